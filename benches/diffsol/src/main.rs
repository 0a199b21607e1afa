//! diffsol's BDF with dense LU on the system of a shipped scene; prints one JSON object.
//!
//! `curveflow-diffsol SCENE NODES TOLERANCE SECONDS TIME…`: the state and the processor time at each `TIME` that is reached within
//! `SECONDS`, which count from the building of the solver.

mod equations;

use std::error::Error;

use diffsol::{FaerLU, FaerMat, OdeBuilder, OdeSolverMethod, Vector};
use equations::Equations;
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Value, json};

type M = FaerMat<f64>;

const LEAST_STEP: f64 = 1e-20;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, nodes, tolerance, limit, times @ ..] = arguments.as_slice() else {
        return Err("usage: curveflow-diffsol SCENE NODES TOLERANCE SECONDS TIME…".into());
    };
    let times = times.iter().map(|time| time.parse()).collect::<Result<Vec<f64>, _>>()?;
    let report = solve(&Equations::new(scene, nodes)?, tolerance.parse()?, limit.parse()?, &times)?;
    println!("{report}");
    Ok(())
}

/// Steps through `times`; stops early after `limit` seconds of processor time.
fn solve(equations: &Equations, tolerance: f64, limit: f64, times: &[f64]) -> Result<Value, Box<dyn Error>> {
    let start = processor_seconds();
    let mut problem = OdeBuilder::<M>::new()
        // Each block is held against its own size alone, as in the norm of the program.
        .rtol(1e-15)
        .atol(equations.bounds(tolerance))
        .rhs_implicit(|y, _, _, rate| equations.rate(y, rate), |y, _, _, v, out| equations.product(y, v, out))
        .init(|_, _, y| y.copy_from_slice(&equations.initial), equations.initial.len())
        .build()?;
    // The first step of a stiff scene is shorter than diffsol's least, 1e-13.
    problem.ode_options.min_timestep = LEAST_STEP;
    let mut solver = problem.bdf::<FaerLU<f64>>()?;
    let (mut seconds, mut states) = (Vec::new(), Vec::new());
    for time in times {
        while solver.state().t < *time {
            if processor_seconds() - start > limit {
                return Ok(json!({ "seconds": seconds, "states": states, "reached": solver.state().t }));
            }
            solver.step()?;
        }
        states.push(solver.interpolate(*time)?.clone_as_vec());
        seconds.push(processor_seconds() - start);
    }
    let steps = solver.get_statistics().number_of_steps;
    let counts =
        json!({ "steps": steps, "right-hand sides": equations.rates(), "products": equations.products() });
    Ok(json!({ "seconds": seconds, "states": states, "counts": counts }))
}

/// Processor time of this thread.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
