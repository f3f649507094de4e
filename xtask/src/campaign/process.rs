//! Running the program within a limit of wall time, or killing it on the way.

use std::fs::{self, File};
use std::io::Result;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often a running program is looked at.
const LOOK: Duration = Duration::from_millis(1);

/// An interrupted program ends within this time: a second, and more for a busy machine.
const HEEDS: Duration = Duration::from_secs(5);

/// How a run is stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// At once, wherever it is.
    Kill,
    /// As by Ctrl-C.
    Interrupt,
}

/// What came of a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// The program had ended before.
    TooLate,
    /// It was killed.
    Killed,
    /// It was interrupted, and ended with this code.
    Interrupted(Option<i32>),
    /// It ran on.
    Heedless,
}

/// The program, and the folder in which it runs.
#[derive(Debug, Clone)]
pub struct Place<'a> {
    /// The program.
    pub program: &'a Path,
    /// Where its files are.
    pub folder: PathBuf,
    /// The most wall time that a program may take.
    pub limit: Duration,
}

/// How a program ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Ending {
    /// By itself.
    Ended(Said),
    /// It was killed, since it ran longer than it may.
    Overran,
}

/// What a program said.
#[derive(Debug, Clone, PartialEq)]
pub struct Said {
    /// Its exit code; none if a signal ended it.
    pub code: Option<i32>,
    /// Its output.
    pub stdout: String,
    /// Its messages.
    pub stderr: String,
    /// The wall time that it took.
    pub wall: Duration,
}

impl Place<'_> {
    /// Runs the program to its end.
    pub fn run(&self, arguments: &[&str], threads: usize) -> Result<Ending> {
        let [out, err] = ["stdout.txt", "stderr.txt"].map(|name| self.folder.join(name));
        let mut command = self.command(arguments, threads);
        let started = Instant::now();
        // Into files: a full pipe would hold the program up.
        let mut child = command.stdout(File::create(&out)?).stderr(File::create(&err)?).spawn()?;
        let Some(code) = waited(&mut child, started, self.limit)? else { return Ok(Ending::Overran) };
        let wall = started.elapsed();
        let [stdout, stderr] = [out, err].map(|path| {
            let text = fs::read(&path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
            fs::remove_file(&path).and(text)
        });
        Ok(Ending::Ended(Said { code, stdout: stdout?, stderr: stderr?, wall }))
    }

    /// Starts the program and stops it after this time; whether it was still running.
    pub fn stop_after(&self, time: Duration, stop: Stop, arguments: &[&str], threads: usize) -> Result<Stopped> {
        let mut command = self.command(arguments, threads);
        let started = Instant::now();
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
        if ended(&mut child, started, time)?.is_some() {
            return Ok(Stopped::TooLate);
        }
        if stop == Stop::Kill {
            child.kill()?;
            child.wait()?;
            return Ok(Stopped::Killed);
        }
        Command::new("kill").args(["-INT", &child.id().to_string()]).status()?;
        match waited(&mut child, Instant::now(), HEEDS)? {
            Some(code) => Ok(Stopped::Interrupted(code)),
            None => Ok(Stopped::Heedless),
        }
    }

    fn command(&self, arguments: &[&str], threads: usize) -> Command {
        let mut command = Command::new(self.program);
        command.current_dir(&self.folder).args(arguments).env("RAYON_NUM_THREADS", threads.to_string());
        command.stdin(Stdio::null());
        command
    }
}

/// The exit code of a child; none if it is killed because this time has passed.
fn waited(child: &mut Child, started: Instant, limit: Duration) -> Result<Option<Option<i32>>> {
    let code = ended(child, started, limit)?;
    if code.is_none() {
        child.kill()?;
        child.wait()?;
    }
    Ok(code)
}

/// The exit code of a child; none if it has not ended within this time.
fn ended(child: &mut Child, started: Instant, limit: Duration) -> Result<Option<Option<i32>>> {
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status.code()));
        }
        let left = limit.saturating_sub(started.elapsed());
        if left.is_zero() {
            return Ok(None);
        }
        sleep(LOOK.min(left));
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn place(limit: u64) -> Place<'static> {
        Place { program: Path::new("/bin/sh"), folder: std::env::temp_dir(), limit: Duration::from_millis(limit) }
    }

    #[test]
    fn a_program_beyond_its_limit_is_killed() {
        assert_eq!(place(30).run(&["-c", "sleep 60"], 1).unwrap(), Ending::Overran);
        let stopped = |stop, what| place(30).stop_after(Duration::from_millis(200), stop, &["-c", what], 1).unwrap();
        assert_eq!(stopped(Stop::Kill, "sleep 60"), Stopped::Killed);
        assert_eq!(stopped(Stop::Kill, "exit 3"), Stopped::TooLate);
        assert_eq!(
            stopped(Stop::Interrupt, "trap 'exit 5' INT; while :; do sleep 0.01; done"),
            Stopped::Interrupted(Some(5))
        );
    }
}
