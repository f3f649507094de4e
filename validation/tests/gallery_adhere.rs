//! The gallery's `adhere`: a ball is caught by a sticky ceiling, and comes off at its pull-off.
//!
//!   f(d) = 2πR d₀ β ((d/d₀)^(1−ν_a)/(ν_a−1) − (d/d₀)^(1−ν_r)/(ν_r−1)) ≤ F at d = d₀        (R ≫ d)
//!   it is borne while m (g + a(t)) ≤ F,   a(t) = −Aω² sin(ωt + φ) the upward acceleration of the ceiling
//!
//! A load that rises slowly is passed with a delay: near the fold c ẏ = ½κF y² + m ȧ t with the damping c at d₀ and κ =
//! (ν_r − ν_a)/(d₀²(1/(ν_a−1) − 1/(ν_r−1))), so that the ball is at d₀ after 1.0188 T, T³ = 2c²/(κF m ȧ) (the first
//! zero of Ai′).

use gyration_validation::{Answer, Experiment};
use std::f64::consts::{PI, TAU};

const CASE: &str = "gallery: adhere";
const RADIUS: f64 = 0.015;
const REFERENCE_GAP: f64 = 1e-5;
const BETA: f64 = 236.25e3;
const DAMPING: f64 = 1.65e7;
const GRAVITY: f64 = 9.81;
const AMPLITUDE: f64 = 0.04;
const OMEGA: f64 = 2.0 * TAU;
const PHASE: f64 = 0.1 * PI;

fn mass() -> f64 {
    200.0 * 4.0 / 3.0 * PI * RADIUS.powi(3)
}

/// The attraction at a gap [N].
fn attraction(gap: f64) -> f64 {
    let s = gap / REFERENCE_GAP;
    2.0 * PI * RADIUS * REFERENCE_GAP * BETA * (s.powi(-3) / 3.0 - s.powi(-7) / 7.0)
}

/// The upward acceleration of the ceiling [m/s²].
fn acceleration(time: f64) -> f64 {
    -AMPLITUDE * OMEGA * OMEGA * (OMEGA * time + PHASE).sin()
}

/// How long after the load has passed the pull-off the ball is at the gap of the pull-off [s].
fn delay(time: f64) -> f64 {
    /// −1 times the first zero of the derivative of Airy's function Ai. Source: DLMF, table 9.9.1.
    const AIRY: f64 = 1.0187929716;
    let jerk = -AMPLITUDE * OMEGA.powi(3) * (OMEGA * time + PHASE).cos();
    let damping = 2.0 * PI * RADIUS * REFERENCE_GAP * DAMPING / 7.0;
    let curvature = 4.0 / (REFERENCE_GAP.powi(2) * (1.0 / 3.0 - 1.0 / 7.0));
    AIRY * (2.0 * damping.powi(2) / (curvature * attraction(REFERENCE_GAP) * mass() * jerk)).cbrt()
}

fn answer(quantity: &'static str, reference: f64, measured: f64, tolerance: f64, source: &'static str) {
    Answer { row: None, case: CASE, quantity, reference, measured, tolerance, source }.check();
}

/// The first time after `from` at which the gap is wider than d₀ [s], interpolated between samples.
fn comes_off(times: &[f64], gaps: &[f64], from: f64) -> f64 {
    let k = (1..gaps.len()).find(|k| times[*k] > from && gaps[*k] > REFERENCE_GAP);
    let k = k.unwrap_or_else(|| panic!("never off after {from} s"));
    times[k - 1] + (REFERENCE_GAP - gaps[k - 1]) / (gaps[k] - gaps[k - 1]) * (times[k] - times[k - 1])
}

#[test]
fn ball_is_caught_and_comes_off_at_the_pull_off() {
    let run = Experiment::of_gallery("adhere", &["time.sample=1e-5"]).run();
    let gaps = run.column("ball.gap");
    let caught = run.times.iter().zip(&gaps).filter(|(time, _)| (0.15..0.3).contains(*time));
    assert!(caught.clone().all(|(_, gap)| *gap < REFERENCE_GAP), "not caught");
    let pull_off = attraction(REFERENCE_GAP);
    // The largest over the gaps, which the closed form puts at d₀.
    let gaps_around = (1..400).map(|k| REFERENCE_GAP * 0.01 * f64::from(k));
    assert!(gaps_around.map(attraction).all(|force| force <= pull_off));
    let off = comes_off(&run.times, &gaps, 0.15);
    let load = mass() * (GRAVITY + acceleration(off));
    // The list asks for 1 %.
    answer("load under which it comes off [N]", pull_off, load, 1e-2, "2πR d₀ β (1/(ν_a−1) − 1/(ν_r−1))");
    // a(t) = F/m − g on the way down of the sine.
    let excess = (pull_off / mass() - GRAVITY) / (AMPLITUDE * OMEGA * OMEGA);
    let passed = (PI + excess.asin() - PHASE) / OMEGA;
    // The inertia of the ball on its bond adds to the delay of damping, here a fifth of it.
    answer("instant at which it comes off [s]", passed + delay(passed), off, 2e-3, "slow passage of a fold, 1.0188 T");
}

#[test]
fn ball_that_the_ceiling_shakes_less_stays() {
    // 6.3 m/s² × 0.8 is less than the 5.2 m/s² that adhesion can give beside gravity.
    let gentle =
        ["support.ceiling.motion.oscillate.amplitude=0.032", "body.ball.position=[0, 0, 0.2667]", "time.end=2"];
    let run = Experiment::of_gallery("adhere", &gentle).run();
    let gaps = run.column("ball.gap");
    let held = run.times.iter().zip(&gaps).filter(|(time, _)| **time > 0.15);
    assert!(held.clone().count() > 100 && held.clone().all(|(_, gap)| *gap < REFERENCE_GAP));
    assert!(run.relative_residual() < 1e-8, "{:e}", run.relative_residual());
}
