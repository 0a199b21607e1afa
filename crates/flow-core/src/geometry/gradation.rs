//! Gradings that follow the scales of a solution. See `THEORY.md`, eq. (D13).

use multiversion::multiversion;

use super::grading::Grading;
use super::grid::{Complex64, PeriodicGrid};
use crate::expression::vector_math::exp;

/// The spacing grows at most at this rate with the distance: a layer of width d at distance x asks for max(d, |x|). A function
/// with a pole at distance d from the real line is then resolved by a number of nodes that grows as ln(1/d).
const GROWTH: f64 = 1.0;
/// Modes, in roots of the number of nodes, beyond which the logarithm of the spacing is smoothed …
const SMOOTH: f64 = 1.25;
/// … and those in which the samples are, in multiples of that.
const CLEAN: f64 = 2.5;
/// Least number of points of the map, of which the second filter leaves a few millionths at half of it.
const LEAST_POINTS: usize = 256;

/// Samples (see [`Grading::samples`]) of the grading on `nodes` nodes whose spacing is inversely proportional to `wave_numbers`,
/// given at the `fractions` of the arc length in increasing order, the first of them 0.
///
/// # Panics
/// If there is no node or no fraction, not one wave number for each of these, or one that is not positive and finite.
#[must_use]
pub fn follow_scales(fractions: &[f64], wave_numbers: &[f64], nodes: usize) -> Vec<f64> {
    let count = fractions.len();
    assert!(nodes > 0 && count > 0, "a grading of {nodes} nodes by {count} fractions");
    assert_eq!(wave_numbers.len(), count, "one wave number per fraction");
    let usable = |k: &f64| *k > 0.0 && k.is_finite();
    assert!(wave_numbers.iter().all(usable), "wave numbers are positive and finite");
    let spacing: Vec<f64> = wave_numbers.iter().map(|k| 1.0 / k).collect();
    let spacing = limit_growth(fractions, spacing);
    let logarithms: Vec<f64> = spacing.iter().map(|h| h.ln()).collect();
    let samples = Grading::samples(nodes);
    let every = LEAST_POINTS.div_ceil(samples);
    let count = every * samples;
    let mut filter = Filter::new(count);
    // Smoothed along the parameter of the raw map, but as a function of the place x: the crowds stay where they are.
    let (places, mut logarithms) = place_nodes(fractions, &spacing, &logarithms, count);
    let modes = SMOOTH * (nodes as f64).sqrt();
    filter.low_pass(&mut logarithms, modes);
    let mut smooth = logarithms.clone();
    exponentiate(&mut smooth);
    let (_, mut logarithms) = place_nodes(&places, &smooth, &logarithms, count);
    filter.low_pass(&mut logarithms, CLEAN * modes);
    let mut samples: Vec<f64> = logarithms.into_iter().step_by(every).collect();
    exponentiate(&mut samples);
    samples
}

/// The largest spacing below `spacing` that grows at most at the rate [`GROWTH`].
fn limit_growth(fractions: &[f64], mut spacing: Vec<f64>) -> Vec<f64> {
    let count = spacing.len();
    let distance =
        |i: usize| if i + 1 < count { fractions[i + 1] - fractions[i] } else { 1.0 - fractions[i] };
    for i in 0..2 * count {
        let (left, right) = (i % count, (i + 1) % count);
        spacing[right] = spacing[right].min(spacing[left] + GROWTH * distance(left));
    }
    for i in (0..2 * count).rev() {
        let (left, right) = (i % count, (i + 1) % count);
        spacing[left] = spacing[left].min(spacing[right] + GROWTH * distance(left));
    }
    spacing
}

/// Places x of `count` nodes with dx/ds proportional to the `spacing` given at the `fractions`, and the `logarithms` of the spacing
/// there; the first is at 0.
fn place_nodes(fractions: &[f64], spacing: &[f64], logarithms: &[f64], count: usize) -> (Vec<f64>, Vec<f64>) {
    let points = fractions.len();
    let density: Vec<f64> = spacing.iter().map(|h| 1.0 / h).collect();
    let ends = |i: usize| if i + 1 < points { (i + 1, fractions[i + 1]) } else { (0, 1.0) };
    let mut reached = vec![0.0; points + 1];
    for i in 0..points {
        let (next, end) = ends(i);
        reached[i + 1] = reached[i] + 0.5 * (end - fractions[i]) * (density[i] + density[next]);
    }
    let (mut places, mut levels) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let step = reached[points] / count as f64;
    let mut node = 0;
    for left in 0..points {
        let (next, end) = ends(left);
        let per_density = 1.0 / (reached[left + 1] - reached[left]);
        let until = if left + 1 < points { reached[left + 1] } else { f64::INFINITY };
        while node < count && step * (node as f64) < until {
            let part = (step * node as f64 - reached[left]) * per_density;
            places.push(fractions[left] + part * (end - fractions[left]));
            levels.push(logarithms[left] + part * (logarithms[next] - logarithms[left]));
            node += 1;
        }
    }
    (places, levels)
}

/// A Gaussian filter of periodic values.
struct Filter {
    grid: PeriodicGrid,
    spectrum: Vec<Complex64>,
    factors: Vec<f64>,
}

impl Filter {
    fn new(count: usize) -> Self {
        let grid = PeriodicGrid::new(count);
        let modes = grid.modes();
        Self { grid, spectrum: vec![Complex64::default(); modes], factors: vec![0.0; modes] }
    }

    /// Smooths `values` with the cut-off `modes`.
    fn low_pass(&mut self, values: &mut [f64], modes: f64) {
        self.grid.transform(values, &mut self.spectrum);
        for (mode, factor) in self.factors.iter_mut().enumerate() {
            *factor = -(mode as f64 / modes).powi(2);
        }
        exponentiate(&mut self.factors);
        for (value, factor) in self.spectrum.iter_mut().zip(&self.factors) {
            *value *= *factor;
        }
        self.grid.synthesise(&self.spectrum, values);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn exponentiate(values: &mut [f64]) {
    for value in values {
        *value = exp(*value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wave numbers of one layer of width `d` at `place`.
    fn layer(d: f64, place: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
        let fractions: Vec<f64> = (0..count).map(|i| i as f64 / count as f64).collect();
        let near = |x: &f64| 1.0 / (d * ((x - place) / d).cosh().powi(2)).max(1e-300) + 6.0;
        let waves =
            fractions.iter().map(|x| if (x - place).abs() < 20.0 * d { near(x).min(1.0 / d) } else { 6.0 });
        (fractions.clone(), waves.collect())
    }

    #[test]
    fn nodes_crowd_where_the_layer_is() {
        for (d, place) in [(0.02, 0.5), (0.002, 0.31)] {
            let (fractions, waves) = layer(d, place, 4096);
            let grading = Grading::new(&follow_scales(&fractions, &waves, 128)).unwrap();
            let densest =
                (0..128).min_by(|a, b| grading.weight()[*a].total_cmp(&grading.weight()[*b])).unwrap();
            assert!(
                (grading.fractions()[densest] - place).abs() < d,
                "{d}: {}",
                grading.fractions()[densest]
            );
        }
    }

    #[test]
    fn a_tenfold_sharper_layer_asks_for_a_few_nodes_more() {
        // Nodes within the layer, of 128.
        let within = |d: f64| {
            let (fractions, waves) = layer(d, 0.5, 8192);
            let grading = Grading::new(&follow_scales(&fractions, &waves, 128)).unwrap();
            grading.fractions().iter().filter(|x| (**x - 0.5).abs() < 2.0 * d).count()
        };
        assert!(2 * within(0.002) > within(0.02), "{} and {}", within(0.002), within(0.02));
    }

    #[test]
    fn equal_scales_make_equal_distances() {
        let fractions: Vec<f64> = (0..50).map(|i| f64::from(i) / 50.0).collect();
        assert!(follow_scales(&fractions, &[7.0; 50], 32).iter().all(|w| (w - 1.0 / 7.0).abs() < 1e-14));
    }
}
