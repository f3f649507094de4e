//! What one call of the mechanics costs: rates and Jacobian of a body near a plane, rates of two bodies that meet and
//! of a soft cube alone.
//!
//! The floor is that of the moments of a box: six parallelograms, of which each takes 496 products and sums for the
//! loads of three laws, 1,060 with their derivatives (counted in the formulas, `bench/2026-12-01-faces.md`).

use crate::arithmetic::Arithmetic;
use crate::clock::seconds_in_batches;
use crate::near::{SHAPES, near_table};
use crate::row::{BenchmarkRow, Floor, Size};
use crate::soft::{free_cube, material};
use gyration::dynamics::{Workspace, jacobian, rates};
use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Scene;
use nalgebra::DMatrix;
use std::hint::black_box;
use std::path::Path;

/// Products and sums of the loads of a box under three laws, and of their derivatives.
pub const LOADS_OF_BOX: f64 = 6.0 * 496.0;
pub const SLOPES_OF_BOX: f64 = 6.0 * 1060.0;
/// Exponents of repulsion, and of damping and friction.
const EXPONENTS: (f64, f64) = (6.0, 3.0);
/// Shapes that meet their equals, and the distance of centres at which they nearly touch \[m\].
const PAIRS: [(&str, &str, f64); 5] = [
    ("balls", "{ sphere = { radius = 0.5 } }", 1.02),
    ("boxes", "{ box = { size = [1, 1.2, 0.8] } }", 1.14),
    ("ellipsoids", "{ ellipsoid = { semi_axes = [0.5, 0.6, 0.4] } }", 1.02),
    ("cylinders", "{ cylinder = { radius = 0.5, height = 1 } }", 1.12),
    ("capsules", "{ capsule = { radius = 0.5, height = 1 } }", 1.02),
];

/// A call of the mechanics that is measured.
pub struct Kernel {
    /// A short name.
    pub key: String,
    /// What it is.
    pub work: String,
    call: Box<dyn FnMut()>,
}

impl Kernel {
    /// Calls it once.
    pub fn call(&mut self) {
        (self.call)();
    }
}

/// All that are measured.
pub fn kernels() -> Vec<Kernel> {
    let kernel = |key: String, work: String, call| Kernel { key, work, call };
    let near = SHAPES.map(|(name, shape, height)| {
        let near = near_table(shape, height, EXPONENTS);
        kernel(format!("rates/{name}"), format!("rates on a plane: {name}"), call_of_rates(near))
    });
    let (_, shape, height) = SHAPES[0];
    let jacobian = call_of_jacobian(near_table(shape, height, EXPONENTS));
    let jacobian = kernel("jacobian/box".to_owned(), "Jacobian on a plane: box".to_owned(), jacobian);
    let pairs = PAIRS.map(|(name, shape, distance)| {
        let pair = pair(shape, distance);
        kernel(format!("pair/{name}"), format!("rates of two that meet: {name}"), call_of_rates(pair))
    });
    let soft = call_of_rates(free_cube(material("neo_hookean_log")));
    let soft = kernel("rates/free-cube".to_owned(), "rates of a soft cube alone".to_owned(), soft);
    near.into_iter().chain([jacobian]).chain(pairs).chain([soft]).collect()
}

/// Measures them.
pub fn rows(arithmetic: &Arithmetic, size: Size, add: &mut impl FnMut(BenchmarkRow)) {
    let batch = if size == Size::Whole { 0.2 } else { 0.02 };
    for mut kernel in kernels() {
        let seconds = seconds_in_batches(batch, || kernel.call());
        let floor = match kernel.key.as_str() {
            "rates/box" => Some((LOADS_OF_BOX, "the moments of six faces")),
            "jacobian/box" => Some((SLOPES_OF_BOX, "the same with derivatives")),
            _ => None,
        };
        let floor = floor.map(|(operations, of)| Floor { seconds: arithmetic.seconds(operations), of: of.to_owned() });
        add(BenchmarkRow { key: kernel.key, work: kernel.work, seconds, floor, remark: String::new() });
    }
}

fn call_of_rates((model, state): (Model, State)) -> Box<dyn FnMut()> {
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    Box::new(move || {
        let bodies = black_box(&state.bodies);
        let done = rates(&model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers);
        debug_assert!(done.is_ok(), "the bodies do not touch");
        black_box(&slopes);
    })
}

fn call_of_jacobian((model, state): (Model, State)) -> Box<dyn FnMut()> {
    let mut workspace = Workspace::default();
    let mut blocks = [DMatrix::zeros(13, 13)];
    Box::new(move || {
        let bodies = black_box(&state.bodies);
        let done = jacobian(&model, &mut workspace, 0.0, bodies.into(), &mut blocks[..]);
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
