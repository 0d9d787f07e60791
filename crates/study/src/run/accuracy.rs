//! Error bars of a run: the same study on other grids and with other time steps.

use super::{ProgressCallback, RunError, solve_once};
use crate::input::{Duty, Study, Subject};
use crate::models;
use crate::progress::ProgressEvent;
use crate::results::{Body, DimensionlessResults, Header, Results, SteadyResults};
use crate::verify::{
    Figures, GridRun, figures, relative_errors, space_errors, space_estimates, time_errors,
};
use sommerfeld_film::Outcome;
use sommerfeld_film::dimensionless::{
    DimensionlessFilm, DimensionlessIntegrals, MOST_CELLS, refine_dimensionless,
};
use sommerfeld_film::richardson::{
    Kind, SMALLEST_GRID, Sample, cell_size, estimate, grid_sequence,
};
use std::collections::BTreeMap;

/// Most cells of a load cycle with an error target: 256 x 64. Each of its steps costs a film.
const MOST_CELLS_OF_CYCLE: usize = 1 << 14;
/// Its time steps are halved at most this often.
const MOST_HALVINGS: i32 = 2;

/// How finely a run resolves film and time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Resolution {
    /// Cells around and along the axis.
    grid: [usize; 2],
    /// Time steps over those of the study: 2^`step_doublings`.
    step_doublings: i32,
}

/// The study at another resolution.
fn at(study: &Study, resolution: Resolution) -> Study {
    let mut study = study.clone();
    study.film.grid = resolution.grid;
    if let Subject::Bearing(case) = &mut study.subject
        && let Duty::Cycle(duty) = &mut case.duty
    {
        let factor = 2_f64.powi(resolution.step_doublings);
        let steps = (duty.cycle.period / (factor * duty.crank_step)).round();
        duty.crank_step = duty.cycle.period / steps.max(1.0);
        // The error of a step of order 2 goes with the cube of its length.
        duty.step_error_factor *= factor.powi(3);
    }
    study
}

/// Runs the study at a resolution; its progress fills the share `from` to `to` of the bar.
fn solve_at(
    study: &Study,
    resolution: Resolution,
    [from, to]: [f64; 2],
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let [around, along] = resolution.grid;
    solve_once(&at(study, resolution), None, &mut |event| {
        progress(ProgressEvent {
            label: format!("{around} x {along} cells, {}", event.label),
            done: from + (to - from) * event.done,
            ..event
        })
    })
}

/// Adds error bars to the results of `study`, from two coarser grids and, for load cycles, longer
/// time steps; together they cost less than the run itself. Where there can be none a message says why.
pub(super) fn add_error_bars(
    study: &Study,
    results: &mut Results,
    progress: &mut ProgressCallback<'_>,
) -> Result<(), RunError> {
    if results.header.status != Outcome::Converged {
        no_bars(results, "the run did not converge");
        return Ok(());
    }
    let [least_around, least_along] = SMALLEST_GRID;
    let [around, along] = study.film.grid;
    let on_grid = study.film.model.is_field();
    if on_grid && (around < least_around || along < least_along) {
        let reason = format!("film.grid must be at least [{least_around}, {least_along}] for them");
        no_bars(results, &reason);
        return Ok(());
    }
    let own = figures(results);
    let mut errors: Figures = own.keys().map(|key| (key.clone(), 0.0)).collect();
    let mut coarser = None;
    if on_grid {
        let mut grids = grid_sequence(study.film.grid);
        let (Some(coarse), Some(middle)) = (grids.next(), grids.next()) else {
            return Ok(());
        };
        let mut run = |grid, share| {
            let resolution = Resolution {
                grid,
                step_doublings: 0,
            };
            solve_at(study, resolution, share, progress)
        };
        let runs = [run(coarse, [0.6, 0.65])?, run(middle, [0.65, 0.85])?];
        if runs
            .iter()
            .any(|run| run.header.status != Outcome::Converged)
        {
            no_bars(results, "the same film on a coarser grid did not converge");
            return Ok(());
        }
        let found = runs.each_ref().map(figures);
        let of = |grid, figures| GridRun {
            size: cell_size(grid),
            figures,
        };
        let triple = [
            of(study.film.grid, &own),
            of(middle, &found[1]),
            of(coarse, &found[0]),
        ];
        errors = space_errors(&space_estimates(results, triple), |e| e.error_of_finest);
        let [_, of_middle] = found;
        coarser = Some((middle, of_middle));
    } else {
        results.header.messages.push(format!(
            "error bars: the model {} has no grid, its figures no error of one; how well the model \
             describes a bearing is another question",
            study.film.model.name()
        ));
    }
    if matches!(results.body, Body::LoadCycle(_)) {
        let (grid, run) = coarser.unwrap_or((study.film.grid, own));
        let long = Resolution {
            grid,
            step_doublings: 1,
        };
        let long = solve_at(study, long, [0.85, 1.0], progress)?;
        if long.header.status != Outcome::Converged {
            no_bars(results, "the orbit with longer time steps did not converge");
            return Ok(());
        }
        add(&mut errors, &time_errors(results, &run, &figures(&long)));
    }
    results.header.error = Some(errors);
    if on_grid {
        note_model(&mut results.header);
    }
    Ok(())
}

fn no_bars(results: &mut Results, reason: &str) {
    results
        .header
        .messages
        .push(format!("no error bars: {reason}"));
}

fn note_model(header: &mut Header) {
    header
        .models
        .extend(models::find("error_bar", "three-grids"));
}

/// Sum of the errors, of those figures that have both.
fn add(errors: &mut Figures, others: &Figures) {
    errors.retain(|key, error| match others.get(key) {
        Some(other) => {
            *error += other;
            true
        }
        None => false,
    });
}

/// Runs `study` on ever finer grids until all figures are within its error target.
pub(super) fn solve_to_target(
    study: &Study,
    target: f64,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let first = std::array::from_fn(|k| study.film.grid[k].max(SMALLEST_GRID[k]));
    match &study.subject {
        Subject::Sweep(_) | Subject::Machine(_) | Subject::Database(_) => {
            solve_once(study, None, progress)
        }
        Subject::Dimensionless(film) => dimensionless_to_target(study, film, first, target),
        Subject::Bearing(case) => match &case.duty {
            Duty::Cycle(_) => cycle_to_target(study, first, target, progress),
            Duty::State(_) | Duty::Load(_) => steady_to_target(study, first, target, progress),
        },
    }
}

fn dimensionless_to_target(
    study: &Study,
    film: &DimensionlessFilm,
    first: [usize; 2],
    target: f64,
) -> Result<Results, RunError> {
    let refined = refine_dimensionless(film, first, target)?;
    let mut header = super::header(study);
    super::note_outcome(refined.outcome, &mut header);
    let DimensionlessIntegrals {
        p_cos,
        p_sin,
        p_z_cos,
        p_z_sin,
        peak,
    } = refined.integrals;
    let mut relative = refined.relative_errors().to_vec();
    relative.sort_by(|a, b| b.1.total_cmp(&a.1));
    header.grid = Some(refined.grid);
    if refined.outcome == Outcome::Converged {
        let error = &refined.error;
        header.error = Some(BTreeMap::from(
            [
                ("p_cos", error.p_cos),
                ("p_sin", error.p_sin),
                ("p_z_cos", error.p_z_cos),
                ("p_z_sin", error.p_z_sin),
                ("peak", error.peak),
            ]
            .map(|(name, error)| (format!("integrals.{name}"), error)),
        ));
        note_model(&mut header);
        note_target(&mut header, refined.grid, relative[0], target);
    }
    Ok(Results {
        header,
        body: Body::Dimensionless(DimensionlessResults {
            p_cos,
            p_sin,
            p_z_cos,
            p_z_sin,
            peak,
        }),
    })
}

/// Says on which grid, and which figure misses the target.
fn note_target(header: &mut Header, grid: [usize; 2], worst: (&str, f64), target: f64) {
    let [around, along] = grid;
    let (key, error) = worst;
    // An error that is no number meets no target either.
    let is_reached = error <= target;
    header.messages.push(if is_reached {
        format!(
            "error target {target} reached on {around} x {along} cells: the largest estimate is \
             {error:.1e}, of {key}"
        )
    } else {
        format!(
            "error target {target} not reached on {around} x {along} cells, the finest that are \
             tried: the estimate of {key} is {error:.1e}; the errors stated are those reached"
        )
    });
}

fn steady_to_target(
    study: &Study,
    first: [usize; 2],
    target: f64,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let mut runs: Vec<([usize; 2], Results)> = Vec::new();
    let grids = grid_sequence(first).collect::<Vec<_>>();
    let mut best = None;
    for (k, &grid) in grids.iter().enumerate() {
        if runs.len() >= 3 && grid[0] * grid[1] > MOST_CELLS {
            break;
        }
        let share = [k as f64, k as f64 + 1.0].map(|k| k / grids.len() as f64);
        let label = format!("{} x {} cells", grid[0], grid[1]);
        if progress(ProgressEvent::new(label, share[0])).is_break() && k > 0 {
            break;
        }
        let resolution = Resolution {
            grid,
            step_doublings: 0,
        };
        let run = solve_at(study, resolution, share, progress)?;
        if run.header.status != Outcome::Converged {
            // A coarse grid may fail where finer ones do not; without a film none does better.
            let is_last = runs.len() >= 3 || run.header.status != Outcome::NotConverged;
            best = Some(run);
            if is_last {
                break;
            }
            continue;
        }
        runs.insert(0, (grid, run));
        if let [fine, middle, coarse, ..] = &runs[..] {
            let (found, worst) = extrapolated([fine, middle, coarse]);
            let is_reached = worst.1 <= target;
            let mut found = found;
            note_target(&mut found.header, grid, (&worst.0, worst.1), target);
            best = Some(found);
            if is_reached {
                break;
            }
        }
    }
    match best {
        Some(best) => Ok(best),
        None => solve_once(study, None, progress),
    }
}

/// Limits of three steady runs, the finest first, with their errors, and the figure with the largest
/// error over its scale. Fields are those of the finest grid.
fn extrapolated(runs: [&([usize; 2], Results); 3]) -> (Results, (String, f64)) {
    let own = runs.map(|(_, results)| figures(results));
    let sizes = runs.map(|(grid, _)| cell_size(*grid));
    let mut best = runs[0].1.clone();
    let triple = std::array::from_fn(|k| GridRun {
        size: sizes[k],
        figures: &own[k],
    });
    let errors: Figures = space_errors(&space_estimates(&best, triple), |e| e.error);
    let worst = relative_errors(&best, &own[0], &errors).into_iter().next();
    let mut bodies = runs.map(|(_, results)| results.body.clone());
    if let [
        Body::Steady(fine),
        Body::Steady(middle),
        Body::Steady(coarse),
    ] = &mut bodies
    {
        let pairs = scalars(middle).into_iter().zip(scalars(coarse));
        for (value, (middle, coarse)) in scalars(fine).into_iter().zip(pairs) {
            let values = [*value, *middle, *coarse];
            let samples = std::array::from_fn(|k| Sample {
                size: sizes[k],
                value: values[k],
            });
            // The limit is the same for either kind.
            *value = estimate(Kind::Integral, samples).extrapolated;
        }
    }
    let [fine, ..] = bodies;
    best.body = fine;
    best.header.error = Some(errors);
    note_model(&mut best.header);
    let grids = runs.map(|(grid, _)| format!("{} x {}", grid[0], grid[1]));
    best.header.messages.push(format!(
        "figures are extrapolated from {}, {} and {} cells; the fields are those of the first",
        grids[0], grids[1], grids[2]
    ));
    (best, worst.unwrap_or_default())
}

/// Every number of a steady state that a grid has a part in.
fn scalars(steady: &mut SteadyResults) -> Vec<&mut f64> {
    let SteadyResults {
        state,
        reaction,
        summary,
        ..
    } = steady;
    let mut list: Vec<&mut f64> = Vec::new();
    list.extend(&mut state.position);
    list.extend(&mut state.tilt);
    list.extend(&mut reaction.film_force);
    list.extend(&mut reaction.film_moment);
    list.extend(&mut summary.side_flow);
    list.extend([
        &mut reaction.friction_torque_journal,
        &mut reaction.friction_torque_shell,
        &mut summary.minimum_film_thickness.value,
        &mut summary.peak_film_pressure.value,
        &mut summary.feed_flow,
        &mut summary.friction_power,
        &mut summary.squeeze_power,
        &mut summary.full_film_share,
        &mut steady.sommerfeld_number,
    ]);
    for feed in &mut steady.feed_flows {
        list.push(&mut feed.flow);
    }
    for matrix in [&mut steady.stiffness, &mut steady.damping] {
        list.extend(matrix.iter_mut().flatten().flatten());
    }
    list
}

/// A run of a load cycle that others may share.
struct CycleRuns<'a> {
    study: &'a Study,
    done: Vec<(Resolution, Results, Figures)>,
}

impl CycleRuns<'_> {
    /// The run at a resolution, made if it is not there: its place.
    fn index(
        &mut self,
        resolution: Resolution,
        progress: &mut ProgressCallback<'_>,
    ) -> Result<usize, RunError> {
        if let Some(k) = self.done.iter().position(|run| run.0 == resolution) {
            return Ok(k);
        }
        let results = solve_at(self.study, resolution, [0.0, 1.0], progress)?;
        let figures = figures(&results);
        self.done.push((resolution, results, figures));
        Ok(self.done.len() - 1)
    }
}

/// Refines grid or time step, whichever has the larger part in what misses the target. The results
/// are those of the finest run: points of an orbit are not extrapolated.
fn cycle_to_target(
    study: &Study,
    first: [usize; 2],
    target: f64,
    progress: &mut ProgressCallback<'_>,
) -> Result<Results, RunError> {
    let grids: Vec<_> = grid_sequence(first).collect();
    let mut runs = CycleRuns {
        study,
        done: Vec::new(),
    };
    let (mut finest, mut halvings) = (2, 0);
    let mut stopped = false;
    let mut watched = |event: ProgressEvent| {
        let answer = progress(event);
        stopped |= answer.is_break();
        answer
    };
    loop {
        // With halved steps the grids of the first steps still tell the error of the grid.
        let with = |grid, halvings: i32| Resolution {
            grid,
            step_doublings: -halvings,
        };
        let places = [
            runs.index(with(grids[finest], halvings), &mut watched)?,
            runs.index(with(grids[finest], 0), &mut watched)?,
            runs.index(with(grids[finest - 1], 0), &mut watched)?,
            runs.index(with(grids[finest - 2], 0), &mut watched)?,
            runs.index(with(grids[finest - 1], halvings), &mut watched)?,
            runs.index(with(grids[finest - 1], halvings - 1), &mut watched)?,
        ];
        let [best, fine, middle, coarse, short, long] = places.map(|k| &runs.done[k]);
        let mut results = best.1.clone();
        let all = [best, fine, middle, coarse, short, long];
        if all
            .iter()
            .any(|run| run.1.header.status != Outcome::Converged)
        {
            if results.header.status == Outcome::Converged {
                let reason = "a run at another resolution did not converge";
                no_bars(&mut results, reason);
            }
            return Ok(results);
        }
        let of = |run: &'_ (Resolution, Results, Figures)| cell_size(run.0.grid);
        let triple = [fine, middle, coarse].map(|run| GridRun {
            size: of(run),
            figures: &run.2,
        });
        let space: Figures =
            space_errors(&space_estimates(&results, triple), |e| e.error_of_finest);
        let time = time_errors(&results, &short.2, &long.2);
        let mut errors = space.clone();
        add(&mut errors, &time);
        let relative = relative_errors(&results, &best.2, &errors);
        let worst = relative.first().cloned().unwrap_or_default();
        let grid_leads = space.get(&worst.0) >= time.get(&worst.0);
        let next = grids.get(finest + 1);
        let finer = next.is_some_and(|[n, m]| n * m <= MOST_CELLS_OF_CYCLE);
        let can_go_on = if grid_leads {
            finer
        } else {
            halvings < MOST_HALVINGS
        };
        if worst.1 <= target || !can_go_on {
            results.header.error = Some(errors);
            note_model(&mut results.header);
            note_target(
                &mut results.header,
                grids[finest],
                (&worst.0, worst.1),
                target,
            );
            if halvings > 0 {
                let message = format!("time steps are 1/{} of those of the study", 1 << halvings);
                results.header.messages.push(message);
            }
            return Ok(results);
        }
        if grid_leads {
            finest += 1;
        } else {
            halvings += 1;
        }
    }
}
