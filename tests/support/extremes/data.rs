//! Curves and densities that are hard to hold.

use super::case::{Case, Ladder};
use super::outcome::End;

/// Sharp peaks of the curvature and narrow necks.
#[must_use]
pub fn curves() -> Vec<Case> {
    let relax = "energy.bending.rigidity = 1.0\nenergy.length.tension = 1.0\n";
    let needle = |nodes: &str, flow: &str, end: &str| {
        format!(
            "curve = {{ shape = 'ellipse', semi_axes = [1.0, 0.01] }}\n{relax}{flow}time.end = {end}\n\
             accuracy = {{ tolerance = 1e-5, nodes = {nodes} }}"
        )
    };
    let graded = "flow = { gauge = 'graded', grading = '0.004 + sin(2*pi*s)^2' }\n";
    let neck = |flow: &str| {
        format!(
            "curve = {{ shape = 'polar', r = 'sqrt(cos(2*phi) + sqrt(1.001 - sin(2*phi)^2))' }}\n\
             energy.bending.rigidity = 1.0\n{flow}\ntime.end = 1.0\naccuracy.tolerance = 1e-5"
        )
    };
    let (tension, stretched) = ("energy.length.tension = 1.0", "energy.length.tension = -30.0");
    let on_contact = format!("{stretched}\nflow.stop_on_contact = true");
    vec![
        Case::text("κ up to 1e4, 1024 graded nodes", &needle("1024", graded, "1.0"), &[], End::EndTime),
        Case::text("κ up to 1e4, 32768 nodes, to t = 1e-9", &needle("32768", "", "1e-9"), &[], End::EndTime)
            .large(),
        Case::text("κ up to 1e4, automatic nodes", &needle("'auto'", "", "1.0"), &[], End::TooManyNodes),
        Case::text("a neck of 1/40 that opens", &neck(tension), &[], End::EndTime),
        Case::text("a neck of 1/40 that closes, stop on contact", &neck(&on_contact), &[], End::Contact),
        Case::text("a neck of 1/40 that crosses", &neck(stretched), &[("time.end", "2e-3")], End::EndTime),
        Case::text("a curvature that jumps, which takes its time to rest", JUMP, &[], End::EndTime),
        Case::text("a curve with a corner", CORNER, &[], End::Curve),
    ]
}

const CORNER: &str =
    "curve = { shape = 'polar', r = '1 + abs(cos(phi))' }\nenergy.bending.rigidity = 1.0\ntime.end = 1.0";

const JUMP: &str = "curve = { shape = 'polar', r = '1 + 0.1*sin(phi)*abs(sin(phi))' }\nenergy.bending.rigidity = 1.0\n\
                    time = { end = 0.1, stop_at_equilibrium = true }\naccuracy = { tolerance = 1e-2, nodes = 'auto' }";

/// The circle shrinks until κ = 2√2.
const MEETING: &str = "
    curve = { shape = 'circle', radius = 1.0 }
    density = [{ name = 'protein', initial = 0.5, mobility = 'diffusion' }]
    energy.length.tension = 100.0
    energy.agents = { density = 'protein', epsilon = 1.0, delta = 100.0, preferred_curvature = 'rho', \
        low_density = '0.1*kappa^2', high_density = '0.8' }
    time.end = 1.0
    accuracy.tolerance = 1e-4
    ";

/// Fronts, masses and ranges of the agents.
#[must_use]
pub fn densities() -> Vec<Case> {
    let ladder =
        Ladder { base: "three_fold", changes: &[("accuracy.tolerance", "1e-4"), ("time.end", "1.0")] };
    let initial = |name: &str, initial: &str, end| {
        ladder.case(name, &[("density.0.initial", &format!("\"{initial}\""))], end)
    };
    vec![
        initial(
            "two fronts 3ε apart",
            "0.45 - 0.4*tanh((cos(2*pi*s) - cos(0.035))/0.0004)*0 + 0.4*tanh((cos(2*pi*(s - 0.5)) - cos(0.06))/0.002)",
            End::EndTime,
        ),
        initial("no mass, ρ = 0", "0", End::EndTime),
        initial("little mass, ρ = 0.01", "0.01 + 0.005*cos(4*pi*s)", End::EndTime),
        initial("full, ρ = 1", "1", End::EndTime),
        initial("nearly full, ρ = 0.99", "0.99 + 0.005*cos(4*pi*s)", End::EndTime),
        initial("outside [ρ₋, ρ₊]: −0.5 … 1.5", "0.5 + cos(6*pi*s)", End::EndTime),
        initial("outside: −1 … 2", "0.5 + 1.5*cos(2*pi*s)", End::EndTime),
        ladder.case(
            "nodal lines that meet at the start",
            &[("energy.agents.low_density", "\"0.9*kappa\"")],
            End::Term,
        ),
        Case::text("nodal lines that meet on the way", MEETING, &[], End::Fault),
    ]
}
