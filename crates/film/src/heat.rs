//! Where does the film make heat, and where does its oil go with it?
//!
//! ```text
//! heat of a cell = shear by sliding (eta U^2/h) + half of flow x pressure drop at each of its faces
//! ```
//! All cells together make the power lost in the film and what the supply pumps through it:
//! `sum = M_journal w - F v + sum p_feed q_feed - sum p_ambient q_side`, up to the asperities' friction,
//! which belongs to the cells where they touch. Flows are those of the operator.

use crate::energy::HeatInstant;
use crate::finish::Finish;
use crate::integrals::SolvedFilm;
use crate::journal_state::JournalState;
use crate::reynolds::{Axial, Cell};

/// Flows and heat of one instant, with storage made once.
#[derive(Debug, Clone, Default)]
pub(crate) struct FilmHeat {
    around: Vec<f64>,
    axial: Vec<f64>,
    heat: Vec<f64>,
}

impl FilmHeat {
    /// Takes those of a solved film.
    pub(crate) fn take(&mut self, film: &SolvedFilm<'_>, state: &JournalState) {
        let (n, m) = (film.grid.n_around(), film.grid.n_axial());
        self.around.resize((n + 1) * m, 0.0);
        self.axial.resize(n * (m + 1), 0.0);
        self.heat.clear();
        let sliding = state.journal_speed - state.shell_speed;
        let cells = 0..n * m;
        self.heat
            .extend(cells.map(|k| film.shear_power(k, sliding) + film.boundary_power(k, sliding)));
        self.take_around(film);
        self.take_axial(film);
    }

    /// As an instant of an account.
    pub(crate) fn instant<'a>(&'a self, fed_by: &'a [Option<usize>]) -> HeatInstant<'a> {
        HeatInstant {
            around: &self.around,
            axial: &self.axial,
            heat: &self.heat,
            fed_by,
        }
    }

    fn take_around(&mut self, film: &SolvedFilm<'_>) {
        let (n, m) = (film.grid.n_around(), film.grid.n_axial());
        let operator = film.operator;
        let is_ring = operator.west(0, 0).is_some();
        for i in 0..=n {
            for j in 0..m {
                let face = i * m + j;
                self.around[face] =
                    film.units.flow * operator.flow_around(i, j, film.pressure, film.held);
                if is_ring && i == n {
                    continue;
                }
                let before = match i {
                    0 => operator.west(0, j),
                    _ => Some(face - m),
                };
                let behind = (i < n).then_some(face);
                let reduced = |cell: Option<usize>, side: usize| {
                    operator.beside(cell, side, film.pressure, film.held).0
                };
                let conducted =
                    operator.conductance_around[face] * (reduced(before, 0) - reduced(behind, 1));
                let drop = film.loading_beside(before, 0) - film.loading_beside(behind, 1);
                let power = self.power(film, conducted * drop);
                self.share(film, [before, behind], power);
            }
        }
    }

    fn take_axial(&mut self, film: &SolvedFilm<'_>) {
        let (n, m) = (film.grid.n_around(), film.grid.n_axial());
        let ambient = match film.operator.axial {
            Axial::Closed => 0.0,
            Axial::Bath(p) | Axial::Air(p) => p,
        };
        for i in 0..n {
            for j in 0..=m {
                let face = i * (m + 1) + j;
                let flow = film.operator.flow_axial(i, j, film.pressure);
                self.axial[face] = film.units.flow * flow;
                let before = (j > 0).then(|| i * m + j - 1);
                let behind = (j < m).then_some(i * m + j);
                let loading = |cell: Option<usize>| cell.map_or(ambient, |k| film.loading(k));
                let power = self.power(film, flow * (loading(before) - loading(behind)));
                self.share(film, [before, behind], power);
            }
        }
    }

    /// W of a flow times a pressure drop, both 1/s.
    fn power(&self, film: &SolvedFilm<'_>, product: f64) -> f64 {
        product * film.units.flow * film.units.pressure
    }

    /// Gives the power of a face to both of its cells; where one is a feed or none, to the other.
    fn share(&mut self, film: &SolvedFilm<'_>, sides: [Option<usize>; 2], power: f64) {
        let lands = sides.map(|side| side.filter(|k| film.set.cells[*k] != Cell::Fed));
        match lands {
            [Some(a), Some(b)] => {
                self.heat[a] += 0.5 * power;
                self.heat[b] += 0.5 * power;
            }
            [Some(k), None] | [None, Some(k)] => self.heat[k] += power,
            [None, None] => {}
        }
    }
}

impl SolvedFilm<'_> {
    /// Friction power of asperities in a cell, W.
    fn boundary_power(&self, cell: usize, sliding: f64) -> f64 {
        let (Finish::Rough(rough), Some([pressure, _])) =
            (&self.bearing.finish, self.contact.get(cell))
        else {
            return 0.0;
        };
        if self.set.cells[cell] == Cell::Fed {
            return 0.0;
        }
        let m = self.grid.n_axial();
        let load = pressure * self.grid.area(cell / m, cell % m);
        rough.boundary_friction
            * load
            * self.units.pressure
            * self.units.area
            * self.units.radius
            * sliding.abs()
    }
}
