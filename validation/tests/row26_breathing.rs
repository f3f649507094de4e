//! Row 26: a sphere or a cube under an isotropic drive Q(t) I breathes, F staying I: with P = g I,
//!
//!   (j/V) g g̈ + μ_γ ġ/g = Q(t),   whatever c₁, c₂ and μ
//!
//! The scalar equation is integrated in the test by extrapolation, apart from the program.

use crate::independent::{Equations, integrate};
use crate::soft::{BALL, CUBE};
use gyration_validation::{Case, Experiment, largest};

const DRAG: f64 = 40.0;
const AMPLITUDE: f64 = 900.0;
const FREQUENCY: f64 = 4.0;
const PHASE: f64 = 0.7;

/// (g, ġ, t), with j/V [kg/m].
struct Breath(f64);

impl Equations<3> for Breath {
    fn rates(&self, y: &[f64; 3]) -> Option<[f64; 3]> {
        let [g, rate, time] = *y;
        let drive = AMPLITUDE * (std::f64::consts::TAU * FREQUENCY * time + PHASE).sin();
        (g > 0.0).then(|| [rate, (drive - DRAG * rate / g) / (self.0 * g), 1.0])
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

fn breathing(shape: &str, material: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 0.05 }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[body]]
        name = "body"
        density = 1000
        {shape}
        contractile = {{ {material}, contraction_viscosity = {DRAG}, drive = {{ sine = {{
            amplitude = [[{AMPLITUDE}, 0, 0], [0, {AMPLITUDE}, 0], [0, 0, {AMPLITUDE}]], frequency = {FREQUENCY}, phase = {PHASE} }} }} }}
        "#
    ))
}

#[test]
fn breathing_agrees_with_its_scalar_equation() {
    // j/V is ρR²/5 of a sphere, ρa²/12 of a cube.
    let cases = [
        (
            "breathing sphere, Mooney–Rivlin, viscous",
            BALL,
            2.0,
            "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20",
        ),
        ("breathing sphere, soft neo-Hookean", BALL, 2.0, "material = { neo_hookean = { shear = 10 } }"),
        (
            "breathing cube, Ogden, viscous",
            CUBE,
            10.0 / 12.0,
            "material = { ogden = { mu = [900, -300], alpha = [3, -2] } }, viscosity = 5",
        ),
        (
            "breathing cube, Mooney–Rivlin without viscosity",
            CUBE,
            10.0 / 12.0,
            "material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }",
        ),
    ];
    for (name, shape, inertia, material) in cases {
        let case = Case { row: Some(26), name, source: "(j/V) g g̈ + μ_γ ġ/g = Q(t), extrapolated midpoint rule" };
        let run = breathing(shape, material).run();
        let known = integrate(&Breath(inertia), &[1.0, 0.0, 0.0], &run.times, 1e-13);
        let of = |name: &str, row: usize| run.matrices(name).iter().map(|m| m[(row, row)]).collect::<Vec<f64>>();
        let apart = |found: &[f64]| largest(found.iter().zip(&known).map(|(found, known)| found - known[0]));
        let swing = known.iter().map(|y| (y[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(swing > 0.1, "it is to breathe: {swing}");
        let worst = (0..3).map(|row| apart(&of("placement_gradient", row)).max(apart(&of("contraction", row))));
        case.check("largest error of P and G over four periods", 0.0, largest(worst), 1e-7);
    }
}
