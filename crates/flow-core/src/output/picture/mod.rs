//! A figure of a run, as PNG or SVG: the curve, the state in the (ρ, κ) plane, energy and length over time.
//!
//! The figure is a list of outlines, text included, so both formats show the same and need no font.

mod axis;
mod bitmap;
mod colour_map;
mod curve_panel;
mod drawing;
mod figure;
mod font;
mod history_panel;
mod legend;
mod panel;
mod state_panel;
mod svg;

pub use figure::{NodalLines, Options, PictureError, plot};
