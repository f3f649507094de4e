//! What two bodies do to each other as a recording has it.

use gyration::dynamics::Exchange;
use gyration::lattice::Cell;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::{RecordError, Recording};

/// What two bodies do to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RecordedPair {
    /// The bodies.
    pub bodies: [usize; 2],
    /// The cell of the second as seen from that of the first.
    pub cell: Cell,
    /// f on the first \[N\].
    pub force: Vec3,
    /// N on each \[J\].
    pub moments: [Mat3; 2],
}

impl RecordedPair {
    /// Of an exchange; none with a support.
    pub fn between_bodies(exchange: &Exchange) -> Option<Self> {
        let bodies = [exchange.parties[0].body()?, exchange.parties[1].body()?];
        let moments = [exchange.moments[0]?, exchange.moments[1]?];
        Some(Self { bodies, cell: exchange.cell, force: exchange.force, moments })
    }

    /// Those of a sample of a recording, of so many bodies; none with supports.
    ///
    /// # Errors
    /// Those of reading; `Corrupt` if there is no such body.
    pub fn of_row(recording: &Recording, row: usize, bodies: usize) -> Result<Vec<Self>, RecordError> {
        let entries = recording.entries(row)?;
        let group = recording.ragged().unwrap_or_default();
        let read =
            |name: &str| Ok::<_, RecordError>(recording.read_rows(&format!("{group}/{name}"), entries.clone())?.data);
        let (first, second, cell) = (read("first")?, read("second")?, read("cell")?);
        let (force, moment_first, moment_second) = (read("force")?, read("moment_first")?, read("moment_second")?);
        let matrix = |numbers: &[f64], entry: usize| Mat3::from_row_slice(&numbers[9 * entry..][..9]);
        let mut pairs = Vec::new();
        for entry in (0..first.len()).filter(|entry| second[*entry] >= 0.0) {
            let both = [first[entry] as usize, second[entry] as usize];
            if both.iter().any(|body| *body >= bodies) {
                let reason = format!("entry {entry} of sample {row} is of a body that there is not");
                return Err(RecordError::Corrupt { path: recording.path().join(group), reason });
            }
            pairs.push(Self {
                bodies: both,
                // Not a number without a lattice: the cell of the first.
                cell: std::array::from_fn(|a| cell[3 * entry + a] as i32),
                force: Vec3::from_column_slice(&force[3 * entry..][..3]),
                moments: [matrix(&moment_first, entry), matrix(&moment_second, entry)],
            });
        }
        Ok(pairs)
    }
}
