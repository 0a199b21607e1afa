//! A figure of a run, as PNG or SVG: the curve, the state in the (ρ, κ) plane, energy and length over time.
//!
//! `plotters` draws it, with fonts built into the program, so that no system font is needed.

mod axis;
mod curve_panel;
mod figure;
mod history_panel;
mod page;
mod panel;
mod render;
mod state_panel;

pub use figure::{NodalLines, Options, PictureError, plot};
