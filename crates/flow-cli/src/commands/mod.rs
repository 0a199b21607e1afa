//! One file per command: parse, call, print.

pub mod check;
pub mod info;
pub mod plot;
pub mod run;
mod scene_args;
pub mod scenes;
pub mod view;
