//! A general shaft with given loads.

use super::Checker;
use super::crankshaft::offsets;
use super::duty::round;
use super::grooves::mm;
use super::machine::Found;
use super::machine_bearings::{CheckedBearing, Kind};
use super::{as_number, as_text, value_in};
use crate::input::load_file::CycleSettings;
use crate::input::machine::{Machine, MachineBearing};
use crate::input::read::Entries;
use crate::input::values::Value;
use sommerfeld_bearing::CycleTilt;
use sommerfeld_engine::{Drilling, GeneralShaft, Role, ShaftLoad, ShaftSection, Unbalance};
use std::ops::Range;

const POSITIONS: &str = "shaft.bearing_positions";
const MODEL: &str = "shaft.model";
/// Share by which a journal may differ from the section it is part of before it is told.
const DIAMETER_SLACK: f64 = 0.02;

impl Checker<'_> {
    /// The shaft and its bearings.
    pub(super) fn shaft(&mut self) -> Option<Found> {
        let sections = self.sections();
        let length: f64 = sections.iter().map(|section| section.length).sum();
        let positions = self.bearing_positions(length);
        let kind = Kind {
            role: Role::Shaft,
            count: positions.as_ref().map_or(0, Vec::len),
            is_due: true,
        };
        let bearings = match kind.count {
            0 => Vec::new(),
            _ => self.machine_bearings(&[kind]),
        };
        let unbalances = self.shaft_unbalances(length);
        let loads = self.shaft_loads(length);
        let is_elastic = self.text(MODEL)? == "elastic";
        let mut is_right = true;
        if is_elastic {
            self.refuse_elastic_closed_form(MODEL);
        } else {
            is_right = !self.refuse_offsets(MODEL, &bearings);
        }
        let supports = self.supports("shaft", kind.count);
        let positions = positions?;
        let places = bearings
            .iter()
            .filter_map(|bearing| Some(bearing.place(*positions.get(bearing.index)?)));
        self.refuse_overlaps_along(places.collect());
        self.compare_diameters(&sections, &positions, &bearings);
        let number = |name: &str| self.number(&format!("shaft.{name}"));
        let shaft = GeneralShaft {
            youngs_modulus: number("youngs_modulus")?,
            poissons_ratio: number("poissons_ratio")?,
            density: number("density")?,
            gravity: self.pair("shaft.gravity").unwrap_or_default(),
            bearings: positions,
            unbalances: unbalances?,
            loads: loads?,
            period: number("period")?,
            is_elastic,
            supports: supports?,
            offsets: offsets(&bearings.iter().collect::<Vec<_>>()),
            sections,
        };
        let is_loaded =
            !shaft.unbalances.is_empty() || !shaft.loads.is_empty() || shaft.gravity != [0.0; 2];
        if !is_loaded {
            let error = self.section_error("shaft", "nothing loads the shaft");
            self.errors
                .push(error.hinting("give [[shaft.load]], [[shaft.unbalance]] or shaft.gravity"));
        }
        let bearings = bearings.into_iter().map(|bearing| MachineBearing {
            name: bearing.name(),
            role: bearing.role,
            index: bearing.index,
            drillings: bearing
                .drillings
                .iter()
                .filter_map(|keys| {
                    let [inlet_radius, outlet_radius] = keys.radii?;
                    Some(Drilling {
                        feed: keys.feed,
                        inlet_radius,
                        outlet_radius,
                        inlet: None,
                    })
                })
                .collect(),
            bearing: bearing.bearing,
            feed_pressures: bearing.feed_pressures,
        });
        let bearings = bearings.collect();
        is_right.then_some((Machine::Shaft(Box::new(shaft)), bearings))
    }

    fn sections(&mut self) -> Vec<ShaftSection> {
        const LIST: &str = "shaft.section";
        let list = self.reading.lists.get(LIST).cloned().unwrap_or_default();
        if list.is_empty() && self.entry(LIST).is_none() {
            let error = self.section_error("shaft", "the sections of the shaft are missing");
            self.errors.push(
                error.of_key(LIST).with_value("").hinting(
                    "add [[shaft.section]] with length and diameter, from the free end on",
                ),
            );
        }
        let mut sections = Vec::new();
        for (header, entries) in &list {
            let number =
                |name: &str| value_in(entries, &format!("{LIST}.{name}")).and_then(as_number);
            let (Some(length), Some(diameter), Some(bore_diameter)) = (
                number("length"),
                number("diameter"),
                number("bore_diameter"),
            ) else {
                continue;
            };
            if bore_diameter >= diameter {
                let path = "shaft.section.bore_diameter";
                let span = entries.get(path).map_or(header, |entry| &entry.value_span);
                let error = self
                    .reading
                    .error(span, "the bore leaves nothing of the section");
                let allowed = format!("less than its diameter, {} mm", mm(diameter));
                self.errors.push(error.of_key(path).allowing(allowed));
            }
            sections.push(ShaftSection {
                length,
                diameter,
                bore_diameter,
            });
        }
        sections
    }

    /// Two bearings or more, ascending, on the shaft.
    fn bearing_positions(&mut self, length: f64) -> Option<Vec<f64>> {
        self.entry(POSITIONS)?;
        let positions = self.list(POSITIONS);
        let message = if positions.len() < 2 {
            "a shaft needs two bearings or more".to_owned()
        } else if let Some(pair) = positions.windows(2).find(|pair| pair[1] <= pair[0]) {
            format!(
                "the positions do not ascend: {} mm, then {} mm",
                mm(pair[0]),
                mm(pair[1])
            )
        } else if let Some(off) = positions.iter().find(|at| length > 0.0 && **at > length) {
            format!("a bearing at {} mm is not on the shaft", mm(*off))
        } else {
            return Some(positions);
        };
        let error = self.error_at(POSITIONS, message);
        let allowed = format!("ascending, 0 mm to {} mm", mm(length));
        self.errors.push(error.allowing(allowed));
        None
    }

    /// Position of an element of a list, on the shaft.
    fn position(
        &mut self,
        (header, entries): &(Range<usize>, Entries),
        path: &str,
        length: f64,
    ) -> Option<f64> {
        let position = value_in(entries, path).and_then(as_number)?;
        if length == 0.0 || position <= length * (1.0 + 1e-12) {
            return Some(position);
        }
        let span = entries.get(path).map_or(header, |entry| &entry.value_span);
        let message = format!("{} mm is not on the shaft", mm(position));
        let error = self.reading.error(span, message).of_key(path);
        let allowed = format!("0 mm to {} mm, the length of its sections", mm(length));
        self.errors.push(error.allowing(allowed));
        None
    }

    fn shaft_unbalances(&mut self, length: f64) -> Option<Vec<Unbalance>> {
        const LIST: &str = "shaft.unbalance";
        let list = self.reading.lists.get(LIST).cloned().unwrap_or_default();
        let found: Vec<Unbalance> = list
            .iter()
            .filter_map(|element| {
                let axial = self.position(element, "shaft.unbalance.position", length)?;
                let number = |name: &str| {
                    value_in(&element.1, &format!("{LIST}.{name}")).and_then(as_number)
                };
                Some(Unbalance {
                    axial,
                    moment: number("moment")?,
                    angle: number("angle")?,
                })
            })
            .collect();
        (found.len() == list.len()).then_some(found)
    }

    fn shaft_loads(&mut self, length: f64) -> Option<Vec<ShaftLoad>> {
        const LIST: &str = "shaft.load";
        let list = self.reading.lists.get(LIST).cloned().unwrap_or_default();
        let found: Vec<ShaftLoad> = list
            .iter()
            .filter_map(|element| {
                let axial = self.position(element, "shaft.load.position", length);
                let points = self.load_points(element);
                Some(ShaftLoad {
                    axial: axial?,
                    points: points?,
                })
            })
            .collect();
        (found.len() == list.len()).then_some(found)
    }

    /// Force over the angle: constant, or from a file.
    fn load_points(
        &mut self,
        (header, entries): &(Range<usize>, Entries),
    ) -> Option<Vec<[f64; 3]>> {
        const FORCE: &str = "shaft.load.force";
        const FILE: &str = "shaft.load.file";
        let period = self.period()?;
        let force = match value_in(entries, FORCE) {
            Some(Value::Pair(force)) => Some(force),
            _ => None,
        };
        let file = value_in(entries, FILE).and_then(as_text);
        let span = |path: &str| entries.get(path).map_or(header, |entry| &entry.value_span);
        match (force, file) {
            (Some([x, y]), None) => Some(vec![[0.0, x, y], [0.5 * period, x, y]]),
            (None, Some(name)) => {
                let named_at = self.reading.error(span(FILE), "").of_key(FILE);
                let settings = CycleSettings {
                    engine_speed: 1.0,
                    period,
                    journal_mass: 0.0,
                };
                let table = self.load_table(&name, &settings, named_at.clone())?;
                self.warnings.extend(table.warnings);
                if table.cycle.tilt != CycleTilt::Aligned {
                    let mut error = named_at;
                    error.message = "the load of a shaft has no moments or tilts".to_owned();
                    self.errors
                        .push(error.allowing("crank_angle[deg],load_x[N],load_y[N]"));
                    return None;
                }
                let points = table.cycle.points.iter();
                Some(
                    points
                        .map(|point| [point.crank_angle, point.load[0], point.load[1]])
                        .collect(),
                )
            }
            (Some(_), Some(_)) => {
                let error = self.reading.error(span(FILE), "the load is given twice");
                self.errors
                    .push(error.of_key(FILE).allowing("force or file"));
                None
            }
            (None, None) => {
                if !entries.contains_key(FORCE) && !entries.contains_key(FILE) {
                    let error = self.reading.error(header, "the load has no force");
                    self.errors
                        .push(error.of_key(FORCE).with_value("").allowing("force or file"));
                }
                None
            }
        }
    }

    /// The journal of a bearing is part of a section: a warning where their diameters differ.
    fn compare_diameters(
        &mut self,
        sections: &[ShaftSection],
        positions: &[f64],
        bearings: &[CheckedBearing],
    ) {
        for bearing in bearings {
            let Some(at) = positions.get(bearing.index) else {
                continue;
            };
            let mut end = 0.0;
            let section = sections.iter().find(|section| {
                end += section.length;
                *at <= end
            });
            let Some(section) = section else { continue };
            let journal = bearing.bearing.diameter - 2.0 * bearing.bearing.radial_clearance;
            if (section.diameter / journal - 1.0).abs() > DIAMETER_SLACK {
                let message = format!(
                    "the journal of {} has {} mm, the section of the shaft there {} mm",
                    bearing.name(),
                    round(1e3 * journal),
                    mm(section.diameter)
                );
                let note = self.error_at(POSITIONS, message);
                self.warnings
                    .push(note.hinting("give the shaft a section for its journal"));
            }
        }
    }
}
