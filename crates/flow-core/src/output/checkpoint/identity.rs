//! Which file it is, by its content: also if it was moved or copied meanwhile.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// Length and CRC-32 of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    bytes: u64,
    checksum: u32,
}

impl Identity {
    /// That of the file `path`.
    ///
    /// # Errors
    /// What the system says if it is no plain file, or cannot be read.
    pub fn of(path: &Path) -> io::Result<Self> {
        if !fs::metadata(path)?.is_file() {
            return Err(io::ErrorKind::InvalidInput.into()); // a pipe would wait for its other end
        }
        let (mut file, mut buffer) = (File::open(path)?, [0; 1 << 14]);
        let (mut bytes, mut checksum) = (0, crc32fast::Hasher::new());
        loop {
            match file.read(&mut buffer) {
                Ok(0) => return Ok(Self { bytes, checksum: checksum.finalize() }),
                Ok(read) => {
                    bytes += read as u64;
                    checksum.update(&buffer[..read]);
                }
                Err(reason) if reason.kind() == io::ErrorKind::Interrupted => {}
                Err(reason) => return Err(reason),
            }
        }
    }
}
