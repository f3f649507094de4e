//! One scene on trial: checked, run, stopped and resumed, audited, written otherwise.

use super::meeting::Meeting;
use super::process::{Ending, Interrupted, Place, Said};
use super::report::Report;
use super::scene::RandomScene;
use super::stops::{Moment, PlannedStop, Stopped};
use super::stream::Stream;
use super::table::Table;
use super::{momenta, stops, twins};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Parts in which a run that its wall time ends may be resumed.
const MOST_PARTS: usize = 20;
/// A run that takes less than this part of its wall time is quick enough to be run twice more.
const QUICK: f64 = 0.2;
/// The exit code of an interrupted run.
const INTERRUPTED: i32 = 130;
/// The scene.
pub const SCENE: &str = "scene.toml";
/// The recording of the run that is stopped.
const PART: &str = "part.gyr";

/// What a scene has come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// `refused` by `check`, `refused by run`, or what [`Report::outcome`] says.
    pub outcome: String,
    /// How and when the second run was stopped, each time.
    pub stops: Vec<(Stopped, Moment)>,
    /// Whether the scene was run once more, written otherwise.
    pub has_twin: bool,
    /// The largest residual over what the tolerances let pass.
    pub residual: f64,
    /// Whether the program called the ledger open.
    pub is_open: bool,
}

impl Verdict {
    /// Of a scene that was not run.
    fn without_run(outcome: &str) -> Self {
        Self { outcome: outcome.into(), stops: Vec::new(), has_twin: false, residual: 0.0, is_open: false }
    }
}

/// A scene on trial.
#[derive(Debug)]
pub struct Trial<'a> {
    /// Where it is.
    pub place: Place<'a>,
    /// `solver.max_wall_time` [s].
    pub wall_time: f64,
    /// Random numbers, for the stops.
    pub stream: Stream,
}

impl Trial<'_> {
    /// Puts a scene on trial; what is wrong otherwise.
    pub fn judge(&mut self, scene: &RandomScene) -> Result<Verdict, String> {
        self.write(scene).map_err(|error| format!("cannot write the scene: {error}"))?;
        let checked = self.said(&["check", SCENE, "--set", &self.wall_time()], 1)?;
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
        let rows = self.rows("whole.gyr")?;
        let table = Table::parse(&rows)?;
        table.audit(scene.rtol)?;
        report.audit(&whole, &table, &self.path("whole.gyr"), scene.end)?;
        if let Some(meeting) = scene.meeting.as_ref().filter(|_| report.is_final()) {
            self.audit_meeting(meeting, &table, scene.rtol)?;
        }
        let stops = if report.is_final() { self.stopped(&whole)? } else { Vec::new() };
        // A twin that its wall time ends would say nothing.
        let is_quick = whole.wall.as_secs_f64() < QUICK * self.wall_time;
        let twin = scene.meeting.as_ref().filter(|_| report.is_final() && is_quick);
        if let Some(meeting) = twin {
            match self.stream.chance(0.5) {
                true => twins::renamed(self, meeting, &rows)?,
                false => twins::exchanged(self, meeting, &table, scene)?,
            }
        }
        let Report { outcome, residual, is_open } = report;
        Ok(Verdict { outcome, stops, has_twin: twin.is_some(), residual, is_open })
    }

    /// What bodies that meet owe besides.
    fn audit_meeting(&self, meeting: &Meeting, table: &Table, rtol: f64) -> Result<(), String> {
        if meeting.has_springs_alone {
            table.never_rises("work.load", rtol)?;
        }
        if meeting.is_isolated {
            momenta::audit(&self.path("whole.gyr"), table, meeting.bodies.len(), rtol)?;
        }
        Ok(())
    }

    fn write(&self, scene: &RandomScene) -> std::io::Result<()> {
        fs::create_dir_all(&self.place.folder)?;
        fs::write(self.path(SCENE), &scene.text)?;
        scene.files.iter().try_for_each(|(name, text)| fs::write(self.path(name), text))
    }

    /// The rows of a recording, as CSV.
    fn rows(&self, recording: &str) -> Result<String, String> {
        Ok(self.said(&["export", recording, "--format", "csv", "-o", "-"], 1)?.stdout)
    }

    /// Writes the scene otherwise, runs it, and reads its rows.
    pub fn rows_of(&self, scene: &str, text: &str, more: &[&str]) -> Result<String, String> {
        fs::write(self.path(scene), text).map_err(|error| format!("{scene}: {error}"))?;
        let said = self.said(&arguments([scene, "twin.gyr"], &self.wall_time(), &[&["--force"], more].concat()), 1)?;
        match said.code {
            Some(0 | 1) => self.rows("twin.gyr"),
            code => Err(format!("{scene}, the same bodies written otherwise, exits with {code:?}")),
        }
    }

    /// Runs the scene once more, stops it and resumes it, on whatever threads: the bytes are those of the run before.
    fn stopped(&mut self, whole: &Said) -> Result<Vec<(Stopped, Moment)>, String> {
        let mut stops = Vec::new();
        for stop in stops::planned(&mut self.stream, whole.wall) {
            let moment = self.stop(stop, whole)?;
            stops.push((stop.how, moment));
            if moment == Moment::TooLate {
                break;
            }
        }
        let mut last = self.go_on()?;
        for _ in 0..MOST_PARTS {
            if !last.stdout.contains("\"wall_time\"") || Report::of(&last)?.is_final() {
                break;
            }
            last = self.go_on()?;
        }
        // What had ended before is not run again, and is done whatever its outcome.
        let expected = if last.stdout.contains("\"already_finished\"") { Some(0) } else { whole.code };
        if last.code != expected {
            let told = last.stderr.lines().next().unwrap_or_default();
            return Err(format!("resumed ({stops:?}) it exits with {:?}: {told}", last.code));
        }
        if let Some(differing) = differing(&self.path("whole.gyr"), &self.path(PART))? {
            return Err(self.whose_fault(&stops, &differing)?);
        }
        let done = self.run(PART, &["--resume"], 1)?;
        match done.code {
            Some(0) => Ok(stops),
            code => Err(format!("--resume of what has ended exits with {code:?}")),
        }
    }

    /// Goes on with the second run, or begins it, on some threads.
    fn go_on(&mut self) -> Result<Said, String> {
        let threads = stops::threads(&mut self.stream);
        self.run(PART, self.resuming(), threads)
    }

    fn resuming(&self) -> &'static [&'static str] {
        if self.path(PART).exists() { &["--resume"] } else { &[] }
    }

    /// Goes on with the second run, or begins it, and stops it.
    fn stop(&self, stop: PlannedStop, whole: &Said) -> Result<Moment, String> {
        let (wall_time, more) = (self.wall_time(), self.resuming());
        let arguments = arguments([SCENE, PART], &wall_time, more);
        let told = |error| format!("cannot start the program: {error}");
        let was_running = match stop.how {
            Stopped::Killed => self.place.kill_after(stop.after, &arguments, stop.threads).map_err(told)?,
            Stopped::Interrupted => {
                let ended = self.place.interrupt_after(stop.after, &arguments, stop.threads).map_err(told)?;
                match ended {
                    (Interrupted::Overran, _) => return Err("it does not heed an interrupt".into()),
                    // By the signal itself before it listens; or it was done already.
                    (Interrupted::Ended(None | Some(INTERRUPTED)), was_running) => was_running,
                    (Interrupted::Ended(code), _) if code == whole.code || code == Some(0) => false,
                    (Interrupted::Ended(code), _) => return Err(format!("interrupted it exits with {code:?}")),
                }
            }
        };
        Ok(match was_running {
            false => Moment::TooLate,
            true if self.path(PART).exists() => Moment::OnItsWay,
            true => Moment::BeforeItBegan,
        })
    }

    /// Whether the threads or the stops make the bytes differ.
    fn whose_fault(&self, stops: &[(Stopped, Moment)], file: &str) -> Result<String, String> {
        self.run("threads.gyr", &[], 2)?;
        Ok(match differing(&self.path("whole.gyr"), &self.path("threads.gyr"))? {
            Some(file) => format!("{file} differs between one thread and two"),
            None => format!("{file} differs after stops and resumptions: {stops:?}"),
        })
    }

    fn run(&self, recording: &str, more: &[&str], threads: usize) -> Result<Said, String> {
        self.said(&arguments([SCENE, recording], &self.wall_time(), more), threads)
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

fn arguments<'a>([scene, recording]: [&'a str; 2], wall_time: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["run", scene, "-o", recording, "--json", "--set", wall_time], more].concat()
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
