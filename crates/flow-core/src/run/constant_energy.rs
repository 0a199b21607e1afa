//! The part of the energy that is a constant of the motion, as far as the scene tells: `THEORY.md`, eq. (I14).

use super::choices::family;
use super::mobilities::{density_mobilities, normal_mobility};
use super::record::{Frame, Record};
use super::scene::{Bending, Formula, Scene};
use crate::flow::Kept;
use crate::geometry::PeriodicGrid;
use crate::geometry::vectors::mean_of_product;
use crate::integrator::EnergyScale;
use crate::operators::Derivative;

/// What errors of the energy are relative to in the run of `scene` that left `record`.
pub(super) fn energy_scale(scene: &Scene, record: &Record) -> EnergyScale {
    let scale = |first: &Frame| EnergyScale::new(first.energy, constant_energy(scene, record, first));
    record.frames.first().map_or(EnergyScale::new(0.0, 0.0), scale)
}

/// The constant of the motion in the energy of the run of `scene` that left `record`, from the state `first`; 0 if nothing is known to
/// be one.
fn constant_energy(scene: &Scene, record: &Record, first: &Frame) -> f64 {
    let energy = &scene.energy;
    let preferred = energy.bending.as_ref().and_then(Bending::constant_preferred_curvature);
    if energy.length.is_none() && energy.local.is_none() && preferred.is_none() {
        return 0.0;
    }
    let Some((kept, masses)) = kept(scene) else { return 0.0 };
    // That of an area which is kept is none of these: steps keep it only up to their error, until it is put back, and what it costs
    // shows in the dissipation of each.
    let costs_length = energy.length.is_some() && kept.length;
    let terms = record.energy_terms.iter().zip(&first.energy_terms);
    let of_length =
        terms.filter(|(name, _)| costs_length && *name == "length").map(|(_, value)| value).sum::<f64>();
    let length = kept.length.then_some(first.length);
    let turning = mean_of_product(&first.curvature, &first.metric);
    let of_bending = energy.bending.as_ref().zip(preferred).map_or(0.0, |(bending, preferred)| {
        bending.rigidity * preferred * (0.5 * preferred * length.unwrap_or(0.0) - turning)
    });
    let of_local = energy.local.as_ref().map_or(0.0, |local| {
        // Its variables are each field and its slope, the curvature first.
        let masses = masses.iter().zip(&first.mass).map(|(kept, mass)| kept.then_some(*mass));
        let integrals = std::iter::once(Some(turning)).chain(masses).enumerate();
        let integrals = integrals.filter_map(|(field, integral)| Some((2 * field, integral?)));
        of_tangent(&local.expression, length, integrals)
    });
    of_length + of_bending + of_local
}

/// What the tangent plane of the density `e` at fields that are zero adds up to along the curve, as far as its integrals are kept:
/// the length, that of 1, and those of some variables. What is not finite there says nothing.
fn of_tangent(e: &Formula, length: Option<f64>, integrals: impl Iterator<Item = (usize, f64)>) -> f64 {
    let (e, zero) = (e.expression(), vec![0.0; e.variables().len()]);
    let at_zero = length.map(|length| e.evaluate(&zero) * length);
    let slopes =
        integrals.filter(|(variable, _)| e.depends_on(*variable)).filter_map(|(variable, integral)| {
            e.derivative(variable).ok().map(|slope| slope.evaluate(&zero) * integral)
        });
    at_zero.into_iter().chain(slopes).filter(|part| part.is_finite()).sum()
}

/// What the flow of `scene` keeps whatever its energy: of the curve, and whether the mass of each density.
fn kept(scene: &Scene) -> Option<(Kept, Vec<bool>)> {
    /// As many as every operator takes: what is kept does not depend on them.
    const NODES: usize = 32;
    let grid = PeriodicGrid::new(NODES);
    let derivative = Derivative::new(family(scene, false), &grid);
    let curve = normal_mobility(scene, &grid, &derivative).keeps();
    let densities = density_mobilities(scene, &grid, &derivative).ok()?;
    Some((curve, densities.iter().map(|density| density.conserves_mass()).collect()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::run::Simulation;

    /// Of the unit circle with the density 1/2 of each kind: one whose mass is kept, one that is exchanged.
    fn constant_of(energy: &str, mobility: &str) -> f64 {
        let text = format!(
            "
            curve = {{ shape = 'circle', radius = 1.0 }}
            density = [
                {{ name = 'kept', initial = 0.5, mobility = 'diffusion' }},
                {{ name = 'free', initial = 0.5, mobility = 'exchange' }},
            ]
            energy = {{ {energy} }}
            flow.normal_mobility = '{mobility}'
            time.end = 1.0
            "
        );
        let scene = Scene::parse(&text, "circle").unwrap();
        energy_scale(&scene, &Simulation::new(&scene).unwrap().record()).constant()
    }

    #[test]
    fn it_is_the_integral_of_the_tangent_plane_as_far_as_that_is_kept() {
        for (energy, with_length, without) in [
            ("bending.rigidity = 3.0", 0.0, 0.0),
            ("bending = { rigidity = 3.0, preferred_curvature = 2.0 }", 6.0 * TAU - 6.0 * TAU, -6.0 * TAU),
            ("local.expression = '7 + kappa^2 + kappa_sigma^2'", 7.0 * TAU, 0.0),
            ("local.expression = '0.5*(kappa - 4)^2'", 8.0 * TAU - 4.0 * TAU, -4.0 * TAU),
            ("local.expression = '(kept - 3)^2 + free_sigma^2'", 9.0 * TAU - 3.0 * TAU, -3.0 * TAU),
            ("local.expression = '(free - 3)^2 + kappa^2'", 9.0 * TAU, 0.0),
            // No tangent there: nothing is known of the one, and of the other but its value.
            ("local.expression = 'kept*ln(kept) + kappa^2'", 0.0, 0.0),
            ("local.expression = '2 + sqrt(kept) + kappa^2'", 2.0 * TAU, 0.0),
            ("local.expression = 'kappa^2', length.tension = 5.0", 5.0 * TAU, 0.0),
        ] {
            for (mobility, exact) in [("incompressible", with_length), ("identity", without)] {
                let found = constant_of(energy, mobility);
                assert!(
                    (found - exact).abs() < 1e-12 * 10.0 * TAU,
                    "{energy}, {mobility}: {found}, not {exact}"
                );
            }
        }
    }

    #[test]
    fn the_cost_of_an_area_is_none_also_where_that_is_kept() {
        assert_eq!(constant_of("bending.rigidity = 1.0, area.pressure = 2.0", "area-preserving"), 0.0);
    }
}
