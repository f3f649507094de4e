//! Overrides, `--set body.die.velocity='[1, 0, 0]'`: changes to the tree before it is checked.
//!
//! `KEY=VALUE`, where KEY is dotted, items of arrays by name, else by index from zero; a word in quotes may hold dots.
//! VALUE is a TOML value; what is none and does not look like one (`30 deg`, `explicit`) is a string. Tables on the way
//! are made where there are none, items of arrays are not, but for those of gravity, which has a default. Whatever an
//! override brings is from then on placed in its own text; what is a number already has no text, and no place.

use super::printed::Printed;
use super::toml;
use crate::defaults::GRAVITY;
use crate::document::{Diagnostics, Document, NamedText};
use crate::key::{Key, name_of, split_copy};
use crate::overriding::{Override, OverrideValue};
use crate::suggest;
use crate::tree::{Entry, Node, Span, Table, Value};

/// What an override is called in a message.
const NAME: &str = "--set";
/// The longest dotted key.
const DEEPEST: usize = 32;

/// Applies overrides in their order; what cannot be applied is noted.
pub(crate) fn apply(document: &mut Document, overrides: &[Override], diagnostics: &mut Diagnostics) {
    for one in overrides {
        let text = document.texts.len();
        if one.is_text() {
            document.texts.push(NamedText { name: NAME.to_owned(), content: one.to_string() });
        }
        if let Err(fault) = apply_one(&mut document.root, one, text) {
            match fault {
                OverrideError::Key(span, message, help) => diagnostics.at(span, &Key::root(), message, help),
                OverrideError::Value(errors) => diagnostics.extend(errors),
            }
        }
    }
}

enum OverrideError {
    Key(Span, String, String),
    Value(Diagnostics),
}

/// A word of a dotted key and its place.
struct Word<'a> {
    name: &'a str,
    span: Span,
}

fn apply_one(root: &mut Node, Override { key, value }: &Override, text: usize) -> Result<(), OverrideError> {
    let written = || words(key, text);
    let (words, value) = match value {
        OverrideValue::Absent => {
            let span = Span { text, start: 0, end: key.len() };
            let help = "write KEY=VALUE, body.die.mass=0.01";
            return Err(OverrideError::Key(span, "an override without a value".into(), help.into()));
        }
        OverrideValue::Written(raw) => (written()?, parsed(raw, text, key.len() + 1).map_err(OverrideError::Value)?),
        OverrideValue::Number(number) => (written()?, node(Value::Number(*number))),
        OverrideValue::Array(numbers) => (written()?, array(numbers)),
        OverrideValue::Table(name, numbers) => {
            let entry = Entry { key_span: Span::default(), node: array(numbers) };
            (written()?, node(Value::Table([((*name).to_owned(), entry)].into())))
        }
    };
    let mut at = root;
    for (index, word) in words.iter().enumerate() {
        at = step(at, word, words.get(index + 1))?;
    }
    *at = value;
    Ok(())
}

fn words(key: &str, text: usize) -> Result<Vec<Word<'_>>, OverrideError> {
    let mut words = Vec::new();
    let mut start = 0;
    let mut quoted = false;
    let outside = |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    };
    for raw in key.split(outside) {
        let trimmed = raw.trim();
        let name = trimmed.strip_prefix('"').and_then(|word| word.strip_suffix('"')).unwrap_or(trimmed);
        let span = Span { text, start, end: start + raw.len() };
        start = span.end + 1;
        if name.is_empty() || words.len() == DEEPEST {
            let help = "write a dotted key, body.die.velocity or contact.0.friction.beta";
            return Err(OverrideError::Key(span, "not a dotted key".into(), help.into()));
        }
        words.push(Word { name, span });
    }
    Ok(words)
}

/// A value without a place.
fn node(value: Value) -> Node {
    Node { value, span: Span::default() }
}

fn array(numbers: &[f64]) -> Node {
    node(Value::Array(numbers.iter().map(|number| node(Value::Number(*number))).collect()))
}

/// A TOML value, or else a bare string.
fn parsed(raw: &str, text: usize, offset: usize) -> Result<Node, Diagnostics> {
    let trimmed = raw.trim();
    let offset = offset + (raw.len() - raw.trim_start().len());
    match toml::parse_value(trimmed, text, offset) {
        Ok(node) => Ok(node),
        Err(errors) if trimmed.starts_with(['[', '{', '"', '\'']) || trimmed.is_empty() => Err(errors),
        Err(errors) if Printed::of(trimmed).is_some() => Err(errors),
        Err(_) => {
            let span = Span { text, start: offset, end: offset + trimmed.len() };
            Ok(Node { value: Value::Text(trimmed.to_owned()), span })
        }
    }
}

fn step<'a>(at: &'a mut Node, word: &Word<'_>, next: Option<&Word<'_>>) -> Result<&'a mut Node, OverrideError> {
    let fault = |message: String, help: String| Err(OverrideError::Key(word.span, message, help));
    match &mut at.value {
        Value::Table(table) => {
            let is_item = next.is_some_and(|next| next.name.parse::<usize>().is_ok());
            if is_item && word.name == "gravity" {
                let default = || Entry { key_span: word.span, node: Node { span: word.span, ..array(&GRAVITY) } };
                return Ok(&mut table.entry(word.name.to_owned()).or_insert_with(default).node);
            }
            if is_item && !table.contains_key(word.name) {
                let message = format!("no `{}` is written here, so that it has no items", word.name);
                let whole = match word.name {
                    "gradient" | "gradient_rate" => "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                    "quaternion" => "[1, 0, 0, 0]",
                    _ => "[1, 0, 0]",
                };
                return fault(message, format!("set it as a whole first: {} = {whole}", word.name));
            }
            let empty = || Node { value: Value::Table(Table::new()), span: word.span };
            let entry = table.entry(word.name.to_owned());
            Ok(&mut entry.or_insert_with(|| Entry { key_span: word.span, node: empty() }).node)
        }
        Value::Array(items) => {
            let by_name = items.iter().position(|item| name_of(item) == Some(word.name));
            let by_index = || word.name.parse().ok().filter(|index| *index < items.len());
            match by_name.or_else(by_index) {
                Some(index) => Ok(&mut items[index]),
                None => {
                    let names: Vec<&str> = items.iter().filter_map(name_of).collect();
                    let help = match (items.len(), names.is_empty()) {
                        (0, _) => "the array is empty".to_owned(),
                        (count, true) => format!("indices run from 0 to {}", count - 1),
                        _ => match copied(items, word.name) {
                            Some(name) => format!("copies are set together: write `body.{name}`"),
                            None => suggest::fix(word.name, names.iter().copied(), "names"),
                        },
                    };
                    fault(format!("no item \"{}\" in the array", word.name), help)
                }
            }
        }
        other => {
            let message = format!("\"{}\" leads into {}", word.name, other.kind());
            fault(message, "set the value above it as a whole".into())
        }
    }
}

/// The name of the body, with copies, of one of which this is the name.
fn copied<'a>(items: &'a [Node], name: &str) -> Option<&'a str> {
    let (of, _) = split_copy(name)?;
    let mut copied = items.iter().filter(|item| item.get("copies").is_some());
    copied.find_map(|item| name_of(item).filter(|it| *it == of))
}
