//! From one gauge or grading to another: the fields of a state at other nodes of the same curve. See `THEORY.md`, eq. (F18).

use std::sync::Arc;

use super::gradient_flow::GradientFlow;
use crate::geometry::{
    Closure, ClosureError, Complex64, Grading, Layout, PeriodicGrid, ScatteredPoints, SpectralLayout,
};

/// A state on other nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Regraded {
    /// The spectral state.
    pub state: Vec<f64>,
    /// Its energy less that of the original: the difference of the errors of the two discretisations.
    pub energy_error: f64,
}

/// The spectral `state` of the flow `from` on the nodes of the flow `to`, of the same energy and any gauge, grading and number
/// of nodes. A metric that is a field starts as the grading of `to`. Turning number, masses and length are kept to rounding; the placement, a mean over the curve, is as it was.
///
/// Allocates; meant for the moments between steps.
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
    let energy = from.spectral_gradient(state);
    assert_eq!(from.layout().densities(), to.layout().densities(), "the same densities");
    let mut way = Regrading::new(from, to.layout(), to.grading().cloned(), turning_number);
    let state = way.apply(from, state)?;
    let energy_error = to.spectral_gradient(&state) - energy;
    Ok(Regraded { state, energy_error })
}

/// The way from the nodes of one flow to those of another, for any number of states.
#[derive(Clone, Debug)]
pub struct Regrading {
    points: ScatteredPoints,
    grid: PeriodicGrid,
    layouts: [SpectralLayout; 2],
    fields: usize,
    metric: Option<usize>,
    weight: Vec<f64>,
    closure: Closure,
    turning_number: i32,
}

impl Regrading {
    /// From the nodes of the state that `from` evaluated last to those of the layout `to`, which may be graded.
    #[must_use]
    pub fn new(from: &GradientFlow, to: Layout, grading: Option<Arc<Grading>>, turning_number: i32) -> Self {
        let nodes = to.nodes();
        let uniform = || (0..nodes).map(|i| i as f64 / nodes as f64).collect();
        let fractions: Vec<f64> = grading.as_ref().map_or_else(uniform, |grading| grading.fractions());
        let old = from.current().grading();
        let points = old.map_or_else(
            || ScatteredPoints::new(from.layout().nodes(), &fractions),
            |old| ScatteredPoints::at_fractions(old, &fractions),
        );
        Self {
            points,
            grid: PeriodicGrid::new(nodes),
            layouts: [from.spectral_layout(), SpectralLayout::new(to)],
            fields: to.fields(),
            metric: to.metric(),
            weight: grading.as_ref().map_or_else(|| vec![1.0; nodes], |grading| grading.weight().to_vec()),
            closure: Closure::graded(nodes, grading),
            turning_number,
        }
    }

    /// The spectral `state` of `from` on the new nodes.
    ///
    /// # Errors
    /// [`ClosureError`] if the new nodes do not resolve the curve so far that it cannot be closed.
    pub fn apply(&mut self, from: &mut GradientFlow, state: &[f64]) -> Result<Vec<f64>, ClosureError> {
        let [old, new] = self.layouts;
        let length = state[old.length_index()];
        from.set_current(state);
        let mut out = vec![0.0; new.len()];
        for field in 0..self.fields {
            let mut values = self.points.values(from.current().spectrum(field));
            values.iter_mut().zip(&self.weight).for_each(|(value, weight)| *value *= length * weight);
            let total = old.spectra(state)[field * old.modes()].re;
            let spectrum = &mut new.spectra_mut(&mut out)[new.spectrum(field)];
            self.grid.transform(&values, spectrum);
            // The interpolant has another mean, by its error: the masses and the turning number are put right.
            let missing = total - spectrum[0].re;
            values.iter_mut().zip(&self.weight).for_each(|(value, weight)| *value += missing * weight);
            self.grid.transform(&values, spectrum);
            spectrum[0] = Complex64::new(total, 0.0);
        }
        if let Some(metric) = self.metric {
            let values: Vec<f64> = self.weight.iter().map(|weight| length * weight).collect();
            let spectrum = &mut new.spectra_mut(&mut out)[new.spectrum(metric)];
            self.grid.transform(&values, spectrum);
            spectrum[0] = Complex64::new(length, 0.0);
        }
        out[new.length_index()] = length;
        let turning = &mut new.spectra_mut(&mut out)[..new.modes()];
        self.closure.project(turning, length, self.turning_number, 0.0)?;
        Ok(out)
    }
}
