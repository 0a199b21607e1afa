//! Figures as PNG or SVG: of a run, the curve, the state in the (ρ, κ) plane, energy and length over time; of a ladder of
//! tolerances, errors against time.
//!
//! `plotters` draws it, with fonts built into the program, so that no system font is needed.

mod axis;
mod curve_panel;
mod figure;
mod file;
mod history_panel;
mod notation;
mod numbers;
mod page;
mod panel;
mod render;
mod state_panel;
mod tradeoff_figure;

pub use figure::{Options, plot};
pub use file::{PictureError, check_name};
pub use state_panel::NodalLines;
pub use tradeoff_figure::plot_tradeoff;
