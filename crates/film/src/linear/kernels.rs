//! Small dense kernels of the ring solver: where its time goes. Matrices are row-major.

/// Right sides side by side: four outputs of a film, or two where no moment acts.
pub type Lanes<const L: usize = 4> = [f64; L];

/// The larger of two numbers; `b` where `a` is not a number. One instruction in loops that [`f64::max`],
/// which asks after both, would make wait.
#[inline(always)]
#[must_use]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

pub(super) fn add_diagonal(block: &mut [f64], diagonal: &[f64], in_use: &mut bool) {
    let m = diagonal.len();
    if !*in_use {
        block.fill(0.0);
        *in_use = true;
    }
    for j in 0..m {
        block[j * m + j] += diagonal[j];
    }
}

/// Gauss-Jordan sweeps on `rows` x `width`: afterwards the pivot rows hold the inverse of the pivot
/// block P, the other rows `-C P^-1` with C their own entries. `pivot_row(p)` is the row of pivot
/// column `p`. Returns `false` at a vanishing pivot.
pub(super) fn sweep(block: &mut [f64], width: usize, pivot_row: impl Fn(usize) -> usize) -> bool {
    // Of a known width the lines stay in registers.
    match width {
        4 => sweep_lines(block, 4, pivot_row),
        8 => sweep_lines(block, 8, pivot_row),
        16 => sweep_lines(block, 16, pivot_row),
        32 => sweep_lines(block, 32, pivot_row),
        _ => sweep_lines(block, width, pivot_row),
    }
}

#[inline(always)]
fn sweep_lines(block: &mut [f64], width: usize, pivot_row: impl Fn(usize) -> usize) -> bool {
    for p in 0..width {
        let row = pivot_row(p);
        let (above, rest) = block.split_at_mut(row * width);
        let (pivots, below) = rest.split_at_mut(width);
        let pivot = pivots[p];
        if pivot == 0.0 || !pivot.is_finite() {
            return false;
        }
        let inverse = 1.0 / pivot;
        for value in pivots.iter_mut() {
            *value *= inverse;
        }
        pivots[p] = inverse;
        for lines in [above, below] {
            for line in lines.chunks_exact_mut(width) {
                let factor = line[p];
                if factor != 0.0 {
                    line[p] = 0.0;
                    for (value, pivot) in line.iter_mut().zip(pivots.iter()) {
                        *value -= factor * pivot;
                    }
                }
            }
        }
    }
    true
}

/// `y = D^-1 x` of one station.
pub(super) fn apply_inverse(
    inverse: &[f64],
    diagonal: &[f64],
    columns: &[usize],
    x: &[f64],
    y: &mut [f64],
) {
    let width = columns.len();
    if width == x.len() {
        // All rows are loaded and have no diagonal part of their own.
        return match width {
            8 => product(inverse, 8, x, y),
            16 => product(inverse, 16, x, y),
            32 => product(inverse, 32, x, y),
            _ => product(inverse, width, x, y),
        };
    }
    for (row, value) in y.iter_mut().enumerate() {
        let line = &inverse[row * width..(row + 1) * width];
        let loaded: f64 = line.iter().zip(columns).map(|(a, &j)| a * x[j]).sum();
        *value = diagonal[row] * x[row] + loaded;
    }
}

/// `y = A x` for a square row-major A.
#[inline(always)]
fn product(a: &[f64], width: usize, x: &[f64], y: &mut [f64]) {
    let x = &x[..width];
    for (line, value) in a.chunks_exact(width).zip(y) {
        *value = dot(line, x);
    }
}

/// `y = D^-T x` of one station.
pub(super) fn apply_transposed<const L: usize>(
    inverse: &[f64],
    diagonal: &[f64],
    columns: &[usize],
    x: &[Lanes<L>],
    y: &mut [Lanes<L>],
) {
    let width = columns.len();
    if width == x.len() {
        y.fill([0.0; L]);
        return match width {
            8 => add_product_transposed(inverse, 8, x, y),
            16 => add_product_transposed(inverse, 16, x, y),
            32 => add_product_transposed(inverse, 32, x, y),
            _ => add_product_transposed(inverse, width, x, y),
        };
    }
    for ((value, d), x) in y.iter_mut().zip(diagonal).zip(x) {
        *value = x.map(|x| d * x);
    }
    if width == 0 {
        return;
    }
    for (line, x) in inverse.chunks_exact(width).zip(x) {
        for (entry, &j) in line.iter().zip(columns) {
            add_lanes(&mut y[j], *entry, x);
        }
    }
}

/// `y += A^T x` for a square row-major A.
#[inline(always)]
fn add_product_transposed<const L: usize>(
    a: &[f64],
    width: usize,
    x: &[Lanes<L>],
    y: &mut [Lanes<L>],
) {
    let y = &mut y[..width];
    for (line, x) in a.chunks_exact(width).zip(x) {
        for (value, entry) in y.iter_mut().zip(line) {
            add_lanes(value, *entry, x);
        }
    }
}

/// Four partial sums, so that the additions do not wait for one another.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4
        .remainder()
        .iter()
        .zip(b4.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a4.zip(b4) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// `y += A x` for a square row-major A.
pub(super) fn add_product(a: &[f64], x: &[f64], y: &mut [f64]) {
    for (line, value) in a.chunks_exact(x.len()).zip(y) {
        *value += dot(line, x);
    }
}

pub(super) fn subtract_product(a: &[f64], x: &[f64], y: &mut [f64]) {
    for (line, value) in a.chunks_exact(x.len()).zip(y) {
        *value -= dot(line, x);
    }
}

pub(super) fn subtract_product_transposed<const L: usize>(
    a: &[f64],
    x: &[Lanes<L>],
    y: &mut [Lanes<L>],
) {
    for (line, x) in a.chunks_exact(y.len()).zip(x) {
        let factor = x.map(|v| -v);
        for (value, entry) in y.iter_mut().zip(line) {
            add_lanes(value, *entry, &factor);
        }
    }
}

#[inline]
pub(super) fn add_lanes<const L: usize>(target: &mut Lanes<L>, factor: f64, source: &Lanes<L>) {
    for (value, entry) in target.iter_mut().zip(source) {
        *value += factor * entry;
    }
}

/// `x -= diagonal * y`.
pub(super) fn subtract_scaled<const L: usize>(
    x: &mut [Lanes<L>],
    diagonal: &[f64],
    y: &[Lanes<L>],
) {
    for ((value, factor), y) in x.iter_mut().zip(diagonal).zip(y) {
        add_lanes(value, -factor, y);
    }
}

/// The lines of two different stations, the first to be written.
pub(super) fn two_stations<const L: usize>(
    x: &mut [Lanes<L>],
    first: usize,
    second: usize,
    m: usize,
) -> (&mut [Lanes<L>], &[Lanes<L>]) {
    if first < second {
        let (low, high) = x.split_at_mut(second * m);
        (&mut low[first * m..(first + 1) * m], &high[..m])
    } else {
        let (low, high) = x.split_at_mut(first * m);
        (&mut high[..m], &low[second * m..(second + 1) * m])
    }
}

/// `product = D^-1 right` for a square `right`, many of whose rows may be zero.
pub(super) fn multiply_left(
    inverse: &[f64],
    diagonal: &[f64],
    columns: &[usize],
    right: &[f64],
    product: &mut [f64],
) {
    let m = diagonal.len();
    let width = columns.len();
    for ((target, source), d) in product
        .chunks_exact_mut(m)
        .zip(right.chunks_exact(m))
        .zip(diagonal)
    {
        for (value, entry) in target.iter_mut().zip(source) {
            *value = d * entry;
        }
    }
    for (column, &j) in columns.iter().enumerate() {
        let source = &right[j * m..(j + 1) * m];
        if source.iter().all(|v| *v == 0.0) {
            continue;
        }
        for (row, target) in product.chunks_exact_mut(m).enumerate() {
            add_scaled(target, inverse[row * width + column], source);
        }
    }
}

/// `product = left D^-1` for a square `left`.
pub(super) fn multiply_right(
    left: &[f64],
    inverse: &[f64],
    diagonal: &[f64],
    columns: &[usize],
    product: &mut [f64],
) {
    let m = diagonal.len();
    let width = columns.len();
    for row in 0..m {
        let source = &left[row * m..(row + 1) * m];
        let target = &mut product[row * m..(row + 1) * m];
        for j in 0..m {
            target[j] = source[j] * diagonal[j];
        }
        for (inner, factor) in source.iter().enumerate() {
            if *factor != 0.0 {
                let line = &inverse[inner * width..(inner + 1) * width];
                for (entry, &j) in line.iter().zip(columns) {
                    target[j] += factor * entry;
                }
            }
        }
    }
}

/// `target -= left right`, all square.
pub(super) fn subtract_matrix_product(left: &[f64], right: &[f64], m: usize, target: &mut [f64]) {
    for row in 0..m {
        for inner in 0..m {
            let factor = -left[row * m + inner];
            add_scaled(
                &mut target[row * m..(row + 1) * m],
                factor,
                &right[inner * m..(inner + 1) * m],
            );
        }
    }
}

pub(super) fn add_scaled(target: &mut [f64], factor: f64, source: &[f64]) {
    if factor != 0.0 {
        for (value, entry) in target.iter_mut().zip(source) {
            *value += factor * entry;
        }
    }
}

/// `target -= factor * line * scale`, entry by entry.
#[inline]
pub(super) fn subtract_scaled_line(target: &mut [f64], factor: f64, line: &[f64], scale: &[f64]) {
    for ((value, entry), scale) in target.iter_mut().zip(line).zip(scale) {
        *value -= factor * entry * scale;
    }
}
