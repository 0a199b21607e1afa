//! What a run leaves behind: frames, the log of accepted steps, counters and the reason why it stopped.

use serde::{Deserialize, Serialize};

use super::provenance::Provenance;
use super::scene::{Scene, SceneError, names_a_file, with_points};
use super::seconds::Seconds;
use crate::integrator::{Counters, Rejections};

/// One saved state. Fields hold one value per node, `n` of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Simulated time.
    pub time: f64,
    /// Energy `𝓕_h`.
    pub energy: f64,
    /// Energy of each term, in the order of [`Record::energy_terms`].
    pub energy_terms: Vec<f64>,
    /// Dissipation −d𝓕/dt ≥ 0.
    pub dissipation: f64,
    /// 𝓕 − 𝓕₀ + ∫ dissipation dt: zero up to the error of the time integration and [`Frame::remap_error`].
    pub energy_balance: f64,
    /// Energy that changes of the nodes or of the gauge have added so far; zero in a run without them.
    pub remap_error: f64,
    /// Length |Γ|.
    pub length: f64,
    /// Enclosed (signed) area, positive on a counter-clockwise curve.
    pub area: f64,
    /// Mass ∫ρ dσ of each density, in the order of [`Record::densities`].
    pub mass: Vec<f64>,
    /// Gap |γ(1) − γ(0)| of the curve before projection, in units of length.
    pub closure_defect: f64,
    /// Number of self-crossings of the curve.
    pub crossings: f64,
    /// Curvature κ.
    pub curvature: Vec<f64>,
    /// Metric g = |∂γ/∂s|.
    pub metric: Vec<f64>,
    /// Position γ as (x, y).
    pub position: Vec<[f64; 2]>,
    /// Normal velocity V.
    pub normal_velocity: Vec<f64>,
    /// Densities, in the order of [`Record::densities`].
    pub density: Vec<Vec<f64>>,
    /// Fields that the scene asks for, in the order of [`Record::fields`].
    pub fields: Vec<Vec<f64>>,
    /// Values that come with a term of the scene, in the order of [`Record::diagnostics`].
    pub diagnostics: Vec<f64>,
}

/// One entry per accepted step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepLog {
    /// Time at the end of the step.
    pub time: Vec<f64>,
    /// Size of the step.
    pub size: Vec<f64>,
    /// Energy at the end of the step.
    pub energy: Vec<f64>,
    /// Dissipation at the end of the step.
    pub dissipation: Vec<f64>,
    /// Order of the method in the step.
    pub order: Vec<u8>,
    /// Number of nodes in the step.
    pub nodes: Vec<u32>,
    /// Rejected attempts before this step was accepted, by cause.
    pub rejections: Vec<Rejections>,
}

impl StepLog {
    /// An empty log with room for `steps` steps.
    #[must_use]
    pub fn with_room(steps: usize) -> Self {
        let column = || Vec::with_capacity(steps);
        Self {
            time: column(),
            size: column(),
            energy: column(),
            dissipation: column(),
            order: Vec::with_capacity(steps),
            nodes: Vec::with_capacity(steps),
            rejections: Vec::with_capacity(steps),
        }
    }

    /// Number of entries of each column.
    pub(super) fn lengths(&self) -> [usize; 7] {
        let Self { time, size, energy, dissipation, order, nodes, rejections } = self;
        [time.len(), size.len(), energy.len(), dissipation.len(), order.len(), nodes.len(), rejections.len()]
    }
}

/// Why a run stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum StopReason {
    /// The end time was reached.
    EndTime,
    /// The dissipation fell below the bound for equilibrium.
    Equilibrium,
    /// The curve came to cross itself more often than at the start, and the scene says to stop then: the last frame is from just
    /// before.
    Contact,
    /// It was stopped from outside: by an observer (signal, Ctrl-C, limit), or since nobody asked for more steps.
    Interrupted,
    /// The run failed; the last good state is the last frame. Holds the message, which is all that a file has of it;
    /// [`Simulation::failure`](super::Simulation::failure) has the error.
    Failed(String),
}

impl StopReason {
    /// Short name, as written to files: `end-time`, `equilibrium`, `contact`, `interrupted` or `failed`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::EndTime => "end-time",
            Self::Equilibrium => "equilibrium",
            Self::Contact => "contact",
            Self::Interrupted => "interrupted",
            Self::Failed(_) => "failed",
        }
    }

    /// Whether the run came to where it was to go: its end time, its equilibrium, or the contact that it was to stop at.
    #[must_use]
    pub fn is_success(&self) -> bool {
        matches!(self, Self::EndTime | Self::Equilibrium | Self::Contact)
    }

    /// One sentence on it; the message of the failure if there was one.
    #[must_use]
    pub fn message(&self) -> &str {
        match self {
            Self::EndTime => "the end time was reached",
            Self::Equilibrium => "the dissipation fell below the bound for equilibrium",
            Self::Contact => "the curve came to cross itself more often than at the start",
            Self::Interrupted => "the run was stopped before its end",
            Self::Failed(message) => message,
        }
    }
}

/// A finished (or interrupted) run.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Title of the scene.
    pub title: String,
    /// The scene file as given, verbatim (after `--set` changes, if any).
    pub scene: String,
    /// The scene as resolved: TOML with every default and automatic choice filled in.
    pub resolved_scene: String,
    /// Names of the energy terms.
    pub energy_terms: Vec<String>,
    /// Names of those among them that come from outside the scene, which makes no such run alone.
    pub own_terms: Vec<String>,
    /// Names of the densities.
    pub densities: Vec<String>,
    /// Names of the fields that the scene asks for (`[output] fields`), with underscores: `normal_force`.
    pub fields: Vec<String>,
    /// Names of the values per frame that come with a term. With a membrane term under the L² flow: the distances
    /// in L²(dσ) `incompressible_distance`, of ρ from 1 + ερ̄, and `velocity_residual`, of V from 𝓘V̂.
    pub diagnostics: Vec<String>,
    /// Saved states, in time order; the first is the initial state, the last the final one.
    pub frames: Vec<Frame>,
    /// The log of accepted steps.
    pub steps: StepLog,
    /// Work done and time spent.
    pub counters: Counters,
    /// Where the time went.
    pub seconds: Seconds,
    /// Why the run stopped.
    pub stop_reason: StopReason,
    /// What made the record.
    pub provenance: Provenance,
}

#[cfg(test)]
impl Record {
    /// A record of `frames` and `steps` alone.
    pub(crate) fn of_frames_and_steps(frames: Vec<Frame>, steps: StepLog) -> Self {
        Self {
            title: String::new(),
            scene: String::new(),
            resolved_scene: String::new(),
            energy_terms: Vec::new(),
            own_terms: Vec::new(),
            densities: Vec::new(),
            fields: Vec::new(),
            diagnostics: Vec::new(),
            frames,
            steps,
            counters: Counters::default(),
            seconds: Seconds::default(),
            stop_reason: StopReason::EndTime,
            provenance: Provenance::here(),
        }
    }
}

impl Record {
    /// All frames on the largest number of nodes among them.
    #[must_use]
    pub(super) fn on_common_nodes(mut self) -> Self {
        let nodes = self.frames.iter().map(Frame::nodes).max().unwrap_or_default();
        self.frames = self.frames.into_iter().map(|frame| frame.resampled(nodes)).collect();
        self
    }

    /// Number of nodes of the frames: the largest that the run had, where it chose them itself.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.frames.last().map_or(0, Frame::nodes)
    }

    /// The scene of the run, to run it again: as given, except that points which were read from a file stand in it. It knows nothing
    /// of [`Record::own_terms`], and makes another run without them.
    ///
    /// # Errors
    /// [`SceneError`] if the text is not a scene of this version.
    pub fn to_scene(&self) -> Result<Scene, SceneError> {
        const NAME: &str = "the scene of the result";
        if !names_a_file(&self.scene) {
            return Scene::parse(&self.scene, NAME);
        }
        with_points(&self.scene, &Scene::parse(&self.resolved_scene, NAME)?.curve, NAME)
    }
}
