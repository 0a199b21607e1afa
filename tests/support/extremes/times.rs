//! End times from 1e-12 to 1e12, and flows that end before.

use super::case::Case;
use super::outcome::End;

/// End times.
#[must_use]
pub fn ends() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, base) in [
        ("bending", "length_penalty"),
        ("figure eight", "figure_eight"),
        ("membrane", "membrane_penalty"),
        ("incompressible", "incompressible"),
        ("agents", "three_fold"),
    ] {
        for end in ["1e-12", "1e12"] {
            let changes = [("time.end", end), ("time.stop_at_equilibrium", "false")];
            cases.push(Case::shipped(&format!("{name}, to t = {end}"), base, &changes, End::EndTime));
        }
        let changes = [("time.end", "1e12"), ("time.stop_at_equilibrium", "true")];
        cases.push(Case::shipped(&format!("{name}, to rest"), base, &changes, End::Equilibrium));
    }
    let growing = [("time.end", "1e12"), ("time.stop_at_equilibrium", "false")];
    cases.push(Case::shipped("a circle that grows, to t = 1e12", "circle", &growing, End::EndTime));
    cases
}

/// Flows that are ill-posed, on nodes that the program chooses; differences that ask for very many nodes at first; and steps that
/// shrink to the rounding of the time.
#[must_use]
pub fn ill_posed() -> Vec<Case> {
    let ellipse = "curve = { shape = 'ellipse', semi_axes = [1.0, 0.1] }\n";
    let compressed = format!(
        "{ellipse}energy.length.tension = -1.0\ntime.end = 1.0\naccuracy = {{ tolerance = 1e-4, nodes = 'auto' }}"
    );
    let differences = format!(
        "{ellipse}energy.bending.rigidity = 1.0\ntime.end = 1.0\n\
         accuracy = {{ tolerance = 1e-6, nodes = 'auto', derivative = 'central-2' }}"
    );
    let separating = "curve = { shape = 'circle', radius = 1.0 }\nenergy.bending.rigidity = 1.0\n\
        density = [{ name = 'protein', initial = '0.5 + 0.01*cos(2*pi*s) + 0.01*sin(4*pi*s)', mobility = 'diffusion' }]\n\
        energy.local.expression = 'protein^2*(1 - protein)^2'\ntime.end = 10.0\n\
        accuracy = { tolerance = 1e-4, nodes = 'auto' }";
    vec![
        Case::text("compression without bending, automatic nodes", &compressed, &[], End::Unresolved),
        Case::text("a density that separates at no cost", separating, &[], End::Unresolved),
        Case::text("central-2 at 1e-6, automatic nodes", &differences, &[], End::EndTime),
        Case::text("a figure eight of held area, central-2", HELD_EIGHT, &[], End::EndTime),
    ]
}

/// At rest, to the end in a step: the pressure moves nothing, and the density costs nothing. With the force of the pressure left in, rounding moves it: steps fall
/// to 10⁻²⁵ at t = 3·10⁻¹², grow and fall again, until one underflows.
const HELD_EIGHT: &str = "
    curve = { shape = 'figure-eight', size = 1.0, turning_number = 0 }
    density = [{ name = 'protein', initial = 1.0, mobility = 'exchange' }]
    energy.area.pressure = -3.0
    energy.membrane = { density = 'protein', epsilon = 2.200810134939843e-6 }
    flow.normal_mobility = 'area-preserving'
    time = { end = 4.447839545141853e-11, stop_at_equilibrium = true }
    accuracy = { tolerance = 8.317339582317727e-6, nodes = 100, derivative = 'central-2', linear_solver = 'banded' }
    ";

/// Flows that end in a point, blow up, or have no solution.
#[must_use]
pub fn singular() -> Vec<Case> {
    let circle = |name: &str, energy: &str, tolerance: &str, end| {
        let text = format!(
            "curve = {{ shape = 'circle', radius = 1.0 }}\n{energy}\n\
             time = {{ end = 1.0, stop_at_equilibrium = false }}\naccuracy = {{ tolerance = {tolerance}, nodes = 64 }}"
        );
        Case::text(name, &text, &[], end)
    };
    let tension = "energy.length.tension = 1.0";
    let mut cases: Vec<Case> = ["1e-2", "1e-6", "1e-10"]
        .iter()
        .map(|tolerance| {
            circle(&format!("a circle under tension, {tolerance}"), tension, tolerance, End::StepUnderflow)
        })
        .collect();
    let trillium = "curve = { shape = 'trillium' }\nenergy.length.tension = 1.0\ntime.end = 10.0\n\
                    accuracy = { tolerance = 1e-5, nodes = 512 }";
    cases.push(Case::text("a trillium under tension", trillium, &[], End::StepUnderflow));
    // Towards the point the steps go with R²: pressure is no part of the implicit operator (F20).
    cases.push(circle(
        "a circle under pressure −1",
        "energy.area.pressure = -1.0",
        "1e-6",
        End::StepUnderflow,
    ));
    cases.push(circle(
        "negative bending",
        "energy.local.expression = '-0.5*kappa^2'",
        "1e-6",
        End::StepUnderflow,
    ));
    cases.push(circle(
        "a logarithm of 1 − κ",
        "energy.local.expression = 'ln(1 - kappa)'",
        "1e-6",
        End::EnergyNotFinite,
    ));
    cases
}
