//! Checks of the pages by themselves: where links lead, and which chores they and the workflows name.

use super::markdown::{anchors, links};
use super::stage::path_of;
use crate::root;
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// The pages that git keeps, by path, without those of other people's packages.
fn pages() -> BTreeMap<String, String> {
    let output = Command::new("git").args(["ls-files", "*.md"]).current_dir(root()).output().unwrap();
    let names = String::from_utf8(output.stdout).unwrap();
    let there = names.lines().filter(|name| root().join(name).is_file());
    there.map(|name| (name.to_owned(), fs::read_to_string(root().join(name)).unwrap())).collect()
}

#[test]
fn links_and_pictures_of_the_pages_lead_somewhere() {
    let pages = pages();
    let (mut count, mut wrong) = (0, Vec::new());
    for (page, text) in &pages {
        for link in links(text) {
            let target = &text[link.target];
            let Some((path, mark)) = path_of(page, target) else { continue };
            count += 1;
            let has_mark = mark.is_none_or(|mark| pages.get(&path).is_some_and(|page| anchors(page).contains(&mark)));
            if !root().join(&path).exists() || !has_mark {
                wrong.push(format!("{page}:{}: {target}", link.line));
            }
        }
    }
    assert!(count > 200, "{count} links were found");
    assert!(wrong.is_empty(), "these lead nowhere: {wrong:#?}");
}

/// Pages, and what runs chores by itself.
fn instructions() -> Vec<(String, String)> {
    let files = [".ci/run", ".github/workflows/release.yml", ".github/workflows/test.yml"];
    let read = |name: &str| (name.to_owned(), fs::read_to_string(root().join(name)).unwrap());
    pages().into_iter().chain(files.into_iter().map(read)).collect()
}

#[test]
fn chores_that_are_named_exist() {
    let (mut count, mut wrong) = (0, Vec::new());
    for (file, text) in instructions() {
        for (place, words) in text.match_indices("cargo xtask ") {
            let rest = &text[place + words.len()..];
            let chore = rest.split(|c: char| !c.is_ascii_lowercase()).next().unwrap_or_default();
            count += 1;
            // CHORE stands for any of them.
            if !rest.starts_with("CHORE") && !crate::USAGE.contains(&format!("\n  {chore} ")) {
                wrong.push(format!("{file}: {}", rest.lines().next().unwrap_or_default()));
            }
        }
    }
    assert!(count > 20, "{count} chores were found");
    assert!(wrong.is_empty(), "there are no such chores: {wrong:#?}");
}
