//! From one gauge or grading to another: the fields of a state at other nodes of the same curve. See `THEORY.md`, eq. (F18).

use super::gradient_flow::GradientFlow;
use crate::geometry::{Closure, ClosureError, Complex64, PeriodicGrid};

/// A state on other nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Regraded {
    /// The spectral state.
    pub state: Vec<f64>,
    /// Its energy less that of the original: the difference of the errors of the two discretisations.
    pub energy_error: f64,
}

/// Passes of Newton's method; the start is within a node distance.
const MOST_PASSES: usize = 50;
/// Error of the fraction of the arc length that is rounding.
const FOUND: f64 = 1e-15;

/// The spectral `state` of the flow `from` on the nodes of the flow `to`, of the same energy and any gauge, grading and number
/// of nodes. A metric that is a field starts as the grading of `to`. Turning number, masses and length are kept to rounding; the placement, a mean over the curve, is as it was.
///
/// Allocates; meant for the moments between steps. Costs the product of the numbers of nodes.
///
/// # Shapes
/// `state`: a spectral state of `from` (see [`crate::geometry::SpectralLayout`]); the result is one of `to`.
/// # Errors
/// [`ClosureError`] if the new nodes do not resolve the curve so far that it cannot be closed.
/// # Panics
/// If the two flows have different numbers of densities.
/// # Source
/// `THEORY.md`, eq. (F18).
pub fn regrade(
    from: &mut GradientFlow,
    to: &mut GradientFlow,
    state: &[f64],
    turning_number: i32,
) -> Result<Regraded, ClosureError> {
    let (old, new) = (from.spectral_layout(), to.spectral_layout());
    let nodes = to.layout().nodes();
    let fields = from.layout().fields();
    assert_eq!(fields, to.layout().fields(), "the same densities");
    let energy = from.spectral_gradient(state);
    let length = state[old.length_index()];
    let grading = to.grading().cloned();
    let uniform = || (0..nodes).map(|i| i as f64 / nodes as f64).collect();
    let fractions: Vec<f64> = grading.as_ref().map_or_else(uniform, |grading| grading.fractions());
    let parameters = parameters(from, &fractions);
    let mut out = vec![0.0; new.len()];
    let old_grid = PeriodicGrid::new(from.layout().nodes());
    let mut grid = PeriodicGrid::new(nodes);
    let weight = grading.as_ref().map_or_else(|| vec![1.0; nodes], |grading| grading.weight().to_vec());
    for field in 0..fields {
        let spectrum = from.current().spectrum(field);
        let at = |s: &f64| series(&old_grid, spectrum, *s)[0];
        let values: Vec<f64> =
            parameters.iter().zip(&weight).map(|(s, weight)| length * weight * at(s)).collect();
        let total = old.spectra(state)[field * old.modes()].re;
        let spectrum = &mut new.spectra_mut(&mut out)[field * new.modes()..(field + 1) * new.modes()];
        grid.transform(&values, spectrum);
        let missing = total - spectrum[0].re;
        let corrected: Vec<f64> = values.iter().zip(&weight).map(|(value, w)| value + missing * w).collect();
        grid.transform(&corrected, spectrum);
        spectrum[0] = Complex64::new(total, 0.0);
    }
    if let Some(metric) = to.layout().metric() {
        let values: Vec<f64> = weight.iter().map(|weight| length * weight).collect();
        let spectrum = &mut new.spectra_mut(&mut out)[metric * new.modes()..(metric + 1) * new.modes()];
        grid.transform(&values, spectrum);
        spectrum[0] = Complex64::new(length, 0.0);
    }
    out[new.length_index()] = length;
    let turning = &mut new.spectra_mut(&mut out)[..new.modes()];
    Closure::graded(nodes, grading).project(turning, length, turning_number, 0.0)?;
    let energy_error = to.spectral_gradient(&out) - energy;
    Ok(Regraded { state: out, energy_error })
}

/// Parameters of the nodes of `from` where the `fractions` of the arc length are reached.
fn parameters(from: &GradientFlow, fractions: &[f64]) -> Vec<f64> {
    let Some(grading) = from.current().grading() else { return fractions.to_vec() };
    let nodes = grading.nodes();
    let mut grid = PeriodicGrid::new(nodes);
    let mut shift = vec![Complex64::default(); grid.modes()];
    grid.transform(grading.shift(), &mut shift);
    let at_nodes = grading.fractions();
    let find = |x: &f64| {
        let right = at_nodes.partition_point(|at| at <= x);
        let [mut low, mut high] = [right.max(1) - 1, right.max(1)].map(|i| i as f64 / nodes as f64);
        let mut s = 0.5 * (low + high);
        for _ in 0..MOST_PASSES {
            let [value, slope] = series(&grid, &shift, s);
            let excess = s + value - x;
            if excess.abs() <= FOUND {
                break;
            }
            *(if excess > 0.0 { &mut high } else { &mut low }) = s;
            let aim = s - excess / (1.0 + slope);
            // A node itself may be the solution, to rounding.
            s = if (low..=high).contains(&aim) { aim } else { 0.5 * (low + high) };
        }
        s
    };
    fractions.iter().map(find).collect()
}

/// The trigonometric interpolant with the coefficients `spectrum` at `s`, and its derivative.
fn series(grid: &PeriodicGrid, spectrum: &[Complex64], s: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (mode, value) in spectrum.iter().enumerate() {
        let k = grid.wave_number(mode);
        let wave = value * Complex64::cis(k * s) * grid.multiplicity(mode);
        sum[0] += wave.re;
        sum[1] -= k * wave.im;
    }
    sum
}
