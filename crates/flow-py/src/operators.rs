//! The operators of the flow on arrays: one function each.

use flow_core::flow::{NodalCurve, NodalError, NodalRates};
use flow_core::geometry::CurveGeometry;
use flow_core::operators::DerivativeFamily;
use flow_core::run;
use flow_core::run::scene::{Derivative, Gauge};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{Table, Vector, table, vector};
use crate::error::detached;
use crate::scene::Scene;

type NodalIn<'py> = PyReadonlyArray1<'py, f64>;
type NodalOut<'py> = Vector<'py>;

/// Curvature, metric, tangent angle, tangent, normal; length, area, turning number, closure defect.
type Geometry<'py> =
    (NodalOut<'py>, NodalOut<'py>, NodalOut<'py>, Table<'py>, Table<'py>, f64, f64, i32, f64);

/// Geometry of the closed curve through `position`, of shape (node, 2).
#[pyfunction]
pub fn geometry<'py>(py: Python<'py>, position: PyReadonlyArray2<'py, f64>) -> PyResult<Geometry<'py>> {
    let (points, rest) = position.as_slice()?.as_chunks::<2>();
    if !rest.is_empty() || position.as_array().ncols() != 2 {
        return Err(PyValueError::new_err("`position` has the shape (node, 2)"));
    }
    let geometry = detached(py, || CurveGeometry::of(points))?;
    let nodes = points.len();
    Ok((
        vector(py, geometry.curvature),
        vector(py, geometry.metric),
        vector(py, geometry.tangent_angle),
        table(py, geometry.tangent.into_flattened(), nodes, 2)?,
        table(py, geometry.normal.into_flattened(), nodes, 2)?,
        geometry.length,
        geometry.area,
        geometry.turning_number,
        geometry.closure_defect,
    ))
}

/// Rates of curvature, metric and each density, and the tangential velocity, under a normal velocity.
#[pyfunction]
#[allow(clippy::type_complexity)] // written once
pub fn flow_map<'py>(
    py: Python<'py>,
    curvature: NodalIn<'py>,
    metric: NodalIn<'py>,
    normal_velocity: NodalIn<'py>,
    density: Vec<NodalIn<'py>>,
    gauge: &str,
    derivative: &str,
) -> PyResult<(NodalOut<'py>, NodalOut<'py>, Vec<NodalOut<'py>>, NodalOut<'py>)> {
    let (kappa, g, v) = (curvature.as_slice()?, metric.as_slice()?, normal_velocity.as_slice()?);
    let (rho, family) = (slices(&density)?, family(derivative)?);
    let gauge = gauge_named(gauge)?;
    let rates = detached(py, || NodalCurve::new(kappa, g, &rho, family, gauge.rule())?.flow_map(v))?;
    let NodalRates { curvature, metric, density, tangential_velocity } = rates;
    let density = density.into_iter().map(|rate| vector(py, rate)).collect();
    Ok((vector(py, curvature), vector(py, metric), density, vector(py, tangential_velocity)))
}

/// u with Hu = `right_hand_side`, H = −`Δ_s` + κ².
#[pyfunction]
pub fn helmholtz<'py>(
    py: Python<'py>,
    curvature: NodalIn<'py>,
    metric: NodalIn<'py>,
    right_hand_side: NodalIn<'py>,
    derivative: &str,
) -> PyResult<NodalOut<'py>> {
    on_curve(py, &curvature, &metric, &right_hand_side, derivative, NodalCurve::helmholtz)
}

/// 𝓘 `force`, 𝓘 = Id − κH⁻¹κ.
#[pyfunction]
pub fn incompressibility<'py>(
    py: Python<'py>,
    curvature: NodalIn<'py>,
    metric: NodalIn<'py>,
    force: NodalIn<'py>,
    derivative: &str,
) -> PyResult<NodalOut<'py>> {
    on_curve(py, &curvature, &metric, &force, derivative, NodalCurve::incompressible)
}

/// Energy of a scene on a curve with its densities, in the order of the scene.
#[pyfunction]
pub fn energy<'py>(
    py: Python<'py>,
    scene: &Scene,
    curvature: NodalIn<'py>,
    metric: NodalIn<'py>,
    density: Vec<NodalIn<'py>>,
) -> PyResult<f64> {
    Ok(evaluation(py, scene, &curvature, &metric, &density)?.energy)
}

/// Force of the energy of a scene on the normal motion of a curve with its densities, in the order of the scene.
#[pyfunction]
pub fn normal_force<'py>(
    py: Python<'py>,
    scene: &Scene,
    curvature: NodalIn<'py>,
    metric: NodalIn<'py>,
    density: Vec<NodalIn<'py>>,
) -> PyResult<NodalOut<'py>> {
    Ok(vector(py, evaluation(py, scene, &curvature, &metric, &density)?.normal_force))
}

fn evaluation(
    py: Python<'_>,
    scene: &Scene,
    curvature: &NodalIn<'_>,
    metric: &NodalIn<'_>,
    density: &[NodalIn<'_>],
) -> PyResult<run::Evaluation> {
    let (kappa, g, rho) = (curvature.as_slice()?, metric.as_slice()?, slices(density)?);
    detached(py, || run::evaluate(&scene.core, kappa, g, &rho))
}

fn on_curve<'py>(
    py: Python<'py>,
    curvature: &NodalIn<'py>,
    metric: &NodalIn<'py>,
    argument: &NodalIn<'py>,
    derivative: &str,
    apply: fn(&mut NodalCurve, &[f64]) -> Result<Vec<f64>, NodalError>,
) -> PyResult<NodalOut<'py>> {
    let (kappa, g, argument) = (curvature.as_slice()?, metric.as_slice()?, argument.as_slice()?);
    let (family, gauge) = (family(derivative)?, Gauge::at_rest(g).rule());
    let out = detached(py, || apply(&mut NodalCurve::new(kappa, g, &[], family, gauge)?, argument))?;
    Ok(vector(py, out))
}

fn slices<'a>(arrays: &'a [NodalIn<'_>]) -> PyResult<Vec<&'a [f64]>> {
    arrays.iter().map(|array| Ok(array.as_slice()?)).collect()
}

fn gauge_named(name: &str) -> PyResult<Gauge> {
    named("gauge", name, Gauge::ALL.iter().map(|gauge| (gauge.name(), *gauge)))
}

fn family(name: &str) -> PyResult<DerivativeFamily> {
    let families = Derivative::ALL.iter().filter_map(|choice| Some((choice.name(), choice.family()?)));
    named("derivative", name, families)
}

/// The one of `choices` that `argument` names.
fn named<T>(
    argument: &str,
    name: &str,
    choices: impl Iterator<Item = (&'static str, T)> + Clone,
) -> PyResult<T> {
    let known = choices.clone().find(|(known, _)| *known == name);
    known.map(|(_, choice)| choice).ok_or_else(|| {
        let allowed = choices.map(|(name, _)| name).collect::<Vec<_>>().join(", ");
        PyValueError::new_err(format!("{argument} = {name:?}: it must be one of {allowed}"))
    })
}
