//! The measured trade of accuracy for time: a ladder of tolerances, each run against a tighter one.
//!
//! Three kinds of runs. The *scout*, at the tolerance of the scene, finds when the flow ends: at rest, in contact or at
//! `time.end`, as the scene says; and the time halfway, at which half of the energy lost until then is lost. The *reference* is
//! a hundred times tighter than the tightest rung. The *rungs* are what is measured. Reference and rungs all go to that end,
//! past any rest of their own, so that they take the same span of time; each is compared at both times: `THEORY.md`, eq. (I8).
//!
//! ```
//! use flow_core::run::tradeoff::{Ladder, tradeoff};
//! use flow_core::run::{Quiet, Scene};
//!
//! let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
//! let scene = Scene::parse(text, "circle.toml")?;
//! let measured = tradeoff(&scene, &Ladder::new(&[1e-3, 1e-6], None)?, &mut Quiet)?;
//! let (tolerance, rung) = measured.cheapest(1e-6).unwrap();
//! assert!(tolerance == 1e-6 && rung.largest_error() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod curve_distance;
mod error;
mod errors;
mod ladder;
mod leg;
mod measured;
mod observer;
mod span;

pub use error::{RunError, TradeoffError};
pub use errors::Errors;
pub use ladder::{Ladder, LadderError};
pub use measured::{Reference, Row, Rung, Tradeoff, tradeoff};
pub use observer::{LadderObserver, Leg};
pub use span::{Ending, Span};
