//! The pages of the book and their order.
//!
//! A page of `docs/` that has no place here is an error of the build.

use std::fmt::Write as _;

/// The front page.
pub const FRONT: &str = "README.md";

/// The reference of the Python package, which is made.
pub const REFERENCE: &str = "docs/python-reference.rst";

/// The parts of the book: a caption and its pages.
const PARTS: [(&str, &[&str]); 7] = [
    (
        "Begin",
        &["docs/README.md", "docs/gallery.md", "docs/viewing.md", "docs/recipes.md", "docs/check-any-simulator.md"],
    ),
    ("Scenes", &["docs/scene-reference.md", "docs/robots.md", "docs/crowds.md", "docs/bench.md", "docs/exit-codes.md"]),
    (
        "Results",
        &[
            "docs/recording.md",
            "docs/recipes-recordings.md",
            "docs/exports.md",
            "docs/fields.md",
            "docs/spectrum.md",
            "docs/sensitivities.md",
        ],
    ),
    ("Many runs", &["docs/studies.md", "docs/ready-studies.md", "docs/clusters.md", "docs/calibrate.md"]),
    ("Python", &["docs/python.md", REFERENCE]),
    (
        "Theory",
        &[
            "docs/notation.md",
            "docs/equations.md",
            "docs/theory-rigid.md",
            "docs/theory-affine.md",
            "docs/theory-contractile.md",
            "docs/theory-meetings.md",
            "docs/theory-lattices.md",
            "docs/theory-fluid.md",
            "docs/fluid-memory.md",
            "docs/resistance.md",
            "docs/modes.md",
            "docs/bands.md",
            "docs/continuum.md",
            "docs/orbits.md",
            "docs/known-answers.md",
            "docs/published.md",
        ],
    ),
    ("Project", &["CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md"]),
];

/// The pages that have a place.
pub fn pages() -> impl Iterator<Item = &'static str> {
    PARTS.iter().flat_map(|(_, pages)| pages.iter().copied())
}

/// The contents as Sphinx reads them at the end of the front page; `others` are pages that links lead to besides.
pub fn contents(others: &[String]) -> String {
    let mut text = String::new();
    for (caption, pages) in PARTS {
        let _ = write!(text, "\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n");
        let others = others.iter().map(String::as_str).filter(|_| caption == "Project");
        for page in pages.iter().copied().chain(others) {
            let _ = writeln!(text, "{}", document(page));
        }
        text.push_str("```\n");
    }
    text
}

/// The name of a page in the contents: without ending, and `index` for what a folder opens with.
fn document(page: &str) -> String {
    let page = staged(page);
    page.rsplit_once('.').map_or(page.clone(), |(name, _)| name.to_owned())
}

/// The path of a page as it is built: a README is what its folder opens with.
pub fn staged(page: &str) -> String {
    match page.strip_suffix("README.md") {
        Some(folder) => format!("{folder}index.md"),
        None => page.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_page_of_the_book_has_a_place() {
        let entries = std::fs::read_dir(crate::root().join("docs")).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        for name in names.filter(|name| name.ends_with(".md")) {
            let page = format!("docs/{name}");
            assert!(pages().any(|placed| placed == page), "{page} has no place in xtask/src/docs/contents.rs");
        }
        for page in pages().filter(|page| *page != REFERENCE) {
            assert!(crate::root().join(page).is_file(), "{page} is not there");
        }
    }

    #[test]
    fn contents_name_documents() {
        let text = contents(&["bench/README.md".to_owned()]);
        assert!(text.contains(":caption: Begin\n\ndocs/index\ndocs/gallery\n"), "{text}");
        assert!(text.ends_with("ARCHITECTURE\nbench/index\n```\n"), "{text}");
    }
}
