//! The text of an expression.

use flow_core::expression::{Expression, Program};

use super::check_message;

const VARIABLES: [&str; 2] = ["kappa", "rho"];
/// Most bytes of scratch that one text may ask for, its derivatives included.
const MOST_SCRATCH: usize = 1 << 28;

/// Reads an expression; one that is valid is differentiated twice, compiled and evaluated.
pub fn expression(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let expression = match Expression::parse(&text, &VARIABLES) {
        Ok(expression) => expression,
        Err(error) => return check_message(&error),
    };
    let mut all = vec![expression];
    for (of, variable) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        match all.get(of).map(|expression| expression.derivative(variable)) {
            Some(Ok(derivative)) => all.push(derivative),
            Some(Err(error)) => check_message(&error),
            None => {}
        }
    }
    evaluate(&all);
}

/// Everywhere that numbers can be.
fn evaluate(expressions: &[Expression]) {
    let ends =
        [0.0, -0.0, 1.0, -2.5, 5e-324, -1e-308, 1e308, -1e308, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    let (kappa, rho): (Vec<f64>, Vec<f64>) = ends.iter().flat_map(|a| ends.map(|b| (*a, b))).unzip();
    let program = Program::compile(&expressions.iter().collect::<Vec<_>>());
    assert!(8 * program.scratch_len() <= MOST_SCRATCH, "{} numbers of scratch", program.scratch_len());
    let mut outputs = vec![vec![0.0; kappa.len()]; expressions.len()];
    let mut borrowed: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
    program.evaluate(&[&kappa, &rho], &mut borrowed, &mut vec![0.0; program.scratch_len()]);
    for (expression, output) in expressions.iter().zip(&outputs) {
        let value = expression.evaluate(&[kappa[0], rho[0]]);
        // Compiled, products and powers are taken in another order: only what both can hold must be alike.
        let alike = !(value.is_finite() && output[0].is_finite())
            || (value - output[0]).abs() <= value.abs().max(1.0);
        assert!(alike, "{}: {value} ≠ {}", expression.text(), output[0]);
    }
}
