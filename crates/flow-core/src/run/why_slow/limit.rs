//! What limits a run, from its shares and counters.

use super::super::energy_terms::{Initial, energy_terms};
use super::super::own_terms::OwnTerms;
use super::super::record::{Record, StopReason};
use super::super::resolution::LEAST_NODES;
use super::super::scene::{DensityMobility, LinearSolver, Scene};
use super::super::warnings::doubts;
use super::{Spending, WhySlow};
use crate::flow::MetricRole;

/// What the time of a run goes up with most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Nothing was measured: an older file.
    NotMeasured,
    /// The start takes most of the time.
    Start,
    /// The frames and the files do, the frames more.
    Frames,
    /// The frames and the files do, the files more.
    Output,
    /// Those who watch do.
    Observers,
    /// Steps are rejected because the energy rises.
    EnergyRises,
    /// Steps are rejected because values are not finite.
    NotFinite,
    /// The implicit solves fail, or take many iterations.
    ImplicitSolves,
    /// One term of the energy takes most of the time, and the steps are as long as the tolerance lets them be.
    Term,
    /// The steps are as long as the tolerance lets them be.
    Accuracy,
}

/// Part of the time from which on one thing is most of it.
const MOST: f64 = 0.5;
/// Part of the attempts that may be rejected for one cause: at a good tolerance less than one in twenty is.
const REJECTED: f64 = 0.1;
/// Frames that a file costs more than.
const FEW_FRAMES: usize = 20;
/// Equidistant nodes beyond which nodes that follow the solution are quicker.
const MANY_NODES: usize = 2048;
/// Krylov iterations of a solve; 1 to 4 are usual.
const MANY_ITERATIONS: f64 = 8.0;

impl Limit {
    /// All of them.
    const ALL: [Self; 10] = [
        Self::NotMeasured,
        Self::Start,
        Self::Frames,
        Self::Output,
        Self::Observers,
        Self::EnergyRises,
        Self::NotFinite,
        Self::ImplicitSolves,
        Self::Term,
        Self::Accuracy,
    ];

    /// Its name: `not-measured`, `start`, `frames`, `output`, `observers`, `energy-rises`, `not-finite`, `implicit-solves`, `term`
    /// or `accuracy`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NotMeasured => "not-measured",
            Self::Start => "start",
            Self::Frames => "frames",
            Self::Output => "output",
            Self::Observers => "observers",
            Self::EnergyRises => "energy-rises",
            Self::NotFinite => "not-finite",
            Self::ImplicitSolves => "implicit-solves",
            Self::Term => "term",
            Self::Accuracy => "accuracy",
        }
    }

    /// The first that holds.
    pub(super) fn of(why: &WhySlow) -> Self {
        Self::ALL.into_iter().find(|limit| limit.holds(why)).unwrap_or(Self::Accuracy)
    }

    fn holds(self, why: &WhySlow) -> bool {
        let attempts = (why.steps + why.rejections.total()).max(1) as f64;
        let rejected = |count: u64| count as f64 > REJECTED * attempts;
        match self {
            Self::NotMeasured => why.total <= 0.0,
            Self::Start => why.share(Spending::Start) > MOST,
            Self::Observers => why.share(Spending::Observers) > MOST,
            Self::Frames | Self::Output => {
                let (frames, output) = (why.share(Spending::Frames), why.share(Spending::Output));
                frames + output > MOST && (frames >= output) == (self == Self::Frames)
            }
            Self::EnergyRises => rejected(why.rejections.energy_rise),
            Self::NotFinite => rejected(why.rejections.not_finite),
            Self::ImplicitSolves => {
                rejected(why.rejections.solver) || why.krylov_iterations_per_solve > MANY_ITERATIONS
            }
            Self::Term => dearest_term(why).is_some(),
            Self::Accuracy => true,
        }
    }

    /// One sentence on it, and one thing to try.
    pub(super) fn explain(self, why: &WhySlow, record: &Record) -> (String, String) {
        let percent = |spending| format!("{:.0} %", 100.0 * why.share(spending));
        let rejections = &why.rejections;
        let (sentence, advice) = match self {
            Self::NotMeasured => (
                "this file does not say where the time went".to_owned(),
                "run the scene again with this version",
            ),
            Self::Start => (
                format!("the run is short: its start takes {} of the time", percent(Spending::Start)),
                "run many scenes in one process, from Python, rather than one in each",
            ),
            Self::Output if record.frames.len() <= FEW_FRAMES => (
                format!("the run is short: its file takes {} of the time", percent(Spending::Output)),
                "run many scenes in one process, from Python, where results are files only if they are saved",
            ),
            Self::Frames | Self::Output => {
                (saving(why), "save fewer frames (output.frames), or fewer fields (output.fields)")
            }
            Self::Observers => (
                format!("those who watch the run take {} of the time", percent(Spending::Observers)),
                "do less in the callback, or call it less often",
            ),
            Self::EnergyRises => (
                format!(
                    "{} attempts at a step were rejected because the energy rose",
                    rejections.energy_rise
                ),
                "a smaller accuracy.tolerance: it solves the implicit steps more exactly",
            ),
            Self::NotFinite => (
                format!(
                    "{} attempts at a step left the numbers that the scene is good for",
                    rejections.not_finite
                ),
                "check the range of its expressions, or give it more accuracy.nodes",
            ),
            Self::ImplicitSolves => (implicit_solves(why), easier_solves(record)),
            Self::Term => dear_term(why, record),
            Self::Accuracy => (
                format!("{}; {}", as_long_as_they_may_be(why), largest_part(why)),
                "a larger accuracy.tolerance: `curveflow tradeoff` measures what that costs in accuracy",
            ),
        };
        (sentence, self.before_it_is_quicker(record).unwrap_or_else(|| advice.to_owned()))
    }

    /// What a run that failed needs before it is worth making quicker, and a doubtful result before its steps may be made fewer or
    /// cheaper, which would make it worse.
    fn before_it_is_quicker(self, record: &Record) -> Option<String> {
        if let StopReason::Failed(message) = &record.stop_reason {
            return Some(format!("first mend what ended the run: {message}"));
        }
        let doubt = matches!(self, Self::Term | Self::Accuracy).then(|| doubts(record).next())??;
        Some(format!("first {}: the result is doubtful as it is", doubt.remedy()))
    }
}

fn saving(why: &WhySlow) -> String {
    let (frames, output) = (100.0 * why.share(Spending::Frames), 100.0 * why.share(Spending::Output));
    let files = if output > 0.0 { format!(", and files {output:.0} %") } else { String::new() };
    format!("frames take {frames:.0} % of the time{files}")
}

fn as_long_as_they_may_be(why: &WhySlow) -> String {
    format!(
        "the {} steps are as long as accuracy.tolerance lets them be ({} more were rejected for their error)",
        why.steps, why.rejections.error
    )
}

/// What takes the largest part of the time of the steps.
fn largest_part(why: &WhySlow) -> String {
    let aside =
        [Spending::Start, Spending::Frames, Spending::Observers, Spending::Output].map(Spending::name);
    let largest = why.activities.iter().find(|share| !aside.contains(&share.name.as_str()));
    largest.map_or_else(String::new, |share| {
        let name = super::text::readable(&share.name);
        format!("their largest part is {name}, {:.0} % of the time", 100.0 * share.share)
    })
}

fn implicit_solves(why: &WhySlow) -> String {
    if why.krylov_iterations_per_solve <= MANY_ITERATIONS {
        return format!(
            "{} implicit solves failed, though not for their linear systems: {:.1} Krylov iterations each",
            why.rejections.solver, why.krylov_iterations_per_solve
        );
    }
    format!(
        "the implicit solves are hard: {:.1} Krylov iterations each, and {} of them failed",
        why.krylov_iterations_per_solve, why.rejections.solver
    )
}

/// The scene; that of a file of another version may not be readable here, and the general advice holds then.
fn scene_of(record: &Record) -> Option<Scene> {
    Scene::parse(&record.resolved_scene, "the scene of the result").ok()
}

/// Whether a term acts on positions.
fn has_shape_energy(scene: &Scene) -> bool {
    let any = Initial { length: 1.0, area: 1.0, is_round: false, own: OwnTerms::default() };
    energy_terms(scene, &any, LEAST_NODES).is_ok_and(|terms| terms.iter().any(|term| term.has_shape_energy()))
}

/// Whether a term has an epsilon, which sets the width of fronts or the stiffness of a membrane.
fn has_fronts(scene: &Scene) -> bool {
    let energy = &scene.energy;
    energy.agents.is_some() || energy.membrane.is_some() || energy.packing.is_some()
}

/// What makes the linear systems of a scene easier.
fn easier_solves(record: &Record) -> &'static str {
    let smaller = "a smaller accuracy.tolerance: shorter steps are easier to solve";
    let Some(scene) = scene_of(record) else { return smaller };
    let carries = scene.density.iter().any(|density| density.mobility == DensityMobility::Carried);
    match (scene.flow.gauge.metric(), scene.accuracy.linear_solver) {
        (MetricRole::Uniform | MetricRole::Graded, _) if carries => {
            "flow.gauge = \"co-moving\": a density with mobility = \"none\" stays on its nodes there"
        }
        (MetricRole::Field, _) => {
            "a [[flow.switch]] to gauge = \"scaled-arc-length\" before the flow comes to rest"
        }
        (MetricRole::Graded, _) if scene.flow.grading.is_some() => {
            "a weaker flow.grading, or gauge = \"scaled-arc-length\""
        }
        (MetricRole::Graded, _) if has_fronts(&scene) => "gauge = \"scaled-arc-length\", or a larger epsilon",
        (MetricRole::Graded, _) => "gauge = \"scaled-arc-length\"",
        (_, LinearSolver::Fourier) => "accuracy.linear_solver = \"auto\"",
        (_, LinearSolver::Auto | LinearSolver::Banded)
            if record.nodes() <= 128 && has_shape_energy(&scene) =>
        {
            "accuracy.linear_solver = \"dense\": only it knows the terms that act on positions"
        }
        (MetricRole::Uniform, _) if record.nodes() > MANY_NODES => {
            "flow.gauge = \"graded\": nodes crowd where the solution is sharp then, and far fewer do"
        }
        _ => smaller,
    }
}

/// The term of the energy that takes most of the time, with its share.
fn dearest_term(why: &WhySlow) -> Option<(&str, f64)> {
    let parts = ["normal_mobility", "density_mobilities", "flow_map"];
    let terms = why.evaluations.iter().filter(|share| !parts.contains(&share.name.as_str()));
    terms.map(|share| (share.name.as_str(), share.share)).find(|(_, share)| *share > MOST)
}

fn dear_term(why: &WhySlow, record: &Record) -> (String, &'static str) {
    let (term, share) = dearest_term(why).unwrap_or_default();
    let sentence =
        format!("{}; energy.{term} takes {:.0} % of the time", as_long_as_they_may_be(why), 100.0 * share);
    let advice = scene_of(record).and_then(|scene| scene.energy.cheaper(term));
    (sentence, advice.unwrap_or("shorter expressions in it, or fewer accuracy.nodes"))
}
