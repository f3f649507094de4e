//! Shells of one mesh: side by side and voids are bodies, what is enclosed twice is told.

use gyration::shape::Polyhedron;
use gyration::tensor::Vec3;
use gyration_geometry::{ShellFault, Shells, doubly_enclosed};

/// Boxes from corner to corner, those with a minus sign facing inward.
fn boxes(corners: &[(f64, [f64; 3], [f64; 3])]) -> Polyhedron {
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut mesh = Polyhedron::default();
    for (sense, least, most) in corners {
        let first = mesh.vertices.len();
        let corner =
            |place: usize| Vec3::from_fn(|axis, _| if place >> axis & 1 == 1 { most[axis] } else { least[axis] });
        mesh.vertices.extend((0..8).map(corner));
        for [a, b, c, d] in faces.map(|face| face.map(|place| first + place)) {
            let pieces = if *sense > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
            mesh.triangles.extend(pieces);
        }
    }
    mesh
}

const UNIT: (f64, [f64; 3], [f64; 3]) = (1.0, [0.0; 3], [1.0; 3]);

fn fault(others: &[(f64, [f64; 3], [f64; 3])]) -> Option<Shells> {
    doubly_enclosed(&boxes(&[&[UNIT], others].concat()))
}

#[test]
fn shells_side_by_side_and_voids_count_once() {
    assert_eq!(fault(&[]), None);
    assert_eq!(fault(&[(1.0, [2.0, 0.0, 0.0], [3.0, 1.0, 1.0])]), None);
    // With a face in common.
    assert_eq!(fault(&[(1.0, [1.0, 0.0, 0.0], [2.0, 1.0, 1.0])]), None);
    let void = (-1.0, [0.2; 3], [0.8; 3]);
    assert_eq!(fault(&[void]), None);
    // A body in the void of another.
    assert_eq!(fault(&[void, (1.0, [0.4; 3], [0.6; 3])]), None);
}

/// Symptom: two shells of 2 g that cross were a body of 4 g, without a word.
#[test]
fn shells_that_cross_are_told_with_the_place_and_their_volumes() {
    for other in [
        (1.0, [0.5, 0.4, 0.3], [1.5, 1.4, 1.3]),
        // With faces in common planes, so that no edge passes through a face.
        (1.0, [0.5, 0.0, 0.0], [1.5, 1.0, 1.0]),
        // A void that is partly in nothing.
        (-1.0, [0.5, 0.4, 0.3], [1.5, 0.6, 0.7]),
    ] {
        let found = fault(&[other]).unwrap();
        assert_eq!((found.which, found.kind, found.union), ([1, 2], ShellFault::Crossing, None));
        assert!(found.place.iter().all(|c| (0.0..=1.0).contains(c)), "{}", found.place);
        assert!((found.own[0] - 1.0).abs() < 1e-12 && (found.sum - found.own.iter().sum::<f64>()).abs() < 1e-12);
        assert!(found.to_string().contains("shells 1 and 2 cross near ["), "{found}");
    }
}

#[test]
fn a_shell_within_another_of_the_same_sense_is_told_with_the_volume_of_both() {
    let found = fault(&[(1.0, [0.25; 3], [0.75; 3])]).unwrap();
    assert_eq!((found.which, found.kind), ([1, 2], ShellFault::Within));
    assert!((found.sum - 1.125).abs() < 1e-12 && (found.union.unwrap() - 1.0).abs() < 1e-12);
    assert!(found.to_string().contains("counts as 1.125000e0 m³, and what it encloses is 1.000000e0 m³"), "{found}");
    let found = fault(&[(-1.0, [2.0; 3], [2.5; 3])]).unwrap();
    assert_eq!((found.which, found.kind), ([2, 2], ShellFault::VoidInNothing));
}

/// A cube whose top is pushed down through its bottom: closed, and each edge of two faces, but inside out below.
#[test]
fn a_shell_that_crosses_itself_is_told() {
    let mut mesh = boxes(&[UNIT]);
    // A pyramid in the place of the top, whose tip hangs below the bottom.
    let top = [4, 5, 7, 6];
    mesh.triangles.retain(|triangle| !triangle.iter().all(|corner| top.contains(corner)));
    let tip = mesh.vertices.len();
    mesh.vertices.push(Vec3::new(0.45, 0.55, -0.5));
    mesh.triangles.extend((0..4).map(|k| [top[k], top[(k + 1) % 4], tip]));
    let found = doubly_enclosed(&mesh).unwrap();
    assert_eq!((found.which, found.kind, found.union), ([1, 1], ShellFault::Crossing, None));
    assert!(found.place.z.abs() < 1e-12, "where it leaves through the bottom: {}", found.place);
    assert!(found.to_string().contains("shell 1 crosses itself near ["), "{found}");
    // The tip above the bottom.
    mesh.vertices[tip].z = 0.2;
    assert_eq!(doubly_enclosed(&mesh), None);
}
