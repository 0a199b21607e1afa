//! The global heaps of an HDF5 file, where its texts are, checked before the library sees them: they have no checksums, and
//! the library (2.2) loops for ever over an entry of length zero, such as a zeroed piece of a heap is made of.

use memchr::memmem::find_iter;

/// Signature and version of a heap; three reserved bytes follow, and its length.
const SIGNATURE: &[u8] = b"GCOL\x01";
const HEAD: usize = 16;
/// Index, references and length of an entry, which come before its content.
const ENTRY_HEAD: usize = 16;
/// The library takes nothing shorter for a heap.
const LEAST_LENGTH: usize = 4096;

/// Whether lengths and addresses in the file `bytes` have eight bytes each, as in all files of ours.
pub(super) fn has_wide_lengths(bytes: &[u8]) -> bool {
    let place = match bytes.get(8) {
        Some(0 | 1) => 13,
        _ => 9,
    };
    bytes.get(place..place + 2) == Some(&[8, 8])
}

/// Finds the first heap, by its place in the file, whose entries do not lie one behind the other.
pub(super) fn broken_heap(bytes: &[u8]) -> Option<usize> {
    find_iter(bytes, SIGNATURE).find(|start| {
        // What is too long for the file is numbers that look like a heap, or refused by the library.
        heap(&bytes[*start..]).is_some_and(|heap| !is_whole(heap))
    })
}

/// The entries of a heap at the start of `bytes`.
fn heap(bytes: &[u8]) -> Option<&[u8]> {
    let length = length_at(bytes, HEAD - 8)?;
    if length < LEAST_LENGTH { None } else { bytes.get(HEAD..length) }
}

fn is_whole(mut entries: &[u8]) -> bool {
    // What is shorter than the head of an entry is free.
    while entries.len() >= ENTRY_HEAD {
        let is_free = entries[..2] == [0, 0];
        let length = length_at(entries, ENTRY_HEAD - 8).unwrap_or(usize::MAX);
        // The length of free space includes its head.
        let all = if is_free {
            Some(length)
        } else {
            length.checked_next_multiple_of(8).and_then(|l| l.checked_add(ENTRY_HEAD))
        };
        let Some(rest) = all.filter(|all| *all >= ENTRY_HEAD).and_then(|all| entries.get(all..)) else {
            return false;
        };
        entries = rest;
    }
    true
}

fn length_at(bytes: &[u8], place: usize) -> Option<usize> {
    let (length, _) = bytes.get(place..)?.split_first_chunk()?;
    usize::try_from(u64::from_le_bytes(*length)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A heap with an entry of `length` bytes and index `index`, and free space behind it.
    fn file(index: u8, length: u64) -> Vec<u8> {
        let mut bytes = b"\x89HDF\r\n\x1a\n\x03\x08\x08 and so on GCOL\x01\0\0\0".to_vec();
        let start = bytes.len() - 8;
        bytes.extend(4096_u64.to_le_bytes());
        bytes.extend([index, 0, 1, 0, 0, 0, 0, 0]);
        bytes.extend(length.to_le_bytes());
        bytes.resize(start + HEAD + 40, b'x');
        bytes.extend([0; 8]);
        bytes.extend((4096_u64 - 56).to_le_bytes());
        bytes.resize(start + 4096, 0);
        bytes
    }

    #[test]
    fn entries_lie_one_behind_the_other() {
        assert!(has_wide_lengths(&file(1, 20)) && broken_heap(&file(1, 20)).is_none());
        // Zeroed, too long, and so long that its end overflows.
        for (index, length) in [(0, 0), (1, 5000), (1, u64::MAX), (1, u64::MAX - 15), (0, 8)] {
            assert_eq!(broken_heap(&file(index, length)), Some(22), "{index}, {length}");
        }
        let cut = &file(0, 0)[..4000];
        assert!(broken_heap(cut).is_none());
        assert!(
            !has_wide_lengths(b"\x89HDF\r\n\x1a\n\x03\x04\x08") && !has_wide_lengths(b"\x89HDF\r\n\x1a\n")
        );
    }
}
