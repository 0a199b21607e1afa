//! Collects the problems of one scene and finds the lines that they are on.

use std::cell::RefCell;
use std::ops::Range;
use std::path::Path;

use super::error::{Fault, Place, Problem, SceneError};
use super::message::{NO_VALUE, plain};
use super::overrides::Override;

/// The source of a scene and what is wrong with it.
pub(super) struct Report<'a> {
    name: &'a str,
    text: &'a str,
    overrides: &'a [Override<'a>],
    line_starts: Vec<usize>,
    problems: RefCell<Vec<Problem>>,
}

impl<'a> Report<'a> {
    pub(super) fn new(name: &'a str, text: &'a str, overrides: &'a [Override<'a>]) -> Self {
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { name, text, overrides, line_starts, problems: RefCell::default() }
    }

    /// Folder that paths in the scene start from.
    pub(super) fn folder(&self) -> &Path {
        Path::new(self.name).parent().unwrap_or(Path::new(""))
    }

    pub(super) fn add(&self, key: &str, span: &Range<usize>, fault: Fault) {
        let place = self.place(key, span);
        self.problems.borrow_mut().push(Problem { key: key.to_owned(), place, fault });
    }

    /// Takes back what has turned out to be a consequence of another problem.
    pub(super) fn take_back(&self, is_consequence: impl Fn(&Problem) -> bool) {
        self.problems.borrow_mut().retain(|problem| !is_consequence(problem));
    }

    /// The problems, or `None` if there are none.
    pub(super) fn into_error(self) -> Option<SceneError> {
        let mut problems = self.problems.into_inner();
        // Stable: problems of one line stay in the order in which they were found; overrides come last.
        problems.sort_by_key(|problem| problem.line().unwrap_or(usize::MAX));
        (!problems.is_empty()).then(|| SceneError::Invalid { source_name: self.name.to_owned(), problems })
    }

    pub(super) fn syntax_error(&self, error: &toml::de::Error) -> SceneError {
        let offset = error.span().map_or(0, |span| span.start).min(self.text.len());
        let (number, start) = self.line(offset);
        let column = self.text.get(start..offset).map_or(1, |before| before.chars().count() + 1);
        let place = Place::Line { number, text: self.line_text(number) };
        let (before, after) = self.text.split_at_checked(offset).unwrap_or((self.text, ""));
        let blank = |c| c == ' ' || c == '\t';
        let after = after.trim_start_matches(blank);
        let nothing_follows = after.is_empty() || after.starts_with(['\n', '\r', '#']);
        let message = if nothing_follows && before.trim_end_matches(blank).ends_with('=') {
            NO_VALUE.to_owned()
        } else {
            plain(error.message())
        };
        SceneError::Syntax { source_name: self.name.to_owned(), place, column, message }
    }

    fn place(&self, key: &str, span: &Range<usize>) -> Place {
        let overriding = self.overrides.iter().rev().find(|o| is_within(key, &o.path));
        // An empty span belongs to the document as a whole or to a table that exists only through an override.
        let parent = key.rsplit_once('.').map_or(key, |(parent, _)| parent);
        let created = |o: &&Override<'_>| is_within(&o.path, key) || is_within(&o.path, parent);
        let creating = || self.overrides.iter().filter(|_| span.is_empty()).find(created);
        if let Some(found) = overriding.or_else(creating) {
            return Place::Override { key: found.key.to_owned(), value: found.value.to_owned() };
        }
        if span.is_empty() {
            return Place::Nowhere;
        }
        let (number, _) = self.line(span.start);
        Place::Line { number, text: self.line_text(number) }
    }

    /// Number of the line (from 1) that holds a byte, and where it starts.
    fn line(&self, offset: usize) -> (usize, usize) {
        let number = self.line_starts.partition_point(|&start| start <= offset).max(1);
        (number, self.line_starts[number - 1])
    }

    fn line_text(&self, number: usize) -> String {
        let end = self.line_starts.get(number).copied().unwrap_or(self.text.len());
        plain(&self.text[self.line_starts[number - 1]..end])
    }
}

/// Whether a dotted key is `outer` or lies inside it.
fn is_within(key: &str, outer: &str) -> bool {
    key.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}
