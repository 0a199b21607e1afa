//! Result files in HDF5: written whole, read back whole, opened by h5py, xarray (h5netcdf) and netCDF-4.

mod bounds;
mod dataset;
mod heaps;
mod layout;
mod meanings;
mod numbers;
mod opening;
mod provenance;
mod reader;
mod seconds;
mod writer;

pub use layout::CONVENTIONS;
pub use reader::read;
pub use writer::{to_bytes, write, write_timed};
