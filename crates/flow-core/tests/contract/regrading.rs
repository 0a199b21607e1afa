//! From one grading to another.

use flow_core::flow::regrade;
use flow_core::geometry::{Grading, Layout};
use flow_core::operators::DerivativeFamily;

use crate::gauges::grading;
use crate::mobilities::{Density, Normal};
use crate::states::{fixed_blob, spectral};
use crate::terms::{Term, flow_on};
use crate::vectors::{distance, largest};

/// To other nodes and back: masses and turning are kept to rounding, the energy to the order of the family.
#[test]
fn regrading_changes_the_energy_by_the_order_of_the_discretisation() {
    let blob = fixed_blob();
    for family in DerivativeFamily::ALL {
        let errors = [96, 192, 384].map(|nodes| {
            let state = blob.state(nodes, 2);
            // A number of nodes of its own, too.
            let (grading, other) = (grading(nodes + 8), Layout::new(nodes + 8, 2));
            let build = |grading: Option<&Grading>, layout: Layout| {
                let densities = [Density::Diffusion; 2];
                flow_on(grading, Term::Everything.build(layout), family, layout, Normal::Identity, &densities)
            };
            let (mut uniform, mut graded) = (build(None, state.layout), build(Some(&grading), other));
            let y = spectral(state.layout, &state.y);
            let there = regrade(&mut uniform, &mut graded, &y, 1).expect("a closed curve");
            let back = regrade(&mut graded, &mut uniform, &there.state, 1).expect("a closed curve");
            let (old, new) = (uniform.spectral_layout(), graded.spectral_layout());
            for field in 0..3 {
                let [a, b] = [y[old.field(field).start], there.state[new.field(field).start]];
                assert!((a - b).abs() <= 1e-14 * a.abs(), "{family:?}: {a} ≠ {b}");
            }
            let energy = uniform.spectral_gradient(&y);
            let error = distance(&back.state, &y) / largest(&y);
            println!(
                "{family:?}, n = {nodes}: energy {:.1e} there, {:.1e} back, state {error:.1e}",
                there.energy_error / energy,
                back.energy_error / energy
            );
            assert!(nodes < 384 || error < 1e-9, "{family:?}: {error:.1e}");
            (there.energy_error / energy).abs()
        });
        let order = family.order().unwrap_or(8);
        let bound = (4.0 * 0.5_f64.powi(order) * errors[1]).max(1e-10);
        assert!(errors[2] <= bound, "{family:?}: {errors:?}");
    }
}
