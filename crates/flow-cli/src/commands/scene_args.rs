//! Arguments that name a scene: a file or a shipped one, and changes to it.

use std::path::{Path, PathBuf};

use flow_core::run::{Scene, SetupError};

use crate::error::CliError;

/// Which scene, and what to change in it.
#[derive(Debug, clap::Args)]
pub struct SceneArgs {
    /// Scene file, or the name of a shipped scene (see `curveflow scenes`).
    pub scene: PathBuf,
    /// Change a value of the scene, e.g. `--set accuracy.tolerance=1e-6`; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = key_and_value)]
    pub set: Vec<(String, String)>,
}

impl SceneArgs {
    /// Reads and checks the scene. A file wins over a shipped scene of the same name.
    pub fn read(&self) -> Result<Scene, CliError> {
        let scene = match shipped(&self.scene) {
            Some((name, text)) => Scene::parse_with(text, name, &self.set),
            None => Scene::read_with(&self.scene, &self.set),
        };
        scene.map_err(|error| CliError::InvalidScene(Box::new(error)))
    }

    /// The error of a scene that reads well and makes no initial state.
    pub fn unusable(&self, reason: SetupError) -> CliError {
        CliError::Unusable { scene: self.scene.clone(), reason }
    }

    /// Name for what is made of the scene: the file's name without its ending.
    pub fn stem(&self) -> PathBuf {
        PathBuf::from(self.scene.file_stem().unwrap_or(self.scene.as_os_str()))
    }
}

fn shipped(path: &Path) -> Option<(&'static str, &'static str)> {
    let name = path.to_str().filter(|_| !path.exists())?;
    Scene::shipped().iter().copied().find(|(shipped, _)| *shipped == name)
}

fn key_and_value(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected key=value, e.g. accuracy.tolerance=1e-6")?;
    Ok((key.trim().to_owned(), value.trim().to_owned()))
}
