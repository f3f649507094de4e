//! A soft box that tumbles, bounces and dissipates, against the equations written once more (`independent`).
//!
//! Incompressible rubber with viscosity in the measure `deformed_area`; compressible foam with Newtonian friction in
//! `deformed_area_potential`. Both strike the plane with corners and edges, under repulsion, damping and friction.

use crate::independent::{Numbers, Power, SoftBox, Stuff, gauss, integrate};
use crate::soft;
use gyration::tensor::Mat3;
use gyration_validation::{Case, Run, largest};

/// A problem in both languages.
struct Problem {
    name: &'static str,
    measure: &'static str,
    affine: &'static str,
    stuff: Stuff,
}

const PROBLEMS: [Problem; 2] = [
    Problem {
        name: "soft box, incompressible and viscous",
        measure: "deformed_area",
        affine: "material = { mooney_rivlin = { c1 = 1500, c2 = 500 } }, viscosity = 10",
        stuff: Stuff::Rubber { c1: 1500.0, c2: 500.0, viscosity: 10.0 },
    },
    Problem {
        name: "soft box, compressible with internal friction",
        measure: "deformed_area_potential",
        affine: "material = { neo_hookean_log = { mu = 4000, lambda = 6000 } }, internal_friction = { shear = 5, bulk = 8 }",
        stuff: Stuff::Foam { mu: 4000.0, lambda: 6000.0, shear: 5.0, bulk: 8.0 },
    },
];

const END: f64 = 0.3;

/// The samples of a run as the numbers of the independent equations.
fn numbers(run: &Run) -> Vec<Numbers> {
    let columns = |prefix: &str| ["x", "y", "z"].map(|axis| run.column(&format!("body.{prefix}{axis}")));
    let (places, speeds) = (columns(""), columns("v"));
    let (gradients, rates) = (run.matrices("placement_gradient"), run.matrices("gradient_rate"));
    let sample = |k: usize| {
        std::array::from_fn(|number| match number {
            0..3 => places[number][k],
            3..12 => gradients[k][((number - 3) / 3, number % 3)],
            12..15 => speeds[number - 12][k],
            _ => rates[k][((number - 15) / 3, number % 3)],
        })
    };
    (0..run.times.len()).map(sample).collect()
}

fn again(problem: &Problem, points: u32) -> SoftBox {
    SoftBox {
        size: [0.10, 0.08, 0.06],
        density: 1000.0,
        gravity: 9.81,
        stuff: problem.stuff,
        reference_gap: 0.01,
        repulsion: Power(600.0, 5),
        damping: Power(60.0, 4),
        friction: Power(100.0, 3),
        potential: problem.measure == "deformed_area_potential",
        rule: gauss(points),
    }
}

/// The largest differences of places, of P and of velocities.
fn apart(ours: &[Numbers], theirs: &[Numbers]) -> [f64; 3] {
    [0..3, 3..12, 12..15].map(|range| {
        let pairs = ours.iter().zip(theirs);
        largest(pairs.flat_map(|(a, b)| range.clone().map(|k| a[k] - b[k]).collect::<Vec<_>>()))
    })
}

fn compare(problem: &Problem) {
    let case =
        Case { row: None, name: problem.name, source: "the equations written once more, extrapolated midpoint rule" };
    let run = soft::thrown_box(problem.measure, problem.affine).until(END).sampled(END / 12.0).run();
    let ours = numbers(&run);
    let theirs = integrate(&again(problem, 14), &ours[0], &run.times, 1e-12);
    let deformed =
        largest(run.matrices("placement_gradient").iter().map(|p| (p.transpose() * p - Mat3::identity()).amax()));
    println!("{}: largest entry of C − I at the samples {deformed:.2}", problem.name);
    assert!(deformed > 0.1, "it is to deform: {deformed}");
    // 20 points a direction and 1e-13 a step move the reference by 1e-13 m and 1e-11.
    let [place, gradient, velocity] = apart(&ours, &theirs);
    case.check("largest error of a coordinate of the centre over 0.3 s [m]", 0.0, place, 1e-7);
    case.check("largest error of an entry of P over 0.3 s", 0.0, gradient, 1e-6);
    case.check("largest error of a velocity of the centre over 0.3 s [m/s]", 0.0, velocity, 1e-5);
    let case = case.by("energies and works integrated apart");
    case.check("residual of the ledger over the energy in play", 0.0, run.relative_residual(), 1e-8);
}

#[test]
fn incompressible_box_agrees_with_an_independent_integration() {
    compare(&PROBLEMS[0]);
}

#[test]
fn compressible_box_agrees_with_an_independent_integration() {
    compare(&PROBLEMS[1]);
}
