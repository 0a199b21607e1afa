//! Terms of the energy `𝓕_h`.
//!
//! A term is a sum of up to five parts, and says only what it has: a local density e(κ, ρ), a constant
//! coefficient of ½∫|∇_sφ|² dσ for a field φ, a local density e(κ, ρ, ∇_sκ, ∇_sρ) at the flux points, a
//! function of the length, and a function of the positions. The flow (`crate::flow`) turns these parts into the gradient and the second
//! derivative of `𝓕_h` in any gauge, so no term knows about metrics or transforms. See `THEORY.md`, section 3.

mod adhesion;
mod agents;
mod area;
mod bending;
mod differentiated;
mod fault;
mod jet;
mod kernel;
mod length;
mod local;
mod membrane;
mod packing;
mod regularization;
mod shape;

use std::fmt::Debug;

pub use adhesion::Adhesion;
pub use agents::{Agents, NodalLines};
pub use area::Area;
pub use bending::Bending;
pub use fault::TermFault;
pub use jet::{Fields, Jet, Order};
pub use kernel::CutOff;
pub use length::Length;
pub use local::Local;
pub use membrane::Membrane;
pub use packing::Packing;
pub use regularization::Regularization;
pub use shape::ShapeFields;

/// Value, first and second derivative of a function of the length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LengthJet {
    /// Value.
    pub value: f64,
    /// First derivative.
    pub first: f64,
    /// Second derivative.
    pub second: f64,
}

impl LengthJet {
    /// The sum of two functions.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

/// One term of the discrete energy `𝓕_h(κ`, g, ρ).
///
/// # What a term can be
///
/// ∫e(κ, ρ) dσ + ½c∫|∇_sφ|² dσ + ∫e(κ, ρ, ∇_sκ, ∇_sρ) dσ + Φ(|Γ|) + a function of the positions, tangents and the length that does
/// not change with translations and rotations. Not among these are other functions of integrals, like (∫κ² dσ − c)² or one of an
/// enclosed mass: their second derivatives are not local, and no part here holds them. Derivatives along the curve higher than the first
/// are not among them either.
///
/// # Derivatives must be exact
///
/// They are those of the discrete energy, to rounding. The flow takes its force from the first derivatives, and every step is checked by
/// the balance of the energy that is lost and the dissipation: with a gradient that is off by 1 % this balance does not close, and steps
/// shrink until what is missing of each is within the tolerance. A run creeps then, the more the smaller the tolerance. If it is out of
/// steps before its end, it fails with [`IntegrationError::OpenBalance`](crate::integrator::IntegrationError::OpenBalance); if it gets
/// there, all that was missing together is in the [`energy_balance`](crate::run::Frame::energy_balance) of its frames, and
/// [`warnings`](crate::run::warnings) tells. Second derivatives do not enter results, but the
/// implicit steps are solved with them: where they are missing or wrong the solves fail or take many iterations, and the steps become as
/// short as those of an explicit method. [`GradientFlow::check_derivatives`](crate::flow::GradientFlow::check_derivatives) compares both
/// with differences, term by term: a test with it belongs to every term.
pub trait EnergyTerm: Debug + Send + Sync {
    /// Key of the term in scenes, in the output file and in Python.
    fn name(&self) -> &'static str;

    /// Whether [`EnergyTerm::add_density`] adds anything. Where this or one of the other two flags says no, the part is not asked for:
    /// [`Simulation::with_terms`](crate::run::Simulation::with_terms) and
    /// [`GradientFlow::check_derivatives`](crate::flow::GradientFlow::check_derivatives) look whether one was forgotten, but a flow that
    /// is put together by hand does not.
    fn has_density(&self) -> bool {
        false
    }

    /// Adds the local density e(κ, ρ) at the nodes and its derivatives up to the order of `jet`.
    /// Scratch belongs to the term; it is sized when the term is built.
    fn add_density(&mut self, _fields: Fields<'_>, _jet: &mut Jet) {}

    /// As [`EnergyTerm::add_density`] to zero, whatever is in `jet`: a term may save itself the zero. Without that, scenes of bending
    /// alone take 0.5 to 1 % longer (`benches`, generality), of the 5 % that they may take beyond a solver for nothing else.
    fn set_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        jet.clear(jet.order());
        self.add_density(fields, jet);
    }

    /// Coefficient c of the part (c/2) ∫|∇_sφ|² dσ for field `field` (0: curvature, then the densities).
    fn stiffness(&self, _field: usize) -> f64 {
        0.0
    }

    /// Whether [`EnergyTerm::add_slope_density`] adds anything.
    fn has_slope_density(&self) -> bool {
        false
    }

    /// Adds a local density of the fields and of their slopes: `fields` holds the fields at the flux points,
    /// then their arc-length derivatives in the same order. The flux points of these densities are the midpoints of the nodes for
    /// every derivative, the nodal one of [`Derivative::new`](crate::operators::Derivative::new) included, under which the sawtooth
    /// would have no slope and cost nothing.
    fn add_slope_density(&mut self, _fields: Fields<'_>, _jet: &mut Jet) {}

    /// The part that depends on the length alone.
    fn of_length(&self, _length: f64) -> LengthJet {
        LengthJet::default()
    }

    /// Whether [`EnergyTerm::add_shape_energy`] adds anything.
    fn has_shape_energy(&self) -> bool {
        false
    }

    /// Whether the part that depends on positions is a cost of length as well: of waves longer than the range of a kernel a pair
    /// energy E makes the tension E/|Γ|, of shorter ones twice as much; pressure makes none.
    fn is_line_energy(&self) -> bool {
        false
    }

    /// What the enclosed area `area` costs, if the term is a function of that alone: a constant without a force where the flow keeps it.
    fn cost_of_area(&self, _area: f64) -> Option<f64> {
        None
    }

    /// Largest distance of nodes on which the sums of [`EnergyTerm::add_shape_energy`] on a curve of length `length` are off by the
    /// part `error` at most; infinite if they do not ask for any.
    fn largest_spacing(&self, _length: f64, _error: f64) -> f64 {
        f64::INFINITY
    }

    /// Returns the part that depends on where the nodes lie, and adds its
    /// derivatives by positions, by tangents and by the length at fixed positions and tangents. With
    /// [`Order::Hessian`] the term also keeps what [`EnergyTerm::add_shape_hessian_product`] needs.
    ///
    /// It must not change with translations and rotations: the origin of the positions and the angle of the frame mean nothing (see
    /// [`ShapeFields::position`]), and a term that depends on them, like a field of gravity, acts as if the curve were held where they
    /// put it. [`GradientFlow::check_derivatives`](crate::flow::GradientFlow::check_derivatives) tells the net force of a term.
    fn add_shape_energy(&mut self, _shape: &ShapeFields, _order: Order, _out: &mut ShapeFields) -> f64 {
        0.0
    }

    /// Adds the second derivative times `motion`, at the shape `at` that was last evaluated with [`Order::Hessian`].
    fn add_shape_hessian_product(
        &mut self,
        _at: &ShapeFields,
        _motion: &ShapeFields,
        _out: &mut ShapeFields,
    ) {
    }

    /// Bytes that the term keeps for second derivatives beside a few numbers for each node: as many for each pair of nodes, for example.
    fn kept_bytes(&self) -> f64 {
        0.0
    }

    /// What is wrong with the data that the term was evaluated on last, if anything: asked for at the start and after each step, of
    /// the pointwise fields. A run ends with it. Terms from outside have [`TermFault::OutOfRange`].
    fn fault(&self, _fields: Fields<'_>) -> Option<TermFault> {
        None
    }
}
