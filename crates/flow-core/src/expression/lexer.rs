//! Cuts the text of an expression into numbers, names and signs.

use super::error::ExpressionError;
use super::spelling;

/// One piece of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    /// A finite literal.
    Number(f64),
    /// A variable, a function or `pi`.
    Name(&'a str),
    /// One of `+ - * / ^ ( )`.
    Sign(char),
    /// Nothing is left.
    End,
}

/// Reads tokens from left to right.
#[derive(Debug)]
pub(super) struct Lexer<'a> {
    text: &'a str,
    position: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { text, position: 0 }
    }

    /// The column, counted in characters from 1, of the byte at `offset`.
    pub(super) fn column(&self, offset: usize) -> usize {
        self.text[..offset].chars().count() + 1
    }

    /// The text between two byte offsets.
    pub(super) fn slice(&self, start: usize, end: usize) -> &'a str {
        &self.text[start..end]
    }

    /// The name from `start` to the last token read, with the attributes that follow it after points.
    pub(super) fn dotted(&self, start: usize) -> &'a str {
        spelling::dotted(self.text, start, self.position)
    }

    /// The byte offset just behind the last token read.
    pub(super) fn position(&self) -> usize {
        self.position
    }

    /// The next token and the byte offset where it starts.
    pub(super) fn next_token(&mut self) -> Result<(usize, Token<'a>), ExpressionError> {
        let rest = self.text[self.position..].trim_ascii_start();
        let start = self.text.len() - rest.len();
        let token = match rest.chars().next() {
            None => {
                self.position = start;
                Token::End
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(start)?,
            Some(c) if c.is_alphabetic() || c == '_' => self.name(start),
            Some(c) if "+-*/^()".contains(c) => {
                self.position = start + 1;
                Token::Sign(c)
            }
            Some(found) => {
                return Err(ExpressionError::UnexpectedCharacter { column: self.column(start), found });
            }
        };
        Ok((start, token))
    }

    fn name(&mut self, start: usize) -> Token<'a> {
        let rest = &self.text[start..];
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        self.position = start + length;
        Token::Name(&rest[..length])
    }

    /// `digits[.digits][e[±]digits]`, with digits on at least one side of the point.
    fn number(&mut self, start: usize) -> Result<Token<'a>, ExpressionError> {
        let bytes = self.text.as_bytes();
        let digits_from =
            |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
        let mut end = digits_from(start);
        if bytes.get(end) == Some(&b'.') {
            end = digits_from(end + 1);
        }
        let mantissa = &self.text[start..end];
        if mantissa == "." {
            return Err(ExpressionError::UnexpectedCharacter { column: self.column(start), found: '.' });
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            if bytes.get(signed).is_some_and(u8::is_ascii_digit) {
                end = digits_from(signed);
            }
        }
        let literal = &self.text[start..end];
        let vanished =
            |value: f64| value == 0.0 && mantissa.contains(|c: char| c.is_ascii_digit() && c != '0');
        match literal.parse::<f64>() {
            Ok(value) if value.is_finite() && !vanished(value) => {
                self.position = end;
                Ok(Token::Number(value))
            }
            _ => Err(ExpressionError::NumberOutOfRange {
                column: self.column(start),
                literal: literal.to_owned(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<Token<'_>> {
        let mut lexer = Lexer::new(text);
        let mut all = Vec::new();
        loop {
            match lexer.next_token().unwrap().1 {
                Token::End => return all,
                token => all.push(token),
            }
        }
    }

    #[test]
    fn numbers_take_an_exponent_only_with_digits() {
        assert_eq!(tokens("1.5e-3"), [Token::Number(1.5e-3)]);
        assert_eq!(tokens(".5 2."), [Token::Number(0.5), Token::Number(2.0)]);
        assert_eq!(tokens("2e"), [Token::Number(2.0), Token::Name("e")]);
        assert_eq!(tokens("0e-999"), [Token::Number(0.0)]);
    }

    #[test]
    fn numbers_that_overflow_or_vanish_are_refused() {
        for text in ["1e999", "1e-999"] {
            let error = Lexer::new(text).next_token().unwrap_err();
            assert_eq!(error, ExpressionError::NumberOutOfRange { column: 1, literal: text.to_owned() });
        }
    }
}
