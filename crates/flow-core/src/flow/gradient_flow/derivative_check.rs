//! Whether the derivatives of the terms are those of their energies: by differences, at one state.

use std::f64::consts::TAU;

use super::{Descent, GradientFlow};
use crate::flow::curve_fields::CurveFields;
use crate::flow::energy_sum::EnergySum;
use crate::flow::graded_energy::mean_product;
use crate::flow::intrinsic_gradient::IntrinsicGradient;
use crate::geometry::vectors::{mean, mean_of_product, scale};
use crate::geometry::{Complex64, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::Derivative;

/// By how much the derivatives of one term are off, as parts of themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DerivativeErrors {
    /// Name of the term.
    pub term: &'static str,
    /// Largest error of the first derivative along a motion of one field, or of the length.
    pub gradient: f64,
    /// Largest error of the second derivative along such a motion.
    pub second_derivative: f64,
    /// Sum of the derivatives by the positions over their size: how far the term depends on the origin, which means nothing.
    pub net_force: f64,
}

impl DerivativeErrors {
    /// What differences of exact derivatives stay below (measured, for the terms of the library: 1e-9).
    pub const LARGEST: f64 = 1e-6;

    /// Whether all of them are below [`DerivativeErrors::LARGEST`]; NaN is not.
    #[must_use]
    pub fn are_small(&self) -> bool {
        [self.gradient, self.second_derivative, self.net_force].iter().all(|error| *error < Self::LARGEST)
    }
}

/// Part of a field by which a motion changes it.
const AMPLITUDE: f64 = 0.1;
/// Step of the differences along a motion: their error h⁴f⁽⁵⁾/30 and the rounding εf/h are then both near 1e-12 f.
const STEP: f64 = 1e-3;
/// Steps of the difference of order four, and its weights.
const STENCIL: [(f64, f64); 4] = [(1.0, 8.0), (-1.0, -8.0), (2.0, -1.0), (-2.0, 1.0)];
/// Part of the energy, and of its change along usual motions, below which a change does not count: where symmetries cancel it, all is
/// rounding.
const FLOOR: f64 = 1e-3;
/// Amplitude and phase of the smooth waves of a motion, and the amplitude of a rough one.
const WAVES: [(f64, f64); 6] = [(0.5, 0.0), (1.0, 0.3), (0.7, 1.6), (0.5, 1.0), (0.4, 2.2), (0.3, 2.0)];
const ROUGH: f64 = 0.2;

impl GradientFlow {
    /// Compares the derivatives of each term with differences at the nodal state `y`, in the order of the terms: the gradient with those
    /// of the energy, and the second derivative with those of the gradient.
    ///
    /// The motions change one field at a time, or the length: along a sum of waves, smooth ones and a rough one, and along the gradient.
    /// Takes some forty evaluations of each term for each field, and allocates: it is for tests. Linearise anew before further products.
    ///
    /// ```
    /// use flow_core::run::{Scene, Setup};
    ///
    /// let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").unwrap();
    /// let mut setup = Setup::new(&Scene::parse(text, "three_fold")?)?;
    /// let flow = setup.membrane.flow();
    /// let mut y = vec![0.0; flow.layout().len()];
    /// flow.decode(&setup.state, &mut y);
    /// assert!(flow.check_derivatives(&y).iter().all(|errors| errors.are_small()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// If a term adds a part that it does not declare (see [`UndeclaredPart`](crate::flow::UndeclaredPart)): it would be left out of the
    /// flow, and of the comparison. If `y` is no nodal vector of the layout.
    /// # Source
    /// `THEORY.md`, eqs. (D3)–(D10): the derivatives are those of the discrete energy.
    pub fn check_derivatives(&mut self, y: &[f64]) -> Vec<DerivativeErrors> {
        let state = self.encoded(y);
        self.set_current(&state);
        if let Some(part) = self.undeclared_part() {
            panic!("{part}");
        }
        self.derivative_errors(y)
    }

    /// Whether the gradient of a term is not the derivative of its energy at the spectral `state`; no where differences do not tell.
    pub fn has_wrong_gradient(&mut self, state: &[f64]) -> bool {
        let mut y = vec![0.0; self.layout().len()];
        self.decode(state, &mut y);
        self.derivative_errors(&y).iter().any(|errors| errors.gradient > DerivativeErrors::LARGEST)
    }

    fn derivative_errors(&mut self, y: &[f64]) -> Vec<DerivativeErrors> {
        self.linearised = false;
        let Descent { layout, map, gradient: out, .. } = &mut self.descent;
        let (layout, at) = (*layout, &mut self.current.fields);
        let (grid, derivative) = map.grid_and_derivative();
        let mut probe = Probe { layout, grid, derivative, at, out, usual: Vec::new() };
        let state = probe.encoded(y);
        let waves = probe.waves(y);
        probe.usual = waves.iter().enumerate().map(|(field, wave)| probe.motion_sizes(wave)[field]).collect();
        probe.usual.resize(layout.state_fields() + 1, AMPLITUDE * y[layout.length_index()]);
        let mut errors = Vec::new();
        self.energy.each_alone(|term| errors.push(probe.errors(term, &state, &waves)));
        errors
    }
}

/// A spectral dual vector: the spectra of its fields, and the length.
type Dual = (Vec<Complex64>, f64);

/// Evaluates a sum of one term.
struct Probe<'a> {
    layout: Layout,
    grid: &'a mut PeriodicGrid,
    derivative: &'a Derivative,
    at: &'a mut CurveFields,
    out: &'a mut IntrinsicGradient,
    /// Norms of the motions by waves, by field, and of that of the length.
    usual: Vec<f64>,
}

impl Probe<'_> {
    fn errors(&mut self, term: &mut EnergySum, state: &[f64], waves: &[Vec<f64>]) -> DerivativeErrors {
        let (_, gradient) = self.evaluated(term, state);
        let net_force = term.net_force();
        let along = self.along(&gradient, waves);
        let [mut first, mut second] = [0.0; 2];
        for motion in waves.iter().chain(&along) {
            let [of_energy, of_gradient] = self.compare(term, state, &gradient, motion);
            (first, second) = (worse(first, of_energy), worse(second, of_gradient));
        }
        let name = term.names().next().unwrap_or_default();
        DerivativeErrors { term: name, gradient: first, second_derivative: second, net_force }
    }

    /// Errors of both derivatives along `motion`.
    fn compare(&mut self, term: &mut EnergySum, state: &[f64], gradient: &Dual, motion: &[f64]) -> [f64; 2] {
        let (mut energy_rate, mut gradient_rate) = (0.0, zero_like(gradient));
        let mut sizes = self.sizes(gradient);
        let mut largest_energy: f64 = 0.0;
        for (steps, weight) in STENCIL {
            let moved: Vec<f64> = state.iter().zip(motion).map(|(y, v)| y + steps * STEP * v).collect();
            let (energy, there) = self.evaluated(term, &moved);
            let weight = weight / (12.0 * STEP);
            energy_rate += weight * energy;
            add(&mut gradient_rate, weight, &there);
            largest_energy = largest_energy.max(energy.abs());
            sizes.iter_mut().zip(self.sizes(&there)).for_each(|(size, there)| *size = size.max(there));
        }
        let sum = |of: &[f64]| sizes.iter().zip(of).map(|(gradient, motion)| gradient * motion).sum::<f64>();
        let (whole, usual) = (sum(&self.motion_sizes(motion)), sum(&self.usual));
        let missing = (energy_rate - self.pair(gradient, motion)).abs();
        let of_energy = part(missing, whole + FLOOR * (largest_energy + usual));

        self.at.set(state, self.grid, self.derivative);
        term.linearise(self.at, self.out);
        term.hessian_product(self.at, motion, self.out);
        let told = (self.out.spectra.clone(), self.out.by_length);
        let [told_sizes, rate_sizes] = [&told, &gradient_rate].map(|dual| self.sizes(dual));
        add(&mut gradient_rate, -1.0, &told);
        let missing = self.sizes(&gradient_rate);
        let of_gradient = (0..missing.len()).map(|block| {
            let floor = AMPLITUDE * sizes[block] + FLOOR * usual / self.usual[block];
            part(missing[block], told_sizes[block].max(rate_sizes[block]) + floor)
        });
        [of_energy, of_gradient.fold(0.0, worse)]
    }

    fn evaluated(&mut self, term: &mut EnergySum, state: &[f64]) -> (f64, Dual) {
        self.at.set(state, self.grid, self.derivative);
        let energy = term.gradient(self.at, self.out);
        (energy, (self.out.spectra.clone(), self.out.by_length))
    }

    fn encoded(&mut self, nodal: &[f64]) -> Vec<f64> {
        let spectral = SpectralLayout::new(self.layout);
        let mut state = vec![0.0; spectral.len()];
        spectral.encode(self.grid, nodal, &mut state);
        state
    }

    /// Motions of one field each, and of the length, by waves that are the part [`AMPLITUDE`] of it in the state `y`.
    fn waves(&mut self, y: &[f64]) -> Vec<Vec<f64>> {
        let (layout, nodes) = (self.layout, self.layout.nodes());
        let mut motions = Vec::new();
        for field in 0..layout.state_fields() {
            let mut motion = vec![0.0; layout.len()];
            let values = &mut motion[layout.field(field)];
            for (i, value) in values.iter_mut().enumerate() {
                let angle = |wave: usize| TAU * (wave * i % nodes) as f64 / nodes as f64;
                let smooth = WAVES
                    .iter()
                    .enumerate()
                    .map(|(k, (a, phase))| a * (angle(k) + phase + field as f64).cos());
                *value = smooth.sum::<f64>() + ROUGH * angle(3 * nodes / 8).cos();
            }
            let size = root_mean_square(&y[layout.field(field)]);
            let factor = AMPLITUDE * if size > 0.0 { size } else { 1.0 } / root_mean_square(values);
            scale(values, factor);
            if layout.metric() == Some(field) {
                motion[layout.length_index()] = mean(&motion[layout.field(field)]); // L is the mean of g
            }
            motions.push(self.encoded(&motion));
        }
        if layout.metric().is_none() {
            let mut motion = vec![0.0; motions[0].len()];
            let last = motion.len() - 1;
            motion[last] = AMPLITUDE * y[layout.length_index()];
            motions.push(motion);
        }
        motions
    }

    /// The motions of the fields along the gradient, as large as those by waves; the length moves by its own already.
    fn along(&self, gradient: &Dual, waves: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let spectral = SpectralLayout::new(self.layout);
        let (sizes, last) = (self.sizes(gradient), spectral.length_index());
        let mut motions = Vec::new();
        for (field, wave) in waves.iter().enumerate().take(self.layout.state_fields()) {
            let factor = self.usual[field] / sizes[field];
            if !factor.is_finite() {
                continue; // nothing pulls at it
            }
            let mut motion = vec![0.0; wave.len()];
            let modes = spectral.spectrum(field);
            let spectrum = &mut spectral.spectra_mut(&mut motion)[modes.clone()];
            spectrum.iter_mut().zip(&gradient.0[modes]).for_each(|(v, p)| *v = p * factor);
            if self.layout.metric() == Some(field) {
                motion[last] = spectrum[0].re;
            }
            motions.push(motion);
        }
        motions
    }

    /// ⟨`dual`, `motion`⟩.
    fn pair(&self, dual: &Dual, motion: &[f64]) -> f64 {
        let spectral = SpectralLayout::new(self.layout);
        let fields = dual
            .0
            .chunks_exact(spectral.modes())
            .zip(spectral.spectra(motion).chunks_exact(spectral.modes()));
        let sum: f64 = fields.map(|(p, v)| mean_product(self.grid, p, v)).sum();
        sum + dual.1 * motion[spectral.length_index()]
    }

    /// Norms of the fields, and the length.
    fn sizes(&self, dual: &Dual) -> Vec<f64> {
        let fields = dual.0.chunks_exact(self.grid.modes());
        let norm = |field: &[Complex64]| mean_product(self.grid, field, field).max(0.0).sqrt();
        fields.map(norm).chain([dual.1.abs()]).collect()
    }

    fn motion_sizes(&self, motion: &[f64]) -> Vec<f64> {
        let spectral = SpectralLayout::new(self.layout);
        self.sizes(&(spectral.spectra(motion).to_vec(), motion[spectral.length_index()]))
    }
}

/// The larger of two errors, NaN if one is.
fn worse(a: f64, b: f64) -> f64 {
    if b.is_nan() || b > a { b } else { a }
}

/// `missing` as a part of `whole`; nothing is missing of nothing.
fn part(missing: f64, whole: f64) -> f64 {
    if missing == 0.0 { 0.0 } else { missing / whole }
}

fn zero_like(dual: &Dual) -> Dual {
    (vec![Complex64::default(); dual.0.len()], 0.0)
}

fn add(sum: &mut Dual, factor: f64, dual: &Dual) {
    sum.0.iter_mut().zip(&dual.0).for_each(|(sum, value)| *sum += value * factor);
    sum.1 += factor * dual.1;
}

fn root_mean_square(values: &[f64]) -> f64 {
    mean_of_product(values, values).sqrt()
}
