//! Every term of the energy, and flows of it.

use std::sync::Arc;

use flow_core::energies::{
    Adhesion, Agents, Area, Bending, CutOff, EnergyTerm, Length, Local, Membrane, NodalLines, Packing,
    Regularization,
};
use flow_core::expression::Expression;
use flow_core::flow::{EnergySum, FlowMap, GradientFlow};
use flow_core::geometry::{Grading, Layout, PeriodicGrid};
use flow_core::operators::{Derivative, DerivativeFamily};

use crate::mobilities::{Density, Normal};

/// A term, or all of them together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    Bending,
    BendingAround,
    BendingOfDensity,
    Regularization,
    Tension,
    Penalty,
    Pressure,
    AreaPenalty,
    Adhesion,
    ShortAdhesion,
    Membrane,
    Packing,
    Agents,
    LocalOfCurvature,
    Local,
    LocalWithSlopes,
    /// All terms; two densities, with the agents on the second.
    Everything,
}

/// Widths ε and δ of the agents, and the target of the length penalty.
pub const EPSILON: f64 = 0.05;
pub const DELTA: f64 = 0.2;
pub const PENALTY: f64 = 3.0;
pub const TARGET: f64 = 9.0;

const WITHOUT_SLOPES: &str = "0.3*kappa^2*protein + 0.1*protein^4 + exp(0.1*kappa)";
const WITH_SLOPES: &str =
    "0.3*kappa^2*protein + 0.1*kappa_sigma^2*(1 + protein^2) + 0.2*protein_sigma^2 + exp(0.1*kappa)";
/// Every variable of two densities meets another one.
const OF_TWO_DENSITIES: &str = "0.3*kappa^2*protein*lipid + 0.1*kappa_sigma^2*(1 + lipid^2) + 0.2*protein_sigma*lipid_sigma + lipid^3*kappa_sigma*protein_sigma";

impl Term {
    /// Every term.
    pub const ALL: [Self; 17] = [
        Self::Bending,
        Self::BendingAround,
        Self::BendingOfDensity,
        Self::Regularization,
        Self::Tension,
        Self::Penalty,
        Self::Pressure,
        Self::AreaPenalty,
        Self::Adhesion,
        Self::ShortAdhesion,
        Self::Membrane,
        Self::Packing,
        Self::Agents,
        Self::LocalOfCurvature,
        Self::Local,
        Self::LocalWithSlopes,
        Self::Everything,
    ];

    /// Densities of the states that it is tested on.
    pub fn densities(self) -> usize {
        match self {
            Self::Bending
            | Self::BendingAround
            | Self::Tension
            | Self::Pressure
            | Self::AreaPenalty
            | Self::Adhesion
            | Self::LocalOfCurvature => 0,
            Self::Packing | Self::Everything => 2,
            _ => 1,
        }
    }

    /// The term for states of `layout`.
    pub fn build(self, layout: Layout) -> Vec<Box<dyn EnergyTerm>> {
        match self {
            Self::Bending => vec![Box::new(Bending::new(0.7))],
            Self::BendingAround => vec![Box::new(Bending::around(0.7, 0.4))],
            Self::BendingOfDensity => vec![Box::new(bending_of_density(0, layout.nodes()))],
            Self::Regularization => vec![Box::new(Regularization::new(DELTA))],
            Self::Tension => vec![Box::new(Length::Tension(0.6))],
            Self::Penalty => vec![Box::new(Length::Penalty { penalty: PENALTY, target: TARGET })],
            Self::Pressure => vec![Box::new(Area::Pressure(0.8))],
            Self::AreaPenalty => vec![Box::new(Area::Penalty { penalty: 2.0, target: 2.5 })],
            Self::Adhesion => vec![Box::new(adhesion(CutOff::Automatic { length: 6.0 }, layout.nodes()))],
            Self::ShortAdhesion => vec![Box::new(adhesion(CutOff::At(SHORT), layout.nodes()))],
            Self::Membrane => vec![Box::new(Membrane::new(0, 0.3))],
            Self::Packing => vec![Box::new(packing(layout.nodes()))],
            Self::Agents => vec![Box::new(agents(0, layout.nodes()))],
            Self::LocalOfCurvature => {
                vec![Box::new(local("0.2*kappa^4 + exp(0.1*kappa)", &[], layout.nodes()))]
            }
            Self::Local => vec![Box::new(local(WITHOUT_SLOPES, &["protein"], layout.nodes()))],
            Self::LocalWithSlopes => vec![Box::new(local(WITH_SLOPES, &["protein"], layout.nodes()))],
            Self::Everything => {
                let mut single = Self::ALL.to_vec();
                single.retain(|term| *term != Self::Everything && term.densities() == 0);
                single.extend([Self::Penalty, Self::Regularization, Self::Packing, Self::Membrane]);
                let mut all: Vec<_> = single.iter().flat_map(|term| term.build(layout)).collect();
                all.push(Box::new(bending_of_density(1, layout.nodes())));
                all.push(Box::new(agents(1, layout.nodes())));
                all.push(Box::new(local(OF_TWO_DENSITIES, &["lipid", "protein"], layout.nodes())));
                all
            }
        }
    }
}

/// Cut-off of [`Term::ShortAdhesion`], across which the kernel is smooth enough for differences.
const SHORT: f64 = 0.8;

/// A kernel with a core and a well; at [`SHORT`] it has fallen below 1e-18.
fn adhesion(cut_off: CutOff, nodes: usize) -> Adhesion {
    let text = match cut_off {
        CutOff::At(_) => "0.5*(1 - q/0.015)*exp(-q/0.015)",
        CutOff::Automatic { .. } => "0.5*(1 - q/0.25)*exp(-q/0.25)",
    };
    let kernel = Expression::parse(text, &["q"]).expect("a formula");
    Adhesion::new(&kernel, cut_off, nodes).expect("short derivatives")
}

fn bending_of_density(density: usize, nodes: usize) -> Bending {
    let preferred = Expression::parse("1.3 - 2*rho + 0.4*rho^3", &["rho"]).expect("a formula");
    Bending::around_function(0.9, &preferred, density, nodes).expect("short derivatives")
}

fn packing(nodes: usize) -> Packing {
    Packing::new(&[vec![1.4, 0.3], vec![0.3, 0.9]], 0.2, nodes)
}

/// The agents of `scenes/three_fold.toml`.
fn agents(density: usize, nodes: usize) -> Agents {
    let parse = |text| Expression::parse(text, &["kappa", "rho"]).expect("a formula");
    let lines = NodalLines {
        preferred_curvature: parse("1.3 - 2.0/0.76*(rho - 0.19)"),
        low_density: parse("0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)"),
        high_density: parse("0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)"),
    };
    Agents::new(density, EPSILON, DELTA, &lines, nodes).expect("short derivatives")
}

fn local(text: &str, densities: &[&str], nodes: usize) -> Local {
    let names: Vec<&str> = std::iter::once("kappa").chain(densities.iter().copied()).collect();
    let slopes: Vec<String> = names.iter().map(|name| format!("{name}_sigma")).collect();
    let variables: Vec<&str> = names.iter().copied().chain(slopes.iter().map(String::as_str)).collect();
    let expression = Expression::parse(text, &variables).expect("a formula");
    Local::new(&expression, names.len(), nodes).expect("short derivatives")
}

/// The flow of `terms` under the mobilities, on uniform nodes.
pub fn flow_under(
    terms: Vec<Box<dyn EnergyTerm>>,
    family: DerivativeFamily,
    layout: Layout,
    normal: Normal,
    densities: &[Density],
) -> GradientFlow {
    flow_on(None, terms, family, layout, normal, densities)
}

/// The flow of `terms` under the mobilities, on nodes that may be graded.
pub fn flow_on(
    grading: Option<&Grading>,
    terms: Vec<Box<dyn EnergyTerm>>,
    family: DerivativeFamily,
    layout: Layout,
    normal: Normal,
    densities: &[Density],
) -> GradientFlow {
    let grid = PeriodicGrid::new(layout.nodes());
    let derivative = Derivative::graded(family, &grid, grading.cloned().map(Arc::new));
    let energy = EnergySum::new(terms, layout, &grid, &derivative);
    let map = FlowMap::new(layout, &grid, &derivative);
    let mobilities = densities.iter().map(|density| density.build(&grid, &derivative)).collect();
    GradientFlow::new(map, energy, layout, normal.build(&grid, &derivative), mobilities)
}

/// The flow of `terms` with every density diffusing.
pub fn flow_of(terms: Vec<Box<dyn EnergyTerm>>, family: DerivativeFamily, layout: Layout) -> GradientFlow {
    let densities = vec![Density::Diffusion; layout.densities()];
    flow_under(terms, family, layout, Normal::Identity, &densities)
}

/// The flow of `term`.
pub fn flow(term: Term, family: DerivativeFamily, layout: Layout) -> GradientFlow {
    flow_of(term.build(layout), family, layout)
}

/// Every term with every family.
pub fn every_flow() -> impl Iterator<Item = (Term, DerivativeFamily)> {
    Term::ALL.into_iter().flat_map(|term| DerivativeFamily::ALL.into_iter().map(move |family| (term, family)))
}
