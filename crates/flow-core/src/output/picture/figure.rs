//! The figure: a title and three panels.

use std::path::Path;

use plotters::prelude::DrawingBackend;

use super::curve_panel::CurvePanel;
use super::file::{self, PictureError};
use super::history_panel::HistoryPanel;
use super::page::{Drawn, Page, SIZE};
use super::panel::Rect;
use super::render::Draw;
use super::state_panel::{NodalLines, StatePanel};
use crate::output::drawn::smooth;
use crate::run::{Frame, Record};

/// Points of a curve at least: a side is then shorter than its line is wide.
const POINTS: usize = 512;
/// Between the page's edge and what stands nearest to it; between the labels of neighbouring panels.
const EDGE: f64 = 14.0;
const GAP: f64 = 16.0;
/// Of the frames, below a title; between the upper and the lower one.
const TOP: f64 = 118.0;
const BOTTOM: f64 = 820.0;
const BETWEEN: f64 = 142.0;

/// How a figure is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Width in pixels; the height is 9/16 of it.
    pub width: u32,
    /// Whether an existing file may be replaced.
    pub replace: bool,
    /// The density to draw; the first one, or else the curvature, if none is named.
    pub density: Option<String>,
    /// Nodal lines of the energy, drawn with the final state.
    pub nodal_lines: Option<NodalLines>,
}

impl Default for Options {
    /// 1600 × 900 pixels, replacing nothing.
    fn default() -> Self {
        Self { width: 1600, replace: false, density: None, nodal_lines: None }
    }
}

/// Draws `record` into the file `path`, whose name ends in `.png` or `.svg`.
/// # Errors
/// [`PictureError`]; the target is then as it was.
pub fn plot(record: &Record, path: &Path, options: &Options) -> Result<(), PictureError> {
    let ends = record.frames.first().zip(record.frames.last()).ok_or(PictureError::NoFrames)?;
    let [first, last] = [ends.0, ends.1].map(|frame| smooth(frame, POINTS));
    let density = density(record, options.density.as_deref())?;
    let figure = Figure { record, first, last, density, lines: options.nodal_lines.as_ref() };
    file::write(&figure, path, options.width, options.replace)
}

/// The number of the density to draw; zero if there is none.
fn density(record: &Record, name: Option<&str>) -> Result<usize, PictureError> {
    let Some(name) = name else { return Ok(0) };
    let missing = || PictureError::NoDensity { name: name.to_owned(), densities: record.densities.clone() };
    record.densities.iter().position(|density| density == name).ok_or_else(missing)
}

struct Figure<'a> {
    record: &'a Record,
    first: Frame,
    last: Frame,
    density: usize,
    lines: Option<&'a NodalLines>,
}

impl Draw for Figure<'_> {
    fn draw<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB> {
        let top = TOP - page.title(&self.record.title)?;
        let curve = CurvePanel::new(self.record, self.density, &self.first, &self.last);
        let state = StatePanel::new(self.record, self.density, [&self.first, &self.last], self.lines);
        let history = HistoryPanel::new(self.record);
        // The frames have fixed places, unless labels are so wide that they must give way.
        let left = Rect { left: 112.0, top, right: 782.0, bottom: BOTTOM };
        let left = curve.fitted(page, left, EDGE)?;
        let [energies, lengths] = history.rooms(page)?;
        let beside = left.right + curve.room(page)? + GAP + energies.max(state.room(page)?);
        let upper = Rect {
            left: beside.max(1042.0),
            top,
            right: (SIZE[0] - EDGE - lengths).min(1480.0),
            bottom: 0.5 * (top + BOTTOM - BETWEEN),
        };
        curve.draw(page, left)?;
        state.draw(page, upper)?;
        history.draw(page, Rect { top: upper.bottom + BETWEEN, bottom: BOTTOM, ..upper })
    }
}
