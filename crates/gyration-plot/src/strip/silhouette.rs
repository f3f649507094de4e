//! A body as it is seen from the side: its outline and its edges.
//!
//! The outline is the hull of the projected points. An edge is behind the body if it lies deeper than the centre of
//! mass and inside the outline: exact for shapes with a centre, near enough for the others; what is behind is drawn
//! faintly.

use super::view::View;
use crate::draw::Point;
use crate::recorded::{BodyPicture, Pose};
use gyration::tensor::Vec3;

/// A body seen from the side [m].
#[derive(Debug, Clone, PartialEq)]
pub struct Silhouette {
    /// Which body.
    pub body: usize,
    /// The outline, in order around; not closed.
    pub hull: Vec<Point>,
    /// Edges in front.
    pub front: Vec<Vec<Point>>,
    /// Edges behind.
    pub behind: Vec<Vec<Point>>,
    /// The centre of mass.
    pub center: Point,
    /// The body's size times its largest stretch [m].
    pub size: f64,
    /// Whether the centre of mass is not in the middle of the body, so that it is worth a mark.
    pub lopsided: bool,
}

/// A centre of mass this far from the middle of the bounding box is off it, as a fraction of the size.
const OFF_MIDDLE: f64 = 0.02;

impl Silhouette {
    /// The body of this index in a pose.
    pub fn of(index: usize, body: &BodyPicture, pose: &Pose, view: &View) -> Self {
        let place = |point: &Vec3| pose.position + pose.gradient * point;
        let seen = |points: &[Vec3]| points.iter().map(|p| view.project(&place(p))).collect::<Vec<Point>>();
        let hull = convex_hull(seen(&body.look.silhouette));
        let depth = |point: &Vec3| view.depth(&(pose.gradient * point));
        let points = seen(&body.look.outline.points);
        let depths: Vec<f64> = body.look.outline.points.iter().map(depth).collect();
        let inside = Inside::of(&hull);
        let mut this = Self {
            body: index,
            hull,
            front: Vec::new(),
            behind: Vec::new(),
            center: view.project(&pose.position),
            size: body.size * pose.gradient.singular_values().max(),
            lopsided: is_lopsided(body),
        };
        for line in &body.look.outline.polylines {
            this.add_line(line, &points, |a, b, middle| {
                // Within a hundredth of the size of the outline an edge is part of it.
                depths[a] + depths[b] < -1e-6 * body.size && inside.distance(middle) > 0.01 * body.size
            });
        }
        this
    }

    /// Divides a line into what is in front and what is behind, which is told of the ends and the middle of an edge.
    fn add_line(&mut self, line: &[usize], points: &[Point], is_behind: impl Fn(usize, usize, Point) -> bool) {
        let mut current: Option<(bool, Vec<Point>)> = None;
        for pair in line.windows(2) {
            let (Some(a), Some(b)) = (points.get(pair[0]), points.get(pair[1])) else { continue };
            let behind = is_behind(pair[0], pair[1], [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
            match &mut current {
                Some((side, run)) if *side == behind => run.push(*b),
                _ => {
                    self.keep(current.take());
                    current = Some((behind, vec![*a, *b]));
                }
            }
        }
        self.keep(current);
    }

    fn keep(&mut self, run: Option<(bool, Vec<Point>)>) {
        match run {
            Some((true, points)) => self.behind.push(points),
            Some((false, points)) => self.front.push(points),
            None => {}
        }
    }

    /// All points that are drawn.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        let edges = self.front.iter().chain(&self.behind).flatten();
        self.hull.iter().chain(edges).chain([&self.center])
    }
}

/// Whether the centre of mass, the origin of the outline, is off the middle.
fn is_lopsided(body: &BodyPicture) -> bool {
    let start = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let (low, high) = body.look.silhouette.iter().fold(start, |(low, high), point| (low.inf(point), high.sup(point)));
    // Without points the middle is not a number, and nothing is off it.
    (0.5 * (low + high)).norm() > OFF_MIDDLE * body.size
}

fn cross(o: Point, a: Point, b: Point) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

/// The convex hull, counterclockwise: Andrew's monotone chain.
pub fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.retain(|point| point.iter().all(|c| c.is_finite()));
    leave_out_inner(&mut points);
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && cross(a, b, *point) <= 0.0
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    hull
}

/// Points from which on most are looked for inside before all are sorted.
const MANY: usize = 32;

/// Leaves out points within the octagon of those that are outermost along eight directions: none is a corner of the
/// hull. Source: Akl and Toussaint, *A fast convex hull algorithm*, Inf. Process. Lett. 7 (1978).
fn leave_out_inner(points: &mut Vec<Point>) {
    if points.len() < MANY {
        return;
    }
    // Counterclockwise.
    let directions =
        [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];
    let along = |direction: &Point, point: &Point| direction[0] * point[0] + direction[1] * point[1];
    let mut outermost = [points[0]; 8];
    for point in points.iter() {
        for (direction, outermost) in directions.iter().zip(&mut outermost) {
            if along(direction, point) > along(direction, outermost) {
                *outermost = *point;
            }
        }
    }
    let sides: Vec<[Point; 2]> =
        (0..8).map(|k| [outermost[k], outermost[(k + 1) % 8]]).filter(|[a, b]| a != b).collect();
    // All at one place have no sides.
    points.retain(|point| sides.is_empty() || sides.iter().any(|[a, b]| cross(*a, *b, *point) <= 0.0));
}

/// The inside of a convex outline: of each side, a point and the unit normal inward.
struct Inside(Vec<(Point, Point)>);

impl Inside {
    fn of(hull: &[Point]) -> Self {
        let side = |(a, b): (&Point, &Point)| {
            let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
            (*a, [(a[1] - b[1]) / length, (b[0] - a[0]) / length])
        };
        Self(hull.iter().zip(hull.iter().cycle().skip(1)).map(side).collect())
    }

    /// The distance to the nearest side, negative outside.
    fn distance(&self, point: Point) -> f64 {
        let distance = |(a, n): &(Point, Point)| (point[0] - a[0]) * n[0] + (point[1] - a[1]) * n[1];
        self.0.iter().map(distance).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recorded::{Look, Wireframe};
    use gyration::tensor::Mat3;
    use std::sync::Arc;

    fn cube() -> BodyPicture {
        let corner = |k: usize| Vec3::from_fn(|axis, _| if k >> axis & 1 == 0 { -0.5 } else { 0.5 });
        let points: Vec<Vec3> = (0..8).map(corner).collect();
        let edges = (0..8).flat_map(|k| [1, 2, 4].map(|bit| (k, k ^ bit))).filter(|(a, b)| a < b);
        let polylines = edges.map(|(a, b)| vec![a, b]).collect();
        let outline = Wireframe { points: points.clone(), polylines };
        let (name, kind) = ("cube".into(), "rigid".into());
        let look = Arc::new(Look { outline, silhouette: points });
        BodyPicture { name, kind, mass: 1.0, size: 1.0, look, volume: None, period: None }
    }

    #[test]
    fn three_edges_of_a_cube_on_its_corner_are_behind() {
        let view = View { right: Vec3::x(), up: Vec3::z(), toward: -Vec3::y(), raised: false };
        // A diagonal of the cube turned into the line of sight.
        let y = Vec3::new(1.0, 1.0, 1.0).normalize();
        let x = Vec3::new(1.0, -1.0, 0.0).normalize();
        let gradient = Mat3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
        let seen = Silhouette::of(0, &cube(), &Pose { position: Vec3::zeros(), gradient }, &view);
        assert_eq!(seen.hull.len(), 6);
        assert_eq!((seen.front.len(), seen.behind.len()), (9, 3));
    }

    #[test]
    fn a_cube_that_is_sheared_is_seen_as_a_parallelogram() {
        let view = View { right: Vec3::x(), up: Vec3::z(), toward: -Vec3::y(), raised: false };
        let gradient = Mat3::new(1.0, 0.0, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0);
        let seen = Silhouette::of(0, &cube(), &Pose { position: Vec3::zeros(), gradient }, &view);
        let corners = [[-0.75, -1.0], [0.25, -1.0], [0.75, 1.0], [-0.25, 1.0]];
        assert_eq!(seen.hull, corners);
        assert!((seen.size - gradient.norm().min(seen.size)).abs() < 1e-15 && seen.size > 2.0);
    }

    #[test]
    fn a_centre_of_mass_off_the_middle_is_marked() {
        let mut body = cube();
        assert!(!is_lopsided(&body));
        Arc::make_mut(&mut body.look).silhouette.iter_mut().for_each(|point| point.z += 0.1);
        assert!(is_lopsided(&body));
        Arc::make_mut(&mut body.look).silhouette.clear();
        assert!(!is_lopsided(&body));
    }

    #[test]
    fn hulls_leave_out_what_is_inside_or_not_finite() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let inside = [[0.5, 0.5], [0.5, 0.0], [f64::NAN, 0.0]];
        let hull = convex_hull(square.into_iter().chain(inside).collect());
        assert_eq!(hull, square);
        let inside = Inside::of(&hull);
        assert!((inside.distance([0.5, 0.25]) - 0.25).abs() < 1e-15);
        assert!(inside.distance([2.0, 0.5]) < 0.0);
    }

    #[test]
    fn hulls_of_many_points_are_those_of_all() {
        // A spiral, points along lines, and many at one place.
        let spiral = (0..400).map(f64::from).map(|k| [k * libm::cos(2.4 * k), 0.3 * k * libm::sin(2.4 * k)]);
        let grid = (0..100).map(|k| [f64::from(k % 10), f64::from(k / 10)]);
        let line = (0..50).map(|k| [f64::from(k), 2.0 * f64::from(k)]);
        let place = (0..50).map(|_| [0.5, -0.5]);
        for points in [spiral.collect::<Vec<Point>>(), grid.collect(), line.collect(), place.collect()] {
            let hull = convex_hull(points.clone());
            let outside = |point: &Point| {
                let sides = hull.iter().zip(hull.iter().cycle().skip(1));
                sides.map(|(a, b)| cross(*a, *b, *point)).fold(f64::INFINITY, f64::min) < -1e-9
            };
            assert!(hull.len() < 3 || !points.iter().any(outside), "{hull:?}");
            // The same as of halves that are few enough to be sorted as they are.
            let parts = points.chunks(MANY - 1).flat_map(|part| convex_hull(part.to_vec())).collect::<Vec<Point>>();
            let few = parts.chunks(MANY - 1).flat_map(|part| convex_hull(part.to_vec())).collect::<Vec<Point>>();
            assert_eq!(convex_hull(few), hull);
        }
        assert_eq!(convex_hull((0..100).map(|k| [f64::from(k % 10), f64::from(k / 10)]).collect()).len(), 4);
    }

    #[test]
    fn edges_with_indices_outside_are_left_out() {
        let mut body = cube();
        Arc::make_mut(&mut body.look).outline.polylines = vec![vec![0, 99], vec![0, 1]];
        let view = View { right: Vec3::x(), up: Vec3::z(), toward: -Vec3::y(), raised: false };
        let pose = Pose { position: Vec3::zeros(), gradient: Mat3::identity() };
        let seen = Silhouette::of(0, &body, &pose, &view);
        assert_eq!(seen.front.len() + seen.behind.len(), 1);
    }
}
