//! Words of a text: numbers, names, signs, each with its column.

use crate::error::{ParseError, Reason};

/// A word.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Token {
    Number(f64),
    Name(String),
    Sign(char),
    End,
}

impl std::fmt::Display for Token {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Token::Number(value) => write!(out, "{value}"),
            Token::Name(name) => write!(out, "`{name}`"),
            Token::Sign(sign) => write!(out, "`{sign}`"),
            Token::End => out.write_str("the end"),
        }
    }
}

/// A word and its column, counted in characters from 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Word {
    pub(crate) token: Token,
    pub(crate) column: usize,
}

/// All words of `text`, [`Token::End`] last.
pub(crate) fn words(text: &str) -> Result<Vec<Word>, ParseError> {
    let characters: Vec<char> = text.chars().collect();
    let mut words = Vec::new();
    let mut at = 0;
    while let Some(&character) = characters.get(at) {
        let column = at + 1;
        let (token, next) = match character {
            _ if character.is_whitespace() => {
                at += 1;
                continue;
            }
            '0'..='9' | '.' => number(&characters, at)?,
            'a'..='z' | 'A'..='Z' | '_' => name(&characters, at),
            '*' if characters.get(at + 1) == Some(&'*') => {
                return Err(ParseError::Text { column, reason: Reason::Stars });
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => (Token::Sign(character), at + 1),
            other => return Err(ParseError::Text { column, reason: Reason::Character(other) }),
        };
        words.push(Word { token, column });
        at = next;
    }
    words.push(Word { token: Token::End, column: characters.len() + 1 });
    Ok(words)
}

fn name(characters: &[char], from: usize) -> (Token, usize) {
    let end = run(characters, from, |c| c.is_ascii_alphanumeric() || c == '_');
    (Token::Name(characters[from..end].iter().collect()), end)
}

/// Digits, a point, and an exponent if digits follow its `e`.
fn number(characters: &[char], from: usize) -> Result<(Token, usize), ParseError> {
    let mut end = run(characters, from, |c| c.is_ascii_digit() || c == '.');
    if matches!(characters.get(end), Some('e' | 'E')) {
        let signed = end + 1 + usize::from(matches!(characters.get(end + 1), Some('+' | '-')));
        let exponent = run(characters, signed, |c| c.is_ascii_digit());
        if exponent > signed {
            end = exponent;
        }
    }
    let digits: String = characters[from..end].iter().collect();
    match digits.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Token::Number(value), end)),
        _ => Err(ParseError::Text { column: from + 1, reason: Reason::Number(digits) }),
    }
}

/// End of the characters from `from` on that are all `of`.
fn run(characters: &[char], from: usize, of: impl Fn(char) -> bool) -> usize {
    let count = characters[from..].iter().take_while(|c| of(**c)).count();
    from + count
}
