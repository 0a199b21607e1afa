//! Where the unknowns stand: node by node, so that every row reaches the neighbouring nodes only.
//!
//! At a node: the motion of each density (per length) and its variational derivative p, those of the curvature, V, Z
//! (the adjoint of W, less ∂𝓕/∂|Γ|), and W at the midpoint after the node. A motion before its p before V: so the leading
//! blocks are those of the flow on a part of the curve with fixed ends, and pivots need no search.

/// Numbers of nodes and fields.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// Nodes.
    pub nodes: usize,
    /// Curvature and densities.
    pub fields: usize,
}

impl Places {
    /// Unknowns at a node.
    pub fn per_node(self) -> usize {
        2 * self.fields + 3
    }

    /// Number of unknowns, the border apart.
    pub fn unknowns(self) -> usize {
        self.nodes * self.per_node()
    }

    /// Motion of field `field`: densities first.
    pub fn motion(self, field: usize, node: usize) -> usize {
        let place = if field == 0 { self.fields - 1 } else { field - 1 };
        node * self.per_node() + 2 * place
    }

    /// Variational derivative by field `field`.
    pub fn gradient(self, field: usize, node: usize) -> usize {
        self.motion(field, node) + 1
    }

    /// Normal velocity.
    pub fn velocity(self, node: usize) -> usize {
        node * self.per_node() + 2 * self.fields
    }

    /// Z.
    pub fn adjoint(self, node: usize) -> usize {
        self.velocity(node) + 1
    }

    /// W at the midpoint after the node.
    pub fn tangential(self, node: usize) -> usize {
        self.velocity(node) + 2
    }

    /// The node before and the node after.
    pub fn neighbours(self, node: usize) -> [usize; 2] {
        [(node + self.nodes - 1) % self.nodes, (node + 1) % self.nodes]
    }
}
