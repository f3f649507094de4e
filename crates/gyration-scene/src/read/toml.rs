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
    let mut read = text;
    let (mut table, mut errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty()
        && let Some(found) = Printed::of(text)
    {
        note_printed(&found, 0, 0, diagnostics);
        printed = found;
        read = &printed.plain;
        (table, errors) = DeTable::parse_recoverable(read);
    }
    note(&errors, read, (0, 0), diagnostics);
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
        None => note(&errors, value, (text, offset), &mut diagnostics),
    }
    Err(diagnostics)
}

/// One diagnostic for all that NumPy printed.
fn note_printed(printed: &Printed, text: usize, offset: usize, diagnostics: &mut Diagnostics) {
    let span = shift(printed.first.clone(), text, offset);
    diagnostics.at(span, &Key::root(), format!("not valid TOML: {}", printed.message()), HELP);
}

/// One diagnostic a place: what follows from the first error there says nothing new. What was read stands in a text at
/// an offset.
fn note(errors: &[Error], read: &str, (text, offset): (usize, usize), diagnostics: &mut Diagnostics) {
    let mut last = None;
    for error in errors {
        if diagnostics.is_full() {
            return;
        }
        let whole = Span { text, start: 0, end: offset + read.len() };
        let span = error.span().map_or(whole, |range| shift(range, text, offset));
        if last != Some(span.start) {
            let help = error.span().and_then(|range| number_as_meant(error.message(), read, range.start));
            let help = help.unwrap_or_else(|| help_by(error.message()).to_owned());
            diagnostics.at(span, &Key::root(), format!("not valid TOML: {}", error.message()), help);
        }
        last = Some(span.start);
    }
}

/// The fix for a number whose digits TOML does not take as they are written: .5, 6. and 06.
fn number_as_meant(message: &str, read: &str, at: usize) -> Option<String> {
    if !["mantissa", "fraction", "leading zero"].iter().any(|fault| message.contains(fault)) {
        return None;
    }
    let (before, behind) = (read.get(..at)?, read.get(at..)?);
    let is_within = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.' | '_');
    let start = before.trim_end_matches(is_within).len();
    let end = read.len() - behind.trim_start_matches(is_within).len();
    let meant = with_digits(&read[start..end])?;
    Some(format!("write {meant}"))
}

/// A decimal number with a digit on both sides of its point, and no zero in front that says nothing.
fn with_digits(word: &str) -> Option<String> {
    let (sign, size) = word.strip_prefix('-').map_or(("", word.strip_prefix('+').unwrap_or(word)), |size| ("-", size));
    let (mantissa, exponent) = size.find(['e', 'E']).map_or((size, ""), |place| size.split_at(place));
    let (whole, fraction) = mantissa.split_once('.').map_or((mantissa, None), |(whole, rest)| (whole, Some(rest)));
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !(are_digits(whole) && fraction.is_none_or(are_digits)) || mantissa.trim_matches('.').is_empty() {
        return None;
    }
    let filled = |digits: &str| if digits.is_empty() { "0" } else { digits }.to_owned();
    let point = fraction.map(|fraction| format!(".{}", filled(fraction))).unwrap_or_default();
    let number = format!("{sign}{}{point}{exponent}", filled(whole.trim_start_matches('0')));
    number.parse::<f64>().is_ok_and(f64::is_finite).then_some(number)
}

fn help_by(message: &str) -> &'static str {
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
