//! ETDRK4 with an embedded third-order solution: the linear part is diagonal in Fourier space.
//!
//! Kassam & Trefethen, SISC 26 (2005) 1214. The embedded solution takes the rate at the
//! end of the step, needed by the next one, in place of the rate at the last stage; their difference, with the
//! weight of that stage, is the error (order 3, as in Balac & Mahé, Comput. Phys. Commun. 184 (2013) 1211).

use flow_core::geometry::{Complex64, Layout, PeriodicGrid};
use flow_core::integrator::{Counters, ErrorNorm, Problem};

use super::one_step::Formula;
use super::shared::Shared;
use super::symbol::{BlockFunction, Symbol, add_function};

/// Accepted steps after which the linear part is renewed in any case.
const OLDEST_SYMBOL: usize = 20;
/// Changes of the step size below this factor are not worth new weights.
const WORTHWHILE: f64 = 1.25;

/// A state or a rate in Fourier space: spectra of the fields, and the length.
#[derive(Clone, Debug, Default)]
struct Spectral {
    spectra: Vec<Complex64>,
    length: f64,
}

impl Spectral {
    fn copy_from(&mut self, other: &Self) {
        self.spectra.copy_from_slice(&other.spectra);
        self.length = other.length;
    }
}

/// Functions of the linear part for one step size.
#[derive(Clone, Debug, Default)]
struct Functions {
    size: f64,
    linear: BlockFunction,
    half: BlockFunction,
    half_rate: BlockFunction,
    whole: BlockFunction,
    first: BlockFunction,
    middle: BlockFunction,
    last: BlockFunction,
}

/// The method with its stages.
#[derive(Debug)]
pub struct Etdrk4 {
    flow: Shared,
    layout: Layout,
    grid: PeriodicGrid,
    symbol: Option<Symbol>,
    age: usize,
    functions: Functions,
    state: Spectral,
    rates: [Spectral; 5],
    stages: [Spectral; 3],
    scratch: Spectral,
    nodal: Vec<f64>,
    rate: Vec<f64>,
    /// Rate at the end of the last step.
    end_rate: Vec<f64>,
    /// Rate at the start of this step, once known.
    start_rate: Option<Vec<f64>>,
}

impl Etdrk4 {
    /// For the membrane behind `flow`, which the step loop must use as well.
    #[must_use]
    pub fn new(flow: Shared) -> Self {
        let layout = flow.0.borrow().layout();
        let grid = PeriodicGrid::new(layout.nodes());
        let zero =
            Spectral { spectra: vec![Complex64::default(); layout.fields() * grid.modes()], length: 0.0 };
        let nodal = vec![0.0; layout.len()];
        Self {
            flow,
            layout,
            grid,
            symbol: None,
            age: 0,
            functions: Functions::default(),
            state: zero.clone(),
            rates: std::array::from_fn(|_| zero.clone()),
            stages: std::array::from_fn(|_| zero.clone()),
            scratch: zero,
            rate: nodal.clone(),
            end_rate: nodal.clone(),
            nodal,
            start_rate: None,
        }
    }

    fn prepare(&mut self, problem: &mut dyn Problem, y: &[f64], size: f64, counters: &mut Counters) {
        if self.functions.size == size && self.age < OLDEST_SYMBOL && self.symbol.is_some() {
            return;
        }
        if self.age > 0 || self.symbol.is_none() {
            problem.linearise(y);
            self.symbol = Some(Symbol::new(self.flow.0.borrow_mut().flow()));
            self.age = 0;
        }
        let Some(symbol) = &self.symbol else { return };
        counters.factorisations += 1;
        let weights = symbol.weights(size);
        self.functions = Functions {
            size,
            linear: symbol.function(|k| symbol.rates()[k]),
            half: symbol.function(|k| weights[k].half),
            half_rate: symbol.function(|k| size * weights[k].half_rate),
            whole: symbol.function(|k| weights[k].whole),
            first: symbol.function(|k| size * weights[k].first),
            middle: symbol.function(|k| 2.0 * size * weights[k].middle),
            last: symbol.function(|k| size * weights[k].last),
        };
    }

    /// The nonlinear part of the rate at a state known in both forms.
    fn nonlinear(&mut self, index: usize, at: Option<usize>) {
        let state = at.map_or(&self.state, |stage| &self.stages[stage]);
        let rate = &mut self.rates[index];
        transform(&mut self.grid, self.layout, &self.rate, rate);
        let fields = self.layout.fields();
        add_function(&self.functions.linear, fields, -1.0, &state.spectra, &mut rate.spectra);
    }

    /// Evaluates the rate at stage `stage` and keeps its nonlinear part as number `stage + 1`.
    fn evaluate(&mut self, stage: usize, problem: &mut dyn Problem, counters: &mut Counters) {
        self.scratch.copy_from(&self.stages[stage]);
        synthesise(&mut self.grid, self.layout, &mut self.scratch, &mut self.nodal);
        problem.rate(&self.nodal, &mut self.rate);
        counters.right_hand_sides += 1;
        self.nonlinear(stage + 1, Some(stage));
    }

    /// Stage `stage` = function(from) + half_rate(Σ factor × rate), `from` the state or an earlier stage.
    fn stage(&mut self, stage: usize, from: Option<usize>, terms: &[(f64, usize)], size: f64) {
        let (fields, functions) = (self.layout.fields(), &self.functions);
        let mut out = std::mem::take(&mut self.stages[stage]);
        out.spectra.fill(Complex64::default());
        let from = from.map_or(&self.state, |stage| &self.stages[stage]);
        add_function(&functions.half, fields, 1.0, &from.spectra, &mut out.spectra);
        out.length = from.length;
        for (factor, rate) in terms {
            let rate = &self.rates[*rate];
            add_function(&functions.half_rate, fields, *factor, &rate.spectra, &mut out.spectra);
            out.length += 0.5 * size * factor * rate.length;
        }
        self.stages[stage] = out;
    }

    /// The solution into the first stage's place.
    fn combine(&mut self, size: f64) {
        let (fields, functions) = (self.layout.fields(), &self.functions);
        let out = &mut self.stages[0];
        out.spectra.fill(Complex64::default());
        add_function(&functions.whole, fields, 1.0, &self.state.spectra, &mut out.spectra);
        out.length = self.state.length;
        let weights = [
            (&functions.first, 1.0),
            (&functions.middle, 2.0),
            (&functions.middle, 2.0),
            (&functions.last, 1.0),
        ];
        for ((function, sixths), rate) in weights.into_iter().zip(&self.rates) {
            add_function(function, fields, 1.0, &rate.spectra, &mut out.spectra);
            out.length += size * sixths / 6.0 * rate.length;
        }
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
        if let Some(known) = &self.start_rate {
            self.rate.copy_from_slice(known);
        } else {
            problem.rate(y, &mut self.rate);
            counters.right_hand_sides += 1;
            self.start_rate = Some(self.rate.clone());
        }
        transform(&mut self.grid, self.layout, y, &mut self.state);
        self.nonlinear(0, None);
        self.stage(0, None, &[(1.0, 0)], size);
        self.evaluate(0, problem, counters);
        self.stage(1, None, &[(1.0, 1)], size);
        self.evaluate(1, problem, counters);
        self.stage(2, Some(0), &[(2.0, 2), (-1.0, 0)], size);
        self.evaluate(2, problem, counters);
        self.combine(size);
        self.evaluate_end(problem, next, counters);
        let fields = self.layout.fields();
        self.scratch.spectra.fill(Complex64::default());
        let [_, _, _, last, end] = &self.rates;
        add_function(&self.functions.last, fields, 1.0, &last.spectra, &mut self.scratch.spectra);
        add_function(&self.functions.last, fields, -1.0, &end.spectra, &mut self.scratch.spectra);
        self.scratch.length = size / 6.0 * (last.length - end.length);
        synthesise(&mut self.grid, self.layout, &mut self.scratch, error);
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

impl Etdrk4 {
    fn evaluate_end(&mut self, problem: &mut dyn Problem, next: &mut [f64], counters: &mut Counters) {
        self.scratch.copy_from(&self.stages[0]);
        synthesise(&mut self.grid, self.layout, &mut self.scratch, next);
        problem.rate(next, &mut self.rate);
        counters.right_hand_sides += 1;
        self.end_rate.copy_from_slice(&self.rate);
        self.nonlinear(4, Some(0));
    }
}

fn transform(grid: &mut PeriodicGrid, layout: Layout, values: &[f64], out: &mut Spectral) {
    let modes = grid.modes();
    for field in 0..layout.fields() {
        grid.transform(&values[layout.field(field)], &mut out.spectra[field * modes..(field + 1) * modes]);
    }
    out.length = values[layout.length_index()];
}

fn synthesise(grid: &mut PeriodicGrid, layout: Layout, spectral: &mut Spectral, out: &mut [f64]) {
    let modes = grid.modes();
    for field in 0..layout.fields() {
        grid.synthesise(
            &mut spectral.spectra[field * modes..(field + 1) * modes],
            &mut out[layout.field(field)],
        );
    }
    out[layout.length_index()] = spectral.length;
}
