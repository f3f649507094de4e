//! Grammar: from words to the tape. A sum of any length takes no depth; what stands within one another is bounded.

use crate::error::{ParseError, Reason};
use crate::operation::{Binary, Function};
use crate::tape::Tape;
use crate::token::{Token, Word};
use crate::{FUNCTIONS, PI};

/// Parentheses, signs and powers within one another that a thread's stack surely holds.
const DEPTH: usize = 100;

/// Names that an expression may have.
pub(crate) struct Names<'a> {
    pub(crate) variables: &'a [&'a str],
    pub(crate) constants: &'a [(String, f64)],
}

impl Names<'_> {
    fn known(&self) -> String {
        let mut known = format!("variables: {}", self.variables.join(", "));
        if !self.constants.is_empty() {
            let names: Vec<&str> = self.constants.iter().map(|(name, _)| name.as_str()).collect();
            known += &format!("; constants: {}", names.join(", "));
        }
        known + &format!("; functions: {}; and {PI}", FUNCTIONS.join(", "))
    }
}

/// Reads words of a text and appends what they say to a tape.
pub(crate) struct Parser<'a> {
    words: &'a [Word],
    at: usize,
    depth: usize,
    names: Names<'a>,
    tape: Tape,
}

impl<'a> Parser<'a> {
    /// A parser of `words`, which end with [`Token::End`].
    pub(crate) fn new(words: &'a [Word], names: Names<'a>) -> Self {
        Self { words, at: 0, depth: 0, names, tape: Tape::default() }
    }

    /// The whole text.
    pub(crate) fn expression(mut self) -> Result<Tape, ParseError> {
        if self.token() == &Token::End {
            return self.fault(Reason::Empty);
        }
        let value = self.sum()?;
        match self.token().clone() {
            Token::End => {}
            Token::Sign(')') => return self.fault(Reason::Unopened),
            Token::Sign(',') => return self.fault(Reason::Comma),
            other => return self.fault(Reason::Operator(other.to_string())),
        }
        // An expression of one variable and no operation ends with that variable; so does every other with its value.
        debug_assert_eq!(value + 1, self.tape.steps.len(), "the value stands last");
        Ok(self.tape)
    }

    fn sum(&mut self) -> Result<usize, ParseError> {
        let mut left = self.product()?;
        loop {
            let binary = match self.token() {
                Token::Sign('+') => Binary::Add,
                Token::Sign('-') => Binary::Subtract,
                _ => return Ok(left),
            };
            let column = self.advance();
            let right = self.product()?;
            left = self.tape.binary(binary, left, right, column)?;
        }
    }

    fn product(&mut self) -> Result<usize, ParseError> {
        let mut left = self.signed()?;
        loop {
            let binary = match self.token() {
                Token::Sign('*') => Binary::Multiply,
                Token::Sign('/') => Binary::Divide,
                _ => return Ok(left),
            };
            let column = self.advance();
            let right = self.signed()?;
            left = self.tape.binary(binary, left, right, column)?;
        }
    }

    fn signed(&mut self) -> Result<usize, ParseError> {
        if self.token() != &Token::Sign('-') {
            return self.power();
        }
        let column = self.advance();
        self.deeper()?;
        let operand = self.signed()?;
        self.depth -= 1;
        self.tape.negative(operand, column)
    }

    fn power(&mut self) -> Result<usize, ParseError> {
        let base = self.operand()?;
        if self.token() != &Token::Sign('^') {
            return Ok(base);
        }
        let column = self.advance();
        self.deeper()?;
        let exponent = self.signed()?;
        self.depth -= 1;
        self.tape.power(base, exponent, column)
    }

    fn operand(&mut self) -> Result<usize, ParseError> {
        let column = self.column();
        let value = match self.token().clone() {
            Token::Number(value) => {
                self.advance();
                self.tape.constant(value, column)
            }
            Token::Sign('(') => {
                self.advance();
                self.deeper()?;
                let inner = self.sum()?;
                self.close(column)?;
                self.depth -= 1;
                inner
            }
            Token::Name(name) => {
                self.advance();
                self.name(&name, column)?
            }
            other => return self.fault(Reason::Operand(other.to_string())),
        };
        match self.token().clone() {
            Token::Number(_) | Token::Name(_) | Token::Sign('(') => {
                let next = self.token().to_string();
                self.fault(Reason::Operator(next))
            }
            Token::Sign(_) | Token::End => Ok(value),
        }
    }

    fn name(&mut self, name: &str, column: usize) -> Result<usize, ParseError> {
        if FUNCTIONS.contains(&name) {
            return self.call(name, column);
        }
        let called = self.token() == &Token::Sign('(');
        if let Some(index) = self.names.variables.iter().position(|variable| *variable == name) {
            return if called {
                fault(column, Reason::NoFunction(name.to_owned()))
            } else {
                Ok(self.tape.variable(index, column))
            };
        }
        let constant = self.names.constants.iter().find(|(constant, _)| constant == name).map(|(_, value)| *value);
        let constant = if name == PI { Some(std::f64::consts::PI) } else { constant };
        match constant {
            Some(_) if called => fault(column, Reason::NoFunction(name.to_owned())),
            Some(value) => Ok(self.tape.constant(value, column)),
            None => fault(column, Reason::Name { name: name.to_owned(), known: self.names.known() }),
        }
    }

    /// A function, whose name has been read.
    fn call(&mut self, name: &str, column: usize) -> Result<usize, ParseError> {
        let opening = self.column();
        if self.token() != &Token::Sign('(') {
            return fault(column, Reason::Function(name.to_owned()));
        }
        self.advance();
        self.deeper()?;
        let first = self.sum()?;
        let value = if let Some(function) = Function::named(name) {
            self.no_more_arguments(function.name(), "one argument", 1)?;
            self.tape.function(function, first, column)?
        } else {
            let (binary, name) = if name == "min" { (Binary::Minimum, "min") } else { (Binary::Maximum, "max") };
            if self.token() != &Token::Sign(',') {
                if self.token() == &Token::Sign(')') {
                    return fault(column, Reason::Arguments { name, takes: "two arguments", given: 1 });
                }
                self.close(opening)?;
            }
            self.advance();
            let second = self.sum()?;
            self.no_more_arguments(name, "two arguments", 2)?;
            self.tape.binary(binary, first, second, column)?
        };
        self.close(opening)?;
        self.depth -= 1;
        Ok(value)
    }

    fn no_more_arguments(&self, name: &'static str, takes: &'static str, given: usize) -> Result<(), ParseError> {
        match self.token() {
            Token::Sign(',') => self.fault(Reason::Arguments { name, takes, given: given + 1 }),
            _ => Ok(()),
        }
    }

    /// The parenthesis that closes the one at column `opening`.
    fn close(&mut self, opening: usize) -> Result<(), ParseError> {
        match self.token().clone() {
            Token::Sign(')') => {
                self.advance();
                Ok(())
            }
            Token::End => fault(opening, Reason::Unclosed),
            Token::Sign(',') => self.fault(Reason::Comma),
            other => self.fault(Reason::Operator(other.to_string())),
        }
    }

    fn deeper(&mut self) -> Result<(), ParseError> {
        self.depth += 1;
        if self.depth > DEPTH { self.fault(Reason::Depth(DEPTH)) } else { Ok(()) }
    }

    fn token(&self) -> &Token {
        &self.words[self.at].token
    }

    fn column(&self) -> usize {
        self.words[self.at].column
    }

    /// Goes on to the next word, and returns the column of this one.
    fn advance(&mut self) -> usize {
        let column = self.column();
        self.at = (self.at + 1).min(self.words.len() - 1);
        column
    }

    fn fault<T>(&self, reason: Reason) -> Result<T, ParseError> {
        fault(self.column(), reason)
    }
}

fn fault<T>(column: usize, reason: Reason) -> Result<T, ParseError> {
    Err(ParseError::Text { column, reason })
}
