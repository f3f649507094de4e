//! Lattices whose bodies are kept to a line, a plane or an axis.

use gyration::tensor::Mat3;
use gyration_scene::Scene;
use gyration_sim::modes::bands::{LatticeWaves, StrainedCell};
use gyration_validation::{Case, Experiment};
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn scene(text: &str) -> Scene {
    Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn waves(text: &str) -> LatticeWaves {
    let scene = scene(text);
    let cell = scene.built().cell.as_ref().unwrap();
    LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap()
}

fn frequencies(waves: &LatticeWaves, kappa: f64) -> Vec<f64> {
    waves.branches([kappa, 0.0, 0.0]).unwrap().iter().map(|branch| branch.omega).collect()
}

/// A chain of masses of half a kilogram 0.1 m apart, on springs of 40 N/m, kept to its line.
fn masses(rest: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        lattice = {{ cell = [[0.1, 0, 0]], {rest} }}
        [[body]]
        name = "a"
        shape = {{ points = [{{ mass = 0.5, at = [0, 0, 0] }}] }}
        keep = {{ line = [1, 0, 0] }}
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        stiffness = 40
        rest_length = 0.1
        "#
    )
}

#[test]
fn masses_kept_to_their_line_have_one_branch_and_run_by_it() {
    let case = Case { row: None, name: "chain of masses kept to its line", source: "ω² = 4 (k/m) sin²(q/2)" };
    let chain = waves(&masses("repeat = [1, 1, 1]"));
    for (quantity, kappa) in [("ω at κ = 0.1 [rad/s]", 0.1), ("ω at κ = 0.5 [rad/s]", 0.5)] {
        let found = frequencies(&chain, kappa);
        assert_eq!(found.len(), 1);
        case.check(quantity, 2.0 * (40.0_f64 / 0.5).sqrt() * (PI * kappa).sin(), found[0], 1e-13);
    }
    // Springs along a line are linear: the wave returns whatever its amplitude.
    let text = masses("repeat = [8, 1, 1], wave = { kappa = [0.125, 0, 0], amplitude = 5e-3 }");
    let omega = 2.0 * 80.0_f64.sqrt() * (PI / 8.0).sin();
    let experiment = Experiment::of_scene(&text).until(3.0 * TAU / omega);
    let run = experiment.run();
    let place = |state: &gyration::state::State, n: usize| state.motion(&experiment.model, n).placement.position.x;
    let off = (0..8).map(|n| (place(&run.end, n) - place(&experiment.start, n)).abs()).fold(0.0, f64::max);
    case.check("places after three periods, over the amplitude", 0.0, off / 5e-3, 1e-8);
}

/// A chain of affine boxes on springs off the middle of their faces, all in the plane z = 0.
fn boxes(keep: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        lattice = {{ cell = [[0.5, 0, 0]] }}
        [[body]]
        name = "a"
        density = 50
        shape = {{ box = {{ size = [0.4, 0.3, 0.25] }} }}
        affine = {{ material = {{ mooney_rivlin = {{ c1 = "30 Pa", c2 = "10 Pa" }} }} }}
        {keep}
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        points = [[0.2, 0.05, 0], [-0.2, 0.1, 0]]
        stiffness = 6
        rest_length = 0.1118033988749895
        "#
    )
}

#[test]
fn granules_kept_to_a_plane_have_the_waves_that_lie_in_it() {
    let case = Case {
        row: None,
        name: "chain of incompressible granules kept to a plane of symmetry",
        source: "six of the eleven branches of the free chain",
    };
    let (free, kept) = (waves(&boxes("")), waves(&boxes("keep = { plane = [0, 0, 1] }")));
    let mut most: f64 = 0.0;
    for kappa in [0.05, 0.2, 0.37, 0.5] {
        let [all, found] = [&free, &kept].map(|waves| frequencies(waves, kappa));
        assert_eq!([all.len(), found.len()], [11, 6]);
        let largest = all.iter().copied().fold(0.0, f64::max);
        let mut left = all;
        for omega in found {
            let nearest = (0..left.len()).min_by(|i, j| (left[*i] - omega).abs().total_cmp(&(left[*j] - omega).abs()));
            let taken = left.remove(nearest.unwrap());
            most = most.max((taken - omega).abs() / largest);
        }
    }
    case.check("difference over the largest frequency", 0.0, most, 1e-10);
}

/// Pendulums that turn about the x axis, joined by taut springs, at a spacing.
fn pendulums(spacing: f64) -> String {
    format!(
        r#"
        time = {{ end = 1, sample = 1 }}
        lattice = {{ cell = [[{spacing:?}, 0, 0]] }}
        [[body]]
        name = "a"
        mass = 0.3
        shape = {{ box = {{ size = [0.02, 0.02, 0.2] }} }}
        position = [0.03, 0, -0.1]
        pin = [0, 0, 0.1]
        keep = {{ axis = [1, 0, 0] }}
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        points = [[0, 0, -0.1], [0, 0, -0.1]]
        stiffness = 25
        rest_length = 0.06
        "#
    )
}

#[test]
fn pendulums_kept_to_an_axis_go_with_their_pins_as_the_cell_is_stretched() {
    let case = Case {
        row: None,
        name: "chain of pendulums about one axis, taut springs between their ends",
        source: "I ω² = m g r + 4 T r₁²/a sin²(q/2), T = k(a − l₀)",
    };
    let inertia = 0.3 * ((0.02_f64.powi(2) + 0.2_f64.powi(2)) / 12.0 + 0.1_f64.powi(2));
    let expected = |spacing: f64, kappa: f64| {
        let taut = 25.0 * (spacing - 0.06) / spacing * 0.2_f64.powi(2) * 4.0 * (PI * kappa).sin().powi(2);
        ((0.3 * 9.81 * 0.1 + taut) / inertia).sqrt()
    };
    let chain = scene(&pendulums(0.1));
    let cell = chain.built().cell.as_ref().unwrap();
    let rows = [
        (0.0, 0.0, "ω at κ = 0 [rad/s]"),
        (0.0, 0.21, "ω at κ = 0.21 [rad/s]"),
        (0.0, 0.5, "ω at κ = 0.5 [rad/s]"),
        (0.3, 0.21, "ω at κ = 0.21, F̄_xx = 1.3 [rad/s]"),
        (0.3, 0.5, "ω at κ = 0.5, F̄_xx = 1.3 [rad/s]"),
    ];
    for (stretch, kappa, quantity) in rows {
        let gradient = Mat3::from_diagonal(&gyration::tensor::Vec3::new(1.0 + stretch, 1.0, 1.0));
        let (_, waves) = StrainedCell::new(&cell.model, &cell.state).at(&gradient).unwrap();
        let found = frequencies(&waves, kappa);
        assert_eq!(found.len(), 1);
        case.check(quantity, expected(0.1 * (1.0 + stretch), kappa), found[0], 1e-11);
    }
    let across = Mat3::new(1.0, 0.0, 0.1, 0.0, 1.0, 0.0, 0.1, 0.0, 1.0);
    let line = scene(&masses("repeat = [1, 1, 1]"));
    let cell = line.built().cell.as_ref().unwrap();
    let refused = StrainedCell::new(&cell.model, &cell.state).at(&across).unwrap_err().to_string();
    assert!(refused.contains("\"a\" is kept to a line"), "{refused}");
}
