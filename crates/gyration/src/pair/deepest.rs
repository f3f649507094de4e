//! The shortest way apart of two convex bodies that overlap.
//!
//! With h(n) = max n·(B − A), the way n separates A from B after h(n), and the shortest is the face next to the origin
//! of the convex body B − A. A polytope of its points is grown at the face next to the origin, with offset c:
//!
//!   c ≤ least h ≤ h(n)
//!
//! It ends when the two agree. The faces of polyhedra, and the planes along an edge of each, are met exactly; round
//! bodies are approached. Source: van den Bergen 2001 (expanding polytopes).

use crate::tensor::Vec3;

/// A point of B − A, given a direction: the farthest along it.
pub(super) trait Support {
    fn farthest(&self, direction: &Vec3) -> Vec3;
}

impl<F: Fn(&Vec3) -> Vec3> Support for F {
    fn farthest(&self, direction: &Vec3) -> Vec3 {
        self(direction)
    }
}

/// The part of the depth to which it is found.
const PRECISION: f64 = 1e-3;
/// More points than bodies take whose faces can be told apart.
const MOST_POINTS: usize = 400;
/// A distance that is none, relative to the size.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A triangle of the polytope, outward: n·x = offset.
#[derive(Debug, Clone, Copy)]
struct Face {
    corners: [usize; 3],
    normal: Vec3,
    offset: f64,
}

/// A polytope of points of a convex body.
struct Polytope {
    points: Vec<Vec3>,
    faces: Vec<Face>,
}

/// The way n, and how far along it [m]: not positive, where it separates the two as they are. None of bodies that span
/// no volume, or whose numbers are none.
pub(super) fn shortest_way(body: &impl Support) -> Option<(Vec3, f64)> {
    let mut polytope = Polytope::begin(body)?;
    let mut best: Option<(Vec3, f64)> = None;
    while polytope.points.len() < MOST_POINTS {
        let face = *polytope.faces.iter().min_by(|one, other| one.offset.total_cmp(&other.offset))?;
        let farthest = body.farthest(&face.normal);
        let depth = farthest.dot(&face.normal);
        if best.is_none_or(|(_, least)| depth < least) {
            best = Some((face.normal, depth));
        }
        let rounding = ROUNDING * farthest.norm();
        // A way that separates them ends it as well.
        if depth <= 0.0 || depth - face.offset <= PRECISION * face.offset.abs() + rounding {
            break;
        }
        if !polytope.grow(farthest, rounding) {
            break;
        }
    }
    best.filter(|(_, depth)| depth.is_finite())
}

impl Polytope {
    /// A tetrahedron of four points in general position.
    fn begin(body: &impl Support) -> Option<Self> {
        let ends = |direction: &Vec3| [body.farthest(direction), body.farthest(&-direction)];
        let [first, second] = ends(&Vec3::x());
        let across = any_across(&(second - first))?;
        let line = (second - first).normalize();
        let off_line = |point: &Vec3| (point - first - line * line.dot(&(point - first))).norm();
        let sideways = [across, line.cross(&across)].map(|direction| ends(&direction));
        let third = sideways.into_iter().flatten().max_by(|a, b| off_line(a).total_cmp(&off_line(b)))?;
        let normal = (second - first).cross(&(third - first)).try_normalize(0.0)?;
        let off_plane = |point: &Vec3| normal.dot(&(point - first)).abs();
        let fourth = ends(&normal).into_iter().max_by(|a, b| off_plane(a).total_cmp(&off_plane(b)))?;
        let size = (second - first).norm();
        if off_plane(&fourth) <= ROUNDING * size {
            return None;
        }
        let mut polytope = Self { points: vec![first, second, third, fourth], faces: Vec::new() };
        let inside = polytope.points.iter().sum::<Vec3>() / 4.0;
        for [a, b, c] in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
            let face = polytope.face([a, b, c])?;
            let outward = face.normal.dot(&inside) < face.offset;
            let face = if outward { face } else { polytope.face([a, c, b])? };
            polytope.faces.push(face);
        }
        Some(polytope)
    }

    /// The face of three of its points; none of points on a line.
    fn face(&self, corners: [usize; 3]) -> Option<Face> {
        let [a, b, c] = corners.map(|corner| self.points[corner]);
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
        Some(Face { corners, normal, offset: normal.dot(&a) })
    }

    /// Takes a point in; false if it is on the polytope already.
    fn grow(&mut self, point: Vec3, rounding: f64) -> bool {
        let new = self.points.len();
        self.points.push(point);
        let sees = |face: &Face| face.normal.dot(&point) > face.offset + rounding;
        let mut horizon: Vec<[usize; 2]> = Vec::new();
        for face in self.faces.iter().filter(|face| sees(face)) {
            let [a, b, c] = face.corners;
            for edge in [[a, b], [b, c], [c, a]] {
                // An edge within what is seen comes once from each side.
                match horizon.iter().position(|other| *other == [edge[1], edge[0]]) {
                    Some(twin) => drop(horizon.swap_remove(twin)),
                    None => horizon.push(edge),
                }
            }
        }
        self.faces.retain(|face| !sees(face));
        let made: Option<Vec<Face>> = horizon.iter().map(|[a, b]| self.face([*a, *b, new])).collect();
        match made {
            Some(made) if !made.is_empty() => {
                self.faces.extend(made);
                true
            }
            _ => false,
        }
    }
}

/// A unit vector across a vector; none across zero.
fn any_across(vector: &Vec3) -> Option<Vec3> {
    vector.cross(&Vec3::ith(vector.iamin(), 1.0)).try_normalize(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_face_next_to_the_origin_is_found_of_a_box_and_of_a_ball() {
        let center = Vec3::new(0.1, -0.2, 0.4999);
        let cube = |d: &Vec3| center + d.map(|c| if c < 0.0 { -0.5 } else { 0.5 });
        let (way, depth) = shortest_way(&cube).unwrap();
        assert!((way + Vec3::z()).norm() < 1e-12 && (depth - 1e-4).abs() < 1e-12, "{way:?} {depth}");
        let center = Vec3::new(0.3, -0.2, 0.1);
        for depth in [1e-7, 1e-3, 0.2] {
            let radius = center.norm() + depth;
            let ball = |d: &Vec3| center + radius * d.normalize();
            let (way, found) = shortest_way(&ball).unwrap();
            assert!((found / depth - 1.0).abs() < 2.0 * PRECISION, "{found} for {depth}");
            assert!((way + center.normalize()).norm() < (8.0 * PRECISION * depth / radius).sqrt(), "{way:?}");
        }
    }

    #[test]
    fn a_way_that_separates_is_found_and_a_plate_without_volume_has_none() {
        let apart = |d: &Vec3| Vec3::new(2.0, 0.0, 0.0) + d.map(f64::signum);
        // Not positive: a way along which they touch is one.
        assert!(shortest_way(&apart).unwrap().1 <= 0.0);
        let plate = |d: &Vec3| Vec3::new(d.x.signum(), d.y.signum(), 0.0);
        assert_eq!(shortest_way(&plate), None);
    }
}
