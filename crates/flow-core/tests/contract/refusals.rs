//! What an operator cannot be asked for is a panic that says so, not a number or an index out of range.

use std::f64::consts::TAU;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use flow_core::energies::{Adhesion, Bending, CutOff, EnergyTerm, Fields, Local, Packing};
use flow_core::expression::Expression;
use flow_core::flow::{EnergySum, FlowMap, GradientFlow, Identity};
use flow_core::geometry::shapes::{Shape, ShapeError};
use flow_core::geometry::{
    CellList, Closure, Complex64, Embedding, Grading, Layout, PeriodicGrid, ScatteredPoints, SpectralLayout,
    enclosed_area, follow_scales,
};
use flow_core::operators::{CyclicBanded, Derivative, DerivativeFamily};
use flow_core::run::Interpolant;
use flow_core::run::scene::Formula;

/// Checks that a call panics with `message`.
pub fn panics(message: &str, call: impl FnOnce()) {
    let panic = catch_unwind(AssertUnwindSafe(call)).expect_err("a panic");
    let text = panic.downcast_ref::<String>().cloned();
    let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
    assert!(text.as_deref().is_some_and(|text| text.contains(message)), "{text:?}");
}

fn of_two() -> Expression {
    Expression::parse("1 + 0.1*x*y", &["x", "y"]).expect("a formula")
}

#[test]
fn formulas_of_a_second_variable() {
    let polar = Shape::Polar { r: of_two() };
    let parametric = Shape::Parametric { x: of_two(), y: Expression::constant(1.0) };
    for shape in [polar, parametric] {
        assert!(matches!(shape.length(), Err(ShapeError::OtherVariables { .. })));
        assert!(matches!(shape.resample(32), Err(ShapeError::OtherVariables { .. })));
    }
    panics("no function of q alone", || _ = Adhesion::new(&of_two(), CutOff::At(1.0), 32));
    panics("no function of one density", || _ = Bending::around_function(1.0, &of_two(), 0, 32));
    panics("no formula of one variable", || {
        _ = Formula::parse("x*y", &["x", "y"]).unwrap().values(&[1.0]);
    });
    panics("at most 8 fields", || _ = Local::new(&of_two(), 9, 32));
    let of_three = Expression::parse("x + z", &["x", "y", "z"]).unwrap();
    panics("3 variables on 1 fields", || _ = Local::new(&of_three, 1, 32));
    panics("must be positive", || _ = Packing::new(&[vec![1.0]], 0.0, 32));
}

#[test]
fn fields_and_points_of_other_numbers() {
    panics("one node at least", || _ = Fields::new(0, &[]));
    panics("one node at least", || _ = Fields::new(3, &[0.0; 4]));
    panics("field 2 of 2", || _ = Fields::new(2, &[0.0; 4]).get(2));
    panics("as many points", || CellList::new(4).sort([&[0.0; 3], &[0.0; 3]], 1.0));
    // Before they are sorted the points are all near each other.
    assert_eq!(CellList::new(4).later_neighbours(1)[0], 2..4);
}

#[test]
fn scales_that_are_none() {
    let half = [0.0, 0.5];
    panics("a grading of 0 nodes", || _ = follow_scales(&half, &[1.0; 2], 0));
    panics("by 0 fractions", || _ = follow_scales(&[], &[], 16));
    panics("one wave number per fraction", || _ = follow_scales(&half, &[1.0; 3], 16));
    for wave in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        panics("positive and finite", || _ = follow_scales(&half, &[1.0, wave], 16));
    }
}

#[test]
fn bands_that_are_none() {
    panics("diagonal", || _ = CyclicBanded::<0>::new(8));
    panics("needs 6 rows", || _ = CyclicBanded::<2>::new(5));
    let mut matrix = CyclicBanded::<2>::new(12);
    panics("offset -3 in row 4", || matrix.set(4, -3, 1.0));
    panics("offset 0 in row 12 of 12", || matrix.set(12, 0, 1.0));
    matrix.set(11, 2, 1.0);
    panics("in a row of 12", || matrix.set_row(12, 0, &[1.0]));
    panics("1 entries from offset -3", || matrix.set_row(4, -3, &[1.0]));
    panics("4 entries from offset 0", || matrix.set_row(4, 0, &[1.0; 4]));
    panics("1 entries from offset 3", || matrix.set_rows(0, 3, &[[1.0; 8]]));
    panics("in a row of 12", || matrix.set_rows(12, 0, &[[1.0; 8]]));
    matrix.set_row(11, -2, &[1.0; 5]);
}

#[test]
fn bands_whose_entries_are_gone_or_that_have_no_factors() {
    let mut x = [6.0; 12];
    let mut matrix = CyclicBanded::<1>::new(12);
    (0..12).for_each(|row| matrix.set_row(row, -1, &[1.0, 4.0, 1.0]));
    panics("is not factorised", || matrix.solve(&mut x));
    matrix.factorise().unwrap();
    panics("clear it", || _ = matrix.factorise());
    panics("clear it", || matrix.set(3, 0, 4.0));
    panics("clear it", || matrix.set_row(3, -1, &[1.0, 4.0, 1.0]));
    panics("clear it", || matrix.set_rows(0, 0, &[[4.0; 8]]));
    matrix.solve(&mut x);
    assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-14), "the refused calls changed nothing: {x:?}");
    matrix.clear();
    matrix.factorise().expect_err("a zero matrix");
    panics("or that failed", || matrix.solve(&mut x));
    panics("clear it", || _ = matrix.factorise());
}

#[test]
fn spectra_of_other_grids() {
    let spectrum = vec![Complex64::default(); 9];
    panics("the grid of the projection", || {
        _ = Closure::new(32).project(&mut spectrum.clone(), TAU, 1, 0.0);
    });
    panics("the coefficients of 32 nodes", || _ = ScatteredPoints::new(32, &[0.25]).values(&spectrum));
    let mut wave = vec![Complex64::default(); 17];
    wave[1] = Complex64::new(0.5, 0.0);
    let values = ScatteredPoints::new(32, &[0.0, f64::NAN, f64::INFINITY, 0.5]).values(&wave);
    assert!((values[0] - 1.0).abs() < 1e-12 && (values[3] + 1.0).abs() < 1e-12, "{values:?}");
    assert!(values[1].is_nan() && values[2].is_nan(), "{values:?}");
}

#[test]
fn values_of_other_grids() {
    let (mut grid, zero) = (PeriodicGrid::new(8), Complex64::default());
    panics("nodal values and Fourier", || grid.transform(&[0.0; 7], &mut [zero; 5]));
    panics("nodal values and Fourier", || grid.synthesise(&[zero; 4], &mut [0.0; 8]));
    for modes in [0, 2, 6] {
        panics("coefficients of the grid", || grid.integrate(&mut vec![zero; modes]));
    }
    panics("coefficients of the turning", || Embedding::new(8).set_tangent_spectrum(&[zero; 4], TAU, 0.0));
    let (long, short) = ([0.0; 8].as_slice(), [0.0; 7].as_slice());
    panics("one value per node", || _ = enclosed_area([short, long], [long, long], TAU));
    panics("one value per node", || _ = enclosed_area([long, long], [long, short], TAU));
    panics("4 nodes, fewer than 8", || _ = Interpolant::new(long).slopes(4));
}

#[test]
fn grids_that_do_not_fit() {
    let (grid, family) = (PeriodicGrid::new(32), DerivativeFamily::Fourier);
    let derivative = Derivative::new(family, &grid);
    let bending = || -> Vec<Box<dyn EnergyTerm>> { vec![Box::new(Bending::new(1.0))] };
    panics("as many nodes", || _ = FlowMap::new(Layout::new(64, 0), &grid, &derivative));
    // As many modes.
    let other = Derivative::new(family, &PeriodicGrid::new(33));
    panics("[32, 32, 33]", || _ = FlowMap::new(Layout::new(32, 0), &grid, &other));
    panics("[32, 32, 33]", || _ = EnergySum::new(bending(), Layout::new(32, 0), &grid, &other));
    let map = FlowMap::new(Layout::new(32, 1), &grid, &derivative);
    let energy = EnergySum::new(bending(), Layout::new(32, 1), &grid, &derivative);
    panics("those of the flow", || {
        _ = GradientFlow::new(map, energy, Layout::new(32, 0), Box::new(Identity), Vec::new());
    });
    let grading = Some(Arc::new(Grading::uniform(16)));
    panics("the 32 of the grid", || _ = Derivative::graded(family, &grid, grading.clone()));
    panics("the 32 of the grid", || _ = Derivative::staggered(family, &grid, grading.clone()));
}

fn bending_flow(layout: Layout) -> GradientFlow {
    let grid = PeriodicGrid::new(layout.nodes());
    let derivative = Derivative::new(DerivativeFamily::Fourier, &grid);
    let energy = EnergySum::new(vec![Box::new(Bending::new(1.0))], layout, &grid, &derivative);
    let map = FlowMap::new(layout, &grid, &derivative);
    GradientFlow::new(map, energy, layout, Box::new(Identity), Vec::new())
}

#[test]
fn nodal_vectors_for_spectral_ones_and_the_other_way_round() {
    for nodes in [32, 33] {
        let layout = Layout::new(nodes, 0);
        let (mut flow, nodal) = (bending_flow(layout), layout.assemble(&vec![1.0; nodes], &[], TAU));
        let spectral_layout = SpectralLayout::new(layout);
        let mut spectral = vec![0.0; spectral_layout.len()];
        spectral_layout.encode(flow.grid_mut(), &nodal, &mut spectral);
        let mut out = spectral.clone();
        panics("nodal vector", || _ = flow.energy_at(&spectral));
        panics("nodal vector", || _ = flow.check_derivatives(&spectral));
        panics("nodal vector", || flow.linearise(&spectral));
        panics("nodal vector", || flow.decode(&spectral, &mut out));
        panics("spectral vector", || _ = flow.spectral_gradient(&nodal));
        panics("spectral vector", || _ = flow.spectral_rate(&nodal, &mut out));
        panics("spectral vector", || flow.spectral_linearise(&nodal));
        out.push(0.0);
        panics("spectral vector", || _ = flow.spectral_rate(&spectral, &mut out));
        flow.spectral_linearise(&spectral);
        panics("spectral vector", || flow.spectral_hessian_product(&nodal));
        panics("spectral vector", || flow.spectral_mobility(&nodal, &mut spectral.clone()));
        panics("nodal vector", || flow.hessian_product(&spectral, &mut nodal.clone()));
    }
}

#[test]
fn products_without_a_linearisation() {
    let layout = Layout::new(32, 0);
    let mut flow = bending_flow(layout);
    let (state, mut out) = (layout.assemble(&[1.0; 32], &[], TAU), vec![0.0; layout.len()]);
    panics("there is none", || flow.jacobian_product(&state, &mut out));
    panics("there is none", || flow.hessian_product(&state, &mut out));
    panics("there is none", || flow.apply_mobility(&state, &mut out));
    flow.linearise(&state);
    flow.jacobian_product(&state, &mut out);
}
