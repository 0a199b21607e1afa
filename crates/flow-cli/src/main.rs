//! The `curveflow` command.

fn main() {}
