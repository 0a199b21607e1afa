//! Scenes whose points are in another file, with the points in the scene instead.

use super::curve::{Curve, Shape};
use super::document::Scene;
use super::error::SceneError;

impl Scene {
    /// The same scene with points that were read from a file standing in it: it does not change with the file, and goes anywhere.
    /// `source_name` is its name in messages.
    ///
    /// # Errors
    /// [`SceneError`] if so many points make the text too large, or as [`Scene::checked`] does.
    pub fn self_contained(&self, source_name: &str) -> Result<Self, SceneError> {
        let scene = self.clone().checked()?;
        if names_a_file(scene.text()) {
            with_points(scene.text(), &scene.curve, source_name)
        } else {
            Ok(scene)
        }
    }

    /// Whether the points of its curve stand in its text, or will, once it is checked.
    #[must_use]
    pub fn holds_points(&self) -> bool {
        let written = !self.holds_what_was_read() || !names_a_file(self.text());
        matches!(self.curve.shape, Shape::Points { .. }) && written
    }
}

/// The scene of `text` with the points of `curve` in place of a file.
pub fn with_points(text: &str, curve: &Curve, source_name: &str) -> Result<Scene, SceneError> {
    let Curve { shape: Shape::Points { points }, turning_number } = curve else {
        return Scene::parse(text, source_name);
    };
    let table = format!("{{ shape = \"points\", turning_number = {turning_number}, points = {points:?} }}");
    Scene::parse_with(text, source_name, &[("curve".to_owned(), table)])
}

/// Whether the points of the curve are in another file.
pub fn names_a_file(text: &str) -> bool {
    let table: Option<toml::Table> = text.parse().ok();
    table.is_some_and(|table| table.get("curve").is_some_and(|curve| curve.get("file").is_some()))
}
