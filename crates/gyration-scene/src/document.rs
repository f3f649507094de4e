//! A document: the texts a scene comes from, their tree, and the errors and files found so far.
//!
//! Bytes become lines and columns here and nowhere else.

use crate::error::{ErrorKind, Excerpt, SceneError, SceneErrors};
use crate::file_sum::FileSum;
use crate::key::Key;
use crate::tree::{Node, Span, Value};
use std::collections::BTreeSet;

/// A text with a name: the file, or an override.
#[derive(Debug, Clone)]
pub(crate) struct NamedText {
    pub(crate) name: String,
    pub(crate) content: String,
}

/// The texts of a scene and the tree that stands in them.
#[derive(Debug, Clone)]
pub(crate) struct Document {
    pub(crate) texts: Vec<NamedText>,
    pub(crate) root: Node,
}

/// An error by its place in the tree; it gets its line and column at the end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Diagnostic {
    pub(crate) key: Key,
    pub(crate) span: Span,
    pub(crate) message: String,
    pub(crate) help: String,
    pub(crate) fault: ErrorKind,
}

/// Collects what is wrong, up to a number that no one reads: a file of megabytes must not take gigabytes of messages.
/// Beside it stand the files that were read while it was looked for.
#[derive(Debug, Default)]
pub(crate) struct Diagnostics {
    found: Vec<Diagnostic>,
    files: BTreeSet<FileSum>,
    /// What is being looked at.
    looking_at: ErrorKind,
}

/// The most diagnostics that are kept.
const MOST_DIAGNOSTICS: usize = 2000;

impl Diagnostics {
    /// An empty collection of errors of this kind.
    pub(crate) fn of(looking_at: ErrorKind) -> Self {
        Self { looking_at, ..Self::default() }
    }

    /// From here on, errors are of this kind.
    pub(crate) fn look_at(&mut self, fault: ErrorKind) {
        self.looking_at = fault;
    }

    /// Notes an error at a span.
    pub(crate) fn at(&mut self, span: Span, key: &Key, message: impl Into<String>, help: impl Into<String>) {
        if !self.is_full() {
            let (key, message, help) = (key.clone(), message.into(), help.into());
            self.found.push(Diagnostic { key, span, message, help, fault: self.looking_at });
        }
    }

    /// Notes all that another collection has.
    pub(crate) fn extend(&mut self, other: impl IntoIterator<Item = Diagnostic>) {
        for diagnostic in other {
            if !self.is_full() {
                self.found.push(diagnostic);
            }
        }
    }

    /// Keeps what was found in a file, once for each key.
    pub(crate) fn add_file(&mut self, found: FileSum) {
        self.files.insert(found);
    }

    /// The files that were read, by their keys.
    pub(crate) fn into_files(self) -> Vec<FileSum> {
        self.files.into_iter().collect()
    }

    /// Whether nothing is wrong so far.
    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Whether no more are kept: there is then no need to look for more.
    pub(crate) fn is_full(&self) -> bool {
        self.found.len() >= MOST_DIAGNOSTICS
    }

    /// What was found so far.
    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.found.iter()
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.found.into_iter()
    }
}

impl Document {
    /// A document of one text with an empty tree.
    pub(crate) fn new(name: &str, content: &str) -> Self {
        let text = NamedText { name: name.to_owned(), content: content.to_owned() };
        Self { texts: vec![text], root: Node { value: Value::Table(Default::default()), span: Span::default() } }
    }

    /// The diagnostics in the order of the texts, with lines and columns.
    pub(crate) fn errors(&self, diagnostics: Diagnostics) -> SceneErrors {
        // A file with more errors than this is not a scene; the first ones tell.
        const MOST: usize = 200;
        let is_full = diagnostics.is_full();
        let mut diagnostics = diagnostics.found;
        diagnostics.sort_by(|a, b| (a.span.text, a.span.start, &a.key).cmp(&(b.span.text, b.span.start, &b.key)));
        diagnostics.dedup();
        let omitted = diagnostics.len().saturating_sub(MOST);
        diagnostics.truncate(MOST);
        SceneErrors::new(diagnostics.into_iter().map(|diagnostic| self.locate(diagnostic)).collect(), omitted, is_full)
    }

    fn locate(&self, diagnostic: Diagnostic) -> SceneError {
        let key = diagnostic.key.dotted(&self.root);
        let (file, place) = match self.texts.get(diagnostic.span.text) {
            Some(text) => (text.name.clone(), LineColumn::new(&text.content, diagnostic.span)),
            None => (String::new(), LineColumn::new("", Span::default())),
        };
        let LineColumn { line, column, excerpt } = place;
        let Diagnostic { message, help, fault, span, .. } = diagnostic;
        SceneError { file, line, column, key, message, help, fault, overriding: span.text.checked_sub(1), excerpt }
    }
}

/// A span of a text as people count.
struct LineColumn {
    line: usize,
    column: usize,
    excerpt: Excerpt,
}

impl LineColumn {
    fn new(text: &str, span: Span) -> Self {
        let start = text.floor_char_boundary(span.start);
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let column = text[line_start..start].chars().count();
        let end = text.floor_char_boundary(span.end.clamp(start, line_end.max(start)));
        let marked = text[start..end].chars().count().max(1);
        let line = &text[line_start..line_end];
        Self {
            line: before.matches('\n').count() + 1,
            column: column + 1,
            excerpt: window(line.trim_end_matches('\r'), column, marked),
        }
    }
}

/// The part of a line around its mark that fits a terminal; control characters become blanks.
fn window(line: &str, column: usize, marked: usize) -> Excerpt {
    const WIDTH: usize = 100;
    const LEAD: usize = 40;
    let length = line.chars().count();
    let skip = if length <= WIDTH { 0 } else { column.saturating_sub(LEAD) };
    let shown: String = line.chars().skip(skip).take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
    let before = column - skip;
    let room = shown.chars().count().saturating_sub(before).max(1);
    Excerpt { text: shown, before, marked: marked.min(room) }
}
