//! The times of a strip in words.

use super::Strip;
use crate::chart::ticks::{decimals, prefix};

/// Times with more decimals than these have a unit with a prefix.
const MOST_DECIMALS: usize = 6;

/// Times in words.
pub(super) struct Clock {
    factor: f64,
    prefix: &'static str,
    decimals: usize,
}

impl Clock {
    pub fn words(&self, time: f64) -> String {
        let Self { factor, prefix, decimals } = *self;
        format!("{:.decimals$} {prefix}s", factor * time)
    }
}

impl Strip {
    /// How times are told: by decimals that tell them apart to a tenth of their distance.
    pub(super) fn clock(&self) -> Clock {
        let times = self.frames.iter().map(|frame| frame.time);
        let last = times.clone().fold(0.0, f64::max);
        let nearest = times.clone().zip(times.skip(1)).map(|(a, b)| b - a).fold(f64::INFINITY, f64::min);
        let told = |factor: f64| match nearest.is_finite() && nearest > 0.0 {
            true => decimals(factor * nearest) + 1,
            false => 3,
        };
        match told(1.0) {
            few if few <= MOST_DECIMALS => Clock { factor: 1.0, prefix: "", decimals: few },
            _ => {
                let (factor, prefix) = prefix(last);
                Clock { factor, prefix, decimals: told(factor) }
            }
        }
    }
}
