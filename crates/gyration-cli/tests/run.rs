//! `gyration run`: names, exit codes, what is printed where, what is left on disk.

use crate::common::{BALL, Said, Sandbox, TIP, assert_same_bytes, tree};
use serde_json::Value;
use std::fs;
use std::process::Stdio;

#[test]
fn run_leaves_a_recording_and_a_picture() {
    let sandbox = Sandbox::with_ball();
    let said = sandbox.done(&["run", "ball.toml"]);
    assert_eq!(said.stdout, "");
    for words in ["completed", "residual", "ball.gyr/overview.svg", "momentum"] {
        assert!(said.stderr.contains(words), "{words}: {}", said.stderr);
    }
    assert!(!said.stderr.contains('\x1b') && !said.stderr.contains('\r'), "no bar and no colours in a pipe");
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
    let svg = fs::read_to_string(sandbox.path("ball.gyr/overview.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("A ball on a table") && svg.contains("completed"));
    let group: Value = serde_json::from_slice(&fs::read(sandbox.path("ball.gyr/zarr.json")).unwrap()).unwrap();
    let attributes = &group["attributes"];
    assert_eq!(attributes["scene"].as_str(), Some(BALL));
    assert_eq!(attributes["outcome"].as_str(), Some("completed"));
    for name in ["resolved", "version", "commit", "tolerances", "statistics"] {
        assert!(!attributes[name].is_null(), "{name}");
    }
}

#[test]
fn names_are_counted_up_unless_given() {
    let sandbox = Sandbox::with_ball();
    let short = ["run", "ball.toml", "--quiet", "--set", "time.end=0.05"];
    for _ in 0..3 {
        let said = sandbox.done(&short);
        assert_eq!(said.stderr, "");
    }
    assert_eq!(sandbox.names(), ["ball-2.gyr", "ball-3.gyr", "ball.gyr", "ball.toml"]);
    assert_same_bytes(&sandbox.path("ball.gyr"), &sandbox.path("ball-2.gyr"));
    let named = [&short[..], &["-o", "ball.gyr"]].concat();
    let said = sandbox.refused(2, &named);
    assert!(said.stderr.contains("--resume") && said.stderr.contains("--force"), "{}", said.stderr);
    sandbox.done(&[&named[..], &["--force", "--set", "body.ball.velocity=[0,0,1]"]].concat());
    let csv = sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "-"]).stdout;
    let first: Vec<&str> = csv.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(first[13..16].iter().map(|x| x.parse().unwrap()).collect::<Vec<f64>>(), [0.0, 0.0, 1.0]);
}

#[test]
fn force_removes_recordings_only() {
    let sandbox = Sandbox::with_ball();
    fs::create_dir(sandbox.path("thesis")).unwrap();
    sandbox.write("thesis/chapter.txt", "precious");
    sandbox.refused(3, &["run", "ball.toml", "-o", "thesis", "--force"]);
    assert_eq!(fs::read_to_string(sandbox.path("thesis/chapter.txt")).unwrap(), "precious");
    sandbox.done(&["run", "ball.toml", "--quiet", "-o", "new.gyr", "--force", "--set", "time.end=0.01"]);
}

#[test]
fn force_keeps_the_old_recording_if_the_new_run_cannot_start() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet", "--set", "time.end=0.05"]);
    let before = tree(&sandbox.path("ball.gyr"));
    // (0.15 m / 1 m)^−400 is beyond the largest number: the start has no finite traction.
    let infinite = "contact.0.repulsion={ alpha = 1, nu = 400, d0 = 1 }";
    for more in [&["--force"][..], &["-o", "new.gyr"]] {
        let said = sandbox.refused(2, &[&["run", "ball.toml", "--set", infinite][..], more].concat());
        assert!(said.stderr.contains("start"), "{}", said.stderr);
    }
    assert!(before == tree(&sandbox.path("ball.gyr")));
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
}

#[test]
fn exit_code_does_not_hang_on_a_reader_of_stdout() {
    let sandbox = Sandbox::with_ball();
    let early = ["run", "ball.toml", "--json", "--set", "solver.max_wall_time=1e-9", "--set", "time.end=60"];
    let resumed = [&early[..], &["--resume"]].concat();
    let whole = ["run", "ball.toml", "--json", "-o", "whole.gyr"];
    for (arguments, code) in [(&early[..], 1), (&resumed, 1), (&whole, 0)] {
        let mut child = sandbox.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let said = Said::from(child.wait_with_output().unwrap());
        assert_eq!(said.code, Some(code), "{arguments:?}: {}", said.stderr);
        assert_eq!(said.stderr.contains("--resume"), code == 1, "{}", said.stderr);
    }
}

#[test]
fn boundary_elements_take_no_longer_than_a_run_may() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "box.toml",
        r#"
        time = { end = 1, sample = 0.5 }
        solver.max_wall_time = "50 ms"
        fluid = { viscosity = 1 }
        [[body]]
        name = "box"
        shape = { box = { size = [1, 2, 3] } }
        density = 1
        inclusion = { triangles = 5000 }
        "#,
    );
    let said = sandbox.refused(1, &["run", "box.toml"]);
    assert!(said.stderr.contains("box.toml:7") && said.stderr.contains("solver.max_wall_time"), "{}", said.stderr);
    assert_eq!(sandbox.names(), ["box.toml"]);
}

#[test]
fn summary_in_json_is_all_there_is_on_stdout() {
    let sandbox = Sandbox::with_ball();
    let said = sandbox.done(&["run", "ball.toml", "--json", "-o", "a.gyr"]);
    assert_eq!(said.stderr, "");
    let summary: Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!(summary["outcome"].as_str(), Some("completed"));
    assert_eq!(summary["recording"].as_str(), Some("a.gyr"));
    assert_eq!(summary["time"].as_f64(), Some(0.6));
    let ledger = &summary["ledger"];
    let number = |name: &str| ledger[name].as_f64().unwrap();
    assert!(number("largest_residual") <= number("allowed_residual"), "{ledger}");
    assert_eq!(ledger["verdict"], "closed");
}

#[test]
fn an_open_ledger_is_told_always() {
    let sandbox = Sandbox::with_ball();
    sandbox.write("tip.toml", TIP);
    for (name, option) in [("a.gyr", "--quiet"), ("b.gyr", "--json")] {
        let said = sandbox.run(&["run", "tip.toml", option, "-o", name]);
        assert_eq!(said.code, Some(1), "{}", said.stderr);
        assert!(said.stderr.contains("warning: the energy balance is open"), "{}", said.stderr);
        let group = fs::read(sandbox.path(name).join("zarr.json")).unwrap();
        let group: Value = serde_json::from_slice(&group).unwrap();
        assert_eq!(group["attributes"]["ledger"], "open");
    }
    assert!(sandbox.run(&["run", "tip.toml"]).stderr.contains("warning: the energy balance is open"));
    let said = sandbox.done(&["run", "ball.toml"]);
    assert!(said.stderr.contains("the balance closes") && !said.stderr.contains("warning"), "{}", said.stderr);
}

#[test]
fn rest_is_a_good_end() {
    let sandbox = Sandbox::with_ball();
    let rest = ["--set", "time.stop_at_rest={ speed = 10.0, hold = 0.01 }"];
    let said = sandbox.done(&[&["run", "ball.toml", "--json"][..], &rest].concat());
    let summary: Value = serde_json::from_str(&said.stdout).unwrap();
    assert!(summary["outcome"]["at_rest"]["time"].as_f64().is_some_and(|time| time < 0.6), "{summary}");
}

#[test]
fn stop_for_physics_tells_body_and_advice() {
    let sandbox = Sandbox::with_ball();
    // ν = 1.5 < 2 does not forbid a sphere to touch, and without damping nothing else does.
    let text = BALL.lines().filter(|line| !line.starts_with("damping")).collect::<Vec<_>>().join("\n");
    sandbox.write("soft.toml", &text);
    let soft = ["run", "soft.toml", "--set", "contact.0.repulsion.nu=1.5", "--set", "contact.0.repulsion.alpha=1e-3"];
    let said = sandbox.run(&soft);
    assert_eq!((said.code, said.stdout.as_str()), (Some(1), ""), "{}", said.stderr);
    assert!(said.stderr.contains("\"ball\"") && said.stderr.contains("\"table\""), "{}", said.stderr);
    assert!(sandbox.path("soft.gyr/overview.svg").exists());
    // It is over: there is nothing to resume.
    let said = sandbox.done(&[&soft[..], &["--resume"]].concat());
    assert!(said.stderr.contains("Nothing was done"), "{}", said.stderr);
}

#[test]
fn malformed_scenes_leave_no_files() {
    let sandbox = Sandbox::new();
    let cases = [
        ("syntax", "[[body".to_owned()),
        ("key", BALL.replace("density", "densty")),
        ("unit", BALL.replace("5 cm", "5 kg")),
        ("support", BALL.replace("support = \"table\"", "support = \"floor\"")),
        ("mesh", BALL.replace("{ sphere = { radius = \"5 cm\" } }", "{ mesh = { file = \"none.stl\", scale = 1 } }")),
        ("overlap", BALL.replace("[0, 0, 0.2]", "[0, 0, 0.01]")),
        ("kind", BALL.replace("density = 1000", "density = 1000\ncontractile = {}")),
    ];
    for (name, text) in &cases {
        let file = format!("{name}.toml");
        sandbox.write(&file, text);
        let said = sandbox.refused(2, &["run", &file]);
        assert!(said.stderr.contains(&format!("{file}:")), "{name}: {}", said.stderr);
    }
    let files: Vec<String> = sandbox.names().into_iter().filter(|name| !name.ends_with(".toml")).collect();
    assert!(files.is_empty(), "{files:?}");
}

#[test]
fn directory_that_cannot_be_written_is_a_fault_of_the_disk() {
    let sandbox = Sandbox::with_ball();
    sandbox.write("file", "");
    let said = sandbox.refused(3, &["run", "ball.toml", "-o", "file/ball.gyr"]);
    assert!(said.stderr.contains("file"), "{}", said.stderr);
}
