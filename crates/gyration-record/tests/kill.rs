//! A writing process that is killed again and again leaves, in the end, the bytes of one that never was.
//!
//! The child is this program, called with the path in an environment variable. Moments of the kills come from a fixed
//! sequence; where in the work they fall depends on the machine, and nothing is asserted about that.

use crate::common::{attributes, checkpoint, layout, row, time, tree, write_to};
use gyration_record::{Attributes, Recording, Writer};
use serde_json::json;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

const PATH: &str = "GYRATION_RECORD_KILL_PATH";
const ROWS: usize = 1200;

#[test]
#[ignore = "the child of killed_runs_resume_to_the_same_bytes: does nothing by itself"]
fn child() {
    if let Some(path) = std::env::var_os(PATH) {
        write(Path::new(&path));
    }
}

/// Writes the recording, from the beginning or from where it stands.
fn write(path: &Path) {
    let mut writer = if path.exists() {
        let resumed = Writer::resume(path).unwrap();
        assert_eq!(resumed.checkpoint, checkpoint(resumed.writer.rows()));
        resumed.writer
    } else {
        Writer::create(path, &layout(64), Attributes::new()).unwrap()
    };
    write_to(&mut writer, ROWS, 10).unwrap();
    writer.finish(attributes(json!({"outcome": "completed"})), &checkpoint(ROWS)).unwrap();
}

/// What is there reads, whole; returns its rows.
fn rows_that_read(path: &Path) -> usize {
    if !path.exists() {
        return 0;
    }
    let recording = Recording::open(path).unwrap();
    let rows = recording.rows();
    let position = recording.read("position").unwrap().data;
    assert!((0..rows).all(|k| position[6 * k..][..6] == row(k)[..6]));
    assert_eq!(recording.times().unwrap(), (0..rows).map(time).collect::<Vec<_>>());
    assert!(recording.events().unwrap().len() >= rows / 2);
    rows
}

#[test]
fn killed_runs_resume_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (path, whole) = (folder.path().join("killed.gyr"), folder.path().join("whole.gyr"));
    write(&whole);
    let (mut kills, mut moved, mut random) = (0, 0, 12345_u64);
    loop {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "kill::child", "--ignored", "--quiet"])
            .env(PATH, &path)
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        // Microseconds up to 0.13 s at first, longer after each kill, so that any machine comes to an end.
        let micros = (random >> 47) * (10 + kills) / 10;
        std::thread::sleep(Duration::from_micros(micros));
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success());
            break;
        }
        child.kill().unwrap();
        let killed = !child.wait().unwrap().success();
        let rows = rows_that_read(&path);
        kills += u64::from(killed);
        moved += u64::from(rows > 0 && rows < ROWS);
    }
    println!("{kills} kills, {moved} of them within the run");
    assert_eq!(rows_that_read(&path), ROWS);
    assert!(tree(&path) == tree(&whole));
}
