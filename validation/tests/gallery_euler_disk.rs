//! The scene `euler-disk`: it goes round at the steady rate of its inclination, faster and faster, and ends in finite
//! time.

use crate::spinning::{Spinning, falls_to, mean};
use gyration_sim::Outcome;
use gyration_validation::{Answer, Experiment, largest};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.0375;

#[test]
fn disk_keeps_the_steady_rate_while_it_sinks_and_then_stops() {
    let run = Experiment::of_gallery("euler-disk", &[]).run();
    let motion = Spinning::of(&run, "disk");
    let (azimuths, inclinations) = (motion.azimuths(), motion.inclinations());
    let mut rates = Vec::new();
    let mut errors = Vec::new();
    // Means over windows of 0.25 s, some turns, down to 3°, where the gap is a twentieth of the rim's rise.
    let end = inclinations.iter().position(|inclination| *inclination < 3_f64.to_radians()).unwrap();
    for first in (0..end - 250).step_by(250) {
        let last = first + 250;
        let rate = (azimuths[last] - azimuths[first]) / (run.times[last] - run.times[first]);
        let steady: Vec<f64> =
            inclinations[first..last].iter().map(|a| (4.0 * GRAVITY / (RADIUS * a.sin())).sqrt()).collect();
        rates.push(rate);
        errors.push((rate / mean(&steady)).powi(2) - 1.0);
    }
    println!("rates {rates:.2?} rad/s");
    Answer {
        row: Some(21),
        case: "scene euler-disk, from 20° down to 3°",
        quantity: "largest relative error of the square of the rate",
        reference: 0.0,
        measured: largest(errors),
        // The list asks for 2 % of a thin disk: this one is 2 mm thick and 0.1 mm above the table.
        tolerance: 0.02,
        source: "Ω² = 4g/(r sin a)",
    }
    .check();
    assert!(rates.windows(2).all(|pair| pair[1] > pair[0]), "{rates:?}");
    let wandered = largest(run.column("disk.x").into_iter().chain(run.column("disk.y")));
    println!("the centre stays within {:.1e} m", wandered);
    assert!(wandered < 0.02 * RADIUS, "the centre wanders by {wandered} m");
    assert!(matches!(run.outcome, Outcome::AtRest { .. }), "{}", run.outcome.in_words());
    let [halfway, flat] = [10.0_f64, 0.5].map(|angle| falls_to(&run.times, &inclinations, angle.to_radians()).unwrap());
    println!("at 10° at {halfway:.3} s, at 0.5° at {flat:.3} s");
    // E ~ (t_end − t)^½ leaves a quarter of the time for the second half of the inclination.
    assert!(halfway > 0.65 * flat && halfway < 0.8 * flat, "at 10° at {halfway} s, at 0.5° at {flat} s");
    assert!(run.relative_residual() < 1e-6, "{:e}", run.relative_residual());
}
