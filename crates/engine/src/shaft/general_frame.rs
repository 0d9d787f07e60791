//! Which beams stand for a straight shaft, and which forces act on it?
//!
//! Sections are Timoshenko beams between steps, bearings and places of force. Weight: a beam of one
//! section that carries `w` per length between two nodes moves its nodes as under two forces `w L/2` at
//! the points of Gauss, `L/(2 sqrt 3)` to both sides of its middle: the shape functions of a beam are
//! cubic, and two points integrate cubics exactly. So the reactions are those of the distributed weight.
//! Loads and weight keep their direction, unbalances turn with the shaft.

use super::error::{ascending, positive, within};
use crate::{GeneralShaft, ShaftError, ShaftForce, ShaftLoad};
use sommerfeld_flex::{CondensedShaft, Frame, Material, Section};
use std::f64::consts::PI;

/// Nodes closer than this share of the length of the shaft are one.
const SAME: f64 = 1e-9;
/// Points of Gauss for two of them, as shares of half the length.
const GAUSS: f64 = 0.577_350_269_189_625_8;

impl GeneralShaft {
    /// Forces on the shaft at `speed` (rad/s) and shaft angle `angle` (rad), fixed frame, always in the
    /// same order and places: unbalances, given loads, then the weight piece by piece.
    #[must_use]
    pub fn forces(&self, speed: f64, angle: f64) -> Vec<ShaftForce> {
        let turning = self.unbalances.iter().map(|unbalance| {
            let pull = unbalance.moment * speed * speed;
            let (sin, cos) = (unbalance.angle + angle).sin_cos();
            ShaftForce {
                axial: unbalance.axial,
                force: [pull * cos, pull * sin],
            }
        });
        let given = self.loads.iter().map(|load| ShaftForce {
            axial: load.axial,
            force: load.at(angle, self.period),
        });
        turning.chain(given).chain(self.weight()).collect()
    }

    /// Axial positions of [`Self::forces`], m.
    #[must_use]
    pub fn force_positions(&self) -> Vec<f64> {
        let forces = self.forces(0.0, 0.0);
        forces.iter().map(|force| force.axial).collect()
    }

    /// Length of the shaft, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let lengths = self.sections.iter().map(|section| section.length);
        lengths.fold(0.0, |sum, length| sum + length)
    }

    /// Steps, bearings and places of loads and unbalances, ascending, with both ends.
    fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.steps();
        breaks.extend(&self.bearings);
        breaks.extend(self.unbalances.iter().map(|unbalance| unbalance.axial));
        breaks.extend(self.loads.iter().map(|load| load.axial));
        self.sorted(breaks)
    }

    fn sorted(&self, mut places: Vec<f64>) -> Vec<f64> {
        let same = SAME * self.length();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|later, earlier| *later - *earlier < same);
        places
    }

    /// Ends of the sections, from 0.
    fn steps(&self) -> Vec<f64> {
        let mut steps = vec![0.0];
        let mut end = 0.0;
        for section in &self.sections {
            end += section.length;
            steps.push(end);
        }
        steps
    }

    fn section_at(&self, axial: f64) -> usize {
        let steps = self.steps();
        let behind = steps.iter().skip(1).take_while(|end| **end <= axial);
        behind.count().min(self.sections.len().saturating_sub(1))
    }

    /// Two forces for each piece between breaks; none without gravity.
    fn weight(&self) -> Vec<ShaftForce> {
        if self.density == 0.0 || self.gravity == [0.0; 2] || self.sections.is_empty() {
            return Vec::new();
        }
        let breaks = self.breaks();
        let pieces = breaks.windows(2).map(|ends| (ends[0], ends[1]));
        let points = pieces.flat_map(|(from, to)| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let section = self.sections[self.section_at(middle)];
            let area = 0.25 * PI * (section.diameter.powi(2) - section.bore_diameter.powi(2));
            let force = self.gravity.map(|g| self.density * area * half * g);
            [-GAUSS, GAUSS].map(|share| ShaftForce {
                axial: middle + share * half,
                force,
            })
        });
        points.collect()
    }

    fn check(&self) -> Result<(), ShaftError> {
        positive("youngs_modulus", self.youngs_modulus)?;
        let nu = self.poissons_ratio;
        within(
            "poissons_ratio",
            nu,
            nu > -1.0 && nu <= 0.5,
            "above -1, at most 0.5",
        )?;
        within("density", self.density, self.density >= 0.0, "0 or more")?;
        for section in &self.sections {
            positive("length of a section", section.length)?;
            positive("diameter of a section", section.diameter)?;
            let bore = section.bore_diameter;
            let is_inside = (0.0..section.diameter).contains(&bore);
            within(
                "bore_diameter",
                bore,
                is_inside,
                "at least 0 and below the diameter",
            )?;
        }
        if self.bearings.is_empty() {
            return Err(ShaftError::TooFewBearings {
                given: 0,
                needed: 1,
            });
        }
        ascending("bearings", self.bearings.iter().copied())?;
        self.on_shaft("bearing", self.bearings.iter().copied())?;
        self.on_shaft("unbalance", self.unbalances.iter().map(|u| u.axial))?;
        self.on_shaft("load", self.loads.iter().map(|load| load.axial))
    }

    fn on_shaft(
        &self,
        what: &'static str,
        places: impl Iterator<Item = f64>,
    ) -> Result<(), ShaftError> {
        let length = self.length();
        let same = SAME * length;
        for (index, axial) in places.enumerate() {
            if !(-same..=length + same).contains(&axial) {
                return Err(ShaftError::OffShaft {
                    what,
                    index,
                    axial,
                    length,
                });
            }
        }
        Ok(())
    }
}

impl ShaftLoad {
    /// Force along x and y, N, at `angle` (rad) when it repeats after `period` (rad); 0 without points.
    #[must_use]
    pub fn at(&self, angle: f64, period: f64) -> [f64; 2] {
        let Some((first, last)) = self.points.first().zip(self.points.last()) else {
            return [0.0; 2];
        };
        // into the period that opens with the first point
        let angle = first[0] + (angle - first[0]).rem_euclid(period);
        let behind = self.points.partition_point(|point| point[0] <= angle);
        let from = behind.checked_sub(1).map_or(last, |at| &self.points[at]);
        let (to, end) = match self.points.get(behind) {
            Some(next) => (next, next[0]),
            None => (first, first[0] + period),
        };
        let span = end - from[0];
        let share = if span > 0.0 {
            (angle - from[0]) / span
        } else {
            0.0
        };
        [1, 2].map(|k| from[k] + share * (to[k] - from[k]))
    }
}

/// Condenses `shaft` onto the centres of its bearings; places of load are
/// [`GeneralShaft::force_positions`]. It is held along its axis and in torsion at its last end.
///
/// # Errors
/// [`ShaftError`] for dimensions out of range, bearings and loads beside the shaft.
pub fn condensed_shaft(shaft: &GeneralShaft) -> Result<CondensedShaft, ShaftError> {
    shaft.check()?;
    let material = Material {
        youngs_modulus: shaft.youngs_modulus,
        poissons_ratio: shaft.poissons_ratio,
    };
    let forces = shaft.force_positions();
    let mut places = shaft.breaks();
    places.extend(&forces);
    let places = shaft.sorted(places);
    let mut frame = Frame::new();
    for place in &places {
        frame.add_node([0.0, 0.0, *place]);
    }
    for (at, ends) in places.windows(2).enumerate() {
        let section = shaft.sections[shaft.section_at(0.5 * (ends[0] + ends[1]))];
        let section = Section::circle(&material, section.diameter, section.bore_diameter);
        frame.add_beam([at, at + 1], section, [1.0, 0.0, 0.0])?;
    }
    let node = |axial: &f64| {
        let same = SAME * shaft.length();
        let at = places.partition_point(|place| *place < axial - same);
        at.min(places.len().saturating_sub(1))
    };
    let end = places.len().saturating_sub(1);
    frame.hold(end, 2)?;
    frame.hold(end, 5)?;
    let journals: Vec<usize> = shaft.bearings.iter().map(node).collect();
    let loads: Vec<usize> = forces.iter().map(node).collect();
    Ok(CondensedShaft::from_frame(&frame, &journals, &loads)?)
}
