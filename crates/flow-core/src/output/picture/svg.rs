//! Writes a drawing as SVG. Text is outlines, so it looks the same without any font.

use std::fmt::Write;

use super::colour_map::Colour;
use super::drawing::{Drawing, Ink, Piece};

/// The SVG document of `drawing`, entitled `title`.
pub(super) fn document(drawing: &Drawing, title: &str, pixels: u32) -> String {
    let (width, height) = (drawing.width, drawing.height);
    let pixel_height = (f64::from(pixels) * height / width).round();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{pixels}\" height=\"{pixel_height}\" \
         viewBox=\"0 0 {width} {height}\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(title)
    );
    for (outline, ink) in &drawing.items {
        let _ = writeln!(text, "<path d=\"{}\" {}/>", path(outline), style(*ink)); // a String never fails
    }
    text.push_str("</svg>\n");
    text
}

fn path(outline: &[Piece]) -> String {
    let mut data = String::new();
    for piece in outline {
        let (letter, points): (char, &[[f64; 2]]) = match piece {
            Piece::Move(p) => ('M', &[*p]),
            Piece::Line(p) => ('L', &[*p]),
            Piece::Quadratic(a, p) => ('Q', &[*a, *p]),
            Piece::Cubic(a, b, p) => ('C', &[*a, *b, *p]),
            Piece::Close => ('Z', &[]),
        };
        data.push(letter);
        for [x, y] in points {
            let separator = if data.ends_with(letter) { "" } else { " " };
            let _ = write!(data, "{separator}{} {}", short(*x), short(*y));
        }
    }
    data
}

/// Hundredths of a pixel are enough.
fn short(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

fn style(ink: Ink) -> String {
    match ink {
        Ink::Fill(colour) => format!("fill=\"{}\"", hex(colour)),
        Ink::Stroke { colour, width, dash } => {
            let dash = dash.map_or(String::new(), |[on, off]| format!(" stroke-dasharray=\"{on} {off}\""));
            format!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"{dash}", hex(colour))
        }
    }
}

fn hex(Colour(r, g, b): Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    // Control characters are not allowed in XML.
    text.chars().filter(|c| !c.is_control()).collect()
}
