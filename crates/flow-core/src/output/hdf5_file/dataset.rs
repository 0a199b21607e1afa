//! One dataset: chunked, with Fletcher32, dimension scales, a long name and units.

use std::borrow::Cow;

use hdf5_image::{attach_scale, set_scale};
use hdf5_metno::types::VarLenUnicode;
use hdf5_metno::{Dataset, Extent, Group, H5Type, Location, SimpleExtents};

use super::meanings::{self, Meaning};
use crate::output::StorageError;
use crate::run::chunk_rows;

/// A named dimension.
pub(super) struct Axis {
    scale: Dataset,
    length: usize,
}

/// Turns an error of the library into ours, naming what was being built.
pub(super) fn building<E: std::error::Error + Send + Sync + 'static>(
    item: &str,
) -> impl FnOnce(E) -> StorageError + '_ {
    move |source| StorageError::Build { item: item.to_owned(), source: Box::new(source) }
}

/// Makes a dimension that is no variable, as netCDF-4 does: only its name and length matter.
pub(super) fn axis(group: &Group, name: &str, length: usize) -> Result<Axis, StorageError> {
    let scale = empty::<u8>(group, name, &[length]).map_err(building(name))?;
    let label = format!("This is a netCDF dimension but not a netCDF variable.{length:10}");
    set_scale(&scale, &label).map_err(building(name))?;
    describe(&scale, &meanings::axis(name))?;
    Ok(Axis { scale, length })
}

/// Makes a dimension with one label per entry.
pub(super) fn labelled_axis(group: &Group, name: &str, labels: &[&str]) -> Result<Axis, StorageError> {
    let scale = empty::<VarLenUnicode>(group, name, &[labels.len()]).map_err(building(name))?;
    let labels: Vec<_> = labels.iter().map(|label| text(label)).collect();
    scale.write_raw(&labels).map_err(building(name))?;
    set_scale(&scale, name).map_err(building(name))?;
    describe(&scale, &meanings::axis(name))?;
    Ok(Axis { scale, length: labels.len() })
}

/// Writes `data`, row by row, as the dataset `name` over `axes`.
pub(super) fn dataset<T: H5Type>(
    group: &Group,
    name: &str,
    axes: &[&Axis],
    meaning: &Meaning,
    data: &[T],
) -> Result<(), StorageError> {
    let shape: Vec<usize> = axes.iter().map(|axis| axis.length).collect();
    let dataset = empty::<T>(group, name, &shape).map_err(building(name))?;
    if !data.is_empty() {
        dataset.write_raw(data).map_err(building(name))?;
    }
    for (number, axis) in (0..).zip(axes) {
        attach_scale(&dataset, &axis.scale, number).map_err(building(name))?;
    }
    describe(&dataset, meaning)
}

fn describe(dataset: &Dataset, meaning: &Meaning) -> Result<(), StorageError> {
    write_text(dataset, "long_name", &meaning.long_name)?;
    write_text(dataset, "units", meaning.units)
}

/// Writes a text attribute, UTF-8 of variable length, which h5py gives as `str`.
pub(super) fn write_text(owner: &Location, name: &str, value: &str) -> Result<(), StorageError> {
    let attribute = owner.new_attr::<VarLenUnicode>().create(name);
    attribute.and_then(|attribute| attribute.write_scalar(&text(value))).map_err(building(name))
}

/// A text as the library stores it; it cannot hold NUL bytes, which become replacement characters.
pub(super) fn text(value: &str) -> VarLenUnicode {
    storable(value).parse().unwrap_or_default()
}

/// The text that is read again where `value` is written.
pub(super) fn storable(value: &str) -> Cow<'_, str> {
    if value.contains('\0') { value.replace('\0', "\u{FFFD}").into() } else { value.into() }
}

fn empty<T: H5Type>(group: &Group, name: &str, shape: &[usize]) -> hdf5_metno::Result<Dataset> {
    // The library has no chunks of size 0: an empty dimension is one that could grow.
    let extents = shape.iter().map(|&n| if n == 0 { Extent::resizable(0) } else { Extent::fixed(n) });
    let row: usize = shape.iter().skip(1).product();
    let mut chunk: Vec<usize> = shape.iter().map(|&n| n.max(1)).collect();
    if let Some(first) = chunk.first_mut() {
        *first = chunk_rows(*first, row);
    }
    group
        .new_dataset::<T>()
        .shape(SimpleExtents::from_vec(extents.collect()))
        .chunk(chunk)
        .fletcher32()
        .obj_track_times(false)
        .create(name)
}
