//! What the physics tests share: scenes, runs, and the checks that every run must pass.

pub mod extremes;
pub mod hostile;
pub mod physics;
pub mod report;

use flow_core::run::{Frame, Quiet, Record, Scene, StopReason};

/// A shipped scene with `changes` (dotted key, value).
///
/// # Panics
/// If there is no such scene, or the changes make none.
#[must_use]
pub fn shipped(name: &str, changes: &[(&str, &str)]) -> Scene {
    let found = Scene::shipped().iter().find(|(shipped, _)| *shipped == name);
    let (_, text) = found.unwrap_or_else(|| panic!("no scene {name}"));
    let changes: Vec<_> =
        changes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Scene::parse_with(text, name, &changes).unwrap_or_else(|error| panic!("{error}"))
}

/// A scene from its text.
///
/// # Panics
/// If it is not a scene.
#[must_use]
pub fn scene(text: &str) -> Scene {
    Scene::parse(text, "test.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// The record of `scene`, run to its end.
///
/// # Panics
/// If the run cannot start or fails on the way.
#[must_use]
pub fn run(scene: &Scene) -> Record {
    let record = flow_core::run::run(scene, &mut Quiet).unwrap_or_else(|error| panic!("{error}"));
    assert!(!matches!(record.stop_reason, StopReason::Failed(_)), "{:?}", record.stop_reason);
    record
}

/// The frame saved last.
///
/// # Panics
/// Never: the initial frame is always saved.
#[must_use]
pub fn last(record: &Record) -> &Frame {
    record.frames.last().expect("the initial frame")
}

/// Asserts that `value` is `exact` up to the relative `tolerance`.
///
/// # Panics
/// If it is not.
#[track_caller]
pub fn assert_close(value: f64, exact: f64, tolerance: f64) {
    let error = (value - exact).abs() / exact.abs();
    assert!(error <= tolerance, "{value} ≠ {exact}: relative error {error:.2e} > {tolerance:.0e}");
}

/// Largest relative rise of the energy in a step; 0 if it falls at every one.
///
/// The program itself rejects rises above a few units in the last place; what is left is rounding.
#[must_use]
pub fn largest_rise(record: &Record) -> f64 {
    let start = record.frames[0].energy;
    let before = std::iter::once(&start).chain(&record.steps.energy);
    before.zip(&record.steps.energy).fold(0.0, |rise, (a, b)| ((b - a) / a.abs()).max(rise))
}

/// How often the periodic `values` cross `level`.
#[must_use]
pub fn crossings(values: &[f64], level: f64) -> usize {
    let next = values.iter().cycle().skip(1);
    values.iter().zip(next).filter(|(a, b)| (**a > level) != (**b > level)).count()
}

/// The middle between the smallest and the largest value.
#[must_use]
pub fn middle(values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (low + high)
}

/// Mean over the nodes.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The zero of `f`, which is below zero at the first of `ends` and above at the second.
#[must_use]
pub fn bisection(ends: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = ends;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if f(middle) > 0.0 { &mut high } else { &mut low }) = middle;
    }
    low
}
