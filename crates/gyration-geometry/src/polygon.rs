//! Splitting a polygon of a mesh into triangles.
//!
//! A fan from one corner. With the polygon's area vector N = ½ Σ X_k × X_{k+1} (Newell), a fan covers the polygon once
//! iff no triangle of it is turned over, n·N ≥ 0. The corner is chosen whose worst triangle is best; every convex
//! polygon and every quadrilateral has one. Of many corners some are tried: in a convex polygon any will do.

use gyration::tensor::Vec3;

use crate::fault::{FileFault, FilePlace, Trouble};

/// Turned-over area that is rounding, relative to that of the polygon; 1e-7 is single precision.
const TURNED_OVER: f64 = 1e-6;

/// The most corners that are tried as the centre of a fan: trying all of n takes n² triangles.
const MOST_TRIED: usize = 64;

/// Adds the triangles of the polygon with the given corners, all valid indices of `vertices`.
pub(crate) fn add_polygon(
    corners: &[usize],
    vertices: &[Vec3],
    triangles: &mut Vec<[usize; 3]>,
    place: FilePlace,
) -> Result<(), FileFault> {
    match *corners {
        [] | [_] | [_, _] => Err(Trouble::FewCorners { corners: corners.len() }.at(place)),
        [a, b, c] => {
            triangles.push([a, b, c]);
            Ok(())
        }
        _ => {
            let fan = best_fan(corners, vertices).ok_or(Trouble::Polygon { corners: corners.len() }.at(place))?;
            triangles.extend(fan);
            Ok(())
        }
    }
}

fn best_fan(corners: &[usize], vertices: &[Vec3]) -> Option<Vec<[usize; 3]>> {
    let area_vector = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|index| vertices[index]);
        (b - a).cross(&(c - a))
    };
    let total: Vec3 = fan(corners, 0).map(area_vector).sum();
    let worst = |start: usize| fan(corners, start).map(|t| area_vector(t).dot(&total)).fold(f64::INFINITY, f64::min);
    let stride = corners.len().div_ceil(MOST_TRIED);
    let tried = (0..corners.len()).step_by(stride).map(|start| (start, worst(start)));
    let (start, turned) = tried.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let covers_once = turned >= -TURNED_OVER * total.norm_squared();
    covers_once.then(|| fan(corners, start).collect())
}

/// The triangles between one corner and the edges that do not touch it.
fn fan(corners: &[usize], start: usize) -> impl Iterator<Item = [usize; 3]> {
    let count = corners.len();
    let corner = move |k: usize| corners[(start + k) % count];
    (1..count - 1).map(move |k| [corner(0), corner(k), corner(k + 1)])
}
