//! Labels: words with raised and lowered parts.
//!
//! A label is written as in TeX, `10^{-3}` and `d_{0}`; a hyphen in front of a digit becomes a minus sign.

use super::font;

/// Raised and lowered letters relative to the size of the others.
pub const SMALL: f64 = 0.7;
/// By how much of the size raised letters stand higher.
pub const RAISE: f64 = 0.38;
/// By how much of the size lowered letters stand deeper.
pub const LOWER: f64 = 0.18;

/// Where a part of a label stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Script {
    /// On the base line.
    Base,
    /// An exponent.
    Raised,
    /// An index.
    Lowered,
}

impl Script {
    /// Size and shift upwards, as fractions of the size of the label.
    pub fn size_and_shift(self) -> (f64, f64) {
        match self {
            Self::Base => (1.0, 0.0),
            Self::Raised => (SMALL, RAISE),
            Self::Lowered => (SMALL, -LOWER),
        }
    }
}

/// Words, some of them raised or lowered.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Label {
    /// The parts, from left to right.
    pub parts: Vec<(Script, String)>,
}

impl Label {
    /// Reads `10^{-3} m_{0}`; names from scenes go through [`Label::plain`].
    pub fn new(markup: &str) -> Self {
        let mut label = Self::default();
        let mut rest = markup;
        while let Some((start, level)) = next_mark(rest) {
            label.push(Script::Base, &rest[..start]);
            let inner = &rest[start + 2..];
            let end = inner.find('}').unwrap_or(inner.len());
            label.push(level, &inner[..end]);
            rest = inner.get(end + 1..).unwrap_or("");
        }
        label.push(Script::Base, rest);
        label
    }

    /// The words as they are.
    pub fn plain(words: &str) -> Self {
        Self { parts: vec![(Script::Base, words.to_owned())] }
    }

    fn push(&mut self, level: Script, words: &str) {
        if !words.is_empty() {
            self.parts.push((level, with_minus_signs(words)));
        }
    }

    /// Width [pt] in letters of this size.
    pub fn width(&self, size: f64, bold: bool) -> f64 {
        let part = |(level, words): &(Script, String)| font::width(words, size * level.size_and_shift().0, bold);
        self.parts.iter().map(part).sum()
    }
}

/// The next `^{` or `_{`.
fn next_mark(text: &str) -> Option<(usize, Script)> {
    let raised = text.find("^{").map(|at| (at, Script::Raised));
    let lowered = text.find("_{").map(|at| (at, Script::Lowered));
    [raised, lowered].into_iter().flatten().min_by_key(|(at, _)| *at)
}

/// Hyphens in front of digits, at the beginning or after a space or a bracket, become minus signs.
fn with_minus_signs(words: &str) -> String {
    let mut result = String::with_capacity(words.len());
    let mut previous = ' ';
    let mut letters = words.chars().peekable();
    while let Some(letter) = letters.next() {
        let begins = previous == ' ' || previous == '(';
        let negative = letter == '-' && begins && letters.peek().is_some_and(char::is_ascii_digit);
        result.push(if negative { '−' } else { letter });
        previous = letter;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_raises_and_lowers() {
        let label = Label::new("10^{-3} d_{0}/a-2");
        let expected = [
            (Script::Base, "10"),
            (Script::Raised, "−3"),
            (Script::Base, " d"),
            (Script::Lowered, "0"),
            (Script::Base, "/a-2"),
        ];
        assert_eq!(label.parts, expected.map(|(level, words)| (level, words.to_owned())));
    }

    #[test]
    fn an_open_brace_ends_with_the_label() {
        assert_eq!(Label::new("x^{2").parts.len(), 2);
        assert_eq!(Label::new("").parts.len(), 0);
    }

    #[test]
    fn raised_letters_are_narrower() {
        assert!(Label::new("x^{2}").width(10.0, false) < Label::new("x2").width(10.0, false));
    }
}
