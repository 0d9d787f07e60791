//! How the two surfaces are finished, what their asperities carry, and how the shell gives way.

use super::{Checker, LawKeys};
use crate::input::contact_file::read_contact;
use sommerfeld_film::{
    ContactLaw, Elasticity, Finish, FinishError, GreenwoodTripp, RoughFinish, Roughness,
};

const SURFACE: &str = "bearing.surface";
const CONTACT: &str = "bearing.surface.contact";
const SHELL: &str = "bearing.shell";

impl Checker<'_> {
    /// Finish of both surfaces.
    pub(super) fn finish(&mut self) -> Option<Finish> {
        if self.entry(SURFACE).is_none() {
            return Some(Finish::Smooth);
        }
        let number = |name: &str| self.number(&format!("{SURFACE}.{name}"));
        let roughness = Roughness {
            journal: number("roughness_journal")?,
            shell: number("roughness_shell")?,
            peklenik_journal: number("peklenik_journal")?,
            peklenik_shell: number("peklenik_shell")?,
        };
        let friction = number("boundary_friction");
        let contact = self.contact()?;
        if contact.is_on() && friction.is_none() {
            let message = "asperities in contact need `boundary_friction`";
            let error = self.error_at(&format!("{CONTACT}.law"), message);
            self.errors.push(
                error
                    .of_key("bearing.surface.boundary_friction")
                    .allowing("at least 0, at most 1")
                    .hinting("for example boundary_friction = 0.08, in [bearing.surface]"),
            );
            return None;
        }
        let rough = RoughFinish {
            roughness,
            contact,
            boundary_friction: friction.unwrap_or(0.0),
        };
        match rough.check() {
            Ok(()) => {}
            Err(FinishError::NoRoughness) if !rough.contact.is_on() => return Some(Finish::Smooth),
            Err(error) => {
                let error = self.finish_error(&error);
                self.errors.push(error);
                return None;
            }
        }
        self.refuse_of_closed_form(SURFACE, "has smooth surfaces")?;
        Some(Finish::Rough(rough))
    }

    /// What is wrong with the surfaces, at the key it is about.
    fn finish_error(&self, error: &FinishError) -> crate::input::InputError {
        match error {
            FinishError::NoRoughness => self
                .error_at(
                    &format!("{CONTACT}.law"),
                    "contact of surfaces without roughness: both are smooth",
                )
                .allowing("roughness_journal or roughness_shell above 0 um")
                .hinting("give a roughness, or take the contact out"),
            FinishError::OutOfRange { name, .. } | FinishError::NotPositive { name, .. } => {
                let place = format!("{SURFACE}.{name}");
                self.error_at(&place, error.to_string())
            }
            error => self.section_error(SURFACE, error.to_string()),
        }
    }

    /// What asperities carry.
    fn contact(&mut self) -> Option<ContactLaw> {
        const THEORY: &[&str] = &["factor", "asperity_product", "modulus"];
        const OF_THEORY: &[&str] = &[
            "factor",
            "asperity_product",
            "modulus",
            "summit_height",
            "summit_roughness",
        ];
        const ALL: &[&str] = &[
            "factor",
            "asperity_product",
            "modulus",
            "summit_height",
            "summit_roughness",
            "file",
        ];
        if self.entry(CONTACT).is_none() {
            return Some(ContactLaw::None);
        }
        let law = self.text(&format!("{CONTACT}.law"))?;
        let (needed, foreign): (&[&str], &[&str]) = match law.as_str() {
            "greenwood-tripp" => (THEORY, &["file"]),
            "table" => (&["file"], OF_THEORY),
            _ => (&[], ALL),
        };
        if !self.law_keys(CONTACT, &law, LawKeys { needed, foreign }) {
            return None;
        }
        let number = |name: &str| self.number(&format!("{CONTACT}.{name}"));
        Some(match law.as_str() {
            "greenwood-tripp" => ContactLaw::GreenwoodTripp(GreenwoodTripp {
                factor: number("factor")?,
                asperity_product: number("asperity_product")?,
                modulus: number("modulus")?,
                summit_height: number("summit_height").unwrap_or(0.0),
                summit_roughness: number("summit_roughness"),
            }),
            "table" => self.contact_table(&format!("{CONTACT}.file"))?,
            _ => ContactLaw::None,
        })
    }

    fn contact_table(&mut self, key: &str) -> Option<ContactLaw> {
        let name = self.text(key)?;
        let named_at = self.error_at(key, "");
        let source = self.table_text(&name, "contact table", named_at)?;
        // No text holds this byte: a row that moves from one table to the next changes the hash.
        self.table_bytes.push(0xff);
        match read_contact(&source.file, &source.text) {
            Ok(table) => Some(ContactLaw::Table(table)),
            Err(errors) => {
                self.errors.extend(errors);
                None
            }
        }
    }

    /// How the shell gives way.
    pub(super) fn elasticity(&mut self) -> Option<Elasticity> {
        const LAYER: &[&str] = &["thickness", "modulus", "poisson"];
        if self.entry(SHELL).is_none() {
            return Some(Elasticity::Rigid);
        }
        let path = |name: &str| format!("{SHELL}.{name}");
        let kind = self.text(&path("elastic"))?;
        let is_layer = kind == "layer";
        let mut errors = Vec::new();
        for name in LAYER {
            let is_given = self.reading.was_given(&path(name));
            if is_layer && !is_given {
                let message = format!("a shell with elastic = \"layer\" needs `{name}`");
                let error = self.error_at(&path("elastic"), message);
                errors.push(error.of_key(&path(name)).allowing(LAYER.join(", ")));
            } else if is_given && !is_layer {
                let message = format!("a rigid shell has no `{name}`");
                let error = self.error_at(&path(name), message);
                errors.push(error.hinting("take it out, or give elastic = \"layer\""));
            }
        }
        if !errors.is_empty() {
            self.errors.extend(errors);
            return None;
        }
        if !is_layer {
            return Some(Elasticity::Rigid);
        }
        self.refuse_of_closed_form(SHELL, "has a rigid shell")?;
        let number = |name: &str| self.number(&path(name));
        Some(Elasticity::Layer {
            thickness: number("thickness")?,
            modulus: number("modulus")?,
            poisson: number("poisson")?,
        })
    }

    /// Refuses what only the film on a grid can do; `None` where it did.
    pub(super) fn refuse_of_closed_form(&mut self, section: &str, why: &str) -> Option<()> {
        let model = self.film_model()?;
        if model.is_field() {
            return Some(());
        }
        let message = format!("the model {} {why}", model.name());
        let error = self.section_error(section, message);
        self.errors.push(error.hinting("use model = \"field\""));
        None
    }
}
