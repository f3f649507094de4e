//! Wheels for others, in `target/wheels`: built for speed, for every Python from 3.10 on, and tried where nothing else
//! is.
//!
//! ```text
//! maturin (on Linux with the linker of zig, manylinux2014) → audit → pip install → gyration run dice → a first picture
//! ```
//!
//! A wheel for another processor is built and audited, and not tried. The wheel of the tests is another one, built as
//! the tests are (`package`).

use crate::steps::Steps;
use crate::{python, root, target_directory};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// The first picture of the README, drawn without its window.
const PICTURE: &str = "\
import gyration
recording = gyration.Scene.gallery('dice').edit({'body.die.velocity': [1, 0, 0]}).run()
print(recording.outcome, recording['die.position'][-1])
recording.plot('height', 'energy').save('dice.png')";

/// What is built.
#[derive(Debug, Clone, Copy)]
pub enum Build<'a> {
    /// A wheel for this machine.
    Here,
    /// A wheel for a processor and system that rustup knows by this name.
    For(&'a str),
    /// The sources, from which pip builds a wheel.
    Sources,
}

/// Builds a wheel, or the sources, and tries what can be tried here.
pub fn run(build: Build<'_>) -> ExitCode {
    let mut steps = Steps::default();
    if let Err(reason) = made(&mut steps, build) {
        steps.complain(reason);
    }
    if steps.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn made(steps: &mut Steps, build: Build<'_>) -> Result<(), String> {
    let Some(interpreter) = python::environment(steps, "wheel-python", &root().join("xtask/wheel-requirements.txt"))
    else {
        return Ok(());
    };
    let folder = target_directory().join("wheels");
    // Of an earlier version there must be nothing left to be taken for this one.
    let _ = fs::remove_dir_all(&folder);
    if let Build::For(target) = build
        && !steps.run("install a target", Command::new("rustup").args(["target", "add", target]).current_dir(root()))
    {
        return Ok(());
    }
    if !steps.run("build", &mut maturin(&interpreter, build, &folder)) {
        return Ok(());
    }
    let entries = fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let file = entries.filter_map(Result::ok).map(|entry| entry.path()).next();
    let file = file.ok_or_else(|| format!("{} is empty", folder.display()))?;
    if !matches!(build, Build::Sources) && cfg!(target_os = "linux") {
        steps.run("audit", in_environment(&interpreter, "auditwheel").arg("show").arg(&file));
    }
    if matches!(build, Build::Here) && steps.is_clean() {
        tried(steps, &file)?;
    }
    println!("{}", file.display());
    Ok(())
}

/// The command that builds; maturin finds zig beside itself.
fn maturin(interpreter: &Path, build: Build<'_>, folder: &Path) -> Command {
    let mut command = in_environment(interpreter, "maturin");
    if matches!(build, Build::Sources) {
        command.arg("sdist");
    } else {
        command.args(["build", "--release"]);
        if cfg!(target_os = "linux") {
            command.args(["--zig", "--compatibility", "manylinux2014"]);
        }
    }
    if let Build::For(target) = build {
        command.args(["--target", target]);
    }
    command.args(["--manifest-path", "crates/gyration-py/Cargo.toml", "--out"]).arg(folder);
    command
}

/// Installs the wheel where nothing else is, runs a scene and draws a picture, and tells how long that took.
fn tried(steps: &mut Steps, wheel: &Path) -> Result<(), String> {
    let folder = target_directory().join("wheel-tried");
    let _ = fs::remove_dir_all(&folder);
    let bare = folder.join("python");
    if !steps.run("make a bare environment", python::python().args(["-m", "venv"]).arg(&bare)) {
        return Ok(());
    }
    let programs = bare.join(if cfg!(windows) { "Scripts" } else { "bin" });
    let program = |name: &str| {
        let mut command = Command::new(programs.join(name).with_extension(std::env::consts::EXE_EXTENSION));
        command.current_dir(&folder);
        command
    };
    let started = Instant::now();
    let done = steps.run(
        "install the wheel",
        program("python").args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).arg(wheel),
    ) && steps.run("run a scene", program("gyration").args(["run", "dice"]))
        && steps.run("draw a picture", program("python").args(["-c", PICTURE]));
    if !done {
        return Ok(());
    }
    let size = fs::metadata(folder.join("dice.png")).map_or(0, |picture| picture.len());
    println!("from the wheel to the first picture: {:.1} s", started.elapsed().as_secs_f64());
    if size < 1000 { Err(format!("{} is no picture", folder.join("dice.png").display())) } else { Ok(()) }
}

/// A module of the environment, whose programs are found before others.
fn in_environment(interpreter: &Path, module: &str) -> Command {
    let mut command = Command::new(interpreter);
    command.args(["-m", module]).current_dir(root());
    let own = interpreter.parent().map(Path::to_path_buf);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = own.into_iter().chain(std::env::split_paths(&path)).collect();
    command.env("PATH", std::env::join_paths(folders).unwrap_or_else(|_| OsStr::new("").to_owned()));
    command
}
