//! Ladders of tolerances: measurements in, arrays and a figure out.

use flow_core::output::picture::{Options, PictureError, plot_tradeoff};
use flow_core::run::tradeoff as core;
use pyo3::exceptions::{PyKeyError, PyKeyboardInterrupt};
use pyo3::prelude::*;

use crate::arrays::{Table, Vector, table, vector};
use crate::error::{detached, raised};
use crate::file_path::FilePath;
use crate::scene::Scene;
use crate::tradeoff_parts::{self as parts, ReferenceParts, RungParts, SpanParts};
use crate::watcher::{LadderWatcher, Watcher};

/// A measured ladder.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct Tradeoff {
    /// With the rows alone that were measured: an error does not travel between processes, what it says does.
    core: core::Tradeoff,
    /// Tolerance of every run, and why it has no result.
    runs: Vec<(f64, Option<String>)>,
    interrupted: bool,
}

impl From<core::Tradeoff> for Tradeoff {
    fn from(mut core: core::Tradeoff) -> Self {
        let failure = |row: &core::Row| row.outcome.as_ref().err().map(ToString::to_string);
        let runs = core.rows.iter().map(|row| (row.tolerance, failure(row))).collect();
        let interrupted = core.is_interrupted();
        core.rows.retain(|row| row.outcome.is_ok());
        Self { core, runs, interrupted }
    }
}

impl Tradeoff {
    /// A value per run; `missing` for a run that failed.
    fn per_run<T: Copy>(&self, missing: T, value: impl Fn(&core::Rung) -> T) -> Vec<T> {
        let mut measured = self.core.rungs();
        let mut next = || measured.next().map_or(missing, |(_, rung)| value(rung));
        self.runs.iter().map(|(_, failure)| if failure.is_none() { next() } else { missing }).collect()
    }
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
    let mut watcher = LadderWatcher::new(Watcher::new(callback, interval)?, before_run);
    let default = core::Ladder::default();
    let tolerances = tolerances.unwrap_or_else(|| default.tolerances().to_vec());
    let ladder = core::Ladder::new(&tolerances, reference_nodes).map_err(|error| raised(py, &error))?;
    let measured = detached(py, || match core::tradeoff(&scene.core, &ladder, &mut watcher) {
        Err(core::TradeoffError::Interrupted) => Ok(None),
        other => other.map(Some),
    });
    match (watcher.raised(py), measured?) {
        (Some(raised), _) => Err(raised),
        (None, Some(core)) => Ok(core.into()),
        (None, None) => Err(PyKeyboardInterrupt::new_err(core::TradeoffError::Interrupted.to_string())),
    }
}

#[pymethods]
impl Tradeoff {
    /// The ladder whose `__getnewargs__` these are.
    #[new]
    fn of_parts(
        title: String,
        densities: Vec<String>,
        span: SpanParts,
        reference: ReferenceParts,
        rungs: Vec<RungParts>,
        runs: Vec<(f64, Option<String>)>,
        interrupted: bool,
    ) -> PyResult<Self> {
        let (span, reference) = (parts::span(span)?, parts::reference(reference));
        let rows = rungs.into_iter().map(parts::row).collect::<PyResult<_>>()?;
        let core = core::Tradeoff { title, densities, span, reference, rows };
        Ok(Self { core, runs, interrupted })
    }

    /// All of it as numbers and texts: what pickles hold.
    #[allow(clippy::type_complexity)] // written once
    fn __getnewargs__(
        &self,
    ) -> (&str, Vec<String>, SpanParts, ReferenceParts, Vec<RungParts>, Vec<(f64, Option<String>)>, bool)
    {
        let core::Tradeoff { title, densities, span, reference, .. } = &self.core;
        let (span, reference) = (parts::of_span(*span), parts::of_reference(*reference));
        let rungs = self.core.rungs().map(parts::of_rung).collect();
        (title, densities.clone(), span, reference, rungs, self.runs.clone(), self.interrupted)
    }

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
    fn span(&self) -> SpanParts {
        parts::of_span(self.core.span)
    }

    /// Tolerance of the reference, whether rounding limits it, its nodes, steps and seconds.
    #[getter]
    fn reference(&self) -> ReferenceParts {
        parts::of_reference(self.core.reference)
    }

    /// Whether the errors hold those of the nodes.
    #[getter]
    fn includes_space(&self) -> bool {
        self.core.includes_space()
    }

    /// Whether the ladder was interrupted.
    #[getter]
    fn interrupted(&self) -> bool {
        self.interrupted
    }

    /// Why each run has no result; none where it has one.
    #[getter]
    fn failures(&self) -> Vec<Option<&str>> {
        self.runs.iter().map(|(_, failure)| failure.as_deref()).collect()
    }

    /// Index of the quickest run with at most this error.
    fn cheapest(&self, error: f64) -> Option<usize> {
        let (tolerance, _) = self.core.cheapest(error)?;
        self.runs.iter().position(|(asked, _)| *asked == tolerance)
    }

    /// A value per run, by its name; NaN for a run that failed.
    fn values<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vector<'py>> {
        let value: fn(&core::Rung) -> f64 = match name {
            "error" => core::Rung::largest_error,
            "seconds" => |rung| rung.seconds,
            "tolerance" => {
                return Ok(vector(py, self.runs.iter().map(|(tolerance, _)| *tolerance).collect()));
            }
            _ => return Err(PyKeyError::new_err(name.to_owned())),
        };
        Ok(vector(py, self.per_run(f64::NAN, value)))
    }

    /// A count per run, by its name; 0 for a run that failed.
    fn counts<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vector<'py, u64>> {
        let count: fn(&core::Rung) -> u64 = match name {
            "nodes" => |rung| rung.nodes as u64,
            "steps" => |rung| rung.steps,
            _ => return Err(PyKeyError::new_err(name.to_owned())),
        };
        Ok(vector(py, self.per_run(0, count)))
    }

    /// The error of this number in `names`, halfway and at the end, per run; NaN for a run that failed.
    fn errors<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Table<'py>> {
        let error = |errors: &core::Errors| parts::values(errors).get(number).copied().unwrap_or(f64::NAN);
        let both = [0, 1].map(|at| self.per_run(f64::NAN, |rung| error(&rung.errors[at])));
        table(py, both.concat(), 2, self.runs.len())
    }

    /// Draws the figure of `curveflow tradeoff` into a PNG or SVG file.
    fn picture(&self, py: Python<'_>, path: FilePath, replace: bool) -> PyResult<()> {
        let options = Options { replace, ..Options::default() };
        detached::<_, PictureError>(py, || plot_tradeoff(&self.core, &path.0, &options))
    }
}
