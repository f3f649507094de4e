//! Which names a recording may give to arrays, dimensions, kinds of events and columns: one rule to write and to read.
//!
//! Names become folders, and words of pages and tables. A recording may come from anybody: one that names an array
//! `../victim` would let whoever resumes it write outside its folder.

/// The metadata of the group, and of each array.
pub(crate) const METADATA: &str = "zarr.json";
/// The directory of checkpoint and lock, which no array may be called.
pub(crate) const STATE: &str = "state";

/// Whether this may name an array or a dimension.
pub(crate) fn is_name(name: &str) -> bool {
    is_word(name) && !name.starts_with(|c: char| c.is_ascii_digit())
}

/// Whether this may be an array, or one in a group: `NAME` or `GROUP/NAME`.
pub(crate) fn is_path(path: &str) -> bool {
    let (group, name) = path.split_once('/').unwrap_or(("", path));
    let is_free = |name: &str| is_name(name) && name != STATE;
    is_free(name) && (group.is_empty() || is_free(group)) && !path.starts_with('/')
}

/// Whether this may name a kind of event.
pub(crate) fn is_word(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Whether this may name a column of a CSV.
pub(crate) fn is_column(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "_.-".contains(c))
}
