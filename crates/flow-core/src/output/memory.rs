//! Whether there is memory for what takes much of it, asked before: a process that runs out of it on the way is ended by the system.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_refused() {
        assert!(check_room(1 << 20).is_ok());
        for bytes in [1 << 62, u64::MAX] {
            assert_eq!(check_room(bytes).unwrap_err().kind(), ErrorKind::OutOfMemory);
        }
    }
}
