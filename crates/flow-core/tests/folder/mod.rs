//! A folder for the files of one test.
#![allow(clippy::unwrap_used, dead_code)] // a failed test may panic; no test needs all of this

use std::fs;
use std::path::{Path, PathBuf};

/// Fresh, and removed at the end of the test, also of one that fails.
pub struct Folder(PathBuf);

impl Folder {
    /// `name` is used once in a test program.
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("curveflow-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn files(&self) -> usize {
        fs::read_dir(&self.0).unwrap().count()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
