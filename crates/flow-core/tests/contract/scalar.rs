//! A problem of one unknown, for tests of the step loop and its methods.

use flow_core::integrator::{Finish, INTEGRALS, LinearPart, Problem};

/// ẏ = f(y), and what a finished step says of itself.
pub trait Law {
    /// f.
    fn rate(&self, y: f64) -> f64;

    /// f′.
    fn slope(&self, y: f64) -> f64;

    /// Energy and rates of the integrals, the dissipation first.
    fn word(&self, time: f64, y: f64) -> (f64, [f64; INTEGRALS]);

    /// What settles a candidate, if anything does.
    fn settle(&mut self) -> Option<f64> {
        None
    }

    /// A step to `time` is accepted.
    fn accepted(&mut self, _time: f64) {}

    /// Whether f vanishes wherever the energy no longer falls.
    fn rests_with_its_energy(&self) -> bool {
        false
    }

    /// Whether exponential steps may be taken, of which f′ is the linear part.
    fn is_exponential(&self) -> bool {
        false
    }
}

/// The problem of a law.
pub struct Scalar<L> {
    law: L,
    /// J at the last linearisation.
    slope: f64,
}

impl<L> Scalar<L> {
    pub fn new(law: L) -> Self {
        Self { law, slope: 0.0 }
    }

    pub fn law(&self) -> &L {
        &self.law
    }
}

impl<L: Law> Problem for Scalar<L> {
    fn size(&self) -> usize {
        1
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        rate[0] = self.law.rate(y[0]);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.rate(y, rate);
        self.slope = self.law.slope(y[0]);
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        out[0] = self.slope * v[0];
    }

    fn factorise(&mut self, _: f64) -> bool {
        true
    }

    fn precondition(&mut self, _: &mut [f64]) {}

    fn settle(&mut self, _: f64, r: &mut [f64]) -> bool {
        self.law.settle().is_some_and(|change| {
            r[0] = change;
            true
        })
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        let (energy, integral_rates) = self.law.word(time, y[0]);
        Finish::Good { energy, integral_rates }
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        part.clear(1, 0);
        part.drive_by_last(|_, column| column[0] = self.law.slope(y[0]), |_, _| true);
        self.law.is_exponential()
    }

    fn rests_with_its_energy(&self) -> bool {
        self.law.rests_with_its_energy()
    }

    fn accepted(&mut self, time: f64, _: [f64; INTEGRALS]) {
        self.law.accepted(time);
    }
}
