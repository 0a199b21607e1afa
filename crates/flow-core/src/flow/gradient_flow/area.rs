//! An enclosed area that is kept: its force on the grid, for mobilities that hold that very area, and what it costs. See `THEORY.md`,
//! eqs. (F10) and (F21).

use super::{GradientFlow, Place};
use crate::energies::Area;
use crate::flow::energy_sum::EnergySum;
use crate::flow::flow_map::FlowMap;
use crate::flow::intrinsic_gradient::IntrinsicGradient;
use crate::flow::normal_mobility::NormalMobility;
use crate::geometry::{Complex64, Layout};

/// The area as an energy, with its gradient.
#[derive(Debug)]
pub struct AreaForce {
    area: EnergySum,
    gradient: IntrinsicGradient,
}

impl AreaForce {
    /// Of states of `layout` on the nodes of `map`; none where `mobility` does not ask for it.
    pub fn of(mobility: &mut dyn NormalMobility, layout: Layout, map: &mut FlowMap) -> Option<Self> {
        mobility.area_force()?;
        let (grid, derivative) = map.grid_and_derivative();
        let area = EnergySum::new(vec![Box::new(Area::Pressure(1.0))], layout, grid, derivative);
        let spectra = vec![Complex64::default(); layout.state_fields() * layout.modes()];
        Some(Self { area, gradient: IntrinsicGradient { spectra, by_length: 0.0 } })
    }

    /// Tells it the mobility at `place`.
    pub fn tell(&mut self, map: &mut FlowMap, place: &mut Place) {
        let Some(force) = place.mobility.area_force() else { return };
        self.area.gradient(&place.fields, &mut self.gradient);
        map.force(&place.fields, &self.gradient.spectra, self.gradient.by_length, force);
    }
}

impl GradientFlow {
    /// Force of the area at the state evaluated last, near 1 at each node, where it is the area of the grid that the flow keeps: the mean of
    /// its product with the normal velocity is zero. None where the mean of the velocity itself is, or no area is kept.
    pub fn area_force(&mut self) -> Option<&[f64]> {
        self.current.mobility.area_force().map(|force| &*force)
    }

    /// Where the flow keeps the area, takes what it costs for what it does at `area` from now on, a constant without a force (F21). Left in,
    /// the force moves nothing, but its rounding, and what steps of finite length change of the area, are as dear as the area is.
    pub fn set_kept_area(&mut self, area: f64) {
        if self.current.mobility.keeps().area {
            self.energy.set_kept_area(Some(area));
        }
    }

    /// Force on the normal motion at the nodal `state`, with that of an area that is kept; evaluates the state.
    ///
    /// # Panics
    /// If `state` is no nodal vector of the layout.
    pub fn whole_normal_force(&mut self, state: &[f64]) -> Vec<f64> {
        let Some(area) = self.energy.kept_area() else { return self.normal_force().to_vec() };
        self.energy.set_kept_area(None);
        self.dissipation_at(state);
        let force = self.normal_force().to_vec();
        self.energy.set_kept_area(Some(area));
        self.dissipation_at(state);
        force
    }
}
