//! Recordings, read without the library that writes them: in what two of one scene differ, and the sum of one.
//!
//! Arrays and their sizes stand in the group's `zarr.json`; chunks are plain little-endian numbers, cut along the first
//! dimension only, so that the files of an array, one behind the other and without their checksums, are the array. Left
//! out are the checkpoint, which belongs to one version of the program, the codecs, and the attributes that tell where
//! the numbers come from.

use crate::json::Json;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::Path;

/// Attributes that two versions may have otherwise: what the text of a scene means stands in `resolved`.
const PROVENANCE: [&str; 4] = ["version", "commit", "scene", "record_checksum"];
/// Bytes of the checksum behind a chunk.
const CHECKSUM: usize = 4;

/// What is not the same in two recordings: one line each.
pub fn differences(old: &Path, new: &Path) -> Result<Vec<String>, String> {
    let (groups, none) = ([group(old)?, group(new)?], BTreeMap::new());
    let [attributes, arrays] = [&["attributes"][..], &["consolidated_metadata", "metadata"]].map(|path| {
        groups.each_ref().map(|group| {
            path.iter().try_fold(group, |value, key| value.get(key)).and_then(Json::entries).unwrap_or(&none)
        })
    });
    let mut lines = Vec::new();
    for name in union(attributes).into_iter().filter(|name| !PROVENANCE.contains(name)) {
        match attributes.map(|attributes| attributes.get(name)) {
            [Some(_), None] => lines.push(format!("attribute {name}: only in the old one")),
            [None, Some(_)] => lines.push(format!("attribute {name}: only in the new one")),
            [old, new] if old != new => lines.push(format!("attribute {name}: differs")),
            _ => {}
        }
    }
    for name in union(arrays) {
        lines.extend(match arrays.map(|arrays| arrays.get(name)) {
            [Some(_), None] => Some(format!("{name}: only in the old one")),
            [None, Some(_)] => Some(format!("{name}: only in the new one")),
            [Some(before), Some(after)] => {
                let old = contents(&old.join(name), is_checked(before))?;
                let new = contents(&new.join(name), is_checked(after))?;
                array_difference([before, after], &old, &new).map(|told| format!("{name}: {told}"))
            }
            [None, None] => None,
        });
    }
    Ok(lines)
}

/// The hash of its rows, as the program tells it.
pub fn row_hash(recording: &Path) -> Result<String, String> {
    let group = group(recording)?;
    let hash = ["attributes", "row_hash"].iter().try_fold(&group, |value, key| value.get(key)).and_then(Json::text);
    hash.map(str::to_owned).ok_or_else(|| format!("{}: no hash of the rows", recording.display()))
}

/// The sum of all arrays of a recording: FNV-1a of 64 bits, over names and numbers.
pub fn sum(recording: &Path) -> Result<u64, String> {
    const START: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x100_0000_01b3;
    let group = group(recording)?;
    let arrays = ["consolidated_metadata", "metadata"].iter().try_fold(&group, |value, key| value.get(key));
    let arrays = arrays.and_then(Json::entries).ok_or_else(|| format!("{}: no arrays", recording.display()))?;
    let mut sum = START;
    for (name, metadata) in arrays {
        let contents = contents(&recording.join(name), is_checked(metadata))?;
        let add = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(PRIME);
        sum = name.as_bytes().iter().chain(&contents).fold(sum, add);
    }
    Ok(sum)
}

fn group(folder: &Path) -> Result<Json, String> {
    let path = folder.join("zarr.json");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Json::parse(&text).ok_or_else(|| format!("{}: no JSON", path.display()))
}

fn union([old, new]: [&BTreeMap<String, Json>; 2]) -> BTreeSet<&str> {
    old.keys().chain(new.keys()).map(String::as_str).collect()
}

/// Whether checksums stand behind the chunks of an array.
fn is_checked(metadata: &Json) -> bool {
    let Some(Json::List(codecs)) = metadata.get("codecs") else { return false };
    codecs.iter().any(|codec| codec.get("name").and_then(Json::text) == Some("crc32c"))
}

/// The chunks of an array, one behind the other.
fn contents(folder: &Path, is_checked: bool) -> Result<Vec<u8>, String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut chunks = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(told)? {
        let entry = entry.map_err(told)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if let Some(key) = name.strip_prefix('c') {
            let numbers: Vec<usize> = key.split('.').filter_map(|number| number.parse().ok()).collect();
            chunks.push((numbers, entry.path()));
        }
    }
    chunks.sort();
    let mut bytes = Vec::new();
    for (_, path) in chunks {
        bytes.extend(std::fs::read(path).map_err(told)?);
        bytes.truncate(bytes.len().saturating_sub(if is_checked { CHECKSUM } else { 0 }));
    }
    Ok(bytes)
}

/// In what an array differs from its older self; none if it does not.
fn array_difference(metadata: [&Json; 2], old: &[u8], new: &[u8]) -> Option<String> {
    let [before, after] = metadata.map(|metadata| metadata.get("data_type").and_then(Json::text));
    let mut told = Vec::new();
    let described = |metadata: &Json| {
        let entries = metadata.entries().into_iter().flatten();
        entries.filter(|(key, _)| *key != "codecs").map(|(key, value)| (key.clone(), value.clone())).collect::<Vec<_>>()
    };
    if described(metadata[0]) != described(metadata[1]) {
        told.push("the metadata differ".to_owned());
    }
    if old != new {
        told.push(match (before, after) {
            (Some("float64"), Some("float64")) => {
                numbers(old, new, |bytes: [u8; 8]| f64::from_le_bytes(bytes)).to_string()
            }
            (Some("int32"), Some("int32")) => {
                numbers(old, new, |bytes: [u8; 4]| i32::from_le_bytes(bytes).into()).to_string()
            }
            _ => "the bytes differ".to_owned(),
        });
    }
    (!told.is_empty()).then(|| told.join("; "))
}

/// How far two arrays of numbers are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Apart {
    /// Entries that are not the same bytes, those that only one array has among them.
    entries: usize,
    /// Entries of the longer array.
    of: usize,
    /// Largest |a − b|.
    absolute: f64,
    /// Largest |a − b| / max(|a|, |b|).
    relative: f64,
}

impl fmt::Display for Apart {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { entries, of, absolute, relative } = self;
        write!(formatter, "{entries} of {of} entries, by {absolute:.2e} at most, relatively {relative:.2e}")
    }
}

fn numbers<const N: usize>(old: &[u8], new: &[u8], number: impl Fn([u8; N]) -> f64) -> Apart {
    let (old, new) = (old.as_chunks::<N>().0, new.as_chunks::<N>().0);
    let of = old.len().max(new.len());
    let mut apart = Apart { entries: old.len().abs_diff(new.len()), of, absolute: 0.0, relative: 0.0 };
    for (a, b) in old.iter().zip(new).filter(|(a, b)| a != b) {
        let (a, b) = (number(*a), number(*b));
        let distance = (a - b).abs();
        apart.entries += 1;
        // `max` passes over what is no number.
        apart.absolute = apart.absolute.max(distance);
        apart.relative = apart.relative.max(distance / a.abs().max(b.abs()));
    }
    apart
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::PathBuf;

    fn bytes(numbers: &[f64]) -> Vec<u8> {
        numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
    }

    /// A recording of one array in two chunks.
    fn recording(name: &str, numbers: [&[f64]; 2], attributes: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("xtask-compare-{}-{name}", std::process::id()));
        let metadata = r#"{"gap": {"data_type": "float64", "shape": [3]}}"#;
        fs::create_dir_all(folder.join("gap")).unwrap();
        for (index, numbers) in numbers.iter().enumerate() {
            fs::write(folder.join(format!("gap/c.{}", 9 + index)), bytes(numbers)).unwrap();
        }
        let group = format!(r#"{{"attributes": {attributes}, "consolidated_metadata": {{"metadata": {metadata}}}}}"#);
        fs::write(folder.join("zarr.json"), group).unwrap();
        folder
    }

    #[test]
    fn numbers_that_differ_are_told_with_how_much() {
        let old = recording("old", [&[1.0, 2.0], &[3.0]], r#"{"commit": "a", "events": {"apex": 2}}"#);
        let new = recording("new", [&[1.0, 2.5], &[3.0]], r#"{"commit": "b", "events": {"apex": 3}}"#);
        let same = differences(&old, &old);
        let found = differences(&old, &new);
        fs::remove_dir_all(old).unwrap();
        fs::remove_dir_all(new).unwrap();
        assert_eq!(same, Ok(Vec::new()));
        let gap = "gap: 1 of 3 entries, by 5.00e-1 at most, relatively 2.00e-1";
        assert_eq!(found, Ok(vec!["attribute events: differs".to_owned(), gap.to_owned()]));
    }

    #[test]
    fn a_sign_of_zero_is_a_difference_and_so_is_a_missing_end() {
        let f64s = |old: &[f64], new: &[f64]| numbers(&bytes(old), &bytes(new), f64::from_le_bytes);
        assert_eq!(f64s(&[0.0], &[-0.0]).entries, 1);
        assert_eq!(f64s(&[1.0, 2.0], &[1.0]), Apart { entries: 1, of: 2, absolute: 0.0, relative: 0.0 });
        assert_eq!(f64s(&[f64::NAN, 1.0], &[1.0, 2.0]), Apart { entries: 2, of: 2, absolute: 1.0, relative: 0.5 });
    }

    #[test]
    fn a_checksum_behind_a_chunk_is_no_difference() {
        let old = recording("unchecked", [&[1.0, 2.0], &[3.0]], "{}");
        let new = recording("checked", [&[1.0, 2.0], &[3.0]], r#"{"record_checksum": "0123abcd"}"#);
        let group = fs::read_to_string(new.join("zarr.json")).unwrap();
        let codecs = r#""codecs": [{"name": "crc32c"}], "shape""#;
        fs::write(new.join("zarr.json"), group.replace("\"shape\"", codecs)).unwrap();
        for (chunk, numbers) in [("gap/c.9", &[1.0, 2.0][..]), ("gap/c.10", &[3.0])] {
            fs::write(new.join(chunk), [bytes(numbers), vec![7; 4]].concat()).unwrap();
        }
        let found = differences(&old, &new);
        fs::remove_dir_all(old).unwrap();
        fs::remove_dir_all(new).unwrap();
        assert_eq!(found, Ok(Vec::new()));
    }

    #[test]
    fn the_sum_is_of_the_numbers_however_they_are_cut() {
        let recordings = [
            recording("sum", [&[1.0, 2.0], &[3.0]], r#"{"commit": "a"}"#),
            recording("sum-cut", [&[1.0], &[2.0, 3.0]], r#"{"commit": "b"}"#),
            recording("sum-other", [&[1.0, 2.0], &[3.0_f64.next_up()]], r#"{"commit": "a"}"#),
        ];
        let [whole, cut, other] = recordings.map(|folder| {
            let found = sum(&folder);
            fs::remove_dir_all(folder).unwrap();
            found.unwrap()
        });
        assert_eq!(whole, cut);
        assert_ne!(whole, other);
    }

    #[test]
    fn chunks_follow_one_another_by_number_not_by_name() {
        let folder = recording("order", [&[1.0], &[2.0]], "{}");
        let found = contents(&folder.join("gap"), false);
        fs::remove_dir_all(folder).unwrap();
        assert_eq!(found, Ok(bytes(&[1.0, 2.0])));
    }
}
