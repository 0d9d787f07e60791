//! One TOML value to SI by the kind of its key, or the reason why not.

use super::error::InputError;
use super::schema::{self, GRID_LIMITS, Key, Kind, Presence, Range};
use super::units::{self, Dimension, QuantityError};
use super::vary::Vary;
use toml::Spanned;
use toml::de::DeValue;

/// A value as read, SI.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A quantity in SI or a bare number.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// Text or one of the words of a choice.
    Text(String),
    /// `true` or `false`.
    Flag(bool),
    /// Two quantities in SI.
    Pair([f64; 2]),
    /// Cells around and along the axis.
    Grid([usize; 2]),
    /// A design limit in SI and its source.
    Limit(f64, String),
    /// The keys that a sweep varies.
    Vary(Vec<Vary>),
    /// A table; its keys are entries of their own.
    Table,
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
}

impl Refusal {
    fn new(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            allowed: None,
            hint: None,
            is_planned: false,
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
        (Kind::Pair(dimension), DeValue::Array(list)) => pair(list, dimension).map(Value::Pair),
        (Kind::Grid, DeValue::Array(list)) => grid(list).map(Value::Grid),
        (Kind::Choice(built, planned), DeValue::String(text)) => choice(text, built, planned),
        (kind, value) => Err(Refusal::new(format!(
            "must be {}, not {}",
            expected(&kind),
            type_name(value)
        ))),
    }
}

/// What a kind looks like in the file.
fn expected(kind: &Kind) -> String {
    match kind {
        Kind::Table => "a table".into(),
        Kind::TableList => "a list of tables".into(),
        Kind::Text | Kind::Choice(..) => "text in quotes".into(),
        Kind::Flag => "true or false".into(),
        Kind::Integer(..) => "a whole number".into(),
        Kind::Number(_) => "a number".into(),
        Kind::Quantity(dimension, _) | Kind::QuantityOrLaw(dimension, _) => {
            format!("a {} in quotes with its unit", dimension.name())
        }
        Kind::Pair(dimension) => {
            let unit = dimension.units().first().copied().unwrap_or_default();
            format!("two quantities, [\"1 {unit}\", \"0 {unit}\"]")
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
        DeValue::Float(_) => "a number",
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
    match integer(value) {
        Some(number) if (low..=high).contains(&number) => Ok(number),
        Some(number) => {
            Err(Refusal::new(format!("is {number}, out of range"))
                .allowing(format!("{low} to {high}")))
        }
        None => Err(
            Refusal::new(format!("must be a whole number, not {}", type_name(value)))
                .allowing(format!("{low} to {high}")),
        ),
    }
}

fn bare_number(value: &DeValue<'_>, range: Range) -> Result<f64, Refusal> {
    let number = match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        #[allow(clippy::cast_precision_loss)] // no study needs 2^53
        _ => integer(value).map(|number| number as f64),
    };
    match number {
        Some(number) if !f64::is_finite(number) => {
            Err(Refusal::new("is not a finite number").allowing(range.to_string()))
        }
        Some(number) if range.contains(number, None) => Ok(number),
        Some(_) => Err(Refusal::new("is out of range").allowing(range.to_string())),
        None => Err(Refusal::new("is not a number that can be read")),
    }
}

/// A quantity in SI, within its range.
pub(super) fn quantity(text: &str, dimension: Dimension, range: Range) -> Result<f64, Refusal> {
    match units::parse(text, dimension) {
        Ok(value) if range.contains(value, Some(dimension)) => Ok(value),
        Ok(_) => Err(Refusal::new("is out of range").allowing(range.to_string())),
        Err(error) => Err(quantity_refusal(&error, text, dimension)),
    }
}

fn quantity_refusal(error: &QuantityError, text: &str, dimension: Dimension) -> Refusal {
    let units = dimension.units();
    let refusal = Refusal::new(error.to_string()).allowing(format!(
        "a {} in {}",
        dimension.name(),
        units.join(", ")
    ));
    match error {
        QuantityError::DecimalComma(with_point) => {
            refusal.hinting(format!("write \"{with_point}\": decimals take a point"))
        }
        QuantityError::MissingUnit => {
            let unit = units.first().copied().unwrap_or_default();
            refusal.hinting(format!(
                "write \"{} {unit}\" if that is the unit",
                text.trim()
            ))
        }
        _ => refusal,
    }
}

fn bare_quantity(value: &DeValue<'_>, dimension: Dimension) -> Refusal {
    let number = match value {
        DeValue::Integer(number) => number.as_str(),
        DeValue::Float(number) => number.as_str(),
        _ => "",
    };
    quantity_refusal(&QuantityError::MissingUnit, number, dimension)
}

fn pair(list: &[Spanned<DeValue<'_>>], dimension: Dimension) -> Result<[f64; 2], Refusal> {
    let [x, y] = list else {
        return Err(Refusal::new(format!(
            "must be {}",
            expected(&Kind::Pair(dimension))
        )));
    };
    let read = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::String(text) => quantity(text, dimension, Range::ANY),
        other @ (DeValue::Integer(_) | DeValue::Float(_)) => Err(bare_quantity(other, dimension)),
        _ => Err(Refusal::new(format!(
            "must be {}",
            expected(&Kind::Pair(dimension))
        ))),
    };
    Ok([read(x)?, read(y)?])
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
            .ok_or_else(refusal)
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
