//! One side of a comparison: a commit, a program or a folder of recordings.
//!
//! A commit is checked out at `target/compare/source`, always at this one path, so that the next commit compiles only
//! what differs. Its program and its recordings are kept under `target/compare/COMMIT` and made once.

use crate::cargo::cargo;
use crate::gallery;
use crate::{PROGRAM, root, target_directory};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the recordings of a side stand, and what makes those that are missing.
#[derive(Debug)]
pub struct Side {
    /// The folder of the recordings, NAME.gyr each.
    pub recordings: PathBuf,
    program: Option<PathBuf>,
}

impl Side {
    /// Reads an argument: a folder with recordings, a program, or else a commit, which is built if it has not been.
    /// `name` says which side it is.
    pub fn of(argument: &str, name: &str) -> Result<Self, String> {
        let path = Path::new(argument);
        if path.is_dir() && !recorded(path)?.is_empty() {
            return Ok(Self { recordings: path.to_path_buf(), program: None });
        }
        let folder = target_directory().join("compare");
        if path.is_file() {
            // A program may have been built again since: nothing of it is kept.
            let recordings = folder.join(name);
            renewed(&recordings)?;
            let program = fs::canonicalize(path).map_err(|error| format!("{argument}: {error}"))?;
            return Ok(Self { recordings, program: Some(program) });
        }
        let commit = git(&root(), &["rev-parse", "--verify", "--quiet", &format!("{argument}^{{commit}}")])
            .map_err(|_| format!("`{argument}` is no commit, no program and no folder of recordings"))?;
        let folder = folder.join(&commit);
        let (recordings, program) = (folder.join("recordings"), folder.join(PROGRAM));
        fs::create_dir_all(&recordings).map_err(|error| format!("{}: {error}", recordings.display()))?;
        if !program.exists() {
            build(&commit, &program)?;
        }
        Ok(Self { recordings, program: Some(program) })
    }

    /// The scenes that there are.
    pub fn scenes(&self) -> Result<BTreeSet<String>, String> {
        match &self.program {
            None => recorded(&self.recordings),
            Some(program) => Ok(gallery::names(Command::new(program))?.into_iter().collect()),
        }
    }

    /// Runs a scene, unless it is recorded already.
    pub fn record(&self, scene: &str) -> Result<PathBuf, String> {
        let recording = self.recordings.join(format!("{scene}.gyr"));
        if let Some(program) = self.program.as_ref().filter(|_| !recording.exists()) {
            // Under another name until it is whole.
            let unfinished = self.recordings.join(format!("{scene}.unfinished.gyr"));
            let output = Command::new(program)
                .args(["run", scene, "--quiet", "--force", "-o"])
                .arg(&unfinished)
                .output()
                .map_err(|error| format!("{}: {error}", program.display()))?;
            if !output.status.success() {
                return Err(format!("{}: {}", output.status, String::from_utf8_lossy(&output.stderr).trim()));
            }
            fs::rename(&unfinished, &recording).map_err(|error| format!("{}: {error}", recording.display()))?;
        }
        Ok(recording)
    }
}

/// The recordings in a folder.
fn recorded(folder: &Path) -> Result<BTreeSet<String>, String> {
    let entries = fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    Ok(names.filter_map(|name| name.strip_suffix(".gyr").map(String::from)).collect())
}

/// An empty folder.
fn renewed(folder: &Path) -> Result<(), String> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Builds the program of a commit, without its page.
fn build(commit: &str, program: &Path) -> Result<(), String> {
    let folder = target_directory().join("compare");
    let (source, products) = (folder.join("source"), folder.join("build"));
    let place = source.to_string_lossy().into_owned();
    if source.join(".git").exists() {
        git(&source, &["checkout", "--quiet", "--force", "--detach", commit])?;
    } else {
        git(&root(), &["worktree", "prune"])?;
        git(&root(), &["worktree", "add", "--quiet", "--detach", &place, commit])?;
    }
    println!("building {commit}");
    let mut command = cargo();
    command.args(["build", "--release", "--quiet", "--package", "gyration-cli", "--bin", "gyration"]);
    command.current_dir(&source).env("CARGO_TARGET_DIR", &products).env("GYRATION_PAGE", "none");
    if !command.status().is_ok_and(|status| status.success()) {
        return Err(format!("the program of {commit} cannot be built"));
    }
    fs::copy(products.join("release").join(PROGRAM), program)
        .map_err(|error| format!("{}: {error}", program.display()))?;
    Ok(())
}

fn git(folder: &Path, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new("git").current_dir(folder).args(arguments).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    } else {
        Err(format!("git {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr).trim()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_of_recordings_has_the_scenes_that_are_in_it() {
        let folder = std::env::temp_dir().join(format!("xtask-side-{}", std::process::id()));
        for name in ["cube.gyr", "dice.gyr", "notes"] {
            fs::create_dir_all(folder.join(name)).unwrap();
        }
        let side = Side::of(&folder.to_string_lossy(), "old").unwrap();
        let (scenes, recording) = (side.scenes(), side.record("dice"));
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(scenes, Ok(["cube", "dice"].map(String::from).into()));
        assert_eq!(recording, Ok(folder.join("dice.gyr")));
    }

    #[test]
    fn what_is_nothing_of_all_this_is_refused() {
        let told = Side::of("neither-commit-nor-path", "old").unwrap_err();
        assert!(told.contains("`neither-commit-nor-path` is no commit, no program"), "{told}");
    }
}
