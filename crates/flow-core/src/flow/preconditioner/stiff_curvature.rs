//! What a Newton correction leaves in the stiff modes of the curvature, made good without Krylov iterations.
//!
//! Fronts that move by δρ leave ½ ∂³𝓕/∂κ∂ρ² δρ² in the force on the curvature. It is small, but 𝓚 makes a large rate of it, which
//! the dissipation sees. The stiff modes of the curvature follow the densities at once. Where the curvature has a cost of slopes,
//! the principal part of −J from the curvature to itself is a symbol on equidistant nodes, and a band on graded ones. See
//! `THEORY.md`, eq. (I2).

use super::super::gradient_flow::GradientFlow;
use super::banded::{self, Banded};
use super::fourier::diagonal_symbol;
use crate::geometry::Complex64;

/// How the curvature settles.
#[derive(Debug)]
pub enum StiffCurvature {
    /// Not at all.
    No,
    /// By the symbol of −J from the curvature to itself.
    Symbol,
    /// By a band of the curvature alone; with scratch.
    Band(Box<dyn Banded>, Vec<Complex64>),
}

impl StiffCurvature {
    /// What settles the curvature of `flow`, whatever its state is.
    pub fn new(flow: &GradientFlow) -> Self {
        if !flow.energy_terms().may_be_stiff(0) || flow.layout().metric().is_some() {
            Self::No
        } else if flow.is_equidistant() {
            Self::Symbol
        } else {
            let scratch = vec![Complex64::default(); flow.spectral_layout().modes()];
            banded::of_curvature(flow).map_or(Self::No, |band| Self::Band(band, scratch))
        }
    }

    /// Overwrites the residual `r` of a stage with γ by the change of the curvature that takes back its stiff part, r γσ/(1 + γσ)²
    /// with σ at the linearisation of `flow`, and of nothing else; false if that does not settle it, as where its slopes cost nothing on the mean.
    pub fn settle(&mut self, flow: &mut GradientFlow, gamma: f64, r: &mut [f64]) -> bool {
        if flow.energy_terms().implicit_stiffness()[0] == 0.0 {
            return false;
        }
        let layout = flow.spectral_layout();
        let turning = &mut layout.spectra_mut(r)[..layout.modes()];
        match self {
            Self::No => return false,
            Self::Symbol => {
                let second = flow.energy_terms().convex_mean(0);
                for (value, laplacian) in turning.iter_mut().zip(flow.derivative().minus_laplacian()) {
                    let stiffness = gamma * diagonal_symbol(flow, 0, *laplacian, second);
                    *value *= stiffness / ((1.0 + stiffness) * (1.0 + stiffness));
                }
            }
            Self::Band(band, soft) => {
                if band.factorise(flow, gamma).is_err() {
                    return false;
                }
                band.apply(turning);
                soft.copy_from_slice(turning);
                band.apply(soft);
                turning.iter_mut().zip(soft).for_each(|(change, soft)| *change -= *soft);
            }
        }
        r[layout.field(0).end..].fill(0.0);
        true
    }
}
