//! A fixed point by the steps that led to it (D. G. Anderson, J. ACM 12 (1965) 547).

/// Iterates of `x = g(x)` with what g leaves, the newest last.
#[derive(Default)]
pub struct Mixing {
    seen: Vec<[Vec<f64>; 2]>,
}

impl Mixing {
    /// The next x after g(x) - x = `left`, from the last nine.
    pub fn next(&mut self, x: &[f64], left: Vec<f64>) -> Vec<f64> {
        const KEPT: usize = 9;
        const SHARE: f64 = 0.7;
        self.seen.push([x.to_vec(), left]);
        if self.seen.len() > KEPT {
            self.seen.remove(0);
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let add = |to: &mut [f64], by: f64, what: &[f64]| {
            to.iter_mut().zip(what).for_each(|(a, b)| *a += by * b);
        };
        let [mut next, mut rest] = self.seen.last().cloned().unwrap_or_default();
        let mut basis: Vec<[Vec<f64>; 2]> = Vec::new();
        for pair in self.seen.windows(2).rev() {
            let of = |k: usize| -> Vec<f64> {
                pair[1][k]
                    .iter()
                    .zip(&pair[0][k])
                    .map(|(b, a)| b - a)
                    .collect()
            };
            let [mut moved, mut change] = [of(0), of(1)];
            let size = dot(&change, &change).sqrt();
            for [by, direction] in &basis {
                let share = dot(&change, direction);
                add(&mut change, -share, direction);
                add(&mut moved, -share, by);
            }
            let left = dot(&change, &change).sqrt();
            if left < 1e-4 * size {
                continue;
            }
            change.iter_mut().for_each(|v| *v /= left);
            moved.iter_mut().for_each(|v| *v /= left);
            let share = dot(&rest, &change);
            add(&mut rest, -share, &change);
            add(&mut next, -share, &moved);
            basis.push([moved, change]);
        }
        add(&mut next, SHARE, &rest);
        next
    }
}
