//! What the tests of bodies that deform share: scenes of one body, and matrices in and out of them.
#![allow(dead_code, reason = "each test uses a part of this")]

use gyration::tensor::Mat3;
use gyration_validation::Experiment;

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

/// The largest entry of a difference of matrices over the samples, and of the first matrices.
pub fn spread(found: &[Mat3], expected: impl IntoIterator<Item = Mat3>) -> (f64, f64) {
    let norms = found.iter().zip(expected).map(|(found, expected)| ((found - expected).amax(), expected.amax()));
    norms.fold((0.0, 0.0), |worst: (f64, f64), (difference, size)| (worst.0.max(difference), worst.1.max(size)))
}
