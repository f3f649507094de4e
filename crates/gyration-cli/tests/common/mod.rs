//! The real program in a temporary folder.

// Each file of tests uses a part of it.
#![allow(dead_code, clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A ball that bounces twice or so: short to simulate.
pub const BALL: &str = r#"
title = "A ball on a table"

[time]
end = 0.6
sample = 0.01

[solver]
rtol = 1e-6

[[support]]
name = "table"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }

[[contact]]
support = "table"
repulsion = { alpha = "40 kPa", nu = 6, d0 = "2 mm" }
damping = { beta = 4e3, nu = 6, d0 = "2 mm" }
friction = { beta = 2e3, nu = 6, d0 = "2 mm" }

[[body]]
name = "ball"
shape = { sphere = { radius = "5 cm" } }
density = 1000
position = [0, 0, 0.2]
velocity = [0.3, 0, 0]
"#;

/// An ellipsoid comes down on its tip, which the field stops some 1e-13 m above the table: fewer digits than a
/// tolerance of 1e-11 needs, and a curved gap has no more. The run stops at that impact, its ledger open.
pub const TIP: &str = r#"
time = { end = 0.2, sample = 0.01 }
solver = { rtol = 1e-11, atol = 1e-13 }
[[support]]
name = "table"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
[[contact]]
support = "table"
repulsion = { alpha = 1e9, nu = 3, d0 = 1e-8 }
[[body]]
name = "egg"
shape = { ellipsoid = { semi_axes = [0.05, 0.05, 0.2] } }
density = 500
position = [0, 0, 0.3]
orientation = { axis_angle = { axis = [0, 1, 0], angle = "10 deg" } }
"#;

/// A soft ball on the same table.
pub fn soft_ball() -> String {
    let soft = "affine = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20 }";
    BALL.replace("density = 1000", &format!("density = 1000\n{soft}"))
}

/// A temporary folder in which the program runs.
pub struct Sandbox {
    folder: TempDir,
}

/// What the program said.
pub struct Said {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Sandbox {
    /// An empty folder.
    pub fn new() -> Self {
        Self { folder: TempDir::new().unwrap() }
    }

    /// A folder with the ball as `ball.toml`.
    pub fn with_ball() -> Self {
        let sandbox = Self::new();
        sandbox.write("ball.toml", BALL);
        sandbox
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// The program with these arguments, not yet started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gyration"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null()).env_remove("NO_COLOR");
        command
    }

    /// Runs the program to its end.
    pub fn run(&self, arguments: &[&str]) -> Said {
        Said::from(self.command(arguments).output().unwrap())
    }

    /// Runs the program, which must succeed.
    pub fn done(&self, arguments: &[&str]) -> Said {
        let said = self.run(arguments);
        assert_eq!(said.code, Some(0), "{arguments:?}: {}", said.stderr);
        said
    }

    /// Runs the program, which must refuse with this exit code, a message of its own and nothing on stdout.
    pub fn refused(&self, code: i32, arguments: &[&str]) -> Said {
        let said = self.run(arguments);
        assert_eq!(said.code, Some(code), "{arguments:?}: {}", said.stderr);
        assert_eq!(said.stdout, "", "{arguments:?}");
        assert!(!said.stderr.contains("panicked") && !said.stderr.is_empty(), "{arguments:?}: {}", said.stderr);
        said
    }

    /// The names in the folder, sorted.
    pub fn names(&self) -> Vec<String> {
        names(self.folder.path())
    }
}

impl From<Output> for Said {
    fn from(output: Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The bytes of every file below a folder, by path.
pub fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.insert(path.strip_prefix(folder).unwrap().to_path_buf(), fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// Asserts that two folders have the same files with the same bytes.
pub fn assert_same_bytes(a: &Path, b: &Path) {
    let (a, b) = (tree(a), tree(b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    for (path, bytes) in &a {
        assert!(*bytes == b[path], "{} differs", path.display());
    }
}

/// The words of a picture: what stands between its tags.
pub fn words(svg: &str) -> String {
    svg.split('<').filter_map(|part| part.split_once('>')).map(|(_, words)| words).collect()
}
