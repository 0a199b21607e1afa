//! What a frame holds on request, and how near a stiff membrane is to an incompressible one.

use super::energy_density::EnergyDensity;
use super::energy_terms::{Initial, energy_terms};
use super::scene::{DensityMobility, NormalMobility, OutputField, Scene};
use super::setup_error::SetupError;
use super::term_parts::TermParts;
use crate::flow::{Carried, EnergySum, ExcessDensity, FlowMap, GradientFlow, Incompressible};
use crate::geometry::{Complex64, Layout, PeriodicGrid};
use crate::operators::{Derivative, Helmholtz};

/// Names of the values per frame of a scene with a membrane term.
const OF_THE_MEMBRANE: [&str; 2] = ["incompressible_distance", "velocity_residual"];

/// Evaluates the fields that the scene asks for, and the values per frame that come with a membrane term.
#[derive(Debug)]
pub struct Diagnostics {
    fields: Vec<OutputField>,
    energy_density: Option<EnergyDensity>,
    parts: TermParts,
    /// The flow of the energy without the membrane term, made incompressible.
    incompressible: Option<GradientFlow>,
    membrane: Option<MembraneTerm>,
    /// Takes the flux from its points to the nodes, where frames have their fields, unless these are its points.
    to_nodes: Option<FluxPoints>,
}

/// The way from the flux points halfway between the nodes back to them.
#[derive(Debug)]
struct FluxPoints {
    grid: PeriodicGrid,
    spectrum: Vec<Complex64>,
}

impl FluxPoints {
    fn at_nodes(&mut self, field: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; field.len()];
        self.grid.transform(field, &mut self.spectrum);
        for (mode, value) in self.spectrum.iter_mut().enumerate() {
            *value *= self.grid.half_step(mode).conj();
        }
        self.grid.synthesise(&self.spectrum, &mut out);
        out
    }
}

/// The membrane term of a scene.
#[derive(Clone, Copy, Debug)]
struct MembraneTerm {
    density: usize,
    epsilon: f64,
}

/// Fields and values of one frame, in the order of their names.
#[derive(Clone, Debug, Default)]
pub struct Evaluated {
    /// One field per name of [`Diagnostics::field_names`].
    pub fields: Vec<Vec<f64>>,
    /// One value per name of [`Diagnostics::value_names`].
    pub values: Vec<f64>,
}

impl Diagnostics {
    /// What `scene` asks for, on states of `layout`.
    ///
    /// # Errors
    /// [`SetupError::TooFewNodesForField`] if H = −`Δ_s` + κ² cannot be inverted on so few nodes.
    pub(super) fn new(
        scene: &Scene,
        initial: &Initial,
        layout: Layout,
        derivative: &Derivative,
    ) -> Result<Self, SetupError> {
        let nodes = layout.nodes();
        let fields = scene.output.fields.clone();
        let enough = nodes >= Helmholtz::FEWEST_NODES;
        let of_helmholtz = [OutputField::ExcessDensity, OutputField::MembraneFlux];
        let asked = fields.iter().find(|field| of_helmholtz.contains(field));
        if let Some(field) = asked.filter(|_| !enough) {
            let (field, fewest) = (field.name(), Helmholtz::FEWEST_NODES);
            return Err(SetupError::TooFewNodesForField { field, nodes, fewest });
        }
        let membrane = membrane_term(scene).filter(|_| enough);
        let base = (asked.is_some() || membrane.is_some())
            .then(|| incompressible(scene, initial, layout, derivative));
        let density =
            fields.contains(&OutputField::EnergyDensity).then(|| energy_terms(scene, initial, nodes));
        let to_nodes = derivative.interpolation().map(|_| {
            let grid = PeriodicGrid::new(nodes);
            FluxPoints { spectrum: vec![Complex64::default(); grid.modes()], grid }
        });
        Ok(Self {
            to_nodes,
            parts: TermParts::new(scene, initial, layout, derivative)?,
            energy_density: density.transpose()?.map(|terms| EnergyDensity::new(terms, layout)),
            incompressible: base.transpose()?,
            membrane,
            fields,
        })
    }

    /// Names of the fields, in the order of the scene: its choices, spelled as the other names of a record are.
    #[must_use]
    pub fn field_names(&self) -> Vec<String> {
        let names = |field: &OutputField| match field {
            OutputField::EnergyDensities | OutputField::NormalVelocities => self.parts.names(*field),
            _ => vec![field.name().replace('-', "_")],
        };
        self.fields.iter().flat_map(names).collect()
    }

    /// Names of the values per frame.
    #[must_use]
    pub fn value_names(&self) -> Vec<String> {
        self.membrane.map_or_else(Vec::new, |_| OF_THE_MEMBRANE.map(str::to_owned).to_vec())
    }

    /// All of it at the nodal state `y`, which `flow` evaluated last.
    pub fn at(&mut self, flow: &mut GradientFlow, y: &[f64]) -> Evaluated {
        let nodes = flow.layout().nodes();
        let undefined = || vec![f64::NAN; nodes];
        // H has no inverse on a straight line only, which no closed curve is.
        let excess = self.incompressible.as_mut().map(|base| {
            let missing = |_| ExcessDensity { density: undefined(), flux: undefined() };
            base.excess_density(y).unwrap_or_else(missing)
        });
        let excess = excess.unwrap_or_default();
        let values =
            self.membrane.map_or_else(Vec::new, |term| self.of_the_membrane(term, flow, &excess.density));
        let mut fields = Vec::new();
        for field in &self.fields {
            fields.push(match field {
                OutputField::EnergyDensities => {
                    fields.extend(self.parts.densities(flow.current()));
                    continue;
                }
                OutputField::NormalVelocities => {
                    fields.extend(self.parts.velocities(y));
                    continue;
                }
                OutputField::NormalForce => flow.whole_normal_force(y),
                OutputField::TangentialVelocity => {
                    let mut w = vec![0.0; nodes];
                    flow.tangential_velocity(&mut w);
                    w
                }
                OutputField::ExcessDensity => excess.density.clone(),
                OutputField::MembraneFlux => match &mut self.to_nodes {
                    Some(flux_points) => flux_points.at_nodes(&excess.flux),
                    None => excess.flux.clone(),
                },
                OutputField::EnergyDensity => {
                    self.energy_density.as_mut().map_or_else(undefined, |density| density.at(flow.current()))
                }
            });
        }
        Evaluated { fields, values }
    }

    /// ‖ρ − 1 − ερ̄‖ and ‖V − 𝓘V̂‖ in L²(dσ).
    fn of_the_membrane(&self, term: MembraneTerm, flow: &GradientFlow, excess: &[f64]) -> Vec<f64> {
        let at = flow.current();
        let rho = at.at_nodes(1 + term.density);
        let off = rho.iter().zip(excess).map(|(rho, excess)| rho - 1.0 - term.epsilon * excess);
        let limit = self.incompressible.as_ref().map_or(&[][..], GradientFlow::normal_velocity);
        let residual = flow.normal_velocity().iter().zip(limit).map(|(v, limit)| v - limit);
        let norm = |values: Vec<f64>| (at.length() * at.mean_of_product(&values, &values)).sqrt();
        vec![norm(off.collect()), norm(residual.collect())]
    }
}

/// The membrane term, if it becomes incompressibility as ε → 0: under the L² flow and plain diffusion.
fn membrane_term(scene: &Scene) -> Option<MembraneTerm> {
    let term = scene.energy.membrane.as_ref()?;
    let density = scene.density.iter().position(|density| density.name == term.density)?;
    let plain = scene.flow.normal_mobility == NormalMobility::Identity
        && scene.density[density].mobility == DensityMobility::Diffusion
        && scene.density[density].weight.is_none();
    plain.then_some(MembraneTerm { density, epsilon: term.epsilon })
}

fn incompressible(
    scene: &Scene,
    initial: &Initial,
    layout: Layout,
    derivative: &Derivative,
) -> Result<GradientFlow, SetupError> {
    let mut base = scene.clone();
    base.energy.membrane = None;
    let grid = PeriodicGrid::new(layout.nodes());
    let terms = energy_terms(&base, initial, layout.nodes())?;
    let energy = EnergySum::new(terms, layout, &grid, derivative);
    let map = FlowMap::in_gauge(scene.flow.gauge.rule(), layout, &grid, derivative);
    let normal = Box::new(Incompressible::new(derivative, layout.nodes()));
    let densities = (0..layout.densities()).map(|_| Box::new(Carried) as _).collect();
    Ok(GradientFlow::new(map, energy, layout, normal, densities))
}
