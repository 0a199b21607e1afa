//! The attributes of a result file: which scene, which program, which machine, how much work, why it stopped.

use hdf5_metno::types::VarLenUnicode;
use hdf5_metno::{File, H5Type, Location};

use super::dataset::{building, storable, text, write_text};
use super::layout::{CAUSES, CONVENTIONS, COUNTERS};
use super::numbers;
use crate::output::StorageError;
use crate::run::{Provenance, Record};

/// The attribute that names the terms from outside the scene. It is not in the checksum of the texts, so that versions that do not know
/// it read such files too; each of its names is one of `energy_terms`, which is.
pub(super) const OWN_TERMS: &str = "own_terms";

/// Writes all attributes of the file itself.
pub(super) fn write(file: &File, record: &Record) -> Result<(), StorageError> {
    write_text(file, "Conventions", CONVENTIONS)?;
    for (name, value) in texts(record) {
        write_text(file, name, value)?;
    }
    write_number(file, "text_checksum", &checksum(record))?;
    write_number(file, numbers::NAME, &numbers::checksum(record))?;
    write_names(file, "energy_terms", &record.energy_terms)?;
    write_names(file, OWN_TERMS, &record.own_terms)?;
    write_names(file, "densities", &record.densities)?;
    write_names(file, "fields", &record.fields)?;
    write_names(file, "diagnostics", &record.diagnostics)?;
    // Tells xarray which variables are coordinates.
    write_text(file, "coordinates", "time parameter")?;
    let Provenance { version, commit, machine, citation } = &record.provenance;
    write_text(file, "curveflow_version", version)?;
    if let Some(commit) = commit {
        write_text(file, "commit", commit)?;
    }
    write_text(file, "machine", machine)?;
    write_text(file, "citation", citation)?;
    for counter in COUNTERS {
        write_number(file, counter.name, (counter.get)(&record.counters))?;
    }
    for cause in CAUSES {
        write_number(file, &rejections_name(cause.name), (cause.get)(&record.counters.rejections))?;
    }
    write_number(file, "integration_seconds", &record.counters.integration_seconds)
}

/// Name of the attribute that counts the rejections by one cause.
pub(super) fn rejections_name(cause: &str) -> String {
    format!("rejections_{cause}")
}

/// FNV-1a of every text of the record. HDF5 keeps texts in a heap that has no checksum of its own.
pub(super) fn checksum(record: &Record) -> u64 {
    let texts = texts(record).map(|(_, value)| value);
    let names =
        record.energy_terms.iter().chain(&record.densities).chain(&record.fields).chain(&record.diagnostics);
    let names = names.map(String::as_str);
    let Provenance { version, commit, machine, citation } = &record.provenance;
    let origin = [version.as_str(), commit.as_deref().unwrap_or_default(), machine, citation];
    let next = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    texts
        .into_iter()
        .chain(names)
        .chain(origin)
        .fold(0xcbf2_9ce4_8422_2325, |hash, text| next(storable(text).bytes().fold(hash, next), 0))
}

fn texts(record: &Record) -> [(&'static str, &str); 5] {
    [
        ("title", &record.title),
        ("scene", &record.scene),
        ("resolved_scene", &record.resolved_scene),
        ("stop_reason", record.stop_reason.name()),
        ("message", record.stop_reason.message()),
    ]
}

/// Writes a number as an attribute of `owner`.
pub(super) fn write_number<T: H5Type>(owner: &Location, name: &str, value: &T) -> Result<(), StorageError> {
    let attribute = owner.new_attr::<T>().create(name);
    attribute.and_then(|attribute| attribute.write_scalar(value)).map_err(building(name))
}

/// Writes a list of names in order; an empty list is left out, since groups are sorted by name.
fn write_names(file: &File, name: &str, names: &[String]) -> Result<(), StorageError> {
    if names.is_empty() {
        return Ok(());
    }
    let names: Vec<_> = names.iter().map(|name| text(name)).collect();
    let attribute = file.new_attr::<VarLenUnicode>().shape(names.len()).create(name);
    attribute.and_then(|attribute| attribute.write_raw(&names)).map_err(building(name))
}
