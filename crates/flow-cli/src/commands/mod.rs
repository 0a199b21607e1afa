//! One file per command: parse, call, print.

pub mod info;
pub mod plot;
