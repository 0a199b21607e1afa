//! Writers that turn a [`Record`](crate::run::Record) into files, and the reader that brings it back.

pub mod atomic_file;
mod causes;
pub mod checkpoint;
mod drawn;
#[cfg(feature = "hdf5")]
pub mod hdf5_file;
mod links;
mod memory;
pub mod page;
#[cfg(feature = "picture")]
pub mod picture;
mod rectangle;
mod signature;
mod storage_error;
mod temporary;

pub use causes::with_causes;
pub use storage_error::{Operation, StorageError};
