//! The files that a scene names, behind a recording: tables and meshes may change while it stands.
//!
//! A recording has the key, the name and a checksum of each ([`FileSum`]). One without that attribute, or of a scene
//! that names no file, is compared with nothing.

use gyration_record::Attributes;
use gyration_scene::{FileSum, Scene};
use serde::Deserialize;
use std::collections::BTreeSet;

/// The attribute in which they stand.
pub(crate) const FILES: &str = "files";

/// The files of a recording in which the scene has found other numbers, each once, as the recording has it. Those that
/// the scene does not name are left out.
pub(crate) fn changed_files(recording: &Attributes, scene: &Scene) -> Vec<FileSum> {
    let recorded = recording.get(FILES).and_then(|files| Vec::<FileSum>::deserialize(files).ok()).unwrap_or_default();
    let found = scene.file_sums();
    let names: BTreeSet<&str> = found.iter().map(|found| &*found.file).collect();
    let sums: BTreeSet<(&str, &str)> = found.iter().map(|found| (&*found.file, &*found.sum)).collect();
    let is_other = |one: &FileSum| names.contains(&*one.file) && !sums.contains(&(&*one.file, &*one.sum));
    let mut told = BTreeSet::new();
    recorded.into_iter().filter(|one| is_other(one) && told.insert(one.file.clone())).collect()
}
