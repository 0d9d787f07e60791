//! Discs and links, their checks, and their matrices.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A chain of discs joined by torsional springs. A flywheel, both masses of a dual-mass flywheel, a
/// pulley and the ring of a damper are discs like any other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TorsionalChain {
    /// Discs from the free end to the flywheel. The load acts on the last one.
    pub discs: Vec<Disc>,
    /// Links between neighbours: one fewer than discs.
    pub links: Vec<TorsionalLink>,
}

/// One disc of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Disc {
    /// Moment of inertia, kg m2; for a throw with the mean of what pistons and rods add.
    pub inertia: f64,
    /// Damping against ground, N m s/rad.
    pub damping: f64,
    /// The throw that drives it, if any.
    pub throw: Option<usize>,
}

/// One link of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TorsionalLink {
    /// N m/rad; 0 for a link that only damps.
    pub stiffness: f64,
    /// Viscous damping between the discs, N m s/rad.
    pub damping: f64,
    /// Loss factor: imaginary over real part of the stiffness.
    pub loss_factor: f64,
}

/// What a chain or a task about it refuses. Discs, links and throws are named from 1.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TorsionError {
    /// Discs and links do not make a chain.
    #[error("a torsional chain of {discs} discs needs one link fewer, and has {links}")]
    NotAChain {
        /// Number of discs.
        discs: usize,
        /// Number of links.
        links: usize,
    },
    /// A value is out of its range.
    #[error("{place} {number}: {name} = {value} must be {range}")]
    OutOfRange {
        /// `disc`, `link`, `throw`, ...
        place: &'static str,
        /// Its number from 1.
        number: usize,
        /// Which value.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What it must be.
        range: &'static str,
    },
    /// A value of the task itself is out of its range.
    #[error("{name} = {value} must be {range}")]
    Task {
        /// Which value.
        name: &'static str,
        /// What it is.
        value: f64,
        /// What it must be.
        range: &'static str,
    },
    /// Lists that belong together have different lengths.
    #[error("{name}: {count} given, {due} due")]
    Count {
        /// Of what.
        name: &'static str,
        /// How many there are.
        count: usize,
        /// How many there must be.
        due: usize,
    },
    /// A throw drives no disc or several, or a disc names a throw that has no torque.
    #[error(
        "throw {throw} drives {discs} discs of the torsional chain and has {torques} torques: one of each is due"
    )]
    Throw {
        /// Number of the throw from 1.
        throw: usize,
        /// Discs that name it.
        discs: usize,
        /// Torques given for it.
        torques: usize,
    },
    /// A mean torque would have to pass a link without stiffness.
    #[error("link {link} has no stiffness and would have to carry a mean torque of {torque} N m")]
    FreeLink {
        /// Number of the link from 1.
        link: usize,
        /// N m.
        torque: f64,
    },
    /// A resonance without damping: the twist has no bound.
    #[error("at {frequency} Hz the chain is in resonance and nothing damps it")]
    Resonance {
        /// Hz.
        frequency: f64,
    },
}

/// Matrices of a chain, symmetric, of as many rows as discs.
#[derive(Debug, Clone, PartialEq)]
pub struct ChainMatrices {
    /// Moments of inertia, kg m2; diagonal.
    pub inertia: DMatrix<f64>,
    /// Damping, N m s/rad.
    pub damping: DMatrix<f64>,
    /// Stiffness, N m/rad; singular by the turning of the whole chain.
    pub stiffness: DMatrix<f64>,
    /// Imaginary part of the complex stiffness, N m/rad.
    pub loss: DMatrix<f64>,
}

impl TorsionalChain {
    /// # Errors
    /// Names what does not make a chain: numbers of discs and links, inertias that are not positive,
    /// negative stiffness or damping, values that are not finite.
    pub fn check(&self) -> Result<(), TorsionError> {
        if self.links.len() + 1 != self.discs.len() {
            return Err(TorsionError::NotAChain {
                discs: self.discs.len(),
                links: self.links.len(),
            });
        }
        for (at, disc) in self.discs.iter().enumerate() {
            require("disc", at, "inertia", disc.inertia, Range::Positive)?;
            require("disc", at, "damping", disc.damping, Range::NotNegative)?;
        }
        for (at, link) in self.links.iter().enumerate() {
            require("link", at, "stiffness", link.stiffness, Range::NotNegative)?;
            require("link", at, "damping", link.damping, Range::NotNegative)?;
            require(
                "link",
                at,
                "loss factor",
                link.loss_factor,
                Range::NotNegative,
            )?;
        }
        Ok(())
    }

    /// Matrices of the chain.
    ///
    /// # Errors
    /// What [`TorsionalChain::check`] refuses.
    pub fn matrices(&self) -> Result<ChainMatrices, TorsionError> {
        self.check()?;
        let count = self.discs.len();
        let diagonal = |of: fn(&Disc) -> f64| {
            DMatrix::from_fn(count, count, |row, column| {
                if row == column {
                    of(&self.discs[row])
                } else {
                    0.0
                }
            })
        };
        let mut damping = diagonal(|disc| disc.damping);
        self.add_links(&mut damping, |link| link.damping);
        let mut stiffness = DMatrix::zeros(count, count);
        self.add_links(&mut stiffness, |link| link.stiffness);
        let mut loss = DMatrix::zeros(count, count);
        self.add_links(&mut loss, |link| link.stiffness * link.loss_factor);
        Ok(ChainMatrices {
            inertia: diagonal(|disc| disc.inertia),
            damping,
            stiffness,
            loss,
        })
    }

    /// Each link pulls on the difference of its discs.
    fn add_links(&self, matrix: &mut DMatrix<f64>, of: impl Fn(&TorsionalLink) -> f64) {
        for (at, link) in self.links.iter().enumerate() {
            let value = of(link);
            matrix[(at, at)] += value;
            matrix[(at + 1, at + 1)] += value;
            matrix[(at, at + 1)] -= value;
            matrix[(at + 1, at)] -= value;
        }
    }

    /// Index of the disc of each throw, for as many throws as there are torques.
    pub(super) fn discs_of_throws(&self, throws: usize) -> Result<Vec<usize>, TorsionError> {
        let highest = self.discs.iter().filter_map(|disc| disc.throw).max();
        let named = highest.map_or(0, |throw| throw.saturating_add(1));
        if named > throws {
            return Err(TorsionError::Throw {
                throw: named,
                discs: 1,
                torques: 0,
            });
        }
        (0..throws)
            .map(|throw| {
                let mut discs =
                    (0..self.discs.len()).filter(|&at| self.discs[at].throw == Some(throw));
                match (discs.next(), discs.count()) {
                    (Some(disc), 0) => Ok(disc),
                    (first, more) => Err(TorsionError::Throw {
                        throw: throw + 1,
                        discs: usize::from(first.is_some()) + more,
                        torques: 1,
                    }),
                }
            })
            .collect()
    }
}

/// Range of an input value; both exclude what is not finite.
#[derive(Clone, Copy)]
pub(super) enum Range {
    Positive,
    NotNegative,
}

impl Range {
    pub(super) fn holds(self, value: f64) -> bool {
        let inside = match self {
            Self::Positive => value > 0.0,
            Self::NotNegative => value >= 0.0,
        };
        inside && value.is_finite()
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Positive => "positive and finite",
            Self::NotNegative => "zero or positive, and finite",
        }
    }
}

fn require(
    place: &'static str,
    at: usize,
    name: &'static str,
    value: f64,
    range: Range,
) -> Result<(), TorsionError> {
    if range.holds(value) {
        return Ok(());
    }
    Err(TorsionError::OutOfRange {
        place,
        number: at + 1,
        name,
        value,
        range: range.name(),
    })
}

/// As `require`, for a value of the task.
pub(super) fn require_task(
    name: &'static str,
    value: f64,
    range: Range,
) -> Result<(), TorsionError> {
    if range.holds(value) {
        return Ok(());
    }
    Err(TorsionError::Task {
        name,
        value,
        range: range.name(),
    })
}
