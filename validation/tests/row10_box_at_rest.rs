//! Row 10: a box on its face, all faces radiating.
//!
//!   α{A[d^−ν + (d+h)^−ν] + p[d^(1−ν) − (d+h)^(1−ν)]/(ν−1)} = mg
//!
//! with height h, base A, perimeter p; the vertical frequency is the derivative of the left side over the mass.

use gyration::dynamics::Workspace;
use gyration::dynamics::jacobian;
use gyration_validation::{Answer, Experiment};
use nalgebra::DMatrix;

const ROW: Option<u32> = Some(10);
const CASE: &str = "box 0.1×0.1×0.2 m of 2 kg at rest, α = 1e-6, ν = 6";
const SOURCE: &str = "α{A[d^−ν+(d+h)^−ν] + p[d^(1−ν)−(d+h)^(1−ν)]/(ν−1)} = mg";
const REST_GAP: f64 = 0.0292715643344;

/// The box at a gap, with damping that brings it to rest as fast as can be, cβ·A/d^ν ≈ 2mω.
fn scene(gap: f64, end: f64) -> String {
    format!(
        r#"
        [time]
        end = {end:e}
        sample = {end:e}
        [solver]
        rtol = 1e-11
        atol = 1e-13
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 1e-6, nu = 6 }}
        damping = {{ beta = 1e-5, nu = 6 }}
        [[body]]
        name = "box"
        shape = {{ box = {{ size = [0.1, 0.1, 0.2] }} }}
        mass = 2.0
        position = [0, 0, {:.17e}]
        "#,
        gap + 0.1
    )
}

#[test]
fn dropped_box_comes_to_rest_at_the_height_of_all_its_faces() {
    let end = Experiment::of_scene(&scene(0.03, 3.0)).run();
    Answer {
        row: ROW,
        case: CASE,
        quantity: "gap at rest [m]",
        reference: REST_GAP,
        measured: end.column("box.gap")[1],
        // The tolerance of the list.
        tolerance: 1e-9,
        source: SOURCE,
    }
    .check();
}

#[test]
fn box_at_its_rest_gap_is_carried() {
    let force = Experiment::of_scene(&scene(REST_GAP, 1.0)).contact_force();
    Answer {
        row: ROW,
        case: CASE,
        quantity: "contact force at the rest gap [N]",
        reference: 2.0 * 9.81,
        measured: force.z,
        // The gap is known to 5e-14 m, and the force goes as its power −6.
        tolerance: 2e-11,
        source: SOURCE,
    }
    .check();
}

#[test]
fn box_bobs_at_the_frequency_of_the_stiffness_of_all_its_faces() {
    let experiment = Experiment::of_scene(&scene(REST_GAP, 1.0));
    let mut blocks = [DMatrix::zeros(13, 13)];
    let bodies = &experiment.start.bodies;
    jacobian(&experiment.model, &mut Workspace::default(), 0.0, bodies.into(), &mut blocks[..]).unwrap();
    // ∂z̈/∂z = −ω²: rows and columns are p₀, quaternion, ṗ₀, Ω.
    let measured = -blocks[0][(9, 2)];
    let (alpha, nu, area, perimeter, height, mass) = (1e-6, 6, 0.01, 0.4, 0.2, 2.0);
    let power = |gap: f64, exponent: i32| gap.powi(-exponent);
    let (near, far) = (REST_GAP, REST_GAP + height);
    let faces = area * f64::from(nu) * (power(near, nu + 1) + power(far, nu + 1));
    let sides = perimeter * (power(near, nu) - power(far, nu));
    let reference = alpha * (faces + sides) / mass;
    // The list gives eight digits.
    assert!((reference - 1947.2413).abs() < 1e-4, "{reference}");
    Answer {
        row: ROW,
        case: CASE,
        quantity: "square of the vertical frequency [1/s²]",
        reference,
        measured,
        tolerance: 1e-11,
        source: "derivative of the force in d, over m",
    }
    .check();
}
