//! Free ends of a lattice that swallow waves.

use crate::check::Reporter;
use crate::file;
use crate::key::Key;
use gyration::body::Body;
use gyration::lattice::Cell;
use gyration::load::MassFriction;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Friction in proportion to the mass in the last cells before each free end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AbsorbingEnds {
    /// n, how many cells of each end.
    cells: u32,
    /// γ₁ [1/s].
    rate: f64,
    /// p.
    power: f64,
    /// How many cells there are along each direction with free ends.
    directions: [Option<u32>; 3],
}

impl AbsorbingEnds {
    /// Those of a scene, with the number of cells along each direction with free ends; notes why there can be none.
    pub fn of(
        written: &file::AbsorbingEnds,
        directions: [Option<u32>; 3],
        lattice: &Key,
        reporter: &mut Reporter<'_>,
    ) -> Option<Self> {
        let key = lattice.key("absorb");
        let cells = written.cells.0 as u32;
        let Some(fewest) = directions.into_iter().flatten().min() else {
            let message = "nothing is free: the lattice has no ends that could absorb waves";
            reporter.note(&key, message, "leave it out, or write periodic = false and repeat the cell");
            return None;
        };
        if u64::from(fewest) < 2 * u64::from(cells) {
            let message = format!("the two ends have {} cells together, and there are {fewest}", 2 * u64::from(cells));
            let help = format!("write {} or fewer, or repeat more cells", (fewest / 2).max(1));
            reporter.note(&key.key("cells"), message, help);
            return None;
        }
        Some(Self { cells, rate: written.rate.value(), power: written.power.value(), directions })
    }

    /// γ of a cell [1/s]: the greatest that an end gives it, 0 far from all of them.
    pub fn rate(&self, cell: Cell) -> f64 {
        let n = i64::from(self.cells);
        let along = self.directions.iter().zip(cell).filter_map(|(count, at)| {
            let (last, at) = (i64::from((*count)?) - 1, i64::from(at));
            // The outermost cell is the n-th.
            Some((n - at).max(n - (last - at)))
        });
        let i = along.max().unwrap_or(0);
        if i > 0 { self.rate * libm::pow(i as f64 / n as f64, self.power) } else { 0.0 }
    }
}

/// The copies of a body that absorb waves: those of the same rate are one.
#[derive(Debug, Default)]
pub(super) struct Absorbers(BTreeMap<u64, Arc<Body>>);

impl Absorbers {
    /// The copy with this rate [1/s]; the body itself at 0.
    pub fn of(&mut self, body: &Arc<Body>, rate: f64) -> Arc<Body> {
        if rate == 0.0 {
            return body.clone();
        }
        let copy = || {
            let mut copy = Body::clone(body);
            copy.own.absorption = Some(MassFriction { rate });
            Arc::new(copy)
        };
        self.0.entry(rate.to_bits()).or_insert_with(copy).clone()
    }
}
