//! Phases of waves through lattices.
//!
//!   two springs in turn, k₁ in the cell   Zak 0 where k₁ > k₂, else π: whole cells hung on fixed points by k₂ then
//!                                         have two modes √((k₁ + k₂)/m) at their ends
//!   honeycomb, k = m = bond 1, in the plane, anchors 0.2, f = 0.3 e_z × v
//!                                         gaps 0.441–0.622, 1.162–1.462, 1.645–1.815; Chern 1, 0, 0, −1

use crate::lattices::{LatticeScene, Link, nearest};
use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey, SystemRestState, TopologySurvey, USUAL_MESH};
use gyration_validation::Case;
use std::f64::consts::PI;
use std::path::Path;

fn topology(scene: &Scene, mesh: usize) -> TopologySurvey {
    TopologySurvey::of(scene, None, mesh, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Two springs in turn, the first within the cell.
fn in_turn([inner, outer]: [f64; 2]) -> Scene {
    let lattice = LatticeScene::new(&[[1.0, 0.0, 0.0]]).point("a", [0.0; 3], 0.5).point("b", [0.5, 0.0, 0.0], 0.5);
    let lattice = lattice.spring(Link { between: ["a", "b"], cell: [0; 3], law: [inner, 0.5, 0.0], ..Link::default() });
    lattice.spring(Link { between: ["b", "a"], law: [outer, 0.5, 0.0], ..Link::default() }).scene()
}

/// No mirror maps the cell of three masses onto itself. Symptom: the phases of 24 overlaps, off by 7e-3.
#[test]
fn phases_of_a_chain_without_a_mirror_are_those_of_any_number_of_overlaps() {
    let case = Case {
        row: None,
        name: "Zak phases of three masses in turn",
        source: "Hermitian problems by NumPy: products of up to 800,000 overlaps, extrapolated in n⁻²",
    };
    let place = [0.0, 0.3, 0.7];
    let mut chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]);
    for ((name, x), mass) in ["a", "b", "c"].into_iter().zip(place).zip([1.0, 1.5, 0.7]) {
        let table =
            format!("shape = {{ points = [{{ mass = {mass:?}, at = [0, 0, 0] }}] }}\nkeep = {{ line = [1, 0, 0] }}");
        chain = chain.body(name, [x, 0.0, 0.0], &table);
    }
    for (between, cell, law) in [
        (["a", "b"], [0; 3], [10.0, 0.3, 0.0]),
        (["b", "c"], [0; 3], [4.0, 0.4, 0.0]),
        (["c", "a"], [1, 0, 0], [6.0, 0.3, 0.0]),
    ] {
        chain = chain.spring(Link { between, cell, law, ..Link::default() });
    }
    let scene = chain.scene();
    let found = [USUAL_MESH, 7].map(|mesh| topology(&scene, mesh).zak[0].clone());
    let exact = [
        ("lowest branch [rad]", -0.626805744900),
        ("middle branch [rad]", 2.374930956431),
        ("highest branch [rad]", -1.748125211531),
    ];
    for (branch, (name, exact)) in exact.into_iter().enumerate() {
        let [usual, few] = found.each_ref().map(|phases| phases[branch].unwrap());
        case.check(name, exact, usual, 1e-9);
        assert!((few - usual).abs() < 1e-9, "{few} of 7 wave vectors");
    }
    // A gap of 1e-4 of the band, about which links are short and elsewhere long.
    let mut chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]);
    for (name, x, held) in [("a", 0.0, "potential = \"0.5*6e-4*x^2\""), ("b", 0.5, "")] {
        let table =
            format!("shape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\nkeep = {{ line = [1, 0, 0] }}\n{held}");
        chain = chain.body(name, [x, 0.0, 0.0], &table);
    }
    for (between, cell, law) in [(["a", "b"], [0; 3], [1.0, 0.5, 0.0]), (["b", "a"], [1, 0, 0], [1.0001, 0.5, 0.0])] {
        chain = chain.spring(Link { between, cell, law, ..Link::default() });
    }
    let found = topology(&chain.scene(), USUAL_MESH);
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    case.check("beside a narrow gap [rad]", 1.891026140188, found.zak[0][0].unwrap(), 1e-8);
}

#[test]
fn springs_in_turn_have_a_phase_and_modes_at_their_ends() {
    let case = Case { row: None, name: "Zak phases of two springs in turn", source: "0 where k₁ > k₂, else π" };
    let listed = [
        ([50.0, 30.0], 0.0, ["k₁ > k₂, acoustic [rad]", "k₁ > k₂, optic [rad]"]),
        ([30.0, 50.0], PI, ["k₁ < k₂, acoustic [rad]", "k₁ < k₂, optic [rad]"]),
    ];
    for (springs, phase, names) in listed {
        let found = topology(&in_turn(springs), USUAL_MESH);
        // Four branches across do not run; the acoustic one touches them at κ = 0.
        for (name, branch) in names.into_iter().zip([4, 5]) {
            case.check(name, phase, found.zak[0][branch].unwrap(), 1e-8);
        }
        assert!(found.chern.is_empty() && found.warnings.is_empty(), "{found:?}");
    }
    let (cells, inner, outer) = (24, 30.0, 50.0);
    let mut chain = LatticeScene::alone();
    let name = |n: usize| format!("m{n}");
    for n in 0..2 * cells {
        let hung = match n {
            0 => format!("spring = [{{ anchor = [-0.5, 0, 0], stiffness = {outer:?}, rest_length = 0.5 }}]"),
            n if n + 1 == 2 * cells => {
                let anchor = cells as f64;
                format!("spring = [{{ anchor = [{anchor:?}, 0, 0], stiffness = {outer:?}, rest_length = 0.5 }}]")
            }
            _ => String::new(),
        };
        let table = format!("shape = {{ points = [{{ mass = 0.5, at = [0, 0, 0] }}] }}\n{hung}");
        chain = chain.body(&name(n), [0.5 * n as f64, 0.0, 0.0], &table);
    }
    for n in 1..2 * cells {
        let (one, other) = (name(n - 1), name(n));
        let law = [if n % 2 == 1 { inner } else { outer }, 0.5, 0.0];
        chain = chain.spring(Link { between: [&one, &other], cell: [0; 3], law, ..Link::default() });
    }
    let scene = chain.scene();
    let (model, state) = (&scene.built().model, &scene.built().state);
    let bodies: Vec<usize> = (0..2 * cells).collect();
    let rest = SystemRestState::of(model, state, &bodies).unwrap_or_else(|error| panic!("{error}"));
    let end = ((inner + outer) / 0.5_f64).sqrt();
    // Within the gap √(2k₁/m) … √(2k₂/m).
    let within = |omega: &f64| *omega > 1.01 * 120_f64.sqrt() && *omega < 0.99 * 200_f64.sqrt();
    let found: Vec<f64> = rest.modes.iter().map(|mode| mode.frequency).filter(within).collect();
    let case = case.by("√((k₁ + k₂)/m)");
    case.check("modes at the ends", 2.0, found.len() as f64, 0.0);
    // They feel each other by (k₁/k₂) to the number of cells.
    case.check("their frequency [rad/s]", end, nearest(&found, end), 1e-5);
}

/// The honeycomb with vertical bonds; f = `turns` e_z × v.
fn honeycomb(lattice: &str, turns: f64) -> Scene {
    let (half, anchored) = (0.5 * 3_f64.sqrt(), 0.2);
    let mut text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n\
         lattice = {{ cell = [[{:?}, 0, 0], [{half:?}, 1.5, 0]]{lattice} }}\n",
        2.0 * half
    );
    let mut matrix = vec![vec![0.0; 12]; 12];
    // The force is minus the matrix times the velocities.
    (matrix[0][1], matrix[1][0]) = (turns, -turns);
    for (name, [x, y]) in [("a", [0.0, 0.0]), ("b", [half, 0.5])] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.2 }} }}\nmass = 1\n\
             position = [{x:?}, {y:?}, 0]\nspring = [{{ anchor = [{x:?}, {y:?}, 0], stiffness = {anchored} }}]\n\
             potential = \"400*((P_xx - 1)^2 + (P_yy - 1)^2 + (P_zz - 1)^2 + P_xy^2 + P_yx^2)\"\n\
             keep = {{ plane = [0, 0, 1] }}\n[body.affine]\ngyroscopic = {{ matrix = {matrix:?} }}\n"
        );
    }
    for (between, cell) in [(["a", "b"], ""), (["b", "a"], "cell = [1, 0, 0]"), (["b", "a"], "cell = [0, 1, 0]")] {
        text += &format!("[[spring]]\nbetween = {between:?}\n{cell}\nstiffness = 1\nrest_length = 1\n");
    }
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn a_honeycomb_that_turns_has_chern_numbers() {
    let case =
        Case { row: None, name: "Chern numbers of a honeycomb that turns, f = 0.3 e_z × v", source: "1, 0, 0, −1" };
    let found = topology(&honeycomb("", 0.3), USUAL_MESH);
    let names = ["branch 0", "branch 1", "branch 2", "branch 3"];
    for ((name, number), group) in names.into_iter().zip([1.0, 0.0, 0.0, -1.0]).zip(&found.chern) {
        assert_eq!(group.0.branches.len(), 1, "{found:?}");
        case.check(name, number, group.0.number.unwrap() as f64, 1e-8);
    }
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    // At κ = 0, ω² ∓ 0.3ω = 0.2 and 3.2; at the corners 1.7, and (1.7 − ω²)² − 0.09ω² = 2.25.
    let turning = |square: f64, side: f64| 0.5 * ((0.09 + 4.0 * square).sqrt() + 0.3 * side);
    let corner = |side: f64| (0.5 * (3.49 + side * (3.49_f64.powi(2) - 2.56).sqrt())).sqrt();
    let edges = [
        (["first gap, lower edge [rad/s]", "first gap, upper edge [rad/s]"], [corner(-1.0), turning(0.2, 1.0)]),
        (["second gap, lower edge [rad/s]", "second gap, upper edge [rad/s]"], [turning(1.7, -1.0), turning(1.7, 1.0)]),
        (["third gap, lower edge [rad/s]", "third gap, upper edge [rad/s]"], [turning(3.2, -1.0), corner(1.0)]),
    ];
    let case = case.by("ω² ∓ 0.3ω = 0.2, 1.7, 3.2; (1.7 − ω²)² − 0.09ω² = 2.25");
    for ((names, [from, to]), gap) in edges.into_iter().zip(&found.gaps) {
        case.check(names[0], from, gap.from, 1e-10);
        case.check(names[1], to, gap.to, 1e-10);
        assert_eq!(gap.chern, 1);
    }
    let case = case.by("−C");
    let other = topology(&honeycomb("", -0.3), 12);
    case.check("branch 0, turning the other way, a mesh of 12", -1.0, other.chern[0].0.number.unwrap() as f64, 1e-8);
    let still = topology(&honeycomb("", 0.0), 16);
    // The flat branches touch the others at κ = 0, and these each other at the corners of the zone.
    let group = &still.chern[0].0;
    assert_eq!(group.branches, [0, 1, 2, 3], "{still:?}");
    let case = case.by("what turns neither way");
    case.check("the sum of branches that touch, without turning", 0.0, group.number.unwrap() as f64, 1e-8);
}

#[test]
fn a_ribbon_of_it_has_waves_along_its_edges() {
    let case = Case {
        row: None,
        name: "edges of a ribbon of a honeycomb that turns",
        source: "as many as Chern numbers below, on each edge",
    };
    let rows = 10;
    let scene = honeycomb(&format!(", repeat = [1, {rows}, 1], periodic = [true, false]"), 0.3);
    let options = BandOptions { points: 25, ..BandOptions::default() };
    let found = BandSurvey::of(&scene, Some("0,0,0 1,0,0"), options).unwrap_or_else(|error| panic!("{error}"));
    // Two rows at each edge.
    assert_eq!((found.edges[0].direction, found.edges[0].cells), (2, 2));
    let listed = [
        ("lower gap, least share at the edges", "lower gap, waves that cross it on an edge", [0.5, 0.57]),
        ("middle gap, least share at the edges", "middle gap, waves that cross it on an edge", [1.26, 1.37]),
        ("upper gap, least share at the edges", "upper gap, waves that cross it on an edge", [1.7, 1.77]),
    ];
    for (name, crossing, [from, to]) in listed {
        let (mut least, mut net) = (1.0_f64, [0, 0]);
        let middle = from + 0.4 * (to - from);
        for (row, omega) in found.omega.iter().enumerate() {
            for branch in 0..omega.len() {
                let [lower, upper] = found.edges[0].shares[row][branch];
                if (from..to).contains(&omega[branch]) {
                    least = least.min(lower + upper);
                }
                let next = found.omega.get(row + 1).map_or(omega[branch], |next| next[branch]);
                if (omega[branch] - middle) * (next - middle) < 0.0 {
                    net[usize::from(lower < upper)] += if next > omega[branch] { 1 } else { -1 };
                }
            }
        }
        println!("{name} {least}; up less down {net:?}");
        case.by("nearly all").check(name, 1.0, least, 0.1);
        case.check(crossing, 1.0, f64::from(i32::abs(net[0])), 0.0);
        assert_eq!(net[0] + net[1], 0, "the other edge passes waves the other way");
    }
}
