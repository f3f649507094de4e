//! The convex hull of points: which points have one, and the hull on its corners only.
//!
//! The hull itself is made by `insertion`, with exact signs: there is nothing to go wrong with grids, plates or
//! needles, where a tolerance loses corners. Before that, points that span no volume are refused; behind it, vertices
//! that lie within a face or an edge are left out.

use crate::insertion::Cloud;
use gyration::shape::Polyhedron;
use gyration::tensor::{Mat3, Vec3};

/// Thickness, relative to size, below which points lie in a plane: their own rounding is 1e-16 of their coordinates.
const FLAT: f64 = 1e-9;

/// Points that have no convex hull with a volume.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HullError {
    /// A coordinate is infinite or not a number, or too large to compute with.
    #[error("vertex {vertex} (counted from 0) has the coordinate {value}: it must be finite and below 1e100 m")]
    NotFinite {
        /// Index of the point.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
    /// Fewer than four different points.
    #[error("{distinct} different vertices (of {given}): a polyhedron needs at least 4 that do not lie in a plane")]
    TooFew {
        /// Number of points given.
        given: usize,
        /// Number of different ones.
        distinct: usize,
    },
    /// All points lie in a plane or on a line.
    #[error(
        "the {count} vertices lie {place}: they span {size:e} m, but only {thickness:e} m across; \
         a polyhedron needs a thickness above 1e-9 of its size"
    )]
    Flat {
        /// Number of different points.
        count: usize,
        /// "in a plane" or "on a line".
        place: &'static str,
        /// Extent along the longest principal axis \[m\].
        size: f64,
        /// Extent along the axis that is too short \[m\].
        thickness: f64,
    },
}

/// The convex hull of `points`: triangles counter-clockwise from outside, on its corners only.
///
/// Several triangles may share a face. Points within, also within faces and edges, and repeated points are left out.
///
/// # Errors
/// [`HullError`]: fewer than four points, no volume, a coordinate that is not finite.
pub fn hull(points: &[Vec3]) -> Result<Polyhedron, HullError> {
    check_finite(points)?;
    let distinct = distinct(points);
    let count = distinct.len();
    if count < 4 {
        return Err(HullError::TooFew { given: points.len(), distinct: count });
    }
    check_thickness(&distinct)?;
    let cloud = Cloud::new(&distinct);
    let all: Vec<usize> = (0..count).collect();
    let corners = cloud.corners(&cloud.triangles(&all));
    let mut place = vec![0; count];
    corners.iter().enumerate().for_each(|(new, &old)| place[old] = new);
    let triangles = cloud.triangles(&corners).iter().map(|triangle| triangle.map(|old| place[old])).collect();
    let made = Polyhedron { vertices: corners.iter().map(|&index| distinct[index]).collect(), triangles };
    // Points on a needle of 1e-9 or so of its size may pass for a volume above, and have none.
    match made.validate() {
        Ok(()) => Ok(made),
        Err(_) => {
            let size = distinct.iter().map(|point| (point - distinct[0]).amax()).fold(0.0, f64::max);
            Err(HullError::Flat { count, place: "in a plane", size, thickness: FLAT * size })
        }
    }
}

fn check_finite(points: &[Vec3]) -> Result<(), HullError> {
    for (vertex, point) in points.iter().enumerate() {
        if let Some(&value) = point.iter().find(|value| value.is_nan() || value.abs() > 1e100) {
            return Err(HullError::NotFinite { vertex, value });
        }
    }
    Ok(())
}

/// The different points in the order of their first appearance.
fn distinct(points: &[Vec3]) -> Vec<Vec3> {
    let mut seen = std::collections::HashSet::with_capacity(points.len());
    points.iter().filter(|point| seen.insert(bits(point.as_slice()))).copied().collect()
}

/// Coordinates as a key; −0 counts as 0.
fn bits(coordinates: &[f64]) -> [u64; 3] {
    std::array::from_fn(|axis| (coordinates[axis] + 0.0).to_bits())
}

/// Refuses points on a line or in a plane.
fn check_thickness(points: &[Vec3]) -> Result<(), HullError> {
    let first = points[0];
    let size = points.iter().map(|point| (point - first).amax()).fold(0.0, f64::max);
    let mut scaled: Vec<Vec3> = points.iter().map(|point| (point - first) / size).collect();
    let mean = scaled.iter().sum::<Vec3>() / points.len() as f64;
    scaled.iter_mut().for_each(|point| *point -= mean);
    let extents = principal_axes(&scaled).map(|axis| extent(&scaled, &axis));
    for (thickness, place) in [(extents[1], "on a line"), (extents[0], "in a plane")] {
        if thickness <= FLAT * extents[2] {
            let (size, thickness) = (extents[2] * size, thickness * size);
            return Err(HullError::Flat { count: points.len(), place, size, thickness });
        }
    }
    Ok(())
}

/// Principal axes of a cloud about its mean, right-handed, by ascending spread.
fn principal_axes(points: &[Vec3]) -> [Vec3; 3] {
    let covariance: Mat3 = points.iter().map(|point| point * point.transpose()).sum();
    let eigen = covariance.symmetric_eigen();
    let axis = |k: usize| eigen.eigenvectors.column(k).into_owned();
    let mut axes = [axis(0), axis(1), axis(2)];
    // By the extent itself: an eigenvalue resolves it to 1e-8 of the size only.
    axes.sort_by(|a, b| extent(points, a).total_cmp(&extent(points, b)));
    axes[2] = axes[0].cross(&axes[1]);
    axes
}

fn extent(points: &[Vec3], axis: &Vec3) -> f64 {
    let heights = || points.iter().map(|point| point.dot(axis));
    heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// Points (i, j, k) with 0 ≤ i, j, k < n.
    fn grid(n: usize) -> Vec<Vec3> {
        (0..n * n * n).map(|k| Vec3::new((k % n) as f64, (k / n % n) as f64, (k / n / n) as f64)).collect()
    }

    /// A stream of numbers in [0, 1) (xorshift), so that a failure repeats.
    fn random() -> impl FnMut() -> f64 {
        let mut state = 88172645463325252_u64;
        move || {
            for shift in [13, -7, 17] {
                state ^= if shift > 0 { state << shift } else { state >> -shift };
            }
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    #[test]
    fn corners_of_a_box_are_its_hull_whatever_else_is_given() {
        let mut points = grid(3);
        points.extend(grid(3));
        points.push(Vec3::new(-0.0, 2.0, 0.0));
        let hull = hull(&points).unwrap();
        assert_eq!((hull.vertices.len(), hull.triangles.len()), (8, 12));
        assert!((hull.mass_properties(1.0).volume - 8.0).abs() < 1e-14);
        assert!(hull.vertices.iter().all(|vertex| points.contains(vertex)), "vertices are points that were given");
    }

    #[test]
    fn octahedron_is_its_own_hull() {
        let points: Vec<Vec3> = (0..3).flat_map(|k| [Vec3::ith(k, 1.0), Vec3::ith(k, -1.0)]).collect();
        let hull = hull(&points).unwrap();
        assert_eq!((hull.vertices.len(), hull.triangles.len()), (6, 8));
        assert!((hull.mass_properties(1.0).volume - 4.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn thin_plates_and_needles_have_a_hull() {
        let turn = Rotation3::from_euler_angles(0.3, 0.7, 1.1);
        for exponent in 0..=8 {
            let thickness = 10_f64.powi(-exponent);
            for size in [Vec3::new(1.0, 1.0, thickness), Vec3::new(1.0, thickness, thickness)] {
                let points: Vec<Vec3> = grid(4).iter().map(|point| turn * point.component_mul(&size)).collect();
                let hull = hull(&points).unwrap();
                assert_eq!(hull.validate(), Ok(()), "{size}");
                let volume = hull.mass_properties(1.0).volume;
                // The volume is a sum of some hundred terms of up to (5 m)³, each rounded to 1e-16 of that.
                let error = (volume - 27.0 * size.product()).abs();
                assert!(error < 1e-14, "{size}: {volume:e}, off by {error:e}");
            }
        }
    }

    /// Took minutes: every point was compared with every triangle.
    #[test]
    fn thousands_of_points_on_a_sphere_have_a_hull_soon() {
        let mut random = random();
        let points: Vec<Vec3> = (0..20_000).map(|_| Vec3::from_fn(|_, _| random() - 0.5).normalize()).collect();
        let hull = hull(&points).unwrap();
        // Each is a corner, and a closed surface of triangles on n corners has 2n − 4.
        assert_eq!((hull.vertices.len(), hull.triangles.len()), (20_000, 39_996));
        assert_eq!(hull.validate(), Ok(()));
    }

    /// Products of such coordinates underflow, and signs were wrong.
    #[test]
    fn coordinates_of_all_sizes_have_a_hull() {
        let mut random = random();
        for trial in 0..2000 {
            let mut coordinate = || (random() - 0.5) * 10_f64.powf(-320.0 * random() * random());
            let points: Vec<Vec3> = (0..12).map(|_| Vec3::from_fn(|_, _| coordinate())).collect();
            if let Ok(hull) = hull(&points) {
                hull.validate().unwrap_or_else(|fault| panic!("{trial}: {fault}"));
            }
        }
    }

    #[test]
    fn points_without_a_volume_are_refused() {
        let line: Vec<Vec3> = (0..10).map(|k| Vec3::new(1.0, 2.0, 3.0) * f64::from(k)).collect();
        let plane: Vec<Vec3> = grid(3).iter().map(|p| Vec3::new(p.x, p.y, p.x + 2.0 * p.y)).collect();
        let thin: Vec<Vec3> = grid(2).iter().map(|p| Vec3::new(p.x, p.y, 1e-12 * p.z)).collect();
        assert_eq!(hull(&[]), Err(HullError::TooFew { given: 0, distinct: 0 }));
        assert_eq!(hull(&[Vec3::x(); 10]), Err(HullError::TooFew { given: 10, distinct: 1 }));
        assert_eq!(hull(&grid(2)[..3]), Err(HullError::TooFew { given: 3, distinct: 3 }));
        assert!(matches!(hull(&line), Err(HullError::Flat { place: "on a line", .. })));
        assert!(matches!(hull(&plane), Err(HullError::Flat { place: "in a plane", .. })));
        assert!(matches!(hull(&thin), Err(HullError::Flat { place: "in a plane", count: 8, .. })));
    }

    #[test]
    fn coordinates_that_are_not_finite_are_named() {
        for value in [f64::NAN, f64::INFINITY, -1e200] {
            let mut points = grid(2);
            points[5].y = value;
            assert!(matches!(hull(&points), Err(HullError::NotFinite { vertex: 5, .. })), "{value}");
        }
    }

    #[test]
    fn random_clouds_full_of_coincidences_have_a_hull() {
        let mut random = random();
        let mut computed = 0;
        for trial in 0..4000 {
            let turn = Rotation3::from_euler_angles(random(), 6.0 * random(), 6.0 * random());
            let (thickness, noise) = (10_f64.powf(-6.0 * random()), 10_f64.powf(-16.0 * random()));
            let mut point = |_| {
                let lattice = Vec3::from_fn(|_, _| (3.0 * random()).floor());
                match trial % 4 {
                    0 => turn * lattice,
                    1 => turn * lattice.component_mul(&Vec3::new(1.0, 1.0, thickness)),
                    2 => turn * (lattice + Vec3::from_fn(|_, _| noise * (random() - 0.5))),
                    _ => Vec3::from_fn(|_, _| random() - 0.5).normalize(),
                }
            };
            let points: Vec<Vec3> = (0..8 + trial % 40).map(&mut point).collect();
            if let Ok(hull) = hull(&points) {
                hull.validate().unwrap_or_else(|fault| panic!("{trial}: {fault}"));
                let cloud = Cloud::new(&[hull.vertices.as_slice(), &points].concat());
                for triangle in &hull.triangles {
                    let is_above = |index| cloud.height(*triangle, index) > 0.0;
                    assert!(!(0..cloud.0.len()).any(is_above), "{trial}: a point lies outside");
                }
                computed += 1;
            }
        }
        assert!(computed > 3900, "{computed}");
    }
}
