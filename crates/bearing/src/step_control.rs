//! How far does one time step go?
//!
//! An output crank step is cut into 3^k equal substeps. k rises by one where a step fails or its
//! error estimate is too large; it falls by one, every third substep, where the estimate leaves room.
//! So the end of every output crank step is met exactly, and its middle is the middle of a substep;
//! the level carries over to the next one.

/// Place within one output crank step.
#[derive(Debug, Clone, Copy)]
pub struct Substeps {
    level: u32,
    /// Substeps of the present level already done.
    done: u64,
    finest: u32,
}

impl Substeps {
    /// At the start of a run; the output crank step is divided at most `finest` times.
    #[must_use]
    pub fn new(finest: u32) -> Self {
        Self {
            level: 0,
            done: 0,
            finest,
        }
    }

    /// Begins the next output crank step at the level reached.
    pub fn begin(&mut self) {
        self.done = 0;
    }

    /// The output crank step is done.
    pub fn at_end(&self) -> bool {
        self.done >= self.count()
    }

    /// The next substep is the last one.
    pub fn is_last(&self) -> bool {
        self.done + 1 >= self.count()
    }

    /// The middle of the next substep is the middle of the output crank step.
    pub fn is_central(&self) -> bool {
        2 * self.done + 1 == self.count()
    }

    fn count(&self) -> u64 {
        3_u64.pow(self.level)
    }

    /// Share of the output crank step that is done.
    pub fn position(&self) -> f64 {
        self.done as f64 / self.count() as f64
    }

    /// Share of the output crank step that the next substep takes.
    pub fn length(&self) -> f64 {
        1.0 / self.count() as f64
    }

    /// How often the output crank step is divided at present.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Divides the next substep into three; false at the finest level.
    pub fn divide(&mut self) -> bool {
        if self.level >= self.finest {
            return false;
        }
        self.level += 1;
        self.done *= 3;
        true
    }

    /// One substep is done; the next may be three times as long if `with_room`.
    pub fn advance(&mut self, with_room: bool) {
        self.done += 1;
        if with_room && self.level > 0 && self.done.is_multiple_of(3) {
            self.level -= 1;
            self.done /= 3;
        }
    }

    /// Takes the rest of the output crank step in one substep.
    pub fn skip_to_end(&mut self) {
        self.done = self.count();
    }
}

#[cfg(test)]
mod tests {
    use super::Substeps;

    #[test]
    fn substeps_fill_the_step_exactly() {
        let mut substeps = Substeps::new(3);
        let mut sum = 0.0;
        let mut count = 0;
        let mut centres = 0;
        while !substeps.at_end() {
            if count == 1 || count == 2 {
                assert!(substeps.divide());
            }
            if count == 0 {
                assert!(substeps.divide());
            }
            assert!((substeps.position() - sum).abs() < 1e-14);
            sum += substeps.length();
            let middle = sum - 0.5 * substeps.length();
            assert_eq!(substeps.is_central(), (middle - 0.5).abs() < 1e-12);
            centres += u32::from(substeps.is_central());
            substeps.advance(count > 3);
            count += 1;
        }
        assert!((sum - 1.0).abs() < 1e-14);
        assert_eq!(centres, 1);
    }
}
