//! Everything that the next step depends on, as plain numbers: a checkpoint.
//!
//! A run continued from a `Memory` makes the same steps, to the last bit, as one that was never interrupted: state,
//! rate (that of the projected state), the error allowed there, step, error history, the collocation polynomial from
//! which Newton's method starts, the votes for another stepper, and the counters. A system may find its error scales by
//! a search whose last digit depends on where it began; so they are kept, and never found anew at the start of a step.
//! Options and system are the caller's to repeat. The interpolant of the last step is not part of it: sample before you
//! stop.

use crate::auto::Switch;
use crate::context::Point;
use crate::control::StepControl;
use crate::radau::MOST_STAGES;
use crate::report::{Statistics, Stepper};
use crate::stages::StageVectors;

/// The version of the layout of the numbers.
const VERSION: u64 = 6;
/// The integers before and besides the vectors.
const INTEGERS: usize = 19;
/// The reals besides the vectors.
const REALS: usize = 12;

/// A checkpoint as two vectors of plain numbers, to be stored without loss.
///
/// `integers` begins with the version, the number of components of y and that of w; `reals` begins with the time, then
/// y, then w, then what they lack.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Memory {
    /// Times, states, steps, errors.
    pub reals: Vec<f64>,
    /// Version, sizes, flags, counters.
    pub integers: Vec<u64>,
}

impl Memory {
    /// The time of the checkpoint; NaN if the memory is empty.
    pub fn time(&self) -> f64 {
        self.reals.first().copied().unwrap_or(f64::NAN)
    }
}

/// A memory that no integrator has written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MemoryError {
    /// Written by a version with another layout.
    #[error("the checkpoint has layout {found}, this program reads {VERSION}")]
    Version {
        /// The version found.
        found: u64,
    },
    /// Numbers are missing or left over.
    #[error("the checkpoint holds {integers} integers and {reals} reals, not what its sizes ask for")]
    Length {
        /// The number of integers found.
        integers: usize,
        /// The number of reals found.
        reals: usize,
    },
    /// Of an implicit method of another order than is asked for.
    #[error("the checkpoint is of an implicit method of order {found}, not of the one asked for")]
    Order {
        /// The order found.
        found: usize,
    },
    /// A number that no run comes to.
    #[error("the checkpoint holds {what} that no run comes to")]
    Number {
        /// Which.
        what: &'static str,
    },
}

/// Counters of a run stay below this one.
pub const MOST_COUNTED: u64 = 1 << 62;

/// The state between two steps, in a form that can be computed with.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StepperState {
    /// Number of components of y.
    pub dimension: usize,
    /// Whether rate and step are known.
    pub started: bool,
    /// The next step to try.
    pub step: f64,
    /// The stepper to try it with.
    pub stepper: Stepper,
    /// The error history.
    pub control: StepControl,
    /// The speed at which Newton's method last converged, θ/(1 − θ).
    pub contraction: f64,
    /// The step of the collocation polynomial; 0 if the last step left none.
    pub collocation_step: f64,
    /// The votes for another stepper.
    pub switch: Switch,
    /// The counters.
    pub statistics: Statistics,
}

/// The vectors of a checkpoint: u = (y, w), what it lacks, its rate, the error allowed, and the collocation polynomial
/// (as often as long as there are stages).
pub(crate) struct CheckpointVectors {
    pub t: f64,
    pub u: Vec<f64>,
    pub low: Vec<f64>,
    pub rate: Vec<f64>,
    pub scale: Vec<f64>,
    pub collocation: Vec<f64>,
    pub stages: usize,
}

/// How many vectors there are besides the polynomial.
const VECTORS: usize = 4;

/// Writes a checkpoint, in the place of what stands in the memory.
pub(crate) fn encode(memory: &mut Memory, progress: &StepperState, point: &Point, collocation: &StageVectors) {
    let Point { t, u, low, rate, scale } = point;
    let StepperState { control, switch, .. } = progress;
    let (counters, [smallest_step, largest_step]) = progress.statistics.numbers();
    let Memory { reals, integers } = memory;
    reals.clear();
    integers.clear();
    integers.extend_from_slice(&[
        VERSION,
        progress.dimension as u64,
        (u.len() - progress.dimension) as u64,
        u64::from(progress.started),
        u64::from(progress.stepper == Stepper::Implicit),
        switch.votes,
        switch.stay,
        switch.bar,
        switch.patience,
        collocation.stages() as u64,
    ]);
    integers.extend_from_slice(&counters);
    reals.reserve(REALS + (VECTORS + collocation.stages()) * u.len());
    reals.push(*t);
    reals.extend_from_slice(u);
    reals.extend_from_slice(low);
    reals.extend_from_slice(rate);
    reals.extend_from_slice(scale);
    reals.extend_from_slice(collocation.numbers());
    reals.extend_from_slice(&[
        progress.step,
        control.explicit_error,
        control.explicit_step,
        control.implicit_error,
        control.implicit_step,
        progress.contraction,
        progress.collocation_step,
        smallest_step,
        largest_step,
        control.refused,
        control.heeded,
    ]);
}

/// Reads a checkpoint.
///
/// # Errors
/// `MemoryError` if the numbers are not those of a checkpoint.
pub(crate) fn decode(memory: &Memory) -> Result<(StepperState, CheckpointVectors), MemoryError> {
    let (ints, reals) = (&memory.integers, &memory.reals);
    let found = ints.first().copied().unwrap_or(0);
    if found != VERSION {
        return Err(MemoryError::Version { found });
    }
    let wrong = MemoryError::Length { integers: ints.len(), reals: reals.len() };
    if ints.len() != INTEGERS || reals.len() < REALS {
        return Err(wrong);
    }
    let stages = ints[9];
    if !(1..=MOST_STAGES as u64).contains(&stages) {
        return Err(MemoryError::Number { what: "a number of stages" });
    }
    let vectors = VECTORS + stages as usize;
    let width = (reals.len() - REALS) / vectors;
    let (dimension, quadratures) = (ints[1], ints[2]);
    if dimension.checked_add(quadratures) != Some(width as u64) || reals.len() != REALS + vectors * width {
        return Err(wrong);
    }
    let counters = ints[INTEGERS - 9..].try_into().map_err(|_| wrong)?;
    let (vectors, rest) = reals[1..].split_at(vectors * width);
    let vectors = CheckpointVectors {
        t: reals[0],
        u: vectors[..width].to_vec(),
        low: vectors[width..2 * width].to_vec(),
        rate: vectors[2 * width..3 * width].to_vec(),
        scale: vectors[3 * width..4 * width].to_vec(),
        collocation: vectors[VECTORS * width..].to_vec(),
        stages: stages as usize,
    };
    let progress = StepperState {
        dimension: dimension as usize,
        started: ints[3] != 0,
        step: rest[0],
        stepper: if ints[4] != 0 { Stepper::Implicit } else { Stepper::Explicit },
        control: StepControl {
            explicit_error: rest[1],
            explicit_step: rest[2],
            implicit_error: rest[3],
            implicit_step: rest[4],
            refused: rest[9],
            heeded: rest[10],
        },
        contraction: rest[5],
        collocation_step: rest[6],
        switch: Switch { votes: ints[5], stay: ints[6], bar: ints[7], patience: ints[8] },
        statistics: Statistics::of_numbers(counters, [rest[7], rest[8]]),
    };
    progress.checked(&vectors)?;
    Ok((progress, vectors))
}

impl StepperState {
    /// Whether a run can come to these numbers.
    fn checked(&self, vectors: &CheckpointVectors) -> Result<(), MemoryError> {
        let StepperState { step, collocation_step, switch, statistics, .. } = self;
        let (counters, steps) = statistics.numbers();
        let votes = [switch.votes, switch.stay, switch.bar, switch.patience];
        let is_length = |step: &f64| *step >= 0.0 && *step < f64::INFINITY;
        let wrong = [
            (!vectors.t.is_finite(), "a time"),
            (![*step, *collocation_step].iter().chain(&steps).all(is_length), "a step"),
            (counters.iter().chain(&votes).any(|count| *count >= MOST_COUNTED), "a counter"),
            (!switch.is_patient(), "a choice of the stepper"),
        ];
        match wrong.into_iter().find(|(is_wrong, _)| *is_wrong) {
            Some((_, what)) => Err(MemoryError::Number { what }),
            None => Ok(()),
        }
    }
}
