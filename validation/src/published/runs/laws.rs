//! LAMMPS's granular tests: free fall, drag, pull-off.

use super::{DENSITY, GRAVITY, RADIUS, halved, last, row, scene, sphere};
use crate::published::Runs;

#[test]
fn a_ball_falls_freely() {
    let ball = sphere("ball", RADIUS, DENSITY, [0.0, 0.0, 1.0], [0.0; 3], "");
    let experiment = scene([0.0, 0.0, -GRAVITY], 0.4, 0.4, &ball);
    row("granular-free-fall").check(Runs::Once(experiment.motion_at(0.4).placement.position.z));
}

#[test]
fn a_ball_sinks_at_its_terminal_velocity() {
    for (key, inertia) in [("granular-terminal-velocity", false), ("granular-terminal-velocity-inertia", true)] {
        let immersed = format!("inclusion = {{ inertia = {inertia} }}");
        let ball = sphere("ball", RADIUS, DENSITY, [0.0; 3], [0.0; 3], &immersed);
        let fluid = "fluid = { viscosity = 1, density = 0 }\n";
        let run = scene([0.0, 0.0, -GRAVITY], 2.0, 2.0, &(fluid.to_owned() + &ball)).run();
        row(key).check(Runs::Once(-last(&run, "ball.vz")));
    }
}

/// The largest pull between two balls that adhere: a parabola through three gaps about d₀.
fn pull(d0: f64) -> f64 {
    let beta = 0.1 / (d0 * (0.5 - 0.125));
    let adhesion = format!("adhesion = {{ beta = {beta:?}, nu_attractive = 3, nu_repulsive = 9, d0 = {d0:?} }}\n");
    let contact = format!("[[contact]]\nbetween = [\"a\", \"b\"]\n{adhesion}");
    let at = |gap: f64| {
        let balls = sphere("a", RADIUS, DENSITY, [0.0, 0.0, RADIUS + gap], [0.0; 3], "")
            + &sphere("b", RADIUS, DENSITY, [0.0, 0.0, -RADIUS], [0.0; 3], "");
        -scene([0.0; 3], 1e-12, 1e-12, &(contact.clone() + &balls)).run().column("a.fz")[0]
    };
    let [near, middle, far] = [0.999 * d0, d0, 1.001 * d0].map(at);
    let (slope, bend) = (0.5 * (far - near), far - 2.0 * middle + near);
    assert!(bend < 0.0 && (slope / bend).abs() < 1.0, "the largest pull is not between {near}, {middle}, {far}");
    middle - 0.5 * slope * slope / bend
}

#[test]
fn two_balls_pull_off_at_the_force_of_dmt() {
    row("granular-pull-off-dmt").check(halved(1e-3 * RADIUS, pull));
}
