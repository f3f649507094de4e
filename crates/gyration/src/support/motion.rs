//! How a support is carried along: translations and rotations that add up.
//!
//!   x(t) = R(t) x₀ + b(t),   ẋ = ḃ + ω × (x − b)
//!
//! Translations move everything, the axes of the rotations too, by the sum of their displacements. Rotations are
//! carried out one after the other, the first one first, each about an axis through a point where that is at rest.

use crate::kinematics::Quaternion;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use std::f64::consts::TAU;

/// One of the motions that add up to that of a support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotionPart {
    /// Constant velocity [m/s].
    Velocity(Vec3),
    /// Displacement = direction · amplitude · sin(2πft + phase).
    Oscillation {
        /// Unit direction.
        direction: Vec3,
        /// Amplitude [m].
        amplitude: f64,
        /// f [Hz].
        frequency: f64,
        /// Phase [rad].
        phase: f64,
    },
    /// A turn at a constant rate.
    Rotation {
        /// Unit axis, by the right-hand rule.
        axis: Vec3,
        /// A point of the axis [m].
        point: Vec3,
        /// Angular velocity about it [rad/s].
        rate: f64,
    },
}

/// The prescribed motion of a support: what adds up to it, nothing of one at rest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SupportMotion {
    parts: Vec<MotionPart>,
    /// The time [s] from whose place it does not move, if it is held there: its parts say then how it came there.
    held: Option<f64>,
}

/// Where points of a support have come to, and how they move there: x = R x₀ + b, ẋ = ḃ + ω × (x − b).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carriage {
    /// R.
    pub rotation: Mat3,
    /// b [m].
    pub shift: Vec3,
    /// ω [rad/s].
    pub spin: Vec3,
    /// ḃ [m/s].
    pub velocity: Vec3,
    /// What the turns do to ω̇ [rad/s²], and to b̈ [m/s²]: without the translations.
    turning: [Vec3; 2],
}

/// Bounds on the motion of a point of a support, at all times.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionBound {
    /// |ẋ| [m/s].
    pub speed: f64,
    /// |ẍ| [m/s²].
    pub acceleration: f64,
    /// |ω| [rad/s].
    pub spin: f64,
}

impl MotionPart {
    /// The displacement [m] at a time [s]; none of a turn.
    fn displacement(&self, time: f64) -> Vec3 {
        match self {
            Self::Velocity(velocity) => velocity * time,
            Self::Oscillation { direction, amplitude, frequency, phase } => {
                direction * (amplitude * libm::sin(TAU * frequency * time + phase))
            }
            Self::Rotation { .. } => Vec3::zeros(),
        }
    }

    /// The velocity of that [m/s].
    fn velocity(&self, time: f64) -> Vec3 {
        match self {
            Self::Velocity(velocity) => *velocity,
            Self::Oscillation { direction, amplitude, frequency, phase } => {
                let omega = TAU * frequency;
                direction * (amplitude * omega * libm::cos(omega * time + phase))
            }
            Self::Rotation { .. } => Vec3::zeros(),
        }
    }

    /// The acceleration of that [m/s²].
    fn acceleration(&self, time: f64) -> Vec3 {
        match self {
            Self::Oscillation { frequency, .. } => -(TAU * frequency).powi(2) * self.displacement(time),
            Self::Velocity(_) | Self::Rotation { .. } => Vec3::zeros(),
        }
    }
}

impl SupportMotion {
    /// The sum of some motions.
    pub fn new(parts: Vec<MotionPart>) -> Self {
        Self { parts, held: None }
    }

    /// The same, at rest at all times where it has come to at one [s].
    #[must_use]
    pub fn held_at(&self, time: f64) -> Self {
        Self { parts: self.parts.clone(), held: self.held.or(Some(time)) }
    }

    /// What adds up to it.
    pub fn parts(&self) -> &[MotionPart] {
        &self.parts
    }

    /// What adds up to its rates: nothing once it is held.
    fn moving(&self) -> &[MotionPart] {
        if self.held.is_some() { &[] } else { &self.parts }
    }

    /// Whether it is at rest where it was before any motion.
    pub fn is_fixed(&self) -> bool {
        self.parts.is_empty()
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.parts.iter().any(|part| matches!(part, MotionPart::Rotation { .. }))
    }

    /// Whether it moves to and fro.
    pub fn oscillates(&self) -> bool {
        self.held.is_none() && self.parts.iter().any(|part| matches!(part, MotionPart::Oscillation { .. }))
    }

    /// The displacement [m] by its translations at time t.
    pub fn displacement(&self, time: f64) -> Vec3 {
        let time = self.held.unwrap_or(time);
        self.parts.iter().map(|part| part.displacement(time)).sum()
    }

    /// The velocity [m/s] of its translations at time t.
    pub fn velocity(&self, time: f64) -> Vec3 {
        self.moving().iter().map(|part| part.velocity(time)).sum()
    }

    /// The acceleration [m/s²] of its translations at time t.
    pub fn acceleration(&self, time: f64) -> Vec3 {
        self.moving().iter().map(|part| part.acceleration(time)).sum()
    }

    /// Where its points have come to at time t, and how they move.
    pub fn carriage(&self, time: f64) -> Carriage {
        let mut carried = Carriage::AT_REST;
        for part in &self.parts {
            if let MotionPart::Rotation { axis, point, rate } = part {
                let turn = Quaternion::from_axis_angle(axis, rate * self.held.unwrap_or(time)).rotation();
                let spin = if self.held.is_some() { Vec3::zeros() } else { *rate * axis };
                carried = carried.turned(&turn, point, &spin);
            }
        }
        carried.shift += self.displacement(time);
        carried.velocity += self.velocity(time);
        carried
    }

    /// The highest frequency of an oscillation in it [Hz]; zero without one.
    pub fn highest_frequency(&self) -> f64 {
        let of = |part: &MotionPart| match part {
            MotionPart::Oscillation { frequency, amplitude, .. } if *amplitude != 0.0 => frequency.abs(),
            MotionPart::Oscillation { .. } | MotionPart::Velocity(_) | MotionPart::Rotation { .. } => 0.0,
        };
        self.moving().iter().map(of).fold(0.0, f64::max)
    }

    /// Bounds on the translations.
    pub fn translation_bound(&self) -> MotionBound {
        let mut bound = MotionBound::default();
        for part in self.moving() {
            match part {
                MotionPart::Velocity(velocity) => bound.speed += velocity.norm(),
                MotionPart::Oscillation { amplitude, frequency, direction, .. } => {
                    let speed = (TAU * frequency * amplitude).abs() * direction.norm();
                    bound.speed += speed;
                    bound.acceleration += TAU * frequency.abs() * speed;
                }
                MotionPart::Rotation { .. } => {}
            }
        }
        bound
    }

    /// Bounds on the motion of a point that starts here [m].
    ///
    /// A turn at w about a leaves the distance ρ from a: |v| ← |v| + wρ, |a| ← |a| + 2w|v| + w²ρ.
    pub fn bound(&self, start: &Vec3) -> MotionBound {
        let (mut bound, translation) = (MotionBound::default(), self.translation_bound());
        let mut last: Option<(Vec3, f64)> = None;
        for part in self.moving() {
            let MotionPart::Rotation { axis, point, rate } = part else { continue };
            // Any point of the axis does: the nearest one to the start of the first turn.
            let (center, distance) = match last {
                None => {
                    let foot = point + axis * axis.dot(&(start - point));
                    (foot, (start - foot).norm())
                }
                Some((before, distance)) => (*point, distance + (point - before).norm()),
            };
            let rate = rate.abs();
            bound.acceleration += 2.0 * rate * bound.speed + rate * rate * distance;
            bound.speed += rate * distance;
            bound.spin += rate;
            last = Some((center, distance));
        }
        MotionBound {
            speed: bound.speed + translation.speed,
            acceleration: bound.acceleration + translation.acceleration,
            spin: bound.spin,
        }
    }
}

impl Carriage {
    /// Nothing is moved.
    pub const AT_REST: Self = Self {
        rotation: Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        shift: Vec3::new(0.0, 0.0, 0.0),
        spin: Vec3::new(0.0, 0.0, 0.0),
        velocity: Vec3::new(0.0, 0.0, 0.0),
        turning: [Vec3::new(0.0, 0.0, 0.0); 2],
    };

    /// Turned besides by a rotation about a point [m], at an angular velocity [rad/s].
    fn turned(&self, by: &Mat3, point: &Vec3, spin: &Vec3) -> Self {
        let arm = by * (self.shift - point);
        let (own_spin, own_velocity) = (by * self.spin, by * self.velocity);
        let [spin_rate, acceleration] = self.turning.map(|own| by * own);
        Self {
            rotation: by * self.rotation,
            shift: point + arm,
            spin: spin + own_spin,
            velocity: spin.cross(&arm) + own_velocity,
            turning: [
                spin_rate + spin.cross(&own_spin),
                acceleration + 2.0 * spin.cross(&own_velocity) + spin.cross(&spin.cross(&arm)),
            ],
        }
    }

    /// Where a point has come to [m].
    pub fn place(&self, start: &Vec3) -> Vec3 {
        self.rotation * start + self.shift
    }

    /// ẍ of the point that is at a place [m/s²], without what the translations add to it.
    pub fn turning_acceleration_at(&self, place: &Vec3) -> Vec3 {
        let ([spin_rate, acceleration], arm) = (self.turning, place - self.shift);
        acceleration + spin_rate.cross(&arm) + self.spin.cross(&self.spin.cross(&arm))
    }

    /// Ṙ and R̈.
    pub fn rotation_rates(&self) -> [Mat3; 2] {
        let (spin, spin_rate) = (cross_matrix(&self.spin), cross_matrix(&self.turning[0]));
        [spin * self.rotation, (spin_rate + spin * spin) * self.rotation]
    }

    /// Where the point that is at a place was before any motion [m].
    pub fn start_of(&self, place: &Vec3) -> Vec3 {
        self.rotation.tr_mul(&(place - self.shift))
    }

    /// How fast the point moves that is at a place [m/s].
    pub fn velocity_at(&self, place: &Vec3) -> Vec3 {
        self.velocity + self.spin.cross(&(place - self.shift))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compound() -> SupportMotion {
        let rotation = |axis: Vec3, point, rate| MotionPart::Rotation { axis: axis.normalize(), point, rate };
        SupportMotion::new(vec![
            rotation(Vec3::new(1.0, 2.0, -1.0), Vec3::new(0.3, 0.1, 0.2), 1.7),
            MotionPart::Velocity(Vec3::new(0.2, -0.1, 0.4)),
            rotation(Vec3::new(0.0, 1.0, 3.0), Vec3::new(-0.2, 0.5, 0.1), -0.9),
            MotionPart::Oscillation { direction: Vec3::x(), amplitude: 0.05, frequency: 3.0, phase: 0.4 },
        ])
    }

    #[test]
    fn what_is_held_stays_where_it_has_come_to() {
        let (motion, start) = (compound(), Vec3::new(0.7, -0.4, 0.9));
        let (held, there) = (motion.held_at(0.7), motion.carriage(0.7));
        for time in [0.0, 0.7, 3.0] {
            let carried = held.carriage(time);
            let place = carried.place(&start);
            assert_eq!((place, carried.rotation), (there.place(&start), there.rotation));
            assert_eq!((carried.spin, carried.velocity_at(&place)), (Vec3::zeros(), Vec3::zeros()));
            assert_eq!(carried.turning_acceleration_at(&place) + held.acceleration(time), Vec3::zeros());
            assert_eq!(carried.rotation_rates(), [Mat3::zeros(); 2]);
        }
        assert_eq!(held.bound(&start), MotionBound::default());
        // Held once is held for good.
        assert_eq!(held.held_at(2.0), held);
        assert!(!held.oscillates() && held.highest_frequency() == 0.0);
    }

    /// Central differences over 1e-5 s of places of order one: 1e-11 of rounding, 1e-10 of the third derivative 1e3.
    #[test]
    fn velocities_are_the_rates_of_places_and_bounds_hold() {
        let (motion, start) = (compound(), Vec3::new(0.7, -0.4, 0.9));
        let bound = motion.bound(&start);
        let step = 1e-5;
        let mut worst: f64 = 0.0;
        for time in [0.0, 0.3, 1.1, 4.7] {
            let place = |time: f64| motion.carriage(time).place(&start);
            let velocity = motion.carriage(time).velocity_at(&place(time));
            worst = worst.max((velocity - (place(time + step) - place(time - step)) / (2.0 * step)).norm());
            let longer = 1e-4;
            let bend = (place(time + longer) - 2.0 * place(time) + place(time - longer)) / (longer * longer);
            assert!(velocity.norm() <= bound.speed && bend.norm() <= bound.acceleration * (1.0 + 1e-6));
            let carried = motion.carriage(time);
            // Of second differences over 1e-4 s the fourth derivative leaves 0.05 m (6π/s)⁴ (1e-4 s)²/12 = 5e-6.
            let shaken = motion.translation_bound().acceleration;
            let turning = bend - carried.turning_acceleration_at(&place(time));
            let swing = motion.acceleration(time);
            assert!((turning - swing).norm() < 1e-5 && swing.norm() <= shaken, "{turning} {swing}");
            assert!((carried.start_of(&place(time)) - start).norm() < 1e-14);
            let rotation = |time: f64| motion.carriage(time).rotation;
            let [rate, second] = carried.rotation_rates();
            let differences = (rotation(time + longer) - rotation(time - longer)) / (2.0 * longer);
            let bends = (rotation(time + longer) - 2.0 * rotation(time) + rotation(time - longer)) / (longer * longer);
            // Of rates of some 3 rad/s: (1e-4 s)² 3³/6 and 3⁴/12, rounding 4e-8.
            assert!((rate - differences).norm() < 1e-6 && (second - bends).norm() < 1e-6, "{rate} {second}");
            assert!((carried.rotation.tr_mul(&carried.rotation) - Mat3::identity()).norm() < 1e-15 * 10.0);
            assert!(carried.spin.norm() <= bound.spin);
        }
        println!("velocities off by {worst:.1e}");
        assert!(worst < 1e-8);
    }

    #[test]
    fn a_translation_takes_the_axis_along() {
        let axis = MotionPart::Rotation { axis: Vec3::z(), point: Vec3::x(), rate: 1.0 };
        let motion = SupportMotion::new(vec![axis, MotionPart::Velocity(Vec3::y())]);
        let place = motion.carriage(2.0).place(&Vec3::x());
        assert!((place - Vec3::new(1.0, 2.0, 0.0)).norm() < 1e-15);
        let bound = motion.bound(&Vec3::new(1.5, 0.0, 7.0));
        assert!((bound.speed - 1.5).abs() < 1e-15 && (bound.acceleration - 0.5).abs() < 1e-15);
    }
}
