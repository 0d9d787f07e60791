//! The engine: layout, crank train, and how its parts go together.

use super::Checker;
use super::grooves::mm;
use super::machine::Found;
use super::machine_bearings::{CheckedBearing, Kind};
use super::{as_number, value_in};
use crate::input::error::InputError;
use crate::input::machine::{EnginePlan, Machine};
use crate::input::values::Value;
use sommerfeld_engine::{
    CrankTrain, Cylinder, EngineLayout, LayoutError, LayoutKind, LayoutPlan, PinFit, Rod, Role,
    Strokes, Throw, Unbalance,
};
use std::f64::consts::PI;

/// Inertia of usual rods over that of two point masses in their ends.
const USUAL_INERTIA: std::ops::Range<f64> = 0.4..2.0;

impl Checker<'_> {
    /// The engine and its bearings; its oil has this density, kg/m3.
    pub(super) fn engine(&mut self, speeds: &[f64], density: Option<f64>) -> Option<Found> {
        let layout = self.layout();
        let train = layout.clone().and_then(|layout| self.crank_train(layout));
        let gas = self.gas(speeds);
        let pin_fit = self.pin_fit();
        let bearings = match &layout {
            Some(layout) => {
                let kinds = self.kinds(layout);
                self.machine_bearings(&kinds)
            }
            None => Vec::new(),
        };
        if let Some(fit) = pin_fit {
            self.check_pin(fit, &bearings);
        }
        if let Some(layout) = &layout {
            self.check_places(layout, &bearings);
        }
        let mains = layout
            .as_ref()
            .and_then(|layout| self.mains(layout, &bearings));
        let torsion = match &layout {
            Some(layout) => self.torsion(layout.throws.len()),
            None => Some(None),
        };
        let train = train?;
        let bearings = self.supplied_through_crank(&train, bearings, speeds, density?)?;
        let plan = EnginePlan {
            train,
            gas: gas?,
            mains: mains?,
            pin_fit: pin_fit?,
            torsion: torsion?,
        };
        Some((Machine::Engine(Box::new(plan)), bearings))
    }

    fn kinds(&self, layout: &EngineLayout) -> [Kind; 4] {
        let kind = |role, count, is_due| Kind {
            role,
            count,
            is_due,
        };
        let cylinders = layout.cylinders.len();
        [
            kind(Role::Main, layout.mains.len(), true),
            kind(Role::BigEnd, cylinders, true),
            kind(Role::SmallEnd, cylinders, false),
            kind(Role::PistonBoss, cylinders, false),
        ]
    }

    /// Strokes of a working cycle; `None` where they are neither 2 nor 4.
    pub(super) fn strokes(&self) -> Option<Strokes> {
        match self.value("engine.strokes")? {
            Value::Integer(2) => Some(Strokes::Two),
            Value::Integer(4) => Some(Strokes::Four),
            _ => None,
        }
    }

    fn whole_numbers(&self, path: &str) -> Option<Vec<usize>> {
        match self.value(path)? {
            Value::Integers(list) => list.iter().map(|n| usize::try_from(*n).ok()).collect(),
            _ => None,
        }
    }

    fn layout(&mut self) -> Option<EngineLayout> {
        let kind = self.layout_kind();
        let Value::Integer(cylinders) = self.value("engine.cylinders")? else {
            return None;
        };
        let cylinders = usize::try_from(cylinders).ok()?;
        let strokes = self.strokes();
        if strokes.is_none() && matches!(self.value("engine.strokes"), Some(Value::Integer(_))) {
            let error = self.error_at("engine.strokes", "an engine has two or four strokes");
            self.errors.push(error.allowing("2 or 4"));
        }
        let firing_order = self.firing_order(cylinders);
        let list = |path: &str| self.entry(path).map(|_| self.list(path));
        let plan = LayoutPlan {
            kind: kind?,
            cylinders,
            firing_order: firing_order?,
            firing_intervals: list("engine.firing_intervals"),
            throw_angles: list("engine.throw_angles"),
            cylinder_spacing: self.number("engine.cylinder_spacing")?,
            rod_offset: self.number("engine.rod_offset").unwrap_or(0.0),
            main_positions: list("engine.main_positions"),
            strokes: strokes?,
        };
        match EngineLayout::new(&plan) {
            Ok(layout) => Some(layout),
            Err(error) => {
                let error = self.layout_error(&plan, &error);
                self.errors.push(error);
                None
            }
        }
    }

    /// The layout with the keys that belong to it.
    fn layout_kind(&mut self) -> Option<LayoutKind> {
        let word = self.text("engine.layout")?;
        let own: &[&str] = match word.as_str() {
            "vee" => &["bank_angle", "rod_offset"],
            "boxer" => &["rod_offset"],
            _ => &[],
        };
        let article = if word == "inline" { "an" } else { "a" };
        let mut is_complete = true;
        for name in ["bank_angle", "rod_offset"] {
            let path = format!("engine.{name}");
            let is_given = self.entry(&path).is_some();
            if is_given && !own.contains(&name) {
                let message = format!("{article} {word} engine has no `{name}`");
                let error = self.error_at(&path, message);
                self.errors.push(error.hinting("take it out"));
            } else if !is_given && own.contains(&name) {
                let message = format!("{article} {word} engine needs `{name}`");
                let error = self.error_at("engine.layout", message).of_key(&path);
                let meaning = crate::input::schema::find(&path).map_or("", |key| key.meaning);
                self.errors.push(error.hinting(meaning));
                is_complete = false;
            }
        }
        if !is_complete {
            return None;
        }
        Some(match word.as_str() {
            "vee" => LayoutKind::Vee {
                bank_angle: self.number("engine.bank_angle")?,
            },
            "boxer" => LayoutKind::Boxer,
            _ => LayoutKind::Inline,
        })
    }

    fn firing_order(&mut self, cylinders: usize) -> Option<Vec<usize>> {
        const PATH: &str = "engine.firing_order";
        if self.entry(PATH).is_some() {
            return self.whole_numbers(PATH);
        }
        if cylinders == 1 {
            return Some(vec![1]);
        }
        let error = self.section_error("engine", "the firing order is missing");
        self.errors.push(
            error
                .of_key(PATH)
                .with_value("")
                .hinting(usual_orders(cylinders)),
        );
        None
    }

    /// What is wrong with a layout, at the key that says so.
    fn layout_error(&self, plan: &LayoutPlan, error: &LayoutError) -> InputError {
        let path = match error {
            LayoutError::Cylinders { .. } | LayoutError::NoSuchThrow { .. } => "engine.cylinders",
            LayoutError::FiringIntervals { .. } => "engine.firing_intervals",
            LayoutError::ThrowCount { .. } => "engine.throw_angles",
            LayoutError::NotAtTopDeadCentre { .. } if plan.firing_intervals.is_some() => {
                "engine.firing_intervals"
            }
            LayoutError::Dimension { what, .. } if what.contains("banks") => "engine.bank_angle",
            LayoutError::Dimension { what, .. } if what.contains("rods") => "engine.rod_offset",
            LayoutError::Dimension { .. } => "engine.cylinder_spacing",
            LayoutError::Mains { .. } if plan.main_positions.is_some() => "engine.main_positions",
            LayoutError::Mains { .. } => "engine.cylinder_spacing",
            _ => "engine.firing_order",
        };
        let refused = self.error_at(path, error.to_string());
        match error {
            LayoutError::FiringOrder { .. }
            | LayoutError::NotAtTopDeadCentre { .. }
            | LayoutError::NotOpposed { .. } => refused.hinting(usual_orders(plan.cylinders)),
            LayoutError::Mains { .. } => refused.hinting(
                "positions count from the first main bearing, half a cylinder spacing before the first throw",
            ),
            _ => refused,
        }
    }

    /// Dimensions and masses.
    fn crank_train(&mut self, layout: EngineLayout) -> Option<CrankTrain> {
        let number = |name: &str| self.number(&format!("engine.{name}"));
        let (bore, stroke) = (number("bore"), number("stroke"));
        let (rod_length, pin_offset) = (number("rod_length"), number("pin_offset"));
        let (piston_mass, crankcase) = (number("piston_mass"), number("crankcase_pressure"));
        let rod = match (
            number("rod_mass"),
            number("rod_centre_of_gravity"),
            number("rod_inertia"),
        ) {
            (Some(mass), Some(centre_of_gravity), Some(inertia)) => Some(Rod {
                mass,
                centre_of_gravity,
                inertia,
            }),
            _ => None,
        };
        let unbalances = self.unbalances(&layout);
        let train = CrankTrain {
            bore: bore?,
            crank_radius: 0.5 * stroke?,
            rod_length: rod_length?,
            pin_offset: pin_offset?,
            piston_mass: piston_mass?,
            rod: rod?,
            unbalances: unbalances?,
            crankcase_pressure: crankcase?,
            layout,
        };
        self.check_rod(&train).then_some(train)
    }

    /// Whether the rod reaches and can be one.
    fn check_rod(&mut self, train: &CrankTrain) -> bool {
        let reach = train.crank_radius + train.pin_offset.abs();
        let (length, rod) = (train.rod_length, &train.rod);
        if length <= reach {
            let with = match train.pin_offset {
                0.0 => String::new(),
                _ => " and pin offset".to_owned(),
            };
            let message = format!(
                "the rod does not reach over the crank: {} mm long, crank radius{with} {} mm",
                mm(length),
                mm(reach)
            );
            let error = self.error_at("engine.rod_length", message);
            self.errors.push(
                error
                    .allowing(format!("more than {} mm", mm(reach)))
                    .hinting("usual rods are 1.4 to 2.2 strokes long, between the centres of their bearings"),
            );
            return false;
        }
        let arm = rod.centre_of_gravity;
        if arm >= length {
            let error = self.error_at(
                "engine.rod_centre_of_gravity",
                "the centre of gravity of the rod lies beyond its small end",
            );
            self.errors
                .push(error.allowing(format!("less than its length, {} mm", mm(length))));
            return false;
        }
        let share = rod.inertia / (rod.mass * arm * (length - arm));
        if !USUAL_INERTIA.contains(&share) {
            let message = format!(
                "the inertia of the rod is {share:.2e} times that of two point masses in its ends"
            );
            let note = self.error_at("engine.rod_inertia", message).hinting(
                "usual are 0.8 to 1.2 times; is the unit right, and is it about the centre of gravity?",
            );
            self.warnings.push(note);
        }
        self.check_bores(train);
        true
    }

    /// Neighbouring cylinders of a bank lie apart by more than a bore.
    fn check_bores(&mut self, train: &CrankTrain) {
        let cylinders = &train.layout.cylinders;
        let overlaps = |a: &Cylinder, b: &Cylinder| {
            (a.bank_angle - b.bank_angle).abs() < 1e-6
                && (a.axial - b.axial).abs() < train.bore * (1.0 - 1e-9)
        };
        let pairs = cylinders.iter().enumerate().flat_map(|(at, a)| {
            let later = cylinders.iter().enumerate().skip(at + 1);
            later.map(move |(other, b)| (at, a, other, b))
        });
        let clash = pairs
            .filter(|(_, a, _, b)| overlaps(a, b))
            .map(|p| (p.0, p.2))
            .next();
        if let Some((a, b)) = clash {
            let message = format!("cylinders {} and {} run into each other", a + 1, b + 1);
            let error = self.error_at("engine.cylinder_spacing", message);
            self.errors
                .push(error.allowing(format!("more than the bore, {} mm", mm(train.bore))));
        }
    }

    /// What turns out of balance: of every throw, and one by one.
    fn unbalances(&mut self, layout: &EngineLayout) -> Option<Vec<Unbalance>> {
        const LIST: &str = "engine.unbalance";
        let mut found = Vec::new();
        let moment = |name: &str| self.number(&format!("engine.{name}")).unwrap_or(0.0);
        let towards = moment("throw_unbalance") - moment("counterweight");
        if towards != 0.0 {
            let turned = if towards > 0.0 { 0.0 } else { PI };
            found.extend(layout.throws.iter().map(|throw| Unbalance {
                axial: throw.axial,
                moment: towards.abs(),
                angle: throw.angle + turned,
            }));
        }
        let first = layout.throws.get(layout.cylinders.first()?.throw)?.angle;
        let list = self.reading.lists.get(LIST).cloned().unwrap_or_default();
        for (header, entries) in &list {
            let number =
                |name: &str| value_in(entries, &format!("{LIST}.{name}")).and_then(as_number);
            let throw = match value_in(entries, "engine.unbalance.throw") {
                Some(Value::Integer(number)) => Some(usize::try_from(number).unwrap_or(0)),
                _ => None,
            };
            let place = match (throw, number("position")) {
                (Some(number), None) => match layout.throws.get(number.wrapping_sub(1)) {
                    Some(Throw { angle, axial }) => Ok((*angle, *axial)),
                    None => Err((
                        "engine.unbalance.throw",
                        format!("there is no throw {number}"),
                    )),
                },
                (None, Some(axial)) => Ok((first, axial)),
                (Some(_), Some(_)) => Err((
                    "engine.unbalance.position",
                    "the unbalance has two places".to_owned(),
                )),
                (None, None) => Err((LIST, "the unbalance has no place".to_owned())),
            };
            match place {
                Ok((from, axial)) => {
                    let (Some(moment), Some(angle)) = (number("moment"), number("angle")) else {
                        continue;
                    };
                    found.push(Unbalance {
                        axial,
                        moment,
                        angle: from + angle,
                    });
                }
                Err((path, message)) => {
                    let span = entries.get(path).map_or(header, |entry| &entry.value_span);
                    let error = self.reading.error(span, message).of_key(path);
                    let throws = layout.throws.len();
                    self.errors
                        .push(error.allowing(format!("a throw from 1 to {throws}, or a position")));
                }
            }
        }
        Some(found)
    }

    fn pin_fit(&mut self) -> Option<PinFit> {
        const SHARE: &str = "engine.pin_speed_share";
        let fit = match self.text("engine.pin_fit")?.as_str() {
            "fixed-in-piston" => PinFit::FixedInPiston,
            "fixed-in-rod" => PinFit::FixedInRod,
            _ => PinFit::Floating,
        };
        let Some(share) = self.number(SHARE) else {
            return Some(fit);
        };
        if fit == PinFit::Floating {
            return Some(PinFit::Given(share));
        }
        let error = self.error_at(SHARE, "the speed of a pin that is held is not free");
        self.errors
            .push(error.hinting("take it out, or give pin_fit = \"floating\""));
        None
    }

    /// The bearings of the pin must go with the way it is held.
    fn check_pin(&mut self, fit: PinFit, bearings: &[CheckedBearing]) {
        let first = |role| bearings.iter().find(|bearing| bearing.role == role);
        let (rod, piston) = (first(Role::SmallEnd), first(Role::PistonBoss));
        let idle = match fit {
            PinFit::FixedInPiston => piston.map(|bearing| (bearing, "in the piston")),
            PinFit::FixedInRod => rod.map(|bearing| (bearing, "in the rod")),
            _ => None,
        };
        if let Some((bearing, held)) = idle {
            let message = format!("the pin is fixed {held}: it is no bearing there");
            let error = self.error_at("engine.pin_fit", message);
            let hint = format!("take the [[bearing]] of = \"{}\" out", bearing.role.name());
            self.errors.push(error.hinting(hint));
        }
        let (there, lacking) = match (rod, piston) {
            (Some(rod), None) => (rod, Role::PistonBoss),
            (None, Some(piston)) => (piston, Role::SmallEnd),
            _ => return,
        };
        if fit == PinFit::Floating {
            let message = format!(
                "the speed of a floating pin follows from the friction of both its bearings: the {} is missing",
                lacking.name()
            );
            let error = InputError {
                message,
                ..there.offset_error.clone()
            };
            let error = error.of_key("engine.pin_speed_share").with_value("");
            let hint = format!(
                "add [[bearing]] with of = \"{}\", or give pin_speed_share",
                lacking.name()
            );
            self.errors.push(error.hinting(hint));
        }
    }

    /// Mains and big ends fit beside each other.
    fn check_places(&mut self, layout: &EngineLayout, bearings: &[CheckedBearing]) {
        let axial = |bearing: &CheckedBearing| match bearing.role {
            Role::Main => layout.mains.get(bearing.index).copied(),
            Role::BigEnd => layout.cylinders.get(bearing.index).map(|c| c.axial),
            _ => None,
        };
        let places = bearings
            .iter()
            .filter_map(|bearing| Some(bearing.place(axial(bearing)?)));
        self.refuse_overlaps_along(places.collect());
    }
}

/// Firing orders that engines of so many cylinders have, as a hint.
fn usual_orders(cylinders: usize) -> &'static str {
    match cylinders {
        1 => "firing_order = [1]",
        2 => "usual: [1, 2]",
        3 => "usual: [1, 3, 2] inline",
        4 => "usual: [1, 3, 4, 2] inline; [1, 3, 2, 4] boxer",
        5 => "usual: [1, 2, 4, 5, 3] inline",
        6 => "usual: [1, 5, 3, 6, 2, 4] inline; [1, 4, 2, 5, 3, 6] V of 60 or 90 deg",
        8 => "usual: [1, 5, 4, 8, 6, 3, 7, 2] V of 90 deg with crossed throws",
        _ => "for example firing_order = [1, 5, 3, 6, 2, 4]: every cylinder once",
    }
}
