//! Figures: both formats are written, and odd records neither panic nor draw outside the page.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(feature = "picture")]

mod synthetic;

use std::fs;
use std::path::PathBuf;

use flow_core::output::picture::{NodalLines, Options, PictureError, plot};
use flow_core::run::{Record, StepLog};

/// Draws `record` as SVG and PNG; returns the SVG. The files stay if `CURVEFLOW_KEEP_FIGURES` names a folder.
fn draw(record: &Record, name: &str) -> String {
    let keep = std::env::var_os("CURVEFLOW_KEEP_FIGURES").map(PathBuf::from);
    let folder = keep.clone().unwrap_or_else(std::env::temp_dir);
    let rho = (0..=100).map(|i| 0.01 * f64::from(i));
    let kappa = (0..=200).map(|i| -4.0 + 0.04 * f64::from(i));
    let bump =
        |base: f64, size: f64, centre: f64, kappa: f64| base + size * (-(kappa - centre).powi(2)).exp();
    let nodal_lines = Some(NodalLines {
        preferred_curvature: rho.map(|rho| (rho, 1.3 - 2.63 * (rho - 0.19))).collect(),
        low: kappa.clone().map(|kappa| (bump(0.05, 0.16, 1.0, kappa), kappa)).collect(),
        high: kappa.map(|kappa| (bump(0.8, 0.18, -0.3, kappa), kappa)).collect(),
    });
    let options = Options { replace: true, nodal_lines, ..Options::default() };
    let path = |extension: &str| folder.join(format!("curveflow-{name}-{}.{extension}", std::process::id()));
    let start = std::time::Instant::now();
    plot(record, &path("png"), &options).unwrap();
    println!("{name}: PNG in {:?}", start.elapsed());
    plot(record, &path("svg"), &options).unwrap();
    let (png, svg) = (fs::read(path("png")).unwrap(), fs::read_to_string(path("svg")).unwrap());
    if keep.is_none() {
        fs::remove_file(path("png")).unwrap();
        fs::remove_file(path("svg")).unwrap();
    }
    assert!(png.starts_with(b"\x89PNG"));
    svg
}

/// All points of the lines, circles and anchors of text of an SVG document lie on the page.
fn assert_inside(svg: &str) {
    let attributes = |name: &str| {
        let start = format!(" {name}=\"");
        let values = svg.split(&start).skip(1).map(|part| part.split('"').next().unwrap());
        values.map(str::to_owned).collect::<Vec<_>>()
    };
    let view = attributes("viewBox")[0].split(' ').map(|n| n.parse().unwrap()).collect::<Vec<f64>>();
    let assert_at = |value: &str, size: f64| {
        let value: f64 = value.parse().unwrap();
        assert!((0.0..=size).contains(&value), "{value} of {size}");
    };
    for points in attributes("points") {
        for point in points.split_whitespace() {
            let (x, y) = point.split_once(',').unwrap();
            assert_at(x, view[2]);
            assert_at(y, view[3]);
        }
    }
    for (names, size) in [(["x", "cx"], view[2]), (["y", "cy"], view[3])] {
        names.iter().flat_map(|name| attributes(name)).for_each(|value| assert_at(&value, size));
    }
    assert!(attributes("font-family").iter().all(|font| font == "DejaVu Sans, sans-serif"));
}

#[test]
fn figures_stay_on_the_page() {
    let svg = draw(&synthetic::record(200, 512, &["protein"]), "density");
    assert_inside(&svg);
    assert!(["protein density ρ", "10⁻⁴", "κ₀(ρ)"].iter().all(|text| svg.contains(text)));
    assert_inside(&draw(&synthetic::record(200, 512, &[]), "curvature"));
}

#[test]
fn odd_records_are_drawn() {
    let mut record = synthetic::record(1, 64, &["a component with a rather long name"]);
    record.title = "A very long title, longer than any page is wide, ".repeat(4);
    record.steps = StepLog::default();
    draw(&record, "one-frame");
    let mut record = synthetic::record(5, 64, &["protein"]);
    record.frames[4].energy = f64::NAN;
    record.frames[4].density[0].fill(0.5);
    record.frames[4].position[3] = [f64::NAN, 0.0];
    record.frames.iter_mut().for_each(|frame| frame.length *= 1e-7);
    assert_inside(&draw(&record, "odd"));
}

#[test]
fn a_figure_needs_a_state_and_a_known_format() {
    let mut record = synthetic::record(1, 16, &[]);
    let nowhere = std::env::temp_dir().join("curveflow.pdf");
    assert!(matches!(plot(&record, &nowhere, &Options::default()), Err(PictureError::Format { .. })));
    let path = nowhere.with_extension("png");
    for width in [0, u32::MAX] {
        let options = Options { width, ..Options::default() };
        assert!(matches!(plot(&record, &path, &options), Err(PictureError::Size { .. })));
    }
    record.frames.clear();
    assert!(matches!(plot(&record, &path, &Options::default()), Err(PictureError::NoFrames)));
}
