//! Tables of single curves: the three flows, pieces, adhesion, other turning numbers.

use std::f64::consts::PI;

use curveflow_tests::physics::figure_eight::{DOUBLE, double_circle, elastica, product, turns_off};
use curveflow_tests::physics::three_flows::{self, FLOWS};
use curveflow_tests::physics::{adhesion, labelled_pieces};

use curveflow_tests::report::markdown;

/// Length and shape at t = 0.01.
pub fn three_flows() -> String {
    let measured = three_flows::measure("1e-7", "512");
    let rows = FLOWS.iter().zip(&measured.flows).map(|((scene, how), flow)| {
        vec![
            format!("`{scene}`"),
            (*how).to_owned(),
            format!("{:.6}", flow.length_ratio),
            format!("{:.1e}", flow.length_change),
            format!("{:.5}", flow.bending),
            format!("{:.5}", flow.roundness),
            format!("{:.0e}", flow.rise),
            flow.steps.to_string(),
        ]
    });
    let head = [
        "scene",
        "what is held",
        "\\|Γ\\|/\\|Γ₀\\|",
        "largest change of \\|Γ\\|",
        "½∫κ² dσ",
        "\\|Γ\\|²/4πA",
        "rise of 𝓕",
        "steps",
    ];
    markdown(&head, &rows.collect::<Vec<_>>())
}

/// Crossings and peaks.
pub fn aligned() -> String {
    let measured = three_flows::measure("1e-7", "512");
    let list = |values: Vec<String>| values.join(", ");
    let directions = |aligned: &curveflow_tests::physics::alignment::Aligned| {
        list(aligned.crossing_directions().iter().map(|direction| format!("{direction:.0}°")).collect())
    };
    let rows = [
        ("crossings, length-penalised and incompressible", measured.aligned.crossings().to_string()),
        ("their directions from the centre", directions(&measured.aligned)),
        ("largest gap between the two", format!("{:.4}", measured.aligned.largest_gap())),
        ("best rotation", format!("{:.4} rad", measured.aligned.angle)),
        ("crossings, length-penalised and membrane", measured.membrane_aligned.crossings().to_string()),
        ("largest gap between the two", format!("{:.4}", measured.membrane_aligned.largest_gap())),
        ("mean of ρ − 1", format!("{:.5}", measured.mean_excess)),
        ("peaks of ρ − 1", list(measured.peaks.iter().map(|[excess, _]| format!("{excess:.4}")).collect())),
        ("curvature there", list(measured.peaks.iter().map(|[_, kappa]| format!("{kappa:.3}")).collect())),
        ("correlation of ρ − 1 with κ", format!("{:.4}", measured.correlation)),
        ("distance from the incompressible manifold", format!("{:.3e}", measured.membrane[0])),
        ("‖V − 𝓘V̂‖/‖V‖", format!("{:.3e}", measured.membrane[1])),
    ];
    markdown(&["at t = 0.01", "value"], &rows.map(|(what, value)| vec![what.to_owned(), value]))
}

/// Rates of the length of pieces.
pub fn labelled_pieces() -> String {
    let pieces = labelled_pieces::measure("fourier");
    let rows = pieces.iter().map(|piece| {
        vec![
            format!("{:.3}", piece.time),
            format!("[{}, {}]", piece.ends[0], piece.ends[1]),
            format!("{:.8}", piece.measured),
            format!("{:.8}", piece.predicted),
            format!("{:.8}", piece.inflow),
            format!("{:.1e}", (piece.inflow - piece.predicted).abs() / piece.scale),
        ]
    });
    let head = ["t", "labels", "d\\|piece\\|/dt, moved", "∫κV dσ", "inflow", "difference/max\\|κV\\|\\|Γ\\|"];
    markdown(&head, &rows.collect::<Vec<_>>())
}

/// Nodes, tolerances, and the area held.
pub fn adhesion() -> String {
    let mut rows = Vec::new();
    for mobility in ["identity", "area-preserving"] {
        for (nodes, tolerance) in
            [(64, 1e-5), (64, 1e-7), (128, 1e-5), (128, 1e-7), (256, 1e-5), (256, 1e-7), (512, 1e-7)]
        {
            let run = adhesion::measure(mobility, tolerance, nodes);
            rows.push(vec![
                format!("`{mobility}`"),
                nodes.to_string(),
                format!("{tolerance:.0e}"),
                run.steps.to_string(),
                format!("{:.7}", run.length_ratio),
                format!("{:.6}", run.energy),
                format!("{:.0e}", run.rise),
                format!("{:.1e}", run.area_change),
            ]);
        }
        let converged = adhesion::converged(mobility);
        let value = |[value, error]: [f64; 2]| format!("**{value:.7} ± {error:.0e}**");
        let (length, energy) = (value(converged.length_ratio), value(converged.energy));
        let row = [&format!("`{mobility}`"), "→ ∞", "→ 0", "", &length, &energy, "", ""];
        rows.push(row.map(str::to_owned).to_vec());
    }
    let head =
        ["mobility", "nodes", "tolerance", "steps", "\\|Γ\\|/\\|Γ₀\\|", "𝓕", "rise of 𝓕", "change of A"];
    markdown(&head, &rows)
}

/// Bending energy times length at rest, against the elastica.
pub fn figure_eight() -> String {
    let mut rows = Vec::new();
    let mut add = |name: &str, record: &flow_core::run::Record, turns: f64, exact: f64| {
        rows.push(vec![
            name.to_owned(),
            format!("{turns}"),
            format!("{:.0e}", turns_off(record, turns)),
            format!("{}", record.frames[0].crossings),
            format!("{:.8}", product(record)),
            format!("{exact:.8}"),
            format!("{:.1e}", (product(record) / exact - 1.0).abs()),
            record.counters.steps.to_string(),
        ]);
    };
    for tolerance in ["1e-6", "1e-8"] {
        let record = curveflow_tests::physics::figure_eight::figure_eight(tolerance);
        add(&format!("figure eight, tolerance {tolerance}"), &record, 0.0, elastica());
    }
    for (name, curve) in DOUBLE {
        add(name, &double_circle(curve), 2.0, 8.0 * PI * PI);
    }
    let head =
        ["curve", "turns", "off by", "crossings at the start", "½∫κ² dσ\\|Γ\\|", "exact", "error", "steps"];
    markdown(&head, &rows)
}
