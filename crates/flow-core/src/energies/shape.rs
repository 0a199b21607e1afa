//! A curve as those terms see it that depend on where its nodes lie.

/// Nodal positions and tangents by component, and the length: of a curve, of its motion, or the derivative of
/// an energy by them. A derivative pairs with a motion as the mean over the nodes of the products, plus the
/// product of the lengths.
#[derive(Clone, Debug)]
pub struct ShapeFields {
    /// Position γ at the nodes, relative to an origin that means nothing: the mean of the nodes, which on graded or co-moving nodes is
    /// not the centre of the curve. The centre is ∫γ dσ/|Γ| = ⟨wγ⟩, the mean over the nodes with the weights below; a term that needs
    /// it subtracts it, and takes it along in its derivatives.
    pub position: [Vec<f64>; 2],
    /// Tangent wτ per length at the nodes: ∂_sγ = |Γ|wτ. Of length w up to what the nodes do not resolve.
    pub tangent: [Vec<f64>; 2],
    /// Length |Γ|.
    pub length: f64,
    /// Weights w of the nodes in means over the curve; empty if all are 1. A motion changes them only where the metric is a
    /// field of the state, and a derivative by them is asked for only there: it is empty elsewhere.
    pub weight: Vec<f64>,
}

impl ShapeFields {
    /// Zeros at `nodes` nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        let field = || [vec![0.0; nodes], vec![0.0; nodes]];
        Self { position: field(), tangent: field(), length: 0.0, weight: Vec::new() }
    }

    /// Sets all to zero.
    pub fn clear(&mut self) {
        let fields = self.position.iter_mut().chain(&mut self.tangent);
        fields.chain([&mut self.weight]).for_each(|field| field.fill(0.0));
        self.length = 0.0;
    }

    /// Takes the values of `other`, on as many nodes, without allocating.
    pub fn copy_from(&mut self, other: &Self) {
        for axis in 0..2 {
            self.position[axis].copy_from_slice(&other.position[axis]);
            self.tangent[axis].copy_from_slice(&other.tangent[axis]);
        }
        self.weight.copy_from_slice(&other.weight);
        self.length = other.length;
    }

    /// Whether nothing has been added to it; NaN is something.
    pub(crate) fn is_zero(&self) -> bool {
        let fields = self.position.iter().chain(&self.tangent).chain([&self.weight]);
        self.length == 0.0 && fields.flatten().all(|value| *value == 0.0)
    }

    /// Positions by component.
    #[must_use]
    pub fn positions(&self) -> [&[f64]; 2] {
        [&self.position[0], &self.position[1]]
    }

    /// Tangents by component.
    #[must_use]
    pub fn tangents(&self) -> [&[f64]; 2] {
        [&self.tangent[0], &self.tangent[1]]
    }
}
