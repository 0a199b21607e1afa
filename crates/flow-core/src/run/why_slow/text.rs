//! The answer as text: a sentence, something to try, and the table of shares.

use std::fmt::{self, Display, Formatter};

use super::{Share, Spending, WhySlow};
use crate::integrator::Activity;

/// Shares below this are not shown.
const SHOWN: f64 = 0.0005;

/// A name as people read it.
pub(super) fn readable(name: &str) -> &str {
    if let Some(spending) = Spending::ALL.into_iter().find(|spending| spending.name() == name) {
        return in_words(spending);
    }
    match name {
        "normal_mobility" => "normal mobility",
        "density_mobilities" => "density mobilities",
        "flow_map" => "gauge, flow map, transforms",
        _ => name,
    }
}

fn in_words(spending: Spending) -> &'static str {
    match spending {
        Spending::Start => "the start",
        Spending::Step(Activity::RightHandSide) => "right-hand sides",
        Spending::Step(Activity::JacobianProduct) => "Jacobian products",
        Spending::Step(Activity::Solve) => "preconditioner solves",
        Spending::Step(Activity::Krylov) => "Krylov orthogonalisation",
        Spending::Step(Activity::Check) => "closure and energy checks",
        Spending::Step(Activity::StepControl) => "step and error control",
        Spending::Frames => "frames and diagnostics",
        Spending::Observers => "progress and callbacks",
        _ => spending.name(),
    }
}

impl Display for WhySlow {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", capitalised(&self.sentence))?;
        writeln!(f, "try: {}", self.advice)?;
        if self.total > 0.0 {
            writeln!(f, "\n{:>10}  share  of {:.3e} s", "seconds", self.total)?;
            rows(f, &self.activities, None)?;
            writeln!(f, "\nwithin right-hand sides, linearisations, Jacobian products and checks")?;
            rows(f, &self.evaluations, Some("energy."))?;
        }
        let rejections = &self.rejections;
        write!(
            f,
            "\n{} steps; rejected: {} for the local error, {} in the implicit solve, {} energy rises, {} not finite; {:.2} Krylov \
             iterations per solve",
            self.steps,
            rejections.error,
            rejections.solver,
            rejections.energy_rise,
            rejections.not_finite,
            self.krylov_iterations_per_solve
        )
    }
}

/// The shares, one per line; names that no activity has are terms, and have `prefix`.
fn rows(f: &mut Formatter<'_>, shares: &[Share], prefix: Option<&str>) -> fmt::Result {
    for Share { name, seconds, share } in shares {
        let text = readable(name);
        let prefix = prefix.filter(|_| text == name).unwrap_or_default();
        // What a scene does not have takes no time; a term that it names is listed even so.
        if *share >= SHOWN || !prefix.is_empty() {
            let seconds = if *seconds > 0.0 { format!("{seconds:.3e}") } else { "0".to_owned() };
            writeln!(f, "{seconds:>10}  {:>4.1} %  {prefix}{text}", 100.0 * share)?;
        }
    }
    Ok(())
}

fn capitalised(sentence: &str) -> String {
    let mut characters = sentence.chars();
    characters.next().map_or_else(String::new, |first| first.to_uppercase().chain(characters).collect())
}
