//! Changes to a scene from the command line.

use flow_core::run::Scene;

use super::{check_message, short_run};

const SCENE: &str = "
curve = { shape = 'circle', radius = 1.0 }
energy.bending.rigidity = 1.0
time.end = 1.0
accuracy.tolerance = 1e-3
[[density]]
name = 'protein'
initial = 0.5
mobility = 'diffusion'
";

/// Applies each line, `key=value`, to a small scene.
///
/// # Panics
/// If the text of the scene that comes of it is another one.
pub fn overrides(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let changes: Vec<(String, String)> = text
        .lines()
        .filter_map(|line| line.split_once('='))
        .map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()))
        .collect();
    match Scene::parse_with(SCENE, "scene.toml", &changes) {
        Err(error) => check_message(&error),
        Ok(scene) => {
            let again = Scene::parse(scene.text(), "scene.toml");
            assert!(again.is_ok_and(|again| again == scene), "its text is another scene:\n{}", scene.text());
            short_run(scene);
        }
    }
}
