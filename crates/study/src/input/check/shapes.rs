//! Profiles of bore and journal.

use super::grooves::mm;
use super::{Checker, as_number, value_in};
use crate::input::error::InputError;
use crate::input::profile_file::read_profile;
use crate::input::schema::Mode;
use crate::input::study::FilmModel;
use crate::input::values::Value;
use sommerfeld_film::shape::arc_shift;
use sommerfeld_film::{Bearing, Feature, Inlet, JournalState, ReliefForm, Shape};
use std::f64::consts::{FRAC_PI_2, PI};

/// One of the two surfaces.
#[derive(Clone, Copy, PartialEq)]
enum Surface {
    Bore,
    Journal,
}

impl Surface {
    /// Its section of the study file.
    const fn section(self) -> &'static str {
        match self {
            Self::Bore => "bearing.bore",
            Self::Journal => "bearing.journal",
        }
    }

    /// Sign of an offset outward that widens the gap.
    const fn widening(self) -> f64 {
        match self {
            Self::Bore => 1.0,
            Self::Journal => -1.0,
        }
    }
}

impl Checker<'_> {
    /// Shapes of bore and journal.
    pub(super) fn shapes(&mut self, bearing: &Bearing) -> Option<(Shape, Shape)> {
        let bore = self.shape(Surface::Bore, bearing);
        let journal = self.shape(Surface::Journal, bearing);
        Some((bore?, journal?))
    }

    fn shape(&mut self, surface: Surface, bearing: &Bearing) -> Option<Shape> {
        let section = surface.section();
        if self.entry(section).is_none() {
            return Some(Shape::cylindrical());
        }
        let errors = self.errors.len();
        let path = |name: &str| format!("{section}.{name}");
        let mut features = Vec::new();
        features.extend(self.form(surface, bearing));
        if let Some(depth) = self.number(&path("crowning")) {
            features.push(Feature::Crowning {
                end_offset: surface.widening() * depth,
                half_width: 0.5 * bearing.width,
            });
        }
        if self.entry(&path("relief")).is_some() {
            features.extend(self.end_reliefs(surface, bearing).into_iter().flatten());
        }
        if surface == Surface::Bore && self.entry("bearing.bore.crush_relief").is_some() {
            features.extend(self.crush_reliefs(bearing).into_iter().flatten());
        }
        features.extend(self.harmonics(&path("harmonic")));
        // Every value is there or an error says why not.
        (self.errors.len() == errors).then(|| Shape::of(features))
    }

    /// What `kind` says, with its keys: those it lacks and those it has no use for.
    fn form(&mut self, surface: Surface, bearing: &Bearing) -> Option<Feature> {
        let section = surface.section();
        let path = |name: &str| format!("{section}.{name}");
        let kind = self.text(&path("kind"))?;
        let own: &[&str] = match kind.as_str() {
            "lemon" | "offset" => &["preload", "joint_angle"],
            "table" => &["file"],
            _ => &[],
        };
        for name in ["preload", "file"] {
            let is_given = self.entry(&path(name)).is_some();
            if own.contains(&name) && !is_given {
                let message = format!("a {} of kind {kind} needs `{name}`", &section[8..]);
                let error = self.error_at(&path("kind"), message);
                self.errors.push(error.of_key(&path(name)));
            } else if is_given && !own.contains(&name) {
                let message = format!("a {} of kind {kind} has no `{name}`", &section[8..]);
                let error = self.error_at(&path(name), message);
                self.errors
                    .push(error.hinting("take it out, or give the kind it belongs to"));
            }
        }
        let has_joint =
            own.contains(&"joint_angle") || self.entry("bearing.bore.crush_relief").is_some();
        if self.entry(&path("joint_angle")).is_some() && !has_joint {
            let message = "nothing here has a joint: `joint_angle` belongs to lemon, offset and \
                           crush_relief";
            let error = self.error_at(&path("joint_angle"), message);
            self.errors.push(error.hinting("take it out"));
        }
        let shift = |checker: &Self| {
            let preload = checker.number(&path("preload"))?;
            Some(arc_shift(bearing.radial_clearance, preload))
        };
        match kind.as_str() {
            "lemon" => Some(Feature::Lemon {
                shift: shift(self)?,
                joint: self.number(&path("joint_angle"))?,
            }),
            "offset" => Some(Feature::OffsetHalves {
                shift: shift(self)?,
                joint: self.number(&path("joint_angle"))?,
            }),
            "table" => self.profile(&path("file"), bearing),
            _ => None,
        }
    }

    /// The profile of the file that the key names.
    fn profile(&mut self, key: &str, bearing: &Bearing) -> Option<Feature> {
        let name = self.text(key)?;
        let named_at = self.error_at(key, "");
        let source = self.table_text(&name, "profile", named_at)?;
        // No text holds this byte: a row that moves from one table to the next changes the hash.
        self.table_bytes.push(0xff);
        let table = match read_profile(&source.file, &source.text) {
            Ok(table) => table,
            Err(errors) => {
                self.errors.extend(errors);
                return None;
            }
        };
        let [first, last] = table.span();
        let half = 0.5 * bearing.width;
        if first < last && (first > -half * (1.0 - 1e-9) || last < half * (1.0 - 1e-9)) {
            let message = format!(
                "the profile covers the positions {} to {} mm only",
                mm(first),
                mm(last)
            );
            let error = self.error_at(key, message);
            let width = format!("the whole bearing, {} to {} mm", mm(-half), mm(half));
            self.errors.push(error.allowing(width));
            return None;
        }
        Some(Feature::Table(table))
    }

    fn end_reliefs(&mut self, surface: Surface, bearing: &Bearing) -> Option<Vec<Feature>> {
        let section = surface.section();
        let path = |name: &str| format!("{section}.relief.{name}");
        let (depth, length) = (self.number(&path("depth"))?, self.number(&path("length"))?);
        let form = match self.text(&path("form"))?.as_str() {
            "circular" => ReliefForm::Circular,
            _ => ReliefForm::Linear,
        };
        let half = 0.5 * bearing.width;
        let (ends, longest): (&[f64], f64) = match self.text(&path("ends"))?.as_str() {
            "front" => (&[-1.0], bearing.width),
            "rear" => (&[1.0], bearing.width),
            _ => (&[-1.0, 1.0], half),
        };
        if length > longest * (1.0 + 1e-12) {
            let error = self.error_at(
                &path("length"),
                "the relief is longer than the bearing has room",
            );
            let most = format!("at most {} mm", mm(longest));
            self.errors.push(error.allowing(most));
            return None;
        }
        let relief = |end: &f64| Feature::EndRelief {
            end: end * half,
            length,
            end_offset: surface.widening() * depth,
            form,
        };
        Some(ends.iter().map(relief).collect())
    }

    fn crush_reliefs(&mut self, bearing: &Bearing) -> Option<[Feature; 2]> {
        const LENGTH: &str = "bearing.bore.crush_relief.length";
        let depth = self.number("bearing.bore.crush_relief.depth")?;
        let half_span = self.number(LENGTH)? / bearing.radius();
        let joint = self.number("bearing.bore.joint_angle")?;
        if half_span >= FRAC_PI_2 {
            let error = self.error_at(LENGTH, "the reliefs of both joints meet");
            let most = mm(FRAC_PI_2 * bearing.radius());
            let allowed = format!("less than a quarter of the circumference, {most} mm");
            self.errors.push(error.allowing(allowed));
            return None;
        }
        Some([joint, joint + PI].map(|joint| Feature::JointRelief {
            offset: depth,
            half_span,
            joint,
        }))
    }

    fn harmonics(&self, section: &str) -> Vec<Feature> {
        let list = self.reading.lists.get(section);
        let waves = list.into_iter().flatten().filter_map(|(_, entries)| {
            let value = |name: &str| value_in(entries, &format!("{section}.{name}"));
            let Value::Integer(order) = value("order")? else {
                return None;
            };
            Some(Feature::Harmonic {
                order: u32::try_from(order).ok()?,
                amplitude: as_number(value("amplitude")?)?,
                phase: as_number(value("phase")?)?,
            })
        });
        waves.collect()
    }

    /// What shapes do not go with, and whether the journal fits in; `None` where an error says no.
    pub(super) fn check_shapes(&mut self, bearing: &Bearing) -> Option<()> {
        if bearing.is_plain() {
            return Some(());
        }
        let section = if bearing.bore.is_cylindrical() {
            "bearing.journal"
        } else {
            "bearing.bore"
        };
        let model = self.film_model()?;
        let is_round = !bearing.bore.varies_around() && !bearing.journal.varies_around();
        let refused = if !model.is_field() {
            Some(self.without_shapes(section, model))
        } else if bearing.inlet != Inlet::Cyclic && !is_round {
            let message = "a bore or journal that is not round does not go with an inlet on the line \
                           of the widest gap";
            let error = self.error_at("film.inlet", message).allowing("\"cyclic\"");
            Some(error.hinting("give a groove or hole"))
        } else {
            self.without_room(section, bearing)
        };
        if let Some(error) = refused {
            self.errors.push(error);
            return None;
        }
        let turns = self
            .number("operation.speed")
            .is_some_and(|speed| speed != 0.0);
        if matches!(self.mode, Mode::Equilibrium | Mode::Coefficients)
            && bearing.journal.varies_around()
            && turns
        {
            let message = "the journal is not round: it finds no lasting position as it turns; this is \
                           the one where its +X passes that of the shell";
            let note = self.section_error("bearing.journal", message);
            let note = note.hinting("analysis = \"load-cycle\" follows the journal as it turns");
            self.warnings.push(note);
        }
        Some(())
    }

    /// An error at the header of a section.
    pub(super) fn section_error(&self, section: &str, message: impl Into<String>) -> InputError {
        match self.entry(section) {
            Some(entry) => self.reading.error(&entry.key_span, message),
            None => InputError::new(self.reading.file, message),
        }
        .of_key(section)
    }

    fn without_shapes(&self, section: &str, model: FilmModel) -> InputError {
        let message = format!(
            "the model {} is that of a cylindrical bore and journal",
            model.name()
        );
        self.section_error(section, message)
            .hinting("use model = \"field\"")
    }

    /// The journal fits nowhere, or not where the analysis starts from.
    fn without_room(&self, section: &str, bearing: &Bearing) -> Option<InputError> {
        let place = |gap: f64, angle: f64, axial: f64| {
            let round = |value: f64| (value * 1e4).round() / 1e4 + 0.0;
            let angle = round(angle.to_degrees().rem_euclid(360.0));
            let gap = round(1e6 * gap);
            format!(
                "gap {gap} um at {angle} deg from +X, axial position {} mm",
                round(1e3 * axial)
            )
        };
        let (_, widest) = bearing.roomiest_position();
        if widest.gap <= 0.0 {
            let place = place(widest.gap, widest.angle, widest.axial);
            let message = format!("the journal is larger than the bore: it fits nowhere ({place})");
            let error = self.section_error(section, message);
            return Some(
                error.hinting("give more clearance or a smaller profile; is the unit right?"),
            );
        }
        let centred = bearing.narrowest_gap(&JournalState::default());
        if self.mode == Mode::Film || centred.gap > 0.0 {
            return None;
        }
        let place = place(centred.gap, centred.angle, centred.axial);
        let message = format!("the journal does not fit into the middle of the bearing ({place})");
        let error = self.section_error(section, message);
        Some(error.hinting(
            "every analysis starts from the middle: take the profile from the middle of the bore",
        ))
    }
}
