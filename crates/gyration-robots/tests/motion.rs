//! Imported robots move as their equations do: a double pendulum, an oscillator on a hinge and one on a slider.

use crate::imported;
use gyration::state::State;
use gyration_scene::Scene;
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Unwatched};
use std::path::Path;

const GRAVITY: f64 = 9.81;
const TIGHT: &str = "solver = { rtol = 1e-12, atol = 1e-14 }\n";

/// The scene of a text, and its state after a time \[s\].
fn run(text: &str, end: f64) -> (Scene, State) {
    let import = imported(text);
    // Keys of the top level stand before all sections.
    let overrides = [format!("time.end={end}"), format!("time.sample={end}")];
    let scene = Scene::parse("scene.toml", &(TIGHT.to_owned() + &import.scene), Path::new(""), &overrides);
    let scene = scene.unwrap_or_else(|errors| panic!("{errors}\n{}", import.scene));
    let built = scene.built();
    let mut simulation = Simulation::new(&built.model, &built.state, RunPlan::from(built)).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    assert!(!matches!(outcome, Outcome::Stopped(_)), "{}", outcome.in_words());
    let state = simulation.state();
    (scene, state)
}

/// θ̈₁, θ̈₂ of two rods, angles from below: Lagrange's equations.
fn accelerations([one, other, first, second]: [f64; 4]) -> [f64; 2] {
    let (masses, arms, length, inertias) = ([1.0, 0.7], [0.25, 0.2], 0.5, [0.022, 0.011]);
    let (sin, cos) = (one - other).sin_cos();
    let coupling = masses[1] * length * arms[1];
    let matrix = [
        [inertias[0] + masses[0] * arms[0] * arms[0] + masses[1] * length * length, coupling * cos],
        [coupling * cos, inertias[1] + masses[1] * arms[1] * arms[1]],
    ];
    let right = [
        -coupling * sin * second * second - GRAVITY * (masses[0] * arms[0] + masses[1] * length) * one.sin(),
        coupling * sin * first * first - masses[1] * GRAVITY * arms[1] * other.sin(),
    ];
    let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
    [
        (right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant,
        (right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant,
    ]
}

/// The angles at a time \[s\], by so many steps of the classical method of order four.
fn angles(end: f64, steps: u32) -> [f64; 2] {
    let rates = |y: [f64; 4]| {
        let [first, second] = accelerations(y);
        [y[2], y[3], first, second]
    };
    let step = end / f64::from(steps);
    let mut y = [2.0, 1.2, 0.0, 0.0];
    for _ in 0..steps {
        let moved = |rate: [f64; 4], by: f64| std::array::from_fn(|k| y[k] + by * rate[k]);
        let a = rates(y);
        let b = rates(moved(a, 0.5 * step));
        let c = rates(moved(b, 0.5 * step));
        let d = rates(moved(c, step));
        y = std::array::from_fn(|k| y[k] + step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    [y[0], y[1]]
}

#[test]
fn a_double_pendulum_of_either_format_moves_as_lagranges_equations_do() {
    let end = 1.5;
    let reference = angles(end, 40_000);
    // The classical method has converged.
    let coarser = angles(end, 20_000);
    assert!((0..2).all(|k| (reference[k] - coarser[k]).abs() < 1e-11), "{reference:?} {coarser:?}");
    for text in [include_str!("files/double-pendulum.urdf"), include_str!("files/double-pendulum.xml")] {
        let (scene, state) = run(text, end);
        let built = scene.built();
        let at = |body: usize, state: &State| state.motion(&built.model, body).placement;
        // Ends of the rods: the first hangs at the origin, the second at the end of the first.
        let [one, other] = reference;
        let first = [0.5 * one.sin(), -0.5 * one.cos()];
        let expected =
            [[0.25 * one.sin(), -0.25 * one.cos()], [first[0] + 0.2 * other.sin(), first[1] - 0.2 * other.cos()]];
        for (body, [x, z]) in expected.into_iter().enumerate() {
            let found = at(body, &state).position;
            assert!((found.x - x).hypot(found.z - z) < 1e-9 && found.y.abs() < 1e-12, "{body}: {found} {x} {z}");
            // Both start where the file has them.
            let turn = at(body, &state).gradient * at(body, &built.state).gradient.transpose();
            let turned = [2.0, 1.2][body] - reference[body];
            assert!((turn[(0, 2)] - turned.sin()).abs() < 1e-9, "{body}: {turn} {turned}");
        }
    }
}

/// x from rest at −x₀ beside ẍ = −k x/m − d ẋ/m, less −x₀.
fn damped(stiffness: f64, damping: f64, mass: f64, from: f64, time: f64) -> f64 {
    let decay = 0.5 * damping / mass;
    let frequency = (stiffness / mass - decay * decay).sqrt();
    let (sin, cos) = (frequency * time).sin_cos();
    from - from * (-decay * time).exp() * (cos + decay / frequency * sin)
}

#[test]
fn springs_dashpots_and_servos_of_an_mjcf_pull_as_written() {
    let body = "<inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"1 1 0.5\"/>";
    let text = |joint: &str, actuator: &str| {
        format!(
            "<mujoco><compiler angle=\"radian\"/><option gravity=\"0 0 0\"/><worldbody><body name=\"a\" euler=\"0.3 0.4 0.5\">\
             <joint name=\"j\" {joint}/>{body}</body></worldbody><actuator>{actuator}</actuator></mujoco>"
        )
    };
    let time = 1.5;
    let place = |text: &str| {
        let (scene, state) = run(text, time);
        let built = scene.built();
        let motion = |state: &State| state.motion(&built.model, 0).placement;
        (motion(&built.state), motion(&state))
    };
    // A hinge: the spring rests at 0.9, the coordinate starts at 0.2.
    let hinge = text("axis=\"0 0 1\" stiffness=\"3\" damping=\"0.4\" springref=\"0.9\" ref=\"0.2\"", "");
    let (before, after) = place(&hinge);
    let angle = damped(3.0, 0.4, 0.5, 0.7, time);
    let turn = after.gradient * before.gradient.transpose();
    // About whatever axis: 2 sin θ a is the axial vector of twice the skew part.
    let sine =
        0.5 * (turn[(2, 1)] - turn[(1, 2)]).hypot(turn[(0, 2)] - turn[(2, 0)]).hypot(turn[(1, 0)] - turn[(0, 1)]);
    let cosine = 0.5 * (turn.trace() - 1.0);
    assert!((sine.atan2(cosine) - angle).abs() < 1e-10, "{turn} {angle}");
    assert!(angle > 0.7, "{angle}");
    // A slider: a servo with gear 2 pulls r q to u = 0, q starts at −0.3.
    let slider =
        text("type=\"slide\" axis=\"1 0 0\" ref=\"-0.3\"", "<position joint=\"j\" kp=\"4\" kv=\"0.1\" gear=\"2\"/>");
    let (before, after) = place(&slider);
    let way = damped(16.0, 0.4, 2.0, 0.3, time);
    let moved = before.gradient.transpose() * (after.position - before.position);
    assert!((moved.x - way).abs() < 1e-11 && moved.yz().norm() < 1e-13, "{moved} {way}");
}
