//! Builds a result file in memory and hands its bytes to [`atomic_file`]: the HDF5 library never touches the disk.

use std::collections::TryReserveError;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use hdf5_metno::{File, file::LibraryVersion};

use super::dataset::{Axis, axis, building, dataset, labelled_axis, write_text};
use super::layout::{CAUSES, FRAME_VALUES, NAMED_FIELDS, NAMED_VALUES, NODAL_FIELDS, STEP_VALUES};
use super::meanings::Meaning;
use super::{provenance, seconds};
use crate::output::rectangle::{check, check_frames};
use crate::output::{StorageError, atomic_file};
use crate::run::{Frame, Record, Seconds, Spending};

/// Writes `record` to `path`; an existing file is replaced only if `replace`.
/// # Errors
/// [`StorageError`]; the target is then as it was, and no other file is left.
pub fn write(record: &Record, path: &Path, replace: bool) -> Result<(), StorageError> {
    atomic_file::write(path, &to_bytes(record)?, replace)
}

/// As [`write()`], and adds the time that it takes to the output of the record: in the file up to where its bytes leave for
/// the disk, in `record` all.
/// # Errors
/// As for [`write()`].
pub fn write_timed(record: &mut Record, path: &Path, replace: bool) -> Result<(), StorageError> {
    let (clock, before) = (Instant::now(), record.seconds[Spending::Output]);
    let so_far = || before + clock.elapsed().as_secs_f64();
    atomic_file::write(path, &encode(record, so_far)?, replace)?;
    record.seconds[Spending::Output] = so_far();
    Ok(())
}

/// Returns the bytes of the result file of `record`.
/// # Errors
/// [`StorageError::Ragged`] if its frames differ in size, [`StorageError::Build`] if memory runs out.
pub fn to_bytes(record: &Record) -> Result<Vec<u8>, StorageError> {
    encode(record, || record.seconds[Spending::Output])
}

/// The bytes of `record`, with what `output` tells of the time that the output takes, asked for last.
fn encode(record: &Record, output: impl FnOnce() -> f64) -> Result<Vec<u8>, StorageError> {
    check_rectangular(record)?;
    let file = in_memory()?;
    let frame = axis(&file, "frame", record.frames.len())?;
    let node = axis(&file, "node", record.nodes())?;
    let component = labelled_axis(&file, "component", &["x", "y"])?;
    write_values(&file, record, &frame)?;
    write_fields(&file, record, [&frame, &node, &component])?;
    write_steps(&file, record)?;
    provenance::write(&file, record)?;
    if record.seconds != Seconds::default() {
        let mut seconds = record.seconds.clone();
        seconds[Spending::Output] = output();
        seconds::write(&file, &seconds, &record.energy_terms)?;
    }
    hdf5_image::file_image(&file).map_err(building("the image of the file"))
}

/// A file that exists in memory only.
fn in_memory() -> Result<File, StorageError> {
    // The library takes two open files of one name for the same file.
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let name = format!("curveflow-{}", COUNTER.fetch_add(1, Ordering::Relaxed));
    let version = LibraryVersion::V110; // the first with checksums in all metadata
    File::with_options()
        .with_fapl(|plist| plist.core_options(1 << 20, false).libver_bounds(version, version))
        .create(name)
        .map_err(building("a file"))
}

fn write_values(file: &File, record: &Record, frame: &Axis) -> Result<(), StorageError> {
    for entry in FRAME_VALUES {
        let values = per_frame(record, |frame| *(entry.get)(frame));
        let meaning = Meaning::new(entry.long_name, entry.units);
        dataset(file, entry.name, &[frame], &meaning, &values)?;
    }
    for list in NAMED_VALUES {
        let group = file.create_group(list.group).map_err(building(list.group))?;
        for (i, name) in (list.names)(record).iter().enumerate() {
            let values = per_frame(record, |frame| (list.get)(frame)[i]);
            let meaning = (list.meaning)(name);
            dataset(&group, name, &[frame], &meaning, &values)?;
        }
    }
    Ok(())
}

fn write_fields(file: &File, record: &Record, axes: [&Axis; 3]) -> Result<(), StorageError> {
    let [frame, node, component] = axes;
    let n = record.nodes();
    let parameter: Vec<f64> = (0..n).map(|i| i as f64 / n as f64).collect();
    let meaning = Meaning::new("parameter s of the node", "1");
    dataset(file, "parameter", &[node], &meaning, &parameter)?;
    for entry in NODAL_FIELDS {
        let values = flat(record, n, |frame| (entry.get)(frame).as_slice()).map_err(building(entry.name))?;
        let meaning = Meaning::new(entry.long_name, entry.units);
        dataset(file, entry.name, &[frame, node], &meaning, &values)?;
    }
    let position = flat(record, 2 * n, |frame| frame.position.as_flattened());
    let position = position.map_err(building("position"))?;
    let meaning = Meaning::new("position of the node", "length_unit");
    dataset(file, "position", &[frame, node, component], &meaning, &position)?;
    for list in NAMED_FIELDS {
        let group = file.create_group(list.group).map_err(building(list.group))?;
        for (i, name) in (list.names)(record).iter().enumerate() {
            let values = flat(record, n, |frame| (list.get)(frame)[i].as_slice()).map_err(building(name))?;
            let meaning = (list.meaning)(name);
            dataset(&group, name, &[frame, node], &meaning, &values)?;
        }
    }
    Ok(())
}

fn write_steps(file: &File, record: &Record) -> Result<(), StorageError> {
    let steps = &record.steps;
    let group = file.create_group("steps").map_err(building("steps"))?;
    let step = axis(&group, "step", steps.time.len())?;
    write_text(&group, "coordinates", "time")?;
    for entry in STEP_VALUES {
        let meaning = Meaning::new(entry.long_name, entry.units);
        dataset(&group, entry.name, &[&step], &meaning, (entry.get)(steps))?;
    }
    let meaning = Meaning::new("order of the method", "1");
    dataset(&group, "order", &[&step], &meaning, &steps.order)?;
    let meaning = Meaning::new("number of nodes in the step", "1");
    dataset(&group, "nodes", &[&step], &meaning, &steps.nodes)?;
    let rejections = group.create_group("rejections").map_err(building("rejections"))?;
    for cause in CAUSES {
        let counts: Vec<u64> = steps.rejections.iter().map(|counts| *(cause.get)(counts)).collect();
        let meaning = Meaning::new(cause.long_name, cause.units);
        dataset(&rejections, cause.name, &[&step], &meaning, &counts)?;
    }
    Ok(())
}

fn per_frame(record: &Record, value: impl Fn(&Frame) -> f64) -> Vec<f64> {
    record.frames.iter().map(value).collect()
}

/// The values of `field` in all frames, `row` of them in each.
fn flat<'a>(
    record: &'a Record,
    row: usize,
    field: impl Fn(&'a Frame) -> &'a [f64],
) -> Result<Vec<f64>, TryReserveError> {
    collected(record.frames.iter().flat_map(field).copied(), record.frames.len() * row)
}

/// All of `values`, which are `length` in number, or less, if there is memory for so many.
fn collected(values: impl Iterator<Item = f64>, length: usize) -> Result<Vec<f64>, TryReserveError> {
    let mut all = Vec::new();
    all.try_reserve_exact(length)?;
    all.extend(values.take(length));
    Ok(all)
}

/// A file is a set of rectangles: every frame has the same sizes, every step an entry in each list.
fn check_rectangular(record: &Record) -> Result<(), StorageError> {
    check_frames(record)?;
    if record.seconds != Seconds::default() {
        check("seconds/evaluations", 0, record.seconds.evaluations.terms.len(), record.energy_terms.len())?;
    }
    let steps = record.steps.time.len();
    for (index, entry) in STEP_VALUES.iter().enumerate() {
        check("steps", index, (entry.get)(&record.steps).len(), steps)?;
    }
    check("steps/order", 0, record.steps.order.len(), steps)?;
    check("steps/nodes", 0, record.steps.nodes.len(), steps)?;
    check("steps/rejections", 0, record.steps.rejections.len(), steps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_values_than_there_is_memory_for_are_refused() {
        assert_eq!(collected([1.5, 2.5].into_iter(), 2).unwrap(), [1.5, 2.5]);
        assert!(collected([1.5].into_iter(), usize::MAX / 8).is_err());
    }
}
