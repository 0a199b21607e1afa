//! Every tableau meets the conditions of the order that it claims.

use curveflow_benches::rivals::tableau::{ESDIRK43, ROS34PW2};
use nalgebra::{DMatrix, DVector};

fn matrix(rows: &[&[f64]], diagonal: f64) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| {
        rows[i].get(j).copied().unwrap_or(if i == j { diagonal } else { 0.0 })
    })
}

fn check(name: &str, conditions: &[(f64, f64)]) {
    for (index, (value, expected)) in conditions.iter().enumerate() {
        assert!((value - expected).abs() < 1e-14, "{name}, condition {index}: {value} ≠ {expected}");
    }
}

/// Conditions on the weights `b` of a Runge–Kutta method up to `order` ≤ 4.
fn runge_kutta(a: &DMatrix<f64>, b: &DVector<f64>, order: usize) -> Vec<(f64, f64)> {
    let c = a.column_sum();
    let square = c.component_mul(&c);
    let mut conditions = vec![(b.sum(), 1.0), (b.dot(&c), 0.5)];
    if order >= 3 {
        conditions.extend([(b.dot(&square), 1.0 / 3.0), (b.dot(&(a * &c)), 1.0 / 6.0)]);
    }
    if order >= 4 {
        conditions.extend([
            (b.dot(&square.component_mul(&c)), 0.25),
            (b.dot(&c.component_mul(&(a * &c))), 0.125),
            (b.dot(&(a * &square)), 1.0 / 12.0),
            (b.dot(&(a * (a * &c))), 1.0 / 24.0),
        ]);
    }
    conditions
}

/// Conditions of a Rosenbrock method with any matrix up to `order` ≤ 3: those of the explicit part, and every
/// tree with an implicit edge sums to zero.
fn rosenbrock_w(
    alpha: &DMatrix<f64>,
    gamma: &DMatrix<f64>,
    b: &DVector<f64>,
    order: usize,
) -> Vec<(f64, f64)> {
    let mut conditions = runge_kutta(alpha, b, order);
    let (explicit, implicit) = (alpha.column_sum(), gamma.column_sum());
    conditions.push((b.dot(&implicit), 0.0));
    if order >= 3 {
        conditions.extend([
            (b.dot(&(alpha * &implicit)), 0.0),
            (b.dot(&(gamma * &explicit)), 0.0),
            (b.dot(&(gamma * &implicit)), 0.0),
        ]);
    }
    conditions
}

#[test]
fn esdirk_meets_its_orders() {
    let tableau = &ESDIRK43;
    let a = matrix(tableau.a, 0.0);
    check(tableau.name, &runge_kutta(&a, &DVector::from_column_slice(tableau.b), tableau.order));
    let embedded = DVector::from_column_slice(tableau.b_embedded);
    check(tableau.name, &runge_kutta(&a, &embedded, tableau.embedded_order));
    let wrong = runge_kutta(&a, &embedded, tableau.order);
    assert!(wrong.iter().any(|(value, expected)| (value - expected).abs() > 1e-4), "no error to estimate");
}

#[test]
fn esdirk_is_stiffly_accurate_with_one_diagonal_and_stage_order_two() {
    let a = matrix(ESDIRK43.a, 0.0);
    let c = a.column_sum();
    assert_eq!(ESDIRK43.a.last(), Some(&ESDIRK43.b));
    for i in 1..c.len() {
        assert_eq!(a[(i, i)], a[(1, 1)]);
        let second = (&a * &c)[i];
        assert!((second - 0.5 * c[i] * c[i]).abs() < 1e-14, "stage {i}: {second}");
    }
}

#[test]
fn rosenbrock_meets_its_orders_with_any_matrix() {
    let tableau = &ROS34PW2;
    let (alpha, gamma) = (matrix(tableau.alpha, 0.0), matrix(tableau.implicit, tableau.gamma));
    let b = DVector::from_column_slice(tableau.b);
    check(tableau.name, &rosenbrock_w(&alpha, &gamma, &b, tableau.order));
    let embedded = DVector::from_column_slice(tableau.b_embedded);
    check(tableau.name, &rosenbrock_w(&alpha, &gamma, &embedded, tableau.embedded_order));
}

#[test]
fn rosenbrock_damps_stiff_modes_at_once() {
    // R(∞) = 1 − bᵀ(α + Γ)⁻¹1.
    let beta = matrix(ROS34PW2.alpha, 0.0) + matrix(ROS34PW2.implicit, ROS34PW2.gamma);
    let ones = DVector::from_element(ROS34PW2.b.len(), 1.0);
    let solved = beta.lu().solve(&ones).unwrap();
    assert!((1.0 - DVector::from_column_slice(ROS34PW2.b).dot(&solved)).abs() < 1e-13);
}
