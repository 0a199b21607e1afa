//! The system dy/dt = f(y) of a scene, for integrators from outside.

use std::sync::{Mutex, MutexGuard};

use flow_core::integrator::{Finish, Problem};
use flow_core::run::{Membrane, Setup};
use numpy::{PyReadonlyArray1, PyReadwriteArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{Vector, copied};
use crate::error::detached;
use crate::scene::Scene;

/// A flow with its initial state, in the spectral form that the integrator carries.
#[pyclass(frozen, module = "curveflow._curveflow")]
pub struct System {
    membrane: Mutex<Membrane>,
    initial: Vec<f64>,
    blocks: Vec<(usize, usize)>,
}

impl System {
    fn membrane(&self) -> PyResult<MutexGuard<'_, Membrane>> {
        self.membrane.lock().map_err(|_| PyRuntimeError::new_err("an earlier call on this system panicked"))
    }

    /// Calls `function` with two arrays of the size of the state.
    fn with_arrays(
        &self,
        from: &PyReadonlyArray1<'_, f64>,
        to: &mut PyReadwriteArray1<'_, f64>,
        function: impl FnOnce(&mut Membrane, &[f64], &mut [f64]),
    ) -> PyResult<()> {
        let (from, to) = (from.as_slice()?, to.as_slice_mut()?);
        self.check(from.len())?;
        self.check(to.len())?;
        function(&mut *self.membrane()?, from, to);
        Ok(())
    }

    fn check(&self, length: usize) -> PyResult<()> {
        if length == self.initial.len() {
            return Ok(());
        }
        let size = self.initial.len();
        Err(PyValueError::new_err(format!("the system has {size} entries, the array {length}")))
    }
}

#[pymethods]
impl System {
    #[new]
    fn new(py: Python<'_>, scene: &Scene) -> PyResult<Self> {
        let Setup { mut membrane, mut state, .. } = detached(py, || Setup::new(&scene.core))?;
        if membrane.finish(0.0, &mut state) == Finish::NotFinite {
            return Err(PyValueError::new_err("the energy is not finite at the initial state"));
        }
        let blocks = membrane.blocks().into_iter().map(|block| (block.start, block.end)).collect();
        Ok(Self { membrane: Mutex::new(membrane), initial: state, blocks })
    }

    /// The initial state.
    #[getter]
    fn initial<'py>(&self, py: Python<'py>) -> Vector<'py> {
        copied(py, &self.initial)
    }

    /// First entry and end of each field, and of the length.
    #[getter]
    fn blocks(&self) -> Vec<(usize, usize)> {
        self.blocks.clone()
    }

    /// f(y) into `rate`.
    fn rate(&self, y: PyReadonlyArray1<'_, f64>, mut rate: PyReadwriteArray1<'_, f64>) -> PyResult<()> {
        self.with_arrays(&y, &mut rate, Membrane::rate)
    }

    /// Freezes J at y; f(y) into `rate`.
    fn linearise(&self, y: PyReadonlyArray1<'_, f64>, mut rate: PyReadwriteArray1<'_, f64>) -> PyResult<()> {
        self.with_arrays(&y, &mut rate, Membrane::linearise)
    }

    /// Jv into `out`.
    fn jacobian_product(
        &self,
        v: PyReadonlyArray1<'_, f64>,
        mut out: PyReadwriteArray1<'_, f64>,
    ) -> PyResult<()> {
        self.with_arrays(&v, &mut out, Membrane::jacobian_product)
    }

    /// Prepares an approximate inverse of I − γJ; false if that fails.
    fn factorise(&self, gamma: f64) -> PyResult<bool> {
        Ok(self.membrane()?.factorise(gamma))
    }

    /// The approximate solution of (I − γJ)x = r, in place.
    fn precondition(&self, mut r: PyReadwriteArray1<'_, f64>) -> PyResult<()> {
        let r = r.as_slice_mut()?;
        self.check(r.len())?;
        self.membrane()?.precondition(r);
        Ok(())
    }
}
