//! What does the gap let through, where it is not smooth or its oil not the same everywhere?
//!
//! Rough surfaces, after Patir and Cheng: the mean flow of the film is
//! ```text
//! q_x = -phi_x h^3/(12 eta) dp/dx + U_m h_T + (U_J - U_S)/2 sigma phi_s        q_z = -phi_z h^3/(12 eta) dp/dz
//! ```
//! with the nominal gap h and the mean gap h_T, which is also what the film holds. An oil that thins under
//! shear has the viscosity of the mean shear rate `|U_J - U_S|/h_T`; one whose temperature is a field has at
//! each face the mean of the fluidities of both cells. The nominal gap stays what friction and contact see.
//!
//! The operator is that of a smooth film whose conductances, transports and contents are these; their
//! slopes by the nominal H go into the tangents.
//! References: N. Patir, H. S. Cheng, J. Lubr. Technol. 100 (1978) 12, 10.1115/1.3453103; 101 (1979) 220,
//! 10.1115/1.3453329.

use crate::flow_factors::FlowFactors;
use crate::flow_factors::table::LawTable;
use crate::gap::Gap;
use crate::grid::Grid;
use crate::reynolds::Operator;
use sommerfeld_oil::Lubricant;

/// Nominal gap, and the slopes of what it lets through.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    rough: Option<RoughLaws>,
    thins: bool,
    /// Nominal H at faces around, and mean over cells.
    pub height_around: Vec<f64>,
    /// See `height_around`.
    pub height: Vec<f64>,
    /// Derivatives by the nominal H, over the value: of what conducts, and of what is carried, through
    /// faces around.
    pub around_slopes: Vec<[f64; 2]>,
    /// Derivative of the H that is carried through faces around by the nominal one.
    pub carried_slopes: Vec<f64>,
    /// Relative derivative by the nominal H of what conducts through faces along the axis.
    pub axial_slopes: Vec<f64>,
    /// Flow by sliding past rough surfaces through faces around, 1/s per width.
    drag: Vec<f64>,
    /// First and second derivative of what a cell holds by its nominal H.
    pub holding_slopes: Vec<[f64; 2]>,
    /// Rate of the nominal H, 1/s.
    pub rate: Vec<f64>,
    /// Mean shear rate over the sliding speed over the clearance, `phi_f/H`; half the difference of both
    /// walls, `phi_fs/H`.
    pub shearing: Vec<[f64; 2]>,
    /// Shear stress by pressure flow over that of the smooth film, at faces around.
    pub pressing: Vec<f64>,
    /// Viscosity over that at low shear and the film's temperature, per cell, at cavitation pressure.
    pub viscosity: Vec<f64>,
    /// Fluidity at low shear over that at the film's temperature, per cell; 1 without a field.
    fluidity: Vec<f64>,
}

/// Factors of rough surfaces, tabulated.
#[derive(Debug, Clone, PartialEq)]
struct RoughLaws {
    factors: FlowFactors,
    around: LawTable<3>,
    along: LawTable<1>,
    cell: LawTable<2>,
}

impl RoughLaws {
    fn new(factors: FlowFactors) -> Self {
        // The mean of gap over local gap bends where the deepest heights begin to touch.
        const DEEPEST_HEIGHT: f64 = 3.0;
        Self {
            factors,
            around: LawTable::new(f64::INFINITY),
            along: LawTable::new(f64::INFINITY),
            cell: LawTable::new(DEEPEST_HEIGHT),
        }
    }
}

/// What surrounds the gap at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PassageState<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) oil: &'a Lubricant,
    /// K.
    pub(crate) temperature: f64,
    /// Per cell, K, where it is a field.
    pub(crate) field: Option<&'a [f64]>,
    /// m.
    pub(crate) clearance: f64,
    /// m.
    pub(crate) radius: f64,
    /// Mean speed of the surfaces and speed of the journal relative to the shell, rad/s.
    pub(crate) mean_speed: f64,
    pub(crate) sliding: f64,
}

impl Passage {
    /// Storage for a grid; `None` for smooth surfaces, a Newtonian oil and one temperature.
    pub(crate) fn new(
        grid: &Grid,
        factors: Option<FlowFactors>,
        thins: bool,
        has_field: bool,
    ) -> Option<Self> {
        if factors.is_none() && !thins && !has_field {
            return None;
        }
        let (n, m) = (grid.n_around(), grid.n_axial());
        let around = vec![0.0; (n + 1) * m];
        let cells = vec![0.0; n * m];
        Some(Self {
            rough: factors.map(RoughLaws::new),
            thins,
            height_around: around.clone(),
            height: cells.clone(),
            around_slopes: vec![[0.0; 2]; (n + 1) * m],
            carried_slopes: vec![1.0; (n + 1) * m],
            axial_slopes: vec![0.0; n * (m + 1)],
            drag: around.clone(),
            holding_slopes: vec![[0.0; 2]; n * m],
            rate: cells.clone(),
            shearing: vec![[0.0; 2]; n * m],
            pressing: around,
            viscosity: cells.clone(),
            fluidity: cells,
        })
    }

    /// Takes the nominal gap and leaves in it what conducts, carries and holds.
    pub(crate) fn narrow(&mut self, gap: &mut Gap, state: &PassageState<'_>) {
        self.height_around.copy_from_slice(&gap.around_transport);
        self.height.copy_from_slice(&gap.mean);
        self.rate.copy_from_slice(&gap.rate);
        self.fill_cells(gap, state);
        self.fill_around(gap, state);
        self.fill_axial(gap, state);
    }

    /// Completes an operator made from the narrowed gap: flow by sliding.
    pub(crate) fn amend(&self, operator: &mut Operator, grid: &Grid) {
        if self.rough.is_some() {
            let m = grid.n_axial();
            for (face, transport) in operator.transport.iter_mut().enumerate() {
                *transport += self.drag[face] * grid.axial_widths[face % m];
            }
        }
    }

    /// Viscosity over that at low shear, and its relative derivative by H, at a mean H.
    fn thinned(&self, state: &PassageState<'_>, mean: f64, temperature: f64) -> (f64, f64) {
        if !self.thins || state.sliding == 0.0 {
            return (1.0, 0.0);
        }
        let speed = state.sliding.abs() * state.radius / state.clearance;
        let rate = speed / mean;
        let low = state.oil.viscosity(temperature, 0.0).value;
        let seen = state.oil.viscosity_at_shear(temperature, 0.0, rate);
        // d(rate)/dH = -rate/H
        (
            seen.value / low,
            -seen.by_shear_rate * rate / mean / seen.value,
        )
    }

    fn fill_cells(&mut self, gap: &mut Gap, state: &PassageState<'_>) {
        let reference = state.oil.viscosity(state.temperature, 0.0).value;
        for k in 0..self.height.len() {
            let nominal = self.height[k];
            let (mean, slopes, shearing) = match &mut self.rough {
                Some(RoughLaws { factors, cell, .. }) => {
                    let per_sigma = state.clearance / factors.sigma();
                    let mean = factors.mean_gap(nominal * state.clearance);
                    let [(stress, _), (difference, _)] =
                        cell.at(nominal * per_sigma, |h| factors.at_cell(h));
                    let difference = difference / nominal;
                    // Where the surfaces overlap the factor is zero faster than the gap.
                    let difference = if difference.is_finite() {
                        difference
                    } else {
                        0.0
                    };
                    let curvature = mean.contact_factor_by_gap * state.clearance;
                    let slopes = [mean.contact_factor, curvature];
                    (
                        mean.value / state.clearance,
                        slopes,
                        [stress * per_sigma, difference],
                    )
                }
                None => (nominal, [1.0, 0.0], [1.0 / nominal, 0.0]),
            };
            gap.mean[k] = mean;
            gap.rate[k] *= slopes[0];
            self.holding_slopes[k] = slopes;
            self.shearing[k] = shearing;
            let temperature = state.field.map_or(state.temperature, |field| field[k]);
            let warm = if state.field.is_some() {
                state.oil.viscosity(temperature, 0.0).value / reference
            } else {
                1.0
            };
            self.fluidity[k] = 1.0 / warm;
            self.viscosity[k] = warm * self.thinned(state, mean, temperature).0;
        }
    }

    /// Fluidity of a face over that at the film's temperature, between cells whose viscosity is known.
    fn warm_fluidity(&self, state: &PassageState<'_>, cells: [Option<usize>; 2]) -> (f64, f64) {
        let Some(field) = state.field else {
            return (1.0, state.temperature);
        };
        let (mut count, mut fluidity, mut temperature) = (0.0, 0.0, 0.0);
        for cell in cells.into_iter().flatten() {
            count += 1.0;
            fluidity += self.fluidity[cell];
            temperature += field[cell];
        }
        (fluidity / count, temperature / count)
    }

    fn fill_around(&mut self, gap: &mut Gap, state: &PassageState<'_>) {
        let (n, m) = (state.grid.n_around(), state.grid.n_axial());
        let c = state.clearance;
        let smooth = gap.steps.clone();
        let mut steps = smooth.as_slice();
        for face in 0..(n + 1) * m {
            let nominal = self.height_around[face];
            let (i, j) = (face / m, face % m);
            let (mut conducting, mut carrying) = gap.relative_slopes(face, &mut steps);
            let mut carried_slope = carrying * gap.around_transport[face];
            self.pressing[face] = 1.0;
            let mut drag_slope = 0.0;
            if let Some(RoughLaws {
                factors, around, ..
            }) = &mut self.rough
            {
                let over = factors.sigma() / c;
                let per_sigma = c / factors.sigma();
                let [conductance, drag, pressing] =
                    around.at(nominal * per_sigma, |h| factors.at_face(h));
                let mean = factors.mean_gap(nominal * c);
                let half = 0.5 * state.sliding * over;
                gap.around_cubed[face] = over * over * over * conductance.0;
                conducting = conductance.1 / conductance.0 * per_sigma;
                gap.around_transport[face] = mean.value / c;
                carried_slope = mean.contact_factor;
                self.drag[face] = half * drag.0;
                drag_slope = half * drag.1 * per_sigma;
                self.pressing[face] = pressing.0;
            }
            let around = [(i + n - 1) % n * m + j, i % n * m + j];
            let (fluidity, temperature) = self.warm_fluidity(state, around.map(Some));
            let (thinned, by_height) = self.thinned(state, gap.around_transport[face], temperature);
            gap.around_cubed[face] *= fluidity / thinned;
            conducting -= by_height * carried_slope;
            let flow = state.mean_speed * gap.around_transport[face] + self.drag[face];
            carrying = (state.mean_speed * carried_slope + drag_slope) / flow;
            if !carrying.is_finite() {
                carrying = 0.0;
            }
            self.around_slopes[face] = [conducting, carrying];
            self.carried_slopes[face] = carried_slope;
        }
    }

    /// Leaves in the gap what conducts.
    fn fill_axial(&mut self, gap: &mut Gap, state: &PassageState<'_>) {
        let (n, m) = (state.grid.n_around(), state.grid.n_axial());
        let c = state.clearance;
        gap.axial_cubed.resize(n * (m + 1), 0.0);
        for face in 0..n * (m + 1) {
            let (i, j) = (face / (m + 1), face % (m + 1));
            let nominal = gap.axial[face];
            let (cubed, mut slope, mean, mean_slope) = match &mut self.rough {
                Some(RoughLaws { factors, along, .. }) => {
                    let over = factors.sigma() / c;
                    let per_sigma = c / factors.sigma();
                    let [conductance] = along.at(nominal * per_sigma, |h| factors.at_end(h));
                    let mean = factors.mean_gap(nominal * c);
                    let slope = conductance.1 / conductance.0 * per_sigma;
                    let cubed = over * over * over * conductance.0;
                    (cubed, slope, mean.value / c, mean.contact_factor)
                }
                None => (nominal * nominal * nominal, 3.0 / nominal, nominal, 1.0),
            };
            let cells = [(j > 0).then(|| i * m + j - 1), (j < m).then_some(i * m + j)];
            let (fluidity, temperature) = self.warm_fluidity(state, cells);
            let (thinned, by_height) = self.thinned(state, mean, temperature);
            slope -= by_height * mean_slope;
            self.axial_slopes[face] = slope;
            gap.axial_cubed[face] = cubed * fluidity / thinned;
        }
    }
}
