//! The membrane that an incompressible curve stands for: its excess density and flux. See `THEORY.md`, eq. (F11).

use super::gradient_flow::GradientFlow;
use super::normal_mobility::MobilityError;
use crate::geometry::Complex64;
use crate::geometry::vectors::multiply;
use crate::operators::CurveHelmholtz;

/// Excess density and flux of the membrane at one state. Shapes: one value per node and per flux point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExcessDensity {
    /// ρ̄ = −H⁻¹(κf) at the nodes, f the force on the normal motion: ρ = 1 + ερ̄ in the limit ε → 0 of the penalised membrane.
    /// Has the unit of the force times length.
    pub density: Vec<f64>,
    /// −∇_sρ̄ at the flux points of the derivative family (the nodes for Fourier, else the midpoints), in the direction of
    /// the tangent. It balances local stretching: −∇_s of it is κ𝓘f. Has the unit of the force.
    pub flux: Vec<f64>,
}

impl GradientFlow {
    /// Excess density of the membrane and its flux at the nodal state `y`, for the force f of this flow, whatever its
    /// normal mobility.
    ///
    /// # Shapes
    /// `y`: a nodal state vector (see [`crate::geometry::Layout`]).
    /// # Errors
    /// [`MobilityError`] if the curve is not closed to the point that H = −`Δ_s` + κ² is singular.
    /// # Source
    /// `THEORY.md`, eq. (F11).
    pub fn excess_density(&mut self, y: &[f64]) -> Result<ExcessDensity, MobilityError> {
        self.dissipation_at(y);
        let (nodes, length) = (self.layout().nodes(), self.current().length());
        let kappa = self.current().at_nodes(0);
        let right: Vec<f64> = kappa.iter().zip(self.normal_force()).map(|(kappa, f)| -kappa * f).collect();
        let mut helmholtz = CurveHelmholtz::new(self.derivative(), nodes);
        helmholtz.set(self.current().grading(), kappa, length)?;
        let (mut density, mut flux) = (vec![0.0; nodes], vec![0.0; nodes]);
        helmholtz.solve(&right, &mut density);
        let mut spectrum = vec![Complex64::default(); self.layout().modes()];
        self.grid_mut().transform(&density, &mut spectrum);
        for (value, symbol) in spectrum.iter_mut().zip(self.derivative().to_flux()) {
            *value *= -symbol / length;
        }
        self.grid_mut().synthesise(&spectrum, &mut flux);
        if let Some(grading) = self.current().grading() {
            multiply(&mut flux, grading.inverse_at_midpoints());
        }
        Ok(ExcessDensity { density, flux })
    }
}
