//! The recordings of the gallery in one word each: they must be the same on every processor.
//!
//! `validation/golden.txt` has a line a scene: its name, the end of the run where that of the scene takes long (else
//! `-`), and the sum of all arrays of its recording. The test command runs the scenes as they are, and once more on an
//! emulated processor of 2006 that has neither wide registers nor fused products: there the C library chooses other
//! functions, and sums over registers are narrower.

use crate::cargo::cargo;
use crate::debian::{can_install, install, on_path};
use crate::steps::Steps;
use crate::{gallery, parallel, recording, root, target_directory};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::{Mutex, PoisonError};

/// The emulator, and the package that has it.
const EMULATOR: [&str; 2] = ["qemu-x86_64", "qemu-user"];
/// Intel's Core 2.
const OLD_PROCESSOR: &str = "Conroe";
/// In the place of an end: that of the scene.
const OWN_END: &str = "-";
const HEAD: &str = "# The recordings of the gallery in one word each, written by `cargo xtask golden`.\n\
                    # scene, end of the run [s] (-: that of the scene), sum of the arrays\n";

/// What is known of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Known {
    /// The end of the run, where that of the scene takes long.
    end: Option<String>,
    sum: String,
}

/// The scenes by name.
type Table = BTreeMap<String, Known>;

fn table_path() -> PathBuf {
    root().join("validation/golden.txt")
}

/// Runs the gallery and writes the table anew; ends that stand in it stay.
pub fn run() -> ExitCode {
    match renewed() {
        Ok(told) => {
            println!("{told}");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn renewed() -> Result<String, String> {
    let program = built()?;
    let old = read().unwrap_or_default();
    let names = gallery::names(Command::new(&program))?;
    let unknown = || Known { end: None, sum: String::new() };
    let mut table: Table =
        names.into_iter().map(|name| (name.clone(), old.get(&name).cloned().unwrap_or_else(unknown))).collect();
    for (name, sum) in sums(&table, "golden", || Command::new(&program)) {
        if let Some(known) = table.get_mut(&name) {
            known.sum = sum?;
        }
    }
    let moved: Vec<&str> =
        table.iter().filter(|(name, known)| old.get(*name) != Some(known)).map(|(n, _)| n.as_str()).collect();
    let path = table_path();
    fs::write(&path, text(&table)).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(format!("{} of {} scenes have another sum: {}", moved.len(), table.len(), moved.join(", ")))
}

fn built() -> Result<PathBuf, String> {
    let status = cargo().args(["build", "--release", "--quiet", "--package", "gyration-cli"]).status();
    match status {
        Ok(status) if status.success() => Ok(target_directory().join("release").join(crate::PROGRAM)),
        _ => Err("the program was not built".into()),
    }
}

/// Complains of scenes whose recordings are not those of the table.
pub fn check(steps: &mut Steps, program: &Path) {
    let missing = gallery::names(Command::new(program)).and_then(|names| {
        let table = read()?;
        Ok(names.into_iter().filter(|name| !table.contains_key(name)).collect::<Vec<_>>())
    });
    match missing {
        Ok(names) if names.is_empty() => {}
        Ok(names) => steps.complain(format!("no golden sum of {} (run `cargo xtask golden`)", names.join(", "))),
        Err(reason) => steps.complain(reason),
    }
    steps.checks("golden sums", || judged("golden", || Command::new(program)));
}

/// The emulator, installed if there is none; none with the reason noted if it cannot be had.
pub fn emulator(steps: &mut Steps) -> Option<PathBuf> {
    let [program, package] = EMULATOR;
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        steps.skip("golden sums on an emulated processor: only on Linux for x86-64");
        return None;
    }
    if on_path(program).is_none() {
        if !can_install() {
            steps.skip(&format!(
                "golden sums on an emulated processor; on Debian and Ubuntu: sudo apt-get install {package}"
            ));
            return None;
        }
        install(steps, package);
    }
    on_path(program)
}

/// The same as [`check`] on an emulated processor.
pub fn check_emulated(steps: &mut Steps, program: &Path, emulator: &Path) {
    steps.checks("golden sums on an emulated processor", || {
        judged("golden-emulated", || {
            let mut command = Command::new(emulator);
            command.args(["-cpu", OLD_PROCESSOR]).arg(program);
            command
        })
    });
}

/// Whether each scene has its sum.
fn judged(folder: &str, program: impl Fn() -> Command + Sync) -> Vec<Result<(), String>> {
    let table = match read() {
        Ok(table) => table,
        Err(reason) => return vec![Err(reason)],
    };
    let compared = |(name, sum): (String, Result<String, String>)| match sum {
        Ok(sum) if table.get(&name).is_some_and(|known| known.sum == sum) => Ok(()),
        Ok(sum) => Err(format!(
            "`{name}` records other bytes, {sum}, than validation/golden.txt tells: if that was meant, \
             `cargo xtask compare` says by how much and `cargo xtask golden` writes it anew"
        )),
        Err(reason) => Err(format!("`{name}`: {reason}")),
    };
    sums(&table, folder, program).into_iter().map(compared).collect()
}

/// Runs every scene with a program, into a folder of the build; the sums of the recordings.
fn sums(table: &Table, folder: &str, program: impl Fn() -> Command + Sync) -> BTreeMap<String, Result<String, String>> {
    let folder = target_directory().join(folder);
    let sums = Mutex::new(BTreeMap::new());
    parallel::each(table.iter(), |(name, known)| {
        let sum = recorded(program(), name, known.end.as_deref(), &folder);
        sums.lock().unwrap_or_else(PoisonError::into_inner).insert(name.clone(), sum);
    });
    sums.into_inner().unwrap_or_else(PoisonError::into_inner)
}

fn recorded(mut program: Command, name: &str, end: Option<&str>, folder: &Path) -> Result<String, String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let recording = folder.join(format!("{name}.gyr"));
    program.args(["run", name, "--quiet", "--force", "-o"]).arg(&recording);
    program.args(end.iter().flat_map(|end| ["--set".to_owned(), format!("time.end={end}")]));
    let output = program.output().map_err(|error| format!("cannot be started: {error}"))?;
    if !output.status.success() {
        return Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr).trim()));
    }
    Ok(format!("{:016x}", recording::sum(&recording)?))
}

fn read() -> Result<Table, String> {
    let path = table_path();
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    parsed(&text).map_err(|line| format!("{}: `{line}` is not a name, an end and a sum", path.display()))
}

/// The table in a text; else the line that is none of it.
fn parsed(text: &str) -> Result<Table, String> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let entry = |line: &str| match line.split_whitespace().collect::<Vec<_>>()[..] {
        [name, end, sum] => {
            let end = (end != OWN_END).then(|| end.to_owned());
            Ok((name.to_owned(), Known { end, sum: sum.to_owned() }))
        }
        _ => Err(line.to_owned()),
    };
    lines.map(entry).collect()
}

fn text(table: &Table) -> String {
    let mut text = HEAD.to_owned();
    for (name, Known { end, sum }) in table {
        let _ = writeln!(text, "{name:<24} {:<5} {sum}", end.as_deref().unwrap_or(OWN_END));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_as_it_is_written() {
        let known = |end: Option<&str>, sum: &str| Known { end: end.map(String::from), sum: sum.into() };
        let table =
            Table::from([("dice".into(), known(None, "00ff")), ("top-slow".into(), known(Some("0.5"), "1234"))]);
        assert_eq!(parsed(&text(&table)), Ok(table));
        assert_eq!(parsed("# a\ndice 00ff\n"), Err("dice 00ff".into()));
    }
}
