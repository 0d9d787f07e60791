//! Where the film is thinnest, and where its pressure is highest.

use super::SolvedFilm;
use crate::elastic::Elasticity;
use crate::force::Extreme;
use crate::journal_state::JournalState;
use crate::peak::{CENTRE, Peak, WIDTH, Window, parabola_peak};
use crate::reynolds::Cell;

impl SolvedFilm<'_> {
    /// Of the rigid shapes where they are; of the cells where the shell gives way.
    pub(super) fn minimum_film(&self, state: &JournalState) -> Extreme {
        if self.bearing.elasticity != Elasticity::Rigid {
            return self.narrowest_cell();
        }
        let least = self.search.narrowest(self.bearing, state);
        Extreme {
            value: least.gap,
            angle: least.angle,
            axial: least.axial,
        }
    }

    fn narrowest_cell(&self) -> Extreme {
        let heights = self
            .passage
            .map_or(&self.gap.mean, |passage| &passage.height);
        let m = self.grid.n_axial();
        let cells = 0..heights.len();
        let least = cells.min_by(|&a, &b| heights[a].total_cmp(&heights[b]));
        least.map_or_else(Extreme::default, |k| Extreme {
            value: heights[k] * self.units.clearance,
            angle: self.grid.around[k / m],
            axial: self.grid.axial[k % m] * self.units.radius,
        })
    }

    /// Peak of the surface through the highest cell and those around it, Pa.
    pub(super) fn peak_pressure(&self) -> Extreme {
        let highest = (0..self.pressure.len())
            .max_by(|&a, &b| self.loading(a).total_cmp(&self.loading(b)))
            .unwrap_or(0);
        let (i, j) = (highest / self.grid.n_axial(), highest % self.grid.n_axial());
        let peak = self
            .window(i, j)
            .peak()
            .unwrap_or_else(|| self.separate_peak(i, j));
        Extreme {
            value: (self.loading(highest) + peak.rise) * self.units.pressure
                + self.bearing.cavitation_pressure,
            angle: self.grid.around[i] + peak.around,
            axial: (self.grid.axial[j] + peak.axial) * self.units.radius,
        }
    }

    /// The cells around cell `(i, j)`; beyond a mid-plane those before it.
    fn window(&self, i: usize, j: usize) -> Window {
        let m = self.grid.n_axial();
        let z = &self.grid.axial;
        let column = |offset: usize| {
            let column = (j + offset).checked_sub(CENTRE)?;
            if column < m {
                return Some((column, z[column]));
            }
            let mirrored = (2 * m).checked_sub(column + 1)?;
            let middle = self.grid.axial_faces[m];
            self.operator
                .ends_at_mid_plane
                .then_some((mirrored, 2.0 * middle - z[mirrored]))
        };
        let columns: [_; WIDTH] = std::array::from_fn(column);
        let mut window = Window {
            around: [0.0; WIDTH],
            axial: columns.map(|column| column.map_or(f64::NAN, |(_, place)| place - z[j])),
            pressure: [[f64::NAN; WIDTH]; WIDTH],
        };
        let mut fill = |row: usize, i: usize| {
            for (pressure, column) in window.pressure[row].iter_mut().zip(columns) {
                let Some((column, _)) = column else { continue };
                if self.set.cells[i * m + column] == Cell::Full {
                    *pressure = self.loading(i * m + column);
                }
            }
        };
        fill(CENTRE, i);
        for is_east in [false, true] {
            let (mut here, mut place) = (i, 0.0);
            for step in 1..=CENTRE {
                let [to_west, to_east] = self.distances_around(here);
                let (next, row) = if is_east {
                    place += to_east;
                    (self.operator.east(here, 0), CENTRE + step)
                } else {
                    place -= to_west;
                    (self.operator.west(here, 0), CENTRE - step)
                };
                let Some(next) = next else { break };
                here = next / m;
                window.around[row] = place;
                fill(row, here);
            }
        }
        window
    }

    /// Peaks of two parabolas through cell `(i, j)` and its neighbours, around and along.
    fn separate_peak(&self, i: usize, j: usize) -> Peak {
        let m = self.grid.n_axial();
        let highest = i * m + j;
        let top = self.loading(highest);
        let around = match (self.operator.west(i, j), self.operator.east(i, j)) {
            (Some(west), Some(east)) => parabola_peak(
                [self.loading(west), top, self.loading(east)],
                self.distances_around(i),
            ),
            _ => (0.0, 0.0),
        };
        let z = &self.grid.axial;
        let along = if j + 1 == m && self.operator.ends_at_mid_plane {
            let before = if j == 0 {
                top
            } else {
                self.loading(highest - 1)
            };
            let width = self.grid.axial_widths[j];
            let before_width = if j == 0 { width } else { z[j] - z[j - 1] };
            parabola_peak([before, top, top], [before_width, width])
        } else if j == 0 || j + 1 == m {
            (0.0, 0.0)
        } else {
            parabola_peak(
                [self.loading(highest - 1), top, self.loading(highest + 1)],
                [z[j] - z[j - 1], z[j + 1] - z[j]],
            )
        };
        Peak {
            around: around.0,
            axial: along.0,
            rise: around.1 + along.1,
        }
    }

    fn distances_around(&self, i: usize) -> [f64; 2] {
        let widths = &self.grid.around_widths;
        let n = widths.len();
        let half = |a: usize, b: usize| 0.5 * (widths[a] + widths[b]);
        [half((i + n - 1) % n, i), half(i, (i + 1) % n)]
    }
}
