//! A run that is killed or interrupted goes on to the same bytes as one that is not.

#![allow(clippy::unwrap_used)]

mod common;

use common::{BALL, Said, Sandbox, assert_same_bytes};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Long enough to be hit in the middle: many bounces without loss, precisely.
const LONG: [&str; 10] = [
    "run",
    "ball.toml",
    "--set",
    "time.end=60",
    "--set",
    "solver.rtol=1e-11",
    "--set",
    "contact.0.damping.beta=1e-6",
    "--set",
    "time.sample=0.001",
];

fn start(sandbox: &Sandbox, output: &str) -> Child {
    let mut command = sandbox.command(&[&LONG[..], &["-o", output]].concat());
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let began = Instant::now();
    while !sandbox.path(output).exists() && began.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(5));
    }
    child
}

fn interrupt(child: &Child) {
    let status = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

#[test]
fn killed_runs_go_on_to_the_same_bytes() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&[&LONG[..], &["-o", "whole.gyr", "--quiet"]].concat());
    let mut hits = 0;
    for (k, delay) in [0, 150, 400, 700, 1100].into_iter().enumerate() {
        let output = format!("part-{k}.gyr");
        let mut child = start(&sandbox, &output);
        sleep(Duration::from_millis(delay));
        hits += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
        sandbox.done(&[&LONG[..], &["-o", &output, "--resume", "--quiet"]].concat());
        assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path(&output));
    }
    assert!(hits > 1, "the run is too short to be killed in the middle");
    let csv = |name: &str| sandbox.done(&["export", name, "--format", "csv", "-o", "-"]).stdout;
    assert!(csv("whole.gyr") == csv("part-1.gyr"));
}

#[test]
fn interrupted_run_says_how_to_go_on() {
    let sandbox = Sandbox::with_ball();
    let child = start(&sandbox, "part.gyr");
    sleep(Duration::from_millis(200));
    interrupt(&child);
    let said = Said::from(child.wait_with_output().unwrap());
    assert_eq!(said.code, Some(130), "{}", said.stderr);
    assert!(said.stderr.contains("--resume") && said.stderr.contains("-o part.gyr"), "{}", said.stderr);
    sandbox.done(&[&LONG[..], &["-o", "part.gyr", "--resume", "--quiet"]].concat());
    sandbox.done(&[&LONG[..], &["-o", "whole.gyr", "--quiet"]].concat());
    assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path("part.gyr"));
}

#[test]
fn wall_time_ends_a_run_that_can_be_resumed_with_more() {
    let sandbox = Sandbox::with_ball();
    let limited = |limit: &'static str| [&LONG[..], &["--quiet", "-o", "part.gyr", "--set", limit]].concat();
    let said = sandbox.run(&limited("solver.max_wall_time=0.05"));
    assert_eq!(said.code, Some(1), "{}", said.stderr);
    sandbox.done(&[&limited("solver.max_wall_time=1000")[..], &["--resume"]].concat());
}

#[test]
fn finished_run_stays_as_it_is() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    let before = common::tree(&sandbox.path("ball.gyr"));
    let said = sandbox.done(&["run", "ball.toml", "--resume"]);
    assert!(said.stderr.contains("Nothing was done"), "{}", said.stderr);
    assert!(before == common::tree(&sandbox.path("ball.gyr")));
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
}

#[test]
fn another_scene_is_not_resumed() {
    let sandbox = Sandbox::with_ball();
    sandbox.refused(3, &["run", "ball.toml", "--resume"]);
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    let before = common::tree(&sandbox.path("ball.gyr"));
    let said = sandbox.refused(2, &["run", "ball.toml", "--resume", "--set", "body.ball.density=2000"]);
    assert!(said.stderr.contains("another scene"), "{}", said.stderr);
    sandbox.write("other.toml", &BALL.replace("5 cm", "4 cm"));
    sandbox.refused(2, &["run", "other.toml", "-o", "ball.gyr", "--resume"]);
    assert!(before == common::tree(&sandbox.path("ball.gyr")));
    // What only the comments tell is the same scene.
    sandbox.write("same.toml", &format!("# a remark\n{BALL}"));
    sandbox.done(&["run", "same.toml", "-o", "ball.gyr", "--resume"]);
}
