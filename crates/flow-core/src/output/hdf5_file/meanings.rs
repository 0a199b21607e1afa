//! Long names and units of dimensions and of what a scene names: its terms, its densities, and the fields that it asks for.

use std::borrow::Cow;

/// Name and units of a dataset.
pub(super) struct Meaning {
    pub(super) long_name: Cow<'static, str>,
    pub(super) units: &'static str,
}

impl Meaning {
    pub fn new(long_name: impl Into<Cow<'static, str>>, units: &'static str) -> Self {
        Self { long_name: long_name.into(), units }
    }
}

/// A dimension.
pub(super) fn axis(name: &str) -> Meaning {
    let long_name = match name {
        "frame" => "saved state",
        "node" => "node of the curve",
        "component" => "component of a vector",
        "step" => "accepted step",
        other => other,
    };
    Meaning::new(long_name.to_owned(), "1")
}

/// Energy of a term.
pub(super) fn energy_term(name: &str) -> Meaning {
    Meaning::new(format!("energy of the term {name}"), "energy_unit")
}

/// Mass of a density.
pub(super) fn mass(name: &str) -> Meaning {
    Meaning::new(format!("mass of {name}"), "density_unit length_unit")
}

/// A density.
pub(super) fn density(name: &str) -> Meaning {
    Meaning::new(format!("density of {name}"), "density_unit")
}

/// A distance from the incompressible flow.
pub(super) fn diagnostic(name: &str) -> Meaning {
    let long_name = format!("{}, its norm in L2 over the arc length", spaced(name));
    let units = match name {
        "velocity_residual" => "length_unit1.5 time_unit-1",
        _ => "density_unit length_unit0.5",
    };
    Meaning::new(long_name, units)
}

/// A field of `output.fields`. The strength of a membrane term is measured in units of its own, `epsilon_unit`.
pub(super) fn field(name: &str) -> Meaning {
    let units = match name {
        "normal_force" => "energy_unit length_unit-2",
        "excess_density" => "density_unit epsilon_unit-1",
        "membrane_flux" => "density_unit epsilon_unit-1 length_unit-1",
        _ if name.starts_with("energy_density") => "energy_unit length_unit-1",
        _ => "length_unit time_unit-1",
    };
    Meaning::new(spaced(name), units)
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}
