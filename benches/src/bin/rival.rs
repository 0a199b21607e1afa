//! One method on one shipped scene, for `benches/peers`; prints one JSON object.
//!
//! `rival METHOD SCENE NODES TOLERANCE SECONDS TIME…`: the state and the processor time at each `TIME` that is reached within
//! `SECONDS`; each is a run of its own, repeated while it is short.

use std::error::Error;

use curveflow_benches::measure::{Case, Method};
use serde_json::{Value, json};

/// Runs are repeated until they add up to so many seconds, the resolution of the clock being a few milliseconds.
const REPEATED: f64 = 0.2;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [method, scene, nodes, tolerance, limit, times @ ..] = arguments.as_slice() else {
        return Err("usage: rival METHOD SCENE NODES TOLERANCE SECONDS TIME…".into());
    };
    let method = Method::ALL.into_iter().find(|one| one.name() == method).ok_or("no such method")?;
    let case = Case { scene: scene.clone().leak(), nodes: nodes.parse()?, derivative: "fourier" };
    let times = times.iter().map(|time| time.parse()).collect::<Result<Vec<f64>, _>>()?;
    println!("{}", report(method, case, tolerance.parse()?, limit.parse()?, &times));
    Ok(())
}

/// Stops at the first time that is not reached.
fn report(method: Method, case: Case, tolerance: f64, limit: f64, times: &[f64]) -> Value {
    let (mut seconds, mut states, mut counts) = (Vec::new(), Vec::new(), Value::Null);
    for time in times {
        let run = method.run(case, "auto", tolerance, *time, limit);
        if run.unfinished.is_some() {
            return json!({ "seconds": seconds, "states": states, "reached": run.time });
        }
        counts = json!({ "steps": run.counters.steps, "right-hand sides": run.counters.right_hand_sides });
        seconds.push(mean_seconds(run.seconds, || method.run(case, "auto", tolerance, *time, limit).seconds));
        states.push(run.state);
    }
    json!({ "seconds": seconds, "states": states, "counts": counts })
}

fn mean_seconds(first: f64, again: impl Fn() -> f64) -> f64 {
    let (mut total, mut runs) = (first, 1.0);
    while total < REPEATED {
        total += again();
        runs += 1.0;
    }
    total / runs
}
