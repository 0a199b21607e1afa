//! The part of the energy that is a constant of the motion, as far as the scene tells: `THEORY.md`, eq. (I14).

use super::choices::family;
use super::mobilities::{density_mobilities, normal_mobility};
use super::record::{Frame, Record};
use super::scene::{Bending, Formula, Local, Scene};
use crate::expression::Expression;
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
    let bending = energy.bending.as_ref().filter(|bending| bending.preferred_curvature.is_some());
    if energy.length.is_none() && energy.area.is_none() && energy.local.is_none() && bending.is_none() {
        return 0.0;
    }
    let Some((kept, masses)) = kept(scene) else { return 0.0 };
    let cost = |name: &str| {
        let terms = record.energy_terms.iter().zip(&first.energy_terms);
        terms.filter(|(known, _)| *known == name).map(|(_, value)| value).sum::<f64>()
    };
    let of_length = if energy.length.is_some() && kept.length { cost("length") } else { 0.0 };
    let of_area = if energy.area.is_some() && kept.area { cost("area") } else { 0.0 };
    let length = kept.length.then_some(first.length);
    let turning = mean_of_product(&first.curvature, &first.metric);
    let curvature = Integral { mean: turning / first.length, kept: Some(turning) };
    let densities = masses.iter().zip(&first.mass);
    let densities: Vec<Integral> = densities
        .map(|(kept, mass)| Integral { mean: mass / first.length, kept: kept.then_some(*mass) })
        .collect();
    let of_bending = bending.map_or(0.0, |bending| {
        let density = scene.density.iter().position(|known| bending.density.as_ref() == Some(&known.name));
        let density = density.map_or(&[][..], |at| &densities[at..=at]);
        of_tangent(&|fields| bending_plane(bending, fields), cost("bending"), length, curvature, density)
    });
    let of_local = energy.local.as_ref().map_or(0.0, |local| {
        of_tangent(&|fields| local_plane(local, fields), cost("local"), length, curvature, &densities)
    });
    of_length + of_area + of_bending + of_local
}

/// Where tangent planes are looked for, the first that exists being taken: parts of the means of the curvature and of the densities.
const BASES: [[f64; 2]; 5] = [[0.0, 0.0], [0.0, 0.5], [0.0, 1.0], [0.5, 0.5], [1.0, 1.0]];

/// What a field adds up to along the curve at the start.
#[derive(Clone, Copy)]
struct Integral {
    /// Per length.
    mean: f64,
    /// The integral itself, if the flow keeps it.
    kept: Option<f64>,
}

/// The value of a density of the energy at some fields, and its slope along each.
type Plane = (f64, Vec<f64>);

/// What a tangent plane of a density of the energy adds up to along the curve, as far as its integrals are kept: the `length`, that of 1,
/// and those of fields. `plane` is that at values of the fields, the curvature first.
///
/// Any plane will do, but the nearer its base is to the state, the less it leaves. That at fields that are zero leaves all of κ²/2, and of
/// (ρ − 1)² what varies. Where there is none (a ln a), densities are half their means, which leaves of each cost its natural size also
/// where they hardly vary; and so on as [`BASES`] says. So it is where the first plane leaves more than `cost`, all that the term costs.
fn of_tangent(
    plane: &dyn Fn(&[f64]) -> Plane,
    cost: f64,
    length: Option<f64>,
    curvature: Integral,
    densities: &[Integral],
) -> f64 {
    let integrals: Vec<Integral> = std::iter::once(curvature).chain(densities.iter().copied()).collect();
    let at = |[of_curvature, of_densities]: &[f64; 2]| {
        let densities = densities.iter().map(|density| of_densities * density.mean);
        let base: Vec<f64> = std::iter::once(of_curvature * curvature.mean).chain(densities).collect();
        let (value, slopes) = plane(&base);
        if !value.is_finite() {
            return None; // there are no such states, whether the value is needed or not
        }
        let of_length = length.map(|length| value * length);
        let of_fields = integrals.iter().zip(&base).zip(slopes).filter_map(|((integral, base), slope)| {
            let excess = integral.kept? - base * length.unwrap_or(0.0);
            // A field that does not matter may have a mean that is no number.
            (slope != 0.0).then_some(slope * excess)
        });
        Some(of_length.into_iter().chain(of_fields).sum::<f64>()).filter(|sum| sum.is_finite())
    };
    let first = BASES.iter().find_map(at).unwrap_or(0.0);
    // What is finite at fields that are zero may still be far from what it is elsewhere, as 1/(ρ + 10⁻³).
    let serves = |constant: &f64| (cost - constant).abs() <= cost.abs();
    if serves(&first) { first } else { at(&BASES[1]).filter(serves).unwrap_or(first) }
}

/// The tangent plane of (b/2)(κ − c₀(ρ))² at the curvature and the density on which c₀ depends, if it does.
fn bending_plane(bending: &Bending, fields: &[f64]) -> Plane {
    let preferred = bending.preferred_curvature.as_ref().map(Formula::expression);
    let at = |c: &Expression| c.evaluate(&[fields.get(1).copied().unwrap_or(0.0)]);
    let excess = fields[0] - preferred.map_or(0.0, at);
    let by_excess = bending.rigidity * excess;
    let by_density = preferred.filter(|_| fields.len() > 1).and_then(|c| c.derivative(0).ok());
    let by_density = by_density.map(|c| -by_excess * at(&c));
    (0.5 * by_excess * excess, std::iter::once(by_excess).chain(by_density).collect())
}

/// The tangent plane of a local density at fields without slopes; its variables are each field and its slope.
fn local_plane(local: &Local, fields: &[f64]) -> Plane {
    let e = local.expression.expression();
    let point: Vec<f64> = fields.iter().flat_map(|field| [*field, 0.0]).collect();
    let slope = |field| {
        // One that is too large to be told has none that is known.
        let slope = e.depends_on(2 * field).then(|| e.derivative(2 * field).ok()).flatten();
        slope.map_or(0.0, |slope| slope.evaluate(&point))
    };
    (e.evaluate(&point), (0..fields.len()).map(slope).collect())
}

/// What the flow of `scene` keeps whatever its energy: of the curve, and whether the mass of each density.
fn kept(scene: &Scene) -> Option<(Kept, Vec<bool>)> {
    /// As many as every operator takes: what is kept does not depend on them.
    const NODES: usize = 32;
    let grid = PeriodicGrid::new(NODES);
    let derivative = Derivative::new(family(scene, false), &grid);
    let curve = normal_mobility(scene, false, &grid, &derivative).keeps();
    let densities = density_mobilities(scene, &grid, &derivative).ok()?;
    Some((curve, densities.iter().map(|density| density.conserves_mass()).collect()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{LN_2, LN_10, TAU};

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
            (
                "bending = { rigidity = 3.0, preferred_curvature = 'rho + 2', density = 'kept' }",
                3.0 * TAU,
                -3.0 * TAU,
            ),
            (
                "bending = { rigidity = 3.0, preferred_curvature = 'rho + 2', density = 'free' }",
                0.0,
                -6.0 * TAU,
            ),
            ("bending = { rigidity = 3.0, preferred_curvature = '2*rho', density = 'kept' }", 0.0, 0.0),
            // No tangent there: at half the density, at all of it if it must be, and so with the curvature.
            ("local.expression = '2 + kept*ln(kept) + kappa^2'", (2.25 - LN_2) * TAU, (0.5 - LN_2) * TAU),
            ("local.expression = '2 + free*ln(free) + kappa^2'", (2.0 - 0.5 * LN_2) * TAU, 0.0),
            ("local.expression = '2 + sqrt(kept) + kappa^2'", 2.75 * TAU, 0.5 * TAU),
            ("local.expression = '2 + ln(kept - 0.4) + kappa^2'", (2.0 - LN_10) * TAU, 5.0 * TAU),
            ("local.expression = '2 + kappa*ln(kappa)'", (2.5 - LN_2) * TAU, (1.0 - LN_2) * TAU),
            // There is one, but it leaves more than all.
            (
                "local.expression = '1e3 + 1/(kept + 1e-3)'",
                (1e3 + 1.0 / 0.251 - 0.25 / (0.251 * 0.251)) * TAU,
                -5e5 * TAU,
            ),
            ("local.expression = 'kappa^2', length.tension = 5.0", 5.0 * TAU, 0.0),
        ] {
            for (mobility, exact) in [("incompressible", with_length), ("identity", without)] {
                let found = constant_of(energy, mobility);
                assert!(
                    (found - exact).abs() < 1e-12 * f64::max(10.0 * TAU, exact.abs()),
                    "{energy}, {mobility}: {found}, not {exact}"
                );
            }
        }
    }

    #[test]
    fn so_is_the_cost_of_an_area_that_is_kept() {
        let energy = "bending.rigidity = 1.0, area.pressure = 2.0";
        assert!((constant_of(energy, "area-preserving") + TAU).abs() < 1e-12);
        assert_eq!(constant_of(energy, "identity"), 0.0);
    }
}
