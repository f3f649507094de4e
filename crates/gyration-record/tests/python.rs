//! Python opens a recording as it is: xarray in both ways, NumPy the exports.
//!
//! Needs a Python with xarray, zarr ≥ 3 and numpy, named by the environment variable GYRATION_PYTHON:
//!
//! ```text
//! GYRATION_PYTHON=venv/bin/python cargo test -p gyration-record --test tests -- --ignored python::
//! ```

use crate::common::{checkpoint, finished, layout, write_to};
use gyration_record::{Attributes, Recording, Writer, export};
use std::fs::File;
use std::path::Path;
use std::process::Command;

/// Opens a recording and checks every number against its place. Any warning is an error.
const CHECK: &str = r#"
import sys, warnings
warnings.simplefilter("error")
import numpy as np, xarray as xr
path, rows, events, whole = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4] == "finished"
k = np.arange(rows)
row = k[:, None] + np.arange(25) / 32
for options in ({}, {"consolidated": True}, {"consolidated": False}):
    ds = xr.open_zarr(path, **options).load()
    assert dict(ds.sizes) == {"time": rows, "body": 2, "col": 3, "row": 3, "event": events}, ds.sizes
    assert ds.position.dims == ("time", "body", "col") and ds.gradient.dims == ("time", "body", "row", "col")
    assert ds.time.dtype == np.float64 and ds.event_time.dtype == np.float64 and ds.event_kind.dtype == np.int32
    assert np.array_equal(ds.time, k * 0.1)
    assert np.array_equal(ds.position, row[:, :6].reshape(rows, 2, 3))
    assert np.array_equal(ds.gradient, row[:, 6:24].reshape(rows, 2, 3, 3))
    assert np.array_equal(ds.energy_kinetic, row[:, 24])
    assert np.array_equal(ds.position.sel(body="ball", col="y"), row[:, 4])
    assert float(ds.mass.sel(body="die")) == 0.5
    assert np.array_equal(ds.event_time, np.arange(events) / 8)
    assert np.array_equal(ds.event_kind, np.arange(events) % 3)
    assert np.array_equal(ds.event_body, np.arange(events) % 3 - 1)
    assert ds.event_kind.attrs["flag_meanings"] == "touch part rest"
    assert ds.position.attrs["units"] == "m" and ds.position.attrs["long_name"] == "position of the bodies"
    assert ds.time.attrs["units"] == "s"
    if whole:
        assert ds.attrs["outcome"] == "completed" and ds.attrs["scene"] == "title = \"käse\"\n"
print("xarray", xr.__version__, "read", rows, "rows in three ways")
"#;

/// Flips a bit of a chunk and expects a complaint; then reads what the codec says that it is.
const CHECK_SUMS: &str = r#"
import sys, json, pathlib
import xarray as xr
path = pathlib.Path(sys.argv[1])
chunk = path / "position" / "c.0.0.0"
whole = chunk.read_bytes()
chunk.write_bytes(whole[:100] + bytes([whole[100] ^ 4]) + whole[101:])
try:
    xr.open_zarr(path).position.load()
except Exception as error:
    assert "checksum" in str(error), error
else:
    sys.exit("a flip was not told")
chunk.write_bytes(whole)
xr.open_zarr(path).load()
print("zarr tells a flip of a bit")
"#;

const CHECK_EXPORTS: &str = r#"
import sys, json, warnings
warnings.simplefilter("error")
import numpy as np
rows = int(sys.argv[3])
row = np.arange(rows)[:, None] + np.arange(25) / 32
with np.load(sys.argv[1]) as npz:
    assert np.array_equal(npz["time"], np.arange(rows) * 0.1)
    assert np.array_equal(npz["position"], row[:, :6].reshape(rows, 2, 3))
    assert np.array_equal(npz["gradient"], row[:, 6:24].reshape(rows, 2, 3, 3))
    assert npz["event_kind"].dtype == np.int32 and list(npz["body"]) == ["die", "ball"]
    assert json.loads(str(npz["attributes"]))["scene"] == "title = \"käse\"\n"
csv = np.genfromtxt(sys.argv[2], delimiter=",", names=True, deletechars="")
assert csv.dtype.names == ("t", "ball.x", "ball.y", "ball.z", "die.x", "die.y", "die.z", "energy.kinetic")
assert np.array_equal(csv["t"], np.arange(rows) * 0.1) and np.array_equal(csv["die.x"], row[:, 0])
print("numpy", np.__version__, "read npz and csv")
"#;

fn python(script: &str, arguments: &[&str]) {
    let Some(python) = std::env::var_os("GYRATION_PYTHON") else {
        panic!("GYRATION_PYTHON is not set: it names a Python with xarray, zarr >= 3 and numpy");
    };
    let output = Command::new(python).args(["-c", script]).args(arguments).output().unwrap();
    let (told, wrong) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{wrong}");
    print!("{told}");
}

fn check(path: &Path, rows: usize, events: usize, how: &str) {
    python(CHECK, &[path.to_str().unwrap(), &rows.to_string(), &events.to_string(), how]);
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn xarray_opens_a_finished_recording_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    for rows in [1, 8, 21] {
        let path = folder.path().join(format!("{rows}.gyr"));
        finished(&path, rows, 8);
        check(&path, rows, rows.div_ceil(2), "finished");
    }
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn xarray_opens_a_recording_that_is_being_written_and_one_that_was_abandoned() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let mut writer = Writer::create(&path, &layout(8), Attributes::new()).unwrap();
    for rows in [1, 4, 8, 11] {
        write_to(&mut writer, rows, usize::MAX).unwrap();
        writer.flush(&checkpoint(rows)).unwrap();
        check(&path, rows, rows.div_ceil(2), "unfinished");
    }
    write_to(&mut writer, 30, usize::MAX).unwrap();
    drop(writer);
    check(&path, 11, 6, "unfinished");
    drop(Writer::resume(&path).unwrap());
    check(&path, 11, 6, "unfinished");
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn zarr_holds_chunks_against_their_checksums() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 21, 8);
    python(CHECK_SUMS, &[path.to_str().unwrap()]);
}

#[test]
#[ignore = "needs GYRATION_PYTHON"]
fn numpy_reads_the_exports() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    finished(&path, 21, 8);
    let recording = Recording::open(&path).unwrap();
    let (npz, csv) = (folder.path().join("run.npz"), folder.path().join("run.csv"));
    export::npz(&recording, &npz).unwrap();
    export::csv(&recording, &mut File::create(&csv).unwrap()).unwrap();
    python(CHECK_EXPORTS, &[npz.to_str().unwrap(), csv.to_str().unwrap(), "21"]);
}
