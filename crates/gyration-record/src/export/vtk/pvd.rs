//! The list of a time series: which file is of which time.

use std::io::{self, Write};

/// A file of the series.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesFile {
    /// Its time \[s\].
    pub time: f64,
    /// Which of several files of the same time it is.
    pub part: usize,
    /// Where it is, from the folder of the list, with `/` between the names.
    pub file: String,
}

/// Writes the list as `.pvd`.
///
/// # Errors
/// Those of writing.
pub fn pvd(entries: &[SeriesFile], out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">"
    )?;
    writeln!(out, "<Collection>")?;
    for SeriesFile { time, part, file } in entries {
        let file = escaped(file);
        writeln!(out, "<DataSet timestep=\"{time:e}\" part=\"{part}\" file=\"{file}\"/>")?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}

/// A text as it may stand in an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
