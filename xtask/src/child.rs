//! Running one program: its output line by line, in the order in which it was written, and what it cost.

use std::io::{BufRead, BufReader, Result};
use std::ops::AddAssign;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// What running something took.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Cost {
    /// Time that passed [s].
    pub wall: f64,
    /// Time of processors, that of the programs it started included [s]; zero where the system does not tell.
    pub cpu: f64,
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.wall += other.wall;
        self.cpu += other.cpu;
    }
}

/// Runs a command to its end and hands over each line of its output and its errors; whether it exited with zero, else
/// in which words it ended, and what it took.
pub fn run(command: &mut Command, mut line: impl FnMut(&str)) -> Result<(std::result::Result<(), String>, Cost)> {
    let started = Instant::now();
    let (reader, writer) = std::io::pipe()?;
    command.stdin(Stdio::null()).stdout(writer.try_clone()?).stderr(writer);
    let child = command.spawn();
    // The command keeps the writing ends, and the pipe would never end.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = child?;
    for text in BufReader::new(reader).split(b'\n') {
        // Not `lines`: a test may print what is not UTF-8.
        line(&String::from_utf8_lossy(&text?));
    }
    let cpu = processor_time(&child);
    let status = child.wait()?;
    let outcome = if status.success() { Ok(()) } else { Err(status.to_string()) };
    Ok((outcome, Cost { wall: started.elapsed().as_secs_f64(), cpu }))
}

/// The processor time of a child that ends, read before it is forgotten.
fn processor_time(child: &Child) -> f64 {
    let path = format!("/proc/{}/stat", child.id());
    loop {
        let Some((ended, cpu)) = std::fs::read_to_string(&path).ok().as_deref().and_then(reading) else { return 0.0 };
        if ended {
            return cpu;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Whether a process has ended, and its processor time: `pid (name) state … utime stime cutime cstime …`.
fn reading(stat: &str) -> Option<(bool, f64)> {
    /// Ticks of the kernel's clock in a second, as it shows them to programs.
    const TICKS: f64 = 100.0;
    // The name may hold spaces and brackets.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: Option<Vec<f64>> = fields.get(11..15)?.iter().map(|field| field.parse().ok()).collect();
    Some((matches!(*fields.first()?, "Z" | "X"), ticks?.iter().sum::<f64>() / TICKS))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> (Vec<String>, std::result::Result<(), String>, Cost) {
        let mut lines = Vec::new();
        let (outcome, cost) = run(Command::new("sh").args(["-c", script]), |line| lines.push(line.to_owned())).unwrap();
        (lines, outcome, cost)
    }

    #[test]
    fn lines_come_in_the_order_of_writing_whichever_way_they_go() {
        let (lines, outcome, _) = shell("echo one; echo two >&2; echo three; exit 3");
        assert_eq!(lines, ["one", "two", "three"]);
        assert!(outcome.unwrap_err().contains('3'));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_time_of_what_a_child_starts_is_counted() {
        let (_, outcome, cost) = shell("sh -c 'i=0; while [ $i -lt 60000 ]; do i=$((i+1)); done'; true");
        assert_eq!(outcome, Ok(()));
        assert!(cost.cpu > 0.0, "{cost:?}");
    }

    #[test]
    fn a_name_with_brackets_is_passed_over() {
        let stat = "7 (a (b) c) Z 1 2 3 4 5 6 7 8 9 10 100 50 30 20 20 0";
        assert_eq!(reading(stat), Some((true, 2.0)));
        assert_eq!(reading("7 (a) R 1"), None);
    }
}
