//! Scene expressions: a closed grammar, its exact derivatives, and compiled programs over nodal arrays.
//!
//! The grammar has numbers, named variables, `+ - * / ^`, parentheses, `pi`, and the functions `exp ln sqrt sin
//! cos tan sinh cosh tanh abs`; nothing else can run from a scene. Powers associate to the right and bind tighter
//! than the unary minus, so `-x^2` is `-(x^2)`.
//!
//! [`Expression`] is parsed and differentiated once, when a run is built; [`Program`] compiles several
//! expressions together and evaluates them at every node, every step.
//!
//! ```
//! use flow_core::expression::{Expression, Program};
//!
//! let energy = Expression::parse("(kappa - 1)^2 / 2", &["kappa"])?;
//! let slope = energy.derivative(0)?;
//! let program = Program::compile(&[&energy, &slope]);
//!
//! let kappa = [0.0, 1.0, 3.0];
//! let (mut e, mut e_kappa) = ([0.0; 3], [0.0; 3]);
//! let mut scratch = vec![0.0; program.scratch_len()];
//! program.evaluate(&[&kappa], &mut [&mut e, &mut e_kappa], &mut scratch);
//! assert_eq!((e, e_kappa), ([0.5, 0.0, 2.0], [-1.0, 0.0, 2.0]));
//! # Ok::<(), flow_core::expression::ExpressionError>(())
//! ```

mod derivative;
mod error;
mod graph;
mod instruction;
mod lexer;
mod lower;
mod parse;
mod program;
mod spelling;
mod split;
mod symbolic;
mod tape;
pub(crate) mod vector_math;

pub use error::ExpressionError;
pub use program::Program;
pub use symbolic::Expression;
pub use tape::LANES;
