//! The Helmholtz operator H = −`Δ_s` + κ² on a curve of uniform metric, solved in `O(n)`. See `THEORY.md`, eq. (O5).
//!
//! With δ² the second difference and x = −δ², −∂_s² is n² x p(x)/M(x) for two polynomials, so H u = f is the banded
//! system (n²/L² x p(x) + M κ²) u = M f. Both sides are symmetric operators on the grid up to the common factor M, and
//! x = 0 on constants: H 1 = κ².

use std::fmt::Debug;

use super::cyclic_banded::CyclicBanded;
use super::derivative::DerivativeFamily;
use super::factorisation_error::FactorisationError;
use super::half_stencil::{add_convolution, half_stencil, pad, square, wrap};
use crate::geometry::vectors::add_scaled;

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
    /// A curvature, or a square of one, is infinite or not a number.
    #[error("|Γ|∫κ² dσ = {value:.3e}: the curvature, or its square, is not finite")]
    NotFinite { value: f64 },
    /// No curve has such a length.
    #[error("the length of the curve is {length:?}: it must be positive and finite")]
    NoLength { length: f64 },
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
const LEAST_CURVATURE: f64 = 1.0;
/// The root of p for staggered central differences: D₊ = δ(1 + x/24 + …), cut at the order of the family.
const STAGGERED: [f64; 4] = [1.0, 1.0 / 24.0, 3.0 / 640.0, 5.0 / 7168.0];
/// p and M of the compact difference of order 8, for the Fourier family; positive for all 0 ≤ x ≤ 4.
const COMPACT: [&[f64]; 2] = [&[1.0, -31.0 / 252.0], &[1.0, -13.0 / 63.0, 23.0 / 3780.0]];

/// The operator H = −`Δ_s` + κ² on equidistant nodes, factorised for one state: it solves Hu = f in `O(n)`. H is symmetric and positive on
/// every closed curve. See `THEORY.md`, eq. (O5); on graded nodes there is [`CurveHelmholtz`](super::CurveHelmholtz).
///
/// ```
/// use flow_core::operators::{DerivativeFamily, Helmholtz};
/// use std::f64::consts::TAU;
///
/// // On the unit circle κ = 1, and H cos 2s = (4 + 1) cos 2s.
/// let mut helmholtz = Helmholtz::new(DerivativeFamily::Fourier, 64);
/// helmholtz.set(&[1.0; 64], TAU)?;
/// let wave: Vec<f64> = (0..64).map(|i| (2.0 * TAU * i as f64 / 64.0).cos()).collect();
/// let mut u = [0.0; 64];
/// helmholtz.solve(&wave, &mut u);
/// assert!(u.iter().zip(&wave).all(|(u, wave)| (5.0 * u - wave).abs() < 1e-9));
/// # Ok::<(), flow_core::operators::HelmholtzError>(())
/// ```
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
    /// Whether the band holds a factorisation, that of the last state given.
    factorised: bool,
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
            factorised: self.factorised,
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
    ///
    /// # Panics
    /// If there are fewer nodes.
    #[must_use]
    pub fn new(family: DerivativeFamily, nodes: usize) -> Self {
        assert!(nodes >= Self::FEWEST_NODES, "H takes {} nodes at least, not {nodes}", Self::FEWEST_NODES);
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
            factorised: false,
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
    /// [`HelmholtzError`] if the curvature vanishes or is not finite, the length is not positive, or the factorisation fails: no
    /// factorisation is held then.
    /// # Panics
    /// If there is not one curvature per node.
    pub fn set(&mut self, curvature: &[f64], length: f64) -> Result<(), HelmholtzError> {
        assert_eq!(curvature.len(), self.nodes, "H takes one curvature per node");
        self.factorised = false;
        check_length(length)?;
        for (square, kappa) in self.residual.iter_mut().zip(curvature) {
            *square = kappa * kappa;
        }
        check_curvature(length * length * self.residual.iter().sum::<f64>() / self.nodes as f64)?;
        pad(&self.residual, &mut self.square);
        self.scale = (self.nodes as f64 / length).powi(2);
        self.band.assemble(&self.laplacian, self.scale, &self.mass, &self.square);
        self.band.factorise().map_err(HelmholtzError::Singular)?;
        self.factorised = true;
        Ok(())
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
    /// # Panics
    /// If `f` or `u` has another number of values, or no factorisation is held: before [`Helmholtz::set`], and after one that failed.
    pub fn solve(&mut self, f: &[f64], u: &mut [f64]) {
        check_solve(self.factorised, self.nodes, f, u);
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
        add_scaled(u, 1.0, &self.residual);
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

/// Refuses what is not the length of a curve.
pub(super) fn check_length(length: f64) -> Result<(), HelmholtzError> {
    if length > 0.0 && length.is_finite() { Ok(()) } else { Err(HelmholtzError::NoLength { length }) }
}

/// Refuses what is not |Γ|∫κ² dσ of a closed curve.
pub(super) fn check_curvature(value: f64) -> Result<(), HelmholtzError> {
    match value {
        _ if !value.is_finite() => Err(HelmholtzError::NotFinite { value }),
        _ if value < LEAST_CURVATURE => Err(HelmholtzError::NoCurvature { value }),
        _ => Ok(()),
    }
}

/// Panics unless H is `factorised` and both sides have one value per node.
pub(super) fn check_solve(factorised: bool, nodes: usize, f: &[f64], u: &[f64]) {
    assert!(factorised, "H is not factorised: it has not been set, or that failed");
    assert!(f.len() == nodes && u.len() == nodes, "both sides of H u = f have one value per node");
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
