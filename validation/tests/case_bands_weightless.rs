//! Lattices and systems in a viscous fluid whose bodies, or some of them, have no inertia: states of first order.

use gyration_scene::Scene;
use gyration_sim::complete;
use gyration_sim::modes::bands::LatticeWaves;
use gyration_sim::modes::{system_modes, system_rest};
use gyration_validation::Case;
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const RADIUS: f64 = 0.02;
const VISCOSITY: f64 = 0.7;
const STIFFNESS: f64 = 30.0;
/// 6πηR [N s/m].
const DRAG: f64 = 6.0 * PI * VISCOSITY * RADIUS;

/// A ball in the fluid, without inertia unless that is said.
fn ball(name: &str, x: f64, inertia: bool) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nposition = [{x:?}, 0, 0]\nshape = {{ sphere = {{ radius = {RADIUS:?} }} }}\n\
         density = 800\ninclusion = {{ inertia = {inertia}, history = false }}\n"
    )
}

/// A spring with its natural length.
fn spring(ends: [&str; 2], cell: i32, damping: f64) -> String {
    let cell = if cell == 0 { String::new() } else { format!("cell = [{cell}, 0, 0]\n") };
    format!(
        "[[spring]]\nbetween = [\"{}\", \"{}\"]\n{cell}stiffness = {STIFFNESS:?}\nrest_length = 0.1\n\
         damping = {damping:?}\n",
        ends[0], ends[1]
    )
}

fn scene(lines: &str) -> Scene {
    let head = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n";
    let fluid = format!("[fluid]\nviscosity = {VISCOSITY:?}\n");
    Scene::parse("scene.toml", &format!("{head}{lines}{fluid}"), Path::new(""), &[]).unwrap()
}

fn waves(cell: f64, lines: &str) -> LatticeWaves {
    let scene = scene(&format!("lattice = {{ cell = [[{cell:?}, 0, 0]] }}\n{lines}"));
    let cell = scene.built().cell.as_ref().unwrap();
    LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap()
}

#[test]
fn a_chain_without_inertia_creeps() {
    let case = Case {
        row: None,
        name: "chain of balls without inertia in a fluid, dashpots between them",
        source: "decay 4k s²/(6πηR + 4c s²)",
    };
    let damping = 0.4;
    let chain = waves(0.1, &(ball("a", 0.0, false) + &spring(["a", "a"], 1, damping)));
    for (quantity, kappa) in [("decay at κ = 0.1 [1/s]", 0.1), ("decay at κ = 0.5 [1/s]", 0.5)] {
        let branches = chain.branches([kappa, 0.0, 0.0]).unwrap();
        assert_eq!(branches.len(), 6);
        assert!(branches.iter().all(|branch| branch.omega == 0.0 && branch.velocity.is_none()));
        let square = (0.5 * TAU * kappa).sin().powi(2);
        let expected = 4.0 * STIFFNESS * square / (DRAG + 4.0 * damping * square);
        // Across, and about their centres, nothing brings the balls back.
        let [still @ .., creeping] = &branches[..] else { panic!("no branches") };
        assert!(still.iter().all(|branch| branch.decay.abs() < 1e-9 * expected), "{still:?}");
        case.check(quantity, expected, creeping.decay, 1e-12);
        assert!((creeping.participation[0] - 1.0).abs() < 1e-12);
    }
}

#[test]
fn waves_run_over_bodies_of_which_every_second_has_inertia() {
    let case = Case {
        row: None,
        name: "chain of masses with balls without inertia between them",
        source: "(mλ² + ζλ + 2k)(ζλ + 2k) = 4k² cos²(q/2)",
    };
    let two = ball("a", 0.0, true) + &ball("b", 0.1, false);
    let chain = waves(0.2, &(two + &spring(["a", "b"], 0, 0.0) + &spring(["b", "a"], 1, 0.0)));
    let mass = 800.0 * 4.0 / 3.0 * PI * RADIUS.powi(3);
    let along = |kappa: f64| {
        let branches = chain.branches([kappa, 0.0, 0.0]).unwrap();
        assert_eq!(branches.len(), 12);
        branches.into_iter().filter(|branch| branch.omega > 0.0).collect::<Vec<_>>()
    };
    let excess = |kappa: f64, root: Complex<f64>| {
        let heavy = root * root * mass + root * DRAG + 2.0 * STIFFNESS;
        let light = root * DRAG + 2.0 * STIFFNESS;
        let across = 4.0 * STIFFNESS * STIFFNESS * (0.5 * TAU * kappa).cos().powi(2);
        (heavy * light - across).norm() / (4.0 * STIFFNESS * STIFFNESS)
    };
    let running = along(0.3);
    let [wave] = &running[..] else { panic!("{running:?}") };
    case.check("error of its polynomial at κ = 0.3", 0.0, excess(0.3, Complex::new(-wave.decay, -wave.omega)), 1e-12);
    // Central differences of fourth order.
    let step = 1e-3;
    let omega = |kappa: f64| along(kappa)[0].omega;
    let difference = (8.0 * (omega(0.3 + step) - omega(0.3 - step)) - omega(0.3 + 2.0 * step)
        + omega(0.3 - 2.0 * step))
        / (12.0 * step);
    let expected = difference * 0.2 / TAU;
    case.by("fourth-order differences of ω").check("group velocity [m/s]", expected, wave.velocity.unwrap().x, 1e-8);
    let found = chain.evanescent(&[0.0; 3], 0, 4.0).unwrap();
    let root = Complex::new(0.0, -4.0);
    let errors = found.iter().map(|[re, im]| {
        let heavy = root * root * mass + root * DRAG + 2.0 * STIFFNESS;
        let light = root * DRAG + 2.0 * STIFFNESS;
        let cosine = (Complex::new(0.5 * TAU * re, 0.5 * TAU * im)).cos();
        (heavy * light - cosine * cosine * 4.0 * STIFFNESS * STIFFNESS).norm() / (4.0 * STIFFNESS * STIFFNESS)
    });
    assert_eq!(found.len(), 2, "{found:?}");
    case.check("error of complex κ at ω = 4", 0.0, errors.fold(0.0, f64::max), 1e-10);
}

#[test]
fn waves_of_shapes_whose_resistance_is_computed_are_damped_by_it() {
    // Symptom: the cell of which bands are had no resistance, and what is not finite kept the search for roots going.
    let body = |inertia: bool| {
        format!(
            "[[body]]\nname = \"a\"\nshape = {{ box = {{ size = [0.03, 0.03, 0.03] }} }}\ndensity = 800\n\
             inclusion = {{ inertia = {inertia}, triangles = 108 }}\n"
        )
    };
    let at = |inertia: bool, repeat: usize| {
        let lattice = format!("lattice = {{ cell = [[0.1, 0, 0]], repeat = [{repeat}, 1, 1] }}\n");
        let scene = complete(scene(&format!("{lattice}{}{}", body(inertia), spring(["a", "a"], 1, 0.0)))).unwrap();
        let cell = scene.built().cell.as_ref().unwrap();
        let waves = LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap();
        waves.branches([0.5, 0.0, 0.0]).unwrap().iter().map(|branch| branch.decay).fold(0.0, f64::max)
    };
    let case = Case { row: None, name: "chain of cubes without inertia in a fluid", source: "4k over its decay" };
    let drag = 4.0 * STIFFNESS / at(false, 1);
    // A cube drags as the sphere of 1.06 to 1.09 times the radius of one of its volume, to 108 triangles.
    let sphere = 6.0 * PI * VISCOSITY * 0.03 * (0.75 / PI).cbrt();
    case.by("drag of the sphere of its volume").check("drag over that", 1.07, drag / sphere, 0.05);
    case.check("drag in a lattice of three cells [N s/m]", drag, 4.0 * STIFFNESS / at(false, 3), 1e-14);
}

#[test]
fn a_system_without_inertia_relaxes() {
    let case = Case { row: None, name: "two balls without inertia on a spring in a fluid", source: "decay 2k/6πηR" };
    for (quantity, second) in [("decay, both without", false), ("polynomial, one with inertia", true)] {
        let scene = scene(&(ball("a", 0.0, false) + &ball("b", 0.1, second) + &spring(["a", "b"], 0, 0.0)));
        let (model, state) = (&scene.built().model, &scene.built().state);
        let rests = system_rest(model, state, &[0, 1]).unwrap();
        let modes = system_modes(model, state, &[0, 1], &rests).unwrap();
        let roots: Vec<Complex<f64>> = modes.iter().flat_map(|mode| mode.eigenvalues.clone()).collect();
        // A state a coordinate, and one more for each that has inertia.
        assert_eq!(roots.len(), if second { 18 } else { 12 }, "{roots:?}");
        let fastest = |modes: &[gyration_sim::modes::Mode]| {
            let stretches = |mode: &&gyration_sim::modes::Mode| {
                let [one, other] = [0, 1].map(|body| mode.shapes[body].translation.x);
                (one - other).abs() > 0.1
            };
            modes.iter().filter(stretches).map(|mode| mode.eigenvalues[0]).collect::<Vec<_>>()
        };
        let found = fastest(&modes);
        if second {
            let mass = 800.0 * 4.0 / 3.0 * PI * RADIUS.powi(3);
            let root = *found.iter().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap();
            let both = (root * DRAG + STIFFNESS) * (root * root * mass + root * DRAG + STIFFNESS);
            case.check(quantity, 0.0, (both - STIFFNESS * STIFFNESS).norm() / (STIFFNESS * STIFFNESS), 1e-10);
        } else {
            let [root] = found[..] else { panic!("{found:?}") };
            case.check(quantity, 2.0 * STIFFNESS / DRAG, -root.re, 1e-12);
        }
    }
}
