//! One membrane at radii from 1e-6 to 1e6, its coefficients scaled alike: the same run but for the unit of length.

use flow_core::run::{Frame, Record};

use crate::{last, run, scene};

/// Radii.
pub const RADII: [f64; 5] = [1e-6, 1e-3, 1.0, 1e3, 1e6];

/// The membrane at scale `radius`.
///
/// Bending 1 makes energies go with 1/R and times with R⁴; so β goes with 1/R³ and the ε of the membrane with R².
#[must_use]
pub fn at(radius: f64) -> Record {
    run(&scene(&format!(
        "
        curve = {{ shape = 'polar', r = '{radius:e}*(1 + 0.35*cos(3*phi))' }}
        density = [{{ name = 'membrane', initial = '1 + 0.2*cos(2*pi*s)', mobility = 'diffusion' }}]
        energy.bending.rigidity = 1.0
        energy.length = {{ penalty = {:e}, target_ratio = 1.0 }}
        energy.membrane = {{ density = 'membrane', epsilon = {:e} }}
        time = {{ end = {:e}, stop_at_equilibrium = false }}
        accuracy = {{ tolerance = 1e-6, nodes = 128 }}
        output.frames = 4
        ",
        5.0 / radius.powi(3),
        0.05 * radius.powi(2),
        0.1 * radius.powi(4),
    )))
}

/// Largest relative distance of the last frame of `record`, at scale `radius`, from that of `unit`.
#[must_use]
pub fn distance(record: &Record, radius: f64, unit: &Record) -> f64 {
    let (scaled, unit) = (last(record), last(unit));
    let fields: [(Nodal, f64); 4] = [
        (|frame| &frame.curvature, radius),
        (|frame| &frame.metric, 1.0 / radius),
        (|frame| &frame.normal_velocity, radius.powi(3)),
        (|frame| &frame.density[0], 1.0),
    ];
    let energy = (scaled.energy * radius / unit.energy - 1.0).abs();
    fields
        .iter()
        .fold(energy, |worst, (field, scale)| worst.max(difference(field(scaled), *scale, field(unit))))
}

type Nodal = fn(&Frame) -> &[f64];

/// Largest |scale·a − b| over the largest |b|.
fn difference(a: &[f64], scale: f64, b: &[f64]) -> f64 {
    let largest = b.iter().fold(f64::MIN_POSITIVE, |most, value| value.abs().max(most));
    a.iter().zip(b).fold(0.0, |worst, (a, b)| ((scale * a - b) / largest).abs().max(worst))
}
