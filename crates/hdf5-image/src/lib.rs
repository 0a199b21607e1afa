//! What `hdf5-metno` 0.15 does not wrap: the image of a file that lives in memory, and dimension scales.
//!
//! The library must never write to a disk itself, since it crashes the process when the disk is full. So files
//! are built in memory, and [`file_image`] hands over their bytes. Both need calls into the C library; this
//! crate is the only place of the workspace where `unsafe` is allowed, and it does nothing else.

use std::collections::TryReserveError;
use std::ffi::{CString, NulError, c_char, c_uint};
use std::ptr;

use hdf5_metno::sync::sync;
use hdf5_metno::{Dataset, File};
use hdf5_metno_sys::h5::herr_t;
use hdf5_metno_sys::h5f::H5Fget_file_image;
use hdf5_metno_sys::h5i::hid_t;

// Part of the high-level library, which the feature `hl` of `hdf5-metno-sys` builds and links.
unsafe extern "C" {
    fn H5DSset_scale(scale: hid_t, name: *const c_char) -> herr_t;
    fn H5DSattach_scale(dataset: hid_t, scale: hid_t, axis: c_uint) -> herr_t;
}

/// Why a call failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// The library could not finish the file in memory.
    #[error("the file could not be completed in memory: {0}")]
    Flush(#[source] hdf5_metno::Error),
    /// The library gave no image.
    #[error("HDF5 gave no image of the file: it returned {returned} for a buffer of {size} bytes")]
    Image {
        /// What `H5Fget_file_image` returned.
        returned: isize,
        /// Size of the buffer that it was given, 0 when it was asked for the size.
        size: usize,
    },
    /// There is no memory for the image.
    #[error("there is no memory for the {size} bytes of the file")]
    Memory {
        /// Size of the file in bytes.
        size: usize,
        /// What the allocator says.
        source: TryReserveError,
    },
    /// A name holds a NUL byte.
    #[error("the name of a dimension holds a NUL byte at position {}", .0.nul_position())]
    Name(#[from] NulError),
    /// The library refused to make or attach a scale.
    #[error("HDF5 refused the dimension scale {scale} (axis {axis:?})")]
    Scale {
        /// Path of the scale inside the file.
        scale: String,
        /// Axis that it was to be attached to, or none when the scale itself was made.
        axis: Option<u32>,
    },
}

/// Returns the bytes that `file` would have on disk. The file stays open and unchanged.
/// # Errors
/// [`ImageError::Flush`] or [`ImageError::Image`] if the library runs out of memory or cannot finish the file, [`ImageError::Memory`].
pub fn file_image(file: &File) -> Result<Vec<u8>, ImageError> {
    file.flush().map_err(ImageError::Flush)?;
    sync(|| {
        // SAFETY: a null buffer of size 0 asks for the size; `file` keeps its identifier open.
        let size = unsafe { H5Fget_file_image(file.id(), ptr::null_mut(), 0) };
        let bytes = usize::try_from(size).map_err(|_| ImageError::Image { returned: size, size: 0 })?;
        let mut image = Vec::new();
        image.try_reserve_exact(bytes).map_err(|source| ImageError::Memory { size: bytes, source })?;
        image.resize(bytes, 0_u8);
        // SAFETY: the buffer holds `bytes` bytes, and the lock of `sync` keeps the file from growing meanwhile.
        let written = unsafe { H5Fget_file_image(file.id(), image.as_mut_ptr().cast(), bytes) };
        if usize::try_from(written) == Ok(bytes) {
            Ok(image)
        } else {
            Err(ImageError::Image { returned: written, size: bytes })
        }
    })
}

/// Makes `dataset` a dimension scale called `name`.
/// # Errors
/// [`ImageError::Name`] if `name` holds a NUL byte, [`ImageError::Scale`] if the library refuses.
pub fn set_scale(dataset: &Dataset, name: &str) -> Result<(), ImageError> {
    let text = CString::new(name)?;
    // SAFETY: `dataset` keeps its identifier open and `text` lives, NUL-terminated, until the call returns.
    let status = sync(|| unsafe { H5DSset_scale(dataset.id(), text.as_ptr()) });
    if status < 0 { Err(ImageError::Scale { scale: dataset.name(), axis: None }) } else { Ok(()) }
}

/// Attaches `scale` to axis number `axis` of `dataset`.
/// # Errors
/// [`ImageError::Scale`] if `scale` is no dimension scale, or `dataset` has no such axis or is a scale itself.
pub fn attach_scale(dataset: &Dataset, scale: &Dataset, axis: u32) -> Result<(), ImageError> {
    // SAFETY: both identifiers are kept open by the borrowed objects.
    let status = sync(|| unsafe { H5DSattach_scale(dataset.id(), scale.id(), axis) });
    if status < 0 { Err(ImageError::Scale { scale: scale.name(), axis: Some(axis) }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_memory(name: &str) -> File {
        File::with_options().with_fapl(|plist| plist.core_filebacked(false)).create(name).unwrap()
    }

    /// The image is a complete HDF5 file: written to a disk, it opens and holds the data; no other file appears.
    #[test]
    fn image_is_the_file() {
        let name = format!("hdf5-image-{}.h5", std::process::id());
        let file = in_memory(&name);
        file.new_dataset_builder().with_data(&[1.5, 2.5, 3.5]).create("values").unwrap();
        let image = file_image(&file).unwrap();
        assert!(!std::path::Path::new(&name).exists());
        let path = std::env::temp_dir().join(&name);
        std::fs::write(&path, image).unwrap();
        let values: Vec<f64> = File::open(&path).unwrap().dataset("values").unwrap().read_raw().unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(values, [1.5, 2.5, 3.5]);
    }

    /// A scale attaches to an existing axis and to no other; a plain dataset is made a scale by `set_scale` only.
    #[test]
    fn scales_attach_to_axes_that_exist() {
        let file = in_memory("hdf5-image-scales.h5");
        let scale = file.new_dataset_builder().with_data(&[0, 1, 2]).create("node").unwrap();
        let field = file.new_dataset_builder().with_data(&[1.0, 2.0, 3.0]).create("field").unwrap();
        set_scale(&scale, "node").unwrap();
        attach_scale(&field, &scale, 0).unwrap();
        assert!(field.attr("DIMENSION_LIST").is_ok() && scale.attr("REFERENCE_LIST").is_ok());
        assert!(matches!(attach_scale(&field, &scale, 5), Err(ImageError::Scale { axis: Some(5), .. })));
        assert!(matches!(set_scale(&field, "a\0b"), Err(ImageError::Name(_))));
    }
}
