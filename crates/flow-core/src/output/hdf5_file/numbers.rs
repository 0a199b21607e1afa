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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Quiet, Scene, run};

    #[test]
    fn every_number_of_frames_and_steps_counts() {
        let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "membrane_penalty").unwrap();
        let changes = [("output.fields", "['normal-force']"), ("time.end", "1e-4"), ("output.frames", "1")];
        let changes = changes.map(|(key, value)| (key.to_owned(), value.to_owned()));
        let record = run(&Scene::parse_with(text, "scene", &changes).unwrap(), &mut Quiet).unwrap();
        let whole = checksum(&record);
        let counts = |what: &str, change: &dyn Fn(&mut Record)| {
            let mut changed = record.clone();
            change(&mut changed);
            assert!(changed != record && checksum(&changed) != whole, "{what}");
        };
        for entry in FRAME_VALUES {
            counts(entry.name, &|record| *(entry.slot)(&mut record.frames[1]) += 1.0);
        }
        for list in NAMED_VALUES {
            counts(list.group, &|record| (list.slot)(&mut record.frames[1])[0] += 1.0);
        }
        for entry in NODAL_FIELDS {
            counts(entry.name, &|record| (entry.slot)(&mut record.frames[1])[2] += 1.0);
        }
        for list in NAMED_FIELDS {
            counts(list.group, &|record| (list.slot)(&mut record.frames[1])[0][2] += 1.0);
        }
        counts("position", &|record| record.frames[1].position[2][1] += 1.0);
        for entry in STEP_VALUES {
            counts(entry.name, &|record| (entry.slot)(&mut record.steps)[1] += 1.0);
        }
        counts("order", &|record| record.steps.order[1] += 1);
        counts("nodes", &|record| record.steps.nodes[1] += 1);
        for cause in CAUSES {
            counts(cause.name, &|record| *(cause.slot)(&mut record.steps.rejections[1]) += 1);
        }
    }
}
