//! Initial values along the curve: a formula, or numbers.

use schemars::json_schema;
use serde::Serialize;

use super::entry::Entry;
use super::error::{Bound, Fault};
use super::formula::Formula;
use super::keywords::inline_schema;
use crate::geometry::{Complex64, PeriodicGrid, ScatteredPoints};

const FEWEST: usize = 4;
const MOST: usize = 16384;

/// Values along the curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Profile {
    /// An expression of `s` in [0, 1), the fraction of arc length from the first point.
    Formula(Formula),
    /// One value for each point of a curve through points; on other curves at equal distances, from the first point on. Between them
    /// the trigonometric polynomial.
    Values(Vec<f64>),
}

impl Profile {
    /// Values at `fractions` of the arc length. They are at the `places` of a list: on a curve through points the parameters φ/2π, else
    /// the fractions again.
    ///
    /// # Panics
    /// If it is a formula of more than one variable.
    #[must_use]
    pub fn values(&self, fractions: &[f64], places: &[f64]) -> Vec<f64> {
        match self {
            Self::Formula(formula) => formula.values(fractions),
            Self::Values(values) => interpolated(values, places),
        }
    }

    /// The formula, if it is one.
    #[must_use]
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Self::Formula(formula) => Some(formula),
            Self::Values(_) => None,
        }
    }

    /// Reads a formula, or a list of numbers: as many as the curve has `points`, if it goes through points.
    pub(super) fn read(entry: &Entry<'_>, points: Option<usize>) -> Option<Self> {
        if !entry.is_list() {
            let expected = "a number, an expression in quotes or a list of numbers";
            return entry.formula_or(expected, &["s"]).map(Self::Formula);
        }
        let read = |entry: &Entry<'_>| entry.number(Bound::Finite, "write an ordinary number");
        let values: Vec<Option<f64>> = entry.list("a list of numbers")?.iter().map(read).collect();
        let mut values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
        // That of the first point may be repeated, as that point may.
        if points.is_some_and(|points| values.len() == points + 1) && values.first() == values.last() {
            values.pop();
        }
        let (bound, remedy) = match points {
            Some(points) => (Bound::Exactly(points as f64), "give a value for each point of the curve"),
            None => (
                Bound::Between(FEWEST as f64, MOST as f64),
                "give values at equal distances along the curve, from its first point on",
            ),
        };
        if bound.contains(values.len() as f64) {
            return Some(Self::Values(values));
        }
        entry.fault(Fault::WrongCount { count: values.len(), bound, remedy });
        None
    }
}

/// The trigonometric polynomial through `values` at equal distances in [0, 1).
fn interpolated(values: &[f64], places: &[f64]) -> Vec<f64> {
    let mut grid = PeriodicGrid::new(values.len());
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(values, &mut spectrum);
    ScatteredPoints::new(values.len(), places).values(&spectrum)
}

inline_schema!(
    Profile,
    json_schema!({
        "type": ["number", "string", "array"],
        "items": { "type": "number" },
        "minItems": FEWEST,
        "maxItems": MOST + 1,
    })
);

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn values_are_taken_where_they_are_given_and_smooth_between() {
        for count in [9, 16] {
            let wave = |s: f64| 0.5 + (TAU * s).sin() - 0.25 * (3.0 * TAU * s).cos();
            let profile =
                Profile::Values((0..count).map(|i| wave(f64::from(i) / f64::from(count))).collect());
            let places: Vec<f64> = (0..40).map(|i| f64::from(i) / 40.0).collect();
            let elsewhere: Vec<f64> = places.iter().map(|s| s * s).collect();
            for at in [&places, &elsewhere] {
                let values = profile.values(&places, at);
                for (value, place) in values.iter().zip(at) {
                    assert!((value - wave(*place)).abs() < 1e-12, "{count}: {value} at {place}");
                }
            }
        }
    }
}
