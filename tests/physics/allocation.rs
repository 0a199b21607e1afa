//! Steps do not allocate, but for the few in which the method, the linear solver or the nodes change.

use curveflow_tests::shipped;
use flow_core::run::{Quiet, Simulation};

/// The first step, and those after it that are watched.
const WARM_UP: usize = 1;
const STEPS: usize = 120;

/// Steps that allocate. A run may end before all steps are taken, but not before half of them.
fn allocating_steps(name: &str, changes: &[(&str, &str)]) -> u64 {
    let scene = shipped(name, &[&[("accuracy.nodes", "256"), ("output.frames", "1")], changes].concat());
    let mut simulation = Simulation::new(&scene).expect("an initial state");
    for _ in 0..WARM_UP {
        assert!(simulation.step(&mut Quiet));
    }
    let mut total = 0;
    for step in 0..STEPS {
        let mut more = false;
        let info = allocation_counter::measure(|| more = simulation.step(&mut Quiet));
        if !more {
            assert!(2 * step > STEPS, "{name} ends after {step} steps");
            break;
        }
        if info.count_total > 0 {
            println!(
                "{name}, step {}: {} allocations, {} bytes",
                WARM_UP + step,
                info.count_total,
                info.bytes_total
            );
        }
        total += u64::from(info.count_total > 0);
    }
    total
}

#[test]
fn steps_do_not_allocate() {
    // The tolerance keeps the run among the exponential steps.
    assert_eq!(allocating_steps("membrane_penalty", &[("accuracy.tolerance", "1e-9")]), 0);
}

#[test]
fn a_change_of_the_method_or_of_the_solver_allocates_once() {
    // From exponential to implicit steps, and there from the symbol to the band.
    assert_eq!(allocating_steps("three_fold", &[("accuracy.tolerance", "1e-3")]), 2);
}

#[test]
fn steps_with_the_banded_solver_do_not_allocate() {
    // On 2048 nodes the band is on a coarser grid.
    for nodes in ["256", "2048"] {
        let changes = [("accuracy.nodes", nodes), ("accuracy.linear_solver", "banded")];
        assert_eq!(allocating_steps("three_fold", &changes), 0, "{nodes} nodes");
    }
}

#[test]
fn steps_with_an_energy_of_positions_do_not_allocate() {
    // As above, the tolerance keeps the run among the exponential steps.
    assert_eq!(allocating_steps("adhesion", &[("accuracy.tolerance", "1e-8")]), 0);
}

#[test]
fn steps_with_a_cut_off_do_not_allocate() {
    let changes =
        [("energy.adhesion.cutoff", "2.4"), ("energy.area.pressure", "0.3"), ("accuracy.tolerance", "1e-8")];
    assert_eq!(allocating_steps("adhesion", &changes), 0);
}

#[test]
fn steps_on_graded_nodes_do_not_allocate() {
    let graded = [("flow.gauge", "graded"), ("flow.grading", "1 + 0.5*cos(4*pi*s)")];
    assert!(allocating_steps("adhesion", &graded) <= 1, "the band is built once it is needed");
    for solver in ["fourier", "banded"] {
        let changes = [("accuracy.nodes", "256"), ("accuracy.linear_solver", solver)];
        assert_eq!(allocating_steps("three_fold", &[&graded[..], &changes].concat()), 0, "{solver}");
    }
    assert!(allocating_steps("incompressible", &graded) <= 1);
}

#[test]
fn steps_with_co_moving_nodes_do_not_allocate() {
    let moving = [("flow.gauge", "co-moving")];
    for solver in ["fourier", "banded"] {
        let changes = [("accuracy.nodes", "256"), ("accuracy.linear_solver", solver)];
        assert_eq!(allocating_steps("three_fold", &[&moving[..], &changes].concat()), 0, "{solver}");
    }
    assert!(allocating_steps("incompressible", &moving) <= 1);
}

#[test]
fn steps_of_every_mobility_do_not_allocate() {
    for mobility in
        ["incompressible", "area-preserving", "incompressible-area-preserving", "surface-diffusion"]
    {
        let changes = [("flow.normal_mobility", mobility), ("accuracy.tolerance", "1e-8")];
        assert_eq!(allocating_steps("length_penalty", &changes), 0, "{mobility}");
    }
    // Implicit steps take over once.
    for mobility in ["exchange", "none"] {
        let changes = [("accuracy.tolerance", "1e-8"), ("density.protein.mobility", mobility)];
        assert_eq!(allocating_steps("three_fold", &changes), 1, "{mobility}");
    }
    let changes = [("accuracy.tolerance", "1e-8"), ("density.protein.weight", "1 + 0.5*cos(2*pi*s)")];
    assert_eq!(allocating_steps("three_fold", &changes), 1);
}
