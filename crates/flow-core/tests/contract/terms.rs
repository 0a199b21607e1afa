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

/// Defines [`Term`] by a table: a name, the densities of the states that the term is tested on, and the term.
macro_rules! terms {
    ($($Name:ident, $densities:literal, |$layout:pat_param| $build:expr;)*) => {
        /// A term, or all of them together.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Term {
            $($Name,)*
            /// All others, with two densities: agents, and what else has one density, act on the second, but the membrane on the first.
            Everything,
        }

        impl Term {
            /// Every term.
            pub const ALL: [Self; [$($densities),*].len() + 1] = [$(Self::$Name,)* Self::Everything];

            /// Densities of the states that it is tested on.
            pub fn densities(self) -> usize {
                match self {
                    $(Self::$Name => $densities,)*
                    Self::Everything => 2,
                }
            }

            /// The term for states of `layout`.
            pub fn build(self, layout: Layout) -> Vec<Box<dyn EnergyTerm>> {
                match self {
                    $(Self::$Name => {
                        let $layout = layout;
                        vec![Box::new($build)]
                    })*
                    Self::Everything => {
                        let others = Self::ALL.into_iter().filter(|term| *term != Self::Everything);
                        others.flat_map(|term| term.build(layout)).collect()
                    }
                }
            }
        }
    };
}

terms! {
    Bending, 0, |_| Bending::new(0.7);
    BendingAround, 0, |_| Bending::around(0.7, 0.4);
    BendingOfDensity, 1, |layout| bending_of_density(layout);
    Regularization, 1, |_| Regularization::new(DELTA);
    Tension, 0, |_| Length::Tension(0.6);
    Penalty, 1, |_| Length::Penalty { penalty: PENALTY, target: TARGET };
    Pressure, 0, |_| Area::Pressure(0.8);
    AreaPenalty, 0, |_| Area::Penalty { penalty: 2.0, target: 2.5 };
    Adhesion, 0, |layout| adhesion(CutOff::Automatic { length: 6.0 }, layout);
    ShortAdhesion, 1, |layout| adhesion(CutOff::At(SHORT), layout);
    Membrane, 1, |_| Membrane::new(0, 0.3);
    Packing, 2, |layout| packing(layout);
    Agents, 1, |layout| agents(layout);
    LocalOfCurvature, 0, |layout| local("0.2*kappa^4 + exp(0.1*kappa)", layout);
    Local, 1, |layout| local(WITHOUT_SLOPES, layout);
    LocalWithSlopes, 1, |layout| local(WITH_SLOPES, layout);
    LocalOfTwoDensities, 2, |layout| local(OF_TWO_DENSITIES, layout);
}

/// Cut-off of [`Term::ShortAdhesion`], across which the kernel is smooth enough for differences.
const SHORT: f64 = 0.8;

/// A kernel with a core and a well; at [`SHORT`] it has fallen below 1e-18.
fn adhesion(cut_off: CutOff, layout: Layout) -> Adhesion {
    let text = match cut_off {
        CutOff::At(_) => "0.5*(1 - q/0.015)*exp(-q/0.015)",
        CutOff::Automatic { .. } => "0.5*(1 - q/0.25)*exp(-q/0.25)",
    };
    let kernel = Expression::parse(text, &["q"]).expect("a formula");
    Adhesion::new(&kernel, cut_off, layout.nodes()).expect("short derivatives")
}

/// The density that terms of one density act on.
fn last(layout: Layout) -> usize {
    layout.densities() - 1
}

fn bending_of_density(layout: Layout) -> Bending {
    let preferred = Expression::parse("1.3 - 2*rho + 0.4*rho^3", &["rho"]).expect("a formula");
    Bending::around_function(0.9, &preferred, last(layout), layout.nodes()).expect("short derivatives")
}

fn packing(layout: Layout) -> Packing {
    Packing::new(&[vec![1.4, 0.3], vec![0.3, 0.9]], 0.2, layout.nodes())
}

/// The agents of `scenes/three_fold.toml`.
fn agents(layout: Layout) -> Agents {
    let parse = |text| Expression::parse(text, &["kappa", "rho"]).expect("a formula");
    let lines = NodalLines {
        preferred_curvature: parse("1.3 - 2.0/0.76*(rho - 0.19)"),
        low_density: parse("0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)"),
        high_density: parse("0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)"),
    };
    Agents::new(last(layout), EPSILON, DELTA, &lines, layout.nodes()).expect("short derivatives")
}

/// A density is called `protein`, the first of two `lipid`.
fn local(text: &str, layout: Layout) -> Local {
    let densities = ["lipid", "protein"].into_iter().skip(2 - layout.densities());
    let names: Vec<&str> = std::iter::once("kappa").chain(densities).collect();
    let slopes: Vec<String> = names.iter().map(|name| format!("{name}_sigma")).collect();
    let variables: Vec<&str> = names.iter().copied().chain(slopes.iter().map(String::as_str)).collect();
    let expression = Expression::parse(text, &variables).expect("a formula");
    Local::new(&expression, names.len(), layout.nodes()).expect("short derivatives")
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
