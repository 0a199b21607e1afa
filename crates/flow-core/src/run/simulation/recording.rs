//! What there is of a run so far, as a record.

use std::time::Instant;

use super::Simulation;
use super::ahead::ahead;
use crate::integrator::{Counters, IntegrationError, Stepper};
use crate::run::culprit::Culprit;
use crate::run::failure::Failure;
use crate::run::record::{Frame, Record, StepLog, StopReason};
use crate::run::seconds::Seconds;

/// Part of the time of the integration that the replay may take which tells the parts of the evaluations.
const REPLAY_SHARE: f64 = 0.003;
/// Ratio of the distances of co-moving nodes from which on they may be why a run ends.
const UNEVEN: f64 = 20.0;

impl Simulation {
    /// The state at hand as a frame; it is not saved.
    pub fn frame(&mut self) -> Frame {
        self.on.scratch.copy_from_slice(self.integration.stepper().state());
        let (time, integrals) = (self.integration.stepper().time(), self.integration.integrals());
        self.on.frame(time, integrals, &self.start, Some(self.closure_defect))
    }

    /// Names of the densities, in the order of [`Frame::density`].
    #[must_use]
    pub fn densities(&self) -> &[String] {
        &self.record.densities
    }

    /// What there is so far, as if the run were interrupted here, without interrupting it.
    pub fn record(&mut self) -> Record {
        let mut frames = self.record.frames.clone();
        if self.record.frames.last().is_some_and(|last| last.time < self.time()) {
            frames.push(self.frame());
        }
        let seconds = self.seconds();
        Record { seconds, ..self.record_of(frames, self.record.steps.clone()) }
    }

    /// A record of `frames` and `steps` alone, which does not say where the time went.
    #[must_use]
    pub fn record_of(&self, frames: Vec<Frame>, steps: StepLog) -> Record {
        Record {
            frames,
            steps,
            counters: self.counters_with_time(),
            seconds: Seconds::default(),
            stop_reason: self.stopped.clone().unwrap_or(StopReason::Interrupted),
            provenance: self.record.provenance.clone(),
            title: self.record.title.clone(),
            scene: self.record.scene.clone(),
            resolved_scene: self.record.resolved_scene.clone(),
            energy_terms: self.record.energy_terms.clone(),
            own_terms: self.record.own_terms.clone(),
            densities: self.record.densities.clone(),
            fields: self.record.fields.clone(),
            diagnostics: self.record.diagnostics.clone(),
        }
        .on_common_nodes()
    }

    /// Counters with the time spent.
    pub(super) fn counters_with_time(&self) -> Counters {
        let Counters { integration_seconds, unresolved_steps, .. } = self.record.counters;
        let counters = *self.integration.counters();
        let unresolved_steps = if self.misses_data { counters.steps } else { unresolved_steps };
        Counters { unresolved_steps, integration_seconds, ..counters }
    }

    pub(super) fn stop(&mut self, reason: StopReason) {
        let time = self.integration.stepper().time();
        if self.record.frames.last().is_some_and(|last| last.time < time) {
            let clock = Instant::now();
            let last = self.frame();
            self.record.frames.push(last);
            self.clocks.frames += clock.elapsed().as_secs_f64();
        }
        self.record.counters = self.counters_with_time();
        self.record.stop_reason = reason.clone();
        self.stopped = Some(reason);
    }

    /// Ends the run with `error`, and names the term that stands in the way of the next step, if one does.
    #[cold]
    pub(super) fn fail_step(&mut self, error: IntegrationError) {
        if !matches!(error, IntegrationError::StepUnderflow { .. }) {
            return self.fail(error);
        }
        let candidate = self.integration.candidate().to_vec();
        let later = ahead(&mut self.on.membrane, self.integration.stepper().state());
        let flow = self.on.membrane.flow();
        let found = [candidate, later].into_iter().find_map(|state| {
            flow.set_current(&state);
            // What is no curve says nothing of the terms.
            if flow.current().length() > 0.0 { flow.not_finite() } else { None }
        });
        let Some(found) = found else { return self.fail_uneven(error) };
        let culprit = Culprit { found, densities: self.record.densities.clone() };
        self.fail(Failure::NotFinite { error, culprit: culprit.into() });
    }

    /// Ends the run with `error`, and says so if its nodes lie very unevenly.
    fn fail_uneven(&mut self, error: IntegrationError) {
        let flow = self.on.membrane.flow();
        flow.set_current(self.integration.stepper().state());
        let ratio = flow.current().moving_metric().map_or(1.0, |metric| {
            let of = |pick: fn(f64, f64) -> f64| metric.weight().iter().copied().reduce(pick).unwrap_or(1.0);
            of(f64::max) / of(f64::min)
        });
        if ratio > UNEVEN { self.fail(Failure::UnevenNodes { error, ratio }) } else { self.fail(error) }
    }

    pub(super) fn fail(&mut self, failure: impl Into<Failure>) {
        let failure = failure.into();
        self.stop(StopReason::Failed(failure.to_string()));
        self.failure = Some(failure);
    }

    /// Where the time went up to here.
    fn seconds(&mut self) -> Seconds {
        let limit = REPLAY_SHARE * self.clocks.integration;
        let costs = self.on.membrane.flow().part_costs(self.integration.stepper().state(), limit);
        self.clocks.seconds(&costs)
    }

    /// Ends the run where it stands, if it has not ended, and returns its record.
    #[must_use]
    pub fn into_record(mut self) -> Record {
        if self.stopped.is_none() {
            self.stop(StopReason::Interrupted);
        }
        self.record.seconds = self.seconds();
        self.record.on_common_nodes()
    }
}
