//! Numbers of a lattice from frequencies of its waves.
//!
//!   affine granules   (4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²: κ, k, l from ω of both branches

use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey};
use gyration_study::calibration::{Calibration, Fitted};
use gyration_validation::Case;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

/// The cubes of the gallery: m, j, κ = 2μV, k, l.
const CUBES: [f64; 5] = [1.0, 0.01 / 12.0, 1.0, 600.0, 0.02];

/// ω of both branches.
fn frequencies(q: f64) -> [f64; 2] {
    let [mass, moment, own, k, l] = CUBES;
    let (s2, c2) = ((0.5 * q).sin().powi(2), (0.5 * q).cos().powi(2));
    let (along, stretch) = (4.0 * k * s2, own + k * l * l * c2);
    let (sum, product) = (along / mass + stretch / moment, along * own / (mass * moment));
    let root = (0.25 * sum * sum - product).sqrt();
    [product / (0.5 * sum + root), 0.5 * sum + root].map(f64::sqrt)
}

/// A number of mean zero and deviation one, the n-th.
fn normal(n: u64) -> f64 {
    let uniform = |n: u64| {
        let mixed = (n + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    (-2.0 * uniform(2 * n).max(1e-300).ln()).sqrt() * (TAU * uniform(2 * n + 1)).cos()
}

/// A fit to frequencies with errors of this part of them; noise of that size on them, or none.
fn fit(error: f64, noise: f64) -> Fitted {
    let scene = Scene::open("affine-chain", &[]).unwrap();
    let kappa: Vec<f64> = (1..=12).map(|n| f64::from(n) / 24.0).collect();
    let path: Vec<String> = kappa.iter().map(|kappa| format!("{kappa:?},0,0")).collect();
    let options = BandOptions { points: 2, ..BandOptions::default() };
    let bands = BandSurvey::of(&scene.without_waves(), Some(&path.join(" | ")), options).unwrap();
    let mut columns = [Vec::new(), Vec::new(), Vec::new(), Vec::new()];
    for (row, kappa) in kappa.iter().enumerate() {
        for omega in frequencies(TAU * kappa) {
            let off = |branch: &usize| (bands.omega[row][*branch] - omega).abs();
            let branch = (0..bands.omega[row].len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            let measured = omega * (1.0 + noise * normal(columns[0].len() as u64));
            let numbers = [*kappa, branch as f64, measured, error * omega];
            columns.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
        }
    }
    let [kappa, branch, omega, error] = columns;
    let mut text = "scene = \"affine-chain\"\n".to_owned();
    for (name, key, start) in [
        ("k", "spring.0.stiffness", 480.0),
        ("mu", "body.cube.affine.material.st_venant_kirchhoff.mu", 650.0),
        ("x", "spring.0.points.0.0", 0.013),
    ] {
        let _ = writeln!(text, "[fit.{name}]\nkey = \"{key}\"\nstart = {start:?}");
    }
    let _ = writeln!(
        text,
        "[[dispersion]]\nkappa_1 = {kappa:?}\nbranch = {branch:?}\nomega = {omega:?}\nerror = {error:?}"
    );
    let calibration = Calibration::parse("data.toml", &text, Path::new("")).unwrap_or_else(|error| panic!("{error}"));
    calibration.fit().unwrap_or_else(|error| panic!("{error}"))
}

/// k [N/m], κ [J] and l [m] with their errors; the other end of a spring is 1 cm off its cube's middle.
fn numbers(found: &Fitted) -> [[f64; 2]; 3] {
    let number = |name: &str| {
        let number = found.numbers.iter().find(|number| number.name == name).unwrap();
        [number.value, number.error.unwrap()]
    };
    let [mu, of_mu] = number("mu");
    let [x, of_x] = number("x");
    [number("k"), [2e-3 * mu, 2e-3 * of_mu], [x + 0.01, of_x]]
}

#[test]
fn frequencies_tell_the_numbers_of_a_lattice() {
    let case =
        Case { row: None, name: "calibration by waves of affine granules", source: "κ, k, l that made the data" };
    let [_, _, own, k, l] = CUBES;
    let exact = fit(1e-3, 0.0);
    let names = ["k from exact data [N/m]", "κ from exact data [J]", "l from exact data [m]"];
    for ((name, known), [value, _]) in names.into_iter().zip([k, own, l]).zip(numbers(&exact)) {
        case.check(name, known, value, 1e-9);
    }
    println!("{} evaluations, χ² {:e}", exact.evaluations, exact.chi_squared);
    let noisy = fit(1e-3, 1e-3);
    let case = case.by("normal noise of a thousandth: within three standard errors");
    let names = ["k off, in standard errors", "κ off, in standard errors", "l off, in standard errors"];
    for ((name, known), [value, error]) in names.into_iter().zip([k, own, l]).zip(numbers(&noisy)) {
        println!("{name}: {value} ± {error}");
        case.check(name, 0.0, (value - known) / error, 3.0);
    }
    // 24 frequencies and three numbers: χ² of 21 degrees of freedom.
    case.by("21 ± 6.5").check("χ² with noise", 21.0, noisy.chi_squared, 0.9);
    assert_eq!(noisy.degrees_of_freedom, 21);
}
