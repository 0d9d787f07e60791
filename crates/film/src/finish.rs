//! How the two surfaces of a bearing are finished: smooth, or rough with what follows from it.

use crate::contact::ContactLaw;
use crate::flow_factors::FlowFactors;
use crate::roughness::{FinishError, OfGap, Roughness, within};
use serde::{Deserialize, Serialize};

/// Finish of journal and shell. Smooth surfaces have neither flow factors nor contact.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finish {
    /// Smooth.
    #[default]
    Smooth,
    /// Rough.
    Rough(RoughFinish),
}

/// Rough surfaces and what they do in contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoughFinish {
    /// Roughness of both surfaces.
    pub roughness: Roughness,
    /// What asperities carry.
    #[serde(default)]
    pub contact: ContactLaw,
    /// Shear stress over contact pressure where asperities touch, 0 to 1; 0.02 to 0.15 with
    /// lubricant.
    #[serde(default)]
    pub boundary_friction: f64,
}

impl Finish {
    /// Refuses what is no finish.
    ///
    /// # Errors
    /// As [`RoughFinish::check`].
    pub fn check(&self) -> Result<(), FinishError> {
        match self {
            Self::Smooth => Ok(()),
            Self::Rough(rough) => rough.check(),
        }
    }

    /// Flow and stress factors; none for smooth surfaces.
    ///
    /// # Errors
    /// As [`Roughness::check`].
    pub fn flow_factors(&self) -> Result<Option<FlowFactors>, FinishError> {
        match self {
            Self::Smooth => Ok(None),
            Self::Rough(rough) => FlowFactors::new(&rough.roughness).map(Some),
        }
    }

    /// Contact pressure at a nominal gap (m, either sign), Pa; none between smooth surfaces.
    #[must_use]
    pub fn contact_pressure(&self, gap: f64) -> OfGap {
        match self {
            Self::Smooth => OfGap::default(),
            Self::Rough(rough) => {
                let sigma = rough.roughness.composite();
                rough.contact.pressure(gap, sigma)
            }
        }
    }

    /// Composite roughness, m; zero where smooth.
    #[must_use]
    pub fn composite_roughness(&self) -> f64 {
        match self {
            Self::Smooth => 0.0,
            Self::Rough(rough) => rough.roughness.composite(),
        }
    }

    /// Asperities can carry: gaps down to any overlap have an answer.
    #[must_use]
    pub fn has_contact(&self) -> bool {
        matches!(self, Self::Rough(rough) if rough.contact.is_on())
    }
}

impl RoughFinish {
    /// Refuses what is no finish.
    ///
    /// # Errors
    /// [`FinishError`] of the roughness (both surfaces smooth included), of the contact law, or for a
    /// boundary friction outside 0 to 1.
    pub fn check(&self) -> Result<(), FinishError> {
        self.roughness.check()?;
        self.contact.check()?;
        within("boundary_friction", self.boundary_friction, 0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    // a panic is how a test fails
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::contact::GreenwoodTripp;

    /// A measured rig's surfaces, with the Peklenik number of the shell at the end of the range.
    fn rig() -> RoughFinish {
        RoughFinish {
            roughness: Roughness {
                journal: 0.13e-6,
                shell: 0.28e-6,
                peklenik_journal: 4.0,
                peklenik_shell: 9.0,
            },
            contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
                factor: 1e-3,
                asperity_product: 0.05,
                modulus: 53.3e9,
                summit_height: 0.0,
                summit_roughness: None,
            }),
            boundary_friction: 0.02,
        }
    }

    #[test]
    fn surfaces_are_smooth_unless_they_are_said_to_be_rough() {
        let smooth = Finish::default();
        assert_eq!(smooth, Finish::Smooth);
        assert_eq!(smooth.check(), Ok(()));
        assert_eq!(smooth.flow_factors(), Ok(None));
        assert_eq!(smooth.contact_pressure(-1.0), OfGap::default());
        assert!(!smooth.has_contact());
    }

    #[test]
    fn rough_surfaces_carry_by_contact_of_their_composite_roughness() {
        let finish = Finish::Rough(rig());
        assert_eq!(finish.check(), Ok(()));
        assert!(finish.has_contact() && finish.flow_factors().unwrap().is_some());
        // F_5/2(0) = 0.61663422
        let pressure = finish.contact_pressure(0.0).value;
        assert!(
            (pressure / (53.3e6 * 0.616_634_22) - 1.0).abs() < 1e-7,
            "{pressure}"
        );
    }

    #[test]
    fn no_roughness_with_contact_on_is_refused_and_so_is_friction_beyond_its_range() {
        let mut smooth = rig();
        smooth.roughness.journal = 0.0;
        assert_eq!(smooth.check(), Ok(()));
        smooth.roughness.shell = 0.0;
        let error = Finish::Rough(smooth).check().unwrap_err();
        assert_eq!(error, FinishError::NoRoughness);
        let friction = RoughFinish {
            boundary_friction: 2.0,
            ..rig()
        };
        let error = friction.check().unwrap_err().to_string();
        assert!(error.contains("boundary_friction is 2"), "{error}");
    }
}
