//! Numbers for reading: four significant digits, units chosen so that few zeros are left.
//!
//! Results are SI; this is the only place that leaves it. One unit per kind of quantity is chosen
//! for a whole report, so that numbers in cards, tables and figures compare at a glance.

/// Text for a number that is not there or not finite.
const NO_NUMBER: &str = "n/a";

/// A unit for reading: how many of it make one SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Unit {
    /// Its symbol.
    pub symbol: &'static str,
    /// Value in this unit = value in SI times this.
    pub factor: f64,
}

const fn unit(symbol: &'static str, factor: f64) -> Unit {
    Unit { symbol, factor }
}

/// Film thickness.
pub(crate) const MICROMETRE: Unit = unit("µm", 1e6);
/// Limits of pressure, as users write them.
pub(crate) const MEGAPASCAL: Unit = unit("MPa", 1e-6);
/// Limits of power.
pub(crate) const WATT: Unit = unit("W", 1.0);
/// Shares.
pub(crate) const PERCENT: Unit = unit("%", 100.0);
/// Tilt.
pub(crate) const MILLIRADIAN: Unit = unit("mrad", 1e3);
/// Dimensionless.
pub(crate) const ONE: Unit = unit("", 1.0);

const FORCE: &[Unit] = &[unit("N", 1.0), unit("kN", 1e-3), unit("MN", 1e-6)];
const PRESSURE: &[Unit] = &[
    unit("Pa", 1.0),
    unit("kPa", 1e-3),
    unit("MPa", 1e-6),
    unit("GPa", 1e-9),
];
const POWER: &[Unit] = &[unit("mW", 1e3), unit("W", 1.0), unit("kW", 1e-3)];
const FLOW: &[Unit] = &[unit("mm³/s", 1e9), unit("cm³/s", 1e6), unit("l/s", 1e3)];
const TORQUE: &[Unit] = &[unit("mN·m", 1e3), unit("N·m", 1.0), unit("kN·m", 1e-3)];

/// The units of one report.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Units {
    /// Forces and loads.
    pub force: Unit,
    /// Pressures and specific loads.
    pub pressure: Unit,
    /// Powers.
    pub power: Unit,
    /// Flows.
    pub flow: Unit,
    /// Torques and moments.
    pub torque: Unit,
}

impl Units {
    /// Units in which these largest magnitudes (SI) read well.
    pub fn choose(force: f64, pressure: f64, power: f64, flow: f64, torque: f64) -> Self {
        Self {
            force: choose(FORCE, force),
            pressure: choose(PRESSURE, pressure),
            power: choose(POWER, power),
            flow: choose(FLOW, flow),
            torque: choose(TORQUE, torque),
        }
    }
}

/// The largest unit in which the value is at least 1, or the smallest one. A power of 1500 W stays
/// in W: the next unit is taken from 2 of it onwards.
fn choose(units: &[Unit], largest: f64) -> Unit {
    units
        .iter()
        .rev()
        .find(|unit| largest.is_finite() && largest.abs() * unit.factor >= 2.0)
        .or(units.first())
        .copied()
        .unwrap_or(ONE)
}

impl Unit {
    /// An SI value in this unit with four significant digits, without the symbol.
    pub fn number(self, si: f64) -> String {
        significant(si * self.factor)
    }

    /// A number somebody chose, such as a limit, with the symbol: no zeros to fill four digits.
    pub fn plain(self, si: f64) -> String {
        format!("{} {}", plain_number(si * self.factor), self.symbol)
    }

    /// The size of an error in this unit, without the symbol: two digits say enough.
    pub fn rough(self, si: f64) -> String {
        let value = si * self.factor;
        if !(1e-3..1e6).contains(&value.abs()) {
            return size(value);
        }
        let unit = 10f64.powf(value.abs().log10().floor() - 1.0);
        let rounded = (value / unit).round() * unit;
        plain_number(rounded)
    }

    /// An SI value in this unit with four significant digits and the symbol.
    pub fn show(self, si: f64) -> String {
        let number = self.number(si);
        if self.symbol.is_empty() || number == NO_NUMBER {
            return number;
        }
        format!("{number} {}", self.symbol)
    }
}

/// Four significant digits; powers of ten where zeros would have to be counted.
pub(crate) fn significant(value: f64) -> String {
    if !value.is_finite() {
        return NO_NUMBER.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    if !(1e-3..1e6).contains(&size) {
        return scientific(value);
    }
    let exponent = size.log10().floor();
    // A value just below a power of ten rounds up to it and has then one decimal too many: the
    // exponent is taken after rounding to four digits.
    let rounded = (size / 10f64.powf(exponent - 3.0)).round();
    let exponent = if rounded >= 1e4 {
        exponent + 1.0
    } else {
        exponent
    };
    let decimals = (3.0 - exponent).max(0.0) as usize;
    with_minus(format!("{value:.decimals$}"))
}

/// A temperature given in K in degC, with one decimal.
pub(crate) fn celsius(kelvin: f64) -> String {
    let value = kelvin - 273.15;
    if value.is_finite() {
        with_minus(format!("{value:.1}"))
    } else {
        NO_NUMBER.to_owned()
    }
}

/// A number somebody chose: four significant digits at most, without zeros that fill them.
pub(crate) fn plain_number(value: f64) -> String {
    let text = significant(value);
    if text.contains('.') && !text.contains('·') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Eight decimals, for numbers that others compare theirs with.
pub(crate) fn long(value: f64) -> String {
    if value.is_finite() {
        with_minus(format!("{value:.8}"))
    } else {
        NO_NUMBER.to_owned()
    }
}

/// Two significant digits, for what is only judged by its size: residuals, closures.
pub(crate) fn size(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return significant(value);
    }
    if (1e-3..1e6).contains(&value.abs()) {
        return ONE.rough(value);
    }
    powers_of_ten(format!("{value:.1e}"))
}

/// Four significant digits times a power of ten.
fn scientific(value: f64) -> String {
    powers_of_ten(format!("{value:.3e}"))
}

fn powers_of_ten(text: String) -> String {
    match text.split_once('e') {
        Some((mantissa, exponent)) => {
            let superscript: String = exponent.chars().map(superscript).collect();
            with_minus(format!("{mantissa}·10{superscript}"))
        }
        None => with_minus(text),
    }
}

fn superscript(digit: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match digit.to_digit(10) {
        Some(number) => DIGITS[number as usize],
        None => '⁻',
    }
}

/// The minus sign has the width of a digit, so that columns stay aligned; the hyphen has not.
fn with_minus(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) => format!("\u{2212}{rest}"),
        None => text,
    }
}

/// An angle given in degrees, with one decimal at most.
pub(crate) fn angle(degrees: f64) -> String {
    if !degrees.is_finite() {
        return NO_NUMBER.to_owned();
    }
    let text = format!("{degrees:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    with_minus(format!("{}°", if text == "-0" { "0" } else { text }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_significant_digits() {
        assert_eq!(significant(1.23456), "1.235");
        assert_eq!(significant(9.99996), "10.00");
        assert_eq!(significant(-0.0123456), "\u{2212}0.01235");
        assert_eq!(significant(123456.0), "123456");
        assert_eq!(significant(f64::NAN), "n/a");
        assert_eq!(significant(2.5e-13), "2.500·10⁻¹³");
    }

    #[test]
    fn units_follow_the_size() {
        let units = Units::choose(35e3, 2e8, 1500.0, 12e-6, 0.8);
        assert_eq!(units.force.show(35e3), "35.00 kN");
        assert_eq!(units.pressure.symbol, "MPa");
        assert_eq!(units.power.symbol, "W");
        assert_eq!(units.flow.symbol, "cm³/s");
        assert_eq!(units.torque.symbol, "mN·m");
        assert_eq!(choose(POWER, f64::NAN).symbol, "mW");
    }

    #[test]
    fn chosen_numbers_and_errors_have_no_padding() {
        assert_eq!(MICROMETRE.plain(1.5e-6), "1.5 µm");
        assert_eq!(MICROMETRE.plain(100e-6), "100 µm");
        assert_eq!(MICROMETRE.rough(2.1e-8), "0.021");
        assert_eq!(ONE.rough(0.0), "0");
        assert_eq!(size(3.24e-13), "3.2·10⁻¹³");
        assert_eq!(size(0.0324), "0.032");
        assert_eq!(ONE.rough(1.52e-4), "1.5·10⁻⁴");
        assert_eq!(long(-1.25), "\u{2212}1.25000000");
    }

    #[test]
    fn angles_drop_a_zero_decimal() {
        assert_eq!(angle(372.5), "372.5°");
        assert_eq!(angle(90.0), "90°");
        assert_eq!(angle(-0.01), "0°");
    }
}
