//! Discrete derivatives on the periodic grid, each given by its Fourier symbol.
//!
//! A family has a derivative from the nodes to the flux points, D₊, its negative transpose D₋ from the flux
//! points back to the nodes, an interpolation M to the flux points and the second derivative D₋D₊. Transposes
//! are conjugate symbols, so D₊ᵀ = −D₋ holds to rounding by construction. See `THEORY.md`, eq. (D16).
//!
//! On graded nodes the symbols are those per unit parameter, and `Δ_s` = D₋(1/w)D₊/(|Γ|²w) with the grading w that is
//! kept here. The flux points are midpoints then for every family.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::{Complex64, Grading, PeriodicGrid};

/// Family of discrete derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DerivativeFamily {
    /// Exact on trigonometric polynomials; flux points are the nodes.
    #[default]
    Fourier,
    /// Staggered central differences of order 2; flux points are the midpoints, as in all of order 2 to 8.
    #[serde(rename = "central-2")]
    Central2,
    /// Staggered central differences of order 4.
    #[serde(rename = "central-4")]
    Central4,
    /// Staggered central differences of order 6.
    #[serde(rename = "central-6")]
    Central6,
    /// Staggered central differences of order 8.
    #[serde(rename = "central-8")]
    Central8,
}

/// Weights of the differences f(i+½+j) − f(i−½−j), and of the means of the same pairs.
struct Stencil {
    difference: &'static [f64],
    mean: &'static [f64],
}

const CENTRAL_2: Stencil = Stencil { difference: &[1.0], mean: &[1.0] };
const CENTRAL_4: Stencil = Stencil { difference: &[9.0 / 8.0, -1.0 / 24.0], mean: &[9.0 / 8.0, -1.0 / 8.0] };
const CENTRAL_6: Stencil = Stencil {
    difference: &[75.0 / 64.0, -25.0 / 384.0, 3.0 / 640.0],
    mean: &[150.0 / 128.0, -25.0 / 128.0, 3.0 / 128.0],
};
const CENTRAL_8: Stencil = Stencil {
    difference: &[1225.0 / 1024.0, -245.0 / 3072.0, 49.0 / 5120.0, -5.0 / 7168.0],
    mean: &[1225.0 / 1024.0, -245.0 / 1024.0, 49.0 / 1024.0, -5.0 / 1024.0],
};

impl DerivativeFamily {
    /// Every family.
    pub const ALL: [Self; 5] =
        [Self::Fourier, Self::Central2, Self::Central4, Self::Central6, Self::Central8];

    /// Order of the error in the node distance; none for the Fourier derivative.
    #[must_use]
    pub fn order(self) -> Option<i32> {
        match self {
            Self::Fourier => None,
            Self::Central2 => Some(2),
            Self::Central4 => Some(4),
            Self::Central6 => Some(6),
            Self::Central8 => Some(8),
        }
    }

    /// Relative error of the second derivative of a wave that turns by `angle` from node to node.
    #[must_use]
    pub fn symbol_error(self, angle: f64) -> f64 {
        let Some(stencil) = self.stencil() else { return 0.0 };
        // sin(j + ½)θ from the two before it.
        let sine = (0.5 * angle).sin();
        let (mut before, mut wave, mut difference) = (-sine, sine, 0.0);
        for c in stencil.difference {
            difference += 2.0 * c * wave;
            (before, wave) = (wave, (2.0 - 4.0 * sine * sine) * wave - before);
        }
        if angle == 0.0 { 0.0 } else { 1.0 - (difference / angle).powi(2) }
    }

    /// Coefficients of the staggered difference, that of order 8 for the Fourier family.
    pub(super) fn differences(self) -> &'static [f64] {
        self.stencil().unwrap_or(&CENTRAL_8).difference
    }

    fn stencil(self) -> Option<&'static Stencil> {
        match self {
            Self::Fourier => None,
            Self::Central2 => Some(&CENTRAL_2),
            Self::Central4 => Some(&CENTRAL_4),
            Self::Central6 => Some(&CENTRAL_6),
            Self::Central8 => Some(&CENTRAL_8),
        }
    }
}

/// The symbols of one family on one grid, per unit parameter: by what each Fourier mode is multiplied.
///
/// D₊ takes nodal values to their derivatives at the flux points, M to their values there; D₋ = −D₊ᵀ leads back, and −D₋D₊ ≥ 0 stands
/// for −`Δ_s` (with |Γ|², and w on graded nodes). See `THEORY.md`, eq. (D16).
#[derive(Clone, Debug)]
pub struct Derivative {
    family: DerivativeFamily,
    nodes: usize,
    to_flux: Vec<Complex64>,
    inverse_to_flux: Vec<Complex64>,
    interpolation: Option<Vec<Complex64>>,
    minus_laplacian: Vec<f64>,
    grading: Option<Arc<Grading>>,
}

impl Derivative {
    /// Builds the symbols of `family` for `grid` with uniform nodes.
    #[must_use]
    pub fn new(family: DerivativeFamily, grid: &PeriodicGrid) -> Self {
        Self::graded(family, grid, None)
    }

    /// Builds the symbols of `family` for `grid`, whose nodes may be graded.
    ///
    /// The Fourier derivative to graded nodes goes to the midpoints and sees the sawtooth: at the nodes D₊ᵀ(1/w)D₊ would
    /// lose it.
    ///
    /// # Panics
    /// If the grading has another number of nodes.
    #[must_use]
    pub fn graded(family: DerivativeFamily, grid: &PeriodicGrid, grading: Option<Arc<Grading>>) -> Self {
        let midpoints = grading.is_some();
        Self::build(family, grid, grading, midpoints)
    }

    /// The same with the midpoints for flux points, whatever the family: for energies of slopes, which at the nodes cost the sawtooth
    /// nothing.
    ///
    /// # Panics
    /// If the grading has another number of nodes.
    #[must_use]
    pub fn staggered(family: DerivativeFamily, grid: &PeriodicGrid, grading: Option<Arc<Grading>>) -> Self {
        Self::build(family, grid, grading, true)
    }

    /// The same with the midpoints for flux points; itself where they are.
    #[must_use]
    pub fn at_midpoints(&self, grid: &PeriodicGrid) -> Self {
        match self.interpolation {
            Some(_) => self.clone(),
            None => Self::staggered(self.family, grid, self.grading.clone()),
        }
    }

    fn build(
        family: DerivativeFamily,
        grid: &PeriodicGrid,
        grading: Option<Arc<Grading>>,
        midpoints: bool,
    ) -> Self {
        let fits = grading.as_ref().is_none_or(|grading| grading.nodes() == grid.nodes());
        assert!(fits, "a grading of other nodes than the {} of the grid", grid.nodes());
        let to_flux: Vec<_> =
            (0..grid.modes()).map(|mode| Self::flux_symbol(family, midpoints, grid, mode)).collect();
        let inverse_to_flux = to_flux
            .iter()
            .map(|d| if d.norm_sqr() == 0.0 { Complex64::default() } else { 1.0 / d })
            .collect();
        let symbols = |symbol: &dyn Fn(usize) -> Complex64| (0..grid.modes()).map(symbol).collect::<Vec<_>>();
        let interpolation = match family.stencil() {
            Some(stencil) => Some(symbols(&|mode| Self::mean_symbol(stencil, grid, mode))),
            None if midpoints => Some(symbols(&|mode| grid.half_step(mode))),
            None => None,
        };
        // The nodal Fourier derivative loses the sawtooth; the second derivative must not.
        let minus_laplacian = (0..grid.modes())
            .map(|mode| match family {
                DerivativeFamily::Fourier => grid.wave_number(mode).powi(2),
                _ => to_flux[mode].norm_sqr(),
            })
            .collect();
        Self {
            family,
            nodes: grid.nodes(),
            to_flux,
            inverse_to_flux,
            interpolation,
            minus_laplacian,
            grading,
        }
    }

    fn flux_symbol(family: DerivativeFamily, midpoints: bool, grid: &PeriodicGrid, mode: usize) -> Complex64 {
        match family.stencil() {
            None if midpoints && Some(mode) == grid.sawtooth_mode() => {
                Complex64::new(-grid.wave_number(mode), 0.0)
            }
            None if midpoints => Complex64::new(0.0, grid.wave_number(mode)) * grid.half_step(mode),
            None if Some(mode) == grid.sawtooth_mode() => Complex64::default(),
            None => Complex64::new(0.0, grid.wave_number(mode)),
            Some(stencil) => {
                let half = 0.5 * grid.wave_number(mode) / grid.nodes() as f64;
                let sum: f64 = stencil
                    .difference
                    .iter()
                    .enumerate()
                    .map(|(j, c)| 2.0 * c * (half * (2 * j + 1) as f64).sin())
                    .sum();
                Complex64::new(0.0, sum * grid.nodes() as f64) * Complex64::cis(half)
            }
        }
    }

    fn mean_symbol(stencil: &Stencil, grid: &PeriodicGrid, mode: usize) -> Complex64 {
        let half = 0.5 * grid.wave_number(mode) / grid.nodes() as f64;
        let sum: f64 =
            stencil.mean.iter().enumerate().map(|(j, c)| c * (half * (2 * j + 1) as f64).cos()).sum();
        Complex64::cis(half) * sum
    }

    /// The family.
    #[must_use]
    pub fn family(&self) -> DerivativeFamily {
        self.family
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// The grading of the nodes; none if they are uniform.
    #[must_use]
    pub fn grading(&self) -> Option<&Arc<Grading>> {
        self.grading.as_ref()
    }

    /// Symbol of D₊, from the nodes to the flux points.
    #[must_use]
    pub fn to_flux(&self) -> &[Complex64] {
        &self.to_flux
    }

    /// Symbol of the inverse of D₊ on fields that it does not lose, zero elsewhere.
    #[must_use]
    pub fn inverse_to_flux(&self) -> &[Complex64] {
        &self.inverse_to_flux
    }

    /// Symbol of the interpolation M to the flux points; none where these are the nodes.
    #[must_use]
    pub fn interpolation(&self) -> Option<&[Complex64]> {
        self.interpolation.as_deref()
    }

    /// Symbol of −D₋D₊ ≥ 0, which vanishes on constants only.
    #[must_use]
    pub fn minus_laplacian(&self) -> &[f64] {
        &self.minus_laplacian
    }
}
