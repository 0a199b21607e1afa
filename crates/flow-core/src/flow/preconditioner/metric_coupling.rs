//! The metric as a field, eliminated around the inverse of the others. See `THEORY.md`, eq. (O8).
//!
//! With y = δΦ − φδg for the fields Φ = K, m, I − γJ acts on y as it does where the metric is fixed, to leading order, and
//! the normal velocity V that moves the curvature stretches the metric: `γD₊ᵀ(1/Mg)D₊V = y − r` and `δg = r_g + γKV`.

use super::super::gradient_flow::GradientFlow;
use crate::geometry::Complex64;

/// Scratch of the elimination.
#[derive(Clone, Debug)]
pub struct MetricCoupling {
    metric: usize,
    modes: usize,
    /// Motion of the metric, κ and a product at the nodes.
    stretch: Vec<f64>,
    velocity: Vec<f64>,
    values: Vec<f64>,
    /// The right-hand sides of the fields.
    right: Vec<Complex64>,
    spectrum: Vec<Complex64>,
    /// Whether a density is only carried: its node values do not change at all.
    carried: Vec<bool>,
}

impl MetricCoupling {
    /// For the states of `flow`; none if their metric is fixed.
    #[must_use]
    pub fn of(flow: &GradientFlow) -> Option<Self> {
        let (nodes, modes) = (flow.layout().nodes(), flow.spectral_layout().modes());
        let spectrum = vec![Complex64::default(); modes];
        Some(Self {
            metric: flow.layout().metric()?,
            modes,
            stretch: vec![0.0; nodes],
            velocity: vec![0.0; nodes],
            values: vec![0.0; nodes],
            right: vec![Complex64::default(); flow.layout().fields() * modes],
            carried: flow
                .density_mobilities()
                .iter()
                .map(|density| density.symbol(1.0, 1.0) == 0.0)
                .collect(),
            spectrum,
        })
    }

    /// Solves (I − γJ)x = r in place by `inverse`, the inverse on the fields at a fixed metric.
    pub fn apply(
        &mut self,
        flow: &mut GradientFlow,
        r: &mut [f64],
        inverse: impl FnOnce(&mut GradientFlow, &mut [f64]),
    ) {
        let layout = flow.spectral_layout();
        let mean = layout.field(self.metric).start;
        let length_excess = r[layout.length_index()] - r[mean];
        let fields = self.right.len();
        self.right.copy_from_slice(&layout.spectra(r)[..fields]);
        self.add_products(flow, layout.spectra_mut(r), -1.0);
        self.right[..self.modes].copy_from_slice(&layout.spectra(r)[..self.modes]);
        inverse(flow, r);
        let spectra = layout.spectra_mut(r);
        for ((moved, y), right) in self.spectrum.iter_mut().zip(&*spectra).zip(&self.right) {
            *moved = y - right;
        }
        flow.velocity_of_turning(&mut self.spectrum, &mut self.velocity);
        let at = flow.frozen();
        let (kappa, weight, length) = (at.at_nodes(0), at.weight().unwrap_or_default(), at.length());
        for (((value, v), kappa), weight) in self.values.iter_mut().zip(&self.velocity).zip(kappa).zip(weight)
        {
            *value = length * weight * kappa * v;
        }
        flow.grid_and_derivative().0.transform(&self.values, &mut self.spectrum);
        let metric = &mut spectra[self.metric * self.modes..(self.metric + 1) * self.modes];
        metric.iter_mut().zip(&self.spectrum).for_each(|(g, stretch)| *g += stretch);
        self.add_products(flow, spectra, 1.0);
        for (density, _) in self.carried.iter().enumerate().filter(|(_, carried)| **carried) {
            let range = (density + 1) * self.modes..(density + 2) * self.modes;
            spectra[range.clone()].copy_from_slice(&self.right[range]);
        }
        r[layout.length_index()] = r[mean] + length_excess;
    }

    /// Φ += factor × φ × the metric in `spectra`, for every field but the metric.
    fn add_products(&mut self, flow: &mut GradientFlow, spectra: &mut [Complex64], factor: f64) {
        let modes = self.modes;
        self.spectrum.copy_from_slice(&spectra[self.metric * modes..(self.metric + 1) * modes]);
        flow.grid_and_derivative().0.synthesise(&self.spectrum, &mut self.stretch);
        for field in 0..self.metric {
            for ((value, g), phi) in
                self.values.iter_mut().zip(&self.stretch).zip(flow.frozen().at_nodes(field))
            {
                *value = factor * phi * g;
            }
            flow.grid_and_derivative().0.transform(&self.values, &mut self.spectrum);
            let target = &mut spectra[field * modes..(field + 1) * modes];
            target.iter_mut().zip(&self.spectrum).for_each(|(target, product)| *target += product);
        }
    }
}
