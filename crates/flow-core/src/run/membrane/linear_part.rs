//! The part of the flow with coefficients frozen at their means: one small block for each Fourier mode. See `THEORY.md`, eq. (I10).

use nalgebra::{DMatrix, Matrix2};

use crate::flow::{GradientFlow, mobility_symbol};
use crate::geometry::vectors::mean;
use crate::integrator::LinearPart;

/// Rate of the length over the slowest of the other rates from which on it is stiff.
const STIFF: f64 = 100.0;
const MOST_FIELDS: usize = LinearPart::MOST_FIELDS;

/// Whether the derivatives of `flow` are diagonal in Fourier space.
pub fn exists(flow: &GradientFlow) -> bool {
    flow.grading().is_none() && flow.layout().metric().is_none() && flow.layout().fields() <= MOST_FIELDS
}

/// −D S for each mode, at the linearisation of `flow`: D the symbols of the mobilities, S the means of the second derivatives, with
/// the tension. Similar to the symmetric −D^{½}SD^{½}, whose eigenbasis serves. A length under a stiff penalty drives all by its
/// own column of −𝓚 Hess `𝓕_h`; a soft one is left to the rest.
pub fn of(flow: &mut GradientFlow) -> Option<LinearPart> {
    let (fields, length) = (flow.layout().fields(), flow.frozen().length());
    let laplacian = flow.grid_and_derivative().1.minus_laplacian().to_vec();
    let tension = flow.mean_tension();
    let jet = flow.energy_terms().jet();
    let means: Vec<f64> = (0..fields * fields).map(|i| mean(jet.second(i / fields, i % fields))).collect();
    let stiffness = flow.energy_terms().implicit_stiffness().to_vec();
    let entries = 2 * laplacian.len();
    let mut rates = vec![0.0; fields * entries + 1];
    let (mut to, mut from) = (vec![0.0; fields * fields * entries], vec![0.0; fields * fields * entries]);
    let mut root = [0.0; MOST_FIELDS];
    for (mode, symbol) in laplacian.into_iter().enumerate() {
        let square = symbol / (length * length);
        for (field, root) in root[..fields].iter_mut().enumerate() {
            *root = mobility_symbol(flow, field, symbol, length).sqrt();
        }
        let block = |a: usize, b: usize| {
            let own = if a == b { stiffness[a] * square } else { 0.0 };
            let stretched = if a == 0 && b == 0 && square > 0.0 { tension / square } else { 0.0 };
            -root[a] * (means[a * fields + b] + own + stretched) * root[b]
        };
        let set = |of: &mut [f64], place: usize, value: f64| {
            of[place * entries + 2 * mode..place * entries + 2 * mode + 2].fill(value);
        };
        // What does not move has the eigenvalue 0: any basis serves.
        let scale = |field: usize| if root[field] > 0.0 { root[field] } else { 1.0 };
        let mut take = |k: usize, rate: f64, vector: &[f64]| {
            set(&mut rates, k, rate);
            for (a, component) in vector.iter().enumerate() {
                set(&mut from, a * fields + k, scale(a) * component);
                set(&mut to, k * fields + a, component / scale(a));
            }
        };
        match fields {
            1 => take(0, block(0, 0), &[1.0]),
            2 => {
                let eigen = Matrix2::from_fn(block).symmetric_eigen();
                (0..2).for_each(|k| take(k, eigen.eigenvalues[k], eigen.eigenvectors.column(k).as_slice()));
            }
            _ => {
                let eigen = DMatrix::from_fn(fields, fields, block).symmetric_eigen();
                (0..fields).for_each(|k| take(k, eigen.eigenvalues[k], eigen.eigenvectors.column(k).as_slice()));
            }
        }
    }
    let size = rates.len();
    let slow = rates[..size - 1].iter().map(|rate| rate.abs()).filter(|rate| *rate > 0.0).fold(f64::INFINITY, f64::min);
    let part = if fields == 1 { LinearPart::diagonal(rates) } else { LinearPart::blocks(rates, fields, to, from) };
    let column = by_length(flow, size);
    let is_stiff = -column[size - 1] > STIFF * slow;
    let part = if is_stiff { part.driven_by_last(column) } else { part };
    part.fits(size).then_some(part)
}

/// The column of the length in the implicit operator.
fn by_length(flow: &mut GradientFlow, size: usize) -> Vec<f64> {
    let (mut unit, mut column) = (vec![0.0; size], vec![0.0; size]);
    unit[size - 1] = 1.0;
    flow.implicit_product(&unit, &mut column);
    column
}
