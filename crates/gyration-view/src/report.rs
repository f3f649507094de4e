//! The report: one HTML file with page and data, readable without network and without this program.
//!
//! Data are deflated, then written in base64. A file that can be mailed is small: arrays that only few look at are left
//! out of a long recording first, then samples are thinned, one in 2, 3, …, and the header says so.

use crate::computed::MOST_PARTS;
use crate::error::ViewError;
use crate::page;
use crate::stored::{Stored, kept};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gyration_page::header::{Header, PageMode};
use serde_json::Value;

/// Characters that the data may take: with the page, which is below 1 MB, a report stays below 3 MB.
const MOST_DATA: usize = 1_900_000;
/// What base64 makes of a deflated number at the least, in long recordings of the gallery: where the search begins.
const FEWEST_CHARACTERS: f64 = 1.5;
/// Arrays left out first; the recording has them.
const DISPENSABLE: [&str; 5] =
    ["affine_momentum", "gradient_rate", "contraction_velocity", "angular_momentum", "linear_momentum"];
/// How hard to compress, of 10: more takes longer and gains next to nothing on such numbers.
const LEVEL: u8 = 6;

/// Arrays of what happens between samples.
const INTERVALS: [&str; 2] = ["impulse", "peak_force"];

/// A report.
#[derive(Debug, Clone)]
pub struct Report {
    /// The file.
    pub html: String,
    /// Samples in it, and in the recording.
    pub samples: (usize, usize),
}

/// Makes the report of a recording.
///
/// # Errors
/// `NoPage`; `Record` if the recording cannot be read.
pub fn report(stored: &Stored) -> Result<Report, ViewError> {
    let page = page::html()?;
    let rows = stored.rows();
    let mut header = stored.header().clone();
    header.mode = PageMode::Report;
    let mut every = 1;
    if !may_fit(&header, rows, every) {
        leave_out_dispensable(&mut header);
        every = (1..rows).find(|every| may_fit(&header, rows, *every)).unwrap_or(rows.max(1));
    }
    let notes = header.notes.len();
    loop {
        header.notes.truncate(notes);
        header.rows = kept(rows, every);
        header.network = stored.header().network && stored.bodies() * header.rows <= MOST_PARTS;
        header.thinned = (every > 1).then_some((header.rows, rows));
        if every > 1 {
            header.notes.push(format!(
                "To keep the file small, {} of {rows} samples are shown, one in {every}; the recording has all.",
                header.rows
            ));
            header.notes.extend(of_intervals(&header));
        }
        // What thinning cannot make smaller, a mesh of many triangles, is not paid for in samples beyond a quarter.
        let fixed = described(stored, &header)?;
        let room = MOST_DATA.saturating_sub(fixed.len()).max(MOST_DATA / 4);
        let data = sampled(stored, &header, every)?;
        if data.len() <= room || every >= rows {
            let html = page.replacen(page::PLACEHOLDER, &(fixed + &data), 1);
            return Ok(Report { html, samples: (header.rows, rows) });
        }
        every = (every * data.len()).div_ceil(room).max(every + 1);
    }
}

/// What must be told of arrays of intervals where samples are left out.
fn of_intervals(header: &Header) -> Option<String> {
    let told = INTERVALS.iter().find(|name| header.arrays.iter().any(|array| array.name == **name))?;
    Some(format!("`{told}` of a sample goes back to the sample before it in the recording, shown or not."))
}

/// Whether the data fit if they take as little as they can.
fn may_fit(header: &Header, rows: usize, every: usize) -> bool {
    let numbers: usize = header.arrays.iter().map(|array| array.stride()).sum();
    (numbers * kept(rows, every)) as f64 * FEWEST_CHARACTERS <= MOST_DATA as f64
}

fn leave_out_dispensable(header: &mut Header) {
    let all = header.arrays.len();
    header.arrays.retain(|array| !DISPENSABLE.contains(&array.name.as_str()));
    header.columns.retain(|(_, array, _)| !DISPENSABLE.contains(&array.as_str()));
    if header.arrays.len() < all {
        let words = "To keep the file small, momenta and rates are left out; the recording has them.";
        header.notes.push(words.to_owned());
    }
}

/// The elements of the page that hold header, events and surfaces.
fn described(stored: &Stored, header: &Header) -> Result<String, ViewError> {
    let json = in_script(&header.to_json());
    let mut elements = format!("<script type=\"application/json\" id=\"gyration-header\">{json}</script>\n");
    let parts =
        (0..header.surfaces.len()).flat_map(|k| ["points", "triangles"].map(|part| format!("surface/{k}/{part}")));
    for name in std::iter::once("events".to_owned()).chain(parts) {
        elements += &element(stored, &name, 1)?;
    }
    Ok(elements)
}

/// JSON as the text of a script element, which no text in it can end or hide: JSON has `<` in texts only, where its
/// escape says the same.
fn in_script(json: &Value) -> String {
    json.to_string().replace('<', "\\u003c")
}

/// The elements that hold one sample in `every`.
fn sampled(stored: &Stored, header: &Header, every: usize) -> Result<String, ViewError> {
    let names = header.arrays.iter().map(|array| array.name.as_str()).chain(header.network.then_some("network"));
    std::iter::once("time").chain(names).map(|name| element(stored, name, every)).collect()
}

fn element(stored: &Stored, name: &str, every: usize) -> Result<String, ViewError> {
    let packed = miniz_oxide::deflate::compress_to_vec(&stored.blob(name, 0..stored.rows(), every)?, LEVEL);
    Ok(format!("<script type=\"text/plain\" data-blob=\"{name}\">{}</script>\n", STANDARD.encode(packed)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_of_a_recording_ends_the_element_that_holds_it() {
        let header = serde_json::json!({ "title": "</script><!--<script>alert(1)", "arrays": ["\"><script>"] });
        let held = in_script(&header);
        assert!(!held.contains('<'), "{held}");
        assert_eq!(serde_json::from_str::<Value>(&held).unwrap(), header);
    }
}
