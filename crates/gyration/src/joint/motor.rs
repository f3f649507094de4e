//! What acts along the free motion of a hinge or slider: a drive, and stops at its limits.
//!
//!   F = u(x, ẋ, t) + α (d₋/d₀)^−ν − α (d₊/d₀)^−ν − β ((d₋/d₀)^−ν_d + (d₊/d₀)^−ν_d) ẋ
//!   d₋ = x − x₋,   d₊ = x₊ − x,   V = α d₀ ((d₋/d₀)^(1−ν) + (d₊/d₀)^(1−ν))/(ν − 1)
//!
//! x is the angle [rad] or the way [m], F a torque [N m] or a force [N]; u may be a signal of time alone. A stop pushes
//! back into the allowed range only; its damping resists in both directions. At ν = 1 V is −α d₀ ln(d/d₀). Source:
//! `docs/theory-rigid.md`.

use crate::signal::Signal;
use gyration_expression::{Expression, Scratch, Undefined};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// The variables of u of a hinge.
pub const ANGLE_NAMES: [&str; 3] = ["angle", "rate", "t"];
/// The variables of u of a slider.
pub const WAY_NAMES: [&str; 3] = ["distance", "rate", "t"];
/// The index of t among them.
const TIME: usize = 2;

/// A drive and stops; none of them if there are none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motor {
    /// u.
    pub drive: Option<Drive>,
    /// What keeps x within limits.
    pub stop: Option<Stop>,
}

/// u \[N m\], \[N\].
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// An expression of x, ẋ and t.
    Feedback(Arc<Expression>),
    /// The first entry of a signal.
    Signal(Arc<Signal>),
}

/// A field at both limits of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// x₋ and x₊.
    pub limits: [f64; 2],
    /// α, ν.
    pub repulsion: StopLaw,
    /// β, ν_d; none without damping.
    pub damping: Option<StopLaw>,
}

/// A coefficient times a power of the distance to a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopLaw {
    /// α [N m], [N]; β [N m s], [N s/m].
    pub coefficient: f64,
    /// The exponent.
    pub exponent: f64,
    /// d₀ [rad], [m].
    pub reference: f64,
}

/// F and what it depends on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotorAt {
    /// F [N m], [N].
    pub force: f64,
    /// ∂F/∂x.
    pub by_value: f64,
    /// ∂F/∂ẋ.
    pub by_rate: f64,
    /// V [J].
    pub energy: f64,
    /// The power of the drive and of the damping [W].
    pub power: f64,
}

/// Why a motor has no force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MotorFault {
    /// x is at a limit or beyond: the distance left.
    Limit(f64),
    /// The drive is undefined.
    Undefined(Undefined),
}

impl StopLaw {
    /// c (d/d₀)^−ν and its derivative by d.
    fn at(&self, distance: f64) -> [f64; 2] {
        let value = self.coefficient * libm::pow(distance / self.reference, -self.exponent);
        [value, -self.exponent * value / distance]
    }

    /// The potential that has it as −dV/dd.
    fn potential(&self, distance: f64) -> f64 {
        let (size, ratio) = (self.coefficient * self.reference, distance / self.reference);
        let power = self.exponent - 1.0;
        if power == 0.0 { -size * libm::log(ratio) } else { size * libm::pow(ratio, -power) / power }
    }
}

impl Motor {
    /// The signal that drives it, if one does.
    pub fn signal(&self) -> Option<&Signal> {
        match &self.drive {
            Some(Drive::Signal(signal)) => Some(signal),
            Some(Drive::Feedback(_)) | None => None,
        }
    }

    /// Whether anything acts.
    pub fn acts(&self) -> bool {
        self.drive.is_some() || self.stop.is_some()
    }

    /// Whether it may do work.
    pub fn works(&self) -> bool {
        self.drive.is_some() || self.stop.is_some_and(|stop| stop.damping.is_some())
    }

    /// Whether its drive may depend on the motion.
    pub fn is_feedback(&self) -> bool {
        matches!(self.drive, Some(Drive::Feedback(_)))
    }

    /// Whether t stands in the expression that drives it.
    pub fn feels_time(&self) -> bool {
        matches!(&self.drive, Some(Drive::Feedback(expression)) if expression.uses(TIME))
    }

    /// By how much u of a hinge jumps as its angle goes from π to −π at this rate and time; none where it goes on
    /// there, as with the angle in sines and cosines alone. It is no number where u has no value there.
    pub fn jump_at_half_turn(&self, rate: f64, time: f64) -> Option<f64> {
        /// The part of u that is rounding.
        const ROUNDING: f64 = 1e-9;
        let Some(Drive::Feedback(law)) = &self.drive else { return None };
        let mut scratch = Scratch::default();
        let mut at = |angle| law.gradient(&[angle, rate, time], &mut scratch, &mut [0.0; 3]).unwrap_or(f64::NAN);
        let size = [0.0, FRAC_PI_2, -FRAC_PI_2, PI].map(&mut at).iter().fold(0.0, |size: f64, u| size.max(u.abs()));
        let jump = at(-PI) - at(PI);
        (jump.is_nan() || jump.abs() > ROUNDING * size).then_some(jump)
    }

    /// F at x, ẋ and t, and its derivatives.
    ///
    /// # Errors
    /// [`MotorFault`].
    pub fn at(&self, [value, rate, time]: [f64; 3], scratch: &mut Scratch) -> Result<MotorAt, MotorFault> {
        let mut found = MotorAt::default();
        if let Some(drive) = &self.drive {
            let mut slopes = [0.0; 3];
            let force = match drive {
                Drive::Feedback(law) => {
                    law.gradient(&[value, rate, time], scratch, &mut slopes).map_err(MotorFault::Undefined)?
                }
                Drive::Signal(signal) => signal.at(time)[(0, 0)],
            };
            found.force += force;
            found.by_value += slopes[0];
            found.by_rate += slopes[1];
            found.power += force * rate;
        }
        if let Some(stop) = &self.stop {
            stop.add(value, rate, &mut found)?;
        }
        Ok(found)
    }
}

impl Stop {
    fn add(&self, value: f64, rate: f64, found: &mut MotorAt) -> Result<(), MotorFault> {
        for (sign, distance) in [(1.0, value - self.limits[0]), (-1.0, self.limits[1] - value)] {
            if distance.is_nan() || distance <= 0.0 {
                return Err(MotorFault::Limit(distance));
            }
            let [push, slope] = self.repulsion.at(distance);
            found.force += sign * push;
            // d grows with x at the lower limit, and falls at the upper one.
            found.by_value += slope;
            found.energy += self.repulsion.potential(distance);
            if let Some(damping) = &self.damping {
                let [resistance, slope] = damping.at(distance);
                found.force -= resistance * rate;
                found.by_rate -= resistance;
                found.by_value -= sign * slope * rate;
                found.power -= resistance * rate * rate;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_jumps_at_half_a_turn_unless_it_is_periodic() {
        let jump = |law: &str| {
            let law = Expression::parse(law, &ANGLE_NAMES, &[]).unwrap();
            Motor { drive: Some(Drive::Feedback(Arc::new(law))), stop: None }.jump_at_half_turn(0.5, 2.0)
        };
        assert!((jump("10*(3*t - angle) - 2*rate").unwrap() - 20.0 * PI).abs() < 1e-12);
        for periodic in ["-5*sin(angle)", "cos(2*angle)*rate", "angle^2", "sin(3*t) - rate", "0"] {
            assert_eq!(jump(periodic), None, "{periodic}");
        }
        assert!(jump("ln(angle)").unwrap().is_nan());
    }

    #[test]
    fn force_of_a_motor_is_that_of_its_energy_and_has_its_derivatives() {
        let stop = Stop {
            limits: [-0.4, 0.9],
            repulsion: StopLaw { coefficient: 0.7, exponent: 3.0, reference: 0.2 },
            damping: Some(StopLaw { coefficient: 0.3, exponent: 2.0, reference: 0.3 }),
        };
        let drive = Expression::parse("sin(3*t) - 2*angle*rate + angle^2", &ANGLE_NAMES, &[]).unwrap();
        let motor = Motor { drive: Some(Drive::Feedback(Arc::new(drive))), stop: Some(stop) };
        let mut scratch = Scratch::default();
        let mut at = |x: f64, v: f64| motor.at([x, v, 0.3], &mut scratch).unwrap();
        let (found, step) = (at(0.3, 0.8), 1e-6);
        let by_value = (at(0.3 + step, 0.8).force - at(0.3 - step, 0.8).force) / (2.0 * step);
        let by_rate = (at(0.3, 0.8 + step).force - at(0.3, 0.8 - step).force) / (2.0 * step);
        let rise = (at(0.3 + step, 0.8).energy - at(0.3 - step, 0.8).energy) / (2.0 * step);
        assert!((found.by_value - by_value).abs() < 1e-8 && (found.by_rate - by_rate).abs() < 1e-8);
        // F ẋ is what the energy loses and what is done by the rest.
        assert!((found.force * 0.8 - (found.power - rise * 0.8)).abs() < 1e-8);
        assert_eq!(motor.at([0.9, 0.0, 0.0], &mut scratch), Err(MotorFault::Limit(0.0)));
    }
}
