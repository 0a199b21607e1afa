//! Writes checkpoints of this version into a folder, for the fuzz target `checkpoint` to start from.

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = PathBuf::from(env::args_os().nth(1).unwrap_or_else(|| "fuzz/corpus/checkpoint".into()));
    fs::create_dir_all(&folder)?;
    for (k, bytes) in curveflow_tests::hostile::checkpoints().into_iter().enumerate() {
        fs::write(folder.join(format!("run-{k}")), bytes)?;
    }
    Ok(())
}
