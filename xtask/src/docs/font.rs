//! The font of formulas, a package of npm that is pinned beside the settings of the book.
//!
//! Formulas stand in Unicode. Few fonts of fixed width have dots over Greek letters, subscripts and operators together.

use crate::steps::{Steps, succeeds};
use crate::{target_directory, viewer};
use std::fs;
use std::path::{Path, PathBuf};

/// What is copied out of the package.
const FILES: [(&str, &str); 2] =
    [("files/iosevka-latin-400-normal.woff2", "iosevka.woff2"), ("LICENSE", "iosevka-license.txt")];

/// A folder with the font and its licence, by the lists of packages in the folder of the settings; none, with a
/// complaint noted, if it cannot be had.
pub fn folder(steps: &mut Steps, settings: &Path) -> Option<PathBuf> {
    let packages = target_directory().join("book-node");
    let fonts = packages.join("fonts");
    if !succeeds(viewer::npm().arg("--version")) {
        steps.complain("the font of formulas: Node 20 or later is not installed".into());
        return None;
    }
    let read = |folder: &Path, name: &str| fs::read(folder.join(name)).ok();
    let is_current = |name: &str| read(&packages, name).is_some_and(|there| Some(there) == read(settings, name));
    let lists = ["package.json", "package-lock.json"];
    if lists.iter().all(|name| is_current(name)) && FILES.iter().all(|(_, name)| fonts.join(name).is_file()) {
        return Some(fonts);
    }
    let prepared = fs::create_dir_all(&fonts)
        .and_then(|()| lists.iter().try_for_each(|name| fs::copy(settings.join(name), packages.join(name)).map(drop)));
    if let Err(error) = prepared {
        steps.complain(format!("{}: {error}", packages.display()));
        return None;
    }
    let mut install = viewer::npm();
    install.current_dir(&packages).args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]);
    if !steps.run("install the font of formulas", &mut install) {
        return None;
    }
    let package = packages.join("node_modules/@fontsource/iosevka");
    for (from, to) in FILES {
        if let Err(error) = fs::copy(package.join(from), fonts.join(to)) {
            steps.complain(format!("{}: {error}", package.join(from).display()));
            return None;
        }
    }
    Some(fonts)
}
