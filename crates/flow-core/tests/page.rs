//! Pages for the browser: nothing in a record can break out of its place, and odd records are shown.
#![allow(clippy::unwrap_used)] // a failed test may panic

mod folder;
mod synthetic;

use std::fs;
use std::path::PathBuf;

use flow_core::output::StorageError;
use flow_core::output::page::{PageError, html, view};
use flow_core::run::{Record, StepLog, StopReason};

use folder::Folder;

/// Everything that has ended a text before its time.
const HOSTILE: &str =
    "</title></script><!--<script>alert(1)</script> \" ' ` & \\ ${x} \0 \u{7} \u{202e}\u{2066}\u{2028} ]]>";

/// The page of `record`; it stays as `name`.html if `CURVEFLOW_KEEP_PAGES` names a folder, for the tests in a browser.
fn kept(record: &Record, name: &str) -> String {
    let page = html(record).unwrap();
    if let Some(folder) = std::env::var_os("CURVEFLOW_KEEP_PAGES").map(PathBuf::from) {
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(name).with_extension("html"), &page).unwrap();
    }
    page
}

/// The content of the element that starts with `tag`, up to the first `end`, as a browser finds it.
fn content<'a>(page: &'a str, tag: &str, end: &str) -> &'a str {
    page.split_once(tag).unwrap().1.split_once(end).unwrap().0
}

fn summary(page: &str) -> &str {
    content(page, "id=\"summary\">", "</script")
}

/// The page without its data: markup, style and program.
fn frame_of(page: &str) -> String {
    let mut rest = page.to_owned();
    for id in ["summary", "centres", "positions", "fields", "values", "energies"] {
        let data = content(page, &format!("id=\"{id}\">"), "</script").to_owned();
        rest = rest.replace(&format!("id=\"{id}\">{data}<"), &format!("id=\"{id}\"><"));
    }
    rest
}

fn hostile() -> Record {
    let mut record = synthetic::record(3, 16, &[HOSTILE]);
    for text in [&mut record.title, &mut record.scene, &mut record.resolved_scene] {
        HOSTILE.clone_into(text);
    }
    for names in [&mut record.energy_terms, &mut record.fields, &mut record.diagnostics] {
        names.fill(HOSTILE.to_owned());
    }
    record.stop_reason = StopReason::Failed(HOSTILE.to_owned());
    record
}

#[test]
fn hostile_texts_stay_texts() {
    let page = kept(&hostile(), "hostile");
    let tame = html(&Record { title: "tame".to_owned(), ..synthetic::record(3, 16, &["tame"]) }).unwrap();
    // As many elements, in the same places, as in any other page.
    let title = "&lt;/title&gt;&lt;/script&gt;&lt;!--&lt;script&gt;alert(1)&lt;/script&gt; &quot; ' ` &amp; \\ ${x} \
                 ␀ ␇ ⟨U+202E⟩⟨U+2066⟩⟨U+2028⟩ ]]&gt;";
    assert_eq!(frame_of(&page).replace(title, "tame"), frame_of(&tame));
    assert!(!summary(&page).contains(['<', '>', '&', '\0', '\u{7}', '\u{202e}', '\u{2066}', '\u{2028}']));
    let scene = r#""scene":"\u003c/title\u003e\u003c/script\u003e\u003c!--\u003cscript\u003ealert(1)\u003c/script\u003e \" ' ` \u0026 \\ ${x} ␀ ␇ ⟨U+202E⟩⟨U+2066⟩⟨U+2028⟩ ]]\u003e","#;
    assert!(summary(&page).contains(scene));
}

#[test]
fn the_page_asks_for_nothing_from_outside() {
    let page = html(&synthetic::record(2, 16, &["protein"])).unwrap();
    assert!(page.contains(
        "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:"
    ));
    for word in [
        "http:",
        "https:",
        "//www",
        "src=",
        "@import",
        "url(",
        "fetch(",
        "XMLHttpRequest",
        "import(",
        "innerHTML",
        "{{",
    ] {
        assert!(!page.contains(word), "{word}");
    }
    // The six data elements, and the program, which no word of its own may end.
    assert_eq!(page.matches("</script").count(), 7);
}

#[test]
fn what_is_not_a_number_is_kept_as_such() {
    let mut record = synthetic::record(2, 1, &["protein"]);
    record.frames[1].position[0] = [f64::NAN, 1.0];
    record.frames[0].energy = f64::NAN;
    let page = html(&record).unwrap();
    let positions = content(&page, "id=\"positions\">", "</script");
    // One node is its own middle: three zeros, after bytes 00 00 c0 7f (NaN).
    assert_eq!(positions, "AAAAAAAAAAAAAMB/AAAAAA==");
    assert!(summary(&page).contains(r#"["energy, first → last",[null,"#));
}

/// A quarter of the nodes has no position, another no density: what is shown of them is for the tests in a browser.
#[test]
fn gaps_are_kept() {
    let mut record = synthetic::record(3, 64, &["protein"]);
    record.frames[1] = record.frames[0].clone();
    record.frames[1].position[..16].fill([f64::NAN; 2]);
    record.frames[1].density[0][32..48].fill(f64::NAN);
    let page = kept(&record, "gaps");
    assert_eq!(content(&page, "id=\"positions\">", "</script").len(), 3 * 64 * 8 * 4 / 3);
}

#[test]
fn one_frame_is_a_page() {
    let mut record = synthetic::record(1, 64, &[]);
    record.steps = StepLog::default();
    let page = kept(&record, "one-frame");
    assert!(summary(&page).contains(r#""frames":1,"nodes":64,"#));
    assert!(summary(&page).contains(r#""everyStep":0,"#));
    assert_eq!(content(&page, "id=\"energies\">", "</script").len(), 24);
}

/// A record far from the origin, by a power of two, and one that is not: the same curves to the last digit.
#[test]
fn positions_are_kept_from_the_middle_of_the_curve() {
    let far = |by: f64| {
        let mut record = synthetic::record(3, 24, &[]);
        for x in record.frames.iter_mut().flat_map(|frame| frame.position.iter_mut().flatten()) {
            *x = (1024.0 * *x).round() / 1024.0 + by;
        }
        record
    };
    let (near, far) = (kept(&far(0.0), "near"), kept(&far(f64::from(1 << 20)), "far"));
    let positions = |page| content(page, "id=\"positions\">", "</script").to_owned();
    assert_eq!(positions(&near), positions(&far));
    assert_ne!(content(&near, "id=\"centres\">", "</script"), content(&far, "id=\"centres\">", "</script"));
}

/// Large and small units, whose labels would be long: what is shown of them is for the tests in a browser.
#[test]
fn units_may_be_any() {
    let mut record = synthetic::record(3, 24, &["protein"]);
    for frame in &mut record.frames {
        frame.position.iter_mut().flatten().for_each(|x| *x *= 1e6);
        frame.density[0].iter_mut().for_each(|rho| *rho *= 1e6);
        frame.curvature.iter_mut().for_each(|kappa| *kappa = 0.5 + 1e-5 * *kappa);
        (frame.length, frame.energy) = (1e6 * frame.length, 1.2708 + 1e-5 * frame.energy);
    }
    record.steps = StepLog::default();
    kept(&record, "units");
}

/// Steps from 1e-8 on, three frames late: what is drawn of them is for the tests in a browser.
#[test]
fn energies_are_those_of_steps_and_frames() {
    let mut record = synthetic::record(4, 24, &[]);
    for (k, frame) in record.frames.iter_mut().enumerate() {
        (frame.time, frame.length) = (0.1 * k as f64, 8.0 - k as f64);
    }
    record.steps.time = (0..40).map(|k| 1e-8 * 1.5_f64.powi(k)).collect();
    record.steps.energy = vec![7.0; 40];
    let page = kept(&record, "late");
    let energies = content(&page, "id=\"energies\">", "</script");
    assert_eq!(energies.len(), ((40_usize + 4) * 16).div_ceil(3) * 4);
    assert!(summary(&page).contains(r#""everyStep":1,"#));
}

/// (16 (d + 2) n + 32 h + 128) / 3 bytes per frame, as the documentation of the module says.
#[test]
fn a_frame_takes_as_many_bytes_as_stated() {
    let nodes = 300;
    let size = |frames| html(&synthetic::record(frames, nodes, &["protein"])).unwrap().len();
    // Curvature, metric, normal velocity, one density, one field; eight values, two terms, a mass, a distance.
    let (fields, values) = (5, 12);
    let stated = (16 * (fields + 2) * nodes + 32 * values + 128) / 3;
    // The synthetic run has its steps at the times of its frames.
    let measured = (size(103) - size(13)) / 90;
    assert!(measured.abs_diff(stated) <= 2, "{measured} bytes, stated {stated}");
    let mut bare = synthetic::record(1, 2, &[]);
    bare.scene.clear();
    assert!(html(&bare).unwrap().len() < 100_000);
}

#[test]
fn a_page_has_its_name_and_rectangular_frames() {
    let folder = Folder::new("page");
    let path = folder.file("page.html");
    let mut record = synthetic::record(3, 16, &["protein"]);
    assert!(matches!(view(&record, &path.with_extension("h5"), true), Err(PageError::Format { .. })));
    view(&record, &path, false).unwrap();
    let again = view(&record, &path, false);
    let written = fs::read_to_string(&path).unwrap();
    assert!(matches!(again, Err(PageError::Storage(StorageError::Exists { .. }))));
    assert_eq!(written, html(&record).unwrap());
    record.frames[1].density[0].pop();
    let ragged = html(&record);
    assert!(matches!(
        ragged,
        Err(PageError::Storage(StorageError::Ragged { item: "density", index: 1, found: 15, expected: 16 }))
    ));
    record.frames.clear();
    assert!(matches!(html(&record), Err(PageError::NoFrames)));
}
