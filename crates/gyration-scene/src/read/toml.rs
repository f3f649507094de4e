//! TOML into the tree, with every syntax error of the text.

use super::printed::{HELP, Printed};
use crate::document::Diagnostics;
use crate::key::Key;
use crate::tree::{Entry, Node, Span, Table, Value};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

/// Reads a TOML document.
pub(super) fn parse(text: &str, diagnostics: &mut Diagnostics) -> Node {
    let printed;
    let (mut table, mut errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty()
        && let Some(found) = Printed::of(text)
    {
        note_printed(&found, 0, 0, diagnostics);
        printed = found;
        (table, errors) = DeTable::parse_recoverable(&printed.plain);
    }
    note(&errors, 0, 0, text.len(), diagnostics);
    Node { value: Value::Table(convert_table(table.into_inner(), 0, 0)), span: Span { text: 0, start: 0, end: 0 } }
}

/// Reads one TOML value that stands in a text at an offset.
///
/// # Errors
/// All errors of its syntax.
pub(super) fn parse_value(value: &str, text: usize, offset: usize) -> Result<Node, Diagnostics> {
    let (parsed, errors) = DeValue::parse_recoverable(value);
    if errors.is_empty() {
        return Ok(convert(parsed, text, offset));
    }
    let mut diagnostics = Diagnostics::default();
    match Printed::of(value) {
        Some(printed) => note_printed(&printed, text, offset, &mut diagnostics),
        None => note(&errors, text, offset, offset + value.len(), &mut diagnostics),
    }
    Err(diagnostics)
}

/// One diagnostic for all that NumPy printed.
fn note_printed(printed: &Printed, text: usize, offset: usize, diagnostics: &mut Diagnostics) {
    let span = shift(printed.first.clone(), text, offset);
    diagnostics.at(span, &Key::root(), format!("not valid TOML: {}", printed.message()), HELP);
}

/// One diagnostic a place: what follows from the first error there says nothing new.
fn note(errors: &[Error], text: usize, offset: usize, length: usize, diagnostics: &mut Diagnostics) {
    let mut last = None;
    for error in errors {
        if diagnostics.is_full() {
            return;
        }
        let span = error.span().map_or(Span { text, start: 0, end: length }, |range| shift(range, text, offset));
        if last != Some(span.start) {
            diagnostics.at(span, &Key::root(), format!("not valid TOML: {}", error.message()), help(error.message()));
        }
        last = Some(span.start);
    }
}

fn help(message: &str) -> &'static str {
    if message.contains("must be quoted") {
        "put strings and numbers with units into quotes, \"2 cm\""
    } else if message.contains("duplicate") {
        "keep one of the two"
    } else if message.contains("recurs") {
        "a scene never nests that deep"
    } else {
        "see https://toml.io for the syntax"
    }
}

fn shift(range: Range<usize>, text: usize, offset: usize) -> Span {
    Span { text, start: range.start + offset, end: range.end + offset }
}

fn convert(value: Spanned<DeValue<'_>>, text: usize, offset: usize) -> Node {
    let span = shift(value.span(), text, offset);
    let value = match value.into_inner() {
        DeValue::String(string) => Value::Text(string.into_owned()),
        DeValue::Integer(integer) => Value::Number(integer_value(integer.as_str(), integer.radix())),
        DeValue::Float(float) => Value::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(boolean) => Value::Boolean(boolean),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(items) => Value::Array(items.into_iter().map(|item| convert(item, text, offset)).collect()),
        DeValue::Table(table) => Value::Table(convert_table(table, text, offset)),
    };
    Node { value, span }
}

fn convert_table(table: DeTable<'_>, text: usize, offset: usize) -> Table {
    let entries = table.into_iter().map(|(key, value)| {
        let key_span = shift(key.span(), text, offset);
        (key.into_inner().into_owned(), Entry { key_span, node: convert(value, text, offset) })
    });
    entries.collect()
}

/// An integer of any length and radix as a real number; infinite if it does not fit.
fn integer_value(digits: &str, radix: u32) -> f64 {
    if radix == 10 {
        return digits.parse().unwrap_or(f64::INFINITY);
    }
    let digit_values = digits.chars().map(|c| c.to_digit(radix));
    digit_values.flatten().fold(0.0, |sum, digit| sum * f64::from(radix) + f64::from(digit))
}
