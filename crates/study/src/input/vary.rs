//! `[sweep] vary`: the keys of the base study that a sweep varies, with the values they take, given
//! as lists or as ranges. What the values mean for the base study is checked case by case.

use super::error::InputError;
use super::read::{MOST_ERRORS, Reading, join};
use super::schema::{self, Key, Kind};
use super::sweep::{KeyStep, VariedKey, VariedValue, steps_of};
use super::units::{self, Dimension};
use super::values::{Value, not_built};
use std::ops::Range as Span;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// More cases than this are a slip of the pen rather than a sweep.
pub(super) const MOST_CASES: usize = 100_000;

/// A varied key as read, with its places in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Vary {
    /// The key and its values.
    pub(super) varied: VariedKey,
    /// Path of the key without indices, as in the table of keys.
    pub(super) schema_path: &'static str,
    /// Bytes of the key.
    pub(super) key_span: Span<usize>,
    /// Bytes of each value; those of a range share its place.
    pub(super) value_spans: Vec<Span<usize>>,
}

/// The values of a list with their places.
type Listed = (Vec<VariedValue>, Vec<Span<usize>>);
/// A number that a range starts or ends with, and its unit; empty for bare numbers.
type Bound = (f64, String);

impl Reading<'_> {
    /// Reads the table of varied keys, in the order of the file.
    pub(super) fn vary(&mut self, table: &DeTable<'_>, span: &Span<usize>) -> Option<Value> {
        if table.is_empty() {
            let error = self
                .error(span, "`sweep.vary` is empty")
                .of_key("sweep.vary");
            self.errors
                .push(error.hinting("name at least one key of the base study and its values"));
            return None;
        }
        let errors_before = self.errors.len();
        let mut found = Vec::new();
        self.vary_table("", table, &mut found);
        found.sort_by_key(|vary| vary.key_span.start);
        self.refuse_overlaps(&found);
        (self.errors.len() == errors_before).then_some(Value::Vary(found))
    }

    /// Walks dotted keys that were written without quotes, which TOML reads as tables in tables.
    fn vary_table(&mut self, prefix: &str, table: &DeTable<'_>, found: &mut Vec<Vary>) {
        for (name, value) in table {
            if self.errors.len() >= MOST_ERRORS {
                return;
            }
            let path = join(prefix, name.get_ref());
            match value.get_ref() {
                DeValue::Table(inner) if !inner.is_empty() && is_section(&path, inner) => {
                    self.vary_table(&path, inner, found);
                }
                _ => match self.vary_key(&path, &name.span(), value) {
                    Ok(vary) => found.push(vary),
                    Err(error) => self.errors.push(*error),
                },
            }
        }
    }

    fn vary_key(
        &self,
        path: &str,
        key_span: &Span<usize>,
        value: &Spanned<DeValue<'_>>,
    ) -> Result<Vary, Box<InputError>> {
        let (key, steps) = self.varied_key(path, key_span)?;
        let is_element = steps.last().is_some_and(|step| step.index.is_some());
        let (values, value_spans) = match value.get_ref() {
            DeValue::Array(list) => self.list(path, &value.span(), list)?,
            DeValue::Table(table) => {
                let values = self.range(path, key, is_element, &value.span(), table)?;
                let spans = vec![value.span(); values.len()];
                (values, spans)
            }
            _ => {
                let message = format!("`{path}` takes a list of values, or a range");
                return Err(Box::new(
                    self.error(&value.span(), message)
                        .of_key(path)
                        .hinting(RANGE_FORM),
                ));
            }
        };
        let sweep = (values.iter().zip(&value_spans)).find(|(value, _)| value.shown == "sweep");
        if let Some((_, span)) = sweep.filter(|_| key.path == "analysis") {
            let error = self
                .error(span, "a case cannot be a sweep itself")
                .of_key(path);
            return Err(Box::new(
                error.hinting("vary the keys of both in one sweep"),
            ));
        }
        let mut varied = VariedKey {
            path: path.to_owned(),
            steps,
            unit: String::new(),
            values,
        };
        set_numbers(&mut varied, dimension_of(key, is_element));
        Ok(Vary {
            varied,
            schema_path: key.path,
            key_span: key_span.clone(),
            value_spans,
        })
    }

    /// The key that a path names, and the way to it; refused where it names none, or none that a
    /// sweep can vary.
    fn varied_key(
        &self,
        path: &str,
        span: &Span<usize>,
    ) -> Result<(&'static Key, Vec<KeyStep>), Box<InputError>> {
        let refuse =
            |message: String| Box::new(self.error(span, message).of_key(path).with_value(path));
        let shown: String = path.chars().take(80).collect();
        let Some(steps) = steps_of(path) else {
            return Err(Box::new(refuse(format!("`{shown}` is no key")).hinting(
                "write \"section.key\", or \"bearing.groove[0].key\" for an element of a list",
            )));
        };
        let names: Vec<&str> = steps.iter().map(|step| step.name.as_str()).collect();
        let plain = names.join(".");
        if plain == "schema" || names[0] == "sweep" {
            return Err(Box::new(
                refuse(format!("`{shown}` cannot be varied")).hinting(
                    "a sweep varies the keys of its base study; a sweep of a sweep is not possible",
                ),
            ));
        }
        let Some(key) = schema::find(&plain) else {
            let error = refuse(format!("unknown key `{shown}` to vary"));
            return Err(Box::new(match schema::nearest(&plain) {
                Some(key) => error.hinting(format!("did you mean `{}`?", key.path)),
                None => error.hinting("`sommerfeld explain` lists the keys"),
            }));
        };
        if !key.is_built() {
            return Err(Box::new(not_built(*refuse(String::new()), key.path)));
        }
        for (at, step) in steps.iter().enumerate() {
            let part = names[..=at].join(".");
            let kind = schema::find(&part).map(|key| key.kind);
            let is_last = at + 1 == steps.len();
            match (kind, step.index) {
                (Some(Kind::TableList), None) if !is_last => {
                    let rest = names[at + 1..].join(".");
                    return Err(Box::new(
                        refuse(format!("`{part}` is a list: say which of its elements"))
                            .hinting(format!("`{part}[0].{rest}` is that of the first")),
                    ));
                }
                (Some(Kind::TableList | Kind::TableOrList), Some(_)) | (_, None) => {}
                (Some(Kind::Pair(..) | Kind::Grid), Some(0 | 1)) if is_last => {}
                (Some(Kind::Pair(..) | Kind::Grid), Some(_)) if is_last => {
                    return Err(Box::new(
                        refuse(format!("`{part}` has two elements")).allowing("[0] and [1]"),
                    ));
                }
                (_, Some(_)) => {
                    return Err(refuse(format!("`{part}` is no list: it takes no index")));
                }
            }
        }
        Ok((key, steps))
    }

    /// Values given one by one.
    fn list(
        &self,
        path: &str,
        span: &Span<usize>,
        list: &[Spanned<DeValue<'_>>],
    ) -> Result<Listed, Box<InputError>> {
        if list.is_empty() {
            let error = self
                .error(span, format!("`{path}` has an empty list of values"))
                .of_key(path);
            return Err(Box::new(
                error.hinting("give at least one value, or take the key out"),
            ));
        }
        if list.len() > MOST_CASES {
            return Err(self.too_many(path, span, list.len()));
        }
        let values = list.iter().map(|value| {
            let toml = self.text.get(value.span()).unwrap_or_default().to_owned();
            let shown = match value.get_ref() {
                DeValue::String(text) => text.trim().to_owned(),
                _ => toml.split_whitespace().collect::<Vec<_>>().join(" "),
            };
            VariedValue {
                toml,
                shown,
                number: None,
            }
        });
        Ok((
            values.collect(),
            list.iter().map(|value| value.span()).collect(),
        ))
    }

    fn too_many(&self, path: &str, span: &Span<usize>, count: usize) -> Box<InputError> {
        let message = format!("`{path}` takes {count} values");
        Box::new(
            self.error(span, message)
                .of_key(path)
                .allowing(format!("at most {MOST_CASES} cases")),
        )
    }

    /// Values of `{ from = "..", to = "..", count = .., scale = ".." }`.
    fn range(
        &self,
        path: &str,
        key: &Key,
        is_element: bool,
        span: &Span<usize>,
        table: &DeTable<'_>,
    ) -> Result<Vec<VariedValue>, Box<InputError>> {
        let refuse = |span: &Span<usize>, message: String| {
            Box::new(self.error(span, message).of_key(path).hinting(RANGE_FORM))
        };
        let is_number = matches!(key.kind, Kind::Number(_) | Kind::Integer(..))
            || (is_element && matches!(key.kind, Kind::Grid));
        let dimension = dimension_of(key, is_element);
        if !is_number && dimension.is_none() {
            let message = format!("`{path}` has no range: its values are not numbers");
            return Err(Box::new(
                self.error(span, message)
                    .of_key(path)
                    .hinting("give a list of its values"),
            ));
        }
        if let Some((name, _)) = table
            .iter()
            .find(|(name, _)| !["from", "to", "count", "scale"].contains(&name.get_ref().as_ref()))
        {
            let message = format!("a range has no `{}`", name.get_ref());
            return Err(refuse(&name.span(), message));
        }
        let given = |name: &str| {
            let found = table.iter().find(|(key, _)| key.get_ref() == name);
            found.map(|(_, value)| value)
        };
        let due = |name: &str| {
            given(name)
                .ok_or_else(|| refuse(span, format!("the range of `{path}` has no `{name}`")))
        };
        let (from, to, count) = (due("from")?, due("to")?, due("count")?);
        let bound = |value: &Spanned<DeValue<'_>>| {
            read_bound(value.get_ref(), dimension)
                .map_err(|why| refuse(&value.span(), format!("the range of `{path}` {why}")))
        };
        let ((first, unit), (last, other)) = (bound(from)?, bound(to)?);
        if unit != other {
            let message = format!("the range of `{path}` goes from `{unit}` to `{other}`");
            return Err(Box::new(
                self.error(&to.span(), message)
                    .of_key(path)
                    .hinting("give both ends in the same unit"),
            ));
        }
        let number = self.range_count(path, count)?;
        let is_log = match given("scale") {
            Some(scale) => self.is_logarithmic(path, scale, first.min(last))?,
            None => false,
        };
        Ok(spread(first, last, number, is_log)
            .map(|value| range_value(value, &unit))
            .collect())
    }

    fn range_count(
        &self,
        path: &str,
        count: &Spanned<DeValue<'_>>,
    ) -> Result<usize, Box<InputError>> {
        let number = count.get_ref().as_integer();
        let number = number.and_then(|n| i64::from_str_radix(n.as_str(), n.radix()).ok());
        let number = number.and_then(|n| usize::try_from(n).ok());
        number
            .filter(|n| (2..=MOST_CASES).contains(n))
            .ok_or_else(|| {
                let message = format!("the `count` of `{path}` is not a number of values");
                Box::new(
                    self.error(&count.span(), message)
                        .of_key(path)
                        .allowing(format!("a whole number from 2 to {MOST_CASES}")),
                )
            })
    }

    /// Whether the scale of a range is logarithmic; `least` is its smaller end.
    fn is_logarithmic(
        &self,
        path: &str,
        scale: &Spanned<DeValue<'_>>,
        least: f64,
    ) -> Result<bool, Box<InputError>> {
        let refuse = |message: String| self.error(&scale.span(), message).of_key(path);
        match scale.get_ref().as_str() {
            Some("linear") => Ok(false),
            Some("log") if least > 0.0 => Ok(true),
            Some("log") => Err(Box::new(
                refuse(format!("the range of `{path}` reaches 0 or less"))
                    .hinting("a logarithmic range needs both ends above 0"),
            )),
            _ => Err(Box::new(
                refuse(format!("the range of `{path}` has an unknown scale"))
                    .allowing("\"linear\", \"log\""),
            )),
        }
    }

    /// One key, one list: a key varied twice, or within another one, would have two values.
    fn refuse_overlaps(&mut self, found: &[Vary]) {
        for (at, vary) in found.iter().enumerate() {
            let clash = found[..at].iter().find(|earlier| {
                let (a, b) = (&earlier.varied.steps, &vary.varied.steps);
                a.iter().zip(b).all(|(a, b)| {
                    a.name == b.name
                        && (a.index == b.index || a.index.is_none() || b.index.is_none())
                })
            });
            if let Some(earlier) = clash {
                let message = format!(
                    "`{}` would be set twice: `{}` is varied, too",
                    vary.varied.path, earlier.varied.path
                );
                let error = self
                    .error(&vary.key_span, message)
                    .of_key(&vary.varied.path);
                self.errors.push(error.hinting("keep one of the two"));
            }
        }
    }
}

const RANGE_FORM: &str =
    "a list: [\"60 um\", \"72 um\"]; a range: { from = \"40 um\", to = \"120 um\", count = 9 }";

/// A table inside `vary` that leads on to keys, not a range of the key it belongs to.
fn is_section(path: &str, table: &DeTable<'_>) -> bool {
    let looks_like_range = ["from", "to", "count"]
        .iter()
        .any(|name| table.iter().any(|(key, _)| key.get_ref() == name));
    let names: Option<Vec<String>> =
        steps_of(path).map(|steps| steps.into_iter().map(|step| step.name).collect());
    let kind = names.and_then(|names| schema::find(&names.join(".")).map(|key| key.kind));
    let holds_keys = matches!(
        kind,
        None | Some(Kind::Table | Kind::TableList | Kind::TableOrList | Kind::QuantityOrLaw(..))
    );
    holds_keys && !looks_like_range
}

/// The dimension of the values of a key, or of an element of its pair.
fn dimension_of(key: &Key, is_element: bool) -> Option<Dimension> {
    match key.kind {
        Kind::Quantity(dimension, _) | Kind::QuantityOrLaw(dimension, _) => Some(dimension),
        Kind::Pair(dimension, _) if is_element => Some(dimension),
        _ => None,
    }
}

fn read_bound(value: &DeValue<'_>, dimension: Option<Dimension>) -> Result<Bound, String> {
    match (dimension, value) {
        (Some(dimension), DeValue::String(text)) => match units::parse(text, dimension) {
            Ok(_) => units::split(text)
                .map(|(number, unit)| (number, unit.to_owned()))
                .ok_or_else(|| "cannot be read".to_owned()),
            Err(error) => Err(error.to_string()),
        },
        (Some(dimension), _) => Err(format!(
            "needs a {} in quotes with its unit",
            dimension.name()
        )),
        (None, _) => bare(value)
            .map(|number| (number, String::new()))
            .ok_or_else(|| "needs a bare number".to_owned()),
    }
}

/// A bare, finite number.
fn bare(value: &DeValue<'_>) -> Option<f64> {
    let text = match value {
        DeValue::Float(float) => float.as_str(),
        DeValue::Integer(integer) => integer.as_str(),
        _ => return None,
    };
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// `count` values from `first` to `last`, both included, without the round-off of the spacing.
fn spread(first: f64, last: f64, count: usize, is_log: bool) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| {
        if index == 0 || index + 1 == count {
            return if index == 0 { first } else { last };
        }
        let share = index as f64 / (count - 1) as f64;
        let value = if is_log {
            first * (last / first).powf(share)
        } else {
            first + (last - first) * share
        };
        format!("{value:.11e}").parse().unwrap_or(value)
    })
}

fn range_value(value: f64, unit: &str) -> VariedValue {
    let shown = format!("{value} {unit}").trim_end().to_owned();
    let toml = if unit.is_empty() {
        shown.clone()
    } else {
        format!("\"{shown}\"")
    };
    VariedValue {
        toml,
        shown,
        number: None,
    }
}

/// Sets the numbers of the values: in the unit that all of them share, or else in SI; none where
/// the values are not all numbers.
fn set_numbers(varied: &mut VariedKey, dimension: Option<Dimension>) {
    let numbers: Option<Vec<f64>>;
    let Some(dimension) = dimension else {
        numbers = varied
            .values
            .iter()
            .map(|value| value.toml.parse().ok().filter(|n: &f64| n.is_finite()))
            .collect();
        return store(varied, numbers, "-");
    };
    let split: Option<Vec<(f64, &str)>> = varied
        .values
        .iter()
        .map(|value| units::split(&value.shown))
        .collect();
    let Some(split) = split else { return };
    let unit = split[0].1.to_owned();
    if split.iter().all(|(_, other)| *other == unit) {
        let numbers = split.into_iter().map(|(number, _)| number).collect();
        return store(varied, Some(numbers), &unit);
    }
    numbers = varied
        .values
        .iter()
        .map(|value| units::parse(&value.shown, dimension).ok())
        .collect();
    store(varied, numbers, dimension.si_unit());
}

fn store(varied: &mut VariedKey, numbers: Option<Vec<f64>>, unit: &str) {
    let Some(numbers) = numbers else { return };
    unit.clone_into(&mut varied.unit);
    for (value, number) in varied.values.iter_mut().zip(numbers) {
        value.number = Some(number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hit_their_ends_and_round_numbers() {
        let linear: Vec<f64> = spread(40.0, 120.0, 9, false).collect();
        assert_eq!(
            linear,
            [40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0]
        );
        let third: Vec<f64> = spread(0.1, 0.4, 4, false).collect();
        assert_eq!(third, [0.1, 0.2, 0.3, 0.4]);
        let log: Vec<f64> = spread(1.0, 1000.0, 4, true).collect();
        assert_eq!(log, [1.0, 10.0, 100.0, 1000.0]);
    }
}
