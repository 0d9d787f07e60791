//! Shear thinning: limits, derivatives, identification.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use sommerfeld_oil::{
    CROSS_EXPONENT, CompressionLaw, DensityLaw, HTHS_SHEAR_RATE, HTHS_TEMPERATURE, Lubricant,
    OilError, PressureLaw, ShearThinning, ThinningForm, ViscosityLaw,
};

const HTHS: f64 = 3.1e-3;
const RATIO: f64 = 0.5;
const FORMS: [ThinningForm; 3] = [
    ThinningForm::Cross {
        exponent: CROSS_EXPONENT,
    },
    ThinningForm::Cross { exponent: 1.0 },
    ThinningForm::Carreau { exponent: 0.6 },
];

fn base() -> Lubricant {
    Lubricant {
        viscosity_pressure: PressureLaw::Barus { alpha: 1.5e-8 },
        density_pressure: CompressionLaw::DowsonHigginson,
        ..Lubricant::newtonian(
            ViscosityLaw::AstmD341 {
                kv40: 65e-6,
                kv100: 11e-6,
            },
            DensityLaw::ThermalExpansion {
                density: 850.0,
                temperature: 288.15,
                expansion: 6.5e-4,
            },
        )
    }
}

fn oils() -> [Lubricant; 3] {
    FORMS.map(|form| base().with_hths(HTHS, form, RATIO).unwrap())
}

#[test]
fn identification_returns_the_hths_it_was_given() {
    let low_shear = base().viscosity(HTHS_TEMPERATURE, 0.0).value;
    for form in FORMS {
        for part in [0.501, 0.6, 0.8, 0.99, 0.999_999] {
            let hths = part * low_shear;
            let oil = base().with_hths(hths, form, RATIO).unwrap();
            let back = oil
                .viscosity_at_shear(HTHS_TEMPERATURE, 0.0, HTHS_SHEAR_RATE)
                .value;
            assert!(
                (back / hths - 1.0).abs() < 1e-10,
                "{form:?} {part} {back} {hths}"
            );
            oil.check().unwrap();
        }
    }
}

#[test]
fn thinning_runs_from_one_newtonian_plateau_to_the_other() {
    for oil in oils() {
        for t in [313.15, 373.15, HTHS_TEMPERATURE] {
            let low = oil.viscosity(t, 1e7);
            let at = |rate| oil.viscosity_at_shear(t, 1e7, rate);
            assert_eq!(at(0.0).value, low.value, "{oil:?}");
            assert!(
                (at(1e22).value / (RATIO * low.value) - 1.0).abs() < 1e-6,
                "{oil:?}"
            );
            assert_eq!(at(-3e6).value, at(3e6).value);
            assert_eq!(at(-3e6).by_shear_rate, -at(3e6).by_shear_rate);
            let mut last = [low.value, 0.0];
            for k in 0..60 {
                let rate = 10_f64.powf(1.0 + 0.2 * f64::from(k));
                let now = [at(rate).value, at(rate).value * rate];
                assert!(
                    now[0] <= last[0] && now[1] > last[1],
                    "stress rises with the rate"
                );
                last = now;
            }
        }
    }
    let plain = base().viscosity_at_shear(373.15, 1e7, 1e7);
    assert_eq!(
        (plain.value, plain.by_shear_rate),
        (base().viscosity(373.15, 1e7).value, 0.0)
    );
}

#[test]
fn derivatives_agree_with_differences() {
    for oil in oils() {
        for t in [313.15, 373.15, 420.0] {
            for p in [1e5, 5e7] {
                for rate in [1e2, 1e5, 1e6, -2e7] {
                    let exact = oil.viscosity_at_shear(t, p, rate);
                    let slope = |at: &dyn Fn(f64) -> f64, h: f64| {
                        (8.0 * (at(h) - at(-h)) - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h)
                    };
                    let eta = |t, p, rate| oil.viscosity_at_shear(t, p, rate).value;
                    let by_t = slope(&|h| eta(t + h, p, rate), 0.05);
                    let by_p = slope(&|h| eta(t, p + h, rate), 2e4);
                    let by_rate = slope(&|h| eta(t, p, rate + h), 2e-3 * rate.abs());
                    let wrong = |ours: f64, exact: f64| (ours / exact - 1.0).abs();
                    assert!(
                        wrong(by_t, exact.by_temperature) < 1e-7,
                        "{oil:?} {t} {p} {rate}"
                    );
                    assert!(
                        wrong(by_p, exact.by_pressure) < 1e-7,
                        "{oil:?} {t} {p} {rate}"
                    );
                    // far below the critical rate the slope drowns in round-off
                    let bar = 1e-7 * (exact.by_shear_rate * rate).abs() + 1e-12 * exact.value;
                    let scaled = (by_rate - exact.by_shear_rate).abs() * rate.abs();
                    assert!(scaled < bar, "{oil:?} {t} {p} {rate} {scaled}");
                }
            }
        }
    }
}

/// Time-temperature superposition: curves of eta/eta1 over rate eta1 / (rho T) fall onto one.
#[test]
fn states_share_one_master_curve() {
    for oil in oils() {
        let reduced = |t: f64, p: f64, rate: f64| {
            let (eta, rho) = (oil.viscosity(t, p).value, oil.density(t, p).value);
            let there = rate * rho * t / eta;
            oil.viscosity_at_shear(t, p, there).value / eta
        };
        for rate in [1e-6, 1e-5, 1e-4, 1e-2] {
            let one = reduced(HTHS_TEMPERATURE, 0.0, rate);
            let two = reduced(313.15, 8e7, rate);
            assert!((one / two - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn the_rounded_cusp_is_continuous_and_finite() {
    let law = ShearThinning::Cross {
        second_newtonian_ratio: RATIO,
        critical_shear_rate: 1e6,
        exponent: CROSS_EXPONENT,
        reference: None,
    };
    let [below, above] = [1e-9 * (1.0 - 1e-9), 1e-9 * (1.0 + 1e-9)].map(|x| law.factor(x));
    assert!((below[0] - above[0]).abs() < 1e-14);
    assert!((below[1] / above[1] - 1.0).abs() < 1e-8);
    assert_eq!(law.factor(0.0), [1.0, 0.0]);
    // one oil everywhere without a reference state
    let oil = Lubricant {
        shear_thinning: law,
        ..base()
    };
    for t in [313.15, 373.15] {
        let eta = oil.viscosity(t, 0.0).value;
        assert!((oil.viscosity_at_shear(t, 0.0, 1e6).value / eta - 0.75).abs() < 1e-14);
    }
}

#[test]
fn what_cannot_be_identified_is_refused() {
    let low_shear = base().viscosity(HTHS_TEMPERATURE, 0.0).value;
    let with = |hths, form, ratio| base().with_hths(hths, form, ratio).unwrap_err();
    for form in FORMS {
        assert!(matches!(
            with(1.01 * low_shear, form, RATIO),
            OilError::NotShearThinning { .. }
        ));
        assert!(matches!(
            with(0.4 * low_shear, form, RATIO),
            OilError::BelowSecondNewtonian { .. }
        ));
        for ratio in [-0.1, 1.0, f64::NAN] {
            assert!(matches!(
                with(HTHS, form, ratio),
                OilError::OutOfRange { .. }
            ));
        }
        assert!(matches!(
            with(0.0, form, RATIO),
            OilError::NotPositive { .. }
        ));
    }
    for exponent in [0.0, 1.1, f64::NAN] {
        assert!(matches!(
            with(HTHS, ThinningForm::Cross { exponent }, RATIO),
            OilError::OutOfRange {
                name: "exponent",
                ..
            }
        ));
    }
}
