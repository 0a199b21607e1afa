//! One extreme scene and how it is expected to end.

use flow_core::run::Scene;
use flow_core::run::scene::Nodes;

use super::outcome::{End, Outcome, measure};
use crate::last;

/// Where a case is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// In the tests and in the table.
    Small,
    /// In the table only.
    Large,
}

/// A scene and its end.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its line in the table.
    pub name: String,
    /// How it must end.
    pub expected: End,
    /// Where it is run.
    pub size: Size,
    scene: Scene,
}

/// Steps after which a case counts as one that hangs; the most measured are a few thousand.
const MOST_STEPS: &str = "20000";

impl Case {
    /// The shipped scene `base` with `changes` (dotted key, value).
    #[must_use]
    pub fn shipped(name: &str, base: &str, changes: &[(&str, &str)], expected: End) -> Self {
        let changes = with_bound(changes);
        Self { name: name.to_owned(), expected, size: Size::Small, scene: crate::shipped(base, &changes) }
    }

    /// The scene `text` with `changes`.
    ///
    /// # Panics
    /// If it is not a scene.
    #[must_use]
    pub fn text(name: &str, text: &str, changes: &[(&str, &str)], expected: End) -> Self {
        let changes: Vec<_> =
            with_bound(changes).into_iter().map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
        let scene = Scene::parse_with(text, name, &changes).unwrap_or_else(|error| panic!("{name}: {error}"));
        Self { name: name.to_owned(), expected, size: Size::Small, scene }
    }

    /// The case in the table only.
    #[must_use]
    pub fn large(self) -> Self {
        Self { size: Size::Large, ..self }
    }

    /// Its scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Its outcome, and the error of that against a run at a hundredth of the tolerance (10⁻¹¹ at least) if it succeeds.
    #[must_use]
    pub fn measure_with_error(&self) -> (Outcome, Option<f64>) {
        let outcome = self.measure();
        if !outcome.succeeded() || outcome.end == End::Contact {
            return (outcome, None);
        }
        let mut tighter = self.scene.clone();
        tighter.accuracy.tolerance = (0.01 * self.scene.accuracy.tolerance).max(1e-11);
        tighter.time.max_steps = None;
        if let Some(record) = &outcome.record {
            // The same time: what counts as rest depends on the tolerance.
            tighter.time.end = last(record).time;
            tighter.time.stop_at_equilibrium = false;
            tighter.accuracy.nodes = Nodes::Count(record.nodes());
        }
        let error = outcome.error(&measure(&tighter));
        (outcome, error)
    }

    /// Runs it.
    #[must_use]
    pub fn measure(&self) -> Outcome {
        measure(&self.scene)
    }
}

fn with_bound<'a>(changes: &[(&'a str, &'a str)]) -> Vec<(&'a str, &'a str)> {
    let mut all = changes.to_vec();
    if changes.iter().all(|(key, _)| *key != "time.max_steps") {
        all.push(("time.max_steps", MOST_STEPS));
    }
    all
}

/// The scene of one table: a shipped one, and the changes that all of its cases share.
pub struct Ladder<'a> {
    /// Name of the shipped scene.
    pub base: &'a str,
    /// Changes (dotted key, value) in every case.
    pub changes: &'a [(&'a str, &'a str)],
}

impl Ladder<'_> {
    /// The case with the further `changes`.
    #[must_use]
    pub fn case(&self, name: &str, changes: &[(&str, &str)], expected: End) -> Case {
        let mut all = self.changes.to_vec();
        all.retain(|(key, _)| changes.iter().all(|(other, _)| other != key));
        all.extend_from_slice(changes);
        Case::shipped(name, self.base, &all, expected)
    }
}
