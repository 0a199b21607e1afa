//! Whether the frames of a record are rectangles: as many values in each as the record has names and nodes.

use super::StorageError;
use crate::run::{Frame, Record};

/// Checks every frame.
///
/// # Errors
/// [`StorageError::Ragged`] at the first list of another length.
pub(super) fn check_frames(record: &Record) -> Result<(), StorageError> {
    let nodes = record.nodes();
    for (index, frame) in record.frames.iter().enumerate() {
        for (item, found, expected) in lengths(record, frame, nodes) {
            check(item, index, found, expected)?;
        }
    }
    Ok(())
}

/// Checks one list, number `index` of its kind.
///
/// # Errors
/// [`StorageError::Ragged`].
pub(super) fn check(
    item: &'static str,
    index: usize,
    found: usize,
    expected: usize,
) -> Result<(), StorageError> {
    if found == expected { Ok(()) } else { Err(StorageError::Ragged { item, index, found, expected }) }
}

/// What a frame holds, how many values it has and should have.
fn lengths<'a>(
    record: &'a Record,
    frame: &'a Frame,
    nodes: usize,
) -> impl Iterator<Item = (&'static str, usize, usize)> + 'a {
    let fields = |item, fields: &'a [Vec<f64>]| fields.iter().map(move |field| (item, field.len(), nodes));
    [
        ("energy_terms", frame.energy_terms.len(), record.energy_terms.len()),
        ("mass", frame.mass.len(), record.densities.len()),
        ("density", frame.density.len(), record.densities.len()),
        ("fields", frame.fields.len(), record.fields.len()),
        ("diagnostics", frame.diagnostics.len(), record.diagnostics.len()),
        ("position", frame.position.len(), nodes),
        ("curvature", frame.curvature.len(), nodes),
        ("metric", frame.metric.len(), nodes),
        ("normal_velocity", frame.normal_velocity.len(), nodes),
    ]
    .into_iter()
    .chain(fields("density", &frame.density))
    .chain(fields("fields", &frame.fields))
}
