//! Scenes: text in, text out.

use flow_core::run;
use flow_core::run::scene::Formula;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::arrays::{Vector, vector};
use crate::error::detached;
use crate::file_path::file_path;
use crate::record::Record;

/// A scene that has been checked.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct Scene {
    pub(crate) core: run::Scene,
    /// Its name in messages; paths in it start from the folder of this name.
    #[pyo3(get)]
    source_name: String,
}

#[pymethods]
impl Scene {
    /// Reads a scene file.
    #[staticmethod]
    fn read(py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path = file_path(path, "SceneError")?;
        let core = detached(py, || run::Scene::read(&path))?;
        Ok(Self { core, source_name: path.display().to_string() })
    }

    /// Checks the text of a scene after writing the changes (key, value) into it.
    #[staticmethod]
    fn parse(
        py: Python<'_>,
        text: &str,
        source_name: String,
        changes: Vec<(String, String)>,
    ) -> PyResult<Self> {
        let core = detached(py, || run::Scene::parse_with(text, &source_name, &changes))?;
        Ok(Self { core, source_name })
    }

    /// Checks a scene whose text a program wrote: messages say keys, not lines.
    #[staticmethod]
    fn parse_written(py: Python<'_>, text: &str, source_name: String) -> PyResult<Self> {
        let core = detached(py, || run::Scene::parse(text, &source_name).map_err(run::SceneError::at_keys))?;
        Ok(Self { core, source_name })
    }

    /// The scene of a record, as it can be run again.
    #[staticmethod]
    fn of_record(py: Python<'_>, record: &Record) -> PyResult<Self> {
        let core = detached(py, || record.core.to_scene())?;
        Ok(Self { core, source_name: "scene".to_owned() })
    }

    /// This scene with points that were read from a file standing in it.
    fn self_contained(&self, py: Python<'_>) -> PyResult<Self> {
        let core = detached(py, || self.core.self_contained(&self.source_name))?;
        Ok(Self { core, source_name: self.source_name.clone() })
    }

    /// Whether its points stand in its text.
    #[getter]
    fn holds_points(&self) -> bool {
        self.core.holds_points()
    }

    /// Title.
    #[getter]
    fn title(&self) -> &str {
        &self.core.title
    }

    /// The scene as given.
    #[getter]
    fn text(&self) -> &str {
        self.core.text()
    }

    /// The scene with every default filled in.
    fn to_toml(&self) -> String {
        self.core.to_toml()
    }

    /// [`Scene::to_toml`] as JSON.
    fn to_json(&self) -> String {
        serde_json::to_string(&self.core).expect("every scene can be written as JSON")
    }

    /// Density of the agents and κ₀ at `density`, ρ₋ and ρ₊ at `curvature`; none without agents.
    #[allow(clippy::type_complexity)] // written once
    fn nodal_lines<'py>(
        &self,
        py: Python<'py>,
        density: PyReadonlyArray1<'py, f64>,
        curvature: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Option<(&str, Vector<'py>, Vector<'py>, Vector<'py>)>> {
        let Some(agents) = &self.core.energy.agents else { return Ok(None) };
        let at = |line: &Formula, value: f64| line.expression().evaluate(&[value]);
        let (density, curvature) = (density.as_slice()?, curvature.as_slice()?);
        let preferred = density.iter().map(|&rho| at(&agents.preferred_curvature, rho)).collect();
        let low = curvature.iter().map(|&kappa| at(&agents.low_density, kappa)).collect();
        let high = curvature.iter().map(|&kappa| at(&agents.high_density, kappa)).collect();
        Ok(Some((&agents.density, vector(py, preferred), vector(py, low), vector(py, high))))
    }
}

/// JSON Schema of a scene, as JSON.
#[pyfunction]
pub fn schema() -> String {
    run::Scene::schema().to_string()
}

/// Name and text of each scene that comes with the package.
#[pyfunction]
pub fn shipped() -> Vec<(&'static str, &'static str)> {
    run::Scene::shipped().to_vec()
}
