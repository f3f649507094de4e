//! What the reader of recordings owes whatever lies in a folder: arrays as large as they say, or errors in words; and
//! nothing is written beside it.
//!
//! An input damages one file of a sound recording: its first byte says which, its second how. The rest takes the place
//! of the file, or is a list of changes (two bytes of a place, one of a value), or tells where the file is cut.

use crate::common::{finished, tree};
use gyration_record::{Recording, Writer, export};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// A sound recording and a folder to damage it in.
pub struct Sound {
    folder: PathBuf,
    files: Files,
}

impl Sound {
    /// Writes it into a folder.
    pub fn new(folder: &Path) -> Self {
        let sound = folder.join("sound.gyr");
        finished(&sound, 6, 4);
        let files = tree(&sound);
        done(fs::remove_dir_all(&sound));
        Self { folder: folder.to_path_buf(), files }
    }

    /// Damages it as the input says, reads it, resumes it.
    pub fn check(&self, input: &[u8]) {
        let [which, how, rest @ ..] = input else { return };
        let mut files = self.files.clone();
        let count = files.len();
        if let Some((_, bytes)) = files.iter_mut().nth(usize::from(*which) % count) {
            *bytes = damaged(bytes, *how, rest);
        }
        let path = self.folder.join("run.gyr");
        let _ = fs::remove_dir_all(&path);
        for (name, bytes) in &files {
            let file = path.join(name);
            done(fs::create_dir_all(file.parent().unwrap_or(&path)));
            done(fs::write(file, bytes));
        }
        read(&path);
        if let Err(error) = Writer::resume(&path) {
            assert!(!error.to_string().is_empty());
        }
        let beside: Vec<_> = fs::read_dir(&self.folder).into_iter().flatten().flatten().collect();
        assert!(beside.len() == 1, "something is written beside the recording: {beside:?}");
    }
}

fn damaged(bytes: &[u8], how: u8, rest: &[u8]) -> Vec<u8> {
    match how % 3 {
        0 => rest.to_vec(),
        1 => {
            let mut bytes = bytes.to_vec();
            let length = bytes.len().max(1);
            for [high, low, value] in rest.as_chunks::<3>().0 {
                if let Some(byte) = bytes.get_mut(usize::from(u16::from_be_bytes([*high, *low])) % length) {
                    *byte = *value;
                }
            }
            bytes
        }
        _ => {
            let place = rest.iter().fold(0, |place, byte| 256 * (place % 256) + usize::from(*byte));
            bytes[..place % (bytes.len() + 1)].to_vec()
        }
    }
}

/// Reads everything that there is.
fn read(path: &Path) {
    let recording = match Recording::open(path) {
        Ok(recording) => recording,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    for array in recording.arrays() {
        match recording.read(&array.name) {
            Ok(read) => assert_eq!(read.shape.iter().product::<usize>(), read.data.len(), "{}", array.name),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
    for column in recording.columns() {
        if let Ok(numbers) = recording.column(column) {
            assert_eq!(numbers.len(), recording.rows());
        }
    }
    let _ = (recording.events(), recording.labels("body"), recording.times());
    let _ = export::csv(&recording, &mut Vec::new());
}

fn done(result: std::io::Result<()>) {
    result.unwrap_or_else(|error| panic!("{error}"));
}
