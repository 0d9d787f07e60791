//! The layout of an engine from what its designer states: banks, firing order, intervals, throws.
//!
//! A throw is phased by the cylinder that fires on it: at its firing top dead centre the arm points along
//! the cylinder axis, so that throw angle = bank angle - firing angle. What the plan says twice (two
//! cylinders on one throw, throw angles and firing angles) must agree; then the pistons decide, and firing
//! angles are set to their top dead centres exactly.
//!
//! The axial origin lies half a cylinder spacing before the first throw (of a boxer: before the middle of
//! its first two), where the first main stands unless positions are given.

use super::{ANGLE_TOLERANCE, check_dead_centres, overshoot, wrap};
use crate::{Cylinder, EngineLayout, LayoutError, Strokes, Throw};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// How the cylinders stand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LayoutKind {
    /// One bank, one throw for each cylinder.
    Inline,
    /// Two banks. Cylinders 1 to n/2 are bank A, at half the bank angle before x (the turning arm passes
    /// it first; on the left as seen from the free end), the others bank B, as far behind x. Cylinders k
    /// of both banks work on throw k with their rods side by side, that of bank A nearer to the free end.
    Vee {
        /// Angle between the banks, rad.
        bank_angle: f64,
    },
    /// Two banks at -90 and +90 deg, each cylinder with its own throw; cylinders are numbered along the
    /// shaft, odd ones in the bank at -90 deg, and the throws of 1 and 2, of 3 and 4, ... are opposed.
    Boxer,
}

/// What an engine's layout is made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LayoutPlan {
    /// How the cylinders stand.
    pub kind: LayoutKind,
    /// Number of cylinders.
    pub cylinders: usize,
    /// Cylinders in the order in which they fire, 1-based.
    pub firing_order: Vec<usize>,
    /// Crank angles between successive firings, from that of the first in the firing order, rad, as many
    /// as cylinders, one period together; even without.
    pub firing_intervals: Option<Vec<f64>>,
    /// Directions of the throws in any crank-fixed frame, rad, positive in the sense of rotation; from
    /// the firing angles without. A V engine with as many as cylinders has split pins: a throw for each
    /// rod in axial order (first of bank A, first of bank B, second of bank A, ...).
    pub throw_angles: Option<Vec<f64>>,
    /// Axial distance between neighbouring cylinders of a bank, m.
    pub cylinder_spacing: f64,
    /// Axial distance of the two rods of a pin of a V engine, or of two opposed rods of a boxer, m.
    pub rod_offset: f64,
    /// Axial positions of the mains, m; one at each side of every throw (V: of every pair of rods)
    /// without.
    pub main_positions: Option<Vec<f64>>,
    /// Strokes of a working cycle.
    pub strokes: Strokes,
}

impl EngineLayout {
    /// The layout of a plan.
    ///
    /// # Errors
    /// The first thing in the plan that is no engine, or that contradicts the rest.
    pub fn new(plan: &LayoutPlan) -> Result<Self, LayoutError> {
        plan.check_numbers()?;
        let firing_angles = plan.firing_angles()?;
        let mut cylinders: Vec<Cylinder> = (0..plan.cylinders)
            .map(|index| plan.cylinder(index, firing_angles[index]))
            .collect();
        let throws = plan.throws(&cylinders)?;
        let strokes = plan.strokes;
        check_dead_centres(&cylinders, &throws, strokes, plan.against())?;
        for cylinder in &mut cylinders {
            cylinder.firing_angle += overshoot(cylinder, &throws[cylinder.throw]);
        }
        let layout = Self {
            mains: plan.mains(),
            cylinders,
            throws,
            strokes,
        };
        layout.check()?;
        Ok(layout)
    }
}

impl LayoutPlan {
    fn check_numbers(&self) -> Result<(), LayoutError> {
        let (kind, has_pairs) = match self.kind {
            LayoutKind::Inline => ("an inline engine", false),
            LayoutKind::Vee { .. } => ("a V engine", true),
            LayoutKind::Boxer => ("a boxer engine", true),
        };
        let cylinders = self.cylinders;
        let refuse = |needed| {
            Err(LayoutError::Cylinders {
                kind,
                needed,
                cylinders,
            })
        };
        if cylinders == 0 {
            return refuse("one cylinder at least");
        }
        if has_pairs && !cylinders.is_multiple_of(2) {
            return refuse("as many cylinders in either bank");
        }
        let demand = |holds: bool, what, value, needed| match holds {
            true => Ok(()),
            false => Err(LayoutError::Dimension {
                what,
                value,
                needed,
            }),
        };
        let spacing = self.cylinder_spacing;
        demand(
            spacing > 0.0 && spacing.is_finite(),
            "cylinder spacing (m)",
            spacing,
            "it must be above 0",
        )?;
        if let LayoutKind::Vee { bank_angle } = self.kind {
            demand(
                bank_angle > 0.0 && bank_angle <= PI + ANGLE_TOLERANCE,
                "angle between the banks (deg)",
                bank_angle.to_degrees(),
                "it must be above 0 and at most 180 deg",
            )?;
        }
        let offset = self.rod_offset;
        match self.kind {
            LayoutKind::Inline => Ok(()),
            LayoutKind::Vee { .. } => demand(
                (0.0..spacing).contains(&offset),
                "axial distance of the two rods of a pin (m)",
                offset,
                "it must be 0 or above, and below the cylinder spacing",
            ),
            LayoutKind::Boxer => demand(
                offset > 0.0 && offset < spacing,
                "axial distance of two opposed rods (m)",
                offset,
                "the two throws need room beside each other: above 0 and below the cylinder spacing",
            ),
        }
    }

    /// Firing angle of each cylinder, 0 for the first.
    fn firing_angles(&self) -> Result<Vec<f64>, LayoutError> {
        self.check_firing_order()?;
        let period = self.strokes.period();
        let count = self.cylinders as f64;
        let even = |k: usize| period * k as f64 / count;
        let ends: Vec<f64> = match &self.firing_intervals {
            None => (0..self.cylinders).map(even).collect(),
            Some(intervals) => {
                self.check_intervals(intervals)?;
                let sum: f64 = intervals.iter().sum();
                let running = intervals.iter().scan(0.0, |at, interval| {
                    let start = *at;
                    *at += interval * (period / sum);
                    Some(start)
                });
                running.collect()
            }
        };
        let mut angles = vec![0.0; self.cylinders];
        for (cylinder, end) in self.firing_order.iter().zip(ends) {
            angles[cylinder - 1] = end;
        }
        let first = angles[0];
        Ok(angles
            .into_iter()
            .map(|angle| match angle >= first {
                true => angle - first,
                false => angle - first + period,
            })
            .collect())
    }

    fn check_firing_order(&self) -> Result<(), LayoutError> {
        let refuse = |fault: String| {
            Err(LayoutError::FiringOrder {
                order: self.firing_order.clone(),
                fault,
                cylinders: self.cylinders,
            })
        };
        let mut fires = vec![false; self.cylinders];
        for &cylinder in &self.firing_order {
            match cylinder.checked_sub(1).and_then(|at| fires.get_mut(at)) {
                None => return refuse(format!("has a cylinder {cylinder} that is not there")),
                Some(true) => return refuse(format!("has cylinder {cylinder} twice")),
                Some(fires) => *fires = true,
            }
        }
        match fires.iter().position(|fires| !fires) {
            Some(index) => refuse(format!("leaves out cylinder {}", index + 1)),
            None => Ok(()),
        }
    }

    fn check_intervals(&self, intervals: &[f64]) -> Result<(), LayoutError> {
        let refuse = |fault: String| Err(LayoutError::FiringIntervals { fault });
        if intervals.len() != self.cylinders {
            return refuse(format!(
                "{} given, {} cylinders need as many, the last one back to the first firing",
                intervals.len(),
                self.cylinders
            ));
        }
        let lasts = |interval: &f64| *interval > 0.0;
        if let Some(index) = intervals.iter().position(|interval| !lasts(interval)) {
            return refuse(format!(
                "the one after cylinder {} is {:.1} deg, it must be above 0",
                self.firing_order[index],
                intervals[index].to_degrees()
            ));
        }
        let sum: f64 = intervals.iter().sum();
        let period = self.strokes.period();
        let tolerance = ANGLE_TOLERANCE * intervals.len() as f64;
        match (sum - period).abs() <= tolerance {
            true => Ok(()),
            false => refuse(format!(
                "together {:.1} deg, a working cycle takes {:.0} deg",
                sum.to_degrees(),
                period.to_degrees()
            )),
        }
    }

    /// Number of axial places with a throw or, in engines with two banks, with a pair of rods.
    fn places(&self) -> usize {
        match self.kind {
            LayoutKind::Inline => self.cylinders,
            LayoutKind::Vee { .. } | LayoutKind::Boxer => self.cylinders / 2,
        }
    }

    fn has_split_pins(&self) -> bool {
        let given = self.throw_angles.as_ref().map(Vec::len);
        matches!(self.kind, LayoutKind::Vee { .. }) && given == Some(self.cylinders)
    }

    fn cylinder(&self, index: usize, firing_angle: f64) -> Cylinder {
        let middle = |place: usize| (place as f64 + 0.5) * self.cylinder_spacing;
        let half = 0.5 * self.rod_offset;
        let (throw, bank_angle, axial) = match self.kind {
            LayoutKind::Inline => (index, 0.0, middle(index)),
            LayoutKind::Vee { bank_angle } => {
                let (bank, place) = (index / self.places(), index % self.places());
                let side = [-1.0, 1.0][bank];
                let throw = match self.has_split_pins() {
                    true => 2 * place + bank,
                    false => place,
                };
                (throw, side * 0.5 * bank_angle, middle(place) + side * half)
            }
            LayoutKind::Boxer => {
                let side = [-1.0, 1.0][index % 2];
                (index, side * FRAC_PI_2, middle(index / 2) + side * half)
            }
        };
        Cylinder {
            throw,
            bank_angle,
            firing_angle,
            axial,
        }
    }

    /// Throws phased by `throw_angles`, or by the first cylinder on each of them.
    fn throws(&self, cylinders: &[Cylinder]) -> Result<Vec<Throw>, LayoutError> {
        let on = |throw: usize| cylinders.iter().filter(move |on| on.throw == throw);
        let count = 1 + cylinders.iter().map(|on| on.throw).max().unwrap_or(0);
        let mut throws: Vec<Throw> = (0..count)
            .map(|throw| {
                let rods = on(throw).count() as f64;
                let first = on(throw).next();
                Throw {
                    angle: first.map_or(0.0, |on| wrap(on.bank_angle - on.firing_angle)),
                    axial: on(throw).map(|on| on.axial).sum::<f64>() / rods,
                }
            })
            .collect();
        if let Some(given) = &self.throw_angles {
            self.check_throw_count(given.len(), count)?;
            // cylinder 1 fires at crank angle 0, with its arm along its axis
            let turn = cylinders[0].bank_angle - given[cylinders[0].throw];
            for (throw, angle) in throws.iter_mut().zip(given) {
                throw.angle = wrap(angle + turn);
            }
        }
        match self.kind {
            LayoutKind::Boxer => check_opposed(&throws)?,
            LayoutKind::Inline | LayoutKind::Vee { .. } => {}
        }
        Ok(throws)
    }

    fn check_throw_count(&self, given: usize, throws: usize) -> Result<(), LayoutError> {
        let hint = match self.kind {
            LayoutKind::Vee { .. } => "; split pins have one for each cylinder",
            LayoutKind::Inline | LayoutKind::Boxer => "",
        };
        match given == throws {
            true => Ok(()),
            false => Err(LayoutError::ThrowCount {
                given,
                throws,
                hint,
            }),
        }
    }

    /// What phases the throws, for messages.
    fn against(&self) -> String {
        match (&self.throw_angles, self.kind) {
            (Some(_), _) => "the throw angles".to_owned(),
            (None, LayoutKind::Vee { bank_angle }) => format!(
                "two cylinders on one throw with {:.1} deg between the banks; give intervals that do, or a \
                 throw angle for each cylinder (split pins)",
                bank_angle.to_degrees()
            ),
            (None, LayoutKind::Inline | LayoutKind::Boxer) => "the throws".to_owned(),
        }
    }

    fn mains(&self) -> Vec<f64> {
        let places = self.places();
        let step = self.cylinder_spacing;
        match (&self.main_positions, self.kind) {
            (Some(positions), _) => positions.clone(),
            (None, LayoutKind::Boxer) => (0..=2 * places).map(|k| 0.5 * step * k as f64).collect(),
            (None, _) => (0..=places).map(|k| step * k as f64).collect(),
        }
    }
}

fn check_opposed(throws: &[Throw]) -> Result<(), LayoutError> {
    for (pair, two) in throws.chunks_exact(2).enumerate() {
        let between = wrap(two[1].angle - two[0].angle).abs();
        if (between - PI).abs() > ANGLE_TOLERANCE {
            return Err(LayoutError::NotOpposed {
                cylinders: [2 * pair + 1, 2 * pair + 2],
                between: between.to_degrees(),
            });
        }
    }
    Ok(())
}
