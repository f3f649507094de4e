//! A surface with normals: smooth where it bends little, sharp at edges.
//!
//! The normal at the corner of a triangle is the mean, by area, of those triangles around the point that bend by less
//! than the crease angle against it. A point with several normals becomes several vertices. A player takes them along
//! by the inverse transpose of its matrices, which is right under shear.

use crate::export::drawing::{SurfaceMesh, Vec3};
use std::collections::BTreeMap;

/// The angle between faces from which on an edge is sharp \[rad\]: 30°.
const CREASE: f64 = std::f64::consts::PI / 6.0;

/// What a graphics card takes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Shaded {
    /// \[m\].
    pub positions: Vec<[f32; 3]>,
    /// Unit vectors.
    pub normals: Vec<[f32; 3]>,
    /// Three a triangle.
    pub indices: Vec<u32>,
}

/// The surface with normals.
pub(super) fn shaded(surface: &SurfaceMesh) -> Shaded {
    let areas: Vec<Vec3> = surface.triangles.iter().map(|triangle| area_vector(surface, triangle)).collect();
    let mut around = vec![Vec::new(); surface.points.len()];
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        corners.iter().for_each(|&corner| around[corner].push(triangle));
    }
    let mut shaded = Shaded::default();
    let mut known = BTreeMap::new();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        for &corner in corners {
            let normal = single(&normal(&areas, &around[corner], triangle));
            // Equal sums in equal order have equal bits.
            let vertex = *known.entry((corner, normal.map(f32::to_bits))).or_insert_with(|| {
                shaded.positions.push(single(&surface.points[corner]));
                shaded.normals.push(normal);
                shaded.positions.len() - 1
            });
            shaded.indices.push(u32::try_from(vertex).unwrap_or(u32::MAX));
        }
    }
    shaded
}

/// Twice the area along the outward normal \[m²\].
fn area_vector(surface: &SurfaceMesh, triangle: &[usize; 3]) -> Vec3 {
    let [a, b, c] = triangle.map(|corner| surface.points[corner]);
    (b - a).cross(&(c - a))
}

/// The normal of a triangle at a corner around which others stand.
fn normal(areas: &[Vec3], around: &[usize], triangle: usize) -> Vec3 {
    let own = areas[triangle];
    let smooth = |other: &&usize| areas[**other].dot(&own) >= libm::cos(CREASE) * areas[**other].norm() * own.norm();
    let sum: Vec3 = around.iter().filter(smooth).map(|other| areas[*other]).sum();
    // A triangle without area has no normal of its own; any will do, since it is not seen.
    sum.try_normalize(0.0).or(own.try_normalize(0.0)).unwrap_or_else(Vec3::z)
}

/// In single precision.
pub(super) fn single(vector: &Vec3) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> SurfaceMesh {
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let corner = |k: usize| Vec3::from_fn(|axis, _| if k >> axis & 1 == 1 { 1.0 } else { -1.0 });
        let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        SurfaceMesh { points: (0..8).map(corner).collect(), triangles }
    }

    #[test]
    fn edges_of_a_cube_are_sharp_and_its_faces_flat() {
        let shaded = shaded(&cube());
        assert_eq!((shaded.positions.len(), shaded.indices.len()), (24, 36));
        for (position, normal) in shaded.positions.iter().zip(&shaded.normals) {
            assert_eq!(normal.iter().filter(|x| x.abs() == 1.0).count(), 1, "{normal:?}");
            let outward: f32 = position.iter().zip(normal).map(|(x, n)| x * n).sum();
            assert_eq!(outward, 1.0);
        }
    }

    #[test]
    fn a_ball_is_smooth() {
        // An octahedron divided in 8² and pushed out: faces meet at less than 20°.
        let mut ball = SurfaceMesh { points: Vec::new(), triangles: Vec::new() };
        for octant in 0..8_usize {
            let sign = |axis: usize| if octant >> axis & 1 == 1 { -1.0 } else { 1.0 };
            let mut vertex = |i: usize, j: usize| {
                let point = Vec3::new(sign(0) * (8 - i - j) as f64, sign(1) * i as f64, sign(2) * j as f64).normalize();
                ball.points.iter().position(|p| (p - point).norm() < 1e-9).unwrap_or_else(|| {
                    ball.points.push(point);
                    ball.points.len() - 1
                })
            };
            let mut triangles = Vec::new();
            for (i, j) in (0..8).flat_map(|i| (0..8 - i).map(move |j| (i, j))) {
                triangles.push([vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)]);
                if i + j < 7 {
                    triangles.push([vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
                }
            }
            let mirrored = octant.count_ones() % 2 == 1;
            ball.triangles.extend(triangles.iter().map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] }));
        }
        let shaded = shaded(&ball);
        assert_eq!(shaded.positions.len(), ball.points.len());
        for (position, normal) in shaded.positions.iter().zip(&shaded.normals) {
            let along: f32 = position.iter().zip(normal).map(|(x, n)| x * n).sum();
            assert!(along > 0.99, "{position:?} {normal:?}");
        }
    }
}
