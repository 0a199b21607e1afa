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
    let chosen = || {
        let crowds = graded && scene.flow.follows_solution();
        if crowds { DerivativeFamily::Central8 } else { DerivativeFamily::Fourier }
    };
    scene.accuracy.derivative.family().unwrap_or_else(chosen)
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
