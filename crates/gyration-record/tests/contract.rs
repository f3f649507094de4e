//! What is written is read, exported and protected as the contract says.

use crate::common::{attributes, checkpoint, crowd, event, finished, layout, row, time, tree, write_to};
use gyration_record::{Attributes, Event, RecordError, Recording, Writer, export, remove};
use serde_json::{Value, json};
use std::fs;
use tempfile::tempdir;

#[test]
fn what_was_appended_is_read_whole_by_rows_and_by_column() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 10, 4);
    let recording = Recording::open(&path).unwrap();
    assert_eq!(recording.rows(), 10);
    assert_eq!(recording.times().unwrap(), (0..10).map(time).collect::<Vec<_>>());
    let position = recording.read("position").unwrap();
    assert_eq!(position.shape, [10, 2, 3]);
    // From the middle of one chunk over a whole one into the third.
    let part = recording.read_rows("gradient", 3..9).unwrap();
    assert_eq!(part.shape, [6, 2, 3, 3]);
    for k in 3..9 {
        assert_eq!(part.data[(k - 3) * 18..][..18], row(k)[6..24]);
    }
    let ball_y = (0..10).map(|k| row(k)[4]).collect::<Vec<_>>();
    assert_eq!(recording.column("ball.y").unwrap(), ball_y);
    assert_eq!(recording.column("t").unwrap(), recording.times().unwrap());
    assert_eq!(recording.column("energy.kinetic").unwrap(), recording.read("energy_kinetic").unwrap().data);
    assert_eq!(recording.read("mass").unwrap().data, [0.5, 0.25]);
    assert_eq!(recording.labels("body").unwrap().unwrap(), ["die", "ball"]);
    assert_eq!(recording.labels("row").unwrap(), None);
    assert_eq!(recording.event_kinds(), ["touch", "part", "rest"]);
    assert_eq!(recording.events().unwrap(), (0..5).map(event).collect::<Vec<_>>());
    assert_eq!(recording.attributes()["outcome"], "completed");
    assert_eq!(recording.attributes()["scene"], "title = \"käse\"\n");
    assert_eq!(recording.array("position").unwrap().units, "m");
    assert_eq!(recording.array("position").unwrap().description, "position of the bodies");
    assert_eq!(recording.chunks().collect::<Vec<_>>(), [0..4, 4..8, 8..10]);
}

/// 256 events a body in a chunk, of the next power of two of bodies, and 65,536 at most: a crowd leaves few files.
#[test]
fn chunks_of_events_grow_with_the_bodies_up_to_a_limit() {
    let folder = tempdir().unwrap();
    for (bodies, rows) in [(1, 256), (2, 512), (3, 1024), (256, 65_536), (10_000, 65_536)] {
        let path = folder.path().join(format!("{bodies}.gyr"));
        let mut writer = Writer::create(&path, &crowd(bodies), Attributes::new()).unwrap();
        writer.append(0.0, &vec![0.0; bodies]).unwrap();
        for n in 0..=rows {
            writer.append_event(Event { time: n as f64, kind: 0, body: Some(n % bodies) }).unwrap();
        }
        writer.flush(b"state").unwrap();
        // The one that is too many for a chunk begins the next.
        let chunk = |index: usize| path.join(format!("event_time/c.{index}")).exists();
        assert_eq!([0, 1, 2].map(chunk), [true, true, false], "{bodies} bodies");
        assert_eq!(Recording::open(&path).unwrap().events().unwrap().len(), rows + 1);
    }
}

#[test]
fn names_and_rows_that_are_not_there_are_told() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 3, 4);
    let recording = Recording::open(&path).unwrap();
    assert!(matches!(recording.read("speed"), Err(RecordError::NoSuchArray { name }) if name == "speed"));
    assert!(matches!(recording.read("body"), Err(RecordError::NoSuchArray { .. })));
    assert!(matches!(recording.column("die.w"), Err(RecordError::NoSuchColumn { name }) if name == "die.w"));
    assert!(matches!(recording.read_rows("time", 1..4), Err(RecordError::NoSuchRows { to: 4, rows: 3, .. })));
}

#[test]
fn the_recording_appears_at_the_first_flush_with_its_first_row() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
    writer.append(0.0, &row(0)).unwrap();
    assert!(matches!(Recording::open(&path), Err(RecordError::Missing { .. })));
    assert!(matches!(Writer::create(&path, &layout(4), Attributes::new()), Err(RecordError::Locked { .. })));
    writer.flush(b"state").unwrap();
    assert_eq!(Recording::open(&path).unwrap().read_rows("position", 0..1).unwrap().data, row(0)[..6]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn where_flushes_fall_does_not_change_the_bytes() {
    let folder = tempdir().unwrap();
    let trees = [1, 2, 5, 1000].map(|flush_every| {
        let path = folder.path().join(format!("{flush_every}.gyr"));
        let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
        write_to(&mut writer, 18, flush_every).unwrap();
        writer.finish(Attributes::new(), &checkpoint(18)).unwrap();
        tree(&path)
    });
    assert!(trees.iter().all(|other| *other == trees[0]));
}

#[test]
fn a_second_writer_is_refused_and_a_dead_one_is_not() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
    write_to(&mut writer, 1, 1).unwrap();
    assert!(matches!(Writer::resume(&path), Err(RecordError::Locked { path: p }) if p == path));
    assert!(matches!(remove(&path), Err(RecordError::Locked { .. })));
    assert!(matches!(Writer::create(&path, &layout(4), Attributes::new()), Err(RecordError::AlreadyExists { .. })));
    drop(writer);
    assert_eq!(Writer::resume(&path).unwrap().checkpoint, checkpoint(1));
}

#[test]
fn a_finished_recording_can_be_continued_with_other_attributes() {
    let folder = tempdir().unwrap();
    let (path, whole) = (folder.path().join("run.gyr"), folder.path().join("whole.gyr"));
    finished(&whole, 20, 4);
    finished(&path, 9, 4);
    let mut resumed = Writer::resume(&path).unwrap();
    assert_eq!(Recording::open(&path).unwrap().attributes()["outcome"], "completed");
    resumed.writer.patch_attributes(attributes(json!({"outcome": null}))).unwrap();
    resumed.writer.flush(&checkpoint(9)).unwrap();
    assert_eq!(Recording::open(&path).unwrap().attributes().get("outcome"), None);
    write_to(&mut resumed.writer, 20, 3).unwrap();
    resumed.writer.finish(attributes(json!({"outcome": "completed"})), &checkpoint(20)).unwrap();
    assert!(tree(&path) == tree(&whole));
}

#[test]
fn resuming_cuts_off_all_that_lies_beyond_the_checkpoint() {
    let folder = tempdir().unwrap();
    // In the middle of a chunk of four, and at its end.
    for kept in [6, 8] {
        let (path, whole) = (folder.path().join("run.gyr"), folder.path().join("whole.gyr"));
        for (path, rows) in [(&whole, kept), (&path, 19)] {
            let mut writer = Writer::create(path, &layout(4), Attributes::new()).unwrap();
            write_to(&mut writer, kept, usize::MAX).unwrap();
            writer.flush(&checkpoint(kept)).unwrap();
            // Full chunks beyond the flush reach the disk, but nothing counts them.
            write_to(&mut writer, rows, usize::MAX).unwrap();
        }
        assert!(path.join("time/c.3").exists() && !whole.join("time/c.3").exists());
        for left in ["zarr.json.part", "time/c.4.part", "state/checkpoint.part"] {
            fs::write(path.join(left), "half").unwrap();
        }
        for path in [&whole, &path] {
            let resumed = Writer::resume(path).unwrap();
            assert_eq!(resumed.writer.rows(), kept);
            resumed.writer.finish(Attributes::new(), &checkpoint(kept)).unwrap();
        }
        assert!(tree(&path) == tree(&whole), "{kept} rows kept");
        remove(&path).unwrap();
        remove(&whole).unwrap();
    }
}

#[test]
fn rows_of_the_wrong_length_unknown_events_and_reserved_attributes_change_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let reserved = || attributes(json!({"record_format": 2}));
    assert!(matches!(Writer::create(&path, &layout(4), reserved()), Err(RecordError::Layout { .. })));
    let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
    assert!(matches!(writer.append(0.0, &[1.0]), Err(RecordError::RowLength { expected: 25, found: 1 })));
    let unknown = Event { time: 0.0, kind: 3, body: None };
    assert!(matches!(writer.append_event(unknown), Err(RecordError::Layout { .. })));
    assert!(matches!(writer.patch_attributes(reserved()), Err(RecordError::Layout { .. })));
    write_to(&mut writer, 2, 1).unwrap();
    assert_eq!(Recording::open(&path).unwrap().rows(), 2);
}

#[test]
fn damage_is_told_with_the_file() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 6, 4);
    let chunk = path.join("position/c.1.0.0");
    fs::write(&chunk, [0; 7]).unwrap();
    let told = |error: &RecordError| matches!(error, RecordError::Truncated { path, expected: 196, found: 7 } if *path == chunk);
    assert!(told(&Recording::open(&path).unwrap().read("position").unwrap_err()));
    assert!(told(&Writer::resume(&path).unwrap_err()));
    fs::write(path.join("state/checkpoint"), b"GYRCKPT1").unwrap();
    assert!(matches!(Writer::resume(&path), Err(RecordError::Corrupt { path: p, .. }) if p.ends_with("checkpoint")));
    let text = fs::read_to_string(path.join("zarr.json")).unwrap();
    fs::write(path.join("zarr.json"), text.replace("\"record_format\": 2", "\"record_format\": 3")).unwrap();
    assert!(matches!(Recording::open(&path), Err(RecordError::Version { found: 3, supported: 2, .. })));
    fs::write(path.join("zarr.json"), &text[..text.len() / 2]).unwrap();
    assert!(matches!(Recording::open(&path), Err(RecordError::NotARecording { .. })));
}

#[test]
fn names_that_no_writer_gives_are_refused_by_whoever_opens_a_recording() {
    let folder = tempdir().unwrap();
    let (path, victim) = (folder.path().join("run.gyr"), folder.path().join("victim"));
    finished(&path, 6, 4);
    fs::create_dir(&victim).unwrap();
    fs::write(victim.join("c.1.0.0"), [0; 192]).unwrap();
    fs::write(victim.join("c.7.0.0"), "years of work").unwrap();
    let (text, before) = (fs::read_to_string(path.join("zarr.json")).unwrap(), tree(&victim));
    let refused = |from: &str, to: &str, named: &str| {
        fs::write(path.join("zarr.json"), text.replace(from, to)).unwrap();
        let told =
            [Recording::open(&path).unwrap_err(), Writer::resume(&path).unwrap_err(), remove(&path).unwrap_err()];
        for words in told.map(|error| error.to_string()) {
            assert!(words.contains("run.gyr") && words.contains(named) && words.contains("allowed"), "{words}");
            assert!(!words.contains('\u{1b}'), "{words}");
        }
    };
    refused("\"position\"", "\"../victim\"", "the array `../victim`");
    refused("\"mass\"", "\"../../etc\"", "the array `../../etc`");
    refused("\"mass\"", "\"state\"", "the array `state`");
    refused("\"mass\"", "\"\\\"><script>\"", "the array `\\\"><script>`");
    refused("\"row\"", "\"/tmp\"", "the dimension `/tmp`");
    refused("touch part rest", "touch <b> rest", "the kind of event `<b>`");
    refused("[\"die\"]", "[\"die\\u001b\"]", "the column `die\\u{1b}`");
    refused("\"x = ", "\"x, = ", "the column `x,`");
    assert_eq!(tree(&victim), before);
    fs::write(path.join("zarr.json"), text).unwrap();
    Writer::resume(&path).unwrap();
}

#[cfg(unix)]
#[test]
fn nothing_is_written_or_removed_through_a_link_that_lies_in_a_recording() {
    let folder = tempdir().unwrap();
    let (path, aside) = (folder.path().join("run.gyr"), folder.path().join("aside"));
    for name in ["position", "state", "position/c.1.0.0", "state/lock", "zarr.json.part"] {
        finished(&path, 6, 4);
        let (place, target) = (path.join(name), aside.join(name.replace('/', "-")));
        fs::create_dir_all(&aside).unwrap();
        if place.exists() {
            fs::rename(&place, &target).unwrap();
        } else {
            fs::write(&target, "years of work").unwrap();
        }
        let before = tree(&aside);
        std::os::unix::fs::symlink(&target, &place).unwrap();
        let words = Writer::resume(&path).unwrap_err().to_string();
        assert!(words.contains(name) && words.contains("is a link"), "{words}");
        assert_eq!(tree(&aside), before, "{name}");
        fs::remove_dir_all(&path).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_that_lies_in_a_recording_is_not_waited_for() {
    let folder = tempdir().unwrap();
    for name in ["position/c.1.0.0", "state/lock", "zarr.json.part"] {
        let path = folder.path().join("run.gyr");
        finished(&path, 6, 4);
        let _ = fs::remove_file(path.join(name));
        assert!(std::process::Command::new("mkfifo").arg(path.join(name)).status().unwrap().success());
        let words = Writer::resume(&path).unwrap_err().to_string();
        assert!(words.contains(name) && words.contains("it is a pipe"), "{words}");
        fs::remove_dir_all(&path).unwrap();
    }
}

#[test]
fn only_recordings_are_removed() {
    let folder = tempdir().unwrap();
    let (path, other) = (folder.path().join("run.gyr"), folder.path().join("other"));
    fs::create_dir(&other).unwrap();
    fs::write(other.join("thesis.tex"), "years of work").unwrap();
    assert!(matches!(remove(&path), Err(RecordError::Missing { .. })));
    assert!(matches!(remove(&other), Err(RecordError::NotARecording { .. })));
    assert!(matches!(remove(&other.join("thesis.tex")), Err(RecordError::NotARecording { .. })));
    fs::write(other.join("zarr.json"), "{\"zarr_format\": 3, \"node_type\": \"group\", \"attributes\": {}}").unwrap();
    assert!(matches!(remove(&other), Err(RecordError::NotARecording { .. })));
    finished(&path, 2, 4);
    remove(&path).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    // A folder that holds nothing is in nobody's way.
    fs::create_dir(&path).unwrap();
    remove(&path).unwrap();
    assert!(!path.exists());
    assert!(other.join("thesis.tex").exists());
    // A directory in the way of a new recording that is not ours stays too.
    fs::rename(&other, folder.path().join("run.gyr.part")).unwrap();
    assert!(Writer::create(&path, &layout(4), Attributes::new()).is_err());
    assert!(folder.path().join("run.gyr.part/thesis.tex").exists());
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let error = Writer::create(&file.join("run.gyr"), &layout(4), Attributes::new()).unwrap_err();
    assert!(error.to_string().contains("run.gyr"), "{error}");
}

#[test]
fn csv_numbers_read_back_exactly_in_the_order_of_the_layout() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
    let hard = [0.1 + 0.2, 1.0 / 3.0, 5e-324, f64::MAX, -1e-7, 1e22, -0.0, f64::NAN, f64::INFINITY];
    for (k, number) in hard.into_iter().enumerate() {
        let mut numbers = row(k);
        numbers[0] = number;
        writer.append(time(k), &numbers).unwrap();
    }
    writer.finish(Attributes::new(), b"").unwrap();
    let mut bytes = Vec::new();
    export::csv(&Recording::open(&path).unwrap(), &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next().unwrap(), "t,ball.x,ball.y,ball.z,die.x,die.y,die.z,energy.kinetic");
    for (k, number) in hard.into_iter().enumerate() {
        let line = lines.next().unwrap().split(',').map(|text| text.parse::<f64>().unwrap()).collect::<Vec<_>>();
        let r = row(k);
        let expected = [time(k), r[3], r[4], r[5], number, r[1], r[2], r[24]];
        assert_eq!(line.len(), 8);
        assert!(
            line.iter()
                .zip(expected)
                .all(|(found, e)| found.to_bits() == e.to_bits() || (e.is_nan() && found.is_nan()))
        );
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn equal_recordings_give_equal_npz_files() {
    let folder = tempdir().unwrap();
    let files = ["a", "b"].map(|name| {
        let path = folder.path().join(name);
        finished(&path, 10, 4);
        let file = path.with_extension("npz");
        export::npz(&Recording::open(&path).unwrap(), &file).unwrap();
        fs::read(file).unwrap()
    });
    assert!(files[0] == files[1]);
    assert!(files[0].starts_with(b"PK"));
}

#[test]
fn metadata_of_arrays_and_of_the_group_agree() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 10, 4);
    let json = |path| serde_json::from_slice::<Value>(&fs::read(path).unwrap()).unwrap();
    let group = json(path.join("zarr.json"));
    let arrays = group["consolidated_metadata"]["metadata"].as_object().unwrap();
    assert_eq!(arrays.len(), 10);
    for (name, array) in arrays {
        assert_eq!(json(path.join(name).join("zarr.json")), *array, "{name}");
    }
}

#[test]
fn one_that_takes_the_place_of_an_open_one_is_not_read_for_it() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 3, 4);
    let first = Recording::open(&path).unwrap();
    let times = first.times().unwrap();
    fs::rename(&path, folder.path().join("aside.gyr")).unwrap();
    finished(&path, 3, 4);
    // What was read before is known, and nothing else of it.
    assert_eq!(first.times().unwrap(), times);
    let is_replaced = |error| matches!(error, RecordError::Replaced { .. });
    assert!(is_replaced(first.read("position").unwrap_err()));
    assert!(is_replaced(first.labels("body").unwrap_err()) && is_replaced(first.checkpoint().unwrap_err()));
    assert!(Recording::open(&path).unwrap().read("position").is_ok());
}
