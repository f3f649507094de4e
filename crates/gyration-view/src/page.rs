//! The page: one HTML file with scripts and styles inlined, built from `viewer/` and embedded.

use crate::error::ViewError;

/// Where a report puts its data: before the scripts of the page.
pub const PLACEHOLDER: &str = "<!--gyration-data-->";

/// The page, or why there is none; `build.rs` writes it.
const PAGE: Result<&str, &str> = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// The page's HTML.
///
/// # Errors
/// `NoPage` if the program was built without.
pub fn html() -> Result<&'static str, ViewError> {
    PAGE.map_err(|reason| ViewError::NoPage { reason })
}
