//! How works change over a step of S, and the powers at its end, where the next one begins.

use nalgebra::DMatrix;

/// How works change over a step, a column for each number.
pub(super) struct WorkSlopes {
    /// W′ at the nodes, without what a shift in time does.
    pub nodes: Vec<DMatrix<f64>>,
    /// σ [g].
    pub shifted: DMatrix<f64>,
    /// g at the end.
    pub end: Vec<f64>,
}

/// The powers at the end of the last step.
#[derive(Default)]
pub(super) struct LastPowers(Option<(f64, Vec<f64>)>);

impl LastPowers {
    /// Forgets them: behind a kink they are others.
    pub fn forget(&mut self) {
        self.0 = None;
    }

    /// Those at a time, if they are known there.
    pub fn at(&self, time: f64) -> Option<&[f64]> {
        self.0.as_ref().filter(|(known, _)| *known == time).map(|(_, powers)| powers.as_slice())
    }

    /// Takes those at the end of a step that has been taken.
    pub fn take(&mut self, time: f64, slopes: WorkSlopes) {
        self.0 = Some((time, slopes.end));
    }
}
