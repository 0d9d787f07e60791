//! Quantities with units, `"48 mm"` to 0.048 m: the one place where text becomes SI.
//!
//! A quantity is a number, then a unit of the dimension that its key asks for. `m.s`, `m s`, `m*s`
//! and `m·s` are the same unit, so are `m2` and `m^2`. A bare number is refused: whether 72 means
//! millimetres or micrometres is not for a program to guess.

use std::f64::consts::PI;
use std::fmt;

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// m
    Length,
    /// rad
    Angle,
    /// rad/s
    AngularSpeed,
    /// 1/s
    Rate,
    /// Pa, gauge
    Pressure,
    /// K
    Temperature,
    /// K, of a difference or offset: no zero point
    TemperatureDifference,
    /// N
    Force,
    /// N m
    Moment,
    /// kg
    Mass,
    /// Pa s
    DynamicViscosity,
    /// m2/s
    KinematicViscosity,
    /// kg/m3
    Density,
    /// W
    Power,
    /// m3/s
    VolumeFlow,
    /// Pa s/m3: pressure drop per volume flow
    FlowResistance,
    /// kg m2
    Inertia,
    /// kg m: mass times its distance from an axis
    MassMoment,
    /// m/s2
    Acceleration,
    /// N/m
    Stiffness,
    /// N m/rad: moment per angle of twist or tilt
    TorsionalStiffness,
    /// N m s/rad
    TorsionalDamping,
    /// N m2: stiffness EI or GJ of a section
    SectionStiffness,
    /// J
    Energy,
    /// 1/Pa: how a logarithm follows the pressure
    PressureCoefficient,
    /// 1/K: how a length or volume follows the temperature
    ThermalExpansion,
    /// J/(kg K)
    HeatCapacity,
    /// J/(kg K2): how the heat capacity follows the temperature
    HeatCapacitySlope,
    /// W/(m K)
    Conductivity,
    /// W/(m K2): how the conductivity follows the temperature
    ConductivitySlope,
    /// W/K: heat per difference of temperatures
    Conductance,
    /// W/(m2 K)
    HeatTransfer,
    /// 1/Pa: volume worn per load and sliding distance
    WearCoefficient,
    /// s
    Time,
}

/// One unit: name, factor to SI and the SI value of its zero.
type Unit = (&'static str, f64, f64);

/// Longest piece of a text that is shown, characters.
const TEXT_SHOWN: usize = 40;

const DEGREE: f64 = PI / 180.0;
const REVOLUTION_PER_MINUTE: f64 = PI / 30.0;
/// 0 degC in K.
const CELSIUS_ZERO: f64 = 273.15;

const LENGTH: &[Unit] = &[
    ("mm", 1e-3, 0.0),
    ("um", 1e-6, 0.0),
    ("m", 1.0, 0.0),
    ("cm", 1e-2, 0.0),
    ("nm", 1e-9, 0.0),
];
const ANGLE: &[Unit] = &[
    ("deg", DEGREE, 0.0),
    ("rad", 1.0, 0.0),
    ("mrad", 1e-3, 0.0),
    ("urad", 1e-6, 0.0),
];
const ANGULAR_SPEED: &[Unit] = &[
    ("rpm", REVOLUTION_PER_MINUTE, 0.0),
    ("rad/s", 1.0, 0.0),
    ("deg/s", DEGREE, 0.0),
    ("1/min", REVOLUTION_PER_MINUTE, 0.0),
];
const RATE: &[Unit] = &[("1/s", 1.0, 0.0)];
const PRESSURE: &[Unit] = &[
    ("bar", 1e5, 0.0),
    ("MPa", 1e6, 0.0),
    ("Pa", 1.0, 0.0),
    ("kPa", 1e3, 0.0),
    ("GPa", 1e9, 0.0),
    ("N/mm2", 1e6, 0.0),
];
const TEMPERATURE: &[Unit] = &[("degC", 1.0, CELSIUS_ZERO), ("K", 1.0, 0.0)];
const TEMPERATURE_DIFFERENCE: &[Unit] = &[("K", 1.0, 0.0)];
const FORCE: &[Unit] = &[("N", 1.0, 0.0), ("kN", 1e3, 0.0), ("MN", 1e6, 0.0)];
const MOMENT: &[Unit] = &[("N.m", 1.0, 0.0), ("kN.m", 1e3, 0.0), ("N.mm", 1e-3, 0.0)];
const MASS: &[Unit] = &[("kg", 1.0, 0.0), ("g", 1e-3, 0.0), ("t", 1e3, 0.0)];
const DYNAMIC_VISCOSITY: &[Unit] = &[("mPa.s", 1e-3, 0.0), ("Pa.s", 1.0, 0.0), ("cP", 1e-3, 0.0)];
const KINEMATIC_VISCOSITY: &[Unit] =
    &[("mm2/s", 1e-6, 0.0), ("m2/s", 1.0, 0.0), ("cSt", 1e-6, 0.0)];
const DENSITY: &[Unit] = &[("kg/m3", 1.0, 0.0), ("g/cm3", 1e3, 0.0), ("kg/l", 1e3, 0.0)];
const POWER: &[Unit] = &[("W", 1.0, 0.0), ("kW", 1e3, 0.0)];
const VOLUME_FLOW: &[Unit] = &[
    ("m3/s", 1.0, 0.0),
    ("cm3/s", 1e-6, 0.0),
    ("l/min", 1e-3 / 60.0, 0.0),
];
const FLOW_RESISTANCE: &[Unit] = &[
    ("bar.s/cm3", 1e11, 0.0),
    ("Pa.s/m3", 1.0, 0.0),
    ("bar.min/l", 6e9, 0.0),
];
const INERTIA: &[Unit] = &[
    ("kg.m2", 1.0, 0.0),
    ("kg.cm2", 1e-4, 0.0),
    ("kg.mm2", 1e-6, 0.0),
    ("g.m2", 1e-3, 0.0),
];
const MASS_MOMENT: &[Unit] = &[
    ("kg.m", 1.0, 0.0),
    ("kg.mm", 1e-3, 0.0),
    ("g.mm", 1e-6, 0.0),
    ("g.cm", 1e-5, 0.0),
];
const ACCELERATION: &[Unit] = &[("m/s2", 1.0, 0.0)];
const STIFFNESS: &[Unit] = &[
    ("N/m", 1.0, 0.0),
    ("N/mm", 1e3, 0.0),
    ("kN/mm", 1e6, 0.0),
    ("MN/m", 1e6, 0.0),
    ("N/um", 1e6, 0.0),
];
const TORSIONAL_STIFFNESS: &[Unit] = &[
    ("N.m/rad", 1.0, 0.0),
    ("kN.m/rad", 1e3, 0.0),
    ("MN.m/rad", 1e6, 0.0),
];
const TORSIONAL_DAMPING: &[Unit] = &[("N.m.s/rad", 1.0, 0.0)];
const SECTION_STIFFNESS: &[Unit] = &[("N.m2", 1.0, 0.0), ("kN.m2", 1e3, 0.0), ("MN.m2", 1e6, 0.0)];
const ENERGY: &[Unit] = &[("J", 1.0, 0.0), ("kJ", 1e3, 0.0)];
const PRESSURE_COEFFICIENT: &[Unit] = &[
    ("1/Pa", 1.0, 0.0),
    ("1/GPa", 1e-9, 0.0),
    ("1/MPa", 1e-6, 0.0),
];
const THERMAL_EXPANSION: &[Unit] = &[("1/K", 1.0, 0.0)];
const HEAT_CAPACITY: &[Unit] = &[("J/(kg.K)", 1.0, 0.0), ("kJ/(kg.K)", 1e3, 0.0)];
const HEAT_CAPACITY_SLOPE: &[Unit] = &[("J/(kg.K2)", 1.0, 0.0)];
const CONDUCTIVITY: &[Unit] = &[("W/(m.K)", 1.0, 0.0)];
const CONDUCTIVITY_SLOPE: &[Unit] = &[("W/(m.K2)", 1.0, 0.0)];
const CONDUCTANCE: &[Unit] = &[("W/K", 1.0, 0.0)];
const HEAT_TRANSFER: &[Unit] = &[("W/(m2.K)", 1.0, 0.0), ("kW/(m2.K)", 1e3, 0.0)];
const WEAR_COEFFICIENT: &[Unit] = &[
    ("1/Pa", 1.0, 0.0),
    ("m2/N", 1.0, 0.0),
    ("mm3/(N.m)", 1e-9, 0.0),
];
const TIME: &[Unit] = &[("h", 3600.0, 0.0), ("min", 60.0, 0.0), ("s", 1.0, 0.0)];

/// All dimensions, to look up what a foreign unit measures.
const DIMENSIONS: &[Dimension] = &[
    Dimension::Length,
    Dimension::Angle,
    Dimension::AngularSpeed,
    Dimension::Rate,
    Dimension::Pressure,
    Dimension::Temperature,
    Dimension::Force,
    Dimension::Moment,
    Dimension::Mass,
    Dimension::DynamicViscosity,
    Dimension::KinematicViscosity,
    Dimension::Density,
    Dimension::Power,
    Dimension::VolumeFlow,
    Dimension::FlowResistance,
    Dimension::Inertia,
    Dimension::MassMoment,
    Dimension::Acceleration,
    Dimension::Stiffness,
    Dimension::TorsionalStiffness,
    Dimension::TorsionalDamping,
    Dimension::SectionStiffness,
    Dimension::Energy,
    Dimension::PressureCoefficient,
    Dimension::ThermalExpansion,
    Dimension::HeatCapacity,
    Dimension::HeatCapacitySlope,
    Dimension::Conductivity,
    Dimension::ConductivitySlope,
    Dimension::Conductance,
    Dimension::HeatTransfer,
    Dimension::WearCoefficient,
    Dimension::Time,
];

impl Dimension {
    /// In words, for messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Angle => "angle",
            Self::AngularSpeed => "angular speed",
            Self::Rate => "rate",
            Self::Pressure => "pressure",
            Self::Temperature => "temperature",
            Self::TemperatureDifference => "temperature difference",
            Self::Force => "force",
            Self::Moment => "moment",
            Self::Mass => "mass",
            Self::DynamicViscosity => "dynamic viscosity",
            Self::KinematicViscosity => "kinematic viscosity",
            Self::Density => "density",
            Self::Power => "power",
            Self::VolumeFlow => "volume flow",
            Self::FlowResistance => "flow resistance",
            Self::Inertia => "inertia",
            Self::MassMoment => "mass moment",
            Self::Acceleration => "acceleration",
            Self::Stiffness => "stiffness",
            Self::TorsionalStiffness => "torsional stiffness",
            Self::TorsionalDamping => "torsional damping",
            Self::SectionStiffness => "section stiffness",
            Self::Energy => "energy",
            Self::PressureCoefficient => "pressure coefficient",
            Self::ThermalExpansion => "thermal expansion",
            Self::HeatCapacity => "heat capacity",
            Self::HeatCapacitySlope => "heat capacity per temperature",
            Self::Conductivity => "conductivity",
            Self::ConductivitySlope => "conductivity per temperature",
            Self::Conductance => "heat conductance",
            Self::HeatTransfer => "heat transfer coefficient",
            Self::WearCoefficient => "wear coefficient",
            Self::Time => "time",
        }
    }

    const fn table(self) -> &'static [Unit] {
        match self {
            Self::Length => LENGTH,
            Self::Angle => ANGLE,
            Self::AngularSpeed => ANGULAR_SPEED,
            Self::Rate => RATE,
            Self::Pressure => PRESSURE,
            Self::Temperature => TEMPERATURE,
            Self::TemperatureDifference => TEMPERATURE_DIFFERENCE,
            Self::Force => FORCE,
            Self::Moment => MOMENT,
            Self::Mass => MASS,
            Self::DynamicViscosity => DYNAMIC_VISCOSITY,
            Self::KinematicViscosity => KINEMATIC_VISCOSITY,
            Self::Density => DENSITY,
            Self::Power => POWER,
            Self::VolumeFlow => VOLUME_FLOW,
            Self::FlowResistance => FLOW_RESISTANCE,
            Self::Inertia => INERTIA,
            Self::MassMoment => MASS_MOMENT,
            Self::Acceleration => ACCELERATION,
            Self::Stiffness => STIFFNESS,
            Self::TorsionalStiffness => TORSIONAL_STIFFNESS,
            Self::TorsionalDamping => TORSIONAL_DAMPING,
            Self::SectionStiffness => SECTION_STIFFNESS,
            Self::Energy => ENERGY,
            Self::PressureCoefficient => PRESSURE_COEFFICIENT,
            Self::ThermalExpansion => THERMAL_EXPANSION,
            Self::HeatCapacity => HEAT_CAPACITY,
            Self::HeatCapacitySlope => HEAT_CAPACITY_SLOPE,
            Self::Conductivity => CONDUCTIVITY,
            Self::ConductivitySlope => CONDUCTIVITY_SLOPE,
            Self::Conductance => CONDUCTANCE,
            Self::HeatTransfer => HEAT_TRANSFER,
            Self::WearCoefficient => WEAR_COEFFICIENT,
            Self::Time => TIME,
        }
    }

    /// Its name with the article before it.
    #[must_use]
    pub fn with_article(self) -> String {
        let name = self.name();
        let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) {
            "an"
        } else {
            "a"
        };
        format!("{article} {name}")
    }

    /// The unit that was most likely meant by one that is not known: the same letters in another
    /// case, or a habit of the workshop.
    #[must_use]
    pub fn meant_unit(self, unit: &str) -> Option<&'static str> {
        const HABITS: &[(&str, &str)] = &[
            ("c", "degC"),
            ("celsius", "degC"),
            ("degrees", "deg"),
            ("micron", "um"),
            ("microns", "um"),
            ("micrometer", "um"),
            ("mu", "um"),
            ("u/min", "rpm"),
            ("min-1", "rpm"),
            ("rad/sec", "rad/s"),
            ("n/m2", "Pa"),
            ("n.s/m2", "Pa.s"),
            ("ns/m2", "Pa.s"),
            ("j/kgk", "J/(kg.K)"),
            ("j/kg.k", "J/(kg.K)"),
            ("j/kg/k", "J/(kg.K)"),
            ("w/mk", "W/(m.K)"),
            ("w/m.k", "W/(m.K)"),
            ("w/m/k", "W/(m.K)"),
            ("w/m2k", "W/(m2.K)"),
            ("w/m2.k", "W/(m2.K)"),
        ];
        let letters = normalised(unit).to_lowercase();
        let known = |name: &str| self.table().iter().find(|known| known.0 == name);
        self.table()
            .iter()
            .find(|known| known.0.to_lowercase() == letters)
            .or_else(|| {
                let habit = HABITS.iter().find(|habit| habit.0 == letters)?;
                known(habit.1)
            })
            .map(|known| known.0)
    }

    /// Names of its units, the usual one first.
    #[must_use]
    pub fn units(self) -> Vec<&'static str> {
        self.table().iter().map(|unit| unit.0).collect()
    }

    /// Name of its SI unit.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        let si = self
            .table()
            .iter()
            .find(|unit| unit.1 == 1.0 && unit.2 == 0.0);
        si.map_or("", |unit| unit.0)
    }

    /// SI value of a number in one of its units; `None` where the unit is not one of them.
    #[must_use]
    pub fn to_si(self, number: f64, unit: &str) -> Option<f64> {
        let unit = normalised(unit);
        self.table()
            .iter()
            .find(|known| known.0 == unit)
            .map(|&(_, factor, zero)| number * factor + zero)
    }
}

/// A quantity that cannot be read.
#[derive(Debug, Clone, PartialEq)]
pub enum QuantityError {
    /// No number at the start.
    NoNumber,
    /// A comma where the decimal point is due; holds the text with a point.
    DecimalComma(String),
    /// Digits in groups; holds the text without the gaps.
    GroupedDigits(String),
    /// A minus sign that is not the one of the keyboard; holds the text with that.
    ForeignMinus(String),
    /// Infinite, or not a number.
    NotFinite,
    /// A bare number.
    MissingUnit,
    /// A unit of another dimension.
    WrongDimension(String, Dimension),
    /// No unit that is known here.
    UnknownUnit(String),
}

impl fmt::Display for QuantityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNumber => write!(f, "does not start with a number"),
            Self::DecimalComma(_) => write!(f, "is written with a decimal comma"),
            Self::GroupedDigits(_) => write!(f, "has its digits in groups"),
            Self::ForeignMinus(_) => {
                write!(f, "has a minus sign that is not the one of the keyboard")
            }
            Self::NotFinite => write!(f, "is not a finite number"),
            Self::MissingUnit => write!(f, "has no unit"),
            Self::WrongDimension(unit, dimension) => {
                write!(f, "has the unit `{unit}` of {}", dimension.with_article())
            }
            Self::UnknownUnit(unit) => {
                let shown: String = unit.chars().take(TEXT_SHOWN).collect();
                write!(f, "has the unknown unit `{}`", shown.escape_debug())
            }
        }
    }
}

/// Reads a quantity into SI.
///
/// # Errors
/// [`QuantityError`] says what is wrong with the text.
pub fn parse(text: &str, dimension: Dimension) -> Result<f64, QuantityError> {
    let text = text.trim();
    let (number, unit) = text.split_at(number_length(text));
    if number.is_empty() {
        if let Some(plain) = with_ascii_minus(text) {
            return Err(QuantityError::ForeignMinus(
                plain.chars().take(TEXT_SHOWN).collect(),
            ));
        }
        let first = text.split_whitespace().next().unwrap_or_default();
        return Err(match first.trim_start_matches(['-', '+']) {
            word if ["nan", "inf", "infinity"].contains(&word.to_ascii_lowercase().as_str()) => {
                QuantityError::NotFinite
            }
            _ => QuantityError::NoNumber,
        });
    }
    if let Some(error) = broken_number(number, unit) {
        return Err(error);
    }
    let number: f64 = number.parse().map_err(|_| QuantityError::NoNumber)?;
    if !number.is_finite() {
        return Err(QuantityError::NotFinite);
    }
    let unit = unit.trim();
    if unit.is_empty() {
        return Err(QuantityError::MissingUnit);
    }
    match dimension.to_si(number, unit) {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => Err(QuantityError::NotFinite),
        None => Err(foreign_unit(unit)),
    }
}

/// Digits go on behind the number: a decimal comma, or groups of thousands.
fn broken_number(number: &str, rest: &str) -> Option<QuantityError> {
    let is_gap = |c: char| ",._'\u{2019}".contains(c) || c.is_whitespace();
    let after_gap = rest.strip_prefix(is_gap)?;
    // `1/s` and `1/min` are units.
    if !after_gap.starts_with(|c: char| c.is_ascii_digit()) || after_gap.starts_with("1/") {
        return None;
    }
    let end = rest.find(|c: char| !is_gap(c) && !c.is_ascii_digit());
    let (digits, unit) = rest.split_at(end.unwrap_or(rest.len()));
    let written = format!("{number}{}", digits.trim_end());
    if written.len() > TEXT_SHOWN {
        return None;
    }
    let gaps: Vec<char> = written.chars().filter(|&c| is_gap(c)).collect();
    // Of several separators the last is the decimal point, if it stands there once.
    let last = gaps.last().copied()?;
    let is_decimal = matches!(last, ',' | '.')
        && gaps.iter().filter(|&&gap| gap == last).count() == 1
        && (gaps.len() > 1 || last == ',');
    let plain = written.chars().filter_map(|c| match c {
        c if c == last && is_decimal => Some('.'),
        c if is_gap(c) => None,
        c => Some(c),
    });
    let unit: String = unit.chars().take(TEXT_SHOWN).collect();
    let plain = format!("{} {unit}", plain.collect::<String>());
    let plain = plain.trim_end().to_owned();
    Some(if gaps.len() == 1 && is_decimal {
        QuantityError::DecimalComma(plain)
    } else {
        QuantityError::GroupedDigits(plain)
    })
}

/// The number and the unit of a quantity as they are written, whatever the unit is.
#[must_use]
pub fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let (number, unit) = text.split_at(number_length(text));
    let number: f64 = number.parse().ok()?;
    let unit = unit.trim();
    (number.is_finite() && !unit.is_empty()).then_some((number, unit))
}

/// Tells a unit of another dimension from one that is not known at all.
fn foreign_unit(unit: &str) -> QuantityError {
    match DIMENSIONS.iter().find(|d| d.to_si(1.0, unit).is_some()) {
        Some(&dimension) => QuantityError::WrongDimension(unit.to_owned(), dimension),
        None => QuantityError::UnknownUnit(unit.to_owned()),
    }
}

/// The text with a hyphen for the minus sign of typesetting or the dash that stands at its start;
/// `None` where there is none.
pub(super) fn with_ascii_minus(text: &str) -> Option<String> {
    let rest = text.strip_prefix(['\u{2212}', '\u{2013}', '\u{2014}', '\u{2010}', '\u{2011}'])?;
    Some(format!("-{}", rest.trim_start()))
}

/// Length in bytes of the decimal number at the start of `text`; 0 without one.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut end = digits(sign);
    let mut count = end - sign;
    if bytes.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        count += fraction - end - 1;
        end = fraction;
    }
    if count == 0 {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    end
}

/// One spelling for the many of a unit.
fn normalised(unit: &str) -> String {
    let mut out = String::with_capacity(unit.len());
    for c in unit.trim().chars() {
        match c {
            '\u{b5}' | '\u{3bc}' => out.push('u'), // both micro signs
            '\u{b2}' => out.push('2'),
            '\u{b3}' => out.push('3'),
            '\u{b0}' => out.push_str("deg"),
            '^' => {}
            c if matches!(c, '*' | '\u{b7}' | '\u{22c5}') || c.is_whitespace() => {
                if !out.ends_with(['.', '/']) {
                    out.push('.');
                }
            }
            '/' => {
                while out.ends_with('.') {
                    out.pop();
                }
                out.push('/');
            }
            c => out.push(c),
        }
    }
    match out.as_str() {
        "Nm" => "N.m".to_owned(),
        "kNm" => "kN.m".to_owned(),
        "Nmm" => "N.mm".to_owned(),
        "mPas" => "mPa.s".to_owned(),
        "Pas" => "Pa.s".to_owned(),
        _ => out,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn quantities_become_si() {
        let cases = [
            ("48 mm", Dimension::Length, 0.048),
            ("48mm", Dimension::Length, 0.048),
            ("36 \u{b5}m", Dimension::Length, 36e-6),
            ("3000 rpm", Dimension::AngularSpeed, 314.159_265_358_979_3),
            ("-1.5e1 deg", Dimension::Angle, -0.261_799_387_799_149_4),
            ("5 bar", Dimension::Pressure, 5e5),
            ("8 mPa.s", Dimension::DynamicViscosity, 8e-3),
            ("8 mPa s", Dimension::DynamicViscosity, 8e-3),
            ("100 degC", Dimension::Temperature, 373.15),
            ("100 \u{b0}C", Dimension::Temperature, 373.15),
            ("65 cSt", Dimension::KinematicViscosity, 65e-6),
            ("3 N*m", Dimension::Moment, 3.0),
            ("850 kg/m^3", Dimension::Density, 850.0),
            ("2 bar.s/cm3", Dimension::FlowResistance, 2e11),
            ("1 bar min/l", Dimension::FlowResistance, 6e9),
            (".5 1/s", Dimension::Rate, 0.5),
            ("9.5e-9 1/Pa", Dimension::PressureCoefficient, 9.5e-9),
            ("9.5 1/GPa", Dimension::PressureCoefficient, 9.5e-9),
            ("2 kJ/(kg K)", Dimension::HeatCapacity, 2000.0),
            ("0.14 W/(m*K)", Dimension::Conductivity, 0.14),
            ("5 W/(m\u{b2} K)", Dimension::HeatTransfer, 5.0),
            ("1e-16 m2/N", Dimension::WearCoefficient, 1e-16),
            ("2e-7 mm3/(N m)", Dimension::WearCoefficient, 2e-16),
            ("10 h", Dimension::Time, 36_000.0),
        ];
        for (text, dimension, value) in cases {
            let read = parse(text, dimension).unwrap();
            assert!(
                (read - value).abs() <= 1e-15 * value.abs(),
                "{text}: {read}"
            );
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        let error = |text| parse(text, Dimension::Length).unwrap_err();
        assert_eq!(error("48"), QuantityError::MissingUnit);
        assert_eq!(error("mm"), QuantityError::NoNumber);
        assert_eq!(error(""), QuantityError::NoNumber);
        assert_eq!(
            error("0,5 mm"),
            QuantityError::DecimalComma("0.5 mm".into())
        );
        assert_eq!(error("nan"), QuantityError::NotFinite);
        assert_eq!(error("-Inf mm"), QuantityError::NotFinite);
        let grouped = |text: &str| QuantityError::GroupedDigits(text.into());
        assert_eq!(error("1 000 mm"), grouped("1000 mm"));
        assert_eq!(error("1.000,5 mm"), grouped("1000.5 mm"));
        assert_eq!(error("1,000.5 mm"), grouped("1000.5 mm"));
        assert_eq!(error("1.000.000 mm"), grouped("1000000 mm"));
        assert_eq!(error("10'000 mm"), grouped("10000 mm"));
        let minus = QuantityError::ForeignMinus("-5 mm".into());
        assert_eq!(error("\u{2212}5 mm"), minus);
        // A unit that begins with a digit is no group of digits.
        assert_eq!(parse("8 1/s", Dimension::Rate), Ok(8.0));
        assert_eq!(error("1e999 mm"), QuantityError::NotFinite);
        assert_eq!(
            error("5 bar"),
            QuantityError::WrongDimension("bar".into(), Dimension::Pressure)
        );
        assert_eq!(error("5 inch"), QuantityError::UnknownUnit("inch".into()));
    }
}
