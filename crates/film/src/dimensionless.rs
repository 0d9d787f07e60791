//! The paper's dimensionless problem as a bearing, and its integrals back from the reaction.
//!
//! ```text
//! d/dphi(H^3 dPi/dphi) + (D/B)^2 d/dZ(H^3 dPi/dZ) = wedge 6 dH/dphi + squeeze 12 cos(phi)
//! H = 1 + eps cos(phi) - gamma (1 - eps) Z cos(phi) - delta Z sin(phi),        Z = 2z/B
//! ```
//! phi runs from the WIDEST gap, against which the shell frame's angle, from the narrowest gap, is
//! turned by pi. The bearing has R = 1 m, psi = 1e-3 and eta = psi^2, so that at 1 rad/s and 1/s
//! pressures in Pa are `Pi`. Source: Marsalek, Novotny, Drapal, Pistek (2012), equations 4 to 9, with
//! `delta` as it stands in the gap.

use crate::bearing::{Bearing, Cavitation, Ends, FilmShear, Inlet};
use crate::force::{Conditions, FilmError, FilmForce, FilmSummary, Outcome, Reaction, Step};
use crate::journal_state::JournalState;
use crate::mirror::{Extent, half_of};
use crate::richardson::{
    Estimate, Kind, Sample, cell_size, estimate, grid_sequence, vector_errors,
};
use crate::shape::Shape;
use crate::solver::FilmSolver;
use crate::tilted_grid::tilted_grid;
use serde::{Deserialize, Serialize};
use sommerfeld_oil::Lubricant;

const RADIUS: f64 = 1.0;
const RELATIVE_CLEARANCE: f64 = 1e-3;

/// One dimensionless film.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DimensionlessFilm {
    /// Diameter over width.
    pub d_over_b: f64,
    /// Relative eccentricity.
    pub relative_eccentricity: f64,
    /// Tilt in the plane of the narrowest gap over its largest possible value.
    pub tilt_gamma: f64,
    /// Tilt across that plane, as it stands in the gap.
    pub tilt_delta: f64,
    /// Factor of the wedge term.
    pub wedge: f64,
    /// Factor of the squeeze term.
    pub squeeze: f64,
    /// Closure for the ruptured film.
    pub cavitation: Cavitation,
    /// Where the film starts.
    pub inlet: Inlet,
}

/// Integrals of `Pi` over phi in [0, 2 pi] and Z in [-1, 1], and its peak.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct DimensionlessIntegrals {
    /// Of `Pi cos(phi)`.
    pub p_cos: f64,
    /// Of `Pi sin(phi)`.
    pub p_sin: f64,
    /// Of `Pi Z cos(phi)`.
    pub p_z_cos: f64,
    /// Of `Pi Z sin(phi)`.
    pub p_z_sin: f64,
    /// Largest `Pi`.
    pub peak: f64,
}

/// The narrowest place of a dimensionless gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NarrowestGap {
    /// H there; not positive where the gap closes.
    pub relative_film_thickness: f64,
    /// Angle from the widest gap, degrees.
    pub phi_deg: f64,
    /// Relative axial coordinate; 0 where all are alike.
    pub z: f64,
}

impl DimensionlessFilm {
    /// The bearing whose film this is.
    #[must_use]
    pub fn bearing(&self) -> Bearing {
        Bearing {
            diameter: 2.0 * RADIUS,
            width: 2.0 * RADIUS / self.d_over_b,
            radial_clearance: RELATIVE_CLEARANCE * RADIUS,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: Vec::new(),
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            ends: Ends::Air,
            inlet: self.inlet,
            cavitation: self.cavitation,
            film_shear: FilmShear::FullWidth,
            finish: crate::Finish::Smooth,
            elasticity: crate::Elasticity::Rigid,
        }
    }

    /// Oil of the bearing.
    #[must_use]
    pub fn lubricant(&self) -> Lubricant {
        const DENSITY: f64 = 1.0; // has no effect on an incompressible film
        Lubricant::constant(RELATIVE_CLEARANCE * RELATIVE_CLEARANCE, DENSITY)
    }

    /// State of its journal, the narrowest gap towards +X.
    #[must_use]
    pub fn state(&self) -> JournalState {
        let c = RELATIVE_CLEARANCE * RADIUS;
        let width = 2.0 * RADIUS / self.d_over_b;
        let eps = self.relative_eccentricity;
        JournalState {
            position: [eps * c, 0.0],
            tilt: [
                2.0 * c * self.tilt_delta / width,
                -2.0 * c * self.tilt_gamma * (1.0 - eps) / width,
            ],
            velocity: [self.squeeze * c, 0.0],
            journal_speed: self.wedge,
            ..JournalState::default()
        }
    }

    /// The narrowest place of the gap: it is linear in Z, so it lies at an edge.
    #[must_use]
    pub fn narrowest_gap(&self) -> NarrowestGap {
        let eps = self.relative_eccentricity;
        let at = |z: f64| {
            let cos = eps - self.tilt_gamma * (1.0 - eps) * z;
            let sin = -self.tilt_delta * z;
            NarrowestGap {
                relative_film_thickness: 1.0 - cos.hypot(sin),
                phi_deg: (-sin).atan2(-cos).to_degrees().rem_euclid(360.0),
                z,
            }
        };
        [at(-1.0), at(1.0)]
            .into_iter()
            .fold(at(0.0), |narrowest, edge| {
                if edge.relative_film_thickness < narrowest.relative_film_thickness {
                    edge
                } else {
                    narrowest
                }
            })
    }

    /// The paper's integrals from the film's answer.
    #[must_use]
    pub fn integrals(&self, reaction: &Reaction, summary: &FilmSummary) -> DimensionlessIntegrals {
        let half_width = RADIUS / self.d_over_b;
        let (force, moment) = (reaction.film_force, reaction.film_moment);
        let per_force = 1.0 / (RADIUS * half_width);
        let per_moment = per_force / half_width;
        DimensionlessIntegrals {
            p_cos: force[0] * per_force,
            p_sin: force[1] * per_force,
            p_z_cos: moment[1] * per_moment,
            p_z_sin: -moment[0] * per_moment,
            peak: summary.peak_film_pressure.value,
        }
    }

    /// Grading of a following grid that suits the narrowest gap, see [`crate::Grid::following`].
    #[must_use]
    pub fn grading(&self) -> f64 {
        (0.95 - self.narrowest_gap().relative_film_thickness).clamp(0.0, 0.95)
    }
}

/// Solution of a dimensionless film.
#[derive(Debug, Clone, PartialEq)]
pub struct DimensionlessSolution {
    /// The integrals, extrapolated from two axial resolutions.
    pub integrals: DimensionlessIntegrals,
    /// How far the extrapolation moved each of them: an estimate of the error before it.
    pub moved: DimensionlessIntegrals,
    /// How the solution ended.
    pub outcome: Outcome,
    /// Film updates on both grids.
    pub iterations: usize,
}

/// Solves `film` on `n_around` x `n_axial` cells and on half the axial cells, and extrapolates: the
/// error is nearly all axial and of second order (Richardson).
///
/// # Errors
/// [`FilmError::Contact`] where the gap closes.
pub fn solve_dimensionless(
    film: &DimensionlessFilm,
    [n_around, n_axial]: [usize; 2],
) -> Result<DimensionlessSolution, FilmError> {
    let fine = solve_on(film, [n_around, n_axial])?;
    let coarse = solve_on(film, [n_around, n_axial / 2])?;
    let ratio = (n_axial as f64 / (n_axial / 2) as f64).powi(2);
    Ok(extrapolated_from(fine, coarse, ratio))
}

/// Solves `film` on `n_around` x `n_axial` cells that suit its tilt, see [`tilted_grid`], and on half as many each
/// way, and extrapolates (Richardson). Of an aligned film half is solved. Where the gap is narrow at an edge it errs
/// by a third of what [`solve_dimensionless`] does, in less than half the time. Numbers of cells are multiples of 4.
///
/// # Errors
/// [`FilmError::Contact`] where the gap closes, [`FilmError::Unsupported`] for other numbers of cells.
pub fn solve_graded(
    film: &DimensionlessFilm,
    [n_around, n_axial]: [usize; 2],
) -> Result<DimensionlessSolution, FilmError> {
    if n_around == 0 || n_axial == 0 || n_around % 4 + n_axial % 4 > 0 {
        return Err(FilmError::Unsupported {
            reason: "a graded film needs numbers of cells that are multiples of 4",
        });
    }
    let solve = |cells| {
        let (bearing, oil, state) = (film.bearing(), film.lubricant(), film.state());
        let grid = tilted_grid(&bearing, &state, cells);
        let half = match state.tilt == [0.0; 2] {
            true => half_of(&bearing, &grid),
            false => None,
        };
        let solver = match half {
            Some(half) => FilmSolver::following_on(&bearing, &oil, half, Extent::Half)?,
            None => FilmSolver::following_on(&bearing, &oil, grid, Extent::Whole)?,
        };
        solve_with(film, solver)
    };
    let fine = solve([n_around, n_axial])?;
    let coarse = solve([n_around / 2, n_axial / 2])?;
    Ok(extrapolated_from(fine, coarse, 4.0))
}

/// The limit of two solutions whose errors are to each other as 1 to `ratio`.
fn extrapolated_from(
    (fine, outcome, fine_iterations): Solved,
    (coarse, coarse_outcome, coarse_iterations): Solved,
    ratio: f64,
) -> DimensionlessSolution {
    let shift = |fine: f64, coarse: f64| (fine - coarse) / (ratio - 1.0);
    let moved = combine(&fine, &coarse, shift);
    DimensionlessSolution {
        integrals: combine(&fine, &moved, |value, by| value + by),
        moved,
        outcome: if coarse_outcome == Outcome::Converged {
            outcome
        } else {
            coarse_outcome
        },
        iterations: fine_iterations + coarse_iterations,
    }
}

/// Most cells that [`refine_dimensionless`] tries: 512 x 128.
pub const MOST_CELLS: usize = 1 << 16;

/// A dimensionless film solved to an error.
#[derive(Debug, Clone, PartialEq)]
pub struct RefinedSolution {
    /// The integrals, extrapolated from the last three grids.
    pub integrals: DimensionlessIntegrals,
    /// Error of each of them, absolute.
    pub error: DimensionlessIntegrals,
    /// The finest grid.
    pub grid: [usize; 2],
    /// All errors are within the target.
    pub reached: bool,
    /// How the solution ended.
    pub outcome: Outcome,
    /// Film updates on all grids.
    pub iterations: usize,
}

impl RefinedSolution {
    /// Errors of the integrals over their scales: forces over the force vector; moments over the larger of
    /// the moment vector and a tenth of the force, so that moments that vanish by symmetry have a
    /// scale; the peak over itself.
    #[must_use]
    pub fn relative_errors(&self) -> [(&'static str, f64); 5] {
        let (value, error) = (&self.integrals, &self.error);
        let force = value.p_cos.hypot(value.p_sin);
        let moment = value.p_z_cos.hypot(value.p_z_sin).max(0.1 * force);
        // An error of nothing is none, whatever the scale.
        let over = |error: f64, scale: f64| if error == 0.0 { 0.0 } else { error / scale };
        [
            ("integrals.p_cos", over(error.p_cos, force)),
            ("integrals.p_sin", over(error.p_sin, force)),
            ("integrals.p_z_cos", over(error.p_z_cos, moment)),
            ("integrals.p_z_sin", over(error.p_z_sin, moment)),
            ("integrals.peak", over(error.peak, value.peak.abs())),
        ]
    }
}

/// Solves `film` on ever finer grids around `first`, at least three and up to [`MOST_CELLS`], until
/// every error of the extrapolated integrals is below `target`, relative to the scales of
/// [`RefinedSolution::relative_errors`].
///
/// # Errors
/// [`FilmError::Contact`] where the gap closes.
pub fn refine_dimensionless(
    film: &DimensionlessFilm,
    first: [usize; 2],
    target: f64,
) -> Result<RefinedSolution, FilmError> {
    let mut runs: Vec<([usize; 2], DimensionlessIntegrals)> = Vec::new();
    let mut refined = RefinedSolution {
        integrals: DimensionlessIntegrals::default(),
        error: DimensionlessIntegrals::default(),
        grid: first,
        reached: false,
        outcome: Outcome::Converged,
        iterations: 0,
    };
    for grid in grid_sequence(first) {
        if runs.len() >= 3 && grid[0] * grid[1] > MOST_CELLS {
            break;
        }
        let (integrals, outcome, iterations) = solve_on(film, grid)?;
        refined.iterations += iterations;
        runs.insert(0, (grid, integrals));
        if outcome != Outcome::Converged {
            refined.outcome = outcome;
            refined.grid = grid;
            refined.integrals = integrals;
            break;
        }
        if let [fine, middle, coarse, ..] = runs[..] {
            let [value, error] = extrapolated([fine, middle, coarse]);
            refined.grid = grid;
            refined.integrals = value;
            refined.error = error;
            let mut errors = refined.relative_errors().into_iter();
            refined.reached = errors.all(|(_, error)| error <= target);
            if refined.reached {
                break;
            }
        }
    }
    Ok(refined)
}

/// Limits of three runs, the finest first, and their errors.
fn extrapolated(runs: [([usize; 2], DimensionlessIntegrals); 3]) -> [DimensionlessIntegrals; 2] {
    let of = |kind: Kind, figure: fn(&DimensionlessIntegrals) -> f64| {
        let samples = runs.map(|(grid, integrals)| Sample {
            size: cell_size(grid),
            value: figure(&integrals),
        });
        estimate(kind, samples)
    };
    let figures = [
        of(Kind::Integral, |i| i.p_cos),
        of(Kind::Integral, |i| i.p_sin),
        of(Kind::Integral, |i| i.p_z_cos),
        of(Kind::Integral, |i| i.p_z_sin),
        of(Kind::Extreme, |i| i.peak),
    ];
    let gathered = |of: fn(&Estimate) -> f64| {
        let [p_cos, p_sin, p_z_cos, p_z_sin, peak] = figures.each_ref().map(of);
        DimensionlessIntegrals {
            p_cos,
            p_sin,
            p_z_cos,
            p_z_sin,
            peak,
        }
    };
    let mut error = gathered(|e| e.error);
    [error.p_cos, error.p_sin] = vector_errors([error.p_cos, error.p_sin]);
    [error.p_z_cos, error.p_z_sin] = vector_errors([error.p_z_cos, error.p_z_sin]);
    [gathered(|e| e.extrapolated), error]
}

/// Integrals, how the solution ended, film updates.
type Solved = (DimensionlessIntegrals, Outcome, usize);

fn solve_on(film: &DimensionlessFilm, cells: [usize; 2]) -> Result<Solved, FilmError> {
    let solver = FilmSolver::following(&film.bearing(), &film.lubricant(), cells, film.grading())?;
    solve_with(film, solver)
}

fn solve_with(film: &DimensionlessFilm, mut solver: FilmSolver) -> Result<Solved, FilmError> {
    let conditions = Conditions {
        temperature: 373.15, // the viscosity is constant
        feed_pressures: None,
    };
    let answer = solver.react(&film.state(), Step::Steady, &conditions)?;
    let summary = solver.summary();
    let integrals = film.integrals(&answer.reaction, &summary);
    Ok((integrals, answer.outcome, summary.iterations))
}

fn combine(
    a: &DimensionlessIntegrals,
    b: &DimensionlessIntegrals,
    with: impl Fn(f64, f64) -> f64,
) -> DimensionlessIntegrals {
    DimensionlessIntegrals {
        p_cos: with(a.p_cos, b.p_cos),
        p_sin: with(a.p_sin, b.p_sin),
        p_z_cos: with(a.p_z_cos, b.p_z_cos),
        p_z_sin: with(a.p_z_sin, b.p_z_sin),
        peak: with(a.peak, b.peak),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Graded cells agree with the others as far as those can tell, half a film with a whole one.
    #[test]
    fn graded_cells_find_the_same_film() {
        let base = DimensionlessFilm {
            d_over_b: 2.0,
            relative_eccentricity: 0.5,
            tilt_gamma: 0.0,
            tilt_delta: 0.0,
            wedge: 1.0,
            squeeze: 0.0,
            cavitation: Cavitation::Reynolds,
            inlet: Inlet::Cyclic,
        };
        let tilted = DimensionlessFilm {
            tilt_gamma: 0.4,
            tilt_delta: 0.3,
            ..base
        };
        let nearly = DimensionlessFilm {
            tilt_delta: 1e-9,
            ..base
        };
        for (film, other, bar) in [
            (base, base, 1e-3),
            (tilted, tilted, 1e-3),
            (base, nearly, 1e-7),
        ] {
            let found = solve_graded(&film, [96, 32]).map(|solution| solution.integrals);
            let expected = match bar < 1e-6 {
                true => solve_graded(&other, [96, 32]),
                false => solve_dimensionless(&other, [128, 48]),
            };
            let (Ok(a), Ok(b)) = (found, expected.map(|solution| solution.integrals)) else {
                unreachable!("these films have solutions");
            };
            let force = b.p_cos.hypot(b.p_sin);
            assert!((a.p_cos - b.p_cos).hypot(a.p_sin - b.p_sin) < bar * force);
            assert!((a.p_z_cos - b.p_z_cos).hypot(a.p_z_sin - b.p_z_sin) < bar * force);
            assert!((a.peak - b.peak).abs() < (5.0 * bar).min(0.5) * b.peak);
        }
        assert!(solve_graded(&base, [90, 32]).is_err());
    }

    #[test]
    fn the_gap_of_a_tilted_film_closes_at_an_edge() {
        let film = DimensionlessFilm {
            d_over_b: 2.0,
            relative_eccentricity: 0.8,
            tilt_gamma: 1.0,
            tilt_delta: 0.0,
            wedge: 1.0,
            squeeze: 0.0,
            cavitation: Cavitation::Reynolds,
            inlet: Inlet::Cyclic,
        };
        let narrowest = film.narrowest_gap();
        assert!(narrowest.relative_film_thickness.abs() < 1e-12);
        assert!((narrowest.phi_deg - 180.0).abs() < 1e-9);
        assert!((narrowest.z + 1.0).abs() < 1e-12);
    }
}
