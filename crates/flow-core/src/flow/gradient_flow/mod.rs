//! The right-hand side −`𝓚(X)∇𝓕_h` and the implicit operator −𝓚 Hess `𝓕_h`. See `THEORY.md`, eqs. (F6) and (F7).

mod derivative_check;
mod implicit;
mod not_finite;
mod part_costs;
mod parts;
mod slopes;
mod turning;

use implicit::drive;

use super::curve_fields::CurveFields;
use super::density_mobility::DensityMobility;
use super::energy_sum::EnergySum;
use super::flow_map::FlowMap;
use super::graded_energy::add_spectrum;
use super::intrinsic_gradient::IntrinsicGradient;
use super::normal_mobility::{MobilityError, NormalMobility};
use crate::geometry::{Complex64, Layout, SpectralLayout};

pub use derivative_check::DerivativeErrors;
pub use part_costs::{EvaluationCost, PartCosts};

/// What an evaluation of the flow tells besides the rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rate {
    /// Energy `𝓕_h`.
    pub energy: f64,
    /// Dissipation ⟨f, 𝓑f⟩ + ⟨∂_ρ𝓕, 𝓖∂_ρ𝓕⟩ ≥ 0.
    pub dissipation: f64,
}

/// A gradient flow on one grid, with all its scratch.
///
/// ```
/// use flow_core::energies::{Bending, EnergyTerm, Length};
/// use flow_core::flow::{EnergySum, FlowMap, GradientFlow, Identity};
/// use flow_core::geometry::{Layout, PeriodicGrid, SpectralLayout};
/// use flow_core::operators::{Derivative, DerivativeFamily};
/// use std::f64::consts::TAU;
///
/// // ∫½κ² dσ + σ|Γ| on 32 nodes, without densities.
/// let (nodes, tension) = (32, 0.3);
/// let (layout, mut grid) = (Layout::new(nodes, 0), PeriodicGrid::new(nodes));
/// let derivative = Derivative::new(DerivativeFamily::Fourier, &grid);
/// let terms: Vec<Box<dyn EnergyTerm>> = vec![Box::new(Bending::new(1.0)), Box::new(Length::Tension(tension))];
/// let energy = EnergySum::new(terms, layout, &grid, &derivative);
/// let map = FlowMap::new(layout, &grid, &derivative);
/// let mut flow = GradientFlow::new(map, energy, layout, Box::new(Identity), vec![]);
///
/// // A circle of radius 2: V = κ³/2 − σκ all along it.
/// let (radius, spectral) = (2.0, SpectralLayout::new(layout));
/// let nodal = layout.assemble(&vec![1.0 / radius; nodes], &[], TAU * radius);
/// let mut state = vec![0.0; spectral.len()];
/// spectral.encode(&mut grid, &nodal, &mut state);
/// let mut rate = vec![0.0; spectral.len()];
/// let at = flow.spectral_rate(&state, &mut rate);
///
/// let velocity = 0.5 / radius.powi(3) - tension / radius;
/// assert!(flow.normal_velocity().iter().all(|v| (v - velocity).abs() < 1e-12));
/// assert!((at.dissipation - TAU * radius * velocity * velocity).abs() < 1e-12);
/// assert!((rate[spectral.length_index()] - TAU * velocity).abs() < 1e-12);
/// ```
#[derive(Debug)]
pub struct GradientFlow {
    layout: Layout,
    map: FlowMap,
    energy: EnergySum,
    density_mobilities: Vec<Box<dyn DensityMobility>>,
    current: CurveFields,
    current_mobility: Box<dyn NormalMobility>,
    frozen: CurveFields,
    frozen_mobility: Box<dyn NormalMobility>,
    frozen_fault: Option<MobilityError>,
    /// Whether there is a linearisation.
    linearised: bool,
    /// Minus the tension at the linearisation.
    frozen_stretching: Vec<f64>,
    gradient: IntrinsicGradient,
    force: Vec<f64>,
    velocity: Vec<f64>,
    spectrum: Vec<Complex64>,
}

impl GradientFlow {
    /// The flow of `energy` under the mobilities, one density mobility per density.
    ///
    /// # Panics
    /// If there are more or fewer of them.
    #[must_use]
    pub fn new(
        mut map: FlowMap,
        energy: EnergySum,
        layout: Layout,
        normal_mobility: Box<dyn NormalMobility>,
        density_mobilities: Vec<Box<dyn DensityMobility>>,
    ) -> Self {
        assert_eq!(density_mobilities.len(), layout.densities(), "one mobility per density");
        let (grid, derivative) = map.grid_and_derivative();
        let current = CurveFields::new(layout, grid, derivative);
        let modes = grid.modes();
        let spectra = vec![Complex64::default(); layout.state_fields() * modes];
        Self {
            layout,
            map,
            energy,
            density_mobilities,
            frozen: current.clone(),
            frozen_mobility: normal_mobility.boxed_clone(),
            frozen_fault: None,
            linearised: false,
            frozen_stretching: vec![0.0; layout.nodes()],
            current,
            current_mobility: normal_mobility,
            gradient: IntrinsicGradient { spectra, by_length: 0.0 },
            force: vec![0.0; layout.nodes()],
            velocity: vec![0.0; layout.nodes()],
            spectrum: vec![Complex64::default(); modes],
        }
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

    /// Spectral rate at the state evaluated last, by [`GradientFlow::spectral_dissipation`].
    pub fn rate_at_hand(&mut self, rate: &mut [f64]) {
        self.write_rates(false, rate);
    }

    /// Takes the fields of the spectral `state`, without evaluating anything.
    pub fn set_current(&mut self, state: &[f64]) {
        let (grid, derivative) = self.map.grid_and_derivative();
        self.current.set(state, grid, derivative);
    }

    /// Energy of the spectral `state`; its gradient is then at [`GradientFlow::gradient`].
    pub fn spectral_gradient(&mut self, state: &[f64]) -> f64 {
        self.set_current(state);
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

    /// Force f on the normal motion at the state evaluated last.
    #[must_use]
    pub fn normal_force(&self) -> &[f64] {
        &self.force
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
        self.frozen_fault = self.frozen_mobility.set(&self.frozen).err();
        self.linearised = true;
        self.freeze_tension();
        self.hold_area();
    }

    /// Spectral rate at the state of the linearisation; call right after [`GradientFlow::spectral_linearise`].
    pub fn frozen_rate(&mut self, rate: &mut [f64]) {
        if self.energy.depends_on_positions() {
            self.descend(true); // the tension is left out there
        } else {
            let (frozen, gradient) = (&self.frozen, &self.gradient.spectra);
            self.map.complete_force(frozen, gradient, &self.frozen_stretching, &mut self.force);
            self.drive_frozen();
        }
        self.write_rates(true, rate);
    }

    /// Product of the frozen Hess `𝓕_h` with the spectral `v`, at [`GradientFlow::gradient`].
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn spectral_hessian_product(&mut self, v: &[f64]) {
        assert!(self.linearised, "products are those of a linearisation, and there is none");
        self.energy.hessian_product(&self.frozen, v, &mut self.gradient);
    }

    /// 𝓚 applied to the spectral dual vector `dual`, at the frozen state.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`].
    pub fn spectral_mobility(&mut self, dual: &[f64], out: &mut [f64]) {
        assert!(self.linearised, "𝓚 is that at a linearisation, and there is none");
        let layout = self.spectral_layout();
        self.gradient.spectra.copy_from_slice(layout.spectra(dual));
        self.gradient.by_length = dual[layout.length_index()];
        self.descend(true);
        self.write_rates(true, out);
        for value in out.iter_mut() {
            *value = -*value;
        }
    }

    /// Force and normal velocity of the gradient at hand; the velocity is NaN where the mobility is not defined.
    fn descend(&mut self, frozen: bool) {
        let (at, mobility, fault) = if frozen {
            (&self.frozen, &mut self.frozen_mobility, self.frozen_fault)
        } else {
            let fault = self.current_mobility.set(&self.current).err();
            (&self.current, &mut self.current_mobility, fault)
        };
        self.map.force(at, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
        drive(mobility.as_mut(), fault, at, &self.force, &mut self.velocity);
    }

    fn dissipation(&mut self) -> f64 {
        let of_the_curve = self.current.mean_of_product(&self.force, &self.velocity);
        self.add_density_dissipation(self.current.length() * of_the_curve)
    }

    fn add_density_dissipation(&mut self, mut sum: f64) -> f64 {
        let length = self.current.length();
        for (density, mobility) in self.density_mobilities.iter_mut().enumerate() {
            if let Some(metric) = self.current.moving_metric() {
                mobility.follow(metric);
            }
            let mu = &self.gradient.spectra[self.layout.spectrum(density + 1)];
            mobility.apply(length, mu, &mut self.spectrum);
            sum += length * self.map.mean_product(mu, &self.spectrum);
        }
        sum
    }

    /// Rates of the velocity and of the gradient at hand.
    fn write_rates(&mut self, frozen: bool, out: &mut [f64]) {
        let at = if frozen { &self.frozen } else { &self.current };
        let length = at.length();
        let layout = SpectralLayout::new(self.layout);
        let rates = layout.spectra_mut(out);
        let length_rate = if frozen {
            self.map.rates(at, &self.velocity, rates)
        } else {
            self.map.rates_at_hand(at, &self.velocity, rates)
        };
        let grid = self.map.grid_mut();
        for (density, mobility) in self.density_mobilities.iter_mut().enumerate() {
            if let Some(metric) = at.moving_metric() {
                mobility.follow(metric);
            }
            let range = self.layout.spectrum(density + 1);
            mobility.apply(length, &self.gradient.spectra[range.clone()], &mut self.spectrum);
            add_spectrum(&mut rates[range], -length, &self.spectrum);
        }
        grid.make_real(rates);
        out[layout.length_index()] = length_rate;
    }
}
