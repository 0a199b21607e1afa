//! A write that the system cuts short, as on a full disk: an error, and the old file stays.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(unix)]

use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;

use flow_core::output::{Operation, StorageError, atomic_file};

/// Names the file to write, in a process that may write small files only.
const TARGET: &str = "CURVEFLOW_TEST_TARGET";

/// Runs itself again under a limit on the size of files; the system then writes a part and refuses the rest.
#[test]
fn a_cut_write_leaves_the_old_file() {
    if let Some(path) = std::env::var_os(TARGET) {
        return write_too_much(Path::new(&path));
    }
    let folder = std::env::temp_dir().join(format!("curveflow-full-disk-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("out.h5");
    atomic_file::write(&path, b"old", false).unwrap();
    let limited = "ulimit -f 64 && trap '' XFSZ && exec \"$0\" --exact a_cut_write_leaves_the_old_file";
    let program = std::env::current_exe().unwrap();
    let child = Command::new("sh").args(["-c", limited]).arg(program).env(TARGET, &path).output().unwrap();
    let (content, files) = (fs::read(&path).unwrap(), fs::read_dir(&folder).unwrap().count());
    fs::remove_dir_all(&folder).unwrap();
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && said.contains("1 passed"), "{said}");
    assert_eq!((content.as_slice(), files), (b"old".as_slice(), 1));
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
