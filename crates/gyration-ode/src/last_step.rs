//! The last step as plain numbers: what a checkpoint does not have, and an interpolant needs.
//!
//! An integrator that is made of a [`Memory`] and of these numbers gives the same values within the last step as the
//! one that they are of, and goes on to the same bytes. So somebody else may have made the step.

use crate::explicit::Explicit;
use crate::integrator::{Integrator, LastStep};
use crate::interpolant::interpolated_stages;
use crate::memory::{Memory, MemoryError};
use crate::report::{Limit, Options, StepReport, Stepper};

impl Integrator {
    /// The last step: its size, where it began, the state there and what that lacks, and of an explicit one the rates
    /// of its stages; empty where nothing can be interpolated.
    pub fn last_step_numbers(&self) -> Vec<f64> {
        if self.last == LastStep::None {
            return Vec::new();
        }
        let mut numbers = vec![self.last_size, self.other.t];
        numbers.extend_from_slice(&self.other.u);
        numbers.extend_from_slice(&self.other.low);
        if self.last == LastStep::Explicit {
            interpolated_stages().for_each(|stage| numbers.extend_from_slice(self.explicit.rates_of(stage)));
        }
        numbers
    }

    /// [`Integrator::resume`] with the last step, of which these are the numbers.
    ///
    /// # Errors
    /// `MemoryError` if the numbers are not those of a checkpoint and of a step that led to it.
    pub fn resume_within(memory: &Memory, last_step: &[f64], options: Options) -> Result<Self, MemoryError> {
        let mut this = Self::resume(memory, options)?;
        let [size, start, vectors @ ..] = last_step else {
            return if last_step.is_empty() { Ok(this) } else { Err(MemoryError::Number { what: "a last step" }) };
        };
        let width = this.current.u.len();
        let with_rates = width * (2 + interpolated_stages().count());
        if !(vectors.len() == 2 * width || vectors.len() == with_rates) || !(*start < this.current.t && *size > 0.0) {
            return Err(MemoryError::Number { what: "a last step" });
        }
        (this.last_size, this.other.t) = (*size, *start);
        let (u, rest) = vectors.split_at(width);
        let (low, rates) = rest.split_at(width);
        this.other.u.copy_from_slice(u);
        this.other.low.copy_from_slice(low);
        this.last = LastStep::Collocation;
        if vectors.len() == with_rates {
            this.last = LastStep::Explicit;
            this.explicit = Explicit::new(width);
            for (place, stage) in interpolated_stages().enumerate() {
                this.explicit.put_rates(stage, &rates[place * width..(place + 1) * width]);
            }
        }
        Ok(this)
    }
}

impl StepReport {
    /// The report as numbers.
    pub fn numbers(&self) -> [u64; 8] {
        let (limit, component) = match self.limit {
            Limit::Error { component } => (0, component as u64),
            Limit::Stability => (1, 0),
            Limit::Domain => (2, 0),
            Limit::Newton => (3, 0),
            Limit::MaxStep => (4, 0),
            Limit::End => (5, 0),
        };
        let reals = [self.start, self.end, self.error, self.projection];
        let [start, end, error, projection] = reals.map(f64::to_bits);
        let stepper = u64::from(self.stepper == Stepper::Implicit);
        [start, end, error, projection, stepper, limit, component, u64::from(self.rejections)]
    }

    /// From the numbers of a report; none where they are not.
    pub fn of_numbers(
        [start, end, error, projection, stepper, limit, component, rejections]: [u64; 8],
    ) -> Option<Self> {
        let limit = match limit {
            0 => Limit::Error { component: usize::try_from(component).ok()? },
            1 => Limit::Stability,
            2 => Limit::Domain,
            3 => Limit::Newton,
            4 => Limit::MaxStep,
            5 => Limit::End,
            _ => return None,
        };
        let stepper = if stepper == 0 { Stepper::Explicit } else { Stepper::Implicit };
        let [start, end, error, projection] = [start, end, error, projection].map(f64::from_bits);
        Some(Self { start, end, stepper, limit, error, projection, rejections: u32::try_from(rejections).ok()? })
    }
}
