//! Oils by name, and oils as older inputs write them.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use sommerfeld_oil::{
    ConductivityLaw, HeatCapacityLaw, Lubricant, OilError, PressureLaw, SaeGrade, ViscosityLaw,
    library::{LibraryError, library, named, read},
};

#[test]
fn every_oil_is_whole_and_has_its_source() {
    let oils = library().unwrap();
    assert!(oils.len() >= 8, "{}", oils.len());
    for (place, oil) in oils.iter().enumerate() {
        let is_new = oils[..place].iter().all(|other| other.name != oil.name);
        assert!(is_new, "{} twice", oil.name);
        assert_eq!(named(&oil.name).unwrap(), *oil);
        assert!(!oil.source.is_empty() && !oil.licence.is_empty() && !oil.title.is_empty());
        assert!((1900..=2100).contains(&oil.year), "{}", oil.name);
        let (low, high) = (oil.temperatures.low, oil.temperatures.high);
        assert!(low <= high, "{}", oil.name);
        for t in [low, high] {
            oil.lubricant.check_temperature(t).unwrap();
            assert!(
                (1e-3..100.0).contains(&oil.lubricant.viscosity(t, 0.0).value),
                "{}",
                oil.name
            );
        }
    }
}

#[test]
fn the_provenance_table_names_every_oil() {
    let table = include_str!("../data/README.md");
    for oil in library().unwrap() {
        assert!(table.contains(&format!("`{}`", oil.name)), "{}", oil.name);
    }
}

/// Viscosities (mPa s) and pressure coefficients (1e-9 1/Pa) at 30, 60 and 100 degC of Stachowiak and
/// Batchelor (2001), table 2.3. The coefficient at 100 degC is the law's; the others are its forecast
/// with z from there, which the source's own scatter allows to 15 %.
#[test]
fn machine_oils_follow_their_table() {
    for (name, viscosities, coefficients) in [
        (
            "heavy-machine-oil-153",
            [153.0, 34.0, 9.1],
            [23.7, 20.5, 15.8],
        ),
        (
            "heavy-machine-oil-250",
            [250.0, 50.5, 12.6],
            [25.0, 21.3, 17.6],
        ),
        ("cylinder-oil-810", [810.0, 135.0, 26.8], [34.0, 28.0, 22.0]),
    ] {
        let oil = named(name).unwrap().lubricant;
        let temperatures = [303.15, 333.15, 373.15];
        for (place, t) in temperatures.into_iter().enumerate() {
            let eta = oil.viscosity(t, 0.0);
            assert!(
                (eta.value * 1e3 / viscosities[place] - 1.0).abs() < 1e-9,
                "{name} {t}"
            );
            let forecast = eta.by_pressure / eta.value * 1e9;
            let bar = if t == 373.15 { 1e-9 } else { 0.15 };
            assert!(
                (forecast / coefficients[place] - 1.0).abs() < bar,
                "{name} {t} {forecast}"
            );
        }
        let fit = [0, 1, 2].map(|i| [temperatures[i], viscosities[i] * 1e-3]);
        let (
            ViscosityLaw::Vogel { a, b, c },
            ViscosityLaw::Vogel {
                a: a2,
                b: b2,
                c: c2,
            },
        ) = (oil.viscosity, ViscosityLaw::vogel_through(fit).unwrap())
        else {
            unreachable!("both are Vogel's")
        };
        for (ours, fitted) in [(a, a2), (b, b2), (c, c2)] {
            assert!((ours / fitted - 1.0).abs() < 1e-9);
        }
    }
}

/// Viscosity index of the nominal grades from rows `Y, L, H` of ASTM D2270 (2010), table 1.
#[test]
fn iso_grades_have_the_viscosity_index_95() {
    for (grade, rows) in [
        (32.0, [[5.2, 43.76, 30.43], [5.3, 45.53, 31.40]]),
        (46.0, [[6.6, 69.16, 44.24], [6.7, 71.29, 45.33]]),
        (68.0, [[8.5, 111.5, 65.32], [8.6, 113.9, 66.48]]),
        (100.0, [[11.0, 173.9, 95.19], [11.1, 176.6, 96.45]]),
    ] {
        let oil = named(&format!("iso-vg-{grade}")).unwrap().lubricant;
        let [kv40, kv100] = [313.15, 373.15].map(|t| oil.kinematic_viscosity(t) * 1e6);
        assert!((kv40 / grade - 1.0).abs() < 1e-9);
        let part = (kv100 - rows[0][0]) / (rows[1][0] - rows[0][0]);
        let [l, h] = [1, 2].map(|i| rows[0][i] + part * (rows[1][i] - rows[0][i]));
        let index = 100.0 * (l - kv40) / (l - h);
        assert!((index - 95.0).abs() < 0.5, "ISO VG {grade}: {index}");
    }
}

#[test]
fn cases_of_this_program_are_what_they_were() {
    let rig = named("sander-rig").unwrap().lubricant;
    assert_eq!(rig.viscosity(373.15, 0.0).value, 6.8e-3);
    assert_eq!(rig.viscosity_pressure, PressureLaw::Barus { alpha: 9.5e-9 });
    let heat = named("heat-balance-case").unwrap().lubricant;
    assert_eq!(heat.volumetric_heat(350.0, 0.0).value, 1.8e6);
    let eta = heat.viscosity(273.15 + 69.74, 0.0).value;
    assert!((eta / (1.3e-4 * (900.0_f64 / 179.74).exp()) - 1.0).abs() < 1e-12);
    for (name, grade) in [("nominal-5w-30", "5W-30"), ("nominal-15w-40", "15W-40")] {
        let grade: SaeGrade = grade.parse().unwrap();
        assert_eq!(
            grade.check_lubricant(&named(name).unwrap().lubricant),
            Ok(())
        );
    }
}

#[test]
fn an_oil_of_two_laws_still_reads() {
    let old = r#"
        viscosity = { law = "constant", viscosity = 0.01 }
        density = { law = "constant", density = 850.0 }
    "#;
    let oil: Lubricant = toml::from_str(old).unwrap();
    assert_eq!(oil, Lubricant::constant(0.01, 850.0));
    assert_eq!(oil.heat_capacity, HeatCapacityLaw::default());
    let roelands = r#"
        viscosity = { law = "constant", viscosity = 0.01 }
        viscosity_pressure = { law = "roelands", alpha = 1e-8 }
        density = { law = "constant", density = 850.0 }
        density_pressure = { law = "limit-1.34" }
        conductivity = { law = "mineral-oil", relative_density = 0.85 }
    "#;
    let oil: Lubricant = toml::from_str(roelands).unwrap();
    oil.check().unwrap();
    let again: Lubricant = toml::from_str(&toml::to_string(&oil).unwrap()).unwrap();
    assert_eq!(again, oil);
    assert_eq!(
        again.conductivity,
        ConductivityLaw::MineralOil {
            relative_density: 0.85
        }
    );
}

#[test]
fn volumetric_heat_follows_both_of_its_laws() {
    let oil = Lubricant {
        density_pressure: sommerfeld_oil::CompressionLaw::DowsonHigginson,
        ..Lubricant::newtonian(
            ViscosityLaw::Constant { viscosity: 0.01 },
            sommerfeld_oil::DensityLaw::ThermalExpansion {
                density: 870.0,
                temperature: 288.15,
                expansion: 7e-4,
            },
        )
    };
    for (t, p) in [(313.15, 1e5), (400.0, 1e8)] {
        let exact = oil.volumetric_heat(t, p);
        let at = |t, p| oil.volumetric_heat(t, p).value;
        let by_t = (at(t + 0.1, p) - at(t - 0.1, p)) / 0.2;
        let by_p = (at(t, p + 1e4) - at(t, p - 1e4)) / 2e4;
        assert!((by_t / exact.by_temperature - 1.0).abs() < 1e-7);
        assert!((by_p / exact.by_pressure - 1.0).abs() < 1e-7);
        assert_eq!(
            exact.value,
            oil.density(t, p).value * oil.heat_capacity.at(t).value
        );
    }
    assert!(oil.heat_temperature_range().contains(373.15));
    assert!(!oil.heat_temperature_range().contains(600.0));
}

#[test]
fn what_is_no_data_file_is_named() {
    let unknown = named("snake-oil").unwrap_err().to_string();
    assert!(
        unknown.contains("snake-oil") && unknown.contains("iso-vg-46"),
        "{unknown}"
    );
    let head = "source = \"s\"\nyear = 2026\nlicence = \"l\"\n";
    let entry = |viscosity: &str| {
        format!(
            "{head}[[oil]]\nname = \"n\"\ntitle = \"t\"\ntemperatures = [300.0, 400.0]\n[oil.lubricant]\n\
             viscosity = {{ law = \"constant\", viscosity = {viscosity} }}\ndensity = {{ law = \"constant\", density = 850.0 }}\n"
        )
    };
    assert_eq!(read("a.toml", &entry("0.01")).unwrap().len(), 1);
    assert!(matches!(
        read("a.toml", &entry("-0.01")),
        Err(LibraryError::Oil {
            error: OilError::NotPositive { .. },
            ..
        })
    ));
    assert!(matches!(
        read("a.toml", &format!("{head}oils = 3")),
        Err(LibraryError::File { .. })
    ));
}
