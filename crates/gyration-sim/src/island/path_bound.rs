//! Where a body may be over a step, and when two bodies may come within reach of each other.
//!
//!   |p₀(t) − chord(t)| ≤ δ = max_j |b_j − chord(t_j)|
//!
//! b_j are the Bernstein coefficients of the interpolant, a polynomial of degree 8 at most, and t_j their places: a
//! polynomial stays within the hull of its coefficients, and so does its distance from the chord. Two bodies whose
//! chords stay farther apart than their reach and both δ have not met, whatever they did in between.

use gyration::neighbours::Bounds;
use gyration::tensor::Vec3;
use nalgebra::{SMatrix, SVector};
use std::sync::LazyLock;

/// The degree of the interpolants.
const DEGREE: usize = 8;
/// Into how many equal parts a step is cut by the places through which a bound is laid, and one more.
pub(crate) const NODES: usize = DEGREE + 1;

/// Where the centre of a body is for all times of a step.
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
    /// Through the centres at equal parts of a step.
    pub fn through((start, end): (f64, f64), centers: &[Vec3; NODES]) -> Self {
        let (from, to) = (centers[0], centers[DEGREE]);
        let off = |k: usize| centers[k] - from.lerp(&to, k as f64 / DEGREE as f64);
        let axes: [SVector<f64, NODES>; 3] =
            [0, 1, 2].map(|axis| *COEFFICIENTS * SVector::from_fn(|k, _| off(k)[axis]));
        let size = |k: usize| Vec3::new(axes[0][k], axes[1][k], axes[2][k]).norm();
        let deviation = (0..NODES).map(size).fold(0.0, f64::max);
        Self { start, end, from, to, deviation }
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

    /// Whether two bodies may be closer than `reach` [m] at a time that both steps have.
    pub fn may_meet(&self, other: &Self, reach: f64) -> bool {
        let (begin, end) = (self.start.max(other.start), self.end.min(other.end));
        if begin >= end {
            return false;
        }
        let apart = |time: f64| self.chord(time) - other.chord(time);
        nearest(&apart(begin), &apart(end)) <= reach + (self.deviation + other.deviation)
    }
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

    fn bound((start, end): (f64, f64), place: impl Fn(f64) -> Vec3) -> PathBound {
        PathBound::through(
            (start, end),
            &std::array::from_fn(|k| place(start + (end - start) * k as f64 / DEGREE as f64)),
        )
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
            assert_eq!(one.may_meet(&other, 0.1), meets, "{delay}");
            assert_eq!(other.may_meet(&one, 0.1), meets, "{delay}");
        }
        let other = straight((0.0, 1.9), Vec3::new(2.0, -2.0, 0.0), Vec3::y());
        assert!(!one.may_meet(&other, 0.1) && one.may_meet(&other, 0.2));
        assert!(!one.may_meet(&straight((4.0, 5.0), Vec3::zeros(), Vec3::x()), 10.0));
    }
}
