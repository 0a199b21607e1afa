//! From curvature and length to tangent angle and position: ∂_sθ = K, ∂_sγ = |Γ| τ(θ).
//! See `THEORY.md`, eqs. (G3) and (G4).

use std::sync::Arc;

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};
use super::unit_vectors::unit_vectors;
use super::vectors::{add_ramp, mean_of_product, multiply, sum};

/// Where a curve lies: what curvature and length leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// Mean over the curve of θ − 2πωx, the tangent angle less its turning; x is the fraction of the arc length.
    pub angle: f64,
    /// Mean position of the curve.
    pub centre: [f64; 2],
}

/// Computes tangents and positions; holds all its scratch.
#[derive(Clone, Debug)]
pub struct Embedding {
    grid: PeriodicGrid,
    grading: Option<Arc<Grading>>,
    spectrum: Vec<Complex64>,
    theta: Vec<f64>,
    tangent: [Vec<f64>; 2],
    position: [Vec<f64>; 2],
    shape: [Vec<Complex64>; 2],
    gap: [f64; 2],
}

impl Embedding {
    /// An embedding of uniform nodes.
    #[must_use]
    pub fn new(nodes: usize) -> Self {
        Self::graded(nodes, None)
    }

    /// An embedding of nodes that may be graded.
    #[must_use]
    pub fn graded(nodes: usize, grading: Option<Arc<Grading>>) -> Self {
        let grid = PeriodicGrid::new(nodes);
        let field = vec![0.0; nodes];
        Self {
            spectrum: vec![Complex64::default(); grid.modes()],
            shape: [vec![Complex64::default(); grid.modes()], vec![Complex64::default(); grid.modes()]],
            grid,
            grading,
            theta: field.clone(),
            tangent: [field.clone(), field.clone()],
            position: [field.clone(), field],
            gap: [0.0; 2],
        }
    }

    /// Goes on with the metric `grading`, on as many nodes.
    pub fn follow(&mut self, grading: &Grading) {
        match &mut self.grading {
            Some(own) => Arc::make_mut(own).copy_from(grading),
            None => self.grading = Some(Arc::new(grading.clone())),
        }
    }

    /// Tangents and closure gap of the curve with turning per parameter `turning` (nodal) and length `length`,
    /// with mean tangent angle `angle`. Call before the accessors.
    ///
    /// # Panics
    /// If there is not one value per node.
    pub fn set_tangent(&mut self, turning: &[f64], length: f64, angle: f64) {
        self.grid.transform(turning, &mut self.spectrum);
        self.tangent_of_spectrum(length, angle);
    }

    /// As [`Embedding::set_tangent`], from the spectrum of the turning.
    ///
    /// # Panics
    /// If there are not [`PeriodicGrid::modes`] coefficients.
    pub fn set_tangent_spectrum(&mut self, turning: &[Complex64], length: f64, angle: f64) {
        assert_eq!(turning.len(), self.spectrum.len(), "Fourier coefficients of the turning");
        self.spectrum.copy_from_slice(turning);
        self.tangent_of_spectrum(length, angle);
    }

    fn tangent_of_spectrum(&mut self, length: f64, angle: f64) {
        let nodes = self.grid.nodes() as f64;
        let turning = self.spectrum[0].re;
        let turning_per_node = turning / nodes;
        self.grid.integrate(&mut self.spectrum);
        self.grid.synthesise(&self.spectrum, &mut self.theta);
        let angle = match &self.grading {
            None => angle,
            Some(grading) => {
                angle + turning * grading.mean_shift() - mean_of_product(grading.weight(), &self.theta)
            }
        };
        add_ramp(&mut self.theta, angle, turning_per_node);
        let [cosine, sine] = &mut self.tangent;
        unit_vectors(&self.theta, cosine, sine);
        if let Some(grading) = &self.grading {
            multiply(cosine, grading.weight());
            multiply(sine, grading.weight());
        }
        for axis in 0..2 {
            self.gap[axis] = sum(&self.tangent[axis]) * length / nodes;
        }
    }

    /// Spectra of the positions per length, mean zero, for the tangents set last; the gap is spread evenly.
    pub fn shape_spectra(&mut self) -> [&[Complex64]; 2] {
        for axis in 0..2 {
            self.grid.transform(&self.tangent[axis], &mut self.shape[axis]);
            self.grid.integrate(&mut self.shape[axis]);
        }
        [&self.shape[0], &self.shape[1]]
    }

    /// Positions for the tangents set last, with mean position `centre`; the gap is spread evenly.
    pub fn set_position(&mut self, length: f64, centre: [f64; 2]) {
        self.shape_spectra();
        for axis in 0..2 {
            self.grid.synthesise(&self.shape[axis], &mut self.position[axis]);
            let centre = match &self.grading {
                None => centre[axis],
                Some(grading) => {
                    centre[axis] - length * mean_of_product(grading.weight(), &self.position[axis])
                }
            };
            for x in &mut self.position[axis] {
                *x = centre + length * *x;
            }
        }
    }

    /// Tangent angle θ at the nodes.
    #[must_use]
    pub fn tangent_angle(&self) -> &[f64] {
        &self.theta
    }

    /// Tangent per length, wτ with τ = (cos θ, sin θ), at the nodes, by component: ∂_sγ = |Γ|wτ, w = 1 on uniform nodes.
    #[must_use]
    pub fn tangent(&self) -> [&[f64]; 2] {
        [&self.tangent[0], &self.tangent[1]]
    }

    /// Position γ at the nodes, by component.
    #[must_use]
    pub fn position(&self) -> [&[f64]; 2] {
        [&self.position[0], &self.position[1]]
    }

    /// Gap γ(1) − γ(0) = ∫τ dσ.
    #[must_use]
    pub fn gap(&self) -> [f64; 2] {
        self.gap
    }
}
