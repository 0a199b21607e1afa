//! A scene as data: read from TOML, checked, and written back with every default filled in.
//!
//! One file per table. A table is read by one function that asks a `Section` for its keys; what nobody asked for is an
//! unknown key, so the list of allowed keys is the code itself. Nothing stops at the first mistake: every problem
//! of a scene is reported at once, each with its key, line, value, bound and one thing to try.
//!
//! A new energy is one file in `energy/`, its two lines in `energy/mod.rs` and one in the list of `energy/table.rs`. The JSON Schema
//! follows from the types; the class of the same name in `python/curveflow/model` is asked for by a test there.
//!
//! ```
//! use flow_core::run::Scene;
//!
//! let text = "
//! curve = { shape = 'circle', radius = 1.0 }
//! time = { end = 1.0 }
//! [energy.bending]
//! rigidty = 1.0
//! ";
//! let error = Scene::parse(text, "bent.toml").unwrap_err().to_string();
//! assert!(error.contains("line 5 | rigidty = 1.0"));
//! assert!(error.contains("did you mean `rigidity`?"));
//! ```

mod accuracy;
mod choice;
mod count;
mod curve;
mod density;
mod difference;
mod document;
mod energy;
mod entry;
mod error;
mod flow;
mod formula;
mod gauge;
mod held_points;
mod keywords;
mod message;
mod output;
mod overrides;
mod points;
mod profile;
mod report;
mod schema;
mod section;
mod shipped;
mod suggest;
mod switch;
mod time;

pub use accuracy::{Accuracy, Derivative, LinearSolver, Nodes};
pub(super) use accuracy::{FEWEST_NODES, LOOSEST, MOST_NODES, TIGHTEST};
pub use curve::{Curve, Shape};
pub use density::{Density, DensityMobility};
pub use document::{MAX_SCENE_BYTES, Scene};
pub(super) use energy::Start;
pub use energy::*;
pub use error::{Bound, Fault, Place, Problem, SceneError};
pub use flow::{Flow, NormalMobility};
pub use formula::Formula;
pub use gauge::Gauge;
pub(super) use held_points::{names_a_file, with_points};
pub use output::{Frames, Output, OutputField, Spacing};
pub use points::{PointsError, parse as parse_points};
pub use profile::Profile;
pub use switch::Switch;
pub use time::Time;
