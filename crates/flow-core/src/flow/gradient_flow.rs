//! The right-hand side −`𝓚(X)∇𝓕_h` and the implicit operator −𝓚 Hess `𝓕_h`. See `THEORY.md`, eqs. (F6) and (F7).

use super::curve_fields::CurveFields;
use super::density_mobility::DensityMobility;
use super::energy_sum::{EnergySum, IntrinsicGradient};
use super::flow_map::FlowMap;
use super::normal_mobility::NormalMobility;
use crate::geometry::{Complex64, Layout, SpectralLayout};

/// What an evaluation of the flow tells besides the rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rate {
    /// Energy `𝓕_h`.
    pub energy: f64,
    /// Dissipation ⟨f, 𝓑f⟩ + ⟨∂_ρ𝓕, 𝓖∂_ρ𝓕⟩ ≥ 0.
    pub dissipation: f64,
}

/// A gradient flow on one grid, with all its scratch.
#[derive(Debug)]
pub struct GradientFlow {
    layout: Layout,
    map: FlowMap,
    energy: EnergySum,
    normal_mobility: Box<dyn NormalMobility>,
    density_mobilities: Vec<DensityMobility>,
    current: CurveFields,
    frozen: CurveFields,
    gradient: IntrinsicGradient,
    force: Vec<f64>,
    velocity: Vec<f64>,
}

impl GradientFlow {
    /// The flow of `energy` under the mobilities, one density mobility per density.
    #[must_use]
    pub fn new(
        mut map: FlowMap,
        energy: EnergySum,
        layout: Layout,
        normal_mobility: Box<dyn NormalMobility>,
        density_mobilities: Vec<DensityMobility>,
    ) -> Self {
        assert_eq!(density_mobilities.len(), layout.densities(), "one mobility per density");
        let (grid, derivative) = map.grid_and_derivative();
        let current = CurveFields::new(layout, grid, derivative);
        let spectra = vec![Complex64::default(); layout.fields() * grid.modes()];
        Self {
            layout,
            map,
            energy,
            normal_mobility,
            density_mobilities,
            frozen: current.clone(),
            current,
            gradient: IntrinsicGradient { spectra, by_length: 0.0 },
            force: vec![0.0; layout.nodes()],
            velocity: vec![0.0; layout.nodes()],
        }
    }

    /// Shape of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// The terms of the energy, to read.
    #[must_use]
    pub fn energy_terms(&self) -> &EnergySum {
        &self.energy
    }

    /// Mobilities of the densities.
    #[must_use]
    pub fn density_mobilities(&self) -> &[DensityMobility] {
        &self.density_mobilities
    }

    /// Fields at the state evaluated last.
    #[must_use]
    pub fn current(&self) -> &CurveFields {
        &self.current
    }

    /// Fields at the linearisation.
    #[must_use]
    pub fn frozen(&self) -> &CurveFields {
        &self.frozen
    }

    /// Grid and derivative.
    pub fn grid_and_derivative(
        &mut self,
    ) -> (&mut crate::geometry::PeriodicGrid, &crate::operators::Derivative) {
        self.map.grid_and_derivative()
    }

    /// Shape of the spectral state vector.
    #[must_use]
    pub fn spectral_layout(&self) -> SpectralLayout {
        SpectralLayout::new(self.layout)
    }

    /// How often a mode stands in the full spectrum.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        self.map.multiplicity(mode)
    }

    /// Rate of `state` into `rate`, both spectral.
    pub fn spectral_rate(&mut self, state: &[f64], rate: &mut [f64]) -> Rate {
        let evaluated = self.spectral_dissipation(state);
        self.write_rates(false, rate);
        evaluated
    }

    /// Energy and dissipation of the spectral `state`; cheaper than a rate.
    pub fn spectral_dissipation(&mut self, state: &[f64]) -> Rate {
        let energy = self.spectral_gradient(state);
        self.descend(false);
        Rate { energy, dissipation: self.dissipation() }
    }

    /// Energy of the spectral `state`; its gradient is then at [`GradientFlow::gradient`].
    pub fn spectral_gradient(&mut self, state: &[f64]) -> f64 {
        let (grid, derivative) = self.map.grid_and_derivative();
        self.current.set(state, grid, derivative);
        self.energy.gradient(&self.current, &mut self.gradient)
    }

    /// Energy of each term at the state evaluated last.
    pub fn current_energies_by_term(&mut self) -> Vec<f64> {
        self.energy.energies_by_term(&self.current)
    }

    /// What a term finds wrong with the state evaluated last.
    #[must_use]
    pub fn fault(&self) -> Option<crate::energies::TermFault> {
        self.energy.fault(&self.current)
    }

    /// Gradient of the energy at the state evaluated last.
    #[must_use]
    pub fn gradient(&self) -> &IntrinsicGradient {
        &self.gradient
    }

    /// Normal velocity V at the state evaluated last.
    #[must_use]
    pub fn normal_velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Tangential velocity W at the state evaluated last.
    pub fn tangential_velocity(&mut self, w: &mut [f64]) {
        self.map.tangential_velocity(&self.current, &self.velocity, w);
    }

    /// Freezes the implicit operator −𝓚 Hess `𝓕_h` at the spectral `state`.
    pub fn spectral_linearise(&mut self, state: &[f64]) {
        let (grid, derivative) = self.map.grid_and_derivative();
        self.frozen.set(state, grid, derivative);
        self.energy.linearise(&self.frozen, &mut self.gradient);
    }

    /// Spectral rate at the state of the linearisation; call right after [`GradientFlow::spectral_linearise`].
    pub fn frozen_rate(&mut self, rate: &mut [f64]) {
        self.descend(true);
        self.write_rates(true, rate);
    }

    /// Product of the frozen −𝓚 Hess `𝓕_h` with `v`, both spectral.
    pub fn spectral_jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.spectral_hessian_product(v);
        self.descend(true);
        self.write_rates(true, out);
    }

    /// Product of the frozen Hess `𝓕_h` with the spectral `v`, at [`GradientFlow::gradient`].
    pub fn spectral_hessian_product(&mut self, v: &[f64]) {
        self.energy.hessian_product(&self.frozen, v, &mut self.gradient);
    }

    /// 𝓚 applied to the spectral dual vector `dual`, at the frozen state.
    pub fn spectral_mobility(&mut self, dual: &[f64], out: &mut [f64]) {
        let layout = self.spectral_layout();
        self.gradient.spectra.copy_from_slice(layout.spectra(dual));
        self.gradient.by_length = dual[layout.length_index()];
        self.descend(true);
        self.write_rates(true, out);
        for value in out.iter_mut() {
            *value = -*value;
        }
    }

    /// Force and normal velocity of the gradient at hand.
    fn descend(&mut self, frozen: bool) {
        let at = if frozen { &self.frozen } else { &self.current };
        self.map.force(at, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
        self.normal_mobility.apply(at, &self.force, &mut self.velocity);
    }

    fn dissipation(&mut self) -> f64 {
        let length = self.current.length();
        let nodes = self.layout.nodes() as f64;
        let normal: f64 = self.force.iter().zip(&self.velocity).map(|(f, v)| f * v).sum();
        let mut sum = length * normal / nodes;
        let (grid, derivative) = self.map.grid_and_derivative();
        let modes = grid.modes();
        for (density, mobility) in self.density_mobilities.iter().enumerate() {
            let mu = &self.gradient.spectra[(density + 1) * modes..(density + 2) * modes];
            let mut square = 0.0;
            for (mode, (mu, symbol)) in mu.iter().zip(derivative.minus_laplacian()).enumerate() {
                square += grid.multiplicity(mode) * mobility.symbol(*symbol, length) * mu.norm_sqr();
            }
            sum += length * square;
        }
        sum
    }

    /// Rates of the velocity and of the gradient at hand.
    fn write_rates(&mut self, frozen: bool, out: &mut [f64]) {
        let at = if frozen { &self.frozen } else { &self.current };
        let length = at.length();
        let layout = SpectralLayout::new(self.layout);
        let rates = layout.spectra_mut(out);
        let length_rate = self.map.rates(at, &self.velocity, rates);
        let (grid, derivative) = self.map.grid_and_derivative();
        let modes = grid.modes();
        for (density, mobility) in self.density_mobilities.iter().enumerate() {
            let range = (density + 1) * modes..(density + 2) * modes;
            let (rate, mu) = (&mut rates[range.clone()], &self.gradient.spectra[range]);
            for ((rate, mu), symbol) in rate.iter_mut().zip(mu).zip(derivative.minus_laplacian()) {
                *rate -= mu * (length * mobility.symbol(*symbol, length));
            }
        }
        // Of the mean and of the sawtooth a real field has the real part only. The rounding of the symbols must not
        // leave more: 𝓚 Hess does not act on the rest, which no solve could then reduce.
        for spectrum in rates.chunks_exact_mut(modes) {
            spectrum[0].im = 0.0;
            if let Some(sawtooth) = grid.sawtooth_mode() {
                spectrum[sawtooth].im = 0.0;
            }
        }
        out[layout.length_index()] = length_rate;
    }
}
