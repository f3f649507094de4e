//! A recording in memory answers as the one on disk that holds the same rows.

use crate::common::{event, finished, layout, row, time};
use gyration_record::{Attributes, RecordError, Recording, Rows, export};
use std::path::Path;
use std::sync::Arc;
use tempfile::tempdir;

fn rows(count: usize) -> Rows {
    let mut rows = Rows::default();
    for k in 0..count {
        if k % 2 == 0 {
            rows.push_event(event(k / 2));
        }
        rows.push(time(k), row(k));
    }
    rows
}

#[test]
fn rows_in_memory_are_read_and_written_as_those_on_disk() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 10, 4);
    let disk = Recording::open(&path).unwrap();
    let memory = Recording::in_memory(Path::new("run"), &layout(4), Attributes::new(), Arc::new(rows(10))).unwrap();
    for array in disk.arrays().iter().filter(|array| !["body", "col"].contains(&array.name.as_str())) {
        assert_eq!(memory.read(&array.name).unwrap(), disk.read(&array.name).unwrap(), "{}", array.name);
    }
    assert_eq!(memory.read_rows("gradient", 3..9).unwrap(), disk.read_rows("gradient", 3..9).unwrap());
    assert_eq!(memory.column("ball.y").unwrap(), disk.column("ball.y").unwrap());
    assert_eq!(memory.labels("body").unwrap(), disk.labels("body").unwrap());
    assert_eq!(memory.events().unwrap(), disk.events().unwrap());
    assert!(memory.chunks().eq(disk.chunks()));
    let table = |recording: &Recording| {
        let mut bytes = Vec::new();
        export::csv(recording, &mut bytes).unwrap();
        bytes
    };
    assert!(table(&memory) == table(&disk));
    assert!(memory.read_rows("time", 8..11).is_err() && memory.checkpoint().is_err());
}

#[test]
fn rows_that_do_not_fit_their_layout_are_refused() {
    let mut wrong = rows(2);
    wrong.push(time(2), [1.0]);
    let made = Recording::in_memory(Path::new("run"), &layout(4), Attributes::new(), Arc::new(wrong));
    assert!(matches!(made, Err(RecordError::RowLength { expected: 25, .. })), "{made:?}");
}
