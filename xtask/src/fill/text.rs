//! Filling prose: paragraphs are broken anew, as late as the width allows; everything else stays as it is.
//!
//! Left alone are lists, tables, headings, quotes, blocks of code and whatever is indented, equations among it.

/// The lines of a text with its paragraphs filled to a width in characters.
pub fn filled(lines: &[&str], width: usize) -> Vec<String> {
    let (mut text, mut paragraph, mut in_code) = (Vec::new(), Vec::new(), false);
    for line in lines {
        let fence = line.trim_start().starts_with("```");
        if in_code || fence || stands_alone(line) {
            flush(&mut paragraph, width, &mut text);
            text.push((*line).to_owned());
        } else {
            paragraph.extend(words(line));
            // A break that is meant.
            if line.ends_with("  ") || line.ends_with('\\') {
                flush(&mut paragraph, width, &mut text);
                if let (Some(last), true) = (text.last_mut(), line.ends_with(' ')) {
                    last.push_str("  ");
                }
            }
        }
        in_code ^= fence;
    }
    flush(&mut paragraph, width, &mut text);
    text
}

/// Whether a line is no part of a paragraph.
fn stands_alone(line: &str) -> bool {
    let first = line.split(' ').next().unwrap_or("");
    line.trim().is_empty()
        || line.starts_with([' ', '\t', '|', '<', '>'])
        || is_marker(first)
        || line.starts_with("]: ")
        || line.starts_with('[') && line.contains("]: ")
}

/// Whether a word at the beginning of a line would make it an item or a heading.
fn is_marker(word: &str) -> bool {
    let digits = word.trim_end_matches(['.', ')']);
    let numbered = digits.len() + 1 == word.len() && !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    numbered || matches!(word, "-" | "*" | "+" | "•" | "·") || (!word.is_empty() && word.chars().all(|c| c == '#'))
}

/// The words of a line; code within it whose spaces count is one word.
fn words(line: &str) -> Vec<&str> {
    let (mut words, mut start, mut in_code) = (Vec::new(), None, false);
    for (place, character) in line.char_indices() {
        if character == '`' {
            let span = line[place + 1..].split_once('`').map(|(span, _)| span);
            in_code = !in_code && span.is_some_and(|span| span.contains("  "));
        }
        if character.is_whitespace() && !in_code {
            words.extend(start.take().map(|start| &line[start..place]));
        } else {
            start = start.or(Some(place));
        }
    }
    words.extend(start.map(|start| &line[start..]));
    words
}

/// Adds the paragraph, broken greedily, and empties it.
fn flush(paragraph: &mut Vec<&str>, width: usize, text: &mut Vec<String>) {
    let mut line = String::new();
    for piece in pieces(paragraph) {
        if !line.is_empty() && line.chars().count() + 1 + piece.chars().count() > width {
            text.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(&piece);
    }
    if !line.is_empty() {
        text.push(line);
    }
    paragraph.clear();
}

/// Words, those that must not begin a line joined to the word before them.
fn pieces(words: &[&str]) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for word in words {
        match pieces.last_mut().filter(|_| stands_alone(word) || word.starts_with("```")) {
            Some(last) => {
                last.push(' ');
                last.push_str(word);
            }
            None => pieces.push((*word).to_owned()),
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, width: usize, expected: &str) {
        let lines: Vec<&str> = text.lines().collect();
        let once = filled(&lines, width);
        assert_eq!(once.join("\n"), expected);
        let again: Vec<&str> = once.iter().map(String::as_str).collect();
        assert_eq!(filled(&again, width), once, "filled twice");
    }

    #[test]
    fn paragraphs_are_broken_as_late_as_the_width_allows() {
        check("one two three\nfour\n\nfive\nsix", 10, "one two\nthree four\n\nfive six");
    }

    #[test]
    fn what_is_no_paragraph_stays() {
        let text = "# A heading of more than ten\n- an item of a list\n\
                    \u{20} and its second line\n1. a number of it\n\n\
                    \u{20} q = a + b + c\n\n\
                    | a | table of two |\n```\na  b  c  d  e\nf\n```\n\
                    [a]: http://somewhere.long/x\n> said by another";
        check(text, 10, text);
    }

    #[test]
    fn no_word_becomes_a_marker_by_the_way() {
        check("aaaa bbbb - cccc 12. dd", 10, "aaaa\nbbbb -\ncccc 12.\ndd");
        check("aaaa bbbb\n#1 is no heading", 20, "aaaa bbbb #1 is no\nheading");
    }

    #[test]
    fn a_long_word_has_a_line_of_its_own_and_characters_are_counted() {
        check("see http://a.very.long/address there", 10, "see\nhttp://a.very.long/address\nthere");
        check("äöü äöü äöü", 7, "äöü äöü\näöü");
    }

    #[test]
    fn spaces_within_code_that_count_stay() {
        check("a `b  c` d\n`e f` g", 20, "a `b  c` d `e f` g");
    }

    #[test]
    fn a_break_that_is_meant_stays() {
        check("one  \ntwo three", 20, "one  \ntwo three");
    }
}
