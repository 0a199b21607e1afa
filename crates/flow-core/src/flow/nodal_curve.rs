//! The operators of the flow on a curve that is given by arrays of nodal values.
//!
//! The integrator works on spectral state vectors; this is for data that comes from outside. Every field has one value per
//! node, at s = i/n.

use std::sync::Arc;

use super::curve_fields::CurveFields;
use super::flow_map::FlowMap;
use super::gauge::{Gauge, MetricRole};
use super::normal_mobility::{Incompressible, MobilityError, NormalMobility};
use crate::geometry::{Complex64, Grading, GradingError, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::{
    CurveHelmholtz, Derivative, DerivativeFamily, FactorisationError, Helmholtz, HelmholtzError,
};

impl MetricRole {
    /// The role that a nodal `metric` has in a gauge that keeps it but for its mean.
    #[must_use]
    pub fn at_rest(metric: &[f64]) -> Self {
        if spread(metric) <= UNIFORM { Self::Uniform } else { Self::Graded }
    }
}

/// Spread of a metric, relative to its mean, that counts as none.
const UNIFORM: f64 = 1e-10;

/// The arrays are not those of a curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum NodalError {
    /// Arrays of different lengths.
    #[error("`{field}` has {found} values, and `curvature` has {nodes}: all fields have one value per node")]
    Length { field: &'static str, found: usize, nodes: usize },
    /// Too few nodes.
    #[error("`curvature` has {nodes} values; it takes {fewest} nodes at least")]
    TooFewNodes { nodes: usize, fewest: usize },
    /// A value is NaN or infinite.
    #[error("`{field}` is {value} at node {node}: it must be finite")]
    NotFinite { field: &'static str, node: usize, value: f64 },
    /// The metric is no metric.
    #[error(
        "`metric` is {value:?} at s = {parameter:.6}: it must be positive, and not vanish beside its largest value"
    )]
    NotPositive { parameter: f64, value: f64 },
    /// Sharper than the distance of the nodes.
    #[error(
        "`metric` is not resolved by its {nodes} nodes: interpolated from them to s = {parameter:.6} it is off by {error:.1e} of \
         its value, and at most {bound:.0e} is allowed; give more nodes, or a smoother metric"
    )]
    NotResolved { nodes: usize, parameter: f64, error: f64, bound: f64 },
    /// The nodes are not where the gauge has them.
    #[error(
        "`metric` varies by {spread:.1e} of its mean, and the gauge \"scaled-arc-length\" keeps it uniform: use gauge = \
         \"graded\", which keeps the nodes at their fractions of the arc length, or \"co-moving\""
    )]
    NotUniform { spread: f64 },
    /// H has no inverse.
    #[error(
        "`curvature` has |Γ|∫κ² dσ = {value:.3e}, which is 4π² or more on every closed curve, and finite: no closed curve has it"
    )]
    NoCurvature { value: f64 },
    /// A pivot of H vanished.
    #[error("`curvature` makes −Δ_s + κ² singular: {0}")]
    Singular(FactorisationError),
}

impl From<GradingError> for NodalError {
    fn from(error: GradingError) -> Self {
        match error {
            GradingError::NotPositive { parameter, value } => Self::NotPositive { parameter, value },
            GradingError::NotResolved { nodes, parameter, error, bound } => {
                Self::NotResolved { nodes, parameter, error, bound }
            }
        }
    }
}

impl From<HelmholtzError> for NodalError {
    fn from(error: HelmholtzError) -> Self {
        match error {
            HelmholtzError::NoCurvature { value } => Self::NoCurvature { value },
            HelmholtzError::Singular(error) => Self::Singular(error),
        }
    }
}

/// Rates of the fields at fixed parameter under a normal velocity, one value per node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodalRates {
    /// Rate of the curvature.
    pub curvature: Vec<f64>,
    /// Rate of the metric.
    pub metric: Vec<f64>,
    /// Rate of each density, without sources.
    pub density: Vec<Vec<f64>>,
    /// Tangential velocity W of the gauge.
    pub tangential_velocity: Vec<f64>,
}

/// A curve with its densities at the nodes.
#[derive(Debug)]
pub struct NodalCurve {
    layout: Layout,
    grid: PeriodicGrid,
    derivative: Derivative,
    map: FlowMap,
    at: CurveFields,
    metric: Vec<f64>,
}

impl NodalCurve {
    /// The curve of `curvature` and `metric` with each `density`, one value per node; the curve need not close.
    ///
    /// # Errors
    /// [`NodalError`] if the arrays do not fit together, are not finite, or the metric does not fit the gauge.
    pub fn new(
        curvature: &[f64],
        metric: &[f64],
        density: &[&[f64]],
        family: DerivativeFamily,
        gauge: Arc<dyn Gauge>,
    ) -> Result<Self, NodalError> {
        let nodes = curvature.len();
        check(nodes, curvature, metric, density)?;
        let grid = PeriodicGrid::new(nodes);
        let grading = match gauge.metric() {
            MetricRole::Uniform if spread(metric) > UNIFORM => {
                return Err(NodalError::NotUniform { spread: spread(metric) });
            }
            MetricRole::Uniform => None,
            MetricRole::Graded | MetricRole::Field => Some(Arc::new(Grading::of_metric(metric)?)),
        };
        let layout = Layout::new(nodes, density.len());
        let layout = if gauge.metric() == MetricRole::Field { layout.with_metric() } else { layout };
        let derivative = Derivative::graded(family, &grid, grading);
        let map = FlowMap::in_gauge(gauge, layout, &grid, &derivative);
        let at = CurveFields::new(layout, &grid, &derivative);
        let mut curve = Self { layout, grid, derivative, map, at, metric: metric.to_vec() };
        let state = spectral(&nodal_state(curvature, metric, density, layout), layout, &mut curve.grid);
        curve.at.set(&state, &mut curve.grid, &curve.derivative);
        Ok(curve)
    }

    /// Rates under the normal velocity `v` (F2), (F19).
    ///
    /// # Errors
    /// [`NodalError`] if `v` does not fit the curve.
    pub fn flow_map(&mut self, v: &[f64]) -> Result<NodalRates, NodalError> {
        self.check_field("normal_velocity", v)?;
        let (nodes, spectral) = (self.layout.nodes(), SpectralLayout::new(self.layout));
        let (mut state, mut nodal) = (vec![0.0; spectral.len()], vec![0.0; self.layout.len()]);
        let length_rate = self.map.rates(&self.at, v, spectral.spectra_mut(&mut state));
        state[spectral.length_index()] = length_rate;
        let mut scratch = vec![Complex64::default(); spectral.modes()];
        spectral.decode(&mut self.grid, &state, &mut scratch, &mut nodal);
        let mut tangential_velocity = vec![0.0; nodes];
        self.map.tangential_velocity(&self.at, v, &mut tangential_velocity);
        let metric: Vec<f64> = if let Some(field) = self.layout.metric() {
            nodal[self.layout.field(field)].to_vec()
        } else {
            let stretch = nodal[self.layout.length_index()] / self.at.length();
            self.metric.iter().map(|g| g * stretch).collect()
        };
        let mut pointwise = (0..self.layout.fields()).map(|field| {
            let (per_parameter, values) = (&nodal[self.layout.field(field)], self.at.at_nodes(field));
            (0..nodes).map(|i| (per_parameter[i] - values[i] * metric[i]) / self.metric[i]).collect()
        });
        let curvature = pointwise.next().unwrap_or_default();
        let density = pointwise.collect();
        Ok(NodalRates { curvature, metric, density, tangential_velocity })
    }

    /// u with Hu = f, H = −`Δ_s` + κ² (O5), (O7).
    ///
    /// # Errors
    /// [`NodalError`] if `f` does not fit the curve, or H is singular.
    pub fn helmholtz(&mut self, f: &[f64]) -> Result<Vec<f64>, NodalError> {
        self.check_field("right_hand_side", f)?;
        self.check_nodes()?;
        let mut operator = CurveHelmholtz::new(&self.derivative, self.layout.nodes());
        operator.set(self.at.at_nodes(0), self.at.length())?;
        let mut u = vec![0.0; f.len()];
        operator.solve(f, &mut u);
        Ok(u)
    }

    /// 𝓘f = f − κH⁻¹(κf) (F8).
    ///
    /// # Errors
    /// [`NodalError`] if `f` does not fit the curve, or H is singular.
    pub fn incompressible(&mut self, f: &[f64]) -> Result<Vec<f64>, NodalError> {
        self.check_field("force", f)?;
        self.check_nodes()?;
        let mut operator = Incompressible::new(&self.derivative, self.layout.nodes());
        operator.set(&self.at).map_err(|MobilityError::Helmholtz(error)| error)?;
        let mut v = vec![0.0; f.len()];
        operator.apply(&self.at, f, &mut v);
        Ok(v)
    }

    fn check_field(&self, field: &'static str, values: &[f64]) -> Result<(), NodalError> {
        check_field(field, values, self.layout.nodes())
    }

    fn check_nodes(&self) -> Result<(), NodalError> {
        let (nodes, fewest) = (self.layout.nodes(), Helmholtz::FEWEST_NODES);
        if nodes < fewest { Err(NodalError::TooFewNodes { nodes, fewest }) } else { Ok(()) }
    }
}

/// The nodal state vector of pointwise fields.
pub(crate) fn nodal_state(curvature: &[f64], metric: &[f64], density: &[&[f64]], layout: Layout) -> Vec<f64> {
    let mut y = Vec::with_capacity(layout.len());
    for field in std::iter::once(curvature).chain(density.iter().copied()) {
        y.extend(field.iter().zip(metric).map(|(value, g)| value * g));
    }
    if layout.metric().is_some() {
        y.extend_from_slice(metric);
    }
    y.push(metric.iter().sum::<f64>() / metric.len() as f64);
    y
}

fn spectral(nodal: &[f64], layout: Layout, grid: &mut PeriodicGrid) -> Vec<f64> {
    let spectral = SpectralLayout::new(layout);
    let mut state = vec![0.0; spectral.len()];
    spectral.encode(grid, nodal, &mut state);
    state
}

/// Largest distance of a metric from its mean, relative to that.
fn spread(metric: &[f64]) -> f64 {
    let mean = metric.iter().sum::<f64>() / metric.len() as f64;
    metric.iter().map(|g| (g / mean - 1.0).abs()).fold(0.0, f64::max)
}

/// Checks that all fields have one finite value per node.
pub(crate) fn check(
    nodes: usize,
    curvature: &[f64],
    metric: &[f64],
    density: &[&[f64]],
) -> Result<(), NodalError> {
    const FEWEST_NODES: usize = 8;
    if nodes < FEWEST_NODES {
        return Err(NodalError::TooFewNodes { nodes, fewest: FEWEST_NODES });
    }
    check_field("curvature", curvature, nodes)?;
    check_field("metric", metric, nodes)?;
    if let Some(node) = metric.iter().position(|g| *g <= 0.0) {
        let parameter = node as f64 / nodes as f64;
        return Err(GradingError::NotPositive { parameter, value: metric[node] }.into());
    }
    density.iter().try_for_each(|rho| check_field("density", rho, nodes))
}

fn check_field(field: &'static str, values: &[f64], nodes: usize) -> Result<(), NodalError> {
    if values.len() != nodes {
        return Err(NodalError::Length { field, found: values.len(), nodes });
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(node) => Err(NodalError::NotFinite { field, node, value: values[node] }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::flow::{CoMoving, Graded, ScaledArcLength};

    /// Mode `mode` of a circle of radius 1 under V = cos: `κ_t` = (n² − 1)V, 𝓘V = n²/(n² + 1)V, H⁻¹V = V/(n² + 1).
    #[test]
    fn modes_of_a_circle_are_exact() {
        let (nodes, mode) = (128, 3.0_f64);
        let (kappa, metric) = (vec![1.0; nodes], vec![TAU; nodes]);
        let wave: Vec<f64> = (0..nodes).map(|i| (mode * TAU * i as f64 / nodes as f64).cos()).collect();
        let close = |a: &[f64], factor: f64| a.iter().zip(&wave).all(|(a, b)| (a - factor * b).abs() < 1e-9);
        let gauges: [(Arc<dyn Gauge>, f64); 3] =
            [(Arc::new(ScaledArcLength), 0.0), (Arc::new(Graded), 0.0), (Arc::new(CoMoving), TAU)];
        for (gauge, stretch) in gauges {
            let role = gauge.metric();
            let family = DerivativeFamily::Fourier;
            let mut curve = NodalCurve::new(&kappa, &metric, &[&kappa], family, gauge).unwrap();
            let rates = curve.flow_map(&wave).unwrap();
            assert!(close(&rates.curvature, mode * mode - 1.0), "{role:?}");
            assert!(close(&rates.metric, stretch), "{role:?}");
            // What is carried thins out where the curve grows, wherever the nodes go.
            assert!(close(&rates.density[0], -1.0), "{role:?}");
            if role != MetricRole::Field {
                assert!(close(&curve.helmholtz(&wave).unwrap(), 1.0 / (mode * mode + 1.0)));
                assert!(close(&curve.incompressible(&wave).unwrap(), mode * mode / (mode * mode + 1.0)));
            }
        }
    }
}
