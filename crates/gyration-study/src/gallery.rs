//! The ready studies, compiled into the program.

use gyration_studies::STUDIES;

/// Name and text of each ready study.
pub fn studies() -> &'static [(&'static str, &'static str)] {
    STUDIES
}

/// The text of a ready study.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    STUDIES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
