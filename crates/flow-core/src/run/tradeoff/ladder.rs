//! Which tolerances are measured, and how much tighter the reference is.

use super::super::scene::{FEWEST_NODES, LOOSEST, MOST_NODES, TIGHTEST};

/// The reference must be tighter than any rung by a factor that makes its own error small.
const TIGHTEST_RUNG: f64 = 1e-10;
/// How many times tighter than the tightest rung the reference is.
const REFERENCE: f64 = 100.0;

/// Tolerances in falling order.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    tolerances: Vec<f64>,
    reference_nodes: Option<usize>,
}

/// Why a list of tolerances is no ladder.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // each message names its fields
pub enum LadderError {
    /// No tolerance.
    #[error("the list of tolerances is empty: it needs one at least; try 1e-3,1e-5")]
    Empty,
    /// A tolerance that cannot be measured.
    #[error(
        "tolerance {value:e}, number {position} of the list, must be between {TIGHTEST_RUNG:e}, ten times the tightest \
         that the reference can have, and {LOOSEST:e}; try 1e-5"
    )]
    OutOfRange { position: usize, value: f64 },
    /// A tolerance given twice.
    #[error("tolerance {value:e} is in the list twice; drop one of them")]
    Repeated { value: f64 },
    /// A number of nodes that no scene may have.
    #[error(
        "the reference cannot have {nodes} nodes: they must be between {FEWEST_NODES} and {MOST_NODES}; try twice those of \
         the scene"
    )]
    ReferenceNodes { nodes: usize },
}

impl Default for Ladder {
    /// 10⁻², 10⁻³ … 10⁻⁸.
    fn default() -> Self {
        Self { tolerances: vec![1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8], reference_nodes: None }
    }
}

impl Ladder {
    /// A ladder of `tolerances` in any order. With `reference_nodes` the reference has so many nodes. Without, it has those of
    /// the scene, and the errors are those of the time integration alone; or, where the scene says `"auto"`, as many as its
    /// own tolerance needs.
    ///
    /// # Errors
    /// [`LadderError`] if a tolerance is out of range or given twice, or the number of nodes out of range.
    pub fn new(tolerances: &[f64], reference_nodes: Option<usize>) -> Result<Self, LadderError> {
        if tolerances.is_empty() {
            return Err(LadderError::Empty);
        }
        if let Some(at) = tolerances.iter().position(|value| !(TIGHTEST_RUNG..=LOOSEST).contains(value)) {
            return Err(LadderError::OutOfRange { position: at + 1, value: tolerances[at] });
        }
        let mut tolerances = tolerances.to_vec();
        tolerances.sort_by(|a, b| b.total_cmp(a));
        if let Some(pair) = tolerances.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(LadderError::Repeated { value: pair[0] });
        }
        match reference_nodes {
            Some(nodes) if !(FEWEST_NODES..=MOST_NODES).contains(&nodes) => {
                Err(LadderError::ReferenceNodes { nodes })
            }
            _ => Ok(Self { tolerances, reference_nodes }),
        }
    }

    /// The tolerances, the loosest first.
    #[must_use]
    pub fn tolerances(&self) -> &[f64] {
        &self.tolerances
    }

    /// Number of nodes of the reference, if it was given.
    #[must_use]
    pub fn reference_nodes(&self) -> Option<usize> {
        self.reference_nodes
    }

    pub(super) fn tightest(&self) -> f64 {
        self.tolerances.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Tolerance of the reference, and whether rounding keeps it from being tighter.
    pub(super) fn reference(&self) -> (f64, bool) {
        let wanted = decimal(self.tightest() / REFERENCE);
        (wanted.max(TIGHTEST), wanted < TIGHTEST)
    }
}

/// The value without the rounding of a quotient: 1e-7, not 1.0000000000000001e-7.
fn decimal(value: f64) -> f64 {
    format!("{value:.12e}").parse().expect("a number as text is a number")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_fall_and_are_checked() {
        let ladder = Ladder::new(&[1e-5, 1e-3], None).unwrap();
        assert_eq!(ladder.tolerances(), [1e-3, 1e-5]);
        for (tolerances, wrong) in [
            (vec![], LadderError::Empty),
            (vec![1e-3, 1e-12], LadderError::OutOfRange { position: 2, value: 1e-12 }),
            (vec![1e-3, 1e-5, 1e-3], LadderError::Repeated { value: 1e-3 }),
        ] {
            assert_eq!(Ladder::new(&tolerances, None), Err(wrong));
        }
        assert!(matches!(Ladder::new(&[f64::NAN], None), Err(LadderError::OutOfRange { .. })));
        assert_eq!(Ladder::new(&[1e-3], Some(4)), Err(LadderError::ReferenceNodes { nodes: 4 }));
    }

    #[test]
    fn the_reference_is_tighter_than_every_rung() {
        assert_eq!(Ladder::default().reference(), (1e-10, false));
        for (tightest, tolerance, floor) in [(3e-5, 3e-7, false), (1e-9, 1e-11, false), (1e-10, 1e-11, true)]
        {
            let (found, at_floor) = Ladder::new(&[1e-2, tightest], None).unwrap().reference();
            assert_eq!((found, at_floor), (tolerance, floor));
        }
    }
}
