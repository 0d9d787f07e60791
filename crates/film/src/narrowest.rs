//! Where is the gap smallest, and how small is it there?
//!
//! Between cylinders it lies at an edge of the straight journal axis. With profiles the whole surface
//! is searched: it is divided into patches between the kinks of both surfaces, inside which the gap
//! is smooth. The patch with the least corner is followed down to its minimum, and so is every other
//! whose gap could be smaller, by the bound
//!
//! ```text
//! h >= least corner - (M_angle d_angle^2 + M_z d_z^2)/8 - bend d_angle/4
//! ```
//! with bounds M of the second derivatives. Patches that could still hold a smaller gap are divided
//! until they cannot: nothing is missed. `bend` is the change of slope at kinks that turn through the
//! patches. Nothing is allocated after the search is made.

use crate::bearing::Bearing;
use crate::journal_state::JournalState;
use std::f64::consts::TAU;

/// Stations around at least.
const STATIONS: usize = 96;
/// Stations around at most; finer waves are found by dividing.
const MOST_STATIONS: usize = 2048;
/// Pieces along the axis between kinks.
const PIECES: usize = 3;
/// The gap is the smallest within this share of the clearance.
const CERTAINTY: f64 = 1e-6;
/// Patches looked at beyond the first round; a valley as narrow along its whole length needs many.
const MOST_PATCHES: usize = 4000;

/// The smallest gap with its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Narrowest {
    /// Gap, m; negative where the surfaces overlap.
    pub gap: f64,
    /// Angle from +X of the shell frame, rad.
    pub angle: f64,
    /// Axial position from the mid-plane, m.
    pub axial: f64,
}

/// The search of one bearing: what does not depend on the journal's place.
#[derive(Debug, Clone, PartialEq)]
pub struct GapSearch {
    /// Angles of the bore that bound the patches, rad, from 0 to a whole turn; none for cylinders.
    stations: Vec<Station>,
    /// Axial positions that bound the patches, m.
    positions: Vec<f64>,
    /// Axial share of bore less journal at `positions`, m.
    along: Vec<f64>,
    /// Tabled share of the bore, all positions of a station first, m; empty without a table.
    tabled: Vec<f64>,
    /// Bound of both profiles' second derivative by angle, m/rad2.
    curvature_around: f64,
    /// The same by z between two positions, 1/m.
    curvature_along: Vec<f64>,
    /// Change of slope at kinks of the journal, m/rad.
    bend: f64,
    /// Where along an aligned journal the gap is smallest, m, and the axial share there, m: the same
    /// at all angles, unless a table differs in both directions.
    aligned: Option<[f64; 2]>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Station {
    angle: f64,
    direction: [f64; 2],
    /// Angular share of the bore just before and behind, m.
    bore: [f64; 2],
}

/// Part of the surface: two angles of the bore, two axial positions.
#[derive(Debug, Clone, Copy)]
struct Patch {
    around: [f64; 2],
    along: [f64; 2],
    /// Bound of the gap's second derivative by z, 1/m.
    curvature_along: f64,
}

impl GapSearch {
    /// The search of `bearing`.
    #[must_use]
    pub fn of(bearing: &Bearing) -> Self {
        let (bore, journal) = (&bearing.bore, &bearing.journal);
        let half = 0.5 * bearing.width;
        let varies_along = bore.varies_along() || journal.varies_along();
        let mut search = Self {
            stations: Vec::new(),
            positions: vec![-half, half],
            along: vec![0.0; 2],
            tabled: Vec::new(),
            curvature_around: 0.0,
            curvature_along: vec![0.0],
            bend: journal.bend(),
            aligned: Some([0.0; 2]),
        };
        if bore.is_cylindrical() && journal.is_cylindrical() {
            return search;
        }
        let bound = |z: f64, axis: usize| {
            bore.curvature_bounds(z)[axis] + journal.curvature_bounds(z)[axis]
        };
        search.curvature_around = bound(0.0, 0);
        search.stations = stations(bearing);
        if varies_along {
            search.positions = positions(bearing);
            let pieces = search.positions.windows(2);
            search.curvature_along = pieces.map(|p| bound(0.5 * (p[0] + p[1]), 1)).collect();
        }
        let share = |z: &f64| bore.along(*z) - journal.along(*z);
        search.along = search.positions.iter().map(share).collect();
        if varies_along {
            search.aligned = search.narrowest_along(bearing);
        }
        if bore.tables().next().is_some() {
            for station in &search.stations {
                let at = |z: &f64| bore.tabled(station.angle, *z);
                search.tabled.extend(search.positions.iter().map(at));
            }
        }
        search
    }

    fn narrowest_along(&self, bearing: &Bearing) -> Option<[f64; 2]> {
        let (bore, journal) = (&bearing.bore, &bearing.journal);
        let mut tables = bore.tables().chain(journal.tables());
        if tables.any(|table| table.varies_along()) {
            return None;
        }
        let share = |z: f64| bore.along(z) - journal.along(z);
        let slope = |z: f64| bore.gradient(0.0, z)[1] - journal.gradient(0.0, z)[1];
        // Of places alike, the mid-plane is named.
        let middle = [0.0, share(0.0)];
        let least = self.positions.windows(2).fold(middle, |least, piece| {
            let z = lowest([piece[0], piece[1]], share, slope);
            let found = share(z);
            if found < least[1] { [z, found] } else { least }
        });
        Some(least)
    }

    /// The narrowest place of `bearing`, which the search was made of.
    #[must_use]
    pub fn narrowest(&self, bearing: &Bearing, state: &JournalState) -> Narrowest {
        if self.stations.is_empty() {
            return between_cylinders(bearing, state);
        }
        let along = if self.aligned.is_none() || state.tilt != [0.0; 2] {
            0..self.positions.len()
        } else {
            0..0
        };
        let mut descent = self.descent(bearing, state);
        let mut best: Option<(Patch, f64)> = None;
        self.patches(&descent, along.clone(), |patch, lowest| {
            if best.is_none_or(|(_, least)| lowest < least) {
                best = Some((patch, lowest));
            }
        });
        if let Some((patch, _)) = best {
            descent.follow_down(patch);
        }
        let start = descent;
        // First the minima of all that may be lower, then the proof that nothing else is.
        for divides in [false, true] {
            self.patches(&start, along.clone(), |patch, lowest| {
                if lowest - start.largest_dip(patch) >= descent.least.gap - descent.tolerance() {
                    return;
                }
                if divides {
                    descent.divide(patch, 24);
                } else {
                    descent.follow_down(patch);
                }
            });
        }
        let mut least = descent.least;
        least.angle = (least.angle + state.shell_angle).rem_euclid(TAU);
        least
    }

    /// Smallest gap of `bearing` at the front edge (z = -B/2) and at the rear edge (z = +B/2), m.
    #[must_use]
    pub fn at_edges(&self, bearing: &Bearing, state: &JournalState) -> [f64; 2] {
        [-0.5, 0.5].map(|side| {
            let z = side * bearing.width;
            if self.stations.is_empty() {
                let [x, y] = state.centre_at(z);
                return bearing.radial_clearance - x.hypot(y);
            }
            let mut descent = self.descent(bearing, state);
            let arcs = self.stations.windows(2).map(|pair| Patch {
                around: [pair[0].angle, pair[1].angle],
                along: [z; 2],
                curvature_along: 0.0,
            });
            let lowest = |patch: &Patch| descent.lowest_corner(*patch);
            if let Some(best) = arcs.clone().min_by(|a, b| lowest(a).total_cmp(&lowest(b))) {
                descent.follow_down(best);
            }
            for arc in arcs {
                descent.divide(arc, 24);
            }
            descent.least.gap
        })
    }

    fn descent<'a>(&self, bearing: &'a Bearing, state: &'a JournalState) -> Descent<'a> {
        let reach = [self.positions[0], self.positions[self.positions.len() - 1]]
            .map(|z| {
                let [x, y] = state.centre_at(z);
                x.hypot(y)
            })
            .into_iter()
            .fold(0.0, f64::max);
        Descent {
            bearing,
            state,
            turned: state.shell_angle,
            curvature: self.curvature_around + reach,
            bend: self.bend,
            least: Narrowest {
                gap: f64::INFINITY,
                angle: 0.0,
                axial: 0.0,
            },
            patches_left: MOST_PATCHES,
        }
    }

    /// Visits every patch with its lowest corner; with no position given, the one of an aligned
    /// journal alone.
    fn patches(
        &self,
        film: &Descent<'_>,
        along: std::ops::Range<usize>,
        mut visit: impl FnMut(Patch, f64),
    ) {
        let mut journal_before = film.journal_around(self.stations[0].angle);
        for (s, pair) in self.stations.windows(2).enumerate() {
            let journal_behind = film.journal_around(pair[1].angle);
            let sides = [
                (s, pair[0], pair[0].bore[1] - journal_before),
                (s + 1, pair[1], pair[1].bore[0] - journal_behind),
            ];
            journal_before = journal_behind;
            let around = [pair[0].angle, pair[1].angle];
            let lowest = |k: usize, z: f64, share: f64| {
                let heights = sides.map(|(index, station, own)| {
                    let bore = self.tabled.get(index * self.positions.len() + k);
                    let angle = film.on_journal(station.angle);
                    film.height(&station, z) + own + share + bore.copied().unwrap_or(0.0)
                        - film.bearing.journal.tabled(angle, z)
                });
                heights[0].min(heights[1])
            };
            if let ([z, share], true) = (self.aligned.unwrap_or_default(), along.is_empty()) {
                let patch = Patch {
                    around,
                    along: [z; 2],
                    curvature_along: 0.0,
                };
                // Tables are alike all along: any of their positions will do.
                visit(patch, lowest(0, z, share));
                continue;
            }
            let edge = |k: usize| lowest(k, self.positions[k], self.along[k]);
            let mut before = edge(along.start);
            for k in along.start + 1..along.end {
                let behind = edge(k);
                let patch = Patch {
                    around,
                    along: [self.positions[k - 1], self.positions[k]],
                    curvature_along: self.curvature_along[k - 1],
                };
                visit(patch, before.min(behind));
                before = behind;
            }
        }
    }
}

/// Smallest gap between cylinders.
fn between_cylinders(bearing: &Bearing, state: &JournalState) -> Narrowest {
    let at = |z: f64| {
        let [x, y] = state.centre_at(z);
        Narrowest {
            gap: bearing.radial_clearance - x.hypot(y),
            angle: y.atan2(x),
            axial: z,
        }
    };
    let half = 0.5 * bearing.width;
    // Along an aligned journal all places are alike: the mid-plane is named.
    [at(-half), at(half)].into_iter().fold(at(0.0), lesser)
}

fn lesser(a: Narrowest, b: Narrowest) -> Narrowest {
    if b.gap < a.gap { b } else { a }
}

fn stations(bearing: &Bearing) -> Vec<Station> {
    const NEAR: f64 = 1e-9;
    let resolution = bearing.bore.resolution().max(bearing.journal.resolution());
    let count = resolution.clamp(STATIONS, MOST_STATIONS);
    let mut angles: Vec<f64> = (0..=count).map(|i| TAU * i as f64 / count as f64).collect();
    angles.extend(bearing.bore.kinks_around());
    angles.sort_by(f64::total_cmp);
    let mut kept: Vec<Station> = Vec::new();
    for angle in angles {
        if kept.last().is_some_and(|last| angle - last.angle < NEAR) {
            continue;
        }
        kept.push(Station {
            angle,
            direction: [angle.cos(), angle.sin()],
            bore: [-NEAR, NEAR].map(|side| bearing.bore.around(angle + side)),
        });
    }
    kept
}

/// Bounds along the axis: ends, kinks and nodes of tables, each stretch in pieces.
fn positions(bearing: &Bearing) -> Vec<f64> {
    let half = 0.5 * bearing.width;
    let shapes = [&bearing.bore, &bearing.journal];
    let mut edges: Vec<f64> = shapes.iter().flat_map(|s| s.kinks_along()).collect();
    for table in shapes.iter().flat_map(|shape| shape.tables()) {
        edges.extend(table.positions());
    }
    edges.push(0.0);
    let near = 1e-9 * bearing.width;
    edges.retain(|z| z.abs() < half - near);
    edges.extend([-half, half]);
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|a, b| (*a - *b).abs() <= near);
    let pieces = if edges.len() > 12 { 1 } else { PIECES };
    let mut positions = vec![-half];
    for pair in edges.windows(2) {
        let step = (pair[1] - pair[0]) / pieces as f64;
        positions.extend((1..pieces).map(|i| pair[0] + i as f64 * step));
        positions.push(pair[1]);
    }
    positions
}

/// A search under way, in angles of the bore.
#[derive(Debug, Clone, Copy)]
struct Descent<'a> {
    bearing: &'a Bearing,
    state: &'a JournalState,
    turned: f64,
    /// Bound of the gap's second derivative by angle, m/rad2.
    curvature: f64,
    bend: f64,
    least: Narrowest,
    patches_left: usize,
}

impl Descent<'_> {
    fn tolerance(&self) -> f64 {
        CERTAINTY * self.bearing.radial_clearance
    }

    /// The journal's own angle where the bore's is `angle`.
    fn on_journal(&self, angle: f64) -> f64 {
        angle + self.turned - self.state.journal_angle
    }

    fn journal_around(&self, angle: f64) -> f64 {
        self.bearing.journal.around(self.on_journal(angle))
    }

    /// Gap of the cylinders at a station.
    fn height(&self, station: &Station, z: f64) -> f64 {
        let [cos, sin] = station.direction;
        let [x, y] = self.centre(z);
        self.bearing.radial_clearance - x * cos - y * sin
    }

    /// Journal centre at z in the frame that turned with the bore.
    fn centre(&self, z: f64) -> [f64; 2] {
        let [x, y] = self.state.centre_at(z);
        if self.turned == 0.0 {
            return [x, y];
        }
        let (sin, cos) = self.turned.sin_cos();
        [cos * x + sin * y, cos * y - sin * x]
    }

    fn gap(&self, angle: f64, z: f64) -> f64 {
        let [x, y] = self.centre(z);
        let (sin, cos) = angle.sin_cos();
        self.bearing.radial_clearance - x * cos - y * sin + self.bearing.bore.offset(angle, z)
            - self.bearing.journal.offset(self.on_journal(angle), z)
    }

    /// Derivatives of the gap by angle and by z.
    fn gradient(&self, angle: f64, z: f64) -> [f64; 2] {
        let [x, y] = self.centre(z);
        let ([x1, y1], [x0, y0]) = (self.centre(1.0), self.centre(0.0));
        let (sin, cos) = angle.sin_cos();
        let bore = self.bearing.bore.gradient(angle, z);
        let journal = self.bearing.journal.gradient(self.on_journal(angle), z);
        [
            x * sin - y * cos + bore[0] - journal[0],
            -(x1 - x0) * cos - (y1 - y0) * sin + bore[1] - journal[1],
        ]
    }

    /// How far below its lowest corner the gap of a patch can lie, m.
    fn largest_dip(&self, patch: Patch) -> f64 {
        let [d_angle, d_z] = [patch.around, patch.along].map(|[a, b]| b - a);
        let smooth = self.curvature * d_angle * d_angle + patch.curvature_along * d_z * d_z;
        0.125 * smooth + 0.25 * self.bend * d_angle
    }

    /// Follows the gap of a patch down to its minimum, by its derivatives.
    fn follow_down(&mut self, patch: Patch) {
        // Just inside, so that a step at the edge is not crossed.
        let inside = 1e-9 * (patch.around[1] - patch.around[0]);
        let around = [patch.around[0] + inside, patch.around[1] - inside];
        let along = |film: &Self, angle: f64| {
            lowest(
                patch.along,
                |z| film.gap(angle, z),
                |z| film.gradient(angle, z)[1],
            )
        };
        let film = *self;
        let angle = lowest(
            around,
            |angle| film.gap(angle, along(&film, angle)),
            |angle| film.gradient(angle, along(&film, angle))[0],
        );
        let axial = along(&film, angle);
        let gap = self.gap(angle, axial);
        self.least = lesser(self.least, Narrowest { gap, angle, axial });
    }

    fn lowest_corner(&self, patch: Patch) -> f64 {
        let inside = 1e-9 * (patch.around[1] - patch.around[0]);
        [patch.around[0] + inside, patch.around[1] - inside]
            .into_iter()
            .flat_map(|angle| patch.along.map(|z| self.gap(angle, z)))
            .fold(f64::INFINITY, f64::min)
    }

    /// Divides a patch until its gap cannot be smaller than the least one known.
    fn divide(&mut self, patch: Patch, depth: usize) {
        if self.patches_left == 0 {
            return;
        }
        self.patches_left -= 1;
        let lowest = self.lowest_corner(patch);
        if lowest < self.least.gap {
            self.follow_down(patch);
        }
        let dip = self.largest_dip(patch);
        if depth == 0 || lowest - dip >= self.least.gap - self.tolerance() {
            return;
        }
        let [d_angle, d_z] = [patch.around, patch.along].map(|[a, b]| b - a);
        let of_angle = 0.125 * self.curvature * d_angle * d_angle + 0.25 * self.bend * d_angle;
        let halves = |[a, b]: [f64; 2]| [[a, 0.5 * (a + b)], [0.5 * (a + b), b]];
        if of_angle >= 0.5 * dip || d_z == 0.0 {
            for around in halves(patch.around) {
                self.divide(Patch { around, ..patch }, depth - 1);
            }
        } else {
            for along in halves(patch.along) {
                self.divide(Patch { along, ..patch }, depth - 1);
            }
        }
    }
}

/// Place of the smallest value between two places: the root of the derivative, by false position
/// with Dowell and Jarratt's halving (the Illinois rule); the better end where the derivative does
/// not rise through zero.
fn lowest([from, to]: [f64; 2], value: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> f64 {
    const ITERATIONS: usize = 60;
    /// Share of the stretch that a place is found to.
    const NEAR: f64 = 1e-12;
    if from == to {
        return from;
    }
    let (mut low, mut high) = ((from, slope(from)), (to, slope(to)));
    match (low.1 < 0.0, high.1 > 0.0) {
        (true, true) => {}
        (false, true) => return from,
        (true, false) => return to,
        (false, false) => return if value(from) < value(to) { from } else { to },
    }
    let near = NEAR * (to - from);
    let mut place = from;
    for _ in 0..ITERATIONS {
        let before = place;
        place = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let rises = slope(place);
        if rises == 0.0 || (place - before).abs() < near || high.0 - low.0 < near {
            break;
        }
        if rises < 0.0 {
            // The end that stays loses half its weight.
            if before == low.0 {
                high.1 *= 0.5;
            }
            low = (place, rises);
        } else {
            if before == high.0 {
                low.1 *= 0.5;
            }
            high = (place, rises);
        }
    }
    place
}

impl Bearing {
    /// The narrowest place of the gap for a journal state. Callers that ask often keep a
    /// [`GapSearch`].
    #[must_use]
    pub fn narrowest_gap(&self, state: &JournalState) -> Narrowest {
        GapSearch::of(self).narrowest(self, state)
    }

    /// Smallest gap between journal and bore, m; negative where they overlap.
    #[must_use]
    pub fn minimum_gap(&self, state: &JournalState) -> f64 {
        self.narrowest_gap(state).gap
    }

    /// Smallest gap at the front edge (z = -B/2) and at the rear edge (z = +B/2), m; negative where
    /// the surfaces overlap.
    #[must_use]
    pub fn edge_film_thickness(&self, state: &JournalState) -> [f64; 2] {
        GapSearch::of(self).at_edges(self, state)
    }

    /// The roomiest of the aligned positions tried for the journal, with its narrowest place: where
    /// its gap is not positive, the journal fits nowhere. The smallest gap is a concave function of
    /// the position, so that steps away from the narrowest place, ever shorter, lead to its top.
    #[must_use]
    pub fn roomiest_position(&self) -> ([f64; 2], Narrowest) {
        const STEPS: usize = 400;
        let search = GapSearch::of(self);
        let mut position = [0.0; 2];
        let narrowest = |position: [f64; 2]| {
            let state = JournalState {
                position,
                ..JournalState::default()
            };
            search.narrowest(self, &state)
        };
        let mut place = narrowest(position);
        let mut best = (position, place);
        let first = place.gap.abs().max(self.radial_clearance);
        for step in 1..=STEPS {
            if best.1.gap > 0.0 {
                break;
            }
            let length = first / step as f64;
            position[0] -= length * place.angle.cos();
            position[1] -= length * place.angle.sin();
            place = narrowest(position);
            if place.gap > best.1.gap {
                best = (position, place);
            }
        }
        best
    }
}
