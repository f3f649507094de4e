//! The scene `rocking-block`: swings whose period depends on their amplitude as Housner's does.

use gyration_sim::Outcome;
use gyration_validation::{Answer, Experiment, Run, largest};

/// b, h, and g in the scene's units.
const HALF_WIDTH: f64 = 0.05;
const HALF_HEIGHT: f64 = 0.2;
const GRAVITY: f64 = 9.81;

/// A swing from upright to upright.
struct Swing {
    duration: f64,
    /// Largest tilt [rad].
    amplitude: f64,
}

/// The swings of a run, the first from its release.
fn swings(run: &Run) -> Vec<Swing> {
    let tilts = run.column("block.P_xz");
    let mut found = Vec::new();
    let (mut began, mut first) = (None, 0);
    for k in 1..tilts.len() {
        let (before, now) = (tilts[k - 1], tilts[k]);
        if before * now >= 0.0 {
            continue;
        }
        let upright = run.times[k - 1] + (run.times[k] - run.times[k - 1]) * before / (before - now);
        if let Some(start) = began {
            let amplitude = largest(tilts[first..k].iter().map(|tilt| tilt.asin()));
            found.push(Swing { duration: upright - start, amplitude });
        }
        (began, first) = (Some(upright), k);
    }
    found
}

#[test]
fn swings_last_as_long_as_their_amplitude_says() {
    let run = Experiment::of_gallery("rocking-block", &["time.sample=0.0005"]).run();
    let critical = (HALF_WIDTH / HALF_HEIGHT).atan();
    let p = (0.75 * GRAVITY / HALF_WIDTH.hypot(HALF_HEIGHT)).sqrt();
    let swings = swings(&run);
    // Where the lower edge sinks by less than a tenth of the tilt's rise: θ > 10 d/(2b), d = 0.1 mm.
    let slender: Vec<&Swing> = swings.iter().take_while(|swing| swing.amplitude > 0.012).collect();
    assert!(slender.len() >= 10, "only {} swings", slender.len());
    let errors = slender.iter().map(|swing| {
        let reference = 2.0 * (1.0 / (1.0 - swing.amplitude / critical)).acosh() / p;
        println!("amplitude {:.4} rad: {:.4} s, rigid edge {reference:.4} s", swing.amplitude, swing.duration);
        swing.duration / reference - 1.0
    });
    Answer {
        row: Some(20),
        case: "scene rocking-block, swings down to 0.012 rad",
        quantity: "largest relative error of the duration of a swing",
        reference: 0.0,
        measured: largest(errors),
        tolerance: 0.03,
        source: "(2/p) arcosh(1/(1−θ/α)), p² = 3g/(4R)",
    }
    .check();
    // 1 − (1 − θ/α)² is the energy; a plastic impact leaves Housner's share of it, the field is free to leave more.
    let energy = |swing: &Swing| 1.0 - (1.0 - swing.amplitude / critical).powi(2);
    let ratios: Vec<f64> = slender.windows(2).map(|pair| energy(pair[1]) / energy(pair[0])).collect();
    let plastic = (1.0 - 1.5 * critical.sin().powi(2)).powi(2);
    println!("energy kept at an impact: {ratios:.3?}; plastic {plastic:.3}");
    assert!(ratios.iter().all(|ratio| *ratio > 0.5 * plastic && *ratio < 1.0), "{ratios:?}");
}

#[test]
fn block_settles_where_it_stood() {
    let run = Experiment::of_gallery("rocking-block", &[]).run();
    assert!(matches!(run.outcome, Outcome::AtRest { .. }), "{}", run.outcome.in_words());
    let (x, y, tilt) = (run.column("block.x"), run.column("block.y"), run.column("block.P_xz"));
    // Released on its right edge it comes down with its middle b to the left of it.
    let start = HALF_WIDTH * 10_f64.to_radians().cos() - HALF_HEIGHT * 10_f64.to_radians().sin();
    let walked = x.last().unwrap() + HALF_WIDTH - start;
    println!("walked {:.2e} m, at rest with a tilt of {:.1e}", walked, tilt.last().unwrap());
    assert!(walked.abs() < 0.02 * HALF_WIDTH, "walked {walked} m");
    assert!(largest(y) < 1e-9 && tilt.last().unwrap().abs() < 1e-4);
    // The scene's rtol is 1e-8.
    assert!(run.relative_residual() < 1e-6, "{:e}", run.relative_residual());
}
