//! A membrane that a method may look into while the step loop holds it as a `Problem`.

use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

use flow_core::integrator::{Finish, INTEGRALS, LinearPart, Problem};
use flow_core::run::Membrane;

/// A handle on one membrane.
#[derive(Clone, Debug)]
pub struct Shared(pub Rc<RefCell<Membrane>>);

impl Shared {
    /// Takes the membrane.
    #[must_use]
    pub fn new(membrane: Membrane) -> Self {
        Self(Rc::new(RefCell::new(membrane)))
    }
}

impl Problem for Shared {
    fn size(&self) -> usize {
        self.0.borrow().size()
    }

    fn blocks(&self) -> Vec<Range<usize>> {
        self.0.borrow().blocks()
    }

    fn block_floor(&self, block: usize, y: &[f64]) -> f64 {
        self.0.borrow().block_floor(block, y)
    }

    fn rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.0.borrow_mut().rate(y, rate);
    }

    fn linearise(&mut self, y: &[f64], rate: &mut [f64]) {
        self.0.borrow_mut().linearise(y, rate);
    }

    fn weigh(&self, r: &mut [f64]) {
        self.0.borrow().weigh(r);
    }

    fn unweigh(&self, r: &mut [f64]) {
        self.0.borrow().unweigh(r);
    }

    fn settle(&mut self, gamma: f64, r: &mut [f64]) -> bool {
        self.0.borrow_mut().settle(gamma, r)
    }

    fn jacobian_product(&mut self, v: &[f64], out: &mut [f64]) {
        self.0.borrow_mut().jacobian_product(v, out);
    }

    fn factorise(&mut self, gamma: f64) -> bool {
        self.0.borrow_mut().factorise(gamma)
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.0.borrow_mut().precondition(r);
    }

    fn krylov_feedback(&mut self, iterations: usize) -> bool {
        self.0.borrow_mut().krylov_feedback(iterations)
    }

    fn rests_with_its_energy(&self) -> bool {
        self.0.borrow().rests_with_its_energy()
    }

    fn finish(&mut self, time: f64, y: &mut [f64]) -> Finish {
        self.0.borrow_mut().finish(time, y)
    }

    fn energy_rounding(&self, y: &[f64]) -> f64 {
        self.0.borrow().energy_rounding(y)
    }

    fn energy_slope(&self, direction: &[f64]) -> Option<f64> {
        self.0.borrow().energy_slope(direction)
    }

    fn finished_rate(&mut self, y: &[f64], rate: &mut [f64]) {
        self.0.borrow_mut().finished_rate(y, rate);
    }

    fn linear_part(&mut self, y: &[f64], part: &mut LinearPart) -> bool {
        self.0.borrow_mut().linear_part(y, part)
    }

    fn accepted(&mut self, time: f64, integrals: [f64; INTEGRALS]) {
        self.0.borrow_mut().accepted(time, integrals);
    }
}
