#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test may stop at the first surprise"
)]

use super::*;
use sommerfeld_film::{
    Cavitation, ContactLaw, Elasticity, Ends, FilmShear, Inlet, RoughFinish, Roughness, Shape,
};

const RATE: f64 = 1e-12;
const SOFTNESS: f64 = 2e-7;
const SHELL: f64 = 4e-7;

fn bearing() -> Bearing {
    Bearing {
        diameter: 0.05,
        width: 0.02,
        radial_clearance: 2e-5,
        bore: Shape::cylindrical(),
        journal: Shape::cylindrical(),
        feeds: Vec::new(),
        ambient_pressure: 0.0,
        cavitation_pressure: 0.0,
        ends: Ends::Air,
        inlet: Inlet::Cyclic,
        cavitation: Cavitation::Gumbel,
        film_shear: FilmShear::FullWidth,
        finish: Finish::Rough(RoughFinish {
            roughness: Roughness {
                journal: 3e-7,
                shell: SHELL,
                peklenik_journal: 1.0,
                peklenik_shell: 1.0,
            },
            contact: ContactLaw::None,
            boundary_friction: 0.0,
        }),
        elasticity: Elasticity::Rigid,
    }
}

/// A cycle whose contact pressure falls by a factor e for each `SOFTNESS` worn off the bore, and at
/// three angles of even cells by another factor.
fn fading(ran: &RanIn) -> Result<WornCycle, FilmError> {
    let bearing = &ran.bearing;
    let angles = vec![0.5, 2.0, 4.0];
    let wear = |angle: &f64| RATE * (-bearing.bore.offset(*angle, 0.0) / SOFTNESS).exp();
    let shares = [1.0, 0.5, 0.0];
    let wear_load: Vec<f64> = angles
        .iter()
        .map(wear)
        .zip(shares)
        .map(|(w, s)| w * s)
        .collect();
    Ok(WornCycle {
        contact_share: wear_load[0] / RATE,
        minimum_film_thickness: 1e-6,
        on_shell: WearMap {
            angles,
            axial: vec![0.0],
            angle_widths: vec![2.0; 3],
            axial_widths: vec![0.02],
            radius: 0.025,
            duration: 1.0,
            peak_pressure_velocity: vec![0.0; 3],
            mean_pressure_velocity: vec![0.0; 3],
            wear_load,
        },
        outcome: Outcome::Converged,
    })
}

fn settings(largest_depth: f64) -> RunningIn {
    RunningIn {
        coefficient: 1.0,
        duration: 3.6e6,
        largest_depth,
        settled_below: 0.0,
        step_limit: 100_000,
        roughness: WornRoughness::Truncated,
    }
}

/// `dw/dt = r exp(-w/s)` from nothing: `w = s ln(1 + r t / s)`, reached by the second order.
#[test]
fn wear_that_fades_with_depth_follows_its_closed_form() {
    let exact = |rate: f64| SOFTNESS * (1.0 + rate * 3.6e6 / SOFTNESS).ln();
    let error = |largest: f64| {
        let ran = run_in(&bearing(), &settings(largest), fading).unwrap();
        assert_eq!(ran.end, RunningInEnd::TimeOver);
        let total: f64 = ran.steps.iter().map(|step| step.duration).sum();
        assert!((total / 3.6e6 - 1.0).abs() < 1e-12 && ran.time == 3.6e6);
        assert_eq!(ran.steps.last().unwrap().duration, 0.0);
        assert!((ran.bearing.bore.offset(2.0, 0.003) - ran.depth[1]).abs() < 1e-20);
        assert!((ran.depth[1] / exact(0.5 * RATE) - 1.0).abs() < 0.01);
        assert_eq!(ran.depth[2], 0.0);
        ran.depth[0] / exact(RATE) - 1.0
    };
    let (coarse, fine) = (error(0.2 * SOFTNESS), error(0.1 * SOFTNESS));
    let order = (coarse / fine).log2();
    assert!(
        fine.abs() < 5e-3 && (order - 2.0).abs() < 0.1,
        "{coarse} {fine}"
    );
}

/// Depth and change of each step stay in their bounds, and the volume worn is that of the map.
#[test]
fn a_step_changes_little_and_its_volume_adds_up() {
    let ran = run_in(&bearing(), &settings(0.8 * SOFTNESS), fading).unwrap();
    for pair in ran.steps.windows(2) {
        let worn = pair[1].depth - pair[0].depth;
        assert!(worn <= 0.8 * SOFTNESS * (1.0 + 1e-12) && worn > 0.0);
        assert!(pair[1].rate_change < 0.6, "{pair:?}");
    }
    let last = ran.steps.last().unwrap();
    let cell = 0.025 * 2.0 * 0.02;
    let volume = cell * ran.depth.iter().sum::<f64>();
    assert!((last.volume / volume - 1.0).abs() < 1e-12);
    assert_eq!(ran.steps[0].volume, 0.0);
}

/// The roughness is that of the heights truncated by the mean worn depth, and stays where it is kept or
/// nothing is worn.
#[test]
fn summits_wear_with_the_profile() {
    let ran = run_in(&bearing(), &settings(0.1 * SOFTNESS), fading).unwrap();
    let [a, b, _] = ran.depth[..] else {
        panic!("three cells")
    };
    let mean = (a * a + b * b) / (a + b);
    let expected = WornHeights::of(SHELL, mean).rms;
    let last = ran.steps.last().unwrap();
    assert!((last.shell_roughness / expected - 1.0).abs() < 1e-12);
    assert!(ran.steps[0].shell_roughness == SHELL && expected < 0.6 * SHELL);
    let Finish::Rough(rough) = &ran.bearing.finish else {
        panic!("rough")
    };
    assert_eq!(rough.roughness.shell, last.shell_roughness);
    assert_eq!(rough.roughness.journal, 3e-7);

    let kept = RunningIn {
        roughness: WornRoughness::Kept,
        ..settings(0.1 * SOFTNESS)
    };
    let ran = run_in(&bearing(), &kept, fading).unwrap();
    assert!(ran.steps.iter().all(|step| step.shell_roughness == SHELL));

    let still = |ran: &RanIn| {
        let mut cycle = fading(ran)?;
        cycle.on_shell.wear_load.fill(0.0);
        Ok(cycle)
    };
    let ran = run_in(&bearing(), &settings(0.1 * SOFTNESS), still).unwrap();
    assert_eq!((ran.end, ran.bearing), (RunningInEnd::Settled, bearing()));
}

#[test]
fn it_ends_where_rates_settle_or_fade_and_where_steps_are_used_up() {
    let limited = RunningIn {
        step_limit: 7,
        ..settings(0.1 * SOFTNESS)
    };
    let ran = run_in(&bearing(), &limited, fading).unwrap();
    assert_eq!((ran.end, ran.steps.len()), (RunningInEnd::StepLimit, 8));
    // A tenth of the softness off changes the rate by a tenth.
    let settling = RunningIn {
        settled_below: 0.12,
        ..settings(0.1 * SOFTNESS)
    };
    let ran = run_in(&bearing(), &settling, fading).unwrap();
    assert_eq!((ran.end, ran.steps.len()), (RunningInEnd::Settled, 2));
    assert!((ran.time * RATE - 0.05 * SOFTNESS).abs() < 1e-20);
    let fade = RunningIn {
        settled_below: 0.09,
        duration: 3.6e8,
        ..settling
    };
    let ran = run_in(&bearing(), &fade, fading).unwrap();
    let [.., before, last] = ran.steps[..] else {
        panic!("steps")
    };
    assert_eq!(ran.end, RunningInEnd::Faded);
    assert!(last.deepest_rate < 0.09 * RATE && before.deepest_rate >= 0.09 * RATE);
    let unsolved = |ran: &RanIn| {
        let starved = !ran.bearing.bore.is_cylindrical();
        Ok(WornCycle {
            outcome: if starved {
                Outcome::Starved
            } else {
                Outcome::Converged
            },
            ..fading(ran)?
        })
    };
    let ran = run_in(&bearing(), &settling, unsolved).unwrap();
    assert_eq!(ran.end, RunningInEnd::NotSolved(Outcome::Starved));
    assert_eq!(ran.steps.len(), 1);
}

#[test]
fn settings_that_are_none_are_refused() {
    for bad in [0.0, -1.0, f64::NAN] {
        let settings = RunningIn::of(1e-16, bad, 3e-7);
        assert!(run_in(&bearing(), &settings, fading).is_err());
    }
}
