//! A run as one HTML page: the curve moves, coloured by any of its fields, beside its energy and its state.
//!
//! The page holds all that it needs and asks no network for anything; what shows it is in `browser/`, in the
//! languages of browsers. Fields are kept as `f32`, positions too, from the middle of the curve on, the history as `f64`.
//! A page of F frames of n nodes with d fields (curvature, metric, normal velocity, each density, each field of `[output]`)
//! and h values per frame takes (16 (d + 2) n + 32 h + 128) / 3 bytes per frame, and at most 100 kB besides, plus the scene,
//! twice, and the log of at most 4000 steps, 64 / 3 bytes each.

mod base64;
mod card;
mod document;
mod facts;
mod json;
mod payload;
mod plane;
mod text;

pub use card::card;
pub use document::{PageError, html, view};
