//! Nodal fields, and a local density with its derivatives by them.

/// Pointwise fields φ₀ … φ_{m−1}, one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    nodes: usize,
    values: &'a [f64],
}

impl<'a> Fields<'a> {
    /// Wraps `values`, whose length is a multiple of `nodes`.
    ///
    /// # Panics
    /// If it is not, or `nodes` is 0.
    #[must_use]
    pub fn new(nodes: usize, values: &'a [f64]) -> Self {
        assert!(nodes > 0 && values.len().is_multiple_of(nodes), "whole fields of one node at least");
        Self { nodes, values }
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of fields.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len() / self.nodes
    }

    /// Field `field`.
    ///
    /// # Panics
    /// If there is no such field.
    #[must_use]
    pub fn get(&self, field: usize) -> &'a [f64] {
        assert!(field < self.count(), "field {field} of {}", self.count());
        &self.values[field * self.nodes..(field + 1) * self.nodes]
    }
}

/// How many derivatives are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// The value alone.
    Value,
    /// Value and first derivatives.
    Gradient,
    /// Value, first and second derivatives.
    Hessian,
}

/// A local density e and its derivatives by the fields, at every node.
#[derive(Clone, Debug)]
pub struct Jet {
    nodes: usize,
    fields: usize,
    order: Order,
    value: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
}

impl Jet {
    /// A zero jet of a function of `fields` fields.
    #[must_use]
    pub fn new(nodes: usize, fields: usize) -> Self {
        Self {
            nodes,
            fields,
            order: Order::Value,
            value: vec![0.0; nodes],
            first: vec![0.0; nodes * fields],
            second: vec![0.0; nodes * fields * (fields + 1) / 2],
        }
    }

    /// Sets all to zero and the order that terms shall add up to.
    pub fn clear(&mut self, order: Order) {
        self.order = order;
        self.value.fill(0.0);
        if order >= Order::Gradient {
            self.first.fill(0.0);
        }
        if order >= Order::Hessian {
            self.second.fill(0.0);
        }
    }

    /// Sets the order, for a term that sets the rest.
    pub fn set_order(&mut self, order: Order) {
        self.order = order;
    }

    /// Derivatives that terms shall add.
    #[must_use]
    pub fn order(&self) -> Order {
        self.order
    }

    /// Number of fields.
    #[must_use]
    pub fn fields(&self) -> usize {
        self.fields
    }

    /// e at the nodes.
    #[must_use]
    pub fn value(&self) -> &[f64] {
        &self.value
    }

    /// ∂e/∂φ at the nodes, φ = field `field`.
    ///
    /// # Panics
    /// If there is no such field.
    #[must_use]
    pub fn first(&self, field: usize) -> &[f64] {
        &self.first[field * self.nodes..(field + 1) * self.nodes]
    }

    /// ∂²e/∂φ∂ψ at the nodes.
    ///
    /// # Panics
    /// If there are no such fields.
    #[must_use]
    pub fn second(&self, a: usize, b: usize) -> &[f64] {
        let block = Self::block(a, b);
        &self.second[block * self.nodes..(block + 1) * self.nodes]
    }

    /// Whether all second derivatives are finite.
    #[must_use]
    pub fn has_finite_second(&self) -> bool {
        self.second.iter().all(|value| value.is_finite())
    }

    /// Whether nothing has been added to it; NaN is something.
    pub(crate) fn is_zero(&self) -> bool {
        [&self.value, &self.first, &self.second].into_iter().flatten().all(|value| *value == 0.0)
    }

    /// e at the nodes, to be added to.
    pub fn value_mut(&mut self) -> &mut [f64] {
        &mut self.value
    }

    /// e and ∂e/∂φ, to be added to.
    ///
    /// # Panics
    /// If there is no such field.
    pub fn value_and_first_mut(&mut self, field: usize) -> (&mut [f64], &mut [f64]) {
        (&mut self.value, &mut self.first[field * self.nodes..(field + 1) * self.nodes])
    }

    /// ∂e/∂φ, to be added to.
    ///
    /// # Panics
    /// If there is no such field.
    pub fn first_mut(&mut self, field: usize) -> &mut [f64] {
        &mut self.first[field * self.nodes..(field + 1) * self.nodes]
    }

    /// ∂²e/∂φ∂ψ, to be added to.
    ///
    /// # Panics
    /// If there are no such fields.
    pub fn second_mut(&mut self, a: usize, b: usize) -> &mut [f64] {
        let block = Self::block(a, b);
        &mut self.second[block * self.nodes..(block + 1) * self.nodes]
    }

    /// Position of the block (a, b) in packed lower-triangular order.
    fn block(a: usize, b: usize) -> usize {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        high * (high + 1) / 2 + low
    }
}
