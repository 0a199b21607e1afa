//! The final curve as an SVG element, coloured by its first density, or by its curvature if it has none, before the initial one.

use std::fmt::Write;

use super::super::text::escaped;
use super::FEW_DIGITS;
use super::number::short;
use crate::output::drawn::{range, smooth};
use crate::run::{Frame, Record};

/// Width and height of the picture, in pixels.
const SIZE: f64 = 240.0;
const MARGIN: f64 = 8.0;
/// Fewer sides than this show at this size, and more than that do not.
const LEAST_SIDES: usize = 128;
const MOST_SIDES: usize = 2 * LEAST_SIDES;
/// An odd number: the middle of the range, where constants are, is not between two shades.
const SHADES: usize = 33;
/// Viridis (van der Walt and Smith), as the page has it.
const VIRIDIS: [[u8; 3]; 11] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x24, 0x75],
    [0x41, 0x44, 0x87],
    [0x35, 0x5f, 0x8d],
    [0x2a, 0x78, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x22, 0xa8, 0x84],
    [0x44, 0xbf, 0x70],
    [0x7a, 0xd1, 0x51],
    [0xbd, 0xdf, 0x26],
    [0xfd, 0xe7, 0x25],
];

/// The picture with its bar of colours; nothing if the last frame has no curve that can be drawn.
pub(super) fn picture(record: &Record) -> String {
    let Some(ends) = record.frames.first().zip(record.frames.last()) else { return String::new() };
    let [first, last] = [ends.0, ends.1].map(|frame| smooth(frame, LEAST_SIDES));
    let place = |point: &[f64; 2]| point.iter().all(|x| x.is_finite());
    let points: Vec<[f64; 2]> = first.position.iter().chain(&last.position).copied().filter(place).collect();
    let Some(view) = View::around(&points) else { return String::new() };
    let (name, values) = coloured_by(record, &last);
    let (low, high) = range(values.iter().copied());
    let mut svg = format!(
        "<div><svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{SIZE}\" height=\"{SIZE}\" \
         viewBox=\"0 0 {SIZE} {SIZE}\" role=\"img\" aria-label=\"the final curve\" style=\"display:block\">"
    );
    // A String never fails.
    let _ = write!(
        svg,
        "<path d=\"{}Z\" fill=\"none\" stroke=\"currentColor\" stroke-opacity=\"0.4\" stroke-dasharray=\"4 3\"/>",
        view.path(&thinned(&first.position, &first.position).0)
    );
    svg.push_str("<g fill=\"none\" stroke-width=\"4\" stroke-linecap=\"round\" stroke-linejoin=\"round\">");
    let (points, values) = thinned(&last.position, values);
    for (shade, piece) in pieces(&points, &values, low, high) {
        let _ = write!(svg, "<path d=\"{}\" stroke=\"{}\"/>", view.path(&piece), colour(shade));
    }
    svg.push_str("</g></svg>");
    svg.push_str(&bar(&name, low, high));
    svg.push_str("</div>");
    svg
}

fn coloured_by<'a>(record: &Record, frame: &'a Frame) -> (String, &'a [f64]) {
    match (record.densities.first(), frame.density.first()) {
        (Some(name), Some(density)) => (escaped(name), density),
        _ => ("curvature".to_owned(), &frame.curvature),
    }
}

/// From the plane to the picture.
struct View {
    centre: [f64; 2],
    scale: f64,
}

impl View {
    /// What shows all `points`; none if they have no extent.
    fn around(points: &[[f64; 2]]) -> Option<Self> {
        let range = |k: usize| {
            let values = || points.iter().map(move |point| point[k]);
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((left, right), (bottom, top)) = (range(0), range(1));
        let extent = (right - left).max(top - bottom);
        (extent > 0.0 && extent.is_finite()).then(|| Self {
            centre: [0.5 * (left + right), 0.5 * (bottom + top)],
            scale: (SIZE - 2.0 * MARGIN) / extent,
        })
    }

    /// The path through `points`, broken where one is not finite.
    fn path(&self, points: &[[f64; 2]]) -> String {
        let mut path = String::new();
        let mut command = 'M';
        for point in points {
            let x = 0.5 * SIZE + self.scale * (point[0] - self.centre[0]);
            let y = 0.5 * SIZE - self.scale * (point[1] - self.centre[1]);
            if x.is_finite() && y.is_finite() {
                let _ = write!(path, "{command}{x:.1} {y:.1}");
            }
            command = if x.is_finite() && y.is_finite() { 'L' } else { 'M' };
        }
        path
    }
}

/// At most so many points at even distances, with their values.
fn thinned<T: Copy>(points: &[[f64; 2]], values: &[T]) -> (Vec<[f64; 2]>, Vec<T>) {
    let stride = points.len().div_ceil(MOST_SIDES).max(1);
    points.iter().zip(values).step_by(stride).map(|(point, value)| (*point, *value)).unzip()
}

/// Stretches of the closed curve of one shade each; sides next to a value that is none have the lowest.
fn pieces(points: &[[f64; 2]], values: &[f64], low: f64, high: f64) -> Vec<(usize, Vec<[f64; 2]>)> {
    let mut pieces: Vec<(usize, Vec<[f64; 2]>)> = Vec::new();
    for i in 0..points.len() {
        let next = (i + 1) % points.len();
        let place = (0.5 * (values[i] + values[next]) - low) / (high - low);
        let shade = (place * SHADES as f64).clamp(0.0, (SHADES - 1) as f64) as usize;
        match pieces.last_mut() {
            Some((last, piece)) if *last == shade => piece.push(points[next]),
            _ => pieces.push((shade, vec![points[i], points[next]])),
        }
    }
    pieces
}

fn colour(shade: usize) -> String {
    let place = shade as f64 / (SHADES - 1) as f64 * (VIRIDIS.len() - 1) as f64;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let mixed = |k: usize| {
        let (from, to) = (f64::from(VIRIDIS[below][k]), f64::from(VIRIDIS[below + 1][k]));
        (from + (place - below as f64) * (to - from)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2))
}

fn bar(name: &str, low: f64, high: f64) -> String {
    // As many digits as tell the ends apart.
    let digits = (low.abs().max(high.abs()) / (high - low)).log10().ceil() as i32 + 1;
    let digits = digits.max(FEW_DIGITS);
    let stops: Vec<String> = (0..SHADES).step_by(SHADES / 8).map(colour).collect();
    format!(
        "<div style=\"width:{SIZE}px;height:8px;margin-top:6px;border-radius:4px;\
         background:linear-gradient(to right,{})\"></div>\
         <div style=\"width:{SIZE}px;display:flex;justify-content:space-between;font-size:12px\">\
         <span>{}</span><span style=\"overflow-wrap:anywhere;padding:0 0.5em\">{name}</span><span>{}</span></div>",
        stops.join(","),
        short(low, digits),
        short(high, digits)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_closed_and_cut_where_its_shade_changes() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let cut = pieces(&points, &[0.0, 0.0, 1.0, 1.0], 0.0, 1.0);
        assert_eq!(cut.iter().map(|(shade, _)| *shade).collect::<Vec<_>>(), [0, 16, 32, 16]);
        assert_eq!(cut[3].1, [[0.0, 1.0], [0.0, 0.0]]);
        // A field that does not vary has one shade.
        assert_eq!(pieces(&points, &[2.0; 4], 2.0, 2.0).len(), 1);
    }

    #[test]
    fn ends_of_the_colours_are_those_of_the_map() {
        assert_eq!((colour(0), colour(SHADES - 1)), ("#440154".to_owned(), "#fde725".to_owned()));
    }
}
