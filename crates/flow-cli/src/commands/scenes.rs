//! `curveflow scenes`: list and print the shipped scenes.

use flow_core::run::Scene;

use crate::error::CliError;
use crate::print;

/// List the shipped scenes, or print one.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// Scene to print, as a start for one's own.
    pub name: Option<String>,
}

/// Prints the names with their titles, or the text of one.
pub fn execute(args: &Args) -> Result<(), CliError> {
    let scenes = Scene::shipped();
    let Some(name) = &args.name else {
        let width = scenes.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        for (name, text) in scenes {
            let title = Scene::parse(text, name).map(|scene| scene.title).unwrap_or_default();
            print::data(&format!("{name:width$}  {title}"))?;
        }
        return Ok(());
    };
    let found = scenes.iter().find(|(shipped, _)| shipped == name);
    let (_, text) = found.ok_or_else(|| CliError::Usage {
        message: format!(
            "no shipped scene is called `{name}`; {}there are {}",
            Scene::shipped_like(name).map(|near| format!("did you mean `{near}`? ")).unwrap_or_default(),
            scenes.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
        ),
    })?;
    print::data(text.trim_end())
}
