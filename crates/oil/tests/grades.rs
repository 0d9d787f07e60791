//! Windows of SAE J300 against the printed table.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use sommerfeld_oil::{
    CROSS_EXPONENT, DensityLaw, GradeError, Lubricant, SaeGrade, ThinningForm, ViscosityLaw,
    sae::Viscometrics,
};

/// Agreement of limits as printed, in SI, with ours.
fn same(ours: Option<f64>, printed: &str, unit: f64) -> bool {
    match (ours, printed.parse::<f64>()) {
        (Some(ours), Ok(printed)) => (ours / (printed * unit) - 1.0).abs() < 1e-12,
        (ours, printed) => ours.is_none() && printed.is_err(),
    }
}

#[test]
fn windows_are_the_printed_ones() {
    let table = include_str!("../../../validation/sae-j300/reference.csv");
    let mut rows = 0;
    for line in table.lines().skip(2) {
        let cells: Vec<&str> = line.rsplitn(4, ',').collect();
        let [hths, high, low, label] = [cells[0], cells[1], cells[2], cells[3]];
        let names: &[&str] = match label.trim_matches('"') {
            "40 (0W/5W/10W-40)" => &["0W-40", "5W-40", "10W-40"],
            "40 (15W/20W/25W-40, 40)" => &["15W-40", "20W-40", "25W-40", "40"],
            name => &[name],
        };
        for name in names {
            let window = name.parse::<SaeGrade>().unwrap().window();
            assert!(
                same(Some(window.kv100_low), low, 1e-6),
                "{name}: {window:?}"
            );
            assert!(same(window.kv100_high, high, 1e-6), "{name}: {window:?}");
            assert!(same(window.hths_low, hths, 1e-3), "{name}: {window:?}");
        }
        rows += 1;
    }
    assert_eq!(rows, 15);
}

#[test]
fn winter_grades_have_the_printed_cold_limits() {
    let table = include_str!("../../../validation/sae-j300/cold.csv");
    let mut rows = 0;
    for line in table.lines().skip(2) {
        let cells: Vec<&str> = line.split(',').collect();
        let window = cells[0].parse::<SaeGrade>().unwrap().window();
        let (cranking, pumping) = (window.cranking.unwrap(), window.pumping.unwrap());
        assert!(same(Some(cranking.viscosity), cells[1], 1e-3), "{line}");
        assert!(
            same(Some(cranking.temperature - 273.15), cells[2], 1.0),
            "{line}"
        );
        assert!(same(Some(pumping.viscosity), cells[3], 1e-3), "{line}");
        assert!(
            same(Some(pumping.temperature - 273.15), cells[4], 1.0),
            "{line}"
        );
        rows += 1;
    }
    assert_eq!(rows, 6);
}

#[test]
fn grades_are_read_as_people_write_them() {
    for text in ["5W-30", "5w30", " SAE 5W-30 ", "sae5W30"] {
        assert_eq!(text.parse::<SaeGrade>().unwrap().to_string(), "5W-30");
    }
    for grade in SaeGrade::single() {
        assert_eq!(grade.to_string().parse::<SaeGrade>().unwrap(), grade);
    }
    for text in [
        "", "W", "5W-", "7W-30", "5W-35", "30W", "5W-30-40", "-30", "SAE", "+5W",
    ] {
        let error = text.parse::<SaeGrade>().unwrap_err();
        assert!(error.to_string().contains("5W-30"), "{text}: {error}");
    }
}

#[test]
fn an_oil_outside_its_window_is_named_with_both_values() {
    let grade: SaeGrade = "5W-30".parse().unwrap();
    let oil = |kv100, hths, cranking| Viscometrics {
        kv100: Some(kv100),
        hths: Some(hths),
        cranking: Some(cranking),
        pumping: None,
    };
    assert_eq!(grade.check(&oil(9.3e-6, 2.9e-3, 6.6)), Ok(()));
    let message = |oil| grade.check(&oil).unwrap_err().to_string();
    for (measured, needed) in [
        (
            oil(9.2e-6, 3e-3, 6.0),
            ["9.2000 mm2/s", "at least 9.3 mm2/s"],
        ),
        (
            oil(12.5e-6, 3e-3, 6.0),
            ["12.5000 mm2/s", "less than 12.5 mm2/s"],
        ),
        (
            oil(11e-6, 2.8e-3, 6.0),
            ["2.8000 mPa.s", "at least 2.9 mPa.s"],
        ),
        (
            oil(11e-6, 3e-3, 6.7),
            ["6700.0000 mPa.s", "at most 6600 mPa.s"],
        ),
    ] {
        let message = message(measured);
        assert!(
            needed.iter().all(|part| message.contains(part)),
            "{message}"
        );
        assert!(message.contains("SAE 5W-30"), "{message}");
    }
    assert!(matches!(
        grade.check(&oil(f64::NAN, 3e-3, 6.0)),
        Err(GradeError::Below { .. })
    ));
    assert_eq!(grade.check(&Viscometrics::default()), Ok(()));
}

#[test]
fn the_laws_of_an_oil_are_checked_at_100_and_150_degc() {
    let oil = Lubricant::newtonian(
        ViscosityLaw::AstmD341 {
            kv40: 65e-6,
            kv100: 11e-6,
        },
        DensityLaw::Constant { density: 850.0 },
    );
    let grade: SaeGrade = "5W-30".parse().unwrap();
    assert_eq!(grade.check_lubricant(&oil), Ok(()));
    let thinning = |hths| {
        let form = ThinningForm::Cross {
            exponent: CROSS_EXPONENT,
        };
        oil.clone().with_hths(hths, form, 0.5).unwrap()
    };
    assert_eq!(grade.check_lubricant(&thinning(2.9e-3)), Ok(()));
    assert!(matches!(
        grade.check_lubricant(&thinning(2.8e-3)),
        Err(GradeError::Below { .. })
    ));
    let thicker: SaeGrade = "5W-40".parse().unwrap();
    assert!(thicker.check_lubricant(&oil).is_err());
}
