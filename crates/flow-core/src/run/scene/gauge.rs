//! `flow.gauge` and `flow.grading`: the list of gauges.

use std::sync::Arc;

use super::choice::names;
use super::error::Fault;
use super::formula::Formula;
use super::section::Section;
use crate::flow::{self, MetricRole};

names! {
    /// The gauge: which tangential velocity goes with a normal one.
    #[derive(Default)]
    pub enum Gauge {
        /// The metric g stays uniform along the curve. The default.
        #[default]
        ScaledArcLength = "scaled-arc-length",
        /// The metric g is the length times a fixed function of the parameter, `grading`.
        Graded = "graded",
        /// Every node moves along the normal, and the metric g with the curve: nodes are material points.
        CoMoving = "co-moving",
    }
}

impl Gauge {
    /// The rule itself.
    #[must_use]
    pub fn rule(self) -> Arc<dyn flow::Gauge> {
        match self {
            Gauge::ScaledArcLength => Arc::new(flow::ScaledArcLength),
            Gauge::Graded => Arc::new(flow::Graded),
            Gauge::CoMoving => Arc::new(flow::CoMoving),
        }
    }

    /// What the metric is in it.
    #[must_use]
    pub fn metric(self) -> MetricRole {
        self.rule().metric()
    }

    /// The gauge that keeps a nodal `metric` but for its mean.
    #[must_use]
    pub fn at_rest(metric: &[f64]) -> Self {
        if MetricRole::at_rest(metric) == MetricRole::Uniform {
            Gauge::ScaledArcLength
        } else {
            Gauge::Graded
        }
    }

    /// The keys `gauge` and `grading` of a table.
    pub(super) fn read(section: &mut Section<'_>) -> (Option<Self>, Option<Formula>) {
        let gauge: Option<Self> = section.get("gauge").and_then(|entry| entry.choice());
        let grading = section.get("grading");
        let known = gauge.unwrap_or_default();
        match (known, &grading) {
            (gauge, Some(_)) if gauge.metric() != MetricRole::Uniform => {}
            // A gauge that is not known has its own message.
            (other, Some(_)) if gauge.is_some() || !section.has("gauge") => {
                let remedy = "drop the grading, or use gauge = \"graded\"";
                section.fault("grading", Fault::OtherChoice { choice: "gauge", value: other.name(), remedy });
            }
            _ => {}
        }
        let grading =
            grading.and_then(|entry| entry.positive_formula("s", "add a constant, for example 0.1"));
        (gauge, grading)
    }
}
