//! What comes through the crank to the pins of an engine.

use super::Checker;
use super::grooves::DrillingKeys;
use super::machine_bearings::CheckedBearing;
use crate::input::error::InputError;
use crate::input::machine::MachineBearing;
use sommerfeld_bearing::PressureCycle;
use sommerfeld_engine::{
    CrankTrain, Drilling, DrillingInlet, GrooveArc, Role, arm_in_rod_frame, mouth_radius,
};
use sommerfeld_film::{Bearing, Carrier, FeedShape};
use std::f64::consts::PI;

impl Checker<'_> {
    /// The bearings of the plan: angles of the pins counted as load cycles count them, drillings with
    /// their inlets.
    pub(super) fn supplied_through_crank(
        &mut self,
        train: &CrankTrain,
        checked: Vec<CheckedBearing>,
        speeds: &[f64],
        density: f64,
    ) -> Option<Vec<MachineBearing>> {
        let crank = Crank {
            train,
            mains: checked
                .iter()
                .filter(|bearing| bearing.role == Role::Main)
                .cloned()
                .collect(),
            speeds,
            density,
        };
        let mut found = Vec::new();
        let mut is_right = true;
        for bearing in checked {
            let mut drillings = Vec::new();
            for keys in &bearing.drillings {
                match crank.drilling(&bearing, keys) {
                    Ok(drilling) => drillings.push(drilling),
                    Err(error) => {
                        is_right = false;
                        // Many cylinders share one table.
                        if !self.errors.contains(&error) {
                            self.errors.push(*error);
                        }
                    }
                }
            }
            let arm = match bearing.role {
                Role::BigEnd => arm_in_rod_frame(train, bearing.index)?,
                _ => 0.0,
            };
            found.push(MachineBearing {
                name: bearing.name(),
                role: bearing.role,
                index: bearing.index,
                bearing: turned_journal(bearing.bearing, arm),
                feed_pressures: bearing.feed_pressures,
                drillings,
            });
        }
        is_right.then_some(found)
    }
}

/// The bearing with everything that its journal carries turned by an angle, rad.
fn turned_journal(mut bearing: Bearing, by: f64) -> Bearing {
    if by != 0.0 {
        bearing.journal = bearing.journal.turned(by);
        for feed in &mut bearing.feeds {
            if feed.carried_by == Carrier::Journal {
                feed.angle += by;
            }
        }
    }
    bearing
}

/// What the drillings of a crank need to know.
struct Crank<'a> {
    train: &'a CrankTrain,
    mains: Vec<CheckedBearing>,
    speeds: &'a [f64],
    /// kg/m3.
    density: f64,
}

impl Crank<'_> {
    fn drilling(
        &self,
        bearing: &CheckedBearing,
        keys: &DrillingKeys,
    ) -> Result<Drilling, Box<InputError>> {
        let place = |message: String| InputError {
            message,
            ..keys.place.clone()
        };
        let drilling = match (keys.radii, &keys.fed_by) {
            (Some([inlet_radius, outlet_radius]), _) => Drilling {
                feed: keys.feed,
                inlet_radius,
                outlet_radius,
                inlet: None,
            },
            (None, Some(_)) => self.main_drilling(bearing, keys)?,
            (None, None) => return Err(Box::new(place("the drilling has no inlet".into()))),
        };
        let period = self.train.period();
        let own = bearing
            .bearing
            .feeds
            .get(keys.feed)
            .map_or(0.0, |feed| feed.pressure);
        for speed in self.speeds {
            let lowest = drilling
                .lowest_supply(self.density, *speed, period)
                .unwrap_or_else(|| own + drilling.head(self.density, *speed));
            if lowest < bearing.bearing.cavitation_pressure {
                let message = format!(
                    "at {} rpm, with the head of its drilling, {:.2} bar, the feed pressure is below the \
                     cavitation pressure",
                    (speed * 30.0 / PI).round(),
                    1e-5 * drilling.head(self.density, *speed)
                );
                return Err(Box::new(place(message)));
            }
        }
        Ok(drilling)
    }

    /// A drilling from a main journal to the hole of a pin.
    fn main_drilling(
        &self,
        bearing: &CheckedBearing,
        keys: &DrillingKeys,
    ) -> Result<Drilling, Box<InputError>> {
        let place = |message: String| InputError {
            message,
            ..keys.place.clone()
        };
        let hole = bearing.bearing.feeds.get(keys.feed);
        let (Some(fed_by), Some(hole)) = (&keys.fed_by, hole) else {
            return Err(Box::new(place("the drilling has no hole".into())));
        };
        if bearing.role != Role::BigEnd {
            let message = "only a hole in the pin of a big end is fed by a main bearing".to_owned();
            return Err(Box::new(
                place(message).allowing("pressure or pressure_file"),
            ));
        }
        let mains = self.train.layout.mains.len();
        let cylinders = self.train.layout.cylinders.len();
        let number = match fed_by.mains[..] {
            [only] => only,
            ref each if each.len() == cylinders => each.get(bearing.index).copied().unwrap_or(0),
            ref each => {
                let error = place(format!(
                    "{} main bearings feed {cylinders} pins",
                    each.len()
                ));
                let allowed = format!("one number for all cylinders, or {cylinders} numbers");
                return Err(Box::new(error.allowing(allowed)));
            }
        };
        let main = number.wrapping_sub(1);
        if main >= mains {
            let error = place(format!("there is no main bearing {number}"));
            return Err(Box::new(error.allowing(format!("1 to {mains}"))));
        }
        let checked = self.mains.iter().find(|bearing| bearing.index == main);
        // What is wrong with the main itself is told there.
        let Some(checked) = checked else {
            return Err(Box::new(place(format!(
                "main bearing {number} is not complete"
            ))));
        };
        let grooves = arcs(&checked.bearing, &checked.feed_pressures);
        if grooves.is_empty() {
            let error = place(format!(
                "main bearing {number} has no groove that could feed the pin"
            ));
            return Err(Box::new(error.hinting(
                "give it a [[bearing.groove]] in its shell, or give the hole a pressure of its own",
            )));
        }
        let reaches_around = grooves.iter().any(|groove| groove.half_span >= PI);
        if fed_by.inlet_angle.is_none() && !reaches_around {
            let error = place(format!(
                "the grooves of main bearing {number} do not reach around: where the drilling meets them \
                 depends on its inlet"
            ));
            return Err(Box::new(
                error
                    .of_key("bearing.groove.drilling_inlet_angle")
                    .hinting("give drilling_inlet_angle, from the crank arm of the pin"),
            ));
        }
        let cylinders = &self.train.layout.cylinders;
        let throw = cylinders
            .get(bearing.index)
            .map_or(0, |cylinder| cylinder.throw);
        let arm = self
            .train
            .layout
            .throws
            .get(throw)
            .map_or(0.0, |throw| throw.angle);
        let hole_diameter = match hole.shape {
            FeedShape::Hole { diameter } => diameter,
            FeedShape::Rectangle { length, .. } => length,
            FeedShape::Circumferential { width } => width,
        };
        let journal = |bearing: &Bearing| bearing.radius() - bearing.radial_clearance;
        let inlet_radius = journal(&checked.bearing);
        let inlet_diameter = fed_by.inlet_diameter.unwrap_or(hole_diameter);
        Ok(Drilling {
            feed: keys.feed,
            inlet_radius,
            outlet_radius: mouth_radius(
                self.train.crank_radius,
                journal(&bearing.bearing),
                hole.angle,
            ),
            inlet: Some(DrillingInlet {
                main,
                angle: arm + fed_by.inlet_angle.unwrap_or(0.0),
                half_span: 0.5 * inlet_diameter / inlet_radius,
                grooves,
                land_pressure: bearing.bearing.ambient_pressure,
            }),
        })
    }
}

/// The grooves in the shell of a main bearing as an inlet in its journal meets them.
fn arcs(main: &Bearing, cycles: &[PressureCycle]) -> Vec<GrooveArc> {
    let radius = main.radius();
    let feeds = main.feeds.iter().enumerate();
    let of_shell = feeds.filter(|(_, feed)| feed.carried_by == Carrier::Shell);
    of_shell
        .map(|(index, feed)| GrooveArc {
            angle: feed.angle,
            half_span: match feed.shape {
                FeedShape::Circumferential { .. } => PI,
                FeedShape::Rectangle { length, .. } => 0.5 * length / radius,
                FeedShape::Hole { diameter } => 0.5 * diameter / radius,
            },
            pressure: match cycles.iter().find(|cycle| cycle.feed == index) {
                Some(cycle) => cycle.clone(),
                None => PressureCycle {
                    feed: index,
                    points: vec![[0.0, feed.pressure]],
                },
            },
        })
        .collect()
}
