//! The energy of a front between two densities.

use curveflow_tests::{assert_close, run, scene};

/// Two straight fronts (the curvature is everywhere the preferred one) of height 𝖯 = ρ₊ − ρ₋ cost (√2/3)𝖯³ each, whatever
/// ε: the heteroclinic ρ₋ + 𝖯(1 + tanh(√2 𝖯z/ε))/2 has equal shares of slope and potential, and
/// ∫ √(2F) dρ = 2√2 ∫ (ρ − ρ₋)(ρ₊ − ρ) dρ.
#[test]
fn a_straight_front_costs_the_cube_of_its_height() {
    for epsilon in [0.1, 0.05, 0.02] {
        for [low, high] in [[0.1, 0.9], [0.3, 0.8]] {
            let height: f64 = high - low;
            let slope = 2f64.sqrt() * height * std::f64::consts::TAU / epsilon;
            let record = run(&scene(&format!(
                "
                curve = {{ shape = 'circle', radius = 1.0 }}
                [[density]]
                name = 'protein'
                mobility = 'diffusion'
                initial = '{low} + {height}*0.5*(tanh({slope}*(s - 0.25)) - tanh({slope}*(s - 0.75)))'
                [energy.agents]
                density = 'protein'
                epsilon = {epsilon}
                delta = 0.2
                preferred_curvature = '1'
                low_density = '{low}'
                high_density = '{high}'
                [time]
                end = 1e-9
                stop_at_equilibrium = false
                [accuracy]
                tolerance = 1e-6
                nodes = 2048
                "
            )));
            assert_close(record.frames[0].energy, 2.0 * 2f64.sqrt() / 3.0 * height.powi(3), 1e-10);
        }
    }
}
