//! From a text to a tree: TOML, or JSON with the same keys.
//!
//! A text is JSON if its file ends in `.json` or if it begins with a brace. Neither parser looks at what the keys mean;
//! both limit how deep a text may nest, since everything that walks the tree calls itself.

mod json;
mod overrides;
mod toml;

pub(crate) use overrides::apply;

use crate::document::{Document, Findings};
use crate::error::ReadError;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The largest scene file, bytes: a thousand bodies with their hulls written out take less.
pub(crate) const LARGEST_FILE: u64 = 16 << 20;

/// The bytes of a file.
///
/// # Errors
/// `Io`, `TooLarge`.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let failed = |source| ReadError::Io { path: path.to_owned(), source };
    let file = File::open(path).map_err(failed)?;
    let mut content = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut content).map_err(failed)?;
    if content.len() as u64 > LARGEST_FILE {
        let size = std::fs::metadata(path).map_or(content.len() as u64, |data| data.len());
        return Err(ReadError::TooLarge { path: path.to_owned(), size, limit: LARGEST_FILE });
    }
    Ok(content)
}

/// Reads the text of a document into its tree; errors of syntax are noted.
pub(crate) fn tree(document: &mut Document, findings: &mut Findings) {
    let Some(text) = document.texts.first() else { return };
    let named_json = Path::new(&text.name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    let content = &text.content;
    document.root = if named_json || content.trim_start_matches('\u{feff}').trim_start().starts_with('{') {
        json::parse(content, findings)
    } else {
        toml::parse(content, findings)
    };
}
