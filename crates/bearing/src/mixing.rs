//! Which temperatures to try next, when film and temperatures are found in turn?
//!
//! Equation: `G(T) = T`, where G is what a round leads to from temperatures T.
//! Unknowns: the temperature (K) of every cell; the journal, m and rad, comes along.
//! Method: the mix of the last rounds whose changes `G(T) - T` cancel best, by least squares, and from there
//! its change (Anderson). A round whose changes grew forgets the ones before it and goes a smaller share;
//! no step is longer than what the laws of an oil vary little over. Where rounds no longer come nearer, as
//! where oil turns round at the edge of a ruptured film and a cell is fed now from one side, now from the other,
//! none is mixed any more, and every temperature goes a share of its own, which a change of its direction halves.
//! References: D. G. Anderson, J. ACM 12 (1965) 547, 10.1145/321296.321305; H. F. Walker, P. Ni, SIAM J.
//! Numer. Anal. 49 (2011) 1715, 10.1137/10078356X.

use crate::dense::solve;
use std::collections::VecDeque;

/// Rounds that are mixed with the present one, at most.
pub(crate) const DEPTH: usize = 4;
/// Smallest share of a change.
const LEAST_SHARE: f64 = 0.1;
/// Changes that grew by this were led astray.
const GROWTH: f64 = 1.5;
/// Changes above this in the mean of squares, K, are not mixed: laws and ruptured film vary too much.
const FAR: f64 = 3.0;
/// Rounds that come no nearer before every temperature goes its own share, and the largest and smallest of
/// these.
const PATIENCE: usize = 12;
const NEARER: f64 = 0.7;
const CALM_SHARE: f64 = 0.4;
const LEAST_CALM: f64 = 0.01;
/// Largest change of a cell in a round, K.
const LONGEST_STEP: f64 = 40.0;
/// Rounds that differ from others by less than this share do not count: round-off.
const ROUND_OFF: f64 = 1e-10;

/// The rounds so far.
#[derive(Debug, Clone)]
pub(crate) struct Mixing {
    depth: usize,
    share: f64,
    /// Temperatures and changes of the last round.
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Differences of temperatures and of changes between rounds, the newest first.
    differences: VecDeque<(Vec<f64>, Vec<f64>)>,
    /// Smallest change so far (the largest of all temperatures, K), and the rounds since.
    nearest: (f64, usize),
    /// Share of every temperature and its last change, once mixing has failed; else empty.
    calm: Vec<[f64; 2]>,
}

impl Mixing {
    /// Mixes so many rounds with the present one; none of them where rounds differ by more than their
    /// temperatures.
    pub(crate) fn new(depth: usize) -> Self {
        Self {
            depth: depth.min(DEPTH),
            share: 1.0,
            last: None,
            differences: VecDeque::new(),
            nearest: (f64::INFINITY, 0),
            calm: Vec::new(),
        }
    }

    /// Rounds no longer come nearer by mixing.
    pub(crate) fn is_calm(&self) -> bool {
        !self.calm.is_empty()
    }

    /// Counts rounds that come no nearer, and calms the temperatures when there are too many.
    fn watch(&mut self, change: &[f64]) {
        let largest = change.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        if largest < NEARER * self.nearest.0 {
            self.nearest = (largest, 0);
        } else {
            self.nearest.1 += 1;
        }
        if self.nearest.1 == PATIENCE && self.depth > 0 && self.calm.is_empty() {
            self.calm = change.iter().map(|c| [CALM_SHARE, *c]).collect();
        }
    }

    /// The next values where every temperature goes its own share.
    fn calmed(&mut self, from: &[f64], change: &[f64]) -> Vec<f64> {
        let mut next: Vec<f64> = from.iter().zip(change).map(|(t, c)| t + c).collect();
        for (k, [share, last]) in self.calm.iter_mut().enumerate() {
            let turned = change[k] * *last < 0.0;
            *share = if turned {
                (0.5 * *share).max(LEAST_CALM)
            } else {
                (1.1 * *share).min(CALM_SHARE)
            };
            *last = change[k];
            next[k] = from[k] + (*share * change[k]).clamp(-LONGEST_STEP, LONGEST_STEP);
        }
        next
    }

    /// The next values, after a round that led from some to others: so many temperatures, then what goes
    /// along with their mix and has no say in it.
    pub(crate) fn next(&mut self, from: &[f64], led_to: &[f64], temperatures: usize) -> Vec<f64> {
        let size = |all: &[f64]| size(&all[..temperatures]);
        let change = minus(led_to, from);
        self.watch(&change[..temperatures]);
        if self.is_calm() {
            return self.calmed(from, &change);
        }
        if let Some((before, last)) = self.last.take() {
            let grew = size(&change) > GROWTH * size(&last);
            if grew || size(&change) > FAR * (temperatures as f64).sqrt() {
                self.differences.clear();
            } else {
                self.differences
                    .push_front((minus(from, &before), minus(&change, &last)));
                self.differences.truncate(self.depth);
            }
            self.share = if grew {
                (0.5 * self.share).max(LEAST_SHARE)
            } else {
                (1.5 * self.share).min(1.0)
            };
        }
        let share = |k: usize| if k < temperatures { self.share } else { 1.0 };
        let changes = change.iter().enumerate();
        let mut step: Vec<f64> = changes.map(|(k, f)| share(k) * f).collect();
        let weights = self.weights(&change, temperatures);
        for (weight, (moved, changed)) in weights.iter().zip(&self.differences) {
            for (k, step) in step.iter_mut().enumerate() {
                *step -= weight * (moved[k] + share(k) * changed[k]);
            }
        }
        let warmest = step[..temperatures].iter();
        let longest = warmest.fold(LONGEST_STEP, |a, b| a.max(b.abs()));
        let next = step.iter().zip(from);
        let next = next.map(|(s, t)| t + s * LONGEST_STEP / longest).collect();
        self.last = Some((from.to_vec(), change));
        next
    }

    /// Weights of the differences that leave least of a change.
    fn weights(&self, change: &[f64], temperatures: usize) -> [f64; DEPTH] {
        let dot = |a: &[f64], b: &[f64]| dot(&a[..temperatures], &b[..temperatures]);
        let mut matrix = [[0.0; DEPTH]; DEPTH];
        let mut right = [0.0; DEPTH];
        let mut scales = [1.0; DEPTH];
        for (row, (_, a)) in self.differences.iter().enumerate() {
            scales[row] = dot(a, a).sqrt().max(f64::MIN_POSITIVE);
            right[row] = dot(a, change) / scales[row];
            for (column, (_, b)) in self.differences.iter().enumerate().take(row + 1) {
                matrix[row][column] = dot(a, b) / scales[row] / scales[column];
                matrix[column][row] = matrix[row][column];
            }
            matrix[row][row] += ROUND_OFF;
        }
        let mut weights = solve(matrix, right, self.differences.len()).unwrap_or_default();
        for (weight, scale) in weights.iter_mut().zip(scales) {
            *weight /= scale;
        }
        weights
    }
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn size(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map with three modes, one of which grows: as many rounds as modes and one find where it
    /// stays, where rounds by themselves run away.
    #[test]
    fn as_many_rounds_as_modes_find_the_fixed_point() {
        let fixed = [300.5, 301.0, 301.5, 300.7, 300.3];
        let rate = [-1.8, 0.5, -0.3, -1.8, 0.5];
        let round = |from: &[f64]| -> Vec<f64> {
            (0..5)
                .map(|k| fixed[k] + rate[k] * (from[k] - fixed[k]))
                .collect()
        };
        let mut mixing = Mixing::new(DEPTH);
        let mut cells = vec![300.0; 5];
        for _ in 0..5 {
            let led_to = round(&cells);
            cells = mixing.next(&cells, &led_to, 5);
        }
        let worst = minus(&cells, &fixed)
            .iter()
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        assert!(worst < 1e-6, "{worst:e} {cells:?}");
    }

    /// A cell that is fed from one side or the other, as its own temperature decides: mixing jumps to and fro,
    /// shares of their own do not.
    #[test]
    fn a_temperature_that_jumps_to_and_fro_is_calmed() {
        let round = |from: &[f64]| -> Vec<f64> {
            let jump = 30.0 * ((400.0 - from[0]) / 0.5).tanh();
            vec![400.0 + jump, 0.5 * from[0] + 0.4 * from[1]]
        };
        let mut mixing = Mixing::new(DEPTH);
        let mut cells = vec![300.0, 310.0];
        let mut change = f64::INFINITY;
        for _ in 0..120 {
            let led_to = round(&cells);
            change = minus(&led_to, &cells)
                .iter()
                .fold(0.0, |a, b| a.max(b.abs()));
            cells = mixing.next(&cells, &led_to, 2);
        }
        assert!(mixing.is_calm() && change < 0.05, "{change} {cells:?}");
        assert!((cells[0] - 400.0).abs() < 0.05);
    }

    /// Without a way to a fixed point it stays finite, and no step is longer than it may be.
    #[test]
    fn steps_are_bounded() {
        let mut mixing = Mixing::new(DEPTH);
        let mut cells = vec![300.0, 310.0];
        for _ in 0..20 {
            let led_to: Vec<f64> = cells.iter().map(|t| t * t).collect();
            let next = mixing.next(&cells, &led_to, 2);
            assert!(minus(&next, &cells).iter().all(|s| s.abs() <= LONGEST_STEP));
            cells = next;
        }
        assert!(cells.iter().all(|t| t.is_finite()));
    }
}
