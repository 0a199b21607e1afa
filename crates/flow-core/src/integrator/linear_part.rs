//! A part of the Jacobian whose exponential is at hand.

use multiversion::multiversion;
use serde::{Deserialize, Serialize};

use crate::geometry::vectors::add_scaled;

/// Λ in its eigenbasis: real eigenvalues, and a basis of each mode's block where several fields are coupled.
///
/// A vector holds the spectra of the fields one after the other, real and imaginary parts in turn; what comes after them stands alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinearPart {
    /// Eigenvalue of each entry of a vector in the eigenbasis.
    rates: Vec<f64>,
    bases: Option<Bases>,
    /// What the last entry drives: of its eigenvector, the other entries in the eigenbasis of the blocks.
    driven: Option<Vec<f64>>,
}

/// Matrices of `fields` × `fields` for each mode: row by row, each of their elements at all modes in turn, twice for the real and
/// the imaginary part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Bases {
    fields: usize,
    to: Vec<f64>,
    from: Vec<f64>,
}

/// Part of the last eigenvalue by which it must differ from another one.
const LEAST_GAP: f64 = 1e-3;

impl LinearPart {
    /// Most fields that are coupled.
    pub const MOST_FIELDS: usize = 16;

    /// Of a vector that is in its eigenbasis already.
    #[must_use]
    pub fn diagonal(rates: Vec<f64>) -> Self {
        Self { rates, bases: None, driven: None }
    }

    /// Of `fields` complex fields, whose modes go to the eigenbasis by the matrices `to`, and back by `from`: row by row, each of
    /// their elements at all modes in turn, twice for the real and the imaginary part.
    #[must_use]
    pub fn blocks(rates: Vec<f64>, fields: usize, to: Vec<f64>, from: Vec<f64>) -> Self {
        Self { rates, bases: Some(Bases { fields, to, from }), driven: None }
    }

    /// The same with a last entry that drives the others and itself at the rates `column`: Λ has that last column as well.
    #[must_use]
    pub fn driven_by_last(mut self, mut column: Vec<f64>) -> Self {
        self.to_eigenbasis(&mut column);
        let Some(own) = column.pop() else { return self };
        for (component, rate) in column.iter_mut().zip(&self.rates) {
            let gap = own - rate;
            // Where two eigenvalues meet there is no such basis; what is left out is part of the rest.
            *component = if gap.abs() > LEAST_GAP * own.abs() { *component / gap } else { 0.0 };
        }
        if let Some(rate) = self.rates.last_mut() {
            *rate = own;
        }
        self.driven = Some(column);
        self
    }

    /// Eigenvalues, by entry.
    #[must_use]
    pub fn rates(&self) -> &[f64] {
        &self.rates
    }

    /// Takes `v` to the eigenbasis.
    pub fn to_eigenbasis(&self, v: &mut [f64]) {
        if let Some(bases) = &self.bases {
            bases.multiply(&bases.to, v);
        }
        self.add_driven(-1.0, v);
    }

    /// Takes `v` back.
    pub fn from_eigenbasis(&self, v: &mut [f64]) {
        self.add_driven(1.0, v);
        if let Some(bases) = &self.bases {
            bases.multiply(&bases.from, v);
        }
    }

    fn add_driven(&self, sign: f64, v: &mut [f64]) {
        if let (Some(driven), Some((last, others))) = (&self.driven, v.split_last_mut()) {
            add_scaled(others, sign * *last, driven);
        }
    }

    /// Whether it is of vectors of `size` entries, and finite.
    #[must_use]
    pub fn fits(&self, size: usize) -> bool {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let sound = |bases: &Bases| {
            let entries = size.saturating_sub(1) * bases.fields;
            [&bases.to, &bases.from].into_iter().all(|matrices| matrices.len() == entries && finite(matrices))
        };
        let driven = self.driven.as_ref().is_none_or(|driven| driven.len() + 1 == size && finite(driven));
        self.rates.len() == size && finite(&self.rates) && driven && self.bases.as_ref().is_none_or(sound)
    }
}

impl Bases {
    /// v ← Mv, mode by mode.
    fn multiply(&self, matrices: &[f64], v: &mut [f64]) {
        let entries = matrices.len() / (self.fields * self.fields);
        multiply(self.fields, entries, matrices, v);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn multiply(fields: usize, entries: usize, matrices: &[f64], v: &mut [f64]) {
    if fields == 2 {
        let (first, rest) = v.split_at_mut(entries);
        let (top, bottom) = matrices.split_at(2 * entries);
        let elements = top[..entries].iter().zip(&top[entries..]);
        let elements = elements.zip(bottom[..entries].iter().zip(&bottom[entries..]));
        for ((a, b), ((aa, ab), (ba, bb))) in first.iter_mut().zip(rest).zip(elements) {
            (*a, *b) = (aa * *a + ab * *b, ba * *a + bb * *b);
        }
        return;
    }
    for entry in 0..entries {
        let mut old = [0.0; LinearPart::MOST_FIELDS];
        (0..fields).for_each(|field| old[field] = v[field * entries + entry]);
        for row in 0..fields {
            let element = |column: usize| matrices[(row * fields + column) * entries + entry];
            v[row * entries + entry] = (0..fields).map(|column| element(column) * old[column]).sum();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_act_mode_by_mode() {
        // Two fields on six modes; the matrix of mode m is (1, m; 0, 2), its inverse (1, −m/2; 0, ½).
        let modes = 6;
        let element = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..modes).flat_map(|m| [of(f64::from(m)); 2]).collect()
        };
        let matrices = |elements: [&dyn Fn(f64) -> f64; 4]| elements.into_iter().flat_map(element).collect::<Vec<_>>();
        let to = matrices([&|_| 1.0, &|m| m, &|_| 0.0, &|_| 2.0]);
        let from = matrices([&|_| 1.0, &|m| -m / 2.0, &|_| 0.0, &|_| 0.5]);
        let size = 4 * modes as usize + 1;
        let part = LinearPart::blocks(vec![0.0; size], 2, to, from);
        assert!(part.fits(size));
        let v: Vec<f64> = (0..size).map(|i| i as f64).collect();
        let mut w = v.clone();
        part.to_eigenbasis(&mut w);
        assert_eq!(w[6], v[6] + 3.0 * v[18]);
        assert_eq!(w[19], 2.0 * v[19]);
        assert_eq!(w[24], v[24]);
        part.from_eigenbasis(&mut w);
        assert_eq!(w, v);
    }

    #[test]
    fn the_last_entry_drives_the_others() {
        // Λ = (−1, 0, 4; 0, −2, 6; 0, 0, −5).
        let part = LinearPart::diagonal(vec![-1.0, -2.0, 0.0]).driven_by_last(vec![4.0, 6.0, -5.0]);
        assert_eq!(part.rates(), [-1.0, -2.0, -5.0]);
        let mut v = vec![0.5, 0.25, 1.0];
        let exact = [-0.5 + 4.0, -0.5 + 6.0, -5.0];
        part.to_eigenbasis(&mut v);
        v.iter_mut().zip(part.rates()).for_each(|(v, rate)| *v *= rate);
        part.from_eigenbasis(&mut v);
        assert_eq!(v, exact);
    }
}
