//! What a generated cycle may be refused for.

/// Why a cycle cannot be generated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CombustionError {
    /// A number is out of range.
    #[error("{what} is {value}, allowed: {allowed}")]
    OutOfRange {
        /// What it is.
        what: &'static str,
        /// As given, SI.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The pressure left the range of numbers: heat or losses fit no gas in this chamber.
    #[error("the gas has no state any more at {:.1} deg", angle.to_degrees())]
    NoState {
        /// Crank angle from firing, rad.
        angle: f64,
    },
}

impl CombustionError {
    /// An error unless the claim holds.
    pub(crate) const fn unless(
        claim: bool,
        what: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if claim {
            return Ok(());
        }
        Err(Self::OutOfRange {
            what,
            value,
            allowed,
        })
    }
}
