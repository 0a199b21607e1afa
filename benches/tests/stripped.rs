//! The solver for bending alone takes the steps of the core, to the last bit, in the bare loop and in the whole program.

use curveflow_benches::measure::{Steps, generality};

#[test]
fn the_stripped_solver_takes_the_same_steps() {
    for nodes in [64, 96, 256] {
        for steps in [Steps::Implicit, Steps::Exponential] {
            let measured = generality(steps, nodes, 1);
            assert!(measured.steps > 30 && measured.same_bits, "{measured:?}");
        }
    }
}
