//! Approximate inverses of I − γJ, J = −𝓚 Hess `𝓕_h` and the tension. See `THEORY.md`, section 5.

mod banded;
mod dense;
mod fourier;
mod length_coupling;
mod metric_coupling;
mod motion;
mod normal_motion;
mod residual_weights;
mod stiff_curvature;
mod stiff_exchange;

use serde::{Deserialize, Serialize};

use super::gradient_flow::GradientFlow;
use crate::operators::FactorisationError;
use banded::Banded;
use dense::Dense;
use fourier::FourierSymbol;
pub use fourier::mobility_symbol;
use length_coupling::LengthCoupling;
use metric_coupling::MetricCoupling;
use motion::carries;
use normal_motion::NormalMotion;
pub use residual_weights::ResidualWeights;
use stiff_curvature::StiffCurvature;
use stiff_exchange::StiffExchange;

/// How the linear systems of the implicit steps are preconditioned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinearSolver {
    /// Fourier while its Krylov iterations are few, banded once they are not.
    #[default]
    Auto,
    /// The symbol with the coefficients frozen at their means, diagonal in Fourier space.
    Fourier,
    /// A banded factorisation with variable coefficients, corrected by the ratio of the symbols; on many nodes of the low modes only.
    Banded,
    /// The same of all modes, at a higher cost.
    BandedOnAllNodes,
    /// A band for the normal velocity where nodes slide, of surface diffusion with densities.
    BandedOfVelocity,
    /// A dense factorisation of the exact operator, for few nodes.
    Dense,
}

/// An approximate inverse for the fields; the length is coupled in by [`LengthCoupling`].
#[derive(Debug)]
enum FieldInverse {
    Fourier(FourierSymbol),
    Banded(Box<dyn Banded>, FourierSymbol),
    Dense(Dense),
}

/// An approximate inverse of I − γJ, J the Jacobian of one gradient flow. See `THEORY.md`, section 5.
#[derive(Debug)]
pub struct Preconditioner {
    inverse: FieldInverse,
    /// Whether the densities are taken relative to what the curve carries along (see [`carries`]).
    carries: bool,
    /// Where the metric is a field: the inverse then acts on the normal velocity and the densities.
    metric: Option<MetricCoupling>,
    /// Where the inverse acts on the normal velocity and the densities though the metric is no field.
    motion: Option<NormalMotion>,
    /// Where densities exchange at no cost of slopes.
    exchange: Option<StiffExchange>,
    /// None where the mobility keeps the length.
    coupling: Option<LengthCoupling>,
    weights: ResidualWeights,
    stiff_curvature: StiffCurvature,
}

impl Preconditioner {
    /// A preconditioner of the given kind; `Auto` starts as Fourier.
    #[must_use]
    pub fn new(kind: LinearSolver, flow: &GradientFlow) -> Self {
        let layout = flow.layout();
        let modes = flow.spectral_layout().modes();
        let kind = match kind {
            LinearSolver::Banded if NormalMotion::is_needed(flow) => LinearSolver::BandedOfVelocity,
            kind => kind,
        };
        let moves = kind == LinearSolver::BandedOfVelocity && banded::exists(flow);
        let motion = moves.then(|| NormalMotion::of(flow)).flatten();
        let of_velocity = motion.is_some() || flow.layout().metric().is_some();
        let symbol = || FourierSymbol::new(layout, modes, of_velocity);
        let inverse = match kind {
            LinearSolver::Auto | LinearSolver::Fourier => FieldInverse::Fourier(symbol()),
            LinearSolver::Banded | LinearSolver::BandedOnAllNodes | LinearSolver::BandedOfVelocity => {
                match banded::build(flow, motion.is_some(), kind == LinearSolver::BandedOnAllNodes) {
                    Some(banded) => FieldInverse::Banded(banded, symbol()),
                    None => FieldInverse::Fourier(symbol()),
                }
            }
            LinearSolver::Dense => FieldInverse::Dense(Dense::new(flow.spectral_layout())),
        };
        let whole = matches!(inverse, FieldInverse::Dense(_));
        // Where the length is kept, 𝓚e = 0: there is nothing to couple in.
        let coupled = !flow.normal_mobility().keeps().length;
        Self {
            weights: ResidualWeights::new(flow.spectral_layout()),
            stiff_curvature: StiffCurvature::new(flow),
            inverse,
            carries: carries(flow) && motion.is_none() && !whole,
            motion,
            metric: MetricCoupling::of(flow).filter(|_| !whole),
            exchange: StiffExchange::of(flow).filter(|_| !whole),
            coupling: (coupled && !whole).then(|| LengthCoupling::new(flow, of_velocity)),
        }
    }

    /// The solver for this flow that takes up where the Krylov iterations of `kind` are many; none if there is no better one.
    #[must_use]
    pub fn after(kind: LinearSolver, flow: &GradientFlow) -> Option<LinearSolver> {
        match kind {
            LinearSolver::Auto => banded::exists(flow).then_some(LinearSolver::Banded),
            LinearSolver::Banded if NormalMotion::is_needed(flow) => None,
            LinearSolver::Banded if NormalMotion::serves(flow) => Some(LinearSolver::BandedOfVelocity),
            LinearSolver::Banded => banded::leaves_modes(flow).then_some(LinearSolver::BandedOnAllNodes),
            _ => None,
        }
    }

    /// Factorises I − γJ at the frozen state of `flow`.
    ///
    /// # Errors
    /// [`FactorisationError`] if a pivot vanishes; a smaller γ helps.
    pub fn factorise(&mut self, flow: &mut GradientFlow, gamma: f64) -> Result<(), FactorisationError> {
        flow.set_sliding_step(gamma);
        self.weights.set(flow, gamma);
        if let Some(metric) = &mut self.metric {
            metric.set(flow, gamma);
        }
        if let Some(motion) = &mut self.motion {
            motion.set(flow, gamma);
        }
        if let Some(exchange) = &mut self.exchange {
            exchange.set(flow, gamma);
        }
        match &mut self.inverse {
            FieldInverse::Fourier(symbol) => symbol.set(flow, gamma, 0),
            FieldInverse::Banded(banded, symbol) => {
                banded.factorise(flow, gamma)?;
                symbol.set(flow, gamma, banded.modes());
            }
            FieldInverse::Dense(dense) => dense.factorise(flow, gamma)?,
        }
        if let Some(mut coupling) = self.coupling.take() {
            coupling.set(flow, gamma, |flow, r| self.apply_to_fields(flow, r));
            self.coupling = Some(coupling);
        }
        Ok(())
    }

    /// Overwrites the spectral vector `r` by the approximate solution of (I − γJ)x = r.
    pub fn apply(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        if let Some(metric) = &mut self.metric {
            metric.split(flow, r);
        }
        self.apply_to_fields(flow, r);
        if let Some(coupling) = &self.coupling {
            coupling.apply(r);
        }
        if let Some(metric) = &mut self.metric {
            metric.complete(flow, r);
        }
    }

    /// Weights of the residuals at the last factorisation.
    #[must_use]
    pub fn weights(&self) -> &ResidualWeights {
        &self.weights
    }

    /// Overwrites the residual `r` of a stage with γ by what settles the curvature; false if nothing does. See `THEORY.md`, eq. (I2).
    pub fn settle(&mut self, flow: &mut GradientFlow, gamma: f64, r: &mut [f64]) -> bool {
        self.stiff_curvature.settle(flow, gamma, r)
    }

    fn apply_to_fields(&mut self, flow: &mut GradientFlow, r: &mut [f64]) {
        let layout = flow.spectral_layout();
        if let Some(metric) = &mut self.metric {
            metric.take_velocity(flow, r);
        }
        if let Some(exchange) = &mut self.exchange {
            exchange.relax(flow, r);
        }
        if self.carries {
            flow.carry_densities(r, -1.0);
        }
        if let Some(motion) = &mut self.motion {
            motion.split(flow, r);
        }
        match &mut self.inverse {
            FieldInverse::Fourier(symbol) => symbol.apply(layout.spectra_mut(r), 0),
            FieldInverse::Banded(banded, symbol) => {
                let low = banded.modes();
                let spectra = layout.spectra_mut(r);
                banded.apply(spectra);
                symbol.apply(spectra, low);
            }
            FieldInverse::Dense(dense) => dense.apply(r),
        }
        if let Some(motion) = &mut self.motion {
            motion.complete(flow, r);
        }
        if self.carries {
            flow.carry_densities(r, 1.0);
        }
        if let Some(exchange) = &mut self.exchange {
            exchange.complete(flow, r);
        }
        if let Some(metric) = &mut self.metric {
            metric.make_motion(flow, r);
        }
    }
}
