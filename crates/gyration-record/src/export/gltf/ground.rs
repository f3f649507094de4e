//! A support as a piece of its plane with a grid: as large as the motion needs, lines at 1, 2 or 5 times a power of ten
//! metres.
//!
//! Lines run through the support's origin. The sheet lies a fiftieth of the grid's step below them, so that neither
//! flickers through the other.

use super::shading::single;
use crate::export::drawing::{DrawnSupport, Vec3};

/// Steps of the grid along the longer side, about.
const STEPS: f64 = 12.0;
/// What lies around the motion on every side, in steps.
const MARGIN: f64 = 1.5;
/// The sheet's depth below the lines, in steps.
const DEPTH: f64 = 2e-2;

/// A piece of a plane, about a point of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    /// The point \[m\].
    pub center: Vec3,
    /// The unit normal.
    pub normal: Vec3,
    /// Corners, counter-clockwise seen from the free side, from the centre \[m\].
    pub corners: [[f32; 3]; 4],
    /// Ends of lines, two by two, from the centre \[m\].
    pub lines: Vec<[f32; 3]>,
}

impl Sheet {
    /// A sheet under spheres: centre \[m\] and radius \[m\] of each.
    pub fn under(ground: &DrawnSupport, carried: &[(Vec3, f64)]) -> Self {
        let (origin, normal) = (Vec3::from(ground.origin), Vec3::from(ground.normal).normalize());
        // Along x, or along y on a plane that faces x.
        let axis = if normal.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
        let u = (axis - normal * normal.dot(&axis)).normalize();
        let axes = [u, normal.cross(&u)];
        let spans = axes.map(|axis| span(carried.iter().map(|(at, radius)| ((at - origin).dot(&axis), *radius))));
        let step = round_step(spans.iter().map(|[low, high]| high - low).fold(0.0, f64::max) / STEPS);
        // In steps from the support's origin.
        let [[left, right], [near, far]] =
            spans.map(|[low, high]| [(low / step - MARGIN).floor(), (high / step + MARGIN).ceil()]);
        let place = |i: f64, j: f64| step * (i * axes[0] + j * axes[1]);
        let middle = place(0.5 * (left + right), 0.5 * (near + far));
        let depth = normal * (DEPTH * step);
        let corners = [[left, near], [right, near], [right, far], [left, far]];
        let along = (0..=(right - left) as u32).map(|k| left + f64::from(k)).map(|i| [[i, near], [i, far]]);
        let across = (0..=(far - near) as u32).map(|k| near + f64::from(k)).map(|j| [[left, j], [right, j]]);
        Self {
            center: origin + middle,
            normal,
            corners: corners.map(|[i, j]| single(&(place(i, j) - middle - depth))),
            lines: along.chain(across).flatten().map(|[i, j]| single(&(place(i, j) - middle))).collect(),
        }
    }
}

/// The interval that holds some others, given by middle and half their length; a metre if there are none.
fn span(parts: impl Iterator<Item = (f64, f64)>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = parts.fold(start, |[low, high], (at, half)| [low.min(at - half), high.max(at + half)]);
    if low < high { [low, high] } else { [-0.5, 0.5] }
}

/// The nearest of 1, 2, 5 times a power of ten from below; of a length > 0.
fn round_step(length: f64) -> f64 {
    let power = libm::pow(10_f64, libm::log10(length).floor());
    let fits = |factor: &f64| factor * power <= length * (1.0 + 1e-9);
    power * [5.0, 2.0].into_iter().find(fits).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_in_decimals() {
        for (length, step) in [(1.0, 1.0), (0.3, 0.2), (4.9, 2.0), (5.0, 5.0), (7e-4, 5e-4), (9.9e5, 5e5)] {
            assert!((round_step(length) / step - 1.0).abs() < 1e-12, "{length}: {}", round_step(length));
        }
    }

    #[test]
    fn sheet_lies_in_the_plane_under_all_that_it_carries() {
        let ground: DrawnSupport = serde_json::from_value(serde_json::json!({
            "name": "slope", "origin": [1.0, 2.0, 3.0], "normal": [0.6, 0.0, 0.8], "motion": null,
        }))
        .unwrap_or_else(|error| panic!("{error}"));
        let carried = [(Vec3::new(0.0, 0.0, 5.0), 0.1), (Vec3::new(4.0, 5.0, 9.0), 0.2)];
        let sheet = Sheet::under(&ground, &carried);
        assert!((sheet.center - Vec3::from(ground.origin)).dot(&sheet.normal).abs() < 1e-14);
        let [a, b, c, d] = sheet.corners.map(|corner| Vec3::from(corner.map(f64::from)));
        assert!((b - a).cross(&(d - a)).normalize().dot(&sheet.normal) > 1.0 - 1e-6);
        let (u, v) = (b - a, d - a);
        for (at, radius) in carried {
            let from = at - sheet.center - a;
            for side in [u, v] {
                let along = from.dot(&side.normalize());
                assert!(along > radius && along < side.norm() - radius, "{along}");
            }
        }
        assert!((a + c - b - d).norm() < 1e-5);
    }
}
