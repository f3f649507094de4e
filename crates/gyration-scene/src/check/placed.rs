//! Parts of the file that are well formed, and where they stand.

use crate::key::Key;

/// A part of the file and where it stands.
#[derive(Debug, Clone)]
pub(crate) struct Placed<T> {
    pub(crate) key: Key,
    /// Its place among all that the file has of its kind, well formed or not.
    pub(crate) number: usize,
    pub(crate) value: T,
}
