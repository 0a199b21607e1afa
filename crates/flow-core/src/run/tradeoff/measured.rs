//! Runs the ladder, and what comes of it.

use super::super::observer::Observer;
use super::super::scene::{Frames, Nodes, Output, Scene};
use super::super::simulation::run;
use super::error::{RunError, TradeoffError};
use super::errors::{Errors, Floors, larger};
use super::ladder::Ladder;
use super::leg::{self, Outcome};
use super::observer::{LadderObserver, Leg};
use super::span::{Span, halfway};

/// A measured ladder.
#[derive(Debug)]
pub struct Tradeoff {
    /// Title of the scene.
    pub title: String,
    /// Names of the densities.
    pub densities: Vec<String>,
    /// When the runs are compared.
    pub span: Span,
    /// What they are compared with.
    pub reference: Reference,
    /// One per tolerance, the loosest first.
    pub rows: Vec<Row>,
}

/// The run that stands for the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Its tolerance.
    pub tolerance: f64,
    /// Whether rounding kept the tolerance from being a hundredth of the tightest rung's.
    pub at_rounding: bool,
    /// Its number of nodes.
    pub nodes: usize,
    /// Its accepted steps.
    pub steps: u64,
    /// Seconds of its integration.
    pub seconds: f64,
}

/// One tolerance: its measurement, or why there is none.
#[derive(Debug)]
pub struct Row {
    /// The tolerance asked for.
    pub tolerance: f64,
    /// What came of it.
    pub outcome: Result<Rung, RunError>,
}

/// A run that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Number of nodes.
    pub nodes: usize,
    /// Accepted steps.
    pub steps: u64,
    /// Seconds of integration: the median of several runs if they are short.
    pub seconds: f64,
    /// Errors halfway and at the end.
    pub errors: [Errors; 2],
}

impl Rung {
    /// The largest of all errors: what the tolerance was to bound.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        larger(self.errors[0].largest(), self.errors[1].largest())
    }
}

impl Tradeoff {
    /// The runs that were measured, with their tolerances.
    pub fn rungs(&self) -> impl Iterator<Item = (f64, &Rung)> + Clone {
        self.rows.iter().filter_map(|row| row.outcome.as_ref().ok().map(|rung| (row.tolerance, rung)))
    }

    /// The quickest run whose errors are all at most `error`, with its tolerance; none if there is none.
    #[must_use]
    pub fn cheapest(&self, error: f64) -> Option<(f64, &Rung)> {
        let good = self.rungs().filter(|(_, rung)| rung.largest_error() <= error);
        good.min_by(|(_, a), (_, b)| a.seconds.total_cmp(&b.seconds))
    }

    /// Whether all errors hold those of the nodes too: the reference has more of them than any rung.
    #[must_use]
    pub fn includes_space(&self) -> bool {
        self.rungs().all(|(_, rung)| self.includes_space_of(rung))
    }

    /// Whether the errors of `rung` hold those of its nodes: the reference has more.
    #[must_use]
    pub fn includes_space_of(&self, rung: &Rung) -> bool {
        rung.nodes < self.reference.nodes
    }

    /// The tolerances of the rungs whose errors are those in time only.
    pub fn in_time_only(&self) -> impl Iterator<Item = f64> {
        self.rungs().filter(|(_, rung)| !self.includes_space_of(rung)).map(|(tolerance, _)| tolerance)
    }

    /// Whether the ladder was interrupted before its last rung.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        self.rows.iter().any(|row| matches!(row.outcome, Err(RunError::Interrupted)))
    }
}

/// Runs `scene` at every tolerance of `ladder` and measures each run against a tighter one.
///
/// A rung that fails is a row with its error. Once `observer` asks to stop, the rungs not complete are rows with
/// [`RunError::Interrupted`].
/// # Errors
/// [`TradeoffError`] if there is nothing to measure against.
pub fn tradeoff(
    scene: &Scene,
    ladder: &Ladder,
    observer: &mut dyn LadderObserver,
) -> Result<Tradeoff, TradeoffError> {
    let scene = &scene.clone().checked().map_err(|error| TradeoffError::Setup(error.into()))?;
    let span = scout(scene, observer)?;
    let (tolerance, at_rounding) = ladder.reference();
    let nodes = reference_nodes(scene, ladder)?;
    observer.before_run(&Leg::Reference { tolerance, nodes });
    let tight = leg::rung(scene, tolerance, nodes, &span);
    let truth = leg::once(&tight, observer).map_err(|error| match error {
        RunError::Interrupted => TradeoffError::Interrupted,
        source => TradeoffError::Reference { tolerance, nodes, source },
    })?;
    let (nodes, steps, seconds) = (truth.nodes, truth.steps, truth.seconds);
    Ok(Tradeoff {
        title: scene.title.clone(),
        densities: scene.density.iter().map(|density| density.name.clone()).collect(),
        span,
        reference: Reference { tolerance, at_rounding, nodes, steps, seconds },
        rows: climb(scene, ladder, &span, &truth, observer)?,
    })
}

/// The times of comparison.
fn scout(scene: &Scene, observer: &mut dyn LadderObserver) -> Result<Span, TradeoffError> {
    let tolerance = scene.accuracy.tolerance;
    observer.before_run(&Leg::Scout { tolerance });
    let mut scout = scene.clone();
    scout.output = Output { frames: Frames::At { times: Vec::new() }, fields: Vec::new() };
    let failed = |source| match source {
        RunError::Setup(error) => TradeoffError::Setup(error),
        RunError::Interrupted => TradeoffError::Interrupted,
        source @ RunError::Failed { .. } => TradeoffError::Scout { tolerance, source },
    };
    let observer: &mut dyn Observer = observer;
    let record = run(&scout.renewed(), observer).map_err(TradeoffError::Setup)?;
    let ending = leg::ending(&record, scene.time.end).map_err(failed)?;
    let end = record.frames[record.frames.len() - 1].time;
    Ok(Span { halfway: halfway(&record), end, ending })
}

/// As many as asked for, or else those of the scene: where they are automatic, as many as its tolerance needs.
fn reference_nodes(scene: &Scene, ladder: &Ladder) -> Result<Nodes, TradeoffError> {
    match (ladder.reference_nodes(), scene.accuracy.nodes) {
        (Some(nodes), Nodes::Count(least)) if nodes < least => {
            Err(TradeoffError::FewerNodes { nodes, least })
        }
        (Some(nodes), _) => Ok(Nodes::Count(nodes)),
        (None, nodes) => Ok(nodes),
    }
}

/// Runs every rung; none may have more nodes than were asked for the reference, whose errors it would be told as its own.
fn climb(
    scene: &Scene,
    ladder: &Ladder,
    span: &Span,
    truth: &Outcome,
    observer: &mut dyn LadderObserver,
) -> Result<Vec<Row>, TradeoffError> {
    let mut rows: Vec<Row> = Vec::new();
    let count = ladder.tolerances().len();
    let mut interrupted = false;
    for (index, &tolerance) in ladder.tolerances().iter().enumerate() {
        let outcome = if interrupted {
            Err(RunError::Interrupted)
        } else {
            observer.before_run(&Leg::Rung { tolerance, number: index + 1, count });
            let rung = leg::rung(scene, tolerance, scene.accuracy.nodes, span);
            leg::timed(&rung, observer).map(|run| measured(&run, truth))
        };
        interrupted = matches!(outcome, Err(RunError::Interrupted));
        if let (Some(nodes), Ok(rung)) = (ladder.reference_nodes(), &outcome)
            && nodes < rung.nodes
        {
            return Err(TradeoffError::FewerNodes { nodes, least: rung.nodes });
        }
        rows.push(Row { tolerance, outcome });
    }
    Ok(rows)
}

fn measured(run: &Outcome, truth: &Outcome) -> Rung {
    let floors = Floors::of(&truth.start, &truth.frames, truth.energy_scale);
    let errors = [0, 1].map(|at| Errors::of(&run.frames[at], &truth.frames[at], &floors));
    Rung { nodes: run.nodes, steps: run.steps, seconds: run.seconds, errors }
}
