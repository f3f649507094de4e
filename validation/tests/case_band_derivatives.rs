//! Derivatives of bands by numbers of a scene, s = sin(q/2), c = cos(q/2).
//!
//!   masses on springs            ∂ω/∂k = ω/2k, ∂ω/∂m = −ω/2m
//!   string, T = k(a − l₀)        across ∂ω/∂l₀ = −ω/2(a − l₀), along 0
//!   affine granules              F = (4ks² − mω²)(κ + kl²c² − jω²) − 4k²l²s²c² = 0: ∂ω² = −F_p/F_{ω²}
//!   dashpots c                   ∂ω/∂c = −δ²/cω, ∂ω/∂k = 2s²/mω
//!   held across by k_y = k_z     of the two waves of one frequency ∂ω/∂k_y = 0 and 1/2mω
//!   two bonds V₁(x), V₂(a − x)   V₁′ = V₂′ at rest, ∂x/∂p = −(∂V₁′ − ∂V₂′)/(V₁″ + V₂″)
//!   Lennard-Jones, cell at rest  ω ∝ √(ε/m)/σ

use crate::lattices::{
    BETWEEN, GRANULE, LENGTH, LatticeScene, Link, VOLUME, between_faces, granules_that_feel, nearest,
};
use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey, VariedBands};
use gyration_validation::Case;
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Differences of fourth order leave eleven digits and more.
const TOLERANCE: f64 = 1e-9;

/// ω and ∂ω by each number at q.
fn derivatives(scene: &Scene, keys: &[&str], q: f64) -> (Vec<f64>, Vec<Vec<f64>>) {
    let keys: Vec<String> = keys.iter().map(|key| (*key).to_owned()).collect();
    let bands = VariedBands::of(scene, None, &keys).unwrap_or_else(|error| panic!("{error}"));
    let found = bands.at([q / TAU, 0.0, 0.0]).unwrap();
    let changes = found.changes.iter().map(|by| by.iter().map(|change| change.unwrap_or(f64::NAN)).collect());
    (found.omega, changes.collect())
}

/// The branch whose frequency is nearest to one.
fn branch(omega: &[f64], near: f64) -> usize {
    let near = nearest(omega, near);
    omega.iter().position(|omega| *omega == near).unwrap()
}

fn parse(text: &str) -> Scene {
    let head = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n";
    Scene::parse("scene.toml", &format!("{head}{text}"), Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn string(rest_length: f64, damping: f64) -> Scene {
    let string = LatticeScene::new(&[[1.0, 0.0, 0.0]]).point("a", [0.0; 3], 0.5);
    string.spring(Link { law: [40.0, rest_length, damping], ..Link::default() }).scene()
}

#[test]
fn a_string_feels_its_springs_masses_and_tension() {
    let case = Case { row: None, name: "derivatives of a string", source: "ω/2k, −ω/2m, −ω/2(a − l₀)" };
    let keys = ["spring.0.stiffness", "body.a.shape.points.0.mass", "spring.0.rest_length"];
    let (omega, found) = derivatives(&string(0.8, 0.0), &keys, 0.4 * PI);
    let s = (0.2 * PI).sin();
    let (across, along) = (2.0 * 16_f64.sqrt() * s, 2.0 * 80_f64.sqrt() * s);
    let (low, high) = (branch(&omega, across), branch(&omega, along));
    case.check("along, by k", along / 80.0, found[high][0], TOLERANCE);
    case.check("along, by m", -along, found[high][1], TOLERANCE);
    case.check("along, by l₀", 0.0, found[high][2], TOLERANCE);
    case.check("across, by k", across / 80.0, found[low][0], TOLERANCE);
    case.check("across, by m", -across, found[low][1], TOLERANCE);
    case.check("across, by l₀", -across / 0.4, found[low][2], TOLERANCE);
    let (omega, found) = derivatives(&string(1.0, 1.5), &["spring.0.stiffness", "spring.0.damping"], PI);
    let damped = 284.0_f64.sqrt();
    let case = case.by("−δ²/cω, 2s²/mω");
    case.check("damped, by k", 4.0 / damped, found[branch(&omega, damped)][0], TOLERANCE);
    case.check("damped, by c", -24.0 / damped, found[branch(&omega, damped)][1], TOLERANCE);
}

#[test]
fn waves_of_one_frequency_part() {
    let case =
        Case { row: None, name: "derivatives of bands of masses held across", source: "0 and 1/2mω; ∓1/2mω" };
    let scene = parse(
        r#"
        lattice = { cell = [[1, 0, 0]] }
        constants = { k_y = "30 N/m", k_z = "30 N/m", k_yz = 0.0 }
        [[body]]
        name = "a"
        shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
        potential = "0.5*k_y*y^2 + 0.5*k_z*z^2 + k_yz*y*z"
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        stiffness = 40
        rest_length = 1
        "#,
    );
    let across = 60_f64.sqrt();
    let (omega, found) = derivatives(&scene, &["constants.k_y", "constants.k_yz"], PI);
    assert!(omega[..2].iter().all(|omega| (omega - across).abs() < 1e-12), "{omega:?}");
    case.check("lower, by k_y", 0.0, found[0][0], TOLERANCE);
    case.check("upper, by k_y", 1.0 / across, found[1][0], TOLERANCE);
    // Whatever basis they have: y ± z.
    case.check("lower, by the coupling", -1.0 / across, found[0][1], TOLERANCE);
    case.check("upper, by the coupling", 1.0 / across, found[1][1], TOLERANCE);
}

#[test]
fn granules_feel_their_own_stiffness_and_that_between_them() {
    let case = Case { row: None, name: "derivatives of bands of affine granules", source: "−F_p/(2ω F_{ω²})" };
    let chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &GRANULE.affine());
    let scene = chain.spring(between_faces(["a", "a"], [1, 0, 0])).scene();
    let keys = [
        "spring.0.stiffness",
        "body.a.affine.material.st_venant_kirchhoff.mu",
        "spring.0.points.0.0",
        "spring.0.points.1.0",
        "spring.0.rest_length",
        "body.a.mass_properties.mass",
        "body.a.mass_properties.euler_tensor.0.0",
    ];
    let q = PI / 3.0;
    let (s2, c2) = ((0.5 * q).sin().powi(2), (0.5 * q).cos().powi(2));
    let (k, l, own) = (BETWEEN, LENGTH, GRANULE.stiffness);
    let (omega, found) = derivatives(&scene, &keys, q);
    let names = [
        ["acoustic, by k", "acoustic, by κ", "acoustic, by l", "acoustic, by m", "acoustic, by j"],
        ["optic, by k", "optic, by κ", "optic, by l", "optic, by m", "optic, by j"],
    ];
    for (square, names) in GRANULE.squares(q).into_iter().zip(names) {
        let along = 4.0 * k * s2 - GRANULE.mass * square;
        let stretch = own + k * l * l * c2 - GRANULE.moment * square;
        let by_square = -GRANULE.mass * stretch - GRANULE.moment * along;
        let change = |by: f64| -by / (2.0 * square.sqrt() * by_square);
        let row = &found[branch(&omega, square.sqrt())];
        let by_k = 4.0 * s2 * stretch + along * l * l * c2 - 8.0 * k * l * l * s2 * c2;
        case.check(names[0], change(by_k), row[0], TOLERANCE);
        // κ = 2μV.
        case.check(names[1], change(along), row[1] / (2.0 * VOLUME), TOLERANCE);
        // The springs keep their natural length: both points move, and so does the length at rest.
        let by_l = along * 2.0 * k * l * c2 - 8.0 * k * k * l * s2 * c2;
        case.check(names[2], change(by_l), 0.5 * row[2] - 0.5 * row[3] - row[4], TOLERANCE);
        case.check(names[3], change(-square * stretch), row[5], TOLERANCE);
        case.check(names[4], change(-square * along), row[6], TOLERANCE);
    }
}

/// Two bonds ½k(l − l₀)² + ⅙c(l − l₀)³ in turn, at rest: k, l₀, c of the first; the second has k 30, l₀ 0.6, c −20.
fn bonds_in_turn() -> Scene {
    parse(
        r#"
        lattice = { cell = [[1.2, 0, 0]], relax = ["granules"] }
        constants = { k = "50 N/m", c = 70.0 }
        [[body]]
        name = "a"
        shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
        [[body]]
        name = "b"
        position = [0.55, 0, 0]
        shape = { points = [{ mass = 0.3, at = [0, 0, 0] }] }
        [[bond]]
        between = ["a", "b"]
        law = "0.5*k*(l - 0.5)^2 + c*(l - 0.5)^3/6"
        [[bond]]
        between = ["b", "a"]
        cell = [1, 0, 0]
        law = "15*(l - 0.6)^2 - 20*(l - 0.6)^3/6"
        "#,
    )
}

#[test]
fn the_rest_moves_with_a_number() {
    let case = Case {
        row: None,
        name: "derivatives of bands of two bonds in turn",
        source: "∂x/∂p = −(∂V₁′ − ∂V₂′)/(V₁″ + V₂″)",
    };
    let (omega, found) = derivatives(&bonds_in_turn(), &["constants.k", "constants.c"], 0.0);
    let mut x = 0.05;
    let first = |x: f64| (50.0 * x + 35.0 * x * x, 50.0 + 70.0 * x);
    let second = |x: f64| (30.0 * (0.1 - x) - 10.0 * (0.1 - x).powi(2), 30.0 - 20.0 * (0.1 - x));
    for _ in 0..50 {
        x -= (first(x).0 - second(x).0) / (first(x).1 + second(x).1);
    }
    let sum = first(x).1 + second(x).1;
    let optic = (sum * (2.0 + 1.0 / 0.3)).sqrt();
    let row = &found[branch(&omega, optic)];
    // ∂(V₁″ + V₂″) at rest, and by x, where V₂″ falls as x grows.
    let change = |own: f64, by_force: f64| 0.5 * optic * (own - (70.0 + 20.0) * by_force / sum) / sum;
    case.check("by k", change(1.0, x), row[0], TOLERANCE);
    case.check("by c", change(x, 0.5 * x * x), row[1], TOLERANCE);
}

#[test]
fn the_cell_moves_with_a_number() {
    let case = Case {
        row: None,
        name: "derivatives of bands of Lennard-Jones bonds, the cell at rest",
        source: "ω ∝ √(ε/m)/σ",
    };
    let scene = parse(
        r#"
        lattice = { cell = [[1.1, 0, 0]], relax = ["granules", "cell"] }
        constants = { eps = "1 J", sigma = "1 m" }
        [[body]]
        name = "a"
        shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
        [[bond]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        law = "4*eps*((sigma/l)^12 - (sigma/l)^6)"
        [[bond]]
        between = ["a", "a"]
        cell = [2, 0, 0]
        law = "4*eps*((sigma/l)^12 - (sigma/l)^6)"
        "#,
    );
    let (omega, found) = derivatives(&scene, &["constants.eps", "constants.sigma"], PI);
    let along = 15.526001;
    let at = branch(&omega, along);
    case.check("∂ln ω/∂ln ε", 0.5, found[at][0] / omega[at], TOLERANCE);
    case.check("∂ln ω/∂ln σ", -1.0, found[at][1] / omega[at], TOLERANCE);
}

#[test]
fn waves_that_are_driven_feel_what_drives_them() {
    let case = Case {
        row: None,
        name: "derivatives of bands of granules that feel their stretch",
        source: "∂λ = −F_p/F_λ with κ(λa + b)/(λa + κ)",
    };
    let (gain, drag, q) = (300.0, 150.0, 0.5 * PI);
    let scene = granules_that_feel(gain, drag).scene();
    let keys = [
        "body.a.contractile.contraction_viscosity",
        "body.a.contractile.material.st_venant_kirchhoff.mu",
        "spring.0.stiffness",
    ];
    let (omega, found) = derivatives(&scene, &keys, q);
    let (s, c) = (0.5 * q).sin_cos();
    // The characteristic function of λ, μ_γ, μ and k.
    let function = |root: Complex<f64>, [drag, mu, k]: [f64; 3]| {
        let own = 2.0 * mu * VOLUME;
        let (a, b) = (VOLUME * drag, VOLUME * gain);
        let stretch =
            (root * a + b) * own + (root * a + own) * (root * root * GRANULE.moment + k * (LENGTH * c).powi(2));
        let along = root * root * GRANULE.mass + 4.0 * k * s * s;
        along * stretch - (root * a + own) * 4.0 * (k * LENGTH * s * c).powi(2)
    };
    let numbers = [drag, 0.5 * GRANULE.stiffness / VOLUME, BETWEEN];
    let names = [
        (Complex::new(-0.203543, -2.186075), ["acoustic, by μ_γ", "acoustic, by μ", "acoustic, by k"]),
        (Complex::new(-5.001752, -10.548097), ["optic, by μ_γ", "optic, by μ", "optic, by k"]),
    ];
    for (near, names) in names {
        // A derivative by differences of a polynomial of fifth degree.
        let by_root = |root: Complex<f64>| {
            let step = Complex::new(1e-5, 0.0);
            (function(root + step, numbers) - function(root - step, numbers)) / 2e-5
        };
        let mut root = near;
        for _ in 0..20 {
            root -= function(root, numbers) / by_root(root);
        }
        for (index, name) in names.into_iter().enumerate() {
            let at = |side: f64| {
                let mut beside = numbers;
                beside[index] *= 1.0 + side * 1e-5;
                function(root, beside)
            };
            // Of second degree in each number: differences have no error but rounding.
            let by_number = (at(1.0) - at(-1.0)) / (2e-5 * numbers[index]);
            let change = -(-by_number / by_root(root)).im;
            case.check(name, change, found[branch(&omega, -root.im)][index], 1e-8);
        }
    }
}

#[test]
fn derivatives_are_the_differences_of_whole_bands() {
    let case = Case {
        row: None,
        name: "derivatives of bands of a taut chain of granules",
        source: "differences of fourth order of bands of neighbouring scenes",
    };
    let body = GRANULE.affine();
    let chain = LatticeScene::relaxed(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &body);
    let link = Link { law: [BETWEEN, 0.45, 0.0], ..between_faces(["a", "a"], [1, 0, 0]) };
    let text = chain.spring(link).scene();
    let keys = ["spring.0.stiffness", "spring.0.rest_length", "body.a.affine.material.st_venant_kirchhoff.mu"];
    let q = 0.3 * PI;
    let (omega, found) = derivatives(&text, &keys, q);
    let names = ["worst of all branches, by k", "worst of all branches, by l₀", "worst of all branches, by μ"];
    for (index, ((key, number), name)) in keys.iter().zip([BETWEEN, 0.45, 1000.0]).zip(names).enumerate() {
        let step = 1e-3 * number;
        let at = |steps: f64| {
            let setting = format!("{key}={:?}", number + steps * step);
            let scene = Scene::parse("scene.toml", text.text(), Path::new(""), &[setting]).unwrap();
            let options = BandOptions { points: 2, ..BandOptions::default() };
            BandSurvey::of(&scene, Some(&format!("{:?},0,0", q / TAU)), options).unwrap().omega.remove(0)
        };
        let [a, b, c, d] = [at(-2.0), at(-1.0), at(1.0), at(2.0)];
        let worst = (0..omega.len()).filter(|branch| omega[*branch] > 0.0).map(|branch| {
            let differences = (8.0 * (c[branch] - b[branch]) - (d[branch] - a[branch])) / (12.0 * step);
            (found[branch][index] - differences).abs() * number / omega[branch]
        });
        case.check(name, 0.0, worst.fold(0.0, f64::max), 1e-9);
    }
}
