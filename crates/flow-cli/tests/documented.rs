//! The documentation names only commands, options, keys of a scene and targets of cargo that exist.
#![allow(clippy::unwrap_used)] // a failed test may panic

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

const PAGES: [&str; 4] = ["README.md", "CONTRIBUTING.md", "THEORY.md", "docs"];
/// Fewer have been lost.
const LEAST: [(&str, usize); 4] = [("command", 30), ("option", 40), ("key", 20), ("target", 8)];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pages() -> Vec<PathBuf> {
    let (folders, mut pages): (Vec<_>, Vec<_>) =
        PAGES.iter().map(|page| root().join(page)).partition(|path| path.is_dir());
    for folder in folders {
        pages.extend(fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    }
    pages.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    pages.sort();
    pages
}

/// The code of a page: lines of its blocks but those of Python and Rust, and what stands between backticks.
fn code(text: &str) -> Vec<String> {
    let mut code = Vec::new();
    let mut prose = String::new();
    let mut block: Option<&str> = None;
    for line in text.lines() {
        match (line.trim_start().strip_prefix("```"), block) {
            (Some(language), None) => block = Some(language),
            (Some(_), Some(_)) => block = None,
            (None, Some("sh" | "text" | "")) => code.push(line.split(" #").next().unwrap().to_owned()),
            (None, Some(_)) => {}
            (None, None) => {
                prose.push_str(line);
                prose.push(' ');
            }
        }
    }
    code.extend(prose.split('`').skip(1).step_by(2).map(str::to_owned));
    code
}

fn curveflow(arguments: &[&str]) -> Option<String> {
    let output = Command::new(env!("CARGO_BIN_EXE_curveflow")).args(arguments).output().unwrap();
    output.status.success().then(|| String::from_utf8(output.stdout).unwrap())
}

/// What is wrong on the pages, and how many things of each kind were looked at.
struct Review {
    schema: Value,
    helps: BTreeMap<String, String>,
    manifests: String,
    seen: BTreeMap<&'static str, usize>,
    faults: Vec<String>,
}

impl Review {
    fn new() -> Self {
        let schema = serde_json::from_str(&curveflow(&["schema"]).unwrap()).unwrap();
        let manifests =
            ["benches", "crates/flow-core", "crates/flow-cli", "crates/flow-py", "examples", "tests"];
        let manifest = |folder: &&str| fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
        let manifests = manifests.iter().map(manifest).collect();
        Self { schema, helps: BTreeMap::new(), manifests, seen: BTreeMap::new(), faults: Vec::new() }
    }

    fn check(&mut self, kind: &'static str, is_there: bool, what: &str) {
        *self.seen.entry(kind).or_default() += 1;
        if !is_there {
            self.faults.push(format!("{kind} {what}"));
        }
    }

    fn help(&mut self, command: &str) -> Option<&str> {
        if !self.helps.contains_key(command) {
            self.helps.insert(command.to_owned(), curveflow(&[command, "--help"])?);
        }
        self.helps.get(command).map(String::as_str)
    }

    fn read(&mut self, code: &str) {
        // Of several commands in a line each is one of its own.
        for part in code.split(['|', ';', '&', '>']) {
            let words: Vec<&str> = part.split_whitespace().collect();
            match words.as_slice() {
                ["curveflow", command, rest @ ..] => self.command(command, rest, code),
                words if words.contains(&"cargo") => self.cargo(words, code),
                [option, ..] if option.starts_with("--") => {
                    self.lone_option(option.trim_end_matches(','), words.get(1), code);
                }
                [key] | [key, "=", ..] => self.key(key.split('=').next().unwrap()),
                _ => {}
            }
        }
    }

    fn command(&mut self, command: &str, rest: &[&str], code: &str) {
        if command == "help" || command.starts_with(|first: char| !first.is_ascii_lowercase()) {
            return; // `curveflow …`
        }
        let help = self.help(command).map(str::to_owned);
        self.check("command", help.is_some(), code);
        let Some(help) = help else { return };
        for word in rest {
            let option = word.trim_matches(|c: char| !c.is_ascii_alphanumeric() && c != '-');
            if option.starts_with('-') && option.len() > 1 {
                let known = help.split_whitespace().any(|known| known.trim_end_matches(',') == option);
                self.check("option", known, &format!("{option} in: {code}"));
            } else if let Some((key, _)) = word.split_once('=').filter(|(key, _)| *key != "key") {
                self.key(key);
            }
        }
    }

    /// An option without its command is one of any command, or of `cargo test`.
    fn lone_option(&mut self, option: &str, value: Option<&&str>, code: &str) {
        if let ("--test" | "--bin", Some(_)) = (option, value) {
            let words: Vec<&str> = code.split_whitespace().collect();
            return self.cargo(&words, code);
        }
        let commands = ["run", "resume", "check", "info", "plot", "tradeoff", "view", "scenes", "schema"];
        let known = commands.iter().any(|command| {
            self.help(command).is_some_and(|help| help.split_whitespace().any(|known| known == option))
        });
        self.check("option", known, code);
    }

    fn cargo(&mut self, rest: &[&str], code: &str) {
        for pair in rest.windows(2) {
            if let ["--bin" | "--test" | "-p" | "--package" | "--example", name] = pair {
                let file = |folder: &str| root().join(folder).join(format!("{name}.rs")).exists();
                let named = self.manifests.contains(&format!("name = \"{name}\""))
                    || ["crates/flow-core/tests", "crates/flow-cli/tests", "benches/src/bin"]
                        .into_iter()
                        .any(file);
                self.check("target", named, code);
            }
        }
    }

    /// A word with dots whose first part is a table of the scene.
    fn key(&mut self, word: &str) {
        let path: Vec<&str> = word.trim_matches(['[', ']']).split('.').collect();
        let is_name =
            |part: &&str| part.chars().all(|c| c.is_ascii_lowercase() || c == '_') && !part.is_empty();
        let is_table = |first: &str| self.schema["properties"].get(first).is_some();
        let is_file = path.last().is_some_and(|last| ["rs", "md", "toml", "h", "py"].contains(last));
        if path.len() > 1 && path.iter().all(is_name) && is_table(path[0]) && !is_file {
            let known = has_key(&self.schema, &self.schema, &path);
            self.check("key", known, word);
        }
    }
}

/// Whether `schema`, a part of `root`, allows for what `path` names.
fn has_key(schema: &Value, root: &Value, path: &[&str]) -> bool {
    let Some((first, rest)) = path.split_first() else { return true };
    if let Some(reference) = schema["$ref"].as_str() {
        return root.pointer(&reference[1..]).is_some_and(|schema| has_key(schema, root, path));
    }
    let alternatives =
        ["oneOf", "anyOf", "allOf"].iter().filter_map(|name| schema[*name].as_array()).flatten();
    schema["properties"].get(*first).is_some_and(|schema| has_key(schema, root, rest))
        || alternatives.chain(schema.get("items")).any(|schema| has_key(schema, root, path))
}

#[test]
fn what_the_documentation_names_is_there() {
    let mut review = Review::new();
    for page in pages() {
        let before = review.faults.len();
        for code in code(&fs::read_to_string(&page).unwrap()) {
            review.read(&code);
        }
        for fault in &mut review.faults[before..] {
            *fault = format!("{}: {fault}", page.display());
        }
    }
    println!("{:?}", review.seen);
    assert!(review.faults.is_empty(), "not there:\n{}", review.faults.join("\n"));
    for (kind, least) in LEAST {
        let seen = review.seen.get(kind).copied().unwrap_or_default();
        assert!(seen >= least, "only {seen} of kind {kind}");
    }
}
