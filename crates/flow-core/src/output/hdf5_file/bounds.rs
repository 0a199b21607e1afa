//! What a file may make its reader do: take as much memory as the file itself, open no other file, and believe no data
//! without a checksum. Strangers' files claim terabytes in a few bytes.

use std::cell::Cell;

use hdf5_metno::filters::Filter;
use hdf5_metno::{Dataset, Group, H5Type, IndexType, IterationOrder, LinkType, Result as Hdf5Result};

/// The bytes that may still be read.
pub(super) struct Bounds {
    file: usize,
    left: Cell<usize>,
}

impl Bounds {
    /// Bounds for a file of `bytes` bytes: nothing in it is compressed, so all its data together take less.
    pub fn of(bytes: u64) -> Self {
        let file = usize::try_from(bytes).unwrap_or(usize::MAX);
        Self { file, left: Cell::new(file) }
    }

    /// All values of a dataset.
    pub fn read<T: H5Type>(&self, dataset: &Dataset) -> Hdf5Result<Vec<T>> {
        if dataset.filters() != [Filter::Fletcher32] {
            return Err(format!("its filters are {:?}, not a checksum alone", dataset.filters()).into());
        }
        let chunk = dataset.chunk().unwrap_or_default();
        if bytes(&chunk, dataset.dtype()?.size()).is_none_or(|bytes| bytes > self.file) {
            return Err(format!("its chunks are of {chunk:?} values, more than the file holds").into());
        }
        let shape = dataset.shape();
        let left = bytes(&shape, size_of::<T>()).and_then(|bytes| self.left.get().checked_sub(bytes));
        self.left.set(left.ok_or_else(|| format!("its shape is {shape:?}, more than the file holds"))?);
        // The library refuses to read nothing from a dataset without chunks.
        if shape.contains(&0) { Ok(Vec::new()) } else { dataset.read_raw() }
    }
}

/// Bytes of an array, if they can be counted.
fn bytes(shape: &[usize], element: usize) -> Option<usize> {
    // A dimension of size 0 must not hide an overflow of the others.
    shape.iter().try_fold(element, |bytes, &length| bytes.checked_mul(length.max(1)))
}

/// Refuses links that lead out of the tree of `group`, to other files or back.
pub(super) fn check_links(group: &Group) -> Hdf5Result<()> {
    let lead_out = |name: &str, kind| (kind != LinkType::Hard).then(|| name.to_owned());
    match group
        .find_link(IndexType::Name, IterationOrder::Native, |name, link| Ok(lead_out(name, link.link_type)))?
    {
        Some(name) => Err(format!("\"{name}\" in {} is a link to elsewhere", group.name()).into()),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_datasets_together_are_no_larger_than_the_file() {
        let file = hdf5_metno::File::with_options()
            .with_fapl(|plist| plist.core_filebacked(false))
            .create("curveflow-bounds.h5")
            .unwrap();
        let dataset = file.new_dataset::<f64>().shape(100).chunk(50).fletcher32().create("values").unwrap();
        dataset.write_raw(&[1.5; 100]).unwrap();
        let bounds = Bounds::of(1000);
        assert_eq!(bounds.read::<f64>(&dataset).unwrap(), [1.5; 100]);
        let error = bounds.read::<f64>(&dataset).unwrap_err().to_string();
        assert!(error.contains("its shape is [100], more than the file holds"), "{error}");
        let error = Bounds::of(300).read::<f64>(&dataset).unwrap_err().to_string();
        assert!(error.contains("its chunks are of [50] values"), "{error}");
    }

    #[test]
    fn sizes_that_cannot_be_counted_are_none() {
        assert_eq!(bytes(&[3, 5], 8), Some(120));
        assert_eq!(bytes(&[1 << 33, 1 << 31], 8), None);
        assert_eq!(bytes(&[1 << 33, 1 << 31, 0], 8), None);
    }
}
