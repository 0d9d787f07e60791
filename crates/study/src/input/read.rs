//! TOML text to values in SI, key by key against the table of keys. Collects every error.

use super::error::{InputError, Place};
use super::schema::{self, Key, Kind, Range};
use super::units::Dimension;
use super::values::{Value, not_built, plain_value, quantity};
use std::collections::BTreeMap;
use std::ops::Range as Span;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// More errors than this in one file are not looked for: placing each takes a walk over the file.
pub(super) const MOST_ERRORS: usize = 100;
/// Behind the first few errors of syntax the parser guesses.
const SYNTAX_ERRORS: usize = 5;
/// Longest piece of a key that is shown, characters.
const KEY_SHOWN: usize = 80;
/// The schema that is read here.
const SCHEMA: i64 = 1;

/// A value with its place in the file.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) value: Value,
    /// Bytes of the key.
    pub(super) key_span: Span<usize>,
    /// Bytes of the value.
    pub(super) value_span: Span<usize>,
}

/// Values by full key.
pub(super) type Entries = BTreeMap<&'static str, Entry>;

/// Groups of entries by the key of their list, each with the place of its header.
pub(super) type Lists = BTreeMap<&'static str, Vec<(Span<usize>, Entries)>>;

/// One `[[bearing]]` of a machine: read like the one `[bearing]` of another study.
#[derive(Debug, Clone)]
pub(super) struct BearingTable {
    /// Bytes of its header.
    pub(super) header: Span<usize>,
    pub(super) entries: Entries,
    pub(super) grooves: Vec<(Span<usize>, Entries)>,
    pub(super) lists: Lists,
}

/// A study file as read: values, places, and what was wrong.
pub(super) struct Reading<'t> {
    pub(super) file: &'t str,
    pub(super) text: &'t str,
    pub(super) entries: Entries,
    /// One set of entries per `[[bearing.groove]]`, with the place of its header.
    pub(super) grooves: Vec<(Span<usize>, Entries)>,
    /// The same for every other list of tables, by its key.
    pub(super) lists: Lists,
    /// Every `[[bearing]]` of a machine.
    pub(super) bearings: Vec<BearingTable>,
    pub(super) errors: Vec<InputError>,
}

impl<'t> Reading<'t> {
    /// Reads a study file.
    pub(super) fn of(file: &'t str, text: &'t str) -> Self {
        let mut reading = Self {
            file,
            text,
            entries: Entries::new(),
            grooves: Vec::new(),
            lists: Lists::new(),
            bearings: Vec::new(),
            errors: Vec::new(),
        };
        let (document, syntax) = DeTable::parse_recoverable(text);
        if let Some(error) = reading.newer_schema(document.get_ref()) {
            reading.errors.push(error);
            return reading;
        }
        for error in syntax.iter().take(SYNTAX_ERRORS) {
            let error = reading.syntax_error(error);
            reading.errors.push(error);
        }
        // What the parser guesses behind a syntax error is not worth a message.
        if reading.errors.is_empty() {
            let mut entries = Entries::new();
            reading.table("", document.get_ref(), &mut entries);
            reading.entries = entries;
        }
        reading
    }

    /// An error at a place of this file.
    pub(super) fn error(&self, span: &Span<usize>, message: impl Into<String>) -> InputError {
        let value = self.text.get(span.clone()).unwrap_or_default();
        InputError::new(self.file, message)
            .at(Place::of_span(self.text, span.clone()))
            .with_value(value)
    }

    /// The key was given, readable or not.
    pub(super) fn was_given(&self, path: &str) -> bool {
        self.entries.contains_key(path)
    }

    /// A file of a later schema: what this one would say about its keys means nothing.
    fn newer_schema(&self, document: &DeTable<'_>) -> Option<InputError> {
        let value = document.get("schema")?;
        let digits = value.get_ref().as_integer()?;
        // Too long for a whole number of the machine is newer, too.
        let is_newer = digits.radix() == 10
            && !digits.as_str().starts_with('-')
            && digits
                .as_str()
                .parse::<i64>()
                .map_or(true, |version| version > SCHEMA);
        is_newer.then(|| {
            let shown: String = digits.as_str().chars().take(20).collect();
            let message = format!("the study is written for schema {shown}, which is newer");
            self.error(&value.span(), message)
                .of_key("schema")
                .allowing(format!("schema = {SCHEMA}"))
                .hinting(format!(
                    "this is version {} of the program: use a newer one, or write the study for \
                     schema {SCHEMA} (`sommerfeld explain` lists its keys)",
                    env!("CARGO_PKG_VERSION")
                ))
        })
    }

    fn syntax_error(&self, error: &toml::de::Error) -> InputError {
        let span = error.span().unwrap_or(0..0);
        let place = Place::of_span(self.text, span.clone());
        let message = match error.message() {
            "duplicate key" => {
                let key = self.text.get(span.clone()).unwrap_or_default().trim();
                let shown: String = key.chars().take(KEY_SHOWN).collect();
                return InputError::new(self.file, format!("`{shown}` is given twice"))
                    .at(place)
                    .of_key(key)
                    .hinting("keep one of the two");
            }
            message => message,
        };
        let refused = InputError::new(self.file, format!("not valid TOML: {message}")).at(place);
        let line = self.line_of(&span);
        if has_decimal_comma(line) {
            return refused.hinting("decimals take a point: 0.5, not 0,5");
        }
        if line.contains('\u{2212}') {
            return refused
                .hinting("the minus sign is not the one of the keyboard: write a plain -");
        }
        if line.contains(['\u{201c}', '\u{201d}', '\u{201e}', '\u{ab}', '\u{bb}']) {
            return refused.hinting("text and quantities stand in straight quotes: \"72 mm\"");
        }
        refused.hinting("text and quantities stand in quotes: diameter = \"72 mm\"")
    }

    fn line_of(&self, span: &Span<usize>) -> &'t str {
        let before = self.text.get(..span.start).unwrap_or_default();
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let rest = self.text.get(start..).unwrap_or_default();
        rest.lines().next().unwrap_or_default()
    }

    /// Reads the keys of a table. `path` is its full key.
    fn table(&mut self, path: &str, table: &DeTable<'_>, entries: &mut Entries) {
        for (name, value) in table {
            if self.errors.len() >= MOST_ERRORS {
                return;
            }
            let full = join(path, name.get_ref());
            let Some(key) = schema::find(&full) else {
                self.unknown_key(&full, &name.span());
                continue;
            };
            let read = self
                .value(key, name, value, entries)
                .unwrap_or(Value::Unreadable);
            let entry = Entry {
                value: read,
                key_span: name.span(),
                value_span: value.span(),
            };
            entries.insert(key.path, entry);
        }
    }

    fn unknown_key(&mut self, path: &str, span: &Span<usize>) {
        let shown: String = path.chars().take(KEY_SHOWN).collect();
        let section = path.rsplit_once('.').map_or("", |(section, _)| section);
        let known: Vec<&str> = schema::children(section)
            .filter(|k| k.is_built())
            .map(Key::name)
            .collect();
        let mut error = self
            .error(span, format!("unknown key `{shown}`"))
            .of_key(path)
            .allowing(known.join(", "));
        if let Some(key) = schema::nearest(path) {
            let place = if key.section() == section {
                key.name()
            } else {
                key.path
            };
            error = error.hinting(format!("did you mean `{place}`?"));
        }
        self.errors.push(error);
    }

    /// Reads one value, or says why not.
    fn value(
        &mut self,
        key: &'static Key,
        name: &Spanned<std::borrow::Cow<'_, str>>,
        value: &Spanned<DeValue<'_>>,
        entries: &mut Entries,
    ) -> Option<Value> {
        let span = value.span();
        match (key.kind, value.get_ref()) {
            (Kind::NotBuilt, _) => {
                self.errors
                    .push(not_built(self.error(&name.span(), ""), key.path).of_key(key.path));
                None
            }
            (Kind::Table | Kind::TableOrList | Kind::QuantityOrLaw(..), DeValue::Table(table)) => {
                self.table(key.path, table, entries);
                Some(Value::Table)
            }
            (Kind::Vary, DeValue::Table(table)) => self.vary(table, &span),
            (Kind::TableList, DeValue::Array(list)) => self.groups(key, list),
            (Kind::TableOrList, DeValue::Array(list)) => self.bearings(key, list),
            (Kind::TableList, DeValue::Table(table)) => {
                let mut group = Entries::new();
                self.table(key.path, table, &mut group);
                self.keep_group(key, name.span(), group);
                Some(Value::Table)
            }
            (Kind::Limit(dimension, range), DeValue::Table(table)) => {
                self.limit(key, &span, table, dimension, range)
            }
            (_, plain) => match plain_value(key, plain) {
                Ok(read) => Some(read),
                Err(refusal) => {
                    let span = refusal.part.clone().unwrap_or(span);
                    let error = refusal.into_error(self.error(&span, ""), key);
                    self.errors.push(error);
                    None
                }
            },
        }
    }

    fn keep_group(&mut self, key: &'static Key, header: Span<usize>, group: Entries) {
        let list = match key.path {
            "bearing.groove" => &mut self.grooves,
            path => self.lists.entry(path).or_default(),
        };
        list.push((header, group));
    }

    /// Reads a list such as `[[bearing.groove]]`.
    fn groups(&mut self, key: &'static Key, list: &[Spanned<DeValue<'_>>]) -> Option<Value> {
        for element in list {
            let DeValue::Table(table) = element.get_ref() else {
                let message = format!("`{}` is a list of tables", key.path);
                let error = self.error(&element.span(), message).of_key(key.path);
                self.errors
                    .push(error.hinting(format!("write [[{}]] for each", key.path)));
                return None;
            };
            let mut group = Entries::new();
            self.table(key.path, table, &mut group);
            self.keep_group(key, element.span(), group);
        }
        Some(Value::Table)
    }

    /// Reads every `[[bearing]]`, each with lists of its own.
    fn bearings(&mut self, key: &'static Key, list: &[Spanned<DeValue<'_>>]) -> Option<Value> {
        for element in list {
            let DeValue::Table(table) = element.get_ref() else {
                let message = format!("`{}` is a list of tables", key.path);
                let error = self.error(&element.span(), message).of_key(key.path);
                self.errors
                    .push(error.hinting(format!("write [[{}]] for each", key.path)));
                return None;
            };
            let outer = (
                std::mem::take(&mut self.grooves),
                std::mem::take(&mut self.lists),
            );
            let mut entries = Entries::new();
            self.table(key.path, table, &mut entries);
            let (grooves, lists) = (
                std::mem::replace(&mut self.grooves, outer.0),
                std::mem::replace(&mut self.lists, outer.1),
            );
            self.bearings.push(BearingTable {
                header: element.span(),
                entries,
                grooves,
                lists,
            });
        }
        Some(Value::Tables)
    }

    /// Reads `{ value = "..", source = ".." }`.
    fn limit(
        &mut self,
        key: &'static Key,
        span: &Span<usize>,
        table: &DeTable<'_>,
        dimension: Dimension,
        range: Range,
    ) -> Option<Value> {
        let mut limit = None;
        let mut source = String::new();
        for (name, value) in table {
            match (name.get_ref().as_ref(), value.get_ref()) {
                ("value", DeValue::String(text)) => match quantity(text, dimension, range) {
                    Ok(number) => limit = Some(number),
                    Err(refusal) => {
                        let error = refusal.into_error(self.error(&value.span(), ""), key);
                        self.errors.push(error);
                        return None;
                    }
                },
                ("source", DeValue::String(text)) => source = text.clone().into_owned(),
                (_, _) => {
                    let message = format!("`{}` cannot hold this", key.path);
                    let error = self.error(&name.span(), message).of_key(key.path);
                    self.errors.push(error.allowing(limit_form(key)));
                    return None;
                }
            }
        }
        if limit.is_none() {
            let error = self
                .error(span, format!("`{}` has no value", key.path))
                .of_key(key.path);
            self.errors.push(error.allowing(limit_form(key)));
        }
        limit.map(|number| Value::Limit(number, source))
    }
}

fn limit_form(key: &Key) -> String {
    format!("value and source: {}", key.typical)
}

pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() {
        name.to_owned()
    } else {
        format!("{path}.{name}")
    }
}

/// Two digits with a comma between them, as decimals are written in much of the world.
fn has_decimal_comma(line: &str) -> bool {
    line.as_bytes()
        .windows(3)
        .any(|w| w[0].is_ascii_digit() && w[1] == b',' && w[2].is_ascii_digit())
}
