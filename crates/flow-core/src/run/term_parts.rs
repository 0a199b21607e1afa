//! What each term of the energy does along the curve: its density, and its part of the normal velocity.

use super::energy_density::EnergyDensity;
use super::energy_terms::{Initial, energy_terms};
use super::mobilities::normal_mobility;
use super::scene::{OutputField, Scene};
use super::setup_error::SetupError;
use crate::energies::EnergyTerm;
use crate::flow::{Carried, CurveFields, EnergySum, FlowMap, GradientFlow};
use crate::geometry::{Layout, PeriodicGrid};
use crate::operators::Derivative;

/// The terms of a scene, one by one.
#[derive(Debug, Default)]
pub(super) struct TermParts {
    densities: Vec<(&'static str, EnergyDensity)>,
    flows: Vec<(&'static str, GradientFlow)>,
}

impl TermParts {
    /// The parts that `scene` asks for, on states of `layout`.
    ///
    /// # Errors
    /// [`SetupError`] as for the terms.
    pub fn new(
        scene: &Scene,
        initial: &Initial,
        layout: Layout,
        derivative: &Derivative,
    ) -> Result<Self, SetupError> {
        let mut parts = Self::default();
        let asked = |field| scene.output.fields.contains(&field);
        if asked(OutputField::EnergyDensities) {
            for term in energy_terms(scene, initial, layout.nodes())? {
                let local = (0..layout.fields()).any(|field| term.stiffness(field) != 0.0)
                    || term.has_density()
                    || term.has_slope_density();
                if local {
                    parts.densities.push((term.name(), EnergyDensity::new(vec![term], layout)));
                }
            }
        }
        if asked(OutputField::NormalVelocities) {
            for term in energy_terms(scene, initial, layout.nodes())? {
                parts.flows.push((term.name(), flow_of(scene, term, layout, derivative, initial)));
            }
        }
        Ok(parts)
    }

    /// Names of the parts that stand for `field`.
    pub fn names(&self, field: OutputField) -> Vec<String> {
        match field {
            OutputField::EnergyDensities => {
                self.densities.iter().map(|(term, _)| format!("energy_density_{term}")).collect()
            }
            OutputField::NormalVelocities => {
                self.flows.iter().map(|(term, _)| format!("normal_velocity_{term}")).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Energy per length of each local term at the fields `at`.
    pub fn densities(&mut self, at: &CurveFields) -> Vec<Vec<f64>> {
        self.densities.iter_mut().map(|(_, density)| density.at(at)).collect()
    }

    /// 𝓑f of each term at the nodal state `y`; they add up to the normal velocity.
    pub fn velocities(&mut self, y: &[f64]) -> Vec<Vec<f64>> {
        let velocity = |(_, flow): &mut (&'static str, GradientFlow)| {
            flow.dissipation_at(y);
            flow.normal_velocity().to_vec()
        };
        self.flows.iter_mut().map(velocity).collect()
    }
}

/// The flow of one term, as it is in a run.
fn flow_of(
    scene: &Scene,
    term: Box<dyn EnergyTerm>,
    layout: Layout,
    derivative: &Derivative,
    initial: &Initial,
) -> GradientFlow {
    let grid = PeriodicGrid::new(layout.nodes());
    let energy = EnergySum::new(vec![term], layout, &grid, derivative);
    let map = FlowMap::in_gauge(scene.flow.gauge.rule(), layout, &grid, derivative);
    let normal = normal_mobility(scene, initial.is_round, &grid, derivative);
    let densities = (0..layout.densities()).map(|_| Box::new(Carried) as _).collect();
    let mut flow = GradientFlow::new(map, energy, layout, normal, densities);
    flow.set_kept_area(initial.area);
    flow
}
