//! What the reader of measurements owes whatever text it gets: a calibration with as many results as conditions, or
//! errors in words.

use gyration_study::calibration::Calibration;
use std::path::Path;

/// Reads a text as a file of measurements.
pub fn check(text: &str) {
    match Calibration::parse("measured.toml", text, Path::new("/nowhere")) {
        Ok(calibration) => {
            assert!(!calibration.experiments().is_empty());
            for experiment in calibration.experiments() {
                let rows = experiment.measured.len();
                assert!(experiment.conditions.len() == rows && experiment.deviations.len() == rows);
                assert!(experiment.deviations.iter().all(|deviation| *deviation > 0.0 && deviation.is_finite()));
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
