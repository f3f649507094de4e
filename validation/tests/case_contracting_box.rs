//! A viscous box that drives itself anisotropically on a floor, under three laws, against the equations written once
//! more (`independent`).

use crate::independent::contracting::{ContractingBox, MORE};
use crate::independent::{Power, SoftBox, Stuff, gauss, integrate};
use gyration::tensor::Mat3;
use gyration_validation::{Case, Experiment, Run, largest};

const END: f64 = 0.4;
const DRAG: f64 = 60.0;
const FREQUENCY: f64 = 5.0;
const AMPLITUDE: [[f64; 3]; 3] = [[-300.0, 100.0, 200.0], [0.0, -250.0, 50.0], [300.0, 0.0, 900.0]];

fn scene() -> Experiment {
    let [a, b, c] = AMPLITUDE;
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = {END}, sample = 0.02 }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[support]]
        name = "floor"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "floor"
        repulsion = {{ alpha = 600, nu = 5, d0 = 0.01 }}
        damping = {{ beta = 60, nu = 4, d0 = 0.01 }}
        friction = {{ beta = 100, nu = 3, d0 = 0.01 }}
        [[body]]
        name = "body"
        shape = {{ box = {{ size = [0.10, 0.08, 0.06] }} }}
        density = 1000
        contractile = {{ material = {{ mooney_rivlin = {{ c1 = 1500, c2 = 500 }} }}, viscosity = 10, contraction_viscosity = {DRAG},
            drive = {{ sine = {{ amplitude = [{a:?}, {b:?}, {c:?}], frequency = {FREQUENCY} }} }} }}
        position = [0, 0, 0.045]
        orientation = {{ axis_angle = {{ axis = [1, 2, 0.5], angle = 0.1 }} }}
        velocity = [0.1, -0.05, 0]
        "#
    ))
}

/// The samples of a run as the numbers of the independent equations.
fn numbers(run: &Run) -> Vec<[f64; MORE]> {
    let columns = |prefix: &str| ["x", "y", "z"].map(|axis| run.column(&format!("body.{prefix}{axis}")));
    let (places, speeds) = (columns(""), columns("v"));
    let matrices = ["placement_gradient", "gradient_rate", "contraction"].map(|name| run.matrices(name));
    let entry = |matrices: &[Mat3], k: usize, number: usize| matrices[k][(number / 3, number % 3)];
    let sample = |k: usize| {
        std::array::from_fn(|number| match number {
            0..3 => places[number][k],
            3..12 => entry(&matrices[0], k, number - 3),
            12..15 => speeds[number - 12][k],
            15..24 => entry(&matrices[1], k, number - 15),
            24..33 => entry(&matrices[2], k, number - 24),
            _ => run.times[k],
        })
    };
    (0..run.times.len()).map(sample).collect()
}

#[test]
fn driven_box_on_a_floor_agrees_with_an_independent_integration() {
    let case = Case {
        row: None,
        name: "driven viscous box on a floor, three laws",
        source: "the equations written once more, extrapolated midpoint rule",
    };
    let soft = SoftBox {
        size: [0.10, 0.08, 0.06],
        density: 1000.0,
        gravity: 9.81,
        stuff: Stuff::Rubber { c1: 1500.0, c2: 500.0, viscosity: 10.0 },
        reference_gap: 0.01,
        repulsion: Power(600.0, 5),
        damping: Power(60.0, 4),
        friction: Power(100.0, 3),
        potential: false,
        rule: gauss(14),
    };
    let again = ContractingBox { soft, drag: DRAG, amplitude: AMPLITUDE, frequency: FREQUENCY };
    let run = scene().run();
    let ours = numbers(&run);
    let theirs = integrate(&again, &ours[0], &run.times, 1e-12);
    let apart = |range: std::ops::Range<usize>| {
        largest(ours.iter().zip(&theirs).flat_map(|(a, b)| range.clone().map(|k| a[k] - b[k]).collect::<Vec<_>>()))
    };
    let moved = largest(run.matrices("contraction").iter().map(|g| (g - Mat3::identity()).amax()));
    println!("largest entry of G − I at the samples {moved:.2}");
    assert!(moved > 0.1, "it is to contract: {moved}");
    case.check("largest error of a coordinate of the centre over 0.4 s [m]", 0.0, apart(0..3), 1e-7);
    case.check("largest error of an entry of P over 0.4 s", 0.0, apart(3..12), 1e-6);
    case.check("largest error of an entry of G over 0.4 s", 0.0, apart(24..33), 1e-6);
    case.by("energies and works integrated apart").check(
        "residual of the ledger over the energy in play",
        0.0,
        run.relative_residual(),
        1e-8,
    );
}
