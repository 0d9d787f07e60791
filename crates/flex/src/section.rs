//! How stiff is the cross-section of a beam?
//!
//! Stiffnesses of the section against stretching, bending, shear and twisting. Shear: Timoshenko's
//! beam, whose shear coefficient follows from Poisson's ratio. Twisting: Saint-Venant, free to warp.
//! References: G. R. Cowper, J. Appl. Mech. 33 (1966) 335, 10.1115/1.3625046 (shear coefficients);
//! S. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed. (1970), section 109 (rectangle).

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Terms of the series for the twist of a rectangle: the next one is below 1e-12 of the sum.
const TWIST_TERMS: u32 = 120;

/// Isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Young's modulus, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
}

impl Material {
    /// Shear modulus, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.youngs_modulus / (1.0 + self.poissons_ratio)
    }
}

/// Stiffnesses of a cross-section. Local axes of a beam: x along it, y and z the principal axes of its
/// section.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Stretching, E A, N.
    pub axial: f64,
    /// Twisting, G J, N m2.
    pub torsion: f64,
    /// Bending about local y and z, E I, N m2.
    pub bending: [f64; 2],
    /// Shear angle per shear force along local y and z, 1 / (kappa G A), 1/N; 0 for a beam that bends
    /// without shear.
    pub shear_flexibility: [f64; 2],
}

impl Section {
    /// Circle of `diameter` with a concentric bore of `bore_diameter`, 0 for none, m.
    #[must_use]
    pub fn circle(material: &Material, diameter: f64, bore_diameter: f64) -> Self {
        let nu = material.poissons_ratio;
        let area = 0.25 * PI * (diameter.powi(2) - bore_diameter.powi(2));
        let moment = PI / 64.0 * (diameter.powi(4) - bore_diameter.powi(4));
        let ratio = (bore_diameter / diameter).powi(2);
        let squared = (1.0 + ratio).powi(2);
        let kappa =
            6.0 * (1.0 + nu) * squared / ((7.0 + 6.0 * nu) * squared + (20.0 + 12.0 * nu) * ratio);
        let bending = material.youngs_modulus * moment;
        Self {
            axial: material.youngs_modulus * area,
            torsion: 2.0 * material.shear_modulus() * moment,
            bending: [bending; 2],
            shear_flexibility: [1.0 / (kappa * material.shear_modulus() * area); 2],
        }
    }

    /// Rectangle, `along_y` by `along_z`, m.
    #[must_use]
    pub fn rectangle(material: &Material, along_y: f64, along_z: f64) -> Self {
        let nu = material.poissons_ratio;
        let area = along_y * along_z;
        let kappa = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
        let shear = 1.0 / (kappa * material.shear_modulus() * area);
        Self {
            axial: material.youngs_modulus * area,
            torsion: material.shear_modulus() * rectangle_twist(along_y, along_z),
            bending: [area * along_z.powi(2), area * along_y.powi(2)]
                .map(|moment| material.youngs_modulus * moment / 12.0),
            shear_flexibility: [shear; 2],
        }
    }

    /// The same section without shear: a beam after Euler and Bernoulli.
    #[must_use]
    pub fn without_shear(self) -> Self {
        Self {
            shear_flexibility: [0.0; 2],
            ..self
        }
    }

    /// Whether every stiffness is a positive, finite number and no shear flexibility negative.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let [about_y, about_z] = self.bending;
        [self.axial, self.torsion, about_y, about_z]
            .iter()
            .all(|stiffness| stiffness.is_finite() && *stiffness > 0.0)
            && self
                .shear_flexibility
                .iter()
                .all(|flexibility| flexibility.is_finite() && *flexibility >= 0.0)
    }
}

/// Saint-Venant's torsion constant of a rectangle, m4.
fn rectangle_twist(one: f64, other: f64) -> f64 {
    let (short, long) = (one.min(other), one.max(other));
    let sum: f64 = (0..TWIST_TERMS)
        .rev()
        .map(|k| {
            let n = f64::from(2 * k + 1);
            (0.5 * n * PI * long / short).tanh() / n.powi(5)
        })
        .sum();
    long * short.powi(3) * (1.0 / 3.0 - 64.0 / PI.powi(5) * short / long * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = Material {
        youngs_modulus: 210e9,
        poissons_ratio: 0.3,
    };

    #[test]
    fn torsion_constants_of_rectangles_are_those_of_the_tables() {
        // Timoshenko and Goodier (1970), table in section 109: k1 = J / (long short^3)
        for (ratio, printed) in [(1.0, 0.1406), (1.5, 0.196), (2.0, 0.229), (10.0, 0.312)] {
            let found = rectangle_twist(2.0, 2.0 * ratio) / (16.0 * ratio);
            assert!((found - printed).abs() < 6e-4, "{ratio}: {found} {printed}");
        }
        // very thin: one third
        assert!((rectangle_twist(1e-6, 1.0) / 1e-18 - 1.0 / 3.0).abs() < 1e-6);
    }

    #[test]
    fn shear_coefficients_are_those_of_cowper() {
        let kappa = |section: Section, area: f64| {
            1.0 / (section.shear_flexibility[0] * STEEL.shear_modulus() * area)
        };
        let solid = kappa(Section::circle(&STEEL, 0.04, 0.0), PI * 4e-4);
        assert!((solid - 7.8 / 8.8).abs() < 1e-14);
        let bar = kappa(Section::rectangle(&STEEL, 0.02, 0.05), 1e-3);
        assert!((bar - 13.0 / 15.3).abs() < 1e-14);
        // a thin tube: 2 (1 + nu) / (4 + 3 nu)
        let (outer, inner) = (0.04, 0.04 * (1.0 - 1e-7));
        let area = 0.25 * PI * (outer * outer - inner * inner);
        let tube = kappa(Section::circle(&STEEL, outer, inner), area);
        assert!((tube - 2.6 / 4.9).abs() < 1e-6, "{tube}");
    }

    #[test]
    fn bending_about_an_axis_grows_with_the_cube_of_the_other_side() {
        let bar = Section::rectangle(&STEEL, 0.02, 0.05);
        assert!((bar.bending[0] / (210e9 * 0.02 * 0.05_f64.powi(3) / 12.0) - 1.0).abs() < 1e-14);
        assert!((bar.bending[1] / (210e9 * 0.05 * 0.02_f64.powi(3) / 12.0) - 1.0).abs() < 1e-14);
        assert!(bar.is_sound());
        assert!(!Section::circle(&STEEL, 0.04, 0.04).is_sound());
    }
}
