//! Databases of films in studies: built, looked up, refused with what the file holds, stopped and taken up.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use serde_json::Value;
use sommerfeld_database::superposition::{SuperpositionRecipe, SuperpositionTable};
use sommerfeld_database::table::Axes;
use sommerfeld_database::{Recipe, Table};
use sommerfeld_study::database_files::{self, FileCheck};
use sommerfeld_study::film_tables::{FilmTable, StoredFilms};
use sommerfeld_study::input::{DatabasePlan, Subject, study_from_text};
use sommerfeld_study::output::summary;
use sommerfeld_study::report::render;
use sommerfeld_study::results::{Body, Results};
use sommerfeld_study::{RunOptions, RunSummary, run_with, solve};
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tempfile::TempDir;

const BUILD: &str = "schema = 1\nanalysis = \"database\"\n[database]\nwidth_ratios = 0.4\ntarget = 1e-2\n\
    last_eccentricity = 0.95\nsamples = 100\n[film]\ncavitation = \"reynolds\"\n";
const BEARING: &str =
    "[bearing]\ndiameter = \"72 mm\"\nwidth = \"28.8 mm\"\ndiametral_clearance = \"72 um\"\n";
const OIL: &str = "[oil]\nviscosity = \"8 mPa.s\"\n";
const STEADY: &str = "[operation]\nspeed = \"2000 rpm\"\nload = [\"6 kN\", \"0 N\"]\n";

fn build(directory: &Path, text: &str, threads: usize) -> RunSummary {
    let study =
        study_from_text("films.toml", text, directory).unwrap_or_else(|errors| panic!("{errors}"));
    let options = RunOptions {
        threads: Some(threads),
        ..RunOptions::default()
    };
    let results = directory.join("films");
    let mut last = 0.0;
    run_with(&study, &results, options, &mut |event| {
        assert!((0.0..=1.0).contains(&event.done) && event.done >= last - 1e-12);
        last = event.done;
        ControlFlow::Continue(())
    })
    .unwrap_or_else(|error| panic!("{error}"))
}

/// A directory with a database in `films/table.h5`, built once for all tests.
fn films() -> &'static Path {
    static FILMS: OnceLock<TempDir> = OnceLock::new();
    let directory = FILMS.get_or_init(|| {
        let directory = tempfile::tempdir().unwrap();
        build(directory.path(), BUILD, 2);
        directory
    });
    directory.path()
}

fn study_text(bearing: &str, film: &str, duty: &str) -> String {
    let analysis = if duty.contains("load_cycle") {
        "load-cycle"
    } else {
        "equilibrium"
    };
    format!("schema = 1\nanalysis = \"{analysis}\"\n{bearing}{OIL}[film]\n{film}{duty}")
}

fn results(text: &str) -> Results {
    let study =
        study_from_text("study.toml", text, films()).unwrap_or_else(|errors| panic!("{errors}"));
    solve(&study, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn number(summary: &Value, key: &str) -> f64 {
    summary[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key}: {summary}"))
}

const FILM: &str = "model = \"database\"\ndatabase = \"films/table.h5\"\n";

#[test]
fn a_build_tells_what_it_found() {
    let directory = tempfile::tempdir().unwrap();
    let ran = build(directory.path(), BUILD, 1);
    let found = summary(&ran.results);
    assert_eq!(found["status"], "converged", "{}", found["messages"]);
    for key in [
        "points",
        "maximum_relative_error",
        "error_samples",
        "build_time_s",
    ] {
        assert!(number(&found, key) > 0.0, "{key}");
    }
    assert!(number(&found, "maximum_relative_error") <= 1e-2);
    let file = PathBuf::from(found["file"].as_str().unwrap());
    assert!(file.is_file() && ran.files.contains(&file));
    // What the summary says stands in the file.
    let told = database_files::info(&file).unwrap();
    assert!(
        told.contains("reynolds") && told.contains("force_along[-]"),
        "{told}"
    );
    let stored = StoredFilms::load("table.h5", &file).unwrap();
    assert_eq!(
        stored.facts().stated_error,
        number(&found, "maximum_relative_error")
    );
    assert_eq!(stored.facts().points as f64, number(&found, "points"));
    let page = render(&ran.results).unwrap();
    for part in ["database-histogram", "database-force", "How far it errs"] {
        assert!(page.contains(part), "{part}");
    }
    // Whatever the number of threads, the same table.
    assert_eq!(
        stored.table,
        StoredFilms::load("table.h5", &films().join("films/table.h5"))
            .unwrap()
            .table
    );
}

/// The film of the database is that of the grid, in every analysis, within what the file states.
#[test]
fn a_film_that_is_looked_up_is_that_of_the_grid() {
    let grid = "grid = [256, 32]\n";
    let looked = results(&study_text(BEARING, FILM, STEADY));
    let found = summary(&looked);
    assert_eq!(found["status"], "converged", "{}", found["messages"]);
    let field = format!("cavitation = \"reynolds\"\n{grid}");
    let direct = summary(&results(&study_text(BEARING, &field, STEADY)));
    for (key, bar) in [
        ("relative_eccentricity", 2e-3),
        ("minimum_film_thickness_m", 1e-2),
        ("peak_film_pressure_pa", 1e-2),
        ("power_loss_w", 1e-2),
        ("side_flow_m3_s", 2e-2),
    ] {
        let (a, b) = (number(&found, key), number(&direct, key));
        assert!((a / b - 1.0).abs() < bar, "{key}: {a} {b}");
    }
    // The error of the file stands beside the results.
    let database = &found["databases"][0];
    assert_eq!(database["file"], "films/table.h5");
    assert!(number(database, "maximum_relative_error") <= 1e-2);
    assert!(render(&looked).unwrap().contains("stated error"));
    let figures = looked.key_figures();
    assert!(
        figures
            .iter()
            .any(|(_, text)| text.contains("stated error"))
    );
}

/// What the study says against what the file holds.
#[test]
fn what_a_database_does_not_hold_is_refused_with_what_it_does() {
    let wide = BEARING.replace("28.8 mm", "36 mm");
    let rough = format!(
        "{BEARING}[bearing.surface]\nroughness_journal = \"0.3 um\"\nroughness_shell = \"0.4 um\"\n"
    );
    let hole = format!(
        "{BEARING}[[bearing.groove]]\nkind = \"hole\"\nangle = \"180 deg\"\ndiameter = \"6 mm\"\npressure = \"3 bar\"\n"
    );
    let tilted = format!("{STEADY}tilt = [\"0 rad\", \"0.1 mrad\"]\n");
    let cases: [(&str, &str, &str, &str); 7] = [
        (
            BEARING,
            "cavitation = \"gumbel\"\n",
            STEADY,
            "its films have \"reynolds\"",
        ),
        (
            BEARING,
            "cavitation = \"mass-conserving\"\n",
            STEADY,
            "its films have \"reynolds\"",
        ),
        (
            &wide,
            "",
            STEADY,
            "width/diameter 0.400000, the bearing has 0.500000",
        ),
        (
            BEARING,
            "inlet = \"max-film-line\"\n",
            STEADY,
            "its films have \"cyclic\"",
        ),
        (&rough, "", STEADY, "the model database"),
        (&hole, "", STEADY, "no grooves and holes"),
        (BEARING, "", &tilted, "has no tilt"),
    ];
    for (bearing, film, duty, expected) in cases {
        let text = study_text(bearing, &format!("{FILM}{film}"), duty);
        let Err(errors) = study_from_text("study.toml", &text, films()) else {
            panic!("accepted: {text}");
        };
        assert!(
            errors.to_string().contains(expected),
            "{expected}\n{errors}"
        );
    }
    // Ends at a pressure other than that of the films.
    let text = study_text(
        BEARING,
        &format!("{FILM}ambient_pressure = \"1 bar\"\ncavitation_pressure = \"1 bar\"\n"),
        STEADY,
    );
    let Err(errors) = study_from_text("study.toml", &text, films()) else {
        panic!("accepted: {text}");
    };
    assert!(errors.to_string().contains("pressure"), "{errors}");
}

/// Of several files each bearing takes the first that holds it.
#[test]
fn of_several_files_the_one_that_holds_the_bearing_is_taken() {
    let directory = tempfile::tempdir().unwrap();
    // The same films under the name of another width: it is the name that decides.
    let stored = StoredFilms::load("", &films().join("films/table.h5")).unwrap();
    let FilmTable::Combined(table) = &stored.table else {
        panic!("another table");
    };
    let wide = Recipe {
        width_ratios: [0.6; 2],
        ..*table.recipe()
    };
    let axes = Axes::new(&wide, table.axes().counts()).unwrap();
    let table = Table::new(wide, axes, table.nodes().to_vec(), *table.errors()).unwrap();
    for place in ["films", "other"] {
        fs::create_dir(directory.path().join(place)).unwrap();
    }
    table
        .save(&directory.path().join("films/table.h5"))
        .unwrap();
    fs::copy(
        films().join("films/table.h5"),
        directory.path().join("other/table.h5"),
    )
    .unwrap();
    let film = "model = \"database\"\ndatabase = [\"films/table.h5\", \"other/table.h5\"]\n";
    let text = study_text(BEARING, film, STEADY);
    let study = study_from_text("study.toml", &text, directory.path()).unwrap();
    let found = solve(&study, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(found.header.databases.len(), 1);
    assert_eq!(found.header.databases[0].file, "other/table.h5");
    let both = summary(&found);
    let alone = summary(&results(&study_text(BEARING, FILM, STEADY)));
    assert_eq!(both["force_n"], alone["force_n"]);
}

/// Films of tilted journals: built from a study, looked up with tilts, and a film model that tilts.
#[test]
fn tilted_journals_have_a_superposition_too() {
    let directory = tempfile::tempdir().unwrap();
    let text = "schema = 1\nanalysis = \"database\"\n[database]\nscheme = \"superposition\"\n\
        journal = \"tilted\"\nwidth_ratios = 0.4\ntarget = 0.05\nsamples = 8\nnodes = [5, 5, 5]\n\
        smallest_gap = 0.3\nlast_eccentricity = 0.6\nmost_films = 2000\n[film]\ncavitation = \"reynolds\"\n";
    let study = study_from_text("films.toml", text, directory.path()).unwrap();
    let Subject::Database(plan) = &study.subject else {
        panic!("another study");
    };
    let DatabasePlan::Superposition(recipe) = plan.as_ref() else {
        panic!("another plan");
    };
    assert_eq!((recipe.eccentricity_nodes, recipe.tilt_nodes), (5, [5, 5]));
    // On few cells: what is tried here is not how well it is solved.
    let recipe = SuperpositionRecipe {
        grid: [32, 8],
        centre_nodes: [5, 4],
        target: 0.9,
        ..*recipe
    };
    let file = directory.path().join("table.h5");
    SuperpositionTable::build(&recipe, Some(&file), &mut |_, _| true).unwrap();
    let stored = StoredFilms::load("table.h5", &file).unwrap();
    assert!(stored.facts().told().contains("tilted"));
    let state = database_files::State {
        width_ratio: 0.4,
        eccentricity: 0.4,
        angle: -1.5,
        tilts: [0.3, -0.2],
    };
    let found = database_files::look_up(&stored, &state).unwrap();
    assert!(
        found.moment.iter().all(|moment| moment.abs() > 1e-3),
        "{found:?}"
    );
    assert!(database_files::beyond(&stored, &state).is_none());
    let far = database_files::State {
        tilts: [0.6, 0.3],
        ..state
    };
    assert!(
        database_files::beyond(&stored, &far)
            .unwrap()
            .contains("below 0.3")
    );
    let closed = database_files::State {
        tilts: [1.2, 0.0],
        ..state
    };
    let error = database_files::look_up(&stored, &closed).unwrap_err();
    assert!(error.contains("close the gap"), "{error}");
    let rows = "eccentricity[-],direction[deg],tilt_gamma[-],tilt_delta[-]\n0.4,-90,0.3,-0.2\n";
    assert!(database_files::look_up_table(&stored, rows).is_ok());
    let aligned = StoredFilms::load("", &films().join("films/table.h5")).unwrap();
    let error = database_files::look_up(&aligned, &state).unwrap_err();
    assert!(error.contains("aligned"), "{error}");
    // The film of a study tilts on it.
    let film = "model = \"superposition\"\ndatabase = \"table.h5\"\n";
    let duty = "[operation]\nspeed = \"2000 rpm\"\nrelative_eccentricity = 0.4\ntilt = [\"0.2 mrad\", \"0.1 mrad\"]\n";
    let text = format!("schema = 1\nanalysis = \"film\"\n{BEARING}{OIL}[film]\n{film}{duty}");
    let study = study_from_text("s.toml", &text, directory.path());
    let study = study.unwrap_or_else(|errors| panic!("{errors}"));
    let found = summary(&solve(&study, &mut |_| ControlFlow::Continue(())).unwrap());
    assert_eq!(found["status"], "converged", "{}", found["messages"]);
    assert_eq!(found["databases"][0]["journal"], "tilted");
}

/// What a study of a superposition says wrong is named.
#[test]
fn nonsense_of_a_superposition_is_named() {
    let base = "schema = 1\nanalysis = \"database\"\n[film]\ncavitation = \"reynolds\"\n[database]\nwidth_ratios = 0.4\n";
    for (keys, expected) in [
        ("journal = \"tilted\"\n", "holds aligned journals"),
        ("nodes = 25\n", "one of the scheme superposition"),
        (
            "scheme = \"superposition\"\nsmallest_gap = 0.1\n",
            "last_eccentricity",
        ),
        (
            "scheme = \"superposition\"\nnodes = [5, 5, 5]\n",
            "one whole number",
        ),
        (
            "scheme = \"superposition\"\njournal = \"tilted\"\nnodes = [5, 6, 5]\n",
            "odd",
        ),
        (
            "scheme = \"superposition\"\njournal = \"tilted\"\nnodes = [1, 5, 5]\n",
            "nodes",
        ),
        (
            "scheme = \"superposition\"\njournal = \"bent\"\n",
            "aligned",
        ),
    ] {
        let Err(errors) = study_from_text("films.toml", &format!("{base}{keys}"), films()) else {
            panic!("accepted: {keys}");
        };
        assert!(
            errors.to_string().contains(expected),
            "{expected}\n{errors}"
        );
    }
}

/// A truncated file, one that is no database, one with a changed byte.
#[test]
fn a_file_that_is_not_whole_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let whole = fs::read(films().join("films/table.h5")).unwrap();
    let mut changed = whole.clone();
    let middle = changed.len() / 2;
    changed[middle] ^= 0x40;
    for (bytes, expected) in [
        (whole[..whole.len() / 2].to_vec(), "not a whole HDF5 file"),
        (
            b"crank_angle[deg],load_x[N]\n".to_vec(),
            "not a whole HDF5 file",
        ),
        (Vec::new(), "not a whole HDF5 file"),
        (changed, "cannot be used"),
    ] {
        fs::write(directory.path().join("table.h5"), bytes).unwrap();
        let film = "model = \"database\"\ndatabase = \"table.h5\"\n";
        let text = study_text(BEARING, film, STEADY);
        let Err(errors) = study_from_text("study.toml", &text, directory.path()) else {
            panic!("accepted");
        };
        assert!(
            errors.to_string().contains(expected),
            "{expected}\n{errors}"
        );
        assert!(database_files::info(&directory.path().join("table.h5")).is_err());
    }
}

/// A build that is stopped goes on with what is solved, and ends with the table of one that was not.
#[test]
fn a_build_that_was_stopped_is_taken_up() {
    let directory = tempfile::tempdir().unwrap();
    let study = study_from_text("films.toml", BUILD, directory.path()).unwrap();
    let place = directory.path().join("films");
    let mut events = 0;
    let stopped = run_with(&study, &place, RunOptions::default(), &mut |_| {
        events += 1;
        if events > 2 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    let Body::Database(database) = &stopped.results.body else {
        panic!("another body");
    };
    if database.built.is_none() {
        assert!(database.file.is_file(), "{}", database.file.display());
        let found = summary(&stopped.results);
        assert_eq!(found["status"], "not-converged");
        assert!(
            found["messages"][0]
                .as_str()
                .unwrap()
                .starts_with("interrupted")
        );
        assert!(!place.join("table.h5").exists());
    }
    let whole = run_with(&study, &place, RunOptions::default(), &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(summary(&whole.results)["status"], "converged");
    let load = |path: &Path| StoredFilms::load("", path).unwrap().table;
    assert!(load(&place.join("table.h5")) == load(&films().join("films/table.h5")));
    assert!(!place.join("unfinished.h5").exists());
}

/// A table of states in, answers out: those of the states one by one.
#[test]
fn a_table_of_states_is_looked_up() {
    let stored = StoredFilms::load("", &films().join("films/table.h5")).unwrap();
    let states = "name,eccentricity[-],direction[deg]\nsteady,0.8,-90\nclosing,0.5,0\n";
    let answers = database_files::look_up_table(&stored, states).unwrap();
    let mut lines = answers.lines();
    let header = lines.next().unwrap();
    assert!(header.starts_with("name,eccentricity[-],direction[deg],force_along[-]"));
    let cells: Vec<&str> = lines.next().unwrap().split(',').collect();
    let alone = stored.look(0.4, 0.8, (-90.0_f64).to_radians()).unwrap();
    assert_eq!(cells[3].parse::<f64>().unwrap(), alone.force[0]);
    assert_eq!(lines.count(), 1);
    for (bad, expected) in [
        ("eccentricity[-]\n0.5\n", "direction[deg] is missing"),
        ("eccentricity[-],direction[deg]\n", "no rows"),
        ("eccentricity[-],direction[deg]\n1.5,0\n", "line 2"),
        (
            "eccentricity[-],direction[deg]\n0.5,0\nx,0\n",
            "line 3: x is no number",
        ),
        ("eccentricity[-],direction[deg]\n0.5,nan\n", "line 2"),
    ] {
        let error = database_files::look_up_table(&stored, bad).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

/// Steady rotation looked up in SI is the film of the study.
#[test]
fn a_state_in_si_is_that_of_a_study() {
    let stored = StoredFilms::load("", &films().join("films/table.h5")).unwrap();
    let scales = database_files::Scales {
        diameter: 0.072,
        width: 0.0288,
        radial_clearance: 36e-6,
        viscosity: 8e-3,
        effective_speed: 2000.0 * std::f64::consts::PI / 30.0,
        eccentricity_rate: 20.0,
    };
    let state = scales.state(0.7);
    let found = database_files::look_up(&stored, &state).unwrap();
    let rows = database_files::dimensional_rows(&found, &scales, 0.7);
    let value = |name: &str| rows.iter().find(|row| row.0 == name).unwrap().1;
    let duty = "[operation]\nspeed = \"2000 rpm\"\nrelative_eccentricity = 0.7\n\
        relative_eccentricity_rate = \"20 1/s\"\n";
    let text = format!("schema = 1\nanalysis = \"film\"\n{BEARING}{OIL}[film]\n{FILM}{duty}");
    let found = summary(&results(&text));
    let force = found["force_n"].as_array().unwrap();
    for (name, expected) in [
        ("force_along", force[0].as_f64().unwrap()),
        ("force_across", force[1].as_f64().unwrap()),
        ("peak_pressure", number(&found, "peak_film_pressure_pa")),
    ] {
        let got = value(name);
        assert!(
            (got / expected - 1.0).abs() < 1e-9,
            "{name}: {got} {expected}"
        );
    }
    let flow = 2.0 * value("side_flow_each_end");
    let expected = number(&found, "side_flow_m3_s");
    assert!((flow / expected - 1.0).abs() < 1e-9, "{flow} {expected}");
}

#[test]
fn fresh_states_keep_the_bound() {
    let found = database_files::check(&films().join("films/table.h5"), 200, 77).unwrap();
    assert!(found.is_kept(), "{found:?}");
    let FileCheck::Combined(found) = found else {
        panic!("another table");
    };
    assert!(found.report.samples == 200 && found.stated <= found.bound);
}

/// A table that errs by more than it says it was built for is found out.
#[test]
fn a_bound_that_is_not_kept_is_found_out() {
    let stored = StoredFilms::load("", &films().join("films/table.h5")).unwrap();
    let FilmTable::Combined(table) = &stored.table else {
        panic!("another table");
    };
    let boastful = Recipe {
        target: 1e-5,
        ..*table.recipe()
    };
    let table = Table::new(
        boastful,
        *table.axes(),
        table.nodes().to_vec(),
        *table.errors(),
    );
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.h5");
    table.unwrap().save(&path).unwrap();
    let found = database_files::check(&path, 200, 3).unwrap();
    assert!(!found.is_kept(), "{found:?}");
    assert!(matches!(found, FileCheck::Combined(found) if found.report.maximum > 1e-5));
}

/// The paper's scheme: built, shown, looked up, compared; its error is that of the sum, not of the table.
#[test]
fn a_superposition_is_built_and_compared() {
    let directory = tempfile::tempdir().unwrap();
    let text = BUILD
        .replace("target = 1e-2", "target = 1e-2\nscheme = \"superposition\"")
        .replace("samples = 100", "samples = 8");
    let ran = build(directory.path(), &text, 2);
    let found = summary(&ran.results);
    assert_eq!(found["status"], "converged", "{}", found["messages"]);
    assert_eq!(found["scheme"], "superposition");
    assert!(number(&found, "points") > 0.0);
    let file = directory.path().join("films/table.h5");
    assert!(database_files::info(&file).unwrap().contains("Phi_1V"));
    let FileCheck::Superposition(drives) = database_files::check(&file, 8, 5).unwrap() else {
        panic!("another table");
    };
    // A target that the films it may have do not meet is a status, not a number alone.
    let text = text
        .replace("target = 1e-2", "target = 1e-5")
        .replace("samples = 8", "samples = 8\nnodes = 5\nmost_films = 50");
    let missed = tempfile::tempdir().unwrap();
    let found = summary(&build(missed.path(), &text, 2).results);
    assert_eq!(found["status"], "not-converged", "{}", found["messages"]);
    assert_eq!(found["error_status"], "not-converged");
    assert!(
        found["messages"][0]
            .as_str()
            .unwrap()
            .contains("most_films")
    );
    let poor = missed.path().join("films/table.h5");
    assert!(
        database_files::info(&poor)
            .unwrap()
            .contains("not-converged")
    );
    let told = StoredFilms::load("", &poor).unwrap().facts().told();
    assert!(told.contains("NOT-CONVERGED"), "{told}");
    assert!(!database_files::check(&poor, 8, 5).unwrap().is_kept());
    for drive in &drives {
        assert!(
            drive.found.samples == 8 && drive.found.largest < 1e-2,
            "{drive:?}"
        );
    }
    fs::create_dir(directory.path().join("both")).unwrap();
    fs::copy(
        films().join("films/table.h5"),
        directory.path().join("both/table.h5"),
    )
    .unwrap();
    let film = "model = \"database\"\ndatabase = [\"films/table.h5\", \"both/table.h5\"]\n\
        compare = [\"superposition\"]\n";
    // Steady: wedge alone, so that nothing is added, and both agree.
    let study = study_from_text(
        "s.toml",
        &study_text(BEARING, film, STEADY),
        directory.path(),
    );
    let study = study.unwrap_or_else(|errors| panic!("{errors}"));
    let found = summary(&solve(&study, &mut |_| ControlFlow::Continue(())).unwrap());
    let compared = &found["comparison"]["superposition"];
    assert_eq!(compared["status"], "converged", "{}", found["messages"]);
    let off = compared["difference_percent"]["minimum_film_thickness_m"].as_f64();
    assert!(off.unwrap().abs() < 3.0, "{off:?}");
    assert!(
        compared["notes"]
            .to_string()
            .contains("but not of their sum")
    );
    // Squeeze and wedge together: the sum errs by more than either table.
    let duty = "[operation]\nspeed = \"2000 rpm\"\nrelative_eccentricity = 0.8\n\
        relative_eccentricity_rate = \"60 1/s\"\n";
    let text = format!("schema = 1\nanalysis = \"film\"\n{BEARING}{OIL}[film]\n{film}{duty}");
    let study = study_from_text("s.toml", &text, directory.path()).unwrap();
    let found = summary(&solve(&study, &mut |_| ControlFlow::Continue(())).unwrap());
    let off = found["comparison"]["superposition"]["difference_percent"]["peak_film_pressure_pa"]
        .as_f64();
    assert!(off.unwrap().abs() > 5.0, "{off:?}");
}
