//! Why a run takes the time that it takes: where the time went, what limits the run, and one thing to try.

mod limit;
mod text;

use super::record::Record;
use super::seconds::Spending;
use crate::integrator::Rejections;
pub use limit::Limit;

/// Time spent on one thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Share {
    /// Name, as in the result file.
    pub name: String,
    /// Seconds.
    pub seconds: f64,
    /// Part of the whole time of the run, from 0 to 1.
    pub share: f64,
}

/// What the clocks and the counters of a run say.
#[derive(Clone, Debug, PartialEq)]
pub struct WhySlow {
    /// Seconds of the run, since its start or, if it was resumed, since then.
    pub total: f64,
    /// What they were spent on, largest first; they add up to the total.
    pub activities: Vec<Share>,
    /// Parts of the right-hand sides, linearisations, products and checks, largest first; they add up to those.
    pub evaluations: Vec<Share>,
    /// Accepted steps.
    pub steps: u64,
    /// Attempts that were thrown away, by cause.
    pub rejections: Rejections,
    /// Krylov iterations of a linear solve, in the mean; 0 if there was none.
    pub krylov_iterations_per_solve: f64,
    /// What the time goes up with most.
    pub limit: Limit,
    /// One sentence on it.
    pub sentence: String,
    /// One thing to try.
    pub advice: String,
}

impl WhySlow {
    /// What `record` says.
    #[must_use]
    pub fn of(record: &Record) -> Self {
        let (seconds, counters) = (&record.seconds, &record.counters);
        let total = seconds.total();
        let share = |(name, seconds): (&str, f64)| Share {
            name: name.to_owned(),
            seconds,
            share: if total > 0.0 { seconds / total } else { 0.0 },
        };
        let sorted = |mut shares: Vec<Share>| {
            shares.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
            shares
        };
        let parts = &seconds.evaluations;
        let terms = record.energy_terms.iter().map(String::as_str).zip(parts.terms.iter().copied());
        let others = [
            ("normal_mobility", parts.normal_mobility),
            ("density_mobilities", parts.density_mobilities),
            ("flow_map", parts.flow_map),
        ];
        let solves = counters.newton_iterations.max(1) as f64;
        let mut why = Self {
            total,
            activities: sorted(seconds.by_activity().map(share).into()),
            evaluations: sorted(terms.chain(others).map(share).collect()),
            steps: counters.steps,
            rejections: counters.rejections,
            krylov_iterations_per_solve: counters.krylov_iterations as f64 / solves,
            limit: Limit::NotMeasured,
            sentence: String::new(),
            advice: String::new(),
        };
        why.limit = Limit::of(&why);
        (why.sentence, why.advice) = why.limit.explain(&why, record);
        why
    }

    /// What people call an activity, or a part of the evaluations.
    #[must_use]
    pub fn readable(name: &str) -> &str {
        text::readable(name)
    }

    /// The share of `spending`.
    fn share(&self, spending: Spending) -> f64 {
        self.activities.iter().find(|share| share.name == spending.name()).map_or(0.0, |share| share.share)
    }
}
