//! Resistance matrices by boundary elements: ellipsoids of 320, 1,280 and 5,120 triangles, with and without a wall.
//!
//!     cargo bench -p gyration-bench --bench resistance [-- TRIANGLES]
//!
//! Wall time of the fastest of some calls, on one thread and on all. With a number of triangles only that matrix is
//! made, once and on one thread, for callgrind.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use gyration_stokes::{ClosedSurface, Faces, StokesOptions, StokesResistance, WallPlane};
use std::time::Instant;

/// Twenty triangles, cut into four again and again.
fn ellipsoid(refinements: u32) -> ClosedSurface {
    ClosedSurface::ellipsoid([1.0, 0.5, 0.2], refinements).expect("the ellipsoid is a surface")
}

fn resistance(surface: &ClosedSurface, wall: Option<WallPlane>) -> StokesResistance {
    let options = StokesOptions { faces: Faces::Curved, wall, ..StokesOptions::default() };
    surface.resistance(&options).expect("the ellipsoid has a resistance")
}

/// The fastest of some calls [s].
fn fastest(calls: u32, work: impl Fn() -> StokesResistance) -> f64 {
    let time = |_| {
        let begin = Instant::now();
        std::hint::black_box(work());
        begin.elapsed().as_secs_f64()
    };
    (0..calls).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    let asked = std::env::args().skip(1).find_map(|word| word.parse::<u32>().ok());
    let wall = WallPlane { point: [0.0, 0.0, -0.5], normal: [0.0, 0.0, 1.0] };
    if let Some(triangles) = asked {
        let surface = ellipsoid((triangles / 20).ilog(4));
        one.install(|| std::hint::black_box(resistance(&surface, None)));
        return;
    }
    println!(
        "{:>9} {:>14} {:>14} {:>16} {:>9}",
        "triangles", "one thread [s]", "threads [s]", "with a wall [s]", "threads"
    );
    for (refinements, calls) in [(2, 20), (3, 5), (4, 1)] {
        let surface = ellipsoid(refinements);
        let single = one.install(|| fastest(calls, || resistance(&surface, None)));
        let many = fastest(calls, || resistance(&surface, None));
        let beside_wall = one.install(|| fastest(1, || resistance(&surface, Some(wall))));
        let triangles = surface.triangles().len();
        println!("{triangles:>9} {single:>14.3} {many:>14.3} {beside_wall:>16.3} {:>9}", rayon::current_num_threads());
    }
}
