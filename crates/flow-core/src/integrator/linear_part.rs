//! A part of the Jacobian whose exponential is at hand.

use multiversion::multiversion;
use serde::{Deserialize, Serialize};

use crate::geometry::vectors::add_scaled;

/// A linear part Λ of f whose exponential is at hand, in its eigenbasis: real eigenvalues, and a basis of each mode's block where several fields are coupled.
///
/// A vector holds the spectra of the fields one after the other, real and imaginary parts in turn; what comes after them stands alone.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LinearPart {
    fields: usize,
    /// Eigenvalue of each entry of a vector in the eigenbasis.
    rates: Vec<f64>,
    /// Matrices of `fields` × `fields` for each mode: row by row, each of their elements at all modes in turn, twice for the real
    /// and the imaginary part. Empty for one field, which is in its eigenbasis already.
    to: Vec<f64>,
    from: Vec<f64>,
    /// Whether the last entry drives the others, and then what else is in its eigenvector, in the eigenbasis of the blocks.
    is_driven: bool,
    driven: Vec<f64>,
    unit: Vec<f64>,
}

/// Part of the last eigenvalue by which it must differ from another one.
const LEAST_GAP: f64 = 1e-3;

impl LinearPart {
    /// Most fields that are coupled.
    pub const MOST_FIELDS: usize = 16;

    /// Room for `fields` fields of `modes` modes and one entry more; all is zero then. Storage is reused.
    pub fn clear(&mut self, fields: usize, modes: usize) {
        let entries = 2 * fields * modes;
        let blocks = if fields > 1 { fields * entries } else { 0 };
        self.fields = fields;
        self.is_driven = false;
        for (values, length) in [
            (&mut self.rates, entries + 1),
            (&mut self.to, blocks),
            (&mut self.from, blocks),
            (&mut self.driven, entries + 1),
        ] {
            values.clear();
            values.resize(length, 0.0);
        }
    }

    /// Takes an eigenvector of the block of mode `mode`, number `place` of them, with its eigenvalue: its component in field a is
    /// `vector`ₐ`scale`ₐ, where the vectors without their scales are orthonormal.
    pub fn set_eigenvector(&mut self, mode: usize, place: usize, rate: f64, vector: &[f64], scale: &[f64]) {
        let entries = (self.rates.len() - 1) / self.fields;
        let pair = |row: usize| row * entries + 2 * mode..row * entries + 2 * mode + 2;
        self.rates[pair(place)].fill(rate);
        if self.fields == 1 {
            return;
        }
        for (field, (component, scale)) in vector.iter().zip(scale).enumerate() {
            self.from[pair(field * self.fields + place)].fill(component * scale);
            self.to[pair(place * self.fields + field)].fill(component / scale);
        }
    }

    /// The last entry drives the others and itself at the rates that `column` writes, with the unit vector of that entry first: Λ
    /// has that last column as well, if `is_stiff` says so of the last of them and of the slowest of the other rates.
    pub fn drive_by_last(
        &mut self,
        column: impl FnOnce(&[f64], &mut [f64]),
        is_stiff: impl FnOnce(f64, f64) -> bool,
    ) {
        let slowest =
            self.rates.iter().map(|rate| rate.abs()).filter(|rate| *rate > 0.0).fold(f64::INFINITY, f64::min);
        let mut unit = std::mem::take(&mut self.unit);
        unit.clear();
        unit.resize(self.rates.len(), 0.0);
        if let Some(last) = unit.last_mut() {
            *last = 1.0;
        }
        column(&unit, &mut self.driven);
        self.unit = unit;
        let Some(own) = self.driven.last().copied().filter(|own| is_stiff(*own, slowest)) else { return };
        let mut driven = std::mem::take(&mut self.driven);
        self.to_eigenbasis(&mut driven);
        for (component, rate) in driven.iter_mut().zip(&self.rates) {
            let gap = own - rate;
            // Where two eigenvalues meet there is no such basis; what is left out is part of the rest.
            *component = if gap.abs() > LEAST_GAP * own.abs() { *component / gap } else { 0.0 };
        }
        self.driven = driven;
        self.is_driven = true;
        if let Some(rate) = self.rates.last_mut() {
            *rate = own;
        }
    }

    /// Eigenvalues, by entry.
    #[must_use]
    pub fn rates(&self) -> &[f64] {
        &self.rates
    }

    /// Takes `v` to the eigenbasis.
    pub fn to_eigenbasis(&self, v: &mut [f64]) {
        self.multiply(&self.to, v);
        self.add_driven(-1.0, v);
    }

    /// Takes `v` back.
    pub fn from_eigenbasis(&self, v: &mut [f64]) {
        self.add_driven(1.0, v);
        self.multiply(&self.from, v);
    }

    fn multiply(&self, matrices: &[f64], v: &mut [f64]) {
        if self.fields > 1 {
            multiply(self.fields, matrices, v);
        }
    }

    fn add_driven(&self, sign: f64, v: &mut [f64]) {
        if let Some((last, others)) = v.split_last_mut().filter(|_| self.is_driven) {
            add_scaled(others, sign * *last, &self.driven[..others.len()]);
        }
    }

    /// Whether it is of vectors of `size` entries, and finite.
    #[must_use]
    pub fn fits(&self, size: usize) -> bool {
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let blocks = if self.fields > 1 { self.fields * (size - 1) } else { 0 };
        (1..=Self::MOST_FIELDS).contains(&self.fields)
            && [(&self.rates, size), (&self.to, blocks), (&self.from, blocks), (&self.driven, size)]
                .into_iter()
                .all(|(values, length)| values.len() == length && finite(values))
    }
}

/// v ← Mv, mode by mode.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn multiply(fields: usize, matrices: &[f64], v: &mut [f64]) {
    let entries = matrices.len() / (fields * fields);
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

    /// Λv by the eigenbasis.
    fn product(part: &LinearPart, v: &[f64]) -> Vec<f64> {
        let mut w = v.to_vec();
        part.to_eigenbasis(&mut w);
        w.iter_mut().zip(part.rates()).for_each(|(w, rate)| *w *= rate);
        part.from_eigenbasis(&mut w);
        w
    }

    #[test]
    fn blocks_act_mode_by_mode() {
        // Two fields on three modes: the eigenvectors (0.6, 0.8) and (−0.8, 0.6), scaled by 1 and 2.
        let (modes, scale) = (3, [1.0, 2.0]);
        let mut part = LinearPart::default();
        part.clear(2, modes);
        for mode in 0..modes {
            part.set_eigenvector(mode, 0, -1.0 - mode as f64, &[0.6, 0.8], &scale);
            part.set_eigenvector(mode, 1, -5.0, &[-0.8, 0.6], &scale);
        }
        let size = 4 * modes + 1;
        assert!(part.fits(size));
        let v: Vec<f64> = (0..size).map(|i| 1.0 + i as f64).collect();
        let w = product(&part, &v);
        for mode in 0..modes {
            let rate = -1.0 - mode as f64;
            for entry in [2 * mode, 2 * mode + 1] {
                let (a, b) = (v[entry], 0.5 * v[2 * modes + entry]);
                let [first, second] = [rate * (0.6 * a + 0.8 * b), -5.0 * (-0.8 * a + 0.6 * b)];
                assert!((w[entry] - (0.6 * first - 0.8 * second)).abs() < 1e-12);
                assert!((w[2 * modes + entry] - 2.0 * (0.8 * first + 0.6 * second)).abs() < 1e-12);
            }
        }
        assert_eq!(w[size - 1], 0.0);
    }

    #[test]
    fn the_last_entry_drives_the_others() {
        // Λ = (−1, 0, 4; 0, −1, 6; 0, 0, −5).
        let mut part = LinearPart::default();
        part.clear(1, 1);
        part.set_eigenvector(0, 0, -1.0, &[1.0], &[1.0]);
        part.drive_by_last(|_, column| column.copy_from_slice(&[4.0, 6.0, -5.0]), |own, slow| -own > slow);
        assert_eq!(part.rates(), [-1.0, -1.0, -5.0]);
        assert_eq!(product(&part, &[0.5, 0.25, 1.0]), [3.5, 5.75, -5.0]);
    }
}
