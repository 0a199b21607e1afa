//! Result files: what is written is read back, and damage is a typed error.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(feature = "hdf5")]

mod folder;
mod synthetic;

use std::fs;
use std::path::Path;

use flow_core::output::{StorageError, hdf5_file};
use flow_core::run::{Record, Seconds, Spending, StepLog, StopReason};

use folder::Folder;

fn round_trip(record: &Record, path: &Path) {
    hdf5_file::write(record, path, true).unwrap();
    assert!(*record == hdf5_file::read(path).unwrap());
}

#[test]
fn what_is_written_is_read_back() {
    let folder = Folder::new("round-trip");
    let path = folder.file("out.h5");
    round_trip(&synthetic::record(7, 64, &["protein", "a lipid, β"]), &path);
    round_trip(&synthetic::record(3, 1000, &[]), &path);
    let mut failed = synthetic::record(1, 16, &["protein"]);
    failed.stop_reason = StopReason::Failed("κ is not finite at node 3, t = 1.0e-2".to_owned());
    failed.energy_terms.clear();
    failed.frames[0].energy_terms.clear();
    failed.seconds.evaluations.terms.clear();
    failed.steps = StepLog::default();
    failed.frames[0].energy = f64::INFINITY;
    round_trip(&failed, &path);
    failed.frames.clear();
    round_trip(&failed, &path);
    round_trip(&Record { seconds: Seconds::default(), ..synthetic::record(2, 16, &[]) }, &path);
}

/// No scene has such a title; a record that a program has made may.
#[test]
fn what_no_file_can_hold_damages_none() {
    let folder = Folder::new("nul");
    let path = folder.file("out.h5");
    let record = Record { title: "a\0b".to_owned(), ..synthetic::record(2, 16, &[]) };
    hdf5_file::write(&record, &path, true).unwrap();
    assert_eq!(hdf5_file::read(&path).unwrap().title, "a\u{FFFD}b");
}

#[test]
fn terms_from_outside_the_scene_are_named() {
    let folder = Folder::new("own-terms");
    let path = folder.file("out.h5");
    let mut record = synthetic::record(2, 16, &["protein"]);
    record.own_terms = vec!["agents".to_owned()];
    round_trip(&record, &path);
    record.own_terms = vec!["another".to_owned()];
    hdf5_file::write(&record, &path, true).unwrap();
    let error = hdf5_file::read(&path).unwrap_err();
    assert!(
        matches!(&error, StorageError::Damaged { item, .. } if item == "own_terms"),
        "a name that is none of the terms: {error:?}"
    );
}

/// The values of each step are the most of such a file, which holds little besides.
#[test]
fn runs_of_many_steps_and_few_frames_are_read_back() {
    let folder = Folder::new("steps");
    let steps = synthetic::record(20_000, 8, &[]).steps;
    round_trip(&Record { steps, ..synthetic::record(2, 16, &["protein"]) }, &folder.file("out.h5"));
}

#[test]
fn the_file_knows_how_long_it_took_to_make() {
    let folder = Folder::new("timed");
    let path = folder.file("out.h5");
    let mut record = synthetic::record(7, 64, &["protein"]);
    let before = record.seconds[Spending::Output];
    hdf5_file::write_timed(&mut record, &path, false).unwrap();
    let written = hdf5_file::read(&path).unwrap();
    let (made, all) = (written.seconds[Spending::Output], record.seconds[Spending::Output]);
    assert!(before < made && made < all, "{before}, {made}, {all}");
    record.seconds[Spending::Output] = made;
    assert!(record == written);
}

#[test]
fn nothing_is_written_where_nothing_may_be() {
    let folder = Folder::new("refused");
    let record = synthetic::record(2, 16, &[]);
    let path = folder.file("out.h5");
    fs::write(&path, "kept").unwrap();
    assert!(matches!(hdf5_file::write(&record, &path, false), Err(StorageError::Exists { .. })));
    let missing = folder.file("none").join("out.h5");
    assert!(matches!(hdf5_file::write(&record, &missing, false), Err(StorageError::FolderMissing { .. })));
    let mut ragged = record.clone();
    ragged.frames[1].curvature.pop();
    assert!(matches!(hdf5_file::write(&ragged, &path, true), Err(StorageError::Ragged { .. })));
    let mut ragged = record.clone();
    ragged.seconds.evaluations.terms.pop();
    assert!(matches!(hdf5_file::write(&ragged, &path, true), Err(StorageError::Ragged { .. })));
    assert_eq!(fs::read_to_string(&path).unwrap(), "kept");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn foreign_files_are_named() {
    let folder = Folder::new("foreign");
    let path = folder.file("out.h5");
    assert!(matches!(hdf5_file::read(&path), Err(StorageError::System { .. })));
    assert!(matches!(hdf5_file::read(folder.path()), Err(StorageError::NotAFile { .. })));
    for content in ["", "title = \"a scene\""] {
        fs::write(&path, content).unwrap();
        assert!(matches!(hdf5_file::read(&path), Err(StorageError::NotHdf5 { .. })));
    }
    fs::write(&path, include_bytes!("data/foreign.h5")).unwrap(); // empty, made by h5py
    let error = hdf5_file::read(&path).unwrap_err();
    assert!(matches!(error, StorageError::Foreign { found: None, .. }) && error.is_unreadable_file());
}

/// Cut at any length, the file is recognised as damaged.
#[test]
fn truncation_is_an_error() {
    let folder = Folder::new("truncated");
    let path = folder.file("out.h5");
    let bytes = hdf5_file::to_bytes(&synthetic::record(4, 64, &["protein"])).unwrap();
    for length in (8..bytes.len()).step_by(bytes.len() / 40) {
        fs::write(&path, &bytes[..length]).unwrap();
        assert!(matches!(hdf5_file::read(&path), Err(StorageError::Damaged { .. })), "{length} bytes");
    }
}

/// A flipped bit is an error or harmless (unused space), never a wrong number.
#[test]
fn flipped_bits_are_never_read_as_data() {
    let folder = Folder::new("flipped");
    let path = folder.file("out.h5");
    let record = synthetic::record(4, 64, &["protein"]);
    let bytes = hdf5_file::to_bytes(&record).unwrap();
    let mut found = 0;
    let mut silent = Vec::new();
    for i in 0..400_usize {
        let position = (i * 2_654_435_761) % bytes.len();
        let mut damaged = bytes.clone();
        damaged[position] ^= 1 << (i % 8);
        fs::write(&path, &damaged).unwrap();
        match hdf5_file::read(&path) {
            Ok(read) if read != record => silent.push(position),
            Ok(_) => {}
            Err(error) => {
                assert!(error.is_unreadable_file(), "{error}");
                found += 1;
            }
        }
    }
    assert!(silent.is_empty(), "silently wrong after a flip at {silent:?}");
    assert!(found > 100, "only {found} of 400 flips noticed");
}
