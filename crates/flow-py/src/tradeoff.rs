//! Ladders of tolerances: measurements in, arrays out.

use std::time::Duration;

use flow_core::run::tradeoff as core;
use pyo3::exceptions::{PyKeyError, PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{Table, Vector, table, vector};
use crate::error::{detached, raised};
use crate::scene::Scene;
use crate::watcher::{LadderWatcher, Watcher};

/// A measured ladder.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct Tradeoff {
    core: core::Tradeoff,
}

/// Measures a ladder of tolerances, the default one if there are none; watched like a run. `before_run` is called before every
/// run with its name, its tolerance, its number and the number of rungs.
#[pyfunction]
pub fn tradeoff(
    py: Python<'_>,
    scene: &Scene,
    tolerances: Option<Vec<f64>>,
    reference_nodes: Option<usize>,
    before_run: Option<Py<PyAny>>,
    callback: Option<Py<PyAny>>,
    interval: f64,
) -> PyResult<Tradeoff> {
    let interval = Duration::try_from_secs_f64(interval)
        .map_err(|error| PyValueError::new_err(format!("interval = {interval}: {error}")))?;
    let default = core::Ladder::default();
    let tolerances = tolerances.unwrap_or_else(|| default.tolerances().to_vec());
    let ladder = core::Ladder::new(&tolerances, reference_nodes).map_err(|error| raised(py, &error))?;
    let mut watcher = LadderWatcher::new(Watcher::new(callback, interval), before_run);
    let measured = detached(py, || match core::tradeoff(&scene.core, &ladder, &mut watcher) {
        Err(core::TradeoffError::Interrupted) => Ok(None),
        other => other.map(Some),
    });
    match (watcher.raised(py), measured?) {
        (Some(raised), _) => Err(raised),
        (None, Some(core)) => Ok(Tradeoff { core }),
        (None, None) => Err(PyKeyboardInterrupt::new_err(core::TradeoffError::Interrupted.to_string())),
    }
}

#[pymethods]
impl Tradeoff {
    /// Title of the scene.
    #[getter]
    fn title(&self) -> &str {
        &self.core.title
    }

    /// Names of the errors, in the order of the columns of `errors`.
    #[getter]
    fn names(&self) -> Vec<&str> {
        let densities = self.core.densities.iter().map(String::as_str);
        ["curve", "curvature"].into_iter().chain(densities).chain(["energy", "length"]).collect()
    }

    /// Times of comparison, and why the runs end at the second.
    #[getter]
    fn span(&self) -> (f64, f64, &'static str) {
        let span = self.core.span;
        (span.halfway, span.end, span.ending.name())
    }

    /// Tolerance of the reference, whether rounding limits it, its nodes, steps and seconds.
    #[getter]
    fn reference(&self) -> (f64, bool, usize, u64, f64) {
        let reference = self.core.reference;
        (reference.tolerance, reference.at_rounding, reference.nodes, reference.steps, reference.seconds)
    }

    /// Whether the errors hold those of the nodes.
    #[getter]
    fn includes_space(&self) -> bool {
        self.core.includes_space()
    }

    /// Whether the ladder was interrupted.
    #[getter]
    fn interrupted(&self) -> bool {
        self.core.is_interrupted()
    }

    /// Why each run has no result; none where it has one.
    #[getter]
    fn failures(&self) -> Vec<Option<String>> {
        self.core.rows.iter().map(|row| row.outcome.as_ref().err().map(ToString::to_string)).collect()
    }

    /// Index of the quickest run with at most this error.
    fn cheapest(&self, error: f64) -> Option<usize> {
        let (tolerance, _) = self.core.cheapest(error)?;
        self.core.rows.iter().position(|row| row.tolerance == tolerance)
    }

    /// A value per run, by its name; NaN for a run that failed.
    fn values<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vector<'py>> {
        let value: fn(&core::Rung) -> f64 = match name {
            "error" => core::Rung::largest_error,
            "seconds" => |rung| rung.seconds,
            "tolerance" => {
                return Ok(vector(py, self.core.rows.iter().map(|row| row.tolerance).collect()));
            }
            _ => return Err(PyKeyError::new_err(name.to_owned())),
        };
        let row = |row: &core::Row| row.outcome.as_ref().map_or(f64::NAN, value);
        Ok(vector(py, self.core.rows.iter().map(row).collect()))
    }

    /// A count per run, by its name; 0 for a run that failed.
    fn counts<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vector<'py, u64>> {
        let count: fn(&core::Rung) -> u64 = match name {
            "nodes" => |rung| rung.nodes as u64,
            "steps" => |rung| rung.steps,
            _ => return Err(PyKeyError::new_err(name.to_owned())),
        };
        let row = |row: &core::Row| row.outcome.as_ref().map_or(0, count);
        Ok(vector(py, self.core.rows.iter().map(row).collect()))
    }

    /// The error of this number in `names`, halfway and at the end, per run; NaN for a run that failed.
    fn errors<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Table<'py>> {
        let rows = &self.core.rows;
        let mut values = Vec::with_capacity(2 * rows.len());
        for at in 0..2 {
            for row in rows {
                let errors = row.outcome.as_ref().ok().map(|rung| &rung.errors[at]);
                let error = errors.and_then(|errors| errors.named(&self.core.densities).nth(number));
                values.push(error.map_or(f64::NAN, |(_, error)| error));
            }
        }
        table(py, values, 2, rows.len())
    }
}
