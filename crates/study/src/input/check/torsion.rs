//! The torsional chain of a crankshaft.

use super::Checker;
use super::{as_number, value_in};
use crate::input::values::Value;
use sommerfeld_engine::{Disc, TorsionalChain, TorsionalLink};

const SECTION: &str = "engine.torsion";
const DISC: &str = "engine.torsion.disc";
const LINK: &str = "engine.torsion.link";

impl Checker<'_> {
    /// The chain, if its vibration is asked for; the outer `None` where an error says why not.
    pub(super) fn torsion(&mut self, throws: usize) -> Option<Option<TorsionalChain>> {
        if self.entry(SECTION).is_none() {
            return Some(None);
        }
        let discs = self.discs(throws);
        let links = self.links();
        let (discs, links) = (discs?, links?);
        if discs.len() < 2 || links.len() + 1 != discs.len() {
            let message = format!("a chain of {} discs has {} links", discs.len(), links.len());
            let error = self.section_error(SECTION, message);
            self.errors.push(
                error
                    .allowing("two discs or more, and a link between each and the next")
                    .hinting("write [[engine.torsion.disc]] and [[engine.torsion.link]] from the free end on"),
            );
            return None;
        }
        Some(Some(TorsionalChain { discs, links }))
    }

    fn discs(&mut self, throws: usize) -> Option<Vec<Disc>> {
        let list = self.reading.lists.get(DISC).cloned().unwrap_or_default();
        let errors = self.errors.len();
        let mut discs: Vec<Disc> = Vec::new();
        for (header, entries) in &list {
            let number =
                |name: &str| value_in(entries, &format!("{DISC}.{name}")).and_then(as_number);
            let throw = match value_in(entries, "engine.torsion.disc.throw") {
                Some(Value::Integer(number)) => Some(usize::try_from(number).unwrap_or(0)),
                _ => None,
            };
            let refused = match throw {
                Some(number) if number == 0 || number > throws => {
                    Some(format!("there is no throw {number}"))
                }
                Some(number) if discs.iter().any(|disc| disc.throw == Some(number - 1)) => {
                    Some(format!("throw {number} drives two discs"))
                }
                _ => None,
            };
            if let Some(message) = refused {
                let at = entries.get("engine.torsion.disc.throw");
                let span = at.map_or(header, |entry| &entry.value_span);
                let error = self.reading.error(span, message);
                self.errors.push(
                    error
                        .of_key("engine.torsion.disc.throw")
                        .allowing(format!("1 to {throws}, each once")),
                );
            }
            discs.push(Disc {
                inertia: number("inertia")?,
                damping: number("damping")?,
                throw: throw.map(|number| number.wrapping_sub(1)),
            });
        }
        let driven: Vec<usize> = discs.iter().filter_map(|disc| disc.throw).collect();
        let idle: Vec<String> = (0..throws)
            .filter(|throw| !driven.contains(throw))
            .map(|throw| (throw + 1).to_string())
            .collect();
        if self.errors.len() == errors && !idle.is_empty() {
            let message = format!("throws that drive no disc: {}", idle.join(", "));
            let error = self
                .section_error(SECTION, message)
                .of_key("engine.torsion.disc.throw");
            self.errors
                .push(error.hinting("give the disc of each throw its number: throw = 1"));
        }
        (self.errors.len() == errors).then_some(discs)
    }

    fn links(&self) -> Option<Vec<TorsionalLink>> {
        let list = self.reading.lists.get(LINK).cloned().unwrap_or_default();
        let common = self.number("engine.torsion.loss_factor")?;
        list.iter()
            .map(|(_, entries)| {
                let number =
                    |name: &str| value_in(entries, &format!("{LINK}.{name}")).and_then(as_number);
                Some(TorsionalLink {
                    stiffness: number("stiffness")?,
                    damping: number("damping")?,
                    loss_factor: number("loss_factor").unwrap_or(common),
                })
            })
            .collect()
    }
}
