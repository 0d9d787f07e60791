//! How the loads of the main bearings are found: hinges, or an elastic crankshaft.

use super::Checker;
use super::grooves::mm;
use super::machine_bearings::CheckedBearing;
use sommerfeld_engine::{CrankshaftShape, EngineLayout, Mains, Role, Web};

const SECTION: &str = "engine.crankshaft";
const MODEL: &str = "engine.crankshaft.model";
const FITTED: [&str; 3] = ["web_bending_in_plane", "web_bending_across", "web_torsion"];

impl Checker<'_> {
    /// The mains as they are modelled.
    pub(super) fn mains(
        &mut self,
        layout: &EngineLayout,
        bearings: &[CheckedBearing],
    ) -> Option<Mains> {
        let is_elastic = self.text(MODEL)? == "elastic";
        let mains: Vec<&CheckedBearing> =
            bearings.iter().filter(|b| b.role == Role::Main).collect();
        if !is_elastic {
            if self.refuse_offsets(MODEL, bearings) {
                return None;
            }
            self.warn_of_elastic_keys();
            return Some(Mains::Determinate);
        }
        self.refuse_elastic_closed_form(MODEL);
        let others: Vec<CheckedBearing> = bearings
            .iter()
            .filter(|b| b.role != Role::Main)
            .cloned()
            .collect();
        let misplaced = self.refuse_offsets(MODEL, &others);
        let shape = self.crankshaft_shape(bearings);
        let supports = self.supports(SECTION, layout.mains.len());
        let shape = shape?;
        self.check_bays(layout, &shape);
        let offsets = offsets(&mains);
        (!misplaced).then_some(Mains::Elastic {
            shape,
            supports: supports?,
            offsets,
        })
    }

    /// An offset of a bore shifts loads only where the shaft bends.
    pub(super) fn refuse_offsets(&mut self, model_key: &str, bearings: &[CheckedBearing]) -> bool {
        let Some(bearing) = bearings.iter().find(|bearing| bearing.offset.is_some()) else {
            return false;
        };
        let message = match bearing.role {
            Role::Main | Role::Shaft => format!(
                "the offset of {} changes no load while each bearing is a hinge",
                bearing.name()
            ),
            _ => format!("{} has no line to be offset from", bearing.name()),
        };
        let error = self.error_at(model_key, message).of_key("bearing.offset");
        self.errors.push(
            error.hinting(
                "take `offset` out, or follow the bending of the shaft: model = \"elastic\"",
            ),
        );
        true
    }

    /// Keys that only an elastic crankshaft reads.
    fn warn_of_elastic_keys(&mut self) {
        let unused: Vec<&'static str> = crate::input::schema::children(SECTION)
            .map(|key| key.path)
            .filter(|path| *path != MODEL && self.entry(path).is_some())
            .collect();
        for path in unused {
            let message = format!("`{path}` is not used: every main bearing is a hinge");
            let note = self.error_at(path, message);
            self.warnings
                .push(note.hinting("model = \"elastic\" uses it"));
        }
    }

    /// Dimensions and material.
    fn crankshaft_shape(&mut self, bearings: &[CheckedBearing]) -> Option<CrankshaftShape> {
        let path = |name: &str| format!("{SECTION}.{name}");
        let mut is_complete = true;
        for name in ["main_length", "pin_length", "web_thickness"] {
            if self.entry(&path(name)).is_none() {
                self.lacking(name);
                is_complete = false;
            }
        }
        let web = self.web();
        let main_diameter = self.journal_diameter(bearings, Role::Main);
        let pin_diameter = self.journal_diameter(bearings, Role::BigEnd);
        if !is_complete {
            return None;
        }
        let number = |name: &str| self.number(&path(name));
        let shape = CrankshaftShape {
            youngs_modulus: number("youngs_modulus")?,
            poissons_ratio: number("poissons_ratio")?,
            main_diameter: main_diameter?,
            main_length: number("main_length")?,
            pin_diameter: pin_diameter?,
            pin_length: number("pin_length")?,
            bore_diameter: number("bore_diameter")?,
            web: web?,
        };
        let thinnest = shape.main_diameter.min(shape.pin_diameter);
        if shape.bore_diameter >= thinnest {
            let error = self.error_at(
                &path("bore_diameter"),
                "the bore leaves nothing of the journals",
            );
            self.errors
                .push(error.allowing(format!("less than {} mm", mm(thinnest))));
            return None;
        }
        Some(shape)
    }

    fn lacking(&mut self, name: &str) {
        let path = format!("{SECTION}.{name}");
        let message = format!("an elastic crankshaft needs `{name}`");
        let error = self.error_at(MODEL, message).of_key(&path);
        let meaning = crate::input::schema::find(&path).map_or("", |key| key.meaning);
        self.errors.push(error.hinting(meaning));
    }

    /// A bar of its dimensions, or the three fitted stiffnesses.
    fn web(&mut self) -> Option<Web> {
        let path = |name: &str| format!("{SECTION}.{name}");
        let given = FITTED.map(|name| self.entry(&path(name)).is_some());
        let has_width = self.entry(&path("web_width")).is_some();
        let thickness = self.number(&path("web_thickness"));
        if given.contains(&true) && has_width {
            let error = self.error_at(
                &path("web_width"),
                "the stiffness of the webs is given twice",
            );
            self.errors
                .push(error.allowing("web_width, or the three stiffnesses"));
            return None;
        }
        if has_width {
            return Some(Web::Bar {
                thickness: thickness?,
                width: self.number(&path("web_width"))?,
            });
        }
        if !given.contains(&true) {
            self.lacking("web_width");
            return None;
        }
        for name in FITTED
            .iter()
            .zip(given)
            .filter(|(_, given)| !given)
            .map(|(name, _)| name)
        {
            self.lacking(name);
        }
        let [bending_in_plane, bending_across, torsion] =
            FITTED.map(|name| self.number(&path(name)));
        Some(Web::Fitted {
            thickness: thickness?,
            bending_in_plane: bending_in_plane?,
            bending_across: bending_across?,
            torsion: torsion?,
        })
    }

    /// Diameter of the journals of a kind, which an elastic crankshaft has alike, m.
    fn journal_diameter(&mut self, bearings: &[CheckedBearing], role: Role) -> Option<f64> {
        let mut own = bearings.iter().filter(|bearing| bearing.role == role);
        let first = own.next()?;
        // Clearances may differ from bearing to bearing; the bores of one crankshaft do not.
        if let Some(other) = own.find(|b| {
            (b.bearing.diameter - first.bearing.diameter).abs() > 1e-3 * first.bearing.diameter
        }) {
            let message = format!(
                "an elastic crankshaft has journals of one diameter: {} has {} mm, {} has {} mm",
                first.name(),
                mm(first.bearing.diameter),
                other.name(),
                mm(other.bearing.diameter)
            );
            let error = self.error_at(MODEL, message).of_key("bearing.diameter");
            self.errors
                .push(error.hinting("use model = \"determinate\""));
            return None;
        }
        Some(first.bearing.diameter - 2.0 * first.bearing.radial_clearance)
    }

    /// Journals, pins and webs fit between the mains.
    fn check_bays(&mut self, layout: &EngineLayout, shape: &CrankshaftShape) {
        let thickness = match shape.web {
            Web::Bar { thickness, .. } | Web::Fitted { thickness, .. } => thickness,
        };
        for pair in layout.mains.windows(2) {
            let throws = layout
                .throws
                .iter()
                .filter(|t| t.axial > pair[0] && t.axial < pair[1]);
            let count = throws.count() as f64;
            if count == 0.0 {
                continue;
            }
            let needed = shape.main_length + count * shape.pin_length + (count + 1.0) * thickness;
            let room = pair[1] - pair[0];
            if needed > room * (1.0 + 1e-9) {
                let message = format!(
                    "main journals, pins and webs take {} mm between two mains, which lie {} mm apart",
                    mm(needed),
                    mm(room)
                );
                let path = "engine.crankshaft.web_thickness";
                let error = self.error_at(path, message);
                self.errors.push(error.hinting(
                    "main_length, pin_length and the webs beside each pin must fit between two main centres",
                ));
                return;
            }
        }
    }
}

/// Offsets of bores by number; empty where all are in line.
pub(super) fn offsets(bearings: &[&CheckedBearing]) -> Vec<[f64; 2]> {
    let has_one = bearings.iter().any(|bearing| bearing.offset.is_some());
    let offsets = bearings
        .iter()
        .map(|bearing| bearing.offset.unwrap_or_default());
    if has_one {
        offsets.collect()
    } else {
        Vec::new()
    }
}
