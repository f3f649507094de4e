//! What a mesh over the whole zone tells: gaps between branches, and the density of states.

use super::{BandRow, LatticeWaves, NoBands, PathPoint};
use gyration::tensor::Vec3;
use serde::Serialize;

/// Bins of the density of states.
const BINS: usize = 400;
/// A gap narrower than this part of its middle is rounding.
const NARROWEST: f64 = 1e-9;

/// Frequencies at which no wave runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BandGap {
    /// Its lower edge [rad/s].
    pub from: f64,
    /// Its upper edge [rad/s].
    pub to: f64,
    /// The branch below it.
    pub below: usize,
    /// Its width over its middle.
    pub width_over_middle: f64,
}

/// The density of states: how many branches there are in an interval of frequencies, of a mean wave vector.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StateDensity {
    /// ω in the middle of each bin [rad/s].
    pub omega: Vec<f64>,
    /// Branches per frequency [s]; their sum over the bins times the width is the number of branches.
    pub density: Vec<f64>,
}

/// What a mesh tells.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Zone {
    /// The gaps, ascending.
    pub gaps: Vec<BandGap>,
    /// The density of states.
    pub dos: StateDensity,
}

impl LatticeWaves {
    /// Looks at a mesh of so many wave vectors along each periodic direction.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn zone(&self, mesh: usize, periodic: &[bool]) -> Result<Zone, NoBands> {
        let counts: [usize; 3] =
            std::array::from_fn(|a| if periodic.get(a).copied().unwrap_or(false) { mesh.max(1) } else { 1 });
        let spacing = |a: usize| 1.0 / counts[a] as f64;
        let reciprocal = self.lattice.reciprocal();
        let steps: Vec<Vec3> = reciprocal.iter().enumerate().map(|(a, vector)| spacing(a) * vector).collect();
        let mut rows = Vec::new();
        for number in 0..counts.iter().product() {
            let place = [number % counts[0], number / counts[0] % counts[1], number / counts[0] / counts[1]];
            let kappa = std::array::from_fn(|a| place[a] as f64 * spacing(a));
            let point = PathPoint { kappa, along: [0.0; 3], label: None, is_vertex: false, begins: false };
            rows.push(self.row(&point, false)?);
        }
        Ok(Zone { gaps: gaps(&rows), dos: density(&rows, &steps, &counts) })
    }
}

/// Between which branches no frequency lies.
fn gaps(rows: &[BandRow]) -> Vec<BandGap> {
    let branches = rows.first().map_or(0, |row| row.branches.len());
    let omega = |row: &BandRow, branch: usize| row.branches[branch].omega;
    let gap = |below: usize| {
        let from = rows.iter().map(|row| omega(row, below)).fold(0.0, f64::max);
        let to = rows.iter().map(|row| omega(row, below + 1)).fold(f64::INFINITY, f64::min);
        let width_over_middle = 2.0 * (to - from) / (to + from);
        (width_over_middle > NARROWEST).then_some(BandGap { from, to, below, width_over_middle })
    };
    (0..branches.saturating_sub(1)).filter_map(gap).collect()
}

/// Each wave vector stands for the cell of the mesh about it, over which a frequency goes as its derivative says.
fn density(rows: &[BandRow], steps: &[Vec3], counts: &[usize; 3]) -> StateDensity {
    let width_of = |velocity: Option<Vec3>| {
        let along = steps.iter().zip(counts).filter(|(_, count)| **count > 1);
        velocity.map_or(0.0, |velocity| along.map(|(step, _)| velocity.dot(step).abs()).sum())
    };
    let all = || rows.iter().flat_map(|row| &row.branches);
    let most = all().map(|branch| branch.omega + 0.5 * width_of(branch.velocity)).fold(0.0, f64::max);
    let width = if most > 0.0 { most / BINS as f64 } else { 1.0 };
    let mut density = vec![0.0; BINS];
    let weight = 1.0 / (rows.len() as f64 * width);
    for branch in all() {
        let half = 0.5 * width_of(branch.velocity).max(1e-9 * width);
        let (low, high) = ((branch.omega - half) / width, (branch.omega + half) / width);
        let first = (low.max(0.0) as usize).min(BINS - 1);
        let last = (high as usize).min(BINS - 1);
        let mut given = 0.0;
        for (bin, density) in density.iter_mut().enumerate().take(last + 1).skip(first) {
            let part = (high.min(bin as f64 + 1.0) - low.max(bin as f64)).max(0.0) / (high - low);
            *density += weight * part;
            given += part;
        }
        // Below zero there are no frequencies: what would lie there comes back.
        density[first] += weight * (1.0 - given);
    }
    let omega = (0..BINS).map(|bin| (bin as f64 + 0.5) * width).collect();
    StateDensity { omega, density }
}
