//! Rows 15 and 13 with stiff bodies: restitution and apex tend to those of the rigid body.
//!
//! With x = βv_in/α and y = βv_out/α at the same gap a rigid body has x − ln(1+x) = −y − ln(1−y). A stiff sphere gives
//! under the field by something that goes as 1/stiffness; its vibrations are left behind by less than any power of
//! that.

use gyration_validation::{Case, Experiment, Run};

const HEIGHT: f64 = 0.15;

/// A sphere of c₁ + c₂ = `stiffness` [Pa] that comes from a gap of 0.1 m at 1 m/s.
fn thrown(stiffness: f64, beta: f64, gravity: f64, velocity: f64) -> Experiment {
    let (c1, c2) = (0.75 * stiffness, 0.25 * stiffness);
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, {gravity:e}] }}
        time = {{ end = 0.25, sample = 1e-4 }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        measure = "reference_area"
        repulsion = {{ alpha = 1e-6, nu = 6 }}
        damping = {{ beta = {beta:e}, nu = 6 }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = 0.05 }} }}
        mass = 0.5
        affine = {{ material = {{ mooney_rivlin = {{ c1 = {c1:e}, c2 = {c2:e} }} }} }}
        position = [0, 0, {HEIGHT}]
        velocity = [0, 0, {velocity:e}]
        "#
    ))
}

/// The upward speed when the centre is back at its height [m/s], from the sample before.
fn speed_back(run: &Run) -> f64 {
    let (places, speeds) = (run.column("ball.z"), run.column("ball.vz"));
    let back = (1..places.len()).find(|k| places[*k] > HEIGHT && places[k - 1] <= HEIGHT);
    let k = back.unwrap_or_else(|| panic!("it does not come back within {:?} s", run.times.last()));
    // The acceleration there is 0.01 m/s² and hardly changes within a tenth of a millisecond.
    let late = (HEIGHT - places[k - 1]) / speeds[k - 1];
    speeds[k - 1] + late / 1e-4 * (speeds[k] - speeds[k - 1])
}

#[test]
fn stiff_sphere_tends_to_the_restitution_of_the_rigid_one() {
    // The list, x = 0.1.
    const RIGID: f64 = 0.93747557995;
    let case =
        Case {
            row: Some(15), name: "stiff sphere, x = 0.1", source: "x − ln(1+x) = −y − ln(1−y), and 1/stiffness"
        };
    let restitution = |stiffness| speed_back(&thrown(stiffness, 1e-7, 0.0, -1.0).run());
    let [soft, stiff] = [1.6e6, 3.2e6].map(restitution);
    let [off, less] = [soft, stiff].map(|found| found / RIGID - 1.0);
    println!("relative deviation of the restitution at 1.6 and 3.2 MPa: {off:.3e}, {less:.3e}");
    case.check("restitution at c₁ + c₂ = 3.2 MPa", RIGID, stiff, 1e-3);
    case.check("deviation, stiffness over twice it", 2.0, off / less, 5e-2);
    // What is left is of second order in a deviation of 3e-4.
    case.check("restitution in the limit, from two stiffnesses", RIGID, 2.0 * stiff - soft, 5e-6);
}

#[test]
fn stiff_ball_comes_back_to_its_apex() {
    let case =
        Case { row: Some(13), name: "stiff ball dropped from 0.15 m, no loss", source: "conservation of energy" };
    let apex = |stiffness| {
        let mut experiment = thrown(stiffness, 0.0, -9.81, 0.0);
        experiment.plan.end = 0.6;
        let time = experiment.run().times_of("apex")[0];
        experiment.motion_at(time).placement.position.z
    };
    let heights = [5e3, 2e4, 8e4].map(apex);
    println!("what the apex lacks at 5, 20 and 80 kPa: {:?}", heights.map(|height| 1.0 - height / HEIGHT));
    // The vibrations left behind fall as e^−ωτ, τ the time of contact, and ω doubles from one to the next.
    assert!(heights[2] > heights[1] && HEIGHT - heights[2] < (HEIGHT - heights[1]) / 100.0);
    case.check("height of the centre at the apex, c₁ + c₂ = 80 kPa [m]", HEIGHT, heights[2], 1e-6);
}
