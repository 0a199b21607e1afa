//! Makes the frames of a record from states.

use serde::{Deserialize, Serialize};

use super::discretised::Discretised;
use crate::flow::Rate;
use crate::geometry::{StateRef, enclosed_area};
use crate::integrator::{DISSIPATED, Finish, INTEGRALS, Problem};
use crate::run::diagnostics::Evaluated;
use crate::run::membrane::{ANGLE, CENTRE};
use crate::run::record::Frame;

impl Discretised {
    /// Evaluates all that a frame holds, for the spectral state in the scratch, which is closed in place.
    ///
    /// `integrals` are those carried along, less their start values; `start` holds the energy and the placement at
    /// time 0. Without a `closure_defect` it is that of the state.
    pub fn frame(
        &mut self,
        time: f64,
        integrals: [f64; INTEGRALS],
        start: &Start,
        closure_defect: Option<f64>,
    ) -> Frame {
        let Self { membrane, diagnostics, scratch: y, .. } = self;
        let angle = start.angle + integrals[ANGLE];
        // An interpolated state is closed to the tolerance; the projection takes the rest.
        let finish = membrane.finish(time, y);
        let closure_defect = closure_defect.unwrap_or_else(|| membrane.closure_defect());
        let layout = membrane.layout();
        // A state that was finished has been evaluated; one that is not finite is shown as it is.
        let rate = match finish {
            Finish::Good { energy, integral_rates } => {
                Rate { energy, dissipation: integral_rates[DISSIPATED] }
            }
            Finish::NotFinite => membrane.flow().spectral_dissipation(y),
        };
        let normal_velocity = membrane.flow().normal_velocity().to_vec();
        let at = membrane.flow().current();
        let pointwise: Vec<Vec<f64>> =
            (0..layout.fields()).map(|field| at.at_nodes(field).to_vec()).collect();
        let weight = at.weight().map_or_else(|| vec![1.0; layout.nodes()], <[f64]>::to_vec);
        let energy_terms = membrane.flow().current_energies_by_term();
        let mut nodal = vec![0.0; layout.len()];
        membrane.flow().decode(y, &mut nodal);
        let Evaluated { fields, values } = diagnostics.at(membrane.flow(), &nodal);
        let state = StateRef::new(layout, &nodal);
        let length = state.length();
        let mut centre = start.centre;
        for (centre, moved) in centre.iter_mut().zip(&integrals[CENTRE]) {
            *centre += moved;
        }
        let (embedding, crossings) = membrane.embedding_and_crossings();
        embedding.set_tangent(state.turning_per_parameter(), length, angle);
        embedding.set_position(length, centre);
        let position = embedding.position();
        Frame {
            time,
            energy: rate.energy,
            energy_terms,
            dissipation: rate.dissipation,
            energy_balance: rate.energy - start.energy + integrals[DISSIPATED],
            remap_error: start.remap_error,
            length,
            area: enclosed_area(position, embedding.tangent(), length),
            mass: (0..layout.densities()).map(|density| state.mass(density)).collect(),
            closure_defect,
            crossings: crossings.count(position) as f64,
            curvature: pointwise[0].clone(),
            metric: weight.iter().map(|weight| length * weight).collect(),
            position: position[0].iter().zip(position[1]).map(|(x, y)| [*x, *y]).collect(),
            normal_velocity,
            density: pointwise[1..].to_vec(),
            fields,
            diagnostics: values,
        }
    }
}

/// What the integrals start from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// Energy at time 0.
    pub energy: f64,
    /// Mean tangent angle at time 0.
    pub angle: f64,
    /// Mean position at time 0.
    pub centre: [f64; 2],
    /// Energy added by remaps since.
    pub remap_error: f64,
}
