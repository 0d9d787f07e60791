//! The narrowest gap between surfaces of any shape, against exhaustive search.
#![allow(clippy::unwrap_used)]

mod common;

use common::big_end;
use sommerfeld_film::narrowest::GapSearch;
use sommerfeld_film::{Bearing, Feature, JournalState, ProfileTable, ReliefForm, Shape};
use std::f64::consts::TAU;

fn bearing(bore: Vec<Feature>, journal: Vec<Feature>) -> Bearing {
    Bearing {
        bore: Shape::of(bore),
        journal: Shape::of(journal),
        ..big_end()
    }
}

fn table() -> ProfileTable {
    let n = 9;
    let angles: Vec<f64> = (0..n).map(|i| 0.1 + 0.65 * f64::from(i)).collect();
    let positions = vec![-0.015, -0.003, 0.004, 0.015];
    let offsets = (0..n * 4).map(|k| 5e-7 * f64::from((k * 5) % 13)).collect();
    ProfileTable::new(angles, positions, offsets).unwrap()
}

/// Alike along the axis.
fn column() -> ProfileTable {
    let angles: Vec<f64> = (0..12).map(|i| 0.3 + 0.5 * f64::from(i)).collect();
    let offsets = (0..12).map(|k| 1e-6 * f64::from((k * 5) % 7)).collect();
    ProfileTable::new(angles, vec![0.0], offsets).unwrap()
}

fn shapes() -> Vec<(Vec<Feature>, Vec<Feature>)> {
    let wave = |order, amplitude, phase| Feature::Harmonic {
        order,
        amplitude,
        phase,
    };
    let relief = |end: f64, end_offset, form| Feature::EndRelief {
        end,
        length: 4e-3,
        end_offset,
        form,
    };
    vec![
        (
            vec![Feature::Lemon {
                shift: 20e-6,
                joint: 0.2,
            }],
            vec![],
        ),
        (
            vec![Feature::OffsetHalves {
                shift: 15e-6,
                joint: 1.0,
            }],
            vec![wave(3, 4e-6, 0.3)],
        ),
        (
            vec![
                relief(0.015, 6e-6, ReliefForm::Linear),
                relief(-0.015, 9e-6, ReliefForm::Circular),
                Feature::JointRelief {
                    offset: 12e-6,
                    half_span: 0.2,
                    joint: 0.5,
                },
            ],
            vec![Feature::Crowning {
                end_offset: 5e-6,
                half_width: 0.015,
            }],
        ),
        (
            vec![wave(17, 3e-6, 0.0), wave(2, 5e-6, 1.0)],
            vec![wave(5, 2e-6, 0.1)],
        ),
        (vec![Feature::Table(table())], vec![Feature::Table(table())]),
        (
            vec![Feature::Table(column())],
            vec![Feature::Table(column())],
        ),
        (
            vec![],
            vec![
                Feature::Lemon {
                    shift: 8e-6,
                    joint: 0.4,
                },
                relief(0.015, -6e-6, ReliefForm::Linear),
            ],
        ),
    ]
}

fn states() -> Vec<JournalState> {
    let c = 36e-6;
    let mut states = Vec::new();
    for k in 0..12 {
        let k = f64::from(k);
        let angle = 0.7 * k;
        let tilt = c / 0.015 * 0.15;
        states.push(JournalState {
            position: [angle.cos(), angle.sin()].map(|d| 0.06 * k * c * d),
            tilt: if (k * 0.5).fract() == 0.0 {
                [0.0; 2]
            } else {
                [tilt * (1.3 * k).cos(), tilt * (2.1 * k).sin()]
            },
            journal_angle: 0.37 * k,
            shell_angle: if k > 8.0 { 0.11 * k } else { 0.0 },
            ..JournalState::default()
        });
    }
    states
}

/// Against the least of seventy thousand places, one-sided at steps.
#[test]
fn nothing_is_missed() {
    for (bore, journal) in shapes() {
        let bearing = bearing(bore, journal);
        let search = GapSearch::of(&bearing);
        for state in states() {
            let found = search.narrowest(&bearing, &state);
            let gap = |angle: f64, z: f64| {
                let [x, y] = state.centre_at(z);
                bearing.radial_clearance - x * angle.cos() - y * angle.sin()
                    + bearing.bore.offset(angle - state.shell_angle, z)
                    - bearing.journal.offset(angle - state.journal_angle, z)
            };
            let mut least = f64::INFINITY;
            let joint = bearing.bore.kinks_around();
            let near = joint.iter().flat_map(|k| [k - 1e-8, k + 1e-8]);
            let angles = (0..1200)
                .map(|i| TAU * f64::from(i) / 1200.0)
                .chain(near.map(|angle| angle + state.shell_angle));
            for angle in angles {
                for k in 0..=60 {
                    least = least.min(gap(angle, -0.015 + 5e-4 * f64::from(k)));
                }
            }
            let c = bearing.radial_clearance;
            assert!(
                found.gap <= least + 1e-9 * c,
                "{bearing:?} {state:?} {found:?} {least}"
            );
            // It is a gap that is there, so that it cannot be too small.
            let there = [-1e-8, 0.0, 1e-8]
                .map(|side| (gap(found.angle + side, found.axial) - found.gap).abs())
                .into_iter()
                .fold(f64::INFINITY, f64::min);
            assert!(there < 1e-6 * c, "{there} {found:?}");
        }
    }
}

/// A wave of order 1 is a shifted bore.
#[test]
fn a_wave_of_order_one_is_a_shift() {
    let (a, phase) = (10e-6, 0.8_f64);
    let wave = Feature::Harmonic {
        order: 1,
        amplitude: a,
        phase,
    };
    let (shifted, plain) = (bearing(vec![wave], vec![]), bearing(vec![], vec![]));
    for state in states() {
        let state = JournalState {
            shell_angle: 0.0,
            ..state
        };
        let mut moved = state;
        moved.position[0] -= a * phase.cos();
        moved.position[1] -= a * phase.sin();
        let (found, exact) = (shifted.narrowest_gap(&state), plain.narrowest_gap(&moved));
        assert!(
            (found.gap - exact.gap).abs() < 1e-12 * 36e-6,
            "{found:?} {exact:?}"
        );
        assert!((found.angle - exact.angle).sin().abs() < 1e-6);
    }
}

#[test]
fn room_is_found_where_there_is_any() {
    // Beyond the clearance in the middle, yet only shifted.
    let shifted = bearing(
        vec![Feature::Harmonic {
            order: 1,
            amplitude: 90e-6,
            phase: 2.0,
        }],
        vec![],
    );
    assert!(shifted.minimum_gap(&JournalState::default()) < 0.0);
    let (position, place) = shifted.roomiest_position();
    assert!(place.gap > 0.0, "{position:?} {place:?}");
    // A journal of three lobes higher than the clearance.
    let stuck = bearing(
        vec![],
        vec![Feature::Harmonic {
            order: 3,
            amplitude: 40e-6,
            phase: 0.0,
        }],
    );
    assert!(stuck.roomiest_position().1.gap < 0.0);
}
