//! How files begin, by which their kind is known.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Whether the file begins with `signature`; a shorter one does not.
pub(super) fn begins_with(path: &Path, signature: &[u8]) -> io::Result<bool> {
    let mut start = Vec::new();
    File::open(path)?.take(signature.len() as u64).read_to_end(&mut start)?;
    Ok(start == signature)
}
