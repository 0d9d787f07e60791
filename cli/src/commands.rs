//! The commands.

use crate::exit::Exit;
use sommerfeld_study::film_tables::closure_name;
use sommerfeld_study::input::{
    self, BearingCase, DatabasePlan, Duty, Machine, MachinePlan, MessageKind, Study, Subject,
    SweepPlan, render_all,
};
use sommerfeld_study::load_study;
use sommerfeld_study::templates::{self, TEMPLATES};
use std::fs::{self, OpenOptions};
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Prints text on standard output. A reader that has closed it, as `head` does, is no failure.
pub fn print(text: &str) -> Exit {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Ok(()) => Exit::Done,
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::Done,
        Err(_) => Exit::MachineFailed,
    }
}

/// Colours on a terminal only, and not against the user's will (no-color.org).
fn colours() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Reads a study; errors and warnings go to standard error.
pub fn read(file: &Path) -> Result<Study, Exit> {
    match load_study(file) {
        Ok(study) => {
            let warnings = render_all(&study.warnings, MessageKind::Warning, colours());
            eprint!("{warnings}");
            Ok(study)
        }
        Err(errors) => {
            eprint!("{}", errors.render(colours()));
            Err(Exit::Refused)
        }
    }
}

/// `sommerfeld check FILE`
pub fn check(file: &Path) -> Exit {
    match read(file) {
        Ok(study) => print(&format!(
            "{}: a valid study\n  analysis  {}\n  model     {}\n{}",
            study.file,
            study.analysis.name(),
            study.film.model.name(),
            subject(&study.subject)
        )),
        Err(exit) => exit,
    }
}

/// What a study is about, one line each.
fn subject(subject: &Subject) -> String {
    match subject {
        Subject::Dimensionless(case) => format!(
            "  film      dimensionless, D/B {}, relative eccentricity {}\n",
            case.d_over_b, case.relative_eccentricity
        ),
        Subject::Bearing(case) => bearing(case),
        Subject::Machine(plan) => machine(plan),
        Subject::Database(plan) => database(plan),
        Subject::Sweep(plan) => sweep(plan),
    }
}

/// What is to be built.
fn database(plan: &DatabasePlan) -> String {
    let [narrow, wide] = plan.width_ratios();
    format!(
        "  database  {}, closure {}, width/diameter {narrow:.6} to {wide:.6}, target {:e}\n",
        plan.scheme().name(),
        closure_name(plan.closure()),
        plan.target()
    )
}

/// What it is, its bearings by kind, its speeds.
fn machine(plan: &MachinePlan) -> String {
    let mut text = match &plan.machine {
        Machine::Engine(engine) => {
            let train = &engine.train;
            format!(
                "  engine    {} cylinders, {} throws, bore {:.3} mm, stroke {:.3} mm\n",
                train.layout.cylinders.len(),
                train.layout.throws.len(),
                1e3 * train.bore,
                2e3 * train.crank_radius
            )
        }
        Machine::Shaft(shaft) => format!(
            "  shaft     {} sections, {} loads, {} unbalances\n",
            shaft.sections.len(),
            shaft.loads.len(),
            shaft.unbalances.len()
        ),
    };
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for bearing in &plan.bearings {
        let kind = bearing.role.name();
        match counts.last_mut() {
            Some((known, count)) if *known == kind => *count += 1,
            _ => counts.push((kind, 1)),
        }
    }
    let kinds: Vec<String> = counts
        .iter()
        .map(|(kind, count)| format!("{count} {kind}"))
        .collect();
    let speeds: Vec<String> = plan
        .speeds
        .iter()
        .map(|speed| format!("{:.1}", speed * 30.0 / std::f64::consts::PI))
        .collect();
    let (kinds, speeds) = (kinds.join(", "), speeds.join(", "));
    text += &format!("  bearings  {kinds}\n  speeds    {speeds} rpm\n");
    text
}

/// What varies, with how many cases: every one of them was checked.
fn sweep(plan: &SweepPlan) -> String {
    let mut text = format!(
        "  base      {}\n  cases     {}, every one checked\n",
        plan.base_file,
        plan.count()
    );
    for key in &plan.varied {
        let (count, path) = (key.values.len(), &key.path);
        let ends = match (key.values.first(), key.values.last()) {
            (Some(first), Some(last)) if count > 1 => {
                format!("{} to {}", first.shown, last.shown)
            }
            (Some(only), _) => only.shown.clone(),
            _ => String::new(),
        };
        text += &format!("  varied    {path}, {count} values, {ends}\n");
    }
    text
}

fn bearing(case: &BearingCase) -> String {
    let bearing = &case.bearing;
    let viscosity = case.lubricant.viscosity(case.temperature, 0.0).value;
    let mut text = format!(
        "  bearing   diameter {:.3} mm, width {:.3} mm, diametral clearance {:.2} um, feeds {}\n  \
         oil       {:.3} mPa.s at {:.1} degC\n",
        1e3 * bearing.diameter,
        1e3 * bearing.width,
        2e6 * bearing.radial_clearance,
        bearing.feeds.len(),
        1e3 * viscosity,
        case.temperature - 273.15
    );
    if let Duty::Cycle(duty) = &case.duty {
        let points = &duty.cycle.points;
        let largest = points
            .iter()
            .map(|p| p.load[0].hypot(p.load[1]))
            .fold(0.0, f64::max);
        text += &format!(
            "  loads     {} rows, largest load {:.3} kN\n",
            points.len(),
            1e-3 * largest
        );
    }
    text
}

/// `sommerfeld new TEMPLATE DIR`
pub fn new(name: &str, directory: &Path) -> Exit {
    let Some(template) = templates::find(name) else {
        eprintln!("error: there is no template `{name}`\n  = templates:");
        for template in TEMPLATES {
            eprintln!("    {:<16}{}", template.name, template.meaning);
        }
        if let Some(meant) = templates::nearest(name) {
            eprintln!("  = hint: did you mean `{meant}`?");
        }
        return Exit::Refused;
    };
    if let Err(error) = fs::create_dir_all(directory) {
        eprintln!("error: {} cannot be made: {error}", directory.display());
        return Exit::MachineFailed;
    }
    let study = format!("{}.toml", template.name);
    let files =
        std::iter::once((study.as_str(), template.study)).chain(template.files.iter().copied());
    // All or nothing: look before the first file is written.
    if let Some((taken, _)) = files
        .clone()
        .find(|(name, _)| directory.join(name).exists())
    {
        eprintln!(
            "error: {} is already there; nothing was written",
            directory.join(taken).display()
        );
        return Exit::Refused;
    }
    for (name, content) in files {
        if let Err(error) = write_new(&directory.join(name), content) {
            eprintln!(
                "error: {} cannot be written: {error}",
                directory.join(name).display()
            );
            return Exit::MachineFailed;
        }
    }
    print(&format!("{}\n", directory.join(study).display()))
}

/// Writes a file that is not there yet.
fn write_new(path: &Path, content: &str) -> io::Result<()> {
    OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(path)?
        .write_all(content.as_bytes())
}

/// `sommerfeld explain [KEY]`
pub fn explain(key: Option<&str>) -> Exit {
    let Some(key) = key else {
        return print(&input::list_keys());
    };
    match input::explain(key) {
        Ok(text) => print(&text),
        Err(nearest) => {
            eprintln!("error: unknown key `{key}`");
            if let Some(nearest) = nearest {
                eprintln!("  = hint: did you mean `{nearest}`?");
            } else {
                eprintln!("  = hint: `sommerfeld explain` lists all keys");
            }
            Exit::Refused
        }
    }
}

/// `sommerfeld schema`
pub fn schema() -> Exit {
    match serde_json::to_string_pretty(&input::json_schema()) {
        Ok(text) => print(&format!("{text}\n")),
        Err(error) => {
            eprintln!("error: the schema cannot be written: {error}");
            Exit::MachineFailed
        }
    }
}
