//! Measured diagrams: what they mean, how they close, how they are smoothed and scaled.
#![allow(clippy::unwrap_used)]

mod printed;

use printed::{cells_of, rows_of};
use sommerfeld_engine::{
    Chamber, Convention, DiagramError, Gas, IndicatorDiagram, PeakScaling, Seam, Sense,
};
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;
const FOUR: f64 = 2.0 * TAU;

/// Pressure of a made-up cycle at a crank angle from firing, deg: smooth, peak 8 deg after firing.
fn made_up(angle: f64) -> f64 {
    let away = (angle - 8.0 + 360.0).rem_euclid(720.0) - 360.0;
    1e5 + 90e5 * (-(away / 35.0).powi(2)).exp() + 1e4 * (angle * DEGREE * 0.5).sin()
}

/// Rows every degree from `from` to `from` + 720 deg, with firing at `firing`.
fn rows(from: i32, firing: f64) -> Vec<[f64; 2]> {
    let row = |deg: i32| [f64::from(deg) * DEGREE, made_up(f64::from(deg) - firing)];
    (from..=from + 720).map(row).collect()
}

fn diagram() -> IndicatorDiagram {
    let convention = Convention::absolute(FOUR, TAU);
    IndicatorDiagram::from_measured(&rows(0, 360.0), &convention)
        .unwrap()
        .0
}

/// A sequence between -1 and 1 without pattern.
fn noise(seed: usize) -> f64 {
    let hash = (seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let hash = (hash ^ (hash >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (hash >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[test]
fn linear_between_points_and_periodic() {
    let diagram = diagram();
    for deg in -720..720 {
        let deg = f64::from(deg);
        assert!(
            (diagram.at(deg * DEGREE) / made_up(deg) - 1.0).abs() < 1e-9,
            "{deg}"
        );
        let middle = 0.5 * (made_up(deg) + made_up(deg + 1.0));
        assert!(
            (diagram.at((deg + 0.5) * DEGREE) / middle - 1.0).abs() < 1e-9,
            "{deg}"
        );
    }
    let angles: Vec<f64> = (0..5000).map(|i| 40.0 * noise(i)).collect();
    let mut ascending = angles.clone();
    ascending.sort_by(f64::total_cmp);
    for angles in [angles, ascending] {
        let one_by_one: Vec<f64> = angles.iter().map(|&angle| diagram.at(angle)).collect();
        assert_eq!(diagram.at_each(&angles), one_by_one);
    }
    assert!((diagram.peak()[0] - 8.0 * DEGREE).abs() < 1e-12);
}

#[test]
fn points_in_any_order_and_period_are_one_diagram() {
    let points = diagram().points;
    let away = |(index, &[angle, p]): (usize, &[f64; 2])| [angle + FOUR * (index % 3) as f64, p];
    let shuffled: Vec<[f64; 2]> = points.iter().enumerate().rev().map(away).collect();
    let sorted = IndicatorDiagram::new(shuffled, FOUR).unwrap();
    assert_eq!(sorted.points.len(), points.len());
    for (a, b) in sorted.points.iter().zip(&points) {
        assert!((a[0] - b[0]).abs() < 1e-12 && a[1] == b[1]);
    }
}

#[test]
fn every_convention_gives_the_same_diagram() {
    let expected = diagram();
    let along = Convention::absolute(FOUR, 0.0);
    let encoder: Vec<[f64; 2]> = rows(-360, 0.0)
        .iter()
        .map(|r| [r[0] - 0.03, r[1]])
        .collect();
    let gauge: Vec<[f64; 2]> = rows(-360, 0.0).iter().map(|r| [r[0], r[1] - 9e4]).collect();
    let against: Vec<[f64; 2]> = rows(-360, 0.0).iter().map(|r| [-r[0], r[1]]).collect();
    let cases = [
        (rows(-360, 0.0), along),
        (rows(100, 0.0), along),
        (rows(0, 360.0), Convention::absolute(FOUR, TAU + FOUR)),
        (
            encoder,
            Convention {
                shift: 0.03,
                ..along
            },
        ),
        (
            gauge,
            Convention {
                gauge_ambient: Some(9e4),
                ..along
            },
        ),
        (
            against,
            Convention {
                sense: Sense::Against,
                ..along
            },
        ),
    ];
    for (rows, convention) in cases {
        let (found, closure) = IndicatorDiagram::from_measured(&rows, &convention).unwrap();
        assert!(closure.share < 1e-6, "{closure:?}");
        for angle in (0..1440).map(|half| 0.5 * DEGREE * f64::from(half) + 1e-3) {
            let (a, b) = (found.at(angle), expected.at(angle));
            assert!(
                (a / b - 1.0).abs() < 1e-6,
                "{convention:?} {angle}: {a} {b}"
            );
        }
    }
}

#[test]
fn a_step_at_the_seam_is_kept_or_shared_out() {
    let mut open = rows(0, 360.0);
    let drift = 2e5;
    for row in &mut open {
        row[1] += drift * row[0] / FOUR;
    }
    let keep = Convention::absolute(FOUR, TAU);
    let (kept, closure) = IndicatorDiagram::from_measured(&open, &keep).unwrap();
    assert!((closure.step + drift).abs() < 1e-3, "{closure:?}");
    assert!((kept.before(TAU) - kept.at(TAU) - drift).abs() < 1e-3);
    let share = Convention {
        seam: Seam::Distribute,
        ..keep
    };
    let (shared, same) = IndicatorDiagram::from_measured(&open, &share).unwrap();
    assert_eq!(closure, same);
    assert!((shared.before(TAU) - shared.at(TAU)).abs() < 1e-6);
    // The straight line that was added is taken out again but for its mean.
    for deg in 0..720 {
        let angle = (f64::from(deg) + 0.3) * DEGREE;
        let away = shared.at(angle) - diagram().at(angle) - 0.5 * drift;
        assert!(away.abs() < 1.0, "{deg}: {away}");
    }
    // Rows that stop a step before the end close by their slope.
    open.pop();
    let (_, closure) = IndicatorDiagram::from_measured(&open, &keep).unwrap();
    assert!((closure.step + drift).abs() < 0.01 * drift, "{closure:?}");
}

#[test]
fn what_is_no_cycle_is_refused_by_name() {
    let convention = Convention::absolute(FOUR, TAU);
    let refused = |rows: &[[f64; 2]], convention: &Convention| {
        IndicatorDiagram::from_measured(rows, convention).unwrap_err()
    };
    let full = rows(0, 360.0);
    let less = refused(&full[..=700], &convention);
    assert!(
        matches!(less, DiagramError::CoversLess { covered, .. } if (covered / DEGREE - 700.0).abs() < 1e-9)
    );
    let two_stroke = Convention::absolute(TAU, TAU);
    assert!(matches!(
        refused(&full, &two_stroke),
        DiagramError::CoversMore { .. }
    ));
    let DiagramError::PeakMisplaced { peak, shift } =
        refused(&full, &Convention::absolute(FOUR, 0.0))
    else {
        panic!("a peak a turn away is refused");
    };
    assert!((peak / DEGREE + 352.0).abs() < 1e-9 && (shift + TAU).abs() < 1e-12);
    let cured = Convention::absolute(FOUR, shift);
    assert!(IndicatorDiagram::from_measured(&full, &cured).is_ok());
    assert!(matches!(
        refused(&full[..5], &convention),
        DiagramError::TooFewPoints { points: 5 }
    ));
    let changed = |row: usize, column: usize, value: f64| {
        let mut rows = full.clone();
        rows[row][column] = value;
        refused(&rows, &convention)
    };
    assert_eq!(changed(3, 1, f64::NAN), DiagramError::NotFinite { row: 3 });
    assert!(matches!(
        changed(9, 0, 0.0),
        DiagramError::Unsorted { row: 9, .. }
    ));
    assert!(matches!(
        changed(9, 1, -2e3),
        DiagramError::BelowVacuum { row: 9, .. }
    ));
    assert!(matches!(changed(720, 1, 20e5), DiagramError::Open { share } if share > 0.2));
    assert_eq!(
        refused(&full, &Convention::absolute(0.0, 0.0)),
        DiagramError::Period
    );
}

#[test]
fn smoothing_takes_noise_and_leaves_the_peak() {
    let clean = diagram();
    let noisy: Vec<[f64; 2]> = clean
        .points
        .iter()
        .enumerate()
        .map(|(index, &[angle, p])| [angle, p + 0.5e5 * noise(index)])
        .collect();
    let noisy = IndicatorDiagram::new(noisy, FOUR).unwrap();
    let smooth = noisy.smoothed(10.0 * DEGREE).unwrap();
    assert_eq!(smooth.peak(), noisy.peak());
    // Away from the peak, where its measured height is not restored.
    let rms = |diagram: &IndicatorDiagram| {
        let far = clean.points.iter().zip(&diagram.points);
        let far = far.filter(|(point, _)| (20.0..700.0).contains(&(point[0] / DEGREE)));
        let squares: Vec<f64> = far.map(|(a, b)| (a[1] - b[1]).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    println!(
        "noise {:.0} Pa, smoothed {:.0} Pa",
        rms(&noisy),
        rms(&smooth)
    );
    assert!(rms(&smooth) < 0.4 * rms(&noisy));
    assert!(matches!(
        noisy.smoothed(0.0),
        Err(DiagramError::Smoothing { .. })
    ));
    assert!(matches!(
        noisy.smoothed(4.0),
        Err(DiagramError::Smoothing { .. })
    ));
}

#[test]
fn smoothing_reproduces_a_parabola_around_the_seam() {
    // A parabola over half the cycle, the other half its continuation by period.
    let parabola = |angle: f64| 5e5 - 1e4 * (angle - TAU).powi(2);
    let points = (0..720)
        .map(|deg| f64::from(deg) * DEGREE)
        .map(|a| [a, parabola(a).max(1e5)]);
    let diagram = IndicatorDiagram::new(points.collect(), FOUR).unwrap();
    let smooth = diagram.smoothed(15.0 * DEGREE).unwrap();
    for deg in [150, 250, 345, 360, 377, 500] {
        let (a, b) = (smooth.points[deg][1], diagram.points[deg][1]);
        assert!((a / b - 1.0).abs() < 1e-11, "{deg}: {a} {b}");
    }
}

#[test]
fn gas_between_speeds_and_peaks() {
    let low = diagram();
    let high = low.scaled(1.5);
    let gas = Gas {
        diagrams: vec![(100.0, low.clone()), (200.0, high.clone())],
        peaks: Vec::new(),
    };
    for angle in [0.0, 0.1, 1.0, 3.3, 7.0, 12.0] {
        let half = 0.5 * (low.at(angle) + high.at(angle));
        assert!((gas.diagram_at(150.0).at(angle) / half - 1.0).abs() < 1e-12);
        assert_eq!(gas.diagram_at(50.0).at(angle), low.at(angle));
        assert_eq!(gas.diagram_at(900.0).at(angle), high.at(angle));
    }
    let peaks = vec![[100.0, 90e5], [300.0, 130e5]];
    let gas = Gas {
        peaks,
        ..Gas::of(low.clone())
    };
    assert!((gas.diagram_at(200.0).peak()[1] - 110e5).abs() < 1e-6);
    assert!((gas.diagram_at(20.0).peak()[1] - 90e5).abs() < 1e-6);
    let factor = 110e5 / low.peak()[1];
    assert!((gas.diagram_at(200.0).at(3.0) / low.at(3.0) / factor - 1.0).abs() < 1e-12);
    let kept = gas.diagram_scaled(200.0, PeakScaling::AboveCompressionStart);
    assert!((kept.peak()[1] - 110e5).abs() < 1e-6);
    assert_eq!(kept.peak()[0], low.peak()[0]);
    let start = low.at(-PI);
    for point in &low.points {
        let [angle, p] = *point;
        let expected = if p > start {
            start + (p - start) * (110e5 - start) / (low.peak()[1] - start)
        } else {
            p
        };
        assert!((kept.at(angle) - expected).abs() < 1e-6 * expected);
    }
}

#[test]
fn blending_keeps_the_steps_of_both() {
    let stepped = |at: f64, up: f64| {
        let mut points: Vec<[f64; 2]> = (0..12).map(|i| [f64::from(i), 1e5]).collect();
        points.extend([[at, 1e5], [at, 1e5 + up]]);
        IndicatorDiagram::new(points, 12.0).unwrap()
    };
    let (a, b) = (stepped(2.5, 4e5), stepped(7.5, 8e5));
    let blend = a.blended(&b, 0.25);
    for angle in [0.0, 2.5, 2.6, 2.9, 3.0, 7.5, 7.7, 11.99] {
        for side in [IndicatorDiagram::at, IndicatorDiagram::before] {
            let expected = 0.75 * side(&a, angle) + 0.25 * side(&b, angle);
            assert!(
                (side(&blend, angle) / expected - 1.0).abs() < 1e-12,
                "{angle}"
            );
        }
    }
}

/// The full-load diagram of the inline six.
fn inline_six() -> IndicatorDiagram {
    let rows: Vec<[f64; 2]> = cells_of("inline-six-gas/diagram.csv")
        .iter()
        .map(|row| {
            [
                row[0].parse::<f64>().unwrap() * DEGREE,
                1e6 * row[1].parse::<f64>().unwrap(),
            ]
        })
        .collect();
    let convention = Convention::absolute(FOUR, TAU);
    let (diagram, closure) = IndicatorDiagram::from_measured(&rows, &convention).unwrap();
    assert!(
        (closure.step - 15_474.0).abs() < 1e-3 && closure.share < 2e-3,
        "{closure:?}"
    );
    diagram
}

#[test]
fn the_inline_six_at_every_crank_angle() {
    let diagram = inline_six();
    let highest = diagram.peak()[1];
    let rows = cells_of("inline-six-gas/reference.csv");
    assert_eq!(rows.len(), 360);
    let mut worst = 0.0_f64;
    for row in &rows {
        let [angle, expected] = [0, 1].map(|cell| row[cell].parse::<f64>().unwrap());
        let found = diagram.at((angle - 360.0) * DEGREE);
        worst = worst.max((found - expected).abs() / highest);
        assert!(
            (found - expected).abs() < 5e-4 * highest,
            "{angle}: {found} against {expected}"
        );
    }
    println!("largest difference over the peak: {worst:.1e}");
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn the_inline_six_over_the_cycle() {
    let chamber = Chamber {
        bore: 0.105,
        crank_radius: 0.0685,
        rod_length: 0.207,
        pin_offset: 0.0,
        compression_ratio: 17.0,
    };
    let diagram = inline_six();
    let [angle, pressure] = diagram.peak();
    let found = [
        chamber.work(&diagram),
        chamber.mean_effective_pressure(&diagram),
        pressure,
        angle / DEGREE,
    ];
    let rows = rows_of("inline-six-gas/work.csv");
    assert_eq!(rows.len(), found.len());
    for (row, found) in rows.iter().zip(found) {
        println!("{}: {found} against {}", row.name, row.value);
        assert!(
            (found - row.value).abs() <= row.bar * (1.0 + 1e-9),
            "{}: {found}",
            row.name
        );
    }
}
