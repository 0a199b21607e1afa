//! The part of the energy that depends on slopes, L⟨e′(φ, ∇_sφ)⟩ at the flux points, with its exact derivatives:
//! p += Mᵀe′_φ + D₊ᵀe′_σ/L.
//!
//! The flux points are the midpoints here even where those of the flow are the nodes: at these the sawtooth has no slope, costs
//! nothing, and grows. That is for flows built by hand; those of scenes with such a term have the midpoints throughout
//! ([`Derivative::staggered`]). On graded nodes L⟨we′(φ, D₊φ/(Lw))⟩, and 1/w is left to the sum. Built only if a term has it.
//! See `THEORY.md`, eq. (D6).

use super::curve_fields::CurveFields;
use super::intrinsic_gradient::IntrinsicGradient;
use crate::energies::{EnergyTerm, Fields, Jet, Order};
use crate::geometry::vectors::{self, mean, mean_of_product, mean_of_triple_product};
use crate::geometry::{Complex64, Layout, PeriodicGrid};
use crate::operators::Derivative;

/// Scratch and linearisation of the slope part.
#[derive(Debug)]
pub struct SlopeEnergy {
    layout: Layout,
    grid: PeriodicGrid,
    /// With the midpoints for flux points.
    derivative: Derivative,
    /// Whether the fields of a state are at hand at these.
    at_hand: bool,
    jet: Jet,
    /// Fields, then slopes, at the flux points.
    fields: Vec<f64>,
    /// Slopes and ∂e′/∂σ at the linearisation.
    frozen_slopes: Vec<f64>,
    frozen_by_slope: Vec<f64>,
    motion: Vec<f64>,
    product: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl SlopeEnergy {
    /// Room for states of `layout`, whose fields are taken with `derivative`.
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let (nodes, fields) = (layout.nodes(), layout.fields());
        Self {
            layout,
            grid: grid.clone(),
            derivative: derivative.at_midpoints(grid),
            at_hand: derivative.interpolation().is_some(),
            jet: Jet::new(nodes, 2 * fields),
            fields: vec![0.0; 2 * fields * nodes],
            frozen_slopes: vec![0.0; fields * nodes],
            frozen_by_slope: vec![0.0; fields * nodes],
            motion: vec![0.0; 2 * fields * nodes],
            product: vec![0.0; nodes],
            spectrum: vec![Complex64::default(); grid.modes()],
        }
    }

    /// e′ with its derivatives at the state evaluated last, and the fields and slopes there.
    #[must_use]
    pub fn jet(&self) -> (&Jet, Fields<'_>) {
        (&self.jet, Fields::new(self.layout.nodes(), &self.fields))
    }

    /// Mean over the flux points of ∂²e′/∂(∇_sφ)∂(∇_sψ) at the linearisation.
    #[must_use]
    pub fn mean_cost(&self, a: usize, b: usize) -> f64 {
        let fields = self.layout.fields();
        mean(self.jet.second(fields + a, fields + b))
    }

    /// ⟨we′⟩.
    fn mean_density(&self) -> f64 {
        let value = self.jet.value();
        self.weight().map_or_else(|| mean(value), |weight| mean_of_product(weight, value))
    }

    /// ⟨wab⟩.
    fn mean_of_product(&self, a: &[f64], b: &[f64]) -> f64 {
        self.weight().map_or_else(|| mean_of_product(a, b), |weight| mean_of_triple_product(weight, a, b))
    }

    /// w at the flux points, unless it is 1.
    fn weight(&self) -> Option<&[f64]> {
        self.derivative.grading().map(|grading| grading.at_midpoints())
    }

    fn fill(&mut self, at: &CurveFields) {
        let fields = self.layout.fields();
        for field in 0..fields {
            let values = &mut self.fields[self.layout.field(field)];
            match self.derivative.interpolation() {
                Some(symbol) if !self.at_hand => {
                    vectors::apply_symbol(&mut self.spectrum, at.spectrum(field), symbol);
                    self.grid.synthesise(&self.spectrum, values);
                }
                _ => values.copy_from_slice(at.at_flux_points(field)),
            }
            let scale = 1.0 / at.length();
            for ((slope, phi), symbol) in
                self.spectrum.iter_mut().zip(at.spectrum(field)).zip(self.derivative.to_flux())
            {
                *slope = phi * symbol * scale;
            }
            let slopes = self.layout.field(fields + field);
            self.grid.synthesise(&self.spectrum, &mut self.fields[slopes.clone()]);
            if let Some(grading) = self.derivative.grading() {
                vectors::multiply(&mut self.fields[slopes], grading.inverse_at_midpoints());
            }
        }
    }

    /// Adds to the gradient; returns the energy and its derivative by the length at fixed fields.
    pub fn add_gradient(
        &mut self,
        terms: &mut [Box<dyn EnergyTerm>],
        at: &CurveFields,
        order: Order,
        gradient: &mut IntrinsicGradient,
    ) -> (f64, f64) {
        self.fill(at);
        let (fields, nodes) = (self.layout.fields(), self.layout.nodes());
        self.jet.clear(order);
        for term in terms.iter_mut().filter(|term| term.has_slope_density()) {
            term.add_slope_density(Fields::new(nodes, &self.fields), &mut self.jet);
        }
        let density = self.mean_density();
        let mut by_length = density;
        for field in 0..fields {
            let slope = self.layout.field(fields + field);
            by_length -= self.mean_of_product(self.jet.first(fields + field), &self.fields[slope]);
            self.product.copy_from_slice(self.jet.first(field));
            self.weigh_product();
            self.add_interpolated(field, gradient);
            self.product.copy_from_slice(self.jet.first(fields + field));
            self.add_divergence(field, 1.0 / at.length(), gradient);
        }
        if order >= Order::Hessian {
            self.frozen_slopes.copy_from_slice(&self.fields[fields * nodes..]);
            for field in 0..fields {
                self.frozen_by_slope[self.layout.field(field)]
                    .copy_from_slice(self.jet.first(fields + field));
            }
        }
        (at.length() * density, by_length)
    }

    /// Adds the second derivative times a motion, given by the spectra of the pointwise fields' motion and
    /// the motion of the length; returns what it adds to the derivative by the length.
    pub fn add_hessian_product(
        &mut self,
        at: &CurveFields,
        motion_spectra: &[Complex64],
        length_motion: f64,
        out: &mut IntrinsicGradient,
    ) -> f64 {
        let (fields, length) = (self.layout.fields(), at.length());
        let mut by_length = 0.0;
        for field in 0..fields {
            let spectrum = &motion_spectra[self.layout.spectrum(field)];
            match self.derivative.interpolation() {
                None => self.spectrum.copy_from_slice(spectrum),
                Some(symbol) => vectors::apply_symbol(&mut self.spectrum, spectrum, symbol),
            }
            self.grid.synthesise(&self.spectrum, &mut self.motion[self.layout.field(field)]);
            vectors::apply_symbol(&mut self.spectrum, spectrum, self.derivative.to_flux());
            let slopes = self.layout.field(fields + field);
            self.grid.synthesise(&self.spectrum, &mut self.motion[slopes.clone()]);
            let by_slope = &self.frozen_by_slope[self.layout.field(field)];
            by_length -= mean_of_product(by_slope, &self.motion[slopes.clone()]) / length;
            if let Some(grading) = self.derivative.grading() {
                vectors::multiply(&mut self.motion[slopes.clone()], grading.inverse_at_midpoints());
            }
            let frozen = &self.frozen_slopes[self.layout.field(field)];
            for (motion, slope) in self.motion[slopes].iter_mut().zip(frozen) {
                *motion = (*motion - slope * length_motion) / length;
            }
        }
        for variable in 0..2 * fields {
            self.product.fill(0.0);
            for other in 0..2 * fields {
                let motion = &self.motion[self.layout.field(other)];
                vectors::add_product(&mut self.product, self.jet.second(variable, other), motion);
            }
            if variable < fields {
                self.weigh_product();
                self.add_interpolated(variable, out);
                continue;
            }
            let field = variable - fields;
            let slope = &self.frozen_slopes[self.layout.field(field)];
            by_length -= self.mean_of_product(&self.product, slope);
            let by_slope = &self.frozen_by_slope[self.layout.field(field)];
            for (product, by_slope) in self.product.iter_mut().zip(by_slope) {
                *product -= by_slope * length_motion / length;
            }
            self.add_divergence(field, 1.0 / length, out);
        }
        by_length
    }

    fn weigh_product(&mut self) {
        if let Some(grading) = self.derivative.grading() {
            vectors::multiply(&mut self.product, grading.at_midpoints());
        }
    }

    /// p += Mᵀ `product`.
    fn add_interpolated(&mut self, field: usize, out: &mut IntrinsicGradient) {
        self.grid.transform(&self.product, &mut self.spectrum);
        let p = &mut out.spectra[self.layout.spectrum(field)];
        match self.derivative.interpolation() {
            None => p.iter_mut().zip(&self.spectrum).for_each(|(p, value)| *p += value),
            Some(symbol) => {
                for ((p, value), symbol) in p.iter_mut().zip(&self.spectrum).zip(symbol) {
                    *p += value * symbol.conj();
                }
            }
        }
    }

    /// p += `scale` D₊ᵀ `product`.
    fn add_divergence(&mut self, field: usize, scale: f64, out: &mut IntrinsicGradient) {
        self.grid.transform(&self.product, &mut self.spectrum);
        let p = &mut out.spectra[self.layout.spectrum(field)];
        for ((p, value), symbol) in p.iter_mut().zip(&self.spectrum).zip(self.derivative.to_flux()) {
            *p += value * symbol.conj() * scale;
        }
    }
}
