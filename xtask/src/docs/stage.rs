//! The pages as the book in HTML is built from them: copied, with links that hold there.
//!
//! Everything stands where it does in the repository, so that links and messages stay as they are, but for three: a
//! README is the `index` of its folder, a link to a folder is its text, and the contents stand at the end of the front
//! page. Pages that links lead to come along, and so do pictures and files.

use super::contents::{self, FRONT, REFERENCE, staged};
use super::markdown::links;
use crate::root;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// What the book is built from.
#[derive(Debug, Default)]
struct Pages {
    /// The texts, by path in the repository.
    texts: BTreeMap<String, String>,
    /// Pictures and files that the pages link to.
    files: BTreeSet<String>,
}

/// Puts everything into a folder, which is emptied before; the reference is the text of a page that is made.
pub fn stage(folder: &Path, reference: &Path) -> Result<(), String> {
    let pages = collected()?;
    let _ = fs::remove_dir_all(folder);
    let placed: BTreeSet<&str> = contents::pages().chain([FRONT]).collect();
    let others: Vec<String> = pages.texts.keys().filter(|page| !placed.contains(page.as_str())).cloned().collect();
    for (page, text) in &pages.texts {
        let mut text = text.clone();
        if page == FRONT {
            text.push_str(&contents::contents(&others));
        }
        write(&folder.join(staged(page)), text.as_bytes())?;
    }
    for file in &pages.files {
        write(&folder.join(file), &read(&root().join(file))?)?;
    }
    write(&folder.join(REFERENCE), &read(reference)?)
}

/// The pages that have a place, and what links lead to from there on.
fn collected() -> Result<Pages, String> {
    let mut pages = Pages::default();
    let mut next: Vec<String> = contents::pages().chain([FRONT]).map(str::to_owned).collect();
    next.retain(|page| page != REFERENCE);
    while let Some(page) = next.pop() {
        if pages.texts.contains_key(&page) {
            continue;
        }
        let bytes = read(&root().join(&page))?;
        let text = String::from_utf8(bytes).map_err(|error| format!("{page}: {error}"))?;
        let linked = linked(&page, &text);
        let is_file = |path: &&String| root().join(path).is_file();
        let (texts, files): (Vec<_>, Vec<_>) = linked.iter().filter(is_file).partition(|path| path.ends_with(".md"));
        next.extend(texts.into_iter().cloned());
        pages.files.extend(files.into_iter().cloned());
        let rewritten = rewritten(&page, &text, |path| root().join(path).is_dir());
        pages.texts.insert(page, rewritten);
    }
    Ok(pages)
}

/// The paths in the repository to which a page links.
fn linked(page: &str, text: &str) -> BTreeSet<String> {
    links(text).into_iter().filter_map(|link| path_of(page, &text[link.target])).map(|(path, _)| path).collect()
}

/// The path in the repository that a link of a page leads to, and its mark; none if it leads to the web.
pub fn path_of(page: &str, target: &str) -> Option<(String, Option<String>)> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, mark) = target.split_once('#').map_or((target, None), |(path, mark)| (path, Some(mark.to_owned())));
    if path.is_empty() {
        return Some((page.to_owned(), mark));
    }
    let mut parts = PathBuf::from(page);
    parts.pop();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir => drop(parts.pop()),
            Component::CurDir => {}
            other => parts.push(other),
        }
    }
    Some((parts.to_string_lossy().into_owned(), mark))
}

/// A page with links as they hold in HTML.
fn rewritten(page: &str, text: &str, is_folder: impl Fn(&str) -> bool) -> String {
    let mut rewritten = text.to_owned();
    for link in links(text).into_iter().rev() {
        let target = &text[link.target.clone()];
        let Some((path, _)) = path_of(page, target) else { continue };
        if is_folder(&path) {
            let words = &text[link.whole.start + 1..link.target.start - 2];
            rewritten.replace_range(link.whole, words);
        } else if path.ends_with("README.md") && target.contains("README.md") {
            rewritten.replace_range(link.target.clone(), &target.replace("README.md", "index.md"));
        }
    }
    rewritten
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_hold_in_html() {
        let text = "[a](../README.md#x) [b](../studies) [c](c.md) [d](https://x.org/README.md)";
        let rewritten = rewritten("docs/p.md", text, |path| path == "studies");
        assert_eq!(rewritten, "[a](../index.md#x) b [c](c.md) [d](https://x.org/README.md)");
    }

    #[test]
    fn links_lead_from_where_the_page_stands() {
        let path = |target: &str| path_of("docs/p.md", target);
        assert_eq!(path("../README.md#x"), Some(("README.md".into(), Some("x".into()))));
        assert_eq!(path("#y"), Some(("docs/p.md".into(), Some("y".into()))));
        assert_eq!(path("pictures/q.svg"), Some(("docs/pictures/q.svg".into(), None)));
        assert_eq!(path("https://x.org"), None);
    }
}
