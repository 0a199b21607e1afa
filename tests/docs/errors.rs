//! `docs/errors.md` knows every kind of error and every exit code.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn page() -> String {
    fs::read_to_string(root().join("docs/errors.md")).unwrap()
}

/// All Rust files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let inner = folders.iter().flat_map(|folder| sources(folder));
    let files = files.into_iter().filter(|path| path.extension().is_some_and(|extension| extension == "rs"));
    inner.chain(files).collect()
}

/// Name and variants of each public enum whose name says that it tells what is wrong.
fn errors(source: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    let mut inside = false;
    for line in source.lines() {
        let word = |text: &str| text.chars().take_while(|c| c.is_alphanumeric()).collect::<String>();
        if let Some(rest) = line.strip_prefix("pub enum ") {
            let name = word(rest);
            inside = ["Error", "Fault", "Rejection"].iter().any(|end| name.ends_with(end));
            if inside {
                found.push((name, Vec::new()));
            }
        } else if line == "}" {
            inside = false;
        } else if let Some(rest) = line.strip_prefix("    ").filter(|_| inside)
            && rest.starts_with(|c: char| c.is_ascii_uppercase())
            && let Some((_, variants)) = found.last_mut()
        {
            variants.push(word(rest));
        }
    }
    found
}

#[test]
fn every_kind_of_error_is_on_the_page() {
    let page = page();
    let sections: Vec<&str> = page.split("\n## ").collect();
    let mut count = 0;
    for path in ["flow-core", "flow-cli", "hdf5-image"]
        .iter()
        .flat_map(|name| sources(&root().join("crates").join(name)))
    {
        for (name, variants) in errors(&fs::read_to_string(&path).unwrap()) {
            let heading = format!("`{name}`");
            let section = sections
                .iter()
                .find(|section| section.lines().next().is_some_and(|line| line.contains(&heading)));
            let section = section.unwrap_or_else(|| panic!("no section on {name} of {}", path.display()));
            for variant in variants {
                assert!(section.contains(&format!("\n| `{variant}`")), "no line on {name}::{variant}");
                count += 1;
            }
        }
    }
    assert!(count > 120, "only {count} variants were found");
}

#[test]
fn every_exit_code_is_on_the_page() {
    let main = fs::read_to_string(root().join("crates/flow-cli/src/lib.rs")).unwrap();
    let map = &main[main.find("fn exit_code").unwrap()..];
    let map = &map[..map.find("\n}").unwrap()];
    let codes: Vec<u8> = map
        .lines()
        .filter_map(|line| {
            line.rsplit_once("=> ").and_then(|(_, code)| code.trim_end_matches(',').parse().ok())
        })
        .chain([0, 2, 70])
        .collect();
    assert!(codes.len() >= 8, "{codes:?}");
    let page = page();
    for code in codes {
        assert!(page.contains(&format!("\n| {code} |")), "no line on exit code {code}");
    }
}
