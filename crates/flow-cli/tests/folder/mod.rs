//! A folder in which the command runs.
#![allow(clippy::unwrap_used, dead_code)] // a failed test may panic; no test needs all of this

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use flow_core::output::hdf5_file;
use flow_core::run::Record;

/// A fresh folder, removed at the end of the test.
pub struct Folder(pub PathBuf);

impl Folder {
    /// With the scene `three_fold` as `scene.toml`.
    pub fn new(name: &str) -> Self {
        let folder = Self::empty(name);
        let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/three_fold.toml");
        fs::copy(shipped, folder.0.join("scene.toml")).unwrap();
        folder
    }

    pub fn empty(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("curveflow-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_curveflow"));
        command.args(arguments).current_dir(&self.0).stdin(Stdio::null());
        command
    }

    pub fn call(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// A run to `output` that takes long, and says nothing.
    pub fn long(&self, output: &str) -> Command {
        let large = ["--set", "accuracy.nodes=8192", "--set", "accuracy.tolerance=1e-10"];
        let mut command = self.command(&["run", "scene.toml", "-o", output, "-q"]);
        command.args(large).stderr(Stdio::null());
        command
    }

    /// Runs `command` in the shell, where the program is `"$0"`.
    pub fn shell(&self, command: &str) -> Output {
        let mut shell = Command::new("sh");
        shell.args(["-c", command, env!("CARGO_BIN_EXE_curveflow")]).current_dir(&self.0);
        shell.stdin(Stdio::null()).output().unwrap()
    }

    pub fn record(&self, name: &str) -> Record {
        hdf5_file::read(&self.0.join(name)).unwrap()
    }

    /// Of all files, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

pub fn code(output: &Output) -> i32 {
    output.status.code().unwrap_or(-1)
}

pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub fn wait_for(path: &Path) {
    for _ in 0..1000 {
        if path.exists() {
            return;
        }
        sleep(Duration::from_millis(10));
    }
    panic!("{} does not appear", path.display());
}
