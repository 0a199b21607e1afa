//! Every combination of energy, mobilities and gauge that a scene accepts obeys the laws, and the others are refused with the
//! reason.

mod laws;
mod table;

use flow_core::run::Scene;
use flow_core::run::scene::Fault;
use proptest::prelude::*;

use crate::config;
use crate::states::{Blob, any_blob};
use laws::Flowing;
use table::{Combination, WEIGHTED, all};

/// As in `dissipation.rs` and `mobility_laws.rs`.
const RELATIVE: f64 = 1e-11;
const OF_THE_NORMS: f64 = 1e-14;
const ROUNDING: f64 = 1e-12;
/// Rounding under six derivatives on 64 nodes, (πn/|Γ|)⁶ ε, relative to the largest rate or, where forces have no effect, force.
const SYMMETRY: f64 = 1e-6;
/// Error of the closure on 64 nodes.
const CLOSED: f64 = 1e-4;
/// Error of the discretisation on 192 nodes in the energy, and in the dissipation: surface diffusion of what the agents make of
/// their nodal lines, which are exponentials of κ, is the hardest.
const ENERGY_RESOLVED: f64 = 1e-6;
const DISSIPATION_RESOLVED: f64 = 1e-2;

/// The curve of a blob as the lines of a scene.
fn polar(blob: &Blob) -> String {
    format!("shape = \"polar\"\nr = \"{}\"", blob.radius_formula())
}

/// The same, turned by `angle` and moved.
fn displaced(blob: &Blob, angle: f64) -> String {
    let (r, [c, s]) = (blob.radius_formula(), [angle.cos(), angle.sin()]);
    format!(
        "shape = \"parametric\"\nx = \"({r})*(({c:?})*cos(phi) - ({s:?})*sin(phi)) + 0.7\"\n\
         y = \"({r})*(({s:?})*cos(phi) + ({c:?})*sin(phi)) - 1.3\""
    )
}

fn flowing(row: Combination, blob: &Blob, curve: &str, nodes: usize) -> Flowing {
    Flowing::new(&row.scene(curve, &blob.density_formulas(), nodes))
}

proptest! {
    #![proptest_config(config(2))]

    /// d𝓕/dt = ⟨∇𝓕, rate⟩ = −dissipation ≤ 0, 𝓚 symmetric and ≥ 0, masses and turning number, length and area where they are
    /// kept, closure.
    #[test]
    fn the_laws_hold_for_every_combination(blob in any_blob(), seed: u64, odd: bool) {
        let nodes = if odd { 65 } else { 64 };
        for row in all().filter(|row| row.refusal().is_none()) {
            let mut flow = flowing(row, &blob, &polar(&blob), nodes);
            let balance = flow.balance();
            let bound = RELATIVE * balance.dissipation + OF_THE_NORMS * balance.norms;
            prop_assert!((balance.energy_rate + balance.dissipation).abs() <= bound, "{row:?}: {balance:?}");
            // What holds the area takes away all of a pressure, up to the rounding of the pressure itself.
            let least = -OF_THE_NORMS * (balance.norms + balance.force_square);
            prop_assert!(balance.dissipation >= least, "{row:?}: {balance:?}");
            let mobility = flow.mobility(seed);
            prop_assert!(mobility.asymmetry <= ROUNDING, "{row:?}: asymmetry {:.1e}", mobility.asymmetry);
            prop_assert!(mobility.square >= 0.0, "{row:?}: ⟨a, 𝓚a⟩ = {:.1e}", mobility.square);
            let kept = flow.kept();
            prop_assert!(kept.turning <= 1e-15, "{row:?}: {kept:?}");
            for mass in kept.masses {
                prop_assert!(mass <= 1e-15 || row.density_mobility == "exchange", "{row:?}: {kept:?}");
            }
            let (length, area) = (kept.length.unwrap_or(0.0), kept.area.unwrap_or(0.0));
            prop_assert!(length <= ROUNDING && area <= ROUNDING, "{row:?}: {kept:?}");
            prop_assert_eq!(kept.length.is_some(), row.normal_mobility.starts_with("incompressible"));
            prop_assert!(kept.gap <= CLOSED, "{row:?}: the curve opens at {:.1e}", kept.gap);
        }
    }

    /// Energy, dissipation and rates do not see where the curve lies, nor, where nothing else does, which node is the first.
    #[test]
    fn every_combination_has_the_symmetries(blob in any_blob(), angle in 0.0_f64..6.0, shift in 1_usize..60) {
        for row in all().filter(|row| row.refusal().is_none()) {
            let mut plain = flowing(row, &blob, &polar(&blob), 64);
            let mut moved = flowing(row, &blob, &displaced(&blob, angle), 64);
            let (here, there) = (plain.balance(), moved.balance());
            prop_assert!((here.energy - there.energy).abs() <= 1e-12 * here.energy.abs(), "{row:?}: {here:?}, {there:?}");
            let error = plain.distance(&moved);
            prop_assert!(error <= SYMMETRY, "{row:?}: displaced, the rates differ by {error:.1e}");
            if row.forgets_the_first_node() {
                let (energy, error) = plain.shifted(shift);
                prop_assert!(energy <= 1e-13 && error <= SYMMETRY, "{row:?}: shifted: {energy:.1e}, {error:.1e}");
            }
        }
    }

    /// Energy and dissipation do not depend on the gauge.
    #[test]
    fn no_combination_sees_its_gauge(blob in any_blob()) {
        for row in all().filter(|row| row.gauge == "scaled-arc-length") {
            let reference = flowing(row, &blob, &polar(&blob), 192).balance();
            for gauge in ["graded", "co-moving"] {
                let other = Combination { gauge, ..row };
                if other.refusal().is_some() {
                    continue;
                }
                let balance = flowing(other, &blob, &polar(&blob), 192).balance();
                let energy = (balance.energy - reference.energy).abs() / reference.energy.abs();
                let scale = reference.dissipation + reference.force_square;
                let dissipation = (balance.dissipation - reference.dissipation).abs() / scale;
                prop_assert!(energy <= ENERGY_RESOLVED && dissipation <= DISSIPATION_RESOLVED, "{other:?}: {energy:.1e}, {dissipation:.1e}");
            }
        }
    }
}

/// What makes no sense together is refused with its reason, whatever the energy; from the start or after a switch.
#[test]
fn what_makes_no_sense_together_is_refused_with_the_reason() {
    let densities = ["0.5", "0.4"].map(str::to_owned);
    let (mut accepted, mut refused) = (0, 0);
    for row in all() {
        let text = row.scene("shape = \"circle\"\nradius = 1.0", &densities, 64);
        match (row.refusal(), Scene::parse(&text, "table")) {
            (None, Ok(_)) => accepted += 1,
            (Some(reason), Err(error)) => {
                let message = error.to_string();
                assert!(message.contains(reason), "{row:?}: {message}");
                assert!(matches!(error.problems()[0].fault, Fault::Conflict { with: "density.weight", .. }));
                refused += 1;
            }
            (_, Ok(_)) => panic!("{row:?} must be refused"),
            (_, Err(error)) => panic!("{row:?} must not be refused: {error}"),
        }
        if row.density_mobility == WEIGHTED && row.refusal().is_none() {
            let later = format!("{text}[[flow.switch]]\ntime = 0.5\ngauge = \"co-moving\"\n");
            assert!(Scene::parse(&later, "table").is_err(), "{row:?}, switched");
        }
    }
    assert_eq!((accepted, refused), (880, 80));
}

/// A weight weighs a diffusion and nothing else.
#[test]
fn a_weight_of_what_does_not_diffuse_is_refused_with_the_reason() {
    for mobility in ["exchange", "none"] {
        for row in all().filter(|row| row.density_mobility == mobility) {
            let text = row.scene("shape = \"circle\"\nradius = 1.0", &["0.5", "0.4"].map(str::to_owned), 64);
            let name = format!("mobility = \"{mobility}\"");
            let weighted = text.replace(&name, &format!("{name}\nweight = \"1 + 0.5*cos(2*pi*s)\""));
            let message = Scene::parse(&weighted, "table").expect_err("a weight").to_string();
            assert!(
                message.contains("drop the weight, or use mobility = \"diffusion\""),
                "{row:?}: {message}"
            );
        }
    }
}
