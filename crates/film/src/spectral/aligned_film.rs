//! What does the film of a plain bearing put on an aligned journal, in numbers without units?
//!
//! ```text
//! (H^3 p_theta)_theta + (D/B)^2 (H^3 p_Z)_Z = -(w_r cos(theta) + w_t sin(theta)),   theta from the narrowest gap
//! ```
//! One problem for all aligned films: its force depends on the eccentricity, the width and the direction
//! of `(w_r, w_t) = (eps_dot, -eps omega_eff/2)`, and is of degree 1 in its size. Pressures are over
//! 12 eta R^2/c^2; the scaled ones of the paper are twelve times that, over eta/psi^2.
//! Reference: Marsalek, Novotny, Drapal, Pistek (2012), equations 4 to 9.

use super::answer::{AlignedFigures, AlignedForce};
use super::fitted_film::{Accuracy, Crowding, JointFilm, LinewiseFilm};
use super::half_film::HalfFilm;
use crate::bearing::Cavitation;
use crate::force::{FilmError, Outcome};

/// How exact a film is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// For films in the loop of an orbit.
    OnLine,
    /// For tables: error of the force below 2e-5 of its size up to a relative eccentricity of 0.95 and
    /// B/D of 1; against rings of columns 3e-5 at 0.99 and B/D 0.5, 2e-4 at 0.99 and B/D 1.5.
    Fine,
    /// For tables close to contact: fronts of more terms, and nodes that crowd more in the narrowest gap.
    NearContact,
    /// As [`Precision::NearContact`] with more of everything. What both differ by is the error of the
    /// coarser one; up to a relative eccentricity of 0.999 and B/D of 1 below 1e-4 of the force in most
    /// directions (`database/tests/nodes.rs`).
    Finest,
}

/// The film of an aligned journal.
#[derive(Debug, Clone)]
pub struct AlignedFilm {
    kernel: Kernel,
    is_at_rest: bool,
}

/// The film of the closure, the width and the precision.
#[derive(Debug, Clone)]
enum Kernel {
    HalfNarrow(Box<HalfFilm<4, 4>>),
    HalfMiddle(Box<HalfFilm<4, 6>>),
    HalfWide(Box<HalfFilm<6, 6>>),
    HalfFine(Box<HalfFilm<8, 8>>),
    HalfFinest(Box<HalfFilm<12, 12>>),
    FittedNarrow(Box<JointFilm<4, 6, 8>>),
    FittedWide(Box<JointFilm<5, 7, 8>>),
    FittedWider(Box<JointFilm<6, 8, 8>>),
    FittedFine(Box<LinewiseFilm<7, 9>>),
    FittedFinest(Box<LinewiseFilm<9, 11>>),
}

/// Largest width over diameter that four shapes on as many lines are enough for.
const NARROW: f64 = 0.6;
/// Largest width over diameter that four shapes on more lines are enough for after Gumbel.
const MIDDLE: f64 = 0.9;
/// Largest width over diameter that five are enough for.
const WIDE: f64 = 1.0;
/// Modulus of the substitution of a fitted film for tables over the relative eccentricity.
const MODULUS: f64 = 0.96;
/// The same where nodes crowd in the narrowest gap.
const CROWDED: f64 = 0.985;
/// Power of the substitution on line.
const POWER: f64 = 0.75;
/// How long elements at the fronts are on line, over the others: without shorter ones, or fewer of them, a front in the
/// widest gap is lost from a relative eccentricity of 0.97.
const END: f64 = 0.5;
/// Error of the force over its size that the fronts of a film for tables may leave.
const UNFELT: f64 = 1e-7;
/// The same on line, before what the fronts still have to move is accounted for.
const SETTLED: f64 = 1e-11;

impl AlignedFilm {
    /// Film of a bearing of this width over diameter, all ends at cavitation pressure, cyclic.
    ///
    /// # Errors
    /// [`FilmError::Unsupported`] for a closure with a memory and for a width that is not positive.
    pub fn new(
        cavitation: Cavitation,
        width_ratio: f64,
        precision: Precision,
    ) -> Result<Self, FilmError> {
        if !(width_ratio.is_finite() && width_ratio > 0.0) {
            return Err(FilmError::Unsupported {
                reason: "the width of an on-line film must be positive",
            });
        }
        let d_over_b = 1.0 / width_ratio;
        let is_narrow = width_ratio <= NARROW;
        let even = |elements, degree, share| Accuracy {
            elements,
            degree,
            end: 1.0,
            crowding: Crowding::Share(share),
            tolerance: UNFELT,
        };
        let on_line = Accuracy {
            elements: 6,
            degree: 6,
            end: END,
            crowding: Crowding::Graded(POWER),
            tolerance: SETTLED,
        };
        let kernel = match (cavitation, precision) {
            (Cavitation::Gumbel, Precision::OnLine) if is_narrow => {
                Kernel::HalfNarrow(Box::new(HalfFilm::new(d_over_b, 64)))
            }
            (Cavitation::Gumbel, Precision::OnLine) if width_ratio <= MIDDLE => {
                Kernel::HalfMiddle(Box::new(HalfFilm::new(d_over_b, 64)))
            }
            (Cavitation::Gumbel, Precision::OnLine) => {
                Kernel::HalfWide(Box::new(HalfFilm::new(d_over_b, 64)))
            }
            (Cavitation::Gumbel, Precision::Fine) => {
                Kernel::HalfFine(Box::new(HalfFilm::new(d_over_b, 256)))
            }
            (Cavitation::Gumbel, Precision::NearContact) => {
                Kernel::HalfFine(Box::new(HalfFilm::new(d_over_b, 512)))
            }
            (Cavitation::Gumbel, Precision::Finest) => {
                Kernel::HalfFinest(Box::new(HalfFilm::new(d_over_b, 512)))
            }
            (Cavitation::Reynolds, Precision::OnLine) if is_narrow => {
                Kernel::FittedNarrow(Box::new(JointFilm::new(d_over_b, on_line)))
            }
            (Cavitation::Reynolds, Precision::OnLine) if width_ratio > WIDE => {
                Kernel::FittedWider(Box::new(JointFilm::new(d_over_b, on_line)))
            }
            (Cavitation::Reynolds, Precision::OnLine) => {
                Kernel::FittedWide(Box::new(JointFilm::new(d_over_b, on_line)))
            }
            (Cavitation::Reynolds, Precision::Fine) => {
                let accuracy = even(8, 7, MODULUS);
                Kernel::FittedFine(Box::new(LinewiseFilm::new(d_over_b, accuracy, 4)))
            }
            (Cavitation::Reynolds, Precision::NearContact) => Kernel::FittedFine(Box::new(
                LinewiseFilm::new(d_over_b, even(8, 8, CROWDED), 5),
            )),
            (Cavitation::Reynolds, Precision::Finest) => Kernel::FittedFinest(Box::new(
                LinewiseFilm::new(d_over_b, even(10, 8, CROWDED), 6),
            )),
            (Cavitation::MassConserving, _) => {
                return Err(FilmError::Unsupported {
                    reason: "a film that remembers is not solved on line: use model = \"field\" for \
                             cavitation = \"mass-conserving\"",
                });
            }
        };
        Ok(Self {
            kernel,
            is_at_rest: true,
        })
    }

    /// Force at a relative eccentricity for a motion `(w_r, w_t)`, 1/s, along and across the line of
    /// centres; [`Outcome::NotConverged`] where the fronts of a film after Reynolds do not settle.
    /// A film at rest has no force; its derivatives by motion are those of a closing gap, or of the full
    /// film after Gumbel.
    ///
    /// # Errors
    /// [`FilmError::Contact`] for a relative eccentricity not from 0 to below 1, [`FilmError::NotFinite`]
    /// for a motion that is no number.
    pub fn force(
        &mut self,
        relative_eccentricity: f64,
        motion: [f64; 2],
    ) -> Result<(AlignedForce, Outcome), FilmError> {
        if !(0.0..1.0).contains(&relative_eccentricity) {
            return Err(FilmError::Contact {
                angle_deg: 0.0,
                axial_mm: 0.0,
                gap_um: 0.0,
            });
        }
        if !motion.iter().all(|part| part.is_finite()) {
            return Err(FilmError::NotFinite { name: "motion" });
        }
        self.is_at_rest = motion == [0.0; 2];
        let eps = relative_eccentricity;
        let (found, settled) = match &mut self.kernel {
            Kernel::HalfNarrow(film) => (film.force(eps, motion), true),
            Kernel::HalfMiddle(film) => (film.force(eps, motion), true),
            Kernel::HalfWide(film) => (film.force(eps, motion), true),
            Kernel::HalfFine(film) => (film.force(eps, motion), true),
            Kernel::HalfFinest(film) => (film.force(eps, motion), true),
            Kernel::FittedNarrow(film) => film.force(eps, motion),
            Kernel::FittedWide(film) => film.force(eps, motion),
            Kernel::FittedWider(film) => film.force(eps, motion),
            Kernel::FittedFine(film) => film.force(eps, motion),
            Kernel::FittedFinest(film) => film.force(eps, motion),
        };
        let outcome = if settled {
            Outcome::Converged
        } else {
            Outcome::NotConverged
        };
        Ok((found, outcome))
    }

    /// The same for the paper's scaled pressure and motion `(2 eps_dot, omega_eff)`: the integrals F1
    /// and F2 of `Pi cos(phi)` and `Pi sin(phi)`, phi from the widest gap, so that the force on the journal is
    /// `eta D B/(4 psi^2) F`; with its derivatives by relative eccentricity at fixed
    /// `(2 eps_dot, omega_eff)` and by these two.
    ///
    /// # Errors
    /// As [`AlignedFilm::force`].
    pub fn scaled_force(
        &mut self,
        relative_eccentricity: f64,
        [twice_rate, effective_speed]: [f64; 2],
    ) -> Result<(AlignedForce, Outcome), FilmError> {
        let eps = relative_eccentricity;
        let motion = [0.5 * twice_rate, -0.5 * eps * effective_speed];
        let (found, outcome) = self.force(eps, motion)?;
        let scaled = AlignedForce {
            force: found.force.map(|force| 12.0 * force),
            by_eccentricity: [0, 1].map(|row| {
                12.0 * found.by_eccentricity[row] - 6.0 * effective_speed * found.by_motion[row][1]
            }),
            by_motion: found
                .by_motion
                .map(|[along, across]| [6.0 * along, -6.0 * eps * across]),
        };
        Ok((scaled, outcome))
    }

    /// Figures of the film last solved.
    #[must_use]
    pub fn figures(&self) -> AlignedFigures {
        if self.is_at_rest {
            return AlignedFigures::default();
        }
        match &self.kernel {
            Kernel::HalfNarrow(film) => film.figures(),
            Kernel::HalfMiddle(film) => film.figures(),
            Kernel::HalfWide(film) => film.figures(),
            Kernel::HalfFine(film) => film.figures(),
            Kernel::HalfFinest(film) => film.figures(),
            Kernel::FittedNarrow(film) => film.figures(),
            Kernel::FittedWide(film) => film.figures(),
            Kernel::FittedWider(film) => film.figures(),
            Kernel::FittedFine(film) => film.figures(),
            Kernel::FittedFinest(film) => film.figures(),
        }
    }
}
