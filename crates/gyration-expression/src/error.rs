//! Faults of a text, and of a place where an expression is to be evaluated.

use thiserror::Error;

/// Fault of a text or of the constants given with it.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParseError {
    /// The text says nothing sound at `column`, counted in characters from 1.
    #[error("column {column}: {reason}")]
    Text {
        /// Place of the fault, counted in characters from 1.
        column: usize,
        /// The fault, and what would be right.
        reason: Reason,
    },
    /// A constant has a name that means something else.
    #[error("constant `{name}` has the name of {taken_by}; give it another")]
    ConstantTaken {
        /// Name of the constant.
        name: String,
        /// Owner of the name: a variable, a function, pi.
        taken_by: &'static str,
    },
    /// A constant has a name that no expression can contain.
    #[error("constant `{name}` is no name: letters, digits and _ make one, with no digit first")]
    ConstantName {
        /// Name of the constant.
        name: String,
    },
    /// A constant has no finite value.
    #[error("constant `{name}` is {value}, not a finite number")]
    ConstantValue {
        /// Name of the constant.
        name: String,
        /// Its value.
        value: f64,
    },
}

impl ParseError {
    /// Column of the fault, counted in characters from 1; none where a constant is at fault.
    pub fn column(&self) -> Option<usize> {
        match self {
            ParseError::Text { column, .. } => Some(*column),
            ParseError::ConstantTaken { .. } | ParseError::ConstantName { .. } | ParseError::ConstantValue { .. } => {
                None
            }
        }
    }
}

/// Fault of a text at a column.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Reason {
    /// Nothing stands there.
    #[error("the expression is empty; write 0 for none")]
    Empty,
    /// A character that no expression has.
    #[error("`{0}` has no meaning here; known are + - * / ^ ( ) , numbers and names")]
    Character(char),
    /// Two stars.
    #[error("a power is written with ^, as in x^2")]
    Stars,
    /// Digits that are no number.
    #[error("`{0}` is no finite number")]
    Number(String),
    /// An operand is missing before the word, or the end.
    #[error("a number, a name or ( is missing before {0}")]
    Operand(String),
    /// Two operands without an operator between them.
    #[error("an operator is missing before {0}; a product is written with *, as in 2*x")]
    Operator(String),
    /// A name without meaning.
    #[error("`{name}` is not known; {known}")]
    Name {
        /// The name.
        name: String,
        /// Names that are known, in words.
        known: String,
    },
    /// A function without its parentheses.
    #[error("`{0}` is a function; its argument stands in parentheses")]
    Function(String),
    /// Parentheses behind what is no function.
    #[error("`{0}` is no function; a product is written with *")]
    NoFunction(String),
    /// The wrong number of arguments.
    #[error("`{name}` takes {takes}, not {given}")]
    Arguments {
        /// The function.
        name: &'static str,
        /// Number of arguments that it takes, in words.
        takes: &'static str,
        /// Number of arguments that it is given.
        given: usize,
    },
    /// A parenthesis that nothing closes.
    #[error("this ( is never closed")]
    Unclosed,
    /// A parenthesis that nothing opened.
    #[error("this ) closes nothing")]
    Unopened,
    /// A comma outside the arguments of a function.
    #[error("a comma separates arguments of min and max only; decimals have a point")]
    Comma,
    /// Parentheses, signs and powers within one another beyond the limit.
    #[error("more than {0} parentheses, signs or powers within one another; write the expression flatter")]
    Depth(usize),
    /// A part without variables that has no finite value.
    #[error("`{operation}` has no finite value at {argument}")]
    Constant {
        /// Function or operator.
        operation: &'static str,
        /// Its argument.
        argument: f64,
    },
}

/// Lack of an operation at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// A finite value.
    Value,
    /// A finite first derivative.
    Derivative,
    /// A finite second derivative.
    SecondDerivative,
}

impl std::fmt::Display for Want {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Want::Value => "finite value",
            Want::Derivative => "derivative",
            Want::SecondDerivative => "second derivative",
        })
    }
}

/// An operation of the expression has no finite value, or not the wanted derivative, at the numbers given.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("`{operation}` has no {want} at {argument} (column {column})")]
pub struct Undefined {
    /// Function or operator.
    pub operation: &'static str,
    /// Its place in the text, counted in characters from 1.
    pub column: usize,
    /// Its argument: of an operator the operand that matters (divisor, base).
    pub argument: f64,
    /// Lack of it there.
    pub want: Want,
}
