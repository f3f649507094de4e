//! A unit body near a table under three laws, and a soft particle in a flow: what one call of the mechanics costs.

use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Scene;
use std::path::Path;

/// A unit body of density one near a table: rest gap 0.03, ν = 6; damping and friction ν = 3 (`exponents` replaces
/// them).
///
/// # Panics
/// If the scene is not valid: a mistake in this file.
pub fn near_table(shape: &str, height: f64, exponents: (f64, f64)) -> (Model, State) {
    let (repulsion, viscous) = exponents;
    let text = format!(
        r#"
title = "{shape} near a table"
world = {{ gravity = [0, 0, -1] }}
time = {{ end = 10.0, sample = 0.1 }}
[[support]]
name = "table"
plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
[[contact]]
support = "table"
repulsion = {{ alpha = 7.29e-10, nu = {repulsion:?} }}
damping = {{ beta = 5e-5, nu = {viscous:?} }}
friction = {{ beta = 5e-5, nu = {viscous:?} }}
[[body]]
name = "body"
shape = {shape}
density = 1
position = [0, 0, {height}]
orientation = {{ axis_angle = {{ axis = [1, 0.7, 0.3], angle = 0.5 }} }}
velocity = [0.3, 0, 0]
angular_velocity = [1, 0.5, 2]
"#
    );
    match Scene::parse("bench.toml", &text, Path::new(""), &[]) {
        Ok(scene) => (scene.built().model.clone(), scene.built().state.clone()),
        Err(errors) => panic!("{errors}"),
    }
}

/// A soft particle of a triaxial shape in simple shear, with or without inertia: G = ηγ̇/μ = 0.2.
///
/// # Panics
/// If the scene is not valid: a mistake in this file.
pub fn particle_in_shear(inertia: bool) -> (Model, State) {
    let text = format!(
        r#"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = 10.0, sample = 0.1 }}
fluid = {{ viscosity = 1, velocity_gradient = [[0, 1, 0], [0, 0, 0], [0, 0, 0]] }}
[[body]]
name = "particle"
shape = {{ ellipsoid = {{ semi_axes = [1, 0.8, 0.6] }} }}
density = 1
affine = {{ material = {{ neo_hookean = {{ shear = 5 }} }} }}
orientation = {{ axis_angle = {{ axis = [1, 0.7, 0.3], angle = 0.5 }} }}
inclusion = {{ inertia = {inertia} }}
"#
    );
    match Scene::parse("bench.toml", &text, Path::new(""), &[]) {
        Ok(scene) => (scene.built().model.clone(), scene.built().state.clone()),
        Err(errors) => panic!("{errors}"),
    }
}

/// The shapes measured: name, TOML, height of the centre at which the gap is about 0.03.
pub const SHAPES: [(&str, &str, f64); 7] = [
    ("box", "{ box = { size = [1, 1, 1] } }", 0.86),
    ("sphere", "{ sphere = { radius = 0.5 } }", 0.53),
    ("cylinder", "{ cylinder = { radius = 0.5, height = 1 } }", 0.71),
    ("cone", "{ cone = { radius = 0.5, height = 1 } }", 0.5),
    ("ellipsoid", "{ ellipsoid = { semi_axes = [0.5, 0.3, 0.4] } }", 0.47),
    ("torus", "{ torus = { major_radius = 0.4, minor_radius = 0.1 } }", 0.32),
    ("capsule", "{ capsule = { radius = 0.3, height = 0.6 } }", 0.59),
];
