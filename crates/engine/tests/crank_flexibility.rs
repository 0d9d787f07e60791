//! The condensed crankshaft against the force method: no stiffness matrices of beams, but unit loads on the
//! shaft clamped at its last main, and the work of their inner forces (Mohr, Castigliano).
#![allow(clippy::unwrap_used)]

use nalgebra::{DMatrix, Vector3};
use sommerfeld_engine::{
    CrankTrain, CrankshaftShape, Cylinder, EngineLayout, Rod, Strokes, Throw, Web,
    condensed_crankshaft,
};
use sommerfeld_flex::{Material, Section};
use std::f64::consts::PI;

type Vector = Vector3<f64>;

const RADIUS: f64 = 0.0685;
/// Main to throw: half a main 17, web 24, half a pin 18 mm.
const PITCH: f64 = 0.059;
/// Main to the mid-plane of the web.
const JOURNAL: f64 = 0.029;

/// A piece of the chain from the first to the last main.
struct Member {
    from: Vector,
    to: Vector,
    section: Section,
    /// Local y.
    across: Vector,
}

/// A unit force and moment at a point; it loads the members from `first` on.
struct Unit {
    first: usize,
    at: Vector,
    force: Vector,
    moment: Vector,
}

fn shape() -> CrankshaftShape {
    CrankshaftShape {
        youngs_modulus: 210e9,
        poissons_ratio: 0.3,
        main_diameter: 0.083,
        main_length: 0.034,
        pin_diameter: 0.069,
        pin_length: 0.036,
        bore_diameter: 0.02,
        web: Web::Bar {
            thickness: 0.024,
            width: 0.115,
        },
    }
}

/// Members of a crankshaft with throws at `angles`: six for each throw, main to main.
fn chain(angles: &[f64]) -> Vec<Member> {
    let steel = Material {
        youngs_modulus: 210e9,
        poissons_ratio: 0.3,
    };
    let journal = Section::circle(&steel, 0.083, 0.02);
    let pin = Section::circle(&steel, 0.069, 0.02);
    let web = Section::rectangle(&steel, 0.024, 0.115);
    let mut members = Vec::new();
    for (throw, angle) in angles.iter().enumerate() {
        let main = 2.0 * PITCH * throw as f64;
        let arm = Vector::new(RADIUS * angle.cos(), RADIUS * angle.sin(), 0.0);
        let axis = |z: f64| Vector::new(0.0, 0.0, main + z);
        let [near, far] = [JOURNAL, 2.0 * PITCH - JOURNAL];
        let places = [
            axis(0.0),
            axis(near),
            axis(near) + arm,
            axis(PITCH) + arm,
            axis(far) + arm,
            axis(far),
            axis(2.0 * PITCH),
        ];
        let sections = [journal, web, pin, pin, web, journal];
        for (k, section) in sections.into_iter().enumerate() {
            let is_web = k == 1 || k == 4;
            members.push(Member {
                from: places[k],
                to: places[k + 1],
                section,
                across: if is_web { Vector::z() } else { Vector::x() },
            });
        }
    }
    members
}

impl Unit {
    /// Inner forces at `place` of `member` in its local axes, times what they meet there: stretching,
    /// twisting, bending about y and z, shear along y and z.
    fn inner(&self, member: &Member, place: Vector) -> [f64; 6] {
        let along = (member.to - member.from).normalize();
        let normal = along.cross(&member.across);
        let moment = self.moment + (self.at - place).cross(&self.force);
        [
            self.force.dot(&along),
            moment.dot(&along),
            moment.dot(&member.across),
            moment.dot(&normal),
            self.force.dot(&member.across),
            self.force.dot(&normal),
        ]
    }
}

/// Displacement in the sense of one unit load under another. Inner forces are linear along a member, so
/// that Simpson's rule is exact.
fn flexibility(members: &[Member], one: &Unit, other: &Unit) -> f64 {
    let loaded = &members[one.first.max(other.first)..];
    let works = loaded.iter().map(|member| {
        let section = &member.section;
        let soft = [
            1.0 / section.axial,
            1.0 / section.torsion,
            1.0 / section.bending[0],
            1.0 / section.bending[1],
            section.shear_flexibility[0],
            section.shear_flexibility[1],
        ];
        let points = [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)];
        let sum: f64 = points
            .iter()
            .map(|(share, weight)| {
                let place = member.from + (member.to - member.from) * *share;
                let (a, b) = (one.inner(member, place), other.inner(member, place));
                weight * (0..6).map(|k| a[k] * b[k] * soft[k]).sum::<f64>()
            })
            .sum();
        sum / 6.0 * (member.to - member.from).norm()
    });
    works.sum()
}

/// Unit loads x, y, moments about x, y at the start of member `first`.
fn units(members: &[Member], first: usize) -> [Unit; 4] {
    let unit = |force: Vector, moment: Vector| Unit {
        first,
        at: members[first].from,
        force,
        moment,
    };
    let none = Vector::zeros();
    [
        unit(Vector::x(), none),
        unit(Vector::y(), none),
        unit(none, Vector::x()),
        unit(none, Vector::y()),
    ]
}

fn matrix(members: &[Member], rows: &[Unit], columns: &[Unit]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |row, column| {
        flexibility(members, &rows[row], &columns[column])
    })
}

fn train(angles: &[f64]) -> CrankTrain {
    let throws: Vec<Throw> = angles
        .iter()
        .enumerate()
        .map(|(k, angle)| Throw {
            angle: *angle,
            axial: PITCH * (2 * k + 1) as f64,
        })
        .collect();
    let cylinders = throws.iter().enumerate().map(|(throw, place)| Cylinder {
        throw,
        bank_angle: 0.0,
        firing_angle: 0.0,
        axial: place.axial,
    });
    CrankTrain {
        layout: EngineLayout {
            cylinders: cylinders.collect(),
            mains: (0..=angles.len()).map(|k| 2.0 * PITCH * k as f64).collect(),
            throws,
            strokes: Strokes::Four,
        },
        bore: 0.105,
        crank_radius: RADIUS,
        rod_length: 0.207,
        pin_offset: 0.0,
        piston_mass: 1.7,
        rod: Rod {
            mass: 2.4,
            centre_of_gravity: 0.065,
            inertia: 2e-2,
        },
        unbalances: Vec::new(),
        crankcase_pressure: 1e5,
    }
}

#[test]
fn stiffness_of_six_throws_is_the_inverse_of_their_flexibility() {
    let (third, half) = (2.0 * PI / 3.0, PI);
    for angles in [
        vec![0.0, 2.0 * third, third, third, 2.0 * third, 0.0],
        vec![0.0, half, half, 0.0],
        vec![0.3, 1.7, 4.1],
    ] {
        let train = train(&angles);
        let rods: Vec<f64> = train
            .layout
            .throws
            .iter()
            .map(|throw| throw.axial)
            .collect();
        let shaft = condensed_crankshaft(&train, &shape(), &rods).unwrap();
        let members = chain(&angles);
        let mains: Vec<Unit> = (0..angles.len())
            .flat_map(|k| units(&members, 6 * k))
            .collect();
        let pins: Vec<Unit> = (0..angles.len())
            .flat_map(|k| units(&members, 6 * k + 3))
            .collect();
        // the last main clamped: its rows and columns drop out
        let size = mains.len();
        let clamped = shaft.stiffness.view((0, 0), (size, size)).into_owned();
        let scale = clamped.diagonal().map(f64::sqrt);
        let own = matrix(&members, &mains, &mains);
        let one = &clamped * &own;
        let off = DMatrix::from_fn(size, size, |row, column| {
            let exact = f64::from(u8::from(row == column));
            (one[(row, column)] - exact) * scale[column] / scale[row]
        });
        assert!(off.amax() < 1e-8, "{angles:?}: {:e}", off.amax());
        // forces and moments on the pins: what holds the mains still
        let carried = &clamped * matrix(&members, &mains, &pins);
        let transfer = shaft.load_transfer.rows(0, size);
        let off = (carried - transfer).amax();
        assert!(off < 1e-8, "{angles:?}: {off:e}");
    }
}
