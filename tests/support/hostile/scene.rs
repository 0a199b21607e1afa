//! The text of a scene.

use flow_core::run::Scene;

use super::{check_message, short_run};

/// Reads a scene; one that is valid is written out, read again and run for a few steps.
///
/// # Panics
/// If it is another scene when it is read again.
pub fn scene(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Scene::parse(&text, "scene.toml") {
        Err(error) => check_message(&error),
        Ok(scene) => {
            let written = scene.to_toml();
            let again = Scene::parse(&written, "scene.toml").map(|again| again.to_toml());
            assert!(again.is_ok_and(|again| again == written), "written out it is another scene:\n{written}");
            short_run(scene);
        }
    }
}
