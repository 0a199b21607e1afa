//! The system of a shipped scene as the closures that diffsol calls.

use std::cell::{Cell, RefCell};
use std::error::Error;
use std::ops::Range;

use flow_core::integrator::{Finish, Problem};
use flow_core::run::{Membrane, Scene, Setup};

/// A flow, the state at which its implicit operator is frozen, and the calls so far.
pub struct Equations {
    /// Initial state, closed to rounding.
    pub initial: Vec<f64>,
    blocks: Vec<Range<usize>>,
    membrane: RefCell<Membrane>,
    frozen_at: RefCell<Vec<f64>>,
    rates: Cell<u64>,
    products: Cell<u64>,
}

impl Equations {
    /// The shipped scene `name` on `nodes` nodes.
    pub fn new(name: &str, nodes: &str) -> Result<Self, Box<dyn Error>> {
        let (_, text) =
            Scene::shipped().iter().find(|(shipped, _)| *shipped == name).ok_or("no such shipped scene")?;
        let overrides = [
            ("accuracy.nodes".to_owned(), nodes.to_owned()),
            ("accuracy.linear_solver".to_owned(), "fourier".to_owned()),
        ];
        let Setup { mut membrane, state: mut initial, .. } =
            Setup::new(&Scene::parse_with(text, name, &overrides)?)?;
        if membrane.finish(0.0, &mut initial) == Finish::NotFinite {
            return Err("the initial state is not finite".into());
        }
        let blocks = membrane.blocks();
        Ok(Self {
            initial,
            blocks,
            membrane: RefCell::new(membrane),
            frozen_at: RefCell::default(),
            rates: Cell::new(0),
            products: Cell::new(0),
        })
    }

    /// Absolute tolerances: each block against its own size, as in the program's norm of errors.
    pub fn bounds(&self, tolerance: f64) -> Vec<f64> {
        let size = self.initial.len() as f64;
        let mut bounds = vec![0.0; self.initial.len()];
        for block in &self.blocks {
            let norm = self.initial[block.clone()].iter().map(|y| y * y).sum::<f64>().sqrt();
            let share = (size / (block.len() * self.blocks.len()) as f64).sqrt();
            bounds[block.clone()].fill(tolerance * share * norm / (block.len() as f64).sqrt());
        }
        bounds
    }

    /// f(y).
    pub fn rate(&self, y: &[f64], rate: &mut [f64]) {
        self.rates.set(self.rates.get() + 1);
        self.membrane.borrow_mut().rate(y, rate);
    }

    /// J(y) v; J is renewed when y is another one.
    pub fn product(&self, y: &[f64], v: &[f64], out: &mut [f64]) {
        self.products.set(self.products.get() + 1);
        let (mut membrane, mut frozen_at) = (self.membrane.borrow_mut(), self.frozen_at.borrow_mut());
        if *frozen_at != y {
            frozen_at.clear();
            frozen_at.extend_from_slice(y);
            membrane.linearise(y, out);
        }
        membrane.jacobian_product(v, out);
    }

    /// Calls of [`Self::rate`].
    pub fn rates(&self) -> u64 {
        self.rates.get()
    }

    /// Calls of [`Self::product`].
    pub fn products(&self) -> u64 {
        self.products.get()
    }
}
