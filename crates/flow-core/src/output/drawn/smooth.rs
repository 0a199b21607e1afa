//! A frame between its nodes.

use crate::run::Frame;

/// The fields of `frame` on at least `least` nodes, the old ones among them: curves are drawn as the trigonometric
/// polynomials that they are (`THEORY.md`, eq. (D1)), not as polygons. A frame with gaps, or one that is fine enough, stays
/// as it is.
pub(in crate::output) fn smooth(frame: &Frame, least: usize) -> Frame {
    let nodes = frame.nodes();
    let fields = || frame.nodal_fields().filter(|field| !field.is_empty());
    let whole = frame.position.len() == nodes && fields().all(|field| field.len() == nodes);
    // One value that is not finite would spread over the whole curve.
    let finite = || fields().flatten().chain(frame.position.iter().flatten()).all(|value| value.is_finite());
    if nodes < 3 || nodes >= least || !whole || !finite() {
        return frame.clone();
    }
    frame.clone().resampled(nodes * least.div_ceil(nodes))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn circle(nodes: usize) -> Frame {
        let at = |i: usize| TAU * i as f64 / nodes as f64;
        Frame {
            position: (0..nodes).map(|i| [5.0 + at(i).cos(), at(i).sin()]).collect(),
            curvature: vec![1.0; nodes],
            metric: vec![TAU; nodes],
            normal_velocity: vec![0.0; nodes],
            ..Frame::default()
        }
    }

    #[test]
    fn a_circle_of_few_nodes_is_round() {
        let drawn = smooth(&circle(9), 100);
        assert_eq!(drawn.position.len(), 108);
        for [x, y] in &drawn.position {
            assert!(((x - 5.0).hypot(*y) - 1.0).abs() < 1e-14);
        }
        for (old, new) in circle(9).position.iter().zip(drawn.position.iter().step_by(12)) {
            assert!((old[0] - new[0]).hypot(old[1] - new[1]) < 1e-14);
        }
    }

    #[test]
    fn gaps_stay_where_they_are() {
        let mut gap = circle(9);
        gap.position[2] = [f64::NAN; 2];
        assert_eq!(smooth(&gap, 100).position.len(), 9);
        gap.position.pop();
        assert_eq!(smooth(&gap, 100).position.len(), 8);
        assert_eq!(smooth(&circle(1), 100).curvature.len(), 1);
        assert!(smooth(&Frame::default(), 100).curvature.is_empty());
    }
}
