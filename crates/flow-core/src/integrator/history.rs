//! Past states at unequal times, and the polynomials through them. See `THEORY.md`, eq. (I4).

use crate::geometry::vectors::combine;

/// The last states at their times, newest first, of which polynomials are made; storage is reused. See `THEORY.md`, eq. (I4).
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    times: Vec<f64>,
    states: Vec<Vec<f64>>,
    filled: usize,
}

/// Most points that are kept.
pub const MOST_POINTS: usize = 7;

/// Weights of the polynomial through some points: value and derivative at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Weights {
    /// Weights of the value.
    pub value: [f64; MOST_POINTS],
    /// Weights of the derivative.
    pub derivative: [f64; MOST_POINTS],
}

/// Lagrange weights at `time` of the polynomial through `times`.
#[must_use]
#[inline] // or derivatives that nobody asked for cost as much as the values
pub fn lagrange(time: f64, times: &[f64]) -> Weights {
    let mut weights = Weights::default();
    for (j, tj) in times.iter().enumerate() {
        let mut value = 1.0;
        let mut derivative = 0.0;
        for (i, ti) in times.iter().enumerate() {
            if i != j {
                let scale = 1.0 / (tj - ti);
                derivative = (derivative * (time - ti) + value) * scale;
                value *= (time - ti) * scale;
            }
        }
        weights.value[j] = value;
        weights.derivative[j] = derivative;
    }
    weights
}

impl History {
    /// Room for a few states of `size` entries.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self { times: vec![0.0; MOST_POINTS], states: vec![vec![0.0; size]; MOST_POINTS], filled: 0 }
    }

    /// Times and states held, newest first.
    #[must_use]
    pub fn points(&self) -> Vec<(f64, Vec<f64>)> {
        self.times().iter().copied().zip(self.states.iter().cloned()).collect()
    }

    /// The history of these `points`, as [`History::points`] gives them; the newest few count.
    #[must_use]
    pub fn of(size: usize, points: &[(f64, Vec<f64>)]) -> Self {
        let mut history = Self::new(size);
        for (time, state) in points.iter().take(MOST_POINTS).rev() {
            history.push(*time, state);
        }
        history
    }

    /// Number of states held.
    #[must_use]
    pub fn len(&self) -> usize {
        self.filled
    }

    /// Whether no state is held.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.filled == 0
    }

    /// Times, newest first.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times[..self.filled]
    }

    /// The state `back` steps ago.
    #[must_use]
    pub fn state(&self, back: usize) -> &[f64] {
        &self.states[back]
    }

    /// Puts a new state in front; the oldest falls out.
    pub fn push(&mut self, time: f64, state: &[f64]) {
        self.times.rotate_right(1);
        self.states.rotate_right(1);
        self.times[0] = time;
        self.states[0].copy_from_slice(state);
        self.filled = (self.filled + 1).min(MOST_POINTS);
    }

    /// Sum of the newest `points` states with `weights`.
    pub fn combine(&self, weights: &[f64], points: usize, out: &mut [f64]) {
        combine(&weights[..points], &self.states, out);
    }
}
