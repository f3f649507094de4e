//! The parser of quantities and units, by recursive descent over characters.
//!
//!   quantity = number [unit]
//!   unit     = factor { ("*" | "·" | blank | "/") factor }        left to right; "/" takes one factor
//!   factor   = ( symbol | "1" | "(" unit ")" ) [ ["^" | "**"] integer | superscripts ]

use super::{Unit, symbols};

/// Why a text is not a quantity.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// The text does not begin with a number.
    #[error("\"{text}\" does not begin with a number")]
    NoNumber {
        /// The text as written.
        text: String,
    },
    /// The number does not fit, or is infinite, or not a number.
    #[error("the number in \"{text}\" is not finite")]
    NotFinite {
        /// The text as written.
        text: String,
    },
    /// A symbol that is no unit.
    #[error("unknown unit \"{symbol}\"")]
    UnknownUnit {
        /// The symbol.
        symbol: String,
        /// The unit that may have been meant.
        nearest: Option<String>,
    },
    /// The unit is not written as a product of powers.
    #[error("cannot read the unit \"{unit}\"")]
    Malformed {
        /// The unit as written.
        unit: String,
    },
}

/// The largest power of a unit that is read; beyond it something is misspelt.
const LARGEST_POWER: i32 = 12;
/// The deepest nesting of parentheses.
const DEEPEST: usize = 8;

/// Reads `2 cm`: the number and the unit behind it (a pure number has the unit one).
///
/// # Errors
/// `NoNumber`, `NotFinite`, `UnknownUnit`, `Malformed`.
pub fn parse_quantity(text: &str) -> Result<(f64, Unit), UnitError> {
    let trimmed = text.trim();
    let end = number_length(trimmed);
    let number: f64 = trimmed[..end].parse().map_err(|_| UnitError::NoNumber { text: text.to_owned() })?;
    if !number.is_finite() {
        return Err(UnitError::NotFinite { text: text.to_owned() });
    }
    let rest = trimmed[end..].trim();
    let unit = if rest.is_empty() { Unit::ONE } else { parse_unit(rest)? };
    if (number * unit.size).is_finite() {
        Ok((number, unit))
    } else {
        Err(UnitError::NotFinite { text: text.to_owned() })
    }
}

/// Reads a product of powers of units, `kg/m^3`.
///
/// # Errors
/// `UnknownUnit`, `Malformed`.
pub fn parse_unit(text: &str) -> Result<Unit, UnitError> {
    let mut reader = UnitReader { rest: text, text };
    let unit = reader.product(0)?;
    if reader.rest.is_empty() { Ok(unit) } else { Err(reader.malformed()) }
}

/// How many bytes of the text are a decimal number: sign, digits, point, digits, exponent with digits.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        at
    };
    let start = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut end = digits(start);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    end
}

struct UnitReader<'a> {
    text: &'a str,
    rest: &'a str,
}

impl<'a> UnitReader<'a> {
    fn product(&mut self, depth: usize) -> Result<Unit, UnitError> {
        let mut unit = self.factor(depth)?;
        loop {
            self.blanks();
            let divides = self.eat("/");
            let _ = divides || self.eat("·") || (!self.rest.starts_with("**") && self.eat("*"));
            self.blanks();
            if !divides && (self.rest.is_empty() || self.rest.starts_with(')')) {
                return Ok(unit);
            }
            let factor = self.factor(depth)?;
            let factor = if divides { factor.power(-1) } else { Some(factor) };
            unit = factor.and_then(|factor| unit.times(factor)).ok_or_else(|| self.malformed())?;
        }
    }

    fn factor(&mut self, depth: usize) -> Result<Unit, UnitError> {
        self.blanks();
        if depth > DEEPEST {
            return Err(self.malformed());
        }
        let base = if self.eat("(") {
            let inner = self.product(depth + 1)?;
            self.blanks();
            if !self.eat(")") {
                return Err(self.malformed());
            }
            inner
        } else if self.eat("1") {
            return Ok(Unit::ONE);
        } else {
            self.symbol()?
        };
        base.power(self.power()?).ok_or_else(|| self.malformed())
    }

    fn symbol(&mut self) -> Result<Unit, UnitError> {
        let is_letter = |c: char| (c.is_alphabetic() || c == '°') && superscript(c).is_none();
        let symbol = self.take_while(is_letter);
        if symbol.is_empty() {
            return Err(self.malformed());
        }
        symbols::lookup(symbol)
            .ok_or_else(|| UnitError::UnknownUnit { symbol: symbol.to_owned(), nearest: symbols::nearest(symbol) })
    }

    /// The power behind a symbol: `^3`, `**3`, `3`, `³`, `^-1`, `⁻¹`; one if there is none.
    fn power(&mut self) -> Result<i32, UnitError> {
        let raised = self.take_while(|c| superscript(c).is_some());
        let digits: String = if raised.is_empty() {
            let marked = self.eat("^") || self.eat("**");
            let sign = if marked && self.eat("-") { "-" } else { "" };
            let digits = self.take_while(|c| c.is_ascii_digit());
            if digits.is_empty() && !marked {
                return Ok(1);
            }
            format!("{sign}{digits}")
        } else {
            raised.chars().filter_map(superscript).collect()
        };
        let power: i32 = digits.parse().map_err(|_| self.malformed())?;
        if power.abs() <= LARGEST_POWER { Ok(power) } else { Err(self.malformed()) }
    }

    fn blanks(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn eat(&mut self, token: &str) -> bool {
        match self.rest.strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn take_while(&mut self, accept: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !accept(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn malformed(&self) -> UnitError {
        UnitError::Malformed { unit: self.text.to_owned() }
    }
}

/// The plain form of a superscript digit or sign.
fn superscript(c: char) -> Option<char> {
    let plain = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().zip("0123456789-".chars());
    plain.into_iter().find_map(|(raised, plain)| (raised == c).then_some(plain))
}
