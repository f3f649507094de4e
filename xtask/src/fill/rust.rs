//! Filling the comments of Rust: runs of lines that hold nothing but a comment of one kind at one indentation.

use super::text;

/// The widest line.
pub const WIDTH: usize = 120;

/// A source with its comments filled.
pub fn filled(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    let (lines, in_code) = (source.lines().collect::<Vec<_>>(), starts_in_code(source));
    let comment = |line: usize| if in_code[line] { comment(lines[line]) } else { None };
    let mut line = 0;
    while line < lines.len() {
        let Some((prefix, _)) = comment(line) else {
            out.push_str(lines[line]);
            out.push('\n');
            line += 1;
            continue;
        };
        let run = (line..lines.len()).map_while(|line| comment(line).filter(|(other, _)| *other == prefix));
        let bodies: Vec<&str> = run.map(|(_, body)| body).collect();
        line += bodies.len();
        for body in text::filled(&bodies, WIDTH - prefix.chars().count() - 1) {
            out.push_str(prefix);
            if !body.is_empty() {
                out.push(' ');
                out.push_str(&body);
            }
            out.push('\n');
        }
    }
    out
}

/// The lines, from 1, that are too wide; an address cannot be broken, and what stands in a text of several lines is its
/// own affair.
pub fn wide(source: &str) -> Vec<usize> {
    let in_code = starts_in_code(source);
    let is_one_word = |line: &str| comment(line).is_some_and(|(_, body)| !body.trim().contains(' '));
    let lines = source.lines().enumerate();
    lines
        .filter(|(number, line)| in_code[*number] && line.chars().count() > WIDTH && !is_one_word(line))
        .map(|(number, _)| number + 1)
        .collect()
}

/// Indentation with marker, and text, of a line that is a comment and nothing else.
fn comment(line: &str) -> Option<(&str, &str)> {
    let start = line.len() - line.trim_start().len();
    let marker = ["//!", "///", "//"].into_iter().find(|marker| line[start..].starts_with(marker))?;
    let (prefix, body) = line.split_at(start + marker.len());
    // Four strokes, or a stroke right before a letter, are no prose.
    let body = if body.is_empty() { Some(body) } else { body.strip_prefix(' ') };
    body.map(|body| (prefix, body))
}

/// Of each line, whether it begins outside of texts and of comments between `/*` and `*/`.
fn starts_in_code(source: &str) -> Vec<bool> {
    let mut starts = Vec::new();
    // What ends the text or comment that the line begins in.
    let mut until: Option<String> = None;
    for line in source.lines() {
        starts.push(until.is_none());
        let mut rest = line;
        while !rest.is_empty() {
            rest = match &until {
                Some(end) => match found(rest, end) {
                    Some(behind) => {
                        until = None;
                        behind
                    }
                    None => "",
                },
                None => opened(rest, &mut until),
            };
        }
    }
    starts
}

/// What stands behind the end of a text; in one that is not raw, a backslash takes the next character along.
fn found<'a>(text: &'a str, end: &str) -> Option<&'a str> {
    let mut rest = text;
    loop {
        if let Some(behind) = rest.strip_prefix(end) {
            return Some(behind);
        }
        let mut characters = rest.chars();
        if characters.next()? == '\\' && end == "\"" {
            let _ = characters.next();
        }
        rest = characters.as_str();
    }
}

/// Passes over code to the next thing that may hold anything; sets what ends it, and gives what stands behind its
/// beginning.
fn opened<'a>(code: &'a str, until: &mut Option<String>) -> &'a str {
    let Some(place) = code.find(['"', '/', '\'', 'r']) else { return "" };
    let (before, rest) = code.split_at(place);
    let within_a_name = before.ends_with(|c: char| c.is_alphanumeric() || c == '_') && !before.ends_with('b');
    if rest.starts_with("//") {
        return "";
    }
    if let Some(behind) = rest.strip_prefix("/*") {
        *until = Some("*/".into());
        return behind;
    }
    if let Some(behind) = rest.strip_prefix('"') {
        *until = Some("\"".into());
        return behind;
    }
    if let Some(behind) = rest.strip_prefix('\'') {
        // A character, or a lifetime, which has no second stroke.
        let mut characters = behind.chars();
        let first = characters.next();
        let escaped = first == Some('\\');
        let tail =
            if escaped { found(&behind[2.min(behind.len())..], "'") } else { characters.as_str().strip_prefix('\'') };
        return tail.unwrap_or(behind);
    }
    let hashes = rest[1..].len() - rest[1..].trim_start_matches('#').len();
    match rest[1 + hashes.min(rest.len() - 1)..].strip_prefix('"').filter(|_| rest.starts_with('r') && !within_a_name) {
        Some(behind) => {
            *until = Some(format!("\"{}", "#".repeat(hashes)));
            behind
        }
        None => &rest[1..],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_of_one_kind_are_filled_and_code_is_not() {
        let long = "word ".repeat(30);
        let source =
            format!("//! One\n//! two.\n\n/// {}\nfn f() {{\n    // a\n    // b\n    g(); // c\n}}\n", long.trim());
        let expected = format!(
            "//! One two.\n\n/// {}\n/// {}\nfn f() {{\n    // a b\n    g(); // c\n}}\n",
            "word ".repeat(23).trim(),
            "word ".repeat(7).trim()
        );
        assert_eq!(filled(&source), expected);
        assert_eq!(filled(&expected), expected);
    }

    #[test]
    fn what_looks_like_a_comment_in_a_text_is_left_alone() {
        for text in
            ["\"x\n// a\n// b\n\"", "r#\"x \" \\\n// a\n// b\n\"#", "/* x\n// a\n// b\n*/", "\"\\\"\n// a\n// b\n\""]
        {
            let source = format!("let c = '\"'; let l: &'static str = {text};\n// one\n// two\n");
            assert_eq!(filled(&source), format!("let c = '\"'; let l: &'static str = {text};\n// one two\n"));
        }
    }

    #[test]
    fn equations_and_commands_in_comments_stay() {
        let source = "/// Law.\n///\n///   q = α d\n///\n/// # Errors\n/// None.\n///\n\
                      /// ```\n/// f();\n/// g();\n/// ```\n//no prose\n//// rule\n";
        assert_eq!(filled(source), source);
    }

    #[test]
    fn wide_lines_are_told_but_for_addresses_and_texts() {
        let (long, address) = ("x ".repeat(70), format!("http://{}", "x".repeat(120)));
        let source = format!("// {address}\nlet a = {long};\nlet b = \"\n{long}\";\n// {long}\n");
        assert_eq!(wide(&source), [2, 5]);
    }
}
