//! `curveflow run SCENE`: integrate one scene and write its result file.

use std::path::{Path, PathBuf};

use flow_core::output::StorageError;
use flow_core::output::atomic_file::check_writable;
use flow_core::output::checkpoint::{OtherScene, Pair};
use flow_core::run::{Record, Scene, Simulation};

use super::conduct::{Conduct, Outset};
use super::resume;
use super::scene_args::{SceneArgs, without_own_terms};
use super::standing::{Standing, lock};
use crate::error::CliError;

/// Integrate a scene and write its result file.
#[derive(Debug, clap::Args)]
pub struct Args {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Result file to write [default: the scene's name with .h5, in the current folder].
    #[arg(short, long, value_name = "OUT.h5")]
    pub output: Option<PathBuf>,
    /// Replace an existing result file, and the checkpoints of a run that was stopped.
    #[arg(long, conflicts_with = "resume")]
    pub replace: bool,
    /// Go on where a run of the same scene was stopped; start if there was none, and do nothing if it is done. Of the scene, only
    /// `time.max_steps` may have changed.
    #[arg(long)]
    pub resume: bool,
    #[command(flatten)]
    pub conduct: Conduct,
}

/// Runs the scene. What was computed is written also if the run fails or is stopped.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let outset = Outset::now()?;
    let scene = args.scene.read()?;
    let output = args.output.clone().unwrap_or_else(|| args.scene.named(".h5"));
    let mut pair = Pair::beside(&output);
    if args.resume {
        return go_on(args, outset, &scene, output, pair);
    }
    if let Err(error) = check_writable(&output, args.replace) {
        if matches!(error, StorageError::Exists { .. }) {
            // That a run can go on is better news than that a file is in the way.
            let _lock = lock(&output)?;
            pair.start_anew(false)?;
        }
        return Err(error.into());
    }
    let _lock = lock(&output)?;
    pair.start_anew(args.replace)?;
    args.conduct.run(outset, simulation(args, &scene)?, pair, args.replace)
}

fn simulation(args: &Args, scene: &Scene) -> Result<Simulation, CliError> {
    Simulation::new(scene).map_err(|error| args.scene.unusable(error))
}

fn go_on(
    args: &Args,
    outset: Outset,
    scene: &Scene,
    output: PathBuf,
    mut pair: Pair,
) -> Result<(), CliError> {
    match Standing::of(&mut pair)? {
        Standing::Stopped(mut found, _lock) => {
            let taken = found.checkpoint.take_scene(scene);
            taken.map_err(|OtherScene { key }| CliError::OtherScene { output, key })?;
            resume::go_on(&args.conduct, outset, *found, pair)
        }
        Standing::Over(record) => {
            check_same(&record, scene, &output)?;
            resume::already_done(&args.conduct, &without_own_terms(*record, &output)?, &output)
        }
        Standing::Nothing(_lock) => {
            check_writable(&output, false)?;
            args.conduct.run(outset, simulation(args, scene)?, pair, false)
        }
    }
}

/// Fails if the record in the file `output` is of another scene than `scene`.
fn check_same(record: &Record, scene: &Scene, output: &Path) -> Result<(), CliError> {
    let other = |key| CliError::OtherScene { output: output.to_path_buf(), key };
    let theirs = Scene::parse(&record.resolved_scene, "the scene of the result").map_err(|_| other(None))?;
    theirs.first_difference(scene).map_or(Ok(()), |key| Err(other(Some(key))))
}
