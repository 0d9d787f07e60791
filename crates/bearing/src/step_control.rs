//! How far does one time step go?
//!
//! An output crank step is cut into 2^k equal substeps. k rises by one where a step fails or its
//! error estimate is too large; it falls by one, at even substeps, where the estimate leaves room.
//! So every output crank angle is met exactly, and the level carries over to the next one.

/// Place within one output crank step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Substeps {
    level: u32,
    /// Substeps of the present level already done.
    done: u64,
    finest: u32,
}

impl Substeps {
    pub(crate) fn new(finest: u32) -> Self {
        Self {
            level: 0,
            done: 0,
            finest,
        }
    }

    /// Begins the next output crank step at the level reached.
    pub(crate) fn begin(&mut self) {
        self.done = 0;
    }

    /// The output crank step is done.
    pub(crate) fn at_end(&self) -> bool {
        self.done >= 1 << self.level
    }

    /// Share of the output crank step that is done.
    pub(crate) fn position(&self) -> f64 {
        self.done as f64 / (1_u64 << self.level) as f64
    }

    /// Share of the output crank step that the next substep takes.
    pub(crate) fn length(&self) -> f64 {
        1.0 / (1_u64 << self.level) as f64
    }

    /// How often the output crank step is halved at present.
    pub(crate) fn level(&self) -> u32 {
        self.level
    }

    /// Halves the next substep; false at the finest level.
    pub(crate) fn halve(&mut self) -> bool {
        if self.level >= self.finest {
            return false;
        }
        self.level += 1;
        self.done *= 2;
        true
    }

    /// One substep is done; the next may be twice as long if `with_room`.
    pub(crate) fn advance(&mut self, with_room: bool) {
        self.done += 1;
        if with_room && self.level > 0 && self.done.is_multiple_of(2) {
            self.level -= 1;
            self.done /= 2;
        }
    }

    /// Takes the rest of the output crank step in one substep.
    pub(crate) fn skip_to_end(&mut self) {
        self.done = 1 << self.level;
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
        while !substeps.at_end() {
            if count == 1 || count == 2 {
                assert!(substeps.halve());
            }
            if count == 0 {
                assert!(substeps.halve());
            }
            assert!((substeps.position() - sum).abs() < 1e-15);
            sum += substeps.length();
            substeps.advance(count > 3);
            count += 1;
        }
        assert!((sum - 1.0).abs() < 1e-15);
    }
}
