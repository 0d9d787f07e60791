//! Shapes of bore and journal, from the study file to results.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use sommerfeld_film::{Feature, Outcome, ReliefForm};
use sommerfeld_study::input::Study;
use sommerfeld_study::load_study;
use sommerfeld_study::results::Body;
use sommerfeld_study::solve;
use std::fs;
use std::ops::ControlFlow;

const OPERATION: &str = "
[oil]
viscosity = \"8 mPa.s\"
[film]
cavitation = \"reynolds\"
grid = [48, 8]
[operation]
speed = \"2000 rpm\"
relative_eccentricity = 0.5
line_of_centres_angle = \"90 deg\"
";

/// A film study with these shapes, and profile tables beside it.
fn study(shapes: &str, files: &[(&str, String)]) -> Study {
    let directory = tempfile::tempdir().unwrap();
    for (name, content) in files {
        fs::write(directory.path().join(name), content).unwrap();
    }
    let path = directory.path().join("study.toml");
    let bearing = "schema = 1\nanalysis = \"film\"\n[bearing]\ndiameter = \"72 mm\"\n\
                   width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n";
    fs::write(&path, format!("{bearing}{shapes}{OPERATION}")).unwrap();
    load_study(&path).unwrap_or_else(|errors| panic!("{errors}"))
}

fn minimum_film(study: &Study) -> f64 {
    let results = solve(study, &mut |_| ControlFlow::Continue(())).unwrap();
    let Body::Steady(steady) = results.body else {
        panic!()
    };
    steady.summary.minimum_film_thickness.value
}

#[test]
fn every_key_becomes_its_feature() {
    let study = study(
        "[bearing.bore]\nkind = \"lemon\"\npreload = 0.5\njoint_angle = \"30 deg\"\ncrowning = \"4 um\"\n\
         relief = { depth = \"5 um\", length = \"3 mm\", form = \"circular\", ends = \"rear\" }\n\
         crush_relief = { depth = \"20 um\", length = \"3.6 mm\" }\n\
         [[bearing.bore.harmonic]]\norder = 3\namplitude = \"1 um\"\nphase = \"90 deg\"\n\
         [bearing.journal]\ncrowning = \"2 um\"\nrelief = { depth = \"5 um\", length = \"3 mm\" }\n",
        &[],
    );
    let bearing = &study.bearing_case().unwrap().bearing;
    let [lemon, crown, relief, joint, opposite, wave] = &bearing.bore.features[..] else {
        panic!("{:?}", bearing.bore)
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * b.abs();
    assert!(matches!(lemon, Feature::Lemon { shift, joint }
        if near(*shift, 36e-6) && near(*joint, 30_f64.to_radians())));
    assert!(matches!(crown, Feature::Crowning { end_offset, half_width }
        if near(*end_offset, 4e-6) && near(*half_width, 0.015)));
    assert!(
        matches!(relief, Feature::EndRelief { end, length, end_offset, form: ReliefForm::Circular }
        if near(*end, 0.015) && near(*length, 3e-3) && near(*end_offset, 5e-6))
    );
    for (feature, degrees) in [(joint, 30_f64), (opposite, 210.0)] {
        assert!(
            matches!(feature, Feature::JointRelief { offset, half_span, joint }
            if near(*offset, 20e-6) && near(*half_span, 0.1) && near(*joint, degrees.to_radians()))
        );
    }
    assert!(
        matches!(wave, Feature::Harmonic { order: 3, amplitude, phase }
        if near(*amplitude, 1e-6) && near(*phase, 90_f64.to_radians()))
    );
    // What widens the gap takes from the journal, at both ends.
    let ends: Vec<f64> = bearing
        .journal
        .features
        .iter()
        .map(|f| match f {
            Feature::Crowning { end_offset, .. } | Feature::EndRelief { end_offset, .. } => {
                *end_offset
            }
            _ => panic!("{f:?}"),
        })
        .collect();
    assert!(ends.len() == 3 && near(ends[0], -2e-6) && near(ends[1], -5e-6) && ends[1] == ends[2]);
}

/// Square to the joint the clearance of a lemon is the nominal one; along it, that of its arcs.
#[test]
fn a_lemon_bore_runs() {
    let lemon = |joint: &str| {
        let shapes =
            format!("[bearing.bore]\nkind = \"lemon\"\npreload = 0.5\njoint_angle = \"{joint}\"\n");
        minimum_film(&study(&shapes, &[]))
    };
    assert!((lemon("0 deg") - 18e-6).abs() < 1e-15);
    // At the joint 36 + 36 - 18 um; the least is where the gap of the arcs beside it is: searched.
    let gap = |angle: f64| 36e-6 - 18e-6 * angle.sin() + 36e-6 * (1.0 - angle.cos().abs());
    let least = (0..100_000).map(|k| gap(f64::from(k) * 1e-5 * std::f64::consts::TAU));
    let least = least.fold(f64::INFINITY, f64::min);
    assert!((lemon("90 deg") - least).abs() < 1e-12);
}

/// A table of a wave is the wave, and its content is part of the study.
#[test]
fn a_table_of_a_wave_is_the_wave() {
    let wave = study(
        "[[bearing.bore.harmonic]]\norder = 2\namplitude = \"6 um\"\nphase = \"20 deg\"\n",
        &[],
    );
    let csv = |amplitude: f64| {
        let rows = (0..72).map(|k| {
            let angle = f64::from(5 * k);
            let offset = amplitude * (2.0 * (angle - 20.0).to_radians()).cos();
            format!("{angle},{offset}\r\n")
        });
        "angle[deg],offset[um]\r\n".to_owned() + &rows.collect::<String>()
    };
    let shapes = "[bearing.bore]\nkind = \"table\"\nfile = \"bore.csv\"\n";
    let table = study(shapes, &[("bore.csv", csv(6.0))]);
    let films = [&wave, &table].map(minimum_film);
    assert!((films[0] - films[1]).abs() < 5e-9, "{films:?}");
    let other = study(shapes, &[("bore.csv", csv(5.0))]);
    assert_eq!(table.text, other.text);
    assert_ne!(table.input_hash, other.input_hash);
}

/// A journal of two lobes turns under a load: its film is thinner than that of a round one, and the
/// orbit follows it twice a turn.
#[test]
fn a_journal_that_is_not_round_turns_through_its_cycle() {
    let cycle = |shapes: &str| {
        let directory = tempfile::tempdir().unwrap();
        let loads: String = (0..8).map(|k| format!("{},2000,0\n", 45 * k)).collect();
        let loads = format!("crank_angle[deg],load_x[N],load_y[N]\n{loads}");
        fs::write(directory.path().join("loads.csv"), loads).unwrap();
        let path = directory.path().join("study.toml");
        let text = format!(
            "schema = 1\nanalysis = \"load-cycle\"\n[bearing]\ndiameter = \"72 mm\"\n\
             width = \"30 mm\"\ndiametral_clearance = \"72 um\"\n{shapes}\n\
             [[bearing.groove]]\nkind = \"hole\"\nangle = \"180 deg\"\ndiameter = \"6 mm\"\n\
             pressure = \"5 bar\"\n[oil]\nviscosity = \"8 mPa.s\"\n[film]\ngrid = [48, 8]\n\
             [load_cycle]\nfile = \"loads.csv\"\nengine_speed = \"2000 rpm\"\n\
             period = \"360 deg\"\ncrank_step = \"5 deg\"\n"
        );
        fs::write(&path, text).unwrap();
        let study = load_study(&path).unwrap_or_else(|errors| panic!("{errors}"));
        let results = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(results.header.status, Outcome::Converged);
        let Body::LoadCycle(cycle) = results.body else {
            panic!()
        };
        let films = cycle
            .orbit
            .points
            .iter()
            .map(|p| p.summary.minimum_film_thickness.value);
        let range = |axis: usize| {
            let places = cycle.orbit.points.iter().map(|p| p.state.position[axis]);
            places.clone().fold(f64::MIN, f64::max) - places.fold(f64::MAX, f64::min)
        };
        (films.fold(f64::INFINITY, f64::min), range(0).max(range(1)))
    };
    let (round_film, round_range) = cycle("");
    let lobes = "[[bearing.journal.harmonic]]\norder = 2\namplitude = \"2 um\"\n";
    let (film, range) = cycle(lobes);
    assert!(film > 0.0 && film < round_film, "{film} {round_film}");
    assert!(
        range > 0.5e-6 && range > 10.0 * round_range,
        "{range} {round_range}"
    );
}
