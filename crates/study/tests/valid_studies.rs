//! Templates and the forms of the study file are read into the right SI values.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_film::{Cavitation, FilmShear, Inlet};
use sommerfeld_study::input::{Duty, FilmModel, Study, Subject, TiltCondition, study_from_text};
use sommerfeld_study::load_study;
use sommerfeld_study::templates::{self, TEMPLATES};
use std::fs;
use std::path::Path;

fn accepted(text: &str) -> Study {
    study_from_text("study.toml", text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"))
}

fn template(name: &str) -> &'static str {
    templates::find(name).unwrap().study
}

#[test]
fn every_template_is_accepted_without_a_warning() {
    let directory = tempfile::tempdir().unwrap();
    for template in TEMPLATES {
        let path = directory.path().join(template.name).with_extension("toml");
        fs::write(&path, template.study).unwrap();
        for (name, content) in template.files {
            fs::write(directory.path().join(name), content).unwrap();
        }
        let study = load_study(&path).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(
            study.warnings.is_empty(),
            "{}: {:?}",
            template.name,
            study.warnings
        );
    }
}

#[test]
fn film_study_in_si() {
    let text = template("film").to_owned()
        + "relative_eccentricity_rate = \"20 1/s\"\nline_of_centres_rate = \"90 deg/s\"\n";
    let study = accepted(&text);
    let case = study.bearing_case().unwrap();
    assert!((case.bearing.radial_clearance - 25e-6).abs() < 1e-18);
    assert_eq!(case.bearing.cavitation, Cavitation::MassConserving);
    assert_eq!(case.bearing.film_shear, FilmShear::FilmFraction);
    assert!((case.temperature - 373.15).abs() < 1e-12);
    let Duty::State(state) = &case.duty else {
        panic!()
    };
    assert!((state.eccentricity() - 20e-6).abs() < 1e-18);
    assert!((state.line_of_centres_angle().to_degrees() - 30.0).abs() < 1e-12);
    assert!((state.journal_speed - 100.0 * std::f64::consts::PI).abs() < 1e-12);
    // Along the line of centres c eps_rate, across it e times the turning rate.
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let [vx, vy] = state.velocity;
    assert!((vx * cos + vy * sin - 25e-6 * 20.0).abs() < 1e-15);
    assert!((vy * cos - vx * sin - 20e-6 * std::f64::consts::FRAC_PI_2).abs() < 1e-15);
}

#[test]
fn a_moment_frees_the_tilt() {
    let steady = |text: &str| match accepted(text).bearing_case().unwrap().duty {
        Duty::Load(load) => load,
        _ => panic!(),
    };
    let text = template("main-bearing");
    assert_eq!(steady(text).tilt, TiltCondition::Fixed([0.0; 2]));
    assert_eq!(steady(text).load, [8000.0, 0.0]);
    let text = text.replace("# moment", "moment");
    assert_eq!(
        steady(&text).tilt,
        TiltCondition::Free { moment: [0.0, 5.0] }
    );
}

#[test]
fn closed_forms_have_their_own_closure() {
    let text = template("main-bearing").to_owned() + "\n[film]\nmodel = \"long-bearing\"\n";
    let study = accepted(&text);
    assert_eq!(study.film.model, FilmModel::LongBearing);
    let bearing = &study.bearing_case().unwrap().bearing;
    assert_eq!(bearing.cavitation, Cavitation::Gumbel);
    assert_eq!(bearing.film_shear, FilmShear::FullWidth);
    assert!(study.warnings[0].message.contains("has no grooves"));
}

#[test]
fn byte_order_mark_and_windows_line_ends() {
    let plain = accepted(template("dimensionless"));
    let text = format!(
        "\u{feff}{}",
        template("dimensionless").replace('\n', "\r\n")
    );
    let windows = accepted(&text);
    assert_eq!(plain.subject, windows.subject);
    let Subject::Dimensionless(case) = plain.subject else {
        panic!()
    };
    assert_eq!(case.inlet, Inlet::Cyclic);
    assert_eq!((case.wedge, case.squeeze), (1.0, 0.0));
}

#[test]
fn the_hash_follows_the_inputs() {
    let hash = |text: &str| accepted(text).input_hash;
    let text = template("film");
    assert_eq!(hash(text), hash(text));
    assert_ne!(hash(text), hash(&text.replace("0.8", "0.7")));
}

#[test]
fn keys_of_another_analysis_are_a_warning() {
    let text = template("main-bearing").to_owned() + "relative_eccentricity = 0.5\n";
    let warnings = accepted(&text).warnings;
    assert_eq!(warnings.len(), 1);
    assert_eq!(warnings[0].key, "operation.relative_eccentricity");
    assert_eq!(warnings[0].place.as_ref().unwrap().columns.start, 1);
}
