//! What a flow is made of, to read.

use std::sync::Arc;

use super::GradientFlow;
use crate::flow::curve_fields::CurveFields;
use crate::flow::density_mobility::DensityMobility;
use crate::flow::energy_sum::EnergySum;
use crate::flow::normal_mobility::{MobilityError, NormalMobility};
use crate::geometry::{Grading, Layout, PeriodicGrid};
use crate::operators::Derivative;

impl GradientFlow {
    /// Shape of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.descent.layout
    }

    /// The terms of the energy, to read.
    #[must_use]
    pub fn energy_terms(&self) -> &EnergySum {
        &self.energy
    }

    /// Mobilities of the densities.
    #[must_use]
    pub fn density_mobilities(&self) -> &[Box<dyn DensityMobility>] {
        &self.descent.density_mobilities
    }

    /// Fields of the densities that are only carried along.
    pub(in crate::flow) fn carried_fields(&self) -> impl Iterator<Item = usize> {
        self.descent.carried_fields()
    }

    /// Whether a density is only carried along, over nodes that are not material: then nothing makes good what errors leave of it.
    #[must_use]
    pub fn carries_over_nodes(&self) -> bool {
        self.descent.carries_over_nodes()
    }

    /// The normal mobility at the linearisation.
    #[must_use]
    pub fn normal_mobility(&self) -> &dyn NormalMobility {
        &*self.frozen.mobility
    }

    /// Why products of the implicit operator are NaN: the normal mobility is not defined at the linearisation.
    #[must_use]
    pub fn linearisation_fault(&self) -> Option<MobilityError> {
        self.frozen.fault
    }

    /// Fields at the state evaluated last.
    #[must_use]
    pub fn current(&self) -> &CurveFields {
        &self.current.fields
    }

    /// Fields at the linearisation.
    #[must_use]
    pub fn frozen(&self) -> &CurveFields {
        &self.frozen.fields
    }

    /// The derivative, for others who work on the same nodes.
    #[must_use]
    pub fn derivative(&self) -> &Derivative {
        self.descent.map.derivative()
    }

    /// The grid, with its scratch.
    pub fn grid_mut(&mut self) -> &mut PeriodicGrid {
        self.descent.map.grid_mut()
    }

    /// Whether the nodes are at equal distances: neither graded nor material.
    #[must_use]
    pub fn is_equidistant(&self) -> bool {
        self.grading().is_none() && self.layout().metric().is_none()
    }

    /// The grading of the nodes; none if they are uniform.
    #[must_use]
    pub fn grading(&self) -> Option<&Arc<Grading>> {
        self.descent.map.grading()
    }

    /// How often a mode stands in the full spectrum.
    #[must_use]
    pub fn multiplicity(&self, mode: usize) -> f64 {
        self.descent.map.multiplicity(mode)
    }
}
