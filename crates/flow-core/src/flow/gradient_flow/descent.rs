//! From a gradient to forces, velocities and rates: the operator −𝓚. See `THEORY.md`, eq. (F6).

use super::area::AreaForce;
use crate::flow::curve_fields::CurveFields;
use crate::flow::density_mobility::DensityMobility;
use crate::flow::flow_map::FlowMap;
use crate::flow::graded_energy::add_spectrum;
use crate::flow::intrinsic_gradient::IntrinsicGradient;
use crate::flow::normal_mobility::{MobilityError, NormalMobility};
use crate::geometry::{Complex64, Layout, SpectralLayout};

/// Part of the square of the force without what holds the area that a constant tension makes up next to a rest.
const AT_REST: f64 = 0.5;

/// The fields of one state, and the normal mobility there.
#[derive(Debug)]
pub struct Place {
    pub fields: CurveFields,
    pub mobility: Box<dyn NormalMobility>,
    /// Why the mobility is not defined there.
    pub fault: Option<MobilityError>,
}

impl Place {
    /// Prepares the mobility at the fields, once it knows the area there.
    fn set_mobility(&mut self) {
        self.fault = self.mobility.set(&self.fields).err();
    }

    /// V = 𝓑f, NaN where the mobility is not defined.
    pub fn drive(&mut self, force: &[f64], velocity: &mut [f64]) {
        if self.fault.is_some() {
            velocity.fill(f64::NAN);
        } else {
            self.mobility.apply(&self.fields, force, velocity);
        }
    }

    /// φ of f = c + φκ, the nearest to the `force`: at a rest c holds the area and φ, the same all along, every piece of the curve. Far
    /// from one, where most of f − c is no such multiple, what holds the area beside the mean tension `mean`.
    pub fn holding_mean_tension(&mut self, force: &[f64], mean: f64) -> f64 {
        let Self { fields, mobility, .. } = self;
        let (kappa, pressure) = (fields.at_nodes(0), mobility.area_multiplier(fields, force));
        let square = fields.mean_of_product(kappa, kappa);
        let of_pressure = pressure * fields.mean(kappa);
        let along = fields.mean_of_product(kappa, force) - of_pressure;
        let rest = fields.mean_of_product(force, force) - pressure * (2.0 * fields.mean(force) - pressure);
        if along * along > AT_REST * square * rest { along / square } else { mean - of_pressure / square }
    }

    /// What holds every piece of the curve, NaN where the mobility is not defined.
    pub fn holding_tension(&mut self, force: &[f64], tension: &mut [f64]) {
        if self.fault.is_some() {
            tension.fill(f64::NAN);
        } else {
            self.mobility.holding_tension(&self.fields, force, tension);
        }
    }
}

/// A gradient, and what the flow makes of it at a [`Place`]; with all that this takes.
#[derive(Debug)]
pub struct Descent {
    pub layout: Layout,
    pub map: FlowMap,
    pub density_mobilities: Vec<Box<dyn DensityMobility>>,
    /// What the normal mobility must know of the area; none where it does without.
    pub area: Option<AreaForce>,
    pub gradient: IntrinsicGradient,
    pub force: Vec<f64>,
    pub velocity: Vec<f64>,
    pub spectrum: Vec<Complex64>,
}

impl Descent {
    /// Fields of the densities that are only carried along.
    pub fn carried_fields(&self) -> impl Iterator<Item = usize> {
        let densities = self.density_mobilities.iter().enumerate();
        densities.filter(|(_, mobility)| mobility.is_zero()).map(|(density, _)| density + 1)
    }

    /// Whether a density is only carried along, over nodes that are not material.
    pub fn carries_over_nodes(&self) -> bool {
        self.layout.metric().is_none() && self.carried_fields().next().is_some()
    }

    /// Prepares the mobility at the fields of `place`.
    pub fn set_mobility(&mut self, place: &mut Place) {
        if let Some(area) = &mut self.area {
            area.tell(&mut self.map, place);
        }
        place.set_mobility();
    }

    /// Force of the gradient at hand.
    pub fn set_force(&mut self, at: &CurveFields) {
        self.map.force(at, &self.gradient.spectra, self.gradient.by_length, &mut self.force);
    }

    /// Force and normal velocity of the gradient at hand.
    pub fn descend(&mut self, place: &mut Place) {
        self.set_force(&place.fields);
        place.drive(&self.force, &mut self.velocity);
    }

    /// ⟨f, 𝓑f⟩ of the force and the velocity at hand.
    pub fn curve_dissipation(&self, at: &CurveFields) -> f64 {
        at.length() * at.mean_of_product(&self.force, &self.velocity)
    }

    /// `sum` + ⟨∂_ρ𝓕, 𝓖∂_ρ𝓕⟩ of the gradient at hand.
    pub fn add_density_dissipation(&mut self, at: &CurveFields, mut sum: f64) -> f64 {
        for (density, mobility) in self.density_mobilities.iter_mut().enumerate() {
            let mu = &self.gradient.spectra[self.layout.spectrum(density + 1)];
            mobility.apply(at, mu, &mut self.spectrum);
            sum += at.length() * self.map.mean_product(mu, &self.spectrum);
        }
        sum
    }

    /// Rates of the velocity and of the gradient at hand.
    pub fn write_rates(&mut self, at: &CurveFields, out: &mut [f64]) {
        let layout = SpectralLayout::new(self.layout);
        let rates = layout.spectra_mut(out);
        let length_rate = self.map.rates_at_hand(at, &self.velocity, rates);
        for (density, mobility) in self.density_mobilities.iter_mut().enumerate() {
            let range = layout.spectrum(density + 1);
            mobility.apply(at, &self.gradient.spectra[range.clone()], &mut self.spectrum);
            add_spectrum(&mut rates[range], -at.length(), &self.spectrum);
        }
        self.map.grid_mut().make_real(rates);
        out[layout.length_index()] = length_rate;
    }
}
