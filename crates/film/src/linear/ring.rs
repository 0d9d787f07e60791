//! Direct solution on a ring of stations, each a short line of cells along the axis.
//!
//! The film's five-point equations, ordered station by station around the bearing, are block
//! tridiagonal with diagonal couplings, plus the corner that closes the ring. Elimination walks the
//! stations in the direction of flow from a cut; the station at the cut is the border of the
//! system, and what couples it is carried along only where it is not zero.
//!
//! Every matrix here has non-negative column sums, a positive diagonal and no positive entry beside
//! it (pressure columns conduct, film-fraction columns drain downstream), so that elimination
//! without pivoting is stable. Film-fraction columns have no entry along the axis and none
//! upstream: they make no fill, and a station costs only the square of its LOADED cells times all
//! its cells. Dense station inverses are formed by Gauss-Jordan sweeps; the next station's matrix
//! follows from them by scaling rows and columns alone, because its couplings are diagonal.

use super::kernels::{
    Lanes, add_diagonal, add_product, apply_inverse, apply_transposed, larger, multiply_left,
    multiply_right, subtract_matrix_product, subtract_product, subtract_product_transposed,
    subtract_scaled, subtract_scaled_line, sweep, two_stations,
};

/// Five-point matrix in row form: entry `west[k]` of row `k` multiplies the unknown of the cell
/// before it around, and so on. Cells `(i, j)` at `i * n_axial + j`.
#[derive(Debug, Clone, PartialEq)]
pub struct RingMatrix {
    /// Stations around.
    pub n_around: usize,
    /// Cells along the axis.
    pub n_axial: usize,
    /// The last station is followed by the first.
    pub periodic: bool,
    /// Diagonal.
    pub centre: Vec<f64>,
    /// Coefficient of the cell at `i - 1`.
    pub west: Vec<f64>,
    /// Coefficient of the cell at `i + 1`.
    pub east: Vec<f64>,
    /// Coefficient of the cell at `j - 1`.
    pub south: Vec<f64>,
    /// Coefficient of the cell at `j + 1`.
    pub north: Vec<f64>,
    /// Whether the column of a cell couples along the axis (a pressure); columns of film fractions
    /// and of known values do not.
    pub loaded: Vec<bool>,
    /// Film fractions drain towards higher `i`.
    pub flows_east: bool,
}

impl RingMatrix {
    /// Zero matrix of the given shape.
    #[must_use]
    pub fn new(n_around: usize, n_axial: usize, periodic: bool) -> Self {
        let zero = vec![0.0; n_around * n_axial];
        Self {
            n_around,
            n_axial,
            periodic,
            centre: zero.clone(),
            west: zero.clone(),
            east: zero.clone(),
            south: zero.clone(),
            north: zero,
            loaded: vec![true; n_around * n_axial],
            flows_east: true,
        }
    }

    /// `residual = rhs - matrix * x`; returns its largest absolute entry.
    pub fn residual(&self, x: &[f64], rhs: &[f64], residual: &mut [f64]) -> f64 {
        let (n, m) = (self.n_around, self.n_axial);
        let mut largest = 0.0_f64;
        for i in 0..n {
            let here = i * m..(i + 1) * m;
            let before = if i == 0 { n - 1 } else { i - 1 } * m;
            let behind = if i + 1 == n { 0 } else { i + 1 } * m;
            let (before, behind) = (&x[before..before + m], &x[behind..behind + m]);
            let (centre, own) = (&self.centre[here.clone()], &x[here.clone()]);
            let (west, east) = (&self.west[here.clone()], &self.east[here.clone()]);
            let (south, north) = (&self.south[here.clone()], &self.north[here.clone()]);
            let (rhs, residual) = (&rhs[here.clone()], &mut residual[here]);
            for j in 0..m {
                let product = centre[j] * own[j] + west[j] * before[j] + east[j] * behind[j];
                residual[j] = rhs[j] - product;
            }
            for j in 1..m {
                residual[j] -= south[j] * own[j - 1];
                residual[j - 1] -= north[j - 1] * own[j];
            }
            for value in residual {
                largest = larger(value.abs(), largest);
            }
        }
        largest
    }
}

/// Factors of a [`RingMatrix`], with all storage made once.
#[derive(Debug, Clone)]
pub struct RingFactor {
    n_axial: usize,
    /// Stations in the order of elimination; the border is not among them.
    order: Vec<usize>,
    border: Option<usize>,
    /// `behind[k]`, `ahead[k]`: couplings of row k to the stations before and after in `order`.
    behind: Vec<f64>,
    ahead: Vec<f64>,
    /// Loaded rows of each station: `rows[start[i]..start[i + 1]]`.
    rows: Vec<usize>,
    start: Vec<usize>,
    /// Per station, all rows by loaded columns, at `i * m * m`.
    inverse: Vec<f64>,
    /// Inverse of the diagonal of rows that are not loaded.
    inverse_diagonal: Vec<f64>,
    /// Coupling of each station's rows to the border unknowns, `m` by `m`, at `i * m * m`.
    to_border: Vec<f64>,
    /// Coupling of the border rows to each station's unknowns.
    from_border: Vec<f64>,
    has_to_border: Vec<bool>,
    has_from_border: Vec<bool>,
    border_inverse: Vec<f64>,
    /// Station matrix under elimination, and scratch of the same size.
    block: Vec<f64>,
    product: Vec<f64>,
    line: Vec<f64>,
    border_line: Vec<f64>,
    /// Lanes of one station and of the border.
    lanes: Vec<f64>,
}

impl RingFactor {
    /// Storage for matrices of the shape of `matrix`.
    #[must_use]
    pub fn new(matrix: &RingMatrix) -> Self {
        let (n, m) = (matrix.n_around, matrix.n_axial);
        let border_size = if matrix.periodic { n * m * m } else { 0 };
        Self {
            n_axial: m,
            order: Vec::with_capacity(n),
            border: None,
            behind: vec![0.0; n * m],
            ahead: vec![0.0; n * m],
            rows: Vec::with_capacity(n * m),
            start: vec![0; n + 1],
            inverse: vec![0.0; n * m * m],
            inverse_diagonal: vec![0.0; n * m],
            to_border: vec![0.0; border_size],
            from_border: vec![0.0; border_size],
            has_to_border: vec![false; n],
            has_from_border: vec![false; n],
            border_inverse: vec![0.0; m * m],
            block: vec![0.0; m * m],
            product: vec![0.0; m * m],
            line: vec![0.0; m],
            border_line: vec![0.0; m],
            lanes: vec![0.0; 2 * 4 * m],
        }
    }

    /// Eliminates `matrix`. Returns `false` where a pivot vanishes: the film is not determined.
    pub fn factor(&mut self, matrix: &RingMatrix) -> bool {
        self.collect_loaded_rows(matrix);
        self.choose_order(matrix);
        self.orient_couplings(matrix);
        self.load_border_couplings(matrix);
        let m = self.n_axial;
        let Some(&first) = self.order.first() else {
            return false;
        };
        self.load_station(matrix, first);
        for position in 0..self.order.len() {
            let station = self.order[position];
            if !self.invert_station(station) {
                return false;
            }
            let next = self.order.get(position + 1).copied();
            self.eliminate_border(station, next);
            if let Some(next) = next {
                self.load_station(matrix, next);
                self.pass_on(station, next);
            }
        }
        if self.border.is_some() {
            return sweep(&mut self.border_inverse, m, |p| p);
        }
        true
    }

    /// Solves in place: `x` holds the right side and becomes the solution.
    pub fn solve(&mut self, x: &mut [f64]) {
        let m = self.n_axial;
        let coupling = [&self.behind, &self.ahead];
        if let Some(border) = self.border {
            self.border_line
                .copy_from_slice(&x[border * m..(border + 1) * m]);
        }
        for position in 0..self.order.len() {
            let station = self.order[position];
            let rows = station * m..(station + 1) * m;
            apply_inverse(
                &self.inverse[station * m * m..],
                &self.inverse_diagonal[rows.clone()],
                &self.rows[self.start[station]..self.start[station + 1]],
                &x[rows],
                &mut self.line,
            );
            if self.has_from_border[station] {
                let block = &self.from_border[station * m * m..(station + 1) * m * m];
                subtract_product(block, &self.line, &mut self.border_line);
            }
            if let Some(&next) = self.order.get(position + 1) {
                for j in 0..m {
                    x[next * m + j] -= coupling[0][next * m + j] * self.line[j];
                }
            }
        }
        if let Some(border) = self.border {
            let solution = &mut x[border * m..(border + 1) * m];
            solution.fill(0.0);
            add_product(&self.border_inverse, &self.border_line, solution);
            self.border_line.copy_from_slice(solution);
        }
        for position in (0..self.order.len()).rev() {
            let station = self.order[position];
            if let Some(&next) = self.order.get(position + 1) {
                for j in 0..m {
                    x[station * m + j] -= coupling[1][station * m + j] * x[next * m + j];
                }
            }
            let rows = station * m..(station + 1) * m;
            if self.has_to_border[station] {
                let block = &self.to_border[station * m * m..(station + 1) * m * m];
                subtract_product(block, &self.border_line, &mut x[rows.clone()]);
            }
            apply_inverse(
                &self.inverse[station * m * m..],
                &self.inverse_diagonal[rows.clone()],
                &self.rows[self.start[station]..self.start[station + 1]],
                &x[rows.clone()],
                &mut self.line,
            );
            x[rows].copy_from_slice(&self.line);
        }
    }

    /// Solves the transposed system in place for several right sides at once, at most four, one per
    /// lane: the adjoints of force and moment. The factors are read once for all of them.
    pub fn solve_transposed<const L: usize>(&mut self, x: &mut [Lanes<L>]) {
        let mut scratch = std::mem::take(&mut self.lanes);
        let m = self.n_axial;
        let (lanes, _) = scratch.as_chunks_mut();
        let (here, border) = lanes.split_at_mut(m);
        self.solve_lanes(x, here, &mut border[..m]);
        self.lanes = scratch;
    }

    fn solve_lanes<const L: usize>(
        &self,
        x: &mut [Lanes<L>],
        here: &mut [Lanes<L>],
        at_border: &mut [Lanes<L>],
    ) {
        let m = self.n_axial;
        let size = m * m;
        if let Some(border) = self.border {
            at_border.copy_from_slice(&x[border * m..(border + 1) * m]);
        }
        for (position, &station) in self.order.iter().enumerate() {
            let rows = station * m..(station + 1) * m;
            self.apply_transposed(station, &x[rows.clone()], here);
            if self.has_to_border[station] {
                let block = &self.to_border[station * size..(station + 1) * size];
                subtract_product_transposed(block, here, at_border);
            }
            if let Some(&next) = self.order.get(position + 1) {
                subtract_scaled(&mut x[next * m..(next + 1) * m], &self.ahead[rows], here);
            }
        }
        if let Some(border) = self.border {
            let solution = &mut x[border * m..(border + 1) * m];
            solution.fill([0.0; L]);
            subtract_product_transposed(&self.border_inverse, at_border, solution);
            for value in solution.iter_mut() {
                *value = value.map(|v| -v);
            }
            at_border.copy_from_slice(solution);
        }
        for (position, &station) in self.order.iter().enumerate().rev() {
            if let Some(&next) = self.order.get(position + 1) {
                let coupling = &self.behind[next * m..(next + 1) * m];
                let (own, next) = two_stations(x, station, next, m);
                subtract_scaled(own, coupling, next);
            }
            let rows = station * m..(station + 1) * m;
            if self.has_from_border[station] {
                let block = &self.from_border[station * size..(station + 1) * size];
                subtract_product_transposed(block, at_border, &mut x[rows.clone()]);
            }
            self.apply_transposed(station, &x[rows.clone()], here);
            x[rows].copy_from_slice(here);
        }
    }

    /// `y = D^-T x` of one station.
    fn apply_transposed<const L: usize>(&self, station: usize, x: &[Lanes<L>], y: &mut [Lanes<L>]) {
        let m = self.n_axial;
        let columns = &self.rows[self.start[station]..self.start[station + 1]];
        let inverse = &self.inverse[station * m * m..station * m * m + m * columns.len()];
        let diagonal = &self.inverse_diagonal[station * m..(station + 1) * m];
        apply_transposed(inverse, diagonal, columns, x, y);
    }

    fn collect_loaded_rows(&mut self, matrix: &RingMatrix) {
        let m = self.n_axial;
        self.rows.clear();
        for i in 0..matrix.n_around {
            self.start[i] = self.rows.len();
            self.rows
                .extend((0..m).filter(|j| matrix.loaded[i * m + j]));
        }
        self.start[matrix.n_around] = self.rows.len();
    }

    /// Walks with the flow. A ring is cut where the fewest couplings cross: at best between
    /// ruptured or fed stations, where nothing need be carried around.
    fn choose_order(&mut self, matrix: &RingMatrix) {
        let (n, m) = (matrix.n_around, matrix.n_axial);
        let step = |i: usize| {
            if matrix.flows_east {
                (i + 1) % n
            } else {
                (i + n - 1) % n
            }
        };
        self.order.clear();
        self.border = None;
        if !matrix.periodic {
            let first = if matrix.flows_east { 0 } else { n - 1 };
            self.order.extend((0..n).scan(first, |i, _| {
                let station = *i;
                *i = step(station);
                Some(station)
            }));
            return;
        }
        let (back, forth) = if matrix.flows_east {
            (&matrix.west, &matrix.east)
        } else {
            (&matrix.east, &matrix.west)
        };
        let crossing = |i: usize| {
            let (cut, next) = (i * m..(i + 1) * m, step(i) * m..(step(i) + 1) * m);
            let forth = forth[cut].iter().filter(|v| **v != 0.0).count();
            let back = back[next].iter().filter(|v| **v != 0.0).count();
            2 * forth + back
        };
        let cut = (0..n).min_by_key(|&i| crossing(i)).unwrap_or(0);
        self.border = Some(cut);
        let mut station = step(cut);
        while station != cut {
            self.order.push(station);
            station = step(station);
        }
    }

    fn orient_couplings(&mut self, matrix: &RingMatrix) {
        let (back, forth) = if matrix.flows_east {
            (&matrix.west, &matrix.east)
        } else {
            (&matrix.east, &matrix.west)
        };
        self.behind.copy_from_slice(back);
        self.ahead.copy_from_slice(forth);
    }

    /// Couplings between the border and its two neighbours, and the border's own block.
    fn load_border_couplings(&mut self, matrix: &RingMatrix) {
        let m = self.n_axial;
        self.has_to_border.fill(false);
        self.has_from_border.fill(false);
        let (Some(border), Some(&first), Some(&last)) =
            (self.border, self.order.first(), self.order.last())
        else {
            return;
        };
        load_block(matrix, border, &mut self.border_inverse);
        for (station, to, from) in [
            (first, &self.behind[first * m..], &self.ahead[border * m..]),
            (last, &self.ahead[last * m..], &self.behind[border * m..]),
        ] {
            if to[..m].iter().any(|v| *v != 0.0) {
                let block = &mut self.to_border[station * m * m..(station + 1) * m * m];
                add_diagonal(block, &to[..m], &mut self.has_to_border[station]);
            }
            if from[..m].iter().any(|v| *v != 0.0) {
                let block = &mut self.from_border[station * m * m..(station + 1) * m * m];
                add_diagonal(block, &from[..m], &mut self.has_from_border[station]);
            }
        }
    }

    /// Fills `block` with the station's own matrix: all rows by its loaded columns.
    fn load_station(&mut self, matrix: &RingMatrix, station: usize) {
        let m = self.n_axial;
        let columns = &self.rows[self.start[station]..self.start[station + 1]];
        let width = columns.len();
        self.block[..m * width].fill(0.0);
        for (c, &j) in columns.iter().enumerate() {
            self.block[j * width + c] = matrix.centre[station * m + j];
            if j > 0 {
                self.block[(j - 1) * width + c] = matrix.north[station * m + j - 1];
            }
            if j + 1 < m {
                self.block[(j + 1) * width + c] = matrix.south[station * m + j + 1];
            }
        }
        for j in 0..m {
            let k = station * m + j;
            self.inverse_diagonal[k] = if matrix.loaded[k] {
                0.0
            } else {
                matrix.centre[k]
            };
        }
    }

    /// Inverts the station matrix in `block` into `inverse`.
    fn invert_station(&mut self, station: usize) -> bool {
        let m = self.n_axial;
        let columns = &self.rows[self.start[station]..self.start[station + 1]];
        let width = columns.len();
        if !sweep(&mut self.block[..m * width], width, |p| columns[p]) {
            return false;
        }
        let inverse = &mut self.inverse[station * m * m..station * m * m + m * width];
        inverse.copy_from_slice(&self.block[..m * width]);
        if width == m {
            return true;
        }
        for j in 0..m {
            let diagonal = &mut self.inverse_diagonal[station * m + j];
            // Loaded rows hold 0 here and have no diagonal part of their own.
            if columns.binary_search(&j).is_err() {
                if *diagonal == 0.0 || !diagonal.is_finite() {
                    return false;
                }
                *diagonal = 1.0 / *diagonal;
                for value in &mut inverse[j * width..(j + 1) * width] {
                    *value *= *diagonal;
                }
            }
        }
        true
    }

    /// Subtracts what the eliminated `station` leaves in the matrix of `next`:
    /// `behind * inverse * ahead`, a scaling of rows and columns.
    fn pass_on(&mut self, station: usize, next: usize) {
        let m = self.n_axial;
        let own = &self.rows[self.start[station]..self.start[station + 1]];
        let columns = &self.rows[self.start[next]..self.start[next + 1]];
        let (own_width, width) = (own.len(), columns.len());
        let inverse = &self.inverse[station * m * m..station * m * m + m * own_width];
        let ahead = &self.ahead[station * m..(station + 1) * m];
        if own == columns {
            for ((scale, &j), _) in self.line.iter_mut().zip(columns).zip(0..width) {
                *scale = ahead[j];
            }
            let lines = inverse.chunks_exact(width.max(1));
            let targets = self.block.chunks_exact_mut(width.max(1));
            let behind = &self.behind[next * m..(next + 1) * m];
            for ((target, line), factor) in targets.zip(lines).zip(behind) {
                if *factor != 0.0 {
                    subtract_scaled_line(target, *factor, line, &self.line);
                }
            }
            return;
        }
        // Column j of `inverse` exists for loaded j; other columns are diagonal.
        let mut own_column = 0;
        for (c, &j) in columns.iter().enumerate() {
            while own_column < own_width && own[own_column] < j {
                own_column += 1;
            }
            let behind = &self.behind[next * m..(next + 1) * m];
            if own_column < own_width && own[own_column] == j {
                for (row, factor) in behind.iter().enumerate() {
                    let entry = inverse[row * own_width + own_column];
                    self.block[row * width + c] -= factor * entry * ahead[j];
                }
            } else {
                let entry = self.inverse_diagonal[station * m + j];
                self.block[j * width + c] -= behind[j] * entry * ahead[j];
            }
        }
    }

    /// Carries the couplings to and from the border past the eliminated `station`.
    fn eliminate_border(&mut self, station: usize, next: Option<usize>) {
        let m = self.n_axial;
        let size = m * m;
        let here = station * size..(station + 1) * size;
        let columns = &self.rows[self.start[station]..self.start[station + 1]];
        let inverse = &self.inverse[here.start..here.start + m * columns.len()];
        let diagonal = &self.inverse_diagonal[station * m..(station + 1) * m];
        if self.has_to_border[station] {
            // product = inverse * to_border
            multiply_left(
                inverse,
                diagonal,
                columns,
                &self.to_border[here.clone()],
                &mut self.product,
            );
            if self.has_from_border[station] {
                let from = &self.from_border[here.clone()];
                subtract_matrix_product(from, &self.product, m, &mut self.border_inverse);
            }
            if let Some(next) = next {
                let behind = &self.behind[next * m..(next + 1) * m];
                if behind.iter().any(|v| *v != 0.0) {
                    let target = &mut self.to_border[next * size..(next + 1) * size];
                    if !self.has_to_border[next] {
                        target.fill(0.0);
                        self.has_to_border[next] = true;
                    }
                    for row in 0..m {
                        for column in 0..m {
                            target[row * m + column] -=
                                behind[row] * self.product[row * m + column];
                        }
                    }
                }
            }
        }
        if let (true, Some(next)) = (self.has_from_border[station], next) {
            let ahead = &self.ahead[station * m..(station + 1) * m];
            if ahead.iter().any(|v| *v != 0.0) {
                // product = from_border * inverse
                multiply_right(
                    &self.from_border[here],
                    inverse,
                    diagonal,
                    columns,
                    &mut self.product,
                );
                let target = &mut self.from_border[next * size..(next + 1) * size];
                if !self.has_from_border[next] {
                    target.fill(0.0);
                    self.has_from_border[next] = true;
                }
                for row in 0..m {
                    for column in 0..m {
                        target[row * m + column] -= self.product[row * m + column] * ahead[column];
                    }
                }
            }
        }
    }
}

/// The full block of one station, all rows by all columns.
fn load_block(matrix: &RingMatrix, station: usize, block: &mut [f64]) {
    let m = matrix.n_axial;
    block.fill(0.0);
    for j in 0..m {
        let k = station * m + j;
        block[j * m + j] = matrix.centre[k];
        if j > 0 {
            block[j * m + j - 1] = matrix.south[k];
        }
        if j + 1 < m {
            block[j * m + j + 1] = matrix.north[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random film-like matrix: pressure columns conduct, the others drain with the flow.
    fn sample(
        n: usize,
        m: usize,
        periodic: bool,
        flows_east: bool,
        seed: u64,
        share: f64,
    ) -> RingMatrix {
        let mut state = seed;
        let mut random = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut a = RingMatrix::new(n, m, periodic);
        a.flows_east = flows_east;
        for k in 0..n * m {
            a.loaded[k] = random() >= share;
        }
        for i in 0..n {
            for j in 0..m {
                let k = i * m + j;
                let (e, w) = ((i + 1) % n * m + j, (i + n - 1) % n * m + j);
                let ends = |into_east: bool| periodic || if into_east { i + 1 < n } else { i > 0 };
                if a.loaded[k] {
                    let mut total = 0.1 * random();
                    for (open, target, side) in [
                        (ends(true), e, 0),
                        (ends(false), w, 1),
                        (j + 1 < m, k + 1, 2),
                        (j > 0, k.wrapping_sub(1), 3),
                    ] {
                        if open {
                            let c = random();
                            total += c;
                            match side {
                                0 => a.west[target] -= c,
                                1 => a.east[target] -= c,
                                2 => a.south[target] -= c,
                                _ => a.north[target] -= c,
                            }
                        }
                    }
                    a.centre[k] = total;
                } else {
                    let c = 0.1 + random();
                    a.centre[k] = c + 0.01;
                    if flows_east && ends(true) {
                        a.west[e] -= c;
                    }
                    if !flows_east && ends(false) {
                        a.east[w] -= c;
                    }
                }
            }
        }
        a
    }

    fn transposed_residual(a: &RingMatrix, y: &[f64], w: &[f64]) -> f64 {
        let (n, m) = (a.n_around, a.n_axial);
        let mut product = vec![0.0; n * m];
        for i in 0..n {
            for j in 0..m {
                let k = i * m + j;
                product[k] += a.centre[k] * y[k];
                product[(i + n - 1) % n * m + j] += a.west[k] * y[k];
                product[(i + 1) % n * m + j] += a.east[k] * y[k];
                if j > 0 {
                    product[k - 1] += a.south[k] * y[k];
                }
                if j + 1 < m {
                    product[k + 1] += a.north[k] * y[k];
                }
            }
        }
        product
            .iter()
            .zip(w)
            .map(|(p, w)| (p - w).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn solves_and_solves_transposed() {
        for periodic in [false, true] {
            for flows_east in [false, true] {
                for (seed, share) in [(1, 0.0), (2, 0.3), (3, 0.6), (4, 0.95), (5, 1.0)] {
                    let a = sample(9, 5, periodic, flows_east, seed, share);
                    let mut factor = RingFactor::new(&a);
                    assert!(factor.factor(&a));
                    let rhs: Vec<f64> = (0..45).map(|k| ((k * 7919) % 13) as f64 - 6.0).collect();
                    let mut x = rhs.clone();
                    factor.solve(&mut x);
                    let mut r = vec![0.0; 45];
                    let scale = x.iter().fold(1.0, |s: f64, v| s.max(v.abs()));
                    let residual = a.residual(&x, &rhs, &mut r);
                    assert!(
                        residual < 1e-11 * scale,
                        "{periodic} {flows_east} {share}: {residual}"
                    );
                    let mut lanes: Vec<Lanes> =
                        rhs.iter().map(|r| [*r, -*r, 0.0, 2.0 * r]).collect();
                    factor.solve_transposed(&mut lanes);
                    assert!(lanes.iter().all(|l| l[1] == -l[0] && l[2] == 0.0));
                    let y: Vec<f64> = lanes.iter().map(|l| l[0]).collect();
                    let scale = y.iter().fold(1.0, |s: f64, v| s.max(v.abs()));
                    let residual = transposed_residual(&a, &y, &rhs);
                    assert!(
                        residual < 1e-11 * scale,
                        "transposed {periodic} {flows_east} {share}: {residual}"
                    );
                }
            }
        }
    }
}
