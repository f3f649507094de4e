//! CSV: one line a sample, `t` first, the columns in the order of the layout.
//!
//! Each number has 17 significant digits, which read back as the same f64 in any language; NaN and infinities are
//! `NaN`, `inf`, `-inf`, as NumPy and pandas read them.

use crate::error::RecordError;
use crate::recording::{Array, Recording};
use std::io::{self, BufWriter, Write};

/// Writes the recording as CSV.
///
/// # Errors
/// Those of reading; `Io` if `out` fails, under the recording's path.
pub fn csv(recording: &Recording, out: &mut impl Write) -> Result<(), RecordError> {
    let fail = || RecordError::io("write the CSV of", recording.path());
    let mut arrays = vec!["time"];
    // Of each column: which of the arrays, and where in its row.
    let mut places = vec![(0, 0)];
    let mut header = String::from("t");
    for (name, array, index) in recording.column_places() {
        let known = arrays.iter().position(|known| *known == array);
        let place = known.unwrap_or_else(|| {
            arrays.push(array);
            arrays.len() - 1
        });
        places.push((place, index));
        header.push(',');
        header.push_str(name);
    }
    let strides = arrays.iter().map(|name| Ok(recording.array(name)?.row_len())).collect::<Result<Vec<_>, _>>()?;
    let mut out = BufWriter::new(out);
    writeln!(out, "{header}").map_err(fail())?;
    for rows in recording.chunks() {
        let parts = arrays.iter().map(|name| recording.read_rows(name, rows.clone()));
        let parts = parts.collect::<Result<Vec<Array>, _>>()?;
        for row in 0..rows.len() {
            let number = |(array, index): &(usize, usize)| parts[*array].data[row * strides[*array] + index];
            write_line(&mut out, places.iter().map(number)).map_err(fail())?;
        }
    }
    out.flush().map_err(fail())
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
