//! Densities that are only carried along, over nodes that slide on the curve: their transport in the implicit operator. See `THEORY.md`,
//! eq. (F20).

use std::f64::consts::PI;

use super::{Descent, GradientFlow};
use crate::flow::normal_mobility::NormalMobility;
use crate::geometry::SpectralLayout;

/// Angle by which the operator I − γJ turns waves at most.
const MOST_TURNED: f64 = 10.0;

/// The tangential velocity W at a linearisation.
#[derive(Debug)]
pub struct FrozenSliding {
    /// Fields whose transport is in J.
    carried: Vec<usize>,
    /// W at the flux points; empty where there are none of these.
    velocity: Vec<f64>,
    /// γ of the operator I − γJ that is being solved.
    gamma: f64,
    /// Whether that is short enough for J to have the transport.
    counts: bool,
}

impl FrozenSliding {
    /// For states of `descent` under the normal `mobility`.
    pub fn new(descent: &Descent, mobility: &dyn NormalMobility) -> Self {
        // W is mostly what stages have left in short waves where V has two derivatives more than the force, and solves take longer for it.
        let counts = descent.carries_over_nodes() && !mobility.is_minus_laplacian();
        let carried = descent.carried_fields().filter(|_| counts).collect();
        let nodes = if counts { descent.layout.nodes() } else { 0 };
        Self { carried, velocity: vec![0.0; nodes], gamma: 0.0, counts }
    }
}

impl GradientFlow {
    /// Takes W at the linearisation, whose gradient is at hand.
    pub(super) fn freeze_sliding(&mut self) {
        let Self { descent, frozen, sliding, .. } = self;
        if !sliding.carried.is_empty() {
            descent.descend(frozen);
            descent.map.set_sliding(&frozen.fields, &descent.velocity, &mut sliding.velocity);
            self.set_sliding_step(self.sliding.gamma);
        }
    }

    /// Tells the γ of the operator I − γJ that is being solved. J does without the transport where that turns waves round and round: no
    /// step that follows the motion is so long, and the preconditioners do without it.
    pub(in crate::flow) fn set_sliding_step(&mut self, gamma: f64) {
        self.sliding.gamma = gamma;
        self.sliding.counts = gamma * self.sliding_frequency() <= MOST_TURNED;
    }

    /// Adds ∂_s(Wδρ) of the last motion of the second derivative to the rates of the densities that are only carried along. Others forget
    /// what Newton's method leaves of it.
    pub(super) fn add_sliding(&mut self, rates: &mut [f64]) {
        let Self { energy, descent, sliding, .. } = self;
        if !sliding.counts {
            return;
        }
        let (layout, motion) = (SpectralLayout::new(descent.layout), energy.field_motion());
        for &field in &sliding.carried {
            let rate = &mut layout.spectra_mut(rates)[layout.spectrum(field)];
            descent.map.add_transport(&motion[descent.layout.field(field)], &sliding.velocity, rate);
        }
    }

    /// The highest frequency at which waves of a density that is only carried along pass the nodes at the linearisation, per time: nothing
    /// damps them. Zero where J has none of it.
    #[must_use]
    pub fn sliding_frequency(&self) -> f64 {
        let at = &self.frozen.fields;
        let velocity = self.sliding.velocity.iter().enumerate();
        let rates = velocity.map(|(i, w)| w.abs() / at.grading().map_or(1.0, |w| w.at_midpoints()[i]));
        PI * self.descent.layout.nodes() as f64 * rates.fold(0.0, f64::max) / at.length()
    }
}
