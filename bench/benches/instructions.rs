//! Instructions of each kernel under callgrind, beside those kept in `bench/instructions.txt`.
//!
//!     cargo bench -p gyration-bench --bench instructions               a table; fails where one takes 2 % more
//!     cargo bench -p gyration-bench --bench instructions -- --write    keeps what is counted
//!
//! The same program runs under valgrind, which counts alike whatever else a machine does: two runs of a kernel differ
//! by so many calls. Valgrind offers registers of 256 bits; counts belong to one compiler.

use gyration_benchmark::kernels;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, ExitCode};

/// Where they are kept.
const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.txt");
/// Calls of the two runs: what is found once is found in the shorter one.
const CALLS: [u64; 2] = [10, 110];
/// By how much a count may grow.
const ROOM: f64 = 0.02;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--kernel", key, calls] => run(key, calls),
        [] => compare(false),
        ["--write"] => compare(true),
        _ => Err("arguments are none or --write".to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Calls one kernel so often.
fn run(key: &str, calls: &str) -> Result<(), String> {
    let calls: u64 = calls.parse().map_err(|error| format!("{calls}: {error}"))?;
    let kernel = kernels().into_iter().find(|kernel| kernel.key == key);
    let mut kernel = kernel.ok_or_else(|| format!("there is no kernel {key}"))?;
    (0..calls).for_each(|_| kernel.call());
    Ok(())
}

fn compare(writes: bool) -> Result<(), String> {
    let kept = if Path::new(KEPT).exists() { std::fs::read_to_string(KEPT).map_err(in_words)? } else { String::new() };
    let (mut table, mut grown) = (String::new(), Vec::new());
    println!("{:20} {:>10} {:>10}", "kernel", "counted", "kept");
    for key in kernels().into_iter().map(|kernel| kernel.key) {
        let [few, many] = CALLS.map(|calls| count(&key, calls));
        let each = (many? - few?) / (CALLS[1] - CALLS[0]);
        let before =
            kept.lines().find_map(|line| line.strip_prefix(&key)?.strip_prefix(' ')?.trim().parse::<u64>().ok());
        println!("{key:20} {each:10} {:>10}", before.map_or("–".to_owned(), |before| before.to_string()));
        if before.is_none_or(|before| each as f64 > (1.0 + ROOM) * before as f64) {
            grown.push(key.clone());
        }
        writeln!(table, "{key:20} {each:10}").map_err(in_words)?;
    }
    if writes {
        return std::fs::write(KEPT, table).map_err(in_words);
    }
    match grown.is_empty() {
        true => Ok(()),
        false => Err(format!("more instructions than kept, or none kept: {}", grown.join(", "))),
    }
}

/// The instructions of a run with so many calls.
fn count(key: &str, calls: u64) -> Result<u64, String> {
    let own = std::env::current_exe().map_err(in_words)?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(own);
    let run = valgrind.args(["--kernel", key, &calls.to_string()]).output();
    let run = run.map_err(|error| format!("valgrind: {error} (it is to be installed)"))?;
    let said = String::from_utf8_lossy(&run.stderr);
    let collected = said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
    collected.filter(|_| run.status.success()).ok_or_else(|| format!("valgrind did not count {key}: {said}"))
}

fn in_words(error: impl std::fmt::Display) -> String {
    error.to_string()
}
