//! Expressions of named variables, with exact first and second derivatives. Plain numbers, no mechanics, no units.
//!
//! ```text
//! sum      = product (("+" | "-") product)*
//! product  = signed (("*" | "/") signed)*
//! signed   = "-" signed | power
//! power    = operand ("^" signed)?                 ^ binds tighter than the sign before it: -x^2 = -(x^2), and groups
//! operand  = number | name | name "(" sum ("," sum)* ")" | "(" sum ")"               to the right: 2^3^2 = 2^(3^2)
//! ```
//!
//! Functions are sqrt, exp, ln, sin, cos, tan, tanh, abs, min, max; pi is a constant. Two operands side by side are no
//! product: `2x` is refused.
//!
//! [`Expression::parse`] makes a tape of operations. Gradients come from one sweep back over it, and each column of the
//! Hessian from one sweep forward and one back, so that only variables that occur cost anything. Values have the digits
//! of the formula as written: nothing is rearranged, whole powers are products, elementary functions those of `libm`. A
//! place without the wanted derivative, or without a finite value, is an [`Undefined`], never NaN.
//!
//! | to read | file |
//! |---|---|
//! | words, their columns | `token` |
//! | grammar | `parser` |
//! | operations in order, constants computed beforehand | `tape` |
//! | value and partial derivatives of one operation | `operation` |
//! | value, gradient, Hessian | `expression` |

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod error;
mod expression;
mod operation;
mod parser;
mod tape;
#[cfg(test)]
mod tests;
mod token;

pub use error::{ParseError, Reason, Undefined, Want};
pub use expression::{Expression, Scratch, check_constants};

/// Names of the functions, which no variable or constant may have.
pub const FUNCTIONS: [&str; 10] = ["sqrt", "exp", "ln", "sin", "cos", "tan", "tanh", "abs", "min", "max"];

/// Name of π, which no variable or constant may have.
pub const PI: &str = "pi";
