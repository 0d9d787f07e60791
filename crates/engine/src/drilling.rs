//! At which pressure does oil come through the crank to a hole in a crankpin?
//!
//! A drilling runs from the surface of a main journal to that of the pin. Where its inlet passes a groove
//! of the main bearing, the pressure of the groove stands in it; the oil turns with the crank like a solid
//! body, so that its outlet has the head `rho omega^2 (r_out^2 - r_in^2) / 2` more.
//!
//! A groove that does not reach around the bearing feeds only while the inlet meets it. As the inlet, of
//! angular half span h, crosses the end of a groove of half span g, the share of its mouth that is open
//! rises linearly: 0 at a distance of g + h between their centres, `min(1, g/h)` at |g - h|.
//!
//! Assumptions: the drilling is full, its walls do not resist (give the hole a line resistance for that),
//! the inlet turns evenly, and while it faces the land of the main bearing it stands at the pressure around
//! the bearings: the film there is not asked. The pressure of a groove behind a resisting line is taken as
//! that of its supply.
//!
//! The crankpin has its +X along the outward end of its crank arm; a load cycle counts the angle of a
//! journal from +X of its shell at crank angle 0. [`arm_in_rod_frame`] is what lies between them.

use crate::CrankTrain;
use serde::{Deserialize, Serialize};
use sommerfeld_bearing::PressureCycle;
use sommerfeld_film::supply::drilling_head;
use std::f64::consts::{PI, TAU};

/// Crank angle between the points at which a supply that changes over the turn is given, rad.
const STEP: f64 = PI / 180.0;

/// A drilling in the crank that feeds a hole of a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drilling {
    /// Index of the hole among the feeds of its bearing.
    pub feed: usize,
    /// Distance from the crank axis at which it takes its oil, m.
    pub inlet_radius: f64,
    /// Distance from the crank axis at which it opens into the film, m.
    pub outlet_radius: f64,
    /// Where it takes its oil; `None`: from the supply that the hole itself names.
    pub inlet: Option<DrillingInlet>,
}

/// The inlet of a drilling in a main journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DrillingInlet {
    /// Number of the main bearing, 0-based.
    pub main: usize,
    /// Its direction at crank angle 0, rad from x of the engine frame.
    pub angle: f64,
    /// Half of the angle it spans on the journal, rad.
    pub half_span: f64,
    /// The grooves of the main bearing.
    pub grooves: Vec<GrooveArc>,
    /// Gauge pressure in it while it meets no groove, Pa.
    pub land_pressure: f64,
}

/// A groove of a main bearing as the inlet of a drilling meets it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GrooveArc {
    /// Angle of its centre from x of the engine frame, rad.
    pub angle: f64,
    /// Half of the angle it spans, rad; pi or more: it reaches around.
    pub half_span: f64,
    /// Its gauge pressure over the crank angle; one point for a constant one.
    pub pressure: PressureCycle,
}

/// What supplies a hole at a speed.
#[derive(Debug, Clone, PartialEq)]
pub enum HoleSupply {
    /// Gauge pressure, Pa.
    Constant(f64),
    /// Gauge pressure over the crank angle.
    Cycle(PressureCycle),
}

impl Drilling {
    /// What the centrifugal head adds, Pa, at a density (kg/m3) and a speed of the crank (rad/s).
    #[must_use]
    pub fn head(&self, density: f64, speed: f64) -> f64 {
        drilling_head(density, speed, self.inlet_radius, self.outlet_radius)
    }

    /// Supply of the hole at a speed (rad/s), over a period (rad); `None` where the drilling has no inlet
    /// of its own.
    #[must_use]
    pub fn supply(&self, density: f64, speed: f64, period: f64) -> Option<HoleSupply> {
        let inlet = self.inlet.as_ref()?;
        let head = self.head(density, speed);
        if let Some(pressure) = inlet.constant() {
            return Some(HoleSupply::Constant(pressure + head));
        }
        let angles = inlet.angles(period).into_iter();
        let points = angles.map(|angle| [angle, inlet.pressure(angle, period) + head]);
        Some(HoleSupply::Cycle(PressureCycle {
            feed: self.feed,
            points: points.collect(),
        }))
    }

    /// Lowest pressure at the hole over the cycle, Pa.
    #[must_use]
    pub fn lowest_supply(&self, density: f64, speed: f64, period: f64) -> Option<f64> {
        Some(match self.supply(density, speed, period)? {
            HoleSupply::Constant(pressure) => pressure,
            HoleSupply::Cycle(cycle) => {
                let pressures = cycle.points.iter().map(|point| point[1]);
                pressures.fold(f64::INFINITY, f64::min)
            }
        })
    }
}

impl DrillingInlet {
    /// Pressure of a groove that feeds it all around at a constant pressure, where no other adds to it.
    fn constant(&self) -> Option<f64> {
        let [only] = &self.grooves[..] else {
            return None;
        };
        let [point] = &only.pressure.points[..] else {
            return None;
        };
        (only.half_span >= PI).then_some(point[1])
    }

    /// Gauge pressure in the inlet at a crank angle (rad), Pa: that of the groove that opens it most.
    fn pressure(&self, crank_angle: f64, period: f64) -> f64 {
        let shares = self.grooves.iter().map(|groove| {
            let share = groove.open_share(self.angle + crank_angle, self.half_span);
            let pressure = groove.pressure.at(crank_angle, period);
            (
                share,
                self.land_pressure + share * (pressure - self.land_pressure),
            )
        });
        let widest = shares.max_by(|a, b| a.0.total_cmp(&b.0));
        widest.map_or(self.land_pressure, |(_, pressure)| pressure)
    }

    /// Crank angles of one period at which the pressure is given: even ones, and those at which it bends.
    fn angles(&self, period: f64) -> Vec<f64> {
        let even = (period / STEP).ceil().max(1.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few hundred
        let mut angles: Vec<f64> = (0..even as usize)
            .map(|k| k as f64 * period / even)
            .collect();
        for groove in self.grooves.iter().filter(|groove| groove.half_span < PI) {
            let (far, near) = groove.bends(self.half_span);
            for bend in [-far, -near, near, far] {
                let first = (groove.angle - self.angle + bend).rem_euclid(TAU);
                let turns = (0..).map(|turn| first + TAU * f64::from(turn));
                angles.extend(turns.take_while(|angle| *angle < period));
            }
        }
        angles.extend(self.grooves.iter().flat_map(|groove| {
            let points = groove.pressure.points.iter();
            points.map(|point| point[0].rem_euclid(period))
        }));
        angles.sort_by(f64::total_cmp);
        // Rows of a table lie apart; bends closer than this are one.
        angles.dedup_by(|b, a| *b - *a < 1e-9);
        angles.retain(|angle| *angle < period);
        angles
    }
}

impl GrooveArc {
    /// Distances between the centres of groove and inlet at which the mouth begins to open and is open as
    /// far as it gets, rad.
    fn bends(&self, half_span: f64) -> (f64, f64) {
        (
            self.half_span + half_span,
            (self.half_span - half_span).abs(),
        )
    }

    /// Share of the mouth of an inlet at `angle` (rad from x) that is open to the groove.
    fn open_share(&self, angle: f64, half_span: f64) -> f64 {
        if self.half_span >= PI {
            return 1.0;
        }
        let apart = ((angle - self.angle + PI).rem_euclid(TAU) - PI).abs();
        let (far, near) = self.bends(half_span);
        let most = (self.half_span / half_span).min(1.0);
        if apart <= near {
            most
        } else if apart >= far {
            0.0
        } else {
            most * (far - apart) / (far - near)
        }
    }
}

/// Distance of the mouth of a hole in a crankpin from the crank axis, m: `angle` (rad) of the hole from the
/// outward end of the crank arm.
#[must_use]
pub fn mouth_radius(crank_radius: f64, pin_radius: f64, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    (crank_radius + pin_radius * cos).hypot(pin_radius * sin)
}

/// Direction of the outward end of the crank arm of a cylinder (0-based) at crank angle 0 in the frame of
/// its rod, rad: added to an angle counted from the arm, it gives the angle from +X of the crankpin as a
/// load cycle of the big end counts it, whose +X stands along the rod at crank angle 0. `None` without that
/// cylinder, or where its rod does not reach.
#[must_use]
pub fn arm_in_rod_frame(train: &CrankTrain, cylinder: usize) -> Option<f64> {
    let cylinder = train.layout.cylinders.get(cylinder)?;
    let arm = train.layout.throws.get(cylinder.throw)?.angle - cylinder.bank_angle;
    // Cylinder frame: x along the cylinder, the piston pin at y = pin offset.
    let across = (train.pin_offset - train.crank_radius * arm.sin()) / train.rod_length;
    let angle = arm - across.asin();
    angle.is_finite().then_some(angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cylinder, EngineLayout, Rod, Strokes, Throw};

    fn drilling(half_span: f64) -> Drilling {
        Drilling {
            feed: 0,
            inlet_radius: 0.04,
            outlet_radius: 0.09,
            inlet: Some(DrillingInlet {
                main: 2,
                angle: 0.5,
                half_span: 0.1,
                grooves: vec![GrooveArc {
                    angle: 1.0,
                    half_span,
                    pressure: PressureCycle {
                        feed: 0,
                        points: vec![[0.0, 4e5]],
                    },
                }],
                land_pressure: 0.0,
            }),
        }
    }

    #[test]
    fn a_groove_all_around_feeds_at_its_pressure_and_head() {
        let head = 0.5 * 850.0 * 200.0 * 200.0 * (0.09 * 0.09 - 0.04 * 0.04);
        let supply = drilling(PI).supply(850.0, 200.0, 2.0 * TAU);
        let Some(HoleSupply::Constant(pressure)) = supply else {
            panic!("{supply:?}")
        };
        assert!((pressure - 4e5 - head).abs() < 1e-6);
    }

    /// A half groove feeds for half of the turn: mean pressure, ends of the window and symmetry.
    #[test]
    fn a_half_groove_feeds_for_half_of_each_turn() {
        let period = 2.0 * TAU;
        let supply = drilling(0.5 * PI).supply(850.0, 0.0, period);
        let Some(HoleSupply::Cycle(cycle)) = supply else {
            panic!("{supply:?}")
        };
        assert!((cycle.mean(period) - 2e5).abs() < 1e-6 * 2e5);
        // The centres meet at crank angle 0.5; the mouth is half open a quarter turn away from that.
        for turn in [0.0, TAU] {
            let at = |from_centre: f64| cycle.at(0.5 + from_centre + turn, period);
            for side in [-1.0, 1.0] {
                assert!((at(side * 0.5 * PI) - 2e5).abs() < 1e-3);
                assert!((at(side * (0.5 * PI - 0.1)) - 4e5).abs() < 1e-3);
                assert!(at(side * (0.5 * PI + 0.1)).abs() < 1e-3);
            }
        }
        let ascends = cycle.points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        assert!(ascends && cycle.points[cycle.points.len() - 1][0] < period);
    }

    #[test]
    fn a_hole_on_the_far_side_of_the_pin_lies_nearer_to_the_axis() {
        assert!((mouth_radius(0.07, 0.03, 0.0) - 0.10).abs() < 1e-15);
        assert!((mouth_radius(0.07, 0.03, PI) - 0.04).abs() < 1e-15);
        assert!((mouth_radius(0.04, 0.03, 0.5 * PI) - 0.05).abs() < 1e-15);
    }

    /// The hole of a cylinder whose throw is not at crank angle 0, placed by walking the mechanism.
    #[test]
    fn the_arm_stands_where_the_mechanism_puts_it() {
        let train = CrankTrain {
            layout: EngineLayout {
                cylinders: vec![Cylinder {
                    throw: 0,
                    bank_angle: 0.3,
                    firing_angle: 0.0,
                    axial: 0.0,
                }],
                throws: vec![Throw {
                    angle: 2.1,
                    axial: 0.0,
                }],
                mains: vec![-0.05, 0.05],
                strokes: Strokes::Four,
            },
            bore: 0.1,
            crank_radius: 0.05,
            rod_length: 0.15,
            pin_offset: 0.004,
            piston_mass: 1.0,
            rod: Rod {
                mass: 1.0,
                centre_of_gravity: 0.05,
                inertia: 0.01,
            },
            unbalances: Vec::new(),
            crankcase_pressure: 1e5,
        };
        let found = arm_in_rod_frame(&train, 0).unwrap_or(f64::NAN);
        // Engine frame: crankpin and piston pin, the latter on its line at a distance from the crank axis.
        let pin = [0.05 * 2.1_f64.cos(), 0.05 * 2.1_f64.sin()];
        let (axis, across) = (
            [0.3_f64.cos(), 0.3_f64.sin()],
            [-(0.3_f64.sin()), 0.3_f64.cos()],
        );
        let lateral = pin[0] * across[0] + pin[1] * across[1] - 0.004;
        let along =
            pin[0] * axis[0] + pin[1] * axis[1] + (0.15_f64.powi(2) - lateral * lateral).sqrt();
        let piston = [0, 1].map(|k| along * axis[k] + 0.004 * across[k]);
        let rod = (piston[1] - pin[1]).atan2(piston[0] - pin[0]);
        assert!((found - (2.1 - rod)).abs() < 1e-12, "{found}");
    }
}
