//! The Helmholtz operator H = −`Δ_s` + κ² on uniform or graded nodes. See `THEORY.md`, eqs. (O5) and (O7).

use super::cyclic_banded::CyclicBanded;
use super::derivative::{Derivative, DerivativeFamily};
use super::helmholtz::{Helmholtz, HelmholtzError, REFINED_FROM, check_curvature, check_length, check_solve};
use crate::geometry::Grading;
use crate::geometry::vectors::{add_scaled, mean_of_triple_product};

/// H = −`Δ_s` + κ² of a curve, factorised for one state, in the metric of its nodes: equidistant, or graded as its derivative is. See
/// `THEORY.md`, eqs. (O5) and (O7).
#[derive(Clone, Debug)]
pub struct CurveHelmholtz(On);

/// By the kind of nodes.
#[derive(Clone, Debug)]
enum On {
    Uniform(Box<Helmholtz>),
    Graded(Box<GradedHelmholtz>),
}

impl CurveHelmholtz {
    /// Room for H on `nodes` ≥ [`Helmholtz::FEWEST_NODES`] nodes in the metric of `derivative`.
    ///
    /// # Panics
    /// If there are fewer nodes, or `derivative` is graded on another number of them.
    #[must_use]
    pub fn new(derivative: &Derivative, nodes: usize) -> Self {
        match derivative.grading() {
            None => Self(On::Uniform(Box::new(Helmholtz::new(derivative.family(), nodes)))),
            Some(grading) => {
                assert_eq!(grading.nodes(), nodes, "the derivative is graded on other nodes");
                Self(On::Graded(Box::new(GradedHelmholtz::new(derivative.family(), nodes))))
            }
        }
    }

    /// Factorises H for the nodal `curvature` on a curve of length `length` whose nodes have the `grading`, none if they are uniform,
    /// without allocating.
    ///
    /// # Errors
    /// [`HelmholtzError`] if the curvature vanishes or is not finite, the length is not positive, or the factorisation fails: no
    /// factorisation is held then.
    /// # Panics
    /// If there is not one curvature per node, or the operator was made for graded nodes and these are not, or the other way round.
    pub fn set(
        &mut self,
        grading: Option<&Grading>,
        curvature: &[f64],
        length: f64,
    ) -> Result<(), HelmholtzError> {
        match (&mut self.0, grading) {
            (On::Uniform(operator), None) => operator.set(curvature, length),
            (On::Graded(operator), Some(grading)) => operator.set(grading, curvature, length),
            (_, grading) => panic!("H was made for other nodes than those of the grading {grading:?}"),
        }
    }

    /// Solves H u = f with the factorisation held. Shapes: one value per node.
    ///
    /// # Panics
    /// If `f` or `u` has another number of values, or no factorisation is held: before [`Self::set`], and after one that failed.
    pub fn solve(&mut self, f: &[f64], u: &mut [f64]) {
        match &mut self.0 {
            On::Uniform(operator) => operator.solve(f, u),
            On::Graded(operator) => operator.solve(f, u),
        }
    }
}

/// Half-width of the band: that of staggered differences of order 8, which stand in for the Fourier family.
const WIDTH: usize = 7;

/// (S/|Γ|² + wκ²)u = wf with S = D₊ᵀ(1/w)D₊ by staggered differences.
#[derive(Clone, Debug)]
struct GradedHelmholtz {
    /// w at the nodes and 1/w at the midpoints.
    weight: Vec<f64>,
    inverse_at_midpoints: Vec<f64>,
    /// Coefficients of D₊ per node distance, of the differences u(i+1+j) − u(i−j).
    stencil: &'static [f64],
    band: CyclicBanded<WIDTH>,
    /// Whether the band holds a factorisation, that of the last state given.
    factorised: bool,
    scale: f64,
    /// wκ².
    square: Vec<f64>,
    slope: Vec<f64>,
    residual: Vec<f64>,
}

impl GradedHelmholtz {
    fn new(family: DerivativeFamily, nodes: usize) -> Self {
        Self {
            weight: vec![1.0; nodes],
            inverse_at_midpoints: vec![1.0; nodes],
            stencil: family.differences(),
            band: CyclicBanded::new(nodes),
            factorised: false,
            scale: 0.0,
            square: vec![0.0; nodes],
            slope: vec![0.0; nodes],
            residual: vec![0.0; nodes],
        }
    }

    fn set(&mut self, grading: &Grading, curvature: &[f64], length: f64) -> Result<(), HelmholtzError> {
        assert_eq!(curvature.len(), self.square.len(), "H takes one curvature per node");
        self.factorised = false;
        check_length(length)?;
        self.weight.copy_from_slice(grading.weight());
        self.inverse_at_midpoints.copy_from_slice(grading.inverse_at_midpoints());
        let weight = &self.weight;
        check_curvature(length * length * mean_of_triple_product(weight, curvature, curvature))?;
        for ((square, kappa), weight) in self.square.iter_mut().zip(curvature).zip(weight) {
            *square = weight * kappa * kappa;
        }
        let nodes = self.square.len();
        self.scale = (nodes as f64 / length).powi(2);
        self.band.clear();
        let inverse = &self.inverse_at_midpoints;
        let reach = self.stencil.len() as isize;
        // Weight in D₊ of the node `offset` nodes after the one before the midpoint.
        let of = |offset: isize| {
            if offset > 0 { self.stencil[offset as usize - 1] } else { -self.stencil[offset.unsigned_abs()] }
        };
        for row in 0..nodes {
            let mut entries = [0.0; 2 * WIDTH + 1];
            entries[WIDTH] = self.square[row];
            for here in 1 - reach..=reach {
                let midpoint = (row as isize - here).rem_euclid(nodes as isize) as usize;
                let factor = self.scale * inverse[midpoint] * of(here);
                for there in 1 - reach..=reach {
                    entries[(WIDTH as isize + there - here) as usize] += factor * of(there);
                }
            }
            self.band.set_row(row, -(WIDTH as isize), &entries);
        }
        self.band.factorise().map_err(HelmholtzError::Singular)?;
        self.factorised = true;
        Ok(())
    }

    fn solve(&mut self, f: &[f64], u: &mut [f64]) {
        check_solve(self.factorised, self.square.len(), f, u);
        for ((u, f), weight) in u.iter_mut().zip(f).zip(&self.weight) {
            *u = weight * f;
        }
        self.band.solve(u);
        if u.len() >= REFINED_FROM {
            self.write_residual(f, u);
            self.band.solve(&mut self.residual);
            add_scaled(u, 1.0, &self.residual);
        }
    }

    /// w f − wκ²u − D₊ᵀ(1/w)D₊u/|Γ|², as differences of differences.
    fn write_residual(&mut self, f: &[f64], u: &[f64]) {
        let nodes = u.len();
        for i in 0..nodes {
            let difference =
                |(j, d): (usize, &f64)| d * (u[(i + 1 + j) % nodes] - u[(i + nodes - j) % nodes]);
            let slope: f64 = self.stencil.iter().enumerate().map(difference).sum();
            self.slope[i] = self.scale * self.inverse_at_midpoints[i] * slope;
        }
        for i in 0..nodes {
            // D₊ᵀ takes the midpoints before minus those after.
            let difference = |(j, d): (usize, &f64)| {
                d * (self.slope[(i + nodes - 1 - j) % nodes] - self.slope[(i + j) % nodes])
            };
            let divergence: f64 = self.stencil.iter().enumerate().map(difference).sum();
            self.residual[i] = self.weight[i] * f[i] - self.square[i] * u[i] - divergence;
        }
    }
}
