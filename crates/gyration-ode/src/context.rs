//! What a stepper works on: the system with its layout and counters, and instants of the solution.

use crate::extended::{Extended, ExtendedMut, two_sum};
use crate::layout::SystemLayout;
use crate::report::{Cause, Statistics};
use crate::system::System;

/// An instant of the solution: u = (y, w) and what its numbers lack, its rate and the error allowed there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Point {
    pub t: f64,
    pub u: Vec<f64>,
    /// What u lacks of the solution's twice as many digits (`extended`).
    pub low: Vec<f64>,
    pub rate: Vec<f64>,
    pub scale: Vec<f64>,
}

impl Point {
    pub fn new(t: f64, u: Vec<f64>) -> Self {
        let [low, rate, scale] = std::array::from_fn(|_| vec![0.0; u.len()]);
        Self { t, u, low, rate, scale }
    }

    /// Moves as much of what u lacks into it as it can hold.
    pub fn round(&mut self) {
        for (high, low) in self.u.iter_mut().zip(&mut self.low) {
            (*high, *low) = two_sum(*high, *low);
        }
    }

    /// u to all its digits.
    pub fn extended(&self) -> Extended<'_> {
        Extended { high: &self.u, low: &self.low }
    }
}

/// The system, with its layout and the counters, as a stepper sees it during an attempt.
pub(crate) struct Context<'a, S: System> {
    pub system: &'a mut S,
    pub layout: &'a SystemLayout,
    pub statistics: &'a mut Statistics,
}

impl<S: System> Context<'_, S> {
    /// Rates of u = (y, w), refused unless state and rates are finite.
    ///
    /// # Errors
    /// `Cause::Inadmissible` from the system, `Cause::NotFinite` with the index of the component in u.
    pub fn evaluate(&mut self, t: f64, u: Extended, rate: &mut [f64]) -> Result<(), Cause<S::Inadmissible>> {
        let n = self.layout.dimension;
        let y = Extended { high: &u.high[..n], low: &u.low[..n] };
        all_finite(y.high)?;
        let (dy, dw) = rate.split_at_mut(n);
        self.statistics.rate_evaluations += 1;
        self.system.extended_rates(t, y, dy, dw).map_err(Cause::Inadmissible)?;
        all_finite(rate)
    }

    /// Projects a new state and evaluates its rate, which so belongs to the projected state; returns the correction.
    ///
    /// # Errors
    /// As `evaluate`.
    pub fn land(&mut self, point: &mut Point) -> Result<f64, Cause<S::Inadmissible>> {
        let Point { t, u, low, rate, .. } = point;
        let n = self.layout.dimension;
        let (high, w) = u.split_at_mut(n);
        let correction = self.system.extended_project(*t, ExtendedMut { high, low: &mut low[..n] }, w);
        self.evaluate(*t, Extended { high: u, low }, rate)?;
        Ok(correction)
    }

    /// The error allowed at a point, which must be admissible.
    pub fn scales(&mut self, point: &mut Point) {
        let (y, w) = point.u.split_at(self.layout.dimension);
        let (y_scale, w_scale) = point.scale.split_at_mut(self.layout.dimension);
        self.system.error_scales(point.t, y, w, y_scale, w_scale);
    }
}

fn all_finite<I>(values: &[f64]) -> Result<(), Cause<I>> {
    // Without a branch for each, since all of them nearly always are: 0·x is zero unless x is infinite or not a number.
    let (chunks, rest) = values.as_chunks::<4>();
    let mut products = [0.0; 4];
    for chunk in chunks {
        products = std::array::from_fn(|i| products[i] + 0.0 * chunk[i]);
    }
    if products.iter().sum::<f64>() + rest.iter().map(|value| 0.0 * value).sum::<f64>() == 0.0 {
        return Ok(());
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(Cause::NotFinite { index }),
        None => Ok(()),
    }
}
