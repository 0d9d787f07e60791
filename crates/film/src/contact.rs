//! What do asperities carry where the surfaces come close?
//!
//! ```text
//! p_c   = (16 sqrt(2) pi/15) (n b s)^2 sqrt(s/b) E' F_5/2(H)          A_c/A = pi^2 (n b s)^2 F_2(H)
//! H     = (h - d)/s                      1/E' = (1 - nu_J^2)/E_J + (1 - nu_S^2)/E_S
//! ```
//! n asperity density of each surface, b their radius, s rms of both surfaces' summit heights about their
//! means, h nominal gap, d how far the means of the summits stand above the mean planes. Two paraboloids
//! that meet off their summits touch as spheres of radius b/2 do (Hertz); the first formula is that
//! force over all offsets and over Gaussian sums of heights.
//!
//! Assumptions: elastic asperities of one radius, alike on both surfaces; those that touch do not
//! feel each other, so that areas near 1 are beyond the theory. Unless said otherwise summits spread as
//! the surface does, about its mean plane: d = 0, s the composite rms roughness. The mean is over the
//! nominal area, which h may overlap. Instead of the theory, pressure over gap may come from a table
//! ([`ContactTable`]).
//!
//! Reference: J. A. Greenwood, J. H. Tripp, Proc. Instn Mech. Engrs 185 (1970) 625.

pub use crate::contact_table::ContactTable;
use crate::height_integrals::{F_2, F_5_2};
use crate::roughness::{FinishError, LARGEST_ROUGHNESS, OfGap, positive, within};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, SQRT_2};

/// Law of contact between rough surfaces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactLaw {
    /// Asperities carry nothing.
    #[default]
    None,
    /// Elastic asperities.
    GreenwoodTripp(GreenwoodTripp),
    /// Pressure over gap as given.
    Table(ContactTable),
}

/// Parameters of Greenwood and Tripp as they enter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GreenwoodTripp {
    /// `(16 sqrt(2) pi/15) (n b s)^2 sqrt(s/b)`; 3e-4 to 3e-3 for ground surfaces.
    pub factor: f64,
    /// `n b s`; 0.03 to 0.05 for most surfaces.
    pub asperity_product: f64,
    /// Composite modulus E', Pa.
    pub modulus: f64,
    /// Mean height d of the summits above the mean planes of the surfaces, of both together, m; not
    /// negative. About the sum of the rms roughnesses for measured surfaces.
    #[serde(default)]
    pub summit_height: f64,
    /// rms s of the summit heights about their means, of both surfaces together, m; positive. `None`:
    /// they spread as the surfaces do.
    #[serde(default)]
    pub summit_roughness: Option<f64>,
}

/// Asperities of one surface; those of the other are alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asperities {
    /// Asperities per area, 1/m2.
    pub density: f64,
    /// Radius of their tips, m.
    pub radius: f64,
}

/// What a surface is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Modulus of elasticity, Pa.
    pub modulus: f64,
    /// Poisson ratio.
    pub poisson_ratio: f64,
}

impl GreenwoodTripp {
    /// From what asperities and materials are: `sigma` is the composite rms roughness, m. Summits spread as
    /// the surfaces do, about their mean planes.
    ///
    /// # Errors
    /// [`FinishError`] for a value that is not positive, or a Poisson ratio outside 0 to 0.5.
    pub fn from_asperities(
        asperities: Asperities,
        sigma: f64,
        journal: Solid,
        shell: Solid,
    ) -> Result<Self, FinishError> {
        positive("asperity_density", asperities.density)?;
        positive("asperity_radius", asperities.radius)?;
        positive("roughness", sigma)?;
        let product = asperities.density * asperities.radius * sigma;
        let slender = (sigma / asperities.radius).sqrt();
        Ok(Self {
            factor: 16.0 * SQRT_2 * PI / 15.0 * product * product * slender,
            asperity_product: product,
            modulus: composite_modulus(journal, shell)?,
            summit_height: 0.0,
            summit_roughness: None,
        })
    }

    /// Distance of the means of the summits over the rms of their heights, and that rms, m.
    fn between_summits(&self, gap: f64, roughness: f64) -> (f64, f64) {
        let sigma = self.summit_roughness.unwrap_or(roughness);
        ((gap - self.summit_height) / sigma, sigma)
    }

    fn pressure(&self, gap: f64, roughness: f64) -> OfGap {
        let (distance, sigma) = self.between_summits(gap, roughness);
        scaled(self.factor * self.modulus, F_5_2.at(distance), sigma)
    }

    fn area_share(&self, gap: f64, roughness: f64) -> OfGap {
        let unit = (PI * self.asperity_product).powi(2);
        let (distance, sigma) = self.between_summits(gap, roughness);
        let share = scaled(unit, F_2.at(distance), sigma);
        if share.value > 1.0 {
            return OfGap {
                value: 1.0,
                by_gap: 0.0,
            };
        }
        share
    }
}

/// E' of two materials, Pa.
///
/// # Errors
/// [`FinishError`] for a modulus that is not positive, or a Poisson ratio outside 0 to 0.5.
pub fn composite_modulus(journal: Solid, shell: Solid) -> Result<f64, FinishError> {
    positive("modulus_journal", journal.modulus)?;
    positive("modulus_shell", shell.modulus)?;
    within("poisson_ratio_journal", journal.poisson_ratio, 0.0, 0.5)?;
    within("poisson_ratio_shell", shell.poisson_ratio, 0.0, 0.5)?;
    let softness = |s: Solid| (1.0 - s.poisson_ratio * s.poisson_ratio) / s.modulus;
    Ok(1.0 / (softness(journal) + softness(shell)))
}

/// A function of gap over roughness, in its unit.
fn scaled(unit: f64, (value, by_h): (f64, f64), sigma: f64) -> OfGap {
    OfGap {
        value: unit * value,
        by_gap: unit * by_h / sigma,
    }
}

impl ContactLaw {
    /// Contact pressure (Pa, mean over the nominal area) at a nominal gap (m, either sign) of surfaces
    /// with the composite rms roughness `sigma` (m, positive; a table and summits with a roughness of
    /// their own do not use it).
    /// C1, zero far away, never rising with the gap.
    #[must_use]
    pub fn pressure(&self, gap: f64, sigma: f64) -> OfGap {
        match self {
            Self::None => OfGap::default(),
            Self::GreenwoodTripp(law) => law.pressure(gap, sigma),
            Self::Table(table) => table.pressure(gap),
        }
    }

    /// Real over nominal area of contact, at most 1, where the law knows it: a table of pressures
    /// does not.
    #[must_use]
    pub fn area_share(&self, gap: f64, sigma: f64) -> Option<OfGap> {
        match self {
            Self::None => Some(OfGap::default()),
            Self::GreenwoodTripp(law) => Some(law.area_share(gap, sigma)),
            Self::Table(_) => None,
        }
    }

    /// Asperities can carry.
    #[must_use]
    pub fn is_on(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Refuses parameters that are none. A table was checked when it was made.
    ///
    /// # Errors
    /// [`FinishError::NotPositive`]; [`FinishError::OutOfRange`] for a summit height below zero or either
    /// length above [`LARGEST_ROUGHNESS`].
    pub fn check(&self) -> Result<(), FinishError> {
        let Self::GreenwoodTripp(law) = self else {
            return Ok(());
        };
        positive("contact.factor", law.factor)?;
        positive("contact.asperity_product", law.asperity_product)?;
        positive("contact.modulus", law.modulus)?;
        let largest = LARGEST_ROUGHNESS;
        within("contact.summit_height", law.summit_height, 0.0, largest)?;
        let Some(sigma) = law.summit_roughness else {
            return Ok(());
        };
        positive("contact.summit_roughness", sigma)?;
        within("contact.summit_roughness", sigma, 0.0, largest)
    }
}

#[cfg(test)]
mod tests {
    // a panic is how a test fails
    #![allow(clippy::unwrap_used)]

    use super::*;

    const SIGMA: f64 = 0.31e-6;
    const STEEL: Solid = Solid {
        modulus: 210e9,
        poisson_ratio: 0.3,
    };
    const ALUMINIUM: Solid = Solid {
        modulus: 70e9,
        poisson_ratio: 0.33,
    };
    const ASPERITIES: Asperities = Asperities {
        density: 4e10,
        radius: 4e-6,
    };

    fn law() -> GreenwoodTripp {
        GreenwoodTripp::from_asperities(ASPERITIES, SIGMA, STEEL, ALUMINIUM).unwrap()
    }

    /// Midpoint rule over (0, to) in a variable whose integrand vanishes smoothly at both ends.
    fn integral(to: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 400;
        let width = to / f64::from(n);
        (0..n).map(|i| f((f64::from(i) + 0.5) * width)).sum::<f64>() * width
    }

    /// Hertz's force and area of two paraboloids at every offset and every sum of heights.
    #[test]
    fn pressure_and_area_are_those_of_hertz_over_all_pairs_of_asperities() {
        let Asperities { density, radius } = ASPERITIES;
        let law = law();
        for h in [-1.0, 0.0, 1.0, 2.5] {
            // what two asperities overlap by when their summits meet, w = v^2 sigma, at a density
            let over = |f: &dyn Fn(f64) -> f64| {
                integral(3.5, |v| {
                    let sum = h + v * v;
                    let density = (-0.5 * sum * sum).exp() / (2.0 * PI).sqrt();
                    density * 2.0 * v * f(v * v * SIGMA)
                })
            };
            // offset r with r^2 = 4 b w (1 - x^2): remains w x^2, and 2 pi r dr = 8 pi b w x dx
            let force = |w: f64| {
                integral(1.0, |x| {
                    let left = w * x * x;
                    8.0 * PI * radius * w * x * 4.0 / 3.0
                        * law.modulus
                        * (0.5 * radius).sqrt()
                        * left.powf(1.5)
                })
            };
            let area = |w: f64| {
                integral(1.0, |x| {
                    8.0 * PI * radius * w * x * PI * 0.5 * radius * w * x * x
                })
            };
            let pressure = density * density * over(&force);
            let got = law.pressure(h * SIGMA, SIGMA).value;
            assert!(
                (got / pressure - 1.0).abs() < 2e-5,
                "H {h}: {got}, {pressure}"
            );
            let share = density * density * over(&area);
            let got = law.area_share(h * SIGMA, SIGMA).value;
            assert!((got / share - 1.0).abs() < 2e-5, "H {h}: {got}, {share}");
        }
    }

    #[test]
    fn pressure_and_area_have_exact_derivatives_down_to_deep_overlap() {
        let law = ContactLaw::GreenwoodTripp(law());
        for i in -1200..1200 {
            let gap = (f64::from(i) * 0.01 + 0.002) * SIGMA;
            let delta = 1e-3 * SIGMA;
            let four = |f: &dyn Fn(f64) -> f64| {
                (8.0 * (f(delta) - f(-delta)) - (f(2.0 * delta) - f(-2.0 * delta))) / (12.0 * delta)
            };
            let pressure = law.pressure(gap, SIGMA);
            let difference = four(&|d| law.pressure(gap + d, SIGMA).value);
            assert!((pressure.by_gap / difference - 1.0).abs() < 1e-7, "{gap}");
            let area = |gap: f64| law.area_share(gap, SIGMA).unwrap();
            if area(gap - 2.0 * delta).value < 1.0 {
                let difference = four(&|d| area(gap + d).value);
                assert!((area(gap).by_gap / difference - 1.0).abs() < 1e-7, "{gap}");
            }
        }
    }

    #[test]
    fn contact_ends_far_away_and_never_covers_more_than_everything() {
        let on = ContactLaw::GreenwoodTripp(law());
        assert_eq!(on.pressure(36.0 * SIGMA, SIGMA), OfGap::default());
        assert_eq!(on.area_share(-1e3 * SIGMA, SIGMA).unwrap().value, 1.0);
        assert!(on.pressure(-1e3 * SIGMA, SIGMA).value.is_finite());
        assert_eq!(ContactLaw::None.pressure(-SIGMA, SIGMA), OfGap::default());
        let table = ContactTable::new(vec![0.0, 1e-6], vec![1e6, 0.0]).unwrap();
        let table = ContactLaw::Table(table);
        assert_eq!(table.pressure(0.0, SIGMA).value, 1e6);
        assert_eq!(table.area_share(0.0, SIGMA), None);
    }

    #[test]
    fn composite_modulus_is_that_of_both_materials() {
        // (1 - 0.09)/210 + (1 - 0.1089)/70 = 0.01706333.. 1/GPa
        let modulus = composite_modulus(STEEL, ALUMINIUM).unwrap();
        assert!((modulus / 58.605_196_3e9 - 1.0).abs() < 1e-8, "{modulus}");
        let soft = Solid {
            poisson_ratio: 0.6,
            ..STEEL
        };
        let error = composite_modulus(STEEL, soft).unwrap_err().to_string();
        assert!(error.contains("poisson_ratio_shell is 0.6"), "{error}");
    }

    #[test]
    fn parameters_that_are_none_are_refused_by_name() {
        let wrong = ContactLaw::GreenwoodTripp(GreenwoodTripp {
            modulus: -1.0,
            ..law()
        });
        let error = wrong.check().unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("contact.modulus must be positive")
        );
        let flat = Asperities {
            radius: 0.0,
            ..ASPERITIES
        };
        let error = GreenwoodTripp::from_asperities(flat, SIGMA, STEEL, STEEL).unwrap_err();
        assert!(error.to_string().starts_with("asperity_radius"));
        assert_eq!(ContactLaw::GreenwoodTripp(law()).check(), Ok(()));
        let refused = |change: &dyn Fn(&mut GreenwoodTripp)| {
            let mut law = law();
            change(&mut law);
            ContactLaw::GreenwoodTripp(law)
                .check()
                .unwrap_err()
                .to_string()
        };
        for height in [-1e-9, 2e-4, f64::NAN] {
            let error = refused(&|law| law.summit_height = height);
            assert!(error.starts_with("contact.summit_height is"), "{error}");
        }
        for roughness in [0.0, -1e-7, 2e-4, f64::NAN] {
            let error = refused(&|law| law.summit_roughness = Some(roughness));
            assert!(error.starts_with("contact.summit_roughness"), "{error}");
        }
    }

    /// Summits d above the mean planes touch as those in the mean planes do with d less between them; d of
    /// zero is no other law, to the last bit.
    #[test]
    fn summits_above_the_mean_planes_touch_from_further_away() {
        let law = law();
        let with = |summit_height, summit_roughness| {
            ContactLaw::GreenwoodTripp(GreenwoodTripp {
                summit_height,
                summit_roughness,
                ..law
            })
        };
        let in_the_planes = ContactLaw::GreenwoodTripp(law);
        let height = 0.6e-6;
        let finer = 0.7 * SIGMA;
        for i in -80..120 {
            let gap = 0.05 * f64::from(i) * SIGMA;
            let own = in_the_planes.pressure(gap, SIGMA);
            assert_eq!(with(0.0, None).pressure(gap, SIGMA), own);
            assert_eq!(with(0.0, Some(SIGMA)).pressure(gap, finer), own);
            assert_eq!(
                with(height, None).pressure(gap, SIGMA),
                in_the_planes.pressure(gap - height, SIGMA)
            );
            assert_eq!(
                with(height, Some(finer)).pressure(gap, SIGMA),
                in_the_planes.pressure(gap - height, finer)
            );
            assert_eq!(
                with(height, Some(finer)).area_share(gap, SIGMA),
                in_the_planes.area_share(gap - height, finer)
            );
        }
        let high = with(height, Some(finer));
        let delta = 1e-3 * finer;
        for gap in [-0.3e-6, 0.2e-6, 0.7e-6, 1.5e-6] {
            let at = |d: f64| high.pressure(gap + d, SIGMA).value;
            let difference = (8.0 * (at(delta) - at(-delta))
                - (at(2.0 * delta) - at(-2.0 * delta)))
                / (12.0 * delta);
            let slope = high.pressure(gap, SIGMA).by_gap;
            assert!((slope / difference - 1.0).abs() < 1e-7, "{gap}");
        }
    }
}
