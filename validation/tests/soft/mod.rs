//! What the tests of bodies that deform share: scenes of one body, and matrices in and out of them.

#![allow(dead_code, reason = "each test uses a part of this")]

use gyration::tensor::Mat3;
use gyration_validation::{Experiment, largest};

/// c₁ and c₂ [Pa] of the list of known answers.
pub const RUBBER: &str = "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }";
/// A sphere of 0.1 m: with a density of 1000 kg/m³ that of the list.
pub const BALL: &str = "shape = { sphere = { radius = 0.1 } }";
/// A cube of 0.1 m.
pub const CUBE: &str = "shape = { box = { size = [0.1, 0.1, 0.1] } }";

/// A body of 1000 kg/m³ alone, without gravity, and the tolerances (rtol, atol).
pub fn alone(body: &str, (rtol, atol): (f64, f64)) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = {rtol:e}, atol = {atol:e} }}
        [[body]]
        name = "body"
        density = 1000
        {body}
        "#
    ))
}

/// The key of a matrix in a scene.
pub fn entry(key: &str, matrix: &Mat3) -> String {
    let row = |i: usize| format!("[{:e}, {:e}, {:e}]", matrix[(i, 0)], matrix[(i, 1)], matrix[(i, 2)]);
    format!("{key} = [{}, {}, {}]\n", row(0), row(1), row(2))
}

/// The body of a scene with a shape, what it is made of, and a start.
pub fn body(shape: &str, affine: &str, gradient: &Mat3, rate: &Mat3) -> String {
    format!("{shape}\naffine = {{ {affine} }}\n{}{}", entry("gradient", gradient), entry("gradient_rate", rate))
}

/// The largest entry; NaN if there is one.
pub fn size(matrix: &Mat3) -> f64 {
    largest(matrix.iter().copied())
}

/// The largest entry of a difference of matrices over the samples, and of the matrices expected.
pub fn spread(found: &[Mat3], expected: impl IntoIterator<Item = Mat3>) -> (f64, f64) {
    let expected: Vec<Mat3> = expected.into_iter().collect();
    let difference = largest(found.iter().zip(&expected).map(|(found, expected)| size(&(found - expected))));
    (difference, largest(expected.iter().map(size)))
}

/// A soft box thrown on a table: it tumbles, and strikes with corners, edges and faces within 0.3 s.
pub fn thrown_box(measure: &str, affine: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = 0.3, sample = 0.025 }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        measure = "{measure}"
        repulsion = {{ alpha = 600, nu = 5, d0 = 0.01 }}
        damping = {{ beta = 60, nu = 4, d0 = 0.01 }}
        friction = {{ beta = 100, nu = 3, d0 = 0.01 }}
        [[body]]
        name = "body"
        shape = {{ box = {{ size = [0.10, 0.08, 0.06] }} }}
        density = 1000
        affine = {{ {affine} }}
        position = [0, 0, 0.12]
        orientation = {{ axis_angle = {{ axis = [1, 2, 0.5], angle = 0.7 }} }}
        velocity = [0.4, -0.2, 0]
        angular_velocity = [5, -3, 8]
        "#
    ))
}

/// Differences of eighth order of values at a uniform spacing: the derivative at all but the four first and last.
pub fn derivatives<T>(values: &[T], spacing: f64) -> Vec<T>
where
    T: Copy + std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let at = |w: &[T]| {
        let term = |k: usize| (w[4 + k] - w[4 - k]) * (WEIGHTS[k - 1] / spacing);
        ((term(4) + term(3)) + term(2)) + term(1)
    };
    values.windows(9).map(at).collect()
}
