//! What the reader of studies owes whatever text it gets: a study whose runs have their scenes, or errors in words.

use gyration_study::Study;
use std::path::Path;

/// Reads a text as a study.
pub fn check(text: &str) {
    match Study::parse("study.toml", text, Path::new("/nowhere"), &[]) {
        Ok(study) => {
            assert!(study.runs() > 0 && !study.columns().is_empty());
            // A run may have no scene, for reasons in words.
            for run in [0, study.runs() / 2, study.runs() - 1] {
                assert!(study.scene_of(run).map_or_else(|errors| errors.count() > 0, |_| true));
            }
            let again = Study::again(study.source()).map(|again| again.fingerprint().to_owned());
            assert_eq!(again.ok().as_deref(), Some(study.fingerprint()), "a study opened again is another");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
