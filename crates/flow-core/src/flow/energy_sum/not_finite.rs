//! What is wrong with a state: in the words of a term, or which value of which term is no number, or too large, and where.

use super::super::curve_fields::CurveFields;
use super::EnergySum;
use crate::energies::{Fields, Jet, LengthJet, Order, TermFault};
use crate::flow::IntrinsicGradient;
use crate::geometry::Complex64;

/// The dissipation holds the squares of first derivatives: beyond this they overflow.
const SQUARABLE: f64 = 1e150;

/// What of a term is meant. Variables are κ and the densities, then their slopes in the same order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermPart {
    /// Its density e, or its energy of the positions.
    Value,
    /// ∂e/∂φ for a variable φ.
    First(usize),
    /// ∂²e/∂φ∂ψ for two variables, the second of them the lower one.
    Second(usize, usize),
    /// The derivative of this order of its function of the length; 0 for the function.
    OfLength(usize),
    /// Its force on the curve or on the densities.
    Force,
}

/// Where on the curve a value stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermPlace {
    /// At a node.
    Node(usize),
    /// Between a node and the next one.
    After(usize),
    /// Of the curve as a whole.
    Curve,
}

/// A value of a term that is infinite, not a number, or too large to be squared.
#[derive(Clone, Debug, PartialEq)]
pub struct NotFinite {
    /// Name of the term.
    pub term: &'static str,
    /// Which of its values.
    pub part: TermPart,
    /// The value.
    pub value: f64,
    /// Where it stands.
    pub place: TermPlace,
    /// The variables there; none of the curve as a whole.
    pub variables: Vec<f64>,
}

impl EnergySum {
    /// What a term finds wrong with the state evaluated last, whose fields are `at`.
    #[must_use]
    pub fn fault(&self, at: &CurveFields) -> Option<TermFault> {
        let fields = Fields::new(self.layout.nodes(), at.pointwise());
        self.terms.iter().find_map(|term| term.fault(fields))
    }

    /// Whether the pointwise second derivatives at the fields `at` are finite, as a linearisation takes them. Overwrites the
    /// linearisation.
    pub fn has_finite_second_derivatives(&mut self, at: &CurveFields) -> bool {
        let shape = self.shape.take(); // they have none
        let mut gradient = self.room();
        self.evaluate(at, Order::Hessian, &mut gradient);
        self.shape = shape;
        self.jet.has_finite_second()
            && self.slope_jet().is_none_or(|(jet, _)| jet.has_finite_second())
            && self.of_length(at.length()).second.is_finite()
    }

    /// The first value of a term that is not finite at the fields `at`, or else the first derivative that cannot be squared. Overwrites
    /// the linearisation.
    #[cold]
    pub fn not_finite(&mut self, at: &CurveFields) -> Option<NotFinite> {
        let mut gradient = self.room();
        let mut search = |find: &dyn Fn(&Self, f64, &IntrinsicGradient) -> Option<NotFinite>| {
            let mut found = None;
            self.each_alone(|alone| {
                if found.is_none() {
                    let energy = alone.evaluate(at, Order::Hessian, &mut gradient);
                    found = find(alone, energy, &gradient);
                }
            });
            found
        };
        search(&|alone, energy, gradient| alone.infinite(at, energy, gradient))
            .or_else(|| search(&|alone, _, _| alone.in_jets(at, is_squarable)))
    }

    /// A gradient for evaluations that are not those of the flow.
    pub(super) fn room(&self) -> IntrinsicGradient {
        let spectra = vec![Complex64::default(); self.layout.state_fields() * self.grid.modes()];
        IntrinsicGradient { spectra, by_length: 0.0 }
    }

    /// What is not finite in the only term, at the fields `at` that it was evaluated on last.
    fn infinite(&self, at: &CurveFields, energy: f64, gradient: &IntrinsicGradient) -> Option<NotFinite> {
        let of_curve = |part, value: f64| {
            (!value.is_finite()).then(|| self.culprit(part, value, TermPlace::Curve, Vec::new()))
        };
        let LengthJet { value, first, second } = self.of_length(at.length());
        let mut of_length = [value, first, second].into_iter().enumerate();
        let force: f64 = gradient.spectra.iter().map(|p| p.re + p.im).sum();
        self.in_jets(at, |_, value| value.is_finite())
            .or_else(|| of_length.find_map(|(order, value)| of_curve(TermPart::OfLength(order), value)))
            .or_else(|| of_curve(TermPart::Value, energy))
            .or_else(|| of_curve(TermPart::Force, force + gradient.by_length))
    }

    /// The first pointwise value of the only term that is not `good`.
    fn in_jets(&self, at: &CurveFields, good: impl Fn(TermPart, f64) -> bool) -> Option<NotFinite> {
        let found = |jet, fields, place: fn(usize) -> TermPlace| {
            let (part, node, value) = first_bad(jet, &good)?;
            let variables = values_at(fields, node);
            Some(self.culprit(part, value, place(node), variables))
        };
        let at_nodes = Fields::new(self.layout.nodes(), at.pointwise());
        let slopes = || self.slope_jet().and_then(|(jet, fields)| found(jet, fields, TermPlace::After));
        found(&self.jet, at_nodes, TermPlace::Node).or_else(slopes)
    }

    /// The jet of the densities of slopes, and what they are evaluated on.
    pub(super) fn slope_jet(&self) -> Option<(&Jet, Fields<'_>)> {
        match (&self.moving, &self.slopes) {
            (Some(moving), _) => Some(moving.flux_jet()),
            (None, Some(slopes)) => Some(slopes.jet()),
            (None, None) => None,
        }
    }

    fn culprit(&self, part: TermPart, value: f64, place: TermPlace, variables: Vec<f64>) -> NotFinite {
        NotFinite { term: self.names().next().unwrap_or_default(), part, value, place, variables }
    }
}

fn is_squarable(part: TermPart, value: f64) -> bool {
    !matches!(part, TermPart::First(_)) || value.abs() < SQUARABLE
}

fn first_bad(jet: &Jet, good: impl Fn(TermPart, f64) -> bool) -> Option<(TermPart, usize, f64)> {
    let first = (0..jet.fields()).map(|a| (TermPart::First(a), jet.first(a)));
    let pairs = (0..jet.fields()).flat_map(|a| (0..=a).map(move |b| (a, b)));
    let second = pairs.map(|(a, b)| (TermPart::Second(a, b), jet.second(a, b)));
    let mut parts = std::iter::once((TermPart::Value, jet.value())).chain(first).chain(second);
    parts.find_map(|(part, values)| {
        let node = values.iter().position(|value| !good(part, *value))?;
        Some((part, node, values[node]))
    })
}

fn values_at(fields: Fields<'_>, node: usize) -> Vec<f64> {
    (0..fields.count()).map(|field| fields.get(field)[node]).collect()
}
