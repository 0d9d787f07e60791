//! The tables of the page of `validation/sander-rig`, printed on request:
//! `cargo test -p sommerfeld-bearing --test rig -- --ignored --nocapture one_assumption` and so on.

use super::*;
use sommerfeld_bearing::{
    CycleWear, RanIn, RunningIn, RunningInEnd, WornCycle, WornRoughness, run_in,
};
use sommerfeld_film::FilmError;

/// What a bearing at rest wears.
fn worn(
    film: &FilmSolver,
    bearing: &Bearing,
    rest: &Equilibrium,
    load: f64,
) -> Result<WornCycle, FilmError> {
    if rest.outcome != Outcome::Converged {
        return Ok(WornCycle::not_solved(rest.outcome));
    }
    let field = film.field().unwrap();
    let mut record = CycleWear::new(bearing.radius(), &field);
    record.see(&field, &rest.state, 1.0);
    let [x, y] = rest.reaction.contact_force;
    Ok(WornCycle {
        on_shell: record.on_shell.finish(),
        contact_share: x.hypot(y) / load,
        minimum_film_thickness: rest.summary.minimum_film_thickness.value,
        outcome: rest.outcome,
    })
}

impl Rig {
    /// Run in at a speed, 1/min, until the map of wear rates settles; wear moves the profile alone, for the
    /// surfaces are measured ones.
    fn run_in(&self, bearing: &Bearing, load: f64, rpm: f64) -> RanIn {
        let settings = RunningIn {
            settled_below: 0.02,
            roughness: WornRoughness::Kept,
            step_limit: 250,
            ..RunningIn::of(1e-17, 1e9, 0.31e-6)
        };
        let conditions = Conditions {
            temperature: 373.15,
            feed_pressures: None,
        };
        let mut start = None;
        run_in(bearing, &settings, |ran| {
            let bearing = &ran.bearing;
            let mut film = FilmSolver::aligned(bearing, &self.oil, self.cells)?;
            let near = request(load, rpm, 0.0, start);
            let mut rest = find_equilibrium(&mut film, bearing, &near, &conditions)?;
            if rest.outcome != Outcome::Converged {
                // down from where the film carries all
                let mut film = FilmSolver::aligned(bearing, &self.oil, self.cells)?;
                let faster = SPEEDS.iter().filter(|faster| **faster > rpm);
                let mut from = None;
                for speed in faster.chain([&rpm]) {
                    let request = request(load, *speed, 0.0, from);
                    rest = find_equilibrium(&mut film, bearing, &request, &conditions)?;
                    from = Some(rest.state.position);
                }
                return worn(&film, bearing, &rest, load);
            }
            start = Some(rest.state.position);
            worn(&film, bearing, &rest, load)
        })
        .unwrap()
    }
}

/// One assumption at a time: `cargo test -p sommerfeld-bearing --test rig -- --ignored --nocapture one_assumption`.
#[test]
#[ignore = "prints the table of validation/sander-rig"]
fn one_assumption_at_a_time() {
    let rigid = Rig::as_in_the_source();
    let elastic = Rig::elastic();
    let planes = finish(0.13e-6, 0.28e-6, 0.0);
    let thinning = ShearThinning::Cross {
        second_newtonian_ratio: 0.5,
        critical_shear_rate: 3e6,
        exponent: 0.8,
        reference: None,
    };
    let mut rubbing = surfaces();
    let mut isotropic = surfaces();
    if let (Finish::Rough(rubbing), Finish::Rough(isotropic)) = (&mut rubbing, &mut isotropic) {
        rubbing.boundary_friction = 0.1;
        isotropic.roughness.peklenik_journal = 1.0;
        isotropic.roughness.peklenik_shell = 1.0;
    }
    let of = |from: &Rig, change: &dyn Fn(&mut Rig)| {
        let mut rig = from.clone();
        change(&mut rig);
        rig
    };
    let columns = |share: f64| of(&elastic, &|r| r.bodies = Bodies::Columns(share));
    for (name, rig) in [
        ("rigid bodies", rigid.clone()),
        (
            "rigid, 128 x 32 cells",
            of(&rigid, &|r| r.cells = [128, 32]),
        ),
        (
            "rigid, summits in the mean planes",
            of(&rigid, &|r| r.finish = planes.clone()),
        ),
        ("elastic bodies", elastic.clone()),
        ("128 x 32 cells", of(&elastic, &|r| r.cells = [128, 32])),
        ("half as soft", columns(0.5)),
        ("a quarter as soft", columns(0.25)),
        ("an eighth as soft", columns(0.125)),
        (
            "a layer of 2 mm of 70 GPa",
            of(&elastic, &|r| r.bodies = Bodies::Layer(2e-3, 70e9)),
        ),
        ("rod of steel", of(&elastic, &|r| r.rod = 210e9)),
        (
            "summits in the mean planes",
            of(&elastic, &|r| r.finish = planes.clone()),
        ),
        (
            "marks in no direction",
            of(&elastic, &|r| r.finish = isotropic.clone()),
        ),
        (
            "`reynolds`",
            of(&elastic, &|r| r.cavitation = Cavitation::Reynolds),
        ),
        (
            "no pressure coefficient",
            of(&elastic, &|r| r.oil.viscosity_pressure = PressureLaw::None),
        ),
        (
            "Cross, half at 3e6 1/s",
            of(&elastic, &|r| r.oil.shear_thinning = thinning),
        ),
        (
            "clearance 0.8e-3",
            of(&elastic, &|r| r.relative_clearance = 0.8e-3),
        ),
        (
            "clearance 1.3e-3",
            of(&elastic, &|r| r.relative_clearance = 1.3e-3),
        ),
        (
            "supports tilted by 2e-5",
            of(&elastic, &|r| r.support_tilt = 2e-5),
        ),
        (
            "boundary friction 0.1",
            of(&elastic, &|r| r.finish = rubbing.clone()),
        ),
    ] {
        let speeds = over_speed(&rig, LOAD);
        print(name, &speeds);
        println!("  level {:?}, least at {}", level(&speeds), least(&speeds));
    }
}

/// The rows of finite elements; `RIG_ROW` chooses one by a part of its name.
#[test]
#[ignore = "prints the table of validation/sander-rig; a quarter of an hour"]
fn by_finite_elements() {
    let elements = Rig::by_elements();
    let of = |change: &dyn Fn(&mut Rig)| {
        let mut rig = elements.clone();
        change(&mut rig);
        rig
    };
    for (name, rig) in [
        ("finite elements", of(&|r| r.speeds = &MEASURED)),
        (
            "sizes of another state of the file",
            of(&|r| {
                r.bodies = Bodies::Elements("other-rod", "other-bracket");
                r.speeds = &MEASURED;
            }),
        ),
        (
            "96 x 24 cells",
            of(&|r| {
                r.cells = [96, 24];
                r.speeds = &[500.0, 300.0, 150.0];
            }),
        ),
        ("rod of steel", of(&|r| r.rod = 210e9)),
        (
            "no flow factors",
            of(&|r| r.finish = finish(1e-9, 1e-9, 0.60e-6)),
        ),
        ("clearance 1.3e-3", of(&|r| r.relative_clearance = 1.3e-3)),
    ] {
        let asked = std::env::var("RIG_ROW").unwrap_or_default();
        if !name.contains(&asked) {
            continue;
        }
        let speeds = over_speed(&rig, LOAD);
        print(name, &speeds);
        println!("  level {:?}, least at {}", level(&speeds), least(&speeds));
    }
}

/// What running in at the slowest speed makes of it, between rigid bodies and on columns.
#[test]
#[ignore = "prints the figures of validation/sander-rig on running in; minutes"]
fn run_in_at_the_slowest_speed() {
    for (name, rig) in [
        ("rigid bodies", Rig::as_in_the_source()),
        ("elastic bodies", Rig::elastic()),
    ] {
        let worn =
            [(rig.tested(LOAD), LOAD), (rig.support(LOAD), 0.5 * LOAD)].map(|(bearing, load)| {
                let ran = rig.run_in(&bearing, load, 150.0);
                for step in [ran.steps.first().unwrap(), ran.steps.last().unwrap()] {
                    let (depth, share) = (1e6 * step.depth, step.contact_share);
                    println!("{name}: {depth:.2} um, share of contact {share:.3}");
                }
                println!("{name}: {} after {} steps", ran.end.name(), ran.steps.len());
                ran
            });
        if worn
            .iter()
            .all(|ran| !matches!(ran.end, RunningInEnd::NotSolved(_)))
        {
            let [tested, support] = [(&worn[0], LOAD), (&worn[1], 0.5 * LOAD)]
                .map(|(ran, load)| rig.rests(&ran.bearing, load, 0.0, rig.speeds));
            let speeds = over(&rig, LOAD, &tested, &support);
            print(name, &speeds);
            println!("  level {:?}, least at {}", level(&speeds), least(&speeds));
        }
    }
}
