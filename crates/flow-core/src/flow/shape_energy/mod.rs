//! The part of the energy that depends on where the nodes lie, as a function of curvature and length.
//!
//! Positions come from the discrete embedding: θ = P K + ⟨K⟩s, τ = c(cos θ, sin θ), γ = L P τ with P the Fourier
//! antiderivative, which is exactly skew. P loses the sawtooth of K: its angle vanishes at the nodes, but between
//! them it folds the curve and shortens the mean tangent by c, without which pressure would not feel it and the
//! sawtooth would grow. The gradient is pulled back by its exact transpose, so it is the exact
//! derivative of the discrete sum. Built only if a term has it. See `THEORY.md`, eq. (D7).

mod metric;
mod motion;
mod pull_back;
mod sawtooth;

use sawtooth::Sawtooth;

use super::curve_fields::CurveFields;
use super::intrinsic_gradient::IntrinsicGradient;
use crate::energies::{Area, EnergyTerm, Order, ShapeFields};
use crate::geometry::vectors::{mean, mean_of_product, scale, scale_into};
use crate::geometry::{Complex64, Embedding, Layout, PeriodicGrid, SpectralLayout};
use crate::operators::Derivative;

/// Scratch and linearisation of the shape part.
#[derive(Debug)]
pub struct ShapeEnergy {
    layout: SpectralLayout,
    grid: PeriodicGrid,
    embedding: Embedding,
    sawtooth: Option<Sawtooth>,
    shape: ShapeFields,
    dual: ShapeFields,
    frozen: Frozen,
    motion: ShapeFields,
    /// Derivative by the tangent angle, or its motion.
    angle: Vec<f64>,
    values: Vec<f64>,
    spectrum: Vec<Complex64>,
    /// Index of the metric among the fields, if the state holds it.
    metric: Option<usize>,
    /// The energy of what holds the area, at the linearisation.
    held: Option<Area>,
    /// The area at which what it costs is a constant.
    kept_area: Option<f64>,
}

/// What `term` costs, if it is a constant since the area is kept.
fn constant(kept_area: Option<f64>, term: &dyn EnergyTerm) -> Option<f64> {
    kept_area.and_then(|area| term.cost_of_area(area))
}

/// What the second derivative needs.
#[derive(Debug)]
struct Frozen {
    shape: ShapeFields,
    /// Derivative of the energy by positions.
    by_position: [Vec<f64>; 2],
    /// Its derivative by tangents, that through the positions included, along the tangents and across them.
    along_tangent: Vec<f64>,
    across_tangent: Vec<f64>,
    sawtooth: Option<Sawtooth>,
    /// Energy of the terms that are line energies, per length.
    line_tension: f64,
    /// ω = ∂𝓕/∂w and ⟨wω⟩, where the metric is a field.
    by_weight: Vec<f64>,
    mean_by_weight: f64,
}

impl Frozen {
    fn clear(&mut self) {
        let [x, y] = &mut self.by_position;
        for sum in [x, y, &mut self.along_tangent, &mut self.across_tangent, &mut self.by_weight] {
            sum.fill(0.0);
        }
        self.mean_by_weight = 0.0;
    }
}

impl ShapeEnergy {
    /// Room for states of `layout`.
    #[must_use]
    pub fn new(layout: Layout, grid: &PeriodicGrid, derivative: &Derivative) -> Self {
        let nodes = layout.nodes();
        let mut shape = ShapeFields::new(nodes);
        if let Some(grading) = derivative.grading() {
            shape.weight = grading.weight().to_vec();
        }
        let mut of_motion = shape.clone();
        if layout.metric().is_none() {
            of_motion.weight = Vec::new();
        }
        let sawtooth = grid.sawtooth_mode().map(|mode| Sawtooth {
            mode,
            square: 1.0 / derivative.minus_laplacian()[mode],
            turning: 0.0,
        });
        let frozen = Frozen {
            shape: shape.clone(),
            by_position: shape.position.clone(),
            along_tangent: vec![0.0; nodes],
            across_tangent: vec![0.0; nodes],
            sawtooth,
            line_tension: 0.0,
            by_weight: of_motion.weight.clone(),
            mean_by_weight: 0.0,
        };
        Self {
            layout: SpectralLayout::new(layout),
            grid: grid.clone(),
            embedding: Embedding::graded(nodes, derivative.grading().cloned()),
            sawtooth,
            dual: of_motion.clone(),
            motion: of_motion,
            shape,
            frozen,
            metric: layout.metric(),
            held: None,
            kept_area: None,
            angle: vec![0.0; nodes],
            values: vec![0.0; nodes],
            spectrum: vec![Complex64::default(); grid.modes()],
        }
    }

    /// Positions and tangents of a state; mean angle and mean position of the nodes are zero, on which no energy depends.
    fn embed(&mut self, at: &CurveFields) {
        let length = at.length();
        if let Some(metric) = at.moving_metric() {
            self.embedding.follow(metric);
            self.shape.weight.copy_from_slice(metric.weight());
        }
        self.spectrum.iter_mut().zip(at.weighted_spectrum(0)).for_each(|(k, kappa)| *k = kappa * length);
        self.embedding.set_tangent_spectrum(&self.spectrum, length, 0.0);
        let mut shortening = 1.0;
        if let Some(sawtooth) = &mut self.sawtooth {
            sawtooth.turning = self.spectrum[sawtooth.mode].re;
            shortening = sawtooth.shortening();
        }
        let tangent = self.embedding.tangent();
        for axis in 0..2 {
            scale_into(&mut self.shape.tangent[axis], shortening, tangent[axis]);
        }
        let position = self.embedding.shape_spectra();
        for axis in 0..2 {
            self.grid.synthesise(position[axis], &mut self.shape.position[axis]);
            scale(&mut self.shape.position[axis], shortening * length);
        }
        self.shape.length = length;
    }

    /// Takes what the area costs for what it does at `kept_area` from now on, a constant, or no longer.
    pub fn set_kept_area(&mut self, kept_area: Option<f64>) {
        self.kept_area = kept_area;
    }

    /// The area at which what it costs is a constant.
    #[must_use]
    pub fn kept_area(&self) -> Option<f64> {
        self.kept_area
    }

    /// Adds to the gradient, by K and by the length at fixed K; returns the energy.
    pub fn add_gradient(
        &mut self,
        terms: &mut [Box<dyn EnergyTerm>],
        at: &CurveFields,
        order: Order,
        gradient: &mut IntrinsicGradient,
    ) -> f64 {
        self.embed(at);
        self.dual.clear();
        let (mut energy, mut of_lines) = (0.0, 0.0);
        for term in terms.iter_mut().filter(|term| term.has_shape_energy()) {
            let value = constant(self.kept_area, &**term)
                .unwrap_or_else(|| term.add_shape_energy(&self.shape, order, &mut self.dual));
            energy += value;
            of_lines += if term.is_line_energy() { value } else { 0.0 };
        }
        if order >= Order::Hessian {
            self.frozen.line_tension = of_lines / at.length();
            self.held = None;
            self.frozen.clear();
            self.frozen.shape.copy_from(&self.shape);
            self.frozen.sawtooth = self.sawtooth;
        }
        self.pull_back(order, gradient);
        energy
    }

    /// Whether `term` has an energy of the positions at the fields `at`, or derivatives of one.
    pub fn is_changed_by(&mut self, term: &mut dyn EnergyTerm, at: &CurveFields) -> bool {
        self.embed(at);
        self.dual.clear();
        let energy = term.add_shape_energy(&self.shape, Order::Gradient, &mut self.dual);
        energy != 0.0 || !self.dual.is_zero()
    }

    /// Adds `multiplier` × area to the energy that was linearised last, and to its `gradient`.
    pub fn hold_area(&mut self, multiplier: f64, gradient: &mut IntrinsicGradient) {
        let mut held = Area::Pressure(-multiplier);
        self.dual.clear();
        held.add_shape_energy(&self.shape, Order::Gradient, &mut self.dual);
        self.held = Some(held);
        self.pull_back(Order::Hessian, gradient);
    }

    /// Tension at the linearisation of the terms that are line energies.
    #[must_use]
    pub fn line_tension(&self) -> f64 {
        self.frozen.line_tension
    }

    /// |Σ ∂𝓕/∂γ| over the size of the derivatives by positions, of the gradient evaluated last; after [`ShapeEnergy::hold_area`] of the area
    /// alone.
    #[must_use]
    pub fn net_force(&self) -> f64 {
        let [x, y] = self.dual.positions();
        let size = (mean_of_product(x, x) + mean_of_product(y, y)).sqrt();
        if size == 0.0 { 0.0 } else { mean(x).hypot(mean(y)) / size }
    }

    /// Adds the second derivative times the motion `v` of the spectral state vector.
    pub fn add_hessian_product(
        &mut self,
        terms: &mut [Box<dyn EnergyTerm>],
        v: &[f64],
        out: &mut IntrinsicGradient,
    ) {
        let length = self.frozen.shape.length;
        self.embed_motion(v);
        self.dual.clear();
        let kept = self.kept_area;
        let moves = |term: &dyn EnergyTerm| term.has_shape_energy() && constant(kept, term).is_none();
        for term in terms.iter_mut().filter(|term| moves(&***term)) {
            term.add_shape_hessian_product(&self.frozen.shape, &self.motion, &mut self.dual);
        }
        if let Some(held) = &mut self.held {
            held.add_shape_hessian_product(&self.frozen.shape, &self.motion, &mut self.dual);
        }
        out.by_length += self.dual.length;
        for axis in 0..2 {
            let (by_position, x) = (&self.frozen.by_position[axis], &self.frozen.shape.position[axis]);
            out.by_length += mean_of_product(&self.dual.position[axis], x) / length;
            // δ(γ/L) = (δγ − γ δL/L)/L.
            let shrink = self.motion.length / length * mean_of_product(by_position, x);
            out.by_length += (mean_of_product(by_position, &self.motion.position[axis]) - shrink) / length;
            let stretch = self.motion.length / length;
            for (dual, by_position) in self.dual.position[axis].iter_mut().zip(by_position) {
                *dual += stretch * by_position;
            }
            self.pull_back_to_tangent(axis, length);
        }
        let ([c, s], [by_x, by_y]) = (self.frozen.shape.tangents(), self.dual.tangents());
        let (along, across) = (&self.frozen.along_tangent, &self.frozen.across_tangent);
        let mut shortening = 0.0;
        if let Some(sawtooth) = self.frozen.sawtooth {
            let turning = self.layout.spectra(v)[sawtooth.mode].re;
            for (i, value) in self.values.iter_mut().enumerate() {
                *value = self.angle[i] * across[i] + c[i] * by_x[i] + s[i] * by_y[i];
            }
            if self.metric.is_some() {
                let weights = self.motion.weight.iter().zip(&self.frozen.shape.weight);
                for ((value, (change, weight)), along) in self.values.iter_mut().zip(weights).zip(along) {
                    *value += change / weight * along;
                }
            }
            let product = sawtooth.second() * turning * mean(along) + sawtooth.first() * mean(&self.values);
            out.spectra[sawtooth.mode].re += product;
            shortening = sawtooth.first() * turning;
        }
        if let Some(field) = self.metric {
            self.move_by_metric(field, shortening, out);
        }
        let ([c, s], [by_x, by_y]) = (self.frozen.shape.tangents(), self.dual.tangents());
        let (along, across) = (&self.frozen.along_tangent, &self.frozen.across_tangent);
        let stretch = |i: usize| match self.metric {
            Some(_) => shortening + self.motion.weight[i] / self.frozen.shape.weight[i],
            None => shortening,
        };
        for (i, angle) in self.angle.iter_mut().enumerate() {
            *angle = c[i] * by_y[i] - s[i] * by_x[i] + stretch(i) * across[i] - *angle * along[i];
        }
        self.pull_back_to_turning(out);
    }
}
