//! The paths that a Rust source names, read from its text: `use` trees, and paths within code.
//!
//! No parser of the language: comments and test modules are taken out, and whatever follows `crate::` or `super::` is a
//! path, with braces spread out. Paths of other crates and of the standard library are not asked for.

/// A source without comments and without what is compiled for tests only.
pub fn stripped(source: &str) -> String {
    let mut text = String::new();
    let mut rest = source.lines();
    while let Some(line) = rest.next() {
        if line.trim_start().starts_with("#[cfg(test)]") {
            skip_item(&mut rest);
        } else {
            text.push_str(line.split_once("//").map_or(line, |(code, _)| code));
            text.push('\n');
        }
    }
    text
}

/// Passes over the item behind an attribute: to its closing brace, which stands under its beginning, or to its
/// semicolon.
fn skip_item<'a>(rest: &mut impl Iterator<Item = &'a str>) {
    let Some(first) = rest.find(|line| !line.trim_start().starts_with("#[")) else { return };
    if first.trim_end().ends_with('{') {
        let indentation = first.len() - first.trim_start().len();
        let _ =
            rest.find(|line| line.starts_with('}') || line.get(indentation..).is_some_and(|end| end.starts_with('}')));
    } else if !first.trim_end().ends_with([';', '}']) {
        let _ = rest.find(|line| line.trim_end().ends_with(';'));
    }
}

/// The paths that begin with `crate` or `super`, as their parts.
pub fn paths(source: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    for root in ["crate", "super"] {
        for (place, _) in source.match_indices(&format!("{root}::")) {
            let before = source[..place].chars().next_back().unwrap_or(' ');
            if !(before.is_alphanumeric() || "_$:".contains(before)) {
                spread(&source[place..], &[], &mut found);
            }
        }
    }
    found
}

/// The names that a module hands on, `pub use child::{A, B as C}`: the paths behind `pub use` and the name that each
/// gets.
pub fn handed_on(source: &str) -> Vec<(String, Vec<String>)> {
    let mut names = Vec::new();
    for (place, text) in source.match_indices("use ") {
        let line = source[..place].lines().next_back().unwrap_or("").trim();
        if line.starts_with("pub") && !source[..place].ends_with('\n') {
            let mut found = Vec::new();
            spread(&source[place + text.len()..], &[], &mut found);
            for mut path in found {
                // `A as B` is kept as one part.
                let last = path.pop().unwrap_or_default();
                let (item, name) = last.split_once(" as ").unwrap_or((&last, &last));
                path.push(item.to_owned());
                names.push((name.to_owned(), path));
            }
        }
    }
    names
}

/// Adds the paths of the tree at the start of a text; what is behind it.
fn spread<'a>(text: &'a str, prefix: &[String], found: &mut Vec<Vec<String>>) -> &'a str {
    let mut rest = text.trim_start();
    let mut path = prefix.to_vec();
    loop {
        if let Some(mut members) = rest.strip_prefix('{') {
            loop {
                members = spread(members, &path, found).trim_start();
                if let Some(behind) = members.strip_prefix('}') {
                    return behind;
                }
                let Some(next) = members.strip_prefix(',') else { return members };
                members = next.trim_start();
                if let Some(behind) = members.strip_prefix('}') {
                    return behind;
                }
            }
        }
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '*')).unwrap_or(rest.len());
        let (part, behind) = rest.split_at(end);
        if part != "self" || path.is_empty() {
            path.push(part.to_owned());
        }
        let Some(next) = behind.strip_prefix("::").filter(|next| !next.starts_with('<')) else {
            let behind = renamed(behind, &mut path);
            found.push(path);
            return behind;
        };
        rest = next;
    }
}

/// Takes ` as NAME` into the last part.
fn renamed<'a>(behind: &'a str, path: &mut [String]) -> &'a str {
    let Some(name) = behind.strip_prefix(" as ") else { return behind };
    let end = name.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(name.len());
    if let Some(last) = path.last_mut() {
        *last = format!("{last} as {}", &name[..end]);
    }
    &name[end..]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(paths: Vec<Vec<String>>) -> Vec<String> {
        paths.iter().map(|path| path.join("::")).collect()
    }

    #[test]
    fn trees_are_spread_and_code_is_read() {
        let source = "use crate::a::{self, b::{C, D as E}, f};\nfn x(y: &super::G) { crate::h::i(y); $crate::no(); }";
        let expected = ["crate::a", "crate::a::b::C", "crate::a::b::D as E", "crate::a::f", "crate::h::i", "super::G"];
        assert_eq!(texts(paths(source)), expected);
    }

    #[test]
    fn tests_and_comments_are_taken_out() {
        let source = "use crate::a; // crate::no\n#[cfg(test)]\n#[path = \"x\"]\nmod tests;\n\
                      #[cfg(test)]\nmod more {\n    use crate::no;\n}\nuse crate::b;\n";
        assert_eq!(texts(paths(&stripped(source))), ["crate::a", "crate::b"]);
    }

    #[test]
    fn names_that_are_handed_on_are_known_by_their_new_name() {
        let source = "mod a;\npub use a::{B, c::D as E};\npub(crate) use f::G;\nuse h::I;\n";
        let names = handed_on(source).into_iter().map(|(name, path)| format!("{name}={}", path.join("::")));
        assert_eq!(names.collect::<Vec<_>>(), ["B=a::B", "E=a::c::D", "G=f::G"]);
    }
}
