//! What the sawtooth of K, which the angle at the nodes does not see, does to the tangents.

/// The sawtooth of K, whose angle has the mean square K̂²/λ for the symbol λ of −D₋D₊: c = exp(−K̂²/2λ).
#[derive(Clone, Copy, Debug)]
pub struct Sawtooth {
    /// Its mode.
    pub mode: usize,
    /// 1/λ.
    pub square: f64,
    /// K̂ of the sawtooth.
    pub turning: f64,
}

impl Sawtooth {
    /// c.
    pub fn shortening(self) -> f64 {
        (-0.5 * self.square * self.turning * self.turning).exp()
    }

    /// c′/c.
    pub fn first(self) -> f64 {
        -self.square * self.turning
    }

    /// c″/c.
    pub fn second(self) -> f64 {
        self.square * (self.square * self.turning * self.turning - 1.0)
    }
}
