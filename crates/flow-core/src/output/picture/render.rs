//! Renders the page into the bytes of a file.

use plotters::prelude::{BitMapBackend, DrawingBackend, IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::{FontStyle, register_font};

use super::page::{Drawn, FONT, Page, SIZE};

const FONT_FILE: &[u8] = include_bytes!("../../../assets/DejaVuSans-subset.ttf");
/// The page is drawn this much larger than the image: averaged, its lines are smooth.
const OVERSAMPLING: usize = 3;

const AREA: u16 = (OVERSAMPLING * OVERSAMPLING) as u16;

/// Any failure of a back end; those used here write to memory.
pub(super) type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Draws the page on any back end.
pub(super) trait Draw {
    fn draw<DB: DrawingBackend>(&self, page: &Page<DB>) -> Drawn<DB>;
}

fn height(width: u32) -> u32 {
    (f64::from(width) * SIZE[1] / SIZE[0]).round() as u32
}

fn draw_on<DB: DrawingBackend>(backend: DB, scale: f64, text_drop: f64, content: &impl Draw) -> Drawn<DB> {
    // Cannot fail: the file is part of the program, and a test draws with it.
    let _ = register_font(FONT, FontStyle::Normal, FONT_FILE);
    let page = Page { root: backend.into_drawing_area(), scale, text_drop };
    page.root.fill(&WHITE)?;
    content.draw(&page)?;
    page.root.present()
}

/// The PNG, `width` pixels wide.
pub(super) fn png(width: u32, content: &impl Draw) -> Result<Vec<u8>, Failure> {
    let height = height(width);
    let (columns, rows) = (width as usize * OVERSAMPLING, height as usize * OVERSAMPLING);
    let mut large = vec![0; 3 * columns * rows];
    let backend = BitMapBackend::with_buffer(&mut large, (columns as u32, rows as u32));
    draw_on(backend, columns as f64 / SIZE[0], 0.25, content)?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&averaged(&large, columns))?;
    writer.finish()?;
    Ok(bytes)
}

/// The image of `columns` pixels per row, each square of pixels averaged into one.
fn averaged(large: &[u8], columns: usize) -> Vec<u8> {
    let row = 3 * columns;
    let mut image = Vec::with_capacity(large.len() / OVERSAMPLING.pow(2));
    let mut sums = vec![0_u16; row];
    for rows in large.chunks_exact(row * OVERSAMPLING) {
        sums.fill(0);
        for row in rows.chunks_exact(row) {
            sums.iter_mut().zip(row).for_each(|(sum, &value)| *sum += u16::from(value));
        }
        for square in sums.chunks_exact(3 * OVERSAMPLING) {
            let mean = |channel: usize| square[channel..].iter().step_by(3).sum::<u16>() / AREA;
            image.extend([0, 1, 2].map(|channel| mean(channel) as u8));
        }
    }
    image
}

/// The SVG document, `width` pixels wide.
pub(super) fn svg(width: u32, content: &impl Draw) -> Result<String, Failure> {
    // The back end knows whole pixels only, so the drawing is larger than the image.
    const SCALE: u32 = 4;
    let drawn = SIZE.map(|length| length as u32 * SCALE);
    let mut document = String::new();
    draw_on(SVGBackend::with_string(&mut document, drawn.into()), f64::from(SCALE), 0.08, content)?;
    let size = |width: u32, height: u32| format!("width=\"{width}\" height=\"{height}\"");
    Ok(document.replacen(&size(drawn[0], drawn[1]), &size(width, height(width)), 1))
}
