//! How does a frame of beams deform under given forces?
//!
//! Equation: `K u = f`, assembled from the stiffness matrices of beams and springs over the freedoms of
//! all nodes; held freedoms are 0. Dense Cholesky factorisation of the matrix scaled to a unit diagonal,
//! with one step of iterative refinement: frames here have some hundred freedoms.
//!
//! Limits: small displacements, linear elastic, no masses.

use crate::beam::{NODE_FREEDOMS, stiffness};
use crate::{FrameError, Section};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// A pivot of the scaled matrix below this is a freedom that nothing holds: rounding leaves about
/// 1e-15 there, slender chains of a hundred beams about 1e-9.
const LEAST_PIVOT: f64 = 1e-12;

/// Nodes joined by beams.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frame {
    nodes: Vec<[f64; 3]>,
    beams: Vec<Beam>,
    springs: Vec<Spring>,
    held: Vec<[usize; 2]>,
}

#[derive(Debug, Clone, PartialEq)]
struct Beam {
    ends: [usize; 2],
    section: Section,
    across: [f64; 3],
}

#[derive(Debug, Clone, PartialEq)]
struct Spring {
    node: usize,
    stiffness: [[f64; NODE_FREEDOMS]; NODE_FREEDOMS],
}

/// Forces (x, y, z, N) and moments (about x, y, z, N m) at a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeLoad {
    /// Index of the node.
    pub node: usize,
    /// Forces, then moments.
    pub load: [f64; NODE_FREEDOMS],
}

impl Frame {
    /// A frame without nodes.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a node at `position` (m) and returns its index.
    pub fn add_node(&mut self, position: [f64; 3]) -> usize {
        self.nodes.push(position);
        self.nodes.len() - 1
    }

    /// Positions of the nodes, m.
    #[must_use]
    pub fn nodes(&self) -> &[[f64; 3]] {
        &self.nodes
    }

    /// Adds a beam from node `ends[0]` to node `ends[1]`; local y of its section lies in the plane of
    /// the beam and `across`.
    ///
    /// # Errors
    /// [`FrameError`] for unknown nodes, a beam without length, a section without stiffness.
    pub fn add_beam(
        &mut self,
        ends: [usize; 2],
        section: Section,
        across: [f64; 3],
    ) -> Result<(), FrameError> {
        for node in ends {
            self.known(node)?;
        }
        let beam = Beam {
            ends,
            section,
            across,
        };
        let sound = section.is_sound() && stiffness(&section, self.span(&beam), across).is_some();
        if !sound {
            return Err(FrameError::Beam { ends });
        }
        self.beams.push(beam);
        Ok(())
    }

    /// Joins `node` to the ground by a spring: force and moment on the ground over displacement and
    /// rotation of the node, symmetric.
    ///
    /// # Errors
    /// [`FrameError`] for an unknown node.
    pub fn add_spring(
        &mut self,
        node: usize,
        stiffness: [[f64; NODE_FREEDOMS]; NODE_FREEDOMS],
    ) -> Result<(), FrameError> {
        self.known(node)?;
        self.springs.push(Spring { node, stiffness });
        Ok(())
    }

    /// Holds a freedom (0 to 2 displacements, 3 to 5 rotations) of `node` at 0.
    ///
    /// # Errors
    /// [`FrameError`] for an unknown node or freedom.
    pub fn hold(&mut self, node: usize, freedom: usize) -> Result<(), FrameError> {
        self.known(node)?;
        if freedom >= NODE_FREEDOMS {
            return Err(FrameError::Freedom { node, freedom });
        }
        self.held.push([node, freedom]);
        Ok(())
    }

    /// Stiffness over all freedoms, node by node, as if nothing were held.
    #[must_use]
    pub fn stiffness(&self) -> DMatrix<f64> {
        let size = NODE_FREEDOMS * self.nodes.len();
        let mut assembled = DMatrix::zeros(size, size);
        for beam in &self.beams {
            let Some(matrix) = stiffness(&beam.section, self.span(beam), beam.across) else {
                continue;
            };
            let place = |k: usize| NODE_FREEDOMS * beam.ends[k / NODE_FREEDOMS] + k % NODE_FREEDOMS;
            for row in 0..2 * NODE_FREEDOMS {
                for column in 0..2 * NODE_FREEDOMS {
                    assembled[(place(row), place(column))] += matrix[(row, column)];
                }
            }
        }
        for spring in &self.springs {
            let first = NODE_FREEDOMS * spring.node;
            for (row, values) in spring.stiffness.iter().enumerate() {
                for (column, value) in values.iter().enumerate() {
                    assembled[(first + row, first + column)] += value;
                }
            }
        }
        assembled
    }

    /// Displacements (m) and rotations (rad) of all nodes under `loads`.
    ///
    /// # Errors
    /// [`FrameError`] for unknown nodes and for a frame that can move without force.
    pub fn solve(&self, loads: &[NodeLoad]) -> Result<Vec<[f64; NODE_FREEDOMS]>, FrameError> {
        let mut force = DMatrix::zeros(NODE_FREEDOMS * self.nodes.len(), 1);
        for load in loads {
            self.known(load.node)?;
            for (k, value) in load.load.iter().enumerate() {
                force[(NODE_FREEDOMS * load.node + k, 0)] += value;
            }
        }
        let free = self.free_freedoms(&[]);
        let matrix = self.stiffness();
        let inner = Factored::new(&matrix, &free)?;
        let answer = inner.solve(&force.select_rows(&free));
        let mut displacements = vec![[0.0; NODE_FREEDOMS]; self.nodes.len()];
        for (freedom, value) in free.iter().zip(answer.iter()) {
            displacements[freedom / NODE_FREEDOMS][freedom % NODE_FREEDOMS] = *value;
        }
        Ok(displacements)
    }

    /// Indices of the freedoms that are neither held nor in `retained`.
    pub(crate) fn free_freedoms(&self, retained: &[usize]) -> Vec<usize> {
        (0..NODE_FREEDOMS * self.nodes.len())
            .filter(|freedom| {
                let place = [freedom / NODE_FREEDOMS, freedom % NODE_FREEDOMS];
                !retained.contains(freedom) && !self.held.contains(&place)
            })
            .collect()
    }

    /// Whether a freedom of a node is held.
    pub(crate) fn is_held(&self, node: usize, freedom: usize) -> bool {
        self.held.contains(&[node, freedom])
    }

    /// An error for a node that does not exist.
    pub(crate) fn known(&self, node: usize) -> Result<(), FrameError> {
        if node < self.nodes.len() {
            return Ok(());
        }
        Err(FrameError::Node {
            node,
            nodes: self.nodes.len(),
        })
    }

    fn span(&self, beam: &Beam) -> [f64; 3] {
        let [from, to] = beam.ends.map(|end| self.nodes[end]);
        [0, 1, 2].map(|k| to[k] - from[k])
    }
}

/// A part of a stiffness matrix, factored.
pub(crate) struct Factored {
    matrix: DMatrix<f64>,
    scale: DVector<f64>,
    factors: Cholesky<f64, Dyn>,
}

impl Factored {
    /// Rows and columns `freedoms` of `stiffness`.
    pub(crate) fn new(stiffness: &DMatrix<f64>, freedoms: &[usize]) -> Result<Self, FrameError> {
        let matrix = stiffness.select_rows(freedoms).select_columns(freedoms);
        let scale = matrix.diagonal().map(|value| 1.0 / value.sqrt());
        if let Some(loose) = scale.iter().position(|value| !value.is_finite()) {
            return Err(loose_freedom(freedoms[loose]));
        }
        let scaled = DMatrix::from_fn(freedoms.len(), freedoms.len(), |row, column| {
            scale[row] * matrix[(row, column)] * scale[column]
        });
        let Some(factors) = Cholesky::new(scaled) else {
            return Err(FrameError::Loose);
        };
        let pivots = factors.l_dirty().diagonal();
        match pivots.iter().position(|pivot| pivot * pivot < LEAST_PIVOT) {
            Some(loose) => Err(loose_freedom(freedoms[loose])),
            None => Ok(Self {
                matrix,
                scale,
                factors,
            }),
        }
    }

    /// Displacements under each column of `forces`.
    pub(crate) fn solve(&self, forces: &DMatrix<f64>) -> DMatrix<f64> {
        let once = self.substitute(forces);
        let rest = forces - &self.matrix * &once;
        once + self.substitute(&rest)
    }

    fn substitute(&self, forces: &DMatrix<f64>) -> DMatrix<f64> {
        let mut scaled = forces.clone();
        self.scale_rows(&mut scaled);
        self.factors.solve_mut(&mut scaled);
        self.scale_rows(&mut scaled);
        scaled
    }

    fn scale_rows(&self, matrix: &mut DMatrix<f64>) {
        for (mut row, scale) in matrix.row_iter_mut().zip(self.scale.iter()) {
            row *= *scale;
        }
    }
}

fn loose_freedom(freedom: usize) -> FrameError {
    FrameError::LooseNode {
        node: freedom / NODE_FREEDOMS,
        freedom: freedom % NODE_FREEDOMS,
    }
}
