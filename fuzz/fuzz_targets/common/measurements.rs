//! What the reader of measured tables owes whatever bytes it gets: a calibration, or errors in words.

use gyration_study::calibration::Calibration;
use std::path::Path;

const TEXT: &str = r#"
scene = "bounce"
[fit.alpha]
key = "contact.0.repulsion.alpha"
[[drop]]
table = "table.csv"
deviation = 1e-3
"#;

/// Reads the bytes as the table of a file of measurements; it is put into `folder`.
pub fn check(folder: &Path, bytes: &[u8]) {
    let table = folder.join("table.csv");
    std::fs::write(&table, bytes).unwrap_or_else(|error| panic!("{}: {error}", table.display()));
    match Calibration::parse("measured.toml", TEXT, folder) {
        Ok(calibration) => {
            for experiment in calibration.experiments() {
                assert_eq!(experiment.conditions.len(), experiment.measured.len());
                assert!(experiment.measured.iter().chain(&experiment.conditions).all(|number| number.is_finite()));
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
