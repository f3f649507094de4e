//! An expression, and its value, gradient and Hessian.
//!
//! Of the tape v_k = f_k(v_a, v_b), backwards: v̄_a += v̄_k ∂f_k/∂v_a, which gives the gradient. The column of the
//! Hessian that belongs to x_i follows from the derivative of both sweeps along x_i, v̇_k forwards and (v̄_k)˙
//! backwards. Operations that do not enter the value, as the greater operand of `min`, are asked for no derivative.

use crate::error::{ParseError, Undefined, Want};
use crate::operation::{Operation, Partials};
use crate::parser::{Names, Parser};
use crate::tape::{Step, Tape};
use crate::token::words;
use crate::{FUNCTIONS, PI};

/// An expression of named variables, read once.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    text: String,
    tape: Tape,
    /// Number of variables it may have, whether it has them or not.
    variables: usize,
    /// Variables that occur and by which derivatives are taken, with their places in the tape, in ascending order.
    free: Vec<(usize, usize)>,
    /// Tells for each step of the tape whether one of `free` enters it.
    varies: Vec<bool>,
}

/// Numbers kept between the sweeps over an expression. One serves any number of expressions, one after the other, and
/// allocates only when an expression is longer than all before it.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    values: Vec<f64>,
    partials: Vec<Partials>,
    reached: Vec<bool>,
    adjoints: Vec<f64>,
    tangents: Vec<f64>,
    adjoint_tangents: Vec<f64>,
    /// The switching functions of what is evaluated, where they are taken down.
    switching: Option<Vec<f64>>,
}

impl Scratch {
    /// Takes down, from now on, the switching functions of each value that is computed: a of |a|, a − b of min(a, b)
    /// and max(a, b), in the order of the text. Where one of them changes its sign the value goes over to another
    /// formula.
    pub fn watch_switching(&mut self) {
        self.switching = Some(Vec::new());
    }

    /// What was taken down, and no longer from now on.
    pub fn take_switching(&mut self) -> Vec<f64> {
        self.switching.take().unwrap_or_default()
    }

    fn fit(&mut self, steps: usize) {
        for numbers in [&mut self.values, &mut self.adjoints, &mut self.tangents, &mut self.adjoint_tangents] {
            numbers.resize(steps, 0.0);
        }
        self.partials.resize(steps, Partials::default());
        self.reached.resize(steps, false);
    }
}

impl Expression {
    /// Reads `text`, an expression of `variables` and `constants`, whose values take the place of their names.
    ///
    /// Of two constants of one name the first counts.
    ///
    /// # Errors
    /// [`ParseError`] with the column if the text does not parse, or with the name of a constant that is none.
    pub fn parse(text: &str, variables: &[&str], constants: &[(String, f64)]) -> Result<Self, ParseError> {
        check_constants(variables, constants)?;
        let words = words(text)?;
        let tape = Parser::new(&words, Names { variables, constants }).expression()?;
        let mut expression =
            Self { text: text.to_owned(), tape, variables: variables.len(), free: Vec::new(), varies: Vec::new() };
        expression.let_free(&[]);
        Ok(expression)
    }

    /// The same expression without derivatives by the variables `held`: their entries are zero, and cost nothing.
    #[must_use]
    pub fn holding(mut self, held: &[usize]) -> Self {
        self.let_free(held);
        self
    }

    fn let_free(&mut self, held: &[usize]) {
        self.free.clear();
        self.varies.clear();
        for (place, step) in self.tape.steps.iter().enumerate() {
            let varies = match step.operation {
                Operation::Variable(index) => {
                    let free = !held.contains(&index);
                    if free {
                        self.free.push((index, place));
                    }
                    free
                }
                other => {
                    let (a, b) = other.operands();
                    [a, b].into_iter().flatten().any(|operand| self.varies[operand])
                }
            };
            self.varies.push(varies);
        }
        self.free.sort_unstable();
    }

    /// The text as it was read.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Number of variables that it was read with.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// True if the variable of that index occurs in it.
    pub fn uses(&self, variable: usize) -> bool {
        self.tape.steps.iter().any(|step| step.operation == Operation::Variable(variable))
    }

    /// The variables that occur and by which derivatives are taken, in ascending order.
    pub fn free(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.free.iter().map(|(index, _)| *index)
    }

    /// The number that it is, if no variable occurs.
    pub fn constant(&self) -> Option<f64> {
        match self.tape.steps.last().map(|step| step.operation) {
            Some(Operation::Constant(value)) => Some(value),
            _ => None,
        }
    }

    /// Degree of the polynomial in the variables `by` that it is as written, the others taken as numbers; none if it is
    /// no polynomial. Terms that cancel count.
    pub fn degree(&self, by: &[usize]) -> Option<usize> {
        use crate::operation::Binary;
        let mut degrees: Vec<Option<usize>> = Vec::with_capacity(self.tape.steps.len());
        for Step { operation, .. } in &self.tape.steps {
            // A step without `by` is a number, whatever is computed of it.
            let number = |place: usize| degrees[place] == Some(0);
            let degree = match *operation {
                Operation::Variable(index) => Some(usize::from(by.contains(&index))),
                Operation::Constant(_) => Some(0),
                Operation::Negative(a) => degrees[a],
                Operation::Whole(a, n) if n >= 0 => degrees[a].map(|degree| degree.saturating_mul(n as usize)),
                Operation::Whole(a, _) | Operation::Constantly(a, _) | Operation::Of(_, a) => number(a).then_some(0),
                Operation::Between(Binary::Add | Binary::Subtract, a, b) => {
                    degrees[a].zip(degrees[b]).map(|(a, b)| a.max(b))
                }
                Operation::Between(Binary::Multiply, a, b) => {
                    degrees[a].zip(degrees[b]).map(|(a, b)| a.saturating_add(b))
                }
                Operation::Between(Binary::Divide, a, b) => degrees[a].filter(|_| number(b)),
                Operation::Between(Binary::Power | Binary::Minimum | Binary::Maximum, a, b) => {
                    (number(a) && number(b)).then_some(0)
                }
            };
            degrees.push(degree);
        }
        degrees.last().copied().flatten()
    }

    /// Value at `variables`.
    ///
    /// # Errors
    /// [`Undefined`] where an operation has no finite value.
    ///
    /// # Panics
    /// If there are fewer numbers than variables.
    pub fn value(&self, variables: &[f64], scratch: &mut Scratch) -> Result<f64, Undefined> {
        scratch.fit(self.tape.steps.len());
        let mut last = 0.0;
        for (place, step) in self.tape.steps.iter().enumerate() {
            last = step.operation.value(variables, &scratch.values).map_err(|lack| step.undefined(lack))?;
            scratch.values[place] = last;
        }
        if let Some(switching) = &mut scratch.switching {
            let values = &scratch.values;
            switching.extend(self.tape.steps.iter().filter_map(|step| step.operation.switching(values)));
        }
        Ok(last)
    }

    /// Value at `variables`, and ∂/∂x_i in `gradient`, zero where x_i does not occur or is held.
    ///
    /// # Errors
    /// [`Undefined`] where an operation has no finite value or first derivative.
    ///
    /// # Panics
    /// If there are fewer numbers or entries than variables.
    pub fn gradient(&self, variables: &[f64], scratch: &mut Scratch, gradient: &mut [f64]) -> Result<f64, Undefined> {
        let value = self.value(variables, scratch)?;
        self.sweep_back(scratch, false)?;
        self.read_gradient(scratch, gradient)?;
        Ok(value)
    }

    /// Value at `variables`, ∂/∂x_i in `gradient`, and ∂²/∂x_i∂x_j in `hessian`, row by row; it is symmetric to the
    /// last digit.
    ///
    /// # Errors
    /// [`Undefined`] where an operation has no finite value, first or second derivative.
    ///
    /// # Panics
    /// If there are fewer numbers or entries than variables, or fewer than their square.
    pub fn hessian(
        &self,
        variables: &[f64],
        scratch: &mut Scratch,
        gradient: &mut [f64],
        hessian: &mut [f64],
    ) -> Result<f64, Undefined> {
        let value = self.value(variables, scratch)?;
        self.sweep_back(scratch, true)?;
        self.read_gradient(scratch, gradient)?;
        hessian[..self.variables * self.variables].fill(0.0);
        for (number, &(row, place)) in self.free.iter().enumerate() {
            self.sweep_along(scratch, place);
            for &(column, place) in &self.free[..=number] {
                let entry = scratch.adjoint_tangents[place];
                if !entry.is_finite() {
                    return Err(self.overflow(Want::SecondDerivative, variables[row]));
                }
                hessian[row * self.variables + column] = entry;
                hessian[column * self.variables + row] = entry;
            }
        }
        Ok(value)
    }

    /// Partial derivatives and adjoints of all that enters the value, from the values.
    fn sweep_back(&self, scratch: &mut Scratch, second: bool) -> Result<(), Undefined> {
        scratch.adjoints.fill(0.0);
        scratch.reached.fill(false);
        let Some(last) = self.tape.steps.len().checked_sub(1) else { return Ok(()) };
        scratch.adjoints[last] = 1.0;
        scratch.reached[last] = self.varies[last];
        for (place, step) in self.tape.steps.iter().enumerate().rev() {
            if !scratch.reached[place] {
                continue;
            }
            let (a, b) = step.operation.operands();
            let (mut a, mut b) = (a.filter(|a| self.varies[*a]), b.filter(|b| self.varies[*b]));
            if let Operation::Between(binary, left, right) = step.operation {
                match binary.chooses(scratch.values[left], scratch.values[right]) {
                    Some(true) => a = None,
                    Some(false) => b = None,
                    None => {}
                }
            }
            let wanted = (a.is_some(), b.is_some());
            let partials = step
                .operation
                .partials(&scratch.values, scratch.values[place], wanted, second)
                .map_err(|lack| step.undefined(lack))?;
            scratch.partials[place] = partials;
            let adjoint = scratch.adjoints[place];
            for (operand, slope) in [(a, partials.a), (b, partials.b)] {
                if let Some(operand) = operand {
                    scratch.adjoints[operand] += adjoint * slope;
                    scratch.reached[operand] = true;
                }
            }
        }
        Ok(())
    }

    fn read_gradient(&self, scratch: &Scratch, gradient: &mut [f64]) -> Result<(), Undefined> {
        gradient[..self.variables].fill(0.0);
        for &(index, place) in &self.free {
            let entry = scratch.adjoints[place];
            if !entry.is_finite() {
                return Err(self.overflow(Want::Derivative, scratch.values[place]));
            }
            gradient[index] = entry;
        }
        Ok(())
    }

    /// Derivatives of values and adjoints along the variable at `along`.
    fn sweep_along(&self, scratch: &mut Scratch, along: usize) {
        scratch.tangents.fill(0.0);
        scratch.adjoint_tangents.fill(0.0);
        scratch.tangents[along] = 1.0;
        for (place, step) in self.tape.steps.iter().enumerate() {
            if !scratch.reached[place] || matches!(step.operation, Operation::Variable(_)) {
                continue;
            }
            let partials = scratch.partials[place];
            let (tangent_a, tangent_b) = scratch.operand_tangents(step.operation);
            scratch.tangents[place] = partials.a * tangent_a + partials.b * tangent_b;
        }
        for (place, step) in self.tape.steps.iter().enumerate().rev() {
            if !scratch.reached[place] {
                continue;
            }
            let partials = scratch.partials[place];
            let (tangent_a, tangent_b) = scratch.operand_tangents(step.operation);
            let (adjoint, turn) = (scratch.adjoints[place], scratch.adjoint_tangents[place]);
            let (a, b) = step.operation.operands();
            if let Some(a) = a {
                scratch.adjoint_tangents[a] +=
                    turn * partials.a + adjoint * (partials.aa * tangent_a + partials.ab * tangent_b);
            }
            if let Some(b) = b {
                scratch.adjoint_tangents[b] +=
                    turn * partials.b + adjoint * (partials.ab * tangent_a + partials.bb * tangent_b);
            }
        }
    }

    /// Fault of a derivative that is too large for a number, though all its factors are finite.
    fn overflow(&self, want: Want, argument: f64) -> Undefined {
        let last = self.tape.steps.last();
        Undefined {
            operation: last.map_or("constant", |step| step.operation.name()),
            column: last.map_or(1, |step| step.column),
            argument,
            want,
        }
    }
}

impl Scratch {
    fn operand_tangents(&self, operation: Operation) -> (f64, f64) {
        let (a, b) = operation.operands();
        let tangent = |operand: Option<usize>| operand.map_or(0.0, |operand| self.tangents[operand]);
        (tangent(a), tangent(b))
    }
}

/// Refuses constants whose names mean something else or cannot stand in a text, and values that are not finite.
///
/// # Errors
/// [`ParseError`] with the name of the first one that is none.
pub fn check_constants(variables: &[&str], constants: &[(String, f64)]) -> Result<(), ParseError> {
    for (name, value) in constants {
        let name = name.clone();
        let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !letters || name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(ParseError::ConstantName { name });
        }
        let taken_by = if variables.contains(&name.as_str()) {
            Some("a variable")
        } else if FUNCTIONS.contains(&name.as_str()) {
            Some("a function")
        } else {
            (name == PI).then_some("the number pi")
        };
        if let Some(taken_by) = taken_by {
            return Err(ParseError::ConstantTaken { name, taken_by });
        }
        if !value.is_finite() {
            return Err(ParseError::ConstantValue { name, value: *value });
        }
    }
    Ok(())
}
