//! Tables of the stiff membrane.

use curveflow_tests::physics::incompressible_limit::{self, LARGEST_FITTED, STARTS};
use curveflow_tests::physics::stiffness::{self, EPSILONS, TOLERANCES};

use curveflow_tests::report::markdown;

/// Every ε of every start.
pub fn ladder() -> String {
    let mut rows = Vec::new();
    for (name, initial) in STARTS {
        for point in incompressible_limit::measure(initial).points {
            rows.push(vec![
                name.to_owned(),
                format!("{:.0e}", point.epsilon),
                format!("{:.3e}", point.distance[0]),
                format!("{:.3e}", point.distance[1]),
                format!("{:.3e}", point.velocity_residual),
                format!("{:+.3e}", point.length_deficit),
                format!("{:.2e}", point.gap),
                point.rate.map_or("–".to_owned(), |rate| rate.to_string()),
                point.eigenvalues.map_or("–".to_owned(), |[first, last]| format!("{first:.3} … {last:.3}")),
                format!("{:.2}", point.buckling),
            ]);
        }
    }
    let head = [
        "start",
        "ε",
        "d(0)",
        "d(T)",
        "‖V − 𝓘V̂‖/‖V‖",
        "1 − \\|Γ\\|/M",
        "gap",
        "ν",
        "lowest of H",
        "max\\|κ\\|/max\\|κ₀\\|",
    ];
    markdown(&head, &rows)
}

/// Exponents of ε.
pub fn exponents() -> String {
    let rows = STARTS.iter().map(|(name, initial)| {
        let limit = incompressible_limit::measure(initial);
        let mut row = vec![(*name).to_owned()];
        row.extend(limit.exponents.iter().map(ToString::to_string));
        row
    });
    let head = format!("start (ε ≤ {LARGEST_FITTED})");
    let head =
        [head.as_str(), "distance", "velocity residual", "length deficit", "gap to the incompressible curve"];
    markdown(&head, &rows.collect::<Vec<_>>())
}

/// Steps before and after the curve is on the manifold.
pub fn stiffness() -> String {
    let mut rows = Vec::new();
    for tolerance in TOLERANCES {
        let work = stiffness::measure(tolerance);
        let mut row = vec![format!("{tolerance:.0e}")];
        row.extend(work.iter().map(|work| {
            let [before, after] = work.steps;
            let rejected = work.rejections.total();
            let rejected = if rejected > 0 { format!(" (−{rejected})") } else { String::new() };
            format!("{before} + **{after}**{rejected}")
        }));
        rows.push(row);
    }
    let epsilons = EPSILONS.map(|epsilon| format!("ε = {epsilon:.0e}"));
    let head: Vec<&str> = std::iter::once("tolerance").chain(epsilons.iter().map(String::as_str)).collect();
    markdown(&head, &rows)
}
