//! The gradient flow dX/dt = −`𝓚(X)∇𝓕_h` with 𝓚 = `A𝓑Aᵀ` + 𝓖. See `THEORY.md`, section 4.

mod curve_fields;
mod density_mobility;
mod energy_sum;
mod excess_density;
mod flow_map;
mod gauge;
mod graded_energy;
mod gradient_flow;
mod intrinsic_gradient;
mod moving_metric_energy;
mod nodal;
mod nodal_curve;
mod nodal_error;
mod normal_mobility;
mod preconditioner;
mod regrade;
mod scales;
mod shape_energy;
mod slope_energy;

pub use curve_fields::CurveFields;
pub use density_mobility::{Carried, DensityMobility, Diffusion, Exchange, WeightedDiffusion};
pub use energy_sum::{EnergySum, NotFinite, TermCost, TermPart, TermPlace, UndeclaredPart};
pub use excess_density::ExcessDensity;
pub use flow_map::FlowMap;
pub use gauge::{CoMoving, Gauge, Graded, MetricRole, ScaledArcLength, Workspace};
pub use gradient_flow::{DerivativeErrors, EvaluationCost, GradientFlow, PartCosts, Rate};
pub use intrinsic_gradient::IntrinsicGradient;
pub use nodal_curve::{NodalCurve, NodalRates};
pub(crate) use nodal_curve::{check, nodal_state};
pub use nodal_error::NodalError;
pub use normal_mobility::{
    AreaPreserving, Identity, Incompressible, IncompressibleAreaPreserving, Kept, MobilityError,
    NormalMobility, SurfaceDiffusion,
};
pub use preconditioner::{LinearSolver, Preconditioner, ResidualWeights, mobility_symbol};
pub use regrade::{Regraded, Regrading, regrade};
pub use scales::local_wave_numbers;
