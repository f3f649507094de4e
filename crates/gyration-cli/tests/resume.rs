//! A run that is killed or interrupted goes on to the same bytes as one that is not.

use crate::common::{BALL, Said, Sandbox, assert_same_bytes, tree};
use gyration_record::Recording;
use serde_json::Value;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Many bounces without loss, precisely.
const PRECISE: [&str; 8] = [
    "run",
    "ball.toml",
    "--set",
    "solver.rtol=1e-11",
    "--set",
    "contact.0.damping.beta=1e-6",
    "--set",
    "time.sample=0.001",
];

/// How often the recording of a running program is looked at.
const LOOK: Duration = Duration::from_millis(2);

/// The arguments of a run to this time [s], with these besides.
fn to<'a>(end: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&PRECISE[..], &["--set", end], more].concat()
}

/// Starts the program and returns it once it has this many rows on disk; none if it ended before.
fn start(sandbox: &Sandbox, arguments: &[&str], output: &str, rows: usize) -> Option<Child> {
    let mut command = sandbox.command(&[arguments, &["-o", output]].concat());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while rows_on_disk(&sandbox.path(output)) < rows {
        if child.try_wait().unwrap().is_some() {
            return None;
        }
        sleep(LOOK);
    }
    Some(child)
}

fn rows_on_disk(path: &Path) -> usize {
    Recording::open(path).map_or(0, |recording| recording.rows())
}

fn is_finished(path: &Path) -> bool {
    Recording::open(path).unwrap().attributes().contains_key("outcome")
}

/// Starts runs, each twice as long as the last, until `stop` meets one in the middle; returns its end, `time.end=…`.
fn met_in_the_middle(sandbox: &Sandbox, output: &str, first: u32, mut stop: impl FnMut(&str, Child)) -> String {
    for doubling in 0..20 {
        let end = format!("time.end={}", first << doubling);
        if let Some(child) = start(sandbox, &to(&end, &[]), output, 2) {
            stop(&end, child);
            if !is_finished(&sandbox.path(output)) {
                return end;
            }
        }
        // Not with --force: the rows of the old recording would be met before those of the new one.
        std::fs::remove_dir_all(sandbox.path(output)).unwrap();
    }
    panic!("no run is long enough to be met in the middle")
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn killed_runs_go_on_to_the_same_bytes() {
    assert_survives(&Sandbox::with_ball(), 20);
}

/// Each has steps of its own, and stands somewhere else when the run is killed.
#[test]
fn killed_runs_of_fifty_bodies_go_on_to_the_same_bytes() {
    let sandbox = Sandbox::new();
    let (rest, ball) = BALL.split_at(BALL.find("[[body]]").unwrap());
    let balls = (0..50).map(|k| {
        let place = format!("position = [{k}, 0, {}]", 0.2 + 0.01 * f64::from(k));
        ball.replace("\"ball\"", &format!("\"ball{k}\"")).replace("position = [0, 0, 0.2]", &place)
    });
    sandbox.write("ball.toml", &[rest.to_owned(), balls.collect()].concat());
    assert_survives(&sandbox, 1);
}

fn assert_survives(sandbox: &Sandbox, first: u32) {
    let end = met_in_the_middle(sandbox, "part.gyr", first, |end, child| {
        kill(child);
        // A second time, behind the rows that it resumes from.
        let rows = rows_on_disk(&sandbox.path("part.gyr"));
        if let Some(child) = start(sandbox, &to(end, &["--resume"]), "part.gyr", rows + 1) {
            kill(child);
        }
    });
    sandbox.done(&to(&end, &["-o", "part.gyr", "--resume", "--quiet"]));
    sandbox.done(&to(&end, &["-o", "whole.gyr", "--quiet"]));
    assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path("part.gyr"));
    // A third one, with no more than the start on disk.
    if let Some(child) = start(sandbox, &to(&end, &[]), "first.gyr", 1) {
        kill(child);
    }
    sandbox.done(&to(&end, &["-o", "first.gyr", "--resume", "--quiet"]));
    assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path("first.gyr"));
    let csv = |name: &str| sandbox.done(&["export", name, "--format", "csv", "-o", "-"]).stdout;
    assert!(csv("whole.gyr") == csv("part.gyr"));
}

#[test]
fn interrupted_run_says_how_to_go_on() {
    let sandbox = Sandbox::with_ball();
    let mut said = None;
    let end = met_in_the_middle(&sandbox, "part.gyr", 20, |_, child| {
        let status = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(status.success());
        said = Some(Said::from(child.wait_with_output().unwrap()));
    });
    let said = said.unwrap();
    assert_eq!(said.code, Some(130), "{}", said.stderr);
    assert!(said.stderr.contains("--resume") && said.stderr.contains("-o part.gyr"), "{}", said.stderr);
    sandbox.done(&to(&end, &["-o", "part.gyr", "--resume", "--quiet"]));
    sandbox.done(&to(&end, &["-o", "whole.gyr", "--quiet"]));
    assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path("part.gyr"));
}

#[test]
fn run_ended_by_its_wall_time_goes_on_to_the_same_bytes() {
    let sandbox = Sandbox::with_ball();
    let limited =
        |limit: &'static str, more: &[&'static str]| to("time.end=5", &[&["--quiet", "--set", limit], more].concat());
    // No machine bounces a ball for 5 s to 1e-11 within a millisecond.
    let said = sandbox.run(&limited("solver.max_wall_time=0.001", &["-o", "part.gyr"]));
    assert_eq!(said.code, Some(1), "{}", said.stderr);
    assert!(!is_finished(&sandbox.path("part.gyr")));
    let said = sandbox.run(&limited("solver.max_wall_time=0.001", &["-o", "part.gyr", "--resume"]));
    assert_eq!(said.code, Some(1), "{}", said.stderr);
    sandbox.done(&limited("solver.max_wall_time=1000", &["-o", "part.gyr", "--resume"]));
    sandbox.done(&limited("solver.max_wall_time=1000", &["-o", "whole.gyr"]));
    let [mut whole, mut part] = ["whole.gyr", "part.gyr"].map(|name| tree(&sandbox.path(name)));
    // The attributes tell the limit under which a run began; all else is the same.
    let [group, resumed] =
        [&mut whole, &mut part].map(|files| attributes(&files.remove(Path::new("zarr.json")).unwrap()));
    assert_eq!(group, resumed);
    assert_eq!(whole.keys().collect::<Vec<_>>(), part.keys().collect::<Vec<_>>());
    let different: Vec<_> = whole.iter().filter(|(path, bytes)| part[*path] != **bytes).map(|(path, _)| path).collect();
    assert!(different.is_empty(), "{different:?}");
}

/// As many threads as anybody likes: no byte is another one.
#[test]
fn the_number_of_threads_may_change_from_run_to_run() {
    let sandbox = Sandbox::with_ball();
    let second = BALL[BALL.find("[[body]]").unwrap()..].replace("\"ball\"", "\"other\"").replace("0.2]", "0.3]");
    sandbox.write("two.toml", &format!("{BALL}{second}"));
    let run = |output, threads| sandbox.done(&["run", "two.toml", "--quiet", "-o", output, "--threads", threads]);
    run("one.gyr", "1");
    run("two.gyr", "2");
    assert_same_bytes(&sandbox.path("one.gyr"), &sandbox.path("two.gyr"));
    // Nor is it another scene that asks for others.
    sandbox.done(&["run", "two.toml", "--quiet", "-o", "one.gyr", "--resume", "--set", "solver.threads=3"]);
    let said = sandbox.refused(2, &["run", "two.toml", "-o", "three.gyr", "--threads", "5000"]);
    assert!(said.stderr.contains("ask for 1 to 1024"), "{}", said.stderr);
}

#[test]
fn a_resumption_without_the_original_overrides_names_them() {
    let sandbox = Sandbox::with_ball();
    let made = ["run", "ball.toml", "--quiet", "--set", "time.end=0.2", "--set", "body.ball.density=900"];
    sandbox.done(&made);
    let said = sandbox.refused(2, &["run", "ball.toml", "--resume"]);
    for words in [
        "time.end: 0.2 there, 0.6 here",
        "body.ball.density: 900.0 there, 1000.0 here",
        "repeat --set 'time.end=0.2' --set 'body.ball.density=900'",
    ] {
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
    sandbox.done(&[&made[..], &["--resume"]].concat());
}

/// The metadata of a recording without the limit of wall time, and without the checksum in which it enters.
fn attributes(json: &[u8]) -> Value {
    let mut group: Value = serde_json::from_slice(json).unwrap();
    let attributes = &mut group["attributes"];
    let [Value::Object(mut solver), Value::Array(overrides)] =
        [attributes["resolved"]["solver"].take(), attributes["overrides"].take()]
    else {
        panic!("neither solver nor overrides: {attributes}")
    };
    assert!(solver.remove("max_wall_time").is_some());
    assert!(attributes["record_checksum"].take().is_string());
    attributes["resolved"]["solver"] = Value::Object(solver);
    attributes["overrides"] =
        overrides.into_iter().filter(|setting| !setting.as_str().unwrap().contains("max_wall_time")).collect();
    group
}

/// A kill came between the outcome and the checkpoint that belongs to it: the checkpoint of the recording is an earlier
/// one, from which a report would take its ledger.
#[test]
fn outcome_that_is_ahead_of_its_checkpoint_is_reached_again() {
    let sandbox = Sandbox::with_ball();
    let limited = |limit: &'static str, output: &'static str, more: &[&'static str]| {
        to("time.end=5", &[&["--quiet", "--set", limit, "-o", output], more].concat())
    };
    let (brief, ample) = ("solver.max_wall_time=0.001", "solver.max_wall_time=1000");
    sandbox.run(&limited(brief, "part.gyr", &[]));
    for whole in ["whole.gyr", "ahead.gyr"] {
        sandbox.done(&limited(ample, whole, &[]));
    }
    let checkpoint = |name: &str| sandbox.path(name).join("state/checkpoint");
    std::fs::copy(checkpoint("part.gyr"), checkpoint("ahead.gyr")).unwrap();
    // On the way there it is not complete: it may be killed once more.
    let said = sandbox.run(&limited(brief, "ahead.gyr", &["--resume"]));
    assert_eq!(said.code, Some(1), "{}", said.stderr);
    assert!(!is_finished(&sandbox.path("ahead.gyr")));
    sandbox.done(&limited(ample, "ahead.gyr", &["--resume"]));
    assert_same_bytes(&sandbox.path("whole.gyr"), &sandbox.path("ahead.gyr"));
}

#[test]
fn finished_run_stays_as_it_is() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    let before = tree(&sandbox.path("ball.gyr"));
    let said = sandbox.done(&["run", "ball.toml", "--resume"]);
    assert!(said.stderr.contains("Nothing was done"), "{}", said.stderr);
    assert!(before == tree(&sandbox.path("ball.gyr")));
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
}

#[test]
fn another_scene_is_not_resumed() {
    let sandbox = Sandbox::with_ball();
    sandbox.refused(3, &["run", "ball.toml", "--resume"]);
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    let before = tree(&sandbox.path("ball.gyr"));
    let said = sandbox.refused(2, &["run", "ball.toml", "--resume", "--set", "body.ball.density=2000"]);
    assert!(said.stderr.contains("another scene"), "{}", said.stderr);
    assert!(said.stderr.contains("body.ball.density: 1000.0 there, 2000.0 here"), "{}", said.stderr);
    assert!(said.stderr.contains("it was made without --set"), "{}", said.stderr);
    sandbox.write("other.toml", &BALL.replace("5 cm", "4 cm"));
    sandbox.refused(2, &["run", "other.toml", "-o", "ball.gyr", "--resume"]);
    assert!(before == tree(&sandbox.path("ball.gyr")));
    // No override brings back what the file said.
    sandbox.write("changed.toml", &BALL.replace("1000", "2000"));
    let changed = sandbox.refused(2, &["run", "changed.toml", "-o", "ball.gyr", "--resume"]);
    assert!(changed.stderr.contains("put the scene back as it was"), "{}", changed.stderr);
    // What only the comments tell is the same scene.
    sandbox.write("same.toml", &format!("# a remark\n{BALL}"));
    sandbox.done(&["run", "same.toml", "-o", "ball.gyr", "--resume"]);
}

#[test]
fn first_steps_are_told_beside_the_survey() {
    let sandbox = Sandbox::with_ball();
    let words = sandbox.done(&["check", "collide", "--steps", "20"]).stdout;
    assert!(words.contains("first steps: 20, each resumes to the same bytes"), "{words}");
    let json = sandbox.done(&["check", "collide", "--steps", "20", "--json"]).stdout;
    let steps = &serde_json::from_str::<Value>(&json).unwrap()["steps"];
    assert!(steps["count"] == 20 && steps["difference"].is_null(), "{steps}");
    assert!(steps["changes"]["momentum"].as_f64().unwrap() < 1e-14, "{steps}");
    // On a table momentum is not kept.
    let json = sandbox.done(&["check", "ball.toml", "--steps", "5", "--json"]).stdout;
    assert!(serde_json::from_str::<Value>(&json).unwrap()["steps"]["changes"].is_null(), "{json}");
}

/// A run that is killed between its outcome and its picture leaves the picture of the part before.
#[test]
fn a_finished_recording_gets_the_picture_of_the_whole_run() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml"]);
    let picture = sandbox.path("ball.gyr/overview.svg");
    let whole = std::fs::read(&picture).unwrap();
    std::fs::write(&picture, "<svg/>").unwrap();
    sandbox.done(&["run", "ball.toml", "--resume"]);
    assert!(std::fs::read(&picture).unwrap() == whole);
}
