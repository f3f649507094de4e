//! Operations in the order in which they are computed, operands before what is made of them.
//!
//! Operations of constants alone are computed when the tape is made. A variable stands in the tape once.

use crate::error::{ParseError, Reason, Undefined};
use crate::operation::{Binary, Function, Lack, Operation};

/// An operation and its column in the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) operation: Operation,
    pub(crate) column: usize,
}

impl Step {
    /// Lack of the step, with its place in the text.
    pub(crate) fn undefined(&self, lack: Lack) -> Undefined {
        Undefined { operation: self.operation.name(), column: self.column, argument: lack.argument, want: lack.want }
    }
}

/// Largest whole exponent that is computed by products.
const LARGEST_EXPONENT: f64 = 1e9;

/// The steps, the last of which is the value of the expression.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tape {
    pub(crate) steps: Vec<Step>,
}

impl Tape {
    pub(crate) fn constant(&mut self, value: f64, column: usize) -> usize {
        self.push(Operation::Constant(value), column)
    }

    pub(crate) fn variable(&mut self, index: usize, column: usize) -> usize {
        let known = self.steps.iter().position(|step| step.operation == Operation::Variable(index));
        known.unwrap_or_else(|| self.push(Operation::Variable(index), column))
    }

    pub(crate) fn negative(&mut self, a: usize, column: usize) -> Result<usize, ParseError> {
        self.compute(Operation::Negative(a), column)
    }

    pub(crate) fn function(&mut self, function: Function, a: usize, column: usize) -> Result<usize, ParseError> {
        self.compute(Operation::Of(function, a), column)
    }

    pub(crate) fn binary(&mut self, binary: Binary, a: usize, b: usize, column: usize) -> Result<usize, ParseError> {
        self.compute(Operation::Between(binary, a, b), column)
    }

    /// a^b: by products where b is a whole constant.
    pub(crate) fn power(&mut self, a: usize, b: usize, column: usize) -> Result<usize, ParseError> {
        let Some(exponent) = self.constant_at(b) else {
            return self.binary(Binary::Power, a, b, column);
        };
        self.drop_last(b);
        let whole = exponent.fract() == 0.0 && exponent.abs() <= LARGEST_EXPONENT;
        let power = if whole { Operation::Whole(a, exponent as i32) } else { Operation::Constantly(a, exponent) };
        self.compute(power, column)
    }

    fn push(&mut self, operation: Operation, column: usize) -> usize {
        self.steps.push(Step { operation, column });
        self.steps.len() - 1
    }

    fn constant_at(&self, place: usize) -> Option<f64> {
        match self.steps[place].operation {
            Operation::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// A constant stands last when it is an operand of what comes next, for only variables are shared.
    fn drop_last(&mut self, place: usize) {
        debug_assert_eq!(place + 1, self.steps.len(), "a constant operand stands last");
        self.steps.truncate(place);
    }

    /// Appends `operation`, or its value if its operands are constants.
    fn compute(&mut self, operation: Operation, column: usize) -> Result<usize, ParseError> {
        let operands = operation.operands();
        let constant = |place: Option<usize>| place.is_none_or(|place| self.constant_at(place).is_some());
        if !(constant(operands.0) && constant(operands.1)) {
            return Ok(self.push(operation, column));
        }
        let place = |place: Option<usize>| place.and_then(|place| self.constant_at(place)).unwrap_or(0.0);
        let values = [place(operands.0), place(operands.1)];
        let value = operation.with_operands(0, 1).value(&[], &values).map_err(|lack| ParseError::Text {
            column,
            reason: Reason::Constant { operation: operation.name(), argument: lack.argument },
        })?;
        for operand in [operands.1, operands.0].into_iter().flatten() {
            self.drop_last(operand);
        }
        Ok(self.constant(value, column))
    }
}

impl Operation {
    /// The same operation of other operands.
    fn with_operands(self, a: usize, b: usize) -> Operation {
        match self {
            Operation::Variable(_) | Operation::Constant(_) => self,
            Operation::Negative(_) => Operation::Negative(a),
            Operation::Whole(_, n) => Operation::Whole(a, n),
            Operation::Constantly(_, c) => Operation::Constantly(a, c),
            Operation::Of(function, _) => Operation::Of(function, a),
            Operation::Between(binary, ..) => Operation::Between(binary, a, b),
        }
    }
}
