//! The sum of the energy terms with its exact gradient and second derivative on the grid.
//!
//! With pointwise fields φ and length L, `𝓕_h` = L⟨e⟩ + Σ c/(2L) ⟨|D₊φ|²⟩ + L⟨e′⟩ + Φ(L), ⟨·⟩ the mean over the
//! nodes; on graded nodes w enters as a weight. See `THEORY.md`, eqs. (D3)–(D5) and (D9).

mod alone;
mod density;
mod not_finite;
mod parts;
mod positions;
mod stiffness;
mod undeclared;

use super::curve_fields::{CurveFields, check_nodes};
use super::graded_energy::{GradedEnergy, add_spectrum, mean_product};
use super::intrinsic_gradient::IntrinsicGradient;
use super::moving_metric_energy::MovingMetricEnergy;
use super::shape_energy::ShapeEnergy;
use super::slope_energy::SlopeEnergy;
use crate::energies::{EnergyTerm, Jet, LengthJet, Order};
use crate::geometry::vectors::{
    add_product, add_real_symbol, multiply, multiply_into, scale_into, weighted_dot,
};
use crate::geometry::{Complex64, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::Derivative;

pub use alone::TermCost;
pub use not_finite::{NotFinite, TermPart, TermPlace};
pub use undeclared::UndeclaredPart;

/// The discrete energy `𝓕_h` of all terms, with its exact gradient and second derivative on the grid.
///
/// With pointwise fields φ and length L, `𝓕_h` = L⟨e⟩ + Σ c/(2L) ⟨|D₊φ|²⟩ + L⟨e′⟩ + Φ(L) and the part of the positions, ⟨·⟩ the mean over
/// the nodes, weighted where they are graded. See `THEORY.md`, eqs. (D3)–(D5), (D7) and (D9).
///
/// # Shapes
/// Gradients: a spectrum for each field of the state, dual to the pointwise fields φ (and to the metric, if it is one), and one
/// number for the length ([`IntrinsicGradient`]). Motions `v`: spectral state vectors ([`SpectralLayout`]).
/// # Units
/// Energies in that of the scene; the derivative by φ is an energy per φ and arc length.
#[derive(Debug)]
pub struct EnergySum {
    terms: Vec<Box<dyn EnergyTerm>>,
    layout: Layout,
    grid: PeriodicGrid,
    derivative: Derivative,
    graded: Option<GradedEnergy>,
    moving: Option<MovingMetricEnergy>,
    stiffness: Vec<f64>,
    implicit_stiffness: Vec<f64>,
    /// Means of the mixed second derivatives by slopes, one row per field.
    cross_stiffness: Vec<f64>,
    /// Second derivatives by pairs of fields at the nodes, with those of slopes; empty where no energy has slopes.
    implicit_second: Vec<f64>,
    jet: Jet,
    slopes: Option<SlopeEnergy>,
    shape: Option<ShapeEnergy>,
    /// Gradient at the linearisation without the terms that depend on positions; empty if there are none.
    without_positions: IntrinsicGradient,
    /// ⟨|D₊φ|²⟩ of each field at the linearisation.
    frozen_slope_squares: Vec<f64>,
    motion: Vec<f64>,
    motion_spectra: Vec<Complex64>,
    product: Vec<f64>,
    /// Change of `e_φ` at the nodes under a motion; on graded nodes only.
    density_rates: Vec<f64>,
}

impl EnergySum {
    /// The sum of `terms` on states of `layout`.
    ///
    /// # Panics
    /// If states, grid and derivative have different numbers of nodes.
    #[must_use]
    pub fn new(
        terms: Vec<Box<dyn EnergyTerm>>,
        layout: Layout,
        grid: &PeriodicGrid,
        derivative: &Derivative,
    ) -> Self {
        check_nodes(layout, grid, derivative);
        let (nodes, fields) = (layout.nodes(), layout.fields());
        let stiffness =
            (0..fields).map(|field| terms.iter().map(|term| term.stiffness(field)).sum()).collect();
        // A metric that moves has its own kind of these.
        let has_slopes = terms.iter().any(|term| term.has_slope_density());
        let slopes =
            (layout.metric().is_none() && has_slopes).then(|| SlopeEnergy::new(layout, grid, derivative));
        let shape = terms
            .iter()
            .any(|term| term.has_shape_energy())
            .then(|| ShapeEnergy::new(layout, grid, derivative));
        Self {
            terms,
            layout,
            grid: grid.clone(),
            derivative: derivative.clone(),
            graded: GradedEnergy::of(layout, grid, derivative),
            moving: MovingMetricEnergy::of(layout, grid, derivative),
            implicit_stiffness: vec![0.0; fields],
            cross_stiffness: vec![0.0; fields * fields],
            implicit_second: vec![0.0; if has_slopes { fields * fields * nodes } else { 0 }],
            stiffness,
            jet: Jet::new(nodes, fields),
            slopes,
            without_positions: IntrinsicGradient {
                spectra: vec![
                    Complex64::default();
                    if shape.is_some() { layout.state_fields() * grid.modes() } else { 0 }
                ],
                by_length: 0.0,
            },
            shape,
            frozen_slope_squares: vec![0.0; fields],
            motion: vec![0.0; nodes * fields],
            motion_spectra: vec![Complex64::default(); grid.modes() * fields],
            product: vec![0.0; nodes],
            density_rates: vec![0.0; if derivative.grading().is_some() { nodes * fields } else { 0 }],
        }
    }

    /// δφ of all fields at the nodes under the motion of the last [`EnergySum::hessian_product`], that of the curvature first.
    #[must_use]
    pub fn field_motion(&self) -> &[f64] {
        self.moving.as_ref().map_or(&self.motion[..], MovingMetricEnergy::motion)
    }

    /// Sum of the functions of the length.
    #[must_use]
    pub fn of_length(&self, length: f64) -> LengthJet {
        self.terms.iter().map(|term| term.of_length(length)).fold(LengthJet::default(), LengthJet::plus)
    }

    /// ⟨D₊a·D₊b⟩ by Parseval's identity.
    fn slope_product(&self, a: &[Complex64], b: &[Complex64]) -> f64 {
        let laplacian = self.derivative.minus_laplacian();
        let product = |m: usize| laplacian[m] * (a[m].re * b[m].re + a[m].im * b[m].im);
        // The mean has no slope; the sawtooth, present once, was counted like the others.
        2.0 * weighted_dot(laplacian, a, b) - self.grid.sawtooth_mode().map_or(0.0, product)
    }

    /// Energy, and its gradient into `gradient`.
    pub fn gradient(&mut self, at: &CurveFields, gradient: &mut IntrinsicGradient) -> f64 {
        self.evaluate(at, Order::Gradient, gradient)
    }

    /// As [`EnergySum::gradient`], keeping the second derivatives for [`EnergySum::hessian_product`].
    pub fn linearise(&mut self, at: &CurveFields, gradient: &mut IntrinsicGradient) -> f64 {
        let energy = self.evaluate(at, Order::Hessian, gradient);
        self.freeze_stiffness();
        energy
    }

    fn evaluate(&mut self, at: &CurveFields, order: Order, gradient: &mut IntrinsicGradient) -> f64 {
        let length = at.length();
        self.set_density(at, order);
        let of_length = self.of_length(length);
        if let Some(moving) = &mut self.moving {
            let (terms, stiffness) = (&mut self.terms, &self.stiffness);
            let energy = moving.evaluate(terms, &self.jet, stiffness, of_length, at, order, gradient);
            return energy + self.add_shape_gradient(at, order, gradient);
        }
        let mean_density = at.mean(self.jet.value());
        let mut energy = length * mean_density + of_length.value;
        let mut by_length = mean_density + of_length.first;
        for field in 0..self.layout.fields() {
            let p = &mut gradient.spectra[self.layout.spectrum(field)];
            let coefficient = self.stiffness[field];
            if self.graded.is_some() {
                p.fill(Complex64::default());
            } else {
                self.grid.transform(self.jet.first(field), p);
            }
            if coefficient != 0.0 {
                let phi = at.spectrum(field);
                let scale = coefficient / (length * length);
                let square = if let Some(graded) = &mut self.graded {
                    let image = graded.image(phi);
                    add_spectrum(p, scale, image);
                    let square = mean_product(&self.grid, phi, image);
                    if order >= Order::Hessian {
                        graded.freeze(field);
                    }
                    square
                } else {
                    add_real_symbol(p, scale, phi, self.derivative.minus_laplacian());
                    self.slope_product(phi, phi)
                };
                if order >= Order::Hessian {
                    self.frozen_slope_squares[field] = square;
                }
                energy += 0.5 * coefficient / length * square;
                by_length -= 0.5 * scale * square;
            }
        }
        if let Some(slopes) = &mut self.slopes {
            let (value, derivative) = slopes.add_gradient(&mut self.terms, at, order, gradient);
            energy += value;
            by_length += derivative;
        }
        for field in 0..self.layout.fields() {
            let p = &mut gradient.spectra[self.layout.spectrum(field)];
            if let Some(graded) = &mut self.graded {
                graded.finish(self.jet.first(field), p);
            }
            by_length -= mean_product(&self.grid, at.weighted_spectrum(field), p);
        }
        gradient.by_length = by_length;
        energy + self.add_shape_gradient(at, order, gradient)
    }

    /// Second derivative times the motion `v` of the spectral state vector, at the state of the last
    /// [`EnergySum::linearise`], whose fields are `at`.
    ///
    /// # Panics
    /// If `v` is no spectral vector of the layout.
    pub fn hessian_product(&mut self, at: &CurveFields, v: &[f64], out: &mut IntrinsicGradient) {
        let (fields, length) = (self.layout.fields(), at.length());
        let (layout, of_length) = (SpectralLayout::new(self.layout), self.of_length(length));
        layout.check(v);
        if let Some(moving) = &mut self.moving {
            moving.hessian_product(&self.jet, of_length, at, layout.spectra(v), out);
            if let Some(shape) = &mut self.shape {
                shape.add_hessian_product(&mut self.terms, v, out);
            }
            return;
        }
        let length_motion = v[layout.length_index()];
        for field in 0..fields {
            let spectrum = &mut self.motion_spectra[self.layout.spectrum(field)];
            scale_into(bytemuck::cast_slice_mut(spectrum), 1.0 / length, &v[layout.field(field)]);
            add_spectrum(spectrum, -length_motion / length, at.weighted_spectrum(field));
            let motion = &mut self.motion[self.layout.field(field)];
            self.grid.synthesise(spectrum, motion);
            if let Some(grading) = self.derivative.grading() {
                multiply(motion, grading.inverse());
                self.grid.transform(motion, spectrum);
            }
        }
        let mut by_length = of_length.second * length_motion;
        for field in 0..fields {
            multiply_into(&mut self.product, self.jet.second(field, 0), &self.motion[self.layout.field(0)]);
            for other in 1..fields {
                let motion = &self.motion[self.layout.field(other)];
                add_product(&mut self.product, self.jet.second(field, other), motion);
            }
            let p = &mut out.spectra[self.layout.spectrum(field)];
            if self.graded.is_some() {
                self.density_rates[self.layout.field(field)].copy_from_slice(&self.product);
                p.fill(Complex64::default());
            } else {
                self.grid.transform(&self.product, p);
            }
            let coefficient = self.stiffness[field];
            if coefficient != 0.0 {
                let (phi, motion) = (at.spectrum(field), &self.motion_spectra[self.layout.spectrum(field)]);
                let scale = coefficient / (length * length);
                let shrink = -2.0 * scale * length_motion / length;
                let cross = if let Some(graded) = &mut self.graded {
                    add_spectrum(p, scale, graded.image(motion));
                    add_spectrum(p, shrink, graded.frozen(field));
                    mean_product(&self.grid, graded.frozen(field), motion)
                } else {
                    let laplacian = self.derivative.minus_laplacian();
                    add_real_symbol(p, scale, motion, laplacian);
                    add_real_symbol(p, shrink, phi, laplacian);
                    self.slope_product(phi, motion)
                };
                by_length +=
                    scale * (self.frozen_slope_squares[field] / length * length_motion - 2.0 * cross);
            }
        }
        if let Some(slopes) = &mut self.slopes {
            by_length += slopes.add_hessian_product(at, &self.motion_spectra, length_motion, out);
        }
        for field in 0..fields {
            let p = &mut out.spectra[self.layout.spectrum(field)];
            if let Some(graded) = &mut self.graded {
                graded.finish(&self.density_rates[self.layout.field(field)], p);
            }
            by_length -= mean_product(&self.grid, at.weighted_spectrum(field), p);
        }
        out.by_length = by_length;
        if let Some(shape) = &mut self.shape {
            shape.add_hessian_product(&mut self.terms, v, out);
        }
    }
}
