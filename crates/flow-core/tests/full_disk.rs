//! A write that the system cuts short, as on a full disk: an error, and the old file stays.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(unix)]

mod folder;

use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

use flow_core::output::{Operation, StorageError, atomic_file};

use folder::Folder;

/// Names the file to write, in a process that may write small files only.
const TARGET: &str = "CURVEFLOW_TEST_TARGET";

/// Runs itself again under a limit on the size of files; the system then writes a part and refuses the rest.
#[test]
fn a_cut_write_leaves_the_old_file() {
    if let Some(path) = std::env::var_os(TARGET) {
        return write_too_much(Path::new(&path));
    }
    let folder = Folder::new("full-disk");
    let path = folder.file("out.h5");
    atomic_file::write(&path, b"old", false).unwrap();
    let limited = "ulimit -f 64 && trap '' XFSZ && exec \"$0\" --exact a_cut_write_leaves_the_old_file";
    let program = std::env::current_exe().unwrap();
    let child = Command::new("sh").args(["-c", limited]).arg(program).env(TARGET, &path).output().unwrap();
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && said.contains("1 passed"), "{said}");
    assert_eq!((fs::read(&path).unwrap().as_slice(), folder.files()), (b"old".as_slice(), 1));
}

fn write_too_much(path: &Path) {
    atomic_file::write(path, b"old", true).unwrap();
    match atomic_file::write(path, &vec![0; 1 << 20], true) {
        Err(StorageError::System { operation: Operation::Write, reason, .. }) => {
            assert_eq!(reason.kind(), ErrorKind::FileTooLarge);
        }
        other => panic!("{other:?}"),
    }
}
