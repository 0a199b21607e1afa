//! The Helmholtz operator H = −`Δ_s` + κ² on a curve of uniform metric, solved in `O(n)`. See `THEORY.md`, eq. (O5).
//!
//! With δ² the second difference and x = −δ², −∂_s² is n² x p(x)/M(x) for two polynomials, so H u = f is the banded
//! system (n²/L² x p(x) + M κ²) u = M f. Both sides are symmetric operators on the grid up to the common factor M, and
//! x = 0 on constants: H 1 = κ².

use std::fmt::Debug;

use super::cyclic_banded::{CyclicBanded, FactorisationError};
use super::derivative::DerivativeFamily;

/// H has no usable inverse.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum HelmholtzError {
    /// The curve is not closed: every closed curve has |Γ|∫κ² dσ ≥ 4π².
    #[error(
        "|Γ|∫κ² dσ = {value:.3e} at a state of the flow, below 4π², the least that a closed curve has; use a smaller \
         tolerance, or more nodes"
    )]
    NoCurvature { value: f64 },
    /// A pivot vanished.
    #[error("−Δ_s + κ²: {0}")]
    Singular(FactorisationError),
}

/// Nodes from which one step of refinement is taken: the rounding of an assembled band, 1e-16 n²/4π² relative to
/// κ², is then above 1e-12.
pub(super) const REFINED_FROM: usize = 512;
/// Half-width of the widest band, that of the staggered differences of order 8.
const WIDEST: usize = 7;
/// |Γ|∫κ² dσ below which H is taken for singular; 4π² is the least of a closed curve.
pub(super) const LEAST_CURVATURE: f64 = 1.0;
/// The root of p for staggered central differences: D₊ = δ(1 + x/24 + …), cut at the order of the family.
const STAGGERED: [f64; 4] = [1.0, 1.0 / 24.0, 3.0 / 640.0, 5.0 / 7168.0];
/// p and M of the compact difference of order 8, for the Fourier family; positive for all 0 ≤ x ≤ 4.
const COMPACT: [&[f64]; 2] = [&[1.0, -31.0 / 252.0], &[1.0, -13.0 / 63.0, 23.0 / 3780.0]];

/// The factorised operator of one state, with its scratch.
#[derive(Debug)]
pub struct Helmholtz {
    nodes: usize,
    /// Polynomials p and M in x.
    polynomials: [Vec<f64>; 2],
    /// Half stencils (offsets 0, 1, …) of p, M and n² x p.
    flux: Vec<f64>,
    mass: Vec<f64>,
    laplacian: Vec<f64>,
    band: Box<dyn Band>,
    scale: f64,
    /// κ², and two fields of scratch, each continued periodically by the half-width on both sides.
    square: Vec<f64>,
    padded: Vec<f64>,
    difference: Vec<f64>,
    residual: Vec<f64>,
}

impl Clone for Helmholtz {
    fn clone(&self) -> Self {
        Self {
            nodes: self.nodes,
            polynomials: self.polynomials.clone(),
            flux: self.flux.clone(),
            mass: self.mass.clone(),
            laplacian: self.laplacian.clone(),
            band: self.band.boxed_clone(),
            scale: self.scale,
            square: self.square.clone(),
            padded: self.padded.clone(),
            difference: self.difference.clone(),
            residual: self.residual.clone(),
        }
    }
}

impl Helmholtz {
    /// Fewest nodes that every family can be used on.
    pub const FEWEST_NODES: usize = 21;

    /// Room for H on `nodes` ≥ [`Self::FEWEST_NODES`] nodes with the second difference D₋D₊ of a central family; for the
    /// Fourier family with a compact one of order 8.
    #[must_use]
    pub fn new(family: DerivativeFamily, nodes: usize) -> Self {
        let (numerator, mass) = match family.order() {
            None => (COMPACT[0].to_vec(), COMPACT[1].to_vec()),
            Some(order) => (square(&STAGGERED[..order as usize / 2]), vec![1.0]),
        };
        let by_x: Vec<f64> = std::iter::once(0.0).chain(numerator.iter().copied()).collect();
        let laplacian = half_stencil(&by_x);
        let width = laplacian.len() - 1;
        let padded = vec![0.0; nodes + 2 * width];
        Self {
            nodes,
            flux: half_stencil(&numerator),
            mass: half_stencil(&mass),
            laplacian,
            polynomials: [numerator, mass],
            band: band(width, nodes),
            scale: 0.0,
            square: padded.clone(),
            padded: padded.clone(),
            difference: padded,
            residual: vec![0.0; nodes],
        }
    }

    /// Symbol of the second difference −∂_s² of H on Fourier mode `mode`, per unit parameter.
    #[must_use]
    pub fn minus_laplacian(&self, mode: usize) -> f64 {
        let n = self.nodes as f64;
        let x = 4.0 * (std::f64::consts::PI * mode as f64 / n).sin().powi(2);
        let [p, m] = self.polynomials.each_ref().map(|p| p.iter().rev().fold(0.0, |sum, c| sum * x + c));
        n * n * x * p / m
    }

    /// Factorises H for the nodal `curvature` on a curve of length `length`, without allocating.
    ///
    /// # Errors
    /// [`HelmholtzError`] if the curvature vanishes or is not finite, or the factorisation fails.
    pub fn set(&mut self, curvature: &[f64], length: f64) -> Result<(), HelmholtzError> {
        for (square, kappa) in self.residual.iter_mut().zip(curvature) {
            *square = kappa * kappa;
        }
        let value = length * length * self.residual.iter().sum::<f64>() / self.nodes as f64;
        if !(value >= LEAST_CURVATURE && value.is_finite()) {
            return Err(HelmholtzError::NoCurvature { value });
        }
        pad(&self.residual, &mut self.square);
        self.scale = (self.nodes as f64 / length).powi(2);
        self.band.assemble(&self.laplacian, self.scale, &self.mass, &self.square);
        self.band.factorise().map_err(HelmholtzError::Singular)
    }

    /// Solves H u = f with the factorisation held, in `O(n)`, without allocating.
    ///
    /// # Shapes
    /// `f` and `u`: one value per node.
    /// # Units
    /// `u` has the unit of `f` times length².
    /// # Source
    /// `THEORY.md`, eq. (O5). On many nodes one step of refinement follows, with the residual as differences of
    /// differences: it takes out the rounding of the assembled band.
    pub fn solve(&mut self, f: &[f64], u: &mut [f64]) {
        pad(f, &mut self.padded);
        u.fill(0.0);
        add_convolution(&self.mass, 1.0, &self.padded, u);
        self.band.solve(u);
        if self.nodes >= REFINED_FROM {
            self.refine(f, u);
        }
    }

    fn refine(&mut self, f: &[f64], u: &mut [f64]) {
        self.write_residual(f, u);
        self.band.solve(&mut self.residual);
        for (u, correction) in u.iter_mut().zip(&self.residual) {
            *u += correction;
        }
    }

    /// M(f − κ²u) − n²/L² p x u.
    fn write_residual(&mut self, f: &[f64], u: &[f64]) {
        let width = (self.padded.len() - self.nodes) / 2;
        for (i, residual) in self.residual.iter_mut().enumerate() {
            *residual = f[i] - self.square[i + width] * u[i];
        }
        pad(&self.residual, &mut self.padded);
        self.residual.fill(0.0);
        add_convolution(&self.mass, 1.0, &self.padded, &mut self.residual);
        pad(u, &mut self.padded);
        for i in width..width + self.nodes {
            let (left, right) = (self.padded[i] - self.padded[i - 1], self.padded[i + 1] - self.padded[i]);
            self.difference[i] = left - right;
        }
        wrap(&mut self.difference, width);
        add_convolution(&self.flux, -self.scale, &self.difference, &mut self.residual);
    }
}

/// A cyclic band of any half-width.
trait Band: Debug + Send + Sync {
    /// Fills in scale × `laplacian` + `mass` κ², half stencils with κ² (continued periodically) to their right.
    fn assemble(&mut self, laplacian: &[f64], scale: f64, mass: &[f64], square: &[f64]);
    fn factorise(&mut self) -> Result<(), FactorisationError>;
    fn solve(&mut self, x: &mut [f64]);
    fn boxed_clone(&self) -> Box<dyn Band>;
}

impl<const B: usize> Band for CyclicBanded<B> {
    fn assemble(&mut self, laplacian: &[f64], scale: f64, mass: &[f64], square: &[f64]) {
        let mass_at = |k: usize| mass.get(k).copied().unwrap_or(0.0);
        let (stiff, mass): ([f64; B], [f64; B]) =
            (std::array::from_fn(|k| scale * laplacian[k + 1]), std::array::from_fn(|k| mass_at(k + 1)));
        let (stiff_here, mass_here) = (scale * laplacian[0], mass_at(0));
        let mut entries = [0.0; 2 * WIDEST + 1];
        self.clear();
        for row in 0..self.rows() {
            let square = &square[row..=row + 2 * B];
            entries[B] = stiff_here + mass_here * square[B];
            for k in 0..B {
                entries[B - 1 - k] = stiff[k] + mass[k] * square[B - 1 - k];
                entries[B + 1 + k] = stiff[k] + mass[k] * square[B + 1 + k];
            }
            self.set_row(row, -(B as isize), &entries[..=2 * B]);
        }
    }

    fn factorise(&mut self) -> Result<(), FactorisationError> {
        self.factorise()
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.solve(x);
    }

    fn boxed_clone(&self) -> Box<dyn Band> {
        Box::new(self.clone())
    }
}

fn band(width: usize, nodes: usize) -> Box<dyn Band> {
    match width {
        1 => Box::new(CyclicBanded::<1>::new(nodes)),
        2 => Box::new(CyclicBanded::<2>::new(nodes)),
        3 => Box::new(CyclicBanded::<3>::new(nodes)),
        5 => Box::new(CyclicBanded::<5>::new(nodes)),
        _ => Box::new(CyclicBanded::<WIDEST>::new(nodes)),
    }
}

/// Square of a polynomial.
fn square(polynomial: &[f64]) -> Vec<f64> {
    let mut square = vec![0.0; 2 * polynomial.len() - 1];
    for (i, a) in polynomial.iter().enumerate() {
        for (j, b) in polynomial.iter().enumerate() {
            square[i + j] += a * b;
        }
    }
    square
}

/// Coefficients at the offsets 0, 1, … of a polynomial in x = −δ², by Horner's rule.
fn half_stencil(polynomial: &[f64]) -> Vec<f64> {
    let width = polynomial.len() - 1;
    let mut stencil = vec![0.0; width + 1];
    for coefficient in polynomial.iter().rev() {
        let at = |k: isize| stencil.get(k.unsigned_abs()).copied().unwrap_or(0.0);
        stencil = (0..=width as isize).map(|k| 2.0 * at(k) - at(k - 1) - at(k + 1)).collect();
        stencil[0] += coefficient;
    }
    stencil
}

/// Copies nodal values between the margins, and fills these.
fn pad(values: &[f64], padded: &mut [f64]) {
    let width = (padded.len() - values.len()) / 2;
    padded[width..width + values.len()].copy_from_slice(values);
    wrap(padded, width);
}

/// Fills the margins by the periodic continuation.
fn wrap(padded: &mut [f64], width: usize) {
    let nodes = padded.len() - 2 * width;
    padded.copy_within(nodes..nodes + width, 0);
    padded.copy_within(width..2 * width, nodes + width);
}

/// out += factor × stencil ∗ padded.
fn add_convolution(half: &[f64], factor: f64, padded: &[f64], out: &mut [f64]) {
    let (nodes, width) = (out.len(), (padded.len() - out.len()) / 2);
    for (k, coefficient) in half.iter().enumerate() {
        let weight = factor * if k == 0 { 0.5 * coefficient } else { *coefficient };
        let (left, right) = (&padded[width - k..][..nodes], &padded[width + k..][..nodes]);
        for ((out, left), right) in out.iter_mut().zip(left).zip(right) {
            *out += weight * (left + right);
        }
    }
}
