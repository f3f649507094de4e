//! Studies: killed, interrupted and divided ones end with the same table as one that is not.

use crate::common::{Said, Sandbox, TIP};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// A ball dropped from somewhere, many times.
const STUDY: &str = r#"
title = "How low does it come?"
scene = "ball.toml"
repetitions = 40

[parameter.height]
key = "body.ball.position.2"
uniform = { from = "8 cm", to = 0.2 }

[parameter.friction]
key = "contact.0.friction.beta"
values = [1e3, 1e4]

[keep]
lowest = { minimum = "ball.gap" }
touches = { count = "closest_approach" }
"#;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::with_ball();
    sandbox.write("low.toml", STUDY);
    sandbox
}

fn table(sandbox: &Sandbox, folder: &str) -> Vec<u8> {
    fs::read(sandbox.path(folder).join("table.parquet")).unwrap()
}

/// The table of a study that nothing disturbs.
fn whole(sandbox: &Sandbox, arguments: &[&str]) -> Vec<u8> {
    sandbox.done(&[&["study", "low.toml", "-o", "whole.study", "--quiet", "--threads", "1"][..], arguments].concat());
    table(sandbox, "whole.study")
}

/// Rows in the journals of a table that is being written.
fn rows(folder: &Path) -> usize {
    let files = fs::read_dir(folder.join("rows")).into_iter().flatten().flatten();
    let lines = |path: &Path| fs::read(path).map_or(0, |bytes| bytes.iter().filter(|byte| **byte == b'\n').count());
    files
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "jsonl"))
        .map(|path| lines(&path))
        .sum()
}

/// Starts a study and returns it once it has this many rows on disk; none if it ended before.
fn start(sandbox: &Sandbox, arguments: &[&str], folder: &str, least: usize) -> Option<Child> {
    let mut command = sandbox.command(&[&["study", "low.toml", "-o", folder][..], arguments].concat());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while rows(&sandbox.path(folder)) < least {
        if child.try_wait().unwrap().is_some() {
            return None;
        }
        sleep(Duration::from_millis(2));
    }
    Some(child)
}

/// Studies of more and more runs, until `stop` meets one in the middle; returns its number of repetitions.
fn met_in_the_middle(sandbox: &Sandbox, folder: &str, mut stop: impl FnMut(&str, Child)) -> String {
    for doubling in 0..12 {
        let repetitions = format!("repetitions={}", 40 << doubling);
        if let Some(child) = start(sandbox, &["--set", &repetitions], folder, 5) {
            stop(&repetitions, child);
            if !sandbox.path(folder).join("table.parquet").exists() {
                return repetitions;
            }
        }
        fs::remove_dir_all(sandbox.path(folder)).unwrap();
    }
    panic!("no study is long enough to be met in the middle")
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn killed_studies_go_on_to_the_same_table() {
    let sandbox = sandbox();
    let repetitions = met_in_the_middle(&sandbox, "part.study", |repetitions, child| {
        kill(child);
        let made = rows(&sandbox.path("part.study"));
        // A second time, behind the rows that it goes on from.
        if let Some(child) = start(&sandbox, &["--set", repetitions, "--resume"], "part.study", made + 5) {
            kill(child);
        }
    });
    let resume = ["study", "low.toml", "-o", "part.study", "--set", &repetitions, "--resume", "--quiet"];
    sandbox.done(&resume);
    assert!(table(&sandbox, "part.study") == whole(&sandbox, &["--set", &repetitions]));
    let said = sandbox.done(&resume[..resume.len() - 1]);
    assert!(said.stderr.contains("Nothing was done"), "{}", said.stderr);
}

#[test]
fn interrupted_study_says_how_to_go_on() {
    let sandbox = sandbox();
    let mut said = None;
    let repetitions = met_in_the_middle(&sandbox, "part.study", |_, child| {
        let status = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(status.success());
        said = Some(Said::from(child.wait_with_output().unwrap()));
    });
    let said = said.unwrap();
    assert_eq!(said.code, Some(130), "{}", said.stderr);
    let (_, command) = said.stderr.split_once("go on with `gyration ").unwrap();
    let command: Vec<&str> = command.split('`').next().unwrap().split(' ').collect();
    sandbox.done(&command);
    assert!(table(&sandbox, "part.study") == whole(&sandbox, &["--set", &repetitions]));
}

#[test]
fn shards_are_joined_to_the_same_table() {
    let sandbox = sandbox();
    let expected = whole(&sandbox, &[]);
    for k in ["2/3", "3/3"] {
        sandbox.done(&["study", "low.toml", "--shard", k, "--quiet"]);
    }
    let said = sandbox.refused(2, &["study", "low.toml", "merge"]);
    assert!(said.stderr.contains("there is no 1") && said.stderr.contains("--shard 1/3"), "{}", said.stderr);
    sandbox.done(&["study", "low.toml", "--shard", "1/3", "--quiet"]);
    let said = sandbox.done(&["study", "low.toml", "merge"]);
    assert!(said.stderr.contains("runs       80: 2 points, 40 repetitions"), "{}", said.stderr);
    assert!(table(&sandbox, "low.study") == expected);
    sandbox.refused(2, &["study", "low.toml", "merge"]);
    sandbox.done(&["study", "low.toml", "merge", "--force", "--quiet"]);
    // Shards of another study are told by name.
    sandbox.write("low.toml", &STUDY.replace("8 cm", "9 cm"));
    let said = sandbox.refused(2, &["study", "low.toml", "merge", "--force"]);
    assert!(said.stderr.contains("shard-1-of-3") && said.stderr.contains("another study"), "{}", said.stderr);
}

#[test]
fn bad_input_is_refused_with_its_fix() {
    let sandbox = sandbox();
    for (code, arguments, words) in [
        (2, &["study", "low.toml", "--shard", "4/3"][..], "1 to n"),
        (2, &["study", "low.toml", "--shard", "0/3"], "1 to n"),
        (2, &["study", "low.toml", "--shard", "three"], "K/N"),
        (2, &["study", "low.toml", "--threads", "100000"], "ask for 1 to 1024"),
        (2, &["study", "low.toml", "--set", "repetitions=0"], "at least 1"),
        (2, &["study", "low.toml", "--set", "parameter.height.key=\"body.bull.position.2\""], "ball"),
        (3, &["study", "law.toml"], "no such file"),
        (3, &["study", "low.toml", "--resume"], "leave --resume out"),
        (2, &["study", "low.toml", "merge"], "no shards"),
        (2, &["study", "low.toml", "--resume", "--force"], "--resume"),
    ] {
        let said = sandbox.refused(code, arguments);
        assert!(said.stderr.contains(words), "{arguments:?}: {}", said.stderr);
    }
    assert_eq!(sandbox.names(), ["ball.toml", "low.toml"]);
    sandbox.done(&["study", "low.toml", "--quiet"]);
    let said = sandbox.refused(2, &["study", "low.toml"]);
    assert!(said.stderr.contains("--resume") && said.stderr.contains("--force"), "{}", said.stderr);
    let said = sandbox.refused(2, &["study", "low.toml", "--set", "seed=2", "--resume"]);
    assert!(said.stderr.contains("another study"), "{}", said.stderr);
    sandbox.done(&["study", "low.toml", "--set", "seed=2", "--force", "--quiet"]);
}

#[test]
fn summary_counts_outcomes_and_tells_what_is_kept() {
    let sandbox = sandbox();
    let failing = "parameter.height.uniform.from=\"2 cm\"";
    let said = sandbox.done(&["study", "low.toml", "--set", failing, "--threads", "2"]).stderr;
    for words in ["How low does it come?", "completed", "failed", "touches    ", "lowest     ", "runs/s on 2 threads"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(said.contains("low.study/table.parquet"), "{said}");
    // A study of nothing but failures is no success.
    let all = ["parameter.height.uniform.from=\"1 cm\"", "parameter.height.uniform.to=\"2 cm\""];
    let said =
        sandbox.refused(1, &["study", "low.toml", "--set", all[0], "--set", all[1], "-o", "all.study", "--quiet"]);
    assert!(said.stderr.contains("no run could be made"), "{}", said.stderr);
    let again = ["study", "low.toml", "--set", all[0], "--set", all[1], "-o", "all.study", "--quiet", "--resume"];
    assert!(sandbox.refused(1, &again).stderr.contains("no run could be made"));
}

#[test]
fn an_open_ledger_of_a_run_is_told_always() {
    let sandbox = Sandbox::with_ball();
    sandbox.write("tip.toml", TIP);
    // Only the second run gets as far as the impact.
    let tips = "scene = \"tip.toml\"\n[parameter.end]\nkey = \"time.end\"\nvalues = [0.05, 0.2]\n\
                [keep]\nheight = { last = \"egg.z\" }\n";
    sandbox.write("tips.toml", tips);
    let told = "gyration: warning: the energy balance of run 1 is open. Do not trust it: ";
    let command = ["study", "tips.toml", "--quiet", "-o", "a.study"];
    for more in [&[][..], &["--resume"], &["--force"]] {
        let said = sandbox.run(&[&command[..], more].concat());
        assert!(said.code == Some(4) && said.stderr.contains(told), "{more:?}: {}", said.stderr);
    }
    for (shard, code) in [("1/2", 0), ("2/2", 4)] {
        let said = sandbox.run(&["study", "tips.toml", "--quiet", "-o", "b.study", "--shard", shard]);
        assert_eq!((said.code, said.stderr.contains(told)), (Some(code), code == 4), "{}", said.stderr);
    }
    let merged = sandbox.run(&["study", "tips.toml", "merge", "--quiet", "-o", "b.study"]);
    assert!(merged.code == Some(4) && merged.stderr.contains(told), "{}", merged.stderr);
    sandbox.write("low.toml", STUDY);
    let said = sandbox.done(&["study", "low.toml"]);
    assert!(!said.stderr.contains("warning"), "{}", said.stderr);
}
