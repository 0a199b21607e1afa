//! Curves so near to a circle that length and area, which are kept, hold them. See `THEORY.md`, eq. (F10).

use std::f64::consts::TAU;

use super::scene::{NormalMobility, Scene};
use crate::flow::GradientFlow;
use crate::geometry::shapes::Resampled;
use crate::geometry::vectors::{add_scaled, mean_of_triple_product, sum};

/// Part of the tolerance by which the curvature of a held curve may vary, in the root mean square: it could move by twice that.
const ROUND: f64 = 0.7;
/// … and by which it would vary where the force takes the curve: what it has left of an area makes more of it in high modes.
const DRIVEN: f64 = 2.0;

/// Whether the curve of `scene`, whose length and area are kept, is nearly a circle, run through once.
pub(super) fn is_nearly_round(scene: &Scene, curve: &Resampled) -> bool {
    scene.flow.normal_mobility == NormalMobility::IncompressibleAreaPreserving
        && curve.turning_number == 1
        && deviation(curve) <= ROUND * scene.accuracy.tolerance
}

/// Whether such a curve counts as a circle, where it is and where its force would take it: `flow` is free to move it from the spectral `state`.
pub(super) fn is_held(flow: &mut GradientFlow, state: &[f64], scene: &Scene, curve: &Resampled) -> bool {
    flow.spectral_dissipation(state);
    let weight = flow.current().weight().map_or_else(|| vec![1.0; curve.curvature.len()], <[f64]>::to_vec);
    // Of the area that is left, κ_m² = (m² − 1)/3 of that of an ellipse in the mode m.
    let driven =
        deviation(curve) * ((mean_square_mode(flow.normal_force(), &weight) - 1.0) / 3.0).max(1.0).sqrt();
    driven <= DRIVEN * scene.accuracy.tolerance
}

/// Root mean square of the deviation of the curvature from that of the circle of the same length, as a part of it.
fn deviation(curve: &Resampled) -> f64 {
    let radius = curve.length / TAU;
    let square = curve.curvature.iter().map(|kappa| (kappa * radius - 1.0).powi(2)).sum::<f64>();
    (square / curve.curvature.len() as f64).sqrt()
}

/// Mean of m² over the modes m of `force`, by their squares, without the modes 0 and 1, which do not change the shape of a circle; the distances of the
/// nodes are as `weight`. Zero without other modes.
fn mean_square_mode(force: &[f64], weight: &[f64]) -> f64 {
    let whole = sum(weight);
    let places = weight.iter().scan(0.0, |next, weight| {
        let place = *next;
        *next += TAU * weight / whole;
        Some(place)
    });
    let places: Vec<f64> = places.collect();
    let mut rest = force.to_vec();
    for wave in [|_| 1.0, f64::cos, f64::sin] {
        let wave: Vec<f64> = places.iter().copied().map(wave).collect();
        let part =
            mean_of_triple_product(weight, &rest, &wave) / mean_of_triple_product(weight, &wave, &wave);
        add_scaled(&mut rest, -part, &wave);
    }
    let mass = mean_of_triple_product(weight, &rest, &rest);
    let next = rest.iter().skip(1).chain(rest.first());
    let steps = rest.iter().zip(next).zip(weight);
    let slopes: f64 = steps.map(|((rest, next), weight)| (next - rest).powi(2) / weight).sum();
    let slopes = slopes * whole * whole / (TAU * TAU * weight.len() as f64);
    if mass > 0.0 { slopes / mass } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_are_counted_without_those_that_move_a_circle_as_a_whole() {
        let graded = |i: f64| 1.0 + 0.3 * (TAU * i / 256.0).cos();
        for weight in [vec![1.0; 256], (0..256).map(|i| graded(f64::from(i))).collect::<Vec<f64>>()] {
            let whole: f64 = weight.iter().sum();
            let places = (0..256).map(|i| TAU * weight[..i].iter().sum::<f64>() / whole);
            let force: Vec<f64> =
                places.map(|x| 5.0 + 3.0 * x.cos() - x.sin() + 0.1 * (7.0 * x).cos()).collect();
            let found = mean_square_mode(&force, &weight);
            assert!((found / 49.0 - 1.0).abs() < 0.3, "{found}");
        }
        assert_eq!(mean_square_mode(&[0.0; 8], &[1.0; 8]), 0.0);
    }
}
