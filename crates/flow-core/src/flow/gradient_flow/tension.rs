//! The tension of the curve at the linearisation, for products and for preconditioners. See `THEORY.md`, eqs. (F20) and (F21).

use super::{Descent, GradientFlow};
use crate::flow::energy_sum::EnergySum;
use crate::flow::intrinsic_gradient::IntrinsicGradient;
use crate::flow::normal_mobility::NormalMobility;
use crate::geometry::Complex64;
use crate::geometry::vectors::{add_product, add_scaled, mean, shift};

/// The tension at a linearisation.
#[derive(Debug)]
pub struct FrozenTension {
    /// Minus the tension at each node: Z − ⟨wZ⟩ − π less its mean, or less what holds every piece of the curve, where that is held.
    pub stretching: Vec<f64>,
    /// Derivatives of the gradient along the curve, by field; empty where J does without what the fields do to the tension.
    slopes: Vec<f64>,
    /// Mean over the nodes of the tension that symbols hold.
    mean: f64,
    /// The tension that holds every piece of the curve, where that is held and terms depend on positions.
    holding: Vec<f64>,
    /// Gradient of the energy and of what holds the area; empty where no term depends on positions.
    held: IntrinsicGradient,
}

impl FrozenTension {
    /// For states of `descent` with this `energy` under the normal `mobility`.
    pub fn new(descent: &Descent, energy: &EnergySum, mobility: &dyn NormalMobility) -> Self {
        let layout = descent.layout;
        let room = |size: usize, needed: bool| if needed { size } else { 0 };
        let (nodes, positions, kept) = (layout.nodes(), energy.depends_on_positions(), mobility.keeps());
        let spectra = room(layout.state_fields() * layout.modes(), positions);
        let held = IntrinsicGradient { spectra: vec![Complex64::default(); spectra], by_length: 0.0 };
        let by_positions = positions && !energy.is_of_positions_alone();
        // Where an area is held, the force at rest is a pressure, and densities that bend the curve against it make the tension vary.
        let by_densities = !positions && layout.densities() > 0 && kept.area && !kept.length;
        // Nodes that only move along the normal have no tension of W.
        let changes = layout.metric().is_none() && (by_positions || by_densities);
        let slopes = vec![0.0; room(layout.fields() * nodes, changes || descent.carries_over_nodes())];
        Self { stretching: vec![0.0; nodes], slopes, mean: 0.0, holding: vec![0.0; nodes], held }
    }
}

impl GradientFlow {
    /// Takes the tension at the linearisation, whose gradient is at hand.
    pub(super) fn freeze_tension(&mut self) {
        if self.energy.depends_on_positions() {
            return self.freeze_tension_of_positions();
        }
        let Self { descent: Descent { map, gradient, force, .. }, frozen, tension, .. } = self;
        let FrozenTension { stretching, slopes, mean: tension, .. } = tension;
        if !slopes.is_empty() {
            map.set_slopes(&gradient.spectra, slopes);
        }
        map.stretching(&frozen.fields, &gradient.spectra, gradient.by_length, stretching);
        if frozen.mobility.keeps().length {
            // 𝓑 takes κ to zero on every curve: a mean tension moves nothing, and its derivative is not that of the force alone.
            let mut moves_nothing = frozen.fields.mean(stretching);
            if frozen.mobility.keeps().area {
                map.complete_force(&frozen.fields, &gradient.spectra, stretching, force);
                moves_nothing = frozen.holding_mean_tension(force, moves_nothing);
            }
            shift(stretching, -moves_nothing);
        }
        *tension = -mean(stretching);
    }

    /// The same where terms depend on positions. Symbols leave out Hess of these terms and, since Hess cancels it, their tension, but
    /// for that of line energies, which it does not cancel.
    fn freeze_tension_of_positions(&mut self) {
        self.hold_area();
        if self.energy.is_of_positions_alone() {
            // Hess alone damps what rounding does to short waves under a pressure that shrinks the curve; with the tension nothing does.
            return; // what is frozen stays zero
        }
        let Self { energy, descent: Descent { map, force, .. }, frozen, tension, .. } = self;
        let FrozenTension { stretching, slopes, holding, held, mean: tension } = tension;
        if !slopes.is_empty() {
            map.set_slopes(&held.spectra, slopes);
        }
        map.stretching(&frozen.fields, &held.spectra, held.by_length, stretching);
        if frozen.mobility.keeps().length {
            map.complete_force(&frozen.fields, &held.spectra, stretching, force);
            frozen.holding_tension(force, holding);
            add_scaled(stretching, -1.0, holding);
        }
        let local = energy.gradient_without_positions();
        map.stretching(&frozen.fields, &local.spectra, local.by_length, force);
        *tension = mean(holding) + energy.line_tension() - mean(force);
    }

    /// Adds to the force what the last motion of the second derivative does to it by the tension, and to the tension.
    pub(super) fn add_tension(&mut self) {
        let Self { energy, descent: Descent { map, force, layout, .. }, frozen, tension, .. } = self;
        let motion = energy.field_motion();
        add_product(force, &tension.stretching, &motion[layout.field(0)]);
        if !tension.slopes.is_empty() {
            map.add_change_of_stretching(&frozen.fields, motion, &tension.slopes, force);
        }
    }

    /// Where the area is held, 𝓚 takes its gradient to zero: what is linearised is the energy less the force that holds it.
    fn hold_area(&mut self) {
        self.tension.held.copy_from(&self.descent.gradient);
        if self.frozen.mobility.keeps().area {
            self.descent.set_force(&self.frozen.fields);
            let multiplier = self.frozen.mobility.area_multiplier(&self.frozen.fields, &self.descent.force);
            self.energy.hold_area(multiplier, &mut self.tension.held);
        }
    }

    /// Minus the tension of the curve at the linearisation, one value per node: Z − ⟨wZ⟩ − π, less what holds every piece of the curve.
    #[must_use]
    pub fn frozen_stretching(&self) -> &[f64] {
        &self.tension.stretching
    }

    /// Mean tension of the curve at the linearisation as symbols hold it: of terms that depend on positions only that of line energies
    /// and what holds every piece of the curve against them. Negative where the curve is compressed.
    #[must_use]
    pub fn mean_tension(&self) -> f64 {
        self.tension.mean
    }
}
