//! Value and partial derivatives of one operation, and the places where it has none.

use crate::error::Want;

/// Functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Tanh,
    Abs,
}

/// Operations of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    /// a^b, b not a constant.
    Power,
    Minimum,
    Maximum,
}

/// A step of the tape; operands are places further ahead in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Operation {
    Variable(usize),
    Constant(f64),
    Negative(usize),
    /// aⁿ by products.
    Whole(usize, i32),
    /// aᶜ of a constant c that is no whole number.
    Constantly(usize, f64),
    Of(Function, usize),
    Between(Binary, usize, usize),
}

/// First and second partial derivatives of an operation by its operands a and b.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Partials {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) aa: f64,
    pub(crate) ab: f64,
    pub(crate) bb: f64,
}

/// Lack of an operation, and the argument at which it is found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lack {
    pub(crate) want: Want,
    pub(crate) argument: f64,
}

impl Function {
    pub(crate) fn named(name: &str) -> Option<Function> {
        Some(match name {
            "sqrt" => Function::Sqrt,
            "exp" => Function::Exp,
            "ln" => Function::Ln,
            "sin" => Function::Sin,
            "cos" => Function::Cos,
            "tan" => Function::Tan,
            "tanh" => Function::Tanh,
            "abs" => Function::Abs,
            _ => return None,
        })
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Function::Sqrt => "sqrt",
            Function::Exp => "exp",
            Function::Ln => "ln",
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Tanh => "tanh",
            Function::Abs => "abs",
        }
    }

    fn value(self, a: f64) -> f64 {
        match self {
            Function::Sqrt => libm::sqrt(a),
            Function::Exp => libm::exp(a),
            Function::Ln => libm::log(a),
            Function::Sin => libm::sin(a),
            Function::Cos => libm::cos(a),
            Function::Tan => libm::tan(a),
            Function::Tanh => libm::tanh(a),
            Function::Abs => a.abs(),
        }
    }

    /// f′ and f″ at a, where f is `value`.
    fn slopes(self, a: f64, value: f64) -> (f64, f64) {
        match self {
            Function::Sqrt => (0.5 / value, -0.25 / (a * value)),
            Function::Exp => (value, value),
            Function::Ln => (1.0 / a, -1.0 / (a * a)),
            Function::Sin => (libm::cos(a), -value),
            Function::Cos => (-libm::sin(a), -value),
            Function::Tan => {
                let slope = 1.0 + value * value;
                (slope, 2.0 * value * slope)
            }
            // 1/cosh², since 1 − tanh² has no digits where tanh is nearly one.
            Function::Tanh => {
                let secant = 1.0 / libm::cosh(a);
                let slope = secant * secant;
                (slope, -2.0 * value * slope)
            }
            // NaN at zero, where |a| has no derivative.
            Function::Abs => (if a == 0.0 { f64::NAN } else { a.signum() }, 0.0),
        }
    }
}

impl Operation {
    /// Name of the operation in the text.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Operation::Variable(_) => "variable",
            Operation::Constant(_) => "constant",
            Operation::Of(function, _) => function.name(),
            Operation::Whole(..) | Operation::Constantly(..) | Operation::Between(Binary::Power, ..) => "^",
            Operation::Negative(_) | Operation::Between(Binary::Subtract, ..) => "-",
            Operation::Between(Binary::Add, ..) => "+",
            Operation::Between(Binary::Multiply, ..) => "*",
            Operation::Between(Binary::Divide, ..) => "/",
            Operation::Between(Binary::Minimum, ..) => "min",
            Operation::Between(Binary::Maximum, ..) => "max",
        }
    }

    /// Places of the operands.
    pub(crate) fn operands(self) -> (Option<usize>, Option<usize>) {
        match self {
            Operation::Variable(_) | Operation::Constant(_) => (None, None),
            Operation::Negative(a) | Operation::Whole(a, _) | Operation::Constantly(a, _) | Operation::Of(_, a) => {
                (Some(a), None)
            }
            Operation::Between(_, a, b) => (Some(a), Some(b)),
        }
    }

    /// The number at whose zero it goes over to another formula, of the values of the operands; none of one that is
    /// smooth.
    pub(crate) fn switching(self, values: &[f64]) -> Option<f64> {
        match self {
            Operation::Of(Function::Abs, a) => Some(values[a]),
            Operation::Between(Binary::Minimum | Binary::Maximum, a, b) => Some(values[a] - values[b]),
            _ => None,
        }
    }

    /// Value, of `variables` and the values of the operands.
    pub(crate) fn value(self, variables: &[f64], values: &[f64]) -> Result<f64, Lack> {
        let value = match self {
            Operation::Variable(index) => variables[index],
            Operation::Constant(value) => value,
            Operation::Negative(a) => -values[a],
            Operation::Whole(a, exponent) => whole_power(values[a], exponent),
            Operation::Constantly(a, exponent) => libm::pow(values[a], exponent),
            Operation::Of(function, a) => function.value(values[a]),
            Operation::Between(binary, a, b) => binary.value(values[a], values[b]),
        };
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Lack { want: Want::Value, argument: self.argument(variables, values) })
        }
    }

    /// First partial derivatives by the operands that are `wanted` and, if `second`, second ones too; zero by the
    /// others. `value` is the operation's own.
    pub(crate) fn partials(
        self,
        values: &[f64],
        value: f64,
        wanted: (bool, bool),
        second: bool,
    ) -> Result<Partials, Lack> {
        let mut partials = match self {
            Operation::Variable(_) | Operation::Constant(_) => Partials::default(),
            Operation::Negative(_) => Partials { a: -1.0, ..Partials::default() },
            Operation::Whole(a, n) => whole_slopes(values[a], n),
            Operation::Constantly(a, c) => constant_slopes(values[a], c),
            Operation::Of(function, a) => {
                let (first, second) = function.slopes(values[a], value);
                Partials { a: first, aa: second, ..Partials::default() }
            }
            Operation::Between(binary, a, b) => binary.partials(values[a], values[b], value),
        };
        if !wanted.0 {
            (partials.a, partials.aa, partials.ab) = (0.0, 0.0, 0.0);
        }
        if !wanted.1 {
            (partials.b, partials.ab, partials.bb) = (0.0, 0.0, 0.0);
        }
        let lack = |want| Lack { want, argument: self.argument(&[], values) };
        if !(partials.a.is_finite() && partials.b.is_finite()) {
            return Err(lack(Want::Derivative));
        }
        if !second {
            (partials.aa, partials.ab, partials.bb) = (0.0, 0.0, 0.0);
        } else if !(partials.aa.is_finite() && partials.ab.is_finite() && partials.bb.is_finite()) {
            return Err(lack(Want::SecondDerivative));
        }
        Ok(partials)
    }

    /// The number to tell of where the operation is undefined: a divisor, a base, an argument.
    fn argument(self, variables: &[f64], values: &[f64]) -> f64 {
        match self {
            Operation::Variable(index) => variables.get(index).copied().unwrap_or(f64::NAN),
            Operation::Constant(value) => value,
            Operation::Between(Binary::Divide, _, b) => values[b],
            Operation::Negative(a)
            | Operation::Whole(a, _)
            | Operation::Constantly(a, _)
            | Operation::Of(_, a)
            | Operation::Between(_, a, _) => values[a],
        }
    }
}

impl Binary {
    fn value(self, a: f64, b: f64) -> f64 {
        match self {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            // A negative base has a power of whole exponents only, and those are constants: `Whole`.
            Binary::Power if a < 0.0 => f64::NAN,
            Binary::Power => libm::pow(a, b),
            Binary::Minimum => {
                if b < a {
                    b
                } else {
                    a
                }
            }
            Binary::Maximum => {
                if b > a {
                    b
                } else {
                    a
                }
            }
        }
    }

    fn partials(self, a: f64, b: f64, value: f64) -> Partials {
        let chosen = |second: bool| Partials { a: f64::from(!second), b: f64::from(second), ..Partials::default() };
        match self {
            Binary::Add => Partials { a: 1.0, b: 1.0, ..Partials::default() },
            Binary::Subtract => Partials { a: 1.0, b: -1.0, ..Partials::default() },
            Binary::Multiply => Partials { a: b, b: a, ab: 1.0, ..Partials::default() },
            Binary::Divide => {
                let inverse = 1.0 / b;
                let by_b = -value * inverse;
                Partials { a: inverse, b: by_b, aa: 0.0, ab: -inverse * inverse, bb: -2.0 * by_b * inverse }
            }
            // NaN at a = 0, where the logarithm of the base ends.
            Binary::Power => {
                let logarithm = libm::log(a);
                let slope = b * libm::pow(a, b - 1.0);
                Partials {
                    a: slope,
                    b: value * logarithm,
                    aa: b * (b - 1.0) * libm::pow(a, b - 2.0),
                    ab: libm::pow(a, b - 1.0) + slope * logarithm,
                    bb: value * logarithm * logarithm,
                }
            }
            Binary::Minimum => chosen(b < a),
            Binary::Maximum => chosen(b > a),
        }
    }

    /// The operand that the value is, of a minimum or maximum: `Some(true)` is b.
    pub(crate) fn chooses(self, a: f64, b: f64) -> Option<bool> {
        match self {
            Binary::Minimum => Some(b < a),
            Binary::Maximum => Some(b > a),
            Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Power => None,
        }
    }
}

/// aⁿ by repeated squares.
pub(crate) fn whole_power(a: f64, n: i32) -> f64 {
    let (mut power, mut square, mut left) = (1.0, a, n.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power *= square;
        }
        left >>= 1;
        if left > 0 {
            square *= square;
        }
    }
    if n < 0 { 1.0 / power } else { power }
}

fn whole_slopes(a: f64, n: i32) -> Partials {
    let exponent = f64::from(n);
    let first = if n == 0 { 0.0 } else { exponent * whole_power(a, n.saturating_sub(1)) };
    let second = match n {
        0 | 1 => 0.0,
        _ => exponent * (exponent - 1.0) * whole_power(a, n.saturating_sub(2)),
    };
    Partials { a: first, aa: second, ..Partials::default() }
}

fn constant_slopes(a: f64, c: f64) -> Partials {
    Partials { a: c * libm::pow(a, c - 1.0), aa: c * (c - 1.0) * libm::pow(a, c - 2.0), ..Partials::default() }
}
