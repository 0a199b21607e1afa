//! Data flows one way: a module imports from its own layer or an earlier one.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::fs;
use std::path::{Path, PathBuf};

/// The layers, lowest first.
const LAYERS: [&str; 8] =
    ["expression", "geometry", "operators", "energies", "flow", "integrator", "run", "output"];

/// Layers below its own that the integrator does without: it sees a right-hand side, a Jacobian and `&[f64]`.
const UNKNOWN_TO_THE_INTEGRATOR: [&str; 3] = ["operators", "energies", "flow"];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let own = files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "rs"));
    own.chain(folders.iter().flat_map(|folder| sources(folder))).collect()
}

/// The layers that the file `path` names, with the lines that name them.
fn named(path: &Path) -> Vec<(&'static str, String)> {
    let text = fs::read_to_string(path).unwrap();
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let layers_of = |line: &str| {
        let rest = line.split("crate::").skip(1);
        let is_of = |rest: &str, layer: &str| {
            rest.strip_prefix(layer)
                .is_some_and(|end| !end.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
        };
        rest.filter_map(|rest| LAYERS.into_iter().find(|layer| is_of(rest, layer))).collect::<Vec<_>>()
    };
    code.flat_map(|line| layers_of(line).into_iter().map(|layer| (layer, line.to_owned()))).collect()
}

#[test]
fn imports_go_down() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut imports = 0;
    for (height, layer) in LAYERS.into_iter().enumerate() {
        for path in sources(&root.join(layer)) {
            for (other, line) in named(&path) {
                let below = LAYERS.iter().position(|known| *known == other).unwrap() <= height;
                let is_known = layer != "integrator" || !UNKNOWN_TO_THE_INTEGRATOR.contains(&other);
                assert!(below && is_known, "{}: {layer} imports from {other}: {line}", path.display());
                imports += 1;
            }
        }
    }
    assert!(imports > 300, "{imports} imports seen: the test no longer reads them");
}

#[test]
fn every_module_has_its_layer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let folders = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir());
    for folder in folders {
        let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
        assert!(LAYERS.contains(&name.as_str()), "`{name}` is no layer");
    }
}
