//! Figures: both formats are written, and odd records neither panic nor draw outside the page.
#![allow(clippy::unwrap_used)] // a failed test may panic
#![cfg(feature = "picture")]

mod drawn;
mod folder;
mod synthetic;

use std::fs;
use std::path::PathBuf;

use flow_core::output::picture::{NodalLines, Options, PictureError, check_name, plot};
use flow_core::run::{Record, StepLog};

use drawn::assert_inside;
use folder::Folder;

/// Draws `record` as SVG and PNG; returns the SVG. The files stay if `CURVEFLOW_KEEP_FIGURES` names a folder.
fn draw(record: &Record, name: &str) -> String {
    let keep = std::env::var_os("CURVEFLOW_KEEP_FIGURES").map(PathBuf::from);
    let own = Folder::new(name);
    let folder = keep.as_deref().unwrap_or(own.path());
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
    let path = |extension: &str| folder.join(format!("{name}.{extension}"));
    let start = std::time::Instant::now();
    plot(record, &path("png"), &options).unwrap();
    println!("{name}: PNG in {:?}", start.elapsed());
    plot(record, &path("svg"), &options).unwrap();
    let (png, svg) = (fs::read(path("png")).unwrap(), fs::read_to_string(path("svg")).unwrap());
    assert!(png.starts_with(b"\x89PNG"));
    svg
}

#[test]
fn figures_stay_on_the_page() {
    let svg = draw(&synthetic::record(200, 512, &["protein"]), "density");
    assert_inside(&svg);
    assert!(["protein density ρ", "10⁻⁴", "κ₀(ρ)"].iter().all(|text| svg.contains(text)));
    assert_inside(&draw(&synthetic::record(200, 512, &[]), "curvature"));
}

#[test]
fn one_of_several_densities_is_chosen_by_its_name() {
    let record = synthetic::record(5, 64, &["lipid", "protein"]);
    let folder = Folder::new("chosen");
    let drawn = |name: &str, density: Option<&str>| {
        let path = folder.file(name);
        let options = Options { density: density.map(str::to_owned), ..Options::default() };
        plot(&record, &path, &options).map(|()| texts(&fs::read_to_string(&path).unwrap()))
    };
    for (name, density, shown) in [("first.svg", None, "lipid"), ("second.svg", Some("protein"), "protein")] {
        let labels = drawn(name, density).unwrap();
        let of_density = labels.iter().filter(|text| text.content == format!("{shown} density ρ")).count();
        assert_eq!(of_density, 2, "the bar of colours and the axis of the state");
    }
    let error = drawn("none.svg", Some("curvature")).err().unwrap();
    assert_eq!(error.to_string(), "the run has no density `curvature`; it has `lipid`, `protein`");
}

#[test]
fn an_empty_title_takes_no_room() {
    let highest = |title: &str| {
        let mut record = synthetic::record(5, 64, &["protein"]);
        title.clone_into(&mut record.title);
        let svg = draw(&record, "untitled");
        assert_inside(&svg);
        texts(&svg)
            .iter()
            .filter(|text| text.content == "energy")
            .map(|text| text.top)
            .fold(f64::INFINITY, f64::min)
    };
    assert!(highest("") < highest("A title"));
}

#[test]
fn odd_records_are_drawn() {
    let mut record = synthetic::record(
        1,
        64,
        &["a component with a name that is as long as the name of a density may be"],
    );
    record.densities.push("another component with a name as long as names may be, and longer".to_owned());
    record.title = "A very long title, longer than any page is wide, ".repeat(4);
    record.steps = StepLog::default();
    assert_inside(&draw(&record, "one-frame"));
    for text in texts(&draw(&record, "long-names")).iter().filter(|text| text.content.contains(" density ρ"))
    {
        assert!(
            text.top >= 0.0 && text.bottom <= 3600.0,
            "{}: {} to {}",
            text.content,
            text.top,
            text.bottom
        );
    }
    let mut record = synthetic::record(5, 64, &["protein"]);
    record.frames[4].energy = f64::NAN;
    record.frames[4].density[0].fill(0.5);
    record.frames[4].position[3] = [f64::NAN, 0.0];
    record.frames.iter_mut().for_each(|frame| frame.length *= 1e-7);
    assert_inside(&draw(&record, "odd"));
}

/// Place, direction and content of the texts of an SVG document: the widths of a digit are 0.64 of the size.
struct Text {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
    content: String,
}

fn texts(svg: &str) -> Vec<Text> {
    let of = |part: &str| {
        let (tag, rest) = part.split_once('>').unwrap();
        let attribute = |name: &str| {
            let value =
                tag.split_once(&format!(" {name}=\"")).map(|(_, rest)| rest.split('"').next().unwrap());
            value.unwrap_or_default().to_owned()
        };
        let number = |name: &str| attribute(name).parse::<f64>().unwrap();
        let content = rest.split('<').next().unwrap().trim().to_owned();
        let (x, y, size) = (number("x"), number("y"), number("font-size"));
        let length = 0.6 * size * content.chars().count() as f64;
        // Rotated text is centred beside its anchor.
        let (left, right, top, bottom) =
            match (attribute("transform").is_empty(), attribute("text-anchor").as_str()) {
                (false, _) if attribute("transform").contains("270") => {
                    (x, x + size, y - length / 2.0, y + length / 2.0)
                }
                (false, _) => (x - size, x, y - length / 2.0, y + length / 2.0),
                (_, "start") => (x, x + length, y - size / 2.0, y + size / 2.0),
                (_, "end") => (x - length, x, y - size / 2.0, y + size / 2.0),
                _ => (x - length / 2.0, x + length / 2.0, y - size / 2.0, y + size / 2.0),
            };
        Text { left, right, top, bottom, content }
    };
    svg.split("<text").skip(1).map(of).collect()
}

/// No text lies on another one or leaves the page.
fn assert_legible(svg: &str) {
    let texts = texts(svg);
    for (k, one) in texts.iter().enumerate() {
        assert!(one.left >= 0.0 && one.right <= 6400.0, "{} from {} to {}", one.content, one.left, one.right);
        for other in &texts[..k] {
            let across = one.left.max(other.left) < one.right.min(other.right);
            let along = one.top.max(other.top) < one.bottom.min(other.bottom);
            assert!(!(across && along), "{:?} lies on {:?}", one.content, other.content);
        }
    }
}

/// `record` with other positions, curvatures and lengths.
fn changed(mut record: Record, position: impl Fn(f64) -> f64, value: impl Fn(f64) -> f64) -> Record {
    for frame in &mut record.frames {
        frame.position.iter_mut().flatten().for_each(|x| *x = position(*x));
        frame.curvature.iter_mut().for_each(|kappa| *kappa = value(*kappa));
        (frame.length, frame.energy) = (value(frame.length), value(frame.energy));
    }
    record.steps = StepLog::default();
    record
}

#[test]
fn labels_and_names_of_axes_stand_apart() {
    let record = || synthetic::record(5, 64, &[]);
    assert_legible(&draw(&record(), "plain"));
    let far = draw(&changed(record(), |x| x + 1e6, |y| y), "far");
    assert_legible(&far);
    assert!(far.contains("x − 1000000") && far.contains("y − 1000000"));
    let flat = draw(&changed(record(), |x| 1e-5 * x, |y| 12.5664 + 1e-5 * y), "flat");
    assert_legible(&flat);
    assert!(flat.contains("length − 12.56"));
    assert_legible(&draw(&changed(record(), |x| 1e8 * x, |y| 0.5884 + 1e-3 * y), "digits"));
}

#[test]
fn a_short_run_in_tiny_units_has_times() {
    let mut record = synthetic::record(20, 64, &[]);
    for (k, frame) in record.frames.iter_mut().enumerate() {
        frame.time = 1e-24 * k as f64;
    }
    record.steps = StepLog::default();
    let svg = draw(&record, "tiny");
    assert!(svg.contains("10⁻²⁴") && svg.contains("10⁻²³"));
}

#[test]
fn few_nodes_are_drawn_round() {
    let sides =
        |nodes| draw(&synthetic::record(2, nodes, &["protein"]), "round").matches("<polyline").count();
    assert!(sides(12) > 150, "{} sides", sides(12));
}

/// A dot on a line, for a sample that stands alone, stands on its line in the legend too.
#[test]
fn dots_on_lines_are_in_the_legend() {
    let mut record = synthetic::record(3, 64, &[]);
    record.steps = StepLog::default();
    let svg = draw(&record, "sparse");
    let tops = svg.split("<circle").skip(1).filter(|circle| circle.contains(" r=\"24\""));
    let tops: Vec<f64> = tops
        .map(|circle| {
            circle.split_once(" cy=\"").and_then(|(_, y)| y.split('"').next()).unwrap().parse().unwrap()
        })
        .collect();
    let legend = tops.iter().fold(f64::INFINITY, |top, at| top.min(*at));
    assert_eq!(tops.iter().filter(|at| **at == legend).count(), 2, "{tops:?}");
}

#[test]
fn a_constant_state_is_a_dot() {
    let mut record = synthetic::record(2, 64, &["protein"]);
    let dots = |record: &Record| draw(record, "constant").matches(" r=\"28\"").count();
    let without = dots(&record);
    record.frames[1].density[0].fill(0.5);
    record.frames[1].curvature.iter_mut().enumerate().for_each(|(i, kappa)| *kappa = 1.0 + 1e-13 * i as f64);
    assert_eq!(dots(&record), without + 1);
}

#[test]
fn a_figure_needs_a_state_and_a_known_format() {
    let mut record = synthetic::record(1, 16, &[]);
    let folder = Folder::new("refused");
    let nowhere = folder.file("curveflow.pdf");
    assert!(matches!(plot(&record, &nowhere, &Options::default()), Err(PictureError::Format { .. })));
    let path = nowhere.with_extension("png");
    for width in [0, u32::MAX] {
        let options = Options { width, ..Options::default() };
        assert!(matches!(plot(&record, &path, &options), Err(PictureError::Size { .. })));
    }
    assert!(matches!(check_name(&nowhere), Err(PictureError::Format { .. })));
    assert!(check_name(&path).is_ok());
    record.frames.clear();
    assert!(matches!(plot(&record, &path, &Options::default()), Err(PictureError::NoFrames)));
}
