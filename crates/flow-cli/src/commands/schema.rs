//! `curveflow schema`: JSON Schema of a scene.

use flow_core::run::Scene;

use crate::error::CliError;
use crate::print;

/// Print the JSON Schema of a scene: for editors that complete and check TOML, and for programs that write scenes.
#[derive(Debug, clap::Args)]
pub struct Args {}

/// Prints the schema.
pub fn execute(_: &Args) -> Result<(), CliError> {
    print::data(&format!("{:#}", Scene::schema()))
}
