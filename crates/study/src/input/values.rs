//! One TOML value to SI by the kind of its key, or the reason why not.

use super::error::InputError;
use super::schema::{self, GRID_LIMITS, Key, Kind, Presence, Range};
use super::units::{self, Dimension, QuantityError};
use super::vary::Vary;
use toml::Spanned;
use toml::de::DeValue;

/// Longest number that is repeated in a hint, characters.
const NUMBER_SHOWN: usize = 30;

/// A value as read, SI.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A quantity in SI or a bare number.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// Text or one of the words of a choice.
    Text(String),
    /// Words of a list, each once.
    Words(Vec<String>),
    /// `true` or `false`.
    Flag(bool),
    /// Two quantities in SI.
    Pair([f64; 2]),
    /// Quantities in SI, one or more.
    List(Vec<f64>),
    /// Cells around and along the axis.
    Grid([usize; 2]),
    /// A design limit in SI and its source.
    Limit(f64, String),
    /// The keys that a sweep varies.
    Vary(Vec<Vary>),
    /// Whole numbers, one or more.
    Integers(Vec<i64>),
    /// A table; its keys are entries of their own.
    Table,
    /// Tables; each has its own entries.
    Tables,
    /// Given, but refused with an error of its own: not to be reported as missing, too.
    Unreadable,
}

/// Fills in the message for a key or value that is planned.
pub(super) fn not_built(mut error: InputError, what: &str) -> InputError {
    error.message = format!(
        "{what} is not built yet in version {}",
        env!("CARGO_PKG_VERSION")
    );
    error
}

/// The default of a key, read like a value of the file; `None` without one.
pub(super) fn default_value(key: &Key) -> Option<Value> {
    let Presence::Default(text) = key.presence else {
        return None;
    };
    let quoted = format!("\"{text}\"");
    let is_text = matches!(
        key.kind,
        Kind::Text | Kind::Choice(..) | Kind::Quantity(..) | Kind::QuantityOrLaw(..)
    );
    let value = DeValue::parse(if is_text { &quoted } else { text }).ok()?;
    plain_value(key, value.get_ref()).ok()
}

/// Why a value is refused: message (the key is put before it), allowed, hint.
pub(super) struct Refusal {
    message: String,
    allowed: Option<String>,
    hint: Option<String>,
    /// The message is about a planned value.
    is_planned: bool,
    /// What the key means is the best hint.
    is_out_of_range: bool,
    /// Bytes of the part that is wrong, of a list.
    pub(super) part: Option<std::ops::Range<usize>>,
}

impl Refusal {
    fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            allowed: None,
            hint: None,
            is_planned: false,
            is_out_of_range: false,
            part: None,
        }
    }

    fn out_of_range(range: Range) -> Self {
        Self {
            is_out_of_range: true,
            ..Self::new("is out of range").allowing(range.to_string())
        }
    }

    fn allowing(mut self, allowed: impl Into<String>) -> Self {
        self.allowed = Some(allowed.into());
        self
    }

    fn hinting(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    pub(super) fn into_error(self, place: InputError, key: &Key) -> InputError {
        let mut error = place.of_key(key.path);
        if self.is_planned {
            error = not_built(error, &format!("{} = {}", key.path, self.message));
        } else {
            error.message = format!("`{}` {}", key.path, self.message);
        }
        error.allowed = self.allowed;
        error.hint = self.hint;
        if self.is_out_of_range && error.hint.is_none() {
            // Its first sentence; `explain` has the rest.
            let end = key
                .meaning
                .find(". ")
                .map_or(key.meaning.len(), |end| end + 1);
            error.hint = Some(key.meaning[..end].to_owned());
        }
        error
    }
}

/// Reads a value that is no table.
pub(super) fn plain_value(key: &Key, value: &DeValue<'_>) -> Result<Value, Refusal> {
    match (key.kind, value) {
        (Kind::Text, DeValue::String(text)) => Ok(Value::Text(text.clone().into_owned())),
        (Kind::Flag, DeValue::Boolean(flag)) => Ok(Value::Flag(*flag)),
        (Kind::Integer(low, high), _) => whole_number(value, low, high).map(Value::Integer),
        (Kind::Number(range), DeValue::Integer(_) | DeValue::Float(_)) => {
            bare_number(value, range).map(Value::Number)
        }
        (Kind::Number(_), DeValue::String(_)) => Err(Refusal::new(
            "is dimensionless: a bare number, no quotes and no unit",
        )),
        (
            Kind::Quantity(dimension, range) | Kind::QuantityOrLaw(dimension, range),
            DeValue::String(text),
        ) => quantity(text, dimension, range).map(Value::Number),
        (
            Kind::Quantity(dimension, _) | Kind::QuantityOrLaw(dimension, _),
            DeValue::Integer(_) | DeValue::Float(_),
        ) => Err(bare_quantity(value, dimension)),
        (Kind::Pair(dimension, range), DeValue::Array(list)) => {
            pair(list, dimension, range).map(Value::Pair)
        }
        (Kind::List(dimension, range), DeValue::Array(list)) => {
            quantities(list, dimension, range).map(Value::List)
        }
        (Kind::List(dimension, range), DeValue::String(text)) => {
            quantity(text, dimension, range).map(|one| Value::List(vec![one]))
        }
        (Kind::Integers(low, high), DeValue::Integer(_)) => {
            whole_number(value, low, high).map(|one| Value::Integers(vec![one]))
        }
        (Kind::Integers(low, high), DeValue::Array(list)) => {
            whole_numbers(list, low, high).map(Value::Integers)
        }
        (Kind::Numbers(range), DeValue::Integer(_) | DeValue::Float(_)) => {
            bare_number(value, range).map(|one| Value::List(vec![one]))
        }
        (Kind::Numbers(range), DeValue::Array(list)) => numbers(list, range).map(Value::List),
        (Kind::Files, DeValue::String(text)) => Ok(Value::Words(vec![text.to_string()])),
        (Kind::Files, DeValue::Array(list)) => files(list).map(Value::Words),
        (Kind::Grid, DeValue::Array(list)) => grid(list).map(Value::Grid),
        (Kind::Choice(built, planned), DeValue::String(text)) => choice(text, built, planned),
        (Kind::Words(built), DeValue::Array(list)) => words(list, built),
        (kind, value) => {
            let refusal = Refusal::new(format!(
                "must be {}, not {}",
                expected(&kind),
                type_name(value)
            ));
            Err(match (kind, key.example()) {
                (Kind::Table | Kind::TableOrList, _) => refusal.hinting(format!(
                    "write [{}] in a line of its own and its keys below",
                    key.path
                )),
                (_, Some(example)) => {
                    refusal.hinting(format!("for example {} = {example}", key.name()))
                }
                _ => refusal,
            })
        }
    }
}

/// What a kind looks like in the file.
fn expected(kind: &Kind) -> String {
    match kind {
        Kind::Table => "a table".into(),
        Kind::TableList => "a list of tables".into(),
        Kind::TableOrList => "a table, or a list of tables".into(),
        Kind::Text | Kind::Choice(..) => "text in quotes".into(),
        Kind::Flag => "true or false".into(),
        Kind::Integer(..) => "a whole number".into(),
        Kind::Number(_) => "a number".into(),
        Kind::Quantity(dimension, _) | Kind::QuantityOrLaw(dimension, _) => {
            format!("a {} in quotes with its unit", dimension.name())
        }
        Kind::Pair(dimension, _) => {
            let unit = dimension.units().first().copied().unwrap_or_default();
            format!("two quantities, [\"1 {unit}\", \"0 {unit}\"]")
        }
        Kind::List(dimension, _) => {
            let unit = dimension.units().first().copied().unwrap_or_default();
            format!("a list of quantities, [\"1 {unit}\", \"2 {unit}\"]")
        }
        Kind::Integers(..) => "a list of whole numbers, [1, 2]".into(),
        Kind::Numbers(_) => "a number, or a list of them".into(),
        Kind::Files => "the path of a file in quotes, or a list of them".into(),
        Kind::Words(built) => {
            let first = built.first().copied().unwrap_or_default();
            format!("a list of words, [\"{first}\"]")
        }
        Kind::Grid => "two whole numbers, [128, 32]".into(),
        Kind::Limit(..) => "a table { value = \"..\", source = \"..\" }".into(),
        Kind::Vary => "a table of keys with their values".into(),
        Kind::NotBuilt => "left out".into(),
    }
}

fn type_name(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a decimal number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

fn integer(value: &DeValue<'_>) -> Option<i64> {
    let number = value.as_integer()?;
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

fn whole_number(value: &DeValue<'_>, low: i64, high: i64) -> Result<i64, Refusal> {
    let allowed = if low == high {
        low.to_string()
    } else {
        format!("{low} to {high}")
    };
    let refusal = match (integer(value), value) {
        (Some(number), _) if (low..=high).contains(&number) => return Ok(number),
        (Some(_), _) | (None, DeValue::Integer(_)) => Refusal {
            is_out_of_range: true,
            ..Refusal::new("is out of range")
        },
        (None, _) => Refusal::new(format!("must be a whole number, not {}", type_name(value))),
    };
    Err(refusal.allowing(allowed))
}

fn bare_number(value: &DeValue<'_>, range: Range) -> Result<f64, Refusal> {
    let number = match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        #[allow(clippy::cast_precision_loss)] // no study needs 2^53
        _ => integer(value).map(|number| number as f64).or_else(|| {
            let digits = value.as_integer()?;
            (digits.radix() == 10).then(|| digits.as_str().parse().ok())?
        }),
    };
    match number {
        Some(number) if !f64::is_finite(number) => {
            Err(Refusal::new("is not a finite number").allowing(range.to_string()))
        }
        Some(number) if range.contains(number, None) => Ok(number),
        Some(_) => Err(Refusal::out_of_range(range)),
        None => Err(Refusal::new("is not a number that can be read").allowing(range.to_string())),
    }
}

/// A quantity in SI, within its range.
pub(super) fn quantity(text: &str, dimension: Dimension, range: Range) -> Result<f64, Refusal> {
    match units::parse(text, dimension) {
        Ok(value) if range.contains(value, Some(dimension)) => Ok(value),
        Ok(_) => Err(Refusal::out_of_range(range)),
        Err(error) => Err(quantity_refusal(&error, text, dimension)),
    }
}

fn quantity_refusal(error: &QuantityError, text: &str, dimension: Dimension) -> Refusal {
    let units = dimension.units();
    let refusal = Refusal::new(error.to_string()).allowing(format!(
        "{} in {}",
        dimension.with_article(),
        units.join(", ")
    ));
    match error {
        QuantityError::DecimalComma(plain) if is_perhaps_grouped(plain) => {
            let grouped = plain.replacen('.', "", 1);
            refusal.hinting(format!(
                "write \"{plain}\" or \"{grouped}\": decimals take a point, thousands nothing"
            ))
        }
        QuantityError::DecimalComma(plain) => {
            refusal.hinting(format!("write \"{plain}\": decimals take a point"))
        }
        QuantityError::GroupedDigits(plain) => {
            refusal.hinting(format!("write \"{plain}\": thousands are not set apart"))
        }
        QuantityError::ForeignMinus(plain) => refusal.hinting(format!("write \"{plain}\"")),
        QuantityError::UnknownUnit(unit) => match dimension.meant_unit(unit) {
            Some(meant) => refusal.hinting(format!("did you mean `{meant}`?")),
            None => refusal,
        },
        QuantityError::MissingUnit => {
            let unit = units.first().copied().unwrap_or_default();
            let number: String = text.trim().chars().take(NUMBER_SHOWN).collect();
            refusal.hinting(format!("write \"{number} {unit}\" if that is the unit"))
        }
        _ => refusal,
    }
}

/// Three digits behind the point: what stood there may have set thousands apart.
fn is_perhaps_grouped(plain: &str) -> bool {
    let behind = plain.split_once('.').map_or("", |(_, behind)| behind);
    behind.bytes().take_while(u8::is_ascii_digit).count() == 3 && !plain.starts_with("0.")
}

fn bare_quantity(value: &DeValue<'_>, dimension: Dimension) -> Refusal {
    let number = match value {
        DeValue::Integer(number) => number.as_str(),
        DeValue::Float(number) => number.as_str(),
        _ => "",
    };
    quantity_refusal(&QuantityError::MissingUnit, number, dimension)
}

fn pair(
    list: &[Spanned<DeValue<'_>>],
    dimension: Dimension,
    range: Range,
) -> Result<[f64; 2], Refusal> {
    let [x, y] = list else {
        return Err(Refusal::new(format!(
            "must be {}",
            expected(&Kind::Pair(dimension, range))
        )));
    };
    let read = |value: &Spanned<DeValue<'_>>| {
        let read = match value.get_ref() {
            DeValue::String(text) => quantity(text, dimension, range),
            other @ (DeValue::Integer(_) | DeValue::Float(_)) => {
                Err(bare_quantity(other, dimension))
            }
            _ => Err(Refusal::new(format!(
                "must be {}",
                expected(&Kind::Pair(dimension, range))
            ))),
        };
        read.map_err(|refusal| Refusal {
            part: Some(value.span()),
            ..refusal
        })
    };
    Ok([read(x)?, read(y)?])
}

/// More quantities than this in a list are no answer to a question.
const LONGEST_LIST: usize = 1000;

fn quantities(
    list: &[Spanned<DeValue<'_>>],
    dimension: Dimension,
    range: Range,
) -> Result<Vec<f64>, Refusal> {
    let wanted = || expected(&Kind::List(dimension, range));
    if list.is_empty() || list.len() > LONGEST_LIST {
        return Err(Refusal::new(format!(
            "has {} values; it must be {}",
            list.len(),
            wanted()
        ))
        .allowing(format!("1 to {LONGEST_LIST} values")));
    }
    list.iter()
        .map(|value| {
            let read = match value.get_ref() {
                DeValue::String(text) => quantity(text, dimension, range),
                other @ (DeValue::Integer(_) | DeValue::Float(_)) => {
                    Err(bare_quantity(other, dimension))
                }
                _ => Err(Refusal::new(format!("must be {}", wanted()))),
            };
            read.map_err(|refusal| Refusal {
                part: Some(value.span()),
                ..refusal
            })
        })
        .collect()
}

fn whole_numbers(list: &[Spanned<DeValue<'_>>], low: i64, high: i64) -> Result<Vec<i64>, Refusal> {
    if list.is_empty() || list.len() > LONGEST_LIST {
        return Err(Refusal::new(format!("has {} values", list.len()))
            .allowing(format!("1 to {LONGEST_LIST} values")));
    }
    list.iter()
        .map(|value| {
            whole_number(value.get_ref(), low, high).map_err(|refusal| Refusal {
                part: Some(value.span()),
                ..refusal
            })
        })
        .collect()
}

fn numbers(list: &[Spanned<DeValue<'_>>], range: Range) -> Result<Vec<f64>, Refusal> {
    if list.is_empty() || list.len() > LONGEST_LIST {
        return Err(Refusal::new(format!("has {} values", list.len()))
            .allowing(format!("1 to {LONGEST_LIST} values")));
    }
    list.iter()
        .map(|value| {
            let number = match value.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) => bare_number(value.get_ref(), range),
                other => Err(Refusal::new(format!(
                    "must be bare numbers, not {}",
                    type_name(other)
                ))),
            };
            number.map_err(|refusal| Refusal {
                part: Some(value.span()),
                ..refusal
            })
        })
        .collect()
}

fn files(list: &[Spanned<DeValue<'_>>]) -> Result<Vec<String>, Refusal> {
    if list.is_empty() || list.len() > LONGEST_LIST {
        return Err(Refusal::new(format!("has {} files", list.len()))
            .allowing(format!("1 to {LONGEST_LIST} files")));
    }
    list.iter()
        .map(|value| match value.get_ref() {
            DeValue::String(text) => Ok(text.to_string()),
            other => Err(Refusal {
                part: Some(value.span()),
                ..Refusal::new(format!("must be paths in quotes, not {}", type_name(other)))
            }),
        })
        .collect()
}

fn words(list: &[Spanned<DeValue<'_>>], built: &'static [&'static str]) -> Result<Value, Refusal> {
    let mut words: Vec<String> = Vec::new();
    for value in list {
        let at = |refusal: Refusal| Refusal {
            part: Some(value.span()),
            ..refusal
        };
        let DeValue::String(text) = value.get_ref() else {
            let wanted = expected(&Kind::Words(built));
            return Err(at(Refusal::new(format!("must be {wanted}"))));
        };
        choice(text, built, &[]).map_err(at)?;
        if words.iter().any(|word| word == text) {
            return Err(at(Refusal::new("stands in the list twice")));
        }
        words.push(text.to_string());
    }
    Ok(Value::Words(words))
}

fn grid(list: &[Spanned<DeValue<'_>>]) -> Result<[usize; 2], Refusal> {
    let [[around_low, around_high], [axial_low, axial_high]] = GRID_LIMITS;
    let refusal = || {
        Refusal::new("must be two whole numbers of cells").allowing(format!(
            "[around, axial], {around_low} to {around_high} around, {axial_low} to {axial_high} axial"
        ))
    };
    let [around, axial] = list else {
        return Err(refusal());
    };
    let cells = |value: &Spanned<DeValue<'_>>, low, high| {
        whole_number(value.get_ref(), low, high)
            .ok()
            .and_then(|number| usize::try_from(number).ok())
            .ok_or_else(|| Refusal {
                part: Some(value.span()),
                ..refusal()
            })
    };
    Ok([
        cells(around, around_low, around_high)?,
        cells(axial, axial_low, axial_high)?,
    ])
}

fn choice(text: &str, built: &[&'static str], planned: &[&'static str]) -> Result<Value, Refusal> {
    if built.contains(&text) {
        return Ok(Value::Text(text.to_owned()));
    }
    if planned.contains(&text) {
        let mut refusal = Refusal::new(format!("\"{text}\"")).allowing(built.join(", "));
        refusal.is_planned = true;
        return Err(refusal);
    }
    let shown: String = text.chars().take(40).collect();
    let refusal =
        Refusal::new(format!("cannot be \"{}\"", shown.escape_debug())).allowing(built.join(", "));
    Err(match schema::nearest_word(built, text) {
        Some(word) => refusal.hinting(format!("did you mean \"{word}\"?")),
        None => refusal,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::keys::KEYS;

    #[test]
    fn every_default_is_a_valid_value_of_its_key() {
        for key in KEYS {
            if let Presence::Default(text) = key.presence {
                assert!(default_value(key).is_some(), "{} = {text}", key.path);
            }
        }
    }
}
