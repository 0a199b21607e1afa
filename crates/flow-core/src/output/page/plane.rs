//! The nodal lines of the agents in the (ρ, κ) plane, as far as the states of the run reach.

use super::{base64, json};
use crate::run::scene::Formula;
use crate::run::{Frame, Record, Scene};

/// Points of a line.
const POINTS: usize = 256;
/// Part of its range that a line goes on at both ends.
const MARGIN: f64 = 0.25;

/// The density of the agents and their lines, as JSON; `null` if the scene has none.
pub(super) fn lines(record: &Record) -> String {
    lines_of_the_scene(record).unwrap_or_else(|| "null".to_owned())
}

fn lines_of_the_scene(record: &Record) -> Option<String> {
    // A file whose scene this version no longer reads still has a curve to show.
    let scene = Scene::parse(&record.resolved_scene, "resolved scene").ok()?;
    let agents = scene.energy.agents.as_ref()?;
    let density = record.densities.iter().position(|name| *name == agents.density)?;
    let at = |line: &Formula, value| line.expression().evaluate(&[value]);
    let rho = samples(&record.frames, |frame| &frame.density[density]);
    let kappa = samples(&record.frames, |frame| &frame.curvature);
    let along_rho = |rho: f64| [rho, at(&agents.preferred_curvature, rho)];
    let low = |kappa: f64| [at(&agents.low_density, kappa), kappa];
    let high = |kappa: f64| [at(&agents.high_density, kappa), kappa];
    let line = |name: &str, points: Vec<[f64; 2]>| {
        json::object([
            ("name", json::text(name)),
            ("points", json::text(&base64::singles(points.into_iter().flatten()))),
        ])
    };
    let drawn = [
        line("κ₀(ρ)", rho.into_iter().map(along_rho).collect()),
        line("ρ₋(κ)", kappa.iter().copied().map(low).collect()),
        line("ρ₊(κ)", kappa.iter().copied().map(high).collect()),
    ];
    Some(json::object([("density", density.to_string()), ("lines", json::list(drawn))]))
}

/// Values at equal distances over the range of a field in all frames.
fn samples<'a>(frames: &'a [Frame], field: impl Fn(&'a Frame) -> &'a Vec<f64>) -> Vec<f64> {
    let values = || frames.iter().flat_map(&field).copied().filter(|value| value.is_finite());
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    let margin = MARGIN * (high - low);
    let (from, to) = (low - margin, high + margin);
    (0..POINTS).map(|k| from + (to - from) * k as f64 / (POINTS - 1) as f64).collect()
}
