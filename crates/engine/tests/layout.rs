//! Layouts: throws, firing angles, and what is refused.
#![allow(clippy::unwrap_used)] // a plan that should be a layout and is not fails the test

use sommerfeld_engine::{EngineLayout, LayoutError, LayoutKind, LayoutPlan, Strokes};

const TURN: f64 = 360.0;

fn plan(kind: LayoutKind, order: &[usize]) -> LayoutPlan {
    LayoutPlan {
        kind,
        cylinders: order.len(),
        firing_order: order.to_vec(),
        firing_intervals: None,
        throw_angles: None,
        cylinder_spacing: 0.1,
        rod_offset: match kind {
            LayoutKind::Inline => 0.0,
            LayoutKind::Vee { .. } | LayoutKind::Boxer => 0.03,
        },
        main_positions: None,
        strokes: Strokes::Four,
    }
}

fn vee(bank_angle: f64) -> LayoutKind {
    LayoutKind::Vee {
        bank_angle: bank_angle.to_radians(),
    }
}

fn radians(degrees: &[f64]) -> Option<Vec<f64>> {
    Some(degrees.iter().map(|angle| angle.to_radians()).collect())
}

/// Directions of the throws, deg, 0 to 360.
fn throws(layout: &EngineLayout) -> Vec<f64> {
    let degrees = layout.throws.iter().map(|throw| throw.angle.to_degrees());
    degrees
        .map(|angle| (angle.rem_euclid(TURN) * 1e6).round() / 1e6 % TURN)
        .collect()
}

fn firings(layout: &EngineLayout) -> Vec<f64> {
    let degrees = layout
        .cylinders
        .iter()
        .map(|on| on.firing_angle.to_degrees());
    degrees.map(|angle| (angle * 1e6).round() / 1e6).collect()
}

#[test]
fn inline_throws_follow_from_the_firing_order() {
    let six = EngineLayout::new(&plan(LayoutKind::Inline, &[1, 5, 3, 6, 2, 4])).unwrap();
    assert_eq!(firings(&six), [0.0, 480.0, 240.0, 600.0, 120.0, 360.0]);
    assert_eq!(throws(&six), [0.0, 240.0, 120.0, 120.0, 240.0, 0.0]);
    assert_eq!(six.mains.len(), 7);
    let four = EngineLayout::new(&plan(LayoutKind::Inline, &[1, 3, 4, 2])).unwrap();
    assert_eq!(throws(&four), [0.0, 180.0, 180.0, 0.0]);
    let three = EngineLayout::new(&plan(LayoutKind::Inline, &[1, 3, 2])).unwrap();
    assert_eq!(throws(&three), [0.0, 240.0, 120.0]);
    let five = EngineLayout::new(&plan(LayoutKind::Inline, &[1, 2, 4, 5, 3])).unwrap();
    assert_eq!(throws(&five), [0.0, 216.0, 144.0, 72.0, 288.0]);
    let one = EngineLayout::new(&plan(LayoutKind::Inline, &[1])).unwrap();
    assert_eq!((throws(&one), one.mains.len()), (vec![0.0], 2));
}

#[test]
fn the_firing_order_may_begin_with_any_cylinder() {
    let from_one = EngineLayout::new(&plan(LayoutKind::Inline, &[1, 3, 4, 2])).unwrap();
    let from_four = EngineLayout::new(&plan(LayoutKind::Inline, &[4, 2, 1, 3])).unwrap();
    assert_eq!(firings(&from_one), firings(&from_four));
    assert_eq!(throws(&from_one), throws(&from_four));
}

#[test]
fn two_strokes_fire_once_a_turn() {
    let mut three = plan(LayoutKind::Inline, &[1, 3, 2]);
    three.strokes = Strokes::Two;
    let layout = EngineLayout::new(&three).unwrap();
    assert_eq!(firings(&layout), [0.0, 240.0, 120.0]);
    assert_eq!(throws(&layout), [0.0, 120.0, 240.0]);
}

#[test]
fn cross_plane_v8_has_throws_at_right_angles() {
    let eight = EngineLayout::new(&plan(vee(90.0), &[1, 5, 4, 8, 6, 3, 7, 2])).unwrap();
    assert_eq!(throws(&eight), [315.0, 45.0, 225.0, 135.0]);
    let same_place = eight.cylinders[4].axial - eight.cylinders[0].axial;
    assert!((same_place - 0.03).abs() < 1e-15);
    assert!(eight.cylinders[0].bank_angle < 0.0 && eight.cylinders[4].bank_angle > 0.0);
}

#[test]
fn v6_needs_uneven_intervals_or_split_pins() {
    let mut six = plan(vee(90.0), &[1, 4, 3, 6, 2, 5]);
    let refused = EngineLayout::new(&six).unwrap_err();
    let message = refused.to_string();
    for part in [
        "cylinder 4",
        "120.0 deg",
        "90.0 and 450.0 deg",
        "split pins",
    ] {
        assert!(message.contains(part), "{message}");
    }
    six.firing_intervals = radians(&[90.0, 150.0, 90.0, 150.0, 90.0, 150.0]);
    let uneven = EngineLayout::new(&six).unwrap();
    assert_eq!(uneven.throws.len(), 3);
    assert_eq!(firings(&uneven), [0.0, 480.0, 240.0, 90.0, 570.0, 330.0]);
    // split by 30 deg: even intervals
    six.firing_intervals = None;
    six.throw_angles = radians(&[0.0, -30.0, 240.0, 210.0, 120.0, 90.0]);
    let split = EngineLayout::new(&six).unwrap();
    assert_eq!(split.throws.len(), 6);
    assert_eq!(split.cylinders[3].throw, 1);
    assert_eq!(firings(&split), [0.0, 480.0, 240.0, 120.0, 600.0, 360.0]);
    assert!(
        split
            .throws
            .windows(2)
            .all(|two| two[0].axial < two[1].axial)
    );
}

#[test]
fn boxer_throws_are_opposed() {
    let four = EngineLayout::new(&plan(LayoutKind::Boxer, &[1, 3, 2, 4])).unwrap();
    assert_eq!(throws(&four), [270.0, 90.0, 90.0, 270.0]);
    assert_eq!(four.mains.len(), 5);
    let refused = EngineLayout::new(&plan(LayoutKind::Boxer, &[1, 2, 3, 4])).unwrap_err();
    assert!(
        matches!(
            refused,
            LayoutError::NotOpposed {
                cylinders: [1, 2],
                ..
            }
        ),
        "{refused}"
    );
}

#[test]
fn given_throws_and_firing_order_must_agree() {
    let mut four = plan(LayoutKind::Inline, &[1, 3, 4, 2]);
    // any crank-fixed frame will do
    four.throw_angles = radians(&[40.0, 220.0, 220.0, 40.0]);
    let layout = EngineLayout::new(&four).unwrap();
    assert_eq!(throws(&layout), [0.0, 180.0, 180.0, 0.0]);
    four.throw_angles = radians(&[0.0, 90.0, 270.0, 180.0]);
    let message = EngineLayout::new(&four).unwrap_err().to_string();
    for part in ["cylinder 2", "540.0 deg", "270.0 and 630.0 deg"] {
        assert!(message.contains(part), "{message}");
    }
    four.throw_angles = radians(&[0.0, 180.0]);
    let message = EngineLayout::new(&four).unwrap_err().to_string();
    assert!(message.contains("2 throw angles for 4 throws"), "{message}");
}

#[test]
fn rounded_angles_are_set_to_the_dead_centres() {
    let mut three = plan(LayoutKind::Inline, &[1, 2, 3]);
    three.throw_angles = radians(&[0.0, -239.99, -119.97]);
    three.firing_intervals = radians(&[239.99, 240.02, 240.0]);
    let layout = EngineLayout::new(&three).unwrap();
    for cylinder in &layout.cylinders {
        let arm = layout.throws[cylinder.throw].angle + cylinder.firing_angle;
        let off = (arm - cylinder.bank_angle).to_degrees();
        assert!((off - (off / TURN).round() * TURN).abs() < 1e-12);
    }
}

#[test]
fn plans_that_are_no_engine_are_refused_by_name() {
    let good = plan(LayoutKind::Inline, &[1, 3, 4, 2]);
    let change = |edit: &dyn Fn(&mut LayoutPlan)| {
        let mut plan = good.clone();
        edit(&mut plan);
        EngineLayout::new(&plan).unwrap_err().to_string()
    };
    let cases: [(String, &str); 12] = [
        (change(&|p| p.cylinders = 0), "not 0 cylinders"),
        (
            change(&|p| p.firing_order = vec![1, 3, 4]),
            "leaves out cylinder 2",
        ),
        (
            change(&|p| p.firing_order = vec![1, 3, 3, 2]),
            "cylinder 3 twice",
        ),
        (
            change(&|p| p.firing_order = vec![1, 0, 4, 2]),
            "cylinder 0 that is not there",
        ),
        (
            change(&|p| p.firing_intervals = radians(&[180.0; 3])),
            "3 given",
        ),
        (
            change(&|p| p.firing_intervals = radians(&[170.0; 4])),
            "together 680.0 deg",
        ),
        (
            change(&|p| p.firing_intervals = radians(&[180.0, -180.0, 360.0, 360.0])),
            "after cylinder 3 is -180.0 deg",
        ),
        (
            change(&|p| p.cylinder_spacing = f64::NAN),
            "cylinder spacing",
        ),
        (change(&|p| p.main_positions = Some(vec![0.0])), "needs two"),
        (
            change(&|p| p.main_positions = Some(vec![0.0, 0.4, 0.2])),
            "main 3",
        ),
        (
            change(&|p| p.main_positions = Some(vec![0.0, 0.15])),
            "stands at throw 2",
        ),
        (
            change(&|p| p.throw_angles = radians(&[0.0, f64::NAN, 180.0, 0.0])),
            "cylinder 2",
        ),
    ];
    for (message, part) in cases {
        assert!(message.contains(part), "{message:?} should say {part:?}");
    }
    let odd = EngineLayout::new(&plan(vee(60.0), &[1, 2, 3])).unwrap_err();
    assert!(odd.to_string().contains("either bank"), "{odd}");
    let mut boxer = plan(LayoutKind::Boxer, &[1, 3, 2, 4]);
    boxer.rod_offset = 0.0;
    let message = EngineLayout::new(&boxer).unwrap_err().to_string();
    assert!(message.contains("opposed rods"), "{message}");
}

#[test]
fn a_layout_made_by_hand_is_checked() {
    let good = EngineLayout::new(&plan(vee(90.0), &[1, 5, 4, 8, 6, 3, 7, 2])).unwrap();
    assert_eq!(good.check(), Ok(()));
    let mut lost = good.clone();
    lost.cylinders[2].throw = 4;
    let message = lost.check().unwrap_err().to_string();
    assert!(message.contains("cylinder 3 works on throw 5"), "{message}");
    let mut turned = good;
    turned.cylinders[6].firing_angle += 0.1;
    let message = turned.check().unwrap_err().to_string();
    assert!(
        message.contains("cylinder 7 fires at 545.7 deg"),
        "{message}"
    );
}
