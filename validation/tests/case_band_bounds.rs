//! Bounds of what frequencies may be off: the truth lies within them, and they are small.
//!
//! Frequencies in closed form are themselves rounded, by some units of their last digit.

use crate::lattices::{GRANULE, LatticeScene, Link, between_faces};
use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey};
use gyration_validation::Case;
use nalgebra::Complex;
use std::f64::consts::TAU;
use std::path::Path;

/// Frequencies in closed form are known to this part of them.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Bounds of ordinary lattices are below this part of a frequency.
const SMALL: f64 = 1e-9;

fn survey(scene: &Scene, kappa: &[[f64; 2]]) -> BandSurvey {
    let path: Vec<String> = kappa.iter().map(|[x, y]| format!("{x:?},{y:?},0")).collect();
    let path = path.join(" | ");
    let options = BandOptions { points: 2, bound: true, ..BandOptions::default() };
    BandSurvey::of(scene, Some(&path), options).unwrap_or_else(|error| panic!("{error}"))
}

/// |ω − ω̃|/bound of the branch nearest to a known one, and bound/ω of it.
fn ratios(found: &BandSurvey, row: usize, known: f64) -> [f64; 2] {
    let off = |branch: &usize| (found.omega[row][*branch] - known).abs();
    let branch = (0..found.omega[row].len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    let bound = found.bound.as_ref().unwrap()[row][branch].unwrap();
    [(off(&branch) - ROUNDING * known).max(0.0) / bound, bound / known]
}

/// Checks known frequencies of all rows.
fn check(case: &Case, names: [&'static str; 2], found: &BandSurvey, known: impl Fn(usize) -> Vec<f64>) {
    let rows = 0..found.omega.len();
    let all: Vec<[f64; 2]> = rows
        .flat_map(|row| known(row).into_iter().map(move |known| (row, known)))
        .map(|(row, known)| ratios(found, row, known))
        .collect();
    let most = |which: usize| all.iter().map(|ratios| ratios[which]).fold(0.0, f64::max);
    println!("{}: off by {:.3} of the bound, bound {:.2e} of ω", names[0], most(0), most(1));
    case.check(names[0], 0.0, most(0), 1.0);
    case.check(names[1], 0.0, most(1), SMALL);
}

fn parse(text: &str) -> Scene {
    let head = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n";
    Scene::parse("scene.toml", &format!("{head}{text}"), Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Wave numbers over half of the zone.
fn line() -> Vec<[f64; 2]> {
    (1..=40).map(|n| [f64::from(n) / 80.0, 0.0]).collect()
}

#[test]
fn known_frequencies_lie_within_their_bounds() {
    let case = Case { row: None, name: "bounds of bands", source: "the truth lies within them" };
    let q = |row: usize| TAU * line()[row][0];

    let string = |rest_length: f64, damping: f64| {
        let string = LatticeScene::new(&[[1.0, 0.0, 0.0]]).point("a", [0.0; 3], 0.5);
        string.spring(Link { law: [40.0, rest_length, damping], ..Link::default() }).scene()
    };
    let names = ["string: error over bound", "string: bound over ω"];
    check(&case, names, &survey(&string(0.8, 0.0), &line()), |row| {
        let s = (0.5 * q(row)).sin();
        vec![2.0 * 80_f64.sqrt() * s, 2.0 * 16_f64.sqrt() * s]
    });
    let names = ["dashpots: error over bound", "dashpots: bound over ω"];
    check(&case, names, &survey(&string(1.0, 1.5), &line()), |row| {
        let s2 = (0.5 * q(row)).sin().powi(2);
        vec![(320.0 * s2 - (6.0 * s2).powi(2)).sqrt()]
    });

    let chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &GRANULE.affine());
    let scene = chain.spring(between_faces(["a", "a"], [1, 0, 0])).scene();
    let names = ["affine granules: error over bound", "affine granules: bound over ω"];
    check(&case, names, &survey(&scene, &line()), |row| {
        // Of the smaller root the product over the larger one has all digits.
        let [low, high] = GRANULE.squares(q(row));
        vec![low.sqrt(), high.sqrt()]
    });

    let half = 0.5 * 3_f64.sqrt();
    let mut honeycomb = LatticeScene::new(&[[1.5, half, 0.0], [1.5, -half, 0.0]]);
    honeycomb = honeycomb.point("a", [0.0; 3], 1.0).point("b", [1.0, 0.0, 0.0], 1.0);
    honeycomb = honeycomb.spring(Link { between: ["a", "b"], cell: [0; 3], ..Link::default() });
    for cell in [[1, 0, 0], [0, 1, 0]] {
        honeycomb = honeycomb.spring(Link { between: ["b", "a"], cell, ..Link::default() });
    }
    let places: Vec<[f64; 2]> = (1..60).map(|n| [0.013 * f64::from(n), 0.007 * f64::from(n)]).collect();
    let names = ["honeycomb: error over bound", "honeycomb: bound over ω"];
    check(&case, names, &survey(&honeycomb.scene(), &places), |row| {
        let phase = |kappa: f64| Complex::from_polar(1.0, TAU * kappa);
        let g = (phase(places[row][0]) + phase(places[row][1]) + 1.0).norm() / 3.0;
        vec![(1.5 * (1.0 + g)).sqrt(), 3_f64.sqrt()]
    });
}

#[test]
fn what_rest_leaves_is_within_bounds() {
    let case = Case { row: None, name: "bounds of bands about rest", source: "the truth lies within them" };
    // ½k(l − l₀)² + ⅙c(l − l₀)³ of two bonds in turn; at q = 0 the optic branch.
    let bonds = |soft: f64| {
        let text = r#"
            lattice = { cell = [[1.2, 0, 0]], relax = ["granules"] }
            constants = { soft = 15.0 }
            [[body]]
            name = "a"
            shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
            [[body]]
            name = "b"
            position = [0.55, 0, 0]
            shape = { points = [{ mass = 0.3, at = [0, 0, 0] }] }
            [[bond]]
            between = ["a", "b"]
            law = "25*(l - 0.5)^2 + 70*(l - 0.5)^3/6"
            [[bond]]
            between = ["b", "a"]
            cell = [1, 0, 0]
            law = "soft*(l - 0.6)^2 - 20*(l - 0.6)^3/6"
        "#;
        parse(&text.replace("soft = 15.0", &format!("soft = {soft:?}")))
    };
    let listed = [
        (15.0, ["bonds in turn: error over bound", "bonds in turn: bound over ω"]),
        (500.0, ["a stiff and a soft bond: error over bound", "a stiff and a soft bond: bound over ω"]),
    ];
    for (soft, names) in listed {
        let mut x = 0.05;
        let first = |x: f64| (50.0 * x + 35.0 * x * x, 50.0 + 70.0 * x);
        let second = |x: f64| (2.0 * soft * (0.1 - x) - 10.0 * (0.1 - x).powi(2), 2.0 * soft - 20.0 * (0.1 - x));
        for _ in 0..50 {
            x -= (first(x).0 - second(x).0) / (first(x).1 + second(x).1);
        }
        let optic = ((first(x).1 + second(x).1) * (2.0 + 1.0 / 0.3)).sqrt();
        check(&case, names, &survey(&bonds(soft), &[[0.0, 0.0]]), |_| vec![optic]);
    }

    let scene = parse(
        r#"
        lattice = { cell = [[1.1, 0, 0]], relax = ["granules", "cell"] }
        [[body]]
        name = "a"
        shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
        [[bond]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        law = "4*(1/l^12 - 1/l^6)"
        [[bond]]
        between = ["a", "a"]
        cell = [2, 0, 0]
        law = "4*(1/l^12 - 1/l^6)"
        "#,
    );
    let spacing = (2.0 * (1.0 + 2_f64.powi(-12)) / (1.0 + 2_f64.powi(-6))).powf(1.0 / 6.0);
    let along = 2.0 * (4.0 * (156.0 * spacing.powi(-14) - 42.0 * spacing.powi(-8))).sqrt();
    let names = ["cell at rest: error over bound", "cell at rest: bound over ω"];
    check(&case, names, &survey(&scene, &[[0.5, 0.0]]), |_| vec![along]);

    // Gaps of a hundredth of the cubes, which push with their seventh power.
    let (side, gap, nu) = (0.02_f64, 3e-4_f64, 6.0_f64);
    let spacing = side + gap;
    // The gap as the numbers of the scene have it.
    let h = 0.5 * (spacing - side);
    let powers = |exponent: f64| (h.powf(-exponent), (h + side).powf(-exponent));
    let ((near, far), (nearer, farther)) = (powers(nu), powers(nu + 1.0));
    let stiffness = 2_f64.powf(-(nu + 1.0))
        * 100.0
        * 1e-4_f64.powf(nu)
        * (nu * side * side * (nearer + farther) + 4.0 * side * (near - far));
    let cubes = parse(&format!(
        "lattice = {{ cell = [[{spacing:?}, 0, 0]] }}\n[[body]]\nname = \"a\"\ndensity = 1000\n\
         shape = {{ box = {{ size = [{side}, {side}, {side}] }} }}\n[[contact]]\nbetween = [\"a\", \"a\"]\n\
         repulsion = {{ alpha = 100, nu = 6, d0 = 1e-4 }}\n"
    ));
    let along = 2.0 * (stiffness / (1000.0 * side.powi(3))).sqrt();
    let names = ["cubes in contact: error over bound", "cubes in contact: bound over ω"];
    check(&case, names, &survey(&cubes, &[[0.5, 0.0]]), |_| vec![along]);
}
