//! What happens between samples.

/// Something that happened between two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// When, in s.
    pub time: f64,
    /// What: an index into [`Layout::event_kinds`](crate::Layout::event_kinds).
    pub kind: usize,
    /// The index of the body concerned, if one is.
    pub body: Option<usize>,
}
