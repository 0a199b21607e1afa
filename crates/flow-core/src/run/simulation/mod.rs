//! Runs a scene: steps, frames, stop.

mod ahead;
mod clocks;
mod contact;
mod discretised;
mod frame;
mod recording;
mod remap;
mod resume;
mod saving;
mod start;
mod switch;
mod until;

use std::ops::ControlFlow;
use std::time::Instant;

use clocks::Clocks;
use discretised::Discretised;
use frame::Start;
pub use resume::{Memory, ResumeError};
use saving::FrameRoom;

use crate::energies::TermFault;
use crate::flow::Kept;
use crate::geometry::Layout;
use crate::integrator::{Adaptive, Clocked, Counters, IntegrationError, Multistep, StepReport, Stepper};
use crate::run::adaptation::Adaptation;
use crate::run::equilibrium::Equilibrium;
use crate::run::failure::Failure;
use crate::run::gauges::Gauges;
use crate::run::observer::{Observer, Progress};
use crate::run::record::{Frame, Record, StopReason};
use crate::run::scene::Scene;
use crate::run::setup_error::SetupError;

/// Part of the tolerance by which the energy balance of one step may be off.
pub const ENERGY_TOLERANCE_SHARE: f64 = 0.01;

/// A scene under way.
///
/// ```
/// use flow_core::run::{Quiet, Scene, Simulation};
///
/// let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
/// let mut simulation = Simulation::new(&Scene::parse(text, "circle")?)?;
///
/// // One step at a time, up to a time, or to the end.
/// simulation.step(&mut Quiet);
/// simulation.run_until(0.5, u64::MAX, &mut Quiet);
/// assert_eq!(simulation.time(), 0.5);
/// let halfway = simulation.frame();
/// while simulation.step(&mut Quiet) {}
///
/// let record = simulation.into_record();
/// let last = record.frames.last().unwrap();
/// assert!(last.energy < halfway.energy);
/// assert!(last.energy_balance.abs() < 1e-6 * last.energy);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    on: Discretised,
    integration: Adaptive<Multistep>,
    gauges: Gauges,
    /// Chooses the nodes, if the scene leaves that to the program.
    adaptation: Option<Adaptation>,
    /// Whether nodes that the scene fixes have missed some of its data: then the run is one of other data.
    misses_data: bool,
    /// Distance of such nodes up to which they resolve the energies of positions, on a circle as long as the curve is at the start.
    largest_distance: f64,
    /// Changes of the gauge so far.
    switches: u64,
    tolerance: f64,
    start: Start,
    end: f64,
    /// Where a step shall end before the end; infinite if nowhere.
    until: f64,
    equilibrium: Option<Equilibrium>,
    frame_times: Vec<f64>,
    /// Frames saved so far, the initial one and those at [`Self::frame_times`].
    scheduled_frames: usize,
    frame_room: FrameRoom,
    /// Gap of the last accepted state before its projection.
    closure_defect: f64,
    record: Record,
    clocks: Clocks,
    /// Self-crossings at the start, if more of them end the run.
    allowed_crossings: Option<usize>,
    stopped: Option<StopReason>,
    failure: Option<Failure>,
}

/// Runs `scene` to its end and returns its record.
///
/// A run that fails on the way returns its record up to the last good state, with
/// [`StopReason::Failed`].
/// # Errors
/// [`SetupError`] if the scene makes no initial state.
pub fn run(scene: &Scene, observer: &mut dyn Observer) -> Result<Record, SetupError> {
    let mut simulation = Simulation::new(scene)?;
    simulation.run_until(f64::INFINITY, u64::MAX, observer);
    Ok(simulation.into_record())
}

impl Simulation {
    /// Takes one accepted step, saves the frames that fall into it and tells `observer`.
    /// Returns whether there is more to do.
    pub fn step(&mut self, observer: &mut dyn Observer) -> bool {
        if self.stopped.is_none() {
            self.step_since(Instant::now(), observer);
        }
        self.stopped.is_none()
    }

    /// The step of a run that has not stopped, which began at `clock`; returns its end, where the next one may begin: a look at the
    /// clock takes a hundredth of a step of few nodes.
    fn step_since(&mut self, clock: Instant, observer: &mut dyn Observer) -> Instant {
        let aside = self.clocks.aside();
        let watch = &mut self.clocks.watch;
        watch.start_step();
        let report = self.integration.step(&mut Clocked::new(&mut self.on.membrane, watch));
        watch.end_step();
        let fault = self.on.membrane.flow().fault();
        self.after_step(report, fault, observer);
        let end = Instant::now();
        let seconds = (end - clock).as_secs_f64() - (self.clocks.aside() - aside);
        self.record.counters.integration_seconds += seconds;
        self.clocks.integration += seconds;
        end
    }

    /// Saves the frames of an accepted step, logs it, tells `observer`, and stops the run if it is over.
    fn after_step(
        &mut self,
        report: Result<StepReport, IntegrationError>,
        fault: Option<TermFault>,
        observer: &mut dyn Observer,
    ) {
        match (report, fault) {
            // The steps shrank before a state that has no energy.
            (Err(_), Some(fault @ TermFault::TooManyPairs { .. })) => {
                self.fail(Failure::Term { time: self.time(), fault });
            }
            (Err(error), _) => self.fail_step(error),
            (Ok(report), fault) => {
                self.closure_defect = self.on.membrane.closure_defect();
                let contact = if fault.is_none() { self.contact(&report) } else { None };
                let room = self.save_frames(contact.unwrap_or(report.time));
                let report = contact.map_or(report, |time| self.end_step_at(time, &report));
                self.log(&report);
                let asked_to_stop = self.tell(&report, observer).is_break();
                if let Err(error) = room {
                    self.fail(Failure::Limit { time: report.time, error });
                } else if let Some(fault) = fault {
                    self.fail(Failure::Term { time: report.time, fault });
                } else if contact.is_some() {
                    self.stop(StopReason::Contact);
                } else if self.at_rest(&report) {
                    self.stop(StopReason::Equilibrium);
                } else if report.time >= self.end {
                    self.stop(StopReason::EndTime);
                } else {
                    if report.time >= self.gauges.next_time() {
                        self.switch(report.time, report.energy);
                    } else {
                        self.adapt(report.time, report.energy);
                    }
                    // Last, so that a resumed run has nothing left to do for this step.
                    if asked_to_stop && self.stopped.is_none() {
                        self.stop(StopReason::Interrupted);
                    }
                }
            }
        }
    }

    fn at_rest(&mut self, report: &StepReport) -> bool {
        let energy_scale = self.integration.energy_scale().of(report.energy);
        self.equilibrium.as_mut().is_some_and(|watch| watch.reached(report, energy_scale))
    }

    fn tell(&mut self, report: &StepReport, observer: &mut dyn Observer) -> ControlFlow<()> {
        let progress = Progress {
            time: report.time,
            end: self.end,
            steps: self.integration.counters().steps,
            step_size: report.size,
            energy: report.energy,
            dissipation: report.dissipation,
            length: self.length(),
        };
        if !observer.takes_time() {
            return observer.after_step(&progress);
        }
        let clock = Instant::now();
        let asked = observer.after_step(&progress);
        self.clocks.observers += clock.elapsed().as_secs_f64();
        asked
    }

    fn log(&mut self, report: &StepReport) {
        let steps = &mut self.record.steps;
        steps.time.push(report.time);
        steps.size.push(report.size);
        steps.energy.push(report.energy);
        steps.dissipation.push(report.dissipation);
        steps.order.push(report.order as u8);
        steps.nodes.push(self.on.membrane.layout().nodes() as u32);
        steps.rejections.push(report.rejections);
    }

    /// Shape of the nodal state.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.on.membrane.layout()
    }

    /// The last accepted state at the nodes (see [`Layout`]).
    pub fn state(&mut self) -> Vec<f64> {
        let mut nodal = vec![0.0; self.on.membrane.layout().len()];
        self.on.membrane.flow().decode(self.integration.stepper().state(), &mut nodal);
        nodal
    }

    /// What the flow keeps, whatever the energy.
    pub(super) fn keeps(&mut self) -> Kept {
        self.on.membrane.flow().normal_mobility().keeps()
    }

    /// Bytes that the terms of the energy keep for second derivatives.
    pub(super) fn kept_bytes(&mut self) -> f64 {
        self.on.membrane.flow().energy_terms().kept_bytes()
    }

    /// Length |Γ| of the curve.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.integration.stepper().state().last().copied().unwrap_or_default()
    }

    /// Time of the last accepted state.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.integration.stepper().time()
    }

    /// Time at which the run ends at the latest.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Work so far.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        self.integration.counters()
    }

    /// The initial frame and those saved since.
    #[must_use]
    pub fn frames(&self) -> &[Frame] {
        &self.record.frames
    }
}
