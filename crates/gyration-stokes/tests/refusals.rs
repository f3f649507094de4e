//! What is no surface, or asks too much, is refused with the triangle and the fix.

use gyration_stokes::{ClosedSurface, StokesError, StokesOptions};
use gyration_threads::Interruption;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

const POINTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

#[test]
fn tetrahedron_is_taken() {
    let surface = ClosedSurface::new(&POINTS, &TRIANGLES).unwrap();
    assert!((surface.volume() - 1.0 / 6.0).abs() < 1e-15);
    assert_eq!((surface.points(), surface.triangles()), (POINTS.to_vec(), TRIANGLES.to_vec()));
    // Every corner is one of three edges.
    assert_eq!(surface.unknowns(), 36);
}

#[test]
fn too_few_triangles_are_refused() {
    assert_eq!(ClosedSurface::new(&POINTS, &TRIANGLES[..3]), Err(StokesError::TooFew { count: 3 }));
}

#[test]
fn hole_is_refused_with_a_triangle_at_it() {
    let mut triangles = TRIANGLES.to_vec();
    triangles.extend([[1, 2, 3]]);
    triangles.remove(0);
    let error = ClosedSurface::new(&POINTS, &triangles).unwrap_err();
    assert!(matches!(error, StokesError::NotClosed { triangle: 0, from: 0, to: 1, neighbours: 0 }), "{error}");
}

#[test]
fn flipped_triangle_is_refused() {
    let mut triangles = TRIANGLES;
    triangles[3] = [1, 3, 2];
    assert!(matches!(ClosedSurface::new(&POINTS, &triangles), Err(StokesError::NotClosed { .. })));
}

#[test]
fn inward_surface_is_refused_with_its_volume() {
    let inward = TRIANGLES.map(|[a, b, c]| [a, c, b]);
    let Err(StokesError::Inward { volume }) = ClosedSurface::new(&POINTS, &inward) else { panic!("not refused") };
    assert!((volume + 1.0 / 6.0).abs() < 1e-15);
}

#[test]
fn reflection_is_refused() {
    let surface = ClosedSurface::new(&POINTS, &TRIANGLES).unwrap();
    assert!(matches!(surface.moved(|[x, y, z]| [-x, y, z]), Err(StokesError::Inward { .. })));
}

#[test]
fn triangle_without_area_is_refused_by_name() {
    let mut points = POINTS;
    points[3] = [0.5, 0.0, 1e-7];
    let error = ClosedSurface::new(&points, &TRIANGLES).unwrap_err();
    assert!(matches!(error, StokesError::Degenerate { triangle: 1, .. }), "{error}");
    assert!(error.to_string().starts_with("triangle 1 is degenerate"));
    let repeated = [[0, 2, 1], [0, 1, 1], [0, 3, 2], [1, 2, 3]];
    assert!(matches!(ClosedSurface::new(&POINTS, &repeated), Err(StokesError::Degenerate { triangle: 1, .. })));
}

#[test]
fn points_that_are_not_finite_or_missing_are_refused() {
    let mut points = POINTS;
    points[2][1] = f64::NAN;
    assert_eq!(ClosedSurface::new(&points, &TRIANGLES), Err(StokesError::NotFinite { point: 2 }));
    let error = ClosedSurface::new(&POINTS[..3], &TRIANGLES).unwrap_err();
    assert_eq!(error, StokesError::NoSuchPoint { triangle: 1, point: 3, count: 3 });
}

#[test]
fn two_bodies_are_refused() {
    let far = POINTS.map(|p| p.map(|x| x + 10.0));
    let points = [POINTS, far].concat();
    let triangles = [TRIANGLES, TRIANGLES.map(|t| t.map(|k| k + 4))].concat();
    assert_eq!(ClosedSurface::new(&points, &triangles), Err(StokesError::NotConnected { triangle: 4 }));
}

#[test]
fn matrix_beyond_the_memory_granted_is_refused_with_its_bytes() {
    let error = ClosedSurface::icosphere(2)
        .unwrap()
        .resistance(&StokesOptions { max_bytes: 1 << 20, ..StokesOptions::default() })
        .unwrap_err();
    let StokesError::TooLarge { triangles: 320, unknowns: 486, bytes, limit } = error else { panic!("{error}") };
    assert!(limit == 1 << 20 && bytes > 8 * 486 * 486);
}

#[test]
fn centre_that_is_not_finite_is_refused() {
    let options = StokesOptions { centre: [0.0, f64::INFINITY, 0.0], ..StokesOptions::default() };
    let error = ClosedSurface::icosphere(0).unwrap().resistance(&options).unwrap_err();
    assert!(matches!(error, StokesError::BadOption { what: "centre", .. }));
}

#[test]
fn ellipsoid_without_thickness_is_refused() {
    assert!(matches!(ClosedSurface::ellipsoid([1.0, 1.0, 0.0], 1), Err(StokesError::BadOption { .. })));
}

#[test]
fn refinement_without_end_is_refused() {
    assert!(matches!(ClosedSurface::icosphere(9), Err(StokesError::BadOption { .. })));
}

#[test]
fn matrix_that_nobody_waits_for_is_given_up_wherever_it_is() {
    let surface = ClosedSurface::icosphere(3).unwrap();
    let whole = surface.resistance(&StokesOptions::default()).unwrap();
    let mut given_up = 0;
    for wait in (0..).map(|attempt| 1 << attempt) {
        let flag = Arc::new(AtomicBool::new(false));
        let raise = {
            let flag = flag.clone();
            move || {
                std::thread::sleep(Duration::from_millis(wait));
                flag.store(true, Ordering::Relaxed);
            }
        };
        let waiting = std::thread::spawn(raise);
        let found = Interruption::default().raised_by(flag).within(|| surface.resistance(&StokesOptions::default()));
        waiting.join().unwrap();
        match found {
            Err(error) => assert_eq!(error, StokesError::Interrupted),
            Ok(found) => {
                assert!(found == whole);
                break;
            }
        }
        given_up += 1;
    }
    assert!(given_up > 1, "{given_up}");
}
