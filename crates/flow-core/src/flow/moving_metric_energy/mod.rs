//! Local and stiffness terms where the metric g is a field of the state: gradient and second derivative by g as well.
//!
//! With densities e(φ) at the nodes and E(Mφ, D₊φ/Mg) at the flux points, `𝓕_h` = ⟨g e⟩ + ⟨(Mg) E⟩ + Φ(⟨g⟩), φ = K/g, m/g.
//! See `THEORY.md`, eq. (D10).

mod second_derivative;

use super::curve_fields::CurveFields;
use super::intrinsic_gradient::IntrinsicGradient;
use crate::energies::{EnergyTerm, Fields, Jet, LengthJet, Order};
use crate::geometry::vectors::{add_scaled, apply_symbol, dot, mean, multiply, multiply_into, scale};
use crate::geometry::{Complex64, Grading, Layout, PeriodicGrid};
use crate::operators::Derivative;

/// Scratch and linearisation.
#[derive(Debug)]
pub struct MovingMetricEnergy {
    layout: Layout,
    grid: PeriodicGrid,
    to_flux: Vec<Complex64>,
    interpolation: Vec<Complex64>,
    /// E with its derivatives by Mφ and by the slopes.
    flux_jet: Jet,
    /// Mφ, then the slopes, at the flux points; at the linearisation, and their motion.
    at_flux: Vec<f64>,
    frozen_at_flux: Vec<f64>,
    motion_at_flux: Vec<f64>,
    /// ∂E/∂(Mφ, slope), ∂e/∂φ and ∂𝓕/∂φ per metric at the linearisation.
    frozen_stress: Vec<f64>,
    frozen_first: Vec<f64>,
    frozen_potential: Vec<f64>,
    motion: Vec<f64>,
    /// Motion of the metric per length, at the nodes and at the flux points.
    metric_motion: [Vec<f64>; 2],
    by_metric: Vec<f64>,
    values: Vec<f64>,
    product: Vec<f64>,
    spectrum: Vec<Complex64>,
    sum: Vec<Complex64>,
}

impl MovingMetricEnergy {
    /// For states of `layout`; none if their metric is not a field.
    #[must_use]
    pub fn of(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Option<Self> {
        layout.metric()?;
        let (nodes, fields) = (layout.nodes(), layout.fields());
        let (field, spectrum) = (vec![0.0; nodes], vec![Complex64::default(); grid.modes()]);
        let [all, twice] = [fields, 2 * fields].map(|count| vec![0.0; count * nodes]);
        Some(Self {
            layout,
            grid: grid.clone(),
            to_flux: derivative.to_flux().to_vec(),
            interpolation: derivative.interpolation()?.to_vec(),
            flux_jet: Jet::new(nodes, 2 * fields),
            at_flux: twice.clone(),
            frozen_at_flux: twice.clone(),
            motion_at_flux: twice.clone(),
            frozen_stress: twice,
            frozen_first: all.clone(),
            frozen_potential: all.clone(),
            motion: all,
            metric_motion: [field.clone(), field.clone()],
            by_metric: field.clone(),
            values: field.clone(),
            product: field,
            sum: spectrum.clone(),
            spectrum,
        })
    }

    /// Energy of the nodal density `jet`, of the slopes and of the length, with the gradient.
    #[allow(clippy::too_many_arguments)] // the parts of the sum that it stands in for
    pub fn evaluate(
        &mut self,
        terms: &mut [Box<dyn EnergyTerm>],
        jet: &Jet,
        stiffness: &[f64],
        of_length: LengthJet,
        at: &CurveFields,
        order: Order,
        gradient: &mut IntrinsicGradient,
    ) -> f64 {
        let (place, metric) = at.metric_field();
        let (nodes, fields, length) = (self.layout.nodes(), self.layout.fields(), at.length());
        self.evaluate_flux(terms, stiffness, at, metric, order);
        let per_node = length / nodes as f64;
        let energy = per_node
            * (dot(metric.weight(), jet.value()) + dot(metric.at_midpoints(), self.flux_jet.value()))
            + of_length.value;
        // ∂𝓕/∂g = e + Mᵀ(E − Σ slope stress) − Σ φ p + Φ′.
        self.product.copy_from_slice(self.flux_jet.value());
        for variable in fields..2 * fields {
            let stress = self.flux_jet.first(variable);
            let slopes = &self.at_flux[self.layout.field(variable)];
            self.product.iter_mut().zip(stress).zip(slopes).for_each(|((q, a), b)| *q -= a * b);
        }
        self.sum.fill(Complex64::default());
        self.add_interpolated();
        self.grid.synthesise(&self.sum, &mut self.by_metric);
        add_scaled(&mut self.by_metric, 1.0, jet.value());
        self.by_metric.iter_mut().for_each(|q| *q += of_length.first);
        for field in 0..fields {
            multiply_into(&mut self.values, jet.first(field), metric.weight());
            scale(&mut self.values, length);
            multiply_into(&mut self.product, self.flux_jet.first(field), metric.at_midpoints());
            scale(&mut self.product, length);
            let stress = std::mem::replace(&mut self.flux_jet, Jet::new(0, 0));
            self.sum_force(stress.first(fields + field));
            self.flux_jet = stress;
            self.divide_by_metric(metric, length);
            let potential = self.layout.field(field);
            for ((q, phi), p) in self.by_metric.iter_mut().zip(at.at_nodes(field)).zip(&self.values) {
                *q -= phi * p;
            }
            if order >= Order::Hessian {
                self.frozen_potential[potential.clone()].copy_from_slice(&self.values);
                self.frozen_first[potential].copy_from_slice(jet.first(field));
            }
            self.grid.transform(&self.values, &mut gradient.spectra[self.layout.spectrum(field)]);
        }
        if order >= Order::Hessian {
            self.frozen_at_flux.copy_from_slice(&self.at_flux);
            for variable in 0..2 * fields {
                self.frozen_stress[self.layout.field(variable)]
                    .copy_from_slice(self.flux_jet.first(variable));
            }
        }
        self.grid.transform(&self.by_metric, &mut gradient.spectra[self.layout.spectrum(place)]);
        gradient.by_length = 0.0;
        energy
    }

    /// E with its derivatives at the state evaluated last, and the fields and slopes there.
    #[must_use]
    pub fn flux_jet(&self) -> (&Jet, Fields<'_>) {
        (&self.flux_jet, Fields::new(self.layout.nodes(), &self.at_flux))
    }

    /// Mean over the flux points of ∂²E/∂(∇_sφ)∂(∇_sψ) at the state that was linearised last.
    #[must_use]
    pub fn mean_cost(&self, a: usize, b: usize) -> f64 {
        let fields = self.layout.fields();
        mean(self.flux_jet.second(fields + a, fields + b))
    }

    /// E with its derivatives at the fields `at`.
    fn evaluate_flux(
        &mut self,
        terms: &mut [Box<dyn EnergyTerm>],
        stiffness: &[f64],
        at: &CurveFields,
        metric: &Grading,
        order: Order,
    ) {
        let (nodes, fields) = (self.layout.nodes(), self.layout.fields());
        for field in 0..fields {
            self.at_flux[self.layout.field(field)].copy_from_slice(at.at_flux_points(field));
            let slopes = &mut self.at_flux[self.layout.field(fields + field)];
            apply_symbol(&mut self.spectrum, at.spectrum(field), &self.to_flux);
            self.grid.synthesise(&self.spectrum, slopes);
            multiply(slopes, metric.inverse_at_midpoints());
            scale(slopes, 1.0 / at.length());
        }
        self.flux_jet.clear(order);
        for term in terms.iter_mut().filter(|term| term.has_slope_density()) {
            term.add_slope_density(Fields::new(nodes, &self.at_flux), &mut self.flux_jet);
        }
        for (field, coefficient) in stiffness.iter().enumerate().filter(|(_, c)| **c != 0.0) {
            let variable = fields + field;
            let slopes = &self.at_flux[self.layout.field(variable)];
            let (value, first) = self.flux_jet.value_and_first_mut(variable);
            for ((value, first), slope) in value.iter_mut().zip(first).zip(slopes) {
                *value += 0.5 * coefficient * slope * slope;
                *first += coefficient * slope;
            }
            if order >= Order::Hessian {
                let second = self.flux_jet.second_mut(variable, variable);
                for second in second {
                    *second += coefficient;
                }
            }
        }
    }

    /// `sum` += Mᵀ `product`.
    fn add_interpolated(&mut self) {
        self.grid.transform(&self.product, &mut self.spectrum);
        for ((sum, value), symbol) in self.sum.iter_mut().zip(&self.spectrum).zip(&self.interpolation) {
            *sum += value * symbol.conj();
        }
    }

    /// `values` = `values` + Mᵀ `product` + D₊ᵀ `stress`: the derivative by a pointwise field.
    fn sum_force(&mut self, stress: &[f64]) {
        self.grid.transform(&self.values, &mut self.sum);
        self.add_interpolated();
        self.grid.transform(stress, &mut self.spectrum);
        for ((sum, value), symbol) in self.sum.iter_mut().zip(&self.spectrum).zip(&self.to_flux) {
            *sum += value * symbol.conj();
        }
        self.grid.synthesise(&self.sum, &mut self.values);
    }

    /// `values` /= g.
    fn divide_by_metric(&mut self, metric: &Grading, length: f64) {
        multiply(&mut self.values, metric.inverse());
        scale(&mut self.values, 1.0 / length);
    }
}
