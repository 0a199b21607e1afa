//! Packing of a blend: ∫ (ρᵀPρ − 1)²/(2ε) dσ over all densities. See `THEORY.md`, eq. (E9).

use super::{EnergyTerm, Fields, Jet, Order};

/// Penalty that keeps the densities of a blend on the ellipsoid ρᵀPρ = 1.
#[derive(Clone, Debug)]
pub struct Packing {
    densities: usize,
    /// P by rows.
    matrix: Vec<f64>,
    by_epsilon: f64,
    /// ρᵀPρ − 1 and then (Pρ)ᵢ, at the nodes.
    excess: Vec<f64>,
    products: Vec<f64>,
}

impl Packing {
    /// The penalty with the symmetric positive definite `matrix` P (rows of one entry per density) and ε > 0, for
    /// `nodes` nodes.
    ///
    /// # Panics
    /// If P is not square, or ε not positive.
    #[must_use]
    pub fn new(matrix: &[Vec<f64>], epsilon: f64, nodes: usize) -> Self {
        let densities = matrix.len();
        assert!(epsilon > 0.0, "a packing of width {epsilon:?}: it must be positive");
        assert!(matrix.iter().all(|row| row.len() == densities), "P is square");
        Self {
            densities,
            matrix: matrix.concat(),
            by_epsilon: 1.0 / epsilon,
            excess: vec![0.0; nodes],
            products: vec![0.0; densities * nodes],
        }
    }
}

impl EnergyTerm for Packing {
    fn name(&self) -> &'static str {
        "packing"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let (nodes, densities, by_epsilon) = (fields.nodes(), self.densities, self.by_epsilon);
        self.excess.fill(-1.0);
        for (a, product) in self.products.chunks_exact_mut(nodes).enumerate() {
            product.fill(0.0);
            for (b, p) in self.matrix[a * densities..(a + 1) * densities].iter().enumerate() {
                product.iter_mut().zip(fields.get(1 + b)).for_each(|(product, rho)| *product += p * rho);
            }
            let products = product.iter().zip(fields.get(1 + a));
            self.excess
                .iter_mut()
                .zip(products)
                .for_each(|(excess, (product, rho))| *excess += product * rho);
        }
        let value = jet.value_mut().iter_mut().zip(&self.excess);
        value.for_each(|(value, excess)| *value += 0.5 * by_epsilon * excess * excess);
        for (a, product) in self.products.chunks_exact(nodes).enumerate() {
            let first = jet.first_mut(1 + a).iter_mut().zip(&self.excess).zip(product);
            first.for_each(|((first, excess), product)| *first += 2.0 * by_epsilon * excess * product);
            if jet.order() < Order::Hessian {
                continue;
            }
            for (b, other) in self.products.chunks_exact(nodes).enumerate().take(a + 1) {
                let p = self.matrix[a * densities + b];
                let second = jet.second_mut(1 + a, 1 + b).iter_mut().zip(&self.excess);
                for ((second, excess), (product, other)) in second.zip(product.iter().zip(other)) {
                    *second += by_epsilon * (4.0 * product * other + 2.0 * excess * p);
                }
            }
        }
    }
}
