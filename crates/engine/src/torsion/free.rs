//! Free vibration of the undamped chain.
//!
//! `K v = w^2 M v` as the symmetric problem of `M^-1/2 K M^-1/2`, whose eigenvalues are real and whose
//! vectors, scaled back, are the modes. Damping of crankshafts moves frequencies by the square of
//! their damping ratio, far below what stiffnesses are known to.

use super::{TorsionError, TorsionalChain};
use nalgebra::{DMatrix, SymmetricEigen};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Natural frequencies and modes of the undamped chain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NaturalVibration {
    /// Hz, ascending; the first, 0, is the turning of the whole chain. Each link without stiffness
    /// adds another 0.
    pub frequencies: Vec<f64>,
    /// Twists of the discs, one row for each frequency, the largest entry 1.
    pub modes: Vec<Vec<f64>>,
}

impl TorsionalChain {
    /// Natural frequencies and modes without damping.
    ///
    /// # Errors
    /// What [`TorsionalChain::check`] refuses.
    pub fn natural_vibration(&self) -> Result<NaturalVibration, TorsionError> {
        let matrices = self.matrices()?;
        let count = self.discs.len();
        let root: Vec<f64> = self.discs.iter().map(|disc| disc.inertia.sqrt()).collect();
        let scaled = DMatrix::from_fn(count, count, |row, column| {
            matrices.stiffness[(row, column)] / (root[row] * root[column])
        });
        let eigen = SymmetricEigen::new(scaled);
        let mut ascending: Vec<usize> = (0..count).collect();
        ascending.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));

        // Rounding leaves what is exactly 0 at 1e-16 of the largest eigenvalue, its root at 1e-8.
        let free = 1 + self
            .links
            .iter()
            .filter(|link| link.stiffness == 0.0)
            .count();
        let frequency = |(rank, &at): (usize, &usize)| {
            if rank < free {
                0.0
            } else {
                eigen.eigenvalues[at].max(0.0).sqrt() / TAU
            }
        };
        let mode = |&at: &usize| {
            let twists = (0..count).map(|disc| eigen.eigenvectors[(disc, at)] / root[disc]);
            largest_is_one(twists.collect())
        };
        Ok(NaturalVibration {
            frequencies: ascending.iter().enumerate().map(frequency).collect(),
            modes: ascending.iter().map(mode).collect(),
        })
    }
}

fn largest_is_one(mode: Vec<f64>) -> Vec<f64> {
    let largest = mode.iter().fold(0.0_f64, |largest, &value| {
        if value.abs() > largest.abs() {
            value
        } else {
            largest
        }
    });
    mode.iter().map(|value| value / largest).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Disc, TorsionalLink};
    use super::*;
    use std::f64::consts::PI;

    fn disc(inertia: f64) -> Disc {
        Disc {
            inertia,
            damping: 0.0,
            throw: None,
        }
    }

    fn spring(stiffness: f64) -> TorsionalLink {
        TorsionalLink {
            stiffness,
            damping: 0.0,
            loss_factor: 0.0,
        }
    }

    #[test]
    fn two_discs_vibrate_at_the_root_of_stiffness_over_reduced_inertia() {
        let (a, b, k) = (0.3_f64, 1.7_f64, 2.0e5_f64);
        let chain = TorsionalChain {
            discs: vec![disc(a), disc(b)],
            links: vec![spring(k)],
        };
        let found = chain.natural_vibration().unwrap();
        assert_eq!(found.frequencies[0], 0.0);
        let exact = (k * (a + b) / (a * b)).sqrt() / TAU;
        assert!((found.frequencies[1] / exact - 1.0).abs() < 1e-14);
        // The node divides the link as the inertias say.
        assert!((found.modes[1][0] - 1.0).abs() < 1e-15);
        assert!((found.modes[1][1] + a / b).abs() < 1e-14);
        assert!(
            found.modes[0]
                .iter()
                .all(|twist| (twist - 1.0).abs() < 1e-12)
        );
    }

    /// Equal discs with half discs at the ends: `w_j = 2 sqrt(k/J) sin(j pi / (2 n))`, modes
    /// `cos(j pi i / n)`.
    #[test]
    fn a_uniform_chain_has_the_frequencies_of_the_lattice() {
        let (inertia, stiffness, links) = (0.05, 1.2e6, 7);
        let ends = |at| if at == 0 || at == links { 0.5 } else { 1.0 };
        let chain = TorsionalChain {
            discs: (0..=links).map(|at| disc(inertia * ends(at))).collect(),
            links: vec![spring(stiffness); links],
        };
        let found = chain.natural_vibration().unwrap();
        for j in 1..=links {
            let phase = j as f64 * PI / links as f64;
            let exact = 2.0 * (stiffness / inertia).sqrt() * (0.5 * phase).sin() / TAU;
            assert!(
                (found.frequencies[j] / exact - 1.0).abs() < 1e-13,
                "mode {j}"
            );
            let sign = found.modes[j][0].signum();
            for (at, twist) in found.modes[j].iter().enumerate() {
                assert!(
                    (twist * sign - (phase * at as f64).cos()).abs() < 1e-11,
                    "mode {j}, disc {at}"
                );
            }
        }
    }

    #[test]
    fn a_chain_that_is_none_is_refused_by_name() {
        let refused = |chain: TorsionalChain| chain.natural_vibration().unwrap_err().to_string();
        let none = TorsionalChain {
            discs: vec![],
            links: vec![],
        };
        assert!(refused(none).contains("0 discs"));
        let light = TorsionalChain {
            discs: vec![disc(1.0), disc(0.0)],
            links: vec![spring(1.0)],
        };
        assert_eq!(
            refused(light),
            "disc 2: inertia = 0 must be positive and finite"
        );
        let odd = TorsionalChain {
            discs: vec![disc(1.0), disc(1.0)],
            links: vec![spring(f64::NAN)],
        };
        assert!(refused(odd).contains("link 1: stiffness"));
        let alone = TorsionalChain {
            discs: vec![disc(1.0)],
            links: vec![],
        };
        assert_eq!(alone.natural_vibration().unwrap().frequencies, [0.0]);
    }
}
