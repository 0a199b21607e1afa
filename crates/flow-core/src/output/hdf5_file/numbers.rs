//! A checksum of all arrays of a record. Fletcher32, which HDF5 offers, takes a chunk that was lost to zeros for whole: the
//! checksum of zeros is zero.

use crc32fast::Hasher;

use super::layout::{CAUSES, FRAME_VALUES, NAMED_FIELDS, NAMED_VALUES, NODAL_FIELDS, STEP_VALUES};
use crate::run::Record;

/// Name of the attribute that holds it.
pub(super) const NAME: &str = "data_checksum";

/// CRC-32 of the frames, frame by frame, and of the log of steps, column by column, each number in little-endian bytes.
pub(super) fn checksum(record: &Record) -> u32 {
    let mut sum = Hasher::new();
    for frame in &record.frames {
        for entry in FRAME_VALUES {
            add(&mut sum, &[*(entry.get)(frame)]);
        }
        for list in NAMED_VALUES {
            add(&mut sum, (list.get)(frame));
        }
        for entry in NODAL_FIELDS {
            add(&mut sum, (entry.get)(frame));
        }
        add(&mut sum, frame.position.as_flattened());
        for field in NAMED_FIELDS.iter().flat_map(|list| (list.get)(frame)) {
            add(&mut sum, field);
        }
    }
    let steps = &record.steps;
    for entry in STEP_VALUES {
        add(&mut sum, (entry.get)(steps));
    }
    sum.update(&steps.order);
    for nodes in &steps.nodes {
        sum.update(&nodes.to_le_bytes());
    }
    for count in steps.rejections.iter().flat_map(|counts| CAUSES.iter().map(|cause| *(cause.get)(counts))) {
        sum.update(&count.to_le_bytes());
    }
    sum.finalize()
}

fn add(sum: &mut Hasher, values: &[f64]) {
    // In pieces: a checksum of eight bytes at a time is several times slower.
    let mut bytes = [0; 2048];
    for values in values.chunks(bytes.len() / 8) {
        let (bytes, _) = bytes.split_at_mut(8 * values.len());
        bytes
            .chunks_exact_mut(8)
            .zip(values)
            .for_each(|(bytes, value)| bytes.copy_from_slice(&value.to_le_bytes()));
        sum.update(bytes);
    }
}
