//! What is wrong with a frame.

use thiserror::Error;

/// Why a frame cannot be built or solved. Nodes and freedoms are counted from 0; freedoms 0 to 2 are
/// displacements, 3 to 5 rotations.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FrameError {
    /// A node that does not exist.
    #[error("node {node} does not exist: the frame has {nodes} nodes")]
    Node {
        /// The node asked for.
        node: usize,
        /// How many there are.
        nodes: usize,
    },
    /// A freedom that does not exist.
    #[error("freedom {freedom} of node {node} does not exist: a node has freedoms 0 to 5")]
    Freedom {
        /// The node.
        node: usize,
        /// The freedom asked for.
        freedom: usize,
    },
    /// A beam without length, orientation or stiffness.
    #[error(
        "the beam between nodes {} and {} has no length, no orientation or a stiffness that is not positive",
        ends[0], ends[1]
    )]
    Beam {
        /// Its nodes.
        ends: [usize; 2],
    },
    /// A node that nothing holds.
    #[error(
        "node {node} can move in its freedom {freedom} without force: hold it or join it to the rest"
    )]
    LooseNode {
        /// The node.
        node: usize,
        /// The freedom.
        freedom: usize,
    },
    /// A stiffness matrix that is not positive definite.
    #[error(
        "the frame can move without force, or a spring pushes: hold it so that no rigid movement is left"
    )]
    Loose,
    /// Journals of a condensation that are held or named twice.
    #[error(
        "node {node} cannot be a journal: it is named twice, or a freedom of a journal is held there"
    )]
    Journal {
        /// The node.
        node: usize,
    },
}
