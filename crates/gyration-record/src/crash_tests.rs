//! The power fails before every single file operation, and in the middle of every file written.
//!
//! Whatever is left must read up to the last flush that returned, and must resume to the same bytes as a run that was
//! never interrupted. The fuse counts operations; once blown, nothing reaches the disk any more.

use crate::disk::Disk;
use crate::{
    ArraySpec, Attributes, Dimension, Event, FixedArray, Layout, Ragged, RaggedArray, RecordError, Recording, Writer,
};
use serde_json::json;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Lets so many operations pass, then none.
#[derive(Debug, Clone)]
pub(crate) struct Fuse(Rc<Cell<usize>>);

impl Fuse {
    pub(crate) fn blows(&self) -> bool {
        let left = self.0.get();
        self.0.set(left.saturating_sub(1));
        left == 0
    }
}

fn disk(operations: usize) -> (Disk, Rc<Cell<usize>>) {
    let left = Rc::new(Cell::new(operations));
    (Disk { fuse: Some(Fuse(left.clone())), ..Disk::default() }, left)
}

const ROWS: usize = 23;
const FLUSH_EVERY: usize = 5;
const EVENTS_PER_ROW: usize = 13; // 299 events: more than a chunk of them

fn ragged() -> Ragged {
    let array = |name: &str, dims: Vec<Dimension>, codes: Option<&[&str]>| RaggedArray {
        spec: ArraySpec { name: name.into(), dims, ..ArraySpec::default() },
        codes: codes.map(|codes| codes.iter().map(|code| (*code).to_owned()).collect()),
    };
    let arrays = vec![
        array("first", Vec::new(), Some(&[])),
        array("force", vec![Dimension::new("row", 3)], None),
        array("kind", Vec::new(), Some(&["contact", "spring"])),
    ];
    Ragged { name: "pairs".into(), arrays, chunk_entries: 16 }
}

/// From none to three entries of a sample.
fn entries(k: usize) -> Vec<f64> {
    (0..k % 4).flat_map(|n| [n as f64, 0.1 * k as f64, f64::NAN, n as f64 + 0.5, (n % 2) as f64]).collect()
}

fn layout() -> Layout {
    let array = |name: &str, dims: &[(&str, usize)]| ArraySpec {
        name: name.into(),
        dims: dims.iter().map(|(name, size)| Dimension::new(*name, *size)).collect(),
        units: "m".into(),
        ..ArraySpec::default()
    };
    Layout {
        arrays: vec![array("position", &[("body", 2), ("col", 3)]), array("energy", &[])],
        fixed: vec![FixedArray { spec: array("mass", &[("body", 2)]), values: vec![1.0, 2.0] }],
        labels: vec![("body".into(), vec!["die".into(), "ball".into()])],
        event_kinds: vec!["touch".into(), "part".into()],
        ragged: Some(ragged()),
        chunk_rows: 4,
        ..Layout::default()
    }
}

fn map(value: serde_json::Value) -> Attributes {
    value.as_object().unwrap().clone()
}

fn row(k: usize) -> Vec<f64> {
    (0..7).map(|i| (k as f64 + 0.1 * i as f64).sin()).collect()
}

fn event(n: usize) -> Event {
    Event { time: 0.01 * n as f64, kind: n % 2, body: [None, Some(0), Some(1)][n % 3] }
}

fn checkpoint(rows: usize) -> Vec<u8> {
    rows.to_le_bytes().to_vec()
}

/// Goes on to the end; `flushed` tells how many rows the last flush that returned has promised.
fn go_on(mut writer: Writer, flushed: &Cell<usize>) -> Result<(), RecordError> {
    for k in writer.rows()..ROWS {
        for n in 0..EVENTS_PER_ROW {
            writer.append_event(event(k * EVENTS_PER_ROW + n))?;
        }
        writer.append_entries(&entries(k))?;
        writer.append(0.1 * k as f64, &row(k))?;
        if k % FLUSH_EVERY == 0 {
            writer.flush(&checkpoint(k + 1))?;
            flushed.set(k + 1);
        }
    }
    writer.finish(map(json!({"outcome": "completed", "steps": ROWS})), &checkpoint(ROWS))?;
    flushed.set(ROWS);
    Ok(())
}

fn run(disk: Disk, path: &Path, flushed: &Cell<usize>) -> Result<(), RecordError> {
    let writer = Writer::create_on(disk, path, &layout(), map(json!({"scene": "title = \"x\"\n"})))?;
    go_on(writer, flushed)
}

/// Starts anew if there is nothing, does nothing if all is done, else resumes.
fn recover(disk: Disk, path: &Path) -> Result<(), RecordError> {
    if !path.exists() {
        return run(disk, path, &Cell::new(0));
    }
    let recording = Recording::open(path)?;
    let is_complete = recording.attributes().contains_key("outcome");
    if is_complete && !recording.is_ahead_of_its_checkpoint()? {
        return Ok(());
    }
    let resumed = Writer::resume_on(disk, path, &["outcome", "steps"])?;
    assert_eq!(resumed.checkpoint, checkpoint(resumed.writer.rows()));
    go_on(resumed.writer, &Cell::new(0))
}

/// All files below a directory, with what is in them.
fn tree(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut open = vec![root.to_path_buf()];
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(&directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                files.insert(path.strip_prefix(root).unwrap().to_path_buf(), fs::read(&path).unwrap());
            }
        }
    }
    files
}

fn assert_reads_to(path: &Path, flushed: usize, when: &str) {
    if !path.exists() {
        assert_eq!(flushed, 0, "{when}: flushed, but there is nothing");
        return;
    }
    let recording = Recording::open(path).unwrap();
    assert!(recording.rows() >= flushed.max(1), "{when}: {} of {flushed} rows", recording.rows());
    let rows = recording.rows();
    let position = recording.read("position").unwrap();
    let energy = recording.read("energy").unwrap();
    assert_eq!(position.shape, [rows, 2, 3]);
    assert_eq!(recording.times().unwrap(), (0..rows).map(|k| 0.1 * k as f64).collect::<Vec<_>>());
    for k in 0..rows {
        assert_eq!(position.data[6 * k..][..6], row(k)[..6], "{when}: row {k}");
        assert_eq!(energy.data[k], row(k)[6]);
    }
    let events = recording.events().unwrap();
    assert!(events.len() >= flushed * EVENTS_PER_ROW);
    assert!(events.iter().enumerate().all(|(n, found)| *found == event(n)), "{when}: events");
    let [first, kind] = ["pairs/first", "pairs/kind"].map(|name| recording.read(name).unwrap().data);
    let force = recording.read("pairs/force").unwrap().data;
    for k in 0..rows {
        let found = recording.entries(k).unwrap().flat_map(|n| {
            let [x, y, z] = [0, 1, 2].map(|i| force[3 * n + i]);
            [first[n], x, y, z, kind[n]]
        });
        let same = |a: f64, b: f64| a == b || (a.is_nan() && b.is_nan());
        assert!(found.zip(entries(k)).all(|(a, b)| same(a, b)), "{when}: entries of {k}");
        assert_eq!(recording.entries(k).unwrap().len(), k % 4, "{when}");
    }
}

/// A scratch folder, in memory where there is one: thousands of files are replaced.
fn scratch() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

/// The tree of an uninterrupted run, and how many operations it took.
fn reference(root: &Path) -> (BTreeMap<PathBuf, Vec<u8>>, usize) {
    let path = root.join("reference.gyr");
    let (disk, left) = disk(usize::MAX);
    run(disk, &path, &Cell::new(0)).unwrap();
    assert_eq!(fs::read_dir(root).unwrap().count(), 1, "nothing is left beside the recording");
    (tree(&path), usize::MAX - left.get())
}

#[test]
fn a_crash_at_any_operation_reads_to_the_last_flush_and_resumes_to_the_same_bytes() {
    let root = scratch();
    let (expected, operations) = reference(root.path());
    println!("{operations} operations, {} files", expected.len());
    for crash in 0..operations {
        let when = format!("crash before operation {crash}");
        let path = root.path().join("run.gyr");
        let flushed = Cell::new(0);
        assert!(run(disk(crash).0, &path, &flushed).is_err(), "{when}");
        assert_reads_to(&path, flushed.get(), &when);
        recover(Disk::default(), &path).unwrap_or_else(|e| panic!("{when}: {e}"));
        assert!(tree(&path) == expected, "{when}: other bytes");
        crate::remove(&path).unwrap();
    }
}

#[test]
fn a_crash_while_resuming_from_a_crash_loses_nothing_either() {
    let root = scratch();
    let (expected, operations) = reference(root.path());
    // Every 29th first crash, with every second one: the first falls on all kinds of operations.
    for first in (0..operations).step_by(29) {
        let path = root.path().join("run.gyr");
        let flushed = Cell::new(0);
        assert!(run(disk(first).0, &path, &flushed).is_err());
        let mut second = 0;
        loop {
            let when = format!("crash before operations {first} and then {second}");
            let (fused, left) = disk(second);
            let resumed = recover(fused, &path);
            assert_reads_to(&path, flushed.get(), &when);
            match resumed {
                Ok(()) => break,
                Err(e) => assert_eq!(left.get(), 0, "{when}: fails without a crash: {e}"),
            }
            second += 1;
        }
        assert!(tree(&path) == expected, "crash {first}: other bytes");
        crate::remove(&path).unwrap();
    }
}

#[test]
fn a_failing_disk_is_named_and_stops_the_writer() {
    let root = scratch();
    let path = root.path().join("run.gyr");
    let (disk, left) = disk(usize::MAX);
    let mut writer = Writer::create_on(disk, &path, &layout(), Attributes::new()).unwrap();
    writer.append(0.0, &row(0)).unwrap();
    writer.flush(b"0").unwrap();
    left.set(0);
    writer.append(0.1, &row(1)).unwrap();
    let error = writer.flush(b"1").unwrap_err();
    assert!(matches!(&error, RecordError::Io { path, .. } if path.ends_with("time/c.0.part")), "{error}");
    left.set(usize::MAX);
    assert!(matches!(writer.flush(b"1"), Err(RecordError::Stopped { .. })));
    assert!(matches!(writer.append(0.1, &row(1)), Err(RecordError::Stopped { .. })));
    drop(writer);
    assert_eq!(Recording::open(&path).unwrap().rows(), 1);
}
