//! Relations of the matrices that only their cells show: nothing opposes a translation of everything, nor a turn.

use super::LatticeWaves;
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use gyration_scene::Scene;
use nalgebra::{Complex, DVector};
use std::path::Path;

/// A cell of a soft body, a rigid one and a point, with taut springs that hold them off their centres.
const TAUT: &str = r#"
    world = { gravity = [0, 0, 0] }
    time = { end = 1, sample = 1 }
    lattice = { cell = [[1.0, 0.1, 0.0], [-0.2, 0.9, 0.1]], relax = ["granules"] }
    [[body]]
    name = "a"
    shape = { box = { size = [0.3, 0.2, 0.25] } }
    mass_properties = { mass = 1.3, euler_tensor = [[0.012, 0.001, 0], [0.001, 0.009, 0], [0, 0, 0.008]] }
    affine = { material = { st_venant_kirchhoff = { lambda = 300, mu = 400 } } }
    [[body]]
    name = "b"
    shape = { box = { size = [0.3, 0.3, 0.2] } }
    mass = 0.8
    position = [0.5, 0.4, 0]
    [[body]]
    name = "c"
    shape = { points = [{ mass = 0.4, at = [0, 0, 0] }] }
    position = [0.5, -0.1, 0.1]
"#;

fn taut() -> LatticeWaves {
    let mut text = TAUT.to_owned();
    for (between, cell, points, stiffness) in [
        (["a", "b"], [0, 0, 0], [[0.15, 0.05, 0.1], [-0.15, 0.0, 0.1]], 40.0),
        (["a", "b"], [0, 0, 0], [[0.15, 0.1, -0.1], [-0.15, -0.1, -0.1]], 30.0),
        (["b", "a"], [1, 0, 0], [[0.15, 0.0, 0.05], [-0.15, 0.1, 0.0]], 50.0),
        (["b", "a"], [0, 1, 0], [[0.0, 0.15, 0.0], [0.05, -0.1, 0.05]], 35.0),
        (["b", "a"], [1, 1, 0], [[0.1, 0.15, -0.05], [-0.15, -0.1, 0.0]], 45.0),
        (["a", "c"], [0, 0, 0], [[0.15, -0.1, 0.0], [0.0, 0.0, 0.0]], 25.0),
        (["c", "a"], [1, 0, 0], [[0.0, 0.0, 0.0], [-0.1, -0.1, 0.1]], 20.0),
        (["c", "b"], [0, -1, 0], [[0.0, 0.0, 0.0], [0.0, 0.1, 0.1]], 20.0),
    ] {
        let points: [[f64; 3]; 2] = points;
        text += &format!(
            "[[spring]]\nbetween = {between:?}\ncell = {cell:?}\npoints = {points:?}\nstiffness = {stiffness}\n\
             rest_length = 0.2\n"
        );
    }
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"));
    let cell = scene.built().cell.as_ref().unwrap_or_else(|| panic!("the scene has a lattice"));
    LatticeWaves::new(&cell.model, &cell.state, true).unwrap_or_else(|error| panic!("{error}"))
}

/// z of a motion of each body: δp₀ at its place, and δP P⁻¹.
fn along(waves: &LatticeWaves, translation: impl Fn(&Vec3) -> Vec3, spread: &Mat3) -> DVector<Complex<f64>> {
    let moved = waves.coordinates.moved(&waves.frozen, |body| {
        let placement = waves.rest.bodies[body].placement;
        (translation(&placement.position), spread * placement.gradient)
    });
    moved.map(|value| Complex::new(value, 0.0))
}

#[test]
fn a_translation_of_everything_meets_no_force() {
    let waves = taut();
    assert!(waves.rest.unrest.is_none() && waves.rest.force.iter().all(|force| force.norm() > 0.1));
    let stiffness = waves.system.wave(&[0.0; 3]).stiffness;
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        let all = along(&waves, |_| axis, &Mat3::zeros());
        let force = (&stiffness * &all).norm() / (stiffness.norm() * all.norm());
        assert!(force < 1e-14, "{force:e}");
    }
}

#[test]
fn a_turn_of_everything_meets_no_force_though_springs_are_taut() {
    let waves = taut();
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        let turn = cross_matrix(&axis);
        // Σ_R K_R on u = W(p + R), A = W: ∂K/∂k along b has iR·b.
        let stiffness = waves.system.wave(&[0.0; 3]).stiffness;
        let own = along(&waves, |place| turn * place, &turn);
        let mut force = &stiffness * &own;
        for direction in [Vec3::x(), Vec3::y(), Vec3::z()] {
            let slope = waves.system.slope(&[0.0; 3], &direction).stiffness;
            force += slope * along(&waves, |_| turn * direction, &Mat3::zeros()) * Complex::new(0.0, -1.0);
        }
        let left = force.norm() / (stiffness.norm() * own.norm());
        assert!(left < 1e-12, "{left:e}");
    }
}
