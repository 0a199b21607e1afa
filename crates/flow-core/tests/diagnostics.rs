//! Fields and values that frames hold on request.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::f64::consts::TAU;

use flow_core::run::scene::OutputField;
use flow_core::run::{Frame, Quiet, Record, Scene, SetupError, evaluate, run};

const ALL: &str = "output = { frames = 2, fields = ['normal-force', 'tangential-velocity', 'excess-density', \
                   'membrane-flux', 'energy-density', 'energy-densities', 'normal-velocities', 'normal-force'] }";

fn record(text: &str) -> Record {
    run(&Scene::parse(text, "test.toml").unwrap(), &mut Quiet).unwrap()
}

fn field<'a>(record: &Record, frame: &'a Frame, field: OutputField) -> &'a [f64] {
    let index = record.fields.iter().position(|name| *name == field.name().replace('-', "_")).unwrap();
    &frame.fields[index]
}

fn assert_all(values: &[f64], expected: f64, tolerance: f64) {
    assert!(values.iter().all(|value| (value - expected).abs() < tolerance), "{values:?} ≠ {expected}");
}

/// ∫ dσ of nodal values.
fn integral(frame: &Frame, values: impl Iterator<Item = f64>) -> f64 {
    values.zip(&frame.metric).map(|(value, metric)| value * metric).sum::<f64>() / frame.metric.len() as f64
}

/// On a circle of radius R bending has the force 1/(2R³), H⁻¹1 = R², hence ρ̄ = −1/(2R²), and no flux.
#[test]
fn a_circle_has_the_fields_of_a_circle() {
    let record = record(&format!(
        "
        curve = {{ shape = 'circle', radius = 1.3 }}
        energy.bending.rigidity = 1.0
        time = {{ end = 0.1, stop_at_equilibrium = false }}
        accuracy.nodes = 64
        {ALL}
        "
    ));
    // Each once, and one field for the one term.
    assert_eq!(record.fields.len(), OutputField::ALL.len(), "{:?}", record.fields);
    assert!(record.fields.contains(&"energy_density_bending".to_owned()), "{:?}", record.fields);
    assert!(record.diagnostics.is_empty());
    assert_eq!(record.frames.len(), 3);
    for frame in &record.frames {
        let radius = frame.length / TAU;
        let at = |name| field(&record, frame, name);
        assert_all(at(OutputField::NormalForce), 0.5 / radius.powi(3), 1e-6);
        assert_all(at(OutputField::TangentialVelocity), 0.0, 1e-6);
        assert_all(at(OutputField::ExcessDensity), -0.5 / (radius * radius), 1e-6);
        assert_all(at(OutputField::MembraneFlux), 0.0, 1e-6);
        assert_all(at(OutputField::EnergyDensity), 0.5 / (radius * radius), 1e-6);
    }
}

/// A pressure p is the force p, also where it moves nothing.
#[test]
fn the_pressure_on_an_area_that_is_kept_is_in_the_force() {
    for mobility in ["identity", "area-preserving", "incompressible-area-preserving", "surface-diffusion"] {
        let text = format!(
            "
            curve = {{ shape = 'ellipse', semi_axes = [1.3, 1.0] }}
            energy = {{ bending.rigidity = 1.0, area.pressure = 7.0 }}
            flow.normal_mobility = '{mobility}'
            time.end = 1e-3
            accuracy.nodes = 64
            output = {{ frames = 2, fields = ['normal-force'] }}
            "
        );
        let scene = Scene::parse(&text, "test.toml").unwrap();
        for frame in &record(&text).frames {
            let expected = evaluate(&scene, &frame.curvature, &frame.metric, &[]).unwrap();
            for (force, expected) in frame.fields[0].iter().zip(&expected.normal_force) {
                assert!((force - expected).abs() < 1e-9, "{mobility}: {force}, not {expected}");
            }
            assert!((frame.energy - expected.energy).abs() < 1e-9, "{mobility}");
        }
    }
}

/// The ways to place nodes, as tables of a scene.
const GAUGES: [&str; 3] = [
    "flow.gauge = 'scaled-arc-length'",
    "flow = { gauge = 'graded', grading = '1 + 0.4*cos(2*pi*s)' }",
    "flow = { gauge = 'co-moving', grading = '1 + 0.4*cos(2*pi*s)' }",
];

/// Local terms of every kind; functions of the length and of the positions are not local.
#[test]
fn the_energy_density_integrates_to_the_local_terms() {
    for gauge in GAUGES {
        assert_density_integrates(gauge);
    }
}

fn assert_density_integrates(gauge: &str) {
    let record = record(&format!(
        "
        {gauge}
        curve.shape = 'trillium'
        density = [{{ name = 'protein', initial = '0.5 + 0.1*cos(4*pi*s)', mobility = 'diffusion' }}]
        energy.bending.rigidity = 0.7
        energy.regularization.delta = 0.1
        energy.local.expression = '0.1*protein_sigma^2 + 0.05*kappa_sigma^2*protein + protein^2'
        energy.length = {{ penalty = 3.0, target_ratio = 1.1 }}
        energy.area.pressure = 0.2
        time = {{ end = 1e-3, stop_at_equilibrium = false }}
        accuracy.nodes = 512
        {ALL}
        "
    ));
    for frame in &record.frames {
        let density = field(&record, frame, OutputField::EnergyDensity);
        let total = integral(frame, density.iter().copied());
        let terms = record.energy_terms.iter().zip(&frame.energy_terms);
        let local: f64 = terms
            .filter(|(name, _)| !["length", "area"].contains(&name.as_str()))
            .map(|(_, energy)| energy)
            .sum();
        // What the nodes leave of the trillium at the shortest waves is in the energy but not in its density.
        assert!((total / local - 1.0).abs() < 1e-6, "{gauge}: {total} ≠ {local}");
    }
}

/// In every gauge and under every mobility.
#[test]
fn the_parts_of_the_terms_add_up() {
    for (gauge, mobility) in
        [("scaled-arc-length", "identity"), ("co-moving", "incompressible"), ("co-moving", "area-preserving")]
    {
        let record = record(&format!(
            "
            curve.shape = 'trillium'
            density = [{{ name = 'protein', initial = '0.5 + 0.1*cos(4*pi*s)', mobility = 'diffusion' }}]
            energy.bending.rigidity = 0.7
            energy.regularization.delta = 0.01
            energy.length = {{ penalty = 3.0, target_ratio = 1.1 }}
            energy.area.pressure = 0.2
            energy.adhesion.kernel = 'exp(-4*q)'
            flow = {{ gauge = '{gauge}', normal_mobility = '{mobility}' }}
            time = {{ end = 1e-3, stop_at_equilibrium = false }}
            accuracy.nodes = 256
            {ALL}
            "
        ));
        let parts = |frame: &Frame, prefix: &str| -> Vec<f64> {
            let named = record.fields.iter().zip(&frame.fields).filter(|(name, _)| name.starts_with(prefix));
            let mut sum = vec![0.0; record.nodes()];
            for (_, values) in named {
                sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
            sum
        };
        assert_eq!(record.fields.iter().filter(|name| name.starts_with("normal_velocity_")).count(), 5);
        assert_eq!(record.fields.iter().filter(|name| name.starts_with("energy_density_")).count(), 2);
        for frame in &record.frames {
            let largest = frame.normal_velocity.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
            for (sum, v) in parts(frame, "normal_velocity_").iter().zip(&frame.normal_velocity) {
                assert!((sum - v).abs() < 1e-9 * largest, "{gauge}, {mobility}: {sum} ≠ {v}");
            }
            let density = field(&record, frame, OutputField::EnergyDensity);
            for (sum, e) in parts(frame, "energy_density_").iter().zip(density) {
                assert!((sum - e).abs() <= 1e-12 * e.abs(), "{gauge}, {mobility}: {sum} ≠ {e}");
            }
        }
    }
}

/// ρ = 1 on a circle is ε/(2R²) above the manifold, and V = 1/(2R³), where 𝓘V̂ = 0.
#[test]
fn a_membrane_knows_its_distance_from_the_incompressible_one() {
    let (radius, epsilon) = (1.3_f64, 0.02);
    let text = format!(
        "
        curve = {{ shape = 'circle', radius = {radius:?} }}
        density = [{{ name = 'membrane', initial = 1.0, mobility = 'diffusion' }}]
        energy.bending.rigidity = 1.0
        energy.membrane = {{ density = 'membrane', epsilon = {epsilon:?} }}
        time.end = 0.1
        "
    );
    let record = record(&(text.clone() + "accuracy.nodes = 64\n"));
    assert_eq!(record.diagnostics, ["incompressible_distance", "velocity_residual"]);
    let [distance, residual] = record.frames[0].diagnostics[..] else { panic!("two values") };
    let root = (TAU * radius).sqrt();
    assert!((distance / root - 0.5 * epsilon / (radius * radius)).abs() < 1e-12, "{distance}");
    assert!((residual / root - 0.5 / radius.powi(3)).abs() < 1e-12, "{residual}");
    for other in ["accuracy.nodes = 16\n", "accuracy.nodes = 64\nflow.normal_mobility = 'area-preserving'\n"]
    {
        assert!(self::record(&(text.clone() + other)).diagnostics.is_empty(), "{other}");
    }
    for other in ["'exchange'", "'diffusion', weight = '2'"] {
        let other = text.replace("'diffusion'", other) + "accuracy.nodes = 64\n";
        assert!(self::record(&other).diagnostics.is_empty(), "{other}");
    }
}

/// ‖ρ − 1 − ερ̄‖ is an integral over the arc length wherever the nodes are.
#[test]
fn the_distance_from_the_incompressible_one_is_that_of_the_curve_in_every_gauge() {
    for gauge in GAUGES {
        let record = record(&format!(
            "
            {gauge}
            curve = {{ shape = 'ellipse', semi_axes = [1.4, 0.8] }}
            density = [{{ name = 'membrane', initial = '1 + 0.1*cos(2*pi*s) + 0.1*sin(4*pi*s)', mobility = 'diffusion' }}]
            energy.bending.rigidity = 1.0
            energy.membrane = {{ density = 'membrane', epsilon = 0.05 }}
            time.end = 0.02
            accuracy.nodes = 128
            output = {{ frames = 2, fields = ['excess-density'] }}
            "
        ));
        for frame in &record.frames {
            let excess = field(&record, frame, OutputField::ExcessDensity);
            let off =
                frame.density[0].iter().zip(excess).map(|(rho, excess)| (rho - 1.0 - 0.05 * excess).powi(2));
            let distance = integral(frame, off).sqrt();
            assert!((frame.diagnostics[0] / distance - 1.0).abs() < 1e-10, "{gauge}: {distance}");
        }
        // The state at the start is the same function of the arc length.
        let [distance, residual] = record.frames[0].diagnostics[..] else { panic!("two values") };
        assert!(
            (distance - 0.272_797).abs() < 1e-5 && (residual - 6.160_08).abs() < 1e-3,
            "{gauge}: {distance}, {residual}"
        );
    }
}

/// Whatever points the derivatives work with, and the slopes that an energy needs.
#[test]
fn velocities_and_fluxes_are_at_the_nodes() {
    let frame = |accuracy: &str, slopes: &str| {
        let record = record(&format!(
            "
            curve = {{ shape = 'ellipse', semi_axes = [1.2, 0.9] }}
            energy.bending.rigidity = 1.0
            {slopes}
            energy.length = {{ penalty = 2.0, target_ratio = 1.1 }}
            time = {{ end = 1e-6, stop_at_equilibrium = false }}
            accuracy = {{ {accuracy} }}
            output = {{ frames = 1, fields = ['tangential-velocity', 'membrane-flux'] }}
            "
        ));
        record.frames[0].fields.clone()
    };
    let expected = frame("nodes = 128", "");
    for (accuracy, slopes) in [
        ("nodes = 128", "energy.local.expression = '1e-12*kappa_sigma^2'"),
        ("nodes = 128, derivative = 'central-8'", ""),
        ("nodes = 128, derivative = 'central-8'", "energy.local.expression = '1e-12*kappa_sigma^2'"),
    ] {
        for (values, expected) in frame(accuracy, slopes).iter().zip(&expected) {
            let largest = expected.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
            let error = values.iter().zip(expected).fold(0.0_f64, |error, (a, b)| error.max((a - b).abs()));
            assert!(error < 1e-5 * largest, "{accuracy} {slopes}: {error} of {largest}");
        }
    }
}

#[test]
fn fields_that_need_more_nodes_say_so() {
    let text = "
        curve = { shape = 'circle', radius = 1.0 }
        energy.bending.rigidity = 1.0
        time.end = 0.1
        accuracy.nodes = 16
        output.fields = ['normal-force', 'membrane-flux']
        ";
    let error = run(&Scene::parse(text, "test.toml").unwrap(), &mut Quiet).unwrap_err();
    assert!(matches!(error, SetupError::TooFewNodesForField { nodes: 16, fewest: 21, .. }), "{error}");
    assert!(error.to_string().contains("\"membrane-flux\""), "{error}");
}
