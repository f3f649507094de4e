//! The page: one HTML file with scripts and styles inlined, built from `viewer/` and embedded.

use crate::error::ViewError;
use miniz_oxide::inflate::decompress_to_vec_zlib;
use std::sync::LazyLock;

/// Where a report puts its data: before the scripts of the page.
pub const PLACEHOLDER: &str = "<!--gyration-data-->";

/// The page, compressed (zlib), or why there is none; `build.rs` writes it.
const COMPRESSED: Result<&[u8], &str> = include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// The page, read once.
static PAGE: LazyLock<Result<String, String>> = LazyLock::new(|| {
    let bytes = decompress_to_vec_zlib(COMPRESSED?).map_err(|error| format!("it cannot be read: {error}"))?;
    String::from_utf8(bytes).map_err(|error| format!("it is no text: {error}"))
});

/// What stands before the sources of scripts in the policy of the page: the hash of its own script.
const SCRIPTS: &str = "script-src ";

/// The scripts that a policy allows, as the page states it; none if there is no page.
pub fn scripts() -> &'static str {
    html().ok().and_then(allowed).unwrap_or("'none'")
}

fn allowed(html: &str) -> Option<&str> {
    let (_, rest) = html.split_once(SCRIPTS)?;
    rest.split_once(';').map(|(scripts, _)| scripts)
}

/// The page's HTML.
///
/// # Errors
/// `NoPage` if the program was built without.
pub fn html() -> Result<&'static str, ViewError> {
    PAGE.as_deref().map_err(|reason| ViewError::NoPage { reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_script_runs_but_that_of_the_page() {
        let head = "content=\"default-src 'none'; script-src 'sha256-abc='; style-src 'unsafe-inline'\"";
        assert_eq!(allowed(head), Some("'sha256-abc='"));
        assert_eq!(allowed("no policy"), None);
        assert!(!scripts().contains("unsafe-inline"));
        assert_eq!(COMPRESSED.is_ok(), scripts().starts_with("'sha256-"), "{}", scripts());
    }
}
