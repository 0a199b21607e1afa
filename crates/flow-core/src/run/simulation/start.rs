//! From a scene to a simulation at its initial state.

use std::time::Instant;

use super::ahead::ahead;
use super::clocks::Clocks;
use super::discretised::Discretised;
use super::frame::Start;
use super::remap::largest_distance;
use super::saving::FrameRoom;
use super::{ENERGY_TOLERANCE_SHARE, Simulation};
use crate::energies::EnergyTerm;
use crate::flow::MetricRole;
use crate::integrator::{
    Adaptive, AdaptiveOptions, Clocked, Counters, DISSIPATED, Finish, INTEGRALS, Integrals, Multistep,
    Problem, Stopwatch,
};
use crate::run::constant_energy::energy_scale;
use crate::run::culprit::Culprit;
use crate::run::equilibrium::Equilibrium;
use crate::run::own_terms::OwnTerms;
use crate::run::provenance::Provenance;
use crate::run::record::{Record, StepLog, StopReason};
use crate::run::scene::Scene;
use crate::run::schedule::frame_times;
use crate::run::seconds::Seconds;
use crate::run::setup::Setup;
use crate::run::setup_error::SetupError;

/// Steps that are logged without allocating; beyond, the room doubles now and then.
const STEP_ROOM: usize = 4096;

impl Simulation {
    /// Builds what the scene names; saves the initial frame. Values of the scene that were changed since it was read are checked
    /// first, as [`Scene::checked`] does.
    ///
    /// # Errors
    /// [`SetupError`] if the scene makes no initial state.
    pub fn new(scene: &Scene) -> Result<Self, SetupError> {
        Self::with(scene, OwnTerms::default())
    }

    /// The same with terms of the energy from outside, after those of the scene. `terms` makes them for a number of nodes: at the start,
    /// and again where the run takes other nodes, another gauge, or saves fields of single terms.
    ///
    /// The record and its files hold their energies by name and say that they are [`Record::own_terms`], but the scene knows nothing of
    /// them: who resumes such a run brings them again, to [`Simulation::resume_with_terms`].
    ///
    /// # Errors
    /// As [`Simulation::new`], [`SetupError::TermName`] and [`SetupError::Undeclared`].
    pub fn with_terms(
        scene: &Scene,
        terms: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static,
    ) -> Result<Self, SetupError> {
        Self::with(scene, OwnTerms::made_by(terms))
    }

    pub(super) fn with(scene: &Scene, own: OwnTerms) -> Result<Self, SetupError> {
        let clock = Instant::now();
        let scene = &scene.clone().checked()?;
        let doubts_gradients = own.exist();
        let mut setup = Setup::of(scene, own)?;
        setup.membrane.flow().set_kept_area(setup.initial.area);
        let own_terms = setup.initial.own.names(setup.mesh.nodes);
        let (energy, integral_rates) = setup.finish()?;
        if let Some(fault) = setup.membrane.flow().fault() {
            return Err(fault.into());
        }
        let Setup {
            membrane,
            state,
            placement,
            diagnostics,
            closure_defect,
            gauges,
            mesh,
            adaptation,
            misses_data,
            ..
        } = setup;
        let mut on = Discretised { membrane, diagnostics, mesh, remapped_at: 0, scratch: state };
        let start = Start { energy, angle: placement.angle, centre: placement.centre, remap_error: 0.0 };
        let first = on.frame(0.0, [0.0; INTEGRALS], &start, Some(closure_defect));
        let allowed_crossings = first.crossings as usize;
        let mut counters = Counters::default();
        let mut watch = Stopwatch::default();
        let first_rate = Instant::now();
        let integrals = Integrals::new(0.0, [0.0; INTEGRALS], integral_rates);
        let stepper = Multistep::starting(
            &mut Clocked::new(&mut on.membrane, &mut watch),
            &on.scratch,
            integrals,
            scene.accuracy.tolerance,
            &mut counters,
        );
        counters.integration_seconds = first_rate.elapsed().as_secs_f64();
        let end = scene.time.end;
        let options = AdaptiveOptions {
            end: end.min(gauges.next_time()),
            most_steps: scene.time.max_steps.unwrap_or(u64::MAX),
            energy_tolerance: ENERGY_TOLERANCE_SHARE * scene.accuracy.tolerance,
            doubts_gradients,
        };
        let frame_times = frame_times(&scene.output, end);
        let record = Record {
            title: scene.title.clone(),
            scene: scene.text().to_owned(),
            resolved_scene: scene.to_toml(),
            energy_terms: on.membrane.flow().energy_terms().names().map(str::to_owned).collect(),
            own_terms,
            densities: scene.density.iter().map(|density| density.name.clone()).collect(),
            fields: on.diagnostics.field_names(),
            diagnostics: on.diagnostics.value_names(),
            frames: vec![first],
            steps: StepLog::with_room(STEP_ROOM),
            counters,
            seconds: Seconds::default(),
            stop_reason: StopReason::EndTime,
            provenance: Provenance::here(),
        };
        let scale = energy_scale(scene, &record);
        let largest_distance = largest_distance(scene, &mut on.membrane, record.frames[0].length);
        let mut simulation = Self {
            equilibrium: scene
                .time
                .stop_at_equilibrium
                .then(|| Equilibrium::new(rest_tolerance(scene), energy, integral_rates[DISSIPATED], end)),
            integration: Adaptive::new(stepper, options, energy, counters).measured_by(scale),
            gauges,
            adaptation,
            misses_data,
            largest_distance,
            frame_room: FrameRoom::new(on.mesh.nodes),
            switches: 0,
            tolerance: scene.accuracy.tolerance,
            start,
            end,
            until: f64::INFINITY,
            frame_times,
            scheduled_frames: 1,
            closure_defect,
            allowed_crossings: scene.flow.stop_on_contact.then_some(allowed_crossings),
            on,
            record,
            clocks: Clocks::started(clock, counters.integration_seconds, watch),
            stopped: None,
            failure: None,
        };
        if simulation.gauges.next_time() <= 0.0 {
            simulation.switch(0.0, energy);
        }
        Ok(simulation)
    }
}

impl Setup {
    /// Puts the initial state onto its constraints; its energy and the rates of the integrals.
    ///
    /// # Errors
    /// [`SetupError::EnergyNotFinite`], which names the term, the [`SetupError::Term`] by which it refuses the data, or
    /// [`SetupError::StateNotFinite`].
    pub fn finish(&mut self) -> Result<(f64, [f64; INTEGRALS]), SetupError> {
        let Finish::Good { energy, integral_rates } = self.membrane.finish(0.0, &mut self.state) else {
            let nodes = self.membrane.layout().nodes();
            return Err(self.not_finite().unwrap_or(SetupError::StateNotFinite { nodes }));
        };
        // No implicit step could be solved, which would seem to be the end of the flow.
        if !self.membrane.flow().has_finite_second_derivatives()
            && !self.leaves_at_once()
            && let Some(error) = self.not_finite()
        {
            return Err(error);
        }
        Ok((energy, integral_rates))
    }

    /// Whether the second derivatives are finite a little later, and the first step, which is solved there, gets on: the state may have
    /// a density of 0 at a node, as long as it does not stay there.
    #[cold]
    fn leaves_at_once(&mut self) -> bool {
        let ahead = ahead(&mut self.membrane, &self.state);
        let flow = self.membrane.flow();
        flow.set_current(&ahead);
        let leaves = flow.has_finite_second_derivatives();
        flow.set_current(&self.state);
        leaves
    }

    /// Names the term that is not finite on the initial data, or says what it refuses them for.
    #[cold]
    fn not_finite(&mut self) -> Option<SetupError> {
        let flow = self.membrane.flow();
        flow.set_current(&self.state);
        let found = flow.not_finite();
        if let Some(fault) = flow.fault() {
            return Some(fault.into()); // the term itself knows best
        }
        let culprit = Culprit { found: found?, densities: self.densities.clone() };
        Some(SetupError::EnergyNotFinite { culprit: culprit.into() })
    }
}

/// Part of the tolerance that [`rest_tolerance`] is, and where nodes slide along the curve.
const REST_SHARE: f64 = 0.01;
const REST_SHARE_SLIDING: f64 = 0.1;

/// Part of the energy that a flow at rest may still lose.
///
/// Co-moving nodes go on to creep along the curve at the rate of the discretisation's error, and a solution slides off the nodes
/// that crowd for it at that rate: their rest is asked for less exactly.
fn rest_tolerance(scene: &Scene) -> f64 {
    let flow = &scene.flow;
    let switched = flow.switch.iter().map(|switch| (switch.gauge, &switch.grading));
    let mut gauges = switched.chain([(flow.gauge, &flow.grading)]);
    let slides = gauges.any(|(gauge, grading)| match gauge.metric() {
        MetricRole::Field => true,
        MetricRole::Graded => grading.is_none(),
        MetricRole::Uniform => false,
    });
    let share = if slides { REST_SHARE_SLIDING } else { REST_SHARE };
    scene.time.equilibrium_tolerance.unwrap_or(share * scene.accuracy.tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rest_is_asked_for_less_exactly_where_nodes_slide_and_after_any_switch_to_such() {
        let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
        let share = |flow: &str| {
            let changes = [("flow".into(), flow.into()), ("accuracy.tolerance".into(), "1e-4".into())];
            (1e4 * rest_tolerance(&Scene::parse_with(text, "circle", &changes).unwrap()) * 1e3).round() / 1e3
        };
        assert_eq!(share("{ gauge = 'scaled-arc-length' }"), 0.01);
        assert_eq!(share("{ gauge = 'graded', grading = '1 + 0.1*cos(2*pi*s)' }"), 0.01);
        assert_eq!(share("{ gauge = 'graded' }"), 0.1);
        assert_eq!(share("{ gauge = 'co-moving' }"), 0.1);
        for gauge in ["graded", "co-moving"] {
            assert_eq!(
                share(&format!("{{ switch = [{{ time = 0.1, gauge = '{gauge}' }}] }}")),
                0.1,
                "{gauge}"
            );
        }
    }
}
