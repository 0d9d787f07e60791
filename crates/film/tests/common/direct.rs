//! An aligned film solved by brute force: cosines across the width, thousands of finite volumes
//! around in the angle itself, pressures cut node by node.

use std::f64::consts::{PI, TAU};

/// Cosines across the width.
const COSINES: usize = 96;
/// Intervals over half the width.
const INTERVALS: usize = 48;

/// `-int int max(p, 0) n dtheta dZ` along and across the line of centres, for p over 12 eta R^2/c^2 and
/// a motion over c along and across; `n` volumes around.
pub fn gumbel_force(width_ratio: f64, eps: f64, motion: [f64; 2], n: usize) -> [f64; 2] {
    let step = TAU / n as f64;
    let height = |theta: f64| 1.0 - eps * theta.cos();
    let theta = |i: usize| step * i as f64;
    let modes: Vec<Vec<f64>> = (0..COSINES)
        .map(|k| {
            let wave = (k as f64 + 0.5) * PI;
            // int cos(wave Z) dZ over the norm, which is 1.
            let integral = 2.0 * (if k % 2 == 0 { 1.0 } else { -1.0 }) / wave;
            let conducts = |i: usize| height(theta(i) + 0.5 * step).powi(3) / (step * step);
            let loss = |i: usize| (wave / width_ratio).powi(2) * height(theta(i)).powi(3);
            let right =
                |i: usize| integral * (motion[0] * theta(i).cos() + motion[1] * theta(i).sin());
            ring(n, conducts, loss, right)
        })
        .collect();
    let mut force = [0.0; 2];
    for g in 0..=INTERVALS {
        let z = g as f64 / INTERVALS as f64;
        let simpson = match g {
            0 | INTERVALS => 1.0,
            _ if g % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let weight = 2.0 * simpson / (3.0 * INTERVALS as f64) * step;
        let shapes: Vec<f64> = (0..COSINES)
            .map(|k| ((k as f64 + 0.5) * PI * z).cos())
            .collect();
        for i in 0..n {
            let pressure: f64 = modes
                .iter()
                .zip(&shapes)
                .map(|(mode, shape)| mode[i] * shape)
                .sum();
            if pressure > 0.0 {
                force[0] -= weight * pressure * theta(i).cos();
                force[1] -= weight * pressure * theta(i).sin();
            }
        }
    }
    force
}

/// Solves `-c_(i-1) (u_(i-1) - u_i) - c_i (u_(i+1) - u_i) + loss_i u_i = right_i` on a ring.
fn ring(
    n: usize,
    conducts: impl Fn(usize) -> f64,
    loss: impl Fn(usize) -> f64,
    right: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let off: Vec<f64> = (0..n).map(&conducts).collect();
    let before = |i: usize| off[(i + n - 1) % n];
    // Without the corner, by Sherman and Morrison with the vector (1, 0, .., 0, 1).
    let corner = off[n - 1];
    let mut diagonal: Vec<f64> = (0..n).map(|i| off[i] + before(i) + loss(i)).collect();
    diagonal[0] += corner;
    diagonal[n - 1] += corner;
    let mut u: Vec<f64> = (0..n).map(&right).collect();
    let mut v = vec![0.0; n];
    (v[0], v[n - 1]) = (1.0, 1.0);
    for i in 1..n {
        let factor = off[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * off[i - 1];
        u[i] += factor * u[i - 1];
        v[i] += factor * v[i - 1];
    }
    for i in (0..n).rev() {
        if i + 1 < n {
            u[i] += off[i] * u[i + 1];
            v[i] += off[i] * v[i + 1];
        }
        u[i] /= diagonal[i];
        v[i] /= diagonal[i];
    }
    // Matrix = T - corner w w^T with w = (1, 0, .., 0, 1).
    let scale = corner * (u[0] + u[n - 1]) / (1.0 - corner * (v[0] + v[n - 1]));
    u.iter().zip(&v).map(|(u, v)| u + scale * v).collect()
}
