//! Gradient flows of energies of closed planar curves that carry embedded densities.
//!
//! A curve with curvature κ and metric g carries densities ρ; an energy 𝓕(κ, g, ρ) pulls at all of them, and the flow is
//! dX/dt = −𝓚(X)∇𝓕 with 𝓚 symmetric and ≥ 0. The discrete flow has the same form exactly: on any grid the energy falls at the
//! rate that is recorded, and masses and turning number are kept to rounding. The equations are in [`theory`].
//!
//! The crate is used from a checkout of Curveflow, by its path: `flow-core = { path = "curveflow/crates/flow-core" }` among the
//! dependencies; the feature `hdf5` adds result files (and builds HDF5, for which there must be a C compiler), `picture` figures. Programs to start from
//! are in the folder `examples` of the checkout. Build with `--release`, or with `opt-level = 3` under `[profile.dev]` of your own
//! workspace: without optimisation runs take many times as long.
//!
//! # A run
//!
//! A *scene* says what flows and how accurately; a *record* is what a run leaves behind.
//!
//! ```
//! use flow_core::run::{Quiet, Scene, StopReason, run};
//!
//! let scene = Scene::parse(
//!     "
//!     curve = { shape = 'circle', radius = 1.0 }
//!     energy.bending.rigidity = 1.0
//!     time = { end = 1.0, stop_at_equilibrium = false }
//!     accuracy = { tolerance = 1e-6, nodes = 32 }
//!     ",
//!     "circle.toml",
//! )?;
//! let record = run(&scene, &mut Quiet)?;
//! assert_eq!(record.stop_reason, StopReason::EndTime);
//!
//! // A circle under bending grows as R(t) = (1 + 2t)^(1/4).
//! let radius = record.frames.last().map(|last| last.length / std::f64::consts::TAU);
//! assert!((radius.unwrap() - 3f64.powf(0.25)).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A mistake
//!
//! Whatever is wrong with a scene is an error that names the line, the value, the bound and a remedy; nothing that a scene
//! holds makes the library panic.
//!
//! ```
//! use flow_core::run::Scene;
//!
//! let text = "
//! curve = { shape = 'circle', radius = -1.0 }
//! energy.bending.rigidty = 1.0
//! time.end = 1.0
//! ";
//! let error = Scene::parse(text, "circle.toml").unwrap_err();
//! assert_eq!(error.problems().len(), 2);
//! assert!(error.to_string().contains("line 3 | energy.bending.rigidty = 1.0"));
//! assert!(error.to_string().contains("did you mean `rigidity`?"));
//! ```
//!
//! # Where to look
//!
//! | to | use |
//! | --- | --- |
//! | run a scene to its end | [`run::run`], [`run::Scene`] |
//! | watch it, or stop it | [`run::Observer`] |
//! | drive it step by step | [`run::Simulation`] |
//! | save it and go on later | [`output::checkpoint`] |
//! | write and read result files | `output::hdf5_file` (feature `hdf5`) |
//! | draw it | `output::picture` (feature `picture`), [`output::page`] |
//! | know which tolerance is enough | [`run::tradeoff`] |
//! | bring your own integrator | [`run::Setup`], [`integrator::Problem`] |
//! | integrate your own problem | [`integrator::Problem`] (with an example), [`integrator::Adaptive`], [`integrator::Bdf`] |
//! | evaluate force, velocity and dissipation of a state | [`flow::GradientFlow`] |
//! | add a term to the energy | as a formula of the scene (`energy.local`), or an [`energies::EnergyTerm`] in [`run::Simulation::with_terms`] |
//! | know whether its derivatives are right | [`flow::GradientFlow::check_derivatives`] |
//! | move the curve or its densities by another law | a [`flow::NormalMobility`], a [`flow::DensityMobility`] in [`flow::GradientFlow::new`] |
//! | move the nodes by another rule | a [`flow::Gauge`] in [`flow::FlowMap::in_gauge`] |
//! | have the linear operators alone | [`operators::CyclicBanded`], [`operators::Helmholtz`], [`operators::Derivative`] |
//! | use the formulas of scenes | [`expression`] |
//!
//! Scenes know the mobilities and gauges of the library by name, and no others: a flow of your own is put together by hand, given to
//! [`run::Membrane`], and that to the integrator. The folder `crates/flow-core/tests/outside` of the checkout does so with an energy, two
//! mobilities and a gauge of its own: its `parts.rs`, `gauge.rs` and `main.rs` are the way to follow.
//!
//! # Layers
//!
//! Data flows one way: [`geometry`] → [`operators`] → [`energies`] → [`flow`] → [`integrator`] → [`run`] → [`output`]. The kernels take
//! `f64` slices and allocate nothing after the first step; no code here is `unsafe`.

#![warn(unnameable_types)] // what others may hold they may name

pub mod energies;
pub mod expression;
pub mod flow;
pub mod geometry;
pub mod integrator;
pub mod operators;
pub mod output;
pub mod run;

#[doc = include_str!("../../../THEORY.md")]
#[allow(clippy::doc_markdown, rustdoc::broken_intra_doc_links, rustdoc::invalid_html_tags)] // they are mathematics there
pub mod theory {}
