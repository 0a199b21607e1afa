//! A file of points.

use flow_core::geometry::shapes::Shape;
use flow_core::run::scene::parse_points;

use super::check_message;

/// More are not tried here: they take time, and nothing else.
const MOST: usize = 2048;
const NODES: usize = 32;

/// Reads points and lays a curve through them.
///
/// # Panics
/// If a curve comes of it that is none.
pub fn curve_points(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match parse_points(&text) {
        Err(error) => check_message(&error),
        Ok(mut points) => {
            points.truncate(MOST);
            match Shape::Points(points).resample(NODES) {
                Err(error) => check_message(&error),
                Ok(curve) => assert!(curve.length > 0.0 && curve.length.is_finite(), "{}", curve.length),
            }
        }
    }
}
