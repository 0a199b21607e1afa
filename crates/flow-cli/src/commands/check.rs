//! `curveflow check SCENE`: validate a scene and predict what it takes; writes nothing.

use std::time::Instant;

use flow_core::run::scene::Nodes;
use flow_core::run::{Prediction, predict};

use super::scene_args::SceneArgs;
use crate::error::CliError;
use crate::print;

/// Validate a scene and predict nodes, memory and cost; writes nothing.
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
    let Prediction { nodes, most_nodes, unknowns, memory_bytes, file_bytes, seconds_per_step, steps } =
        predict(&scene).map_err(|error| args.scene.unusable(error))?;
    if args.json {
        let value = serde_json::json!({
            "nodes": nodes,
            "most_nodes": most_nodes,
            "unknowns": unknowns,
            "memory_bytes": memory_bytes,
            "file_bytes": file_bytes,
            "seconds_per_step": seconds_per_step,
            "steps": steps,
            "seconds": seconds_per_step * steps,
        });
        return print::data(&format!("{value:#}"));
    }
    let mega = |bytes: f64| bytes / 1e6;
    print::data(&format!(
        "the scene is valid\nnodes     {}\nunknowns  {unknowns}\nmemory    {:.1} MB\nfile      at most {:.1} MB\nsteps     \
         about {steps:.0} (rough; fewer if the flow comes to rest)\ntime      about {:.2} s",
        if scene.accuracy.nodes == Nodes::Auto {
            format!("{nodes} at the start, as many as it needs on the way (about {most_nodes} at most)")
        } else {
            nodes.to_string()
        },
        mega(memory_bytes),
        mega(file_bytes),
        seconds_per_step * steps
    ))?;
    print::talk(&format!("(trial steps took {:.2} s)", clock.elapsed().as_secs_f64()));
    Ok(())
}
