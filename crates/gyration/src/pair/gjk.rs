//! A plane between two convex bodies: the point next to the origin of the differences of their points.
//!
//! A − B is convex, and v, its point next to the origin, is the shortest way between them. It is approached by the
//! hulls of up to four of its points, w being the farthest against v:
//!
//!   v·w/|v| ≤ width of the slab along v ≤ distance ≤ |v|
//!
//! It ends when the slab is half as wide as |v|. Source: Gilbert, Johnson and Keerthi 1988.

use super::plane::{Guess, Plane};
use super::side::Half;
use crate::tensor::{Mat3, Vec3};

/// The part of the distance that the slab of the plane has at least.
const PART: f64 = 0.5;

/// A height above the others, relative to the longest edge, at which a point is among them.
const FLAT: f64 = 1e-7;

/// The most points of a hull in space that its point next to the origin is between.
const POINTS: usize = 4;

/// More steps than convex bodies take whose gap can be told from zero.
const MOST_STEPS: usize = 100;

/// A plane between two bodies; the width of the slab between them [m], not positive, if there is none.
pub(super) fn separate(halves: [&Half; 2]) -> Result<Plane, f64> {
    let [above, below] = halves;
    // A's centre is the origin.
    let mut direction = -below.columns.column(0).into_owned();
    if direction.norm_squared() <= 0.0 {
        direction = Vec3::z();
    }
    let least = above.side.least_gap + below.side.least_gap;
    let share = above.root_share * above.root_share;
    let mut simplex = Simplex::default();
    // The widest slab so far: any that is open separates the two.
    let mut best: Option<(f64, Plane)> = None;
    for _ in 0..MOST_STEPS {
        let Some(normal) = direction.try_normalize(0.0) else { break };
        let lowest = above.lowest(&normal);
        let difference = lowest - below.lowest(&-normal);
        let slab = difference.dot(&normal);
        if best.as_ref().is_none_or(|(width, _)| slab > *width) {
            best = Some((slab, Plane { normal, offset: lowest.dot(&normal) - share * slab }));
        }
        if slab >= PART * direction.norm().min(difference.norm()) || simplex.count == POINTS {
            break;
        }
        simplex.add(difference);
        direction = simplex.shrink();
    }
    match best {
        Some((width, plane)) if width > least => Ok(plane),
        best => Err(best.map_or(f64::NAN, |(width, _)| width)),
    }
}

/// The plane of a guess, unless it does not separate the bodies.
pub(super) fn guessed([above, below]: [&Half; 2], guess: &Guess) -> Option<Plane> {
    let Guess { normal, share } = *guess;
    let through_center = Plane { normal, offset: 0.0 };
    let [above_gap, below_gap] = [above, below].map(|half| half.smallest_gap(&through_center).0);
    let slab = above_gap + below_gap;
    let least = above.side.least_gap + below.side.least_gap;
    (slab > least).then_some(Plane { normal, offset: above_gap - share * slab })
}

impl Half<'_> {
    /// The place of its lowest point along a direction, from A's centre [m].
    fn lowest(&self, direction: &Vec3) -> Vec3 {
        let (_, point) = self.smallest_gap(&Plane { normal: self.sign * direction, offset: 0.0 });
        self.columns.column(0) + self.side.placement.gradient * point
    }
}

/// A hull of a few points.
#[derive(Debug, Clone, Copy, Default)]
struct Simplex {
    points: [Vec3; POINTS],
    count: usize,
}

impl Simplex {
    fn add(&mut self, point: Vec3) {
        self.points[self.count] = point;
        self.count += 1;
    }

    /// Its point next to the origin; leaves the points that this one is between. The last point is one of these, since
    /// the hull of the others is farther.
    fn shrink(&mut self) -> Vec3 {
        let last = 1 << (self.count - 1);
        let subsets = (last..2 * last).map(|subset| self.members(subset));
        let nearest = subsets.filter_map(|subset| Some((subset.nearest()?, subset)));
        let least = nearest.min_by(|(a, _), (b, _)| a.norm_squared().total_cmp(&b.norm_squared()));
        let Some((nearest, subset)) = least else { return Vec3::zeros() };
        *self = subset;
        if self.count != 3 {
            return nearest;
        }
        // Next to a face, the face tells the direction to more digits than a small difference of its points.
        let [first, second, third, _] = self.points;
        let across = (second - first).cross(&(third - first));
        match across.try_normalize(0.0) {
            Some(normal) if normal.dot(&first) != 0.0 => normal * normal.dot(&first),
            _ => nearest,
        }
    }

    /// Those of its points whose bits are set.
    fn members(&self, subset: usize) -> Self {
        let mut members = Self::default();
        for place in (0..self.count).filter(|place| subset >> place & 1 == 1) {
            members.add(self.points[place]);
        }
        members
    }

    /// The point next to the origin of the plane through all points, if it is between them; none of points that are not
    /// in general position.
    fn nearest(&self) -> Option<Vec3> {
        let first = self.points[0];
        let count = self.count - 1;
        if count == 0 {
            return Some(first);
        }
        // Edges that are not there have the weight 0.
        let edge = |i: usize| if i < count { self.points[i + 1] - first } else { Vec3::zeros() };
        let edges = [edge(0), edge(1), edge(2)];
        let mut gram = Mat3::from_fn(|i, j| edges[i].dot(&edges[j]));
        (count..3).for_each(|i| gram[(i, i)] = 1.0);
        let factors = gram.cholesky()?;
        let (pivots, longest) = (factors.l_dirty().diagonal(), edges.iter().map(Vec3::norm).fold(0.0, f64::max));
        if (0..count).any(|i| pivots[i] <= FLAT * longest) {
            return None;
        }
        let weights = factors.solve(&Vec3::from_fn(|i, _| -edges[i].dot(&first)));
        let inside = weights.iter().all(|weight| *weight >= 0.0) && weights.sum() <= 1.0;
        inside.then(|| edges.iter().zip(weights.iter()).fold(first, |sum, (edge, weight)| sum + *weight * edge))
    }
}
