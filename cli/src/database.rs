//! `sommerfeld database build | info | lookup | check`: films stored to be looked up.

use crate::commands;
use crate::exit::Exit;
use crate::progress::{Progress, stop_flag};
use crate::run::RunArguments;
use clap::{Args, Subcommand};
use sommerfeld_study::database_files::{
    self, CombinedCheck, FileCheck, Scales, State, SuperposedCheck, answer_rows, beyond,
    dimensional_rows, look_up, look_up_table,
};
use sommerfeld_study::film_tables::StoredFilms;
use sommerfeld_study::input::units::{Dimension, parse};
use std::fs;
use std::path::{Path, PathBuf};

/// What to do with a database.
#[derive(Debug, Subcommand)]
pub enum DatabaseCommand {
    /// Build the database that a study of the analysis "database" describes: the same as `run`
    Build(RunArguments),
    /// Print everything that is stored in a database
    Info {
        /// The database, such as films/table.h5
        file: PathBuf,
    },
    /// Print what a database says of a state, or of every row of a table
    Lookup(Box<LookupArguments>),
    /// Hold a database against films solved for states drawn anew; exit 1 where one errs by more than the
    /// target that the database was built for. So many for each drive of a superposition
    Check {
        /// The database
        file: PathBuf,
        /// States to draw
        #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
        samples: u32,
        /// Where the random states begin; left out, other states are drawn every time
        #[arg(long, value_name = "S")]
        seed: Option<u64>,
    },
}

/// Arguments of `lookup`.
#[derive(Debug, Args)]
#[command(
    after_help = "Without dimensions, forces are over eta |w| R^3 B / (2 c^3) and pressures over \
                        eta |w| R^2 / c^3, w the velocity of the journal centre relative to the oil that \
                        the surfaces drag along: at direction 0 the gap closes, at -90 the journal runs \
                        as in steady rotation, at 180 the gap opens. Moments are over the same force with an \
                        arm of half the width. The relative tilts of a database of tilted journals are those of the \
                        dimensionless film: gamma in the plane of the narrowest gap, from -1 to 1, delta across it. With a \
                        bearing (--diameter, --width, \
                        --clearance, --viscosity, --speed) the direction follows from speed and \
                        eccentricity rate, and the answer is in SI too."
)]
pub struct LookupArguments {
    /// The database
    file: PathBuf,
    /// Relative eccentricity, 0 to below 1
    #[arg(
        long,
        value_name = "E",
        required_unless_present = "states",
        allow_negative_numbers = true
    )]
    eccentricity: Option<f64>,
    /// Angle of the motion from the line of centres, degrees
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, conflicts_with = "diameter", required_unless_present_any = ["states", "diameter"])]
    direction: Option<f64>,
    /// Tilt in the plane of the narrowest gap over its largest value, of a database of tilted journals
    #[arg(
        long,
        value_name = "G",
        allow_negative_numbers = true,
        default_value_t = 0.0
    )]
    tilt_gamma: f64,
    /// Tilt across that plane as it stands in the gap: over the radial clearance, at the edge
    #[arg(
        long,
        value_name = "D",
        allow_negative_numbers = true,
        default_value_t = 0.0
    )]
    tilt_delta: f64,
    /// Width over diameter, where the database holds several
    #[arg(long, value_name = "B/D", conflicts_with = "diameter")]
    width_ratio: Option<f64>,
    /// Bore diameter with its unit, such as "72 mm"
    #[arg(long, requires_all = ["width", "clearance", "viscosity", "speed"])]
    diameter: Option<String>,
    /// Bearing width with its unit
    #[arg(long, requires = "diameter")]
    width: Option<String>,
    /// Diametral clearance with its unit
    #[arg(long, requires = "diameter")]
    clearance: Option<String>,
    /// Dynamic viscosity with its unit, such as "8 mPa.s"
    #[arg(long, requires = "diameter")]
    viscosity: Option<String>,
    /// Speed of journal plus shell, less twice the turning rate of the line of centres, with its unit
    #[arg(long, requires = "diameter", allow_hyphen_values = true)]
    speed: Option<String>,
    /// Rate of the relative eccentricity, such as "20 1/s"
    #[arg(long, requires = "diameter", allow_hyphen_values = true)]
    eccentricity_rate: Option<String>,
    /// CSV of states, eccentricity[-],direction[deg](,width_ratio[-],tilt_gamma[-],tilt_delta[-]): answers
    /// for each row
    #[arg(long, value_name = "CSV", conflicts_with_all = ["eccentricity", "direction", "diameter", "width_ratio", "tilt_gamma", "tilt_delta"])]
    states: Option<PathBuf>,
    /// Where the table of answers is written [default: standard output]
    #[arg(long, value_name = "CSV", requires = "states")]
    out: Option<PathBuf>,
}

/// Runs one of the commands.
pub fn database(command: &DatabaseCommand) -> Exit {
    match command {
        DatabaseCommand::Build(arguments) => crate::run::build_database(arguments),
        DatabaseCommand::Info { file } => match database_files::info(file) {
            Ok(text) => commands::print(&text),
            Err(error) => refused(&error.to_string()),
        },
        DatabaseCommand::Lookup(arguments) => match lookup(arguments) {
            Ok(exit) => exit,
            Err(error) => refused(&error),
        },
        DatabaseCommand::Check {
            file,
            samples,
            seed,
        } => check(file, *samples, *seed),
    }
}

fn refused(error: &str) -> Exit {
    eprintln!("error: {error}");
    Exit::Refused
}

fn lookup(arguments: &LookupArguments) -> Result<Exit, String> {
    let file = &arguments.file;
    let name = file.to_string_lossy();
    let stored = StoredFilms::load(&name, file).map_err(|error| error.to_string())?;
    if let Some(states) = &arguments.states {
        return table(&stored, states, arguments.out.as_deref());
    }
    let eccentricity = arguments.eccentricity.unwrap_or(f64::NAN);
    let scales = scales(arguments)?;
    let tilts = [arguments.tilt_gamma, arguments.tilt_delta];
    if !tilts.iter().all(|tilt| tilt.is_finite()) {
        return Err("a tilt is no number".to_owned());
    }
    let state = match &scales {
        Some(scales) => State {
            tilts,
            ..scales.state(eccentricity)
        },
        None => State {
            width_ratio: width_ratio(arguments, &stored)?,
            eccentricity,
            angle: arguments.direction.unwrap_or(f64::NAN).to_radians(),
            tilts,
        },
    };
    if !state.angle.is_finite() {
        return Err("the direction is no number".to_owned());
    }
    let found = look_up(&stored, &state)?;
    let mut text = format!("{}\n", stored.facts().told());
    text += &format!(
        "  {:<30} {}\n  {:<30} {} deg\n",
        "eccentricity",
        state.eccentricity,
        "direction",
        state.angle.to_degrees()
    );
    if stored.is_tilted() {
        text += &format!(
            "  {:<30} {}\n  {:<30} {}\n",
            "tilt_gamma", state.tilts[0], "tilt_delta", state.tilts[1]
        );
    }
    text += &rows(&answer_rows(&found));
    if let Some(scales) = scales {
        text += "in SI\n";
        text += &rows(&dimensional_rows(&found, &scales, eccentricity));
    }
    if let Some(warning) = beyond(&stored, &state) {
        eprintln!("warning: {warning}");
    }
    Ok(commands::print(&text))
}

fn rows(rows: &[(&str, f64, &str)]) -> String {
    let line = |(name, value, unit): &(&str, f64, &str)| {
        let value = if value.abs() < 1e-3 && *value != 0.0 || value.abs() >= 1e7 {
            format!("{value:.9e}")
        } else {
            format!("{value:.9}")
        };
        let unit = if *unit == "-" { "" } else { unit };
        format!("{}\n", format!("  {name:<30} {value} {unit}").trim_end())
    };
    rows.iter().map(line).collect()
}

fn width_ratio(arguments: &LookupArguments, stored: &StoredFilms) -> Result<f64, String> {
    let [narrow, wide] = stored.facts().width_ratios;
    match arguments.width_ratio {
        Some(ratio) => Ok(ratio),
        None if narrow == wide => Ok(narrow),
        None => Err(format!(
            "the database holds width over diameter from {narrow} to {wide}: give --width-ratio"
        )),
    }
}

/// The bearing of the arguments, if they name one.
fn scales(arguments: &LookupArguments) -> Result<Option<Scales>, String> {
    let quantity = |name: &str, text: &Option<String>, dimension| -> Result<f64, String> {
        let text = text.as_deref().unwrap_or_default();
        parse(text, dimension).map_err(|error| format!("--{name} \"{text}\": {error}"))
    };
    if arguments.diameter.is_none() {
        return Ok(None);
    }
    let length = Dimension::Length;
    let scales = Scales {
        diameter: quantity("diameter", &arguments.diameter, length)?,
        width: quantity("width", &arguments.width, length)?,
        radial_clearance: 0.5 * quantity("clearance", &arguments.clearance, length)?,
        viscosity: quantity(
            "viscosity",
            &arguments.viscosity,
            Dimension::DynamicViscosity,
        )?,
        effective_speed: quantity("speed", &arguments.speed, Dimension::AngularSpeed)?,
        eccentricity_rate: match &arguments.eccentricity_rate {
            Some(_) => quantity(
                "eccentricity-rate",
                &arguments.eccentricity_rate,
                Dimension::Rate,
            )?,
            None => 0.0,
        },
    };
    let sizes = [
        ("diameter", scales.diameter),
        ("width", scales.width),
        ("clearance", scales.radial_clearance),
        ("viscosity", scales.viscosity),
    ];
    match sizes
        .iter()
        .find(|(_, size)| !(*size > 0.0 && size.is_finite()))
    {
        Some((name, _)) => Err(format!("--{name} must be more than 0")),
        None => Ok(Some(scales)),
    }
}

fn table(stored: &StoredFilms, states: &Path, out: Option<&Path>) -> Result<Exit, String> {
    let shown = states.display();
    let text = fs::read_to_string(states).map_err(|error| format!("{shown}: {error}"))?;
    let answers = look_up_table(stored, &text).map_err(|error| format!("{shown}: {error}"))?;
    let Some(out) = out else {
        return Ok(commands::print(&answers));
    };
    if out == states {
        return Err(format!("{shown} would be written over: name another --out"));
    }
    Ok(match fs::write(out, answers) {
        Ok(()) => commands::print(&format!("{}\n", out.display())),
        Err(error) => {
            eprintln!("error: {}: {error}", out.display());
            Exit::MachineFailed
        }
    })
}

fn check(file: &Path, samples: u32, seed: Option<u64>) -> Exit {
    let seed = seed.unwrap_or_else(|| {
        let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
        since.map_or(0, |since| since.as_nanos() as u64)
    });
    let mut shown = Progress::new(stop_flag());
    let mut is_begun = false;
    let found = database_files::check_with(file, samples as usize, seed, &mut |event| {
        is_begun = true;
        shown.show(&event)
    });
    if is_begun {
        shown.finish();
    }
    let found = match found {
        Ok(Some(found)) => found,
        Ok(None) => return Exit::Interrupted,
        Err(error) => return refused(&error.to_string()),
    };
    let verdict = if found.is_kept() { "kept" } else { "exceeded" };
    let told = match &found {
        FileCheck::Combined(found) => combined_check(found, seed, verdict),
        FileCheck::Superposition(drives) => superposed_check(drives, seed, verdict),
    };
    let text = format!("{}: {told}", file.display());
    match (commands::print(&text), found.is_kept()) {
        (Exit::Done, false) => Exit::NotConverged,
        (exit, _) => exit,
    }
}

fn combined_check(found: &CombinedCheck, seed: u64, verdict: &str) -> String {
    let report = &found.report;
    let worst = &report.worst;
    format!(
        "bound {:.1e} {verdict}\n  states                       {} of seed {seed}\n  largest error of the force   \
         {:.3e} at B/D {:.4}, eccentricity {:.6}, direction {:.2} deg\n  99.9 % stay below            {:.3e}\n  \
         half stay below              {:.3e}\n  stated in the file           {:.3e}\n  largest of peak pressure     \
         {:.3e}\n  derivatives, 99 % within     {:.3e} of the solved film\n  derivatives, largest         {:.3e} from \
         central differences of the database\n  smallest power taken up      {:.3e} of force times velocity\n",
        found.bound,
        report.samples,
        report.maximum,
        worst.width_ratio,
        worst.eccentricity,
        worst.angle.to_degrees(),
        report.quantile_999,
        report.median,
        found.stated,
        report.peak_maximum,
        report.tangent_quantile_99,
        report.difference_maximum,
        report.dissipation_minimum,
    )
}

fn superposed_check(drives: &[SuperposedCheck], seed: u64, verdict: &str) -> String {
    let rows = drives.iter().map(|drive| {
        let (found, stated) = (&drive.found, &drive.stated);
        format!(
            "  {} alone, {} states: largest {:.3e} at eccentricity {:.4}, tilts along {:.4} and across {:.4}; \
             99.9 % below {:.3e}, half below {:.3e}; stated in the file {:.3e} of {}\n",
            drive.drive.letter(),
            found.samples,
            found.largest,
            found.worst[0],
            found.worst[1],
            found.worst[2],
            found.of_999,
            found.median,
            stated.largest,
            stated.samples,
        )
    });
    let bound = drives.first().map_or(0.0, |drive| drive.bound);
    let largest = drives.iter().map(|drive| drive.stated.largest);
    let status = match largest.fold(0.0, f64::max) <= bound {
        true => "converged",
        false => "not-converged: its own samples err by more than it was built for",
    };
    format!(
        "bound {bound:.1e} {verdict}, seed {seed}\n  status of the file           {status}\n{}  D wedge, V \
         closing gap, W opening gap: each of force and moment against its own film, not against their sum\n",
        rows.collect::<String>()
    )
}
