//! How viscous is the oil at a temperature? Dynamic viscosity eta(T) in Pa s.
//!
//! - Vogel: `eta = a exp(b / (T + c))`, T in K. H. Vogel, Physikalische Zeitschrift 22 (1921)
//!   645-646. Good between its fitting points; singular at `T = -c`, far below the pour point.
//! - ASTM D341 (Ubbelohde-Walther): `lg lg(nu + 0.7) = A - B lg T`, nu in mm2/s, T in K, the line
//!   through the viscosities at 40 and 100 degC. C. Walther, Erdoel und Teer 7 (1931) 382-384;
//!   ASTM D341-20. The constant 0.7 alone holds for nu above 2 mm2/s; the standard adds terms below.
//!
//! At ambient pressure and low shear: [`crate::PressureLaw`] and [`crate::ShearThinning`] add the
//! rest. ASTM D341's kinematic viscosity is multiplied with the density at ambient pressure.

use crate::{Derived, OilError, TemperatureRange, law::positive};
use serde::{Deserialize, Serialize};
use std::f64::consts::LN_10;

/// Lower reference temperature of ASTM D341 data, 40 degC, K.
const T40: f64 = 313.15;
/// Upper reference temperature of ASTM D341 data, 100 degC, K.
const T100: f64 = 373.15;
/// Shift of the kinematic viscosity in ASTM D341, mm2/s (valid for nu > 2 mm2/s).
const SHIFT: f64 = 0.7;
/// mm2/s in one m2/s.
const MM2_S: f64 = 1e6;
/// Viscosity up to which Vogel's law is followed, Pa s: an oil this thick no longer pours.
const THICKEST: f64 = 1e3;
/// Highest temperature of a liquid lubricating oil, 250 degC, K; Vogel's law ends there. Mineral oils burn
/// (fire point, ASTM D92): a turbine oil ISO VG 32 flashes at 222 and burns on at 252 degC (product data of
/// Panther Lubes), engine oils flash at 218 to 238 degC and burn on 6 to 11 K above (MRT Laboratories, flash
/// point of lubricating oil); all crack and oxidise within minutes.
pub const HOTTEST_OIL: f64 = 523.15;
/// Kinematic viscosities of ASTM D341 with the shift of 0.7 alone, mm2/s.
const D341_VISCOSITIES: [f64; 2] = [2.0, 2e7];
/// Temperatures of ASTM D341, -70 to 370 degC, K.
const D341_TEMPERATURES: TemperatureRange = TemperatureRange {
    low: 203.15,
    high: 643.15,
};

/// Law of the viscosity over temperature.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum ViscosityLaw {
    /// The same at every temperature.
    Constant {
        /// Dynamic viscosity, Pa s.
        viscosity: f64,
    },
    /// `eta = a exp(b / (T + c))`.
    Vogel {
        /// Viscosity at infinite temperature, Pa s.
        a: f64,
        /// Steepness, K; about 700 to 1300.
        b: f64,
        /// Temperature offset, K; about -180 to -140.
        c: f64,
    },
    /// `lg lg(nu + 0.7) = A - B lg T` through two kinematic viscosities.
    #[serde(rename = "astm-d341")]
    AstmD341 {
        /// Kinematic viscosity at 40 degC, m2/s.
        kv40: f64,
        /// Kinematic viscosity at 100 degC, m2/s.
        kv100: f64,
    },
}

impl ViscosityLaw {
    /// Vogel's law through three viscosities, `[K, Pa s]`, of rising temperature.
    ///
    /// # Errors
    /// [`OilError`] where the points are no such oil's: not positive, not thinning as it warms, or
    /// thinning ever faster.
    pub fn vogel_through(points: [[f64; 2]; 3]) -> Result<Self, OilError> {
        let [[t1, eta1], [t2, eta2], [t3, eta3]] = points;
        for [temperature, viscosity] in points {
            positive("temperature", temperature)?;
            positive("viscosity", viscosity)?;
        }
        if !(t1 < t2 && t2 < t3 && eta1 > eta2 && eta2 > eta3) {
            return Err(OilError::DoesNotThin);
        }
        // the ratio of the falls of ln eta is free of a and b and linear in c
        let ratio = (eta1 / eta2).ln() / (eta2 / eta3).ln() * (t3 - t2) / (t2 - t1);
        let c = (t3 - ratio * t1) / (ratio - 1.0);
        let b = (eta1 / eta2).ln() * (t1 + c) * (t2 + c) / (t2 - t1);
        let a = eta1 * (-b / (t1 + c)).exp();
        let law = Self::Vogel { a, b, c };
        if ratio <= 1.0 || t1 + c <= 0.0 {
            return Err(OilError::NotFinite { name: "c" });
        }
        law.check()?;
        Ok(law)
    }

    /// Temperatures at which the law holds: Vogel's from 1000 Pa s, where oil no longer pours, to
    /// 250 degC; ASTM D341's from -70 to 370 degC as long as the oil has 2 to 2e7 mm2/s.
    #[must_use]
    pub fn temperature_range(&self) -> TemperatureRange {
        match *self {
            Self::Constant { .. } => TemperatureRange::ALL,
            Self::Vogel { a, b, c } => TemperatureRange {
                low: if a < THICKEST {
                    (b / (THICKEST / a).ln() - c).max(0.0)
                } else {
                    f64::INFINITY
                },
                high: HOTTEST_OIL,
            },
            Self::AstmD341 { kv40, kv100 } => {
                let line = WaltherLine::through(kv40, kv100);
                let [high, low] = D341_VISCOSITIES.map(|nu| line.temperature(nu / MM2_S));
                TemperatureRange { low, high }.and(D341_TEMPERATURES)
            }
        }
    }

    /// Dynamic viscosity, Pa s, at a temperature (K) for an oil of this density (kg/m3) there.
    #[must_use]
    pub fn dynamic(&self, temperature_k: f64, density: Derived) -> Derived {
        match *self {
            Self::Constant { viscosity } => Derived::constant(viscosity),
            Self::Vogel { a, b, c } => vogel(a, b, c, temperature_k),
            Self::AstmD341 { kv40, kv100 } => {
                let (nu, nu_by_temperature) = WaltherLine::through(kv40, kv100).at(temperature_k);
                Derived {
                    value: nu * density.value,
                    by_temperature: nu_by_temperature * density.value + nu * density.by_temperature,
                    by_pressure: nu * density.by_pressure,
                }
            }
        }
    }

    /// Whether the parameters describe an oil.
    ///
    /// # Errors
    /// [`OilError`] names the parameter that does not.
    pub fn check(&self) -> Result<(), OilError> {
        match *self {
            Self::Constant { viscosity } => positive("viscosity", viscosity),
            Self::Vogel { a, b, c } => {
                positive("a", a)?;
                positive("b", b)?;
                if c.is_finite() {
                    Ok(())
                } else {
                    Err(OilError::NotFinite { name: "c" })
                }
            }
            Self::AstmD341 { kv40, kv100 } => {
                positive("kv40", kv40)?;
                positive("kv100", kv100)?;
                if kv100 >= kv40 {
                    return Err(OilError::DoesNotThin);
                }
                if kv100 * MM2_S <= 1.0 - SHIFT {
                    return Err(OilError::TooThin {
                        value_mm2_s: kv100 * MM2_S,
                    });
                }
                Ok(())
            }
        }
    }
}

/// Vogel's law and its slope.
fn vogel(a: f64, b: f64, c: f64, temperature_k: f64) -> Derived {
    let above = temperature_k + c;
    let value = a * (b / above).exp();
    Derived {
        value,
        by_temperature: -value * b / (above * above),
        by_pressure: 0.0,
    }
}

/// The straight line of ASTM D341 in `lg lg(nu + 0.7)` over `lg T`.
struct WaltherLine {
    a: f64,
    b: f64,
}

impl WaltherLine {
    /// Through the kinematic viscosities (m2/s) at 40 and 100 degC.
    fn through(kv40: f64, kv100: f64) -> Self {
        let ordinate = |nu: f64| (nu * MM2_S + SHIFT).log10().log10();
        let b = (ordinate(kv40) - ordinate(kv100)) / (T100 / T40).log10();
        Self {
            a: ordinate(kv40) + b * T40.log10(),
            b,
        }
    }

    /// Temperature, K, of a kinematic viscosity, m2/s.
    fn temperature(&self, nu: f64) -> f64 {
        let ordinate = (nu * MM2_S + SHIFT).log10().log10();
        10_f64.powf((self.a - ordinate) / self.b)
    }

    /// Kinematic viscosity, m2/s, and its slope, m2/(s K).
    fn at(&self, temperature_k: f64) -> (f64, f64) {
        let logarithm = 10_f64.powf(self.a - self.b * temperature_k.log10());
        let shifted = 10_f64.powf(logarithm);
        let slope = -shifted * LN_10 * logarithm * self.b / temperature_k;
        ((shifted - SHIFT) / MM2_S, slope / MM2_S)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{DensityLaw, Lubricant};

    const DENSITY: f64 = 850.0;

    fn oils() -> Vec<Lubricant> {
        [
            ViscosityLaw::Constant { viscosity: 8e-3 },
            ViscosityLaw::Vogel {
                a: 1.3e-4,
                b: 900.0,
                c: 110.0 - 273.15,
            },
            ViscosityLaw::AstmD341 {
                kv40: 65e-6,
                kv100: 11e-6,
            },
        ]
        .map(|viscosity| Lubricant::newtonian(viscosity, DensityLaw::Constant { density: DENSITY }))
        .to_vec()
    }

    #[test]
    fn derivatives_agree_with_differences() {
        for oil in oils() {
            for t in [280.0, 313.15, 373.15, 420.0] {
                let step = 1e-3;
                let slope = (oil.viscosity(t + step, 0.0).value
                    - oil.viscosity(t - step, 0.0).value)
                    / (2.0 * step);
                let exact = oil.viscosity(t, 0.0);
                assert!(
                    (slope - exact.by_temperature).abs() <= 1e-7 * exact.value,
                    "{oil:?} {t}"
                );
                assert_eq!(exact.by_pressure, 0.0);
            }
        }
    }

    #[test]
    fn vogel_of_the_heat_balance_case() {
        let eta = oils()[1].viscosity(273.15 + 69.74, 0.0).value;
        assert!((eta / (1.3e-4 * (900.0_f64 / 179.74).exp()) - 1.0).abs() < 1e-12);
    }

    /// Rows of `validation/oil-viscosity-d341`: label, kv40, kv100, A, B, then nu at temperatures.
    #[test]
    fn astm_d341_follows_the_reference_table() {
        let table = include_str!("../../../validation/oil-viscosity-d341/reference.csv");
        let degc = [-10.0, 0.0, 20.0, 60.0, 80.0, 120.0, 150.0];
        let mut rows = 0;
        for line in table.lines().skip(2) {
            let cells: Vec<f64> = line
                .split(',')
                .skip(1)
                .map(|c| c.parse().unwrap())
                .collect();
            let viscosity = ViscosityLaw::AstmD341 {
                kv40: cells[0] / MM2_S,
                kv100: cells[1] / MM2_S,
            };
            let oil = Lubricant::newtonian(viscosity, DensityLaw::Constant { density: DENSITY });
            oil.check().unwrap();
            for (t, nu) in degc.iter().zip(&cells[4..]) {
                let ours = oil.viscosity(273.15 + t, 0.0).value / DENSITY * MM2_S;
                let rounding = 0.6e-4; // half a last digit of the table
                assert!(
                    (ours - nu).abs() <= (1e-6 * nu).max(rounding),
                    "{t} {nu} {ours}"
                );
            }
            rows += 1;
        }
        assert_eq!(rows, 2);
    }

    #[test]
    fn vogel_passes_through_its_three_points() {
        let points = [[303.15, 0.153], [333.15, 0.034], [373.15, 0.0091]];
        let law = ViscosityLaw::vogel_through(points).unwrap();
        for [t, eta] in points {
            let ours = law.dynamic(t, Derived::constant(DENSITY)).value;
            assert!((ours / eta - 1.0).abs() < 1e-12, "{t} {ours}");
        }
        let rising = [[303.15, 0.1], [333.15, 0.2], [373.15, 0.01]];
        assert_eq!(
            ViscosityLaw::vogel_through(rising),
            Err(OilError::DoesNotThin)
        );
        let accelerating = [[303.15, 0.1], [333.15, 0.09], [373.15, 0.01]];
        assert!(ViscosityLaw::vogel_through(accelerating).is_err());
    }

    #[test]
    fn ranges_end_where_the_oil_stiffens_or_the_formula_does() {
        let [constant, vogel, d341] = [0, 1, 2].map(|i| oils()[i].clone());
        assert_eq!(constant.temperature_range(), TemperatureRange::ALL);
        let coldest = vogel.temperature_range().low;
        assert!((vogel.viscosity(coldest, 0.0).value / THICKEST - 1.0).abs() < 1e-9);
        let range = d341.temperature_range();
        assert!((d341.kinematic_viscosity(range.high) * MM2_S - 2.0).abs() < 1e-9);
        assert!((203.15..273.15).contains(&range.low), "{range:?}");
        assert!(d341.check_temperature(373.15).is_ok());
        assert!(matches!(
            d341.check_temperature(600.0),
            Err(OilError::TemperatureOutside { .. })
        ));
    }

    #[test]
    fn the_line_passes_through_its_two_points() {
        for (t, nu) in [(T40, 65e-6), (T100, 11e-6)] {
            let eta = oils()[2].viscosity(t, 0.0).value;
            assert!((eta / (nu * DENSITY) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn parameters_that_describe_no_oil_are_refused() {
        let refused = |law: ViscosityLaw| law.check().unwrap_err();
        assert!(matches!(
            refused(ViscosityLaw::Constant { viscosity: -1.0 }),
            OilError::NotPositive { .. }
        ));
        assert_eq!(
            refused(ViscosityLaw::AstmD341 {
                kv40: 10e-6,
                kv100: 11e-6
            }),
            OilError::DoesNotThin
        );
        assert!(matches!(
            refused(ViscosityLaw::AstmD341 {
                kv40: 1e-6,
                kv100: 0.2e-6
            }),
            OilError::TooThin { .. }
        ));
        assert!(matches!(
            refused(ViscosityLaw::Vogel {
                a: 1.0,
                b: 1.0,
                c: f64::NAN
            }),
            OilError::NotFinite { .. }
        ));
    }
}
