//! Waves of a lattice on the page: bands, and a wave as rows of one period.

use crate::common::{FALL, Served, doubles, provenance, record, singles};
use crate::live::Page;
use gyration_view::{Live, PageSource, Stored};
use serde_json::Value;

/// Bars of 1 kg that two springs of 50 N/m join to the next one, 10 cm to both sides of the line.
const BARS: &str = r#"
title = "bars"
world = { gravity = [0, 0, 0] }
time = { end = 0.01, sample = 0.01 }
lattice = { cell = [[0.3, 0, 0]], repeat = [2, 1, 1] }
[[body]]
name = "bar"
shape = { box = { size = [0.2, 0.2, 0.1] } }
mass_properties = { mass = 1, euler_tensor = [[0.01, 0, 0], [0, 0.01, 0], [0, 0, 0.005]] }
[[spring]]
between = ["bar", "bar"]
cell = [1, 0, 0]
points = [[0.1, 0.1, 0], [-0.1, 0.1, 0]]
stiffness = 50
rest_length = 0.1
[[spring]]
between = ["bar", "bar"]
cell = [1, 0, 0]
points = [[0.1, -0.1, 0], [-0.1, -0.1, 0]]
stiffness = 50
rest_length = 0.1
"#;

/// The wave of a branch at κ = ¼ with half of the largest amplitude: what is said of it, positions and P row by row.
fn wave(served: &Served, branch: usize) -> (Value, Vec<f32>, Vec<f32>) {
    let path = format!("/api/wave?path=0.25,0,0%200.5,0,0&branch={branch}&amplitude=0.5");
    let (status, bytes) = served.get(&path);
    assert_eq!(status, 200, "{}", String::from_utf8_lossy(&bytes));
    let length = u32::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
    let head: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
    let payload = &bytes[4 + length..];
    let (rows, bodies) = (head["rows"].as_u64().unwrap() as usize, head["bodies"].as_array().unwrap().len());
    let times = doubles(&payload[..8 * rows]);
    let period = std::f64::consts::TAU / head["omega"].as_f64().unwrap();
    assert!((times[rows - 1] / period - 1.0).abs() < 1e-15);
    let (positions, gradients) = payload[8 * rows..].split_at(4 * 3 * rows * bodies);
    (head, singles(positions), singles(gradients))
}

fn is_near(found: f32, known: f64) {
    assert!((f64::from(found) - known).abs() < 1e-6, "{found} for {known}");
}

#[test]
fn a_wave_passes_over_cells_as_its_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bars.toml");
    std::fs::write(&path, BARS).unwrap();
    let served = Served::new(PageSource::Live(Live::start(&path.to_string_lossy(), &[], provenance()).unwrap()));
    assert_eq!(served.get("/api/bands").0, 503);
    Page::open(&served).read_all();
    let bands = served.json("/api/bands?path=G=0,0,0%20X=1/2,0,0");
    let last = bands["omega"].as_array().unwrap().last().unwrap().as_array().unwrap();
    // ω = 2√(2k/m) along, 2b√(2k/I) of turns.
    assert!((last[5].as_f64().unwrap() - 20.0).abs() < 1e-9, "{last:?}");
    assert!((last[4].as_f64().unwrap() - 0.2 * (100.0_f64 / 0.02).sqrt()).abs() < 1e-9, "{last:?}");
    assert_eq!((&bands["labels"][1][1], bands["vertices"][1].as_u64()), (&"X".into(), Some(40)));

    let (head, positions, gradients) = wave(&served, 5);
    assert_eq!((&head["repeat"], &head["bodies"][7]["name"]), (&serde_json::json!([8, 1, 1]), &"bar-7".into()));
    assert_eq!(head["bodies"][7]["like"], 0);
    // Half of the largest side of a bar, which is less than a cell vector; later cells move later.
    for (row, angle) in [(0, 0.0), (5, std::f64::consts::TAU * 5.0 / 48.0)] {
        for cell in 0..8 {
            let phase = std::f64::consts::FRAC_PI_2 * cell as f64 - angle;
            is_near(positions[3 * (8 * row + cell)], 0.3 * cell as f64 + 0.1 * phase.cos());
        }
    }
    assert!(gradients.iter().enumerate().all(|(k, entry)| *entry == [1.0, 0.0, 0.0, 0.0][k % 9 % 4]));

    // Turns of bars that stay rigid, however far.
    let (_, positions, gradients) = wave(&served, 4);
    for cell in 0..8 {
        let angle = 0.5 * (std::f64::consts::FRAC_PI_2 * cell as f64).cos();
        is_near(positions[3 * cell], 0.3 * cell as f64);
        for (place, known) in [(0, angle.cos()), (1, angle.sin()), (3, -angle.sin()), (4, angle.cos())] {
            is_near(gradients[9 * cell + place], known);
        }
    }

    for (path, words) in [
        ("/api/bands?path=0,0", "no vertex"),
        ("/api/wave?path=0,0,0&branch=6&amplitude=0.5", "6 branches"),
        ("/api/wave?path=0,0,0&branch=0&amplitude=2", "from 0 to 1"),
    ] {
        let (status, told) = served.get(path);
        assert!(status == 422 && String::from_utf8_lossy(&told).contains(words), "{status} {told:?}");
    }
}

#[test]
fn a_recording_has_the_waves_of_its_scene_and_one_without_lattice_none() {
    let folder = tempfile::tempdir().unwrap();
    let shown = |name, text| {
        let path = record(folder.path(), name, text);
        Served::new(PageSource::Recording(Box::new(Stored::open(&path).unwrap())))
    };
    let bands = shown("bars", BARS).json("/api/bands");
    assert_eq!(bands["omega"][40].as_array().unwrap().len(), 6);
    let (status, told) = shown("fall", FALL).get("/api/bands");
    assert!(status == 422 && String::from_utf8_lossy(&told).contains("[lattice]"), "{status}");
}

/// Four balls of 1 kg in a row with free ends, on springs of 100 N/m; rows stand side by side without end.
const RIBBON: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 0.01, sample = 0.01 }
lattice = { cell = [[1, 0, 0], [0, 1, 0]], repeat = [2, 4, 1], periodic = [true, false] }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 1
[[spring]]
between = ["ball", "ball"]
cell = [0, 1, 0]
stiffness = 100
rest_length = 1
"#;

#[test]
fn a_ribbon_tells_how_much_of_its_waves_is_at_its_edges_and_is_drawn_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = record(folder.path(), "ribbon", RIBBON);
    let served = Served::new(PageSource::Recording(Box::new(Stored::open(&path).unwrap())));
    let bands = served.json("/api/bands");
    let edges = &bands["edges"][0];
    assert_eq!((&edges["direction"], &edges["cells"]), (&2.into(), &1.into()));
    for mode in 1..4 {
        // u_i = cos(πj(i + ½)/4), ω = 2√(k/m) sin(πj/8): Σu² is 2.
        let angle = std::f64::consts::PI * f64::from(mode) / 8.0;
        let branch = 20 + mode as usize;
        assert!((bands["omega"][0][branch].as_f64().unwrap() / (20.0 * angle.sin()) - 1.0).abs() < 1e-9);
        for side in 0..2 {
            let share = edges["shares"][0][branch][side].as_f64().unwrap();
            assert!((share - 0.5 * angle.cos().powi(2)).abs() < 1e-9, "mode {mode}: {share}");
        }
    }
    // Eight cells along the ribbon, all four across it.
    let (head, positions, _) = wave(&served, 23);
    assert_eq!((&head["repeat"], head["bodies"].as_array().unwrap().len()), (&serde_json::json!([8, 4, 1]), 32));
    let places = |cell: usize| &positions[3 * cell..3 * cell + 3];
    assert!((0..8).all(|x| (places(x)[0] - x as f32).abs() < 1e-6 && (places(24 + x)[0] - x as f32).abs() < 1e-6));
    // In the third mode both ends move against one another.
    let [low, high] = [places(0)[1], places(24)[1] - 3.0];
    assert!((low + high).abs() < 1e-5 && low.abs() > 1e-3, "{low} {high}");
    assert!(served_bars(&folder).json("/api/bands")["edges"].as_array().unwrap().is_empty());
}

fn served_bars(folder: &tempfile::TempDir) -> Served {
    let path = record(folder.path(), "bars", BARS);
    Served::new(PageSource::Recording(Box::new(Stored::open(&path).unwrap())))
}
