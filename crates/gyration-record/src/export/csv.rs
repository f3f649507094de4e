//! CSV: one line a sample, `t` first, the columns in the order of the layout.
//!
//! Each number has 17 significant digits, which read back as the same f64 in any language; NaN and infinities are
//! `NaN`, `inf`, `-inf`, as NumPy and pandas read them.

use crate::error::RecordError;
use crate::recording::{Array, Recording};
use std::io::{self, BufWriter, Write};
use std::ops::Range;

/// Writes the recording as CSV.
///
/// # Errors
/// Those of reading; `Io` if `out` fails, under the recording's path.
pub fn csv(recording: &Recording, out: &mut impl Write) -> Result<(), RecordError> {
    let table = CsvTable::of(recording)?;
    table.write_head(out)?;
    recording.chunks().try_for_each(|rows| table.write_rows(rows, out))
}

/// A recording as CSV, to be written part by part.
pub struct CsvTable<'a> {
    recording: &'a Recording,
    /// The arrays that have columns, the time first.
    arrays: Vec<&'a str>,
    /// Numbers in a row of each.
    strides: Vec<usize>,
    /// Of each column: which of the arrays, and where in its row.
    places: Vec<(usize, usize)>,
}

impl<'a> CsvTable<'a> {
    /// The table of a recording.
    ///
    /// # Errors
    /// `NoSuchArray`.
    pub fn of(recording: &'a Recording) -> Result<Self, RecordError> {
        let (mut arrays, mut places) = (vec!["time"], vec![(0, 0)]);
        for (_, array, index) in recording.column_places() {
            let known = arrays.iter().position(|known| *known == array);
            let place = known.unwrap_or_else(|| {
                arrays.push(array);
                arrays.len() - 1
            });
            places.push((place, index));
        }
        let strides = arrays.iter().map(|name| Ok(recording.array(name)?.row_len())).collect::<Result<_, _>>()?;
        Ok(Self { recording, arrays, strides, places })
    }

    /// Writes the names of the columns.
    ///
    /// # Errors
    /// `Io` if `out` fails, under the recording's path.
    pub fn write_head(&self, out: &mut impl Write) -> Result<(), RecordError> {
        let mut head = String::from("t");
        for (name, _, _) in self.recording.column_places() {
            head.push(',');
            head.push_str(name);
        }
        writeln!(out, "{head}").map_err(self.failed())
    }

    /// Writes a line for each of some rows; a chunk is read at once.
    ///
    /// # Errors
    /// Those of reading; `Io` as of the head.
    pub fn write_rows(&self, rows: Range<usize>, out: &mut impl Write) -> Result<(), RecordError> {
        let parts = self.arrays.iter().map(|name| self.recording.read_rows(name, rows.clone()));
        let parts = parts.collect::<Result<Vec<Array>, _>>()?;
        let mut out = BufWriter::new(out);
        for row in 0..rows.len() {
            let number = |(array, index): &(usize, usize)| parts[*array].data[row * self.strides[*array] + index];
            write_line(&mut out, self.places.iter().map(number)).map_err(self.failed())?;
        }
        out.flush().map_err(self.failed())
    }

    fn failed(&self) -> impl FnOnce(io::Error) -> RecordError + use<> {
        RecordError::io("write the CSV of", self.recording.path())
    }
}

fn write_line(out: &mut impl Write, numbers: impl Iterator<Item = f64>) -> io::Result<()> {
    for (at, number) in numbers.enumerate() {
        if at > 0 {
            out.write_all(b",")?;
        }
        // 17 significant digits read back as the same number in any language.
        if number.is_finite() { write!(out, "{number:.16e}")? } else { write!(out, "{number}")? }
    }
    out.write_all(b"\n")
}
