//! Random smooth closed curves with random smooth densities.

use std::f64::consts::TAU;
use std::sync::Arc;

use flow_core::expression::Expression;
use flow_core::geometry::shapes::Shape;
use flow_core::geometry::{Closure, Complex64, Grading, Layout, PeriodicGrid, SpectralLayout};
use proptest::prelude::*;

/// Largest amplitudes of the modes 2, 3 and 4 of the radius: lobed, and still resolved by 32 nodes.
const LARGEST: [f64; 3] = [0.15, 0.12, 0.05];

/// Amplitude and phase of each mode.
type Waves<const MODES: usize> = [(f64, f64); MODES];

/// The curve r = 1 + Σ aₖ cos(kφ + pₖ), and two densities 0.5 + Σ bₖ cos(2πks + qₖ).
#[derive(Clone, Debug)]
pub struct Blob {
    pub radius: Waves<3>,
    pub densities: [Waves<2>; 2],
}

/// A state vector with its layout.
#[derive(Clone, Debug)]
pub struct State {
    pub layout: Layout,
    pub y: Vec<f64>,
}

/// Not below a quarter of the largest amplitude: forces on circles vanish, and errors are relative to forces.
fn wave(largest: f64) -> impl Strategy<Value = (f64, f64)> {
    (0.25 * largest..largest, 0.0..TAU)
}

/// Any curve with any densities.
pub fn any_blob() -> impl Strategy<Value = Blob> {
    let radius = [wave(LARGEST[0]), wave(LARGEST[1]), wave(LARGEST[2])];
    let density = || [wave(0.3), wave(0.1)];
    (radius, density(), density())
        .prop_map(|(radius, first, second)| Blob { radius, densities: [first, second] })
}

/// Even, odd, power-of-two and other numbers of nodes.
pub fn any_nodes() -> impl Strategy<Value = usize> {
    prop::sample::select(vec![32, 48, 64, 65, 96])
}

/// One fixed curve, for measured orders.
pub fn fixed_blob() -> Blob {
    Blob {
        radius: [(0.12, 0.3), (0.08, 1.1), (0.03, 2.0)],
        densities: [[(0.25, 0.4), (0.1, 1.0)], [(-0.2, 2.0), (0.05, 0.1)]],
    }
}

impl Blob {
    /// The radius as a formula of φ.
    pub fn radius_formula(&self) -> String {
        let waves = self.radius.iter().enumerate();
        let terms = waves.map(|(k, (a, p))| format!(" + ({a:.9})*cos({}*phi + {p:.9})", k + 2));
        terms.fold("1".to_owned(), |sum, term| sum + &term)
    }

    /// The densities as formulas of s.
    pub fn density_formulas(&self) -> [String; 2] {
        [0, 1].map(|density| {
            let waves = self.densities[density].iter().enumerate();
            let terms = waves.map(|(k, (b, q))| format!(" + ({b:.9})*cos({}*pi*s + {q:.9})", 2 * (k + 1)));
            terms.fold("0.5".to_owned(), |sum, term| sum + &term)
        })
    }

    /// The closed curve at `nodes` nodes with `densities` densities.
    pub fn state(&self, nodes: usize, densities: usize) -> State {
        let r = Expression::parse(&self.radius_formula(), &["phi"]).expect("a formula");
        self.state_on(&Shape::Polar { r }, nodes, densities)
    }

    /// The densities on another curve.
    pub fn state_on(&self, shape: &Shape, nodes: usize, densities: usize) -> State {
        self.state_in(None, shape, nodes, densities)
    }

    /// The same curve at graded nodes.
    pub fn graded_state(&self, grading: &Grading, densities: usize) -> State {
        let r = Expression::parse(&self.radius_formula(), &["phi"]).expect("a formula");
        self.state_in(Some(grading), &Shape::Polar { r }, grading.nodes(), densities)
    }

    fn state_in(&self, grading: Option<&Grading>, shape: &Shape, nodes: usize, densities: usize) -> State {
        let curve = match grading {
            None => shape.resample(nodes).expect("a smooth curve"),
            Some(grading) => shape.resample_graded(grading).expect("a smooth curve"),
        };
        let uniform = || (0..nodes).map(|i| i as f64 / nodes as f64).collect();
        let fractions: Vec<f64> = grading.map_or_else(uniform, Grading::fractions);
        let layout = Layout::new(nodes, densities);
        let density = |waves: &Waves<2>| -> Vec<f64> {
            let value = |s: f64| {
                let waves = waves.iter().enumerate();
                0.5 + waves.map(|(k, (b, q))| b * (TAU * (k + 1) as f64 * s + q).cos()).sum::<f64>()
            };
            fractions.iter().map(|x| value(*x)).collect()
        };
        let values: Vec<Vec<f64>> = self.densities[..densities].iter().map(density).collect();
        let mut y = layout.assemble(&curve.curvature, &values, curve.length);
        if let Some(grading) = grading {
            grading.weigh(&mut y[..layout.length_index()]);
        }
        let mut grid = PeriodicGrid::new(nodes);
        let mut spectrum = vec![Complex64::default(); grid.modes()];
        grid.transform(&y[layout.field(0)], &mut spectrum);
        let mut closure = Closure::graded(nodes, grading.cloned().map(Arc::new));
        let gap = closure.project(&mut spectrum, curve.length, curve.turning_number, curve.angle);
        gap.expect("a curve that closes");
        grid.synthesise(&spectrum, &mut y[layout.field(0)]);
        State { layout, y }
    }
}

/// A figure eight of turning number 0, bent by the waves of `blob`.
pub fn figure_eight(blob: &Blob, nodes: usize, densities: usize) -> State {
    let [(a, p), (b, q), _] = blob.radius;
    let parse = |text: String| Expression::parse(&text, &["phi"]).expect("a formula");
    let x = parse(format!("sin(phi) + ({a:.9})*cos(2*phi + {p:.9})"));
    let y = parse(format!("sin(phi)*cos(phi) + ({b:.9})*cos(phi + {q:.9})"));
    blob.state_on(&Shape::Parametric { x, y }, nodes, densities)
}

/// The initial state of `scenes/three_fold.toml`.
pub fn membrane(nodes: usize) -> State {
    let curve = Shape::Trillium.resample(nodes).expect("a smooth curve");
    let layout = Layout::new(nodes, 1);
    let value = |s: f64| 0.9 + 0.05 * (3.0 * TAU * s).cos() + 0.02 * (TAU * s).cos();
    let density = (0..nodes).map(|i| value(i as f64 / nodes as f64)).collect();
    State { layout, y: layout.assemble(&curve.curvature, &[density], curve.length) }
}

/// The Fourier coefficients of a nodal state vector or motion.
pub fn spectral(layout: Layout, y: &[f64]) -> Vec<f64> {
    let form = SpectralLayout::new(layout);
    let mut state = vec![0.0; form.len()];
    form.encode(&mut PeriodicGrid::new(layout.nodes()), y, &mut state);
    state
}
