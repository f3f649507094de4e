//! A small recording that the system tests write: two bodies, one fixed array, labels, events, columns.
//!
//! Every number follows from its place, so that a reader in any language can check it.

#![allow(dead_code, reason = "each test uses some of it")]
use gyration_record::{ArraySpec, Attributes, Dimension, Event, FixedArray, Layout, RecordError, Writer};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

pub const ROW_LEN: usize = 2 * 3 + 2 * 9 + 1;

pub fn layout(chunk_rows: usize) -> Layout {
    let dim = |name: &str, size| Dimension::new(name, size);
    let (body, row, col) = (dim("body", 2), dim("row", 3), dim("col", 3));
    let array = |name: &str, dims: &[Dimension], units: &str, columns: &[&str]| ArraySpec {
        name: name.into(),
        dims: dims.to_vec(),
        units: units.into(),
        description: format!("{name} of the bodies"),
        columns: columns.iter().map(|name| name.to_string()).collect(),
    };
    let position = ["die.x", "die.y", "die.z", "ball.x", "ball.y", "ball.z"];
    let mass = array("mass", std::slice::from_ref(&body), "kg", &[]);
    Layout {
        arrays: vec![
            array("position", &[body.clone(), col.clone()], "m", &position),
            array("gradient", &[body, row, col], "1", &[]),
            array("energy_kinetic", &[], "J", &["energy.kinetic"]),
        ],
        fixed: vec![FixedArray { spec: mass, values: vec![0.5, 0.25] }],
        labels: vec![
            ("body".into(), ["die", "ball"].map(String::from).into()),
            ("col".into(), ["x", "y", "z"].map(String::from).into()),
        ],
        event_kinds: ["touch", "part", "rest"].map(String::from).into(),
        csv_order: ["ball.x", "ball.y", "ball.z", "die.x", "die.y", "die.z", "energy.kinetic"].map(String::from).into(),
        ragged: None,
        chunk_rows,
    }
}

/// A number of each of many bodies, and events.
pub fn crowd(bodies: usize) -> Layout {
    let speed = ArraySpec {
        name: "speed".into(),
        dims: vec![Dimension::new("body", bodies)],
        units: "m/s".into(),
        description: "speed of the bodies".into(),
        columns: Vec::new(),
    };
    Layout {
        arrays: vec![speed],
        labels: vec![("body".into(), (0..bodies).map(|k| format!("b{k}")).collect())],
        fixed: Vec::new(),
        csv_order: Vec::new(),
        ..layout(1)
    }
}

pub fn attributes(json: serde_json::Value) -> Attributes {
    json.as_object().unwrap().clone()
}

/// The time of row k: a number that most decimals miss.
pub fn time(k: usize) -> f64 {
    k as f64 * 0.1
}

/// Row k: its i-th number is k + i/32, exactly.
pub fn row(k: usize) -> Vec<f64> {
    (0..ROW_LEN).map(|i| k as f64 + i as f64 / 32.0).collect()
}

pub fn event(n: usize) -> Event {
    Event { time: n as f64 / 8.0, kind: n % 3, body: [None, Some(0), Some(1)][n % 3] }
}

/// Appends rows up to `rows`, an event every other one, with a flush every `flush_every`.
pub fn write_to(writer: &mut Writer, rows: usize, flush_every: usize) -> Result<(), RecordError> {
    for k in writer.rows()..rows {
        if k % 2 == 0 {
            writer.append_event(event(k / 2))?;
        }
        writer.append(time(k), &row(k))?;
        if k % flush_every == 0 {
            writer.flush(&checkpoint(k + 1))?;
        }
    }
    Ok(())
}

pub fn checkpoint(rows: usize) -> Vec<u8> {
    (rows as u64).to_le_bytes().to_vec()
}

/// A finished recording of so many rows.
pub fn finished(path: &Path, rows: usize, chunk_rows: usize) {
    let start = attributes(serde_json::json!({"scene": "title = \"käse\"\n", "rtol": 1e-8}));
    let mut writer = Writer::create(path, &layout(chunk_rows), start).unwrap();
    write_to(&mut writer, rows, 7).unwrap();
    writer.finish(attributes(serde_json::json!({"outcome": "completed"})), &checkpoint(rows)).unwrap();
}

/// All files below a directory, with what is in them.
pub fn tree(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
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
