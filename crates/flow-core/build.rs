//! Tells the crate which commit it is built from, for the attributes of result files.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-env-changed=CURVEFLOW_COMMIT");
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var_os("CURVEFLOW_COMMIT").is_some() {
        return; // set by a packager; `option_env!` sees it as it is
    }
    // Only the repository of this workspace counts, not one that happens to hold an unpacked release.
    if Path::new("../../.git").exists() {
        if Path::new("../../.git/logs/HEAD").exists() {
            println!("cargo::rerun-if-changed=../../.git/logs/HEAD");
        }
        if let Some(commit) = commit() {
            println!("cargo::rustc-env=CURVEFLOW_COMMIT={commit}");
        }
    }
}

/// Full name of the current commit, with `-dirty` if files differ from it; none without git.
fn commit() -> Option<String> {
    let output = Command::new("git")
        .args(["describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"])
        .output()
        .ok()?;
    let name = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| name.trim().to_owned())
}
