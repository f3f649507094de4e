//! The test programs of the workspace: built by cargo, started one by one, so that each can be timed.

use crate::cargo::cargo;
use crate::json::Json;
use crate::steps::Steps;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What cargo has built for the tests.
#[derive(Debug, Clone, Default)]
pub struct TestPrograms {
    /// The test programs, in cargo's order.
    pub programs: Vec<Program>,
    /// The program `gyration`.
    pub gyration: PathBuf,
}

/// A test program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// Its crate, and which of its programs.
    title: String,
    path: PathBuf,
    /// The folder of its crate, where it runs.
    folder: PathBuf,
}

/// Builds every test program of the workspace, and what they start; none, with a complaint noted, if that fails.
pub fn build(steps: &mut Steps) -> Option<TestPrograms> {
    let mut command = cargo();
    command.args(["test", "--workspace", "--no-run", "--message-format=json-render-diagnostics"]);
    let mut built = TestPrograms::default();
    let passed = steps.run_reading("build the tests", &mut command, |line| {
        let message = line.starts_with('{').then(|| Json::parse(line)).flatten();
        if let Some(message) = &message {
            built.take(message);
        }
        message.is_none()
    });
    passed.then_some(built)
}

impl TestPrograms {
    /// Reads what cargo says about one artifact.
    fn take(&mut self, message: &Json) -> Option<()> {
        let path = PathBuf::from(message.get("executable")?.text()?);
        let target = message.get("target")?;
        let name = target.get("name")?.text()?;
        if message.get("profile")?.get("test") == Some(&Json::Word("true".into())) {
            let folder = Path::new(message.get("manifest_path")?.text()?).parent()?.to_path_buf();
            let package = folder.file_name()?.to_string_lossy().into_owned();
            let is_test = target.get("kind") == Some(&Json::List(vec![Json::Text("test".into())]));
            let title = format!("{package}: {}", if is_test { name } else { "unit tests" });
            self.programs.push(Program { title, path, folder });
        } else if name == "gyration" {
            self.gyration = path;
        }
        Some(())
    }
}

/// Runs test programs with these arguments as one stage; the programs are told by name.
pub fn run<'a>(
    steps: &mut Steps,
    title: &str,
    programs: impl IntoIterator<Item = &'a Program>,
    set: impl Fn(&mut Command),
) -> bool {
    steps.stage(title, |stage| {
        for program in programs {
            let mut command = Command::new(&program.path);
            command.current_dir(&program.folder).env("CARGO_MANIFEST_DIR", &program.folder);
            crate::cargo::seed(&mut command);
            set(&mut command);
            stage.program(&program.title, &mut command);
        }
    })
}

/// Those of the programs that hold the tests of a crate from outside.
pub fn integration(programs: &[Program]) -> impl Iterator<Item = &Program> {
    programs.iter().filter(|program| program.title.ends_with(": tests"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_programs_and_the_program_are_told_apart() {
        let artifact = |folder: &str, kind: &str, name: &str, test: &str| {
            let text = format!(
                r#"{{"reason": "compiler-artifact", "manifest_path": "/r/{folder}/Cargo.toml",
                "executable": "/t/{name}", "target": {{"kind": ["{kind}"], "name": "{name}"}}, "profile": {{"test": {test}}}}}"#
            );
            Json::parse(&text).unwrap()
        };
        let mut built = TestPrograms::default();
        built.take(&artifact("crates/a", "lib", "a", "true"));
        built.take(&artifact("crates/a", "test", "tests", "true"));
        built.take(&artifact("crates/cli", "bin", "gyration", "false"));
        built.take(&artifact("crates/cli", "example", "other", "false"));
        built.take(&Json::parse(r#"{"reason": "build-finished", "success": true}"#).unwrap());
        let titles: Vec<&str> = built.programs.iter().map(|program| program.title.as_str()).collect();
        assert_eq!(titles, ["a: unit tests", "a: tests"]);
        assert_eq!(integration(&built.programs).count(), 1);
        assert_eq!(
            (built.programs[0].folder.as_path(), built.gyration.as_path()),
            (Path::new("/r/crates/a"), Path::new("/t/gyration"))
        );
    }
}
