//! Coefficients, nodes and tolerances from one end of their ranges to the other.

use super::case::{Case, Ladder};
use super::outcome::End;

const NODES: &str = "accuracy.nodes";
const AUTO: (&str, &str) = (NODES, "\"auto\"");
const TOLERANCE: &str = "accuracy.tolerance";
const END: &str = "time.end";

/// Width ε of the fronts from 1 to 1e-4, the three-fold membrane.
#[must_use]
pub fn epsilon() -> Vec<Case> {
    let key = "energy.agents.epsilon";
    let ladder = Ladder { base: "three_fold", changes: &[AUTO, (TOLERANCE, "1e-4")] };
    let short = |value, end, nodes| {
        let changes = [(key, value), (END, end), (NODES, nodes)];
        ladder.case(&format!("ε = {value}, to t = {end}"), &changes, End::EndTime)
    };
    vec![
        ladder.case("ε = 1", &[(key, "1.0")], End::Equilibrium),
        ladder.case("ε = 0.1", &[(key, "0.1")], End::Equilibrium),
        ladder.case("ε = 0.02", &[(key, "0.02")], End::Equilibrium),
        ladder.case("ε = 0.01", &[(key, "0.01")], End::Equilibrium).large(),
        ladder.case("ε = 0.005", &[(key, "0.005")], End::Equilibrium).large(),
        short("1e-3", "1e-3", "\"auto\"").large(),
        short("1e-4", "1e-5", "65536").large(),
        ladder.case("ε = 1e-4, automatic nodes", &[(key, "1e-4")], End::TooManyNodes),
    ]
}

/// Stiffness δ of the curvature from 10 to 1e-4, the three-fold membrane.
#[must_use]
pub fn delta() -> Vec<Case> {
    let key = "energy.agents.delta";
    let ladder = Ladder { base: "three_fold", changes: &[AUTO, (TOLERANCE, "1e-4"), (END, "0.01")] };
    vec![
        ladder.case("δ = 10", &[(key, "10.0")], End::EndTime),
        // Fronts that form soon after multiply errors by up to a hundred.
        ladder.case("δ = 1, to t = 0.003", &[(key, "1.0"), (END, "0.003")], End::EndTime),
        ladder.case("δ = 0.02", &[(key, "0.02")], End::EndTime),
        ladder.case("δ = 1e-3, to t = 1e-3", &[(key, "1e-3"), (END, "1e-3")], End::EndTime).large(),
        ladder
            .case("δ = 1e-4, to t = 1e-5", &[(key, "1e-4"), (END, "1e-5"), (NODES, "65536")], End::EndTime)
            .large(),
        ladder.case("δ = 1e-4, automatic nodes", &[(key, "1e-4")], End::TooManyNodes),
    ]
}

/// The values of β at which the length is held.
pub const PENALTIES: [&str; 5] = ["0.0", "3.0", "1e3", "1e6", "1e8"];

/// Penalty β on the length from 0 to 1e8, from the target length on.
#[must_use]
pub fn penalty() -> Vec<Case> {
    let key = "energy.length.penalty";
    let bending = Ladder { base: "length_penalty", changes: &[(END, "1.0")] };
    let agents = Ladder { base: "three_fold", changes: &[("energy.length.target_ratio", "1.0")] };
    let far = Ladder { base: "three_fold", changes: &[(TOLERANCE, "1e-3")] };
    let mut cases: Vec<Case> = PENALTIES
        .iter()
        .map(|beta| bending.case(&format!("bending, β = {beta}"), &[(key, beta)], End::EndTime))
        .collect();
    for beta in ["3.0", "1e8"] {
        cases.push(agents.case(&format!("agents, β = {beta}"), &[(key, beta)], End::Equilibrium));
    }
    let near = [(key, "1e8"), ("energy.length.target_ratio", "1.01")];
    cases.push(agents.case("agents, β = 1e8, 1 % longer", &near, End::Equilibrium));
    let wrinkles = [(key, "1e8"), (NODES, "4096"), (END, "1e-10")];
    cases.push(far.case("agents, β = 1e8, 1.8 times longer, to t = 1e-10", &wrinkles, End::EndTime).large());
    cases
}

/// A curve of three lobes under bending and tension whose area is held by a penalty.
const HELD_BY_A_PENALTY: &str = "
    curve = { shape = 'polar', r = '1 + 0.25*cos(3*phi) + 0.1*sin(2*phi)' }
    energy.bending.rigidity = 1.0
    energy.length.tension = 0.3
    energy.area.penalty = 1.0
    energy.area.target_ratio = 1.0
    time = { end = 1000.0, stop_at_equilibrium = true }
    accuracy.tolerance = 1e-5
    ";

/// Penalty on the area up to 1e8, from the area on that it wants.
#[must_use]
pub fn area_penalty() -> Vec<Case> {
    let at = |mobility: &str, beta: &&str| {
        let changes = [("energy.area.penalty", *beta), ("flow.normal_mobility", mobility)];
        let name = format!("{}, β = {beta}", mobility.trim_matches('"'));
        Case::text(&name, HELD_BY_A_PENALTY, &changes, End::Equilibrium)
    };
    let of = |mobility| ["1e4", "1e6", "1e8"].iter().map(move |beta| at(mobility, beta));
    of("\"identity\"").chain(of("\"incompressible\"")).collect()
}

/// Compressibility ε of a membrane density from 1 to 1e-6.
#[must_use]
pub fn membrane() -> Vec<Case> {
    let key = "energy.membrane.epsilon";
    let ladder = Ladder { base: "membrane_penalty", changes: &[] };
    let mut cases: Vec<Case> = ["1.0", "0.01", "1e-4", "1e-6"]
        .iter()
        .map(|epsilon| ladder.case(&format!("ε = {epsilon}"), &[(key, epsilon)], End::EndTime))
        .collect();
    let compressed = ("density.0.initial", "\"1.2 + 0.1*cos(4*pi*s)\"");
    let changes = [(key, "1e-3"), compressed, (NODES, "512"), (TOLERANCE, "1e-4")];
    cases.push(ladder.case("ε = 1e-3, compressed: ρ = 1.2", &changes, End::EndTime));
    cases
}

/// Nodes from 8 to 65536, every derivative family.
#[must_use]
pub fn nodes() -> Vec<Case> {
    let ellipse = |nodes: &str, family: &str| {
        let text = format!(
            "curve = {{ shape = 'ellipse', semi_axes = [1.2, 1.0] }}\nenergy.bending.rigidity = 1.0\n\
             energy.length.tension = 1.0\ntime.end = 0.5\n\
             accuracy = {{ tolerance = 1e-5, nodes = {nodes}, derivative = '{family}' }}"
        );
        Case::text(&format!("{nodes} nodes, {family}"), &text, &[], End::EndTime)
    };
    let families = ["fourier", "central-2", "central-4", "central-6", "central-8"];
    let mut cases: Vec<Case> = families.iter().map(|family| ellipse("8", family)).collect();
    cases.push(ellipse("9", "fourier"));
    cases.push(ellipse("4096", "fourier"));
    cases.push(ellipse("65536", "fourier").large());
    cases.push(ellipse("65536", "central-2").large());
    let few = [(NODES, "8")];
    cases.push(Case::shipped("8 nodes for three lobes", "length_penalty", &few, End::TooFewNodes));
    cases
}

/// Tolerances from 1e-1 to 1e-11.
#[must_use]
pub fn tolerance() -> Vec<Case> {
    let mut cases = Vec::new();
    for tolerance in ["1e-1", "1e-2", "1e-3", "1e-5", "1e-7", "1e-9", "1e-11"] {
        for (name, base, end) in [
            ("bending", "length_penalty", End::EndTime),
            ("figure eight", "figure_eight", End::Equilibrium),
            ("agents", "three_fold", End::EndTime),
        ] {
            let mut changes = vec![(TOLERANCE, tolerance)];
            if base == "three_fold" {
                changes.push((END, "0.1"));
            }
            let case = Case::shipped(&format!("{name}, {tolerance}"), base, &changes, end);
            let large = base == "three_fold" && matches!(tolerance, "1e-9" | "1e-11");
            cases.push(if large { case.large() } else { case });
        }
    }
    cases
}
