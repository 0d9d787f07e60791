//! How far does a surface stand off its nominal circle?
//!
//! ```text
//! h(angle, z) = c - (x + ty z) cos(angle) - (y - tx z) sin(angle)
//!                 + bore(angle - shell_angle, z) - journal(angle - journal_angle, z)
//! ```
//! A profile is the radial offset OUTWARD from the nominal circle, m, for the bore and the journal
//! alike: a bore that stands outward opens the gap, a journal closes it. Features add up. Angles are
//! those of the surface itself, from its own +X, so that profiles turn with what carries them.
//! Offsets are small beside the radius: an arc whose centre is shifted by d stands off by d times a
//! cosine.
//!
//! Lemon and offset halves are given by the circle that fits into them: nominal diameter and
//! clearance are those of the largest circle in the bore, and the arcs stand outward of it.
//! With the preload m = 1 - c / (clearance of the arcs) the arcs are shifted by d = c m / (1 - m).
//!
//! Reference: J. W. Lund, K. K. Thomsen, A calculation method and data for the dynamic coefficients
//! of oil-lubricated journal bearings, ASME 1978 (lobed bores and their preload).

pub use crate::shape_table::{ProfileTable, TableError};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Profile of a bore or journal: the sum of its features, cylindrical without any.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Shape {
    /// What departs from the cylinder.
    pub features: Vec<Feature>,
}

/// One departure from the cylinder; lengths in m, angles in rad of the surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// Two arcs, each shifted by `shift` towards the other, square to the joint:
    /// `shift (1 - |sin|)`.
    Lemon {
        /// Shift of each arc's centre.
        shift: f64,
        /// Angle of one of the two joints.
        joint: f64,
    },
    /// Two arcs shifted along the joint by `shift` in opposite directions:
    /// `shift (1 + cos)` on the half behind the joint, `shift (1 - cos)` on the other. At both joints
    /// the surface steps by twice the shift. For bores.
    OffsetHalves {
        /// Shift of each arc's centre.
        shift: f64,
        /// Angle of one of the two joints.
        joint: f64,
    },
    /// Parabola along the axis: `end_offset (z / half_width)^2`.
    Crowning {
        /// Offset at both ends against the mid-plane: positive for a bore, negative for a journal
        /// whose gap widens to the ends.
        end_offset: f64,
        /// Half the bearing width.
        half_width: f64,
    },
    /// Relief over a length from one end.
    EndRelief {
        /// Axial position of that end, signed.
        end: f64,
        /// Length along the axis.
        length: f64,
        /// Offset at the end: positive for a bore, negative for a journal that is relieved.
        end_offset: f64,
        /// How it runs out.
        form: ReliefForm,
    },
    /// Relief beside a joint (crush relief): `offset` at the joint, falling linearly to nothing at
    /// `half_span` on both sides.
    JointRelief {
        /// Offset at the joint.
        offset: f64,
        /// Angle from the joint to where the relief ends.
        half_span: f64,
        /// Angle of the joint.
        joint: f64,
    },
    /// `amplitude cos(order (angle - phase))`.
    Harmonic {
        /// Lobes around.
        order: u32,
        /// Amplitude.
        amplitude: f64,
        /// Angle of a crest.
        phase: f64,
    },
    /// From a table.
    Table(ProfileTable),
}

/// How an end relief runs out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReliefForm {
    /// A cone: linear.
    Linear,
    /// A circular arc that leaves the cylinder without a bend: quadratic.
    Circular,
}

impl Feature {
    /// Offset of what depends on the angle alone, m.
    fn around(&self, angle: f64) -> f64 {
        match self {
            Self::Lemon { shift, joint } => shift * (1.0 - (angle - joint).sin().abs()),
            Self::OffsetHalves { shift, joint } => {
                let (sin, cos) = (angle - joint).sin_cos();
                shift * (1.0 + half(sin) * cos)
            }
            Self::JointRelief {
                offset,
                half_span,
                joint,
            } => offset * (1.0 - wrapped(angle - joint).abs() / half_span).max(0.0),
            Self::Harmonic {
                order,
                amplitude,
                phase,
            } => amplitude * (f64::from(*order) * (angle - phase)).cos(),
            Self::Crowning { .. } | Self::EndRelief { .. } | Self::Table(_) => 0.0,
        }
    }

    /// Derivative of [`Feature::around`], m/rad; behind a kink.
    fn around_slope(&self, angle: f64) -> f64 {
        match self {
            Self::Lemon { shift, joint } => {
                let (sin, cos) = (angle - joint).sin_cos();
                -shift * half(sin) * cos
            }
            Self::OffsetHalves { shift, joint } => -shift * (angle - joint).sin().abs(),
            Self::JointRelief {
                offset,
                half_span,
                joint,
            } => match wrapped(angle - joint) {
                from if from.abs() >= *half_span => 0.0,
                from => -half(from) * offset / half_span,
            },
            Self::Harmonic {
                order,
                amplitude,
                phase,
            } => {
                let order = f64::from(*order);
                -order * amplitude * (order * (angle - phase)).sin()
            }
            Self::Crowning { .. } | Self::EndRelief { .. } | Self::Table(_) => 0.0,
        }
    }

    /// Integral of [`Feature::around`] up to `angle` from a fixed one, m rad.
    fn around_integral(&self, angle: f64) -> f64 {
        match self {
            Self::Lemon { shift, joint } => {
                let from = angle - joint;
                let arcs = (from / PI).floor();
                shift * (from - (2.0 * arcs + 1.0 - (from - arcs * PI).cos()))
            }
            Self::OffsetHalves { shift, joint } => {
                let from = angle - joint;
                shift * (from + from.sin().abs())
            }
            Self::JointRelief {
                offset,
                half_span,
                joint,
            } => {
                let from = wrapped(angle - joint);
                let turns = ((angle - joint - from) / TAU).round();
                let side = (half_span - from.abs()).max(0.0).powi(2) / (2.0 * half_span);
                let within = if from < 0.0 { side } else { half_span - side };
                offset * (turns * half_span + within)
            }
            Self::Harmonic {
                order,
                amplitude,
                phase,
            } => {
                let order = f64::from(*order);
                amplitude / order * (order * (angle - phase)).sin()
            }
            Self::Crowning { .. } | Self::EndRelief { .. } | Self::Table(_) => 0.0,
        }
    }

    /// Offset of what depends on the axial position alone, m, and its derivative.
    fn along(&self, z: f64) -> [f64; 2] {
        match self {
            Self::Crowning {
                end_offset,
                half_width,
            } => {
                let per = end_offset / (half_width * half_width);
                [per * z * z, 2.0 * per * z]
            }
            Self::EndRelief {
                end,
                length,
                end_offset,
                form,
            } => {
                let share = 1.0 - (end - z) * end.signum() / length;
                let rate = end.signum() / length;
                match form {
                    _ if share <= 0.0 => [0.0; 2],
                    ReliefForm::Linear => [end_offset * share, end_offset * rate],
                    ReliefForm::Circular => {
                        [end_offset * share * share, 2.0 * end_offset * share * rate]
                    }
                }
            }
            _ => [0.0; 2],
        }
    }

    fn varies_around(&self) -> bool {
        match self {
            Self::Crowning { .. } | Self::EndRelief { .. } => false,
            Self::Table(table) => table.varies_around(),
            _ => true,
        }
    }

    fn varies_along(&self) -> bool {
        match self {
            Self::Crowning { .. } | Self::EndRelief { .. } => true,
            Self::Table(table) => table.varies_along(),
            _ => false,
        }
    }

    /// Angles where it bends or steps.
    fn kinks_around(&self) -> Vec<f64> {
        match self {
            Self::Lemon { joint, .. } | Self::OffsetHalves { joint, .. } => {
                vec![*joint, joint + PI]
            }
            Self::JointRelief {
                half_span, joint, ..
            } => vec![joint - half_span, *joint, joint + half_span],
            _ => Vec::new(),
        }
    }

    /// Largest change of slope at a kink, m/rad.
    fn bend(&self) -> f64 {
        match self {
            Self::Lemon { shift, .. } => 2.0 * shift.abs(),
            Self::JointRelief {
                offset, half_span, ..
            } => 2.0 * (offset / half_span).abs(),
            _ => 0.0,
        }
    }

    /// Bounds of the second derivatives by angle (m/rad2) and by z (1/m) between kinks, about `z`.
    fn curvature_bounds(&self, z: f64) -> [f64; 2] {
        match self {
            Self::Lemon { shift, .. } | Self::OffsetHalves { shift, .. } => [shift.abs(), 0.0],
            Self::JointRelief { .. } => [0.0; 2],
            Self::Harmonic {
                order, amplitude, ..
            } => [f64::from(*order).powi(2) * amplitude.abs(), 0.0],
            Self::Crowning {
                end_offset,
                half_width,
            } => [0.0, 2.0 * end_offset.abs() / (half_width * half_width)],
            Self::EndRelief {
                end,
                length,
                end_offset,
                form: ReliefForm::Circular,
            } if (end - z).abs() < *length => [0.0, 2.0 * end_offset.abs() / (length * length)],
            Self::EndRelief { .. } => [0.0; 2],
            Self::Table(table) => table.curvature_bounds(),
        }
    }

    /// Stations around below which its waves would be missed.
    fn resolution(&self) -> usize {
        match self {
            Self::Harmonic { order, .. } => 12 * *order as usize,
            Self::Table(table) => 2 * table.n_around(),
            _ => 0,
        }
    }
}

/// 1 on the half behind the joint, -1 on the other.
fn half(sin: f64) -> f64 {
    if sin >= 0.0 { 1.0 } else { -1.0 }
}

/// The angle within -pi to pi.
fn wrapped(angle: f64) -> f64 {
    let turned = (angle + PI).rem_euclid(TAU) - PI;
    // An angle that is already within keeps all its digits.
    if angle.abs() < PI { angle } else { turned }
}

impl Shape {
    /// No departure from the cylinder.
    #[must_use]
    pub const fn cylindrical() -> Self {
        Self {
            features: Vec::new(),
        }
    }

    /// A shape of these features.
    #[must_use]
    pub fn of(features: impl Into<Vec<Feature>>) -> Self {
        Self {
            features: features.into(),
        }
    }

    /// The shape turned by an angle (rad) in the sense of rotation.
    #[must_use]
    pub fn turned(&self, by: f64) -> Self {
        let mut turned = self.clone();
        for feature in &mut turned.features {
            match feature {
                Feature::Lemon { joint: angle, .. }
                | Feature::OffsetHalves { joint: angle, .. }
                | Feature::JointRelief { joint: angle, .. }
                | Feature::Harmonic { phase: angle, .. } => *angle += by,
                Feature::Table(table) => table.turn(by),
                Feature::Crowning { .. } | Feature::EndRelief { .. } => {}
            }
        }
        turned
    }

    /// It has no features.
    #[must_use]
    pub fn is_cylindrical(&self) -> bool {
        self.features.is_empty()
    }

    fn sum(&self, of: impl Fn(&Feature) -> f64) -> f64 {
        self.features.iter().map(of).sum()
    }

    /// Its tables.
    pub fn tables(&self) -> impl Iterator<Item = &ProfileTable> {
        self.features.iter().filter_map(|feature| match feature {
            Feature::Table(table) => Some(table),
            _ => None,
        })
    }

    /// Radial offset outward at an angle of the surface and an axial position, m.
    #[must_use]
    pub fn offset(&self, angle: f64, z: f64) -> f64 {
        self.around(angle) + self.along(z) + self.tabled(angle, z)
    }

    /// The share of [`Shape::offset`] that depends on the angle alone, m.
    #[must_use]
    pub fn around(&self, angle: f64) -> f64 {
        self.sum(|feature| feature.around(angle))
    }

    /// The share that depends on the axial position alone, m.
    #[must_use]
    pub fn along(&self, z: f64) -> f64 {
        self.sum(|feature| feature.along(z)[0])
    }

    /// The share of its tables, m.
    #[must_use]
    pub fn tabled(&self, angle: f64, z: f64) -> f64 {
        self.tables().map(|table| table.offset(angle, z)).sum()
    }

    /// Derivatives of [`Shape::offset`] by angle (m/rad) and by z (1), behind a kink.
    #[must_use]
    pub fn gradient(&self, angle: f64, z: f64) -> [f64; 2] {
        let own = [
            self.sum(|feature| feature.around_slope(angle)),
            self.sum(|feature| feature.along(z)[1]),
        ];
        self.tables().fold(own, |[around, along], table| {
            let by = table.gradient(angle, z);
            [around + by[0], along + by[1]]
        })
    }

    /// Exact mean of the angular share between two angles, m.
    #[must_use]
    pub fn mean_around(&self, from: f64, to: f64) -> f64 {
        self.sum(|feature| feature.around_integral(to) - feature.around_integral(from))
            / (to - from)
    }

    /// Exact mean of the tables between two angles, m.
    #[must_use]
    pub fn mean_tabled(&self, from: f64, to: f64, z: f64) -> f64 {
        let parts = self.tables();
        let sum: f64 = parts
            .map(|table| table.integral(to, z) - table.integral(from, z))
            .sum();
        sum / (to - from)
    }

    /// It differs around, so that it matters how far the surface has turned.
    #[must_use]
    pub fn varies_around(&self) -> bool {
        self.features.iter().any(Feature::varies_around)
    }

    /// It differs along the axis.
    #[must_use]
    pub fn varies_along(&self) -> bool {
        self.features.iter().any(Feature::varies_along)
    }

    /// Its surface steps at some angle.
    #[must_use]
    pub fn has_steps(&self) -> bool {
        let is_step = |f: &Feature| matches!(f, Feature::OffsetHalves { .. });
        self.features.iter().any(is_step)
    }

    /// Angles where it bends or steps: the faces of a grid belong there.
    #[must_use]
    pub fn kinks_around(&self) -> Vec<f64> {
        let kinks = self.features.iter().flat_map(Feature::kinks_around);
        kinks.map(|angle| angle.rem_euclid(TAU)).collect()
    }

    /// Axial positions where it bends, m.
    #[must_use]
    pub fn kinks_along(&self) -> Vec<f64> {
        let inner = |feature: &Feature| match feature {
            Feature::EndRelief { end, length, .. } => Some(end - end.signum() * length),
            _ => None,
        };
        self.features.iter().filter_map(inner).collect()
    }

    /// Largest change of slope around at a kink, m/rad.
    #[must_use]
    pub fn bend(&self) -> f64 {
        self.sum(Feature::bend)
    }

    /// Bounds of the second derivatives by angle (m/rad2) and by z (1/m) on the stretch between two
    /// kinks along the axis that `z` lies in.
    #[must_use]
    pub fn curvature_bounds(&self, z: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.sum(|feature| feature.curvature_bounds(z)[axis]))
    }

    /// Stations around below which its waves would be missed.
    #[must_use]
    pub fn resolution(&self) -> usize {
        let all = self.features.iter().map(Feature::resolution);
        all.max().unwrap_or(0)
    }

    /// It is its own mirror image in the mid-plane.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.features.iter().all(|feature| match feature {
            Feature::Table(table) => table.is_mirrored(),
            Feature::EndRelief {
                end,
                length,
                end_offset,
                form,
            } => self.features.contains(&Feature::EndRelief {
                end: -end,
                length: *length,
                end_offset: *end_offset,
                form: *form,
            }),
            _ => true,
        })
    }
}

/// Shift of the arcs of a lemon bore or of offset halves for a preload, m: `c m / (1 - m)`.
#[must_use]
pub fn arc_shift(radial_clearance: f64, preload: f64) -> f64 {
    radial_clearance * preload / (1.0 - preload)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn nodes() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let angles = vec![0.2, 0.9, 2.0, 3.5, 4.1, 5.7];
        let positions = vec![-0.02, -0.004, 0.003, 0.011];
        let offsets = (0..24).map(|k| 1e-6 * f64::from((7 * k) % 11)).collect();
        (angles, positions, offsets)
    }

    fn table() -> ProfileTable {
        let (angles, positions, offsets) = nodes();
        ProfileTable::new(angles, positions, offsets).unwrap()
    }

    fn every_feature() -> Vec<Feature> {
        vec![
            Feature::Lemon {
                shift: 2e-5,
                joint: 0.4,
            },
            Feature::OffsetHalves {
                shift: 1e-5,
                joint: 0.7,
            },
            Feature::Crowning {
                end_offset: 3e-6,
                half_width: 0.015,
            },
            Feature::EndRelief {
                end: 0.015,
                length: 0.004,
                end_offset: 5e-6,
                form: ReliefForm::Linear,
            },
            Feature::EndRelief {
                end: -0.015,
                length: 0.006,
                end_offset: -5e-6,
                form: ReliefForm::Circular,
            },
            Feature::JointRelief {
                offset: 2e-5,
                half_span: 0.3,
                joint: 6.2,
            },
            Feature::Harmonic {
                order: 3,
                amplitude: 4e-6,
                phase: 1.1,
            },
            Feature::Table(table()),
        ]
    }

    /// Angles and positions off every kink.
    fn places() -> impl Iterator<Item = (f64, f64)> {
        (0..97).map(|k| {
            let k = f64::from(k);
            (-7.0 + 0.143 * k, -0.0149 + 0.000_307 * k)
        })
    }

    #[test]
    fn gradients_equal_central_differences() {
        for feature in every_feature() {
            let shape = Shape::of([feature.clone()]);
            let kinks = shape.kinks_around();
            for (angle, z) in places() {
                let far = |k: &f64| wrapped(angle - k).abs() > 1e-4;
                if !kinks.iter().all(far) {
                    continue;
                }
                let [around, along] = shape.gradient(angle, z);
                let (d, dz) = (1e-6, 1e-8);
                let by = (shape.offset(angle + d, z) - shape.offset(angle - d, z)) / (2.0 * d);
                assert!((by - around).abs() < 2e-9, "{feature:?} {angle}: {by}");
                let by = (shape.offset(angle, z + dz) - shape.offset(angle, z - dz)) / (2.0 * dz);
                assert!((by - along).abs() < 1e-6, "{feature:?} {z}: {by} {along}");
            }
        }
    }

    #[test]
    fn means_are_the_integrals_of_the_offset() {
        for feature in every_feature() {
            let shape = Shape::of([feature.clone()]);
            for (from, z) in places() {
                let to = from + 0.37;
                let mean = shape.mean_around(from, to) + shape.mean_tabled(from, to, z);
                let n = 20_000;
                let at = |k: usize| from + (to - from) * (k as f64 + 0.5) / n as f64;
                let offset = |angle: f64| shape.around(angle) + shape.tabled(angle, z);
                let sum: f64 = (0..n).map(|k| offset(at(k))).sum();
                // Midpoints miss a step by up to half a piece.
                let bar = if shape.has_steps() { 2e-9 } else { 2e-14 };
                assert!((sum / n as f64 - mean).abs() < bar, "{feature:?} {from}");
            }
        }
    }

    #[test]
    fn a_turn_changes_nothing() {
        for feature in every_feature() {
            let shape = Shape::of([feature.clone()]);
            for (angle, z) in places() {
                for turns in [-3.0, 1.0] {
                    let other = angle + turns * TAU;
                    let difference = shape.offset(angle, z) - shape.offset(other, z);
                    assert!(difference.abs() < 1e-18, "{feature:?} {angle}");
                    let whole = shape.mean_around(angle, angle + TAU)
                        - shape.mean_around(other, other + TAU);
                    assert!(whole.abs() < 1e-18, "{feature:?}");
                }
            }
        }
    }

    #[test]
    fn features_add_up() {
        let all = Shape::of(every_feature());
        for (angle, z) in places() {
            let parts = every_feature().into_iter();
            let sum: f64 = parts.map(|f| Shape::of([f]).offset(angle, z)).sum();
            assert!((all.offset(angle, z) - sum).abs() < 1e-19);
        }
    }

    #[test]
    fn curvature_stays_within_its_bounds() {
        for feature in every_feature() {
            let shape = Shape::of([feature.clone()]);
            let kinks = shape.kinks_around();
            let bends = shape.kinks_along();
            for (angle, z) in places() {
                let [around, along] = shape.curvature_bounds(z);
                let d = 1e-5;
                if kinks.iter().all(|k| wrapped(angle - k).abs() > 2.0 * d) {
                    let by = (shape.gradient(angle + d, z)[0] - shape.gradient(angle - d, z)[0])
                        / (2.0 * d);
                    assert!(
                        by.abs() <= around * 1.001 + 1e-9,
                        "{feature:?} {by} {around}"
                    );
                }
                let d = 1e-7;
                if bends.iter().all(|k| (z - k).abs() > 2.0 * d) {
                    let by = (shape.gradient(angle, z + d)[1] - shape.gradient(angle, z - d)[1])
                        / (2.0 * d);
                    assert!(by.abs() <= along * 1.001 + 1e-6, "{feature:?} {by} {along}");
                }
            }
        }
    }

    #[test]
    fn mirrors_are_known() {
        let relief = |end: f64| Feature::EndRelief {
            end,
            length: 0.004,
            end_offset: 5e-6,
            form: ReliefForm::Linear,
        };
        assert!(Shape::of([relief(0.01), relief(-0.01)]).is_mirrored());
        assert!(!Shape::of([relief(0.01)]).is_mirrored());
        assert!(!Shape::of([Feature::Table(table())]).is_mirrored());
    }

    /// The largest circle in a lemon bore or in offset halves touches at the nominal circle.
    #[test]
    fn arcs_stand_outward_of_the_nominal_circle() {
        let c = 3e-5;
        let shift = arc_shift(c, 0.5);
        assert!((shift - c).abs() < 1e-20);
        for feature in [
            Feature::Lemon { shift, joint: 0.3 },
            Feature::OffsetHalves { shift, joint: 0.3 },
        ] {
            let shape = Shape::of([feature]);
            let least = (0..7200)
                .map(|k| shape.around(TAU * f64::from(k) / 7200.0 + 1e-9))
                .fold(f64::INFINITY, f64::min);
            assert!(least >= 0.0 && least < 1e-6 * c);
        }
        // Square to the joint the clearance of a lemon is the nominal one.
        let lemon = Shape::of([Feature::Lemon { shift, joint: 0.3 }]);
        assert!(lemon.around(0.3 + FRAC_PI_2).abs() < 1e-20);
    }

    #[test]
    fn what_is_turned_has_its_offsets_further_on() {
        let shape = Shape::of(every_feature());
        let offset = |angle| shape.offset(angle, 0.004);
        for angle in [-3.0, 0.1, 1.7, 4.0] {
            let turned = shape.turned(0.6).offset(angle + 0.6, 0.004);
            assert!((turned - offset(angle)).abs() < 1e-18, "{angle}");
        }
    }
}
