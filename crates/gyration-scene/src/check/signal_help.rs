//! The fix for a signal in the place of an expression: the same as an expression of t.

use crate::tree::{Node, Table, Value};
use crate::units::parse_quantity;

/// The expression that a table with one signal stands for; none of another table.
pub(super) fn as_expression(table: &Table) -> Option<String> {
    let number = |part: &Table, key: &str| number(&part.get(key)?.node);
    let signal = |name: &str| match &table.get(name)?.node.value {
        Value::Table(part) => Some(part),
        _ => None,
    };
    if let Some(part) = signal("constant") {
        return Some(format!("{:?}", number(part, "value")?));
    }
    if let Some(part) = signal("sine") {
        let (amplitude, frequency) = (number(part, "amplitude")?, number(part, "frequency")?);
        let phase = match number(part, "phase") {
            Some(phase) if phase != 0.0 => format!(" + {phase:?}"),
            _ => String::new(),
        };
        return Some(format!("{amplitude:?}*sin(2*pi*{frequency:?}*t{phase})"));
    }
    let part = signal("ramp")?;
    let (from, to) = (number(part, "from").unwrap_or(0.0), number(part, "to")?);
    Some(format!("{from:?} + ({:?})*min(t/{:?}, 1)", to - from, number(part, "duration")?))
}

/// A number, or a text of one with a unit.
fn number(node: &Node) -> Option<f64> {
    match &node.value {
        Value::Number(number) => Some(*number),
        Value::Text(text) => parse_quantity(text).ok().map(|(number, unit)| number * unit.size),
        _ => None,
    }
}
