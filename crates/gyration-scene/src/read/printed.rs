//! Numbers as NumPy prints them, `np.float64(0.37)` and `array([1., 2.])`: neither TOML nor JSON has such a value.
//!
//! Parsers stumble over each of them several times. All together they are one error; with a number of the same length
//! in the place of each, whatever else is wrong with a text is found where it stands.

use std::ops::Range;

/// What NumPy printed into a text.
pub(super) struct Printed {
    /// Where the first one stands.
    pub(super) first: Range<usize>,
    /// The text with numbers in their places.
    pub(super) plain: String,
    count: usize,
    shown: String,
}

/// What to do about it.
pub(super) const HELP: &str = "print plain numbers: float(x) of one, x.tolist() of an array";

/// Letters of a print that a message shows.
const SHOWN: usize = 40;

/// What NumPy calls its numbers and arrays where it prints them without its own name.
const NAMES: [&str; 15] = [
    "array",
    "float16",
    "float32",
    "float64",
    "float128",
    "longdouble",
    "bool_",
    "int8",
    "int16",
    "int32",
    "int64",
    "uint8",
    "uint16",
    "uint32",
    "uint64",
];

impl Printed {
    /// What NumPy printed into a text, outside of strings and comments; none if it printed nothing there.
    pub(super) fn of(text: &str) -> Option<Self> {
        let mut plain = String::with_capacity(text.len());
        let mut first: Option<Range<usize>> = None;
        let mut count = 0;
        while let Some(rest) = text.get(plain.len()..).filter(|rest| !rest.is_empty()) {
            match printed(rest) {
                Token::Printed(length) => {
                    first.get_or_insert(plain.len()..plain.len() + length);
                    count += 1;
                    plain.push_str(&number_of(&rest[..length]));
                }
                Token::Other(length) => plain.push_str(&rest[..length]),
            }
        }
        let first = first?;
        let print = &text[first.clone()];
        let mut shown: String = print.chars().take(SHOWN).collect();
        if shown.len() < print.len() {
            shown.push_str(" …");
        }
        Some(Self { first, plain, count, shown })
    }

    /// What is wrong, in words.
    pub(super) fn message(&self) -> String {
        let more = if self.count > 1 { format!(", {} times in this text", self.count) } else { String::new() };
        format!("{} is how NumPy prints a number, not the number itself{more}", self.shown)
    }
}

/// What stands at the beginning of a text, with its length in bytes.
enum Token {
    /// A number or an array as NumPy prints it.
    Printed(usize),
    /// Anything else; the whole text where a bracket is not closed.
    Other(usize),
}

fn printed(text: &str) -> Token {
    let length = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.').unwrap_or(text.len());
    let (path, behind) = text.split_at(length);
    let is_own = path.starts_with("np.") || path.starts_with("numpy.");
    if !is_own && !NAMES.contains(&path) {
        return Token::Other(word(text));
    }
    if !behind.starts_with('(') {
        return if is_own { Token::Printed(length) } else { Token::Other(length) };
    }
    let mut depth = 0_usize;
    let end = behind.find(|c: char| {
        depth = if c == '(' {
            depth + 1
        } else if c == ')' {
            depth - 1
        } else {
            depth
        };
        depth == 0
    });
    end.map_or(Token::Other(text.len()), |end| Token::Printed(length + end + 1))
}

/// A number that takes as many bytes and lines.
fn number_of(printed: &str) -> String {
    let blank = |byte: u8| if byte == b'\n' { '\n' } else { ' ' };
    std::iter::once('0').chain(printed.bytes().skip(1).map(blank)).collect()
}

/// How many bytes of the beginning belong together: a string, a comment, a word or one character.
fn word(text: &str) -> usize {
    let until = |from: usize, end: &str| text[from..].find(end).map_or(text.len(), |at| from + at + end.len());
    let Some(first) = text.chars().next() else { return 0 };
    match first {
        '#' => until(1, "\n"),
        _ if text.starts_with("\"\"\"") => until(3, "\"\"\""),
        _ if text.starts_with("'''") => until(3, "'''"),
        '\'' => text[1..].find(['\'', '\n']).map_or(text.len(), |at| at + 2),
        '"' => {
            let mut escaped = false;
            let end = text[1..].find(|c: char| {
                let ends = !escaped && c == '"' || c == '\n';
                escaped = !escaped && c == '\\';
                ends
            });
            end.map_or(text.len(), |at| at + 2)
        }
        c if c.is_alphanumeric() || c == '_' => {
            text.find(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '.' | '-')).unwrap_or(text.len())
        }
        c => c.len_utf8(),
    }
}
