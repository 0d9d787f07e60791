//! Viscosity under pressure: the reference table, limits, and the reduced pressure against other
//! routes to it.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test stops at the first surprise"
)]

use sommerfeld_oil::{
    CompressionLaw, DensityLaw, Derived, Lubricant, OilError, PressureLaw, RoelandsTemperature,
    ViscosityLaw,
};

const T: f64 = 373.15;

fn roelands(alpha: f64) -> PressureLaw {
    PressureLaw::Roelands {
        alpha,
        temperature: RoelandsTemperature::SameAlpha,
    }
}

fn thickening(viscosity: f64, law: PressureLaw) -> Lubricant {
    Lubricant {
        viscosity_pressure: law,
        ..Lubricant::constant(viscosity, 850.0)
    }
}

/// A Vogel oil that expands and thickens.
fn real(law: PressureLaw) -> Lubricant {
    Lubricant {
        viscosity_pressure: law,
        ..Lubricant::newtonian(
            ViscosityLaw::Vogel {
                a: 4.06e-5,
                b: 1105.0,
                c: -169.0,
            },
            DensityLaw::ThermalExpansion {
                density: 870.0,
                temperature: 288.15,
                expansion: 7e-4,
            },
        )
    }
}

fn laws() -> [PressureLaw; 3] {
    [
        PressureLaw::Barus { alpha: 2e-8 },
        roelands(1.58e-8),
        PressureLaw::Roelands {
            alpha: 1.58e-8,
            temperature: RoelandsTemperature::AlphaAt { temperature: T },
        },
    ]
}

fn sloping() -> Lubricant {
    thickening(
        0.01,
        PressureLaw::Roelands {
            alpha: 1.5e-8,
            temperature: RoelandsTemperature::Slope {
                s0: 1.2,
                temperature: 353.15,
            },
        },
    )
}

#[test]
fn the_reference_table_is_met() {
    let table = include_str!("../../../validation/pressure-laws/reference.csv");
    let mut rows = 0;
    for line in table.lines().skip(2) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: usize| -> f64 { cells[column].parse().unwrap() };
        let (eta0, alpha, p) = (number(0), number(1), number(3) * 1e6);
        let density = |law| {
            let oil = Lubricant {
                density_pressure: law,
                ..Lubricant::constant(eta0, 1.0)
            };
            oil.density(T, p).value
        };
        let ours = [
            alpha / (5.1e-9 * (eta0.ln() + 9.67)),
            0.0,
            thickening(eta0, PressureLaw::Barus { alpha })
                .viscosity(T, p)
                .value,
            thickening(eta0, roelands(alpha)).viscosity(T, p).value,
            density(CompressionLaw::Limit134),
            density(CompressionLaw::DowsonHigginson),
        ];
        for column in [2, 4, 5, 6, 7] {
            let (ours, reference) = (ours[column - 2], number(column));
            let bar = (1e-6 * reference).max(half_last_digit(cells[column]));
            assert!(
                (ours - reference).abs() <= bar,
                "{line}, column {column}: {ours}"
            );
        }
        rows += 1;
    }
    assert_eq!(rows, 8);
}

/// Half of the last digit of a printed number, `0.0123` or `1.2e-5`.
fn half_last_digit(printed: &str) -> f64 {
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa
        .split_once('.')
        .map_or(0, |(_, digits)| digits.len());
    0.5000001 * 10_f64.powi(exponent.parse::<i32>().unwrap() - i32::try_from(decimals).unwrap())
}

#[test]
fn viscosity_derivatives_agree_with_differences() {
    for oil in laws().map(real).into_iter().chain([sloping()]) {
        for t in [313.15, T, 420.0] {
            for p in [-5e6, -1e5, 1e5, 2e7, 1.5e8, 4e8] {
                let (by_t, by_p) = differences(|t, p| oil.viscosity(t, p).value, t, p);
                let exact = oil.viscosity(t, p);
                let wrong = |ours: f64, exact: f64| (ours / exact - 1.0).abs();
                assert!(wrong(by_t, exact.by_temperature) <= 1e-7, "{oil:?} {t} {p}");
                assert!(wrong(by_p, exact.by_pressure) <= 1e-7, "{oil:?} {t} {p}");
            }
        }
    }
}

/// Fourth-order central differences by temperature and pressure.
fn differences(of: impl Fn(f64, f64) -> f64, t: f64, p: f64) -> (f64, f64) {
    let (dt, dp) = (0.05, 5e4);
    let slope = |at: &dyn Fn(f64) -> f64, step: f64| {
        (8.0 * (at(step) - at(-step)) - at(2.0 * step) + at(-2.0 * step)) / (12.0 * step)
    };
    (
        slope(&|step| of(t + step, p), dt),
        slope(&|step| of(t, p + step), dp),
    )
}

#[test]
fn without_a_coefficient_the_oil_is_isoviscous() {
    let plain = real(PressureLaw::None);
    for law in [
        PressureLaw::Barus { alpha: 0.0 },
        roelands(0.0),
        roelands(1e-26),
    ] {
        for p in [-1e5, 0.0, 3e7, 1e9] {
            let (ours, isoviscous) = (real(law).viscosity(T, p), plain.viscosity(T, p));
            assert!((ours.value / isoviscous.value - 1.0).abs() <= f64::EPSILON);
            assert!((ours.by_temperature / isoviscous.by_temperature - 1.0).abs() < 1e-14);
            assert!(ours.by_pressure * 1e9 <= 1e-14 * ours.value);
        }
    }
}

#[test]
fn temperature_counts_once() {
    let plain = real(PressureLaw::None);
    for t in [300.0, T, 420.0] {
        let eta0 = plain.viscosity(t, 0.0);
        for law in laws() {
            assert_eq!(
                real(law).viscosity(t, 0.0).value,
                eta0.value,
                "ambient pressure"
            );
            assert_eq!(
                real(law).viscosity(t, 0.0).by_temperature,
                eta0.by_temperature
            );
        }
        // under pressure the oil at t is the isothermal one of its own viscosity there
        for law in [PressureLaw::Barus { alpha: 2e-8 }, roelands(1.58e-8)] {
            let isothermal = thickening(eta0.value, law).viscosity(T, 2e8).value;
            let ours = real(law).viscosity(t, 2e8).value;
            assert!((ours / isothermal - 1.0).abs() < 1e-14, "{law:?}");
        }
    }
    let PressureLaw::Roelands { temperature, .. } = sloping().viscosity_pressure else {
        panic!("Roelands")
    };
    let twice = real(PressureLaw::Roelands {
        alpha: 1.5e-8,
        temperature,
    });
    assert_eq!(twice.check(), Err(OilError::TemperatureCountsTwice));
    assert!(sloping().check().is_ok());
}

/// Roelands (1966): `ln eta + 9.67 = (ln eta_R + 9.67) (1 + 5.1e-9 p)^z ((T - 138)/(T_R - 138))^-s0`.
#[test]
fn the_slope_is_roelands_law_over_both() {
    let oil = sloping();
    let reference = 0.01_f64.ln() + 9.67;
    let z = 1.5e-8 / (5.1e-9 * reference);
    for (t, p) in [(353.15, 0.0), (353.15, 1e8), (300.0, 0.0), (400.0, 3e8)] {
        let part = ((t - 138.0) / (353.15 - 138.0_f64)).powf(-1.2);
        let eta = (reference * (1.0 + 5.1e-9_f64 * p).powf(z) * part - 9.67).exp();
        assert!(
            (oil.viscosity(t, p).value / eta - 1.0).abs() < 1e-13,
            "{t} {p}"
        );
    }
    // the same oil given by its viscosity at each temperature and one z
    let hot = sloping().viscosity(400.0, 0.0).value.ln() + 9.67;
    let alpha = oil.viscosity(400.0, 0.0).by_pressure / oil.viscosity(400.0, 0.0).value;
    assert!((alpha / (1.5e-8 * hot / reference) - 1.0).abs() < 1e-12);
}

#[test]
fn every_pressure_gives_a_finite_positive_viscosity() {
    for oil in laws().map(real).into_iter().chain([sloping()]) {
        for p in [-f64::MAX, -1e12, -1.97e8, 1e11, 1e30, f64::MAX] {
            let eta = oil.viscosity(300.0, p);
            let all = [eta.value, eta.by_temperature, eta.by_pressure];
            assert!(
                all.iter().all(|v| v.is_finite()) && eta.value > 0.0,
                "{oil:?} {p} {eta:?}"
            );
        }
    }
}

#[test]
fn tension_is_followed_smoothly() {
    for oil in laws().map(real) {
        let [below, at, above] = [-1.0, 0.0, 1.0].map(|p| oil.viscosity(T, p));
        assert!((below.by_pressure / at.by_pressure - 1.0).abs() < 1e-7);
        assert!((above.by_pressure / at.by_pressure - 1.0).abs() < 1e-7);
        let tension = oil.viscosity(T, -1e9).value;
        assert!(tension > 0.7 * at.value && tension < at.value);
    }
}

#[test]
fn reduced_pressure_is_the_integral_of_its_slope() {
    for oil in laws().map(real).into_iter().chain([sloping()]) {
        for t in [313.15, T] {
            let eta0 = oil.viscosity(t, 0.0).value;
            for p in [-3e8, -3e6, -1e5, 1e5, 3e7, 2e8] {
                let exact = oil.reduced_pressure(t, p);
                let slope = eta0 / oil.viscosity(t, p).value;
                assert!((exact.by_pressure / slope - 1.0).abs() < 1e-12, "{p}");
                let integral = simpson(&|p| eta0 / oil.viscosity(t, p).value, 0.0, p);
                assert!((exact.value / integral - 1.0).abs() < 1e-10, "{oil:?} {p}");
                let (by_t, by_p) = differences(|t, p| oil.reduced_pressure(t, p).value, t, p);
                // Barus' reduced pressure does not depend on temperature
                let bar = 1e-7 * exact.by_temperature.abs() + 1e-14 * exact.value.abs();
                assert!(
                    (by_t - exact.by_temperature).abs() <= bar,
                    "{oil:?} {t} {p}"
                );
                assert!(
                    (by_p / exact.by_pressure - 1.0).abs() <= 1e-7,
                    "{oil:?} {t} {p}"
                );
            }
        }
    }
    let plain = real(PressureLaw::None).reduced_pressure(T, 3e7);
    assert_eq!(
        plain,
        Derived {
            value: 3e7,
            by_temperature: 0.0,
            by_pressure: 1.0
        }
    );
}

/// Integral by Simpson's rule on 20000 intervals.
fn simpson(of: &dyn Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let count = 20000;
    let step = (to - from) / f64::from(count);
    let mut sum = of(from) + of(to);
    for i in 1..count {
        let weight = if i % 2 == 1 { 4.0 } else { 2.0 };
        sum += weight * of(from + f64::from(i) * step);
    }
    sum * step / 3.0
}

#[test]
fn the_bound_of_the_reduced_pressure() {
    let of = |eta, law| thickening(eta, law).limiting_reduced_pressure(T);
    let bound = |law| of(0.0068, law);
    assert_eq!(bound(PressureLaw::None), f64::INFINITY);
    assert_eq!(bound(roelands(0.0)), f64::INFINITY);
    assert!((bound(PressureLaw::Barus { alpha: 9.5e-9 }) - 105.26e6).abs() < 0.01e6);
    assert!((bound(roelands(9.5e-9)) - 143e6).abs() < 0.5e6);
    assert!((of(0.01, roelands(2e-8)) - 53e6).abs() < 0.5e6);
    // for z = 1 Roelands' law is Barus'
    let alpha = 5.1e-9 * (0.0068_f64.ln() + 9.67);
    assert!((bound(roelands(alpha)) * alpha - 1.0).abs() < 1e-13);
    // far up the reduced pressure reaches its bound, and grows towards it
    for alpha in [5e-9, 9.5e-9, 2e-8, 4e-8] {
        let oil = thickening(0.0068, roelands(alpha));
        let [near, far] = [3e8, 1e14].map(|p| oil.reduced_pressure(T, p).value);
        assert!(near < bound(roelands(alpha)));
        assert!(
            (far / bound(roelands(alpha)) - 1.0).abs() < 1e-12,
            "{alpha}"
        );
    }
}

/// The bound as `p0 e^L L^(-1/z) Gamma(1/z, L) / z` with the upper incomplete gamma function from its
/// continued fraction (Lentz), which shares nothing with the quadrature.
#[test]
fn the_bound_is_an_incomplete_gamma_function() {
    for (eta, alpha) in [
        (0.0068_f64, 9.5e-9),
        (0.0068, 2e-8),
        (0.1, 2.5e-8),
        (0.0068, 3e-9),
    ] {
        let l = eta.ln() + 9.67;
        let z = alpha / (5.1e-9 * l);
        let a = 1.0 / z;
        // Gamma(a, l) e^l l^-a = 1 / (l + 1 - a - 1 (1 - a) / (l + 3 - a - ...))
        let mut tail = 0.0;
        for k in (1..=4000).rev() {
            let k = f64::from(k);
            tail = k * (k - a) / (l + 1.0 - a + 2.0 * k - tail);
        }
        let gamma = 1.0 / (l + 1.0 - a - tail);
        let reference = gamma / (5.1e-9 * z);
        let ours = thickening(eta, roelands(alpha)).limiting_reduced_pressure(T);
        assert!(
            (ours / reference - 1.0).abs() < 1e-12,
            "{eta} {alpha} {ours} {reference}"
        );
    }
}

#[test]
fn parameters_that_describe_no_oil_are_refused() {
    for alpha in [-1e-9, 1e-6, f64::NAN] {
        for law in [PressureLaw::Barus { alpha }, roelands(alpha)] {
            assert!(matches!(
                thickening(0.01, law).check(),
                Err(OilError::OutOfRange { name: "alpha", .. })
            ));
        }
    }
    let slope = |s0, temperature| {
        thickening(
            0.01,
            PressureLaw::Roelands {
                alpha: 1e-8,
                temperature: RoelandsTemperature::Slope { s0, temperature },
            },
        )
        .check()
    };
    assert!(slope(1.2, T).is_ok() && slope(-0.1, T).is_err() && slope(1.2, 100.0).is_err());
    assert!(sloping().check_temperature(200.0).is_err());
    assert!(sloping().check_temperature(T).is_ok());
}
