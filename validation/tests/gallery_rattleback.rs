//! The scene `rattleback`: clockwise it reverses, anticlockwise it does not.

use crate::spinning::{Spinning, falls_to};
use gyration_validation::Experiment;

#[test]
fn rattleback_spun_clockwise_turns_round() {
    let run = Experiment::of_gallery("rattleback", &[]).run();
    let spins = Spinning::of(&run, "stone").vertical_spins();
    let speeds: Vec<f64> = spins.iter().map(|spin| -spin).collect();
    let stop = falls_to(&run.times, &speeds, 0.0);
    let back = spins.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    println!("stops at {stop:?} s, comes back with {back:.3} rad/s");
    assert!(stop.is_some_and(|time| time > 1.0) && back > 0.5, "stops at {stop:?} s, comes back with {back} rad/s");
    // The scene's rtol is 1e-6.
    assert!(run.relative_residual() < 1e-4, "{:e}", run.relative_residual());
}

#[test]
fn rattleback_spun_anticlockwise_goes_on() {
    let run = Experiment::of_gallery("rattleback", &["body.stone.angular_velocity=[0, 0.5, 5]"]).run();
    let spins = Spinning::of(&run, "stone").vertical_spins();
    let slowest = spins.iter().copied().fold(f64::INFINITY, f64::min);
    println!("never below {slowest:.3} rad/s");
    assert!(slowest > 1.5, "slowed down to {slowest} rad/s");
}
