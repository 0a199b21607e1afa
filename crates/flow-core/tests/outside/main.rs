//! An energy, a normal mobility, a density mobility and a gauge from outside the library, through its public interface alone:
//! each is one file's worth of code, and a flow of them obeys the laws.

mod derivatives;
mod gauge;
mod oscillator;
mod parts;
mod refusal;
mod simulation;
mod slopes;
mod stiff_length;
mod undeclared;
mod uniform;
mod waves;

use std::sync::Arc;

use flow_core::energies::{Bending, EnergyTerm, Length, Membrane as Compression};
use flow_core::flow::{CoMoving, EnergySum, Exchange, FlowMap, Gauge, GradientFlow, LinearSolver};
use flow_core::geometry::shapes::Shape;
use flow_core::geometry::{Closure, Complex64, Grading, Layout, PeriodicGrid, SpectralLayout};
use flow_core::integrator::{Adaptive, AdaptiveOptions, Bdf, Counters, DISSIPATED, Finish, Problem};
use flow_core::operators::{Derivative, DerivativeFamily};
use flow_core::run::Membrane;

use gauge::Partly;
use parts::{Drag, Quartic, SlowExchange};

const NODES: usize = 96;
const END: f64 = 0.05;

fn grading() -> Grading {
    let samples: Vec<f64> = (0..2 * NODES)
        .map(|i| (0.4 * (std::f64::consts::TAU * i as f64 / (2 * NODES) as f64).cos()).exp())
        .collect();
    Grading::new(&samples).expect("resolved")
}

/// The flow of everything from outside, in `gauge`.
fn flow(gauge: Arc<dyn Gauge>, family: DerivativeFamily) -> GradientFlow {
    let layout = Layout::new(NODES, 1).with_metric();
    let grid = PeriodicGrid::new(NODES);
    let derivative = Derivative::graded(family, &grid, Some(Arc::new(grading())));
    let terms: Vec<Box<dyn EnergyTerm>> = vec![
        Box::new(Quartic(0.3)),
        Box::new(Bending::new(0.5)),
        Box::new(Length::Tension(0.2)),
        Box::new(Compression::new(0, 0.5)),
    ];
    let energy = EnergySum::new(terms, layout, &grid, &derivative);
    let exchange = SlowExchange { speed: 0.3, exchange: Exchange::new(&grid, &derivative) };
    let map = FlowMap::in_gauge(gauge, layout, &grid, &derivative);
    GradientFlow::new(map, energy, layout, Box::new(Drag::default()), vec![Box::new(exchange)])
}

/// An ellipse with an uneven density: nodal state and spectral state.
fn start() -> (Vec<f64>, Vec<f64>) {
    let grading = grading();
    let curve = Shape::Ellipse { semi_axes: [1.4, 0.8] }.resample_graded(&grading).expect("a smooth curve");
    let layout = Layout::new(NODES, 1).with_metric();
    let density = grading.fractions().iter().map(|x| 1.0 + 0.2 * (std::f64::consts::TAU * x).sin()).collect();
    let mut nodal = layout.assemble(&curve.curvature, &[density], curve.length);
    grading.weigh(&mut nodal[..layout.length_index()]);
    let spectral = SpectralLayout::new(layout);
    let (mut state, mut grid) = (vec![0.0; spectral.len()], PeriodicGrid::new(NODES));
    spectral.encode(&mut grid, &nodal, &mut state);
    let turning = &mut spectral.spectra_mut(&mut state)[..spectral.modes()];
    let mut closure = Closure::graded(NODES, Some(Arc::new(grading)));
    closure.project(turning, curve.length, 1, curve.angle).expect("a curve that closes");
    spectral.decode(&mut grid, &state, &mut vec![Complex64::default(); spectral.modes()], &mut nodal);
    (nodal, state)
}

fn pair(a: &[f64], b: &[f64]) -> f64 {
    let last = a.len() - 1;
    a[..last].iter().zip(&b[..last]).map(|(a, b)| a * b).sum::<f64>() / NODES as f64 + a[last] * b[last]
}

#[test]
fn the_energy_falls_at_the_rate_of_the_dissipation() {
    let (y, _) = start();
    for family in DerivativeFamily::ALL {
        for part in [0.0, 0.5, 1.0] {
            let mut flow = flow(Arc::new(Partly(part)), family);
            let [mut gradient, mut rate] = [(); 2].map(|()| vec![0.0; y.len()]);
            flow.gradient_at(&y, &mut gradient);
            let told = flow.rate(&y, &mut rate);
            let measured = pair(&gradient, &rate);
            let norms = (pair(&gradient, &gradient) * pair(&rate, &rate)).sqrt();
            let error = (measured + told.dissipation).abs();
            assert!(
                error <= 1e-11 * told.dissipation + 1e-14 * norms,
                "{part}, {family:?}: {measured} ≠ −{told:?}"
            );
            assert!(told.dissipation > 0.0);
        }
    }
}

/// α = 1 keeps the fractions of the arc length: every node stretches as the whole curve does.
#[test]
fn the_gauge_does_what_it_says() {
    let (y, _) = start();
    let layout = Layout::new(NODES, 1).with_metric();
    let metric = layout.field(layout.metric().expect("a metric"));
    let mut rate = vec![0.0; y.len()];
    flow(Arc::new(Partly(1.0)), DerivativeFamily::Fourier).rate(&y, &mut rate);
    let stretch = rate[layout.length_index()] / y[layout.length_index()];
    for (g_t, g) in rate[metric.clone()].iter().zip(&y[metric]) {
        assert!((g_t / g - stretch).abs() < 1e-11 * rate[layout.length_index()].abs().max(1.0));
    }
}

/// Energy at the end, and how far energy and dissipation are out of balance.
fn run(gauge: Arc<dyn Gauge>) -> (f64, f64, u64) {
    let (_, mut state) = start();
    let flow = flow(gauge, DerivativeFamily::Fourier);
    let mut problem = Membrane::new(flow, LinearSolver::Auto, 1, 0.0);
    let Finish::Good { energy: first, integral_rates, .. } = problem.finish(0.0, &mut state) else {
        panic!("a start that is finite");
    };
    let (tolerance, mut counters) = (1e-7, Counters::default());
    let stepper = Bdf::new(&mut problem, &state, integral_rates, tolerance, &mut counters);
    let options = AdaptiveOptions {
        end: END,
        most_steps: 10_000,
        energy_tolerance: 1e-2 * tolerance,
        doubts_gradients: true,
    };
    let mut steps = Adaptive::new(stepper, options, first, counters);
    let (mut energy, mut time) = (first, 0.0);
    while time < END {
        let report = steps.step(&mut problem).expect("a step");
        assert!(report.energy <= energy + 1e-13 * first, "the energy rises at {time}");
        (energy, time) = (report.energy, report.time);
    }
    (energy, (energy - first + steps.integrals()[DISSIPATED]) / first, steps.counters().steps)
}

#[test]
fn a_run_keeps_the_balance_and_does_not_see_the_gauge() {
    let (expected, balance, steps) = run(Arc::new(CoMoving));
    println!("co-moving: {expected}, {balance:.1e}, {steps} steps");
    assert!(balance.abs() < 1e-6);
    for part in [0.3, 1.0] {
        let (energy, balance, steps) = run(Arc::new(Partly(part)));
        println!("{part}: {energy}, {balance:.1e}, {steps} steps");
        assert!((energy / expected - 1.0).abs() < 1e-6, "{part}: {energy} ≠ {expected}");
        assert!(balance.abs() < 1e-6, "{part}: {balance:.1e}");
    }
}
