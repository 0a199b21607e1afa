//! Rivals of the integrator of `flow-core`, and the measurements that choose among them.
//!
//! `cargo run --release -p curveflow-benches --bin methods` makes the tables of `benches/README.md`.

pub mod measure;
pub mod report;
pub mod rivals;
pub mod stripped;
