//! Bending energy (b/2)∫(κ − c₀)² dσ. See `THEORY.md`, eq. (E1).

use multiversion::multiversion;

use super::differentiated::Differentiated;
use super::{EnergyTerm, Fields, Jet, Order};
use crate::expression::{Expression, ExpressionError};
use crate::geometry::vectors::shift;

/// Bending energy with constant rigidity.
#[derive(Clone, Debug)]
pub struct Bending {
    rigidity: f64,
    preferred: Preferred,
}

/// The preferred curvature c₀.
#[derive(Clone, Debug)]
enum Preferred {
    Constant(f64),
    OfDensity(Box<OfDensity>),
}

/// c₀(ρ) of one density.
#[derive(Clone, Debug)]
struct OfDensity {
    field: usize,
    function: Differentiated,
    /// c₀, c₀′ and c₀″ at the nodes.
    values: [Vec<f64>; 3],
}

impl Bending {
    /// Rigidity b ≥ 0, in energy × length, with the preferred curvature c₀ = 0.
    #[must_use]
    pub fn new(rigidity: f64) -> Self {
        Self::around(rigidity, 0.0)
    }

    /// The same with the preferred curvature `preferred`.
    #[must_use]
    pub fn around(rigidity: f64, preferred: f64) -> Self {
        Self { rigidity, preferred: Preferred::Constant(preferred) }
    }

    /// The same with the preferred curvature c₀(ρ), a function of the variable 0, the density `density` (counted
    /// from 0), for `nodes` nodes.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative of c₀ is too large.
    /// # Panics
    /// If c₀ depends on a second variable.
    pub fn around_function(
        rigidity: f64,
        preferred: &Expression,
        density: usize,
        nodes: usize,
    ) -> Result<Self, ExpressionError> {
        assert!(preferred.arity() <= 1, "`{}` is no function of one density", preferred.text());
        let preferred = OfDensity {
            field: 1 + density,
            function: Differentiated::along(&[(preferred, 0)])?,
            values: std::array::from_fn(|_| vec![0.0; nodes]),
        };
        Ok(Self { rigidity, preferred: Preferred::OfDensity(Box::new(preferred)) })
    }
}

impl EnergyTerm for Bending {
    fn name(&self) -> &'static str {
        "bending"
    }

    fn has_density(&self) -> bool {
        true
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        match &mut self.preferred {
            Preferred::Constant(preferred) => add_constant(self.rigidity, *preferred, fields, jet),
            Preferred::OfDensity(preferred) => add_of_density(self.rigidity, preferred, fields, jet),
        }
    }

    fn set_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        match &self.preferred {
            Preferred::Constant(preferred) if jet.fields() == 1 => {
                set_alone(self.rigidity, *preferred, fields, jet);
            }
            _ => {
                jet.clear(jet.order());
                self.add_density(fields, jet);
            }
        }
    }
}

fn add_constant(b: f64, preferred: f64, fields: Fields<'_>, jet: &mut Jet) {
    let order = jet.order();
    let (value, first) = jet.value_and_first_mut(0);
    add_square(b, preferred, fields.get(0), value, first);
    if order >= Order::Hessian {
        shift(jet.second_mut(0, 0), b);
    }
}

/// Where the curvature is the only field.
fn set_alone(b: f64, preferred: f64, fields: Fields<'_>, jet: &mut Jet) {
    let order = jet.order();
    let (value, first) = jet.value_and_first_mut(0);
    set_square(b, preferred, fields.get(0), value, first);
    if order >= Order::Hessian {
        jet.second_mut(0, 0).fill(b);
    }
}

/// e = (b/2)(κ − c₀)², with its derivative.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_square(b: f64, preferred: f64, kappa: &[f64], value: &mut [f64], first: &mut [f64]) {
    for ((value, first), kappa) in value.iter_mut().zip(first).zip(kappa) {
        let excess = kappa - preferred;
        *value = 0.5 * b * excess * excess;
        *first = b * excess;
    }
}

/// e += (b/2)(κ − c₀)², with its derivative.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_square(b: f64, preferred: f64, kappa: &[f64], value: &mut [f64], first: &mut [f64]) {
    for ((value, first), kappa) in value.iter_mut().zip(first).zip(kappa) {
        let excess = kappa - preferred;
        *value += 0.5 * b * excess * excess;
        *first += b * excess;
    }
}

fn add_of_density(b: f64, preferred: &mut OfDensity, fields: Fields<'_>, jet: &mut Jet) {
    let (kappa, rho, field) = (fields.get(0), fields.get(preferred.field), preferred.field);
    let mut outputs = preferred.values.each_mut().map(Vec::as_mut_slice);
    preferred.function.evaluate(jet.order(), &[rho], &mut outputs);
    let [c, c_1, c_2] = &preferred.values;
    let (value, by_kappa) = jet.value_and_first_mut(0);
    for i in 0..kappa.len() {
        let excess = kappa[i] - c[i];
        value[i] += 0.5 * b * excess * excess;
        by_kappa[i] += b * excess;
    }
    let by_rho = jet.first_mut(field);
    for i in 0..kappa.len() {
        by_rho[i] -= b * (kappa[i] - c[i]) * c_1[i];
    }
    if jet.order() < Order::Hessian {
        return;
    }
    shift(jet.second_mut(0, 0), b);
    jet.second_mut(0, field).iter_mut().zip(c_1).for_each(|(second, c_1)| *second -= b * c_1);
    let rho_rho = jet.second_mut(field, field);
    for i in 0..kappa.len() {
        rho_rho[i] += b * (c_1[i] * c_1[i] - (kappa[i] - c[i]) * c_2[i]);
    }
}
