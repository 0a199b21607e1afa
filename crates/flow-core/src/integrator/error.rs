//! Why the step loop ends before its time.

use super::Rejection;

/// Why the time integration stopped before its end.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum IntegrationError {
    /// The step size fell to the rounding of the time.
    #[error(
        "the step size fell to {step:.3e} at t = {time:.6e}, the rounding of the time (attempts rejected in a row: \
         {rejections}, the last because {}); {}", reason(*.cause), advice(*.cause)
    )]
    StepUnderflow { time: f64, step: f64, rejections: u64, cause: Rejection },
    /// Two times lie so close together that no step fits between them.
    #[error(
        "the next time to stop at (the end, a switch, or one asked for) is {step:.3e} after t = {time:.6e}, and a step \
         must be at least {least:.3e}; choose later times, or a smaller unit of time"
    )]
    StopTooNear { time: f64, step: f64, least: f64 },
    /// The allowed number of steps is used up: `time.max_steps` of a scene, [`AdaptiveOptions::most_steps`](super::AdaptiveOptions::most_steps)
    /// of a problem of your own.
    #[error(
        "the number of steps allowed, {steps}, is used up at t = {time:.6e}; raise time.max_steps of the scene or drop it"
    )]
    TooManySteps { time: f64, steps: u64 },
    /// The energy does not lose what is dissipated, however short the step.
    #[error(
        "after {steps} steps, at t = {time:.6e}, the steps are down to {step:.3e}, and however short they are the energy loses \
         {percent:.5} % of what is dissipated: the gradient of a term is not the derivative of its energy; \
         GradientFlow::check_derivatives tells which"
    )]
    OpenBalance { time: f64, steps: u64, step: f64, percent: f64 },
    /// The initial state cannot be evaluated.
    #[error(
        "the energy or its gradient is not finite at the initial state; check the expressions of the scene \
         on the range of its initial curvature and densities"
    )]
    InitialStateNotFinite,
}

#[cold]
fn reason(cause: Rejection) -> &'static str {
    match cause {
        Rejection::Error => "the local error was too large",
        Rejection::Solver => "the implicit solve did not converge",
        Rejection::EnergyRise => "the energy rose",
        Rejection::NotFinite => "the energy or its derivatives are not finite, or the curve did not close",
    }
}

#[cold]
fn advice(cause: Rejection) -> &'static str {
    match cause {
        Rejection::NotFinite => {
            "an expression may leave its range here (a root, a logarithm or a fractional power of what falls below 0, a division by \
             0), or the curve its own: keep the expressions finite where the flow goes, or try more nodes"
        }
        _ => {
            "the flow may end here (a curve shrinking to a point, an ill-posed energy, an expression at the edge of its range), or \
             the tolerance asks for more than double precision: try a larger tolerance or more nodes"
        }
    }
}
