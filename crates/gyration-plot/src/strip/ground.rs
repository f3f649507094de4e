//! Supports seen from the side, where the plane cuts the plane of the picture through the bodies; or from above, as a
//! patch of the plane with a grid, below the bodies.

use super::silhouette::convex_hull;
use super::view::View;
use crate::draw::Point;
use crate::solids::SolidSupportPicture;
use gyration::support::Support;
use gyration::tensor::Vec3;

/// A support in the picture.
#[derive(Debug, Clone, PartialEq)]
pub enum Ground {
    /// A line with a free side.
    Cut(Cut),
    /// A square seen from above: its corners, in order around, and the lines of its grid [m].
    Patch {
        /// The corners.
        corners: Vec<Point>,
        /// The lines.
        grid: Vec<Vec<Point>>,
    },
    /// The areas that a support with a shape covers [m].
    Solid(Vec<Vec<Point>>),
}

/// A line with a free side, in the plane of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// A point of it [m].
    pub origin: Point,
    /// The unit normal, to the free side.
    pub normal: Point,
}

/// What is seen of a support depends on where the bodies are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// The mean place of the bodies [m].
    pub mean: Vec3,
    /// Half the side of a patch [m].
    pub half_side: f64,
}

/// A plane is drawn if its normal lies in the picture at least to this part.
const LEAST_IN_PLANE: f64 = 0.3;

/// Meshes of a patch along each side.
const MESHES: i32 = 6;
/// A patch is drawn if the support's normal points to the viewer at least to this part.
const LEAST_FACING: f64 = 0.1;

impl Ground {
    /// A support with a shape at a time, filled, at its true size.
    pub fn of_solid(support: &SolidSupportPicture, time: f64, view: &View) -> Self {
        Self::Solid(support.areas(time, |point| view.project(point), convex_hull))
    }

    /// A support at a time; none if it cannot be seen in this view.
    pub fn of(support: &Support, time: f64, site: &Site, view: &View) -> Option<Self> {
        if view.raised {
            patch(support, time, site, view)
        } else {
            Cut::of(support, time, &site.mean, view).map(Self::Cut)
        }
    }

    /// Points that the picture should show, if they are within reach of its centre [m].
    pub fn points(&self, center: Point) -> Vec<Point> {
        match self {
            Self::Cut(cut) => vec![cut.nearest(center)],
            Self::Patch { corners, .. } => corners.clone(),
            Self::Solid(areas) => areas.concat(),
        }
    }
}

/// The square of the plane below the bodies.
fn patch(support: &Support, time: f64, site: &Site, view: &View) -> Option<Ground> {
    let normal = support.at(time).normal;
    if normal.dot(&view.toward) < LEAST_FACING {
        return None;
    }
    let foot = site.mean - support.gap(&site.mean, time) * normal;
    let along = (view.right - normal * normal.dot(&view.right)).try_normalize(1e-9)?;
    let across = normal.cross(&along);
    let at = |a: f64, b: f64| view.project(&(foot + site.half_side * (a * along + b * across)));
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| at(a, b)).to_vec();
    let inner = (1..MESHES).map(|k| f64::from(2 * k) / f64::from(MESHES) - 1.0);
    let grid = inner.flat_map(|s| [vec![at(s, -1.0), at(s, 1.0)], vec![at(-1.0, s), at(1.0, s)]]).collect();
    Some(Ground::Patch { corners, grid })
}

impl Cut {
    /// The cut of a support at a time; none if the support faces the viewer.
    ///
    ///   (c + a u + b w − o)·n = 0,   c the mean place of the bodies
    fn of(support: &Support, time: f64, mean: &Vec3, view: &View) -> Option<Self> {
        let normal = view.project(&support.at(time).normal);
        let in_plane = libm::hypot(normal[0], normal[1]);
        if in_plane < LEAST_IN_PLANE {
            return None;
        }
        let unit = normal.map(|c| c / in_plane);
        let distance = support.gap(mean, time) / in_plane;
        let center = view.project(mean);
        Some(Self { origin: [0, 1].map(|k| center[k] - distance * unit[k]), normal: unit })
    }

    /// The point of the line nearest to another.
    fn nearest(&self, point: Point) -> Point {
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
        let support = Support {
            name: "slope".into(),
            origin: Vec3::new(0.0, 5.0, 1.0),
            normal,
            motion: SupportMotion::default(),
        };
        let view = View { right: Vec3::x(), up: Vec3::z(), toward: -Vec3::y(), raised: false };
        let ground = Cut::of(&support, 0.0, &Vec3::new(2.0, 1.0, 3.0), &view).unwrap();
        // The plane passes through (0, 1) of the picture and rises with tan 0.4.
        let at = ground.nearest([0.0, 1.0]);
        assert!(at[0].abs() < 1e-14 && (at[1] - 1.0).abs() < 1e-14);
        assert!((ground.normal[0] + sine).abs() < 1e-15);
        let facing = Support { normal: Vec3::y(), ..support };
        assert!(Cut::of(&facing, 0.0, &Vec3::zeros(), &view).is_none());
    }
    #[test]
    fn a_level_plane_seen_from_above_is_a_patch_below_the_bodies() {
        let normal = Vec3::z();
        let support = Support { name: "table".into(), origin: Vec3::zeros(), normal, motion: SupportMotion::default() };
        let (up, toward) = (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.0, -0.8, 0.6));
        let view = View { right: Vec3::x(), up, toward, raised: true };
        let site = Site { mean: Vec3::new(1.0, 2.0, 3.0), half_side: 0.5 };
        let Some(Ground::Patch { corners, .. }) = Ground::of(&support, 0.0, &site, &view) else { panic!("no patch") };
        assert!((corners[0][0] - 0.5).abs() < 1e-15 && (corners[0][1] - 0.6 * 1.5).abs() < 1e-15, "{corners:?}");
        let below = Support { normal: -normal, ..support };
        assert!(Ground::of(&below, 0.0, &site, &view).is_none());
    }
}
