//! Bits of a study's folder flip on a disk: what is read then is refused with the file's name, or is what was written.

use crate::common::{BALL, STUDY};
use gyration_study::{DataFrame, Row, Shard, Study, Table, merge};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A study of 120 runs, which are two chunks, with all its rows.
struct Whole {
    folder: TempDir,
    study: Study,
    rows: Vec<Row>,
}

impl Whole {
    fn new() -> Self {
        // In memory where that can be: a test waits for no disk a thousand times.
        let folder = tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap();
        fs::write(folder.path().join("ball.toml"), BALL).unwrap();
        let text = STUDY.replace("repetitions = 10", "repetitions = 20");
        let study = Study::parse("where.toml", &text, folder.path(), &[]).unwrap_or_else(|error| panic!("{error}"));
        let rows = (0..study.runs()).map(|run| study.row(run)).collect();
        Self { folder, study, rows }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("a.study")
    }

    /// Adds all rows but those at the end that are not to be there.
    fn add(&self, table: &mut Table, count: usize) {
        let missing: Vec<u64> = table.missing().filter(|run| *run < count as u64).collect();
        let rows: Vec<Row> = missing.into_iter().map(|run| self.rows[run as usize].clone()).collect();
        table.append(&rows).unwrap();
    }

    /// Goes on with the table to its end, and returns its bytes.
    fn go_on(&self) -> Result<Vec<u8>, String> {
        let told = |error: gyration_study::StudyError| error.to_string();
        let mut table = Table::resume(&self.path(), &self.study, Shard::WHOLE).map_err(told)?;
        self.add(&mut table, self.rows.len());
        assert!(table.finish().map_err(told)?);
        // What is read of the table must be whole, too.
        DataFrame::read(&self.path()).map_err(told)?;
        Ok(fs::read(table.file()).unwrap())
    }

    /// Flips bits of each file that is there, one at a time, and compares what `look` finds.
    fn flip(&self, count: usize, look: &dyn Fn(&Self) -> Result<Vec<u8>, String>) -> (usize, usize) {
        let files = tree(&self.path());
        let expected = look(self).unwrap();
        let (mut refused, mut same) = (0, 0);
        for (name, bytes) in files.iter().filter(|(_, bytes)| !bytes.is_empty()) {
            for bit in (0..count).map(|k| (k * 7919 + 13) * 8 * bytes.len() / (7919 * count) % (8 * bytes.len())) {
                let mut damaged = files.clone();
                damaged.get_mut(name).unwrap()[bit / 8] ^= 1 << (bit % 8);
                lay(&self.path(), &damaged);
                match look(self) {
                    Ok(found) => {
                        assert!(found == expected, "bit {bit} of {}", name.display());
                        same += 1;
                    }
                    Err(words) => {
                        assert!(words.contains(name.to_str().unwrap()), "bit {bit} of {}: {words}", name.display());
                        refused += 1;
                    }
                }
            }
        }
        lay(&self.path(), &files);
        (refused, same)
    }
}

/// All files below a folder, with what is in them.
fn tree(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut open = vec![root.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
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

/// Puts a folder back to these files.
fn lay(root: &Path, files: &BTreeMap<PathBuf, Vec<u8>>) {
    fs::remove_dir_all(root).unwrap();
    for (name, bytes) in files {
        let path = root.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}

#[test]
fn a_flip_in_a_study_that_is_begun_is_refused_or_changes_nothing() {
    let whole = Whole::new();
    let mut table = Table::create(&whole.path(), &whole.study, Shard::WHOLE, false).unwrap();
    whole.add(&mut table, 100);
    drop(table);
    let names: Vec<String> = tree(&whole.path()).keys().map(|name| name.display().to_string()).collect();
    assert_eq!(names, ["lock", "rows/000000.parquet", "rows/_000001.jsonl", "study.json"]);
    let (refused, same) = whole.flip(150, &Whole::go_on);
    println!("{refused} flips refused, {same} changed nothing");
    assert!(refused > 430);
}

#[test]
fn a_flip_in_a_finished_table_is_refused_or_changes_nothing() {
    let whole = Whole::new();
    let mut table = Table::create(&whole.path(), &whole.study, Shard::WHOLE, false).unwrap();
    whole.add(&mut table, 120);
    assert!(table.finish().unwrap());
    drop(table);
    let (refused, _) = whole.flip(300, &Whole::go_on);
    assert!(refused > 580);
}

#[test]
fn a_flip_in_a_shard_is_refused_when_shards_are_joined_or_changes_nothing() {
    let whole = Whole::new();
    for number in [1, 2] {
        let shard = Shard::new(number, 2).unwrap();
        let mut table = Table::create(&whole.path(), &whole.study, shard, false).unwrap();
        whole.add(&mut table, 120);
        assert!(table.finish().unwrap());
    }
    let join = |whole: &Whole| {
        let joined = merge(&whole.path(), &whole.study, true).map_err(|error| error.to_string())?;
        Ok(fs::read(joined).unwrap())
    };
    let (refused, _) = whole.flip(60, &join);
    assert!(refused > 220);
}

/// Tables of earlier versions have no checksums; they are gone on with as they are.
#[test]
fn a_study_without_checksums_is_gone_on_with() {
    let whole = Whole::new();
    let mut table = Table::create(&whole.path(), &whole.study, Shard::WHOLE, false).unwrap();
    whole.add(&mut table, 100);
    drop(table);
    let begun = tree(&whole.path());
    let expected = whole.go_on().unwrap();
    lay(&whole.path(), &begun);
    let (journal, manifest) = (whole.path().join("rows/_000001.jsonl"), whole.path().join("study.json"));
    let text = fs::read_to_string(&journal).unwrap();
    let plain: String = text.lines().map(|line| line.split_once(' ').unwrap().1.to_owned() + "\n").collect();
    fs::write(&journal, plain).unwrap();
    let text = fs::read_to_string(&manifest).unwrap();
    let plain: String =
        text.lines().filter(|line| !line.starts_with("  \"checksum\"")).map(|l| l.to_owned() + "\n").collect();
    assert_ne!(plain, text);
    fs::write(&manifest, plain).unwrap();
    assert!(whole.go_on().unwrap() == expected);
}

/// The disk is waited for now and then, and at the end: not for every row.
#[test]
fn the_disk_is_waited_for_by_the_batch() {
    let whole = Whole::new();
    let mut table = Table::create(&whole.path(), &whole.study, Shard::WHOLE, false).unwrap();
    for row in &whole.rows[..60] {
        table.append(std::slice::from_ref(row)).unwrap();
    }
    table.sync().unwrap();
    let syncs = table.syncs();
    assert!((1..30).contains(&syncs), "{syncs}");
    table.sync().unwrap();
    assert_eq!(table.syncs(), syncs, "nothing was written since");
}

#[cfg(unix)]
#[test]
fn nothing_is_written_through_a_link_or_into_a_pipe_that_lies_in_a_study() {
    let whole = Whole::new();
    let mut table = Table::create(&whole.path(), &whole.study, Shard::WHOLE, false).unwrap();
    whole.add(&mut table, 10);
    drop(table);
    let begun = tree(&whole.path());
    let victim = whole.folder.path().join("victim");
    for name in ["lock", "rows/_000000.jsonl"] {
        let place = whole.path().join(name);
        fs::write(&victim, begun[Path::new(name)].clone()).unwrap();
        fs::remove_file(&place).unwrap();
        std::os::unix::fs::symlink(&victim, &place).unwrap();
        let words = Table::resume(&whole.path(), &whole.study, Shard::WHOLE).unwrap_err().to_string();
        assert!(words.contains(name) && words.contains("it is a link"), "{words}");
        fs::remove_file(&place).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(&place).status().unwrap().success());
        let words = Table::resume(&whole.path(), &whole.study, Shard::WHOLE).unwrap_err().to_string();
        assert!(words.contains(name) && words.contains("it is a pipe"), "{words}");
        fs::remove_file(&place).unwrap();
        lay(&whole.path(), &begun);
        assert_eq!(fs::read(&victim).unwrap(), begun[Path::new(name)]);
    }
}
