//! Where the unknowns live: cells around the circumference and along the axis.
//!
//! Pressure and film fraction live at cell centres, gaps at cell faces. Around, cells are counted
//! by the angle; along the axis by `zeta = z / R`, so that both directions share one length, the
//! bore radius. A planar slider uses its own length in place of the radius.
//! Cell `(i, j)`, `i` around and `j` along the axis, is stored at `i * n_axial + j`.

use crate::bearing::{Bearing, Carrier, FeedShape};
use std::f64::consts::{PI, TAU};

/// Orthogonal grid of cells with given faces.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Faces around, rad (or x/L), ascending; `n_around + 1` of them.
    pub around_faces: Vec<f64>,
    /// Faces along the axis, z/R, ascending; `n_axial + 1` of them.
    pub axial_faces: Vec<f64>,
    /// Cell centres around, rad.
    pub around: Vec<f64>,
    /// Cell centres along the axis, z/R.
    pub axial: Vec<f64>,
    /// Cell lengths around, rad.
    pub around_widths: Vec<f64>,
    /// Cell lengths along the axis, z/R.
    pub axial_widths: Vec<f64>,
}

impl Grid {
    /// Grid with the given ascending faces, each direction at least one cell.
    #[must_use]
    pub fn from_faces(around_faces: Vec<f64>, axial_faces: Vec<f64>) -> Self {
        let centres = |faces: &[f64]| faces.windows(2).map(|f| 0.5 * (f[0] + f[1])).collect();
        let widths = |faces: &[f64]| faces.windows(2).map(|f| f[1] - f[0]).collect();
        Self {
            around: centres(&around_faces),
            axial: centres(&axial_faces),
            around_widths: widths(&around_faces),
            axial_widths: widths(&axial_faces),
            around_faces,
            axial_faces,
        }
    }

    /// Grid fixed in the shell frame, from angle 0 to 2 pi, uniform but for its faces being moved
    /// onto the edges of the grooves that the shell carries and onto the bends of the surfaces: an
    /// edge inside a cell would be a first-order error.
    #[must_use]
    pub fn shell_fixed(bearing: &Bearing, n_around: usize, n_axial: usize) -> Self {
        let radius = bearing.radius();
        let half_width = 0.5 * bearing.width / radius;
        let mut around_edges = bearing.bore.kinks_around();
        let bends = [&bearing.bore, &bearing.journal].map(|shape| shape.kinks_along());
        let mut axial_edges: Vec<f64> = bends.into_iter().flatten().map(|z| z / radius).collect();
        for feed in &bearing.feeds {
            let centre = feed.position / radius;
            let width = match feed.shape {
                FeedShape::Rectangle { width, .. } | FeedShape::Circumferential { width } => width,
                FeedShape::Hole { .. } => continue,
            };
            axial_edges.extend([centre - 0.5 * width / radius, centre + 0.5 * width / radius]);
            if let (FeedShape::Rectangle { length, .. }, Carrier::Shell) =
                (feed.shape, feed.carried_by)
            {
                let half = 0.5 * length / radius;
                around_edges
                    .extend([feed.angle - half, feed.angle + half].map(|a| a.rem_euclid(TAU)));
            }
        }
        Self::from_faces(
            faces_through(0.0, TAU, n_around, around_edges, uniform_faces),
            faces_through(
                -half_width,
                half_width,
                n_axial,
                axial_edges,
                clustered_faces,
            ),
        )
    }

    /// Grid for the frame of the line of centres, from the widest gap at angle -pi over the
    /// narrowest at 0 to the widest at pi, graded towards the narrowest gap by the map
    /// `angle = 2 atan(a tan(s/2))`, `a = sqrt((1-g)/(1+g))`: Sommerfeld's substitution with a
    /// tempered relative eccentricity `g` (0: uniform).
    #[must_use]
    pub fn following(bearing: &Bearing, n_around: usize, n_axial: usize, grading: f64) -> Self {
        let stretch = ((1.0 - grading) / (1.0 + grading)).sqrt();
        let half_width = bearing.width / bearing.diameter;
        let around = (0..=n_around)
            .map(|i| {
                let s = PI * (2.0 * i as f64 / n_around as f64 - 1.0);
                if i == 0 || i == n_around {
                    s // tan(pi/2) is not exact
                } else {
                    2.0 * (stretch * (0.5 * s).tan()).atan()
                }
            })
            .collect();
        let bends = [&bearing.bore, &bearing.journal].map(|shape| shape.kinks_along());
        let bends = bends.into_iter().flatten().map(|z| z / bearing.radius());
        let axial = faces_through(
            -half_width,
            half_width,
            n_axial,
            bends.collect(),
            clustered_faces,
        );
        Self::from_faces(around, axial)
    }

    /// Cells around.
    #[must_use]
    pub fn n_around(&self) -> usize {
        self.around.len()
    }

    /// Cells along the axis.
    #[must_use]
    pub fn n_axial(&self) -> usize {
        self.axial.len()
    }

    /// All cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.n_around() * self.n_axial()
    }

    /// Area of cell `(i, j)` over the square of the radius.
    #[must_use]
    pub fn area(&self, i: usize, j: usize) -> f64 {
        self.around_widths[i] * self.axial_widths[j]
    }

    /// The grid with every second face left out, for nested starts; `None` where that leaves too
    /// few cells to be of use.
    #[must_use]
    pub fn coarsened(&self) -> Option<Self> {
        const FEWEST_AROUND: usize = 32;
        if !self.n_around().is_multiple_of(2) || self.n_around() / 2 < FEWEST_AROUND {
            return None;
        }
        let every_second =
            |faces: &[f64]| -> Vec<f64> { faces.iter().copied().step_by(2).collect() };
        let axial = if self.n_axial().is_multiple_of(2) && self.n_axial() > 4 {
            every_second(&self.axial_faces)
        } else {
            self.axial_faces.clone()
        };
        Some(Self::from_faces(every_second(&self.around_faces), axial))
    }
}

fn uniform_faces(from: f64, to: f64, n: usize) -> Vec<f64> {
    (0..=n)
        .map(|i| from + (to - from) * i as f64 / n as f64)
        .collect()
}

/// Faces clustered towards both ends by a sine map, where a tilted journal makes pressures steep:
/// on the default grid the force of a strongly tilted film is three times as accurate as with even
/// cells, that of an aligned one unchanged.
fn clustered_faces(from: f64, to: f64, n: usize) -> Vec<f64> {
    /// Range of the sine, rad: 0 would be even cells, pi/2 a cosine grid.
    const CLUSTERING: f64 = 1.3;
    uniform_faces(-1.0, 1.0, n)
        .into_iter()
        .map(|s| {
            let relative = (CLUSTERING * s).sin() / CLUSTERING.sin();
            0.5 * ((from + to) + (to - from) * relative)
        })
        .collect()
}

/// `n` cells between `from` and `to` with faces on all `edges` that lie inside: each stretch
/// between edges gets its share of the cells, at least one, and is divided by `divide`.
fn faces_through(
    from: f64,
    to: f64,
    n: usize,
    mut edges: Vec<f64>,
    divide: impl Fn(f64, f64, usize) -> Vec<f64>,
) -> Vec<f64> {
    let near = 1e-9 * (to - from);
    edges.retain(|e| *e > from + near && *e < to - near);
    edges.extend([from, to]);
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| (*a - *b).abs() <= near);
    let stretches: Vec<f64> = edges.windows(2).map(|e| e[1] - e[0]).collect();
    let shares = share_cells(&stretches, n.max(stretches.len()));
    let mut faces = vec![from];
    for (stretch, &cells) in edges.windows(2).zip(&shares) {
        faces.extend(divide(stretch[0], stretch[1], cells).drain(1..));
    }
    faces
}

/// Shares `n` cells among stretches in proportion to their lengths, at least one each: the next
/// cell always goes to the stretch whose cells are the longest. Stretches that mirror one another get
/// alike as long as the cells last, so that a symmetric bearing has a symmetric grid.
fn share_cells(lengths: &[f64], n: usize) -> Vec<usize> {
    let count = lengths.len();
    let total: f64 = lengths.iter().sum();
    let is_symmetric =
        (0..count).all(|k| (lengths[k] - lengths[count - 1 - k]).abs() < 1e-9 * total);
    let mut shares = vec![1; count];
    let mut left = n.saturating_sub(count);
    while left > 0 {
        let candidates = (0..count).filter(|k| {
            // The last cell of a symmetric grid belongs in the middle, if there is one.
            !is_symmetric || left > 1 || count.is_multiple_of(2) || 2 * k + 1 == count
        });
        let longest = candidates.max_by(|&a, &b| {
            (lengths[a] / shares[a] as f64).total_cmp(&(lengths[b] / shares[b] as f64))
        });
        let Some(k) = longest else { break };
        let mirror = count - 1 - k;
        shares[k] += 1;
        left -= 1;
        if is_symmetric && mirror != k && left > 0 {
            shares[mirror] += 1;
            left -= 1;
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrored_stretches_get_alike() {
        assert_eq!(share_cells(&[12.0, 6.0, 12.0], 32), [13, 6, 13]);
        assert_eq!(share_cells(&[6.0, 18.0, 6.0], 16), [3, 10, 3]);
        assert_eq!(share_cells(&[1.0, 3.0], 8), [2, 6]);
        assert_eq!(share_cells(&[1.0, 2.0, 1.0], 3), [1, 1, 1]);
    }
}
