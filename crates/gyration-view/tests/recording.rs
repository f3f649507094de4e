//! A recording on disk is served as it stands, and only to its own page.

use crate::common::{FALL, Served, doubles, record, singles};
use gyration_record::Recording;
use gyration_view::{PageSource, Stored};

fn served(folder: &tempfile::TempDir) -> (Recording, Served) {
    let path = record(folder.path(), "fall", FALL);
    let stored = Stored::open(&path).unwrap();
    (Recording::open(&path).unwrap(), Served::new(PageSource::Recording(Box::new(stored))))
}

/// The arrays that stand in the recording itself.
fn recorded(header: &serde_json::Value) -> impl Iterator<Item = &serde_json::Value> {
    header["arrays"].as_array().unwrap().iter().filter(|array| array["name"] != "cauchy_stress")
}

#[test]
fn stress_is_shown_whether_or_not_it_was_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let (_, computed) = served(&folder);
    let asks = FALL.replace("[time]", "[record]\nquantities = [\"cauchy_stress\"]\n[time]");
    let path = record(folder.path(), "asks", &asks);
    let recorded = Served::new(PageSource::Recording(Box::new(Stored::open(&path).unwrap())));
    let blob = |served: &Served, range: &str| singles(&served.get(&format!("/api/blob/cauchy_stress{range}")).1);
    let (computed_all, recorded_all) = (blob(&computed, ""), blob(&recorded, ""));
    assert_eq!(computed_all.len(), 31 * 18);
    let mut largest = 0.0_f32;
    for (row, (a, b)) in computed_all.chunks(18).zip(recorded_all.chunks(18)).enumerate() {
        assert!(a[..9].iter().all(|x| x.is_nan()), "the ball is rigid");
        for (a, b) in a[9..].iter().zip(&b[9..]) {
            // Rounding of both to single precision, of numbers up to the largest so far.
            largest = largest.max(b.abs());
            assert!((a - b).abs() <= 1e-6 * largest, "row {row}: {a} and {b}");
        }
    }
    assert!(largest > 1.0, "the jelly is under stress");
    let bits = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&blob(&computed, "?from=4&to=6")), bits(&computed_all[4 * 18..6 * 18]));
}

#[test]
fn surfaces_hold_the_shapes() {
    let folder = tempfile::tempdir().unwrap();
    let (_, served) = served(&folder);
    let points = singles(&served.get("/api/blob/surface/1/points").1);
    assert!(points.len() == 24 && points.iter().all(|x| (x.abs() - 0.05).abs() < 1e-8), "{points:?}");
    let triangles: Vec<u32> =
        served.get("/api/blob/surface/1/triangles").1.as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect();
    assert!(triangles.len() == 36 && triangles.iter().all(|index| *index < 8));
    assert_eq!(served.get("/api/blob/surface/9/points").0, 404);
    assert_eq!(served.get("/api/blob/surface/1/colour").0, 404);
}

#[test]
fn the_header_says_what_the_recording_says() {
    let folder = tempfile::tempdir().unwrap();
    let (recording, served) = served(&folder);
    let header = served.json("/api/header");
    assert_eq!(header["mode"], "recording");
    assert_eq!(header["rows"], recording.rows());
    assert_eq!((&header["complete"], &header["outcome"]), (&true.into(), &"completed".into()));
    assert_eq!(header["scene"].as_str(), Some(FALL));
    assert_eq!(header["bodies"][0]["name"], "ball");
    assert_eq!(header["summary"]["statistics"], recording.attributes()["statistics"]);
    let columns: Vec<&str> = header["columns"].as_array().unwrap().iter().map(|c| c[0].as_str().unwrap()).collect();
    assert_eq!(columns, recording.columns().collect::<Vec<_>>());
    assert_eq!(header["bodies"][1]["surface"], 1);
    assert_eq!(header["surfaces"][1], serde_json::json!({ "points": 8, "triangles": 12 }));
    for array in recorded(&header) {
        let name = array["name"].as_str().unwrap();
        assert_eq!(array["stride"], recording.array(name).unwrap().row_len(), "{name}");
    }
}

#[test]
fn blobs_hold_the_numbers_of_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    let (recording, served) = served(&folder);
    let blob = |name: &str| served.get(&format!("/api/blob/{name}"));
    assert_eq!(doubles(&blob("time").1), recording.times().unwrap());
    let all = recording.read("position").unwrap().data;
    assert_eq!(singles(&blob("position").1), all.iter().map(|x| *x as f32).collect::<Vec<_>>());
    let some = singles(&blob("position?from=3&to=5").1);
    assert_eq!(some, all[3 * 6..5 * 6].iter().map(|x| *x as f32).collect::<Vec<_>>());
    assert!(doubles(&blob("events").1).len() >= 3, "the ball has touched");
    assert_eq!(blob("no_such_thing").0, 404);
    assert_eq!(blob("position?from=3&to=500").0, 416);
    assert_eq!(blob("../../etc/passwd").0, 404);
    assert_eq!(blob("position?from=x").0, 400);
}

#[test]
fn requests_from_elsewhere_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (_, served) = served(&folder);
    let port = served.port;
    let ask = |headers: &str| served.ask("/api/header", headers).0;
    assert_eq!(ask(&format!("Host: localhost:{port}\r\n")), 200);
    assert_eq!(ask(&format!("Host: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\n")), 200);
    assert_eq!(ask(&format!("Host: rebound.example:{port}\r\n")), 403);
    assert_eq!(ask(&format!("Host: 127.0.0.1:{port}\r\nOrigin: http://elsewhere.example\r\n")), 403);
}

#[test]
fn a_recording_that_grows_is_read_as_far_as_it_has_got() {
    let folder = tempfile::tempdir().unwrap();
    let long = record(folder.path(), "long", FALL);
    let short = record(folder.path(), "short", &FALL.replace("end = 0.3", "end = 0.1"));
    let shown = folder.path().join("shown.gyr");
    std::fs::rename(&short, &shown).unwrap();
    let served = Served::new(PageSource::Recording(Box::new(Stored::open(&shown).unwrap())));
    let before = served.json("/api/header")["rows"].as_u64().unwrap();
    std::fs::rename(&shown, &short).unwrap();
    std::fs::rename(&long, &shown).unwrap();
    let after = served.json("/api/header")["rows"].as_u64().unwrap();
    assert_eq!((before, after), (11, 31));
    assert_eq!(doubles(&served.get(&format!("/api/blob/time?from={before}")).1).len(), 20);
}

#[test]
fn what_is_no_recording_or_was_torn_is_an_error_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let problem = |path: &std::path::Path| Stored::open(path).unwrap_err().to_string();
    assert!(problem(folder.path()).contains("is not a recording"), "{}", problem(folder.path()));
    assert!(problem(&folder.path().join("none")).contains("there is no recording at"));
    let (recording, served) = served(&folder);
    std::fs::write(recording.path().join("position/c.0.0.0"), b"torn").unwrap();
    let (status, body) = served.get("/api/blob/position");
    assert_eq!(status, 500);
    assert!(String::from_utf8_lossy(&body).contains("is damaged: 4 bytes where"), "{}", String::from_utf8_lossy(&body));
    let group = recording.path().join("zarr.json");
    let text = std::fs::read_to_string(&group).unwrap();
    std::fs::write(&group, text.replacen("\"record_format\": 2", "\"record_format\": 99", 1)).unwrap();
    assert!(
        problem(recording.path()).contains("has format 99, this program reads formats to 2"),
        "{}",
        problem(recording.path())
    );
}
