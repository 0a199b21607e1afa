//! Proposition 3 of the paper: what a piece of an incompressible curve gains in length under the normal motion alone is
//! what flows into it of the membrane.

use flow_core::run::{Frame, Record};

use super::fields::Interpolant;
use crate::{last, run, shipped};

/// Pieces of the labels, by their ends; one of them is nearly the whole curve.
const PIECES: [[f64; 2]; 6] =
    [[0.0, 0.05], [0.11, 0.2345], [0.3, 0.5], [0.47, 0.48], [0.6, 0.9], [0.01, 0.99]];

/// One piece of one frame. All rates are those of length.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Time of the frame.
    pub time: f64,
    /// Ends of the piece.
    pub ends: [f64; 2],
    /// Rate of its length, by moving the curve along its normal and back by the velocity V.
    pub measured: f64,
    /// ∫κV dσ over the piece.
    pub predicted: f64,
    /// Inflow of the membrane: flux at the first end less that at the second.
    pub inflow: f64,
    /// Largest |κV||Γ|, the scale of the rates.
    pub scale: f64,
}

/// The pieces of the incompressible trillium at t = 0.001 and 0.01, for one derivative family.
#[must_use]
pub fn measure(derivative: &str) -> Vec<Piece> {
    let changes = [
        ("accuracy.derivative", derivative),
        ("accuracy.tolerance", "1e-7"),
        ("accuracy.nodes", "512"),
        ("output.frames", "10"),
        ("output.fields", "['membrane-flux']"),
    ];
    let record: Record = run(&shipped("incompressible", &changes));
    [&record.frames[1], last(&record)].into_iter().flat_map(pieces).collect()
}

fn pieces(frame: &Frame) -> Vec<Piece> {
    let flux = Interpolant::new(&frame.fields[0]);
    let bent: Vec<f64> =
        frame.curvature.iter().zip(&frame.normal_velocity).map(|(k, v)| k * v * frame.length).collect();
    let scale = bent.iter().fold(0.0, |most: f64, value| value.abs().max(most));
    let step = 1e-4 / scale * frame.length;
    let (forth, back) = (Interpolant::new(&metric(frame, step)), Interpolant::new(&metric(frame, -step)));
    let stretching = Interpolant::new(&bent);
    let piece = |ends: &[f64; 2]| {
        let [start, end] = *ends;
        Piece {
            time: frame.time,
            ends: *ends,
            measured: (forth.integral(start, end) - back.integral(start, end)) / (2.0 * step),
            predicted: stretching.integral(start, end),
            inflow: flux.at(start) - flux.at(end),
            scale,
        }
    };
    PIECES.iter().map(piece).collect()
}

/// |∂_s(γ + hVn)| at the nodes.
fn metric(frame: &Frame, h: f64) -> Vec<f64> {
    let n = frame.position.len();
    let slopes = |values: &[f64]| -> Vec<f64> {
        let interpolant = Interpolant::new(values);
        (0..n).map(|i| interpolant.slope_at(i as f64 / n as f64)).collect()
    };
    let axis = |axis: usize| frame.position.iter().map(|point| point[axis]).collect::<Vec<_>>();
    let (x, y) = (axis(0), axis(1));
    let (tx, ty) = (slopes(&x), slopes(&y));
    // n = (τ_y, −τ_x).
    let moved = |axis: &[f64], normal: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..n).map(|i| axis[i] + h * frame.normal_velocity[i] * normal(i) / frame.length).collect()
    };
    let (mx, my) = (slopes(&moved(&x, &|i| ty[i])), slopes(&moved(&y, &|i| -tx[i])));
    mx.iter().zip(my).map(|(x, y)| x.hypot(y)).collect()
}
