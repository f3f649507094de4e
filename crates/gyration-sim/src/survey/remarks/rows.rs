//! The rows of a recording, or of a very long one some of them, with one array of its bodies.

use gyration_record::{RecordError, Recording};

/// Rows that are looked at.
const MOST_ROWS: usize = 10_000;
/// Numbers that are read at once.
const MOST_NUMBERS: usize = 1_000_000;

/// Hands time and numbers of an array with so many numbers in a row to `note`, at rows about as far from one another.
///
/// # Errors
/// Those of reading.
pub(super) fn each_row(
    recording: &Recording,
    (array, width): (&str, usize),
    mut note: impl FnMut(f64, &[f64]),
) -> Result<(), RecordError> {
    let rows = recording.rows();
    let chunk = (MOST_NUMBERS / width.max(1)).max(1);
    let stride = rows.div_ceil(MOST_ROWS).max(1);
    for first in (0..rows).step_by(chunk) {
        let range = first..(first + chunk).min(rows);
        let times = recording.read_rows("time", range.clone())?.data;
        let numbers = recording.read_rows(array, range)?.data;
        for (row, (time, numbers)) in times.iter().zip(numbers.chunks_exact(width)).enumerate() {
            if (first + row) % stride == 0 || first + row + 1 == rows {
                note(*time, numbers);
            }
        }
    }
    Ok(())
}
