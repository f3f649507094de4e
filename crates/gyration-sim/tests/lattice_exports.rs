//! Recordings of lattices as particles and surfaces: places in space, and the cell that repeats itself.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_record::Recording;
use gyration_sim::replay::{Replay, particles_xyz};
use gyration_sim::{Job, Unwatched};

/// A recorded sheet, or crystal, of points on springs, drifting; its frames of particles, each split at its ends of
/// lines, and the places of the bodies at each sample.
fn frames(lattice: &str) -> (Vec<Vec<String>>, Vec<Vec<Vec3>>) {
    frames_of(lattice, ("", ""))
}

/// The same with other words in the scene.
fn frames_of(lattice: &str, (old, new): (&str, &str)) -> (Vec<Vec<String>>, Vec<Vec<Vec3>>) {
    let text = format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 0.2, sample = 0.1 }}
        {lattice}
        [[body]]
        name = "a"
        shape = {{ sphere = {{ radius = 0.02 }} }}
        density = 1000
        position = [0.01, 0.02, 0.03]
        velocity = [1, 2, 3]
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        stiffness = 40
        rest_length = 0.2
        "#
    );
    let text = text.replace(old, new);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lattice.gyr");
    Job::of(&parsed(&text, &[]), &provenance()).record(&path, &mut Unwatched).unwrap();
    let recording = Recording::open(&path).unwrap();
    let mut text = Vec::new();
    particles_xyz(&recording, 1, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let places = recording.read_rows("position", 0..recording.rows()).unwrap();
    let bodies = places.data.len() / 3 / recording.rows();
    let places: Vec<Vec<Vec3>> =
        places.data.chunks(3 * bodies).map(|row| row.chunks(3).map(Vec3::from_column_slice).collect()).collect();
    let mut replay = Replay::open(&recording).unwrap();
    for (row, places) in places.iter().enumerate() {
        let snapshot = replay.snapshot(row).unwrap();
        for (body, place) in places.iter().enumerate() {
            // Of the place in the cell and that of the cell.
            assert!((snapshot.body(body).place(&Vec3::zeros()) - place).norm() < 1e-15, "{row} {body}");
        }
    }
    (lines.chunks(bodies + 2).map(<[String]>::to_vec).collect(), places)
}

/// What stands in quotes behind a key of a frame's second line.
fn quoted<'a>(head: &'a str, key: &str) -> &'a str {
    let (_, rest) = head.split_once(&format!("{key}=\"")).unwrap();
    rest.split_once('"').unwrap().0
}

#[test]
fn particles_of_a_crystal_are_where_they_are_recorded() {
    let cell = "lattice = { cell = [[0.2, 0, 0], [0.1, 0.2, 0], [0, 0, 0.3]], repeat = [3, 2, 2] }";
    let (frames, places) = frames(cell);
    assert_eq!((frames.len(), places[0].len()), (3, 12));
    for (frame, places) in frames.iter().zip(&places) {
        assert_eq!(quoted(&frame[1], "Lattice"), "0.6000000000000001 0 0 0.2 0.4 0 0 0 0.6");
        assert_eq!((quoted(&frame[1], "Origin"), quoted(&frame[1], "pbc")), ("0 0 0", "T T T"));
        for (line, place) in frame[2..].iter().zip(places) {
            let numbers: Vec<f64> = line.split(' ').skip(2).take(3).map(|word| word.parse().unwrap()).collect();
            assert!((Vec3::from_column_slice(&numbers) - place).norm() < 1e-15, "{line}: {place}");
        }
    }
}

#[test]
fn a_frame_is_as_wide_as_its_bodies_where_nothing_repeats_itself() {
    let sheet = "lattice = { cell = [[0.2, 0, 0], [0.1, 0.2, 0]], repeat = [3, 2, 1], periodic = [true, false] }";
    let (frames, places) = frames(sheet);
    let numbers = |text: &str| text.split(' ').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<f64>>();
    for (frame, places) in frames.iter().zip(&places) {
        assert_eq!(quoted(&frame[1], "pbc"), "T F F");
        let (edges, origin) = (numbers(quoted(&frame[1], "Lattice")), numbers(quoted(&frame[1], "Origin")));
        assert!((edges[0] - 0.6).abs() < 1e-15 && edges[1] == 0.0 && edges[2] == 0.0, "{edges:?}");
        // From the lowest body's end to that of the highest, one diameter more than they are apart.
        for (axis, edge) in [(1, edges[4]), (2, edges[8])] {
            let at = || places.iter().map(|place| place[axis]);
            let (low, high) = (at().fold(f64::INFINITY, f64::min), at().fold(f64::NEG_INFINITY, f64::max));
            assert!((origin[axis] - (low - 0.02)).abs() < 1e-14, "{axis}: {origin:?} {low}");
            assert!((edge - (high - low + 0.04)).abs() < 1e-14, "{axis}: {edges:?}");
        }
    }
    // Points in a plane.
    let points = (
        "shape = { sphere = { radius = 0.02 } }\n        density = 1000",
        "shape = { points = [{ mass = 1, at = [0, 0, 0] }] }",
    );
    let (frames, places) = frames_of(&sheet.replace("[true, false]", "true"), points);
    let edges = numbers(quoted(&frames[2][1], "Lattice"));
    assert_eq!((edges[8], numbers(quoted(&frames[2][1], "Origin"))[2]), (1.0, places[2][0].z - 0.5));
    let (frames, _) = self::frames(&sheet.replace("[true, false]", "false"));
    assert!(frames.iter().all(|frame| frame[1].ends_with("pbc=\"F F F\"")), "{}", frames[0][1]);
}
