//! Fields of a recording on the page: a map of a sample, and why there is none.

use crate::common::{FALL, Served, record, singles};
use crate::live::running;
use gyration_view::{PageSource, Stored};
use serde_json::Value;
use std::f64::consts::TAU;

/// Two balls of 2 kg on a spring that is longer than it would be.
const BALLS: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 0.02, sample = 0.01 }
[[body]]
name = "a"
shape = { sphere = { radius = 0.05 } }
mass = 2
velocity = [0, 0, 1]
[[body]]
name = "b"
shape = { sphere = { radius = 0.05 } }
mass = 2
position = [0.3, 0, 0]
[[spring]]
between = ["a", "b"]
stiffness = 100
rest_length = 0.2
"#;

/// What is said of a map, and its numbers field by field.
fn map(served: &Served, query: &str) -> (Value, Vec<Vec<f32>>) {
    let (status, bytes) = served.get(&format!("/api/fields?{query}"));
    assert_eq!(status, 200, "{}", String::from_utf8_lossy(&bytes));
    let length = u32::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
    let head: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
    let count = head["counts"].as_array().unwrap().iter().map(|many| many.as_u64().unwrap() as usize).product();
    let fields = singles(&bytes[4 + length..]).chunks(count).map(<[f32]>::to_vec).collect();
    (head, fields)
}

/// An answer that is none, in words.
fn refused(served: &Served, query: &str) -> (u16, String) {
    let (status, bytes) = served.get(&format!("/api/fields?{query}"));
    (status, String::from_utf8_lossy(&bytes).into_owned())
}

fn three(value: &Value) -> [f64; 3] {
    std::array::from_fn(|axis| value[axis].as_f64().unwrap())
}

fn shown(folder: &tempfile::TempDir, name: &str, text: &str) -> Served {
    let path = record(folder.path(), name, text);
    Served::new(PageSource::Recording(Box::new(Stored::open(&path).unwrap())))
}

#[test]
fn a_map_has_the_means_of_the_bodies_at_its_points() {
    let folder = tempfile::tempdir().unwrap();
    let served = shown(&folder, "balls", BALLS);
    let (usual, _) = map(&served, "row=0");
    assert!((usual["usual"].as_f64().unwrap() - 0.6).abs() < 1e-12 && usual["width"] == usual["usual"]);
    let (head, fields) = map(&served, "row=0&width=0.1");
    let keys: Vec<&str> = head["fields"].as_array().unwrap().iter().map(|it| it["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["density", "speed", "pressure", "shear", "power"]);
    // Two widths beyond the centres, points half a width apart, in the plane of the path.
    let [x, _, z] = three(&head["origin"]);
    let (across, up) = (three(&head["across"])[0], three(&head["up"])[2]);
    assert_eq!(head["counts"][0], 15);
    assert!((x + 0.2).abs() < 1e-6 && (across - 0.7).abs() < 1e-6 && z < -0.19 && up > 0.4, "{head}");
    let counts = [0, 1].map(|side| head["counts"][side].as_u64().unwrap() as usize);
    let b = 0.1_f64;
    for (at, found) in fields[0].iter().enumerate() {
        let place =
            |index: usize, first: f64, side: f64, count: usize| first + side * index as f64 / (count - 1) as f64;
        let [here, there] = [place(at % counts[0], x, across, counts[0]), place(at / counts[0], z, up, counts[1])];
        let weight = |center: f64| (-((here - center).powi(2) + there.powi(2)) / (2.0 * b * b)).exp();
        let known = 2.0 * (weight(0.0) + weight(0.3)) / (TAU * b * b).powf(1.5);
        assert!((f64::from(*found) / known - 1.0).abs() < 1e-4, "{found} for {known} at {here}, {there}");
    }
    // What pulls has a negative pressure; nearer to the one that moves all moves faster.
    assert!(fields[2].iter().all(|pressure| *pressure <= 0.0) && fields[2].iter().any(|pressure| *pressure < -1.0));
    let row = counts[0] * (counts[1] / 2);
    assert!(fields[1][row] > fields[1][row + counts[0] - 1], "{:?}", fields[1]);
    assert!((map(&served, "row=2").0["time"].as_f64().unwrap() - 0.02).abs() < 1e-12);
    for (query, status, words) in [
        ("row=0&width=-1", 422, "the width -1 m is not a finite length above zero"),
        ("row=0&width=inf", 422, "the width inf m is not a finite length above zero"),
        ("row=0&width=1e308", 422, "out of proportion"),
        ("row=0&width=1e-200", 422, "out of proportion"),
        ("row=3", 416, "3"),
        ("row=18446744073709551615", 416, "18446744073709551615"),
    ] {
        let (found, told) = refused(&served, query);
        assert!(found == status && told.contains(words), "{query}: {found} {told}");
    }
}

#[test]
fn why_there_is_no_map_is_told_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let meeting = format!("{BALLS}[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = {{ alpha = 1e-9, nu = 6 }}\n");
    let (status, told) = refused(&shown(&folder, "meeting", &meeting), "row=0");
    assert!(status == 422 && told.contains("was not recorded: write record = { pairs = true }"), "{status} {told}");
    let recorded = meeting.replace("time =", "record = { pairs = true }\ntime =");
    assert_eq!(map(&shown(&folder, "recorded", &recorded), "row=1").1.len(), 5);
    let ring = BALLS.replace("time =", "lattice = { cell = [[0.5, 0, 0]] }\ntime =");
    let (status, told) = refused(&shown(&folder, "ring", &ring), "row=0&width=1e9");
    assert!(status == 422 && told.contains("bodies of a ring: write one of 2770 m or less"), "{status} {told}");
    let lost = shown(&folder, "lost", BALLS);
    std::fs::remove_dir_all(folder.path().join("lost.gyr")).unwrap();
    let (status, told) = refused(&lost, "row=0");
    assert!(status == 500 && told.contains("lost.gyr"), "{status} {told}");
    let (status, told) = refused(&Served::new(running(&folder, FALL)), "row=0");
    assert!(status == 404 && told.contains("run the scene"), "{status} {told}");
}
