//! The ready studies, compiled into the program.

/// Name and text of each study, in the order in which they are listed.
static STUDIES: &[(&str, &str)] = &[];

/// Name and text of each ready study.
pub fn studies() -> &'static [(&'static str, &'static str)] {
    STUDIES
}

/// The text of a ready study.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    STUDIES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
