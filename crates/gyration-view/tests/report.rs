//! A report is one file that holds the whole recording and needs nothing else. Without the page there is none to make.

use crate::common::{FALL, doubles, record, singles};
use base64::Engine as _;
use gyration_record::Recording;
use gyration_view::{Stored, page, report};
use serde_json::Value;
use std::path::Path;

/// The report of a recording, if the page was built.
pub(crate) fn html(path: &Path) -> Option<String> {
    let made = report(&Stored::open(path).unwrap());
    match page::html() {
        Ok(_) => Some(made.unwrap().html),
        Err(_) => {
            let words = made.unwrap_err().to_string();
            assert!(words.contains("install Node"), "{words}");
            None
        }
    }
}

pub(crate) fn header(html: &str) -> Value {
    let from = html.split("id=\"gyration-header\">").nth(1).unwrap();
    serde_json::from_str(from.split("</script>").next().unwrap()).unwrap()
}

pub(crate) fn blob(html: &str, name: &str) -> Vec<u8> {
    let from = html.split(&format!("data-blob=\"{name}\">")).nth(1).unwrap();
    let packed = base64::engine::general_purpose::STANDARD.decode(from.split("</script>").next().unwrap()).unwrap();
    miniz_oxide::inflate::decompress_to_vec(&packed).unwrap()
}

#[test]
fn a_report_holds_the_numbers_of_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    let path = record(folder.path(), "fall", FALL);
    let recording = Recording::open(&path).unwrap();
    let Some(html) = html(&path) else { return };
    let header = header(&html);
    assert_eq!((header["mode"].as_str(), header["rows"].as_u64()), (Some("report"), Some(recording.rows() as u64)));
    // The title ends a script element; as text it does not.
    assert_eq!(header["title"], "A fall </script> & more");
    assert_eq!(doubles(&blob(&html, "time")), recording.times().unwrap());
    for array in header["arrays"].as_array().unwrap() {
        let name = array["name"].as_str().unwrap();
        if name == "cauchy_stress" {
            assert_eq!(singles(&blob(&html, name)).len(), recording.rows() * 18);
            continue;
        }
        let recorded = recording.read(name).unwrap().data;
        let shown = singles(&blob(&html, name));
        let same = |(a, b): (&f32, &f64)| a.to_bits() == (*b as f32).to_bits();
        assert!(shown.len() == recorded.len() && shown.iter().zip(&recorded).all(same), "{name}");
    }
}

#[test]
fn a_long_recording_is_thinned_below_three_megabytes_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let text = FALL.replace("end = 0.3", "end = 3").replace("sample = 0.01", "sample = 5e-5");
    let path = record(folder.path(), "long", &text);
    let Some(html) = html(&path) else { return };
    assert!(html.len() < 3_000_000, "{} bytes", html.len());
    let header = header(&html);
    let (kept, of) = (header["thinned"]["kept"].as_u64().unwrap(), header["thinned"]["of"].as_u64().unwrap());
    assert_eq!((of, header["rows"].as_u64().unwrap()), (60_001, kept));
    let times = doubles(&blob(&html, "time"));
    assert_eq!((times.len() as u64, times.first(), times.last()), (kept, Some(&0.0), Some(&3.0)));
    assert!(html.len() > 1_000_000, "thinned more than it had to be: {} bytes", html.len());
    assert!(header["notes"].to_string().contains("samples are shown"));
}
