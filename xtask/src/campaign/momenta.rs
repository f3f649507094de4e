//! Momenta of bodies alone in space: momentum stays to rounding, angular momentum to the tolerance.

use super::table::Table;
use crate::recording::floats;
use std::path::Path;

/// Momentum is changed by rounding alone: this part of what the bodies have had at most, each by itself.
const ROUNDING: f64 = 1e-12;
/// Angular momentum is kept to so many times rtol, as the ledger is.
const TOLERANCES: f64 = 100.0;

/// What a recording shows of the momenta.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Largest change of the sum over all bodies.
    change: f64,
    /// Sum over the bodies of the largest that each has had.
    size: f64,
}

impl Drift {
    /// Of vectors by time and body.
    fn of(vectors: &[[f64; 3]], bodies: usize) -> Self {
        let norm = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let total = |row: &[[f64; 3]]| [0, 1, 2].map(|axis| row.iter().map(|v| v[axis]).sum::<f64>());
        let rows: Vec<&[[f64; 3]]> = vectors.chunks_exact(bodies).collect();
        let first = rows.first().map_or([0.0; 3], |row| total(row));
        let change = rows.iter().map(|row| {
            let now = total(row);
            norm(&[0, 1, 2].map(|axis| now[axis] - first[axis]))
        });
        let largest = |body: usize| rows.iter().map(|row| norm(&row[body])).fold(0.0, f64::max);
        Self { change: change.fold(0.0, f64::max), size: (0..bodies).map(largest).sum() }
    }
}

/// What does not hold of the momenta in a recording of bodies alone in space.
pub fn audit(recording: &Path, table: &Table, bodies: usize, rtol: f64) -> Result<(), String> {
    let read = |name: &str| -> Result<Drift, String> {
        let numbers = floats(recording, name)?;
        let (vectors, _) = numbers.as_chunks::<3>();
        let vectors = vectors.get(..table.rows() * bodies).ok_or_else(|| format!("{name} has too few rows"))?;
        Ok(Drift::of(vectors, bodies))
    };
    for (name, allowed) in [("linear_momentum", ROUNDING), ("angular_momentum", TOLERANCES * rtol + ROUNDING)] {
        let Drift { change, size } = read(name)?;
        if change.is_nan() || change > allowed * size {
            let part = change / size;
            return Err(format!("{name} of bodies alone changes by {part:.1e} of itself, {allowed:.1e} is allowed"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_body_gives_the_other_takes() {
        let kept = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.5, 1.0, 0.0], [0.5, 1.0, 0.0]];
        assert_eq!(Drift::of(&kept, 2), Drift { change: 0.0, size: 3.0 });
        let lost = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.5, 1.0, 0.0], [0.5, 0.75, 0.0]];
        assert_eq!(Drift::of(&lost, 2).change, 0.25);
    }
}
