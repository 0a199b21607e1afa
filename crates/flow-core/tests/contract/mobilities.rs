//! Every mobility.

use flow_core::flow::{
    AreaPreserving, Carried, DensityMobility, Diffusion, Exchange, GradientFlow, Identity, Incompressible,
    IncompressibleAreaPreserving, NormalMobility, SurfaceDiffusion, WeightedDiffusion,
};
use flow_core::geometry::PeriodicGrid;
use flow_core::operators::Derivative;

/// A normal mobility.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normal {
    Identity,
    Incompressible,
    AreaPreserving,
    IncompressibleAreaPreserving,
    SurfaceDiffusion,
}

impl Normal {
    /// Every normal mobility.
    pub const ALL: [Self; 5] = [
        Self::Identity,
        Self::Incompressible,
        Self::AreaPreserving,
        Self::IncompressibleAreaPreserving,
        Self::SurfaceDiffusion,
    ];

    /// Whether 𝓑1 = 0.
    pub fn keeps_area(self) -> bool {
        matches!(self, Self::AreaPreserving | Self::IncompressibleAreaPreserving | Self::SurfaceDiffusion)
    }

    pub fn build(self, grid: &PeriodicGrid, derivative: &Derivative) -> Box<dyn NormalMobility> {
        let nodes = grid.nodes();
        match self {
            Self::Identity => Box::new(Identity),
            Self::Incompressible => Box::new(Incompressible::new(derivative, nodes)),
            Self::AreaPreserving => Box::new(AreaPreserving),
            Self::IncompressibleAreaPreserving => {
                Box::new(IncompressibleAreaPreserving::new(derivative, nodes))
            }
            Self::SurfaceDiffusion => Box::new(SurfaceDiffusion::new(grid, derivative)),
        }
    }
}

/// Rate of the area at the state evaluated last, per length: of that of the grid where the flow keeps it.
pub fn area_rate(flow: &mut GradientFlow) -> f64 {
    match flow.area_force().map(<[f64]>::to_vec) {
        Some(force) => flow.current().mean_of_product(flow.normal_velocity(), &force),
        None => flow.current().mean(flow.normal_velocity()),
    }
}

/// A density mobility.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Density {
    Diffusion,
    Weighted,
    Exchange,
    Carried,
}

impl Density {
    /// Every density mobility.
    pub const ALL: [Self; 4] = [Self::Diffusion, Self::Weighted, Self::Exchange, Self::Carried];

    /// The two that follow each other at `index`, for two densities.
    pub fn two(index: usize) -> [Self; 2] {
        [Self::ALL[index % 4], Self::ALL[(index + 1) % 4]]
    }

    pub fn build(self, grid: &PeriodicGrid, derivative: &Derivative) -> Box<dyn DensityMobility> {
        match self {
            Self::Diffusion => Box::new(Diffusion::new(grid, derivative)),
            Self::Weighted => {
                let weight = |s: &f64| 1.0 + 0.8 * (std::f64::consts::TAU * s).cos();
                let points = WeightedDiffusion::flux_points(grid, derivative);
                Box::new(WeightedDiffusion::new(grid, derivative, points.iter().map(weight).collect()))
            }
            Self::Exchange => Box::new(Exchange::new(grid, derivative)),
            Self::Carried => Box::new(Carried),
        }
    }
}
