//! How an extreme scene ended, and what its laws came to.

use std::f64::consts::TAU;

use flow_core::geometry::Embedding;
use flow_core::integrator::IntegrationError;
use flow_core::run::{Failure, Frame, Quiet, Record, Scene, SetupError, Simulation, StopReason};

use crate::last;

/// How a run ended: the stop reason of a success, the type of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The end time was reached.
    EndTime,
    /// The flow came to rest.
    Equilibrium,
    /// The curve came to cross itself, and the scene says to stop then.
    Contact,
    /// `IntegrationError::StepUnderflow`.
    StepUnderflow,
    /// `IntegrationError::TooManySteps`.
    TooManySteps,
    /// `ResolutionError`.
    Unresolved,
    /// A term refused the state met on the way (`TermFault`).
    Fault,
    /// `SetupError::TooFewNodes`.
    TooFewNodes,
    /// `SetupError::TooManyNodes`.
    TooManyNodes,
    /// `SetupError::Curve`.
    Curve,
    /// `SetupError::EnergyNotFinite`.
    EnergyNotFinite,
    /// `SetupError::Term`.
    Term,
    /// Another `SetupError`.
    OtherSetup,
}

/// What a run left behind.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it ended.
    pub end: End,
    /// The message of a failure.
    pub message: String,
    /// The record; none if there was no initial state.
    pub record: Option<Record>,
    tolerance: f64,
    conserves: Vec<bool>,
}

/// Rounding of the energy in a step.
const ENERGY_ROUNDING: f64 = 4e-13;
/// Largest relative change of a mass, and gap per length: both are put back after every step.
const RESTORED: f64 = 1e-11;
/// What counts as energy at least, of curves of size one: parts of this size may cancel (the lobes of a figure eight, forces
/// that balance), and their rounding stays.
const NO_ENERGY: f64 = 0.1;
/// Bound on the balance of a success, in units of the tolerance and of the largest energy; a run that fails after a fight has
/// that of each step only.
const BALANCE: f64 = 100.0;

/// Runs `scene` to its end, which `time.max_steps` bounds.
#[must_use]
pub fn measure(scene: &Scene) -> Outcome {
    let conserves = scene.density.iter().map(|density| density.mobility.name() != "exchange").collect();
    let tolerance = scene.accuracy.tolerance;
    let outcome = |end, message, record| Outcome { end, message, record, tolerance, conserves };
    match Simulation::new(scene) {
        Err(error) => outcome(of_setup(&error), error.to_string(), None),
        Ok(mut simulation) => {
            while simulation.step(&mut Quiet) {}
            let end = match (simulation.failure(), simulation.stop_reason()) {
                (Some(failure), _) => of_failure(failure),
                (None, Some(StopReason::EndTime)) => End::EndTime,
                (None, Some(StopReason::Equilibrium)) => End::Equilibrium,
                (None, Some(StopReason::Contact)) => End::Contact,
                (None, stop) => unreachable!("nobody interrupts: {stop:?}"),
            };
            let record = simulation.into_record();
            outcome(end, record.stop_reason.message().to_owned(), Some(record))
        }
    }
}

fn of_failure(failure: &Failure) -> End {
    match failure {
        Failure::Integration(IntegrationError::TooManySteps { .. }) => End::TooManySteps,
        Failure::Integration(_) | Failure::NotFinite { .. } => End::StepUnderflow,
        Failure::Resolution(_) => End::Unresolved,
        _ => End::Fault,
    }
}

fn of_setup(error: &SetupError) -> End {
    match error {
        SetupError::TooFewNodes { .. } => End::TooFewNodes,
        SetupError::TooManyNodes { .. } => End::TooManyNodes,
        SetupError::Curve(_) => End::Curve,
        SetupError::EnergyNotFinite { .. } => End::EnergyNotFinite,
        SetupError::Term(_) => End::Term,
        _ => End::OtherSetup,
    }
}

impl Outcome {
    /// What is wrong with the record, if anything: a value that is not finite, an energy that rises, a mass that changes, a
    /// curve that is open, a dissipation that does not account for the energy lost. A run that failed must keep a good state too.
    #[must_use]
    pub fn broken_law(&self) -> Option<String> {
        let record = self.record.as_ref()?;
        let broken = |law: &str, value: f64, bound: f64| {
            (value.is_nan() || value > bound).then(|| format!("{law} {value:.1e} > {bound:.1e}"))
        };
        (!self.is_finite())
            .then(|| "a value is not finite".to_owned())
            .or_else(|| broken("rise of the energy", self.rise(), ENERGY_ROUNDING))
            .or_else(|| broken("mass defect", self.mass_defect(), RESTORED))
            .or_else(|| broken("gap", gap(last(record)), RESTORED))
            .or_else(|| broken("balance", self.balance(), self.most_imbalance()))
    }

    fn most_imbalance(&self) -> f64 {
        let by_step = if self.succeeded() { 0.0 } else { self.steps() as f64 };
        self.tolerance * by_step.max(BALANCE)
    }

    /// Accepted steps.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.record.as_ref().map_or(0, |record| record.counters.steps)
    }

    /// Largest rise of the energy in a step over the sum of its terms' sizes; zero if it falls at every one.
    #[must_use]
    pub fn rise(&self) -> f64 {
        let Some(record) = &self.record else { return 0.0 };
        let scale = record.frames.iter().map(size).fold(f64::INFINITY, f64::min).max(NO_ENERGY);
        let (energy, nodes) = (&record.steps.energy, &record.steps.nodes);
        let before = std::iter::once(&record.frames[0].energy).chain(energy);
        // What a change of the nodes does to the energy is an error of space, and recorded as such.
        let remapped = |step: usize| {
            record.counters.remaps > 0 && (step < 1 || nodes[step] != nodes[step - 1] || step == 1)
        };
        let pairs = before.zip(energy).enumerate().filter(|(step, _)| !remapped(*step));
        pairs.fold(0.0, |rise, (_, (a, b))| ((b - a) / a.abs().max(scale)).max(rise))
    }

    /// Largest |𝓕 − 𝓕₀ + ∫ dissipation dt| over the largest energy.
    #[must_use]
    pub fn balance(&self) -> f64 {
        let Some(record) = &self.record else { return 0.0 };
        let scale = record.frames.iter().map(size).fold(NO_ENERGY, f64::max);
        record
            .frames
            .iter()
            .fold(0.0, |worst, frame| ((frame.energy_balance - frame.remap_error).abs() / scale).max(worst))
    }

    /// Largest relative change of a mass that is kept.
    #[must_use]
    pub fn mass_defect(&self) -> f64 {
        let Some(record) = &self.record else { return 0.0 };
        let mut worst = 0.0_f64;
        for (density, _) in self.conserves.iter().enumerate().filter(|(_, conserves)| **conserves) {
            let first = record.frames[0].mass[density];
            let scale = first.abs().max(1e-3 * record.frames[0].length);
            for frame in &record.frames {
                worst = worst.max((frame.mass[density] - first).abs() / scale);
            }
        }
        worst
    }

    /// Relative difference of the final energy and length from those of `tighter`, the larger of the two; a hundredth of the
    /// energy lost counts as energy.
    #[must_use]
    pub fn error(&self, tighter: &Self) -> Option<f64> {
        let (a, b) = (last(self.record.as_ref()?), last(tighter.record.as_ref()?));
        let lost = tighter.record.as_ref()?.frames[0].energy - b.energy;
        let energy = (a.energy - b.energy).abs() / b.energy.abs().max(1e-2 * lost).max(f64::MIN_POSITIVE);
        Some(energy.max((a.length / b.length - 1.0).abs()))
    }

    /// Whether the run went to its end.
    #[must_use]
    pub fn succeeded(&self) -> bool {
        matches!(self.end, End::EndTime | End::Equilibrium | End::Contact)
    }

    fn is_finite(&self) -> bool {
        self.record.as_ref().is_none_or(|record| {
            let frames = record.frames.iter().all(is_finite);
            let steps = &record.steps;
            let mut columns =
                steps.time.iter().chain(&steps.size).chain(&steps.energy).chain(&steps.dissipation);
            frames && columns.all(|value| value.is_finite())
        })
    }
}

/// Sum of the sizes of the terms of the energy: what its rounding is relative to.
fn size(frame: &Frame) -> f64 {
    frame.energy_terms.iter().map(|term| term.abs()).sum()
}

fn is_finite(frame: &Frame) -> bool {
    let values =
        [frame.time, frame.energy, frame.dissipation, frame.energy_balance, frame.length, frame.area];
    let fields = [&frame.curvature, &frame.metric, &frame.normal_velocity];
    let positions = frame.position.iter().flatten();
    let all = values.iter().chain(fields.into_iter().flatten()).chain(positions);
    all.chain(frame.density.iter().flatten()).chain(&frame.mass).all(|value| value.is_finite())
}

/// The gap ∫τ dσ of the saved curvature, per length; on graded nodes the distance of ∫κ dσ from a multiple of 2π.
fn gap(frame: &Frame) -> f64 {
    let nodes = frame.curvature.len();
    if frame.metric.iter().any(|metric| (metric / frame.length - 1.0).abs() > 1e-13) {
        let turns = frame.curvature.iter().zip(&frame.metric).map(|(kappa, metric)| kappa * metric);
        let turns = turns.sum::<f64>() / (TAU * nodes as f64);
        return (turns - turns.round()).abs();
    }
    let turning: Vec<f64> = frame.curvature.iter().map(|kappa| kappa * frame.length).collect();
    let mut embedding = Embedding::new(nodes);
    embedding.set_tangent(&turning, frame.length, 0.0);
    let [x, y] = embedding.gap();
    x.hypot(y) / frame.length
}
