//! Tables as pandas, pyarrow and polars read them. Needs GYRATION_PYTHON: a Python with all three.

use crate::common::{complete, sandbox, study};
use gyration_study::{Row, Shard, Table};
use std::path::Path;
use std::process::Command;

/// Argument: the folder of the table, its part to read (`table.parquet` or `rows`), the rows as JSON lines.
const CHECK: &str = r#"
import json, math, pathlib, sys
import pandas, polars, pyarrow.parquet
source = pathlib.Path(sys.argv[1]) / sys.argv[2]
rows = [json.loads(line) for line in open(sys.argv[3])]
frame = pandas.read_parquet(source).sort_values("run").reset_index(drop=True)
lazy = polars.read_parquet(source if source.is_file() else source / "*.parquet").sort("run")
told = json.loads(pyarrow.parquet.read_table(source).schema.metadata[b"gyration"])
names = [column["name"] for column in told["columns"]]
assert list(frame.columns) == names and lazy.columns == names, (list(frame.columns), names)
assert len(frame) == len(rows) and len(lazy) == len(rows)
kinds = {"integer": "Int64", "number": "Float64", "text": "String", "list": "List(Float64)"}
for column, kind in zip(told["columns"], lazy.dtypes):
    assert str(kind) == kinds[column["kind"]], (column, kind)
for index, row in enumerate(rows):
    for name, value in zip(names, row):
        found, other = frame[name][index], lazy[name][index]
        if value is None:
            assert other is None and (found is None or found != found), (name, found, other)
        elif isinstance(value, list):
            assert list(found) == value and list(other) == value, (name, found, value)
        else:
            assert found == value and other == value, (name, found, other, value)
assert frame["run"].dtype == "int64" and told["columns"][3]["unit"] == "kg/m^3"
assert frame["face"].isna().sum() == (frame["outcome"] == "failed").sum() > 0
print("pandas", pandas.__version__, "pyarrow", pyarrow.__version__, "polars", polars.__version__, "read", len(rows), "rows")
"#;

fn check(folder: &Path, part: &str, rows: &[Row]) {
    let Some(python) = std::env::var_os("GYRATION_PYTHON") else {
        panic!("GYRATION_PYTHON is not set: it names a Python with pandas, pyarrow and polars");
    };
    let lines = folder.with_extension("jsonl");
    std::fs::write(&lines, rows.iter().map(|row| row.to_line() + "\n").collect::<String>()).unwrap();
    let output = Command::new(python).args(["-c", CHECK]).arg(folder).arg(part).arg(&lines).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    print!("{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn data_frames_read_the_table_and_the_rows_before_it() {
    let sandbox = sandbox();
    let study = gyration_study::Study::again(&gyration_study::StudySource {
        overrides: vec!["repetitions=30".into()],
        ..study(sandbox.path()).source().clone()
    });
    let study = study.unwrap();
    let rows: Vec<Row> = (0..study.runs()).map(|run| study.row(run)).collect();
    let mut table = Table::create(&sandbox.path().join("x.study"), &study, Shard::WHOLE, false).unwrap();
    // Two chunks and a piece of a third.
    table.append(&rows[..150]).unwrap();
    check(table.folder(), "rows", &rows[..128]);
    complete(&study, &mut table, 1);
    check(table.folder(), "table.parquet", &rows);
}
