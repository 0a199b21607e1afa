//! Records in, arrays out.

use flow_core::output::page::{self, PageError};
use flow_core::output::{StorageError, hdf5_file};
use flow_core::run::{self as core, Frame, Rejections};
use numpy::PyArray3;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Table, Vector, copied, pairs, table, vector};
use crate::error::detached;
use crate::file_path::FilePath;

/// A finished or interrupted run.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct Record {
    pub(crate) core: core::Record,
}

#[pymethods]
impl Record {
    /// Title of the scene.
    #[getter]
    fn title(&self) -> &str {
        &self.core.title
    }

    /// The scene as given.
    #[getter]
    fn scene(&self) -> &str {
        &self.core.scene
    }

    /// The scene with every default and automatic choice filled in.
    #[getter]
    fn resolved_scene(&self) -> &str {
        &self.core.resolved_scene
    }

    /// Short name of the reason why the run stopped.
    #[getter]
    fn status(&self) -> &'static str {
        self.core.stop_reason.name()
    }

    /// One sentence on the reason why the run stopped.
    #[getter]
    fn message(&self) -> &str {
        self.core.stop_reason.message()
    }

    /// What makes the result doubtful.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        core::warnings(&self.core)
    }

    /// Names of the energy terms.
    #[getter]
    fn energy_terms(&self) -> Vec<&str> {
        self.core.energy_terms.iter().map(String::as_str).collect()
    }

    /// Names of the energy terms from outside the scene.
    #[getter]
    fn own_terms(&self) -> Vec<&str> {
        self.core.own_terms.iter().map(String::as_str).collect()
    }

    /// Names of the densities.
    #[getter]
    fn densities(&self) -> Vec<&str> {
        self.core.densities.iter().map(String::as_str).collect()
    }

    /// Names of the fields that the scene asks for.
    #[getter]
    fn fields(&self) -> Vec<&str> {
        self.core.fields.iter().map(String::as_str).collect()
    }

    /// Names of the values per frame that come with a term.
    #[getter]
    fn diagnostics(&self) -> Vec<&str> {
        self.core.diagnostics.iter().map(String::as_str).collect()
    }

    /// Number of frames and of nodes.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.core.frames.len(), self.core.nodes())
    }

    /// A value per frame, by its name.
    fn values<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vector<'py>> {
        let value: fn(&Frame) -> f64 = match name {
            "time" => |frame| frame.time,
            "energy" => |frame| frame.energy,
            "dissipation" => |frame| frame.dissipation,
            "energy_balance" => |frame| frame.energy_balance,
            "remap_error" => |frame| frame.remap_error,
            "length" => |frame| frame.length,
            "area" => |frame| frame.area,
            "closure_defect" => |frame| frame.closure_defect,
            "crossings" => |frame| frame.crossings,
            _ => return Err(unknown(name)),
        };
        Ok(self.per_frame(py, value))
    }

    /// Energy of the term of this number, per frame.
    fn energy_term<'py>(&self, py: Python<'py>, term: usize) -> PyResult<Vector<'py>> {
        check(term, self.core.energy_terms.len())?;
        Ok(self.per_frame(py, |frame| frame.energy_terms[term]))
    }

    /// Mass of the density of this number, per frame.
    fn mass<'py>(&self, py: Python<'py>, density: usize) -> PyResult<Vector<'py>> {
        check(density, self.core.densities.len())?;
        Ok(self.per_frame(py, |frame| frame.mass[density]))
    }

    /// The value of this number among those that come with a term, per frame.
    fn diagnostic<'py>(&self, py: Python<'py>, diagnostic: usize) -> PyResult<Vector<'py>> {
        check(diagnostic, self.core.diagnostics.len())?;
        Ok(self.per_frame(py, |frame| frame.diagnostics[diagnostic]))
    }

    /// A field per frame and node, by its name.
    fn field<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Table<'py>> {
        let field: fn(&Frame) -> &[f64] = match name {
            "curvature" => |frame| &frame.curvature,
            "metric" => |frame| &frame.metric,
            "normal_velocity" => |frame| &frame.normal_velocity,
            _ => return Err(unknown(name)),
        };
        self.per_node(py, field)
    }

    /// Density of this number, per frame and node.
    fn density<'py>(&self, py: Python<'py>, density: usize) -> PyResult<Table<'py>> {
        check(density, self.core.densities.len())?;
        self.per_node(py, |frame| &frame.density[density])
    }

    /// The field of this number among those that the scene asks for, per frame and node.
    fn requested_field<'py>(&self, py: Python<'py>, field: usize) -> PyResult<Table<'py>> {
        check(field, self.core.fields.len())?;
        self.per_node(py, |frame| &frame.fields[field])
    }

    /// Position, per frame and node.
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (frames, nodes) = self.shape();
        let values = py.detach(|| self.flat(2 * nodes, |frame| frame.position.as_flattened()));
        pairs(py, values, frames, nodes)
    }

    /// The log of accepted steps, by name.
    fn steps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (log, steps) = (&self.core.steps, PyDict::new(py));
        steps.set_item("time", copied(py, &log.time))?;
        steps.set_item("size", copied(py, &log.size))?;
        steps.set_item("energy", copied(py, &log.energy))?;
        steps.set_item("dissipation", copied(py, &log.dissipation))?;
        steps.set_item("order", copied(py, &log.order))?;
        steps.set_item("nodes", copied(py, &log.nodes))?;
        for (name, count) in CAUSES {
            let counts: Vec<u64> = log.rejections.iter().map(count).collect();
            steps.set_item(name, vector(py, counts))?;
        }
        Ok(steps)
    }

    /// Counters of work, by name, and the seconds spent.
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (counters, stats) = (&self.core.counters, PyDict::new(py));
        stats.set_item("steps", counters.steps)?;
        for (name, count) in CAUSES {
            stats.set_item(name, count(&counters.rejections))?;
        }
        stats.set_item("right_hand_sides", counters.right_hand_sides)?;
        stats.set_item("jacobian_products", counters.jacobian_products)?;
        stats.set_item("newton_iterations", counters.newton_iterations)?;
        stats.set_item("krylov_iterations", counters.krylov_iterations)?;
        stats.set_item("factorisations", counters.factorisations)?;
        stats.set_item("solves", counters.solves)?;
        stats.set_item("remaps", counters.remaps)?;
        stats.set_item("unresolved_steps", counters.unresolved_steps)?;
        stats.set_item("integration_seconds", counters.integration_seconds)?;
        for (name, seconds) in self.core.seconds.by_activity() {
            stats.set_item(format!("seconds_{name}"), seconds)?;
        }
        Ok(stats)
    }

    /// What limits the run: its name, a sentence, one thing to try, all as text, the Krylov iterations of a solve, and the
    /// seconds by activity and by part of the evaluations, largest first.
    fn why_slow(&self) -> WhySlow {
        let why = core::WhySlow::of(&self.core);
        let text = why.to_string();
        let seconds = |shares: Vec<core::Share>| {
            shares.into_iter().map(|share| (share.name, share.seconds)).collect::<Vec<_>>()
        };
        (
            why.limit.name(),
            why.sentence,
            why.advice,
            text,
            why.krylov_iterations_per_solve,
            seconds(why.activities),
            seconds(why.evaluations),
        )
    }

    /// The run at a glance, as HTML.
    fn card(&self) -> String {
        page::card(&self.core)
    }

    /// Writes a result file.
    fn save(&self, py: Python<'_>, path: FilePath, replace: bool) -> PyResult<()> {
        detached::<_, StorageError>(py, || hdf5_file::write(&self.core, &path.0, replace))
    }

    /// Writes a page for the browser.
    fn view(&self, py: Python<'_>, path: FilePath, replace: bool) -> PyResult<()> {
        detached::<_, PageError>(py, || page::view(&self.core, &path.0, replace))
    }
}

impl Record {
    /// Wraps a record.
    pub fn new(core: core::Record) -> Self {
        Self { core }
    }

    fn per_frame<'py>(&self, py: Python<'py>, value: impl Fn(&Frame) -> f64) -> Vector<'py> {
        vector(py, self.core.frames.iter().map(value).collect())
    }

    fn per_node<'py>(
        &self,
        py: Python<'py>,
        field: impl Fn(&Frame) -> &[f64] + Send,
    ) -> PyResult<Table<'py>> {
        let (frames, nodes) = self.shape();
        table(py, py.detach(|| self.flat(nodes, field)), frames, nodes)
    }

    /// The rows of a field, one after the other, in the buffer that an array takes over: frames come one by one, at times
    /// on other numbers of nodes, so a table over all of them is written once the run is over, and only once.
    fn flat(&self, row: usize, field: impl Fn(&Frame) -> &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(row * self.core.frames.len());
        for frame in &self.core.frames {
            values.extend_from_slice(field(frame));
        }
        values
    }
}

/// What [`Record::why_slow`] tells.
type WhySlow = (&'static str, String, String, String, f64, Vec<(String, f64)>, Vec<(String, f64)>);

/// Reads one count.
type Count = fn(&Rejections) -> u64;

/// Rejections by cause, named as in the attributes of a result file.
const CAUSES: [(&str, Count); 4] = [
    ("rejections_error", |rejections| rejections.error),
    ("rejections_solver", |rejections| rejections.solver),
    ("rejections_energy_rise", |rejections| rejections.energy_rise),
    ("rejections_not_finite", |rejections| rejections.not_finite),
];

#[cold]
fn unknown(name: &str) -> PyErr {
    PyKeyError::new_err(name.to_owned())
}

fn check(number: usize, count: usize) -> PyResult<()> {
    if number < count { Ok(()) } else { Err(unknown(&number.to_string())) }
}
