//! The part of the flow with coefficients frozen at their means: one small block for each Fourier mode. See `THEORY.md`, eq. (I11).

use nalgebra::{DMatrix, Matrix2, Matrix3};

use crate::flow::{GradientFlow, mobility_symbol};
use crate::geometry::vectors::mean;
use crate::integrator::LinearPart;

/// Rate of the length over the slowest of the other rates from which on it is stiff.
const STIFF: f64 = 100.0;
const MOST_FIELDS: usize = LinearPart::MOST_FIELDS;
/// Part of the fastest rate of the shortest waves by which another one may be off.
const ROUNDING: f64 = 1e-12;

/// Whether the derivatives of `flow` are diagonal in Fourier space.
pub fn exists(flow: &GradientFlow) -> bool {
    flow.is_equidistant() && flow.layout().fields() <= MOST_FIELDS
}

/// −D S for each mode, at the linearisation of `flow`, into `part`: D the symbols of the mobilities, S the means of the second
/// derivatives, with the tension. Similar to the symmetric −D^{½}SD^{½}, whose eigenbasis serves. A length under a stiff penalty
/// drives all by its own column of −𝓚 Hess `𝓕_h`; a soft one is left to the rest. False if that is not finite, or of no
/// use.
pub fn set(part: &mut LinearPart, flow: &mut GradientFlow) -> bool {
    let (fields, length) = (flow.layout().fields(), flow.frozen().length());
    let modes = flow.spectral_layout().modes();
    part.clear(fields, modes);
    let tension = flow.mean_tension();
    let mut means = [[0.0; MOST_FIELDS]; MOST_FIELDS];
    let energy = flow.energy_terms();
    for (a, row) in means[..fields].iter_mut().enumerate() {
        row[..fields]
            .iter_mut()
            .enumerate()
            .for_each(|(b, value)| *value = mean(energy.implicit_second(a, b)));
    }
    let (mut root, mut scale) = ([0.0; MOST_FIELDS], [1.0; MOST_FIELDS]);
    for mode in 0..modes {
        let symbol = flow.derivative().minus_laplacian()[mode];
        let square = symbol / (length * length);
        for field in 0..fields {
            root[field] = mobility_symbol(flow, field, symbol, length).sqrt();
            // What does not move has the eigenvalue 0: any basis serves.
            scale[field] = if root[field] > 0.0 { root[field] } else { 1.0 };
        }
        let block = |a: usize, b: usize| {
            let stretched = if a == 0 && b == 0 && square > 0.0 { tension / square } else { 0.0 };
            let cost = flow.energy_terms().implicit_cost(a, b) * square;
            -root[a] * (means[a][b] + cost + stretched) * root[b]
        };
        let mut take = |place: usize, rate: f64, vector: &[f64]| {
            part.set_eigenvector(mode, place, rate, vector, &scale[..fields]);
        };
        match fields {
            1 => take(0, block(0, 0), &[1.0]),
            2 => {
                let eigen = Matrix2::from_fn(block).symmetric_eigen();
                (0..2).for_each(|k| take(k, eigen.eigenvalues[k], eigen.eigenvectors.column(k).as_slice()));
            }
            3 => {
                let eigen = Matrix3::from_fn(block).symmetric_eigen();
                (0..3).for_each(|k| take(k, eigen.eigenvalues[k], eigen.eigenvectors.column(k).as_slice()));
            }
            _ => {
                let eigen = DMatrix::from_fn(fields, fields, block).symmetric_eigen();
                (0..fields)
                    .for_each(|k| take(k, eigen.eigenvalues[k], eigen.eigenvectors.column(k).as_slice()));
            }
        }
    }
    // Curvature alone holds no length more stiffly than its own slowest waves.
    if fields > 1 || flow.energy_terms().holds_length(length) {
        part.drive_by_last(
            |unit, column| flow.implicit_product(unit, column),
            |own, slowest| -own > STIFF * slowest,
        );
    }
    part.fits(2 * fields * modes + 1) && !grows(part.rates(), fields, modes)
}

/// Whether the shortest waves grow: a flow that is not well posed, whose explosion exponential steps would follow for long. What does not
/// move has the rate zero but for rounding.
fn grows(rates: &[f64], fields: usize, modes: usize) -> bool {
    let shortest = || (1..=fields).map(|field| rates[2 * field * modes - 1]);
    let rounding = ROUNDING * shortest().fold(0.0, |most: f64, rate| most.max(rate.abs()));
    shortest().any(|rate| rate > rounding)
}
