//! A run at a glance, for notebooks: an HTML fragment with the final curve, how the run ended, the laws kept and its cost.
//!
//! It has no script, no style sheet and no address, and uses the colours of what is around it, light or dark.

mod curve;
mod number;

use std::fmt::Write;

use super::facts::{largest, largest_rise};
use super::text::escaped;
use crate::run::{Frame, Record, StopReason, WhySlow, warnings};
use number::short;

const BOX: &str = "display:flex;flex-wrap:wrap;gap:1.2em;align-items:flex-start;max-width:60em;padding:0.8em 1em;\
                   border:1px solid rgba(128,128,128,0.4);border-radius:6px;font:13px/1.45 system-ui,sans-serif;\
                   color:inherit";
const CELL: &str = "padding:0.1em 0.8em 0.1em 0;text-align:left;vertical-align:top;border:none";
const NAME: &str = "opacity:0.7";
/// What looks well and may not be.
const DOUBTFUL: &str = "#8a6100";
/// Significant digits of values, and of errors and times.
const DIGITS: i32 = 5;
const FEW_DIGITS: i32 = 3;
/// Part of the energy by which rounding may raise it in a step.
const ROUNDING: f64 = 1e-13;

/// The fragment of `record`. All that comes from the record is escaped.
#[must_use]
pub fn card(record: &Record) -> String {
    let mut html = format!("<div class=\"curveflow-result\" style=\"{BOX}\">");
    html.push_str(&curve::picture(record));
    html.push_str("<div style=\"flex:1;min-width:22em\">");
    head(&mut html, record);
    html.push_str("<div style=\"display:flex;flex-wrap:wrap;gap:0 1.6em\">");
    table(&mut html, "Laws", &laws(record));
    table(&mut html, "Work", &work(record));
    html.push_str("</div></div></div>");
    html
}

/// Title, how it ended, what makes it doubtful, how large it is.
fn head(html: &mut String, record: &Record) {
    let doubts = warnings(record);
    let colour = match record.stop_reason {
        ref reason if reason.is_success() && !doubts.is_empty() => DOUBTFUL,
        StopReason::EndTime | StopReason::Equilibrium | StopReason::Contact => "#1a7f4b",
        StopReason::Interrupted => DOUBTFUL,
        StopReason::Failed(_) => "#b3261e",
    };
    let badge =
        format!("background:{colour};color:#fff;border-radius:4px;padding:0.05em 0.5em;margin-right:0.5em");
    let title = if record.title.is_empty() { "Untitled run" } else { &record.title };
    // A String never fails.
    let _ = write!(
        html,
        "<div style=\"font-size:1.15em;font-weight:600\">{}</div>\
         <div style=\"margin:0.3em 0\"><span style=\"{badge}\">{}</span>{}</div>{}\
         <div style=\"{NAME}\">t = {}, {} frames, {} nodes</div>",
        escaped(title),
        record.stop_reason.name(),
        escaped(record.stop_reason.message()),
        doubts.iter().map(|doubt| warning(doubt)).collect::<String>(),
        short(record.frames.last().map_or(f64::NAN, |frame| frame.time), DIGITS),
        record.frames.len(),
        record.nodes()
    );
}

/// The line of a warning.
fn warning(text: &str) -> String {
    format!("<div style=\"margin:0.3em 0;font-weight:600\">warning: {}</div>", escaped(text))
}

/// A table of names and values, which are safe already.
fn table(html: &mut String, title: &str, rows: &[(String, String)]) {
    let _ = write!(
        html,
        "<table style=\"font:inherit;color:inherit;border-collapse:collapse;margin:0.5em 0 0;background:none\">\
         <tr><th colspan=\"2\" style=\"{CELL};font-weight:600\">{title}</th></tr>"
    );
    for (name, value) in rows {
        let _ = write!(
            html,
            "<tr style=\"background:none\"><td style=\"{CELL};{NAME}\">{name}</td><td style=\"{CELL}\">{value}</td></tr>"
        );
    }
    html.push_str("</table>");
}

fn laws(record: &Record) -> Vec<(String, String)> {
    let frames = &record.frames;
    let of_frames = |value: fn(&Frame) -> f64| frames.iter().map(value).collect::<Vec<_>>();
    let ends = |value: fn(&Frame) -> f64| {
        [frames.first(), frames.last()].map(|end| short(end.map_or(f64::NAN, value), DIGITS)).join(" → ")
    };
    let rise = largest_rise(record);
    let least = frames.iter().map(|frame| frame.energy.abs()).fold(f64::INFINITY, f64::min);
    let fell = match rise {
        0.0 => "fell at every step".to_owned(),
        _ if rise <= ROUNDING * least => "fell at every step, to rounding".to_owned(),
        _ => format!("rose by {}", short(rise, FEW_DIGITS)),
    };
    let mut rows = vec![
        ("energy".to_owned(), ends(|frame| frame.energy)),
        ("the energy".to_owned(), fell),
        ("balance off by".to_owned(), short(largest(of_frames(|frame| frame.energy_balance)), FEW_DIGITS)),
        ("length".to_owned(), ends(|frame| frame.length)),
        ("area".to_owned(), ends(|frame| frame.area)),
    ];
    for (k, name) in record.densities.iter().enumerate() {
        let most = largest(record.mass_changes(k));
        rows.push((format!("mass of {} off by", escaped(name)), short(most, FEW_DIGITS)));
    }
    let gap = largest(of_frames(|frame| frame.closure_defect / frame.length));
    rows.push(("gap at closure / length".to_owned(), short(gap, FEW_DIGITS)));
    rows
}

fn work(record: &Record) -> Vec<(String, String)> {
    let (counters, why) = (&record.counters, WhySlow::of(record));
    let mut rows = vec![
        ("steps", counters.steps.to_string()),
        ("rejected", counters.rejections.total().to_string()),
        ("right-hand sides", counters.right_hand_sides.to_string()),
        ("Krylov iterations", counters.krylov_iterations.to_string()),
        ("factorisations", counters.factorisations.to_string()),
        ("integration", format!("{} s", short(counters.integration_seconds, FEW_DIGITS))),
    ];
    if let Some(most) = why.activities.first().filter(|most| most.seconds > 0.0) {
        let name = WhySlow::readable(&most.name);
        rows.push(("most time", format!("{name}, {:.0}\u{a0}%", 100.0 * most.share)));
    }
    rows.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
