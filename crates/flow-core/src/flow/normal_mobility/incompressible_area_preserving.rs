//! Local length and area held: 𝓑 = 𝓘 − 𝓘a ⟨𝓘a, ·⟩/⟨𝓘a, a⟩. See `THEORY.md`, eq. (F10).

use std::f64::consts::TAU;

use super::{Incompressible, Kept, MobilityError, NormalMobility};
use crate::flow::CurveFields;
use crate::operators::Derivative;

/// Mean square of the part of a off κ below which the curve is a circle to rounding: a is in the kernel of 𝓘.
const ROUND: f64 = 1e-24;

/// Every piece of the curve keeps its length, and the area is held: V = 𝓘f − (⟨𝓘f, a⟩/⟨𝓘a, a⟩) 𝓘a with 𝓘 of
/// [`Incompressible`](super::Incompressible) and the force a of the area on the grid, 1 in the continuum. See `THEORY.md`, eq. (F10). On a
/// circle 𝓘a = 0; on one that is run through once 𝓑 = 0 too: of all curves of its length that one alone has its area.
#[derive(Clone, Debug)]
pub struct IncompressibleAreaPreserving {
    incompressible: Incompressible,
    /// a, the same less its component along κ, and 𝓘a.
    area_force: Vec<f64>,
    area_part: Vec<f64>,
    image: Vec<f64>,
    /// The force without what holds the area.
    less: Vec<f64>,
    /// 1/⟨𝓘a, a⟩, or 0 on a circle.
    inverse: f64,
    /// Whether every curve counts as a circle that is run through once, which is held.
    holds_all: bool,
    /// Whether the one at hand does.
    holds: bool,
}

impl IncompressibleAreaPreserving {
    /// Room for one state of `nodes` ≥ [`crate::operators::Helmholtz::FEWEST_NODES`] nodes
    /// in the metric of `derivative`.
    #[must_use]
    pub fn new(derivative: &Derivative, nodes: usize) -> Self {
        Self {
            incompressible: Incompressible::new(derivative, nodes),
            area_force: vec![1.0; nodes],
            area_part: vec![0.0; nodes],
            image: vec![0.0; nodes],
            less: vec![0.0; nodes],
            inverse: 0.0,
            holds_all: false,
            holds: false,
        }
    }

    /// The same that holds the curve if it `holds_all`: one so near to a circle that it cannot go anywhere.
    ///
    /// Length and area leave a curve that is nearly a circle a sphere about the circle, which the flow crosses the faster the
    /// smaller it is: where that is less than errors of the steps, they could but jump to and fro on it.
    #[must_use]
    pub fn holding(self, holds_all: bool) -> Self {
        Self { holds_all, ..self }
    }
}

impl NormalMobility for IncompressibleAreaPreserving {
    fn area_force(&mut self) -> Option<&mut [f64]> {
        Some(&mut self.area_force)
    }

    fn set(&mut self, at: &CurveFields) -> Result<(), MobilityError> {
        self.incompressible.set(at)?;
        self.area_part.copy_from_slice(&self.area_force);
        self.incompressible.project(at, &mut self.area_part);
        self.incompressible.apply(at, &self.area_part, &mut self.image);
        let square = at.mean_of_product(&self.image, &self.area_part);
        // One that is run through more often has the area of other curves of its length as well.
        let turning_number = at.length() * at.mean(at.at_nodes(0)) / TAU;
        let once = (turning_number.abs() - 1.0).abs() < 0.5;
        self.holds = self.holds_all || once && square <= ROUND;
        self.inverse = if square > ROUND && !self.holds { 1.0 / square } else { 0.0 };
        Ok(())
    }

    fn apply(&mut self, at: &CurveFields, force: &[f64], velocity: &mut [f64]) {
        if self.holds {
            velocity.fill(0.0);
            return;
        }
        self.incompressible.apply(at, force, velocity);
        let factor = self.inverse * at.mean_of_product(velocity, &self.area_part);
        for (v, image) in velocity.iter_mut().zip(&self.image) {
            *v -= factor * image;
        }
    }

    fn area_multiplier(&mut self, at: &CurveFields, force: &[f64]) -> f64 {
        self.inverse * at.mean_of_product(&self.image, force)
    }

    fn holding_tension(&mut self, at: &CurveFields, force: &[f64], tension: &mut [f64]) {
        let multiplier = self.area_multiplier(at, force);
        for ((less, f), area) in self.less.iter_mut().zip(force).zip(&self.area_force) {
            *less = f - multiplier * area;
        }
        self.incompressible.holding_tension(at, &self.less, tension);
    }

    fn symbol(&self, wave_square: f64) -> f64 {
        if self.holds { 0.0 } else { self.incompressible.symbol(wave_square) }
    }

    fn holds_curve(&self) -> bool {
        self.holds
    }

    fn keeps(&self) -> Kept {
        Kept { length: true, area: true }
    }

    fn boxed_clone(&self) -> Box<dyn NormalMobility> {
        Box::new(self.clone())
    }
}
