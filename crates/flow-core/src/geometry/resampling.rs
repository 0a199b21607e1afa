//! Trigonometric polynomials on other grids.

use super::grid::{Complex64, PeriodicGrid};

/// The coefficients on a grid of `to` nodes of the polynomial with the coefficients `spectrum` on `nodes` nodes. Modes that the
/// new grid does not hold are lost.
pub fn resample_spectrum(nodes: usize, spectrum: &[Complex64], to: usize, out: &mut [Complex64]) {
    let common = out.len().min(spectrum.len());
    out[..common].copy_from_slice(&spectrum[..common]);
    out[common..].fill(Complex64::default());
    // The sawtooth, alone in the spectrum of a grid, is a pair of modes in that of a finer one.
    for mode in [nodes, to].into_iter().filter(|count| count.is_multiple_of(2)).map(|count| count / 2) {
        if let (Some(target), Some(value)) = (out.get_mut(mode), spectrum.get(mode)) {
            let [from, to] = [nodes, to].map(|count| PeriodicGrid::multiplicity_on(count, mode));
            *target = from / to * value;
        }
    }
    if to.is_multiple_of(2) && to / 2 < common {
        out[to / 2].im = 0.0;
    }
}

/// Periodic nodal values on `count` nodes instead.
///
/// # Panics
/// If there are fewer than two nodes before or after.
#[must_use]
pub fn resample(values: &[f64], count: usize) -> Vec<f64> {
    let (mut old, mut new) = (PeriodicGrid::new(values.len()), PeriodicGrid::new(count));
    let mut spectrum = vec![Complex64::default(); old.modes()];
    let mut resampled = vec![Complex64::default(); new.modes()];
    let mut out = vec![0.0; count];
    old.transform(values, &mut spectrum);
    resample_spectrum(values.len(), &spectrum, count, &mut resampled);
    new.synthesise(&resampled, &mut out);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finer_grid_holds_the_same_polynomial() {
        let (mut coarse, mut fine) = (PeriodicGrid::new(8), PeriodicGrid::new(24));
        let nodal: Vec<f64> = (0..8).map(|i| f64::from(i * i % 5)).collect();
        let mut spectrum = vec![Complex64::default(); coarse.modes()];
        coarse.transform(&nodal, &mut spectrum);
        let (mut finer, mut values) = (vec![Complex64::default(); fine.modes()], vec![0.0; 24]);
        resample_spectrum(8, &spectrum, 24, &mut finer);
        fine.synthesise(&finer, &mut values);
        for i in 0..8 {
            assert!((values[3 * i] - nodal[i]).abs() < 1e-14);
        }
        let mut back = vec![Complex64::default(); coarse.modes()];
        resample_spectrum(24, &finer, 8, &mut back);
        assert!(back.iter().zip(&spectrum).all(|(a, b)| (a - b).norm() < 1e-14));
    }
}
