//! Energy equation against closed forms.
use super::*;

const OIL: f64 = 1.8e6;

fn uniform(n: usize, m: usize) -> Grid {
    let faces = |count: usize, length: f64| {
        (0..=count)
            .map(|i| length * i as f64 / count as f64)
            .collect()
    };
    Grid::from_faces(faces(n, 1.0), faces(m, 0.3))
}

fn surroundings(supply: &[f64]) -> Surroundings<'_> {
    Surroundings {
        volumetric_heat: OIL,
        supply,
        ambient: 300.0,
        carry_over: 1.0,
        wall: (0.0, 300.0),
    }
}

/// A flow that enters on the line before the first cell and leaves at both ends of the last station.
fn channel(n: usize, m: usize, flow: f64) -> (Vec<f64>, Vec<f64>) {
    let mut around = vec![flow / m as f64; (n + 1) * m];
    let mut axial = vec![0.0; n * (m + 1)];
    around[n * m..].fill(0.0);
    for j in 0..=m {
        axial[(n - 1) * (m + 1) + j] = flow * (j as f64 / m as f64 - 0.5);
    }
    (around, axial)
}

#[test]
fn an_adiabatic_channel_warms_in_proportion() {
    let (n, m) = (12, 2);
    let grid = uniform(n, m);
    let mut account = HeatAccount::new(&grid, 0.05, false, 1);
    let (around, axial) = channel(n, m, 2e-5);
    let instant = HeatInstant {
        around: &around,
        axial: &axial,
        heat: &vec![2.0; n * m],
        fed_by: &vec![None; n * m],
    };
    account.add(&instant, 0.25);
    let found = account.temperature(&surroundings(&[330.0]), None).unwrap();
    let rise = 2.0 / (OIL * 1e-5);
    for (k, temperature) in found.cells.iter().enumerate() {
        let exact = 330.0 + rise * ((k / m) as f64 + 1.0);
        assert!(
            (temperature - exact).abs() < 1e-9,
            "{k} {temperature} {exact}"
        );
    }
    assert!(
        found.balance.relative_error() < 1e-12,
        "{:?}",
        found.balance
    );
}

/// An axial groove that gives half of what leaves it and takes the rest from the film before it: its
/// temperature is the mean of supply and film.
#[test]
fn a_groove_mixes_supply_and_film() {
    let (n, m) = (20, 2);
    let grid = uniform(n, m);
    let mut account = HeatAccount::new(&grid, 0.05, true, 1);
    let mut fed_by = vec![None; n * m];
    fed_by[..2 * m].fill(Some(0));
    let mut around = vec![0.0; (n + 1) * m];
    let mut axial = vec![0.0; n * (m + 1)];
    // Half of the flow leaves at the ends on the way.
    let mut flow = 2e-5;
    for i in 2..=n {
        around[i * m..(i + 1) * m].fill(flow);
        if i < n {
            let side = 1e-5 / (n - 2) as f64;
            axial[i * (m + 1)] = -side;
            axial[i * (m + 1) + m] = side;
            flow -= side;
        }
    }
    around.copy_within(n * m.., 0);
    let heat = vec![1.5; n * m];
    let instant = HeatInstant {
        around: &around,
        axial: &axial,
        heat: &heat,
        fed_by: &fed_by,
    };
    account.add(&instant, 1.0);
    let found = account.temperature(&surroundings(&[350.0]), None).unwrap();
    let last = found.cells[(n - 1) * m];
    assert!((found.feeds[0] - 0.5 * (350.0 + last)).abs() < 1e-9);
    assert!((found.cells[0] - found.feeds[0]).abs() < 1e-9);
    assert!(
        found.balance.relative_error() < 1e-12,
        "{:?}",
        found.balance
    );
    // Heat in the cells of the groove is not the film's.
    let made = 1.5 * ((n - 2) * m) as f64;
    assert!(
        (found.balance.carried_out / made - 1.0).abs() < 1e-9,
        "{:?}",
        found.balance
    );
    assert!((found.outlet - 350.0 - made / (OIL * 2e-5)).abs() < 1e-9);
}

/// Walls draw the temperature to theirs with exp(-x k b/(rho c q)); upwind cells are of first order.
#[test]
fn walls_draw_heat_exponentially() {
    let error = |n: usize| {
        let grid = uniform(n, 1);
        let mut account = HeatAccount::new(&grid, 0.1, false, 1);
        let (flow_around, axial) = channel(n, 1, 1e-6);
        let instant = HeatInstant {
            around: &flow_around,
            axial: &axial,
            heat: &vec![0.0; n],
            fed_by: &vec![None; n],
        };
        account.add(&instant, 1.0);
        let mut around = surroundings(&[400.0]);
        around.wall = (2000.0, 320.0);
        let found = account.temperature(&around, None).unwrap();
        // 1 x 0.3 over a radius of 0.1 m.
        let exponent = 2000.0 * 0.3 * 0.01 / (OIL * 1e-6);
        let exact = (-exponent).exp();
        assert!(found.balance.relative_error() < 1e-12);
        (found.cells[n - 1] - 320.0) / (found.feeds[0] - 320.0) - exact
    };
    let (coarse, fine) = (error(40), error(80));
    assert!((coarse / fine - 2.0).abs() < 0.1, "{coarse} {fine}");
}

/// Walls beside a groove take heat from the film alone, and the balance of all cells closes.
#[test]
fn walls_beside_a_groove_are_in_the_balance() {
    let (n, m) = (20, 2);
    let grid = uniform(n, m);
    let mut account = HeatAccount::new(&grid, 0.05, true, 1);
    let mut fed_by = vec![None; n * m];
    fed_by[..2 * m].fill(Some(0));
    let mut around = vec![2e-5; (n + 1) * m];
    around[m..2 * m].fill(0.0);
    let instant = HeatInstant {
        around: &around,
        axial: &vec![0.0; n * (m + 1)],
        heat: &vec![1.5; n * m],
        fed_by: &fed_by,
    };
    account.add(&instant, 1.0);
    let mut walls = surroundings(&[350.0]);
    walls.wall = (20_000.0, 355.0);
    let found = account.temperature(&walls, None).unwrap();
    assert!(found.balance.conducted.abs() > 1.0);
    let error = found.balance.relative_error();
    assert!(error < 1e-12, "{error:e} {:?}", found.balance);
}

#[test]
fn nothing_accounted_for_has_no_temperature() {
    let mut account = HeatAccount::new(&uniform(4, 2), 0.05, true, 0);
    assert!(account.temperature(&surroundings(&[]), None).is_none());
}

/// Heat that falls with exp(-T/40 K) in a channel: foreseen rounds find the solution of the equation with
/// that heat in it, which a whole change per round jumps about, and their balance closes on the way.
#[test]
fn foreseen_heat_leads_to_the_same_temperatures_sooner() {
    let (n, m) = (12, 2);
    let grid = uniform(n, m);
    let (around, axial) = channel(n, m, 2e-5);
    let made = |cells: &[f64]| -> Vec<f64> {
        let heat = |t: &f64| 400.0 * ((330.0 - t) / 40.0).exp();
        cells.iter().map(heat).collect()
    };
    let round = |from: &[f64], foresees: bool| {
        let mut account = HeatAccount::new(&grid, 0.05, false, 1);
        let instant = HeatInstant {
            around: &around,
            axial: &axial,
            heat: &made(from),
            fed_by: &vec![None; n * m],
        };
        account.add(&instant, 1.0);
        let foresight = Foresight {
            made_at: from,
            fall: &vec![1.0 / 40.0; n * m],
        };
        let found = account.temperature(&surroundings(&[330.0]), foresees.then_some(&foresight));
        let found = found.unwrap();
        assert!(found.balance.relative_error() < 1e-12, "{found:?}");
        found.cells
    };
    let apart = |a: &[f64], b: &[f64]| {
        let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
    };
    let rounds = |foresees: bool| {
        let mut cells = vec![330.0; n * m];
        for count in 1..=30 {
            let led_to = round(&cells, foresees);
            let change = apart(&led_to, &cells);
            cells = led_to;
            if change < 1e-9 {
                return (count, cells);
            }
        }
        (99, cells)
    };
    let (count, cells) = rounds(true);
    assert!(count <= 8, "{count}");
    assert!(apart(&round(&cells, false), &cells) < 1e-8);
    assert_eq!(rounds(false).0, 99);
}
