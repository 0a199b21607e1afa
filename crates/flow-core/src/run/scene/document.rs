//! A whole scene: from text to checked values and back.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, Deserializer};

use super::density::MAX_DENSITIES;
use super::error::{Fault, SceneError};
use super::keywords::Entries;
use super::overrides;
use super::report::Report;
use super::section::Section;
use super::shipped::{self, SHIPPED};
use super::{Accuracy, Curve, Density, Energy, Flow, Output, Time};
use crate::flow::MetricRole;

/// Longer texts are not scenes.
pub const MAX_SCENE_BYTES: usize = 1 << 20;

/// A scene that has been checked: everything that a run needs to know.
///
/// Its values may be changed: a run checks them anew, as [`Scene::checked`] does, and its record holds the scene as it was run.
///
/// ```
/// use flow_core::run::Scene;
/// use flow_core::run::scene::{Nodes, Shape};
///
/// let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
/// let changes = [("curve.radius".to_owned(), "2.0".to_owned()), ("accuracy.nodes".to_owned(), "128".to_owned())];
/// let scene = Scene::parse_with(text, "circle", &changes)?;
/// assert_eq!(scene.curve.shape, Shape::Circle { radius: 2.0 });
/// assert_eq!(scene.accuracy.nodes, Nodes::Count(128));
///
/// // Written out it has every default, and reads as the same scene.
/// assert!(scene.to_toml().contains("gauge = \"scaled-arc-length\""));
/// assert_eq!(Scene::parse(&scene.to_toml(), "again")?.to_toml(), scene.to_toml());
/// # Ok::<(), flow_core::run::SceneError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(
    title = "A scene of Curveflow",
    description = "A curve, its densities and energy, how it flows and how accurately."
)]
pub struct Scene {
    /// Title; empty unless given.
    #[schemars(default)]
    pub title: String,
    /// Table `[curve]`.
    pub curve: Curve,
    /// Tables `[[density]]`, in the order of the components.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(default, transform = Entries(0, MAX_DENSITIES))]
    pub density: Vec<Density>,
    /// Tables `[energy.*]`.
    pub energy: Energy,
    /// Table `[flow]`.
    #[schemars(default)]
    pub flow: Flow,
    /// Table `[time]`.
    pub time: Time,
    /// Table `[accuracy]`.
    #[schemars(default)]
    pub accuracy: Accuracy,
    /// Table `[output]`.
    #[schemars(default)]
    pub output: Output,
    #[serde(skip)]
    text: String,
    /// The values that were checked, to tell those that were changed since; none in that copy itself.
    #[serde(skip)]
    as_checked: Option<Arc<Scene>>,
}

impl Scene {
    /// Reads a scene from a file.
    /// # Errors
    /// [`SceneError`]: the file cannot be read, or is not a scene.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        Self::read_with(path, &[])
    }

    /// Reads a scene from a file and changes it, as [`Scene::parse_with`] does.
    /// # Errors
    /// [`SceneError`]: the file cannot be read, or is not a scene.
    pub fn read_with(path: impl AsRef<Path>, overrides: &[(String, String)]) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let unreadable = |source| SceneError::Unreadable { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        let file = File::open(path).map_err(unreadable)?;
        file.take(MAX_SCENE_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        let source_name = path.display().to_string();
        check_size(bytes.len(), &source_name)?;
        let text = String::from_utf8(bytes).map_err(|error| SceneError::NotText {
            source_name: source_name.clone(),
            offset: error.utf8_error().valid_up_to(),
        })?;
        Self::parse_with(&text, &source_name, overrides)
    }

    /// Checks the text of a scene; `source_name` is its name in messages, and paths in it start from its folder.
    /// # Errors
    /// [`SceneError`]: the text is not a scene.
    pub fn parse(text: &str, source_name: &str) -> Result<Self, SceneError> {
        Self::parse_with(text, source_name, &[])
    }

    /// Checks the text of a scene after changing some of its values. Each change is a dotted key and a value:
    /// `accuracy.tolerance` and `1e-6`, `density.0.initial` or `density.protein.initial` and `0.5 + 0.1*s`. A value that
    /// is not TOML is taken as text, and an empty one takes the key out. Missing keys and tables are added; later changes win.
    /// # Errors
    /// [`SceneError`]: the text, or what the changes make of it, is not a scene.
    pub fn parse_with(
        text: &str,
        source_name: &str,
        overrides: &[(String, String)],
    ) -> Result<Self, SceneError> {
        check_size(text.len(), source_name)?;
        let parsed =
            DeTable::parse(text).map_err(|error| Report::new(source_name, text, &[]).syntax_error(&error))?;
        let changes = overrides::resolve(parsed.get_ref(), overrides);
        let report = Report::new(source_name, text, &changes);
        let mut document = parsed;
        overrides::apply(document.get_mut(), &changes, &report);
        let scene = read(Section::new(&report, String::new(), 0..0, document.get_ref()));
        match (report.into_error(), scene) {
            (None, Some(scene)) if changes.is_empty() => Ok(scene.with_text(text.to_owned()).sealed()),
            (None, Some(scene)) => Ok(scene.with_text(written_out(document)).sealed()),
            (Some(error), _) => Err(error),
            (None, None) => unreachable!("a scene that cannot be read has a problem"),
        }
    }

    /// The scene itself if it holds what was read; else it is checked as if [`Scene::to_toml`] had been read, which is its
    /// text from then on. What makes a run of a scene begins with this.
    ///
    /// ```
    /// use flow_core::run::Scene;
    /// use flow_core::run::scene::Nodes;
    ///
    /// let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
    /// let mut scene = Scene::parse(text, "circle")?;
    /// scene.accuracy.nodes = Nodes::Count(64);
    /// scene.time.end = f64::NAN;
    /// let error = scene.clone().checked().unwrap_err();
    /// assert_eq!(error.problems()[0].key, "time.end");
    ///
    /// scene.time.end = 0.5;
    /// let scene = scene.checked()?;
    /// assert!(scene.text().contains("nodes = 64"));
    /// # Ok::<(), flow_core::run::SceneError>(())
    /// ```
    /// # Errors
    /// [`SceneError`]: with the changes it is no scene; problems stand at their keys.
    pub fn checked(self) -> Result<Self, SceneError> {
        if self.holds_what_was_read() {
            return Ok(self);
        }
        Self::parse(&self.to_toml(), "the scene as changed").map_err(SceneError::at_keys)
    }

    /// Whether no value was changed since the scene was read.
    pub(super) fn holds_what_was_read(&self) -> bool {
        self.as_checked.as_deref().is_some_and(|read| self.has_values_of(read))
    }

    /// Whether all values, which is all but the text, are those of `other`.
    pub(super) fn has_values_of(&self, other: &Self) -> bool {
        let Self { title, curve, density, energy, flow, time, accuracy, output, text: _, as_checked: _ } =
            self;
        (title, curve, density, energy) == (&other.title, &other.curve, &other.density, &other.energy)
            && (flow, time, accuracy, output) == (&other.flow, &other.time, &other.accuracy, &other.output)
    }

    /// The same scene, with the values that it has now for checked.
    fn sealed(self) -> Self {
        let values = Self { text: String::new(), as_checked: None, ..self.clone() };
        Self { as_checked: Some(Arc::new(values)), ..self }
    }

    /// The same scene after the library has changed values by itself, to such as a run allows though a file might not say them:
    /// it is not checked again.
    pub(crate) fn renewed(self) -> Self {
        let text = self.to_toml();
        self.with_text(text).sealed()
    }

    /// The scene as given: verbatim, or, if values were changed as it was read or in [`Scene::checked`], as TOML with the changes.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The scene as understood: TOML with every default filled in. Parsing it gives the same values.
    ///
    /// # Panics
    /// Never: TOML has all that a scene can hold, changed or not.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("every scene can be written as TOML")
    }

    /// The same scene, as if it had been read from `text`.
    pub(crate) fn with_text(self, text: String) -> Self {
        Self { text, ..self }
    }

    /// The name of the shipped scene that a mistyped `name` may stand for.
    #[must_use]
    pub fn shipped_like(name: &str) -> Option<&'static str> {
        shipped::like(name)
    }

    /// Name and text of each scene that comes with the program.
    #[must_use]
    pub fn shipped() -> &'static [(&'static str, &'static str)] {
        SHIPPED
    }
}

/// A document as TOML; its comments are lost.
fn written_out(document: Spanned<DeTable<'_>>) -> String {
    let table = toml::Table::deserialize(Deserializer::from(document));
    table.expect("all values of a scene have been read").to_string()
}

fn check_size(bytes: usize, source_name: &str) -> Result<(), SceneError> {
    if bytes > MAX_SCENE_BYTES {
        return Err(SceneError::TooLarge { source_name: source_name.to_owned(), limit: MAX_SCENE_BYTES });
    }
    Ok(())
}

/// A weight is a function of the fraction of the arc length, which no node keeps in the co-moving gauge.
fn check_weights(root: &Section<'_>, density: &[Density], flow: &Flow) {
    let gauges = std::iter::once(flow.gauge).chain(flow.switch.iter().map(|switch| switch.gauge));
    let weighted = density.iter().any(|density| density.weight.is_some());
    if weighted && gauges.into_iter().any(|gauge| gauge.metric() == MetricRole::Field) {
        let remedy = "a weight is a function of the fraction of the arc length, which co-moving nodes do not keep: drop \
                      it, or use gauge = \"scaled-arc-length\"";
        root.fault("flow", Fault::Conflict { with: "density.weight", remedy });
    }
}

/// Reads all tables, so that all problems are found; `None` if there is one.
fn read(mut root: Section<'_>) -> Option<Scene> {
    let title = root.get("title").map_or(Some(""), |entry| entry.stored_text());
    let curve = root.required("curve", "[curve] with shape = \"circle\" and radius = 1.0");
    let curve = curve.and_then(|entry| Curve::read(entry.section()?));
    let (density, names) = Density::read_all(root.get("density"), curve.as_ref().and_then(Curve::points));
    let energy = root.required("energy", "[energy.bending] with rigidity = 1.0");
    let energy = energy.and_then(|entry| {
        let energy = Energy::read(entry.section()?, &names.known);
        if energy.is_none() {
            root.fault("energy", Fault::MissingKey { example: "[energy.bending] with rigidity = 1.0" });
        }
        energy
    });
    root.take_back(|problem| names.may_cause(problem));
    let time = root.required("time", "[time] with end = 1.0");
    let time = time.and_then(|entry| Time::read(entry.section()?));
    let end = time.as_ref().map(|time| time.end);
    let flow = root.section("flow").map(|table| Flow::read(table, end)).unwrap_or_default();
    check_weights(&root, density.as_deref().unwrap_or_default(), &flow);
    let accuracy = root.section("accuracy").map(|table| Accuracy::read(table, flow.normal_mobility));
    let accuracy = accuracy.unwrap_or_default();
    let output =
        root.section("output").map_or_else(|| Some(Output::default()), |table| Output::read(table, end));
    root.finish();
    let (title, text) = (title?.to_owned(), String::new());
    Some(Scene {
        title,
        curve: curve?,
        density: density?,
        energy: energy?,
        flow,
        time: time?,
        accuracy,
        output: output?,
        text,
        as_checked: None,
    })
}
