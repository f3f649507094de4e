//! One scene on trial: checked, run, stopped and resumed, exchanged, audited.

use super::first_steps;
use super::process::{Ending, Place, Said, Stop, Stopped};
use super::report::Report;
use super::scene::{EXCHANGED, RandomScene};
use super::stream::Stream;
use super::table::Table;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Parts in which a run that its wall time ends may be resumed.
const MOST_PARTS: usize = 20;

/// Stops of a run before it is left to its end, at most.
const MOST_STOPS: usize = 4;
/// With bodies exchanged sums are rounded otherwise, and now and then a step is: meetings make of an error of rtol·size
/// at most so many of them.
const SPREAD: f64 = 1e4;
/// Threads of the parts of a run, at most.
const MOST_THREADS: usize = 7;
/// What a run answers to an interrupt.
const INTERRUPTED: i32 = 130;
/// What it answers when it ends early.
const ENDED_EARLY: i32 = 1;

/// What a scene has come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// `refused` by `check`, `refused by run`, or what [`Report::outcome`] says.
    pub outcome: String,
    /// How its second run was stopped.
    pub stops: Stops,
    /// The largest residual over what the tolerances let pass.
    pub residual: f64,
    /// Whether the program called the ledger open.
    pub is_open: bool,
    /// What its first steps have shown.
    pub steps: first_steps::Shown,
    /// How far a run with bodies exchanged and renamed comes from it, over rtol times the size; none if it has none.
    pub exchanged: Option<f64>,
}

/// Stops of runs that were resumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stops {
    /// By a kill.
    pub killed: usize,
    /// By an interrupt, as Ctrl-C is one.
    pub interrupted: usize,
    /// Before there was a recording.
    pub early: usize,
    /// When it had ended.
    pub late: usize,
}

impl Verdict {
    /// Of a scene that was not run.
    fn without_run(outcome: &str) -> Self {
        let (stops, steps) = (Stops::default(), first_steps::Shown::default());
        Self { outcome: outcome.into(), stops, residual: 0.0, is_open: false, steps, exchanged: None }
    }
}

/// A scene on trial.
#[derive(Debug)]
pub struct Trial<'a> {
    /// Where it is.
    pub place: Place<'a>,
    /// `solver.max_wall_time` [s].
    pub wall_time: f64,
    /// Random numbers, for the moments of the stops.
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
        if is_not_begun(&whole) {
            return Ok(Verdict::without_run("given up before its first step"));
        }
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
        let rows = self.rows("whole.gyr")?;
        report.audit(&whole, &rows, &self.path("whole.gyr"), scene.end)?;
        let steps = self.first_steps(scene)?;
        let is_final = report.is_final();
        let stops = if is_final { self.interrupted(&whole)? } else { Stops::default() };
        let exchanged = if is_final { self.exchanged(scene, &report, &rows)? } else { None };
        let Report { outcome, residual, is_open } = report;
        Ok(Verdict { outcome, stops, residual, is_open, steps, exchanged })
    }

    fn rows(&self, recording: &str) -> Result<Table, String> {
        Table::parse(&self.said(&["export", recording, "--format", "csv", "-o", "-"], 1)?.stdout)
    }

    /// What `check --steps` shows.
    fn first_steps(&self, scene: &RandomScene) -> Result<first_steps::Shown, String> {
        let steps = first_steps::COUNT.to_string();
        let said = self.said(&["check", "scene.toml", "--steps", &steps, "--json", "--set", &self.wall_time()], 1)?;
        if is_not_begun(&said) {
            return Ok(first_steps::Shown::default());
        }
        first_steps::Shown::read(&said)?.judged(scene.rtol)
    }

    /// Runs the scene with its bodies exchanged and renamed: how far it comes from the run before, over rtol·size.
    fn exchanged(&self, scene: &RandomScene, report: &Report, rows: &Table) -> Result<Option<f64>, String> {
        let Some(text) = &scene.exchanged else { return Ok(None) };
        fs::write(self.path("exchanged.toml"), text).map_err(|error| error.to_string())?;
        let wall_time = self.wall_time();
        let arguments = ["run", "exchanged.toml", "-o", "exchanged.gyr", "--json", "--set", &wall_time];
        let again = self.said(&arguments, 1)?;
        if is_not_begun(&again) {
            return Ok(None);
        }
        let again = Report::of(&again)?;
        if !again.is_final() {
            return Ok(None);
        }
        // Where digits end, which of its numbers ends them first is rounding.
        let is_stopped = |run: &Report| !matches!(run.outcome.as_str(), "completed" | "at_rest");
        if is_stopped(report) && is_stopped(&again) {
            return Ok(None);
        }
        if again.outcome != report.outcome {
            return Err(format!("{} as written, {} with bodies exchanged", report.outcome, again.outcome));
        }
        let off = rows.farthest(&self.rows("exchanged.gyr")?, EXCHANGED)?;
        let off = off / (scene.rtol * scene.size);
        if off.is_nan() || off > SPREAD {
            return Err(format!("with bodies exchanged it comes {off:.1e} rtol·size away"));
        }
        Ok(Some(off))
    }

    fn write(&self, scene: &RandomScene) -> std::io::Result<()> {
        fs::create_dir_all(&self.place.folder)?;
        fs::write(self.path("scene.toml"), &scene.text)?;
        scene.files.iter().try_for_each(|(name, text)| fs::write(self.path(name), text))
    }

    /// Runs the scene once more, on other threads, stops it now and then and resumes it: the bytes are those of the run
    /// before.
    fn interrupted(&mut self, whole: &Said) -> Result<Stops, String> {
        let mut stops = Stops::default();
        let mut told = Vec::new();
        let mut resume: &[&str] = &[];
        for _ in 0..1 + self.stream.index(MOST_STOPS) {
            let after = whole.wall.mul_f64(self.stream.unit() / (1.0 + stops.killed as f64 + stops.interrupted as f64));
            let stop = self.stream.pick(&[Stop::Kill, Stop::Interrupt]);
            let threads = 1 + self.stream.index(MOST_THREADS);
            let came = self.stop_after(after, stop, resume, threads)?;
            told.push(format!("{came:?} after {after:?} on {threads} threads"));
            let is_there = self.path("part.gyr").exists();
            if is_there {
                resume = &["--resume"];
            }
            match came {
                Stopped::Heedless => return Err(format!("it does not heed an interrupt ({})", told.join(", "))),
                Stopped::Interrupted(Some(INTERRUPTED) | None) | Stopped::Killed if !is_there => stops.early += 1,
                // At its wall time, too, it can be resumed.
                Stopped::Interrupted(Some(INTERRUPTED | ENDED_EARLY)) => stops.interrupted += 1,
                // Before it listens to interrupts, one kills it.
                Stopped::Killed | Stopped::Interrupted(None) => stops.killed += 1,
                // It ended as the interrupt came.
                Stopped::Interrupted(code) if code != whole.code && code != Some(0) => {
                    return Err(format!("interrupted it exits with {code:?} ({})", told.join(", ")));
                }
                Stopped::Interrupted(_) | Stopped::TooLate => {
                    stops.late += 1;
                    break;
                }
            }
        }
        let threads = 1 + self.stream.index(MOST_THREADS);
        let mut last = self.run("part.gyr", resume, threads)?;
        for _ in 0..MOST_PARTS {
            let goes_on = || Ok::<_, String>(last.stdout.contains("\"wall_time\"") && !Report::of(&last)?.is_final());
            if !is_not_begun(&last) && !goes_on()? {
                break;
            }
            let resume: &[&str] = if self.path("part.gyr").exists() { &["--resume"] } else { &[] };
            last = self.run("part.gyr", resume, threads)?;
        }
        // What had ended before is not run again, and is done whatever its outcome.
        let expected = if last.stdout.contains("\"already_finished\"") { Some(0) } else { whole.code };
        if last.code != expected {
            let said = last.stderr.lines().next().unwrap_or_default();
            return Err(format!("resumed ({}) it exits with {:?}: {said}", told.join(", "), last.code));
        }
        if let Some(differing) = differing(&self.path("whole.gyr"), &self.path("part.gyr"))? {
            return Err(self.whose_fault(&told.join(", "), &differing, threads)?);
        }
        let done = self.run("part.gyr", &["--resume"], 1)?;
        match done.code {
            Some(0) => Ok(stops),
            code => Err(format!("--resume of what has ended exits with {code:?}")),
        }
    }

    /// Whether the threads or the stops make the bytes differ.
    fn whose_fault(&self, stops: &str, file: &str, threads: usize) -> Result<String, String> {
        self.run("threads.gyr", &[], threads)?;
        Ok(match differing(&self.path("whole.gyr"), &self.path("threads.gyr"))? {
            Some(file) => format!("{file} differs between one thread and {threads}"),
            None => format!("{file} differs after stops and resumptions: {stops}"),
        })
    }

    fn stop_after(&self, time: Duration, stop: Stop, more: &[&str], threads: usize) -> Result<Stopped, String> {
        let wall_time = self.wall_time();
        let stopped = self.place.stop_after(time, stop, &arguments("part.gyr", &wall_time, more), threads);
        stopped.map_err(|error| format!("cannot start the program: {error}"))
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

/// What a run says that its wall time ends before its first step, or before its shapes have their resistances.
const NOT_BEGUN: [&str; 2] = ["before its first step", "its resistance takes longer than it may"];

/// Whether a run was given up before its first step: it has nothing to report then.
fn is_not_begun(said: &Said) -> bool {
    said.code == Some(ENDED_EARLY) && NOT_BEGUN.iter().any(|told| said.stderr.contains(told))
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
