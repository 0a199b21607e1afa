//! The seeds of the fuzz targets, and what fuzzing has found, through the same functions.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::fs;
use std::path::{Path, PathBuf};

use curveflow_tests::hostile;
use flow_core::output::checkpoint::decode;

/// Bytes between two that are changed; odd, so that all bytes of a number are met.
const STRIDE: usize = 3;

/// The files of a folder of the repository, each with the name of its path.
fn files(folder: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(path).unwrap())).collect()
}

fn replay(folders: &[&str], target: fn(&[u8])) {
    let files: Vec<_> = folders.iter().flat_map(|folder| files(folder)).collect();
    assert!(!files.is_empty());
    for (path, bytes) in files {
        println!("{}", path.display());
        target(&bytes);
    }
}

#[test]
fn scenes() {
    replay(&["fuzz/seeds/scene", "scenes"], hostile::scene);
}

#[test]
fn overrides() {
    replay(&["fuzz/seeds/overrides"], hostile::overrides);
}

#[test]
fn expressions() {
    replay(&["fuzz/seeds/expression"], hostile::expression);
}

#[test]
fn curve_points() {
    replay(&["fuzz/seeds/curve_points"], hostile::curve_points);
}

/// Checkpoints have no seeds in files, which would be those of an old version soon: they are made here, and changed byte
/// by byte, with checksums that fit.
#[test]
fn checkpoints() {
    for bytes in hostile::checkpoints() {
        let path = Path::new("out.h5.checkpoint-a");
        assert!(decode(&bytes, path).is_ok_and(|checkpoint| checkpoint.simulation(path).is_ok()));
        hostile::checkpoint(&bytes);
        for (place, value) in
            (0..bytes.len()).step_by(STRIDE).zip([0x00, 0x7f, 0x80, 0xff].into_iter().cycle())
        {
            let mut changed = bytes.clone();
            changed[place] = value;
            hostile::checkpoint(&hostile::mended(&changed));
        }
    }
}
