//! Grooves and holes: do they fit the bearing, and what supplies them?

use super::{Checker, NamedTable, as_number, as_text, value_in};
use crate::input::error::InputError;
use crate::input::load_file::{PressureTable, read_pressure_table};
use crate::input::read::{Entries, MOST_ERRORS};
use crate::input::schema::{Mode, find};
use crate::input::values::Value;
use sommerfeld_bearing::PressureCycle;
use sommerfeld_film::supply::drilling_head;
use sommerfeld_film::{Bearing, Carrier, Feed, FeedLine, FeedShape};
use std::f64::consts::PI;
use std::ops::Range;

const PRESSURE: &str = "bearing.groove.pressure";
const PRESSURE_FILE: &str = "bearing.groove.pressure_file";
const LINE_RESISTANCE: &str = "bearing.groove.line_resistance";
const INLET_RADIUS: &str = "bearing.groove.drilling_inlet_radius";
const FED_BY: &str = "bearing.groove.fed_by";
const INLET_ANGLE: &str = "bearing.groove.drilling_inlet_angle";
const INLET_DIAMETER: &str = "bearing.groove.drilling_inlet_diameter";
const OUTLET_RADIUS: &str = "bearing.groove.drilling_outlet_radius";

impl Checker<'_> {
    /// The feeds of the bearing; their pressures over the crank angle go to `feed_cycles`.
    pub(super) fn feeds(&mut self, bearing: &Bearing) -> Vec<Feed> {
        let mut feeds = Vec::new();
        let (mut errors, mut warnings) = (Vec::new(), Vec::new());
        let (mut cycles, mut read) = (Vec::new(), Vec::new());
        let mut drillings = Vec::new();
        for (header, entries) in &self.reading.grooves {
            if errors.len() >= MOST_ERRORS {
                break;
            }
            let groove = GrooveCheck {
                checker: self,
                header,
                entries,
                bearing,
            };
            match groove.feed() {
                Ok((feed, supply, drilling)) => {
                    drillings.extend(drilling.map(|drilling| DrillingKeys {
                        feed: feeds.len(),
                        ..drilling
                    }));
                    warnings.extend(groove.turning(&feed));
                    errors.extend(groove.clash(&feed, &feeds));
                    if let Supply::Table { table, from } = supply {
                        cycles.push(PressureCycle {
                            feed: feeds.len(),
                            points: table.points,
                        });
                        read.push(from);
                        warnings.extend(table.warnings);
                    }
                    feeds.push(feed);
                }
                Err(error) => errors.extend(error),
            }
        }
        self.feed_cycles = cycles;
        self.drillings = drillings;
        read.iter().for_each(|table| self.take_in(table));
        self.errors.extend(errors);
        self.warnings.extend(warnings);
        feeds
    }
}

/// A drilling in the crank of a machine, as given.
#[derive(Debug, Clone)]
pub(super) struct DrillingKeys {
    /// Index of the hole among the feeds.
    pub(super) feed: usize,
    /// Radii of inlet and outlet, m, where they are given.
    pub(super) radii: Option<[f64; 2]>,
    /// The main bearing that feeds it.
    pub(super) fed_by: Option<FedBy>,
    /// An error at the key that is about the drilling.
    pub(super) place: InputError,
}

/// Where a drilling takes its oil, as given.
#[derive(Debug, Clone)]
pub(super) struct FedBy {
    /// Number of the main bearing, from 1: one for all cylinders, or one for each.
    pub(super) mains: Vec<usize>,
    /// Angle of the inlet from the crank arm, rad.
    pub(super) inlet_angle: Option<f64>,
    /// Diameter of the inlet, m; that of the hole where none is given.
    pub(super) inlet_diameter: Option<f64>,
}

/// One `[[bearing.groove]]` being checked.
struct GrooveCheck<'c, 't> {
    checker: &'c Checker<'t>,
    header: &'c Range<usize>,
    entries: &'c Entries,
    bearing: &'c Bearing,
}

/// What is wrong with a groove; empty where it was reported when it was read.
type Refused = Vec<InputError>;

/// What supplies a groove, the head of its drilling not yet added.
enum Supply {
    /// Pa.
    Constant(f64),
    /// Over the crank angle, with the file it was read from.
    Table {
        table: PressureTable,
        from: NamedTable,
    },
}

impl GrooveCheck<'_, '_> {
    fn is_given(&self, path: &str) -> bool {
        self.entries.contains_key(path)
    }

    fn number(&self, path: &str) -> Result<f64, Refused> {
        value_in(self.entries, path)
            .and_then(as_number)
            .ok_or_else(Vec::new)
    }

    fn text(&self, path: &str) -> Result<String, Refused> {
        value_in(self.entries, path)
            .and_then(as_text)
            .ok_or_else(Vec::new)
    }

    /// An error at a value of this groove, or at its header.
    fn error(&self, path: &str, message: impl Into<String>) -> InputError {
        let span = self
            .entries
            .get(path)
            .map_or(self.header, |entry| &entry.value_span);
        self.checker.reading.error(span, message).of_key(path)
    }

    fn feed(&self) -> Result<(Feed, Supply, Option<DrillingKeys>), Refused> {
        // What is wrong with the one is told beside what is wrong with the other.
        let (mut feed, mut supply) = match (self.outline(), self.supply()) {
            (Ok(feed), Ok(supply)) => (feed, supply),
            (feed, supply) => {
                let errors = feed.err().into_iter().chain(supply.err());
                return Err(errors.flatten().collect());
            }
        };
        let radii = self.radii(&feed)?;
        let drilling = self.drilling(&feed, radii)?;
        if drilling.as_ref().is_some_and(|d| d.fed_by.is_some()) {
            // Its pressure is found when the main bearings are known.
            feed.pressure = self.bearing.ambient_pressure;
            return Ok((feed, supply, drilling));
        }
        let head = self.head(radii)?;
        feed.pressure = self.raise(&mut supply, head)?;
        Ok((feed, supply, drilling))
    }

    /// The drilling of a machine, whose head changes with the speed.
    fn drilling(
        &self,
        feed: &Feed,
        radii: Option<[f64; 2]>,
    ) -> Result<Option<DrillingKeys>, Refused> {
        let with_main = [INLET_ANGLE, INLET_DIAMETER];
        let lone = with_main.into_iter().find(|path| self.is_given(path));
        if let Some(path) = lone.filter(|_| !self.is_given(FED_BY)) {
            let error = self.error(
                path,
                "the inlet belongs to a drilling that a main bearing feeds",
            );
            return Err(vec![error.allowing("with fed_by")]);
        }
        let Some(Value::Integers(mains)) = value_in(self.entries, FED_BY) else {
            let place = self.error(OUTLET_RADIUS, "");
            let drilling = radii.map(|radii| DrillingKeys {
                feed: 0,
                radii: Some(radii),
                fed_by: None,
                place,
            });
            return Ok(drilling.filter(|_| self.checker.mode.is_machine()));
        };
        let refuse =
            |message: &str, allowed: &str| Err(vec![self.error(FED_BY, message).allowing(allowed)]);
        if self.checker.mode != Mode::Engine {
            return refuse(
                "only the hole in the pin of an engine is fed by a main bearing",
                "pressure or pressure_file",
            );
        }
        if feed.carried_by == Carrier::Shell {
            let message = "a drilling in the crank feeds the journal, not the shell";
            return refuse(message, "carried_by = \"journal\"");
        }
        if radii.is_some() {
            let message = "the radii of a drilling from a main bearing follow from the crank";
            return refuse(message, "fed_by, or the two radii with pressure");
        }
        Ok(Some(DrillingKeys {
            feed: 0,
            radii: None,
            fed_by: Some(FedBy {
                mains: mains
                    .iter()
                    .map(|n| usize::try_from(*n).unwrap_or(0))
                    .collect(),
                inlet_angle: self.number(INLET_ANGLE).ok(),
                inlet_diameter: self.number(INLET_DIAMETER).ok(),
            }),
            place: self.error(FED_BY, ""),
        }))
    }

    /// The feed but for its pressure.
    fn outline(&self) -> Result<Feed, Refused> {
        let kind = self.text("bearing.groove.kind")?;
        self.check_keys(&kind)?;
        let shape = self.shape(&kind)?;
        let feed = Feed {
            shape,
            carried_by: match self.text("bearing.groove.carried_by")?.as_str() {
                "journal" => Carrier::Journal,
                _ => Carrier::Shell,
            },
            angle: match shape {
                FeedShape::Circumferential { .. } => 0.0,
                _ => self.number("bearing.groove.angle")?,
            },
            position: self.number("bearing.groove.position")?,
            pressure: 0.0,
            line: self.line()?,
        };
        let errors = self.misfits(&feed);
        if errors.is_empty() {
            Ok(feed)
        } else {
            Err(errors)
        }
    }

    /// Each kind has its own keys: those it lacks and those it has no use for.
    fn check_keys(&self, kind: &str) -> Result<(), Refused> {
        let own: &[&str] = match kind {
            "hole" => &["angle", "diameter"],
            "circumferential" => &["width"],
            _ => &["angle", "length", "width"],
        };
        let mut errors = Vec::new();
        for name in ["angle", "diameter", "length", "width"] {
            let path = format!("bearing.groove.{name}");
            let is_given = self.is_given(path.as_str());
            if own.contains(&name) && !is_given {
                let error = self.error(
                    "bearing.groove.kind",
                    format!("a groove of kind {kind} needs `{name}`"),
                );
                errors.push(error.of_key(&path).allowing(own.join(", ")));
            }
            if is_given && !own.contains(&name) {
                let message = format!("a groove of kind {kind} has no `{name}`");
                errors.push(self.error(&path, message).allowing(own.join(", ")));
            }
        }
        if errors.is_empty() {
            Ok(())
        } else {
            Err(errors)
        }
    }

    fn shape(&self, kind: &str) -> Result<FeedShape, Refused> {
        Ok(match kind {
            "hole" => FeedShape::Hole {
                diameter: self.number("bearing.groove.diameter")?,
            },
            "circumferential" => FeedShape::Circumferential {
                width: self.number("bearing.groove.width")?,
            },
            _ => FeedShape::Rectangle {
                length: self.number("bearing.groove.length")?,
                width: self.number("bearing.groove.width")?,
            },
        })
    }

    fn line(&self) -> Result<FeedLine, Refused> {
        if !self.is_given(LINE_RESISTANCE) {
            return Ok(FeedLine::Direct);
        }
        let resistance = self.number(LINE_RESISTANCE)?;
        Ok(FeedLine::Resistive { resistance })
    }

    /// Pressure or pressure table, whichever is given.
    fn supply(&self) -> Result<Supply, Refused> {
        let error = match (self.is_given(PRESSURE), self.is_given(PRESSURE_FILE)) {
            (false, false) if self.is_given(FED_BY) => {
                return Ok(Supply::Constant(self.bearing.ambient_pressure));
            }
            (true, _) | (_, true) if self.is_given(FED_BY) => self
                .error(FED_BY, "the supply pressure is given twice")
                .allowing("fed_by, pressure or pressure_file"),
            (true, false) => return Ok(Supply::Constant(self.number(PRESSURE)?)),
            (false, true) if self.checker.mode.is_cyclic() => return self.table(),
            (false, true) => self
                .error(
                    PRESSURE_FILE,
                    "only the analysis \"load-cycle\" has a pressure over the crank angle",
                )
                .allowing("pressure"),
            (true, true) => self
                .error(PRESSURE_FILE, "the supply pressure is given twice")
                .allowing("pressure or pressure_file"),
            (false, false) => {
                let misspelt = [PRESSURE, PRESSURE_FILE].into_iter().filter_map(find);
                if misspelt
                    .into_iter()
                    .any(|key| self.checker.was_misspelt(key))
                {
                    return Err(Vec::new());
                }
                self.error(PRESSURE, "the supply pressure of the groove is missing")
                    .with_value("")
                    .allowing("pressure or pressure_file")
                    .hinting("for example pressure = \"1 bar\"")
            }
        };
        Err(vec![error])
    }

    /// The pressure table beside the study.
    fn table(&self) -> Result<Supply, Refused> {
        let period = self.checker.period().ok_or_else(Vec::new)?;
        let named_at = self.error(PRESSURE_FILE, "");
        let name = self.text(PRESSURE_FILE)?;
        let from = self.checker.named_table(&name, "pressure table", named_at);
        let from = from.map_err(|error| vec![*error])?;
        let table = read_pressure_table(&from.file, &from.text, period)?;
        Ok(Supply::Table { table, from })
    }

    /// Radii of inlet and outlet of the drilling in the crank, m, if they are given.
    fn radii(&self, feed: &Feed) -> Result<Option<[f64; 2]>, Refused> {
        let (inlet, outlet) = (INLET_RADIUS, OUTLET_RADIUS);
        let given = [inlet, outlet].map(|path| self.is_given(path));
        if given == [false, false] {
            return Ok(None);
        }
        let [here, lacking] = if given[0] {
            [inlet, outlet]
        } else {
            [outlet, inlet]
        };
        if given != [true, true] {
            let error = self.error(here, "the drilling has only one of its two radii");
            let allowed = "drilling_inlet_radius and drilling_outlet_radius, or neither";
            return Err(vec![error.of_key(lacking).allowing(allowed)]);
        }
        if feed.carried_by == Carrier::Shell {
            let error = self
                .error(
                    here,
                    "a drilling in the crank feeds the journal, not the shell",
                )
                .allowing("carried_by = \"journal\"");
            return Err(vec![error]);
        }
        Ok(Some([self.number(inlet)?, self.number(outlet)?]))
    }

    /// What the drilling in the crank adds to the supply pressure, Pa; a machine adds it speed by speed.
    fn head(&self, radii: Option<[f64; 2]>) -> Result<f64, Refused> {
        let checker = self.checker;
        let Some([inlet, outlet]) = radii.filter(|_| !checker.mode.is_machine()) else {
            return Ok(0.0);
        };
        let density = match checker.value("oil.density") {
            Some(Value::Number(density)) => Some(density),
            _ => checker.number("oil.density.value"),
        };
        let speed = match checker.mode {
            Mode::LoadCycle => checker.number("load_cycle.engine_speed"),
            _ => checker.number("operation.speed"),
        };
        let (density, speed) = density.zip(speed).ok_or_else(Vec::new)?;
        Ok(drilling_head(density, speed, inlet, outlet))
    }

    /// Adds the head to the supply; returns its mean, Pa.
    fn raise(&self, supply: &mut Supply, head: f64) -> Result<f64, Refused> {
        let (path, lowest, mean) = match supply {
            Supply::Constant(pressure) => (PRESSURE, *pressure + head, *pressure + head),
            Supply::Table { table, .. } => {
                for point in &mut table.points {
                    point[1] += head;
                }
                let lowest = table.points.iter().map(|p| p[1]);
                let cycle = PressureCycle {
                    feed: 0,
                    points: table.points.clone(),
                };
                let period = self.checker.period();
                (
                    PRESSURE_FILE,
                    lowest.fold(f64::INFINITY, f64::min),
                    cycle.mean(period.ok_or_else(Vec::new)?),
                )
            }
        };
        if lowest >= self.bearing.cavitation_pressure {
            return Ok(mean);
        }
        let error = if head == 0.0 {
            self.error(path, "the feed pressure is below the cavitation pressure")
        } else {
            let message = format!(
                "with the head of its drilling, {} bar, the feed pressure is below the cavitation \
                 pressure",
                round(head * 1e-5)
            );
            self.error(path, message)
        };
        let allowed = round(self.bearing.cavitation_pressure * 1e-5);
        Err(vec![error.allowing(format!("at least {allowed} bar"))])
    }

    /// Where the groove does not fit the bearing.
    fn misfits(&self, feed: &Feed) -> Vec<InputError> {
        let mut errors = Vec::new();
        let bearing = self.bearing;
        let limit = format!("less than the bearing width, {} mm", mm(bearing.width));
        let extent = match feed.shape {
            FeedShape::Hole { diameter } => {
                if diameter >= bearing.width.min(bearing.diameter) {
                    let error = self.error(
                        "bearing.groove.diameter",
                        "the hole is wider than the bearing",
                    );
                    errors.push(error.allowing(limit));
                }
                diameter
            }
            FeedShape::Rectangle { length, width } => {
                if length >= PI * bearing.diameter {
                    let error = self.error(
                        "bearing.groove.length",
                        "the groove is longer than the circumference",
                    );
                    errors.push(error.hinting("kind = \"circumferential\" runs all around"));
                }
                if width > bearing.width {
                    let error = self.error(
                        "bearing.groove.width",
                        "the groove is wider than the bearing",
                    );
                    errors.push(error.allowing(format!("at most {} mm", mm(bearing.width))));
                }
                width
            }
            FeedShape::Circumferential { width } => {
                if width >= bearing.width {
                    let error = self.error(
                        "bearing.groove.width",
                        "the groove leaves no bearing surface",
                    );
                    errors.push(error.allowing(limit));
                }
                width
            }
        };
        if errors.is_empty() {
            errors.extend(self.overhang(feed, extent));
        }
        errors
    }

    /// A groove that lies beyond an edge of the bearing, in part or as a whole.
    fn overhang(&self, feed: &Feed, extent: f64) -> Option<InputError> {
        let edge = 0.5 * self.bearing.width;
        let (from, to) = (feed.position - 0.5 * extent, feed.position + 0.5 * extent);
        // A groove up to the edge fits, whatever round-off makes of it.
        if from.abs().max(to.abs()) <= edge * (1.0 + 1e-9) {
            return None;
        }
        let message = if from >= edge || to <= -edge {
            "the groove lies wholly outside the bearing".to_owned()
        } else {
            format!(
                "the groove reaches from {} mm to {} mm, over the edge of the bearing at {} mm",
                mm(from),
                mm(to),
                mm(if to > edge { edge } else { -edge }),
            )
        };
        let room = mm(edge - 0.5 * extent);
        let allowed = format!("a position from {} mm to {room} mm", 0.0 - room);
        let error = self.error("bearing.groove.position", message);
        Some(error.allowing(allowed))
    }

    /// Grooves that open into one another hold one pressure: two that their supply holds at
    /// different ones cannot be.
    fn clash(&self, feed: &Feed, others: &[Feed]) -> Option<InputError> {
        let clashing = |other: &Feed| {
            let are_held = feed.line == FeedLine::Direct && other.line == FeedLine::Direct;
            are_held
                && feed.carried_by == other.carried_by
                && feed.pressure != other.pressure
                && overlap(feed, other, self.bearing.radius())
        };
        let at = others.iter().position(clashing)?;
        let message = format!(
            "the groove opens into groove {} of the file, at {} bar, and this one is at {} bar",
            at + 1,
            round(others[at].pressure * 1e-5),
            round(feed.pressure * 1e-5)
        );
        let error = self.error(PRESSURE, message);
        Some(error.hinting(
            "give both the same pressure, move one, or give their lines a line_resistance",
        ))
    }

    /// A steady film under a hole that turns is that of one instant.
    fn turning(&self, feed: &Feed) -> Option<InputError> {
        let is_turning = feed.carried_by == Carrier::Journal
            && !matches!(feed.shape, FeedShape::Circumferential { .. })
            && !self.checker.mode.is_cyclic()
            && self.checker.number("operation.speed") != Some(0.0);
        is_turning.then(|| {
            let message = "the groove turns with the journal; the steady film is that of the \
                           instant at which it stands at its angle";
            self.error("bearing.groove.carried_by", message)
                .hinting("analysis = \"load-cycle\" follows it around")
        })
    }
}

/// Whether two feeds of one carrier share some of its surface of this radius, m.
fn overlap(a: &Feed, b: &Feed, radius: f64) -> bool {
    // A rectangle with half sides [around, axial] and round corners: a hole is all corner.
    let core = |feed: &Feed| match feed.shape {
        FeedShape::Hole { diameter } => ([0.0, 0.0], 0.5 * diameter),
        FeedShape::Rectangle { length, width } => ([0.5 * length, 0.5 * width], 0.0),
        FeedShape::Circumferential { width } => ([PI * radius, 0.5 * width], 0.0),
    };
    let ((sides_a, round_a), (sides_b, round_b)) = (core(a), core(b));
    let turn = (a.angle - b.angle).rem_euclid(2.0 * PI);
    let apart = [
        radius * turn.min(2.0 * PI - turn) - sides_a[0] - sides_b[0],
        (a.position - b.position).abs() - sides_a[1] - sides_b[1],
    ];
    let between = apart[0].max(0.0).hypot(apart[1].max(0.0));
    // Edges that touch share nothing, whatever round-off makes of them.
    let slack = 1e-9 * radius;
    match round_a + round_b {
        0.0 => apart[0].max(apart[1]) < -slack,
        corners => between < corners - slack,
    }
}

/// Metres as millimetres for messages, without round-off tails.
pub(super) fn mm(metres: f64) -> f64 {
    (metres * 1e9).round() / 1e6
}

/// A number as it is shown in messages.
fn round(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}
