//! One table of a scene while it is read.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::entry::Entry;
use super::error::{Fault, Problem};
use super::report::Report;
use super::suggest::nearest;

/// A table, and which of its keys have been asked for.
pub(super) struct Section<'d> {
    report: &'d Report<'d>,
    path: String,
    span: Range<usize>,
    table: &'d DeTable<'d>,
    known: Vec<&'static str>,
    missing: Vec<(&'static str, &'static str)>,
}

impl<'d> Section<'d> {
    pub(super) fn new(
        report: &'d Report<'d>,
        path: String,
        span: Range<usize>,
        table: &'d DeTable<'d>,
    ) -> Self {
        Self { report, path, span, table, known: Vec::new(), missing: Vec::new() }
    }

    /// The value of a key, if the table has it.
    pub(super) fn get(&mut self, key: &'static str) -> Option<Entry<'d>> {
        self.known.push(key);
        let (name, value) = self.table.get_key_value(key)?;
        // The line of a value is the line of its key, except for tables, whose span is their header.
        let span = if matches!(value.get_ref(), DeValue::Table(_)) { value.span() } else { name.span() };
        Some(Entry::new(self.report, self.path_to(key), span, value.get_ref()))
    }

    /// The value of a key that the table must have; `example` can be copied into the scene.
    pub(super) fn required(&mut self, key: &'static str, example: &'static str) -> Option<Entry<'d>> {
        let entry = self.get(key);
        if entry.is_none() {
            self.missing.push((key, example));
        }
        entry
    }

    /// The table of a key, if there is one.
    pub(super) fn section(&mut self, key: &'static str) -> Option<Section<'d>> {
        self.get(key).and_then(Entry::section)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.table.is_empty()
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// Reports a problem at a key of this table.
    pub(super) fn fault(&self, key: &str, fault: Fault) {
        let span = self.table.get_key_value(key).map_or(self.span.clone(), |(name, _)| name.span());
        self.report.add(&self.path_to(key), &span, fault);
    }

    /// Takes back problems, also of other tables, that are consequences of others.
    pub(super) fn take_back(&self, is_consequence: impl Fn(&Problem) -> bool) {
        self.report.take_back(is_consequence);
    }

    /// Ends the reading: keys that nobody asked for are unknown, keys that must be there are missing.
    pub(super) fn finish(mut self) {
        let table = self.table;
        for (key, _) in table {
            let (name, path) = (key.get_ref().as_ref(), self.path_to(key.get_ref()));
            if self.known.contains(&name) {
                continue;
            }
            let suggestion = nearest(name, self.known.iter().copied());
            // A mistyped key is one problem, not an unknown key and a missing one.
            self.missing.retain(|(missing, _)| suggestion != Some(missing));
            let allowed = self.known.clone();
            self.report.add(&path, &key.span(), Fault::UnknownKey { suggestion, allowed });
        }
        for (key, example) in &self.missing {
            self.fault(key, Fault::MissingKey { example });
        }
    }

    fn path_to(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }
}
