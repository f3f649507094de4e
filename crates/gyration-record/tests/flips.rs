//! Bits of a recording flip on a disk: what is read then is refused with the file's name, or is what was written.
//!
//! Three kinds of files are not read by this program: the metadata of each array, which stand in the group's file
//! again, those of the group `state`, and the lock.

use crate::common::{checkpoint, finished, layout, tree, write_to};
use gyration_record::{Attributes, Recording, Writer, export};
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// In memory where that can be: what is tested is what is read, not how long a disk takes.
fn scratch() -> TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

/// Everything that can be read of a recording, as text.
fn all(path: &Path) -> Result<String, String> {
    let told = |error: gyration_record::RecordError| error.to_string();
    let recording = Recording::open(path).map_err(told)?;
    let mut text = format!("{:?}\n{:?}\n", recording.arrays(), recording.columns().collect::<Vec<_>>());
    // A name that is damaged and that nobody asks for takes nothing away; the checksum is the one such name.
    let damaged = |name: &str| name.starts_with("record_") && !["format", "arrays", "columns"].contains(&&name[7..]);
    for (name, value) in recording.attributes().iter().filter(|(name, _)| !damaged(name)) {
        text.push_str(&format!("{name} = {value}\n"));
    }
    for array in recording.arrays() {
        match recording.labels(&array.name).map_err(told)? {
            Some(labels) => text.push_str(&format!("{labels:?}\n")),
            None => text.push_str(&format!("{:?}\n", recording.read(&array.name).map_err(told)?)),
        }
    }
    let mut csv = Vec::new();
    export::csv(&recording, &mut csv).map_err(told)?;
    Ok(text + &format!("{:?} {:?}", recording.events().map_err(told)?, recording.checkpoint().map_err(told)?))
}

/// So many bits of a file of this length, the same ones in every run of the test.
fn some_bits(name: &str, length: usize, count: usize) -> Vec<usize> {
    let mut state = name.bytes().fold(1_u64, |state, byte| state.wrapping_mul(31).wrapping_add(byte.into()));
    let mut next = || {
        // Constants of Knuth's MMIX generator.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 16) as usize
    };
    if length == 0 { Vec::new() } else { (0..count).map(|_| next() % (8 * length)).collect() }
}

/// Flips bits of each file, one at a time; `look` tells what it finds, whole or refused.
fn flip(path: &Path, count: usize, look: &dyn Fn() -> Result<String, String>) -> (usize, usize) {
    let expected = look().unwrap();
    let (mut refused, mut same) = (0, 0);
    for (name, bytes) in tree(path) {
        let (file, shown) = (path.join(&name), name.display().to_string());
        for bit in some_bits(&shown, bytes.len(), count) {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            fs::write(&file, flipped).unwrap();
            match look() {
                Ok(found) => {
                    assert!(found == expected, "bit {bit} of {shown} changed what is read");
                    same += 1;
                }
                Err(words) => {
                    let named = words.contains(&shown) || shown == "zarr.json" && words.contains("run.gyr");
                    assert!(named, "bit {bit} of {shown}: {words}");
                    refused += 1;
                }
            }
        }
        fs::write(&file, &bytes).unwrap();
    }
    (refused, same)
}

#[test]
fn a_flip_in_any_file_of_a_recording_is_refused_or_changes_nothing() {
    let folder = scratch();
    let path = folder.path().join("run.gyr");
    finished(&path, 10, 4);
    let unread = |name: &Path| name.ends_with("zarr.json") && name != Path::new("zarr.json");
    let files = tree(&path);
    let (refused, same) = flip(&path, 150, &|| all(&path));
    println!("{refused} flips refused, {same} changed nothing");
    let unread = files.iter().filter(|(name, bytes)| unread(name) && !bytes.is_empty()).count();
    assert!(same <= 150 * unread + 60, "{same} of {} passed in silence", refused + same);
    assert!(refused > 1500);
}

#[test]
fn a_flip_before_a_resumption_is_refused_or_ends_in_the_same_bytes() {
    let folder = scratch();
    let (path, work) = (folder.path().join("begun.gyr"), folder.path().join("run.gyr"));
    let mut writer = Writer::create(&path, &layout(4), Attributes::new()).unwrap();
    write_to(&mut writer, 7, usize::MAX).unwrap();
    writer.flush(&checkpoint(7)).unwrap();
    write_to(&mut writer, 10, usize::MAX).unwrap();
    drop(writer);
    let begun = tree(&path);
    let lay = |damage: Option<(&Path, usize)>| {
        let _ = fs::remove_dir_all(&work);
        for (name, bytes) in &begun {
            let file = work.join(name);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            let mut bytes = bytes.clone();
            if let Some((_, bit)) = damage.filter(|(damaged, _)| damaged == name) {
                bytes[bit / 8] ^= 1 << (bit % 8);
            }
            fs::write(file, bytes).unwrap();
        }
    };
    let go_on = || -> Result<_, gyration_record::RecordError> {
        let mut resumed = Writer::resume(&work)?;
        write_to(&mut resumed.writer, 20, 3)?;
        resumed.writer.finish(Attributes::new(), &checkpoint(20))?;
        Ok(())
    };
    lay(None);
    go_on().unwrap();
    let expected = all(&work).unwrap();
    for (name, bytes) in &begun {
        for bit in some_bits(&name.display().to_string(), bytes.len(), 6) {
            lay(Some((name, bit)));
            let found = match go_on() {
                // What is not needed to go on is still refused when it is read.
                Ok(()) => all(&work),
                Err(error) => Err(error.to_string()),
            };
            let shown = name.display().to_string();
            match found {
                Ok(found) => assert!(found == expected, "bit {bit} of {shown}"),
                Err(words) => assert!(words.contains(&shown) || words.contains("run.gyr"), "{shown}: {words}"),
            }
        }
    }
}

/// What is gone on with ends up in a recording that looks whole: fixed arrays, labels and chunks long full included.
#[test]
fn a_flip_in_any_chunk_is_refused_before_a_recording_is_gone_on_with() {
    let folder = scratch();
    let path = folder.path().join("run.gyr");
    finished(&path, 10, 4);
    let files = tree(&path);
    let chunks = files.iter().filter(|(name, _)| name.file_name().unwrap().to_string_lossy().starts_with("c."));
    let mut count = 0;
    for (name, bytes) in chunks {
        let mut flipped = bytes.clone();
        flipped[bytes.len() / 2] ^= 4;
        fs::write(path.join(name), &flipped).unwrap();
        let words = Writer::resume(&path).unwrap_err().to_string();
        assert!(words.contains(&name.display().to_string()) && words.contains("checksum"), "{words}");
        fs::write(path.join(name), bytes).unwrap();
        count += 1;
    }
    // Ten rows in chunks of four, of three arrays and the time; a fixed array, two lists of labels, the events.
    assert!(count >= 3 * 4 + 3, "{count}");
    assert!(tree(&path) == files, "what is refused is left as it is");
    Writer::resume(&path).unwrap();
}

/// Recordings of earlier versions have no checksums; they are read and gone on with as they are.
#[test]
fn a_recording_without_checksums_is_read_and_resumed() {
    let folder = scratch();
    let (path, whole) = (folder.path().join("run.gyr"), folder.path().join("whole.gyr"));
    finished(&path, 10, 4);
    finished(&whole, 20, 4);
    let file = path.join("zarr.json");
    let mut group: Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
    assert!(group["attributes"]["record_checksum"].take().is_string());
    group["attributes"].as_object_mut().unwrap().remove("record_checksum");
    for array in group["consolidated_metadata"]["metadata"].as_object_mut().unwrap().values_mut() {
        assert_eq!(array["codecs"].as_array_mut().unwrap().pop().unwrap(), serde_json::json!({"name": "crc32c"}));
    }
    fs::write(&file, serde_json::to_vec_pretty(&group).unwrap()).unwrap();
    for (name, bytes) in tree(&path) {
        if name.file_name().unwrap().to_string_lossy().starts_with("c.") {
            fs::write(path.join(name), &bytes[..bytes.len() - 4]).unwrap();
        }
    }
    let mut resumed = Writer::resume(&path).unwrap();
    write_to(&mut resumed.writer, 20, 3).unwrap();
    resumed.writer.finish(Attributes::new(), &checkpoint(20)).unwrap();
    let read = |path: &Path| Recording::open(path).unwrap().read("position").unwrap();
    assert_eq!(read(&path), read(&whole));
    assert_eq!(fs::metadata(path.join("time/c.0")).unwrap().len(), 32);
}
