//! Properties of every expression: text, derivatives and compiled programs agree with a direct evaluation.

use flow_core::expression::{Expression, ExpressionError, Program};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const VARIABLES: [&str; 2] = ["kappa", "rho"];
const FUNCTIONS: [&str; 10] = ["exp", "ln", "sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "abs"];

/// The obvious model of an expression.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    Variable(usize),
    Negated(Box<Tree>),
    Called(usize, Box<Tree>),
    Joined(char, Box<Tree>, Box<Tree>),
    Raised(Box<Tree>, i32),
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Tree::Number(value) => format!("{value:?}"),
            Tree::Variable(index) => VARIABLES[*index].to_owned(),
            Tree::Negated(a) => format!("(-{})", a.text()),
            Tree::Called(function, a) => format!("{}({})", FUNCTIONS[*function], a.text()),
            Tree::Joined(sign, a, b) => format!("({} {sign} {})", a.text(), b.text()),
            Tree::Raised(a, power) => format!("({})^{power}", a.text()),
        }
    }

    /// The value and a first-order bound of its rounding error.
    fn value(&self, variables: &[f64]) -> (f64, f64) {
        let (value, inherited) = match self {
            Tree::Number(value) => (*value, 0.0),
            Tree::Variable(index) => (variables[*index], 0.0),
            Tree::Negated(a) => {
                let (a, error) = a.value(variables);
                (-a, error)
            }
            Tree::Called(function, a) => {
                let (a, error) = a.value(variables);
                let (value, slope) = called(*function, a);
                (value, slope.abs() * error)
            }
            Tree::Joined(sign, a, b) => {
                let ((a, a_error), (b, b_error)) = (a.value(variables), b.value(variables));
                match sign {
                    '+' => (a + b, a_error + b_error),
                    '-' => (a - b, a_error + b_error),
                    '*' => (a * b, a.abs() * b_error + b.abs() * a_error),
                    _ => (a / b, (a_error + (a / b).abs() * b_error) / b.abs()),
                }
            }
            Tree::Raised(a, power) => {
                let (a, error) = a.value(variables);
                let n = f64::from(*power);
                let value = a.powf(n);
                // Not n aⁿ⁻¹ times the error: where a is large and n < 0, that underflows before aⁿ does.
                let inherited = match (a == 0.0, error == 0.0) {
                    (_, true) => 0.0,
                    (true, false) => (n * a.powf(n - 1.0)).abs() * error,
                    (false, false) => (n * value).abs() * (error / a.abs()),
                };
                (value, inherited + n.abs() * value.abs() * f64::EPSILON)
            }
        };
        (value, inherited + 4.0 * f64::EPSILON * value.abs())
    }
}

/// A function's value and slope.
fn called(function: usize, a: f64) -> (f64, f64) {
    match FUNCTIONS[function] {
        "exp" => (a.exp(), a.exp()),
        "ln" => (a.ln(), 1.0 / a),
        "sqrt" => (a.sqrt(), 0.5 / a.sqrt()),
        "sin" => (a.sin(), 1.0),
        "cos" => (a.cos(), 1.0),
        "tan" => (a.tan(), 1.0 + a.tan() * a.tan()),
        "sinh" => (a.sinh(), a.cosh()),
        "cosh" => (a.cosh(), a.sinh()),
        "tanh" => (a.tanh(), 1.0),
        _ => (a.abs(), 1.0),
    }
}

fn any_tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (0.01..10.0).prop_map(Tree::Number),
        Just(Tree::Number(1.0)),
        Just(Tree::Number(0.0)),
        (0..VARIABLES.len()).prop_map(Tree::Variable),
        (0..VARIABLES.len()).prop_map(Tree::Variable),
    ];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let sign = prop::sample::select(vec!['+', '-', '*', '/']);
        prop_oneof![
            inner.clone().prop_map(|a| Tree::Negated(Box::new(a))),
            (0..FUNCTIONS.len(), inner.clone()).prop_map(|(f, a)| Tree::Called(f, Box::new(a))),
            (sign, inner.clone(), inner.clone()).prop_map(|(sign, a, b)| Tree::Joined(
                sign,
                Box::new(a),
                Box::new(b)
            )),
            (inner, -4..7).prop_map(|(a, power)| Tree::Raised(Box::new(a), power)),
        ]
    })
}

fn parsed(tree: &Tree) -> Expression {
    Expression::parse(&tree.text(), &VARIABLES).expect("the text of a tree is valid")
}

fn same(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

/// Values whose error bound is this small, relative to 1 and to the value, can be compared.
fn is_well_conditioned(value: f64, error: f64) -> bool {
    value.abs() < 1e100 && error < 1e-9 * (1.0 + value.abs())
}

proptest! {
    // A fixed seed: what fails does so on every machine. More cases and other seeds were tried when this was written.
    #![proptest_config(ProptestConfig {
        cases: 4000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(20_261_128),
        ..ProptestConfig::default()
    })]

    /// Text and parser are inverse to each other, to the last bit of the value.
    #[test]
    fn parsing_keeps_the_meaning(tree in any_tree(), kappa in -3.0..3.0, rho in 0.0..2.0) {
        let (direct, _) = tree.value(&[kappa, rho]);
        let value = parsed(&tree).evaluate(&[kappa, rho]);
        prop_assert!(same(value, direct), "{}: {value} ≠ {direct}", tree.text());
    }

    /// The derivative is the limit of central differences, wherever two step sizes agree on that limit.
    #[test]
    fn derivative_is_the_slope(tree in any_tree(), kappa in -3.0..3.0, rho in 0.1..2.0) {
        let expression = parsed(&tree);
        let slope = |h: f64| {
            (expression.evaluate(&[kappa + h, rho]) - expression.evaluate(&[kappa - h, rho])) / (2.0 * h)
        };
        let (value, error) = tree.value(&[kappa, rho]);
        let (coarse, fine) = (slope(1e-4), slope(5e-5));
        let derivative = expression.derivative(0).unwrap();
        if !expression.depends_on(0) {
            prop_assert_eq!(derivative.evaluate(&[kappa, rho]), 0.0);
        }
        // A slope of zero may be a NaN that folding removed; elsewhere, two steps must agree before they can judge.
        let is_smooth = value.abs() < 1e4
            && error < 1e-11
            && fine.abs() > 1e-3
            && (coarse - fine).abs() < 1e-5 * (1.0 + fine.abs());
        if !is_smooth {
            return Ok(());
        }
        let predicted = derivative.evaluate(&[kappa, rho]);
        prop_assert!((predicted - fine).abs() < 1e-3 * (1.0 + fine.abs()), "{}: {predicted} ≠ {fine}", tree.text());
    }

    /// A program agrees with the obvious evaluation at every node, for full and for broken blocks.
    #[test]
    fn program_agrees_with_evaluate(
        trees in prop::collection::vec(any_tree(), 1..4),
        n in prop::sample::select(vec![1_usize, 63, 64, 65, 200]),
        phase in 0.0_f64..6.0,
    ) {
        let expressions: Vec<Expression> = trees.iter().map(parsed).collect();
        let program = Program::compile(&expressions.iter().collect::<Vec<_>>());
        prop_assert_eq!(program.outputs(), trees.len());
        let kappa: Vec<f64> = (0..n).map(|i| 3.0 * (phase + i as f64).sin()).collect();
        let rho: Vec<f64> = (0..n).map(|i| 1.0 + (2.0 * phase + i as f64).cos()).collect();
        let mut outputs = vec![vec![f64::NAN; n]; trees.len()];
        let mut scratch = vec![f64::NAN; program.scratch_len()];
        let mut borrowed: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
        program.evaluate(&[&kappa, &rho], &mut borrowed, &mut scratch);
        for (tree, (expression, output)) in trees.iter().zip(expressions.iter().zip(&outputs)) {
            for i in 0..n {
                let (value, error) = tree.value(&[kappa[i], rho[i]]);
                if is_well_conditioned(value, error) {
                    let reference = expression.evaluate(&[kappa[i], rho[i]]);
                    let difference = (output[i] - reference).abs();
                    prop_assert!(
                        difference <= 4.0 * error + 1e-280,
                        "{} at node {i}: {} ≠ {reference}, allowed {error:e}", tree.text(), output[i]
                    );
                }
            }
        }
    }

    /// No text makes the parser or the compiler panic.
    #[test]
    fn any_text_is_read_or_refused(text in "[-+*/^()0-9.eE a-z\\PC\0]{0,80}") {
        if let Ok(expression) = Expression::parse(&text, &VARIABLES) {
            let _ = (expression.evaluate(&[1.0, 2.0]), expression.derivative(0), Program::compile(&[&expression]));
        }
    }

    /// Sequences of valid pieces reach deeper into the grammar than random characters.
    #[test]
    fn any_tokens_are_read_or_refused(
        tokens in prop::collection::vec(
            prop::sample::select(vec!["(", ")", "+", "-", "*", "/", "^", "2", "0.5", "kappa", "rho", "pi", "exp(", "abs("]),
            0..60,
        ),
    ) {
        let _ = Expression::parse(&tokens.concat(), &VARIABLES);
    }
}

#[test]
fn hostile_texts_are_refused() {
    let texts = [
        "(".repeat(4096),
        "exp(".repeat(1000),
        "-".repeat(4096),
        "1^".repeat(2048),
        "kappa\0".to_owned(),
        "\u{202e}kappa".to_owned(),
        "κ".to_owned(),
        "1".repeat(4000),
        "9".repeat(100_000),
        String::new(),
        "__import__('os')".to_owned(),
        "kappa; rho".to_owned(),
    ];
    for text in &texts {
        assert!(Expression::parse(text, &VARIABLES).is_err(), "{text:.20}");
    }
}

/// What grows fastest is refused, or stays small: a text cannot take all memory, nor go on for ever.
#[test]
fn the_costliest_texts_stay_small() {
    let nested = |open: &str, close: &str| format!("{}kappa{}", open.repeat(60), close.repeat(60));
    let factors: Vec<String> = (0..400).map(|k| format!("(rho+{k})")).collect();
    let texts = [
        nested("exp(", ")"),
        nested("tan(", ")"),
        nested("abs(kappa-", ")"),
        nested("(rho*", ")^kappa"),
        vec!["kappa"; 60].join("^"),
        factors.join("*"),
        factors.join("/"),
        format!("({})^({})", factors[..150].join("*"), factors[150..300].join("/")),
    ];
    for text in &texts {
        let expression = Expression::parse(text, &VARIABLES).unwrap();
        let mut all = vec![expression.clone()];
        let mut refused = 0;
        for variable in [0, 1, 0, 1] {
            match all[all.len() - 1].derivative(variable) {
                Ok(derivative) => all.push(derivative),
                Err(ExpressionError::TooManyTerms { limit: 20_000 }) => refused += 1,
                Err(error) => panic!("{text:.40}: {error}"),
            }
        }
        let program = Program::compile(&all.iter().collect::<Vec<_>>());
        let registers = program.scratch_len() / flow_core::expression::LANES;
        assert!(registers <= 4096, "{text:.40}: {registers} registers, {refused} derivatives refused");
    }
}

#[test]
fn the_longest_sums_and_products_work() {
    for sign in ["+", "*", "-", "/"] {
        let text = vec!["rho"; 1000].join(sign);
        let expression = Expression::parse(&text, &["rho"]).unwrap();
        let slope = expression.derivative(0).unwrap();
        let program = Program::compile(&[&expression, &slope]);
        let (mut value, mut derivative) = ([0.0], [0.0]);
        let mut scratch = vec![f64::NAN; program.scratch_len()];
        program.evaluate(&[&[1.0]], &mut [&mut value, &mut derivative], &mut scratch);
        assert_eq!(value[0], expression.evaluate(&[1.0]));
        assert_eq!(derivative[0], slope.evaluate(&[1.0]));
    }
}

#[test]
fn unknown_names_are_answered_with_a_suggestion() {
    let Err(ExpressionError::UnknownName { name, column, suggestion, allowed }) =
        Expression::parse("2*kapa", &VARIABLES)
    else {
        panic!("must be an unknown name");
    };
    assert_eq!((name.as_str(), column, suggestion.as_deref()), ("kapa", 3, Some("kappa")));
    assert_eq!(allowed.len(), VARIABLES.len() + 1 + FUNCTIONS.len());
}
