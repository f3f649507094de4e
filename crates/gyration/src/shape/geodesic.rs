//! The unit sphere as a geodesic polyhedron: the faces of an icosahedron, each divided into n² and pushed out.
//!
//! 20 n² triangles on 10 n² + 2 points, of edges that differ little; no poles.

use super::triangulation::Triangulation;
use crate::tensor::Vec3;

/// The unit sphere in about `count` triangles, at least 20.
pub(super) fn unit_sphere(count: usize) -> Triangulation {
    let n = ((count as f64 / 20.0).sqrt().round() as usize).max(1);
    icosahedron().subdivided(n).mapped(|point| point.normalize())
}

/// Twenty triangles on the cyclic permutations of (0, ±1, ±golden ratio).
fn icosahedron() -> Triangulation {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let signs = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let rectangle = |axis: usize| {
        signs.map(|(s, t)| {
            let mut corner = Vec3::zeros();
            (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (s, t * golden);
            corner
        })
    };
    let points: Vec<Vec3> = (0..3).flat_map(rectangle).collect();
    // Neighbours are 2 apart, all others further.
    let near = |a: usize, b: usize| (points[a] - points[b]).norm() < 2.5;
    let mut triangles = Vec::with_capacity(20);
    for a in 0..12 {
        for b in (a + 1..12).filter(|&b| near(a, b)) {
            for c in (b + 1..12).filter(|&c| near(a, c) && near(b, c)) {
                let outward = points[a].dot(&points[b].cross(&points[c])) > 0.0;
                triangles.push(if outward { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    Triangulation { points, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_shared_and_evenly_spread() {
        for n in [1, 2, 5, 9] {
            let sphere = unit_sphere(20 * n * n);
            assert_eq!((sphere.triangles.len(), sphere.points.len()), (20 * n * n, 10 * n * n + 2));
            let edges = sphere.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
            let lengths: Vec<f64> = edges.map(|[a, b]| (sphere.points[a] - sphere.points[b]).norm()).collect();
            let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min);
            let longest = lengths.iter().copied().fold(0.0, f64::max);
            // A face reaches 37.4° from its middle, where a step along it is seen cos²(37.4°) = 0.63 times as large.
            assert!(longest / shortest < 1.6, "{n}: {longest} {shortest}");
        }
    }
}
