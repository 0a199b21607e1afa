//! One file per command: parse, call, print.

pub mod check;
mod conduct;
mod idle;
pub mod info;
mod memory;
pub mod plot;
pub mod resume;
mod room;
pub mod run;
mod scene_args;
pub mod scenes;
pub mod schema;
mod so_far;
mod standing;
pub mod tradeoff;
pub mod view;
