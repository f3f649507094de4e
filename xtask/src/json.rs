//! JSON, as far as the chores need it: no dependency is worth a hundred lines.
//!
//! Numbers stay text, since two numbers are the same here only if they are written the same.

use std::collections::BTreeMap;

/// A value of JSON.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Json {
    /// `null`, `true`, `false` or a number, as written.
    Word(String),
    /// A text without its escapes.
    Text(String),
    /// A list.
    List(Vec<Json>),
    /// An object.
    Map(BTreeMap<String, Json>),
}

/// A text as JSON writes it.
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            control if control.is_control() => quoted += &format!("\\u{:04x}", u32::from(control)),
            other => quoted.push(other),
        }
    }
    quoted + "\""
}

impl Json {
    /// Reads a whole text; none if it is not JSON.
    pub fn parse(text: &str) -> Option<Self> {
        let mut reader = JsonReader { rest: text };
        let value = reader.value()?;
        reader.peek().is_none().then_some(value)
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Self> {
        self.entries()?.get(key)
    }

    /// The entries of an object.
    pub fn entries(&self) -> Option<&BTreeMap<String, Self>> {
        if let Self::Map(entries) = self { Some(entries) } else { None }
    }

    /// The number.
    pub fn number(&self) -> Option<f64> {
        if let Self::Word(word) = self { word.parse().ok() } else { None }
    }

    /// The text.
    pub fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }
}

struct JsonReader<'a> {
    rest: &'a str,
}

impl JsonReader<'_> {
    /// The next character that is no space; none at the end.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    /// Takes this character, if it is the next.
    fn take(&mut self, wanted: char) -> Option<()> {
        self.peek()?;
        self.rest = self.rest.strip_prefix(wanted)?;
        Some(())
    }

    fn value(&mut self) -> Option<Json> {
        match self.peek()? {
            '{' => self
                .members('{', '}', |reader| {
                    reader.peek();
                    let key = reader.string()?;
                    reader.take(':')?;
                    Some((key, reader.value()?))
                })
                .map(|members| Json::Map(members.into_iter().collect())),
            '[' => self.members('[', ']', Self::value).map(Json::List),
            '"' => self.string().map(Json::Text),
            _ => self.word(),
        }
    }

    /// What stands between two brackets, separated by commas.
    fn members<T>(&mut self, open: char, close: char, member: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        self.take(open)?;
        let mut members = Vec::new();
        if self.take(close).is_some() {
            return Some(members);
        }
        loop {
            members.push(member(self)?);
            if self.take(',').is_none() {
                self.take(close)?;
                return Some(members);
            }
        }
    }

    fn word(&mut self) -> Option<Json> {
        let end =
            self.rest.find(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c))).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        (!word.is_empty()).then(|| Json::Word(word.to_owned()))
    }

    fn string(&mut self) -> Option<String> {
        self.rest = self.rest.strip_prefix('"')?;
        let mut text = String::new();
        loop {
            let end = self.rest.find(['"', '\\'])?;
            let (plain, rest) = self.rest.split_at(end);
            text.push_str(plain);
            self.rest = &rest[1..];
            if rest.starts_with('"') {
                return Some(text);
            }
            text.push(self.escaped()?);
        }
    }

    /// The character behind a backslash.
    fn escaped(&mut self) -> Option<char> {
        let letter = self.rest.chars().next()?;
        self.rest = &self.rest[letter.len_utf8()..];
        Some(match letter {
            'n' => '\n',
            't' => '\t',
            'r' => '\r',
            'b' => '\u{8}',
            'f' => '\u{c}',
            'u' => {
                let (digits, rest) = self.rest.split_at_checked(4)?;
                self.rest = rest;
                // Of a pair of surrogates each half becomes the same mark.
                char::from_u32(u32::from_str_radix(digits, 16).ok()?).unwrap_or(char::REPLACEMENT_CHARACTER)
            }
            other => other,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_recordings_hold_is_read() {
        let text = r#" {"a": [1.5e-3, -2, true, null], "b": {"c": "x\n\"ä\" \u00e4"}, "d": [], "e": {} } "#;
        let value = Json::parse(text).unwrap();
        let words = ["1.5e-3", "-2", "true", "null"].map(|word| Json::Word(word.into()));
        assert_eq!(value.get("a"), Some(&Json::List(words.to_vec())));
        assert_eq!(value.get("b").and_then(|b| b.get("c")).and_then(Json::text), Some("x\n\"ä\" ä"));
        assert_eq!(value.get("d"), Some(&Json::List(Vec::new())));
        assert_eq!(value.get("e").and_then(Json::entries), Some(&BTreeMap::new()));
    }

    #[test]
    fn what_is_no_json_is_refused() {
        for text in ["", "{", "[1,]", "{\"a\" 1}", "[1] 2", "\"open", "[1 2]", "{a: 1}", "\"\\u12\""] {
            assert_eq!(Json::parse(text), None, "{text}");
        }
    }
}
