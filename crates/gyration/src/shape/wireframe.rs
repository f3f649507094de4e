//! Which edges of a mesh a picture shows: those where the surface bends by more than [`SHARP_ANGLE`].
//!
//! With N₁, N₂ the unit normals at an edge the angle is arccos N₁·N₂. The sharpest edges come first; when the points
//! run out the flattest are left away. A surface that bends nowhere as much (a fine mesh of a smooth body) shows its
//! sharpest edges all the same, so that it is not invisible.

use super::edges::half_edges;
use super::outline::Outline;
use crate::tensor::Vec3;

/// The smallest angle between faces that is drawn \[rad\]: 15°.
const SHARP_ANGLE: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Angle below which two faces are one plane \[rad\]; single-precision meshes stay below it.
const PLANE_ANGLE: f64 = 1e-3;
/// Upper limit of the points of an outline.
const OUTLINE_POINTS: usize = 2000;

/// The wireframe of a surface: one line per sharp edge.
pub(super) fn sharp_edges(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Outline {
    let normals: Vec<Vec3> =
        triangles.iter().map(|triangle| unit_normal(triangle.map(|corner| vertices[corner]))).collect();
    let mut bent: Vec<(f64, [usize; 2])> = half_edges(triangles)
        .chunk_by(|a, b| a.ends == b.ends)
        .map(|meeting| {
            let (a, b) = (normals[meeting[0].triangle], normals[meeting[meeting.len() - 1].triangle]);
            (libm::atan2(a.cross(&b).norm(), a.dot(&b)), meeting[0].ends)
        })
        .filter(|(angle, _)| *angle > PLANE_ANGLE)
        .collect();
    // A stable sort: edges that bend alike stay in the order of their indices.
    bent.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    if bent.first().is_some_and(|(angle, _)| *angle > SHARP_ANGLE) {
        bent.retain(|(angle, _)| *angle > SHARP_ANGLE);
    }
    collect(vertices, bent.into_iter().map(|(_, edge)| edge))
}

/// Lines along edges, as many as the points allow.
fn collect(vertices: &[Vec3], edges: impl Iterator<Item = [usize; 2]>) -> Outline {
    let mut outline = Outline::default();
    let mut drawn = vec![None; vertices.len()];
    for edge in edges {
        let new = edge.iter().filter(|&&vertex| drawn[vertex].is_none()).count();
        if outline.points.len() + new > OUTLINE_POINTS {
            break;
        }
        let line = edge.map(|vertex| {
            *drawn[vertex].get_or_insert_with(|| {
                outline.points.push(vertices[vertex]);
                outline.points.len() - 1
            })
        });
        outline.polylines.push(line.to_vec());
    }
    outline
}

/// The unit normal of a triangle; zero if it has no area, which then counts as flat.
fn unit_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_else(Vec3::zeros)
}
