//! Goes on with other nodes: more or fewer, or crowded elsewhere.

use std::time::Instant;

use super::Simulation;
use super::discretised::Discretised;
use crate::energies::TermFault;
use crate::integrator::{Factorisation, Finish, Multistep, Problem, Stepper};
use crate::run::adaptation::{Look, Plan, Way, sparsest_in};
use crate::run::failure::Failure;
use crate::run::membrane::Membrane;
use crate::run::mesh::Mesh;
use crate::run::resolution::unresolved;
use crate::run::scene::{Nodes, Scene};
use crate::run::setup_error::SetupError;
use crate::run::{assembly, limits};

/// Steps between looks at nodes that are fixed.
const FIXED_LOOKS: u64 = 8;
/// Part of a field, and of the tolerance if that is more, that they may leave unresolved without a word.
const COARSE: f64 = 1e-3;
const COARSE_PART: f64 = 0.1;

/// What they may leave unresolved of a field without a word, at this tolerance.
fn coarse(tolerance: f64) -> f64 {
    COARSE.max(COARSE_PART * tolerance)
}

/// Distance of nodes up to which they resolve the energies of positions by that, on a circle of this `length`; infinite unless `scene`
/// fixes their number.
pub(super) fn largest_distance(scene: &Scene, membrane: &mut Membrane, length: f64) -> f64 {
    match scene.accuracy.nodes {
        Nodes::Auto => f64::INFINITY,
        Nodes::Count(_) => {
            membrane.flow().energy_terms().largest_spacing(length, coarse(scene.accuracy.tolerance))
        }
    }
}

impl Simulation {
    /// Takes other nodes if the state at hand asks for them or allows it.
    pub(super) fn adapt(&mut self, time: f64, energy: f64) {
        let Some(adaptation) = &self.adaptation else { return self.count_unresolved() };
        let age = self.counters().steps - self.on.remapped_at;
        let state = self.integration.stepper().state();
        let Some(glance) = adaptation.glance(&mut self.on.membrane, state, age) else { return };
        let clock = Instant::now();
        let Discretised { membrane, mesh, scratch, .. } = &mut self.on;
        let (served, failure) = match adaptation.look(membrane, (time, state), mesh, glance, scratch) {
            Look::Serve => (true, None),
            Look::Change(plan) => {
                let (fewer, more) =
                    (plan.mesh.nodes < self.on.mesh.nodes, plan.mesh.nodes > self.on.mesh.nodes);
                match self.remap(plan, time, energy) {
                    Err(Some(failure)) if more => (false, Some(failure)),
                    taken => (taken.is_ok() || fewer, None),
                }
            }
            Look::Unresolved => (false, None),
            Look::Hopeless(error) => (false, Some(error.into())),
        };
        self.record.counters.unresolved_steps += u64::from(!served);
        let seconds = clock.elapsed().as_secs_f64();
        self.record.counters.integration_seconds += seconds;
        self.clocks.remaps += seconds;
        if let Some(error) = failure {
            self.fail(error);
        }
    }

    /// On nodes that the scene fixes: counts steps that they are far from resolving.
    fn count_unresolved(&mut self) {
        if !self.counters().steps.is_multiple_of(FIXED_LOOKS) {
            return;
        }
        let Discretised { membrane, scratch, .. } = &mut self.on;
        let (layout, state) = (membrane.layout(), self.integration.stepper().state());
        let family = membrane.flow().derivative().family();
        let misses_fields = unresolved(layout, state, layout.nodes(), family) > coarse(self.tolerance);
        let length = state[membrane.flow().spectral_layout().length_index()];
        let mut distance = || sparsest_in(membrane, state, scratch) * length / layout.nodes() as f64;
        let misses_positions = self.largest_distance.is_finite() && distance() > self.largest_distance;
        if misses_fields || misses_positions {
            self.record.counters.unresolved_steps += FIXED_LOOKS;
        }
    }

    /// Carries the past states over to the nodes of `plan` and goes on with the same order and step size.
    ///
    /// # Errors
    /// If a state cannot be had there, or fewer nodes change the energy by more than the tolerance; with the failure if they leave no
    /// room.
    fn remap(&mut self, mut plan: Plan, time: f64, energy: f64) -> Result<(), Option<Failure>> {
        self.check_plan(&plan).map_err(|error| Some(Failure::Limit { time, error }))?;
        let turning_number = self.on.membrane.turning_number();
        let built = match &plan.way {
            Way::Regraded(grading, _) => {
                self.gauges.build_on(plan.mesh.nodes, grading.clone(), turning_number)
            }
            Way::SameParameters => self.gauges.build(&plan.mesh, turning_number),
        };
        let (mut membrane, diagnostics) = built.map_err(|_| None)?;
        let mut memory = self.integration.stepper().memory();
        match &mut plan.way {
            Way::SameParameters => {
                let (old, new) =
                    (self.on.membrane.flow().spectral_layout(), membrane.flow().spectral_layout());
                for (_, state) in &mut memory.points {
                    *state = old.resampled(state, &new);
                }
                let own = memory.exponential.as_mut();
                let renewed = own.is_none_or(|own| {
                    own.rates.iter_mut().for_each(|rate| *rate = old.resampled(rate, &new));
                    own.renew(&mut membrane, &memory.points[0].1)
                });
                if !renewed {
                    memory = memory.implicit();
                }
            }
            Way::Regraded(_, way) => {
                memory = memory.implicit();
                let flow = self.on.membrane.flow();
                for (_, state) in &mut memory.points {
                    *state = way.apply(flow, state).map_err(|_| None)?;
                }
            }
        }
        membrane.follow(&self.on.membrane);
        let Finish::Good { energy: new_energy, .. } = membrane.finish(time, &mut memory.points[0].1) else {
            let too_many =
                membrane.flow().fault().filter(|fault| matches!(fault, TermFault::TooManyPairs { .. }));
            return Err(too_many.map(|fault| Failure::Term { time, fault }));
        };
        let error = new_energy - energy;
        if !resolves_more(&plan, &self.on.mesh)
            && error.abs() > self.tolerance * self.integration.energy_scale().with_loss(energy)
        {
            return Err(None);
        }
        memory.factorisation = Factorisation::default();
        let stepper = Multistep::resume(&membrane, memory, self.tolerance);
        let mut counters = *self.integration.counters();
        counters.remaps += 1;
        self.start.remap_error += error;
        self.on = Discretised::new((membrane, diagnostics), plan.mesh, counters.steps);
        self.go_on_by(stepper, new_energy, counters);
        Ok(())
    }

    /// Checks that there is room for the run on the nodes of `plan`.
    fn check_plan(&self, plan: &Plan) -> Result<(), SetupError> {
        let layout = assembly::layout(self.gauges.scene(), plan.mesh.nodes);
        limits::check_solver(self.gauges.scene(), layout)?;
        self.check_room(1, layout)
    }
}

/// Whether the plan is to take more nodes: what they change was an error of those at hand.
fn resolves_more(plan: &Plan, mesh: &Mesh) -> bool {
    matches!(plan.way, Way::SameParameters) && plan.mesh.nodes > mesh.nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::energies::{EnergyTerm, Fields, LengthJet};
    use crate::run::{Quiet, Scene};

    /// A term that has no room for more than so many nodes.
    #[derive(Debug)]
    struct Crowded {
        nodes: usize,
        most: usize,
    }

    impl EnergyTerm for Crowded {
        fn name(&self) -> &'static str {
            "crowded"
        }

        fn of_length(&self, _: f64) -> LengthJet {
            let value = if self.nodes > self.most { f64::NAN } else { 0.0 };
            LengthJet { value, ..LengthJet::default() }
        }

        fn fault(&self, _: Fields<'_>) -> Option<TermFault> {
            let Self { nodes, most } = *self;
            (nodes > most).then_some(TermFault::TooManyPairs {
                nodes,
                pairs: nodes * nodes,
                most: most * most,
            })
        }
    }

    fn scene(changes: &[(&str, &str)]) -> Scene {
        let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold_sharp").unwrap();
        let changes: Vec<_> = changes.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
        Scene::parse_with(text, "three_fold_sharp", &changes).unwrap()
    }

    #[test]
    fn a_run_that_needs_more_nodes_than_a_term_has_room_for_says_so() {
        let terms = |nodes| vec![Box::new(Crowded { nodes, most: 600 }) as Box<dyn EnergyTerm>];
        let mut simulation = Simulation::with_terms(&scene(&[]), terms).unwrap();
        while simulation.step(&mut Quiet) {}
        let Some(Failure::Term { fault: TermFault::TooManyPairs { nodes, most, .. }, time }) =
            simulation.failure()
        else {
            panic!("{:?}", simulation.failure())
        };
        assert!(*nodes > 600 && *most == 600 * 600 && *time > 0.0);
        assert!(simulation.layout().nodes() <= 600 && simulation.frames().len() > 1);
    }

    #[test]
    fn a_dense_matrix_does_not_grow_beyond_its_bound_with_the_nodes() {
        let simulation = Simulation::new(&scene(&[("accuracy.linear_solver", "'dense'")])).unwrap();
        let plan = |nodes| Plan { mesh: Mesh { nodes, samples: None }, way: Way::SameParameters };
        assert!(simulation.check_plan(&plan(1024)).is_ok());
        let error = simulation.check_plan(&plan(4096)).unwrap_err();
        assert!(matches!(error, SetupError::TooLargeForDense { .. }), "{error}");
    }
}
