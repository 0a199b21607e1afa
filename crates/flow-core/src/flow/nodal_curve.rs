//! The operators of the flow on a curve that is given by arrays of nodal values.
//!
//! The integrator works on spectral state vectors; this is for data that comes from outside. Every field has one value per
//! node, at s = i/n.

use std::sync::Arc;

use super::curve_fields::CurveFields;
use super::flow_map::FlowMap;
use super::gauge::{Gauge, MetricRole};
use super::nodal_error::NodalError;
use super::normal_mobility::{Incompressible, MobilityError, NormalMobility};
use crate::geometry::vectors::mean;
use crate::geometry::{Complex64, Grading, GradingError, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::{CurveHelmholtz, Derivative, DerivativeFamily, Helmholtz};

impl MetricRole {
    /// The role that a nodal `metric` has in a gauge that keeps it but for its mean.
    #[must_use]
    pub fn at_rest(metric: &[f64]) -> Self {
        if spread(metric) <= UNIFORM { Self::Uniform } else { Self::Graded }
    }
}

/// Spread of a metric, relative to its mean, that counts as none.
const UNIFORM: f64 = 1e-10;

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
    /// # Shapes
    /// `v`, and each field of the rates: one value per node.
    /// # Units
    /// `v` is a length per time; the rates are those of κ, of g and of the densities per time.
    /// # Errors
    /// [`NodalError`] if `v` does not fit the curve, or a rate overflows.
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
        let density: Vec<Vec<f64>> = pointwise.collect();
        check_result("the rate of the curvature", &curvature)?;
        check_result("the rate of the metric", &metric)?;
        check_result("the tangential velocity", &tangential_velocity)?;
        density.iter().try_for_each(|rate| check_result("the rate of a density", rate))?;
        Ok(NodalRates { curvature, metric, density, tangential_velocity })
    }

    /// u with Hu = f, H = −`Δ_s` + κ² (O5), (O7).
    ///
    /// # Shapes
    /// `f` and u: one value per node.
    /// # Units
    /// u has the unit of `f` times length².
    /// # Errors
    /// [`NodalError`] if `f` does not fit the curve, H is singular, or what is asked for overflows.
    pub fn helmholtz(&mut self, f: &[f64]) -> Result<Vec<f64>, NodalError> {
        self.check_field("right_hand_side", f)?;
        self.check_nodes()?;
        let mut operator = CurveHelmholtz::new(&self.derivative, self.layout.nodes());
        operator.set(self.at.grading(), self.at.at_nodes(0), self.at.length())?;
        let mut u = vec![0.0; f.len()];
        operator.solve(f, &mut u);
        check_result("the solution", &u)?;
        Ok(u)
    }

    /// 𝓘f = f − κH⁻¹(κf) (F8), in the unit of `f`.
    ///
    /// # Shapes
    /// `f` and 𝓘f: one value per node.
    /// # Errors
    /// [`NodalError`] if `f` does not fit the curve, H is singular, or what is asked for overflows.
    pub fn incompressible(&mut self, f: &[f64]) -> Result<Vec<f64>, NodalError> {
        self.check_field("force", f)?;
        self.check_nodes()?;
        let mut operator = Incompressible::new(&self.derivative, self.layout.nodes());
        operator.set(&self.at).map_err(|MobilityError::Helmholtz(error)| error)?;
        let mut v = vec![0.0; f.len()];
        operator.apply(&self.at, f, &mut v);
        check_result("the normal velocity", &v)?;
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
    y.push(mean(metric));
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
    let mean = mean(metric);
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
    if !mean(metric).is_finite() {
        return Err(NodalError::NoLength { length: mean(metric) });
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

/// Refuses a result that is not a number: a state is made of finite ones, so that it overflowed.
fn check_result(result: &'static str, values: &[f64]) -> Result<(), NodalError> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(node) => Err(NodalError::Overflow { result, node, value: values[node] }),
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

    /// The length is a mean over the nodes: of many of them its rounding is that of a few.
    #[test]
    fn many_nodes_leave_the_length_exact() {
        let (nodes, mode) = (8192, 3.0_f64);
        let wave: Vec<f64> = (0..nodes).map(|i| (mode * TAU * i as f64 / nodes as f64).cos()).collect();
        let (kappa, metric) = (vec![1.0; nodes], vec![TAU; nodes]);
        let gauge = Arc::new(ScaledArcLength);
        let mut curve = NodalCurve::new(&kappa, &metric, &[], DerivativeFamily::Fourier, gauge).unwrap();
        let u = curve.helmholtz(&wave).unwrap();
        let error = u.iter().zip(&wave).map(|(u, v)| (u * (mode * mode + 1.0) - v).abs()).fold(0.0, f64::max);
        println!("{:.1e}, {error:.1e}", curve.at.length() / TAU - 1.0);
        assert!(error < 2e-14, "{error:.1e}");
    }

    /// At scales whose squares are no numbers.
    #[test]
    fn what_overflows_is_refused() {
        let wave: Vec<f64> = (0..32).map(|i| (TAU * f64::from(i) / 16.0).cos()).collect();
        let curve = |scale: f64| {
            let (kappa, metric) = ([TAU / scale; 32], [scale; 32]);
            NodalCurve::new(&kappa, &metric, &[], DerivativeFamily::Fourier, Arc::new(ScaledArcLength))
        };
        assert!(matches!(curve(1e308), Err(NodalError::NoLength { length: f64::INFINITY })));
        let mut small = curve(1e-200).unwrap();
        assert!(matches!(small.flow_map(&wave), Err(NodalError::Overflow { .. })));
        for result in [small.helmholtz(&wave), small.incompressible(&wave)] {
            // κ² and 1/|Γ|² overflow: H is none.
            assert!(result.is_err());
        }
    }
}
