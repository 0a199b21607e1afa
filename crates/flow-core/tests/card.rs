//! The card of a run: nothing in a record can break out of its place, and odd records have one too.

mod synthetic;

use flow_core::output::page::card;
use flow_core::run::{Record, StopReason};

const HOSTILE: &str = "</div></svg><script>alert(1)</script> \" ' & <b> \u{202e}";

/// The markup without its texts: what stands between `<` and `>`.
fn tags(html: &str) -> Vec<&str> {
    html.split('<').skip(1).map(|tag| tag.split_once('>').expect("a whole tag").0).collect()
}

#[test]
fn hostile_texts_stay_texts() {
    let mut record = synthetic::record(3, 16, &[HOSTILE]);
    HOSTILE.clone_into(&mut record.title);
    record.stop_reason = StopReason::Failed(HOSTILE.to_owned());
    let tame = Record {
        title: "tame".to_owned(),
        stop_reason: StopReason::Failed("tame".to_owned()),
        ..synthetic::record(3, 16, &["tame"])
    };
    let (hostile, tame) = (card(&record), card(&tame));
    assert_eq!(tags(&hostile), tags(&tame));
    assert!(hostile.contains("&lt;script&gt;") && !hostile.contains(['\u{202e}']));
}

#[test]
fn it_asks_for_nothing_from_outside() {
    let card = card(&synthetic::record(2, 16, &["protein"])).replace("http://www.w3.org/2000/svg", "");
    for word in ["http", "src=", "href", "url(", "script", "@import", "<style"] {
        assert!(!card.contains(word), "{word}");
    }
}

#[test]
fn it_is_coloured_by_the_density_or_by_the_curvature() {
    assert!(card(&synthetic::record(2, 16, &["protein"])).contains(">protein<"));
    assert!(card(&synthetic::record(2, 16, &[])).contains(">curvature<"));
}

#[test]
fn large_curves_make_small_pictures() {
    let bytes = card(&synthetic::record(2, 8192, &["protein"])).len();
    assert!(bytes < 40_000, "{bytes}");
}

#[test]
fn what_is_constant_but_for_rounding_has_one_colour() {
    let mut record = synthetic::record(2, 64, &["protein"]);
    for (i, rho) in record.frames[1].density[0].iter_mut().enumerate() {
        *rho = 0.763 + 1e-15 * (i % 7) as f64;
    }
    let html = card(&record);
    assert!(html.contains(">0.725<") && html.contains(">0.801<"), "the ends of the bar are apart");
    assert_eq!(html.matches("<path").count(), 2, "the initial curve, and the final one in one piece");
}

#[test]
fn the_ends_of_the_colours_are_told_apart() {
    let mut record = synthetic::record(2, 64, &["protein"]);
    for (i, rho) in record.frames[1].density[0].iter_mut().enumerate() {
        *rho = if i == 0 { 0.500_01 } else { 0.500_03 };
    }
    record.frames[1].position[1] = [f64::NAN; 2]; // the values as they are
    let html = card(&record);
    assert!(html.contains(">0.50001<") && html.contains(">0.50003<"));
}

#[test]
fn few_nodes_are_drawn_round() {
    let card = card(&synthetic::record(2, 16, &["protein"]));
    let initial = card.split_once("d=\"").and_then(|(_, rest)| rest.split_once('"')).expect("a path").0;
    assert_eq!(initial.matches(['M', 'L']).count(), 128);
}

#[test]
fn odd_records_have_cards() {
    let mut no_frames = synthetic::record(2, 16, &["protein"]);
    no_frames.frames.clear();
    assert!(!card(&no_frames).contains("<svg"));
    let mut gap = synthetic::record(2, 16, &["protein"]);
    gap.frames[1].position[3] = [f64::NAN; 2];
    gap.frames[1].density[0][5] = f64::INFINITY;
    assert!(!card(&gap).contains("NaN"));
    assert!(card(&synthetic::record(2, 0, &[])).contains("0 nodes"));
    assert!(card(&synthetic::record(2, 1, &["protein"])).contains("1 nodes"));
}
