//! Lattices beyond small motions: Toda's soliton as a run, and the stretch at which Morse's bonds give way.
//!
//!   Toda, V = b/α (e^{−αx} + αx − 1)   u_n = ln(cosh(θ − κ)/cosh θ)/α,   θ = κn − βt,   β = √(bα/m) sinh κ
//!   Morse, V = D(1 − e^{−αx})²         V″ = 0 at x = ln 2/α, where the force is Dα/2

use gyration::kinematics::Quaternion;
use gyration::state::{RigidStart, Start, State};
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::modes::bands::StrainPath;
use gyration_sim::survey::StrainSurvey;
use gyration_validation::{Case, Experiment, largest};
use std::path::Path;

/// A chain of masses of half a kilogram, 1 m apart, with bonds V(l).
fn chain(lattice: &str, law: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        lattice = {{ cell = [[1, 0, 0]], {lattice} }}
        [[body]]
        name = "a"
        shape = {{ points = [{{ mass = 0.5, at = [0, 0, 0] }}] }}
        [[bond]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        law = "{law}"
        "#
    )
}

#[test]
fn todas_soliton_keeps_its_shape_and_speed() {
    let case = Case { row: None, name: "soliton of Toda's chain, κ = ½", source: "Toda 1967, sinh κ/κ" };
    let (kappa, alpha, sound, cells, first) = (0.5_f64, 2.0, 4_f64.sqrt(), 72, 26.0);
    let beta = sound * kappa.sinh();
    let text = chain(&format!("repeat = [{cells}, 1, 1], periodic = false"), "1/2*(exp(-2*(l - 1)) + 2*(l - 1) - 1)");
    // At the ends, 26 cells away, bonds are shortened by e^{−26} of the middle.
    let theta = |n: usize, time: f64| kappa * (n as f64 - first) - beta * time;
    let place = |theta: f64| ((theta - kappa).cosh() / theta.cosh()).ln() / alpha;
    let speed = |theta: f64| beta / alpha * (theta.tanh() - (theta - kappa).tanh());
    let experiment = Experiment::of_scene(&text);
    let start = |n: usize| {
        Start::Rigid(RigidStart {
            position: Vec3::x() * place(theta(n, 0.0)),
            orientation: Quaternion::IDENTITY,
            velocity: Vec3::x() * speed(theta(n, 0.0)),
            angular_velocity: Vec3::zeros(),
        })
    };
    let start = State::start(&experiment.model, &(0..cells).map(start).collect::<Vec<_>>());
    let end = 20.0 * kappa / beta;
    let run = Experiment { start, ..experiment.clone() }.until(end).run();
    let found = |n: usize| run.end.motion(&experiment.model, n).placement.position.x;
    let apart = largest((0..cells).map(|n| found(n) - place(theta(n, end)))) / (kappa / alpha);
    case.by("exact solution").check("largest departure after 20 cells, of its height", 0.0, apart, 1e-8);
    // tanh θ = (cosh κ − e^{αu})/sinh κ where the displacement is the steepest.
    let middle = (0..cells).min_by(|a, b| found(*a).abs().total_cmp(&found(*b).abs())).unwrap();
    let there = ((kappa.cosh() - (alpha * found(middle)).exp()) / kappa.sinh()).atanh();
    let gone = middle as f64 - first - there / kappa;
    case.check("its speed over that of sound", kappa.sinh() / kappa, gone / (end * sound), 1e-9);
}

#[test]
fn morses_bonds_give_way_where_their_force_is_greatest() {
    let case = Case { row: None, name: "stretched chain of Morse's bonds, D 3, α 5", source: "V″ = 0" };
    let text = chain("relax = []", "3*(1 - exp(-5*(l - 1)))^2");
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let along = |text: &str, steps: usize| {
        let found = StrainSurvey::of(&scene, &StrainPath::parse(text).unwrap(), steps, None);
        found.unwrap_or_else(|error| panic!("{error}"))
    };
    // The chain at its natural length has no force to hold it across.
    let first = along("xx=0.01..0.2", 6).instability.unwrap();
    case.check("stretch at the first instability", 2_f64.ln() / 5.0, first.gradient[0][0] - 1.0, 1e-9);
    let force = along(&format!("xx={:?}", first.gradient[0][0] - 1.0), 1).path[0].force[0][0];
    case.by("Dα/2").check("force there [N]", 7.5, force, 1e-12);
}
