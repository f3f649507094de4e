//! A ball without inertia goes with a flow that changes in time: its way is the integral of the velocity.

use gyration_validation::{Case, Experiment};

/// The way [m] of the ball along x in a flow whose velocity is such a signal, at a time [s].
fn way(signal: &str, end: f64) -> f64 {
    let scene = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {end:?}, sample = {end:?} }}\n\
         fluid = {{ viscosity = 1, velocity = {signal} }}\n[[body]]\nname = \"ball\"\n\
         shape = {{ sphere = {{ radius = 0.1 }} }}\ndensity = 1000\ninclusion = {{ inertia = false }}\n"
    );
    *Experiment::of_scene(&scene).run().column("ball.x").last().unwrap_or(&f64::NAN)
}

#[test]
fn a_ball_goes_with_a_flow_that_rises_and_with_one_that_turns_back() {
    let case = Case { row: None, name: "a ball without inertia in a flow that changes", source: "∫U dt" };
    // From zero to 3 m/s in 0.4 s, then on.
    let ramp = "{ ramp = { to = [3, 0, 0], duration = 0.4 } }";
    case.check("way in a flow that rises [m]", 3.0 * (0.5 * 0.4 + 0.3), way(ramp, 0.7), 1e-12);
    // Forwards for 1/8 s, back for 1/4 s, of which 1/16 s is seen.
    let square = "{ square = { amplitude = [3, 0, 0], frequency = 2, phase = \"90 deg\" } }";
    case.check("way in a flow that turns back [m]", 3.0 * (0.125 - 0.0625), way(square, 0.1875), 1e-12);
}
