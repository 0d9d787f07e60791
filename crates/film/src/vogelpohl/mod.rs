//! How did the paper solve its film? Its own method, to be compared with the finite volumes.
//!
//! ```text
//! Pi* = Pi H^(3/2)       Pi*_phiphi + (D/B)^2 Pi*_ZZ + a Pi* = b
//! a = -(3/4) H^-2 [2 H H_phiphi + H_phi^2 + (D/B)^2 H_Z^2]
//! b = H^(-3/2) (wedge 6 H_phi + squeeze 12 cos(phi))
//! ```
//! Unknowns: `Pi*` on the nodes of a variable-step grid, five points a node. A coarse grid comes first; each
//! following one has twice the intervals and is meshed anew on the pressure gradient of the one before,
//! whose solution it starts from. On each, point iteration, in which negative pressures are set to 0 as
//! they arise: what it converges to is the closure `reynolds`. Mended here: the paper prints the labels of its
//! equations 14 and 15 interchanged (6 `H_phi` is the wedge), and its condition that the pressure is 0 on the
//! line of the widest gap holds in the first sweep, or throughout with the inlet on that line.
//! Assumptions: incompressible, isoviscous, rigid, smooth, ends at cavitation pressure.
//! Limits: point iteration slows down with the square of the intervals; a gap that is nearly closed at an
//! edge wants many of them. Not converged within the sweeps allowed is [`Outcome::NotConverged`].
//! References: O. Marsalek, P. Novotny, L. Drapal, V. Pistek (2012), 10.2478/v10138-012-0015-7, equations 8 to
//! 20; G. Vogelpohl (1937) for the transform; C. W. Cryer, SIAM J. Control 9 (1971) 385 for the convergence of
//! the iteration with projection.

mod integrals;
mod iteration;
mod mesh;

pub use mesh::Mesh;

use crate::bearing::{Cavitation, Inlet};
use crate::dimensionless::{DimensionlessFilm, DimensionlessIntegrals};
use crate::force::{FilmError, Outcome};
use iteration::{Equations, Iteration};

/// Fewest intervals around and along: the scheme needs neighbours, and positive weights at its nodes.
pub const FEWEST_INTERVALS: [usize; 2] = [16, 4];

/// How the paper's method is run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VogelpohlSettings {
    /// Intervals around and along the axis of the last grid.
    pub intervals: [usize; 2],
    /// Factor of every point step: 1 is the paper's iteration, up to below 2 over-relaxed.
    pub relaxation: f64,
    /// Estimated share of the load that the iteration still lacks when it stops.
    pub tolerance: f64,
    /// Most sweeps on one grid.
    pub most_sweeps: usize,
}

impl VogelpohlSettings {
    /// The paper's iteration on a last grid of so many intervals, to 1e-5 of the load.
    #[must_use]
    pub fn new(intervals: [usize; 2]) -> Self {
        Self {
            intervals,
            relaxation: 1.0,
            tolerance: 1e-5,
            most_sweeps: 200_000,
        }
    }

    fn check(&self) -> Result<(), FilmError> {
        let reason = if (0..2).any(|k| self.intervals[k] < FEWEST_INTERVALS[k]) {
            "the method vogelpohl-fdm needs 16 intervals around and 4 along the axis: use a finer grid"
        } else if !(self.relaxation > 0.0 && self.relaxation < 2.0) {
            "point iteration converges with factors between 0 and 2"
        } else if !(self.tolerance > 0.0 && self.tolerance < 1.0) {
            "the tolerance of the point iteration is a share between 0 and 1"
        } else {
            return Ok(());
        };
        Err(FilmError::Unsupported { reason })
    }
}

/// Solution of a dimensionless film by the paper's method.
#[derive(Debug, Clone, PartialEq)]
pub struct VogelpohlSolution {
    /// The integrals on the last grid.
    pub integrals: DimensionlessIntegrals,
    /// [`Outcome::NotConverged`] where the last grid or one before it used up its sweeps.
    pub outcome: Outcome,
    /// Intervals and sweeps of every grid, the coarsest first.
    pub sweeps: Vec<([usize; 2], usize)>,
    /// The last grid.
    pub mesh: Mesh,
    /// Pressure `Pi` on its nodes: node `i` around, `j` along the axis at `i * mesh.axial.len() + j`.
    pub pressure: Vec<f64>,
}

/// Solves `film` by the paper's method.
///
/// # Errors
/// [`FilmError::Contact`] where the gap closes; [`FilmError::Unsupported`] for a closure other than
/// [`Cavitation::Reynolds`] and for settings that the iteration cannot run with.
pub fn solve_vogelpohl(
    film: &DimensionlessFilm,
    settings: &VogelpohlSettings,
) -> Result<VogelpohlSolution, FilmError> {
    settings.check()?;
    check(film)?;
    let inlet = match film.inlet {
        Inlet::Cyclic => None,
        Inlet::MaxFilmLine { pressure } => Some(pressure),
    };
    let mut outcome = Outcome::Converged;
    let mut sweeps = Vec::new();
    let mut last: Option<(Mesh, Vec<f64>)> = None;
    for intervals in grids(settings.intervals) {
        let mesh = match &last {
            None => Mesh::uniform(intervals),
            Some((coarse, transformed)) => {
                let pressure = pressure_of(film, coarse, transformed);
                coarse.remeshed(&pressure, intervals)
            }
        };
        let start = match &last {
            None => vec![0.0; mesh.nodes()],
            Some((coarse, transformed)) => coarse.carried_to(&mesh, transformed),
        };
        let equations = Equations::new(film, &mesh, inlet);
        let mut iteration = Iteration::new(&equations, start, last.is_none());
        let used = iteration.run(
            settings.relaxation,
            settings.tolerance,
            settings.most_sweeps,
        );
        sweeps.push((intervals, used.sweeps));
        if !used.is_converged {
            outcome = Outcome::NotConverged;
        }
        let transformed = iteration.into_values();
        last = Some((mesh, transformed));
    }
    // `grids` always ends with the one asked for.
    let (mesh, transformed) =
        last.unwrap_or_else(|| (Mesh::uniform(settings.intervals), Vec::new()));
    let pressure = pressure_of(film, &mesh, &transformed);
    Ok(VogelpohlSolution {
        integrals: integrals::of(&mesh, &pressure),
        outcome,
        sweeps,
        mesh,
        pressure,
    })
}

/// Refuses what the scheme is not made for.
fn check(film: &DimensionlessFilm) -> Result<(), FilmError> {
    if film.cavitation != Cavitation::Reynolds {
        return Err(FilmError::Unsupported {
            reason: "the method vogelpohl-fdm has the closure reynolds alone: use cavitation = \"reynolds\"",
        });
    }
    let values = [
        ("d_over_b", film.d_over_b),
        ("relative_eccentricity", film.relative_eccentricity),
        ("tilt_gamma", film.tilt_gamma),
        ("tilt_delta", film.tilt_delta),
        ("wedge", film.wedge),
        ("squeeze", film.squeeze),
    ];
    if let Some((name, _)) = values.into_iter().find(|(_, value)| !value.is_finite()) {
        return Err(FilmError::NotFinite { name });
    }
    let narrowest = film.narrowest_gap();
    if narrowest.relative_film_thickness <= 0.0 {
        // As the bearing of this film has it: R = 1 m, psi = 1e-3, its angle from the narrowest gap.
        return Err(FilmError::Contact {
            angle_deg: (narrowest.phi_deg + 180.0).rem_euclid(360.0),
            axial_mm: 1e3 * narrowest.z / film.d_over_b,
            gap_um: 1e3 * narrowest.relative_film_thickness,
        });
    }
    Ok(())
}

/// Intervals of the grids, the coarsest first: halves of the last one as long as they can be solved.
fn grids(last: [usize; 2]) -> Vec<[usize; 2]> {
    let mut grids = vec![last];
    let mut coarse = last.map(|n| n / 2);
    while (0..2).all(|k| coarse[k] >= FEWEST_INTERVALS[k]) {
        grids.push(coarse);
        coarse = coarse.map(|n| n / 2);
    }
    grids.reverse();
    grids
}

/// `Pi` on the nodes from `Pi*`.
fn pressure_of(film: &DimensionlessFilm, mesh: &Mesh, transformed: &[f64]) -> Vec<f64> {
    let n_axial = mesh.axial.len();
    (transformed.iter().enumerate())
        .map(|(k, value)| {
            let gap =
                iteration::GapAt::new(film, mesh.around[k / n_axial], mesh.axial[k % n_axial]);
            value / gap.height.powf(1.5)
        })
        .collect()
}

#[cfg(test)]
mod tests;
