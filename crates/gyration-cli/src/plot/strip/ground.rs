//! Supports seen from the side: where the plane cuts the plane of the picture through the bodies.

use super::view::View;
use crate::plot::draw::Point;
use gyration::support::Support;
use gyration::tensor::Vec3;

/// A line with a free side, in the plane of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// A point of it [m].
    pub origin: Point,
    /// The unit normal, to the free side.
    pub normal: Point,
}

/// A plane is drawn if its normal lies in the picture at least to this part.
const LEAST_IN_PLANE: f64 = 0.3;

impl Ground {
    /// The cut of a support at a time; none if the support faces the viewer.
    ///
    ///   (c + a u + b w − o)·n = 0,   c the mean place of the bodies
    pub fn of(support: &Support, time: f64, mean: &Vec3, view: &View) -> Option<Self> {
        let normal = view.project(&support.normal);
        let in_plane = normal[0].hypot(normal[1]);
        if in_plane < LEAST_IN_PLANE {
            return None;
        }
        let unit = normal.map(|c| c / in_plane);
        let distance = support.gap(mean, time) / in_plane;
        let center = view.project(mean);
        Some(Self { origin: [0, 1].map(|k| center[k] - distance * unit[k]), normal: unit })
    }

    /// The point of the line nearest to another.
    pub fn nearest(&self, point: Point) -> Point {
        let distance = (point[0] - self.origin[0]) * self.normal[0] + (point[1] - self.origin[1]) * self.normal[1];
        [0, 1].map(|k| point[k] - distance * self.normal[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::support::SupportMotion;

    #[test]
    fn an_inclined_plane_is_a_line_at_its_angle() {
        let (sine, cosine) = 0.4f64.sin_cos();
        let normal = Vec3::new(-sine, 0.0, cosine);
        let support =
            Support { name: "slope".into(), origin: Vec3::new(0.0, 5.0, 1.0), normal, motion: SupportMotion::Fixed };
        let view = View { right: Vec3::x(), up: Vec3::z(), toward: -Vec3::y() };
        let ground = Ground::of(&support, 0.0, &Vec3::new(2.0, 1.0, 3.0), &view).unwrap();
        // The plane passes through (0, 1) of the picture and rises with tan 0.4.
        let at = ground.nearest([0.0, 1.0]);
        assert!(at[0].abs() < 1e-14 && (at[1] - 1.0).abs() < 1e-14);
        assert!((ground.normal[0] + sine).abs() < 1e-15);
        let facing = Support { normal: Vec3::y(), ..support };
        assert!(Ground::of(&facing, 0.0, &Vec3::zeros(), &view).is_none());
    }
}
