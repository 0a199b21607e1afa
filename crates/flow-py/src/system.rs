//! The system dy/dt = f(y) of a scene, for integrators from outside.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use flow_core::integrator::Problem;
use flow_core::run::{Membrane, Setup, SetupError};
use numpy::{PyArray1, PyReadonlyArray1, PyReadwriteArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Vector, vector};
use crate::error::{Panicked, detached};
use crate::scene::Scene;

/// A flow with its initial state, in the spectral form that the integrator carries.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct System {
    membrane: Mutex<Membrane>,
    /// Whether J, and the preconditioner, are of any state.
    is_linearised: AtomicBool,
    is_factorised: AtomicBool,
    initial: Py<PyArray1<f64>>,
    size: usize,
    blocks: Vec<(usize, usize)>,
}

impl System {
    /// Calls `function` without the interpreter lock; a call from another thread waits for its end, without the lock too.
    fn call<T: Send>(&self, py: Python<'_>, function: impl FnOnce(&mut Membrane) -> T + Send) -> PyResult<T> {
        detached::<_, Panicked>(py, || {
            let mut membrane = self.membrane.lock().map_err(|_| Panicked)?;
            Ok(function(&mut membrane))
        })
    }

    /// Calls `function` with two arrays of the size of the state, in place.
    fn with_arrays(
        &self,
        py: Python<'_>,
        from: &PyReadonlyArray1<'_, f64>,
        to: &mut PyReadwriteArray1<'_, f64>,
        function: impl FnOnce(&mut Membrane, &[f64], &mut [f64]) + Send,
    ) -> PyResult<()> {
        let (from, to) = (from.as_slice()?, to.as_slice_mut()?);
        self.check(from.len())?;
        self.check(to.len())?;
        self.call(py, |membrane| function(membrane, from, to))
    }

    /// What needs an earlier call.
    fn after(done: &AtomicBool, call: &str) -> PyResult<()> {
        if done.load(Ordering::Acquire) {
            return Ok(());
        }
        Err(PyValueError::new_err(format!("call {call} first")))
    }

    fn check(&self, length: usize) -> PyResult<()> {
        let size = self.size;
        if length == size {
            return Ok(());
        }
        Err(PyValueError::new_err(format!("the system has {size} entries, the array {length}")))
    }
}

#[pymethods]
impl System {
    #[new]
    fn new(py: Python<'_>, scene: &Scene) -> PyResult<Self> {
        let (membrane, state) = detached::<_, SetupError>(py, || {
            let mut setup = Setup::new(&scene.core)?;
            setup.finish()?;
            Ok((setup.membrane, setup.state))
        })?;
        let blocks = membrane.blocks().into_iter().map(|block| (block.start, block.end)).collect();
        let (size, initial) = (state.len(), vector(py, state).unbind());
        let [is_linearised, is_factorised] = [false; 2].map(AtomicBool::new);
        Ok(Self { membrane: Mutex::new(membrane), is_linearised, is_factorised, initial, size, blocks })
    }

    /// The initial state: one array, which cannot be written to.
    #[getter]
    fn initial<'py>(&self, py: Python<'py>) -> Vector<'py> {
        self.initial.bind(py).clone()
    }

    /// First entry and end of each field, and of the length.
    #[getter]
    fn blocks(&self) -> Vec<(usize, usize)> {
        self.blocks.clone()
    }

    /// f(y) into `rate`.
    fn rate(
        &self,
        py: Python<'_>,
        y: PyReadonlyArray1<'_, f64>,
        mut rate: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<()> {
        self.with_arrays(py, &y, &mut rate, Membrane::rate)
    }

    /// Freezes J at y; f(y) into `rate`.
    fn linearise(
        &self,
        py: Python<'_>,
        y: PyReadonlyArray1<'_, f64>,
        mut rate: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<()> {
        self.with_arrays(py, &y, &mut rate, Membrane::linearise)?;
        self.is_linearised.store(true, Ordering::Release);
        Ok(())
    }

    /// Jv into `out`.
    fn jacobian_product(
        &self,
        py: Python<'_>,
        v: PyReadonlyArray1<'_, f64>,
        mut out: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<()> {
        Self::after(&self.is_linearised, "linearise")?;
        self.with_arrays(py, &v, &mut out, Membrane::jacobian_product)
    }

    /// Prepares an approximate inverse of I − γJ; false if that fails.
    fn factorise(&self, py: Python<'_>, gamma: f64) -> PyResult<bool> {
        Self::after(&self.is_linearised, "linearise")?;
        if !(gamma.is_finite() && gamma >= 0.0) {
            return Err(PyValueError::new_err(format!("gamma = {gamma} must be finite and at least 0")));
        }
        let factorised = self.call(py, |membrane| membrane.factorise(gamma))?;
        self.is_factorised.store(factorised, Ordering::Release);
        Ok(factorised)
    }

    /// The approximate solution of (I − γJ)x = r, in place.
    fn precondition(&self, py: Python<'_>, mut r: PyReadwriteArray1<'_, f64>) -> PyResult<()> {
        Self::after(&self.is_factorised, "factorise")?;
        let r = r.as_slice_mut()?;
        self.check(r.len())?;
        self.call(py, |membrane| membrane.precondition(r))
    }
}
