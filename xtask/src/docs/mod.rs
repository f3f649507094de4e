//! The book in HTML, built by Sphinx from the pages as they stand: `target/book`.
//!
//! ```text
//! pages → links that hold in HTML → Sphinx ← Python reference ← stub and doc comments of gyration-py
//!                                        ↓
//!                               target/book ← target/site, if `cargo xtask web` has built it
//! ```
//!
//! A link, mark or picture that leads nowhere, and a page without a place in the contents, make it fail. It needs
//! nothing from elsewhere; it can be opened as a file.

#[cfg(test)]
mod checks;
mod contents;
mod font;
mod markdown;
mod stage;

use crate::steps::Steps;
use crate::{python, root, target_directory};
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, ExitCode};

/// The folder of its settings.
const SETTINGS: &str = "xtask/book";

/// Builds the book.
pub fn run() -> ExitCode {
    let mut steps = Steps::default();
    if let Err(reason) = build(&mut steps) {
        steps.complain(reason);
    }
    if steps.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Builds the book; what a step complains of is noted there.
fn build(steps: &mut Steps) -> Result<(), String> {
    let settings = root().join(SETTINGS);
    let Some(interpreter) = python::environment(steps, "book-python", &settings.join("requirements.txt")) else {
        return Ok(());
    };
    let Some(fonts) = font::folder(steps, &settings) else { return Ok(()) };
    let [reference, pages, book] = ["book-reference", "book-pages", "book"].map(|name| target_directory().join(name));
    let package = root().join("crates/gyration-py");
    let mut made = python(&interpreter);
    made.arg(settings.join("reference.py")).arg(package.join("python/gyration")).arg(package.join("src"));
    if !steps.run("the Python reference", made.arg(&reference).arg(env!("CARGO_PKG_VERSION"))) {
        return Ok(());
    }
    stage::stage(&pages, &reference.join("python-reference.rst"))?;
    // What an earlier build left is none of this one.
    let _ = fs::remove_dir_all(&book);
    let page = target_directory().join("site");
    let has_page = page.join("index.html").is_file();
    let mut sphinx = python(&interpreter);
    sphinx.args(["-m", "sphinx", "--builder", "html", "--fail-on-warning", "--keep-going", "--quiet", "--fresh-env"]);
    sphinx.args(["--jobs", "auto", "--conf-dir"]).arg(&settings);
    sphinx.arg("--doctree-dir").arg(target_directory().join("book-trees")).arg(&pages).arg(&book);
    sphinx.env("GYRATION_REFERENCE", &reference).env("GYRATION_VERSION", env!("CARGO_PKG_VERSION"));
    sphinx.env("GYRATION_FONTS", &fonts).env("GYRATION_HAS_PAGE", if has_page { "yes" } else { "no" });
    if !steps.run("the book", &mut sphinx) {
        return Ok(());
    }
    if has_page {
        copied(&page, &book.join("page")).map_err(|error| format!("{}: {error}", page.display()))?;
    } else {
        println!("the page that runs scenes is left out: `cargo xtask web` builds it, then `cargo xtask docs` again");
    }
    println!("{}", book.join("index.html").display());
    Ok(())
}

/// The interpreter, which leaves nothing in the checkout.
fn python(interpreter: &Path) -> Command {
    let mut command = Command::new(interpreter);
    command.current_dir(root()).env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

/// Copies a folder with all that is in it.
fn copied(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let target = to.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copied(&path, &target)?;
        } else {
            fs::copy(&path, target)?;
        }
    }
    Ok(())
}
