//! Records without a run: a circle that relaxes to a three-lobed curve, with one density.
#![allow(dead_code)] // each test binary uses its part

use std::f64::consts::TAU;

use flow_core::run::{
    Counters, EvaluationSeconds, Frame, Provenance, Record, Rejections, Seconds, StepLog, StopReason,
};

/// A record of `frames` states with `nodes` nodes; without densities if `densities` is empty.
pub fn record(frames: usize, nodes: usize, densities: &[&str]) -> Record {
    let times: Vec<f64> = (0..frames)
        .map(|i| if i == 0 { 0.0 } else { 1e-5 * 10_f64.powf(8.0 * i as f64 / frames as f64) })
        .collect();
    let rejection = Rejections { error: 1, solver: 2, energy_rise: 3, not_finite: 4 };
    Record {
        title: "Three-fold protein membrane".to_owned(),
        scene: "title = \"Three-fold protein membrane\"  # κ₀(ρ)\n".repeat(2000),
        resolved_scene: "nodes = 512\n".to_owned(),
        energy_terms: vec!["agents".to_owned(), "length".to_owned()],
        own_terms: Vec::new(),
        densities: densities.iter().map(|&name| name.to_owned()).collect(),
        fields: densities.iter().map(|&name| format!("force of {name}")).collect(),
        diagnostics: densities.iter().map(|&name| format!("distance of {name}")).collect(),
        frames: times.iter().map(|&time| frame(time, nodes, densities.len())).collect(),
        steps: StepLog {
            size: times.iter().map(|t| 0.1 * t).collect(),
            energy: times.iter().map(|t| 4.0 + 3.0 * (-t).exp()).collect(),
            dissipation: times.iter().map(|t| (-t).exp()).collect(),
            order: times.iter().map(|_| 4).collect(),
            nodes: times.iter().map(|_| 48).collect(),
            rejections: times
                .iter()
                .map(|t| if *t > 1.0 { rejection } else { Rejections::default() })
                .collect(),
            time: times,
        },
        counters: Counters {
            steps: frames as u64,
            rejections: rejection,
            right_hand_sides: 5,
            jacobian_products: 6,
            newton_iterations: 7,
            krylov_iterations: 8,
            factorisations: 9,
            solves: 10,
            remaps: 11,
            unresolved_steps: 12,
            integration_seconds: 0.25,
        },
        seconds: seconds(),
        stop_reason: StopReason::Equilibrium,
        provenance: Provenance::here(),
    }
}

/// A second or two for everything.
fn seconds() -> Seconds {
    let values = [0.5, 1.0, 1.25, 2.0, 0.75, 1.5, 0.25, 0.75, 0.125, 0.0625, 0.375, 0.03125, 1.0];
    let mut values = values.into_iter();
    let evaluations = EvaluationSeconds {
        terms: vec![2.0, 0.125],
        normal_mobility: 0.25,
        density_mobilities: 0.5,
        flow_map: 2.125,
    };
    Seconds::new(|_| values.next().expect("one for each"), evaluations)
}

/// One state: r = 1 + a cos 3φ, where a grows from 0.05 to 0.35.
fn frame(time: f64, n: usize, densities: usize) -> Frame {
    let progress = 1.0 - (-time).exp();
    let a = 0.05 + 0.3 * progress;
    let mut frame = Frame { time, closure_defect: 1e-13, ..Frame::default() };
    for i in 0..n {
        let phi = TAU * i as f64 / n as f64;
        let (r, r1, r2) =
            (1.0 + a * (3.0 * phi).cos(), -3.0 * a * (3.0 * phi).sin(), -9.0 * a * (3.0 * phi).cos());
        let speed = r.hypot(r1);
        frame.position.push([1.6 * r * phi.cos(), 1.6 * r * phi.sin()]);
        frame.metric.push(TAU * 1.6 * speed);
        frame.curvature.push((r * r + 2.0 * r1 * r1 - r * r2) / speed.powi(3) / 1.6);
        frame.normal_velocity.push(0.3 * (-time).exp() * (3.0 * phi).cos());
    }
    frame.length = frame.metric.iter().sum::<f64>() / n as f64;
    frame.area = 0.5 * TAU * 2.56 * (1.0 + a * a / 2.0);
    frame.energy = 4.0 + 3.0 * (-time).exp() + 0.8 * (-1000.0 * time).exp();
    frame.energy_terms = vec![0.25 * frame.energy, 0.75 * frame.energy];
    frame.dissipation = 3.0 * (-time).exp();
    frame.energy_balance = 1e-6 * progress;
    for k in 0..densities {
        let density = frame
            .curvature
            .iter()
            .map(|kappa| 0.15 + 0.7 * progress * 0.5 * (1.0 - (2.0 * (kappa - 0.6)).tanh()) + 0.1 * k as f64);
        frame.density.push(density.collect());
        frame.mass.push(0.5 * frame.length);
        frame.fields.push(frame.curvature.iter().map(|kappa| kappa * progress).collect());
        frame.diagnostics.push(progress);
    }
    frame
}
