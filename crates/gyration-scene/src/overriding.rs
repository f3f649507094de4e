//! Changes to a scene before it is checked: as written on a command line, or as the numbers that a program has.

use std::fmt;

/// What stands at a dotted key from then on.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    /// The key; items of arrays by name, else by index from zero.
    pub key: String,
    /// What stands there.
    pub value: OverrideValue,
}

/// A value of an override.
#[derive(Debug, Clone, PartialEq)]
pub enum OverrideValue {
    /// Nothing was written, not even `=`, which is an error at its place.
    Absent,
    /// A TOML value, or a bare string.
    Written(String),
    /// A number.
    Number(f64),
    /// Numbers.
    Array(Vec<f64>),
    /// A table with one key, at which numbers stand.
    Table(&'static str, Vec<f64>),
}

impl Override {
    /// A value for a key.
    pub fn new(key: impl Into<String>, value: impl Into<OverrideValue>) -> Self {
        Self { key: key.into(), value: value.into() }
    }

    /// Of `KEY=VALUE`, as in `--set`.
    pub fn parse(text: &str) -> Self {
        match text.split_once('=') {
            Some((key, value)) => Self::new(key, value),
            None => Self::new(text, OverrideValue::Absent),
        }
    }

    /// All of a list.
    pub fn parse_all(texts: &[String]) -> Vec<Self> {
        texts.iter().map(|text| Self::parse(text)).collect()
    }

    /// Whether it is a text, with places in it.
    pub(crate) fn is_text(&self) -> bool {
        matches!(self.value, OverrideValue::Absent | OverrideValue::Written(_))
    }
}

impl From<f64> for OverrideValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for OverrideValue {
    fn from(text: &str) -> Self {
        Self::Written(text.to_owned())
    }
}

impl<const N: usize> From<[f64; N]> for OverrideValue {
    fn from(numbers: [f64; N]) -> Self {
        Self::Array(numbers.into())
    }
}

/// As it would be written.
impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.value {
            OverrideValue::Absent => f.write_str(&self.key),
            value => write!(f, "{}={value}", self.key),
        }
    }
}

/// As it would be written, with all digits.
impl fmt::Display for OverrideValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Absent => Ok(()),
            Self::Written(text) => f.write_str(text),
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Array(numbers) => write!(f, "{numbers:?}"),
            Self::Table(key, numbers) => write!(f, "{{ {key} = {numbers:?} }}"),
        }
    }
}
