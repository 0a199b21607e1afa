//! Result files that were damaged by chance, thousands of them, or made to hurt: each is refused by a typed error, or gives
//! what was written.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(feature = "hdf5")]

mod folder;
mod synthetic;

use std::fs;
use std::path::Path;

use flow_core::output::{StorageError, hdf5_file};
use flow_core::run::Record;
use hdf5_metno::{Extent, File};

use folder::Folder;

/// Damages of each kind, unless the variable of this name asks for more, or for others.
const TRIALS: u64 = 600;
const TRIALS_NAME: &str = "CURVEFLOW_TRIALS";
/// Longest piece that is lost, in bytes: that of a page of a disk.
const PAGE: usize = 4096;

/// A file of its own, removed at the end of the test.
/// Numbers without a pattern, the same in each run: `SplitMix64`.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() % bound as u64).unwrap()
    }

    /// A piece of `length` bytes or less of `bytes`.
    fn piece<'a>(&mut self, bytes: &'a mut [u8], length: usize) -> &'a mut [u8] {
        let start = self.below(bytes.len());
        let length = 1 + self.below(length.min(bytes.len() - start));
        &mut bytes[start..start + length]
    }
}

type Damage = fn(&mut Vec<u8>, &mut Chance);

/// What disks, copies and editors do to files.
const DAMAGES: [(&str, Damage); 8] = [
    ("a bit flipped", |bytes, chance| {
        let place = chance.below(bytes.len());
        bytes[place] ^= 1 << chance.below(8);
    }),
    ("a byte changed", |bytes, chance| {
        let place = chance.below(bytes.len());
        bytes[place] = chance.below(256) as u8;
    }),
    ("a few bits flipped", |bytes, chance| {
        for _ in 0..2 + chance.below(15) {
            let place = chance.below(bytes.len());
            bytes[place] ^= 1 << chance.below(8);
        }
    }),
    ("cut", |bytes, chance| bytes.truncate(chance.below(bytes.len()))),
    ("junk appended", |bytes, chance| {
        for _ in 0..=chance.below(PAGE) {
            bytes.push(chance.below(256) as u8);
        }
    }),
    ("a piece zeroed", |bytes, chance| chance.piece(bytes, PAGE).fill(0)),
    ("a piece of junk", |bytes, chance| {
        let junk = chance.next().to_le_bytes();
        let piece = chance.piece(bytes, PAGE);
        piece.iter_mut().zip(junk.iter().cycle()).for_each(|(byte, junk)| *byte = *junk);
    }),
    ("a piece lost", |bytes, chance| {
        let start = chance.below(bytes.len());
        let end = (start + 1 + chance.below(PAGE)).min(bytes.len());
        bytes.drain(start..end);
    }),
];

/// Reads what should be `record`: true if it was refused, false if it is still all there.
fn refused(path: &Path, record: &Record, damage: &str) -> bool {
    match hdf5_file::read(path) {
        Ok(read) => {
            assert!(read == *record, "{damage}: read as data");
            false
        }
        Err(error) => {
            assert!(error.is_unreadable_file(), "{damage}: {error}");
            assert!(error.to_string().starts_with(&path.display().to_string()));
            true
        }
    }
}

#[test]
fn chance_never_makes_wrong_data() {
    let folder = Folder::new("damaged");
    let path = folder.file("damaged.h5");
    let record = synthetic::record(4, 64, &["protein"]);
    let whole = hdf5_file::to_bytes(&record).unwrap();
    let trials = std::env::var(TRIALS_NAME).map_or(TRIALS, |trials| trials.parse().unwrap());
    let mut chance = Chance(20_261_124 + trials);
    for (damage, apply) in DAMAGES {
        let mut count = 0;
        for _ in 0..trials {
            let mut bytes = whole.clone();
            apply(&mut bytes, &mut chance);
            fs::write(&path, &bytes).unwrap();
            count += u64::from(refused(&path, &record, damage));
        }
        println!("{damage}: {count} of {trials} refused, the others whole");
        if damage == "junk appended" {
            assert_eq!(count, 0, "what stands behind the file is not of it");
        } else {
            assert!(count > trials / 4, "{damage}: only {count} of {trials} noticed");
        }
    }
}

/// Fletcher32 finds nothing wrong with zeros.
#[test]
fn numbers_that_became_zero_are_noticed() {
    let folder = Folder::new("zeroed");
    let path = folder.file("damaged.h5");
    let record = synthetic::record(4, 64, &["protein"]);
    let mut bytes = hdf5_file::to_bytes(&record).unwrap();
    let numbers = record.frames.iter().flat_map(|frame| &frame.metric);
    let chunk: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
    let start = bytes.windows(chunk.len()).position(|window| window == chunk).unwrap();
    bytes[start..start + chunk.len() + 4].fill(0);
    fs::write(&path, &bytes).unwrap();
    let error = hdf5_file::read(&path).unwrap_err();
    assert!(error.to_string().contains("damaged at its numbers"), "{error}");
}

/// The error of a whole file that `change` has changed.
fn hostile(name: &str, change: impl FnOnce(&File)) -> (String, String) {
    let folder = Folder::new(name);
    let path = folder.file("damaged.h5");
    hdf5_file::write(&synthetic::record(4, 64, &["protein"]), &path, true).unwrap();
    let file = File::open_rw(&path).unwrap();
    change(&file);
    file.close().unwrap();
    match hdf5_file::read(&path).unwrap_err() {
        StorageError::Damaged { item, source, .. } => (item, source.to_string()),
        other => panic!("{other}"),
    }
}

/// A few bytes in the file, terabytes in the reader.
#[test]
fn claims_of_much_data_are_refused_before_it_is_asked_for() {
    let (item, reason) = hostile("shape", |file| {
        file.unlink("energy").unwrap();
        file.new_dataset::<f64>().shape(1_usize << 40).chunk(64).fletcher32().create("energy").unwrap();
    });
    assert!(item == "/energy" && reason.contains("more than the file holds"), "{item}: {reason}");
    let (item, reason) = hostile("chunk", |file| {
        file.unlink("energy").unwrap();
        let shape = Extent::resizable(4);
        file.new_dataset::<f64>().shape(shape).chunk(1 << 28).fletcher32().create("energy").unwrap();
    });
    assert!(item == "/energy" && reason.contains("its chunks are of"), "{item}: {reason}");
    // The first dataset that is read tells the number of frames.
    let (item, reason) = hostile("frames", |file| {
        file.unlink("time").unwrap();
        file.new_dataset::<f64>().shape(1_usize << 50).chunk(64).fletcher32().create("time").unwrap();
    });
    assert!(item == "/time" && reason.contains("more than the file holds"), "{item}: {reason}");
}

#[test]
fn data_without_a_checksum_or_from_elsewhere_is_refused() {
    let (item, reason) = hostile("plain", |file| {
        file.unlink("energy").unwrap();
        file.new_dataset_builder().with_data(&[1.0, 2.0, 3.0, 4.0]).create("energy").unwrap();
    });
    assert!(item == "/energy" && reason.contains("its filters are []"), "{item}: {reason}");
    let (item, reason) = hostile("filters", |file| {
        file.unlink("energy").unwrap();
        file.new_dataset::<f64>().shape(4).chunk(4).shuffle().fletcher32().create("energy").unwrap();
    });
    assert!(item == "/energy" && reason.contains("Shuffle"), "{item}: {reason}");
    let (item, reason) = hostile("outside", |file| {
        file.unlink("energy").unwrap();
        file.link_external("/dev/zero", "/energy", "energy").unwrap();
    });
    assert!(item == "the group /" && reason.contains("\"energy\""), "{item}: {reason}");
    let (item, reason) = hostile("soft", |file| {
        let group = file.group("density").unwrap();
        group.unlink("protein").unwrap();
        group.link_soft("/curvature", "protein").unwrap();
    });
    assert!(item == "the group density" && reason.contains("\"protein\""), "{item}: {reason}");
}
