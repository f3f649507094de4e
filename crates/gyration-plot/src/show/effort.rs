//! The power of the drive of each body that contracts, and its works, from the samples.
//!
//!   w = V Q·V_G,   W = ∫ w dt,   W⁺ = ∫ max(0, w) dt
//!
//! by the trapezoidal rule, w being taken as linear between samples. The ledger has W of all bodies together without
//! that error: what the sums miss of it tells how coarse the samples are.

use super::bodies::contracting_bodies;
use crate::cycle::rounded;
use crate::error::PlotError;
use crate::recorded::RecordedScene;

/// Arrays that the power is made of.
pub const ARRAYS: [&str; 2] = ["drive", "contraction_velocity"];
/// Works that miss the ledger's by more than this part are told.
const COARSE: f64 = 0.02;

/// A body that contracts, and its volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Driven {
    /// Its index.
    pub body: usize,
    /// V [m³].
    pub volume: f64,
}

impl Driven {
    /// The bodies that contract.
    ///
    /// # Errors
    /// [`PlotError::Nothing`] without any; [`PlotError::Attribute`] if the recording does not tell their volumes.
    pub fn all(recorded: &RecordedScene, what: &'static str) -> Result<Vec<Self>, PlotError> {
        let driven = |body: usize| {
            let volume = recorded.bodies[body].volume.ok_or_else(|| PlotError::Attribute {
                path: recorded.recording.path().to_path_buf(),
                name: "bodies",
                reason: format!("{} has no volume", recorded.bodies[body].name),
            })?;
            Ok(Self { body, volume })
        };
        contracting_bodies(recorded, what)?.into_iter().map(driven).collect()
    }

    /// w [W], from rows of [`ARRAYS`].
    pub fn power(&self, row: &[&[f64]]) -> f64 {
        let entries = 9 * self.body..9 * self.body + 9;
        let inner: f64 = row[0][entries.clone()].iter().zip(&row[1][entries]).map(|(q, v)| q * v).sum();
        self.volume * inner
    }
}

/// The works of a drive since the first sample.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Works {
    /// W [J].
    pub net: f64,
    /// W⁺ [J].
    pub positive: f64,
    previous: Option<(f64, f64)>,
}

impl Works {
    /// Takes the power [W] of the next sample.
    pub fn push(&mut self, time: f64, power: f64) {
        if let Some((before, old)) = self.previous {
            let half = 0.5 * (time - before);
            self.net += half * (old + power);
            let (up, down) = (old.max(power), old.min(power));
            // Where the sign changes, the triangle above zero.
            self.positive +=
                half * if down >= 0.0 { old + power } else { up.max(0.0).powi(2) / (up - down).max(f64::MIN_POSITIVE) };
        }
        self.previous = Some((time, power));
    }
}

/// A remark where the works of all bodies [J] miss the ledger's.
pub fn sampling(recorded: &RecordedScene, works: &[Works]) -> Result<Option<String>, PlotError> {
    let last = recorded.rows().end - 1;
    let ledger = recorded.recording.read_rows("work_drive", last..last + 1)?.data[0];
    let (net, positive) = works.iter().fold((0.0, 0.0), |sum, works| (sum.0 + works.net, sum.1 + works.positive));
    let missed = (net - ledger).abs() / positive.max(ledger.abs());
    Ok((missed > COARSE).then(|| format!("sampled coarsely: off by {} %", rounded(100.0 * missed))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positive_work_counts_what_is_above_zero() {
        let mut works = Works::default();
        // Two triangles of area ½ and 1 above zero, one of ½ and one of 1 below.
        for (time, power) in [(0.0, 0.0), (1.0, 1.0), (3.0, -1.0), (4.0, 0.0), (5.0, -1.0), (6.0, 1.0), (7.0, 0.0)] {
            works.push(time, power);
        }
        assert_eq!((works.net, works.positive), (0.0, 1.75));
    }

    #[test]
    fn power_that_stays_zero_does_no_work() {
        let mut works = Works::default();
        [0.0, 1.0, 2.0].into_iter().for_each(|time| works.push(time, 0.0));
        assert_eq!((works.net, works.positive), (0.0, 0.0));
    }
}
