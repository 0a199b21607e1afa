//! Paints a drawing and encodes it as PNG.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

use super::colour_map::Colour;
use super::drawing::{Drawing, Ink, Piece, Point};

/// The PNG of `drawing`, `pixels` wide; none if the size is 0 or too large for memory.
pub(super) fn png(drawing: &Drawing, pixels: u32) -> Option<Vec<u8>> {
    let scale = f64::from(pixels) / drawing.width;
    let mut page = Pixmap::new(pixels, (drawing.height * scale).round() as u32)?;
    page.fill(Color::WHITE);
    let transform = Transform::from_scale(scale as f32, scale as f32);
    for (outline, ink) in &drawing.items {
        // An empty outline, a blank for instance, has no path.
        let Some(path) = path(outline) else { continue };
        match *ink {
            Ink::Fill(colour) => page.fill_path(&path, &paint(colour), FillRule::Winding, transform, None),
            Ink::Stroke { colour, width, dash } => {
                let stroke = Stroke {
                    width: width as f32,
                    line_cap: LineCap::Round,
                    line_join: LineJoin::Round,
                    dash: dash.and_then(|dash| StrokeDash::new(dash.map(|d| d as f32).to_vec(), 0.0)),
                    ..Stroke::default()
                };
                page.stroke_path(&path, &paint(colour), &stroke, transform, None);
            }
        }
    }
    page.encode_png().ok()
}

fn path(outline: &[Piece]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let single = |[x, y]: Point| (x as f32, y as f32);
    for piece in outline {
        match *piece {
            Piece::Move(p) => {
                let (x, y) = single(p);
                builder.move_to(x, y);
            }
            Piece::Line(p) => {
                let (x, y) = single(p);
                builder.line_to(x, y);
            }
            Piece::Quadratic(a, p) => {
                let ((ax, ay), (x, y)) = (single(a), single(p));
                builder.quad_to(ax, ay, x, y);
            }
            Piece::Cubic(a, b, p) => {
                let ((ax, ay), (bx, by), (x, y)) = (single(a), single(b), single(p));
                builder.cubic_to(ax, ay, bx, by, x, y);
            }
            Piece::Close => builder.close(),
        }
    }
    builder.finish()
}

fn paint(Colour(r, g, b): Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, 255);
    paint
}
