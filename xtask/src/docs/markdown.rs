//! Pages of Markdown as their links and headings: no parser of the whole language.
//!
//! Code is left out: what stands between fences, what is indented by four, what stands between backticks of one line.

#[cfg(test)]
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A link or a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// Line, from one.
    pub line: usize,
    /// All of it, from the bracket that opens the text on.
    pub whole: Range<usize>,
    /// Its target, without parentheses.
    pub target: Range<usize>,
}

/// The lines outside code, with their number and the place at which each begins.
fn prose(text: &str) -> impl Iterator<Item = (usize, usize, &str)> {
    let (mut place, mut in_code) = (0, false);
    let lines = text.split_inclusive('\n').enumerate().filter_map(move |(number, line)| {
        let start = place;
        place += line.len();
        let fence = line.trim_start().starts_with("```");
        in_code ^= fence;
        let is_prose = !(in_code || fence || line.starts_with("    "));
        is_prose.then_some((number + 1, start, line))
    });
    lines.collect::<Vec<_>>().into_iter()
}

/// The links and pictures of a page, in their order.
pub fn links(text: &str) -> Vec<Link> {
    let mut links = Vec::new();
    for (number, start, line) in prose(text) {
        let line = without_code(line);
        for (place, _) in line.match_indices("](") {
            let target = start + place + 2;
            let Some(length) = text[target..].find([')', ' ', '\n']) else { continue };
            let open = opening(&text[..start + place]).unwrap_or(start + place);
            let end = target + length;
            links.push(Link { line: number, whole: open..end + 1, target: target..end });
        }
    }
    links
}

/// The bracket that opens what a closing one behind the text would close.
fn opening(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (place, character) in text.char_indices().rev() {
        match character {
            ']' => depth += 1,
            '[' if depth == 0 => return Some(place),
            '[' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// A line with blanks in the place of what stands between backticks; its bytes stay where they are.
fn without_code(line: &str) -> String {
    let pieces: Vec<&str> = line.split('`').collect();
    let is_code = |index: usize| index % 2 == 1 && index + 1 < pieces.len();
    let blank = |(index, piece): (usize, &&str)| {
        if is_code(index) { " ".repeat(piece.len()) } else { (*piece).to_owned() }
    };
    pieces.iter().enumerate().map(blank).collect::<Vec<_>>().join("`")
}

/// The marks of the headings of a page, as forges make them.
#[cfg(test)]
pub fn anchors(text: &str) -> BTreeSet<String> {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let mut anchors = BTreeSet::new();
    for (_, _, line) in prose(text) {
        let Some(heading) = line.strip_prefix('#').map(|rest| rest.trim_start_matches('#')) else { continue };
        if let Some(heading) = heading.strip_prefix(' ') {
            let slug = slug(heading.trim());
            let count = seen.entry(slug.clone()).or_default();
            anchors.insert(if *count == 0 { slug } else { format!("{slug}-{count}") });
            *count += 1;
        }
    }
    anchors
}

/// The mark of a heading: small letters, blanks as hyphens, without punctuation.
#[cfg(test)]
fn slug(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || "-_ ".contains(*c));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_and_pictures_are_found_outside_code() {
        let text = "# A `b`\n[one\ntwo](x.md#y) and `[no](z)` and ![p](q.svg)\n```\n[no](z)\n```\n\n    [no](z)\n";
        let links = links(text);
        let targets: Vec<&str> = links.iter().map(|link| &text[link.target.clone()]).collect();
        assert_eq!(targets, ["x.md#y", "q.svg"]);
        assert_eq!(&text[links[0].whole.clone()], "[one\ntwo](x.md#y)");
        assert_eq!(links[1].line, 3);
    }

    #[test]
    fn headings_have_the_marks_of_forges() {
        let text = "# What a heap costs\n## `dice`\n## `dice`\n### T, P (q)\n```\n# no\n```\n";
        assert_eq!(anchors(text), ["dice", "dice-1", "t-p-q", "what-a-heap-costs"].map(String::from).into());
    }
}
