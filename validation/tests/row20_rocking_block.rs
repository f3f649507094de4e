//! Row 20: a slender block, 2b wide and 2h high, let go at rest on an edge, tilted by θ₀.
//!
//! With R² = b² + h², tan α = b/h, p² = 3g/(4R) a block that turns about its edge obeys θ̈ = −p²(α − θ) for small
//! angles: it comes upright for the first time after (1/p) arcosh(1/(1 − θ₀/α)). Source: G. W. Housner, Bull. Seism.
//! Soc. Am. 53 (1963) 403. The edge stands on the field at a gap of b/1000.

use gyration_validation::{Answer, Experiment};

const GRAVITY: f64 = 9.81;
/// b [m].
const HALF_WIDTH: f64 = 0.05;
/// Length of the edges along y [m], and mass [kg].
const DEPTH: f64 = 0.1;
const MASS: f64 = 2.0;

struct Case {
    name: &'static str,
    slenderness: f64,
    /// θ₀/α.
    share: f64,
}

const CASES: [Case; 4] = [
    Case { name: "rocking block, h/b = 4, θ₀ = 0.3 α", slenderness: 4.0, share: 0.3 },
    Case { name: "rocking block, h/b = 4, θ₀ = 0.9 α", slenderness: 4.0, share: 0.9 },
    Case { name: "rocking block, h/b = 8, θ₀ = 0.3 α", slenderness: 8.0, share: 0.3 },
    Case { name: "rocking block, h/b = 8, θ₀ = 0.6 α", slenderness: 8.0, share: 0.6 },
];

/// The block at a tilt [rad], its edge at the gap d that carries it:
///
///   α_r d₀^ν D d^(1−ν) (1/sin θ + 1/cos θ)/(ν−1) = m g,   D the length of the edge.
fn block(half_height: f64, tilt: f64) -> Experiment {
    let gap = 1e-3 * HALF_WIDTH;
    let alpha = MASS * GRAVITY * 5.0 / (DEPTH * gap * (1.0 / tilt.sin() + 1.0 / tilt.cos()));
    let height = HALF_WIDTH * tilt.sin() + half_height * tilt.cos() + gap;
    // Friction holds the edge; damping is as strong as it can be without holding the block.
    Experiment::of_scene(&format!(
        r#"
        [time]
        end = 1.0
        sample = 1.0
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = {alpha:e}, nu = 6, d0 = {gap:e} }}
        damping = {{ beta = {:e}, nu = 6, d0 = {gap:e} }}
        friction = {{ beta = {:e}, nu = 6, d0 = {gap:e} }}
        [[body]]
        name = "block"
        shape = {{ box = {{ size = [{}, {DEPTH}, {}] }} }}
        mass = {MASS}
        position = [0, 0, {height:e}]
        orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = {tilt:e} }} }}
        "#,
        10.0 * alpha,
        300.0 * alpha,
        2.0 * HALF_WIDTH,
        2.0 * half_height,
    ))
}

#[test]
fn block_released_on_its_edge_comes_upright_as_an_inverted_pendulum() {
    for case in CASES {
        let half_height = case.slenderness * HALF_WIDTH;
        let critical = (1.0 / case.slenderness).atan();
        let p = (0.75 * GRAVITY / HALF_WIDTH.hypot(half_height)).sqrt();
        let reference = (1.0 / (1.0 - case.share)).acosh() / p;
        let experiment = block(half_height, case.share * critical);
        let upright = experiment.time_when(reference, |motion| motion.placement.gradient[(0, 2)]);
        Answer {
            row: Some(20),
            case: case.name,
            quantity: "time from release to upright [s]",
            reference,
            measured: upright,
            // The list asks for 3 %: sin α is not α, and the edge gives way.
            tolerance: 0.03,
            source: "(1/p) arcosh(1/(1−θ₀/α)), p² = 3g/(4R)",
        }
        .check();
    }
}
