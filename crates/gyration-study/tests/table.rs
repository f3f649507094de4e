//! The table of a study has the same bytes whoever makes it, in whatever order, however often it is interrupted.

use crate::common::{self, complete, sandbox, study};
use gyration_study::{DataFrame, Row, Shard, Study, StudyError, Table, Value, merge};
use std::fs;
use std::path::Path;

#[test]
fn a_file_that_only_a_later_run_names_belongs_to_the_study() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let corner = "0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n";
    let mesh = |name: &str, scale: f64| {
        let number = |word: &str| word.parse::<f64>().unwrap() * scale;
        let vertices: String =
            corner.lines().map(|line| format!("v {:?}\n", line.split(' ').map(number).collect::<Vec<_>>())).collect();
        let vertices = vertices.replace(['[', ']', ','], "");
        fs::write(folder.join(name), format!("{vertices}f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")).unwrap();
    };
    let fingerprint = |values: &str| {
        let text = format!("scene = \"ball.toml\"\n[parameter.shape]\nkey = \"body.ball.shape\"\nvalues = {values}\n");
        Study::parse("s.toml", &text, folder, &[]).unwrap_or_else(|error| panic!("{error}")).fingerprint().to_owned()
    };
    let values = "[{ mesh = { file = \"a.obj\" } }, { mesh = { file = \"b.obj\" } }]";
    mesh("a.obj", 1.0);
    mesh("b.obj", 2.0);
    let before = fingerprint(values);
    assert_eq!(before, fingerprint(values));
    mesh("b.obj", 3.0);
    assert_ne!(before, fingerprint(values));
}

#[test]
fn a_table_of_places_belongs_to_the_study() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    fs::write(folder.join("balls.toml"), format!("{}copies = {{ places = \"places.csv\" }}\n", common::BALL)).unwrap();
    let text = "scene = \"balls.toml\"\n[parameter.density]\nkey = \"body.ball.density\"\nvalues = [500, 1000]\n";
    let fingerprint = |places: &str| {
        fs::write(folder.join("places.csv"), places).unwrap();
        Study::parse("s.toml", text, folder, &[]).unwrap_or_else(|error| panic!("{error}")).fingerprint().to_owned()
    };
    let before = fingerprint("x,y,z\n0,0,0\n1,0,0\n");
    assert_eq!(before, fingerprint("x,y,z\n0,0,0\n1,0,0\n"));
    assert_ne!(before, fingerprint("x,y,z\n0,0,0\n2,0,0\n"));
}

#[test]
fn replacing_a_table_leaves_shards_and_other_files_alone() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let study = study(folder);
    let path = folder.join("a.study");
    drop(Table::create(&path, &study, Shard::WHOLE, false).unwrap());
    fs::write(path.join("notes.txt"), "dear").unwrap();
    drop(Table::create(&path, &study, Shard::WHOLE, true).unwrap());
    assert_eq!(fs::read(path.join("notes.txt")).unwrap(), b"dear");
    let path = folder.join("b.study");
    let shard = Table::create(&path, &study, Shard::new(1, 3).unwrap(), false).unwrap();
    for replace in [false, true] {
        let error = Table::create(&path, &study, Shard::WHOLE, replace).unwrap_err();
        assert!(matches!(error, StudyError::Shards { .. }) && error.to_string().contains("merge"), "{error}");
    }
    assert!(matches!(Table::resume(&path, &study, Shard::WHOLE), Err(StudyError::Shards { .. })));
    assert!(shard.folder().join("study.json").is_file());
}

#[test]
fn a_writer_that_was_killed_before_it_had_begun_is_in_nobodys_way() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let study = study(folder);
    let path = folder.join("begun.study");
    drop(Table::create(&path, &study, Shard::WHOLE, false).unwrap());
    fs::rename(path.join("study.json"), path.join("_study.json.tmp")).unwrap();
    assert!(matches!(Table::resume(&path, &study, Shard::WHOLE), Err(StudyError::NoTable { .. })));
    let mut table = Table::create(&path, &study, Shard::WHOLE, false).unwrap();
    complete(&study, &mut table, 1);
    assert!(fs::read(table.file()).unwrap() == reference(folder));
}

#[test]
fn damage_is_found_and_a_line_that_stands_twice_counts_once() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let expected = reference(folder);
    let study = study(folder);
    // A table that has lost its end.
    let one = folder.join("one.study/table.parquet");
    fs::write(&one, &expected[..expected.len() / 2]).unwrap();
    let error = Table::resume(&folder.join("one.study"), &study, Shard::WHOLE).unwrap_err();
    assert!(error.to_string().contains("fix: move that file away"), "{error}");
    fs::remove_file(&one).unwrap();
    let mut table = Table::resume(&folder.join("one.study"), &study, Shard::WHOLE).unwrap();
    complete(&study, &mut table, 2);
    assert!(fs::read(&one).unwrap() == expected);
    // A journal with a line twice.
    let path = folder.join("twice.study");
    let mut table = Table::create(&path, &study, Shard::WHOLE, false).unwrap();
    table.append(&[study.row(0), study.row(1)]).unwrap();
    drop(table);
    let journal = path.join("rows/_000000.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    fs::write(&journal, text.clone() + text.lines().next().unwrap() + "\n").unwrap();
    let mut table = Table::resume(&path, &study, Shard::WHOLE).unwrap();
    complete(&study, &mut table, 1);
    assert!(fs::read(table.file()).unwrap() == expected);
}

/// Written by one thread, in order.
fn reference(folder: &Path) -> Vec<u8> {
    let study = study(folder);
    let mut table = Table::create(&folder.join("one.study"), &study, Shard::WHOLE, false).unwrap();
    complete(&study, &mut table, 1);
    fs::read(table.file()).unwrap()
}

#[test]
fn bytes_are_the_same_for_any_number_of_threads_and_shards() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let expected = reference(folder);
    let study = study(folder);
    for threads in [2, 3] {
        let mut table = Table::create(&folder.join(format!("{threads}.study")), &study, Shard::WHOLE, false).unwrap();
        complete(&study, &mut table, threads);
        assert!(fs::read(table.file()).unwrap() == expected, "{threads} threads");
    }
    let path = folder.join("shards.study");
    for number in [2, 3, 1] {
        let error = merge(&path, &study, false).unwrap_err();
        assert!(matches!(error, StudyError::Shards { .. }), "{error}");
        let mut table = Table::create(&path, &study, Shard::new(number, 3).unwrap(), false).unwrap();
        complete(&study, &mut table, 2);
    }
    let frame = DataFrame::read(&path).unwrap();
    assert_eq!(frame.rows() as u64, study.runs());
    let joined = merge(&path, &study, false).unwrap();
    assert!(fs::read(joined).unwrap() == expected, "three shards");
    assert!(merge(&path, &study, false).unwrap_err().to_string().contains("joined already"));
}

#[test]
fn rows_in_any_order_and_twice_make_the_same_table() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let expected = reference(folder);
    let study = study(folder);
    let mut table = Table::create(&folder.join("any.study"), &study, Shard::WHOLE, false).unwrap();
    let mut rows: Vec<Row> = table.missing().map(|run| study.row(run)).collect();
    rows.reverse();
    rows.rotate_left(17);
    for rows in rows.chunks(7) {
        table.append(rows).unwrap();
        table.append(&rows[..rows.len() / 2]).unwrap();
    }
    assert_eq!(table.missing().count(), 0);
    assert!(table.finish().unwrap());
    assert!(fs::read(table.file()).unwrap() == expected);
}

#[test]
fn a_table_that_was_torn_anywhere_goes_on_to_the_same_bytes() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let expected = reference(folder);
    let study = study(folder);
    let rows: Vec<Row> = (0..study.runs()).map(|run| study.row(run)).collect();
    let path = folder.join("torn.study");
    let journal = path.join("rows/_000000.jsonl");
    // Every length of the last of a few lines, and some whole ones.
    for (made, cut) in (0..260).map(|cut| (5, cut)).chain([(0, 0), (1, 0), (59, 0), (60, 0)]) {
        let mut table = Table::create(&path, &study, Shard::WHOLE, true).unwrap();
        table.append(&rows[..made]).unwrap();
        drop(table);
        if let Ok(bytes) = fs::read(&journal) {
            fs::write(&journal, &bytes[..bytes.len().saturating_sub(cut)]).unwrap();
        }
        fs::write(path.join("rows/_000000.parquet.tmp"), b"PAR1 half").unwrap();
        fs::write(path.join("_table.parquet.tmp"), b"PAR1 half").unwrap();
        let mut table = Table::resume(&path, &study, Shard::WHOLE).unwrap();
        let missing: Vec<u64> = table.missing().collect();
        assert!(missing.len() >= rows.len() - made);
        assert!(cut > 0 || missing.len() == rows.len() - made);
        missing.iter().try_for_each(|run| table.append(&rows[*run as usize..=*run as usize])).unwrap();
        assert!(table.finish().unwrap());
        assert!(fs::read(table.file()).unwrap() == expected, "{made} rows, {cut} bytes cut");
        drop(table);
        // Resumed once more, it is as it was.
        let table = Table::resume(&path, &study, Shard::WHOLE).unwrap();
        assert!(table.is_complete() && table.missing().count() == 0);
    }
}

#[test]
fn tables_of_other_studies_and_other_writers_are_refused() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let study = study(folder);
    let path = folder.join("x.study");
    assert!(matches!(Table::resume(&path, &study, Shard::WHOLE), Err(StudyError::NoTable { .. })));
    let table = Table::create(&path, &study, Shard::WHOLE, false).unwrap();
    assert!(matches!(Table::resume(&path, &study, Shard::WHOLE), Err(StudyError::Locked { .. })));
    assert!(matches!(Table::create(&path, &study, Shard::WHOLE, false), Err(StudyError::Exists { .. })));
    assert!(matches!(Table::create(&path, &study, Shard::WHOLE, true), Err(StudyError::Locked { .. })));
    drop(table);
    for (change, told) in [
        ("seed=8", "\n  seed: 7.0 there, 8.0 here\n  fix: it was made without --set; "),
        ("repetitions=11", "\n  repetitions: 10.0 there, 11.0 here\n  fix: "),
        ("keep.end.last=\"ball.x\"", "\n  keep.end.last: \"ball.z\" there, \"ball.x\" here\n  fix: "),
        ("parameter.height.uniform.to=0.3", "\n  parameter.height.uniform.to: 0.2 there, 0.3 here\n  fix: "),
    ] {
        let other = gyration_study::Study::parse("where.toml", common::STUDY, folder, &[change.to_owned()]).unwrap();
        let error = Table::resume(&path, &other, Shard::WHOLE).unwrap_err();
        assert!(matches!(&error, StudyError::OtherStudy { .. }), "{change}: {error}");
        assert!(error.to_string().contains(told), "{error}");
    }
    // Its scene is another one: the table says how it was made.
    let made = ["seed=8".to_owned()];
    let seeded = gyration_study::Study::parse("where.toml", common::STUDY, folder, &made).unwrap();
    drop(Table::create(&folder.join("y.study"), &seeded, Shard::WHOLE, false).unwrap());
    fs::write(folder.join("ball.toml"), common::BALL.replace("density = 1000", "density = 900")).unwrap();
    let error = Table::resume(&folder.join("y.study"), &common::study(folder), Shard::WHOLE).unwrap_err().to_string();
    assert!(error.contains("\n  scene.body.ball.density: 1000.0 there, 900.0 here\n"), "{error}");
    assert!(error.contains("\n  seed: 8.0 there, 7.0 here\n  fix: repeat --set 'seed=8'; else "), "{error}");
    fs::write(folder.join("ball.toml"), common::BALL).unwrap();
    // What says which study it is of cannot be made again.
    let manifest = folder.join("y.study/study.json");
    fs::write(&manifest, "{ torn").unwrap();
    let error = Table::resume(&folder.join("y.study"), &seeded, Shard::WHOLE).unwrap_err().to_string();
    assert!(error.contains("study.json is damaged: line 1 is not JSON") && error.contains("by --force"), "{error}");
    drop(Table::create(&folder.join("y.study"), &seeded, Shard::WHOLE, true).unwrap());
    let same =
        gyration_study::Study::parse("a/b.toml", common::STUDY, folder, &["title=\"other\"".to_owned()]).unwrap();
    assert!(Table::resume(&path, &same, Shard::WHOLE).is_ok());
    // A folder that is no table is not removed.
    let other = folder.join("letters");
    fs::create_dir(&other).unwrap();
    fs::write(other.join("a.txt"), "dear").unwrap();
    assert!(matches!(Table::create(&other, &study, Shard::WHOLE, true), Err(StudyError::Exists { .. })));
    assert!(other.join("a.txt").exists());
}

#[test]
fn a_frame_has_what_the_rows_have() {
    let sandbox = sandbox();
    let folder = sandbox.path();
    let study = study(folder);
    let path = folder.join("frame.study");
    let mut table = Table::create(&path, &study, Shard::WHOLE, false).unwrap();
    let rows: Vec<Row> = (0..study.runs()).map(|run| study.row(run)).collect();
    table.append(&rows[3..9]).unwrap();
    let open = DataFrame::read(&path).unwrap();
    assert_eq!(open.rows(), 6);
    complete(&study, &mut table, 1);
    for frame in [DataFrame::read(&path).unwrap(), DataFrame::read(&table.file()).unwrap()] {
        assert_eq!(frame.rows(), rows.len());
        assert_eq!(frame.title(), Some("Where does it go?"));
        assert_eq!(frame.parameters()[0].count, Some(3));
        assert_eq!(frame.parameters()[1].axis, None);
        assert_eq!(frame.kept(), ["face", "end", "lowest", "mean", "touches", "lows", "far"]);
        for (column, told) in frame.columns().iter().zip(study.columns()) {
            assert_eq!(&column.column, told);
        }
        for (index, row) in rows.iter().enumerate() {
            for (value, column) in row.values.iter().zip(frame.columns()) {
                match value {
                    Value::Text(text) => assert_eq!(column.text(index), Some(text.as_str())),
                    Value::List(list) => assert_eq!(column.list(index), Some(list.as_slice())),
                    other => assert_eq!(column.number(index), other.number()),
                }
            }
        }
    }
    let failed = rows.iter().filter(|row| row.values.contains(&Value::Text("failed".into()))).count();
    assert!(failed > 0 && failed < rows.len() / 2, "{failed} of {} start below the table", rows.len());
}
