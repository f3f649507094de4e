//! Where a body may be over a step, and when two bodies may come within reach of each other.
//!
//!   |p₀(t) − chord(t)| ≤ δ = max_j |b_j − chord(t_j)|
//!
//! b_j are the Bernstein coefficients of the interpolant, a polynomial of degree 8 at most, and t_j their places: a
//! polynomial stays within the hull of its coefficients, and so does its distance from the chord. Two bodies whose
//! chords stay farther apart than their reach and both δ have not met, whatever they did in between.
//!
//! Long bodies beside one another have spheres about them that overlap. They have not met either if their shapes stay
//! apart along a normal n, be it an axis of one of them or the line of their centres:
//!
//!   n·(c_B − c_A) − h_A(P_Aᵀ n) − h_B(−P_Bᵀ n) − δ_A − δ_B − σ_A − σ_B > reach,   σ = 2 r ε/|q|
//!
//! h is the support function, P the orientation in the middle of the step, with the quaternion q, ε a bound like δ on
//! how far the quaternion comes from q, and σ so one on how far a point within the radius r is moved by that.

use crate::island::step_end::StepEnd;
use gyration::body::Solid;
use gyration::kinematics::Quaternion;
use gyration::model::Cutoff;
use gyration::neighbours::Bounds;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{SMatrix, SVector};
use std::sync::LazyLock;

/// The degree of the interpolants.
const DEGREE: usize = 8;
/// Into how many equal parts a step is cut by the places through which a bound is laid, and one more.
pub(crate) const NODES: usize = DEGREE + 1;

/// How many numbers a bound has.
pub(crate) const NUMBERS: usize = 19;

/// Where a rigid body is at one time of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    /// The centre of mass [m].
    pub center: Vec3,
    /// Not normalised.
    pub quaternion: Quaternion,
}

/// Where a rigid body is for all times of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathBound {
    /// The ends of the step [s].
    pub start: f64,
    pub end: f64,
    /// The centre there [m].
    from: Vec3,
    to: Vec3,
    /// δ [m].
    deviation: f64,
    /// P in the middle.
    orientation: Mat3,
    /// σ/r: how far a point at the distance 1 from the centre comes from where it is with that orientation.
    swing: f64,
}

/// From the values of a polynomial at k/8 to its Bernstein coefficients.
static COEFFICIENTS: LazyLock<SMatrix<f64, NODES, NODES>> = LazyLock::new(|| {
    let basis = SMatrix::<f64, NODES, NODES>::from_fn(|node, j| bernstein(j, node as f64 / DEGREE as f64));
    basis.try_inverse().unwrap_or_else(SMatrix::zeros)
});

/// The Bernstein polynomial j of degree 8.
fn bernstein(j: usize, t: f64) -> f64 {
    let choose = (0..j).fold(1.0, |product, i| product * (DEGREE - i) as f64 / (i + 1) as f64);
    choose * t.powi(j as i32) * (1.0 - t).powi((DEGREE - j) as i32)
}

impl PathBound {
    /// Through the places at equal parts of a step.
    pub fn through((start, end): (f64, f64), nodes: &[Node; NODES]) -> Self {
        let (from, to) = (nodes[0].center, nodes[DEGREE].center);
        let off = |k: usize| nodes[k].center - from.lerp(&to, k as f64 / DEGREE as f64);
        let middle = nodes[DEGREE / 2].quaternion;
        let turned = |k: usize| SVector::from(nodes[k].quaternion.0) - SVector::from(middle.0);
        let swing = 2.0 * (largest(turned) / SVector::from(middle.0).norm()).min(1.0);
        Self { start, end, from, to, deviation: largest(off), orientation: middle.rotation(), swing }
    }

    /// A body that goes on as it does for a time [s], to first order in how it turns.
    pub fn ahead(at: &StepEnd, time: f64) -> Self {
        let from = at.motion.placement.position;
        Self {
            start: 0.0,
            end: time,
            from,
            to: from + time * at.motion.velocity.velocity,
            deviation: 0.5 * at.acceleration.norm() * time * time,
            orientation: at.motion.placement.gradient,
            swing: (at.motion.angular_velocity().norm() * time).min(2.0),
        }
    }

    /// Its numbers.
    pub fn numbers(&self) -> [f64; NUMBERS] {
        let Self { start, end, from, to, deviation, orientation, swing } = self;
        let mut numbers = [0.0; NUMBERS];
        let all = [start, end, deviation, swing].into_iter().chain(from).chain(to).chain(orientation);
        numbers.iter_mut().zip(all).for_each(|(number, own)| *number = *own);
        numbers
    }

    /// From its numbers.
    pub fn of_numbers(numbers: [f64; NUMBERS]) -> Self {
        let ([start, end, deviation, swing], places) = (numbers[..4].try_into().unwrap_or_default(), &numbers[4..]);
        let (from, to) = (Vec3::from_column_slice(&places[..3]), Vec3::from_column_slice(&places[3..6]));
        Self { start, end, from, to, deviation, orientation: Mat3::from_column_slice(&places[6..]), swing }
    }

    /// The times of the places through which a bound is laid [s].
    pub fn nodes(start: f64, end: f64) -> [f64; NODES] {
        std::array::from_fn(|k| if k == DEGREE { end } else { start + (end - start) * (k as f64 / DEGREE as f64) })
    }

    /// A box about it.
    pub fn bounds(&self) -> Bounds {
        Bounds::about(&self.from, self.deviation).with(&Bounds::about(&self.to, self.deviation))
    }

    /// Where the chord is at a time.
    fn chord(&self, time: f64) -> Vec3 {
        self.from.lerp(&self.to, (time - self.start) / (self.end - self.start))
    }

    /// Whether two bodies may be within reach of each other at a time that both steps have.
    pub fn may_meet(&self, other: &Self, cutoff: &Cutoff, solids: [&Solid; 2]) -> bool {
        self.centers_may_meet(other, cutoff.centers) && !self.stay_apart(other, cutoff.surfaces, solids)
    }

    /// Whether the centres of two bodies may be closer than a distance [m] at a time that both steps have.
    fn centers_may_meet(&self, other: &Self, distance: f64) -> bool {
        let (begin, end) = (self.start.max(other.start), self.end.min(other.end));
        if begin >= end {
            return false;
        }
        let apart = |time: f64| self.chord(time) - other.chord(time);
        nearest(&apart(begin), &apart(end)) <= distance + (self.deviation + other.deviation)
    }

    /// Whether the shapes of two bodies stay farther apart than a distance [m] at all times that both steps have, along
    /// an axis of one of them or the line of their centres.
    pub fn stay_apart(&self, other: &Self, distance: f64, solids: [&Solid; 2]) -> bool {
        let (begin, end) = (self.start.max(other.start), self.end.min(other.end));
        if begin >= end {
            return true;
        }
        let [from, to] = [begin, end].map(|time| other.chord(time) - self.chord(time));
        let slack = self.slack(solids[0]) + other.slack(solids[1]);
        let is_apart = |axis: Vec3| {
            let axis = if axis.dot(&from) < 0.0 { -axis } else { axis };
            let room = axis.dot(&from).min(axis.dot(&to)) - slack - distance;
            let extents = || {
                let own = solids[0].extent(&self.orientation.tr_mul(&axis));
                own + solids[1].extent(&-other.orientation.tr_mul(&axis))
            };
            room > 0.0 && room > extents()
        };
        let axes = [&self.orientation, &other.orientation];
        let axes = axes.into_iter().flat_map(|axes| axes.column_iter().map(|axis| axis.into_owned()));
        axes.chain(from.try_normalize(0.0)).any(is_apart)
    }

    /// How far a point of a body may be from where the chord and the orientation have it [m].
    fn slack(&self, solid: &Solid) -> f64 {
        self.deviation + self.swing * solid.radius().unwrap_or_default()
    }
}

/// The length of the largest Bernstein coefficient of a polynomial with these values at equal parts of a step.
fn largest<const N: usize>(value: impl Fn(usize) -> SVector<f64, N>) -> f64 {
    let axes: [SVector<f64, NODES>; N] =
        std::array::from_fn(|axis| *COEFFICIENTS * SVector::from_fn(|k, _| value(k)[axis]));
    let size = |k: usize| SVector::<f64, N>::from_fn(|axis, _| axes[axis][k]).norm();
    (0..NODES).map(size).fold(0.0, f64::max)
}

/// The smallest length of a vector that goes straight from one to another.
fn nearest(from: &Vec3, to: &Vec3) -> f64 {
    let along = to - from;
    let square = along.norm_squared();
    let part = if square > 0.0 { (-from.dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (from + part * along).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::shape::{Cuboid, Shape};

    fn bound((start, end): (f64, f64), place: impl Fn(f64) -> Vec3) -> PathBound {
        turning((start, end), |t| Node { center: place(t), quaternion: Quaternion::IDENTITY })
    }

    fn turning((start, end): (f64, f64), node: impl Fn(f64) -> Node) -> PathBound {
        let nodes = std::array::from_fn(|k| node(start + (end - start) * k as f64 / DEGREE as f64));
        PathBound::through((start, end), &nodes)
    }

    #[test]
    fn a_bound_holds_the_whole_of_a_polynomial() {
        // Two bends within one step, which its ends and its middle do not show.
        let place = |t: f64| Vec3::new(t, 40.0 * t * (1.0 - t) * (0.5 - t) * t.powi(4), 0.0);
        let bound = bound((0.0, 1.0), place);
        let off = (0..=1000).map(|k| f64::from(k) / 1000.0).map(|t| (place(t) - bound.chord(t)).norm());
        let most = off.fold(0.0, f64::max);
        println!("off by {most}, bound {}", bound.deviation);
        assert!(most > 0.1 && bound.deviation >= most && bound.deviation < 5.0 * most);
    }

    #[test]
    fn a_parabola_is_bounded_by_twice_what_it_deviates() {
        let bound = bound((1.0, 3.0), |t| Vec3::new(0.0, 0.0, -4.9 * t * t));
        // ⅛ a h² in the middle; the coefficients are at (j/8)(1 − j/8)·a h²·4/7 at most.
        assert!((bound.deviation - 9.8 * 4.0 / 7.0).abs() < 1e-10, "{}", bound.deviation);
    }

    #[test]
    fn bodies_meet_where_they_are_at_the_same_time() {
        let straight = |span, from: Vec3, speed: Vec3| bound(span, move |t| from + t * speed);
        let one = straight((0.0, 4.0), Vec3::zeros(), Vec3::x());
        // Crosses the path of the first at x = 2: at the same time, or two seconds later.
        for (delay, meets) in [(0.0, true), (2.0, false)] {
            let other = straight((0.0, 4.0), Vec3::new(2.0, -2.0 - delay, 0.0), Vec3::y());
            assert_eq!(one.centers_may_meet(&other, 0.1), meets, "{delay}");
            assert_eq!(other.centers_may_meet(&one, 0.1), meets, "{delay}");
        }
        let other = straight((0.0, 1.9), Vec3::new(2.0, -2.0, 0.0), Vec3::y());
        assert!(!one.centers_may_meet(&other, 0.1) && one.centers_may_meet(&other, 0.2));
        assert!(!one.centers_may_meet(&straight((4.0, 5.0), Vec3::zeros(), Vec3::x()), 10.0));
    }

    /// A plank of 1 × 0.1 × 0.01 m.
    fn plank() -> Solid {
        let shape = Shape::Box(Cuboid { size: Vec3::new(1.0, 0.1, 0.01) });
        let mass = shape.mass_properties(1.0);
        Solid::new(shape, mass)
    }

    #[test]
    fn planks_side_by_side_stay_apart_until_one_turns_into_the_other() {
        let plank = plank();
        let still = bound((0.0, 1.0), |_| Vec3::zeros());
        let beside = bound((0.5, 1.5), |_| Vec3::new(0.2, 0.3, 0.0));
        assert!(still.centers_may_meet(&beside, 1.1), "their spheres overlap");
        assert!(still.stay_apart(&beside, 0.19, [&plank; 2]) && !still.stay_apart(&beside, 0.21, [&plank; 2]));
        for (angle, apart) in [(0.01, true), (0.5, false)] {
            // About the third axis by the angle over the step, which moves the ends by half of it.
            let turns = turning((0.5, 1.5), |t| {
                let half = 0.5 * angle * (t - 0.5);
                let quaternion = Quaternion([half.cos(), 0.0, 0.0, half.sin()]);
                Node { center: Vec3::new(0.2, 0.3, 0.0), quaternion }
            });
            assert_eq!(still.stay_apart(&turns, 0.15, [&plank; 2]), apart, "turned by {angle}");
            assert_eq!(turns.stay_apart(&still, 0.15, [&plank; 2]), apart, "turned by {angle}");
        }
        // One that falls onto the other meets it, whichever axis it begins beside.
        let falls = bound((0.0, 1.0), |t| Vec3::new(0.0, 0.0, 0.3 - 0.3 * t));
        assert!(!still.stay_apart(&falls, 0.01, [&plank; 2]));
    }

    #[test]
    fn no_point_of_a_body_that_turns_leaves_its_orientation_by_more_than_the_swing() {
        for angle in [0.03, 0.4, 1.5] {
            let orientation = |t: f64| {
                let half = 0.5 * angle * t * t;
                Quaternion([half.cos(), 0.6 * half.sin(), 0.0, 0.8 * half.sin()])
            };
            let bound = turning((0.0, 1.0), |t| Node { center: Vec3::zeros(), quaternion: orientation(t) });
            let off = |k: i32| {
                let turned = orientation(f64::from(k) / 1000.0).rotation() - bound.orientation;
                (turned.transpose() * turned).symmetric_eigenvalues().max().sqrt()
            };
            let most = (0..=1000).map(off).fold(0.0, f64::max);
            println!("turned by {angle}: off by {most}, bound {}", bound.swing);
            assert!(bound.swing >= most && bound.swing < 2.0 * most);
        }
    }
}
