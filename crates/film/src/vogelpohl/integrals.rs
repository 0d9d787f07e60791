//! The paper's integrals over nodal pressures: trapezoids both ways, of second order like the scheme.

use super::mesh::{Mesh, wrapped};
use crate::dimensionless::DimensionlessIntegrals;
use crate::peak::{CENTRE, WIDTH, Window};

/// Integrals and peak of `pressure` on the nodes of `mesh`.
pub(super) fn of(mesh: &Mesh, pressure: &[f64]) -> DimensionlessIntegrals {
    let (rows, columns) = (mesh.around.len(), mesh.axial.len());
    let mut found = DimensionlessIntegrals::default();
    let mut highest = 0;
    for i in 0..rows {
        let length = 0.5 * (mesh.step_around((i + rows - 1) % rows) + mesh.step_around(i));
        let (sin, cos) = mesh.around[i].sin_cos();
        let (mut force, mut moment) = (0.0, 0.0);
        // Both edges are without pressure.
        for j in 1..columns - 1 {
            let value = pressure[i * columns + j];
            let share = 0.5 * (mesh.axial[j + 1] - mesh.axial[j - 1]) * value;
            force += share;
            moment += share * mesh.axial[j];
            if value > pressure[highest] {
                highest = i * columns + j;
            }
        }
        found.p_cos += length * force * cos;
        found.p_sin += length * force * sin;
        found.p_z_cos += length * moment * cos;
        found.p_z_sin += length * moment * sin;
    }
    found.peak = pressure[highest] + rise(mesh, pressure, [highest / columns, highest % columns]);
    found
}

/// How far the pressure rises above its highest node between the nodes around it.
fn rise(mesh: &Mesh, pressure: &[f64], [i, j]: [usize; 2]) -> f64 {
    let (rows, columns) = (mesh.around.len(), mesh.axial.len());
    let row = |k: usize| (i + rows + k - CENTRE) % rows;
    let column = |k: usize| (j + k).checked_sub(CENTRE).filter(|j| *j < columns);
    // Distances beyond the ends only have to ascend: there is no film, and the window is not used.
    let beyond = |k: usize| (k as f64 - CENTRE as f64) * 4.0;
    let window = Window {
        around: std::array::from_fn(|k| wrapped(mesh.around[row(k)] - mesh.around[i])),
        axial: std::array::from_fn(|k| {
            column(k).map_or(beyond(k), |at| mesh.axial[at] - mesh.axial[j])
        }),
        pressure: std::array::from_fn::<_, WIDTH, _>(|k| {
            std::array::from_fn(|l| {
                column(l).map_or(f64::NAN, |at| pressure[row(k) * columns + at])
            })
        }),
    };
    window.peak().map_or(0.0, |peak| peak.rise)
}
