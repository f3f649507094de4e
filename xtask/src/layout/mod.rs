//! Whether the workspace is laid out as `ARCHITECTURE.md` says: a chore of the tests alone.
//!
//! Its blocks of code marked `order` name crates, or the modules of one crate, in ranks from left to right; each
//! imports only what stands in a rank to its left. Nowhere do modules that stand side by side import one another in a
//! circle.

mod features;
mod paths;
mod tree;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use tree::{ModuleTree, circles};

fn workspace() -> BTreeMap<String, PathBuf> {
    let entries = fs::read_dir(crate::root().join("crates")).unwrap();
    let folders = entries.map(|entry| entry.unwrap().path()).filter(|folder| folder.join("Cargo.toml").exists());
    let named = |folder: PathBuf| (folder.file_name().unwrap().to_string_lossy().into_owned(), folder);
    folders.map(named).chain([("xtask".to_owned(), crate::root().join("xtask"))]).collect()
}

/// The ranks of an order, by its title.
fn orders(page: &str) -> BTreeMap<String, Vec<BTreeSet<String>>> {
    let blocks = page.split("```order\n").skip(1).filter_map(|block| block.split("```").next());
    let mut orders: BTreeMap<String, String> = BTreeMap::new();
    let mut title = String::new();
    for line in blocks.flat_map(str::lines) {
        let (name, ranks) = line.split_once(": ").unwrap_or(("", line));
        if !name.is_empty() {
            title = name.trim().to_owned();
        }
        let text = orders.entry(title.clone()).or_default();
        text.push(' ');
        text.push_str(ranks.trim());
    }
    let ranks = |text: &str| text.split('→').map(|rank| rank.split_whitespace().map(String::from).collect()).collect();
    orders.iter().map(|(title, text)| (title.clone(), ranks(text))).collect()
}

/// The imports that are wrong by this order: who imports what, and why not.
fn misplaced(
    order: &[BTreeSet<String>],
    imports: &BTreeMap<String, BTreeSet<String>>,
) -> Vec<(String, String, &'static str)> {
    let rank = |name: &String| order.iter().position(|rank| rank.contains(name));
    let mut wrong = Vec::new();
    for (importer, imported) in imports {
        for imported in imported {
            let reason = match (rank(importer), rank(imported)) {
                (Some(high), Some(low)) if high > low => continue,
                (Some(_), Some(_)) => "does not stand to its left",
                _ => "one of them has no place",
            };
            wrong.push((importer.clone(), imported.clone(), reason));
        }
    }
    wrong
}

/// The crates of the workspace that a crate imports.
fn dependencies(folder: &Path, crates: &BTreeMap<String, PathBuf>) -> BTreeSet<String> {
    let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
    let sections = manifest.split("\n[").filter(|section| section.starts_with("dependencies]"));
    let names = sections.flat_map(str::lines).filter_map(|line| line.split(['.', ' ', '=']).next());
    names.filter(|name| crates.contains_key(*name)).map(short).collect()
}

fn short(name: &str) -> String {
    name.strip_prefix("gyration-").unwrap_or(name).to_owned()
}

#[test]
fn crates_and_modules_import_only_what_stands_to_their_left() {
    let crates = workspace();
    let page = fs::read_to_string(crate::root().join("ARCHITECTURE.md")).unwrap();
    let orders = orders(&page);
    assert!(orders.contains_key("workspace") && orders.contains_key("gyration"), "{orders:?}");
    for (title, order) in &orders {
        let imports = if title == "workspace" {
            crates.iter().map(|(name, folder)| (short(name), dependencies(folder, &crates))).collect()
        } else {
            let folder = crates.iter().find(|(name, _)| short(name) == *title).unwrap().1;
            ModuleTree::read(&folder.join("src")).imports().remove(&Vec::new()).unwrap_or_default()
        };
        assert!(imports.len() > 3, "{title}: {imports:?}");
        assert_eq!(misplaced(order, &imports), [], "by the order of {title} in ARCHITECTURE.md");
    }
}

#[test]
fn modules_side_by_side_import_one_another_in_no_circle() {
    for (name, folder) in workspace() {
        for (parent, children) in ModuleTree::read(&folder.join("src")).imports() {
            let place = [name.clone()].into_iter().chain(parent).collect::<Vec<_>>().join("::");
            let circles = circles(&children);
            assert!(circles.is_empty(), "in {place} there are circles: {circles:?}");
        }
    }
}

/// A file that no module declares is compiled by nobody, and its tests are never run.
#[test]
fn every_file_of_tests_is_a_module_of_its_program() {
    for folder in workspace().into_values().chain([crate::root().join("validation")]) {
        let Ok(main) = fs::read_to_string(folder.join("tests/main.rs")) else { continue };
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        for entry in fs::read_dir(folder.join("tests")).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            let is_module = path.extension().is_some_and(|end| end == "rs") || path.join("mod.rs").exists();
            let declared = main.contains(&format!("mod {name};")) || manifest.contains(&format!("name = \"{name}\""));
            assert!(!is_module || name == "main" || declared, "{} is no module of tests/main.rs", path.display());
        }
    }
}

/// Pages that the sources of a folder cite by a name in backticks, with the files that do.
fn cited_pages(folder: &Path, cited: &mut BTreeMap<String, PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            cited_pages(&path, cited);
        } else if path.extension().is_some_and(|end| end == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let comments = text.lines().filter(|line| line.trim_start().starts_with("//"));
            let names = comments.flat_map(|line| line.split('`').skip(1).step_by(2));
            let pages = names.filter(|name| name.ends_with(".md") && !name.contains(['*', ' ', 'Y']));
            cited.extend(pages.map(|name| (name.to_owned(), path.clone())));
        }
    }
}

/// A reader has the pages of the repository and no others.
#[test]
fn the_pages_that_comments_cite_exist() {
    let mut cited = BTreeMap::new();
    for folder in ["crates", "xtask/src", "validation", "bench/benches", "bench/src"] {
        cited_pages(&crate::root().join(folder), &mut cited);
    }
    assert!(cited.len() > 5, "{cited:?}");
    for (page, file) in cited {
        assert!(crate::root().join(&page).is_file(), "{} cites `{page}`, which is not there", file.display());
    }
}

#[test]
fn an_order_is_read_with_its_ranks() {
    let orders = orders("x\n```order\nworkspace: a b → c\n  → d\n```\ny\n```order\nc: e → f\n```\n");
    assert_eq!(orders["workspace"].len(), 3);
    let imports = |from: &str, to: &str| BTreeMap::from([(from.to_owned(), BTreeSet::from([to.to_owned()]))]);
    assert!(misplaced(&orders["workspace"], &imports("d", "a")).is_empty());
    for (from, to) in [("a", "b"), ("a", "c"), ("x", "a"), ("a", "x")] {
        assert_eq!(misplaced(&orders["workspace"], &imports(from, to)).len(), 1, "{from} {to}");
    }
}
