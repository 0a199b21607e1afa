//! The right-hand side −`𝓚(X)∇𝓕_h` and the implicit operator −𝓚 Hess `𝓕_h`. See `THEORY.md`, eqs. (F6) and (F7).

mod area;
mod derivative_check;
mod descent;
mod implicit;
mod not_finite;
mod part_costs;
mod parts;
mod sliding;
mod slopes;
mod tension;
mod turning;

use area::AreaForce;
use descent::{Descent, Place};

use super::curve_fields::CurveFields;
use super::density_mobility::DensityMobility;
use super::energy_sum::EnergySum;
use super::flow_map::FlowMap;
use super::intrinsic_gradient::IntrinsicGradient;
use super::normal_mobility::NormalMobility;
use crate::geometry::{Complex64, Layout};

use sliding::FrozenSliding;
use tension::FrozenTension;

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

/// The gradient flow dy/dt = −`𝓚(y)∇𝓕_h`, 𝓚 = `A𝓑Aᵀ` + 𝓖, on one grid, with all its scratch. See `THEORY.md`, eqs. (F6) and (F7).
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
    energy: EnergySum,
    descent: Descent,
    /// The state evaluated last, and that of the linearisation.
    current: Place,
    frozen: Place,
    /// Whether there is a linearisation.
    linearised: bool,
    /// The tension at the linearisation.
    tension: FrozenTension,
    /// How the nodes slide there.
    sliding: FrozenSliding,
}

impl GradientFlow {
    /// The flow of `energy` under the mobilities, one density mobility per density.
    ///
    /// # Panics
    /// If there are more or fewer of them, or `map` or `energy` is one of other states.
    #[must_use]
    pub fn new(
        mut map: FlowMap,
        energy: EnergySum,
        layout: Layout,
        mut normal_mobility: Box<dyn NormalMobility>,
        density_mobilities: Vec<Box<dyn DensityMobility>>,
    ) -> Self {
        assert_eq!(density_mobilities.len(), layout.densities(), "one mobility per density");
        assert_eq!(
            [map.layout(), energy.layout()],
            [layout; 2],
            "the states of map and energy are those of the flow"
        );
        let area = AreaForce::of(&mut *normal_mobility, layout, &mut map);
        let (grid, derivative) = map.grid_and_derivative();
        let fields = CurveFields::new(layout, grid, derivative);
        let mobility = normal_mobility.boxed_clone();
        let frozen = Place { fields: fields.clone(), mobility, fault: None };
        let spectra = vec![Complex64::default(); layout.state_fields() * layout.modes()];
        let descent = Descent {
            layout,
            map,
            density_mobilities,
            area,
            gradient: IntrinsicGradient { spectra, by_length: 0.0 },
            force: vec![0.0; layout.nodes()],
            velocity: vec![0.0; layout.nodes()],
            spectrum: vec![Complex64::default(); layout.modes()],
        };
        let tension = FrozenTension::new(&descent, &energy, &*normal_mobility);
        let sliding = FrozenSliding::new(&descent, &*normal_mobility);
        Self {
            energy,
            descent,
            current: Place { fields, mobility: normal_mobility, fault: None },
            frozen,
            linearised: false,
            tension,
            sliding,
        }
    }

    /// Rate of `state` into `rate`, per time, both spectral ([`crate::geometry::SpectralLayout`]).
    ///
    /// # Panics
    /// If `state` or `rate` is no spectral vector of the layout.
    pub fn spectral_rate(&mut self, state: &[f64], rate: &mut [f64]) -> Rate {
        let evaluated = self.spectral_dissipation(state);
        self.descent.write_rates(&self.current.fields, rate);
        evaluated
    }

    /// Energy and dissipation of the spectral `state`; cheaper than a rate.
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout.
    pub fn spectral_dissipation(&mut self, state: &[f64]) -> Rate {
        let energy = self.spectral_gradient(state);
        let Self { descent, current, .. } = self;
        descent.set_mobility(current);
        descent.descend(current);
        let of_the_curve = descent.curve_dissipation(&current.fields);
        Rate { energy, dissipation: descent.add_density_dissipation(&current.fields, of_the_curve) }
    }

    /// Spectral rate at the state evaluated last, by [`GradientFlow::spectral_dissipation`].
    pub fn rate_at_hand(&mut self, rate: &mut [f64]) {
        self.descent.write_rates(&self.current.fields, rate);
    }

    /// Takes the fields of the spectral `state`, without evaluating anything.
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout.
    pub fn set_current(&mut self, state: &[f64]) {
        let (grid, derivative) = self.descent.map.grid_and_derivative();
        self.current.fields.set(state, grid, derivative);
    }

    /// Takes the fields of the spectral `state`; whether the normal mobility holds the curve there ([`NormalMobility::holds_curve`]).
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout.
    pub fn holds_curve(&mut self, state: &[f64]) -> bool {
        self.set_current(state);
        self.descent.set_mobility(&mut self.current);
        self.current.fault.is_none() && self.current.mobility.holds_curve()
    }

    /// Energy of the spectral `state`; its gradient is then at [`GradientFlow::gradient`].
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout.
    pub fn spectral_gradient(&mut self, state: &[f64]) -> f64 {
        self.set_current(state);
        self.energy.gradient(&self.current.fields, &mut self.descent.gradient)
    }

    /// Energy of each term at the state evaluated last.
    pub fn current_energies_by_term(&mut self) -> Vec<f64> {
        self.energy.energies_by_term(&self.current.fields)
    }

    /// What a term finds wrong with the state evaluated last.
    #[must_use]
    pub fn fault(&self) -> Option<crate::energies::TermFault> {
        self.energy.fault(&self.current.fields)
    }

    /// Gradient of the energy at the state evaluated last.
    #[must_use]
    pub fn gradient(&self) -> &IntrinsicGradient {
        &self.descent.gradient
    }

    /// Force f on the normal motion at the state evaluated last: energy lost per normal displacement and arc length, one value per
    /// node.
    #[must_use]
    pub fn normal_force(&self) -> &[f64] {
        &self.descent.force
    }

    /// Normal velocity V = 𝓑f at the state evaluated last, outward: length per time, one value per node.
    #[must_use]
    pub fn normal_velocity(&self) -> &[f64] {
        &self.descent.velocity
    }

    /// Tangential velocity W of the gauge at the state evaluated last, into `w`: length per time, one value per node.
    pub fn tangential_velocity(&mut self, w: &mut [f64]) {
        self.descent.map.tangential_velocity(&self.current.fields, &self.descent.velocity, w);
    }

    /// Freezes the implicit operator −𝓚 Hess `𝓕_h` at the spectral `state`.
    ///
    /// # Panics
    /// If `state` is no spectral vector of the layout.
    pub fn spectral_linearise(&mut self, state: &[f64]) {
        let (grid, derivative) = self.descent.map.grid_and_derivative();
        self.frozen.fields.set(state, grid, derivative);
        self.energy.linearise(&self.frozen.fields, &mut self.descent.gradient);
        self.descent.set_mobility(&mut self.frozen);
        self.linearised = true;
        self.freeze_sliding();
        self.freeze_tension();
    }

    /// Spectral rate at the state of the linearisation; call right after [`GradientFlow::spectral_linearise`].
    pub fn frozen_rate(&mut self, rate: &mut [f64]) {
        if self.energy.depends_on_positions() {
            self.descent.descend(&mut self.frozen);
        } else {
            let Descent { map, gradient, force, .. } = &mut self.descent;
            map.complete_force(&self.frozen.fields, &gradient.spectra, &self.tension.stretching, force);
            self.drive_frozen();
        }
        self.descent.write_rates(&self.frozen.fields, rate);
    }

    /// Product of the frozen Hess `𝓕_h` with the spectral `v`, at [`GradientFlow::gradient`].
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`], or if a vector is no spectral one of the layout.
    pub fn spectral_hessian_product(&mut self, v: &[f64]) {
        assert!(self.linearised, "products are those of a linearisation, and there is none");
        self.energy.hessian_product(&self.frozen.fields, v, &mut self.descent.gradient);
    }

    /// 𝓚 applied to the spectral dual vector `dual`, at the frozen state.
    ///
    /// # Panics
    /// Before [`GradientFlow::spectral_linearise`], or if a vector is no spectral one of the layout.
    pub fn spectral_mobility(&mut self, dual: &[f64], out: &mut [f64]) {
        assert!(self.linearised, "𝓚 is that at a linearisation, and there is none");
        let layout = self.spectral_layout();
        self.descent.gradient.spectra.copy_from_slice(layout.spectra(dual));
        self.descent.gradient.by_length = dual[layout.length_index()];
        self.descent.descend(&mut self.frozen);
        self.descent.write_rates(&self.frozen.fields, out);
        for value in out.iter_mut() {
            *value = -*value;
        }
    }
}
