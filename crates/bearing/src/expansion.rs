//! How large is the clearance of the warm bearing?
//!
//! ```text
//! c(T) = c_0 + R [ growth of the bore - growth of the journal ]
//! ```
//! The journal grows freely with its temperature. The bore is that of a shell pressed into a housing: two
//! rings (plane stress, Lame 1852) that press on each other by their interference, which changes where
//! they expand differently; without a shell it is the housing's own. The cold clearance is that of the
//! assembled bearing at the reference temperature.
//! Assumptions: each part has one temperature; the housing is a ring; elastic.
//! Reference: G. Lame, Lecons sur la theorie mathematique de l'elasticite, Paris 1852 (thick rings).

use serde::{Deserialize, Serialize};

/// How the parts of a bearing grow with temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Expansion {
    /// Temperature at which the clearance was measured, K.
    pub reference_temperature: f64,
    /// Expansion of the journal, 1/K.
    pub journal: f64,
    /// Expansion of the housing, 1/K.
    pub housing: f64,
    /// Temperature of the journal over that of the oil film, K.
    pub journal_excess: f64,
    /// Temperature of shell and housing over that of the oil film, K.
    pub housing_excess: f64,
    /// A shell of another material pressed into the housing.
    pub shell: ShellFit,
}

/// The bearing shell in its housing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShellFit {
    /// The bore is the housing's own.
    #[default]
    None,
    /// Pressed in.
    Pressed(PressedShell),
}

/// A ring (shell) in a ring (housing).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PressedShell {
    /// Wall thickness of the shell, m.
    pub thickness: f64,
    /// Young's modulus of the shell, Pa.
    pub modulus: f64,
    /// Poisson's ratio of the shell.
    pub poisson: f64,
    /// Expansion of the shell, 1/K.
    pub expansion: f64,
    /// Outer radius of the housing, m.
    pub housing_radius: f64,
    /// Young's modulus of the housing, Pa.
    pub housing_modulus: f64,
    /// Poisson's ratio of the housing.
    pub housing_poisson: f64,
    /// Radial interference at the reference temperature, m: how much larger the free shell is.
    pub interference: f64,
}

impl Expansion {
    /// Radial clearance, m, of a bearing with bore radius `radius` (m) and cold clearance `cold` (m) whose
    /// film has a temperature (K).
    #[must_use]
    pub fn clearance(&self, radius: f64, cold: f64, temperature: f64) -> f64 {
        let rise = temperature - self.reference_temperature;
        let journal = self.journal * (rise + self.journal_excess) * (radius - cold);
        cold + self.bore_growth(radius, rise + self.housing_excess) - journal
    }

    /// Growth of the bore's radius, m, where shell and housing are `rise` (K) warmer than at reference.
    #[must_use]
    pub fn bore_growth(&self, radius: f64, rise: f64) -> f64 {
        match self.shell {
            ShellFit::None => self.housing * rise * radius,
            ShellFit::Pressed(shell) => {
                let joint = radius + shell.thickness;
                let change = (shell.expansion - self.housing) * rise * joint;
                // A shell that has come loose follows its own expansion.
                let warm = (shell.interference + change).max(0.0);
                let pressed = shell.contraction(radius, warm - shell.interference);
                shell.expansion * rise * radius - pressed
            }
        }
    }
}

impl PressedShell {
    /// By how much an interference (m) at the joint narrows the bore's radius, m.
    fn contraction(&self, radius: f64, interference: f64) -> f64 {
        let joint = radius + self.thickness;
        let (inner, middle) = (radius.powi(2), joint.powi(2));
        let shell = joint / self.modulus * ((middle + inner) / (middle - inner) - self.poisson);
        let pressure = interference / (shell + self.housing_growth(joint));
        2.0 * pressure * middle * radius / (self.modulus * (middle - inner))
    }

    /// By how much the housing's inner radius `joint` (m) grows under pressure there, m/Pa.
    fn housing_growth(&self, joint: f64) -> f64 {
        let (inner, outer) = (joint.powi(2), self.housing_radius.powi(2));
        joint / self.housing_modulus * ((outer + inner) / (outer - inner) + self.housing_poisson)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests {
    use super::*;

    const ALUMINIUM: f64 = 23e-6;
    const STEEL: f64 = 11.5e-6;

    fn plain() -> Expansion {
        Expansion {
            reference_temperature: 293.15,
            journal: STEEL,
            housing: ALUMINIUM,
            journal_excess: 0.0,
            housing_excess: 0.0,
            shell: ShellFit::None,
        }
    }

    fn pressed(interference: f64) -> PressedShell {
        PressedShell {
            thickness: 2e-3,
            modulus: 210e9,
            poisson: 0.3,
            expansion: STEEL,
            housing_radius: 50e-3,
            housing_modulus: 70e9,
            housing_poisson: 0.33,
            interference,
        }
    }

    #[test]
    fn an_aluminium_housing_opens_on_a_steel_journal() {
        let (radius, cold) = (30e-3, 30e-6);
        let hot = plain().clearance(radius, cold, 393.15);
        let exact = cold + 100.0 * (ALUMINIUM * radius - STEEL * (radius - cold));
        assert!((hot - exact).abs() < 1e-15);
        assert!((plain().clearance(radius, cold, 293.15) - cold).abs() < 1e-18);
    }

    /// A shell of the housing's material and elasticity makes no difference, whatever its interference.
    #[test]
    fn a_shell_of_the_same_material_grows_with_its_housing() {
        let mut expansion = plain();
        let shell = PressedShell {
            expansion: ALUMINIUM,
            ..pressed(40e-6)
        };
        expansion.shell = ShellFit::Pressed(shell);
        let grown = expansion.bore_growth(30e-3, 80.0);
        assert!((grown - ALUMINIUM * 80.0 * 30e-3).abs() < 1e-15);
    }

    /// A steel shell in aluminium loosens as it warms; between its own and the housing's growth, and with its
    /// own once it is loose.
    #[test]
    fn a_steel_shell_in_aluminium_loosens() {
        let mut expansion = plain();
        expansion.shell = ShellFit::Pressed(pressed(60e-6));
        let (radius, rise) = (30e-3, 80.0);
        let grown = expansion.bore_growth(radius, rise);
        assert!(grown > STEEL * rise * radius && grown < ALUMINIUM * rise * radius);
        let loose = |rise: f64| expansion.bore_growth(radius, rise);
        let slope = (loose(402.0) - loose(400.0)) / 2.0;
        assert!((slope / (STEEL * radius) - 1.0).abs() < 1e-9);
    }

    /// Rows of `validation/elastic-layer/ring.csv`: plane stress as it is, plane strain by its constants.
    #[test]
    fn the_housing_grows_under_the_pressure_of_its_joint_as_lame_has_it() {
        let table = include_str!("../../../validation/elastic-layer/ring.csv");
        let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
        let mut read = 0;
        for row in rows {
            let cells: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
            let (joint, modulus, poisson) = (1e-3 * cells[0], 1e9 * cells[3], cells[4]);
            let growth = |housing_modulus: f64, housing_poisson: f64| {
                let shell = PressedShell {
                    housing_radius: 1e-3 * cells[1],
                    housing_modulus,
                    housing_poisson,
                    ..pressed(0.0)
                };
                1e6 * 1e6 * cells[2] * shell.housing_growth(joint)
            };
            let stress = growth(modulus, poisson);
            let strain = growth(
                modulus / (1.0 - poisson * poisson),
                poisson / (1.0 - poisson),
            );
            assert!((stress - cells[5]).abs() < 5e-4, "{row}: {stress}");
            assert!((strain - cells[6]).abs() < 5e-4, "{row}: {strain}");
            read += 1;
        }
        assert_eq!(read, 1);
    }

    /// Lame's ring (reference: bore 100 mm, 149.5 mm outside, 200 GPa, 0.3) under pressure on its OUTSIDE
    /// by reciprocity of the bore that grows under inner pressure: both cross terms agree.
    #[test]
    fn the_joint_narrows_the_bore_as_lame_has_it() {
        let shell = PressedShell {
            thickness: 24.75e-3,
            modulus: 200e9,
            housing_radius: 120e-3,
            ..pressed(0.0)
        };
        let (radius, joint) = (50e-3_f64, 74.75e-3_f64);
        let interference = 10e-6;
        let narrowed = shell.contraction(radius, interference);
        // Outside moves by p_i 2 R_i^2 R_o/(E (R_o^2 - R_i^2)) under inner pressure p_i; Betti's theorem
        // gives the bore under outer pressure: per unit length R_o times that over R_i.
        let stiffness = |r: f64, sign: f64, inner: f64, outer: f64, e: f64, nu: f64| {
            r / e * ((outer.powi(2) + inner.powi(2)) / (outer.powi(2) - inner.powi(2)) + sign * nu)
        };
        let own = stiffness(joint, -1.0, radius, joint, 200e9, 0.3);
        let housing = stiffness(joint, 1.0, joint, shell.housing_radius, 70e9, 0.33);
        let pressure = interference / (own + housing);
        let outside = 2.0 * radius.powi(2) * joint / (200e9 * (joint.powi(2) - radius.powi(2)));
        let by_betti = pressure * outside * joint / radius;
        assert!((narrowed / by_betti - 1.0).abs() < 1e-12);
    }
}
