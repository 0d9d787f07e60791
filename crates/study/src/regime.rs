//! Is the film laminar, as the Reynolds equation assumes?
//!
//! With `Re = rho U C_R / eta` (U sliding speed of the surfaces, C_R radial clearance) a film between
//! concentric cylinders of which the inner one turns becomes unstable at
//! `Re = 41.1 sqrt(R / C_R)` (Taylor vortices); plane shear flow becomes turbulent near `Re = 2000`.
//! Vortices and turbulence raise friction and load capacity above those of the laminar film. An
//! eccentric journal delays both, so that the bound is on the safe side.
//!
//! References: Taylor, G. I. (1923): Stability of a viscous liquid contained between two rotating
//! cylinders. Phil. Trans. R. Soc. A 223, 289-343, doi:10.1098/rsta.1923.0008. San Andres, L.:
//! Modern Lubrication Theory, Notes 8: Turbulence in thin film flows. Texas A&M University.

use crate::results::{Body, CycleResults, Results};
use sommerfeld_film::Bearing;

/// Critical `Re / sqrt(R / C_R)` of Taylor vortices: small gaps, inner cylinder turning (Taylor 1923).
pub const TAYLOR_FACTOR: f64 = 41.1;
/// Reynolds number near which plane shear flow becomes turbulent; of reference only, the passage is
/// gradual (San Andres, Notes 8).
pub const TURBULENT_SHEAR: f64 = 2000.0;
/// Where the two bounds come from, in a line.
pub const SOURCE: &str = "Taylor (1923), Phil. Trans. R. Soc. A 223, 289-343";

/// How the oil flows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// In layers, as the film models assume.
    Laminar,
    /// With Taylor vortices.
    TaylorVortices,
    /// Turbulent.
    Turbulent,
}

/// The Reynolds number of a film beside its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowRegime {
    /// Largest Reynolds number of the film over the run.
    pub reynolds_number: f64,
    /// Reynolds number at which the film stops being laminar.
    pub critical: f64,
    /// How the oil flows.
    pub regime: Regime,
}

impl FlowRegime {
    /// The regime of a film with this Reynolds number; `None` where a film model gives none (0) or
    /// there is no film.
    #[must_use]
    pub fn of(bearing: &Bearing, reynolds_number: f64) -> Option<Self> {
        if !reynolds_number.is_finite() || reynolds_number <= 0.0 {
            return None;
        }
        let vortices = TAYLOR_FACTOR / bearing.relative_clearance().sqrt();
        let regime = if reynolds_number >= TURBULENT_SHEAR {
            Regime::Turbulent
        } else if reynolds_number >= vortices {
            Regime::TaylorVortices
        } else {
            Regime::Laminar
        };
        Some(Self {
            reynolds_number,
            critical: vortices.min(TURBULENT_SHEAR),
            regime,
        })
    }

    /// The regime of a film at its largest Reynolds number over a cycle.
    #[must_use]
    pub fn of_cycle(cycle: &CycleResults) -> Option<Self> {
        let fastest = cycle.largest(|point| point.summary.reynolds_number)?;
        Self::of(&cycle.bearing, fastest.summary.reynolds_number)
    }

    /// What the reader must know where the film is not laminar.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let what = match self.regime {
            Regime::Laminar => return None,
            Regime::TaylorVortices => "Taylor vortices are likely",
            Regime::Turbulent => "a turbulent film is likely",
        };
        Some(format!(
            "beyond laminar flow: the Reynolds number of the film is {:.0}, the bound 41.1 \
             sqrt(R/c), at most {TURBULENT_SHEAR}, is {:.0} here ({SOURCE}); {what}, and friction \
             and load capacity are then higher than those of the laminar film computed",
            self.reynolds_number, self.critical
        ))
    }
}

impl Results {
    /// The regime of the film at its largest Reynolds number.
    #[must_use]
    pub fn flow_regime(&self) -> Option<FlowRegime> {
        match &self.body {
            Body::Steady(steady) => FlowRegime::of(&steady.bearing, steady.summary.reynolds_number),
            Body::LoadCycle(cycle) => FlowRegime::of_cycle(cycle),
            Body::Dimensionless(_) | Body::Machine(_) | Body::Database(_) | Body::Sweep(_) => None,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use sommerfeld_film::{Cavitation, Ends, FilmShear, Inlet, Shape};

    /// A bearing with R/c = 400, so that vortices come at 822.
    fn bearing() -> Bearing {
        Bearing {
            diameter: 0.08,
            width: 0.04,
            radial_clearance: 1e-4,
            bore: Shape::cylindrical(),
            journal: Shape::cylindrical(),
            feeds: Vec::new(),
            ambient_pressure: 0.0,
            cavitation_pressure: 0.0,
            ends: Ends::Air,
            inlet: Inlet::Cyclic,
            cavitation: Cavitation::Reynolds,
            film_shear: FilmShear::FullWidth,
            finish: sommerfeld_film::Finish::Smooth,
            elasticity: sommerfeld_film::Elasticity::Rigid,
        }
    }

    #[test]
    fn each_side_of_each_bound() {
        let regime = |number| FlowRegime::of(&bearing(), number).unwrap().regime;
        assert_eq!(regime(821.9), Regime::Laminar);
        assert_eq!(regime(822.1), Regime::TaylorVortices);
        assert_eq!(regime(1999.0), Regime::TaylorVortices);
        assert_eq!(regime(2000.0), Regime::Turbulent);
    }

    #[test]
    fn a_tight_bearing_is_bounded_by_shear_flow() {
        let tight = Bearing {
            radial_clearance: 1e-5,
            ..bearing()
        };
        let regime = FlowRegime::of(&tight, 2500.0).unwrap();
        assert_eq!(
            (regime.critical, regime.regime),
            (2000.0, Regime::Turbulent)
        );
    }

    #[test]
    fn only_a_film_that_is_not_laminar_warns() {
        assert_eq!(FlowRegime::of(&bearing(), 100.0).unwrap().warning(), None);
        let warning = FlowRegime::of(&bearing(), 900.0)
            .unwrap()
            .warning()
            .unwrap();
        assert!(warning.contains("is 900") && warning.contains("is 822"));
        assert!(FlowRegime::of(&bearing(), 0.0).is_none());
    }
}
