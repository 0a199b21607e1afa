//! A measured ladder as plain numbers and texts, as which it travels between processes, and back.

use flow_core::run::tradeoff::{Ending, Errors, Reference, Row, Rung, Span};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Time halfway, time of the end, name of what is there.
pub type SpanParts = (f64, f64, String);
/// Tolerance, whether rounding limits it, nodes, steps and seconds.
pub type ReferenceParts = (f64, bool, usize, u64, f64);
/// Tolerance, nodes, steps, seconds, errors halfway and at the end.
pub type RungParts = (f64, usize, u64, f64, [Vec<f64>; 2]);

pub fn of_span(span: Span) -> SpanParts {
    (span.halfway, span.end, span.ending.name().to_owned())
}

pub fn of_reference(reference: Reference) -> ReferenceParts {
    (reference.tolerance, reference.at_rounding, reference.nodes, reference.steps, reference.seconds)
}

pub fn of_rung((tolerance, rung): (f64, &Rung)) -> RungParts {
    (tolerance, rung.nodes, rung.steps, rung.seconds, rung.errors.each_ref().map(values))
}

/// The errors in the order of their names.
pub fn values(errors: &Errors) -> Vec<f64> {
    let Errors { curve, curvature, densities, energy, length } = errors;
    [*curve, *curvature].into_iter().chain(densities.iter().copied()).chain([*energy, *length]).collect()
}

pub fn span((halfway, end, name): SpanParts) -> PyResult<Span> {
    let endings = [Ending::EndTime, Ending::Equilibrium, Ending::Contact];
    let ending = endings.into_iter().find(|ending| ending.name() == name);
    let ending = ending.ok_or_else(|| PyValueError::new_err(format!("no ladder ends at {name:?}")))?;
    Ok(Span { halfway, end, ending })
}

pub fn reference((tolerance, at_rounding, nodes, steps, seconds): ReferenceParts) -> Reference {
    Reference { tolerance, at_rounding, nodes, steps, seconds }
}

pub fn row((tolerance, nodes, steps, seconds, [halfway, end]): RungParts) -> PyResult<Row> {
    let errors = [errors(&halfway)?, errors(&end)?];
    Ok(Row { tolerance, outcome: Ok(Rung { nodes, steps, seconds, errors }) })
}

fn errors(values: &[f64]) -> PyResult<Errors> {
    let &[curve, curvature, ref densities @ .., energy, length] = values else {
        return Err(PyValueError::new_err(format!(
            "{} errors: a run has 4, and one per density",
            values.len()
        )));
    };
    Ok(Errors { curve, curvature, densities: densities.to_vec(), energy, length })
}
