//! ETDRK4 with an embedded third-order solution: the linear part is diagonal in Fourier space.
//!
//! Kassam & Trefethen, SISC 26 (2005) 1214. The embedded solution takes the rate at the end of the step, needed
//! by the next one, in place of the rate at the last stage; their difference, with the weight of that stage, is
//! the error (order 3, as in Balac & Mahé, Comput. Phys. Commun. 184 (2013) 1211). The length has no linear part.

use flow_core::geometry::SpectralLayout;
use flow_core::integrator::{Counters, ErrorNorm, Problem};

use super::add_scaled;
use super::one_step::Formula;
use super::shared::Shared;
use super::symbol::{BlockFunction, Symbol, add_function};

/// Accepted steps after which the linear part is renewed in any case.
const OLDEST_SYMBOL: usize = 20;
/// Changes of the step size below this factor are not worth new weights.
const WORTHWHILE: f64 = 1.25;

/// A function of the linear part, with its value on the length.
#[derive(Clone, Debug, Default)]
struct Function {
    blocks: BlockFunction,
    on_length: f64,
}

/// Functions of the linear part for one step size.
#[derive(Clone, Debug, Default)]
struct Functions {
    size: f64,
    linear: Function,
    half: Function,
    half_rate: Function,
    whole: Function,
    first: Function,
    middle: Function,
    last: Function,
}

/// The method with its stages.
#[derive(Debug)]
pub struct Etdrk4 {
    flow: Shared,
    layout: SpectralLayout,
    symbol: Option<Symbol>,
    age: usize,
    functions: Functions,
    /// Nonlinear parts of the rates at the start, at the three stages and at the end.
    rates: [Vec<f64>; 5],
    stages: [Vec<f64>; 3],
    /// Rate at the end of the last step.
    end_rate: Vec<f64>,
    /// Rate at the start of this step, once known.
    start_rate: Option<Vec<f64>>,
}

impl Etdrk4 {
    /// For the membrane behind `flow`, which the step loop must use as well.
    #[must_use]
    pub fn new(flow: Shared) -> Self {
        let layout = flow.0.borrow_mut().flow().spectral_layout();
        let zero = vec![0.0; layout.len()];
        Self {
            flow,
            layout,
            symbol: None,
            age: 0,
            functions: Functions::default(),
            rates: std::array::from_fn(|_| zero.clone()),
            stages: std::array::from_fn(|_| zero.clone()),
            end_rate: zero,
            start_rate: None,
        }
    }

    fn prepare(&mut self, problem: &mut dyn Problem, y: &[f64], size: f64, counters: &mut Counters) {
        if self.functions.size == size && self.age < OLDEST_SYMBOL && self.symbol.is_some() {
            return;
        }
        if self.age > 0 || self.symbol.is_none() {
            problem.linearise(y, &mut self.stages[0]);
            self.symbol = Some(Symbol::new(self.flow.0.borrow_mut().flow()));
            self.age = 0;
        }
        let Some(symbol) = &self.symbol else { return };
        counters.factorisations += 1;
        let weights = symbol.weights(size);
        let function = |on_length: f64, values: &dyn Fn(usize) -> f64| Function {
            blocks: symbol.function(values),
            on_length,
        };
        self.functions = Functions {
            size,
            linear: function(0.0, &|k| symbol.rates()[k]),
            half: function(1.0, &|k| weights[k].half),
            half_rate: function(size / 2.0, &|k| size * weights[k].half_rate),
            whole: function(1.0, &|k| weights[k].whole),
            first: function(size / 6.0, &|k| size * weights[k].first),
            middle: function(size / 3.0, &|k| 2.0 * size * weights[k].middle),
            last: function(size / 6.0, &|k| size * weights[k].last),
        };
    }

    /// Stage `stage` = `half` of `from` + `half_rate` of Σ factor × rate.
    fn stage(&mut self, stage: usize, from: &[f64], terms: &[(f64, usize)]) {
        let out = &mut self.stages[stage];
        out.fill(0.0);
        add(self.layout, &self.functions.half, 1.0, from, out);
        for (factor, rate) in terms {
            add(self.layout, &self.functions.half_rate, *factor, &self.rates[*rate], out);
        }
    }

    /// Nonlinear part of the rate at stage `stage`, as number `stage + 1`.
    fn evaluate(&mut self, stage: usize, problem: &mut dyn Problem, counters: &mut Counters) {
        let (state, rate) = (&self.stages[stage], &mut self.rates[stage + 1]);
        problem.rate(state, rate);
        counters.right_hand_sides += 1;
        add(self.layout, &self.functions.linear, -1.0, state, rate);
    }

    /// Nonlinear part of the rate at the start of the step.
    fn evaluate_start(&mut self, problem: &mut dyn Problem, y: &[f64], counters: &mut Counters) {
        if let Some(known) = &self.start_rate {
            self.rates[0].copy_from_slice(known);
        } else {
            problem.rate(y, &mut self.rates[0]);
            counters.right_hand_sides += 1;
            self.start_rate = Some(self.rates[0].clone());
        }
        add(self.layout, &self.functions.linear, -1.0, y, &mut self.rates[0]);
    }

    /// The solution, and the nonlinear part of the rate there.
    fn evaluate_end(
        &mut self,
        problem: &mut dyn Problem,
        y: &[f64],
        next: &mut [f64],
        counters: &mut Counters,
    ) {
        let functions = &self.functions;
        next.fill(0.0);
        add(self.layout, &functions.whole, 1.0, y, next);
        let weights = [&functions.first, &functions.middle, &functions.middle, &functions.last];
        for (function, rate) in weights.into_iter().zip(&self.rates) {
            add(self.layout, function, 1.0, rate, next);
        }
        problem.rate(next, &mut self.end_rate);
        counters.right_hand_sides += 1;
        self.rates[4].copy_from_slice(&self.end_rate);
        add(self.layout, &functions.linear, -1.0, next, &mut self.rates[4]);
    }
}

impl Formula for Etdrk4 {
    fn order(&self) -> usize {
        4
    }

    fn embedded_order(&self) -> usize {
        3
    }

    fn advance(
        &mut self,
        problem: &mut dyn Problem,
        _: &ErrorNorm,
        y: &[f64],
        size: f64,
        _: f64,
        next: &mut [f64],
        error: &mut [f64],
        counters: &mut Counters,
    ) -> bool {
        self.prepare(problem, y, size, counters);
        self.evaluate_start(problem, y, counters);
        self.stage(0, y, &[(1.0, 0)]);
        self.evaluate(0, problem, counters);
        self.stage(1, y, &[(1.0, 1)]);
        self.evaluate(1, problem, counters);
        let first = std::mem::take(&mut self.stages[0]);
        self.stage(2, &first, &[(2.0, 2), (-1.0, 0)]);
        self.stages[0] = first;
        self.evaluate(2, problem, counters);
        self.evaluate_end(problem, y, next, counters);
        error.fill(0.0);
        let [.., last, end] = &mut self.rates;
        add_scaled(last, -1.0, end);
        add(self.layout, &self.functions.last, 1.0, last, error);
        true
    }

    fn accepted(&mut self) {
        self.age += 1;
        if let Some(start) = &mut self.start_rate {
            std::mem::swap(start, &mut self.end_rate);
        }
    }

    fn worthwhile_growth(&self) -> f64 {
        WORTHWHILE
    }
}

/// out += factor × function(v), spectral vectors.
fn add(layout: SpectralLayout, function: &Function, factor: f64, v: &[f64], out: &mut [f64]) {
    add_function(&function.blocks, layout.modes(), factor, layout.spectra(v), layout.spectra_mut(out));
    out[layout.length_index()] += factor * function.on_length * v[layout.length_index()];
}
