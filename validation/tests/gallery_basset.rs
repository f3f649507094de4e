//! The gallery's `basset`: a ball that the fluid remembers lags behind one that it does not.
//!
//! Remembered: the closed form of row 33. Forgotten: v = v∞ (1 − e^(−t/T)), T = 2ρ_p R²/(9η).

use gyration::fluid::unsteady::settling::settling;
use gyration_validation::{Experiment, largest};

const RADIUS: f64 = 2e-3;
const VISCOSITY: f64 = 1.0;
const DENSITIES: [f64; 2] = [7800.0, 1260.0];

#[test]
fn the_ball_that_is_remembered_is_as_slow_as_the_closed_form_says() {
    let run = Experiment::of_gallery("basset", &[]).run();
    let [ball, fluid] = DENSITIES;
    let last = 2.0 * (ball - fluid) * 9.81 * RADIUS * RADIUS / (9.0 * VISCOSITY);
    let (tau, relaxation) = (RADIUS * RADIUS * fluid / VISCOSITY, 2.0 * ball * RADIUS * RADIUS / (9.0 * VISCOSITY));
    let inertia = (2.0 * ball / fluid + 1.0) / 9.0;
    let speeds = |name: &str| -> Vec<f64> { run.column(name).iter().map(|speed| -speed / last).collect() };
    let remembered = speeds("remembered.vz");
    let errors = run.times.iter().zip(&remembered).map(|(time, speed)| speed - settling(inertia, time / tau));
    let error = largest(errors);
    println!("remembered: largest error {error:.1e} of the last speed");
    // The history is kept to 1e-6 of itself; row 33 has the table.
    assert!(error < 5e-6, "{error:e}");
    let forgotten = speeds("forgotten.vz");
    let error =
        largest(run.times.iter().zip(&forgotten).map(|(time, speed)| speed - (1.0 - (-time / relaxation).exp())));
    println!("forgotten: largest error {error:.1e}");
    assert!(error < 1e-7, "{error:e}");
    // As the scene says: it lacks 1/√(πt/τ) when the other has arrived, to first order in the time.
    let (time, lack) = (run.times[run.times.len() - 1], 1.0 - remembered[remembered.len() - 1]);
    let expected = 1.0 / (std::f64::consts::PI * time / tau).sqrt();
    assert!((lack / expected - 1.0).abs() < 0.1, "{lack} {expected}");
    assert!(1.0 - forgotten[forgotten.len() - 1] < 1e-5);
}
