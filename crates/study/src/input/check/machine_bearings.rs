//! The bearings of a machine: every `[[bearing]]` stands for one kind, or for some numbers of it.

use super::Checker;
use super::grooves::DrillingKeys;
use crate::input::error::InputError;
use crate::input::read::{BearingTable, Entry};
use crate::input::schema::Mode;
use crate::input::values::Value;
use sommerfeld_bearing::PressureCycle;
use sommerfeld_engine::Role;
use sommerfeld_film::Bearing;

const OF: &str = "bearing.of";
const NUMBERS: &str = "bearing.numbers";
const DIAMETRAL: &str = "bearing.diametral_clearance";
const RELATIVE: &str = "bearing.relative_clearance";
const GROOVE: &str = "bearing.groove";
const CONTACT_LAW: &str = "bearing.surface.contact.law";
const CONTACT_KEYS: &[&str] = &[
    "bearing.surface.contact.factor",
    "bearing.surface.contact.asperity_product",
    "bearing.surface.contact.modulus",
    "bearing.surface.contact.summit_height",
    "bearing.surface.contact.summit_roughness",
    "bearing.surface.contact.file",
];
const ELASTIC: &str = "bearing.shell.elastic";
const SHELL_KEYS: &[&str] = &[
    "bearing.shell.thickness",
    "bearing.shell.modulus",
    "bearing.shell.poisson",
];

/// Bearings of one kind that a machine has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind {
    /// Their place.
    pub(super) role: Role,
    /// How many there are.
    pub(super) count: usize,
    /// They must be described.
    pub(super) is_due: bool,
}

/// A checked bearing, its supply through the crank not yet resolved.
#[derive(Debug, Clone)]
pub(super) struct CheckedBearing {
    pub(super) role: Role,
    /// 0-based.
    pub(super) index: usize,
    pub(super) bearing: Bearing,
    pub(super) feed_pressures: Vec<PressureCycle>,
    pub(super) drillings: Vec<DrillingKeys>,
    /// Position of its bore against the common line, m.
    pub(super) offset: Option<[f64; 2]>,
    /// An error at its width.
    pub(super) width_error: InputError,
    /// An error at its offset, or at its header.
    pub(super) offset_error: InputError,
}

impl CheckedBearing {
    /// Its name in results.
    pub(super) fn name(&self) -> String {
        format!("{}-{}", self.role.name(), self.index + 1)
    }

    /// Its place along the shaft, at an axial position (m).
    pub(super) fn place(&self, axial: f64) -> Place {
        Place {
            name: self.name(),
            axial,
            width: self.bearing.width,
            error: self.width_error.clone(),
        }
    }
}

/// What stands at an axial position of a shaft.
#[derive(Debug, Clone)]
pub(super) struct Place {
    pub(super) name: String,
    /// m.
    pub(super) axial: f64,
    /// m.
    pub(super) width: f64,
    /// An error at its width.
    pub(super) error: InputError,
}

/// In words, in the plural.
fn plural(role: Role) -> &'static str {
    match role {
        Role::Main => "main bearings",
        Role::BigEnd => "big ends",
        Role::SmallEnd => "small ends",
        Role::PistonBoss => "piston bosses",
        Role::Shaft => "bearings",
    }
}

/// As `of` names it.
fn word(role: Role) -> &'static str {
    match role {
        Role::Shaft => "shaft",
        role => role.name(),
    }
}

impl Checker<'_> {
    /// The bearings of these kinds, in their order and by number; those that are right.
    pub(super) fn machine_bearings(&mut self, kinds: &[Kind]) -> Vec<CheckedBearing> {
        let tables = std::mem::take(&mut self.reading.bearings);
        if tables.is_empty() {
            self.refuse_single_bearing();
        }
        let roles: Vec<Option<Role>> = tables
            .iter()
            .map(|table| self.role_of(table, kinds))
            .collect();
        let mut found = Vec::new();
        for kind in kinds {
            let own = tables.iter().zip(&roles);
            let own = own.filter(|(_, role)| **role == Some(kind.role));
            let own: Vec<&BearingTable> = own.map(|(table, _)| table).collect();
            if own.is_empty() {
                if kind.is_due && !tables.is_empty() && roles.iter().all(Option::is_some) {
                    self.report_missing_kind(kind.role);
                }
                continue;
            }
            found.extend(self.bearings_of(*kind, &own));
        }
        self.reading.bearings = tables;
        found
    }

    /// `[bearing]` where `[[bearing]]` is due.
    fn refuse_single_bearing(&mut self) {
        let single = self.entry("bearing");
        let Some(entry) = single.filter(|entry| entry.value == Value::Table) else {
            return;
        };
        let message = format!("the analysis {} has several bearings", self.mode.name());
        let error = self
            .reading
            .error(&entry.key_span, message)
            .of_key("bearing");
        self.errors.push(error.hinting(match self.mode {
            Mode::Engine => "write [[bearing]] for each kind, with of = \"main\", of = \"big-end\"",
            _ => "write [[bearing]]; one describes all bearings of the shaft",
        }));
    }

    fn report_missing_kind(&mut self, role: Role) {
        let message = format!("the {} are missing", plural(role));
        let error = self.section_error(self.mode.name(), message).of_key(OF);
        let hint = format!("add [[bearing]] with of = \"{}\"", word(role));
        self.errors.push(error.with_value("").hinting(hint));
    }

    /// The kind that a table describes; an error where it names none of the machine.
    fn role_of(&mut self, table: &BearingTable, kinds: &[Kind]) -> Option<Role> {
        let words: Vec<&str> = kinds.iter().map(|kind| word(kind.role)).collect();
        let Some(entry) = table.entries.get(OF) else {
            if let [only] = kinds {
                return Some(only.role);
            }
            let message = "which bearings these are is missing";
            let error = self.reading.error(&table.header, message).of_key(OF);
            self.errors.push(
                error
                    .with_value("")
                    .allowing(words.join(", "))
                    .hinting("for example of = \"main\""),
            );
            return None;
        };
        let Value::Text(of) = &entry.value else {
            return None;
        };
        let found = kinds.iter().find(|kind| word(kind.role) == of);
        if found.is_none() {
            let message = match self.mode {
                Mode::Engine => format!("an engine has no bearings of kind {of}"),
                _ => format!("a shaft has no bearings of kind {of}"),
            };
            let error = self.reading.error(&entry.value_span, message).of_key(OF);
            self.errors.push(error.allowing(words.join(", ")));
        }
        found.map(|kind| kind.role)
    }

    /// The bearings of one kind from the tables that describe them.
    fn bearings_of(&mut self, kind: Kind, tables: &[&BearingTable]) -> Vec<CheckedBearing> {
        let mut general: Option<&BearingTable> = None;
        let mut own: Vec<Option<&BearingTable>> = vec![None; kind.count];
        for table in tables.iter().copied() {
            match table.entries.get(NUMBERS) {
                None if general.is_some() => {
                    let message = format!("the {} are described twice", plural(kind.role));
                    let error = self.reading.error(&table.header, message).of_key("bearing");
                    self.errors
                        .push(error.hinting("give one of the two the numbers that it describes"));
                }
                None => general = Some(table),
                Some(entry) => self.assign(kind, table, entry, &mut own),
            }
        }
        let lacking: Vec<String> = (own.iter().enumerate())
            .filter(|(_, table)| table.is_none() && general.is_none())
            .map(|(index, _)| (index + 1).to_string())
            .collect();
        if let (false, Some(first)) = (lacking.is_empty(), tables.first()) {
            let which = lacking.join(", ");
            let message = format!(
                "of the {}, these are not described: {which}",
                plural(kind.role)
            );
            let error = self.reading.error(&first.header, message).of_key(NUMBERS);
            self.errors.push(
                error.hinting("one [[bearing]] of the kind without numbers describes the rest"),
            );
        }
        self.checked(kind.role, general, &own)
    }

    /// Notes which numbers a table describes.
    fn assign<'b>(
        &mut self,
        kind: Kind,
        table: &'b BearingTable,
        entry: &Entry,
        own: &mut [Option<&'b BearingTable>],
    ) {
        let Value::Integers(numbers) = &entry.value else {
            return;
        };
        for number in numbers {
            let index = usize::try_from(*number).unwrap_or(0).wrapping_sub(1);
            let error = match own.get_mut(index) {
                Some(free @ None) => {
                    *free = Some(table);
                    continue;
                }
                Some(_) => format!("{} {number} is described twice", kind.role.name()),
                None => format!("there is no {} {number}", kind.role.name()),
            };
            let error = self.reading.error(&entry.value_span, error).of_key(NUMBERS);
            self.errors
                .push(error.allowing(format!("1 to {}, each once", kind.count)));
        }
    }

    /// Checks each table once, for all the numbers it describes.
    fn checked(
        &mut self,
        role: Role,
        general: Option<&BearingTable>,
        own: &[Option<&BearingTable>],
    ) -> Vec<CheckedBearing> {
        let mut known: Vec<(Option<usize>, Option<CheckedBearing>)> = Vec::new();
        let mut found = Vec::new();
        for (index, table) in own.iter().enumerate() {
            let key = table.map(|table| table.header.start);
            let seen = known.iter().find(|(seen, _)| *seen == key);
            let checked = match seen {
                Some((_, checked)) => checked.clone(),
                None => {
                    let merged = match (general, table) {
                        (Some(general), Some(table)) => Some(merged(general, table)),
                        (one, other) => other.or(one).cloned(),
                    };
                    let checked = merged.and_then(|table| self.check_bearing_table(role, &table));
                    known.push((key, checked.clone()));
                    checked
                }
            };
            found.extend(checked.map(|checked| CheckedBearing { index, ..checked }));
        }
        found
    }

    /// Checks a table as if it were the one `[bearing]` of a study.
    fn check_bearing_table(&mut self, role: Role, table: &BearingTable) -> Option<CheckedBearing> {
        let (errors, warnings) = (self.errors.len(), self.warnings.len());
        let outer = self.enter(table);
        self.report_missing("bearing.");
        self.report_unused("bearing.");
        let bearing = self.bearing();
        let checked = bearing.map(|bearing| CheckedBearing {
            role,
            index: 0,
            bearing,
            feed_pressures: std::mem::take(&mut self.feed_cycles),
            drillings: std::mem::take(&mut self.drillings),
            offset: self.pair("bearing.offset"),
            width_error: self.error_at("bearing.width", ""),
            offset_error: match self.entry("bearing.offset") {
                Some(_) => self.error_at("bearing.offset", ""),
                None => self.reading.error(&table.header, ""),
            },
        });
        self.leave(outer);
        // What two tables have from a third is wrong once.
        keep_new(&mut self.errors, errors);
        keep_new(&mut self.warnings, warnings);
        checked
    }

    /// Puts a table in the place of `[bearing]`; returns what stood there.
    fn enter(&mut self, table: &BearingTable) -> BearingTable {
        let mut entries = self.reading.entries.clone();
        entries.extend(
            table
                .entries
                .iter()
                .map(|(key, entry)| (*key, entry.clone())),
        );
        entries.insert(
            "bearing",
            Entry {
                value: Value::Table,
                key_span: table.header.clone(),
                value_span: table.header.clone(),
            },
        );
        BearingTable {
            header: 0..0,
            entries: std::mem::replace(&mut self.reading.entries, entries),
            grooves: std::mem::replace(&mut self.reading.grooves, table.grooves.clone()),
            lists: std::mem::replace(&mut self.reading.lists, table.lists.clone()),
        }
    }

    fn leave(&mut self, outer: BearingTable) {
        self.reading.entries = outer.entries;
        self.reading.grooves = outer.grooves;
        self.reading.lists = outer.lists;
    }
}

/// What a table says, and what it leaves out as the general one of its kind says it.
fn merged(general: &BearingTable, table: &BearingTable) -> BearingTable {
    let mut merged = general.clone();
    merged.header = table.header.clone();
    for (given, other) in [(DIAMETRAL, RELATIVE), (RELATIVE, DIAMETRAL)] {
        if table.entries.contains_key(given) {
            merged.entries.remove(other);
        }
    }
    for (law, keys) in [(CONTACT_LAW, CONTACT_KEYS), (ELASTIC, SHELL_KEYS)] {
        // Another law has none of the keys of the general one.
        if table.entries.contains_key(law) {
            merged.entries.retain(|key, _| !keys.contains(key));
        }
    }
    merged.entries.extend(
        table
            .entries
            .iter()
            .map(|(key, entry)| (*key, entry.clone())),
    );
    if table.entries.contains_key(GROOVE) {
        merged.grooves.clone_from(&table.grooves);
    }
    for (path, list) in &table.lists {
        merged.lists.insert(path, list.clone());
    }
    merged
}

/// Takes the messages out from `from` on that stand before it, too.
fn keep_new(messages: &mut Vec<InputError>, from: usize) {
    let new = messages.split_off(from.min(messages.len()));
    for message in new {
        if !messages.contains(&message) {
            messages.push(message);
        }
    }
}
