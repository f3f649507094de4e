//! Running the program within a limit of wall time, or killing it on the way.

use std::fs::{self, File};
use std::io::Result;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often a running program is looked at.
const LOOK: Duration = Duration::from_millis(1);

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

    /// Starts the program and kills it after this time; whether it was still running.
    pub fn kill_after(&self, time: Duration, arguments: &[&str], threads: usize) -> Result<bool> {
        let mut command = self.command(arguments, threads);
        let started = Instant::now();
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
        Ok(waited(&mut child, started, time)?.is_none())
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
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status.code()));
        }
        let left = limit.saturating_sub(started.elapsed());
        if left.is_zero() {
            child.kill()?;
            child.wait()?;
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
        assert!(place(30).kill_after(Duration::from_millis(20), &["-c", "sleep 60"], 1).unwrap());
        assert!(!place(30).kill_after(Duration::from_secs(60), &["-c", "exit 3"], 1).unwrap());
    }
}
