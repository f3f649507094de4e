//! What the machinery of a study costs: a run beside the run itself, and memory at a million rows.
//!
//! `cargo run --release -p gyration-study --example throughput -- STUDY RUNS THREADS` makes the first RUNS runs of a
//! study in a temporary folder; without a study, of a ball in free fall for one step.

use gyration_sim::Unwatched;
use gyration_study::{Shard, Study, Table, execute};
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Instant;

/// A ball that falls for a hundredth of a second.
const TRIVIAL: &str = r#"
time = { end = 0.01, sample = 0.01 }
solver = { rtol = 1e-3 }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.05 } }
density = 1000
position = [0, 0, 0.1]
"#;

const STUDY: &str = r#"
scene = "ball.toml"
repetitions = 100000
[parameter.height]
key = "body.ball.position.2"
uniform = { from = 0.1, to = 0.2 }
[keep]
end = { last = "ball.z" }
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = std::env::temp_dir().join(format!("gyration-throughput-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("ball.toml"), TRIVIAL)?;
    let runs = format!("repetitions={}", arguments.get(1).map_or("100000", String::as_str));
    let study = match arguments.first().filter(|name| !name.is_empty()) {
        Some(name) => Study::open(name, &[runs])?,
        None => Study::parse("trivial.toml", STUDY, &folder, &[runs])?,
    };
    let threads: NonZeroUsize = arguments.get(2).map_or("1", String::as_str).parse()?;
    one_by_one(&study);
    let mut table = Table::create(&folder.join("t.study"), &study, Shard::WHOLE, false)?;
    let began = Instant::now();
    execute(&study, &mut table, threads, &mut Unwatched)?;
    let seconds = began.elapsed().as_secs_f64();
    println!("{} runs on {threads} threads: {seconds:.2} s, {:.0} runs/s", study.runs(), study.runs() as f64 / seconds);
    println!(
        "table: {} bytes; peak memory: {}",
        std::fs::metadata(table.file())?.len(),
        peak(Path::new("/proc/self/status"))
    );
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}

/// The fastest of some repetitions of each part of a run.
fn one_by_one(study: &Study) {
    let fastest = |work: &dyn Fn(u64)| {
        let time = |run: u64| {
            let began = Instant::now();
            work(run % study.runs());
            began.elapsed().as_secs_f64() * 1e6
        };
        (0..300).map(time).fold(f64::INFINITY, f64::min)
    };
    let scene = fastest(&|run| drop(black_box(study.scene_of(run))));
    let row = fastest(&|run| drop(black_box(study.row(run))));
    println!("scene {scene:.1} µs, row {row:.1} µs (fastest of 300)");
}

/// The greatest resident memory so far, as the system tells it.
fn peak(status: &Path) -> String {
    let text = std::fs::read_to_string(status).unwrap_or_default();
    text.lines().find(|line| line.starts_with("VmHWM")).map_or_else(|| "?".into(), |line| line[6..].trim().to_owned())
}
