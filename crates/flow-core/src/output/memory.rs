//! Whether there is memory for what takes much of it, asked before: a process that runs out of it on the way is ended by the system.

use std::collections::TryReserveError;
use std::hint::black_box;
use std::io::{self, ErrorKind};

/// Fails if `bytes` more bytes are not to be had now.
pub(super) fn check_room(bytes: u64) -> io::Result<()> {
    let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
    let mut room: Vec<u8> = Vec::new();
    // An allocation that nobody looks at may be left out.
    let reserved = room.try_reserve_exact(black_box(bytes));
    black_box(&mut room);
    reserved.map_err(|_| ErrorKind::OutOfMemory.into())
}

/// All of `values`, which are `length` in number, or less.
pub(super) fn collected(
    values: impl Iterator<Item = f64>,
    length: usize,
) -> Result<Vec<f64>, TryReserveError> {
    let mut all = Vec::new();
    all.try_reserve_exact(length)?;
    all.extend(values.take(length));
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_refused() {
        assert!(check_room(1 << 20).is_ok());
        for bytes in [1 << 62, u64::MAX] {
            assert_eq!(check_room(bytes).unwrap_err().kind(), ErrorKind::OutOfMemory);
        }
        assert_eq!(collected([1.5, 2.5].into_iter(), 2).unwrap(), [1.5, 2.5]);
        assert!(collected([1.5].into_iter(), usize::MAX / 8).is_err());
    }
}
