//! The tables: one line a case.

use std::collections::BTreeMap;

use curveflow_tests::extremes::sweep::{Random, draw};
use curveflow_tests::extremes::{
    Case, End, Outcome, Size, data, parameters, round_off as rounding, scaling as scales, times,
};
use curveflow_tests::report::markdown;

/// The lines of the short runs.
fn cases(cases: &[Case]) -> String {
    lines(cases, Size::Small)
}

fn lines(cases: &[Case], size: Size) -> String {
    let rows: Vec<_> = cases.iter().filter(|case| case.size == size).map(row).collect();
    let head = ["case", "nodes", "ends", "steps", "rise of 𝓕", "balance", "mass defect", "error"];
    markdown(&head, &rows)
}

fn row(case: &Case) -> Vec<String> {
    let (outcome, error) = match case.size {
        Size::Small => case.measure_with_error(),
        Size::Large => (case.measure(), None),
    };
    let broken = outcome.broken_law();
    let end = if outcome.end == case.expected && broken.is_none() {
        name(outcome.end).to_owned()
    } else {
        format!("**{}, not {}: {broken:?}**", name(outcome.end), name(case.expected))
    };
    let number =
        |value: f64| if outcome.record.is_some() { format!("{value:.0e}") } else { "–".to_owned() };
    vec![
        case.name.clone(),
        outcome.record.as_ref().map_or("–".to_owned(), |record| record.nodes().to_string()),
        end,
        outcome.steps().to_string(),
        number(outcome.rise()),
        number(outcome.balance()),
        number(outcome.mass_defect()),
        error.map_or("–".to_owned(), |error| format!("{error:.0e}")),
    ]
}

/// How a run ended, as the document says it.
fn name(end: End) -> &'static str {
    match end {
        End::EndTime => "end time",
        End::Equilibrium => "at rest",
        End::Contact => "contact",
        End::StepUnderflow => "`StepUnderflow`",
        End::TooManySteps => "`TooManySteps`",
        End::Unresolved => "`ResolutionError`",
        End::Fault => "`TermFault` on the way",
        End::TooFewNodes => "`TooFewNodes`",
        End::TooManyNodes => "`TooManyNodes`",
        End::Curve => "`ShapeError`",
        End::EnergyNotFinite => "`EnergyNotFinite`",
        End::Term => "`TermFault`",
        End::OtherSetup => "another `SetupError`",
    }
}

pub fn epsilon() -> String {
    cases(&parameters::epsilon())
}

pub fn delta() -> String {
    cases(&parameters::delta())
}

pub fn penalty() -> String {
    cases(&parameters::penalty())
}

pub fn area_penalty() -> String {
    cases(&parameters::area_penalty())
}

pub fn membrane() -> String {
    cases(&parameters::membrane())
}

pub fn nodes() -> String {
    cases(&parameters::nodes())
}

pub fn tolerance() -> String {
    cases(&parameters::tolerance())
}

pub fn ends() -> String {
    cases(&times::ends())
}

pub fn singular() -> String {
    cases(&times::singular())
}

pub fn ill_posed() -> String {
    cases(&times::ill_posed())
}

pub fn curves() -> String {
    cases(&data::curves())
}

pub fn densities() -> String {
    cases(&data::densities())
}

/// The long runs of all ladders.
pub fn long() -> String {
    let ladders = [
        parameters::epsilon(),
        parameters::delta(),
        parameters::penalty(),
        parameters::nodes(),
        data::curves(),
    ];
    lines(&ladders.concat(), Size::Large)
}

/// The distance of scaled runs from the one of radius 1.
pub fn scaling() -> String {
    let unit = scales::at(1.0);
    let rows: Vec<_> = scales::RADII
        .iter()
        .map(|radius| {
            let record = scales::at(*radius);
            let distance = scales::distance(&record, *radius, &unit);
            vec![format!("{radius:.0e}"), record.counters.steps.to_string(), format!("{distance:.0e}")]
        })
        .collect();
    markdown(&["R", "steps", "distance from R = 1"], &rows)
}

/// Relative error of the velocity of the unit circle, by nodes and family.
pub fn round_off() -> String {
    let head: Vec<&str> = std::iter::once("nodes").chain(rounding::FAMILIES).collect();
    let rows: Vec<_> = rounding::NODES
        .iter()
        .map(|nodes| {
            let errors =
                rounding::FAMILIES.iter().map(|family| format!("{:.0e}", rounding::error(*nodes, family)));
            std::iter::once(nodes.to_string()).chain(errors).collect()
        })
        .collect();
    markdown(&head, &rows)
}

const DRAWN: usize = 60;

/// How many random scenes ended how, and the largest values of what the laws bound.
pub fn sweep() -> String {
    let mut random = Random::new(2);
    let mut ends: BTreeMap<End, Vec<Outcome>> = BTreeMap::new();
    for _ in 0..DRAWN {
        let (text, outcome) = draw(&mut random);
        if let Some(law) = outcome.broken_law() {
            eprintln!("{law}: {:?}, {}\n{text}\n", outcome.end, outcome.message);
        }
        ends.entry(outcome.end).or_default().push(outcome);
    }
    let rows: Vec<_> = ends
        .iter()
        .map(|(end, outcomes)| {
            let largest =
                |of: fn(&Outcome) -> f64| format!("{:.0e}", outcomes.iter().map(of).fold(0.0, f64::max));
            let broken = outcomes.iter().filter(|outcome| outcome.broken_law().is_some()).count();
            vec![
                name(*end).to_owned(),
                outcomes.len().to_string(),
                largest(Outcome::rise),
                largest(Outcome::mass_defect),
                broken.to_string(),
            ]
        })
        .collect();
    markdown(&["ends", "scenes", "rise of 𝓕", "mass defect", "laws broken"], &rows)
}
