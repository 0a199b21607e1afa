//! The symbol of I − γJ with coefficients frozen at their means: one small block per mode.

use multiversion::multiversion;

use super::super::gradient_flow::GradientFlow;
use crate::geometry::vectors;
use crate::geometry::{Complex64, Layout};

/// Inverse blocks, one `fields × fields` matrix per mode, row by row.
#[derive(Clone, Debug)]
pub struct FourierSymbol {
    fields: usize,
    modes: usize,
    inverse: Vec<f64>,
    laplacian: Vec<f64>,
    /// Mean second derivatives, and the block of one mode.
    means: Vec<f64>,
    block: Vec<f64>,
    scratch: Vec<Complex64>,
    /// Whether the first unknown is the normal velocity u that makes the curvature, K = −|Γ|`Δ_s` u, with its symbols.
    of_velocity: bool,
    bend: Vec<f64>,
}

/// Symbols of 𝓚 by field: `Δ_s𝓑Δ_s` on the curvature, 𝓖 on the densities.
#[must_use]
pub fn mobility_symbol(flow: &GradientFlow, field: usize, minus_laplacian: f64, length: f64) -> f64 {
    match field {
        0 => {
            let square = minus_laplacian / (length * length);
            square * square * flow.normal_mobility().symbol(square)
        }
        _ => flow.density_mobilities()[field - 1].symbol(minus_laplacian, length),
    }
}

/// Symbol of −J from `field` to itself, with the second derivative of the energy density `mean`.
pub fn diagonal_symbol(flow: &GradientFlow, field: usize, minus_laplacian: f64, mean: f64) -> f64 {
    let length = flow.symbol_length();
    let stiffness = flow.energy_terms().implicit_stiffness()[field] * minus_laplacian / (length * length);
    mobility_symbol(flow, field, minus_laplacian, length) * (stiffness + mean)
}

impl FourierSymbol {
    /// Room for the blocks, of the normal velocity in place of the curvature or not.
    #[must_use]
    pub fn new(layout: Layout, modes: usize, of_velocity: bool) -> Self {
        let fields = layout.fields();
        Self {
            fields,
            modes,
            inverse: vec![0.0; fields * fields * modes],
            laplacian: vec![0.0; modes],
            means: vec![0.0; fields * fields],
            block: vec![0.0; fields * fields],
            scratch: vec![Complex64::default(); fields],
            of_velocity,
            bend: vec![1.0; modes],
        }
    }

    /// Inverts the blocks of the modes from `first` on, at the frozen state of `flow`.
    pub fn set(&mut self, flow: &GradientFlow, gamma: f64, first: usize) {
        let (fields, length) = (self.fields, flow.symbol_length());
        self.laplacian.copy_from_slice(flow.derivative().minus_laplacian());
        if self.of_velocity {
            let scale = flow.frozen().length() / (length * length);
            let symbols = self.bend.iter_mut().zip(&self.laplacian).skip(1);
            symbols.for_each(|(bend, symbol)| *bend = scale * symbol);
        }
        let (means, block) = (&mut self.means, &mut self.block);
        for a in 0..fields {
            for b in 0..fields {
                let energy = flow.energy_terms();
                means[a * fields + b] =
                    if a == b { energy.convex_mean(a) } else { vectors::mean(energy.implicit_second(a, b)) };
            }
        }
        // Compression makes modes grow; a preconditioner may leave that out.
        let tension = flow.mean_tension().max(0.0);
        if fields == 1 {
            return self.set_single(flow, gamma, first, length, tension);
        }
        for (mode, symbol) in self.laplacian.iter().enumerate().skip(first) {
            for a in 0..fields {
                let mobility = gamma * mobility_symbol(flow, a, *symbol, length);
                for b in 0..fields {
                    let cost = flow.energy_terms().implicit_cost(a, b) * symbol / (length * length);
                    block[a * fields + b] = mobility * (means[a * fields + b] + cost);
                }
                block[a * fields + a] += 1.0;
            }
            let square = symbol / (length * length);
            block[0] += gamma * tension * square * flow.normal_mobility().symbol(square);
            let target = &mut self.inverse[mode * fields * fields..(mode + 1) * fields * fields];
            if !invert(block, fields, target) {
                for a in 0..fields {
                    for b in 0..fields {
                        target[a * fields + b] = if a == b { 1.0 } else { 0.0 };
                    }
                }
            }
        }
    }

    /// As [`FourierSymbol::set`] for the curvature alone: its blocks are numbers, inverted in whole vector registers.
    fn set_single(&mut self, flow: &GradientFlow, gamma: f64, first: usize, length: f64, tension: f64) {
        // The copy of the symbols becomes that of the squares k²: `set` takes it anew each time.
        let (inverse, squares) = (&mut self.inverse[first..], &mut self.laplacian[first..]);
        for square in squares.iter_mut() {
            *square /= length * length;
        }
        flow.normal_mobility().symbols(squares, inverse);
        let coefficients = [self.means[0], flow.energy_terms().implicit_stiffness()[0], tension];
        let laplacian = &flow.derivative().minus_laplacian()[first..];
        invert_single(inverse, [laplacian, squares], length, gamma, coefficients);
    }

    /// Applies the inverse to the modes from `first` on.
    pub fn apply(&mut self, spectra: &mut [Complex64], first: usize) {
        if self.of_velocity {
            spectra.iter_mut().zip(&self.bend).skip(first).for_each(|(u, bend)| *u *= *bend);
        }
        self.apply_to_fields(spectra, first);
        if self.of_velocity {
            spectra.iter_mut().zip(&self.bend).skip(first).for_each(|(u, bend)| *u /= *bend);
        }
    }

    fn apply_to_fields(&mut self, spectra: &mut [Complex64], first: usize) {
        let (fields, modes) = (self.fields, self.modes);
        match fields {
            1 => {
                for (value, inverse) in spectra[first..].iter_mut().zip(&self.inverse[first..]) {
                    *value *= *inverse;
                }
            }
            2 => {
                let (kappa, rho) = spectra.split_at_mut(modes);
                let blocks = self.inverse[4 * first..].chunks_exact(4);
                for ((kappa, rho), block) in kappa[first..].iter_mut().zip(&mut rho[first..]).zip(blocks) {
                    let (a, b) = (*kappa, *rho);
                    *kappa = a * block[0] + b * block[1];
                    *rho = a * block[2] + b * block[3];
                }
            }
            _ => {
                for mode in first..modes {
                    let block = &self.inverse[mode * fields * fields..(mode + 1) * fields * fields];
                    for a in 0..fields {
                        self.scratch[a] =
                            (0..fields).map(|b| spectra[b * modes + mode] * block[a * fields + b]).sum();
                    }
                    for a in 0..fields {
                        spectra[a * modes + mode] = self.scratch[a];
                    }
                }
            }
        }
    }
}

/// The inverses of 1 + γk⁴𝓑(e″ + c k²) + `γTk²𝓑` for the squares k², in place of the symbols 𝓑.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn invert_single(
    inverse: &mut [f64],
    [laplacian, squares]: [&[f64]; 2],
    length: f64,
    gamma: f64,
    [mean, coefficient, tension]: [f64; 3],
) {
    for ((inverse, laplacian), square) in inverse.iter_mut().zip(laplacian).zip(squares) {
        let mobility = gamma * (square * square * *inverse);
        let stiffness = coefficient * laplacian / (length * length);
        let tension = gamma * tension * square * *inverse;
        let value = 1.0 / (mobility * mean + (1.0 + mobility * stiffness) + tension);
        *inverse = if value.is_finite() { value } else { 1.0 };
    }
}

/// Inverts a small matrix; false if it is singular.
fn invert(matrix: &mut [f64], size: usize, inverse: &mut [f64]) -> bool {
    match *matrix {
        [a] => {
            inverse[0] = 1.0 / a;
            inverse[0].is_finite()
        }
        [a, b, c, d] => {
            let scale = 1.0 / (a * d - b * c);
            inverse.copy_from_slice(&[scale * d, -scale * b, -scale * c, scale * a]);
            scale.is_finite()
        }
        _ => eliminate(matrix, size, inverse),
    }
}

/// Gauss–Jordan elimination with pivoting.
fn eliminate(matrix: &mut [f64], size: usize, inverse: &mut [f64]) -> bool {
    inverse.fill(0.0);
    for a in 0..size {
        inverse[a * size + a] = 1.0;
    }
    for column in 0..size {
        let mut pivot = column;
        for row in column..size {
            if matrix[row * size + column].abs() > matrix[pivot * size + column].abs() {
                pivot = row;
            }
        }
        let value = matrix[pivot * size + column];
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        for k in 0..size {
            matrix.swap(pivot * size + k, column * size + k);
            inverse.swap(pivot * size + k, column * size + k);
        }
        for k in 0..size {
            matrix[column * size + k] /= value;
            inverse[column * size + k] /= value;
        }
        for row in (0..size).filter(|row| *row != column) {
            let factor = matrix[row * size + column];
            for k in 0..size {
                matrix[row * size + k] -= factor * matrix[column * size + k];
                inverse[row * size + k] -= factor * inverse[column * size + k];
            }
        }
    }
    true
}
