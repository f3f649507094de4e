//! From a text to a tree: TOML, or JSON with the same keys.
//!
//! A text is JSON if its file ends in `.json` or if it begins with a brace. Neither parser looks at what the keys mean;
//! both limit how deep a text may nest, since everything that walks the tree calls itself.

mod json;
mod overrides;
mod printed;
mod toml;

pub(crate) use overrides::apply;

use crate::document::{Diagnostics, Document};
use crate::error::{ErrorKind, LoadError, ReadError, SceneErrors};
use crate::key::Key;
use crate::tree::Span;
use gyration_files::Files;
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
    let file = gyration_files::open(path).map_err(failed)?;
    let mut content = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut content).map_err(failed)?;
    if content.len() as u64 > LARGEST_FILE {
        let size = std::fs::metadata(path).map_or(content.len() as u64, |data| data.len());
        return Err(ReadError::TooLarge { path: path.to_owned(), size, limit: LARGEST_FILE });
    }
    Ok(content)
}

/// A file that a scene names, by this name.
pub(crate) type NamedFile<'a> = (&'a Files, &'a str);

/// The bytes of a file that a scene names.
///
/// # Errors
/// `Io`, `TooLarge`.
pub(crate) fn named((files, name): NamedFile<'_>) -> Result<Vec<u8>, ReadError> {
    let path = files.path(name);
    match files.given(name) {
        None => bytes(&path),
        Some(Ok(content)) if content.len() as u64 > LARGEST_FILE => {
            Err(ReadError::TooLarge { path, size: content.len() as u64, limit: LARGEST_FILE })
        }
        Some(Ok(content)) => Ok(content.to_vec()),
        Some(Err(source)) => Err(ReadError::Io { path, source }),
    }
}

/// Name and text of a file.
///
/// # Errors
/// `Read` if it cannot be read, `Content` if it is no text.
pub(crate) fn text(path: &Path) -> Result<(String, String), LoadError> {
    let name = path.display().to_string();
    match String::from_utf8(bytes(path)?) {
        Ok(text) => Ok((name, text)),
        Err(error) => Err(not_utf8(&name, &error).into()),
    }
}

/// Reads a text into a tree.
///
/// # Errors
/// All errors of its syntax.
pub(crate) fn document(name: &str, text: &str) -> Result<Document, SceneErrors> {
    let mut document = Document::new(name, text);
    let mut diagnostics = Diagnostics::of(ErrorKind::Syntax);
    let named_json = Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    document.root = if named_json || text.trim_start_matches('\u{feff}').trim_start().starts_with('{') {
        json::parse(text, &mut diagnostics)
    } else {
        toml::parse(text, &mut diagnostics)
    };
    if diagnostics.is_empty() { Ok(document) } else { Err(document.errors(diagnostics)) }
}

fn not_utf8(name: &str, error: &std::string::FromUtf8Error) -> SceneErrors {
    let document = Document::new(name, &String::from_utf8_lossy(error.as_bytes()));
    // Up to the first bad byte the text is as it was.
    let at = error.utf8_error().valid_up_to();
    let mut diagnostics = Diagnostics::of(ErrorKind::Syntax);
    let span = Span { text: 0, start: at, end: at + 1 };
    diagnostics.at(span, &Key::root(), "not valid UTF-8", "save the file as UTF-8 text");
    document.errors(diagnostics)
}
