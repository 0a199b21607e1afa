//! What the choices of a scene stand for in the layers below.

use super::scene::{self, Scene};
use crate::flow::LinearSolver;
use crate::geometry::shapes::Shape;
use crate::operators::DerivativeFamily;

/// The curve that a scene names.
pub(super) fn shape(shape: &scene::Shape) -> Shape {
    match shape {
        scene::Shape::Circle { radius } => Shape::Circle { radius: *radius },
        scene::Shape::Ellipse { semi_axes } => Shape::Ellipse { semi_axes: *semi_axes },
        scene::Shape::Trillium {} => Shape::Trillium,
        scene::Shape::FigureEight { size } => Shape::FigureEight { size: *size },
        scene::Shape::Polar { r } => Shape::Polar { r: r.expression().clone() },
        scene::Shape::Parametric { x, y } => {
            Shape::Parametric { x: x.expression().clone(), y: y.expression().clone() }
        }
        scene::Shape::Points { points } => Shape::Points(points.clone()),
    }
}

/// The family of derivatives of `scene` on nodes that are `graded` or not.
pub(super) fn family(scene: &Scene, graded: bool) -> DerivativeFamily {
    match scene.accuracy.derivative {
        scene::Derivative::Auto if graded && scene.flow.follows_solution() => DerivativeFamily::Central8,
        scene::Derivative::Auto | scene::Derivative::Fourier => DerivativeFamily::Fourier,
        scene::Derivative::Central2 => DerivativeFamily::Central2,
        scene::Derivative::Central4 => DerivativeFamily::Central4,
        scene::Derivative::Central6 => DerivativeFamily::Central6,
        scene::Derivative::Central8 => DerivativeFamily::Central8,
    }
}

/// The linear solver that a scene names.
pub(super) fn linear_solver(solver: scene::LinearSolver) -> LinearSolver {
    match solver {
        scene::LinearSolver::Auto => LinearSolver::Auto,
        scene::LinearSolver::Fourier => LinearSolver::Fourier,
        scene::LinearSolver::Banded => LinearSolver::Banded,
        scene::LinearSolver::Dense => LinearSolver::Dense,
    }
}
