//! `curveflow check SCENE`: validate a scene and predict what it takes; writes nothing.

use std::time::Instant;

use flow_core::run::scene::Nodes;
use flow_core::run::{Prediction, Scene, StopReason, Trial, predict};

use super::scene_args::SceneArgs;
use super::{idle, room};
use crate::error::CliError;
use crate::print;

/// Validate a scene and predict nodes, memory and cost; writes nothing.
///
/// A trial run tells. It takes about a second, or four where steps are slow; but it takes two steps in any case, and with adhesion on 16384
/// nodes these take about ten seconds, with a dense solver on 4000 nodes a minute. Warnings say what does not fit into the memory of this
/// machine, what a run may not hold, and which terms move nothing.
#[derive(Debug, clap::Args)]
pub struct Args {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
}

/// Prints the prediction.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let scene = args.scene.read()?;
    let clock = Instant::now();
    let prediction = predict(&scene).map_err(|error| args.scene.unusable(error))?;
    if args.json {
        return print::data(&format!("{:#}", json(&prediction, &scene)));
    }
    print::data(&table(&prediction, &scene))?;
    let Trial { tolerance, .. } = prediction.trial;
    print::talk(&format!(
        "(a trial run at tolerance {tolerance:e} took {} s)",
        brief(clock.elapsed().as_secs_f64())
    ));
    Ok(())
}

fn json(prediction: &Prediction, scene: &Scene) -> serde_json::Value {
    let Prediction { steps, integration_seconds, output_seconds, ref trial, .. } = *prediction;
    serde_json::json!({
        "nodes": prediction.nodes,
        "most_nodes": prediction.most_nodes,
        "unknowns": prediction.unknowns,
        "memory_bytes": print::count(prediction.memory_bytes),
        "file_bytes": print::count(prediction.file_bytes),
        "seconds_per_step": integration_seconds / steps.max(1.0),
        "steps": print::count(steps),
        "integration_seconds": integration_seconds,
        "output_seconds": output_seconds,
        "seconds": integration_seconds + output_seconds,
        "warnings": warnings(prediction, scene),
        "trial": {
            "tolerance": trial.tolerance,
            "time": trial.time,
            "stop_reason": trial.stop_reason.as_ref().map(StopReason::name),
            "message": trial.stop_reason.as_ref().map(StopReason::message),
        },
    })
}

fn warnings(prediction: &Prediction, scene: &Scene) -> Vec<String> {
    room::warnings(prediction).into_iter().chain(idle::warnings(prediction, scene)).collect()
}

fn table(prediction: &Prediction, scene: &Scene) -> String {
    let Prediction { nodes, most_nodes, unknowns, memory_bytes, file_bytes, steps, .. } = *prediction;
    let Prediction { integration_seconds, output_seconds, ref trial, .. } = *prediction;
    let nodes = if scene.accuracy.nodes == Nodes::Auto {
        format!("{nodes} at the start, as many as it needs on the way (about {most_nodes} at most)")
    } else {
        nodes.to_string()
    };
    let time = brief(trial.time);
    let until = match &trial.stop_reason {
        Some(StopReason::EndTime) => "to the end time".to_owned(),
        Some(StopReason::Equilibrium) => format!("to equilibrium, near t = {time}"),
        Some(StopReason::Contact) => format!("to a contact, near t = {time}"),
        Some(StopReason::Failed(message)) => format!("to a failure near t = {time}: {message}"),
        _ => "to the end time; fewer if the flow comes to rest before".to_owned(),
    };
    let hedge = match scene.time.max_steps {
        Some(most) if steps > most as f64 => format!("; time.max_steps = {most} ends the run before"),
        _ if trial.tolerance > scene.accuracy.tolerance => {
            format!(" (so at tolerance {:e})", trial.tolerance)
        }
        _ => String::new(),
    };
    let warnings = warnings(prediction, scene)
        .iter()
        .fold(String::new(), |lines, warning| lines + "\nwarning   " + warning);
    format!(
        "the scene is valid\nnodes     {nodes}\nunknowns  {unknowns}\nmemory    about {} MB\nfile      at most {} MB\nsteps     \
         about {}, {until}{hedge}\ntime      about {} s, {} s of it for the steps, {} s for frames and file{warnings}",
        brief(memory_bytes / 1e6),
        brief(file_bytes / 1e6),
        brief(steps),
        brief(integration_seconds + output_seconds),
        brief(integration_seconds),
        brief(output_seconds),
    )
}

/// Two digits that count, as many as a prediction deserves.
fn brief(value: f64) -> String {
    print::significant(value, 2)
}
