//! Row 33: spheres in a fluid with inertia, which sink from rest, or are set spinning and let go.
//!
//!   A v' + v + π^−½ ∫ v'/√(τ − s) ds = 1,   A = (2ρ_p/ρ_f + 1)/9,   v in units of 2(ρ_p − ρ_f) g R²/(9η), t in those of R²ρ_f/η
//!
//! The scene knows added mass and the modes of the history alone; the reference is the closed form.

use gyration::fluid::unsteady::{settling::settling, spinning::spinning};
use gyration_validation::{Case, Experiment, Run, largest};

const RADIUS: f64 = 2e-3;
const VISCOSITY: f64 = 0.3;
const DENSITY: f64 = 900.0;
/// R²ρ_f/η \[s\].
const TAU: f64 = RADIUS * RADIUS * DENSITY / VISCOSITY;
const GRAVITY: f64 = 9.81;

/// A run of a sphere of so many times the density of the fluid, until t = `end` and sampled every `sample`, in units of
/// τ.
fn run(ratio: f64, (end, sample): (f64, f64), more: &str) -> Run {
    let (end, sample, density) = (end * TAU, sample * TAU, ratio * DENSITY);
    let text = format!(
        "time = {{ end = {end:?}, sample = {sample:?} }}
        fluid = {{ viscosity = {VISCOSITY}, density = {DENSITY} }}
        [[body]]
        name = \"ball\"
        shape = {{ sphere = {{ radius = {RADIUS} }} }}
        density = {density:?}
        inclusion = {{ history = true }}
        {more}"
    );
    Experiment::of_scene(&text).run()
}

/// The speed of sinking, in units of the last one.
fn speeds(run: &Run, ratio: f64) -> Vec<f64> {
    let last = 2.0 * (ratio - 1.0) * DENSITY * GRAVITY * RADIUS * RADIUS / (9.0 * VISCOSITY);
    run.column("ball.vz").iter().map(|speed| -speed / last).collect()
}

#[test]
fn spheres_sink_as_the_closed_form_says() {
    let case =
        Case { row: Some(33), name: "settling sphere, ρ_p/ρ_f = 1", source: "Basset (1888), closed form with erfc" };
    // A fluid in which nothing sinks would give no speed: the ratio is one to a millionth.
    let ratio = 1.0 + 1e-6;
    for (time, reference) in [(0.1, 0.1544895533), (1.0, 0.5163909604), (10.0, 0.8245501527)] {
        let found = speeds(&run(ratio, (time, time), ""), ratio);
        let quantity = ["v(0.1)", "v(1)", "v(10)"][[0.1, 1.0, 10.0].iter().position(|t| *t == time).unwrap_or(0)];
        // The weight is the difference of two forces a million times as large. Asked: 1e-4.
        case.check(quantity, reference, found[found.len() - 1], 1e-5);
    }
}

#[test]
fn light_and_heavy_spheres_sink_as_the_closed_form_says() {
    for (name, ratio) in [("bubble-like, ρ_p/ρ_f = 0.01", 0.01), ("sand", 2.65), ("steel in oil", 8.7)] {
        let inertia = (2.0 * ratio + 1.0) / 9.0;
        let run = run(ratio, (20.0, 0.1), "");
        let found = speeds(&run, ratio);
        let errors = run.times.iter().zip(&found).map(|(time, speed)| speed - settling(inertia, time / TAU));
        let case = Case { row: Some(33), name, source: "Basset (1888), closed form with erfc" };
        // Asked: 1e-4. The sum of exponentials is made to 1e-6 of the history force.
        case.check("largest error of v until 20 τ", 0.0, largest(errors), 5e-6);
        println!("residual of the ledger {:.1e}", run.relative_residual());
        assert!(run.relative_residual() < 1e-7);
    }
}

#[test]
fn spinning_sphere_slows_down_as_the_closed_form_says() {
    let ratio = 2.5;
    let run = run(ratio, (10.0, 0.05), "angular_velocity = [0, 0, 3]\nposition = [0, 0, 0]");
    let spins: Vec<f64> = run
        .matrices("gradient_rate")
        .iter()
        .zip(run.matrices("placement_gradient"))
        .map(|(rate, turn)| (rate * turn.transpose())[(1, 0)])
        .collect();
    let errors =
        run.times.iter().zip(&spins).skip(1).map(|(time, spin)| spin / 3.0 - spinning(ratio / 15.0, time / TAU));
    let case = Case {
        row: Some(33),
        name: "sphere set spinning and let go, ρ_p/ρ_f = 2.5",
        source: "inverse transform, on the cut",
    };
    case.check("largest error of Ω/Ω₀ until 10 τ", 0.0, largest(errors), 1e-6);
}
