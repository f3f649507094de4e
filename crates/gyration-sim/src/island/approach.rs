//! How two centres come nearer to one another, if both go on as they do.
//!
//!   |Δp(t)| ≥ |Δp + Δṗ t| − ½ |Δp̈| t²

use crate::island::step_end::StepEnd;
use gyration::model::Model;
use gyration::neighbours::{BodyPair, Sphere, near};
use gyration::pair::EDGE;
use gyration::tensor::Vec3;

/// The motion of one centre as seen from another, if both go on as they do.
pub(crate) struct Approach {
    place: Vec3,
    velocity: Vec3,
    /// |Δp̈₀| [m/s²].
    acceleration: f64,
}

impl Approach {
    pub fn of(one: &StepEnd, other: &StepEnd) -> Self {
        let [a, b] = [one, other].map(|end| (&end.motion, end.acceleration));
        Self {
            place: a.0.placement.position - b.0.placement.position,
            velocity: a.0.velocity.velocity - b.0.velocity.velocity,
            acceleration: (a.1 - b.1).norm(),
        }
    }

    /// The same with so much more acceleration, along whatever direction [m/s²].
    pub fn bent_more(self, bend: f64) -> Self {
        Self { acceleration: self.acceleration + bend, ..self }
    }

    /// |Δṗ| [m/s].
    pub fn speed(&self) -> f64 {
        self.velocity.norm()
    }

    /// The distance after a time without acceleration [m].
    pub fn straight(&self, time: f64) -> f64 {
        (self.place + time * self.velocity).norm()
    }

    /// A bound on the distance after a time [m].
    pub fn distance(&self, time: f64) -> f64 {
        self.straight(time) - 0.5 * self.acceleration * time * time
    }

    /// The same by the least distance without acceleration, which is that at the time `nearest` [m].
    pub fn bound(&self, nearest: f64, time: f64) -> f64 {
        self.straight(nearest) - 0.5 * self.acceleration * time * time
    }

    /// When they are nearest within a time, without acceleration [s].
    pub fn nearest(&self, within: f64) -> f64 {
        let square = self.velocity.norm_squared();
        if square > 0.0 { (-self.place.dot(&self.velocity) / square).clamp(0.0, within) } else { 0.0 }
    }

    /// The time in which the acceleration changes the distance by no more than a length [s].
    pub fn bent(&self, length: f64) -> f64 {
        (2.0 * length / self.acceleration).sqrt()
    }

    /// A bound on the smallest distance within a time [m].
    pub fn least(&self, within: f64) -> f64 {
        self.bound(self.nearest(within), within)
    }
}

/// The rigid bodies that may come within reach of one another in a time [s], and some others, ascending.
///
/// A centre is then within |ṗ₀ − u| t + ½ |p̈₀ − w| t² of where it would be if all moved alike, with the mean velocity
/// u and acceleration w.
pub(crate) fn may_meet(model: &Model, ends: &[StepEnd], within: f64) -> Vec<BodyPair> {
    // Bodies part a little farther out than they meet.
    let wider = 1.0 + 4.0 * EDGE;
    let mean = |of: &dyn Fn(&StepEnd) -> Vec3| ends.iter().map(of).sum::<Vec3>() / ends.len().max(1) as f64;
    let (velocity, acceleration) = (mean(&|end| end.motion.velocity.velocity), mean(&|end| end.acceleration));
    let sphere = |(index, end): (usize, &StepEnd)| {
        let body = &model.bodies[index];
        let Some(radius) = body.solid.radius().filter(|_| body.affine().is_none()) else { return Sphere::NOWHERE };
        let (speed, bend) = (end.motion.velocity.velocity - velocity, end.acceleration - acceleration);
        let way = speed.norm() * within + 0.5 * bend.norm() * within * within;
        Sphere::new(end.motion.placement.position, wider * (radius + way))
    };
    let spheres: Vec<Sphere> = ends.iter().enumerate().map(sphere).collect();
    near(model.rules(), &spheres, |rule| rule.reach.map(|reach| wider * reach.longest()))
}
