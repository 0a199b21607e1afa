//! Right-hand side and Jacobian products of the bending energy alone.

use bytemuck::{cast_slice, cast_slice_mut};
use flow_core::geometry::vectors::{
    add_product, add_real_symbol, add_scaled, apply_real_symbol, apply_symbol, dot, mean, mean_of_product,
    multiply_by, multiply_by_conjugate, multiply_into, scale_into, shift_into,
};
use flow_core::geometry::{Complex64, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};
use multiversion::multiversion;

/// The curvature of one state.
#[derive(Clone, Debug)]
struct Curve {
    length: f64,
    curvature: Vec<f64>,
    spectrum: Vec<Complex64>,
}

/// The flow with its scratch.
#[derive(Debug)]
pub(super) struct BendingFlow {
    rigidity: f64,
    grid: PeriodicGrid,
    derivative: Derivative,
    current: Curve,
    frozen: Curve,
    density: Vec<f64>,
    /// bκ, and the second derivative b, at the nodes.
    moment: Vec<f64>,
    stiffness: Vec<f64>,
    gradient: Vec<Complex64>,
    by_length: f64,
    velocity: Vec<f64>,
    /// Z − π at the state evaluated last, and at the linearisation: minus the tension.
    stretching: [Vec<f64>; 2],
    /// δκ at the nodes.
    motion: Vec<f64>,
    values: Vec<f64>,
    product: Vec<f64>,
    spectrum: Vec<Complex64>,
    length_rate: f64,
}

impl BendingFlow {
    pub fn new(nodes: usize, rigidity: f64) -> Self {
        let grid = PeriodicGrid::new(nodes);
        let derivative = Derivative::new(DerivativeFamily::Fourier, &grid);
        let (field, spectrum) = (vec![0.0; nodes], vec![Complex64::default(); grid.modes()]);
        let curve = Curve { length: 1.0, curvature: field.clone(), spectrum: spectrum.clone() };
        Self {
            rigidity,
            derivative,
            frozen: curve.clone(),
            current: curve,
            density: field.clone(),
            moment: field.clone(),
            stiffness: vec![rigidity; nodes],
            gradient: spectrum.clone(),
            by_length: 0.0,
            velocity: field.clone(),
            stretching: [field.clone(), field.clone()],
            motion: field.clone(),
            values: field.clone(),
            product: field,
            spectrum,
            length_rate: 0.0,
            grid,
        }
    }

    pub fn modes(&self) -> usize {
        self.grid.modes()
    }

    pub fn curvature(&self) -> &[f64] {
        &self.current.curvature
    }

    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Energy, gradient and velocity at the spectral state `y`.
    pub fn evaluate(&mut self, y: &[f64]) -> f64 {
        let b = self.rigidity;
        let Curve { length, curvature, spectrum } = &mut self.current;
        let turning = 2 * spectrum.len();
        *length = y[turning];
        scale_into(cast_slice_mut(spectrum), 1.0 / *length, &y[..turning]);
        self.grid.synthesise(spectrum, curvature);
        bend(b, curvature, &mut self.density, &mut self.moment);
        let mean_density = mean(&self.density);
        self.grid.transform(&self.moment, &mut self.gradient);
        self.by_length = mean_density - mean_product(&self.grid, spectrum, &self.gradient);
        let energy = *length * mean_density;
        self.descend(false);
        energy
    }

    /// Keeps the state evaluated last as that of the linearisation.
    pub fn freeze(&mut self) {
        self.frozen.length = self.current.length;
        self.frozen.curvature.copy_from_slice(&self.current.curvature);
        self.frozen.spectrum.copy_from_slice(&self.current.spectrum);
        let [current, frozen] = &mut self.stretching;
        frozen.copy_from_slice(current);
    }

    /// Dissipation at the state evaluated last, where the force is the velocity.
    pub fn dissipation(&self) -> f64 {
        self.current.length * mean_of_product(&self.velocity, &self.velocity)
    }

    /// Gradient and velocity of the second derivative times the motion `v`.
    pub fn frozen_hessian_product(&mut self, v: &[f64]) {
        let Curve { length, spectrum, .. } = &self.frozen;
        let turning = 2 * spectrum.len();
        let length_motion = v[turning];
        scale_into(cast_slice_mut(&mut self.spectrum), 1.0 / length, &v[..turning]);
        add_scaled(cast_slice_mut(&mut self.spectrum), -length_motion / length, cast_slice(spectrum));
        self.grid.synthesise(&self.spectrum, &mut self.motion);
        multiply_into(&mut self.product, &self.stiffness, &self.motion);
        self.grid.transform(&self.product, &mut self.gradient);
        self.by_length = -mean_product(&self.grid, spectrum, &self.gradient);
        self.descend(true);
        // (Z − π)δκ, (F20).
        add_product(&mut self.velocity, &self.stretching[1], &self.motion);
    }

    /// V = f of the gradient at hand.
    fn descend(&mut self, frozen: bool) {
        let at = if frozen { &self.frozen } else { &self.current };
        apply_symbol(&mut self.spectrum, &self.gradient, self.derivative.to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.values);
        multiply_into(&mut self.product, &at.curvature, &self.values);
        self.grid.transform(&self.product, &mut self.spectrum);
        multiply_by(&mut self.spectrum, self.derivative.inverse_to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.values);
        if frozen {
            multiply_shifted(&mut self.velocity, &at.curvature, &self.values, self.by_length);
        } else {
            let stretching = &mut self.stretching[0];
            shift_into(stretching, -self.by_length, &self.values);
            multiply_into(&mut self.velocity, &at.curvature, stretching);
        }
        let scale = -1.0 / at.length.powi(2);
        apply_real_symbol(&mut self.spectrum, scale, &self.gradient, self.derivative.minus_laplacian());
        self.grid.synthesise(&self.spectrum, &mut self.values);
        add_scaled(&mut self.velocity, 1.0, &self.values);
    }

    pub fn write_rates(&mut self, rate: &mut [f64]) {
        self.move_nodes(false);
        self.write_rates_at_hand(rate);
    }

    /// Those at the state evaluated last, right after [`BendingFlow::tangential_velocity`].
    pub fn write_rates_at_hand(&mut self, rate: &mut [f64]) {
        self.transport(false, rate);
    }

    pub fn write_frozen_rates(&mut self, rate: &mut [f64]) {
        self.move_nodes(true);
        self.transport(true, rate);
    }

    /// Tangential velocity W at the state evaluated last.
    pub fn tangential_velocity(&mut self, w: &mut [f64]) {
        self.move_nodes(false);
        w.copy_from_slice(&self.values);
    }

    /// W and the rate of the length, (F1).
    fn move_nodes(&mut self, frozen: bool) {
        let at = if frozen { &self.frozen } else { &self.current };
        multiply_into(&mut self.product, &at.curvature, &self.velocity);
        self.grid.transform(&self.product, &mut self.spectrum);
        self.length_rate = at.length * self.spectrum[0].re;
        multiply_by_conjugate(&mut self.spectrum, at.length, self.derivative.inverse_to_flux());
        self.grid.synthesise(&self.spectrum, &mut self.values);
    }

    /// Rates of the state, (F2).
    fn transport(&mut self, frozen: bool, out: &mut [f64]) {
        let at = if frozen { &self.frozen } else { &self.current };
        let turning = 2 * self.spectrum.len();
        out[turning] = self.length_rate;
        multiply_into(&mut self.product, &at.curvature, &self.values);
        let rate: &mut [Complex64] = cast_slice_mut(&mut out[..turning]);
        self.grid.transform(&self.product, rate);
        multiply_by_conjugate(rate, -1.0, self.derivative.to_flux());
        self.grid.transform(&self.velocity, &mut self.spectrum);
        add_real_symbol(rate, 1.0 / at.length, &self.spectrum, self.derivative.minus_laplacian());
        self.grid.make_real(rate);
    }

    /// Derivative of the energy at the state evaluated last along the spectral `direction`.
    pub fn energy_slope(&self, direction: &[f64]) -> f64 {
        let turning = 2 * self.gradient.len();
        let motion: &[Complex64] = cast_slice(&direction[..turning]);
        mean_product(&self.grid, &self.gradient, motion) + self.by_length * direction[turning]
    }

    /// The eigenvalue of each mode at the linearisation with the coefficients frozen at their means.
    pub fn eigenvalues(&self) -> impl Iterator<Item = f64> {
        let (length, stiffness) = (self.frozen.length, mean(&self.stiffness));
        let tension = -mean(&self.stretching[1]);
        self.derivative.minus_laplacian().iter().map(move |laplacian| {
            let square = laplacian / (length * length);
            let stretched = if square > 0.0 { tension / square } else { 0.0 };
            -square * (stiffness + stretched) * square
        })
    }

    /// The symbol of (I − γJ)⁻¹ at the linearisation, by mode.
    pub fn invert_symbol(&self, gamma: f64, inverse: &mut [f64]) {
        let (length, stiffness) = (self.frozen.length, mean(&self.stiffness));
        let tension = (-mean(&self.stretching[1])).max(0.0);
        invert(inverse, self.derivative.minus_laplacian(), length, gamma, [stiffness, tension]);
    }
}

/// (b/2)κ² and bκ.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn bend(b: f64, kappa: &[f64], density: &mut [f64], moment: &mut [f64]) {
    for ((e, moment), kappa) in density.iter_mut().zip(moment).zip(kappa) {
        *e = 0.5 * b * kappa * kappa;
        *moment = b * kappa;
    }
}

/// f = κ(z − π).
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn multiply_shifted(f: &mut [f64], kappa: &[f64], z: &[f64], by_length: f64) {
    for ((f, z), kappa) in f.iter_mut().zip(z).zip(kappa) {
        *f = kappa * (z - by_length);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn invert(inverse: &mut [f64], laplacian: &[f64], length: f64, gamma: f64, [stiffness, tension]: [f64; 2]) {
    for (inverse, laplacian) in inverse.iter_mut().zip(laplacian) {
        let square = laplacian / (length * length);
        let mobility = gamma * (square * square);
        *inverse = 1.0 / (mobility * stiffness + 1.0 + gamma * tension * square);
    }
}

/// Mean of the product of two fields by Parseval's identity.
fn mean_product(grid: &PeriodicGrid, a: &[Complex64], b: &[Complex64]) -> f64 {
    let product = |m: usize| a[m].re * b[m].re + a[m].im * b[m].im;
    let full = dot(cast_slice(a), cast_slice(b));
    2.0 * full - product(0) - grid.sawtooth_mode().map_or(0.0, product)
}
