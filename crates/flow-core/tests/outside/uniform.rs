//! Runs of a curve without densities on uniform nodes, under terms from outside.

use flow_core::energies::EnergyTerm;
use flow_core::flow::{EnergySum, FlowMap, GradientFlow, Identity, LinearSolver};
use flow_core::geometry::shapes::Shape;
use flow_core::geometry::{Closure, Layout, PeriodicGrid, SpectralLayout};
use flow_core::integrator::{
    Adaptive, AdaptiveOptions, Counters, Finish, INTEGRALS, Integrals, IntegrationError, Multistep, Problem,
    Stepper,
};
use flow_core::operators::{Derivative, DerivativeFamily};
use flow_core::run::Membrane;

pub type Terms = Vec<Box<dyn EnergyTerm>>;

/// How a run ended.
pub struct Outcome {
    pub time: f64,
    pub energy: f64,
    pub counters: Counters,
    pub state: Vec<f64>,
    pub error: Option<IntegrationError>,
}

/// The flow of `terms` and the spectral state of an ellipse.
pub fn start(terms: Terms, semi_axes: [f64; 2], nodes: usize) -> (GradientFlow, Vec<f64>) {
    let (layout, mut grid) = (Layout::new(nodes, 0), PeriodicGrid::new(nodes));
    let derivative = Derivative::new(DerivativeFamily::Fourier, &grid);
    let energy = EnergySum::new(terms, layout, &grid, &derivative);
    let map = FlowMap::new(layout, &grid, &derivative);
    let flow = GradientFlow::new(map, energy, layout, Box::new(Identity), Vec::new());
    let curve = Shape::Ellipse { semi_axes }.resample(nodes).expect("a smooth curve");
    let nodal = layout.assemble(&curve.curvature, &[], curve.length);
    let spectral = SpectralLayout::new(layout);
    let mut state = vec![0.0; spectral.len()];
    spectral.encode(&mut grid, &nodal, &mut state);
    let turning = &mut spectral.spectra_mut(&mut state)[..spectral.modes()];
    Closure::new(nodes).project(turning, curve.length, 1, curve.angle).expect("a curve that closes");
    (flow, state)
}

/// Runs `flow` from `state` to `end` in at most `most_steps` steps.
pub fn run(
    (flow, mut state): (GradientFlow, Vec<f64>),
    solver: LinearSolver,
    tolerance: f64,
    end: f64,
    most_steps: u64,
) -> Outcome {
    let mut problem = Membrane::new(flow, solver, 1, 0.0);
    let Finish::Good { energy, integral_rates, .. } = problem.finish(0.0, &mut state) else {
        panic!("a start that is finite");
    };
    let mut counters = Counters::default();
    let integrals = Integrals::new(0.0, [0.0; INTEGRALS], integral_rates);
    let stepper = Multistep::starting(&mut problem, &state, integrals, tolerance, &mut counters);
    let options =
        AdaptiveOptions { end, most_steps, energy_tolerance: 0.01 * tolerance, doubts_gradients: true };
    let mut steps = Adaptive::new(stepper, options, energy, counters);
    let mut error = None;
    while steps.stepper().time() < end && error.is_none() {
        error = steps.step(&mut problem).err();
    }
    Outcome {
        time: steps.stepper().time(),
        energy: steps.energy(),
        counters: *steps.counters(),
        state: steps.stepper().state().to_vec(),
        error,
    }
}
