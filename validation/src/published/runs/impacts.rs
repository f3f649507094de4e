//! LAMMPS's granular tests: impacts, momenta, energies.

use super::{ALPHA, DENSITY, GRAVITY, RADIUS, damping, floor, halved_each, last, laws, row, scene, sphere};
use crate::published::Runs;
use crate::{Run, momenta};

#[test]
fn impacts_keep_their_momentum_and_return_what_the_damping_leaves() {
    let gap = 0.02;
    let place = RADIUS + 0.5 * gap;
    let balls = sphere("a", RADIUS, DENSITY, [-place, 0.0, 0.0], [1.0, 0.0, 0.0], "")
        + &sphere("b", RADIUS, DENSITY, [place, 0.0, 0.0], [-1.0, 0.0, 0.0], "");
    let between =
        format!("[[contact]]\nbetween = [\"a\", \"b\"]\n{}", laws(ALPHA, 1e-4, 0.5 * damping(0.6), 0.0, None));
    let pair = scene([0.0; 3], 0.04, 0.04, &(between + &balls));
    let run = pair.run();
    let [a, b] = [0, 1].map(|body| run.end.motion(&pair.model, body).velocity.velocity.x);
    row("granular-restitution-head-on").check(Runs::Once(a));
    row("granular-restitution-momentum").check(Runs::Once((a + b) / 2.0));
    let plane = floor(&laws(ALPHA, 1e-4, damping(0.6), 0.0, None));
    let ball = sphere("ball", RADIUS, DENSITY, [0.0, 0.0, RADIUS + gap], [0.0, 0.0, -1.0], "");
    let velocity = scene([0.0; 3], 0.07, 0.07, &(plane + &ball)).motion_at(0.07).velocity.velocity.z;
    row("granular-restitution-wall").check(Runs::Once(-velocity));
}

#[test]
fn ellipsoids_that_collide_off_centre_keep_their_momenta() {
    let contact = format!("[[contact]]\nbetween = [\"a\", \"b\"]\n{}", laws(ALPHA, 1e-4, 0.3, 100.0, Some(0.3)));
    let body = |name: &str, axes: [f64; 3], mass: f64, place: [f64; 3], speed: f64, axis: [f64; 3]| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ ellipsoid = {{ semi_axes = {axes:?} }} }}\nmass = {mass:?}\n\
             position = {place:?}\nvelocity = [{speed:?}, 0, 0]\n\
             orientation = {{ axis_angle = {{ axis = {axis:?}, angle = 0.6 }} }}\n"
        )
    };
    let bodies = body("a", [0.02, 0.015, 0.01], 0.05, [-0.06, 0.008, 0.004], 1.0, [1.0, 2.0, 3.0])
        + &body("b", [0.01, 0.02, 0.015], 0.08, [0.0; 3], 0.0, [-1.0, 1.0, 2.0]);
    let experiment = scene([0.0; 3], 0.2, 0.2, &(contact + &bodies));
    let run = experiment.run();
    let (linear, angular) = momenta(&experiment.model, &run.end);
    let spins = [0, 1].map(|body| run.end.motion(&experiment.model, body).angular_velocity().norm());
    assert!(spins.iter().all(|spin| *spin > 1.0), "they have hardly met: {spins:?}");
    row("granular-ellipsoids-momentum").check(Runs::Once(linear.x));
    row("granular-ellipsoids-angular-momentum").check(Runs::Once(angular.z));
}

/// Kinetic energy, that in the field of gravity and that of contacts, at each sample.
fn energies(run: &Run) -> Vec<f64> {
    let columns = ["energy.kinetic", "energy.gravity", "energy.contact"].map(|name| run.column(name));
    (0..run.times.len()).map(|k| columns.iter().map(|column| column[k]).sum()).collect()
}

#[test]
fn balls_between_floor_and_ceiling_keep_their_energy() {
    let law = laws(ALPHA, 1e-4, 0.0, 0.0, None);
    let ceiling = format!(
        "[[support]]\nname = \"ceiling\"\nplane = {{ origin = [0, 0, 0.06], normal = [0, 0, -1] }}\n\
         [[contact]]\nsupport = \"ceiling\"\n{law}[[contact]]\nbetween = [\"a\", \"b\"]\n{law}"
    );
    let balls = sphere("a", RADIUS, DENSITY, [0.0, 0.0, 0.013], [0.0, 0.0, 0.5], "")
        + &sphere("b", RADIUS, DENSITY, [0.0, 0.0, 0.036], [0.0, 0.0, -0.3], "");
    let run = scene([0.0, 0.0, -GRAVITY], 1.0, 1e-3, &(floor(&law) + &ceiling + &balls)).run();
    assert!(run.times_of("closest_approach").len() > 20, "{:?}", run.events);
    let energies = energies(&run);
    let change = energies.iter().map(|energy| (energy / energies[0] - 1.0).abs()).fold(0.0, f64::max);
    row("granular-stack-energy").check(Runs::Once(change));
}

#[test]
fn an_impact_with_friction_never_gains_energy() {
    let plane = floor(&laws(ALPHA, 1e-4, 0.0, 100.0, Some(0.3)));
    let spin = "angular_velocity = [0, -50, 20]";
    let ball = sphere("ball", RADIUS, DENSITY, [0.0, 0.0, 0.03], [1.0, 0.0, -1.0], spin);
    let run = scene([0.0, 0.0, -GRAVITY], 0.5, 1e-5, &(plane + &ball)).run();
    let energies = energies(&run);
    let (mut least, mut rise) = (energies[0], 0.0_f64);
    for energy in &energies {
        rise = rise.max(energy - least);
        least = least.min(*energy);
    }
    assert!(least < 0.9 * energies[0], "friction has taken nothing: {least} of {}", energies[0]);
    row("granular-friction-energy").check(Runs::Once(rise / energies[0]));
}

/// Speed along and spin of a ball that strikes a plane with 1 m/s and slides throughout.
fn strike(d0: f64, along: f64, spin: f64) -> [f64; 2] {
    let plane = floor(&laws(1e9, d0, damping(0.8), 1e6, Some(0.1)));
    let more = format!("angular_velocity = [0, {spin:?}, 0]");
    let ball = sphere("ball", RADIUS, DENSITY, [0.0, 0.0, RADIUS + 2e-3], [along, 0.0, -1.0], &more);
    let experiment = scene([0.0; 3], 6e-3, 6e-3, &(plane + &ball));
    let run = experiment.run();
    let end = run.end.motion(&experiment.model, 0);
    assert!(end.velocity.velocity.z > 0.5 && last(&run, "ball.gap") > 1e-3, "it has not left");
    [end.velocity.velocity.x, end.angular_velocity().y]
}

#[test]
fn an_impact_that_slides_throughout_has_the_impulse_of_the_bound() {
    let [speed, spin] = halved_each(1e-5, |d0| strike(d0, 2.0, 0.0));
    row("granular-impact-speed").check(speed);
    row("granular-impact-spin").check(spin);
    let [speed, spin] = halved_each(1e-5, |d0| strike(d0, 0.0, 200.0));
    row("granular-spinning-impact-speed").check(speed);
    row("granular-spinning-impact-spin").check(spin);
}
