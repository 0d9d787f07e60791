//! The paper's database as a film: what a multibody model of its kind would be given.

use super::{Drive, Looked, SuperpositionTable};
use sommerfeld_film::frame::Frame;
use sommerfeld_film::{
    Bearing, Capabilities, Conditions, Extreme, Feed, FilmError, FilmForce, FilmShear, FilmSummary,
    Inlet, JournalState, Linearised, Outcome, Reaction, Step, Tangent,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Forces of wedge and squeeze out of a [`SuperpositionTable`], added; exact tangents of the sum.
///
/// In the frame of the line of centres the wedge turns at `omega_J + omega_S - 2 x turning rate`; the squeeze
/// is V where the eccentricity rises, W where it falls, so that tangents by velocity jump where it changes
/// its sign. Tilt rates make no force, and the tilt is taken to turn with the line of centres:
/// [`SuperpositionFilm::statement`] says so. Friction is that of the full
/// width. The peak pressure of the summary is the sum of both peaks, an upper bound of the
/// superposed one; side flow and the share of the full film are not in the tables and stay 0.
#[derive(Debug, Clone)]
pub struct SuperpositionFilm {
    table: Arc<SuperpositionTable>,
    radius: f64,
    width: f64,
    clearance: f64,
    viscosity: f64,
    /// The last state with its reaction, for the summary.
    last: Option<(JournalState, Reaction)>,
    updates: usize,
}

/// The state in the frame of the line of centres, over the clearance.
struct Local {
    eps: f64,
    /// Tilt along and across the plane of the narrowest gap, as they stand in the gap.
    tilts: [f64; 2],
    /// Rate of the relative eccentricity, 1/s.
    squeeze: f64,
    /// Relative eccentricity times the effective speed, 1/s.
    wedge: f64,
}

/// `Phi` and `Theta` times their speeds, wedge and squeeze together, and what they are made of.
struct Sum {
    values: [f64; 4],
    peak: f64,
    wedge: Looked,
    squeeze: Looked,
    /// Signs of the integrals of the wedge: the sense of rotation mirrors them.
    signs: [f64; 4],
}

impl SuperpositionFilm {
    /// Film of `bearing` at one viscosity (Pa s) out of the database of its ratio of diameter over width.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for a bearing that the database does not describe.
    pub fn new(
        table: Arc<SuperpositionTable>,
        bearing: &Bearing,
        viscosity: f64,
    ) -> Result<Self, FilmError> {
        if let Some(reason) = refusal(&table, bearing, viscosity) {
            return Err(FilmError::Unsupported { reason });
        }
        Ok(Self {
            table,
            radius: bearing.radius(),
            width: bearing.width,
            clearance: bearing.radial_clearance,
            viscosity,
            last: None,
            updates: 0,
        })
    }

    /// What a reader of its results must know.
    #[must_use]
    pub fn statement(&self) -> String {
        let recipe = self.table.recipe();
        let status = match self.table.outcome() {
            Outcome::Converged => "",
            _ => "NOT CONVERGED, ",
        };
        format!(
            "superposition: pressures of wedge and squeeze are cut apart and their forces added, as in \
             the paper, which errs by tens of percent where both act; tilt rates are neglected; the \
             tables err by at most {:.1e} of the force or moment of each ({status}target {:.1e}) where the \
             relative gap is above {} and the relative eccentricity above {}",
            self.table.largest_error(),
            recipe.target,
            recipe.smallest_gap,
            recipe.smallest_eccentricity
        )
    }

    fn local(&self, grid_state: &JournalState) -> Local {
        let c = self.clearance;
        let per_tilt = 0.5 * self.width / c;
        let eps = grid_state.position[0] / c;
        let speeds = grid_state.journal_speed + grid_state.shell_speed;
        Local {
            eps,
            tilts: [
                -grid_state.tilt[1] * per_tilt,
                grid_state.tilt[0] * per_tilt,
            ],
            squeeze: grid_state.velocity[0] / c,
            wedge: eps * speeds - 2.0 * grid_state.velocity[1] / c,
        }
    }

    fn check(&self, state: &JournalState) -> Result<(), FilmError> {
        let named = [
            ("position", state.position),
            ("tilt", state.tilt),
            ("velocity", state.velocity),
            ("speeds", [state.journal_speed, state.shell_speed]),
        ];
        for (name, values) in named {
            if !values.iter().all(|value| value.is_finite()) {
                return Err(FilmError::NotFinite { name });
            }
        }
        if !self.table.is_tilted() && state.tilt != [0.0; 2] {
            return Err(FilmError::NoTilt);
        }
        let narrowest = self.narrowest(state);
        if narrowest.value <= 0.0 {
            return Err(FilmError::Contact {
                angle_deg: narrowest.angle.to_degrees(),
                axial_mm: 1e3 * narrowest.axial,
                gap_um: 1e6 * narrowest.value,
            });
        }
        Ok(())
    }

    /// The narrowest gap: at the edge whose centre is farther out.
    fn narrowest(&self, state: &JournalState) -> Extreme {
        let half = 0.5 * self.width;
        let square = |z: f64| {
            let [x, y] = state.centre_at(z);
            x * x + y * y
        };
        let axial = if state.tilt == [0.0; 2] {
            0.0
        } else if square(-half) >= square(half) {
            -half
        } else {
            half
        };
        let [x, y] = state.centre_at(axial);
        Extreme {
            value: self.clearance - x.hypot(y),
            angle: y.atan2(x),
            axial,
        }
    }

    /// `asks_peak`: the sum has the peak, which takes time and which a step's summary alone needs.
    fn sum(&self, local: &Local, asks_peak: bool) -> Sum {
        let sense = if local.wedge < 0.0 { -1.0 } else { 1.0 };
        let spot = self.table.spot(local.eps, local.tilts);
        let wedge = match sense < 0.0 && local.tilts[1] != 0.0 {
            true => {
                let mirrored = self.table.mirrored(&spot);
                self.table.at(Drive::Wedge, &mirrored, asks_peak)
            }
            false => self.table.at(Drive::Wedge, &spot, asks_peak),
        };
        let drive = if local.squeeze < 0.0 {
            Drive::Falling
        } else {
            Drive::Rising
        };
        let squeeze = self.table.at(drive, &spot, asks_peak);
        let signs = [1.0, sense, 1.0, sense];
        let (w, s) = (local.wedge.abs(), local.squeeze.abs());
        Sum {
            values: std::array::from_fn(|k| {
                w * signs[k] * wedge.integrals[k] + s * squeeze.integrals[k]
            }),
            peak: w * wedge.peak + s * squeeze.peak,
            wedge,
            squeeze,
            signs,
        }
    }

    /// Derivatives of the sum by position along, tilts x and y, velocities along and across.
    fn slopes(&self, local: &Local, sum: &Sum, speeds: f64) -> [[f64; 5]; 4] {
        let c = self.clearance;
        let per_tilt = 0.5 * self.width / c;
        let (w, s) = (local.wedge.abs(), local.squeeze.abs());
        let sense = sum.signs[1];
        let side = if local.squeeze < 0.0 { -1.0 } else { 1.0 };
        std::array::from_fn(|k| {
            let wedge = sum.signs[k] * sum.wedge.integrals[k];
            let by_wedge = sum.wedge.slopes[k].map(|slope| w * sum.signs[k] * slope);
            let by_squeeze = sum.squeeze.slopes[k].map(|slope| s * slope);
            [
                (by_wedge[0] + by_squeeze[0] + sense * speeds * wedge) / c,
                (sense * by_wedge[2] + by_squeeze[2]) * per_tilt,
                -(by_wedge[1] + by_squeeze[1]) * per_tilt,
                side * sum.squeeze.integrals[k] / c,
                -2.0 * sense * wedge / c,
            ]
        })
    }

    /// Force along and across (N) and moment about both (N m) from integrals times speeds.
    fn scaled(&self, [f1, f2, m1, m2]: [f64; 4]) -> [f64; 4] {
        let psi = self.clearance / self.radius;
        let force = 0.5 * self.viscosity * self.radius * self.width / (psi * psi);
        let moment = 0.5 * force * self.width;
        [force * f1, force * f2, -moment * m2, moment * m1]
    }

    /// Adds the torques of the shear over the full width: of the speed, and half of the couple of the
    /// pressures each way.
    fn with_friction(&self, state: &JournalState, reaction: Reaction) -> Reaction {
        let per_tilt = 0.5 * self.width / self.clearance;
        let [x, y] = state.position.map(|value| value / self.clearance);
        let [along, across] = [state.tilt[1] * per_tilt, -state.tilt[0] * per_tilt];
        let speed = state.journal_speed - state.shell_speed;
        let widths = mean_inverse_gap([x, y], [along, across]);
        let shear =
            self.viscosity * self.radius.powi(3) * self.width * speed * widths / self.clearance;
        let (force, moment) = (reaction.film_force, reaction.film_moment);
        let couple = state.position[0] * force[1] - state.position[1] * force[0]
            + state.tilt[0] * moment[1]
            - state.tilt[1] * moment[0];
        Reaction {
            friction_torque_journal: shear + 0.5 * couple,
            friction_torque_shell: shear - 0.5 * couple,
            ..reaction
        }
    }
}

/// Integral of 1/H around, mean over the width, of a centre at `centre + Z tilt`:
/// `mean of 2 pi/sqrt(1 - |centre + Z tilt|^2)` over Z from -1 to 1, in closed form.
fn mean_inverse_gap([x, y]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    /// Below it the tilt changes the mean by less than round-off.
    const UNTILTED: f64 = 1e-8;
    let rest = 1.0 - x * x - y * y;
    let (square, mixed) = (a * a + b * b, x * a + y * b);
    let tilt = square.sqrt();
    if tilt < UNTILTED {
        return TAU / rest.sqrt();
    }
    let root = (square * rest + mixed * mixed).sqrt();
    let at = |z: f64| ((square * z + mixed) / root).clamp(-1.0, 1.0).asin();
    TAU * 0.5 * (at(1.0) - at(-1.0)) / tilt
}

/// Why a database is not that of a bearing.
fn refusal(table: &SuperpositionTable, bearing: &Bearing, viscosity: f64) -> Option<&'static str> {
    /// Relative difference of sizes that is of no account.
    const SAME: f64 = 1e-6;
    let recipe = table.recipe();
    let sizes = [
        bearing.diameter,
        bearing.width,
        bearing.radial_clearance,
        viscosity,
    ];
    let is_like = |ratio: f64| (ratio / recipe.d_over_b - 1.0).abs() <= SAME;
    let inlet = |inlet: Inlet| matches!(inlet, Inlet::MaxFilmLine { .. });
    let no_feeds: &[Feed] = &[];
    if sizes.iter().any(|size| !(size.is_finite() && *size > 0.0)) {
        Some("diameter, width, clearance and viscosity must be positive")
    } else if !is_like(bearing.diameter / bearing.width) {
        Some("the database is of another ratio of diameter to width: build one for this bearing")
    } else if bearing.cavitation != recipe.cavitation {
        Some("the database is of another closure: use its cavitation")
    } else if inlet(bearing.inlet) != inlet(recipe.wedge_inlet) {
        Some("the database is of another inlet: use its inlet")
    } else if bearing.ambient_pressure != bearing.cavitation_pressure {
        Some("databases need equal ambient and cavitation pressure: use model = \"field\"")
    } else if bearing.feeds != no_feeds {
        Some("databases know no grooves and holes: use model = \"field\"")
    } else if !bearing.is_plain() {
        Some("databases are those of a cylindrical bore and journal: use model = \"field\"")
    } else if bearing.film_shear != FilmShear::FullWidth {
        Some("databases shear over the full width: use film_shear = \"full-width\"")
    } else {
        None
    }
}

impl FilmForce for SuperpositionFilm {
    fn capabilities(&self) -> Capabilities {
        Capabilities {
            accepts_tilt: self.table.is_tilted(),
            has_history: false,
            conserves_mass: false,
            iteration_limit: 1,
        }
    }

    fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.narrowest(state).value
    }

    fn linearise(
        &mut self,
        state: &JournalState,
        _step: Step,
        _conditions: &Conditions<'_>,
    ) -> Result<Linearised, FilmError> {
        self.check(state)?;
        let frame = Frame::LineOfCentres;
        let turned = frame.turn(state);
        let grid_state = frame.to_grid(state, turned);
        let local = self.local(&grid_state);
        let sum = self.sum(&local, false);
        let slopes = self.slopes(&local, &sum, state.journal_speed + state.shell_speed);
        let mut tangent = Tangent::default();
        for k in 0..5 {
            let column = self.scaled(slopes.map(|row| row[k]));
            for (row, value) in column.into_iter().enumerate() {
                match k {
                    0 => tangent.by_position[row][0] = value,
                    1 | 2 => tangent.by_position[row][k + 1] = value,
                    _ => tangent.by_rate[row][k - 3] = value,
                }
            }
        }
        let [force_x, force_y, moment_x, moment_y] = self.scaled(sum.values);
        let reaction = Reaction {
            film_force: [force_x, force_y],
            film_moment: [moment_x, moment_y],
            ..Reaction::default()
        };
        let (reaction, tangent) = frame.from_grid(&grid_state, turned, reaction, tangent);
        let reaction = self.with_friction(state, reaction);
        self.last = Some((*state, reaction));
        self.updates += 1;
        Ok(Linearised {
            reaction,
            tangent,
            settled: true,
            outcome: Outcome::Converged,
        })
    }

    fn summary(&self) -> FilmSummary {
        let Some((state, reaction)) = &self.last else {
            return FilmSummary::default();
        };
        let frame = Frame::LineOfCentres;
        let local = self.local(&frame.to_grid(state, frame.turn(state)));
        let psi = self.clearance / self.radius;
        let peak = self.sum(&local, true).peak * self.viscosity / (psi * psi);
        let narrowest = self.narrowest(state);
        let edge = |z: f64| {
            let [x, y] = state.centre_at(z);
            self.clearance - x.hypot(y)
        };
        let (force, moment) = (reaction.film_force, reaction.film_moment);
        let of = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        FilmSummary {
            minimum_film_thickness: narrowest,
            edge_film_thickness: [edge(-0.5 * self.width), edge(0.5 * self.width)],
            peak_film_pressure: Extreme {
                value: peak,
                ..narrowest
            },
            friction_power: reaction.friction_torque_journal
                * (state.journal_speed - state.shell_speed),
            squeeze_power: -of(force, state.velocity) - of(moment, state.tilt_rate),
            iterations: self.updates,
            ..FilmSummary::default()
        }
    }

    fn accept_step(&mut self) {
        self.updates = 0;
    }

    fn reject_step(&mut self) {
        self.updates = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_the_inverse_gap_is_its_integral() {
        for (centre, tilt) in [
            ([0.5, 0.2], [0.3, -0.1]),
            ([0.8, 0.0], [0.1, 0.3]),
            ([0.0, 0.0], [0.6, 0.0]),
            ([0.3, 0.1], [1e-9, 0.0]),
        ] {
            let count = 20_000;
            let mut sum = 0.0;
            for k in 0..count {
                let z = -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(count);
                let [x, y] = [centre[0] + z * tilt[0], centre[1] + z * tilt[1]];
                sum += TAU / (1.0 - x * x - y * y).sqrt() / f64::from(count);
            }
            let found = mean_inverse_gap(centre, tilt);
            assert!((found / sum - 1.0).abs() < 1e-7, "{found} {sum}");
        }
    }
}
