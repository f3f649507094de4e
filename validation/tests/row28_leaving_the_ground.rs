//! Row 28: a block of height h whose stretch is 1 + ε sin ωt leaves the ground if its centre has to fall faster than
//! gravity makes it: εω²h/2 > g.
//!
//! The stretch is prescribed, from its least value on; material, contact and drag are stiff beside ω. The threshold is
//! that of the contact force at the top of the stroke, 1 − εω²h/(2g) of the weight below it.

use gyration_validation::{Case, Experiment, Run};
use std::f64::consts::TAU;

const FREQUENCY: f64 = 10.0;
const GRAVITY: f64 = 9.81;
const SOURCE: &str = "ε = 2g/(ω²h)";

fn pumping(height: f64, swing: f64) -> Run {
    let weight = 1000.0 * GRAVITY * height;
    let low = 0.5 * height * (1.0 - swing) + 4e-5 * height / 0.1;
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = 0.13, sample = 5e-4 }}
        [[support]]
        name = "ground"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "ground"
        repulsion = {{ alpha = {weight}, nu = 4, d0 = {:e} }}
        damping = {{ beta = {}, nu = 4, d0 = {:e} }}
        [[body]]
        name = "body"
        shape = {{ box = {{ size = [{height}, {height}, {height}] }} }}
        density = 1000
        position = [0, 0, {low:e}]
        contractile = {{ material = {{ neo_hookean = {{ shear = 3e6 }} }}, viscosity = 3000, prescribed = {{ sum = [
            {{ constant = {{ value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }} }},
            {{ sine = {{ amplitude = [[0, 0, 0], [0, 0, 0], [0, 0, {swing:e}]], frequency = {FREQUENCY}, phase = "-90 deg" }} }},
        ] }} }}
        "#,
        4e-5 * height / 0.1,
        2.0 * weight,
        4e-5 * height / 0.1,
    ))
    .run()
}

/// The least part of the weight that the ground carries in the first stroke, its start apart.
fn least_load(run: &Run, height: f64) -> f64 {
    let weight = 1000.0 * GRAVITY * height.powi(3);
    let loads = run.times.iter().zip(run.column("body.fz"));
    loads.filter(|(time, _)| **time > 0.02).map(|(_, force)| force / weight).fold(f64::INFINITY, f64::min)
}

#[test]
fn block_leaves_the_ground_where_its_centre_would_fall_faster_than_gravity() {
    for (name, height) in [("pumping block, h = 0.1 m", 0.1), ("pumping block, h = 0.04 m", 0.04)] {
        let case = Case { row: Some(28), name, source: SOURCE };
        let threshold = 2.0 * GRAVITY / ((TAU * FREQUENCY).powi(2) * height);
        let below = pumping(height, 0.7 * threshold);
        case.by("1 − εω²h/(2g)").check(
            "least load at 0.7 of the threshold, of the weight",
            0.3,
            least_load(&below, height),
            0.05,
        );
        // It has left where the ground carries less than a hundredth of the weight.
        let (mut stays, mut leaves) = (0.7 * threshold, 1.4 * threshold);
        for _ in 0..10 {
            let middle = 0.5 * (stays + leaves);
            if least_load(&pumping(height, middle), height) > 0.01 { stays = middle } else { leaves = middle }
        }
        case.check("swing at which it leaves the ground", threshold, 0.5 * (stays + leaves), 0.03);
    }
}
