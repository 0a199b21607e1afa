//! What is measured on the flow of a scene at its initial state.

use flow_core::flow::Rate;
use flow_core::geometry::{Complex64, Layout, PeriodicGrid};
use flow_core::run::{Membrane, Scene, Setup};

use crate::mobilities::area_rate;
use crate::vectors::{distance, largest, noise, pair, size};

/// The flow of a scene, and its initial state at the nodes.
pub struct Flowing {
    membrane: Membrane,
    /// The metric w per length at the start.
    weight: Vec<f64>,
    layout: Layout,
    y: Vec<f64>,
    rate: Vec<f64>,
    told: Rate,
    /// Largest rate of the flow, or largest force if no motion is left: what rounding is relative to.
    scale: f64,
}

/// The energy and its rates.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    pub energy: f64,
    /// ⟨∇𝓕, rate⟩.
    pub energy_rate: f64,
    pub dissipation: f64,
    /// |Γ|⟨f²⟩, the dissipation of the force under the identity.
    pub force_square: f64,
    /// ‖∇𝓕‖‖rate‖.
    pub norms: f64,
}

/// The mobility 𝓚 on two random vectors of the dual space.
#[derive(Clone, Copy, Debug)]
pub struct Mobility {
    /// |⟨𝓚a, b⟩ − ⟨𝓚b, a⟩| over the norms.
    pub asymmetry: f64,
    /// ⟨a, 𝓚a⟩.
    pub square: f64,
}

/// Rates of what the flow keeps, each relative to what it is the mean of.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    pub turning: f64,
    pub masses: [f64; 2],
    /// None if the normal mobility does not say that it keeps it.
    pub length: Option<f64>,
    pub area: Option<f64>,
    /// Rate of ∫τ dσ.
    pub gap: f64,
}

impl Flowing {
    pub fn new(scene: &str) -> Self {
        let scene = Scene::parse(scene, "table").unwrap_or_else(|error| panic!("{error}\n{scene}"));
        let Setup { mut membrane, state, .. } = Setup::new(&scene).expect("an initial state");
        let layout = membrane.layout();
        let mut y = vec![0.0; layout.len()];
        membrane.flow().decode(&state, &mut y);
        let mut rate = vec![0.0; layout.len()];
        let told = membrane.flow().rate(&y, &mut rate);
        let weight = membrane.flow().current().weight().map_or(vec![1.0; layout.nodes()], <[f64]>::to_vec);
        let scale = largest(&rate).max(largest(membrane.flow().normal_force()));
        Self { membrane, weight, layout, y, rate, told, scale }
    }

    pub fn balance(&mut self) -> Balance {
        let (flow, layout) = (self.membrane.flow(), self.layout);
        let mut gradient = vec![0.0; layout.len()];
        let energy = flow.gradient_at(&self.y, &mut gradient);
        assert_eq!(self.told, flow.dissipation_at(&self.y));
        let (force, length) = (flow.normal_force(), self.y[layout.length_index()]);
        Balance {
            force_square: length * flow.current().mean_of_product(force, force),
            energy,
            energy_rate: pair(layout, &gradient, &self.rate),
            dissipation: self.told.dissipation,
            norms: size(layout, &gradient) * size(layout, &self.rate),
        }
    }

    pub fn mobility(&mut self, seed: u64) -> Mobility {
        let (flow, layout) = (self.membrane.flow(), self.layout);
        flow.linearise(&self.y);
        let (a, b) = (noise(seed, layout.len()), noise(!seed, layout.len()));
        let [mut of_a, mut of_b] = [(); 2].map(|()| vec![0.0; layout.len()]);
        flow.apply_mobility(&a, &mut of_a);
        flow.apply_mobility(&b, &mut of_b);
        let scale = size(layout, &of_a) * size(layout, &b) + size(layout, &of_b) * size(layout, &a);
        let asymmetry = (pair(layout, &of_a, &b) - pair(layout, &of_b, &a)).abs() / scale;
        Mobility { asymmetry, square: pair(layout, &of_a, &a) }
    }

    pub fn kept(&mut self) -> Kept {
        let (layout, nodes) = (self.layout, self.layout.nodes() as f64);
        let mean = |field: usize| {
            let rate = &self.rate[layout.field(field)];
            (rate.iter().sum::<f64>() / nodes).abs() / largest(rate).max(f64::MIN_POSITIVE)
        };
        let (turning, masses) = (mean(0), [mean(1), mean(2)]);
        let gap = self.gap_rate();
        let flow = self.membrane.flow();
        flow.dissipation_at(&self.y);
        let keeps = flow.normal_mobility().keeps();
        let force = largest(flow.normal_force());
        let length = self.rate[layout.length_index()].abs() / self.y[layout.length_index()];
        let area = area_rate(flow).abs();
        let length = length / (largest(flow.current().at_nodes(0)) * force);
        Kept {
            turning,
            masses,
            length: keeps.length.then_some(length),
            area: keeps.area.then_some(area / force.max(largest(flow.normal_velocity()))),
            gap,
        }
    }

    /// Rate of ∫τ dσ = ∫τg ds, relative to the largest rate of the turning: ∫(τ^⊥ `θ_t` g + τ `g_t`) ds.
    fn gap_rate(&self) -> f64 {
        let nodes = self.layout.nodes();
        let angle = antiderivative(&self.y[self.layout.field(0)]);
        let angle_rate = antiderivative(&self.rate[self.layout.field(0)]);
        let length = self.y[self.layout.length_index()];
        let turns = self.y[self.layout.field(0)].iter().sum::<f64>() / nodes as f64;
        let length_rate = self.rate[self.layout.length_index()];
        let times = |factor: f64| self.weight.iter().map(|w| w * factor).collect::<Vec<_>>();
        let metric = times(length);
        let metric_rate = self
            .layout
            .metric()
            .map_or_else(|| times(length_rate), |field| self.rate[self.layout.field(field)].to_vec());
        let mut gap = [0.0; 2];
        for i in 0..nodes {
            let theta = angle[i] + turns * i as f64 / nodes as f64;
            gap[0] += -theta.sin() * angle_rate[i] * metric[i] + theta.cos() * metric_rate[i];
            gap[1] += theta.cos() * angle_rate[i] * metric[i] + theta.sin() * metric_rate[i];
        }
        gap[0].hypot(gap[1]) / (nodes as f64 * length * self.scale)
    }

    /// Largest difference of the rates, relative to the largest.
    pub fn distance(&self, other: &Self) -> f64 {
        distance(&self.rate, &other.rate) / self.scale
    }

    /// Relative differences of energy and rates when the nodes are counted from node `shift` on.
    pub fn shifted(&mut self, shift: usize) -> (f64, f64) {
        let [y, expected] = [&self.y, &self.rate].map(|vector| rotated(self.layout, vector, shift));
        let mut rate = vec![0.0; y.len()];
        let told = self.membrane.flow().rate(&y, &mut rate);
        let energy = (told.energy - self.told.energy).abs() / self.told.energy.abs();
        (energy, distance(&rate, &expected) / self.scale)
    }
}

fn rotated(layout: Layout, vector: &[f64], shift: usize) -> Vec<f64> {
    let mut out = vector.to_vec();
    for field in 0..layout.state_fields() {
        out[layout.field(field)].rotate_left(shift);
    }
    out
}

/// The periodic function of mean zero with the derivative `values` less their mean.
fn antiderivative(values: &[f64]) -> Vec<f64> {
    let mut grid = PeriodicGrid::new(values.len());
    let mut spectrum = vec![Complex64::default(); grid.modes()];
    grid.transform(values, &mut spectrum);
    for (mode, value) in spectrum.iter_mut().enumerate() {
        let k = grid.wave_number(mode);
        *value *= if k == 0.0 { Complex64::default() } else { Complex64::new(0.0, -1.0 / k) };
    }
    let mut out = vec![0.0; values.len()];
    grid.synthesise(&spectrum, &mut out);
    out
}
