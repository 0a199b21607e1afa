//! Arguments that name a scene: a file, a shipped one, or that of a result, and changes to it.

use std::path::{Path, PathBuf};

use flow_core::output::hdf5_file;
use flow_core::run::{Provenance, Record, Scene, SceneError, SetupError};

use crate::error::CliError;
use crate::print;

/// Which scene, and what to change in it.
#[derive(Debug, clap::Args)]
pub struct SceneArgs {
    /// Scene file, or the name of a shipped scene (see `curveflow scenes`).
    #[arg(required_unless_present = "from")]
    pub scene: Option<PathBuf>,
    /// Take the scene of this result file: on the same machine, the same program gives the same states again.
    #[arg(long, value_name = "RESULT.h5", conflicts_with = "scene")]
    pub from: Option<PathBuf>,
    /// Change a value of the scene, e.g. `--set accuracy.tolerance=1e-6`, or take it out, `--set output.frames=`; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = key_and_value)]
    pub set: Vec<(String, String)>,
}

impl SceneArgs {
    /// Reads and checks the scene. A file wins over a shipped scene of the same name.
    pub fn read(&self) -> Result<Scene, CliError> {
        let scene = match (&self.from, shipped(self.name())) {
            (Some(result), _) => of_result(&without_own_terms(hdf5_file::read(result)?, result)?, &self.set),
            (None, Some((name, text))) => Scene::parse_with(text, name, &self.set),
            (None, None) => Scene::read_with(self.name(), &self.set),
        };
        scene.map_err(|error| CliError::InvalidScene(Box::new(error)))
    }

    /// The error of a scene that reads well and makes no initial state.
    pub fn unusable(&self, reason: SetupError) -> CliError {
        CliError::Unusable { scene: self.name().to_owned(), reason }
    }

    /// Name for what is made of the scene, in the current folder: its own without `.toml`, with `ending` added.
    pub fn named(&self, ending: &str) -> PathBuf {
        let name = self.name().file_name().unwrap_or(self.name().as_os_str());
        with_ending(Path::new(name), &["toml", "h5"], ending)
    }

    /// The scene or result that was named; clap sees to it that one was.
    fn name(&self) -> &Path {
        self.scene.as_deref().or(self.from.as_deref()).unwrap_or(Path::new(""))
    }
}

/// `path` with `ending` added, in place of its extension if that is one of `known`: in `eps_0.1` a dot ends no name.
pub fn with_ending(path: &Path, known: &[&str], ending: &str) -> PathBuf {
    let is_known = path.extension().is_some_and(|extension| known.iter().any(|known| extension == *known));
    let mut name = if is_known { path.with_extension("") } else { path.to_path_buf() }.into_os_string();
    name.push(ending);
    PathBuf::from(name)
}

/// The record of the file `result`, if its scene alone makes it.
pub fn without_own_terms(record: Record, result: &Path) -> Result<Record, CliError> {
    if record.own_terms.is_empty() {
        return Ok(record);
    }
    Err(CliError::OwnTerms { result: result.to_path_buf(), terms: record.own_terms })
}

/// The scene of a result. Says so if another program, or another machine, made it.
fn of_result(record: &Record, set: &[(String, String)]) -> Result<Scene, SceneError> {
    let here = Provenance::here();
    if record.provenance != here {
        let there = &record.provenance;
        print::talk(&format!(
            "the result was made by {there}, this is {here}: expect differences in the last digits"
        ));
    }
    let scene = record.to_scene()?;
    if set.is_empty() { Ok(scene) } else { Scene::parse_with(scene.text(), "the scene of the result", set) }
}

fn shipped(path: &Path) -> Option<(&'static str, &'static str)> {
    let name = path.to_str().filter(|_| !path.exists())?;
    Scene::shipped().iter().copied().find(|(shipped, _)| *shipped == name)
}

fn key_and_value(text: &str) -> Result<(String, String), String> {
    let (key, value) = text.split_once('=').ok_or("expected key=value, e.g. accuracy.tolerance=1e-6")?;
    Ok((key.trim().to_owned(), value.trim().to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_endings_are_taken_off() {
        for (path, named) in [
            ("eps_0.1.toml", "eps_0.1.h5"),
            ("a/my.scene.toml", "a/my.scene.h5"),
            ("eps_0.1", "eps_0.1.h5"),
            ("circle", "circle.h5"),
            (".toml", ".toml.h5"),
        ] {
            assert_eq!(with_ending(Path::new(path), &["toml"], ".h5"), Path::new(named));
        }
    }
}
