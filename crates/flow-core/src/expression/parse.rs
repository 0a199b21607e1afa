//! Recursive descent through the grammar of expressions.
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = signed (("*" | "/") signed)*
//! signed  = "-" signed | power
//! power   = atom ("^" signed)?
//! atom    = number | name | function "(" sum ")" | "(" sum ")"
//! ```

use std::f64::consts::PI;

use super::error::{ExpressionError, unknown_name};
use super::graph::{Function, Graph, NAMED_FUNCTIONS, Node, NodeId, Operator};
use super::lexer::{Lexer, Token};

/// Longest text, in bytes.
const MAX_LENGTH: usize = 4096;
/// Deepest nesting, so that no text can exhaust the stack.
const MAX_DEPTH: usize = 64;

const OPERAND: &str = "a number, a name, a function or `(`";

/// The graph of `text`, operands first, the value last.
pub(super) fn parse(text: &str, variables: &[&str]) -> Result<Vec<Node>, ExpressionError> {
    if text.len() > MAX_LENGTH {
        return Err(ExpressionError::TooLong { length: text.len(), limit: MAX_LENGTH });
    }
    if let Some(name) = variables.iter().find(|&&name| name == "pi" || function_named(name).is_some()) {
        return Err(ExpressionError::ReservedVariable { name: (*name).to_owned() });
    }
    let mut lexer = Lexer::new(text);
    let (start, token) = lexer.next_token()?;
    let mut parser = Parser { lexer, start, token, depth: 0, variables, graph: Graph::default() };
    let root = parser.sum()?;
    if parser.token != Token::End {
        return Err(parser.unexpected("an operator (+ - * / ^) or the end; a product needs its `*`"));
    }
    Ok(parser.graph.reachable(root))
}

fn function_named(name: &str) -> Option<Function> {
    NAMED_FUNCTIONS.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

struct Parser<'a> {
    lexer: Lexer<'a>,
    /// Where the current token starts.
    start: usize,
    token: Token<'a>,
    depth: usize,
    variables: &'a [&'a str],
    graph: Graph,
}

impl<'a> Parser<'a> {
    fn advance(&mut self) -> Result<(), ExpressionError> {
        (self.start, self.token) = self.lexer.next_token()?;
        Ok(())
    }

    fn sum(&mut self) -> Result<NodeId, ExpressionError> {
        let mut left = self.product()?;
        loop {
            let operator = match self.token {
                Token::Sign('+') => Operator::Add,
                Token::Sign('-') => Operator::Subtract,
                _ => return Ok(left),
            };
            self.advance()?;
            let right = self.product()?;
            left = self.graph.binary(operator, left, right)?;
        }
    }

    fn product(&mut self) -> Result<NodeId, ExpressionError> {
        let mut left = self.signed()?;
        loop {
            let operator = match self.token {
                Token::Sign('*') => Operator::Multiply,
                Token::Sign('/') => Operator::Divide,
                _ => return Ok(left),
            };
            let star = self.start;
            self.advance()?;
            if operator == Operator::Multiply && self.token == Token::Sign('*') && self.start == star + 1 {
                return Err(ExpressionError::DoubleStar { column: self.lexer.column(star) });
            }
            let right = self.signed()?;
            left = self.graph.binary(operator, left, right)?;
        }
    }

    /// Every recursion of the grammar passes here, so here the depth is counted.
    fn signed(&mut self) -> Result<NodeId, ExpressionError> {
        if self.depth > MAX_DEPTH {
            return Err(ExpressionError::TooDeep { column: self.lexer.column(self.start), limit: MAX_DEPTH });
        }
        self.depth += 1;
        let value = if self.token == Token::Sign('-') {
            self.advance()?;
            let operand = self.signed()?;
            self.graph.unary(Function::Negate, operand)?
        } else {
            self.power()?
        };
        self.depth -= 1;
        Ok(value)
    }

    fn power(&mut self) -> Result<NodeId, ExpressionError> {
        let base = self.atom()?;
        if self.token != Token::Sign('^') {
            return Ok(base);
        }
        self.advance()?;
        let exponent = self.signed()?;
        self.graph.binary(Operator::Power, base, exponent)
    }

    fn atom(&mut self) -> Result<NodeId, ExpressionError> {
        match self.token {
            Token::Number(value) => {
                self.advance()?;
                self.graph.constant(value)
            }
            Token::Name(name) => self.named(name),
            Token::Sign('(') => self.parenthesised(),
            _ => Err(self.unexpected(OPERAND)),
        }
    }

    fn named(&mut self, name: &'a str) -> Result<NodeId, ExpressionError> {
        let column = self.lexer.column(self.start);
        if let Some(function) = function_named(name) {
            self.advance()?;
            if self.token != Token::Sign('(') {
                return Err(self.unexpected("`(` and the argument of the function"));
            }
            let argument = self.parenthesised()?;
            return self.graph.unary(function, argument);
        }
        let value = if name == "pi" {
            self.graph.constant(PI)?
        } else if let Some(variable) = self.variables.iter().position(|&known| known == name) {
            self.graph.variable(variable)?
        } else {
            let functions = NAMED_FUNCTIONS.iter().map(|(name, _)| *name);
            let allowed: Vec<&str> = self.variables.iter().copied().chain(["pi"]).chain(functions).collect();
            let name = self.lexer.dotted(self.start);
            return Err(unknown_name(name, column, &allowed));
        };
        self.advance()?;
        Ok(value)
    }

    fn parenthesised(&mut self) -> Result<NodeId, ExpressionError> {
        self.advance()?;
        let value = self.sum()?;
        if self.token != Token::Sign(')') {
            return Err(self.unexpected("`)` or an operator (+ - * / ^)"));
        }
        self.advance()?;
        Ok(value)
    }

    #[cold]
    fn unexpected(&self, expected: &'static str) -> ExpressionError {
        let column = self.lexer.column(self.start);
        if self.token == Token::End {
            return ExpressionError::UnexpectedEnd { column, expected };
        }
        let found = self.lexer.slice(self.start, self.lexer.position()).to_owned();
        ExpressionError::UnexpectedToken { column, found, expected }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Expression;
    use super::*;

    fn value(text: &str) -> f64 {
        Expression::parse(text, &["x"]).unwrap().evaluate(&[3.0])
    }

    fn message(text: &str) -> String {
        Expression::parse(text, &["kappa"]).unwrap_err().to_string()
    }

    #[test]
    fn precedence_is_that_of_mathematics() {
        assert_eq!(value("-x^2"), -9.0);
        assert_eq!(value("(-x)^2"), 9.0);
        assert_eq!(value("2^x^2"), 512.0);
        assert_eq!(value("x^-2"), 1.0 / 9.0);
        assert_eq!(value("2 - x - 1"), -2.0);
        assert_eq!(value("12 / x / 2 * 5"), 10.0);
        assert_eq!(value("2*-x"), -6.0);
        assert_eq!(value("1 + 2 * x"), 7.0);
    }

    #[test]
    fn messages_name_the_column_and_the_remedy() {
        let operator = "expected an operator (+ - * / ^) or the end; a product needs its `*`";
        assert_eq!(message("2 kappa"), format!("column 3: found `kappa`, {operator}"));
        assert_eq!(message("kappa)"), format!("column 6: found `)`, {operator}"));
        assert_eq!(message("1 + * 2"), format!("column 5: found `*`, expected {OPERAND}"));
        assert_eq!(message("2**3"), "column 2: a power is written `^`, as in `kappa^2`, not `**`");
        assert_eq!(message("1 +"), format!("column 4: the expression ends here, expected {OPERAND}"));
        assert_eq!(
            message("(1"),
            "column 3: the expression ends here, expected `)` or an operator (+ - * / ^)"
        );
        assert_eq!(
            message("exp kappa"),
            "column 5: found `kappa`, expected `(` and the argument of the function"
        );
        assert!(message("1 + kapa").starts_with("column 5: unknown name `kapa` (did you mean `kappa`?)"));
        assert!(message("1 − 2").starts_with("column 3: found the character '−'"));
    }

    #[test]
    fn limits_are_enforced() {
        let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
        assert!(Expression::parse(&nested(MAX_DEPTH), &["x"]).is_ok());
        for text in [nested(MAX_DEPTH + 1), "-".repeat(4000) + "x", "x^".repeat(2000) + "x"] {
            assert!(matches!(Expression::parse(&text, &["x"]), Err(ExpressionError::TooDeep { .. })));
        }
        assert!(matches!(parse(&" ".repeat(4097), &[]), Err(ExpressionError::TooLong { length: 4097, .. })));
        assert!(matches!(parse("1", &["exp"]), Err(ExpressionError::ReservedVariable { .. })));
    }
}
