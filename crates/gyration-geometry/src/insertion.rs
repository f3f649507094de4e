//! Convex hulls by insertion, with exact predicates.
//!
//! A point p is added to a hull by taking away the triangles (a, b, c) that it sees,
//!
//!   (b−a) × (c−a) · (p−a) > 0,
//!
//! and joining it to the edges around them. The sign is exact (adaptive arithmetic of Shewchuk, crate `robust`): the
//! triangles of a face agree, what is seen is connected and bounded by one loop, and no new triangle is without area.
//!
//! Every point still outside waits at one triangle that it sees; when that goes, the point sees a new triangle or is
//! inside (on the ray from p through the point, all beyond the hull lies below what p sees). So a point meets few
//! triangles: n log n signs for points in any usual order, where asking every triangle would take n². Source: Barber,
//! Dobkin, Huhdanpaa, *The quickhull algorithm for convex hulls* (1996), with exact signs.

use std::collections::HashMap;

use gyration::tensor::Vec3;
use robust::{Coord3D, orient3d};

/// Coordinates below this part of the size count as zero: signs are exact while products of three do not underflow, and
/// a coordinate has 53 bits (2^−200, some 1e-60).
const SMALLEST: f64 = f64::from_bits((1023 - 200) << 52);

/// Points about which signs of volumes are asked.
pub(crate) struct Cloud(pub Vec<Coord3D<f64>>);

/// A triangle of a hull under way.
struct HullFace {
    corners: [usize; 3],
    /// Points that see it and wait here.
    waiting: Vec<usize>,
    /// Whether it is still part of the hull.
    stands: bool,
}

/// A hull under way: its faces, and which of them has an edge in this sense.
#[derive(Default)]
struct Hull {
    faces: Vec<HullFace>,
    face_at: HashMap<[usize; 2], usize>,
}

impl Cloud {
    /// The points in units of a power of two near their size, which is exact and keeps products of coordinates in
    /// range.
    pub(crate) fn new(points: &[Vec3]) -> Self {
        let size = points.iter().map(|point| point.amax()).fold(0.0, f64::max);
        let unit = libm::exp2(libm::log2(size).ceil());
        let scaled = |value: f64| if (value / unit).abs() < SMALLEST { 0.0 } else { value / unit };
        Self(points.iter().map(|p| Coord3D { x: scaled(p.x), y: scaled(p.y), z: scaled(p.z) }).collect())
    }

    /// The exact sign of (b−a) × (c−a) · (p−a): positive if p sees the triangle.
    pub(crate) fn height(&self, [a, b, c]: [usize; 3], p: usize) -> f64 {
        // The crate's sign is positive below.
        -orient3d(self.0[a], self.0[b], self.0[c], self.0[p])
    }

    /// The triangles of the hull of some of the points, which do not lie in a plane.
    pub(crate) fn triangles(&self, chosen: &[usize]) -> Vec<[usize; 3]> {
        let mut hull = Hull::default();
        let first = self.first_tetrahedron(chosen).map(|corners| hull.add(corners));
        self.distribute(&mut hull, chosen.iter().copied(), &first);
        // Faces are only ever added behind: those before `next` have nobody waiting any more.
        let mut next = 0;
        while next < hull.faces.len() {
            match self.farthest(&hull.faces[next]) {
                Some(point) => self.insert(&mut hull, next, point),
                None => next += 1,
            }
        }
        hull.faces.iter().filter(|face| face.stands).map(|face| face.corners).collect()
    }

    /// The waiting point that is farthest from a face: the sooner it is in, the fewer are left outside.
    fn farthest(&self, face: &HullFace) -> Option<usize> {
        let height = |point: &&usize| self.height(face.corners, **point);
        face.waiting.iter().max_by(|p, q| height(p).total_cmp(&height(q))).copied()
    }

    /// Adds a point that sees this face.
    fn insert(&self, hull: &mut Hull, seen: usize, point: usize) {
        let (seen, rim) = self.seen_from(hull, seen, point);
        let mut waiting = Vec::new();
        for index in seen {
            waiting.append(&mut hull.take(index));
        }
        let new: Vec<usize> = rim.iter().map(|&[a, b]| hull.add([a, b, point])).collect();
        self.distribute(hull, waiting.into_iter().filter(|&other| other != point), &new);
    }

    /// The faces that a point sees, from one of them on, and the edges around them.
    fn seen_from(&self, hull: &Hull, start: usize, point: usize) -> (Vec<usize>, Vec<[usize; 2]>) {
        let mut is_seen = HashMap::from([(start, true)]);
        let (mut seen, mut rim) = (vec![start], Vec::new());
        let mut at = 0;
        while let Some(&index) = seen.get(at) {
            at += 1;
            let [a, b, c] = hull.faces[index].corners;
            for side in [[a, b], [b, c], [c, a]] {
                // With exact signs the surface is closed, and there is one.
                let Some(&neighbour) = hull.face_at.get(&[side[1], side[0]]) else { continue };
                let known = is_seen.get(&neighbour).copied();
                let sees = known.unwrap_or_else(|| self.height(hull.faces[neighbour].corners, point) > 0.0);
                if known.is_none() {
                    is_seen.insert(neighbour, sees);
                    if sees {
                        seen.push(neighbour);
                    }
                }
                if !sees {
                    rim.push(side);
                }
            }
        }
        (seen, rim)
    }

    /// Lets each point wait at the first of these faces that it sees; who sees none is inside.
    fn distribute(&self, hull: &mut Hull, points: impl Iterator<Item = usize>, faces: &[usize]) {
        for point in points {
            let sees = |&&face: &&usize| self.height(hull.faces[face].corners, point) > 0.0;
            if let Some(&face) = faces.iter().find(sees) {
                hull.faces[face].waiting.push(point);
            }
        }
    }

    /// A tetrahedron of points far from each other.
    fn first_tetrahedron(&self, chosen: &[usize]) -> [[usize; 3]; 4] {
        let at = |index: usize| Vec3::new(self.0[index].x, self.0[index].y, self.0[index].z);
        let farthest = |distance: &dyn Fn(usize) -> f64| {
            let farther = |best: usize, next: &usize| if distance(*next) > distance(best) { *next } else { best };
            chosen.iter().fold(chosen[0], farther)
        };
        let a = farthest(&|p| at(p).x);
        let b = farthest(&|p| (at(p) - at(a)).norm());
        let c = farthest(&|p| (at(p) - at(a)).cross(&(at(b) - at(a))).norm());
        let d = farthest(&|p| self.height([a, b, c], p).abs());
        let [b, c] = if self.height([a, b, c], d) < 0.0 { [b, c] } else { [c, b] };
        [[a, b, c], [a, d, b], [b, d, c], [c, d, a]]
    }

    /// The vertices at which at least three faces meet; others lie within a face or an edge.
    pub(crate) fn corners(&self, triangles: &[[usize; 3]]) -> Vec<usize> {
        let mut faces_at = vec![Vec::<[usize; 3]>::new(); self.0.len()];
        for &triangle in triangles {
            for vertex in triangle {
                let is_coplanar = |other: &[usize; 3]| other.iter().all(|&corner| self.height(triangle, corner) == 0.0);
                // Three are enough: an apex of thousands of faces need not compare them all.
                if faces_at[vertex].len() < 3 && !faces_at[vertex].iter().any(is_coplanar) {
                    faces_at[vertex].push(triangle);
                }
            }
        }
        (0..self.0.len()).filter(|&vertex| faces_at[vertex].len() >= 3).collect()
    }
}

impl Hull {
    /// Adds a face and returns its index.
    fn add(&mut self, corners: [usize; 3]) -> usize {
        let [a, b, c] = corners;
        let index = self.faces.len();
        for side in [[a, b], [b, c], [c, a]] {
            self.face_at.insert(side, index);
        }
        self.faces.push(HullFace { corners, waiting: Vec::new(), stands: true });
        index
    }

    /// Takes a face away and returns who waited at it.
    fn take(&mut self, index: usize) -> Vec<usize> {
        let face = &mut self.faces[index];
        face.stands = false;
        std::mem::take(&mut face.waiting)
    }
}
