//! The balance of a film recomputed in SI from what the solver wrote: pressure, film fraction, grid,
//! journal state. Nothing of the solver's own equations is used here.

use sommerfeld_film::{
    Bearing, Carrier, Ends, FeedShape, FilmField, FilmShear, FilmSolver, JournalState,
};
use std::f64::consts::TAU;

/// Whether a feed's pressure holds up to the faces of its cells, or in the middle of its cells.
pub const FEEDS_HOLD_TO_EDGES: bool = true;

/// How the content of the film changes.
#[derive(Clone, Copy)]
pub enum Past<'a> {
    /// By the velocities of the state alone.
    None,
    /// From a content `theta h` per cell (m) within a time (s).
    Content { old: &'a [f64], duration: f64 },
}

/// What the fields amount to.
#[derive(Default)]
pub struct Recomputed {
    /// p < p_cav, theta < 0, theta > 1, or p > p_cav with theta < 1: how many cells.
    pub violations: usize,
    /// Cells that are ruptured, and that are fed.
    pub ruptured: usize,
    pub fed: usize,
    /// Largest imbalance of a cell whose film must balance, m3/s.
    pub worst_cell: f64,
    /// Largest flow through a face or into a cell's store, m3/s.
    pub largest_flow: f64,
    /// Through each feed into the film, m3/s.
    pub feed_flows: Vec<f64>,
    /// Leaving at both ends, m3/s.
    pub side_flow: [f64; 2],
    /// Growth of the content, m3/s.
    pub growth: f64,
    /// eta U^2/h over the lands, W.
    pub shear_loss: f64,
    /// h^3/(12 eta) |grad p|^2, W.
    pub pressure_loss: f64,
    /// Pressure above p_cav times flow: out at the ends less in at the feeds, W.
    pub boundary_work: f64,
    /// Pressure above p_cav of a full film on what is missing in the oil that reaches it, W.
    pub reformation_loss: f64,
    /// Content `theta h` per cell, m.
    pub content: Vec<f64>,
}

/// Offset of one surface outward of its circle, m, at an angle of the frame and an axial position, m.
pub type Offset<'a> = &'a dyn Fn(f64, f64) -> f64;

/// How far both surfaces stand outward of their circles.
#[derive(Clone, Copy)]
pub struct Offsets<'a> {
    pub bore: Offset<'a>,
    pub journal: Offset<'a>,
}

impl Offsets<'_> {
    fn widening(&self, angle: f64, z: f64) -> f64 {
        (self.bore)(angle, z) - (self.journal)(angle, z)
    }
}

/// Gauss-Legendre over an interval: mean of `value`, six places.
fn mean_of([a, b]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    let nodes = [
        (0.238_619_186_083_196_9, 0.467_913_934_572_691),
        (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
        (0.932_469_514_203_152, 0.171_324_492_379_170_4),
    ];
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let pair = |(x, w): (f64, f64)| w * (value(middle - x * half) + value(middle + x * half));
    0.5 * nodes.into_iter().map(pair).sum::<f64>()
}

struct Film<'a> {
    bearing: &'a Bearing,
    offsets: Offsets<'a>,
    state: &'a JournalState,
    viscosity: f64,
    angles: &'a [f64],
    places: Vec<f64>,
    field: FilmField<'a>,
    conserves_mass: bool,
    feeds: Vec<Option<usize>>,
}

/// `amplitude . (cos, sin)` of the journal centre at z, for a position and tilt or their rates.
fn along(centre: [f64; 2], tilt: [f64; 2], z: f64, [cos, sin]: [f64; 2]) -> f64 {
    (centre[0] + tilt[1] * z) * cos + (centre[1] - tilt[0] * z) * sin
}

impl Film<'_> {
    fn thickness(&self, angle: f64, z: f64) -> f64 {
        let direction = [angle.cos(), angle.sin()];
        self.bearing.radial_clearance - along(self.state.position, self.state.tilt, z, direction)
            + self.offsets.widening(angle, z)
    }

    /// Mean of cos and sin over station i.
    fn mean_direction(&self, i: usize) -> [f64; 2] {
        let (a, b) = (self.angles[i], self.angles[i + 1]);
        // sin b - sin a = 2 cos((a + b)/2) sin((b - a)/2)
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        [
            middle.cos() * half.sin() / half,
            middle.sin() * half.sin() / half,
        ]
    }

    fn mean_thickness(&self, i: usize, j: usize) -> f64 {
        let z = 0.5 * (self.places[j] + self.places[j + 1]);
        self.bearing.radial_clearance
            - along(
                self.state.position,
                self.state.tilt,
                z,
                self.mean_direction(i),
            )
            + mean_of([self.angles[i], self.angles[i + 1]], |angle| {
                self.offsets.widening(angle, z)
            })
    }

    fn mean_rate(&self, i: usize, j: usize) -> f64 {
        let z = 0.5 * (self.places[j] + self.places[j + 1]);
        let [from, to] = [self.angles[i], self.angles[i + 1]];
        // A profile that turns falls by its slope times its speed.
        let falls = |offset: Offset<'_>| (offset(to, z) - offset(from, z)) / (to - from);
        self.state.journal_speed * falls(self.offsets.journal)
            - self.state.shell_speed * falls(self.offsets.bore)
            - along(
                self.state.velocity,
                self.state.tilt_rate,
                z,
                self.mean_direction(i),
            )
    }

    /// Growth of a full film in cell (i, j) without a past, m3/s. What a ruptured one gains where the
    /// gap closes is bounded by what the surfaces drag out of the cell within one radian.
    fn steady_growth(&self, i: usize, j: usize, area: f64, ruptured: bool) -> f64 {
        let growth = self.mean_rate(i, j) * area;
        if !ruptured || !self.conserves_mass {
            return growth;
        }
        let radius = 0.5 * self.bearing.diameter;
        let dragged = 0.5 * radius * (self.state.journal_speed + self.state.shell_speed);
        let z = 0.5 * (self.places[j] + self.places[j + 1]);
        let leaves_at = if dragged > 0.0 { i + 1 } else { i };
        let width = self.places[j + 1] - self.places[j];
        let outflow = dragged.abs() * self.thickness(self.angles[leaves_at], z) * width;
        growth.max(-outflow * (self.angles[i + 1] - self.angles[i]))
    }

    fn pressure(&self, k: usize) -> f64 {
        self.field.pressure[k] - self.bearing.cavitation_pressure
    }

    /// The feed that covers the centre of cell (i, j).
    fn feed_at(&self, i: usize, j: usize) -> Option<usize> {
        let angle = 0.5 * (self.angles[i] + self.angles[i + 1]);
        let z = 0.5 * (self.places[j] + self.places[j + 1]);
        self.bearing.feeds.iter().position(|feed| {
            let turned = match feed.carried_by {
                Carrier::Shell => self.state.shell_angle,
                Carrier::Journal => self.state.journal_angle,
            };
            let mut apart = (angle - feed.angle - turned).rem_euclid(TAU);
            if apart > 0.5 * TAU {
                apart -= TAU;
            }
            let (s, z) = (0.5 * self.bearing.diameter * apart, z - feed.position);
            match feed.shape {
                FeedShape::Hole { diameter } => s * s + z * z <= 0.25 * diameter * diameter,
                FeedShape::Rectangle { length, width } => {
                    2.0 * s.abs() <= length && 2.0 * z.abs() <= width
                }
                FeedShape::Circumferential { width } => 2.0 * z.abs() <= width,
            }
        })
    }

    /// Distance between what cells `a` and `b` of widths `widths` say of the pressure.
    fn distance(&self, [a, b]: [usize; 2], widths: [f64; 2]) -> f64 {
        let fed = [self.feeds[a].is_some(), self.feeds[b].is_some()];
        match (FEEDS_HOLD_TO_EDGES, fed) {
            (true, [true, false]) => 0.5 * widths[1],
            (true, [false, true]) => 0.5 * widths[0],
            _ => 0.5 * (widths[0] + widths[1]),
        }
    }

    fn is_ruptured(&self, k: usize) -> bool {
        if self.conserves_mass {
            self.field.film_fraction[k] < 1.0
        } else {
            self.pressure(k) <= 0.0
        }
    }
}

/// Recomputes the balance of the film as last solved, periodic around, at a constant viscosity.
pub fn recompute(
    solver: &FilmSolver,
    state: &JournalState,
    viscosity: f64,
    conserves_mass: bool,
    past: Past<'_>,
) -> Recomputed {
    let round = Offsets {
        bore: &|_, _| 0.0,
        journal: &|_, _| 0.0,
    };
    recompute_shaped(solver, state, viscosity, conserves_mass, past, round)
}

/// The same for surfaces that are no cylinders.
pub fn recompute_shaped(
    solver: &FilmSolver,
    state: &JournalState,
    viscosity: f64,
    conserves_mass: bool,
    past: Past<'_>,
    offsets: Offsets<'_>,
) -> Recomputed {
    let bearing = solver.bearing();
    let radius = 0.5 * bearing.diameter;
    let grid = solver.grid();
    let field = sommerfeld_film::FilmForce::field(solver).unwrap();
    let (n, m) = (field.angles.len(), field.axial.len());
    let mut film = Film {
        bearing,
        offsets,
        state,
        viscosity,
        angles: &grid.around_faces,
        places: grid.axial_faces.iter().map(|z| z * radius).collect(),
        field,
        conserves_mass,
        feeds: Vec::new(),
    };
    film.feeds = (0..n * m).map(|k| film.feed_at(k / m, k % m)).collect();

    let mut sum = Recomputed {
        feed_flows: vec![0.0; bearing.feeds.len()],
        ..Recomputed::default()
    };
    let mut excess = vec![0.0; n * m];
    flows_around(&film, &mut excess, &mut sum);
    flows_along(&film, &mut excess, &mut sum);
    let sliding = radius * (state.journal_speed - state.shell_speed);
    for i in 0..n {
        for j in 0..m {
            let k = i * m + j;
            let (p, theta) = (film.pressure(k), field.film_fraction[k]);
            let broken = p < 0.0 || !(0.0..=1.0).contains(&theta) || (p > 0.0 && theta < 1.0);
            sum.violations += usize::from(broken);

            let area = radius
                * (film.angles[i + 1] - film.angles[i])
                * (film.places[j + 1] - film.places[j]);
            let thickness = film.mean_thickness(i, j);
            assert!((field.film_thickness[k] / thickness - 1.0).abs() < 1e-12);
            let content = if conserves_mass { theta } else { 1.0 } * thickness;
            sum.content.push(content);
            let growth = match past {
                Past::Content { old, duration } => {
                    if !film.is_ruptured(k) {
                        // The squeeze of the missing part did no work on the film.
                        let full_before = thickness - film.mean_rate(i, j) * duration;
                        sum.reformation_loss += p * area * (full_before - old[k]) / duration;
                    }
                    (content - old[k]) / duration * area
                }
                Past::None => theta * film.steady_growth(i, j, area, film.is_ruptured(k)),
            };
            sum.growth += growth;
            sum.largest_flow = sum.largest_flow.max(growth.abs());
            excess[k] -= growth;

            if let Some(feed) = film.feeds[k] {
                sum.fed += 1;
                sum.feed_flows[feed] -= excess[k];
                sum.boundary_work += p * excess[k];
                continue;
            }
            let share = match bearing.film_shear {
                FilmShear::FullWidth => 1.0,
                // The film fraction belongs to the gap at the face it drains through.
                FilmShear::FilmFraction if theta < 1.0 => {
                    let speed = state.journal_speed + state.shell_speed;
                    let face = if speed > 0.0 { i + 1 } else { i };
                    let z = 0.5 * (film.places[j] + film.places[j + 1]);
                    let drained = film.thickness(film.angles[face], z);
                    let drained = if speed == 0.0 { thickness } else { drained };
                    (theta * drained / thickness).min(1.0)
                }
                FilmShear::FilmFraction => theta,
            };
            sum.shear_loss += share * viscosity * sliding * sliding / thickness * area;
            sum.ruptured += usize::from(film.is_ruptured(k));
            if conserves_mass || !film.is_ruptured(k) {
                sum.worst_cell = sum.worst_cell.max(excess[k].abs());
            }
        }
    }
    sum
}

fn flows_around(film: &Film<'_>, excess: &mut [f64], sum: &mut Recomputed) {
    let (n, m) = (film.field.angles.len(), film.field.axial.len());
    let radius = 0.5 * film.bearing.diameter;
    let dragged = 0.5 * radius * (film.state.journal_speed + film.state.shell_speed);
    let width_around = |i: usize| radius * (film.angles[i + 1] - film.angles[i]);
    for i in 0..n {
        // The face before station i.
        let before = (i + n - 1) % n;
        for j in 0..m {
            let z = 0.5 * (film.places[j] + film.places[j + 1]);
            let width = film.places[j + 1] - film.places[j];
            let h = film.thickness(film.angles[i], z);
            let (west, east) = (before * m + j, i * m + j);
            let distance = film.distance([west, east], [width_around(before), width_around(i)]);
            let drop = film.pressure(west) - film.pressure(east);
            let conducted = h.powi(3) / (12.0 * film.viscosity) * drop / distance * width;
            let (upstream, downstream) = if dragged > 0.0 {
                (west, east)
            } else {
                (east, west)
            };
            let theta = film.field.film_fraction[upstream];
            let flow = conducted + dragged * theta * h * width;
            sum.largest_flow = sum.largest_flow.max(flow.abs());
            excess[west] -= flow;
            excess[east] += flow;
            sum.pressure_loss += conducted * drop;
            sum.reformation_loss +=
                film.pressure(downstream) * dragged.abs() * h * width * (1.0 - theta);
        }
    }
}

fn flows_along(film: &Film<'_>, excess: &mut [f64], sum: &mut Recomputed) {
    let (n, m) = (film.field.angles.len(), film.field.axial.len());
    let radius = 0.5 * film.bearing.diameter;
    let width_along = |j: usize| film.places[j + 1] - film.places[j];
    let ambient = film.bearing.ambient_pressure - film.bearing.cavitation_pressure;
    for i in 0..n {
        let middle = 0.5 * (film.angles[i] + film.angles[i + 1]);
        let width = radius * (film.angles[i + 1] - film.angles[i]);
        let conductance =
            |z: f64| film.thickness(middle, z).powi(3) / (12.0 * film.viscosity) * width;
        for j in 1..m {
            let (south, north) = (i * m + j - 1, i * m + j);
            let distance = film.distance([south, north], [width_along(j - 1), width_along(j)]);
            let drop = film.pressure(south) - film.pressure(north);
            let flow = conductance(film.places[j]) * drop / distance;
            sum.largest_flow = sum.largest_flow.max(flow.abs());
            excess[south] -= flow;
            excess[north] += flow;
            sum.pressure_loss += flow * drop;
        }
        for (end, j, face) in [(0, 0, 0), (1, m - 1, m)] {
            let k = i * m + j;
            let drop = film.pressure(k) - ambient;
            let drop = match film.bearing.ends {
                Ends::Air => drop.max(0.0),
                Ends::Flooded => drop,
            };
            let flow = conductance(film.places[face]) * drop / (0.5 * width_along(j));
            sum.largest_flow = sum.largest_flow.max(flow.abs());
            excess[k] -= flow;
            sum.side_flow[end] += flow;
            sum.pressure_loss += flow * drop;
            sum.boundary_work += flow * ambient;
        }
    }
}
