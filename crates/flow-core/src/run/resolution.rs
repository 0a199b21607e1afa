//! How many nodes a state needs, and how many the fronts that a scene names will need. See `THEORY.md`, eq. (D11).

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::floors::least_mean_square;
use super::scene::{Length, Scene};
use crate::geometry::vectors::dot;
use crate::geometry::{Layout, SpectralLayout};
use crate::operators::DerivativeFamily;

/// Fewest nodes that the automatic choice takes.
pub const LEAST_NODES: usize = 32;
/// Most nodes.
pub const MOST_NODES: usize = super::scene::MOST_NODES;
/// Part of the modes of a grid that should hold nothing.
const EMPTY: f64 = 0.2;
/// Largest distance of uniform nodes in units of ε: a front of width ε/√2 then spans about eight of them from
/// one side to the other.
const NODE_DISTANCE_PER_EPSILON: f64 = 0.55;
/// More nodes at a time than this factor are a guess.
const MOST_GROWTH: f64 = 2.0;

/// Part of the spectral `state`, the largest over its fields, that `nodes` nodes do not resolve.
pub fn unresolved(layout: Layout, state: &[f64], nodes: usize, family: DerivativeFamily) -> f64 {
    least_resolved(layout, state, nodes, family).1
}

/// The field of the spectral `state` that `nodes` nodes resolve least, and the part of it that they do not: what the highest modes
/// hold, or miss by the error of the derivative, relative to the field.
pub fn least_resolved(layout: Layout, state: &[f64], nodes: usize, family: DerivativeFamily) -> (usize, f64) {
    let spectral = SpectralLayout::new(layout);
    let length = state[spectral.length_index()];
    let first_empty = 0.5 * (1.0 - EMPTY) * nodes as f64;
    // Only differences miss something of the modes below.
    let first = if family == DerivativeFamily::Fourier { first_empty.ceil() as usize } else { 0 };
    let mut worst = (0, 0.0);
    for field in 0..layout.state_fields() {
        let spectrum = &state[spectral.field(field)];
        let missed: f64 = (first..spectral.modes())
            .map(|mode| {
                let angle = TAU * mode as f64 / nodes as f64;
                let error = if mode as f64 >= first_empty { 1.0 } else { family.symbol_error(angle) };
                error * error * (spectrum[2 * mode].powi(2) + spectrum[2 * mode + 1].powi(2))
            })
            .sum();
        let floor = least_mean_square(field, length); // as in the norm of the errors
        let part = (missed / dot(spectrum, spectrum).max(floor)).sqrt();
        if part > worst.1 {
            worst = (field, part);
        }
    }
    worst
}

/// Nodes, at the same parameters, on which at most the part `aim` of the spectral `state` is not resolved: a fast size. If more are
/// needed than the state has it is a guess, but where differences alone miss something, whose error is known on any nodes.
pub fn needed_nodes(layout: Layout, state: &[f64], aim: f64, family: DerivativeFamily) -> usize {
    let nodes = layout.nodes();
    let part = |nodes: usize| unresolved(layout, state, nodes, family);
    let now = part(nodes);
    if now <= aim {
        let fewer = SIZES.iter().take_while(|size| **size < nodes).find(|size| part(**size) <= aim);
        return fewer.copied().unwrap_or(nodes);
    }
    if let Some(order) = family.order()
        && unresolved(layout, state, nodes, DerivativeFamily::Fourier) <= aim
    {
        let more = SIZES.iter().skip_while(|size| **size <= nodes).find(|size| part(**size) <= aim);
        let beyond = |most: usize| most as f64 * (part(most) / aim).powf(1.0 / f64::from(order));
        return more.copied().unwrap_or_else(|| beyond(2 * MOST_NODES).ceil() as usize);
    }
    // As if the spectrum fell on as it does over the last modes.
    let before = 3 * nodes / 4;
    let rate = (part(before) / now).ln() / (nodes - before) as f64;
    let more = if rate > 0.0 { (now / aim).ln() / rate } else { f64::INFINITY };
    let least = nodes as f64 + more.min((MOST_GROWTH - 1.0) * nodes as f64);
    size_above(least).max(nodes)
}

/// Nodes that the sharpest fronts need on the longest curve expected, at equal distances; zero where no term makes fronts.
pub fn fronts(scene: &Scene, initial_length: f64) -> f64 {
    let target = match &scene.energy.length {
        Some(Length::Penalty { target, .. }) => target.length(initial_length),
        _ => initial_length,
    };
    scene
        .energy
        .front_width()
        .map_or(0.0, |width| target.max(initial_length) / (NODE_DISTANCE_PER_EPSILON * width))
}

/// Numbers 2ᵃ3ᵇ of nodes, a ≥ 3, in increasing order, whose transforms are fast.
static SIZES: LazyLock<Vec<usize>> = LazyLock::new(|| {
    let powers = |first: usize, factor: usize| {
        std::iter::successors(Some(first), move |size| Some(factor * size))
            .take_while(|size| *size <= 2 * MOST_NODES)
    };
    let mut sizes: Vec<usize> = powers(8, 3).flat_map(|first| powers(first, 2)).collect();
    sizes.sort_unstable();
    sizes
});

/// The least fast size that is at least `least`, twice the most nodes at most.
pub fn size_above(least: f64) -> usize {
    SIZES.iter().copied().find(|size| *size as f64 >= least).unwrap_or(2 * MOST_NODES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::PeriodicGrid;

    #[test]
    fn sizes_are_fast_and_large_enough() {
        for (least, size) in [(1.0, 8), (100.0, 128), (129.0, 144), (505.0, 512), (1300.0, 1536)] {
            assert_eq!(size_above(least), size);
        }
    }

    /// A state whose curvature has the modes e^{−αk}.
    fn falling(nodes: usize, rate: f64) -> (Layout, Vec<f64>) {
        let layout = Layout::new(nodes, 0);
        let spectral = SpectralLayout::new(layout);
        let mut state = vec![0.0; spectral.len()];
        for (mode, value) in spectral.spectra_mut(&mut state).iter_mut().enumerate() {
            value.re = TAU * (-rate * mode as f64).exp();
        }
        (layout, state)
    }

    #[test]
    fn the_nodes_needed_are_found_from_below_and_from_above() {
        let needed = |nodes, aim| {
            let (layout, state) = falling(nodes, 0.2);
            needed_nodes(layout, &state, aim, DerivativeFamily::Fourier)
        };
        // e^{−0.2·0.4n} = 1e-6 at n = 173.
        assert_eq!(needed(1024, 1e-6), 192);
        assert_eq!(needed(128, 1e-6), 192);
        assert_eq!(needed(64, 1e-6), 128, "at most twice as many");
    }

    /// A curvature that jumps up and down, and one that does so from node to node.
    #[test]
    fn a_jump_is_resolved_but_for_a_hundredth_and_waves_as_short_as_the_nodes_are_not_at_all() {
        let layout = Layout::new(MOST_NODES, 0);
        let spectral = SpectralLayout::new(layout);
        let part = |value: &dyn Fn(usize) -> f64| {
            let nodal: Vec<f64> = (0..MOST_NODES).map(value).chain([TAU]).collect();
            let mut state = vec![0.0; spectral.len()];
            spectral.encode(&mut PeriodicGrid::new(MOST_NODES), &nodal, &mut state);
            unresolved(layout, &state, MOST_NODES, DerivativeFamily::Fourier)
        };
        let jump = part(&|i| if i < MOST_NODES / 2 { 9.0 } else { -9.0 });
        assert!(jump > 1e-3 && jump < 1e-2, "{jump:.1e}");
        let waves = part(&|i| 9.0 * (0.45 * TAU * i as f64).sin());
        assert!(waves > 0.99, "{waves}");
    }

    #[test]
    fn differences_need_more_nodes_than_trigonometric_interpolation() {
        let (layout, state) = falling(1024, 0.2);
        let needed = |family| needed_nodes(layout, &state, 1e-6, family);
        assert!(needed(DerivativeFamily::Central8) > needed(DerivativeFamily::Fourier));
        assert!(needed(DerivativeFamily::Central4) > needed(DerivativeFamily::Central8));
    }

    #[test]
    fn what_differences_need_is_known_from_few_nodes_and_beyond_the_most() {
        let needed = |nodes, aim| {
            let (layout, state) = falling(nodes, 0.2);
            needed_nodes(layout, &state, aim, DerivativeFamily::Central2)
        };
        assert_eq!(needed(256, 1e-5), needed(8192, 1e-5));
        assert!(needed(256, 1e-5) > 2048, "{}", needed(256, 1e-5));
        // An error of order 2.
        let ratio = needed(512, 1e-12) as f64 / needed(512, 1e-10) as f64;
        assert!(needed(512, 1e-10) > MOST_NODES && (ratio / 10.0 - 1.0).abs() < 0.1, "{ratio}");
    }

    #[test]
    fn the_sharper_of_two_fronts_on_the_longest_curve_asks_for_the_nodes() {
        let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").unwrap();
        let nodes = |epsilon: &str, delta: &str, ratio: &str| {
            let changes =
                [("agents.epsilon", epsilon), ("agents.delta", delta), ("length.target_ratio", ratio)]
                    .map(|(key, value)| (format!("energy.{key}"), value.to_owned()));
            fronts(&Scene::parse_with(text, "three_fold", &changes).unwrap(), 2.0)
        };
        let expected = 2.0 / (NODE_DISTANCE_PER_EPSILON * 0.01);
        assert!((nodes("0.01", "0.04", "1") - expected).abs() < 1e-9 * expected);
        assert!((nodes("0.04", "0.01", "0.5") - expected).abs() < 1e-9 * expected);
        assert!((nodes("0.04", "0.01", "1.5") - 1.5 * expected).abs() < 1e-9 * expected);
    }
}
