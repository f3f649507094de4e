//! What one call of the mechanics costs: rates and Jacobian of a body near a plane, rates of two bodies that meet.
//!
//! The floor is that of the moments of a box: twelve triangles, of which each takes 518 products and sums for the loads
//! of three laws, 1,008 with their derivatives (counted in the instructions of both, `bench/2026-11-21.md`).

use crate::arithmetic::Arithmetic;
use crate::clock::seconds_in_batches;
use crate::near::{SHAPES, near_table};
use crate::row::{BenchmarkRow, Floor, Size};
use gyration::dynamics::{Workspace, jacobian, rates};
use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Scene;
use nalgebra::DMatrix;
use std::hint::black_box;
use std::path::Path;

/// Products and sums of the loads of a box under three laws, and of their derivatives.
pub const LOADS_OF_BOX: f64 = 12.0 * 518.0;
pub const SLOPES_OF_BOX: f64 = 12.0 * 1008.0;
/// Exponents of repulsion, and of damping and friction.
const EXPONENTS: (f64, f64) = (6.0, 3.0);
/// Shapes that meet their equals, and the distance of centres at which they nearly touch \[m\].
const PAIRS: [(&str, &str, f64); 4] = [
    ("balls", "{ sphere = { radius = 0.5 } }", 1.02),
    ("boxes", "{ box = { size = [1, 1.2, 0.8] } }", 1.14),
    ("ellipsoids", "{ ellipsoid = { semi_axes = [0.5, 0.6, 0.4] } }", 1.02),
    ("cylinders", "{ cylinder = { radius = 0.5, height = 1 } }", 1.12),
];

/// Measures them.
pub fn rows(arithmetic: &Arithmetic, size: Size, add: &mut impl FnMut(BenchmarkRow)) {
    let batch = if size == Size::Whole { 0.2 } else { 0.02 };
    for (name, shape, height) in SHAPES {
        let (model, state) = near_table(shape, height, EXPONENTS);
        let floor = (name == "box").then(|| Floor {
            seconds: arithmetic.seconds(LOADS_OF_BOX),
            of: "the moments of twelve triangles".to_owned(),
        });
        add(call(
            format!("rates/{name}"),
            format!("rates on a plane: {name}"),
            seconds_of_rates(&model, &state, batch),
            floor,
        ));
    }
    let (_, shape, height) = SHAPES[0];
    let (model, state) = near_table(shape, height, EXPONENTS);
    let floor = Floor { seconds: arithmetic.seconds(SLOPES_OF_BOX), of: "the same with derivatives".to_owned() };
    let seconds = seconds_of_jacobian(&model, &state, batch);
    add(call("jacobian/box".to_owned(), "Jacobian on a plane: box".to_owned(), seconds, Some(floor)));
    for (name, shape, distance) in PAIRS {
        let (model, state) = pair(shape, distance);
        add(call(
            format!("pair/{name}"),
            format!("rates of two that meet: {name}"),
            seconds_of_rates(&model, &state, batch),
            None,
        ));
    }
}

fn call(key: String, work: String, seconds: f64, floor: Option<Floor>) -> BenchmarkRow {
    BenchmarkRow { key, work, seconds, floor, remark: String::new() }
}

fn seconds_of_rates(model: &Model, state: &State, batch: f64) -> f64 {
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    seconds_in_batches(batch, || {
        let bodies = black_box(&state.bodies);
        let done = rates(model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers);
        debug_assert!(done.is_ok(), "the bodies do not touch");
        black_box(&slopes);
    })
}

fn seconds_of_jacobian(model: &Model, state: &State, batch: f64) -> f64 {
    let mut workspace = Workspace::default();
    let mut blocks = [DMatrix::zeros(13, 13)];
    seconds_in_batches(batch, || {
        let bodies = black_box(&state.bodies);
        let done = jacobian(model, &mut workspace, 0.0, bodies.into(), &mut blocks[..]);
        debug_assert!(done.is_ok(), "the body does not touch");
        black_box(&blocks);
    })
}

/// Two bodies of one shape, turned against each other, about to turn back.
fn pair(shape: &str, distance: f64) -> (Model, State) {
    let law = "alpha = 100, nu = 6, d0 = 0.01";
    let body = |name: &str, x: f64, axis: [i8; 3], speed: i8| {
        format!(
            r#"
[[body]]
name = "{name}"
group = "bodies"
shape = {shape}
density = 1
position = [{x:?}, 0, 0]
orientation = {{ axis_angle = {{ axis = {axis:?}, angle = 0.1 }} }}
velocity = [{speed}, 0.1, 0]
angular_velocity = [1, -2, 0.5]
"#
        )
    };
    let text = format!(
        r#"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = 1, sample = 1 }}
[[contact]]
between = ["bodies", "bodies"]
repulsion = {{ {law} }}
damping = {{ beta = 100, nu = 6, d0 = 0.01 }}
friction = {{ beta = 100, nu = 6, d0 = 0.01 }}
{}{}"#,
        body("first", -0.5 * distance, [1, 2, 3], 1),
        body("second", 0.5 * distance, [-3, 1, 2], -1),
    );
    let scene = Scene::parse("pair.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    (scene.built().model.clone(), scene.built().state.clone())
}
