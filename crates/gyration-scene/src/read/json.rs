//! JSON into the tree: RFC 8259, with places, which the parsers at hand do not keep.
//!
//! Stops at the first error of syntax. A key that occurs twice is an error.

use super::printed::{HELP, Printed};
use crate::document::Diagnostics;
use crate::key::Key;
use crate::tree::{Entry, Node, Span, Table, Value};
use std::ops::Range;

/// The deepest nesting; a scene needs less than twenty.
const DEEPEST: usize = 64;

/// Reads a JSON document.
pub(super) fn parse(text: &str, diagnostics: &mut Diagnostics) -> Node {
    let body = text.trim_start_matches('\u{feff}');
    let mut reader = JsonReader { text, at: text.len() - body.len() };
    match reader.document() {
        Ok(node) => node,
        Err(error) => {
            // The first error is at the first value that NumPy printed.
            let printed = Printed::of(text).filter(|printed| printed.first.start == error.start);
            let SyntaxError { start, end, message, help } = match printed {
                None => error,
                Some(printed) => {
                    let Range { start, end } = printed.first;
                    SyntaxError { start, end, message: printed.message(), help: HELP }
                }
            };
            diagnostics.at(Span { text: 0, start, end }, &Key::root(), format!("not valid JSON: {message}"), help);
            Node { value: Value::Table(Table::new()), span: Span::default() }
        }
    }
}

/// An error of syntax.
struct SyntaxError {
    start: usize,
    end: usize,
    message: String,
    help: &'static str,
}

struct JsonReader<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> JsonReader<'a> {
    fn document(&mut self) -> Result<Node, SyntaxError> {
        let node = self.value(0)?;
        self.blanks();
        if self.at < self.text.len() {
            return Err(self.fault("expected the end of the file", "remove what follows the closing brace"));
        }
        Ok(node)
    }

    fn value(&mut self, depth: usize) -> Result<Node, SyntaxError> {
        self.blanks();
        let start = self.at;
        if depth > DEEPEST {
            return Err(self.fault("nested too deep", "a scene never nests that deep"));
        }
        let value = match self.peek() {
            Some('{') => Value::Table(self.table(depth)?),
            Some('[') => Value::Array(self.array(depth)?),
            Some('"') => Value::Text(self.string()?),
            Some('-' | '0'..='9') => Value::Number(self.number()?),
            Some('a'..='z') => self.word()?,
            _ => return Err(self.fault("expected a value", "write a number, a \"string\", [ … ] or { … }")),
        };
        Ok(Node { value, span: Span { text: 0, start, end: self.at } })
    }

    fn table(&mut self, depth: usize) -> Result<Table, SyntaxError> {
        let mut table = Table::new();
        self.at += 1;
        self.blanks();
        if self.eat('}') {
            return Ok(table);
        }
        loop {
            self.blanks();
            let start = self.at;
            if self.peek() != Some('"') {
                return Err(self
                    .fault("expected a key in double quotes", "write \"key\": value, without a comma after the last"));
            }
            let key = self.string()?;
            let key_span = Span { text: 0, start, end: self.at };
            self.blanks();
            if !self.eat(':') {
                return Err(self.fault("expected a colon", "write \"key\": value"));
            }
            let node = self.value(depth + 1)?;
            if table.insert(key.clone(), Entry { key_span, node }).is_some() {
                let message = format!("the key \"{key}\" occurs twice");
                return Err(SyntaxError { start, end: key_span.end, message, help: "keep one of the two" });
            }
            self.blanks();
            if self.eat('}') {
                return Ok(table);
            }
            if !self.eat(',') {
                return Err(self.fault("expected a comma or a closing brace", "separate the keys by commas"));
            }
        }
    }

    fn array(&mut self, depth: usize) -> Result<Vec<Node>, SyntaxError> {
        let mut items = Vec::new();
        self.at += 1;
        self.blanks();
        if self.eat(']') {
            return Ok(items);
        }
        loop {
            items.push(self.value(depth + 1)?);
            self.blanks();
            if self.eat(']') {
                return Ok(items);
            }
            if !self.eat(',') {
                return Err(self.fault("expected a comma or a closing bracket", "separate the items by commas"));
            }
        }
    }

    /// A string: its end is found here, its escapes are left to the JSON library.
    fn string(&mut self) -> Result<String, SyntaxError> {
        let start = self.at;
        let bytes = self.text.as_bytes();
        let mut end = start + 1;
        loop {
            match bytes.get(end) {
                Some(b'"') => break,
                Some(b'\\') => end += 2,
                Some(b'\n') | None => return Err(self.fault("a string without end", "close it with a double quote")),
                Some(_) => end += 1,
            }
        }
        self.at = end + 1;
        let raw = self.text.get(start..self.at).unwrap_or_default();
        serde_json::from_str(raw).map_err(|_| SyntaxError {
            start,
            end: self.at,
            message: "a string with a control character or an unknown escape".to_owned(),
            help: "escape a backslash as \\\\ and a tab as \\t",
        })
    }

    /// A number; one that does not fit is infinite, which the checker refuses.
    fn number(&mut self) -> Result<f64, SyntaxError> {
        let start = self.at;
        let is_part = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
        let raw = self.take_while(is_part);
        let digits = raw.trim_start_matches('-');
        let padded = digits.len() > 1 && digits.starts_with('0') && digits.as_bytes()[1].is_ascii_digit();
        let bare_point =
            digits.contains(".e") || digits.contains(".E") || digits.ends_with('.') || digits.starts_with('.');
        match raw.parse() {
            Ok(number) if !padded && !bare_point => Ok(number),
            _ => {
                let message = format!("{raw} is not a number");
                Err(SyntaxError { start, end: self.at, message, help: "write 0.5, -1 or 1e-6" })
            }
        }
    }

    fn word(&mut self) -> Result<Value, SyntaxError> {
        let start = self.at;
        match self.take_while(|c| c.is_ascii_alphabetic()) {
            "true" => Ok(Value::Boolean(true)),
            "false" => Ok(Value::Boolean(false)),
            "null" => Ok(Value::Null),
            word => {
                let message = format!("unexpected {word}");
                Err(SyntaxError { start, end: self.at, message, help: "put strings into double quotes" })
            }
        }
    }

    fn take_while(&mut self, accept: impl Fn(char) -> bool) -> &'a str {
        let rest = &self.text[self.at..];
        let taken = &rest[..rest.find(|c| !accept(c)).unwrap_or(rest.len())];
        self.at += taken.len();
        taken
    }

    fn blanks(&mut self) {
        self.take_while(|c| matches!(c, ' ' | '\t' | '\n' | '\r'));
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn eat(&mut self, token: char) -> bool {
        let found = self.peek() == Some(token);
        if found {
            self.at += token.len_utf8();
        }
        found
    }

    fn fault(&self, message: &str, help: &'static str) -> SyntaxError {
        let end = self.at + self.peek().map_or(0, char::len_utf8);
        SyntaxError { start: self.at, end, message: message.to_owned(), help }
    }
}
