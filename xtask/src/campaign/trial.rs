//! One scene on trial: checked, run, killed and resumed, audited.

use super::process::{Ending, Place, Said};
use super::report::Report;
use super::scene::RandomScene;
use super::stream::Stream;
use super::table::Table;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Parts in which a run that its wall time ends may be resumed.
const MOST_PARTS: usize = 20;

/// What a scene has come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// `refused` by `check`, `refused by run`, or what [`Report::outcome`] says.
    pub outcome: String,
    /// Where the second run was killed; none if it had none.
    pub killed: Option<Killed>,
    /// The largest residual over what the tolerances let pass.
    pub residual: f64,
    /// Whether the program called the ledger open.
    pub is_open: bool,
}

impl Verdict {
    /// Of a scene that was not run.
    fn without_run(outcome: &str) -> Self {
        Self { outcome: outcome.into(), killed: None, residual: 0.0, is_open: false }
    }
}

/// When a run was killed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Killed {
    /// Before there was a recording.
    BeforeItBegan,
    /// On its way.
    OnItsWay,
    /// It had ended.
    TooLate,
}

/// A scene on trial.
#[derive(Debug)]
pub struct Trial<'a> {
    /// Where it is.
    pub place: Place<'a>,
    /// `solver.max_wall_time` [s].
    pub wall_time: f64,
    /// Random numbers, for the moment of the kill.
    pub stream: Stream,
}

impl Trial<'_> {
    /// Puts a scene on trial; what is wrong otherwise.
    pub fn judge(&mut self, scene: &RandomScene) -> Result<Verdict, String> {
        self.write(scene).map_err(|error| format!("cannot write the scene: {error}"))?;
        let checked = self.said(&["check", "scene.toml", "--set", &self.wall_time()], 1)?;
        if checked.stdout.contains("NaN") {
            return Err("check prints NaN".into());
        }
        let whole = self.run("whole.gyr", &[], 1)?;
        match (checked.code, whole.code) {
            (Some(0), Some(0 | 1)) => {}
            (Some(2), Some(2)) => return Ok(Verdict::without_run("refused")),
            // Only a run takes the resistance of a shape.
            (Some(0), Some(2)) if whole.stderr.contains("too extreme for its boundary elements") => {
                return Ok(Verdict::without_run("refused by run"));
            }
            (checked, run) => {
                let told = whole.stderr.lines().next().unwrap_or_default();
                return Err(format!("check exits with {checked:?}, run with {run:?}: {told}"));
            }
        }
        let report = Report::of(&whole)?;
        let rows = self.said(&["export", "whole.gyr", "--format", "csv", "-o", "-"], 1)?;
        report.audit(&whole, &Table::parse(&rows.stdout)?, &self.path("whole.gyr"), scene.end)?;
        let killed = if report.is_final() { Some(self.interrupted(&whole)?) } else { None };
        let Report { outcome, residual, is_open } = report;
        Ok(Verdict { outcome, killed, residual, is_open })
    }

    fn write(&self, scene: &RandomScene) -> std::io::Result<()> {
        fs::create_dir_all(&self.place.folder)?;
        fs::write(self.path("scene.toml"), &scene.text)?;
        scene.files.iter().try_for_each(|(name, text)| fs::write(self.path(name), text))
    }

    /// Runs the scene once more, on two threads, kills it and resumes it: the bytes are those of the run before.
    fn interrupted(&mut self, whole: &Said) -> Result<Killed, String> {
        let after = whole.wall.mul_f64(self.stream.unit());
        let mut killed = self.kill_after(after, &[])?;
        if !self.path("part.gyr").exists() {
            killed = Killed::BeforeItBegan;
        } else if killed == Killed::OnItsWay && self.stream.chance(0.3) {
            let again = whole.wall.mul_f64(0.5 * self.stream.unit());
            self.kill_after(again, &["--resume"])?;
        }
        let resume: &[&str] = if killed == Killed::BeforeItBegan { &[] } else { &["--resume"] };
        let mut last = self.run("part.gyr", resume, 2)?;
        for _ in 0..MOST_PARTS {
            if !last.stdout.contains("\"wall_time\"") || Report::of(&last)?.is_final() {
                break;
            }
            last = self.run("part.gyr", &["--resume"], 2)?;
        }
        // What had ended before is not run again, and is done whatever its outcome.
        let expected = if last.stdout.contains("\"already_finished\"") { Some(0) } else { whole.code };
        if last.code != expected {
            let told = last.stderr.lines().next().unwrap_or_default();
            return Err(format!("resumed ({killed:?}, after {after:?}) it exits with {:?}: {told}", last.code));
        }
        if let Some(differing) = differing(&self.path("whole.gyr"), &self.path("part.gyr"))? {
            return Err(self.whose_fault(killed, &differing)?);
        }
        let done = self.run("part.gyr", &["--resume"], 1)?;
        match done.code {
            Some(0) => Ok(killed),
            code => Err(format!("--resume of what has ended exits with {code:?}")),
        }
    }

    /// Whether the threads or the kill make the bytes differ.
    fn whose_fault(&self, killed: Killed, file: &str) -> Result<String, String> {
        self.run("threads.gyr", &[], 2)?;
        Ok(match differing(&self.path("whole.gyr"), &self.path("threads.gyr"))? {
            Some(file) => format!("{file} differs between one thread and two"),
            None => format!("{file} differs after a kill ({killed:?}) and a resumption"),
        })
    }

    fn kill_after(&self, time: Duration, more: &[&str]) -> Result<Killed, String> {
        let wall_time = self.wall_time();
        let killed = self.place.kill_after(time, &arguments("part.gyr", &wall_time, more), 2);
        let killed = killed.map_err(|error| format!("cannot start the program: {error}"))?;
        Ok(if killed { Killed::OnItsWay } else { Killed::TooLate })
    }

    fn run(&self, recording: &str, more: &[&str], threads: usize) -> Result<Said, String> {
        self.said(&arguments(recording, &self.wall_time(), more), threads)
    }

    fn wall_time(&self) -> String {
        format!("solver.max_wall_time={:?}", self.wall_time)
    }

    /// Runs the program; it neither panics, nor dies, nor runs on for ever.
    fn said(&self, arguments: &[&str], threads: usize) -> Result<Said, String> {
        let what = arguments.first().copied().unwrap_or_default();
        match self.place.run(arguments, threads).map_err(|error| format!("cannot start the program: {error}"))? {
            Ending::Overran => Err(format!("{what} runs beyond {:?} of wall time", self.place.limit)),
            Ending::Ended(said) if said.code.is_none() => Err(format!("{what} died of a signal")),
            Ending::Ended(said) if said.stderr.contains("panicked") => Err(format!("{what} panicked")),
            Ending::Ended(said) => Ok(said),
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.place.folder.join(name)
    }
}

fn arguments<'a>(recording: &'a str, wall_time: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["run", "scene.toml", "-o", recording, "--json", "--set", wall_time], more].concat()
}

/// The first file that two folders do not have alike.
fn differing(a: &Path, b: &Path) -> Result<Option<String>, String> {
    let [a, b] = [files(a)?, files(b)?];
    let names: BTreeSet<&PathBuf> = a.keys().chain(b.keys()).collect();
    Ok(names.into_iter().find(|name| a.get(*name) != b.get(*name)).map(|name| name.display().to_string()))
}

/// Every file below a folder with its bytes.
fn files(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let (mut found, mut folders) = (BTreeMap::new(), vec![folder.to_path_buf()]);
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).map_err(told)? {
            let path = entry.map_err(told)?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let bytes = fs::read(&path).map_err(told)?;
                found.insert(path.strip_prefix(folder).unwrap_or(&path).to_path_buf(), bytes);
            }
        }
    }
    Ok(found)
}
