//! Seeded mistakes: what the command answers to each, word for word, and with which exit code.
//!
//! Every file of `tests/mistakes` is a transcript. After a few words on what it is about, its sections are
//!
//! - `--- file NAME`: a file with the lines below;
//! - `--- instead of: TEXT`: the last file, with TEXT replaced by the lines below (`\n` in TEXT is a new line);
//! - `--- $ COMMAND`: a command for the shell, and below it what it prints;
//! - `--- exit CODE`: its exit code.
//!
//! `CURVEFLOW_RENEW=1 cargo test -p flow-cli --test mistakes` writes what is printed now into the transcripts: read the
//! difference as somebody would who has made the mistake.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(target_os = "linux")] // the reasons that the system gives are its own words

mod folder;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use folder::Folder;

/// Fewer have been lost.
const LEAST_MISTAKES: usize = 100;

impl Folder {
    /// What `command` prints on both streams, and its exit code.
    fn transcript(&self, command: &str) -> (String, i32) {
        let program = Path::new(env!("CARGO_BIN_EXE_curveflow")).parent().unwrap();
        let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("exec 2>&1\n{command}")]).env("PATH", path).env("LC_ALL", "C");
        let output = shell.current_dir(&self.0).stdin(Stdio::null()).output().unwrap();
        (String::from_utf8(output.stdout).unwrap(), output.status.code().unwrap())
    }
}

/// A transcript with what is printed now.
#[derive(Default)]
struct Replayed {
    text: String,
    exit_codes: Vec<i32>,
}

impl Replayed {
    fn of(text: &str, folder: &Folder) -> Self {
        let mut sections = text.trim_end().split("\n--- ");
        let mut replayed = Self { text: sections.next().unwrap().to_owned(), exit_codes: Vec::new() };
        let mut file = None;
        let mut printed = None;
        for section in sections {
            let (head, body) = section.split_once('\n').unwrap_or((section, ""));
            let mut body = body.to_owned();
            let mut head = head.to_owned();
            if let Some(name) = head.strip_prefix("file ") {
                fs::write(folder.0.join(name), format!("{body}\n")).unwrap();
                file = Some((name.to_owned(), body.clone()));
            } else if let Some(old) = head.strip_prefix("instead of: ") {
                let (name, content) = file.as_ref().expect("a file to be changed");
                let old = old.replace("\\n", "\n");
                assert_eq!(content.matches(&old).count(), 1, "`{old}` must stand once in {name}");
                fs::write(folder.0.join(name), content.replace(&old, &body) + "\n").unwrap();
            } else if let Some(command) = head.strip_prefix("$ ") {
                let (output, code) = folder.transcript(command);
                output.trim_end().clone_into(&mut body);
                printed = Some(code);
            } else if head.starts_with("exit ") {
                let code = printed.take().expect("a command that exits");
                replayed.exit_codes.push(code);
                head = format!("exit {code}");
            } else {
                panic!("no section is called `{head}`");
            }
            replayed.text.push_str("\n--- ");
            replayed.text.push_str(&head);
            if !body.is_empty() {
                replayed.text.push('\n');
                replayed.text.push_str(&body);
            }
        }
        replayed.text.push('\n');
        replayed
    }
}

fn transcripts() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mistakes");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// The first lines that differ.
fn difference(reviewed: &str, now: &str) -> String {
    let (mut reviewed, mut now) = (reviewed.lines(), now.lines());
    loop {
        match (reviewed.next(), now.next()) {
            (None, None) => return "the ends of the files".to_owned(),
            (a, b) if a == b => {}
            (a, b) => {
                return format!("reviewed: {}\n     now: {}", a.unwrap_or("nothing"), b.unwrap_or("nothing"));
            }
        }
    }
}

#[test]
fn every_mistake_is_answered_as_reviewed() {
    let renew = std::env::var_os("CURVEFLOW_RENEW").is_some();
    let (mut failures, mut exit_codes) = (Vec::new(), Vec::new());
    for path in transcripts() {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let replayed = Replayed::of(&text, &Folder::empty(name));
        if replayed.text != text {
            failures.push(format!("{name}\n{}", difference(&text, &replayed.text)));
            if renew {
                fs::write(&path, &replayed.text).unwrap();
            }
        }
        exit_codes.extend(replayed.exit_codes);
    }
    exit_codes.retain(|code| *code != 0);
    assert!(exit_codes.len() >= LEAST_MISTAKES, "only {} mistakes", exit_codes.len());
    let codes: BTreeSet<i32> = exit_codes.into_iter().collect();
    assert_eq!(codes, BTreeSet::from([2, 3, 4, 5, 6, 7]), "each exit code but 70, a bug");
    assert!(failures.is_empty() || renew, "{}", failures.join("\n\n"));
}
