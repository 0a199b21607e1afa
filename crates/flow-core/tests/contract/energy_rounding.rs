//! The rounding of the energy, (I9), and its derivative along a direction, (I6).

use flow_core::flow::LinearSolver;
use flow_core::integrator::{Clocked, DISSIPATED, Finish, Problem, Stopwatch};
use flow_core::run::Membrane;

use crate::states::{fixed_blob, spectral};
use crate::terms::{every_flow, flow};

/// 2⁻⁵² Σ|∂𝓕/∂yᵢ|‖y‖ at the state evaluated last, sum by sum.
fn plain_sum(membrane: &mut Membrane, y: &[f64]) -> f64 {
    let flow = membrane.flow();
    let layout = flow.spectral_layout();
    let modes = layout.modes();
    let mut sum = (flow.gradient().by_length * y[layout.length_index()]).abs();
    for field in 0..flow.layout().state_fields() {
        let (mut slopes, mut square) = (0.0, 0.0);
        for mode in 0..modes {
            let place = field * modes + mode;
            slopes += flow.multiplicity(mode) * flow.gradient().spectra[place].norm();
            square += flow.multiplicity(mode) * layout.spectra(y)[place].norm_sqr();
        }
        sum += slopes * square.sqrt();
    }
    f64::EPSILON * sum
}

/// Odd and even numbers of nodes: with and without a sawtooth.
#[test]
fn the_rounding_of_the_energy_is_its_sum_and_clocks_pass_it_on() {
    for nodes in [32, 33] {
        for (term, family) in every_flow() {
            let state = fixed_blob().state(nodes, term.densities());
            let mut membrane = Membrane::new(flow(term, family, state.layout), LinearSolver::Auto, 1, 0.0);
            let mut y = spectral(state.layout, &state.y);
            assert!(matches!(membrane.finish(0.0, &mut y), Finish::Good { .. }), "{term:?}, {family:?}");
            let expected = plain_sum(&mut membrane, &y);
            let rounding = membrane.energy_rounding(&y);
            assert!(expected > 0.0 && (rounding / expected - 1.0).abs() < 1e-12, "{term:?}, {family:?}");
            let mut watch = Stopwatch::default();
            let clocked = Clocked::new(&mut membrane, &mut watch).energy_rounding(&y);
            assert_eq!(clocked.to_bits(), rounding.to_bits());
        }
    }
}

#[test]
fn along_its_rate_the_energy_falls_by_the_dissipation_and_clocks_pass_that_on() {
    for nodes in [32, 33] {
        for (term, family) in every_flow() {
            let state = fixed_blob().state(nodes, term.densities());
            let mut membrane = Membrane::new(flow(term, family, state.layout), LinearSolver::Auto, 1, 0.0);
            let mut y = spectral(state.layout, &state.y);
            let Finish::Good { integral_rates, .. } = membrane.finish(0.0, &mut y) else {
                panic!("{term:?}, {family:?}")
            };
            let dissipation = integral_rates[DISSIPATED];
            let mut rate = vec![0.0; y.len()];
            membrane.finished_rate(&y, &mut rate);
            let slope = membrane.energy_slope(&rate).unwrap();
            assert!(
                (slope / dissipation + 1.0).abs() < 1e-10,
                "{term:?}, {family:?}: {slope}, {dissipation}"
            );
            let mut watch = Stopwatch::default();
            let mut clocked = Clocked::new(&mut membrane, &mut watch);
            assert_eq!(clocked.energy_slope(&rate).unwrap().to_bits(), slope.to_bits());
            assert_eq!(clocked.is_gradient_exact(&y), Some(true), "{term:?}, {family:?}");
        }
    }
}
