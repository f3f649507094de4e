//! Chung & Ooi's elementary impacts.

use super::{ALPHA, RADIUS, damping, floor, laws, row, scene, sphere};
use crate::Experiment;
use crate::published::Runs;
use gyration_scene::Recorded;

/// The speed of each of two balls [m/s].
const SPEED: f64 = 10.0;

/// Two balls that come towards each other from this gap.
fn balls(density: f64, gap: f64) -> String {
    let place = RADIUS + 0.5 * gap;
    sphere("a", RADIUS, density, [-place, 0.0, 0.0], [SPEED, 0.0, 0.0], "")
        + &sphere("b", RADIUS, density, [place, 0.0, 0.0], [-SPEED, 0.0, 0.0], "")
}

#[test]
fn equal_balls_exchange_their_velocities() {
    for (velocity, momentum, density) in [
        ("chung-ooi-1-glass-velocity", "chung-ooi-1-glass-momentum", 2800.0),
        ("chung-ooi-1-limestone-velocity", "chung-ooi-1-limestone-momentum", 2500.0),
    ] {
        let contact = format!("[[contact]]\nbetween = [\"a\", \"b\"]\n{}", laws(ALPHA, 1e-4, 0.0, 0.0, None));
        let experiment = scene([0.0; 3], 2e-3, 2e-3, &(contact + &balls(density, 0.02)));
        let run = experiment.run();
        let [a, b] = [0, 1].map(|body| run.end.motion(&experiment.model, body).velocity.velocity.x);
        row(velocity).check(Runs::Once(a));
        row(momentum).check(Runs::Once((a + b) / (2.0 * SPEED)));
    }
}

/// Two balls with Hertz's law as a bond, which begins after 10 µs.
fn bonded(density: f64, modulus: f64, poisson: f64) -> Experiment {
    let effective = modulus / (2.0 * (1.0 - poisson * poisson));
    let stiffness = 4.0 / 3.0 * effective * (0.5 * RADIUS).sqrt();
    let bond = format!(
        "[[bond]]\nbetween = [\"a\", \"b\"]\nlaw = \"0.4*k*max({:?} - l, 0)^2.5\"\n\
         constants = {{ k = {stiffness:?} }}\n",
        2.0 * RADIUS
    );
    let rest = balls(density, 2.0 * SPEED * TOUCH) + &bond;
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1e-4, sample = 1e-4 }}\n\
         solver = {{ rtol = 1e-11, atol = 1e-13, max_step = 1e-6 }}\n{rest}"
    );
    Experiment::of_scene(&text)
}

/// The time at which the balls touch [s].
const TOUCH: f64 = 1e-5;

#[test]
fn a_bond_of_hertz_turns_back_as_his_law_says() {
    for ([overlap, force, duration], density, modulus, poisson) in [
        (["chung-ooi-1-glass-overlap", "chung-ooi-1-glass-force", "chung-ooi-1-glass-duration"], 2800.0, 48e9, 0.2),
        (
            ["chung-ooi-1-limestone-overlap", "chung-ooi-1-limestone-force", "chung-ooi-1-limestone-duration"],
            2500.0,
            20e9,
            0.25,
        ),
    ] {
        let experiment = bonded(density, modulus, poisson);
        let turn = experiment.time_when(TOUCH + 2.4e-5, |motion| motion.velocity.velocity.x);
        let run = experiment.recording([Recorded::ForceTotal]).until(turn).run();
        let [a, b] = [0, 1].map(|body| run.end.motion(&experiment.model, body).placement.position.x);
        row(overlap).check(Runs::Once(1e3 * (2.0 * RADIUS - (b - a))));
        let push = run.vectors_of(0, "force_total").last().map_or(f64::NAN, |it| -it.x);
        row(force).check(Runs::Once(push));
        let part = experiment.time_when(TOUCH + 4.8e-5, |motion| motion.placement.position.x + RADIUS);
        row(duration).check(Runs::Once(1e6 * (part - TOUCH)));
    }
}

/// The restitution of a ball of 2.5 mm that strikes a plane with 3.9 m/s.
fn restitution(density: f64, wanted: f64) -> f64 {
    let (radius, speed, gap) = (2.5e-3, 3.9, 2.5e-3);
    let plane = floor(&laws(ALPHA, 1e-5, damping(wanted) / speed, 0.0, None));
    let ball = sphere("ball", radius, density, [0.0, 0.0, radius + gap], [0.0, 0.0, -speed], "");
    let end = gap / speed * (1.0 + 2.0 / wanted);
    let experiment = scene([0.0; 3], end, end, &(plane + &ball));
    experiment.motion_at(end).velocity.velocity.z / speed
}

#[test]
fn impacts_on_a_plane_have_the_restitution_that_was_put_in() {
    for (density, keys) in [
        (
            4000.0,
            [
                ("chung-ooi-3-oxide-0.2", 0.2),
                ("chung-ooi-3-oxide-0.4", 0.4),
                ("chung-ooi-3-oxide-0.6", 0.6),
                ("chung-ooi-3-oxide-0.8", 0.8),
                ("chung-ooi-3-oxide-0.9", 0.9),
                ("chung-ooi-3-oxide-1", 1.0),
            ],
        ),
        (
            7000.0,
            [
                ("chung-ooi-3-iron-0.2", 0.2),
                ("chung-ooi-3-iron-0.4", 0.4),
                ("chung-ooi-3-iron-0.6", 0.6),
                ("chung-ooi-3-iron-0.8", 0.8),
                ("chung-ooi-3-iron-0.9", 0.9),
                ("chung-ooi-3-iron-1", 1.0),
            ],
        ),
    ] {
        for (key, wanted) in keys {
            row(key).check(Runs::Once(restitution(density, wanted)));
        }
    }
}
