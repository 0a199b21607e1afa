//! The nodal lines of a record's agents as polylines, for pictures.

use super::record::Record;
use super::scene::{Formula, Scene};

/// Points of a polyline.
const POINTS: usize = 200;
/// Part of the range of curvatures that is added at both ends.
const MARGIN: f64 = 0.25;

/// κ₀(ρ), ρ₋(κ) and ρ₊(κ) as points (ρ, κ) around the final state of `record`; none if its scene has no
/// agents on `density`, or on the first one if none is named.
#[must_use]
pub fn nodal_polylines(record: &Record, density: Option<&str>) -> Option<[Vec<(f64, f64)>; 3]> {
    let scene = Scene::parse(&record.resolved_scene, "resolved scene").ok()?;
    let agents = scene.energy.agents.as_ref()?;
    if density.or(record.densities.first().map(String::as_str)) != Some(agents.density.as_str()) {
        return None;
    }
    let curvature = &record.frames.last()?.curvature;
    let low = curvature.iter().copied().fold(f64::INFINITY, f64::min);
    let high = curvature.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let margin = MARGIN * (high - low);
    let along =
        |from: f64, to: f64| (0..POINTS).map(move |k| from + (to - from) * k as f64 / (POINTS - 1) as f64);
    let at = |line: &Formula, value| line.expression().evaluate(&[value]);
    let curvatures = || along(low - margin, high + margin);
    Some([
        along(0.0, 1.0).map(|rho| (rho, at(&agents.preferred_curvature, rho))).collect(),
        curvatures().map(|kappa| (at(&agents.low_density, kappa), kappa)).collect(),
        curvatures().map(|kappa| (at(&agents.high_density, kappa), kappa)).collect(),
    ])
}
