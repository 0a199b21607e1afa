//! What is in a result file, once, for the writer and the reader: an entry is named after the Rust field it holds.

use super::meanings::{self, Meaning};
use crate::run::{Counters, EvaluationSeconds, Frame, Record, Rejections, StepLog};

/// The attribute `Conventions` of every result file; the number changes when readers must.
pub const CONVENTIONS: &str = "Curveflow-1";

/// One value, list or field `T` inside an owner `S`.
pub(super) struct Entry<S, T> {
    pub name: &'static str,
    pub long_name: &'static str,
    pub units: &'static str,
    pub get: fn(&S) -> &T,
    pub slot: fn(&mut S) -> &mut T,
}

macro_rules! entries {
    ($owner:ty => $kind:ty: $($field:ident, $long_name:literal, $units:literal;)+) => {
        &[$(Entry::<$owner, $kind> {
            name: stringify!($field),
            long_name: $long_name,
            units: $units,
            get: |owner| &owner.$field,
            slot: |owner| &mut owner.$field,
        }),+]
    };
}

/// Values with one entry per frame.
pub(super) static FRAME_VALUES: &[Entry<Frame, f64>] = entries![Frame => f64:
    time, "simulated time", "time_unit";
    energy, "energy", "energy_unit";
    dissipation, "dissipation, minus the rate of change of the energy", "energy_unit time_unit-1";
    energy_balance, "energy - initial energy + dissipation integrated over time", "energy_unit";
    remap_error, "energy that changes of the nodes or of the gauge have added", "energy_unit";
    length, "length of the curve", "length_unit";
    area, "enclosed area, signed", "length_unit2";
    closure_defect, "gap between the ends of the curve before projection", "length_unit";
    crossings, "number of self-crossings", "1";
];

/// Fields with one entry per frame and node.
pub(super) static NODAL_FIELDS: &[Entry<Frame, Vec<f64>>] = entries![Frame => Vec<f64>:
    curvature, "curvature, positive on a circle", "length_unit-1";
    metric, "metric, arc length per unit parameter", "length_unit";
    normal_velocity, "velocity along the outward normal", "length_unit time_unit-1";
];

/// Numbers with one entry per accepted step.
pub(super) static STEP_VALUES: &[Entry<StepLog, Vec<f64>>] = entries![StepLog => Vec<f64>:
    time, "simulated time at the end of the step", "time_unit";
    size, "size of the step", "time_unit";
    energy, "energy at the end of the step", "energy_unit";
    dissipation, "dissipation at the end of the step", "energy_unit time_unit-1";
];

/// Causes of rejection, both per step and in all.
pub(super) static CAUSES: &[Entry<Rejections, u64>] = entries![Rejections => u64:
    error, "attempts rejected because the local error was above the tolerance", "1";
    solver, "attempts rejected because the implicit solve did not converge", "1";
    energy_rise, "attempts rejected because the energy rose by more than rounding", "1";
    not_finite, "attempts rejected because a value was NaN or infinite", "1";
];

/// Counters of the whole run.
pub(super) static COUNTERS: &[Entry<Counters, u64>] = entries![Counters => u64:
    steps, "accepted steps", "1";
    right_hand_sides, "evaluations of the right-hand side", "1";
    jacobian_products, "products of the implicit operator with a vector", "1";
    newton_iterations, "Newton iterations", "1";
    krylov_iterations, "Krylov iterations", "1";
    factorisations, "factorisations", "1";
    solves, "solves with a factorisation", "1";
    remaps, "changes of the nodes or of the gauge", "1";
    unresolved_steps, "steps whose state the nodes do not resolve: to the tolerance if they are automatic, to a thousandth if they are fixed; all if those miss initial data", "1";
];

/// Parts of the evaluations besides the terms of the energy.
pub(super) static EVALUATIONS: &[Entry<EvaluationSeconds, f64>] = entries![EvaluationSeconds => f64:
    normal_mobility, "the normal mobility", "s";
    density_mobilities, "the mobilities of the densities", "s";
    flow_map, "gauge, flow map, transforms and closure", "s";
];

/// A group with one dataset per name, each with one value per frame.
pub(super) struct NamedValues {
    pub group: &'static str,
    pub meaning: fn(&str) -> Meaning,
    pub names: fn(&Record) -> &Vec<String>,
    pub get: fn(&Frame) -> &Vec<f64>,
    pub slot: fn(&mut Frame) -> &mut Vec<f64>,
}

/// Values per energy term and per density, and those that come with a term.
pub(super) static NAMED_VALUES: &[NamedValues] = &[
    NamedValues {
        group: "energy_terms",
        meaning: meanings::energy_term,
        names: |record| &record.energy_terms,
        get: |frame| &frame.energy_terms,
        slot: |frame| &mut frame.energy_terms,
    },
    NamedValues {
        group: "mass",
        meaning: meanings::mass,
        names: |record| &record.densities,
        get: |frame| &frame.mass,
        slot: |frame| &mut frame.mass,
    },
    NamedValues {
        group: "diagnostics",
        meaning: meanings::diagnostic,
        names: |record| &record.diagnostics,
        get: |frame| &frame.diagnostics,
        slot: |frame| &mut frame.diagnostics,
    },
];

/// A group with one field per name, each with one value per frame and node.
pub(super) struct NamedFields {
    pub group: &'static str,
    pub meaning: fn(&str) -> Meaning,
    pub names: fn(&Record) -> &Vec<String>,
    pub get: fn(&Frame) -> &Vec<Vec<f64>>,
    pub slot: fn(&mut Frame) -> &mut Vec<Vec<f64>>,
}

/// Densities, and fields that the scene asks for.
pub(super) static NAMED_FIELDS: &[NamedFields] = &[
    NamedFields {
        group: "density",
        meaning: meanings::density,
        names: |record| &record.densities,
        get: |frame| &frame.density,
        slot: |frame| &mut frame.density,
    },
    NamedFields {
        group: "fields",
        meaning: meanings::field,
        names: |record| &record.fields,
        get: |frame| &frame.fields,
        slot: |frame| &mut frame.fields,
    },
];
