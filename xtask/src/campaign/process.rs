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

/// How a program ended that was asked to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interrupted {
    /// With this exit code; none if by the signal itself, before it could heed it.
    Ended(Option<i32>),
    /// It was killed, since it did not heed it in time.
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
        if !waited(&mut child, self.limit)? {
            kill(&mut child)?;
            return Ok(Ending::Overran);
        }
        let (wall, code) = (started.elapsed(), child.wait()?.code());
        let [stdout, stderr] = [out, err].map(|path| {
            let text = fs::read(&path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
            fs::remove_file(&path).and(text)
        });
        Ok(Ending::Ended(Said { code, stdout: stdout?, stderr: stderr?, wall }))
    }

    /// Starts the program and kills it after this time; whether it was still running.
    pub fn kill_after(&self, time: Duration, arguments: &[&str], threads: usize) -> Result<bool> {
        let mut child = self.silent(arguments, threads)?;
        Ok(!waited(&mut child, time)? && {
            kill(&mut child)?;
            true
        })
    }

    /// Starts the program and asks it to end after this time, as ^C does; how it ended, and whether it was running.
    pub fn interrupt_after(&self, time: Duration, arguments: &[&str], threads: usize) -> Result<(Interrupted, bool)> {
        let mut child = self.silent(arguments, threads)?;
        let was_running = !waited(&mut child, time)?;
        if was_running {
            interrupt(&mut child)?;
        }
        if waited(&mut child, self.limit)? {
            return Ok((Interrupted::Ended(child.wait()?.code()), was_running));
        }
        kill(&mut child)?;
        Ok((Interrupted::Overran, was_running))
    }

    fn silent(&self, arguments: &[&str], threads: usize) -> Result<Child> {
        self.command(arguments, threads).stdout(Stdio::null()).stderr(Stdio::null()).spawn()
    }

    fn command(&self, arguments: &[&str], threads: usize) -> Command {
        let mut command = Command::new(self.program);
        command.current_dir(&self.folder).args(arguments).env("RAYON_NUM_THREADS", threads.to_string());
        command.stdin(Stdio::null());
        command
    }
}

/// Waits for a child, so long at most; whether it has ended.
fn waited(child: &mut Child, limit: Duration) -> Result<bool> {
    let started = Instant::now();
    loop {
        if child.try_wait()?.is_some() {
            return Ok(true);
        }
        let left = limit.saturating_sub(started.elapsed());
        if left.is_zero() {
            return Ok(false);
        }
        sleep(LOOK.min(left));
    }
}

fn kill(child: &mut Child) -> Result<()> {
    child.kill()?;
    child.wait().map(drop)
}

/// Sends SIGINT: the standard library has SIGKILL alone. Where there is no such signal, a kill stands for it.
fn interrupt(child: &mut Child) -> Result<()> {
    if cfg!(unix) {
        // Not waited for before: the number is still the child's.
        let line = format!("kill -INT {}", child.id());
        return Command::new("sh").args(["-c", &line]).stderr(Stdio::null()).status().map(drop);
    }
    child.kill()
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

    #[test]
    fn a_program_that_is_asked_to_end_says_how_it_did() {
        let soon = Duration::from_millis(200);
        let interrupted = |script: &str, limit| place(limit).interrupt_after(soon, &["-c", script], 1).unwrap();
        let heeding = "trap 'exit 130' INT; while :; do sleep 0.01; done";
        assert_eq!(interrupted(heeding, 5000), (Interrupted::Ended(Some(130)), true));
        assert_eq!(interrupted("trap '' INT; while :; do sleep 0.01; done", 50), (Interrupted::Overran, true));
        assert_eq!(interrupted("exit 3", 5000), (Interrupted::Ended(Some(3)), false));
    }
}
