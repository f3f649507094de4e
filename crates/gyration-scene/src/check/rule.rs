//! The JSON Schema of the file's types as rules that are quick to walk.
//!
//! Read are the keywords that the file's types bring about: `$ref`, `type`, `properties`, `required`, `items`,
//! `minItems`, `maxItems`, `oneOf` (words, tables with one key of several, or both), `anyOf` (one, or an array of them;
//! an array, or a number or expression, or a table), `minimum`, `maximum`, `exclusiveMinimum`, and the format's own
//! `unit`, `expression` and `anyUnit`. A test makes sure that nothing else occurs.

use crate::quantity::{ANY_UNIT, EXPRESSION, UNIT, WORDS};
use crate::schema::SCHEMA;
use crate::units::{Unit, parse_unit};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// The rules of a scene, made once.
pub(crate) static RULES: LazyLock<Rules> = LazyLock::new(|| Rules::new(&SCHEMA));

/// All rules, the shared ones by name.
#[derive(Debug)]
pub(crate) struct Rules {
    pub(super) root: FieldRule,
    shared: BTreeMap<String, FieldRule>,
}

/// What may stand at a place.
#[derive(Debug, Clone)]
pub(super) struct FieldRule {
    pub(super) rule: Rule,
    pub(super) limits: NumberLimits,
    pub(super) description: String,
}

/// The kind of a value and what it holds.
#[derive(Debug, Clone)]
pub(super) enum Rule {
    /// A shared rule.
    Shared(String),
    /// A table with these keys.
    Table { fields: BTreeMap<String, FieldRule>, required: Vec<String> },
    /// A table with keys of the user's choice.
    Named(Box<FieldRule>),
    /// An array of so many items.
    Array { item: Box<FieldRule>, least: usize, most: usize },
    /// One table or text of this kind, or an array of them.
    Several(Box<FieldRule>),
    /// An array, or a number or expression, of the first kind, or a table of the second.
    Either(Box<FieldRule>, Box<FieldRule>),
    /// True or false.
    Boolean,
    /// A pure number.
    Number,
    /// A number in SI units, a string with a unit, or one of these words.
    Quantity { symbol: String, unit: Unit, example: String, words: Vec<String> },
    /// A number in SI units, or a string with any unit.
    AnyQuantity,
    /// A number, or a string with an expression.
    Expression,
    /// Any string.
    Text,
    /// One of these strings, or a table with one of these keys; there may be none of either.
    Choice { words: Vec<String>, tags: BTreeMap<String, FieldRule> },
    /// A schema that is not understood: nothing is checked.
    Unknown,
}

/// Between what a number must lie.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct NumberLimits {
    /// At least this.
    pub(super) least: Option<f64>,
    /// At most this.
    pub(super) most: Option<f64>,
    /// More than this.
    pub(super) above: Option<f64>,
    /// Without a fraction.
    pub(super) whole: bool,
}

impl Rules {
    /// The rules of a schema.
    pub(crate) fn new(schema: &Json) -> Self {
        let definitions = schema.get("$defs").and_then(Json::as_object);
        let shared = definitions.into_iter().flatten().map(|(name, target)| (name.clone(), field(target)));
        Self { root: field(schema), shared: shared.collect() }
    }

    /// The rule itself, behind its name if it is a shared one.
    pub(super) fn resolve<'a>(&'a self, rule: &'a Rule) -> &'a Rule {
        match rule {
            Rule::Shared(name) => self.shared.get(name).map_or(&Rule::Unknown, |shared| &shared.rule),
            other => other,
        }
    }

    /// The limits of a number, with those of the shared rule that it follows.
    pub(super) fn limits(&self, field: &FieldRule) -> NumberLimits {
        let own = field.limits;
        let Rule::Shared(name) = &field.rule else { return own };
        let Some(shared) = self.shared.get(name).map(|shared| shared.limits) else { return own };
        NumberLimits {
            least: own.least.or(shared.least),
            most: own.most.or(shared.most),
            above: own.above.or(shared.above),
            whole: own.whole || shared.whole,
        }
    }

    /// The SI unit of the quantity at a dotted key; none if there is none, or no such key.
    pub(crate) fn unit_of(&self, key: &str) -> Option<&str> {
        let mut rule = self.resolve(&self.root.rule);
        for word in key.split('.') {
            let is_index = word.parse::<usize>().is_ok();
            let next = match rule {
                Rule::Either(array, _) if is_index => self.resolve(&array.rule),
                Rule::Either(_, table) => self.resolve(&table.rule),
                // One of several may be written without an array around it.
                Rule::Several(item) if !is_index => self.resolve(&item.rule),
                rule => rule,
            };
            rule = match next {
                Rule::Table { fields, .. } | Rule::Choice { tags: fields, .. } => self.resolve(&fields.get(word)?.rule),
                Rule::Array { item, .. } | Rule::Several(item) | Rule::Named(item) => self.resolve(&item.rule),
                _ => return None,
            };
        }
        match rule {
            Rule::Quantity { symbol, .. } => Some(symbol),
            _ => None,
        }
    }
}

fn field(schema: &Json) -> FieldRule {
    let number = |keyword: &str| schema.get(keyword).and_then(Json::as_f64);
    FieldRule {
        rule: rule(schema),
        limits: NumberLimits {
            least: number("minimum"),
            most: number("maximum"),
            above: number("exclusiveMinimum"),
            whole: text(schema, "type") == Some("integer"),
        },
        description: text(schema, "description").unwrap_or_default().to_owned(),
    }
}

fn rule(schema: &Json) -> Rule {
    if let Some(name) = rule_name(schema) {
        return Rule::Shared(name.to_owned());
    }
    if let Some(choices) = schema.get("oneOf").and_then(Json::as_array) {
        return choice(choices);
    }
    if let Some([one, many]) = schema.get("anyOf").and_then(Json::as_array).map(Vec::as_slice) {
        let matches = many.get("items").is_some_and(|items| rule_name(items) == rule_name(one));
        if matches {
            return Rule::Several(Box::new(field(one)));
        }
        let is_shared = rule_name(one).is_some() && rule_name(many).is_some();
        return match text(one, "type") {
            Some("array") => Rule::Either(Box::new(field(one)), Box::new(field(many))),
            None if is_shared => Rule::Either(Box::new(field(one)), Box::new(field(many))),
            _ => Rule::Unknown,
        };
    }
    if schema.get(EXPRESSION).is_some() {
        return Rule::Expression;
    }
    if schema.get(ANY_UNIT).is_some() {
        return Rule::AnyQuantity;
    }
    if let Some(symbol) = text(schema, UNIT) {
        return quantity(symbol, schema);
    }
    match text(schema, "type") {
        Some("object") => table(schema),
        Some("array") => array(schema),
        Some("boolean") => Rule::Boolean,
        Some("number" | "integer") => Rule::Number,
        Some("string") => Rule::Text,
        _ => Rule::Unknown,
    }
}

/// The name of a shared rule.
fn rule_name(schema: &Json) -> Option<&str> {
    text(schema, "$ref")?.rsplit('/').next()
}

/// Choices that are constants are words, the others tables of one key each.
fn choice(choices: &[Json]) -> Rule {
    let words = choices.iter().filter_map(|choice| text(choice, "const").map(str::to_owned)).collect();
    Rule::Choice { words, tags: choices.iter().flat_map(fields).collect() }
}

fn quantity(symbol: &str, schema: &Json) -> Rule {
    let example = schema.pointer("/examples/0").and_then(Json::as_str).unwrap_or_default().to_owned();
    let words = schema.get(WORDS).and_then(Json::as_array).into_iter().flatten();
    let words = words.filter_map(|word| word.as_str().map(str::to_owned)).collect();
    let symbol = symbol.to_owned();
    parse_unit(&symbol).map_or(Rule::Unknown, |unit| Rule::Quantity { symbol, unit, example, words })
}

fn table(schema: &Json) -> Rule {
    if let Some(named) = schema.get("additionalProperties").filter(|named| **named != Json::Bool(false)) {
        return Rule::Named(Box::new(field(named)));
    }
    let required = schema.get("required").and_then(Json::as_array).into_iter().flatten();
    let required = required.filter_map(Json::as_str).map(str::to_owned).collect();
    Rule::Table { fields: fields(schema), required }
}

fn array(schema: &Json) -> Rule {
    let count = |keyword: &str| schema.get(keyword).and_then(Json::as_u64).map(|count| count as usize);
    let (least, most) = (count("minItems").unwrap_or(0), count("maxItems").unwrap_or(usize::MAX));
    Rule::Array { item: Box::new(field(schema.get("items").unwrap_or(&Json::Null))), least, most }
}

fn fields(schema: &Json) -> BTreeMap<String, FieldRule> {
    let properties = schema.get("properties").and_then(Json::as_object);
    properties.into_iter().flatten().map(|(name, property)| (name.clone(), field(property))).collect()
}

fn text<'a>(schema: &'a Json, keyword: &str) -> Option<&'a str> {
    schema.get(keyword).and_then(Json::as_str)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_understood(field: &FieldRule, place: &str) {
        match &field.rule {
            Rule::Unknown => panic!("{place} is not understood"),
            Rule::Shared(name) => assert!(RULES.shared.contains_key(name), "{place}: {name} is not defined"),
            Rule::Table { fields, .. } | Rule::Choice { tags: fields, .. } => {
                fields.iter().for_each(|(name, field)| assert_understood(field, &format!("{place}.{name}")));
            }
            Rule::Array { item, .. } | Rule::Several(item) | Rule::Named(item) => assert_understood(item, place),
            Rule::Either(array, table) => [array, table].iter().for_each(|kind| assert_understood(kind, place)),
            Rule::Boolean
            | Rule::Number
            | Rule::Quantity { .. }
            | Rule::AnyQuantity
            | Rule::Expression
            | Rule::Text => {}
        }
    }

    #[test]
    fn quantities_are_found_by_their_keys() {
        let unit = |key: &str| RULES.unit_of(key);
        assert_eq!(unit("body.die.position.2"), Some("m"));
        assert_eq!(unit("body.0.shape.box.size"), None);
        assert_eq!(unit("contact.0.friction.beta"), Some("Pa s/m"));
        assert_eq!(unit("body.die.contractile.drive.sine.frequency"), Some("Hz"));
        assert_eq!([unit("solver.rtol"), unit("body.die.colour"), unit("")], [None; 3]);
    }

    #[test]
    fn every_part_of_the_schema_is_understood() {
        assert_understood(&RULES.root, "scene");
        for (name, shared) in &RULES.shared {
            assert_understood(shared, name);
        }
    }
}
