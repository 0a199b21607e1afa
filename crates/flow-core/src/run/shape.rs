//! The curve of a scene as a shape.

use super::scene;
use crate::geometry::shapes::Shape;

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
