//! The structure of a scene: kinds of values, keys, lengths of arrays, units and limits of numbers.
//!
//! Goes on behind every error. The depth of the recursion is that of the tree, which the parsers limit.

use super::fixed;
use super::meant;
use super::rule::{FieldRule, NumberLimits, Rule, Rules};
use super::signal_help::as_expression;
use crate::document::Diagnostics;
use crate::error::ErrorKind;
use crate::key::Key;
use crate::suggest;
use crate::tree::{Node, Table, Value};
use crate::units::{Unit, UnitDimension, UnitError, parse_quantity, shown};
use std::collections::BTreeMap;

/// Notes where the tree departs from the rules of its format.
pub(crate) fn structure(root: &Node, rules: &Rules, diagnostics: &mut Diagnostics) {
    diagnostics.look_at(ErrorKind::Structure);
    Walker { rules, diagnostics }.visit(root, &Key::root(), &rules.root);
    diagnostics.look_at(ErrorKind::Value);
}

struct Walker<'a> {
    rules: &'a Rules,
    diagnostics: &'a mut Diagnostics,
}

impl Walker<'_> {
    fn visit(&mut self, node: &Node, key: &Key, field: &FieldRule) {
        if self.diagnostics.is_full() {
            return;
        }
        let limits = self.rules.limits(field);
        match (&node.value, self.rules.resolve(&field.rule)) {
            (Value::Table(table), Rule::Table { fields, required }) => self.table(table, node, key, fields, required),
            (Value::Table(table), Rule::Choice { words, tags }) if !tags.is_empty() => {
                self.tagged(table, node, key, words, tags);
            }
            (Value::Table(table), Rule::Named(field)) => {
                table.iter().for_each(|(name, entry)| self.visit(&entry.node, &key.key(name), field));
            }
            // One of several arrays, written without another around it.
            (Value::Array(items), Rule::Several(item))
                if matches!(self.rules.resolve(&item.rule), Rule::Array { .. })
                    && items.first().is_some_and(|first| !matches!(first.value, Value::Array(_))) =>
            {
                self.visit(node, key, item);
            }
            (Value::Array(items), Rule::Several(item)) => self.items(items, key, item),
            (Value::Table(_), Rule::Several(item)) => self.visit(node, key, item),
            (Value::Text(_), Rule::Several(item)) if matches!(self.rules.resolve(&item.rule), Rule::Text) => {}
            (Value::Boolean(_), Rule::Several(item)) if matches!(self.rules.resolve(&item.rule), Rule::Boolean) => {}
            (Value::Array(_), Rule::Either(array, _)) => self.visit(node, key, array),
            (Value::Number(_) | Value::Text(_), Rule::Either(entry, _))
                if matches!(self.rules.resolve(&entry.rule), Rule::Expression) =>
            {
                self.visit(node, key, entry);
            }
            (_, Rule::Either(_, other)) => self.visit(node, key, other),
            (Value::Array(items), Rule::Array { item, least, most }) => {
                let count = items.len();
                if !(*least..=*most).contains(&count) {
                    let expected = match count > *most {
                        _ if most == least => format!("{least}"),
                        true => format!("at most {most}"),
                        false => format!("at least {least}"),
                    };
                    let message = format!("expected {expected} items, found {count}");
                    self.diagnostics.at(node.span, key, message, format!("write {}", self.expected(&field.rule)));
                }
                self.items(items, key, item);
            }
            (Value::Number(number), Rule::Number | Rule::Expression) => self.limits(*number, node, key, limits, ""),
            (Value::Number(number), Rule::Quantity { symbol, .. }) => {
                self.limits(*number, node, key, limits, symbol);
            }
            (Value::Text(text), Rule::Quantity { words, .. }) if words.contains(text) => {}
            (Value::Text(text), Rule::Quantity { symbol, unit, example, words }) => {
                match in_unit(text, unit, symbol, example) {
                    Ok(number) => self.limits(number, node, key, limits, symbol),
                    Err((message, help)) => self.diagnostics.at(node.span, key, message, help + &or(words)),
                }
            }
            (Value::Number(number), Rule::AnyQuantity) => self.limits(*number, node, key, limits, ""),
            (Value::Text(text), Rule::AnyQuantity) => match parse_quantity(text) {
                Ok((number, unit)) => self.limits(number * unit.size, node, key, limits, ""),
                Err(error) => {
                    let help = match &error {
                        UnitError::UnknownUnit { nearest: Some(nearest), .. } => format!("did you mean \"{nearest}\"?"),
                        _ => "write a number, or a string such as \"100 N/m\"".to_owned(),
                    };
                    self.diagnostics.at(node.span, key, error.to_string(), help);
                }
            },
            (Value::Text(text), Rule::Choice { words, .. }) if words.contains(text) => {}
            (Value::Text(text), Rule::Choice { words, tags }) if !words.is_empty() && !tags.contains_key(text) => {
                let listed = || suggest::fix(text, words.iter().map(String::as_str), "one of");
                let help = meant::called(text, words).unwrap_or_else(listed);
                self.diagnostics.at(node.span, key, format!("\"{text}\" is not known here"), help);
            }
            (Value::Text(_), Rule::Text | Rule::Expression)
            | (Value::Boolean(_), Rule::Boolean)
            | (_, Rule::Unknown) => {}
            (_, rule) => {
                let expected = self.expected(rule);
                let help = mismatch_help(&node.value, rule, &expected);
                let message = format!("expected {expected}, found {}", node.value.kind());
                self.diagnostics.at(node.span, key, message, help);
            }
        }
    }

    fn table(
        &mut self,
        table: &Table,
        node: &Node,
        key: &Key,
        fields: &BTreeMap<String, FieldRule>,
        required: &[String],
    ) {
        self.keys(table, key, fields, "known keys");
        for name in required.iter().filter(|name| !table.contains_key(*name)) {
            let help = match fields.get(name) {
                Some(field) => {
                    let purpose = field.description.trim_end_matches('.').replace('\n', " ");
                    format!("add `{name}` ({purpose}): {}", self.expected(&field.rule))
                }
                None => format!("add `{name}`"),
            };
            self.diagnostics.at(node.span, &key.key(name), format!("the key \"{name}\" is missing"), help);
        }
    }

    fn items(&mut self, items: &[Node], key: &Key, item: &FieldRule) {
        items.iter().enumerate().for_each(|(index, node)| self.visit(node, &key.index(index), item));
    }

    fn tagged(&mut self, table: &Table, node: &Node, key: &Key, words: &[String], tags: &BTreeMap<String, FieldRule>) {
        self.keys(table, key, tags, "one of");
        if table.len() != 1 {
            let expected = choices(words, tags);
            let message = format!("expected exactly one key, found {}", table.len());
            self.diagnostics.at(node.span, key, message, format!("write {expected}"));
        }
    }

    /// Every key of a table: unknown, not in this version, or on to its value.
    fn keys(&mut self, table: &Table, key: &Key, fields: &BTreeMap<String, FieldRule>, what: &str) {
        for (name, entry) in table {
            if self.diagnostics.is_full() {
                return;
            }
            let place = key.key(name);
            match fields.get(name) {
                None if fixed::says(key, name) => {
                    let message = "a body that does not move is a support";
                    self.diagnostics.at(entry.key_span, &place, message, fixed::help(name, table));
                }
                None => {
                    let help = self.help_with(name, key, fields, what);
                    self.diagnostics.at(entry.key_span, &place, format!("unknown key \"{name}\""), help);
                }
                Some(field) => self.visit(&entry.node, &place, field),
            }
        }
    }

    /// What to write for a key that is none.
    fn help_with(&self, name: &str, key: &Key, fields: &BTreeMap<String, FieldRule>, what: &str) -> String {
        if let Some(help) = meant::meant(name, key) {
            return help;
        }
        let known = fields.keys().map(String::as_str);
        let of_another_file = if *key == Key::root() { of_another_file(name) } else { None };
        if of_another_file.is_none() && suggest::nearest(name, known.clone()).is_some() {
            return suggest::fix(name, known, what);
        }
        of_another_file
            .or_else(|| meant::meant_in(name, key))
            .or_else(|| meant::elsewhere(name, key, self.rules))
            .unwrap_or_else(|| suggest::fix(name, known, what))
    }

    fn limits(&mut self, number: f64, node: &Node, key: &Key, limits: NumberLimits, unit: &str) {
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let NumberLimits { least, most, above, whole } = limits;
        // Whole numbers up to 2^53 are told with all their digits.
        let told = |value: f64| if whole && value.abs() < 1e17 { value.to_string() } else { shown(value) };
        let broken = match (least, most, above) {
            _ if number.is_nan() => Some("a number".to_owned()),
            _ if number.is_infinite() => Some("finite".to_owned()),
            (_, _, Some(above)) if number <= above => Some(format!("greater than {}{unit}", told(above))),
            (Some(least), _, _) if number < least => Some(format!("at least {}{unit}", told(least))),
            (_, Some(most), _) if number > most => Some(format!("at most {}{unit}", told(most))),
            _ if whole && number.fract() != 0.0 => Some("whole".to_owned()),
            _ => None,
        };
        if let Some(condition) = broken {
            // Beyond a limit by rounding, a number is told with all its digits.
            let mut limits = [least, most, above].into_iter().flatten();
            let is_at_limit = limits.any(|limit| limit != number && shown(limit) == shown(number));
            let found = if is_at_limit { format!("{number:?}") } else { told(number) };
            let message = format!("must be {condition}, found {found}{unit}");
            let range = match (least, most) {
                (Some(least), Some(most)) if whole => format!("write a whole number from {least} to {most}"),
                (Some(least), Some(most)) => format!("write a number from {} to {}{unit}", shown(least), shown(most)),
                _ if number.is_nan() => "write the number itself".to_owned(),
                _ => format!("write a number that is {condition}"),
            };
            self.diagnostics.look_at(ErrorKind::Value);
            self.diagnostics.at(node.span, key, message, range);
            self.diagnostics.look_at(ErrorKind::Structure);
        }
    }

    /// What a rule asks for, in words.
    fn expected(&self, rule: &Rule) -> String {
        match self.rules.resolve(rule) {
            Rule::Number => "a number".to_owned(),
            Rule::Quantity { symbol, example, words, .. } => {
                format!("a number in {symbol} or a string such as \"{example}\"{}", or(words))
            }
            Rule::AnyQuantity => "a number or a string such as \"100 N/m\"".to_owned(),
            Rule::Expression => "a number or a string with an expression".to_owned(),
            Rule::Text => "a string".to_owned(),
            Rule::Boolean => "true or false".to_owned(),
            Rule::Choice { words, tags } => choices(words, tags),
            Rule::Either(array, table) => format!("{}, or {}", self.expected(&array.rule), self.expected(&table.rule)),
            Rule::Several(item) => format!("{}, or an array of such", self.expected(&item.rule)),
            Rule::Array { item, least, most } => {
                let count = if least == most { format!("{least} items") } else { "items".to_owned() };
                format!("an array of {count}, each {}", self.expected(&item.rule))
            }
            Rule::Table { fields, required } if !required.is_empty() || fields.is_empty() => {
                let keys: Vec<String> = required.iter().map(|name| format!("{name} = …")).collect();
                format!("a table {{ {} }}", keys.join(", ")).replace("{  }", "{}")
            }
            Rule::Table { fields, .. } => {
                let keys: Vec<&str> = fields.keys().map(String::as_str).collect();
                format!("a table with keys of {}", keys.join(", "))
            }
            Rule::Named(_) => "a table".to_owned(),
            Rule::Shared(_) | Rule::Unknown => "a value".to_owned(),
        }
    }
}

/// The kinds of file, the command that takes each, and the keys at their roots that no other kind has.
const FILES: [(&str, &str, &[&str]); 3] = [
    ("scenes", "run", &["world", "time", "solver", "support", "contact", "body", "fluid", "constants"]),
    ("studies", "study", &["seed", "repetitions", "sampling", "recordings", "parameter", "keep", "plot"]),
    ("measurements", "calibrate", &["fit", "drop", "gap", "slope", "pull_off"]),
];

/// The fix for a key at the root that belongs to another kind of file.
fn of_another_file(name: &str) -> Option<String> {
    let (files, command, _) = FILES.iter().find(|(.., keys)| keys.contains(&name))?;
    Some(format!("it is a key of {files}, which `gyration {command}` takes"))
}

/// The words by which a quantity may be left to the program, as they end a help.
fn or(words: &[String]) -> String {
    words.iter().map(|word| format!(", or \"{word}\"")).collect()
}

/// One of some words, or a table with one of some keys.
fn choices(words: &[String], tags: &BTreeMap<String, FieldRule>) -> String {
    let keys: Vec<&str> = tags.keys().map(String::as_str).collect();
    let words = match words {
        [] => String::new(),
        [only] => format!("\"{only}\""),
        _ => format!("one of \"{}\"", words.join("\", \"")),
    };
    match (words.is_empty(), keys.is_empty()) {
        (_, true) => words,
        (true, false) => format!("a table with one key of {}", keys.join(", ")),
        (false, false) => format!("{words} or a table with one key of {}", keys.join(", ")),
    }
}

fn mismatch_help(value: &Value, rule: &Rule, expected: &str) -> String {
    match (value, rule) {
        (Value::Null, _) => "leave the key out".to_owned(),
        (Value::Text(text), Rule::Number) if text.trim().parse::<f64>().is_ok() => "write it without quotes".to_owned(),
        (Value::Text(_), Rule::Number) => "write a pure number: it has no unit".to_owned(),
        (Value::Text(text), Rule::Choice { tags, .. }) if tags.contains_key(text) => {
            format!("write {{ {text} = {{ … }} }}")
        }
        (Value::Table(table), Rule::Expression) => match as_expression(table) {
            Some(expression) => format!("write the same as an expression: \"{expression}\""),
            None => format!("write {expected}"),
        },
        _ => format!("write {expected}"),
    }
}

/// The value of a string with a unit in SI units, if the unit has the right dimension; else message and fix.
fn in_unit(text: &str, wanted: &Unit, symbol: &str, example: &str) -> Result<f64, (String, String)> {
    let pattern = format!("write a number in {symbol}, or a string such as \"{example}\"");
    let (number, unit) = parse_quantity(text).map_err(|error| {
        let help = match &error {
            UnitError::UnknownUnit { nearest: Some(nearest), .. } => format!("did you mean \"{nearest}\"?"),
            _ => pattern.clone(),
        };
        (error.to_string(), help)
    })?;
    if unit.dimension == wanted.dimension {
        return Ok(number * unit.size);
    }
    if unit.dimension == UnitDimension::default() {
        return Err((
            format!("\"{text}\" has no unit"),
            format!("write {} without quotes, in {symbol}, or add a unit", shown(number)),
        ));
    }
    let message = format!("\"{text}\" is in {}, expected {symbol} ({})", unit.dimension, wanted.dimension);
    Err((message, pattern))
}
