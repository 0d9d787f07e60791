//! What has each point of shell and journal seen over a cycle?
//!
//! The orbit shows every output point of every cycle, and only its end tells which cycle was the
//! last: each new cycle starts the record anew. Held are the frames and the maps of
//! [`CycleFields`], whatever the number of crank angles.
//!
//! A point fixed on a surface at angle `a` lies at `a + turned` of the frame, `turned` the angle of
//! that surface. The maps keep the cell centres of the film's grid as the angles of their points; a
//! field is taken there by linear interpolation between cell centres, periodic around, so that a peak
//! between two centres is cut by at most the second difference of the field. A surface that
//! stands is not interpolated at all. A share of the cycle is a mean over output points, which are
//! evenly spaced; the indicator of a full film is interpolated like a field.
//!
//! Bearings that do the same later ([`Turn`]) have instants and a journal of their own; their shells
//! have seen the same.
//!
//! Wear is shared out over the cells of a surface ([`WearRecord`]), not interpolated: its volume counts.

use super::turn::Turn;
use crate::input::{BearingCase, CycleDuty};
use crate::results::{AccumulatedMap, CycleField, CycleFields, FieldSnapshot, SurfaceWear};
use crate::spool::FieldSpool;
use sommerfeld_bearing::wear::sliding_speed;
use sommerfeld_bearing::{CyclePoint, Progress, WearRecord};
use sommerfeld_film::{FilmField, Finish};
use std::f64::consts::TAU;

/// Fills [`CycleFields`] while an orbit runs, and the fields of every crank angle on the disk.
pub(super) struct FieldRecorder<'a> {
    /// Output points per cycle.
    points: usize,
    /// Evenly spaced instants that are kept of them, at most.
    frames: usize,
    /// Gauge pressure above which a full cell carries, Pa.
    cavitation_pressure: f64,
    /// Cycle of the record, and whether it holds the start of the run, which is no point of a
    /// periodic orbit and makes way for the first one.
    stage: (usize, bool),
    record: Option<Record>,
    spool: Option<&'a mut FieldSpool>,
    /// Bearings that do the same later.
    turns: &'a [Turn],
    wear: Option<WearWatch>,
}

/// How wear is recorded.
#[derive(Debug, Clone, Copy)]
struct WearWatch {
    /// Archard coefficient of the shell, 1/Pa.
    coefficient: f64,
    boundary_friction: f64,
    /// Radius of the bore, m.
    radius: f64,
    /// Time from one output point to the next, s.
    interval: f64,
}

/// The record of one cycle.
struct Record {
    frames: Vec<CycleField>,
    least_film: f64,
    worst: CycleField,
    /// Output point of the worst instant.
    worst_index: usize,
    on_shell: SurfaceRecord,
    on_journal: SurfaceRecord,
    turned: Vec<TurnedRecord>,
}

/// What a bearing that does the same later has of its own.
struct TurnedRecord {
    frames: Vec<CycleField>,
    on_journal: SurfaceRecord,
}

impl<'a> FieldRecorder<'a> {
    /// For cycles of so many output points, of which at most `frames` are kept; a full film carries
    /// above the cavitation pressure, Pa.
    pub(super) fn new(
        points: usize,
        frames: usize,
        cavitation_pressure: f64,
        spool: Option<&'a mut FieldSpool>,
    ) -> Self {
        Self {
            points,
            frames,
            cavitation_pressure,
            stage: (0, false),
            record: None,
            spool,
            turns: &[],
            wear: None,
        }
    }

    /// Records wear too, where the case asks for it and its surfaces touch.
    pub(super) fn with_wear(self, case: &BearingCase, duty: &CycleDuty) -> Self {
        let (Some(plan), Finish::Rough(rough)) = (&case.wear, &case.bearing.finish) else {
            return self;
        };
        let period = duty.cycle.period / duty.cycle.engine_speed;
        let wear = rough.contact.is_on().then(|| WearWatch {
            coefficient: plan.coefficient,
            boundary_friction: rough.boundary_friction,
            radius: case.bearing.radius(),
            interval: period / self.points as f64,
        });
        Self { wear, ..self }
    }

    /// Records also for bearings that do the same later.
    pub(super) fn with_turns(self, turns: &'a [Turn]) -> Self {
        Self { turns, ..self }
    }

    /// Takes one output point; `false` if the disk failed.
    pub(super) fn see(
        &mut self,
        progress: Progress,
        point: &CyclePoint,
        field: &FilmField<'_>,
    ) -> bool {
        let index = (progress.fraction * self.points as f64).round() as usize;
        let stage = (progress.cycle, index == 0);
        if stage != self.stage {
            self.stage = stage;
            self.record = None;
            if let Some(spool) = &mut self.spool {
                spool.restart();
            }
        }
        let snapshot = || CycleField {
            crank_angle: point.crank_angle,
            field: FieldSnapshot::from(*field),
        };
        let wear = self.wear;
        let record = self.record.get_or_insert_with(|| Record {
            frames: Vec::new(),
            least_film: f64::INFINITY,
            worst: snapshot(),
            worst_index: index,
            on_shell: SurfaceRecord::new(field, wear),
            on_journal: SurfaceRecord::new(field, wear),
            turned: self
                .turns
                .iter()
                .map(|_| TurnedRecord::new(field, wear))
                .collect(),
        });
        let thickness = point.summary.minimum_film_thickness.value;
        if thickness < record.least_film {
            record.least_film = thickness;
            record.worst = snapshot();
            record.worst_index = index;
        }
        if is_frame(index, self.points, self.frames) {
            record.frames.push(snapshot());
        }
        let least = self.cavitation_pressure;
        let sliding = wear.map_or(0.0, |wear| sliding_speed(wear.radius, &point.state));
        let instant = Instant { field, sliding };
        let turned = point.state.shell_angle;
        record.on_shell.see(&instant, turned, least);
        let turned = point.state.journal_angle;
        record.on_journal.see(&instant, turned, least);
        for (own, turn) in record.turned.iter_mut().zip(self.turns) {
            let index = turn.index(index);
            if is_frame(index, self.points, self.frames) {
                own.frames.push(CycleField {
                    crank_angle: turn.crank_angle(index),
                    ..snapshot()
                });
            }
            let turned = turn.journal_angle(index, turned);
            own.on_journal.see(&instant, turned, least);
        }
        match &mut self.spool {
            Some(spool) => spool.push(point.crank_angle, field),
            None => true,
        }
    }

    /// The fields of the last cycle, then those of each bearing that does the same later; none if the
    /// film showed none.
    pub(super) fn finish(self) -> Vec<CycleFields> {
        let Some(record) = self.record else {
            return Vec::new();
        };
        let (worst, worst_index) = (record.worst, record.worst_index);
        let on_shell = record.on_shell.finish(true);
        let turned = record.turned.into_iter().zip(self.turns);
        let turned = turned.map(|(mut own, turn)| {
            own.frames
                .sort_by(|a, b| a.crank_angle.total_cmp(&b.crank_angle));
            CycleFields {
                frames: own.frames,
                worst: CycleField {
                    crank_angle: turn.crank_angle(turn.index(worst_index)),
                    ..worst.clone()
                },
                on_shell: on_shell.clone(),
                on_journal: own.on_journal.finish(false),
            }
        });
        let turned: Vec<CycleFields> = turned.collect();
        let first = CycleFields {
            frames: record.frames,
            worst,
            on_shell,
            on_journal: record.on_journal.finish(false),
        };
        std::iter::once(first).chain(turned).collect()
    }
}

impl TurnedRecord {
    fn new(field: &FilmField<'_>, wear: Option<WearWatch>) -> Self {
        Self {
            frames: Vec::new(),
            on_journal: SurfaceRecord::new(field, wear),
        }
    }
}

/// Whether output point `index` of 1..=`points` is one of at most `most` evenly spaced frames; the
/// last is.
fn is_frame(index: usize, points: usize, most: usize) -> bool {
    let frames = points.min(most);
    let until = |index: usize| index * frames / points;
    index > 0 && until(index) > until(index - 1)
}

/// One output point as a surface sees it.
struct Instant<'a> {
    field: &'a FilmField<'a>,
    /// Sliding speed, m/s.
    sliding: f64,
}

/// What the points of one surface have seen so far.
struct SurfaceRecord {
    angles: Vec<f64>,
    axial: Vec<f64>,
    least_thickness: Vec<f64>,
    least_pressure: Vec<f64>,
    largest_pressure: Vec<f64>,
    /// Sum of the indicator of a full film.
    full: Vec<f64>,
    seen: usize,
    wear: Option<(WearWatch, WearRecord)>,
}

impl SurfaceRecord {
    fn new(field: &FilmField<'_>, wear: Option<WearWatch>) -> Self {
        let cells = field.pressure.len();
        Self {
            angles: field.angles.to_vec(),
            axial: field.axial.to_vec(),
            least_thickness: vec![f64::INFINITY; cells],
            least_pressure: vec![f64::INFINITY; cells],
            largest_pressure: vec![f64::NEG_INFINITY; cells],
            full: vec![0.0; cells],
            seen: 0,
            wear: wear.map(|wear| (wear, WearRecord::new(wear.radius, field))),
        }
    }

    /// Takes the fields of one instant at which the surface has turned by `turned`, rad.
    fn see(&mut self, instant: &Instant<'_>, turned: f64, cavitation_pressure: f64) {
        let Instant { field, sliding } = *instant;
        if let Some((wear, record)) = &mut self.wear {
            record.see(field, turned, sliding, wear.interval);
        }
        let along = self.axial.len();
        let is_full = |cell: usize| {
            let full =
                field.film_fraction[cell] >= 1.0 && field.pressure[cell] > cavitation_pressure;
            f64::from(u8::from(full))
        };
        for (i, angle) in self.angles.iter().enumerate() {
            let (from, to, share) = between(field.angles, angle + turned);
            let (from, to) = (from * along, to * along);
            for j in 0..along {
                let (a, b, point) = (from + j, to + j, i * along + j);
                let at = |values: &[f64]| values[a] + share * (values[b] - values[a]);
                let pressure = at(field.pressure);
                let thickness = at(field.film_thickness);
                self.least_thickness[point] = self.least_thickness[point].min(thickness);
                self.least_pressure[point] = self.least_pressure[point].min(pressure);
                self.largest_pressure[point] = self.largest_pressure[point].max(pressure);
                self.full[point] += is_full(a) + share * (is_full(b) - is_full(a));
            }
        }
        self.seen += 1;
    }

    /// The shell is the surface whose wear coefficient is given.
    fn finish(self, is_shell: bool) -> AccumulatedMap {
        let wear = self.wear.map(|(wear, record)| SurfaceWear {
            map: record.finish(),
            boundary_friction: wear.boundary_friction,
            coefficient: is_shell.then_some(wear.coefficient),
        });
        let seen = self.seen as f64;
        let extremes = self.largest_pressure.iter().zip(&self.least_pressure);
        AccumulatedMap {
            pressure_amplitude: extremes.map(|(high, low)| 0.5 * (high - low)).collect(),
            angles: self.angles,
            axial: self.axial,
            minimum_film_thickness: self.least_thickness,
            maximum_pressure: self.largest_pressure,
            full_film_share: self.full.iter().map(|full| full / seen).collect(),
            wear,
        }
    }
}

/// The two cells around whose centres an angle lies between, and its share of the way from the first
/// to the second. The centres ascend and span less than a turn.
fn between(centres: &[f64], angle: f64) -> (usize, usize, f64) {
    let first = centres[0];
    let angle = first + (angle - first).rem_euclid(TAU);
    let to = centres.partition_point(|centre| *centre <= angle);
    let from = to.max(1) - 1;
    let (next, end) = match centres.get(to) {
        Some(centre) => (to, *centre),
        None => (0, first + TAU),
    };
    let share = (angle - centres[from]) / (end - centres[from]);
    (from, next, share)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use crate::results::MOST_FRAMES;
    use sommerfeld_film::{FilmSummary, JournalState, Outcome, Reaction};

    const AROUND: usize = 96;
    const POINTS: usize = 360;
    const AXIAL: [f64; 2] = [-0.005, 0.005];

    /// Cell centres of an uneven grid, rad.
    fn angles() -> Vec<f64> {
        (0..AROUND)
            .map(|i| (i as f64 + 0.5) * TAU / AROUND as f64)
            .map(|angle| angle + 0.02 * (2.0 * angle).sin())
            .collect()
    }

    /// The record of a wave of pressure 1 + cos(angle - speed turned), seen degree by degree.
    fn run(speed: f64, journal_speed: f64, cycles: usize) -> CycleFields {
        let mut recorder = FieldRecorder::new(POINTS, MOST_FRAMES, 0.5, None);
        for cycle in 1..=cycles {
            for index in usize::from(cycle > 1)..=POINTS {
                let turned = (cycle - 1) as f64 * TAU + index as f64 * TAU / POINTS as f64;
                see(&mut recorder, cycle, index, turned, speed, journal_speed);
            }
        }
        recorder.finish().swap_remove(0)
    }

    fn see(
        recorder: &mut FieldRecorder,
        cycle: usize,
        index: usize,
        turned: f64,
        speed: f64,
        journal_speed: f64,
    ) {
        let angles = angles();
        let wave = |angle: &f64| 1.0 + (angle - speed * turned).cos();
        let pressure: Vec<f64> = angles.iter().flat_map(|a| [wave(a); 2]).collect();
        let thickness: Vec<f64> = pressure.iter().map(|p| 4.0 - p + 0.1 * turned).collect();
        let field = FilmField {
            angles: &angles,
            axial: &AXIAL,
            angle_widths: &[],
            axial_widths: &[],
            film_fraction: &vec![1.0; pressure.len()],
            pressure: &pressure,
            film_thickness: &thickness,
            temperature: &[],
            contact_pressure: &[],
        };
        let least = thickness.iter().copied().fold(f64::INFINITY, f64::min);
        let mut summary = FilmSummary::default();
        summary.minimum_film_thickness.value = least;
        let point = CyclePoint {
            crank_angle: turned,
            load: [0.0; 2],
            moment: [0.0; 2],
            state: JournalState {
                journal_angle: journal_speed * turned,
                ..JournalState::default()
            },
            reaction: Reaction::default(),
            summary,
            outcome: Outcome::Converged,
        };
        let fraction = index as f64 / POINTS as f64;
        recorder.see(Progress { cycle, fraction }, &point, &field);
    }

    fn assert_all(values: &[f64], expected: f64, bar: f64) {
        for value in values {
            assert!((value - expected).abs() <= bar, "{value} for {expected}");
        }
    }

    /// A pattern that turns with the journal tires the shell and leaves the journal at rest. The bar
    /// is twice what linear interpolation costs: an eighth of the spacing squared.
    #[test]
    fn a_pattern_fixed_on_the_journal_tires_only_the_shell() {
        let bar = 2.0 * (1.04 * TAU / AROUND as f64).powi(2) / 8.0;
        let fields = run(1.0, 1.0, 2);
        assert_all(&fields.on_journal.pressure_amplitude, 0.0, bar);
        // The crank step misses the crest by half a degree at most.
        assert_all(&fields.on_shell.pressure_amplitude, 1.0, 1e-4);
        assert_all(&fields.on_shell.maximum_pressure, 2.0, 1e-4);
        // Pressure above 0.5 over two thirds of the way around.
        assert_all(&fields.on_shell.full_film_share, 2.0 / 3.0, 1.0 / 360.0);
        for (point, angle) in fields.on_journal.angles.iter().enumerate() {
            let pressure = fields.on_journal.maximum_pressure[2 * point];
            assert!((pressure - 1.0 - angle.cos()).abs() < bar, "{angle}");
        }
    }

    #[test]
    fn a_pattern_fixed_on_the_shell_tires_only_the_journal() {
        let bar = 2.0 * (1.04 * TAU / AROUND as f64).powi(2) / 8.0;
        let fields = run(0.0, 1.0, 1);
        assert_all(&fields.on_shell.pressure_amplitude, 0.0, 0.0);
        assert_all(&fields.on_journal.pressure_amplitude, 1.0, bar);
        assert_all(&fields.on_journal.full_film_share, 2.0 / 3.0, 0.011);
    }

    /// The thickness grows with time: only the record of the last cycle is thick.
    #[test]
    fn only_the_last_cycle_counts() {
        let fields = run(1.0, 1.0, 3);
        let least = 4.0 - 2.0 + 0.1 * 2.0 * TAU;
        for thickness in &fields.on_shell.minimum_film_thickness {
            assert!(*thickness > least - 1e-3, "{thickness}");
        }
        let first = 2.0 * TAU + TAU / POINTS as f64;
        assert!((fields.worst.crank_angle - first).abs() < TAU / 8.0);
        assert_eq!(fields.frames.len(), MOST_FRAMES);
        let step = TAU / MOST_FRAMES as f64;
        for (frame, field) in fields.frames.iter().enumerate() {
            let expected = 2.0 * TAU + (frame + 1) as f64 * step;
            assert!((field.crank_angle - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn frames_are_evenly_spaced_and_few() {
        for points in [1, 5, 72, 73, 100, 719, 7200] {
            let frames: Vec<usize> = (1..=points)
                .filter(|i| is_frame(*i, points, MOST_FRAMES))
                .collect();
            assert_eq!(frames.len(), points.min(MOST_FRAMES));
            assert_eq!(frames.last(), Some(&points));
            let gaps = frames.windows(2).map(|pair| pair[1] - pair[0]);
            let (least, most) = gaps.fold((points, 1), |(a, b), g| (a.min(g), b.max(g)));
            assert!(points == 1 || most <= least + 1, "{points}: {least} {most}");
        }
    }
}
