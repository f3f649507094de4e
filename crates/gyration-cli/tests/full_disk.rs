//! The disk is full in the middle: the program says so with the file, and goes on once there is room.
//!
//! The disk is a small file system in memory, in a name space of its own; where the system allows none, nothing is
//! tested.

use crate::common::Sandbox;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// What a shell does with the program, as `$gyration`, beside a folder `small` of so many kilobytes, which `grow` makes
/// larger; what it printed, or none where there can be no such folder.
fn beside_a_small_disk(sandbox: &Sandbox, kilobytes: u64, script: &str) -> Option<String> {
    fs::create_dir_all(sandbox.path("small")).unwrap();
    let mount = format!("mount -t tmpfs -o size={kilobytes}k tmpfs small");
    let shell = |script: &str| {
        let mut command = Command::new("unshare");
        command.args(["--mount", "--map-root-user", "sh", "-c", script]);
        command.env("gyration", env!("CARGO_BIN_EXE_gyration")).current_dir(sandbox.path("")).stdin(Stdio::null());
        command.output()
    };
    if !shell(&mount).is_ok_and(|tried| tried.status.success()) {
        println!("no file system can be mounted here: not tested");
        return None;
    }
    let grow = "grow() { mount -o remount,size=256m small; }";
    let said = shell(&format!("{mount}\n{grow}\n{script}")).unwrap();
    Some(String::from_utf8_lossy(&said.stdout).into_owned() + &String::from_utf8_lossy(&said.stderr))
}

fn size(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| if path.is_dir() { size(&path) } else { path.metadata().unwrap().len() }).sum()
}

#[test]
fn a_run_that_fills_the_disk_says_so_and_goes_on_to_the_same_bytes() {
    let sandbox = Sandbox::with_ball();
    let fine = "time.sample=1e-5";
    sandbox.done(&["run", "ball.toml", "-o", "whole.gyr", "--quiet", "--set", fine]);
    // Four chunks; a chunk is beside the one that it replaces for a while.
    let room = size(&sandbox.path("whole.gyr")) * 7 / 10 / 1024;
    let run = format!("$gyration run ball.toml -o small/ball.gyr --quiet --set {fine}");
    let script = format!("{run}; echo code $?; grow; {run} --resume; echo code $?; diff -r whole.gyr small/ball.gyr");
    let Some(said) = beside_a_small_disk(&sandbox, room, &script) else { return };
    assert!(said.starts_with("code 3\ncode 0\n"), "{said}");
    assert!(said.contains("the disk is full") && said.contains("small/ball.gyr/"), "{said}");
    assert!(said.contains("--resume") && !said.contains("differ") && !said.contains("Only in"), "{said}");
}

#[test]
fn a_study_that_fills_the_disk_says_so_and_ends_with_the_same_table() {
    let sandbox = Sandbox::with_ball();
    let study = "scene = \"ball.toml\"\nrepetitions = 150\n[parameter.height]\nkey = \"body.ball.position.2\"\n\
                 uniform = { from = \"8 cm\", to = 0.2 }\n[keep]\nlowest = { minimum = \"ball.gap\" }\n";
    sandbox.write("low.toml", study);
    sandbox.done(&["study", "low.toml", "-o", "whole.study", "--quiet"]);
    let run = "$gyration study low.toml -o small/low.study --quiet";
    let script = format!(
        "{run}; echo code $?; grow; {run} --resume || {run}; echo code $?; \
         cmp whole.study/table.parquet small/low.study/table.parquet && echo same"
    );
    let mut full = 0;
    // Whatever file it is that finds no room: manifest, journal, chunk or table.
    for kilobytes in (8..64).step_by(8) {
        let Some(said) = beside_a_small_disk(&sandbox, kilobytes, &script) else { return };
        assert!(said.contains("code 0\n") && said.contains("same\n"), "{kilobytes} kB: {said}");
        if said.starts_with("code 3") {
            full += 1;
            assert!(said.contains("the disk is full") && said.contains("small/low.study"), "{kilobytes} kB: {said}");
        }
    }
    assert!(full > 2, "the disk was full {full} times");
}
