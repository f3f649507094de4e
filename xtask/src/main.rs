//! Chores of the repository, run as `cargo xtask CHORE`.
//!
//! `test` is the one test command: format, lints, documentation, every test of the workspace, those of the viewer in a
//! browser, the Python tests, the tables of known answers and of what others publish, and licences and advisories of
//! dependencies. `validate` runs these problems and writes `docs/known-answers.md` and `docs/published.md` from what
//! they print. `gallery` runs the scenes, draws their pictures and writes `docs/gallery.md`. `golden` writes the sums
//! of their recordings. `compare` tells whether two commits give the same recordings, `fill` fills comments and pages,
//! `campaign` tries random scenes, `web` builds the site, `docs` the book in HTML, `wheel` wheels for others, `supply`
//! lists the dependencies.
//!
//! This program knows no mechanics; it starts other programs and reads their output.

mod answers;
mod campaign;
mod cargo;
mod child;
mod compare;
mod console;
mod debian;
mod docs;
mod fill;
mod gallery;
mod golden;
mod json;
#[cfg(test)]
mod layout;
mod package;
mod parallel;
mod programs;
mod published;
mod python;
mod recording;
mod report;
mod steps;
mod supply;
mod tally;
mod test;
mod validate;
mod viewer;
mod web;
mod wheel;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask CHORE

  test           run every check; the last line is `N passed, N failed`
  test --fast    the same without documentation, viewer, Python and dependencies
  validate       run the problems with a known answer; rewrite docs/known-answers.md and docs/published.md
  gallery [NAME…]  run the scenes named, or all, and rewrite their pictures and docs/gallery.md
  golden         run the gallery and write the sums of its recordings, validation/golden.txt
  fill [FILE…]   fill comments and pages to the width of a line
  campaign [--scenes N] [--seed S] [--only K] [--program FILE] [--wall-time SECONDS]  random scenes, killed, resumed, audited
  web            build the page that runs scenes by itself, target/site, and test it
  docs           build the book in HTML, target/book; links that lead nowhere are errors
  wheel [--target TRIPLE | --sources]  build a wheel for others, or their sources, in target/wheels, and try it
  supply         list the packages that are locked, once what is new has been looked up
  compare OLD NEW [SCENE…]  whether two commits record the same bytes; also a program, or a folder of recordings";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["test"] => test::run(test::Extent::Full),
        ["test", "--fast"] => test::run(test::Extent::Fast),
        ["validate"] => validate::run(),
        ["gallery", names @ ..] => gallery::run(names),
        ["golden"] => golden::run(),
        ["web"] => web::run(),
        ["docs"] => docs::run(),
        ["wheel"] => wheel::run(wheel::Build::Here),
        ["wheel", "--sources"] => wheel::run(wheel::Build::Sources),
        ["wheel", "--target", target] => wheel::run(wheel::Build::For(target)),
        ["fill", names @ ..] => fill::run(names),
        ["supply"] => supply::run(),
        ["campaign", words @ ..] => campaign::run(words),
        ["compare", old, new, scenes @ ..] => compare::run(old, new, scenes),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            ExitCode::SUCCESS
        }
        _ => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// The file of the program.
const PROGRAM: &str = if cfg!(windows) { "gyration.exe" } else { "gyration" };

/// The root of the repository.
fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().unwrap_or(manifest).to_path_buf()
}

/// The folder of build products: `CARGO_TARGET_DIR`, else `target`.
fn target_directory() -> PathBuf {
    let named = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    root().join(named.unwrap_or_else(|| "target".into()))
}
