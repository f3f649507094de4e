//! The plane of a side view: the one that shows most of the motion.
//!
//! The upward direction w is against gravity; the level direction u is, in this order, the one in which the centres
//! travel most, that of the fall line of an inclined support, that in which turning is seen best (across the mean axis
//! of rotation), that in which the bodies stretch most, or x. The view is level, unless the bodies stay on the spot and
//! turn about no one level axis, as tops and coins do, which nobody sees from the side: such a motion is looked at from
//! above, by the angle e,
//!
//!   v' = v cos e + w sin e,   w' = w cos e − v sin e

use crate::draw::Point;
use gyration::tensor::{Mat3, Polar, Vec3, axial};

/// A side view: drawn are (u·p, w·p); v = u × w points to the viewer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// To the right.
    pub right: Vec3,
    /// Upwards.
    pub up: Vec3,
    /// To the viewer.
    pub toward: Vec3,
    /// Whether it is seen from above, so that a level plane is a surface and not a line.
    pub raised: bool,
}

/// How far above the level a spinning body is looked at from [rad].
const RAISED: f64 = 0.42;

/// The part of all turning that must be about one level axis for a view along it.
const ONE_AXIS: f64 = 0.7;

/// What the choice of a view depends on.
#[derive(Debug, Clone, Default)]
pub struct ViewCriteria {
    /// Places of the centres, body by body [m].
    pub paths: Vec<Vec<Vec3>>,
    /// The turn from each sample to the next, as an axis times the sine of the angle.
    pub turns: Vec<Vec3>,
    /// How the left stretches of each body differ from their mean, sample by sample.
    pub strains: Vec<Mat3>,
    /// Normals of the supports.
    pub normals: Vec<Vec3>,
    /// The largest size of a body [m].
    pub size: f64,
}

impl View {
    /// The view that shows most of the motion.
    pub fn of(motion: &ViewCriteria, up: Vec3) -> Self {
        let level = |v: &Vec3| v - up * up.dot(v);
        let mut spread = Mat3::zeros();
        for path in &motion.paths {
            let mean = path.iter().sum::<Vec3>() / path.len().max(1) as f64;
            spread += path.iter().map(|p| square(&level(&(p - mean)))).sum::<Mat3>() / path.len().max(1) as f64;
        }
        let turning: Mat3 = motion.turns.iter().map(|turn| square(&level(turn))).sum();
        let inclined: Mat3 = motion.normals.iter().map(|normal| square(&level(normal))).sum();
        // Travel counts from a twentieth of the size on, an inclination or a turn from a hundredth of a radian on.
        let traveled = (0.05 * motion.size).powi(2);
        let right = largest_axis(&spread, traveled)
            .or_else(|| largest_axis(&inclined, 1e-4))
            .or_else(|| largest_axis(&turning, 1e-4).map(|axis| up.cross(&axis)))
            .or_else(|| strained_axis(&motion.strains, &up))
            .unwrap_or_else(|| {
                let x = level(&Vec3::x());
                if x.norm() > 0.5 { x } else { level(&Vec3::y()) }
            })
            .normalize();
        let right = if right[right.iamax()] < 0.0 { -right } else { right };
        let level_view = Self { right, up, toward: right.cross(&up), raised: false };
        let all: f64 = motion.turns.iter().map(Vec3::norm_squared).sum();
        let about_one_axis = turning.symmetric_eigenvalues().max() > ONE_AXIS * all;
        // On the spot: within two thirds of the size around the mean, root mean square.
        let still = spread.trace() < (0.67 * motion.size).powi(2);
        if still && all > 1e-4 && !about_one_axis { level_view.raised() } else { level_view }
    }

    /// The same from above.
    fn raised(self) -> Self {
        let (sine, cosine) = libm::sincos(RAISED);
        let Self { right, up, toward, .. } = self;
        Self { right, up: cosine * up - sine * toward, toward: cosine * toward + sine * up, raised: true }
    }

    /// Where a place is drawn [m].
    pub fn project(&self, place: &Vec3) -> Point {
        [self.right.dot(place), self.up.dot(place)]
    }

    /// How near to the viewer a place is [m].
    pub fn depth(&self, place: &Vec3) -> f64 {
        self.toward.dot(place)
    }
}

/// The axis times the sine of the angle of the turn from one placement gradient to another: of their rotations, P = R
/// U.
pub fn turn(from: &Mat3, to: &Mat3) -> Vec3 {
    let rotation = |gradient: &Mat3| Polar::of(gradient).rotation;
    0.5 * axial(&(rotation(to) * rotation(from).transpose()))
}

/// The left stretch R U Rᵀ of a placement gradient.
pub fn left_stretch(gradient: &Mat3) -> Mat3 {
    let Polar { rotation, stretch } = Polar::of(gradient);
    rotation * stretch * rotation.transpose()
}

/// The level direction along which the bodies stretch more than across it, by a hundredth at least.
fn strained_axis(strains: &[Mat3], up: &Vec3) -> Option<Vec3> {
    let level = Mat3::identity() - square(up);
    let squares = strains.iter().map(|strain| level * strain * level).map(|strain| strain * strain);
    let mean = squares.sum::<Mat3>() / strains.len().max(1) as f64;
    let other = 0.5 * mean.trace();
    // Of the two level values the larger exceeds the half of their sum.
    largest_axis(&mean, (1.1 * other).max(1e-4))
}

fn square(v: &Vec3) -> Mat3 {
    v * v.transpose()
}

/// The principal axis of the largest value, if that is above `least`.
fn largest_axis(matrix: &Mat3, least: f64) -> Option<Vec3> {
    let eigen = matrix.symmetric_eigen();
    let index = eigen.eigenvalues.imax();
    (eigen.eigenvalues[index] > least).then(|| eigen.eigenvectors.column(index).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn travel_comes_first_then_inclination_then_turning() {
        let still = ViewCriteria { size: 0.1, ..ViewCriteria::default() };
        let up = Vec3::z();
        assert!((View::of(&still, up).right - Vec3::x()).norm() < 1e-12);
        let turning = ViewCriteria { turns: vec![0.1 * Vec3::x()], ..still.clone() };
        assert!((View::of(&turning, up).right - Vec3::y()).norm() < 1e-12);
        let inclined = ViewCriteria { normals: vec![Vec3::new(0.0, -0.5, 0.8)], turns: vec![0.1 * Vec3::y()], ..still };
        assert!((View::of(&inclined, up).right - Vec3::y()).norm() < 1e-12);
        let path = vec![Vec3::zeros(), Vec3::new(1.0, 1.0, 5.0)];
        let traveling = ViewCriteria { paths: vec![path], ..inclined };
        let view = View::of(&traveling, up);
        assert!((view.right - Vec3::new(1.0, 1.0, 0.0).normalize()).norm() < 1e-12);
        assert!((view.right.cross(&view.up) - view.toward).norm() < 1e-12);
    }

    #[test]
    fn spinning_on_the_spot_is_seen_from_above() {
        let spinning = ViewCriteria { turns: vec![Vec3::new(0.1, 0.0, 0.5)], size: 0.1, ..ViewCriteria::default() };
        let view = View::of(&spinning, Vec3::z());
        assert!(view.raised && view.toward.z > 0.3 && view.up.z > 0.9);
        assert!((view.right.cross(&view.up) - view.toward).norm() < 1e-15);
        let rolling = ViewCriteria { turns: vec![0.3 * Vec3::x(), 0.3 * Vec3::y()], ..spinning.clone() };
        assert!(View::of(&rolling, Vec3::z()).raised);
        let traveling = ViewCriteria { paths: vec![vec![Vec3::zeros(), Vec3::x()]], ..spinning };
        assert!(!View::of(&traveling, Vec3::z()).raised);
    }

    #[test]
    fn a_stretch_is_seen_from_its_side() {
        let along_y = Mat3::from_diagonal(&Vec3::new(0.0, 0.2, -0.1));
        let ringing = ViewCriteria { strains: vec![along_y, -along_y], size: 0.1, ..ViewCriteria::default() };
        assert!((View::of(&ringing, Vec3::z()).right - Vec3::y()).norm() < 1e-12);
        // Alike in all level directions: none is better than x.
        let along_z = Mat3::from_diagonal(&Vec3::new(0.1, 0.1, -0.2));
        let round = ViewCriteria { strains: vec![along_z, -along_z], size: 0.1, ..ViewCriteria::default() };
        assert!((View::of(&round, Vec3::z()).right - Vec3::x()).norm() < 1e-12);
    }

    #[test]
    fn a_stretch_is_no_turn() {
        let stretched = Mat3::new(1.5, 0.2, 0.0, 0.2, 0.7, 0.0, 0.0, 0.0, 1.0);
        assert!(turn(&Mat3::identity(), &stretched).norm() < 1e-14);
    }

    #[test]
    fn a_turn_is_axis_times_sine() {
        let (sine, cosine) = 0.3f64.sin_cos();
        let rotation = Mat3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
        assert!((turn(&Mat3::identity(), &rotation) - sine * Vec3::z()).norm() < 1e-15);
    }
}
