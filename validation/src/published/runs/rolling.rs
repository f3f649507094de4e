//! LAMMPS's granular tests: a ball that slides, rolls or spins on a plane, from the gap at which it rests.
//!
//! The gap of a resting ball, 2πRα d₀ (d/d₀)^(1−ν)/(ν−1) = N, goes as d₀^1.2, and so does what the gap does.

use super::{DENSITY, GRAVITY, RADIUS, floor, halved, halved_each, laws, row, scene, sphere};
use crate::Experiment;
use std::f64::consts::PI;

/// d₀ of the first run, at which the ball rests [m].
const FIRST: f64 = 1e-3 * RADIUS;

/// A ball on a plane that leans by `slope`, its tangent.
struct Ball {
    slope: f64,
    /// c of the damping [s/m].
    damping: f64,
    /// c of the friction [s/m].
    friction: f64,
    mu: Option<f64>,
    velocity: [f64; 3],
    spin: [f64; 3],
}

const AT_REST: Ball = Ball { slope: 0.0, damping: 0.0, friction: 0.0, mu: None, velocity: [0.0; 3], spin: [0.0; 3] };

impl Ball {
    /// The run to this end with samples, and the gap that carries the ball.
    fn at(&self, d0: f64, end: f64, sample: f64) -> (Experiment, f64) {
        let cosine = 1.0 / (1.0 + self.slope * self.slope).sqrt();
        let weight = DENSITY * 4.0 / 3.0 * PI * RADIUS.powi(3) * GRAVITY * cosine;
        // The first one rests at d₀; the far side of the ball is felt by 3e-17 of it.
        let alpha = 5.0 * weight / (2.0 * PI * RADIUS * FIRST);
        let gap = d0 * (2.0 * PI * RADIUS * alpha * d0 / (5.0 * weight)).powf(0.2);
        let gravity = [GRAVITY * self.slope * cosine, 0.0, -GRAVITY * cosine];
        let plane = floor(&laws(alpha, d0, self.damping, self.friction, self.mu));
        let more = format!("angular_velocity = {:?}", self.spin);
        let ball = sphere("ball", RADIUS, DENSITY, [0.0, 0.0, RADIUS + gap], self.velocity, &more);
        (scene(gravity, end, sample, &(plane + &ball)), gap)
    }

    /// Speed along and spin across at this time.
    fn speed_and_spin(&self, d0: f64, time: f64) -> [f64; 2] {
        let motion = self.at(d0, time, time).0.motion_at(time);
        [motion.velocity.velocity.x, motion.angular_velocity().y]
    }
}

const THROWN: Ball = Ball { friction: 100.0, velocity: [1.0, 0.0, 0.0], ..AT_REST };

#[test]
fn slip_of_a_thrown_ball_ceases() {
    let [speed, spin] = halved_each(FIRST, |d0| {
        let [speed, spin] = THROWN.speed_and_spin(d0, 6e-3);
        [speed, RADIUS * spin]
    });
    row("granular-slip-ceases-speed").check(speed);
    row("granular-slip-ceases-spin").check(spin);
}

#[test]
fn a_thrown_ball_slides_as_the_bound_says() {
    let bounded = Ball { mu: Some(0.3), ..THROWN };
    for (key, time) in [("granular-slip-speed-bound", 0.05), ("granular-slip-speed-bound-late", 0.09)] {
        row(key).check(halved(FIRST, |d0| bounded.speed_and_spin(d0, time)[0]));
    }
    let strong = Ball { friction: 1e6, ..bounded };
    let [speed, spin] = halved_each(FIRST, |d0| strong.speed_and_spin(d0, 0.05));
    row("granular-slip-speed").check(speed);
    row("granular-slip-spin").check(spin);
}

#[test]
fn a_ball_on_a_slope_rolls_or_slides() {
    for (key, slope, friction) in [("granular-incline-rolls", 0.5, 40.0), ("granular-incline-slides", 0.8, 1e6)] {
        let ball = Ball { slope, friction, mu: Some(0.2), ..AT_REST };
        let acceleration = |d0: f64| {
            let speed = ball.at(d0, 0.15, 0.05).0.run().column("ball.vx");
            (speed[3] - speed[1]) / 0.1
        };
        row(key).check(halved(FIRST, acceleration));
    }
}

#[test]
fn rolling_decays_with_the_gap_and_not_by_a_torque_of_its_own() {
    let spin = 100.0;
    let ball =
        Ball { damping: 1.0, friction: 40.0, velocity: [spin * RADIUS, 0.0, 0.0], spin: [0.0, spin, 0.0], ..AT_REST };
    row("granular-rolling-decay").check(halved(FIRST, |d0| ball.speed_and_spin(d0, 0.1)[1]));
    // The reason of the row: what is left decays as damping and friction say, once the little slip has died.
    let (experiment, gap) = ball.at(FIRST, 1.0, 0.5);
    let speeds = experiment.run().column("ball.vx");
    let ratio = gap / RADIUS;
    let rate = 5.0 / 7.0 * GRAVITY * ratio / 4.0 + 0.075 * 40.0 * GRAVITY * ratio * ratio;
    let found = (speeds[1] / speeds[2]).ln() / 0.5;
    println!("rolling decays at {:.4} of the rate", found / rate);
    assert!((found / rate - 1.0).abs() < 0.01, "{found} and {rate} 1/s");
}

#[test]
fn a_spin_about_the_normal_decays_by_the_bound() {
    let (mu, spin, time) = (0.3, 100.0, 0.5);
    let ball = Ball { friction: 1e6, mu: Some(mu), spin: [0.0, 0.0, spin], ..AT_REST };
    let lost = |d0: f64| {
        let (experiment, gap) = ball.at(d0, time, time);
        let arm = mu * (2.0 * RADIUS * gap / 4.0).sqrt();
        let known = 5.0 * arm * GRAVITY * time / (2.0 * RADIUS * RADIUS);
        (spin - experiment.motion_at(time).angular_velocity().z) / known
    };
    row("granular-twist-decay").check(halved(FIRST, lost));
}
