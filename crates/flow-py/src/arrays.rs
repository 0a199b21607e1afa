//! NumPy arrays that own their buffer and cannot be written to.

use numpy::{Element, PyArray, PyArrayMethods, ToPyArray};
use numpy::{IntoPyArray, Ix1, Ix2, Ix3, PyArray1, PyArray2, PyArray3};
use pyo3::prelude::*;

/// Read-only vector of one value per frame, step or sample.
pub type Vector<'py, T = f64> = Bound<'py, PyArray1<T>>;

/// Read-only table (frame, node).
pub type Table<'py> = Bound<'py, PyArray2<f64>>;

/// Moves `values` into an array.
pub fn vector<T: Element>(py: Python<'_>, values: Vec<T>) -> Vector<'_, T> {
    frozen::<T, Ix1>(values.into_pyarray(py))
}

/// Copies `values` into an array: they stay where they are, for files and pictures, and only an array that owns its buffer
/// can outlive them without `unsafe`.
pub fn copied<'py, T: Element>(py: Python<'py>, values: &[T]) -> Vector<'py, T> {
    frozen::<T, Ix1>(values.to_pyarray(py))
}

/// Moves `values`, row by row, into an array of `rows` × `columns`.
pub fn table(py: Python<'_>, values: Vec<f64>, rows: usize, columns: usize) -> PyResult<Table<'_>> {
    Ok(frozen::<f64, Ix2>(values.into_pyarray(py).reshape([rows, columns])?))
}

/// Moves pairs, row by row, into an array of `rows` × `columns` × 2.
pub fn pairs(
    py: Python<'_>,
    values: Vec<f64>,
    rows: usize,
    columns: usize,
) -> PyResult<Bound<'_, PyArray3<f64>>> {
    Ok(frozen::<f64, Ix3>(values.into_pyarray(py).reshape([rows, columns, 2])?))
}

fn frozen<T: Element, D: numpy::ndarray::Dimension>(
    array: Bound<'_, PyArray<T, D>>,
) -> Bound<'_, PyArray<T, D>> {
    array.readwrite().make_nonwriteable();
    array
}
