//! Made-up results of rough, warm bearings beside plain ones.

use super::{load_cycle, steady};
use sommerfeld_film::{
    ContactLaw, Extreme, FilmSummary, Finish, GreenwoodTripp, Outcome, RoughFinish, Roughness,
};
use sommerfeld_study::results::{
    Body, FieldSnapshot, HeatFieldResults, HeatResults, PlainRun, Results,
};

/// Rough surfaces that carry, composite roughness 0.5 um.
fn finish() -> Finish {
    Finish::Rough(RoughFinish {
        roughness: Roughness {
            journal: 0.3e-6,
            shell: 0.4e-6,
            peklenik_journal: 1.0,
            peklenik_shell: 1.0,
        },
        contact: ContactLaw::GreenwoodTripp(GreenwoodTripp {
            factor: 1e-3,
            asperity_product: 0.05,
            modulus: 53.3e9,
            summit_height: 0.0,
            summit_roughness: None,
        }),
        boundary_friction: 0.08,
    })
}

fn touch(summary: &mut FilmSummary, contact: f64) {
    summary.peak_contact_pressure = Extreme {
        value: 2e3 * contact,
        angle: 0.25,
        axial: -0.004,
    };
    summary.contact_load = contact;
    summary.boundary_power = 60.0 * contact / 1e3;
}

fn field(field: &mut FieldSnapshot, contact: f64) {
    let peak = field
        .pressure
        .iter()
        .copied()
        .fold(f64::MIN_POSITIVE, f64::max);
    let share = |pressure: &f64| (pressure / peak - 0.5).max(0.0);
    field.contact_pressure = field
        .pressure
        .iter()
        .map(|p| 4e3 * contact * share(p))
        .collect();
    field.temperature = field
        .pressure
        .iter()
        .map(|p| 353.15 + 40.0 * p / peak)
        .collect();
}

/// The balance of heat with its warm clearance.
pub fn balance() -> HeatResults {
    HeatResults {
        effective_temperature: 375.15,
        supply_temperature: 353.15,
        outlet_temperature: 397.15,
        conducted: 115.0,
        radial_clearance: 40e-6,
        given_radial_clearance: 36e-6,
        trials: vec![353.15, 380.15, 375.15],
        field: None,
    }
}

/// Temperatures of a field.
pub fn field_heat() -> HeatResults {
    HeatResults {
        radial_clearance: 36e-6,
        trials: Vec::new(),
        field: Some(HeatFieldResults {
            hottest: 393.15,
            generated: 460.0,
            carried_out: 345.0,
            balance_error: 2e-12,
            changes: vec![20.0, 3.0, 0.01],
        }),
        ..balance()
    }
}

/// The steady state and the load cycle with contact, a field of temperature, beside the same without.
pub fn both(title: &str) -> [Results; 2] {
    [steady(title), load_cycle(title)].map(|plain| {
        let mut results = plain.clone();
        match &mut results.body {
            Body::Steady(steady) => {
                steady.bearing.finish = finish();
                touch(&mut steady.summary, 1e3);
                field(steady.field.as_mut().unwrap(), 1e3);
            }
            Body::LoadCycle(cycle) => {
                cycle.bearing.finish = finish();
                for point in &mut cycle.orbit.points {
                    let load = point.load[0].hypot(point.load[1]);
                    touch(&mut point.summary, 0.1 * load);
                }
                let fields = cycle.fields.as_mut().unwrap();
                let worst = std::iter::once(&mut fields.worst);
                for frame in fields.frames.iter_mut().chain(worst) {
                    field(&mut frame.field, 1e3);
                }
            }
            _ => unreachable!("made above"),
        }
        results.header.heat = Some(field_heat());
        results.header.plain = Some(Box::new(PlainRun {
            temperature: 353.15,
            status: Outcome::Converged,
            body: Some(plain.body),
            wall_time: 0.5,
        }));
        results
    })
}
