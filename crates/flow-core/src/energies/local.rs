//! Any local energy ∫ e(κ, ρ, ∇_sκ, ∇_sρ) dσ given as an expression. See `THEORY.md`, eq. (E5).

use super::differentiated::Differentiated;
use super::{EnergyTerm, Fields, Jet, Order};
use crate::expression::{Expression, ExpressionError};

/// A local density from an expression, differentiated by the program.
///
/// Without slopes it is a density at the nodes, like any other. With slopes it is one at the flux points, but for what depends on fields
/// whose slopes do not occur: what varies from node to node there has no cost between them, and is a density at the nodes too.
#[derive(Clone, Debug)]
pub struct Local {
    plain: Option<Density>,
    of_slopes: Option<Density>,
}

/// Most outputs of a program: value, 16 first and 136 second derivatives of 16 variables.
const MOST_OUTPUTS: usize = 153;
const MOST_VARIABLES: usize = 16;

impl Local {
    /// The density `expression` of the variables κ, ρ¹ … ρᵈ, ∇_sκ, ∇_sρ¹ … ∇_sρᵈ, in this order, with
    /// `fields` = 1 + d ≤ 8, for `nodes` nodes.
    ///
    /// # Errors
    /// [`ExpressionError`] if a derivative is too large.
    /// # Panics
    /// If there are more than 8 fields, or the expression has more than 2 `fields` variables.
    pub fn new(expression: &Expression, fields: usize, nodes: usize) -> Result<Self, ExpressionError> {
        assert!(2 * fields <= MOST_VARIABLES, "at most {} fields", MOST_VARIABLES / 2);
        let arity = expression.arity();
        assert!(arity <= 2 * fields, "an energy of {arity} variables on {fields} fields and their slopes");
        let has_slope = |field: usize| expression.depends_on(fields + field);
        let [plain, of_slopes] = if (0..fields).any(has_slope) {
            expression.split_from(fields, &|field| !has_slope(field))?
        } else {
            [Some(expression.clone()), None]
        };
        let density = |part: Option<Expression>, variables| {
            part.map(|part| Density::new(&part, variables, nodes)).transpose()
        };
        Ok(Self { plain: density(plain, fields)?, of_slopes: density(of_slopes, 2 * fields)? })
    }
}

/// A density with its derivatives.
#[derive(Clone, Debug)]
struct Density {
    variables: usize,
    function: Differentiated,
    /// The density, its first derivatives and its second derivatives in the packed order of [`Jet`].
    results: Vec<f64>,
}

impl Density {
    fn new(expression: &Expression, variables: usize, nodes: usize) -> Result<Self, ExpressionError> {
        let function = Differentiated::by_each(expression, variables)?;
        Ok(Self { variables, results: vec![0.0; function.outputs() * nodes], function })
    }

    fn add(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        let nodes = fields.nodes();
        let inputs: [&[f64]; MOST_VARIABLES] =
            std::array::from_fn(|k| if k < self.variables { fields.get(k) } else { &[] });
        let mut chunks = self.results.chunks_exact_mut(nodes);
        let mut outputs: [&mut [f64]; MOST_OUTPUTS] =
            std::array::from_fn(|_| chunks.next().unwrap_or_default());
        self.function.evaluate(jet.order(), &inputs[..self.variables], &mut outputs);
        let mut results = self.results.chunks_exact(nodes);
        let mut next = |target: &mut [f64]| {
            for (target, value) in target.iter_mut().zip(results.next().unwrap_or_default()) {
                *target += value;
            }
        };
        next(jet.value_mut());
        for a in 0..self.variables {
            next(jet.first_mut(a));
        }
        if jet.order() >= Order::Hessian {
            for a in 0..self.variables {
                for b in 0..=a {
                    next(jet.second_mut(a, b));
                }
            }
        }
    }
}

impl EnergyTerm for Local {
    fn name(&self) -> &'static str {
        "local"
    }

    fn has_density(&self) -> bool {
        self.plain.is_some()
    }

    fn add_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        if let Some(plain) = &mut self.plain {
            plain.add(fields, jet);
        }
    }

    fn has_slope_density(&self) -> bool {
        self.of_slopes.is_some()
    }

    fn add_slope_density(&mut self, fields: Fields<'_>, jet: &mut Jet) {
        if let Some(of_slopes) = &mut self.of_slopes {
            of_slopes.add(fields, jet);
        }
    }
}
