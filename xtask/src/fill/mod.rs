//! Filling comments and pages to the width of a line, and telling where that has not been done.
//!
//! Text that was changed and not filled again is hard to read, and nobody fills it by hand twice.

mod rust;
mod text;

use crate::root;
use crate::steps::Steps;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The pages that are filled beside the Rust files.
const PAGES: [&str; 2] = ["ARCHITECTURE.md", "CONTRIBUTING.md"];

/// How many lines of code, equations and tables, which are not filled, may still be wider; to be lowered as they go.
const WIDE: usize = 120;

/// Fills the files named, or all.
pub fn run(names: &[&str]) -> ExitCode {
    match filled(names) {
        Ok(count) => {
            println!("{count} files filled anew");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Fills the files named, or all; how many have changed, or that more lines of all are too wide than may be.
fn filled(names: &[&str]) -> Result<usize, String> {
    if !names.is_empty() {
        return names.iter().try_fold(0, |count, name| Ok(count + usize::from(fill(Path::new(name))?)));
    }
    let count = files(&["."])?.iter().try_fold(0, |count, file| Ok::<_, String>(count + usize::from(fill(file)?)))?;
    too_wide(&faults_of_all()?).map_or(Ok(count), Err)
}

/// Complains about files whose text is not filled, and about more lines that are too wide than there were.
pub fn check(steps: &mut Steps) {
    match faults_of_all() {
        Ok(found) => {
            too_wide(&found).into_iter().for_each(|fault| steps.complain(fault));
            found.into_iter().filter_map(|faults| faults.not_filled).for_each(|fault| steps.complain(fault));
        }
        Err(reason) => steps.complain(reason),
    }
}

/// The files under these folders that are kept by git and have text to fill.
fn files(folders: &[&str]) -> Result<Vec<PathBuf>, String> {
    let output = Command::new("git").arg("ls-files").args(folders).current_dir(root()).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    let names = String::from_utf8_lossy(&output.stdout).into_owned();
    let names = names.lines().filter(|name| name.ends_with(".rs") || PAGES.contains(name));
    // A file that was taken away is listed until that is committed.
    Ok(names.map(|name| root().join(name)).filter(|file| file.exists()).collect())
}

/// A file as it is, and as it should be: of Rust, or a page.
fn read(file: &Path) -> Result<(String, String), String> {
    if !file.extension().is_some_and(|end| end == "rs" || end == "md") {
        return Err(format!("{}: neither .rs nor .md, whose lines would be joined", file.display()));
    }
    let source = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let filled = if file.extension().is_some_and(|end| end == "rs") {
        rust::filled(&source)
    } else {
        text::filled(&source.lines().collect::<Vec<_>>(), rust::WIDTH).join("\n") + "\n"
    };
    Ok((source, filled))
}

/// Fills a file; whether anything changed.
fn fill(file: &Path) -> Result<bool, String> {
    let (source, filled) = read(file)?;
    if source != filled {
        std::fs::write(file, &filled).map_err(|error| format!("{}: {error}", file.display()))?;
        println!("{}", file.display());
    }
    Ok(source != filled)
}

/// What is wrong with a file.
struct FileFaults {
    /// Where text is first not filled, in words.
    not_filled: Option<String>,
    /// `file:line` of the lines that are too wide.
    wide: Vec<String>,
}

/// What is wrong with each file.
fn faults_of_all() -> Result<Vec<FileFaults>, String> {
    files(&["."])?.iter().map(|file| faults(file)).collect()
}

/// That more lines are too wide than may be.
fn too_wide(found: &[FileFaults]) -> Option<String> {
    let wide: Vec<&str> = found.iter().flat_map(|faults| &faults.wide).map(String::as_str).collect();
    (wide.len() > WIDE).then(|| format!("{} lines are too wide, {WIDE} may be: {}", wide.len(), wide.join(", ")))
}

fn faults(file: &Path) -> Result<FileFaults, String> {
    let (source, filled) = read(file)?;
    let name = file.strip_prefix(root()).unwrap_or(file).display().to_string();
    let not_filled = (source != filled).then(|| {
        let line = source.lines().zip(filled.lines()).take_while(|(a, b)| a == b).count() + 1;
        format!("{name}:{line}: not filled to {} columns (run `cargo xtask fill`)", rust::WIDTH)
    });
    let is_code = name.ends_with(".rs");
    let wide = if is_code { rust::wide(&filled) } else { Vec::new() };
    Ok(FileFaults { not_filled, wide: wide.into_iter().map(|line| format!("{name}:{line}")).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_filled_once_and_then_in_order() {
        let file = std::env::temp_dir().join(format!("xtask-fill-{}.rs", std::process::id()));
        std::fs::write(&file, "// one\n// two\n").unwrap();
        let before = faults(&file);
        let changed = [fill(&file), fill(&file)];
        let after = faults(&file);
        std::fs::remove_file(&file).unwrap();
        assert!(before.unwrap().not_filled.unwrap().contains(":1: not filled"));
        assert_eq!(changed, [Ok(true), Ok(false)]);
        assert!(after.unwrap().not_filled.is_none());
    }
}
