//! Integrals along an arc of the gap, exact for closed-form films.
//!
//! With the Sommerfeld angle s from the NARROWEST gap, `1 - eps cos(theta) = (1 - eps^2)/(1 + eps
//! cos s)`, the integrands `n n/h^3` and `n n n/h^4` of the film forces become trigonometric
//! polynomials of degree 2 and 3, which Gauss-Legendre quadrature integrates to round-off over any
//! arc up to a full turn, at any eccentricity below 1.
//! Reference: A. Sommerfeld, Z. Math. Phys. 50 (1904) 97.

use std::f64::consts::{PI, TAU};

/// Enough for degree 3 over a full turn at round-off (error term (3 pi)^40/40! and smaller).
const NODES: usize = 20;

/// One quadrature point of an arc.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ArcNode {
    /// Unit vector from the shell centre, shell frame.
    pub normal: [f64; 2],
    /// Gap there, m.
    pub gap: f64,
    /// Its share of the arc: the integral of f is the sum of f times weight, rad.
    pub weight: f64,
}

/// Gauss-Legendre rule on [-1, 1], kept so that it is computed once per film.
#[derive(Debug, Clone)]
pub(super) struct ArcRule {
    abscissae: [f64; NODES],
    weights: [f64; NODES],
}

impl ArcRule {
    pub(super) fn new() -> Self {
        let mut rule = Self {
            abscissae: [0.0; NODES],
            weights: [0.0; NODES],
        };
        for i in 0..NODES {
            let mut t = ((4 * i + 3) as f64 / (4 * NODES + 2) as f64 * PI).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (value, derivative) = legendre(t);
                slope = derivative;
                let step = value / derivative;
                t -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            rule.abscissae[i] = t;
            rule.weights[i] = 2.0 / ((1.0 - t * t) * slope * slope);
        }
        rule
    }

    /// Nodes from angle `from` to `to` (rad, shell frame, `from <= to <= from + 2 pi`).
    pub(super) fn nodes(&self, centre: &Centre, from: f64, to: f64) -> [ArcNode; NODES] {
        let start = centre.sommerfeld_angle(from);
        let end = centre.sommerfeld_angle(to);
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let mut nodes = [ArcNode::default(); NODES];
        for (node, (t, weight)) in nodes
            .iter_mut()
            .zip(self.abscissae.iter().zip(&self.weights))
        {
            *node = centre.node(middle + half * t);
            node.weight *= weight * half;
        }
        nodes
    }
}

/// Value and derivative of the Legendre polynomial of degree NODES.
fn legendre(t: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, t);
    for degree in 2..=NODES {
        let n = degree as f64;
        let next = ((2.0 * n - 1.0) * t * current - (n - 1.0) * previous) / n;
        previous = current;
        current = next;
    }
    let derivative = NODES as f64 * (t * current - previous) / (t * t - 1.0);
    (current, derivative)
}

/// Place of an aligned journal centre in its clearance circle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Centre {
    pub clearance: f64,
    pub eps: f64,
    /// From +X to the narrowest gap, rad.
    pub line_of_centres: f64,
    cos_line: f64,
    sin_line: f64,
}

impl Centre {
    pub(super) fn new(position: [f64; 2], clearance: f64) -> Self {
        let line_of_centres = position[1].atan2(position[0]);
        let (sin_line, cos_line) = line_of_centres.sin_cos();
        Self {
            clearance,
            eps: position[0].hypot(position[1]) / clearance,
            line_of_centres,
            cos_line,
            sin_line,
        }
    }

    /// 1 - eps^2 without cancellation.
    pub(super) fn one_minus_square(&self) -> f64 {
        (1.0 - self.eps) * (1.0 + self.eps)
    }

    /// Gap at a shell angle, m.
    pub(super) fn gap(&self, angle: f64) -> f64 {
        self.clearance * (1.0 - self.eps * (angle - self.line_of_centres).cos())
    }

    /// Sommerfeld angle of a shell angle, continuous and rising with it, rad.
    pub(super) fn sommerfeld_angle(&self, angle: f64) -> f64 {
        let theta = angle - self.line_of_centres;
        let turns = (theta / TAU).round();
        let half = 0.5 * (theta - turns * TAU);
        let reduced = 2.0
            * ((1.0 + self.eps).sqrt() * half.sin()).atan2((1.0 - self.eps).sqrt() * half.cos());
        reduced + turns * TAU
    }

    /// Node at a Sommerfeld angle; its weight is d(angle)/d(Sommerfeld angle).
    fn node(&self, s: f64) -> ArcNode {
        let (sin_s, cos_s) = s.sin_cos();
        let root = self.one_minus_square();
        let denominator = 1.0 + self.eps * cos_s;
        let cos_theta = (self.eps + cos_s) / denominator;
        let sin_theta = root.sqrt() * sin_s / denominator;
        ArcNode {
            normal: [
                cos_theta * self.cos_line - sin_theta * self.sin_line,
                sin_theta * self.cos_line + cos_theta * self.sin_line,
            ],
            gap: self.clearance * root / denominator,
            weight: root.sqrt() / denominator,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_turn_integrals_match_their_closed_forms() {
        let rule = ArcRule::new();
        for eps in [0.0, 0.3, 0.9, 0.999] {
            let centre = Centre::new([0.6 * eps, -0.8 * eps], 1.0);
            let nodes = rule.nodes(&centre, 0.3, 0.3 + TAU);
            let cubed: f64 = nodes.iter().map(|n| n.weight / n.gap.powi(3)).sum();
            let exact = PI * (2.0 + eps * eps) / (1.0 - eps * eps).powf(2.5);
            assert!(
                (cubed / exact - 1.0).abs() < 1e-12,
                "{eps}: {cubed} {exact}"
            );
        }
    }
}
