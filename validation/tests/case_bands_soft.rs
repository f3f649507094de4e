//! Waves through chains of granules that keep their volume, that are stretched, or that drive themselves.

use crate::lattices::{
    BETWEEN, GRANULE, LENGTH, LatticeScene, Link, VOLUME, frequencies, granules_that_feel, nearest, nearest_root, row,
};
use gyration_validation::Case;
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};

const TOLERANCE: f64 = 1e-10;

/// (4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²: both frequencies.
fn branches([stiffness, internal, length]: [f64; 3], [mass, moment]: [f64; 2], q: f64) -> [f64; 2] {
    let (s, c) = (0.5 * q).sin_cos();
    let (own, stretch) = (4.0 * stiffness * s * s, internal + stiffness * (length * c).powi(2));
    let (sum, product) = (own / mass + stretch / moment, own * internal / (mass * moment));
    let root = (0.25 * sum * sum - product).sqrt();
    [(product / (0.5 * sum + root)).sqrt(), (0.5 * sum + root).sqrt()]
}

/// A box of rubber: c₁, c₂ [Pa], its sizes [m], 1000 kg/m³.
fn rubber([first, second]: [f64; 2], size: [f64; 3]) -> String {
    format!(
        "shape = {{ box = {{ size = {size:?} }} }}\ndensity = 1000\naffine = {{ material = {{ mooney_rivlin = {{ c1 = \
         {first:?}, c2 = {second:?} }} }} }}\n"
    )
}

#[test]
fn granules_that_keep_their_volume_swell_as_they_shorten() {
    let case = Case {
        row: None,
        name: "bands of granules that keep their volume, q = π/3",
        source: "κ = 6(c₁ + c₂)V, j = J_x + (J_y + J_z)/4",
    };
    let (length, width, [first, second]) = (0.1_f64, 0.06_f64, [2000.0_f64, 1000.0_f64]);
    let volume = length * width * width;
    let mass = 1000.0 * volume;
    let (stiffness, spacing) = (40.0, 0.15);
    let link = Link {
        points: [[0.5 * length, 0.0, 0.0], [-0.5 * length, 0.0, 0.0]],
        law: [stiffness, spacing - length, 0.0],
        ..Link::default()
    };
    let chain = LatticeScene::new(&[[spacing, 0.0, 0.0]]);
    let chain = chain.body("a", [0.0; 3], &rubber([first, second], [length, width, width]));
    let found = frequencies(&chain.spring(link).waves(), [1.0 / 6.0, 0.0, 0.0]);
    let moments = [length, width, width].map(|side| mass * side * side / 12.0);
    let moment = moments[0] + 0.25 * (moments[1] + moments[2]);
    let [low, high] = branches([stiffness, 6.0 * (first + second) * volume, length], [mass, moment], PI / 3.0);
    case.check("acoustic [rad/s]", low, nearest(&found, low), TOLERANCE);
    case.check("optic [rad/s]", high, nearest(&found, high), TOLERANCE);

    let case = Case {
        row: None,
        name: "bands of a box .1 × .08 × .06 of rubber that nothing holds",
        source: "K = V diag(3μ, 4μ), M = [[J_x + (J_y + J_z)/4, (J_z − J_y)/2], [·, J_y + J_z]]",
    };
    let lattice = LatticeScene::new(&[[0.2, 0.0, 0.0]]).body("a", [0.0; 3], &rubber([3000.0, 0.0], [0.1, 0.08, 0.06]));
    let found = frequencies(&lattice.waves(), [0.2, 0.0, 0.0]);
    let (mu, density) = (6000.0, 1000.0);
    let [x, y, z] = [0.1_f64, 0.08, 0.06].map(|side| density * side * side / 12.0);
    // Eigenvalues of K − ω²M.
    let (a, b, d) = (x + 0.25 * (y + z), 0.5 * (z - y), y + z);
    let (two, one, none) = (a * d - b * b, 3.0 * mu * d + 4.0 * mu * a, 12.0 * mu * mu);
    let root = (one * one - 4.0 * two * none).sqrt();
    let [low, high] = [one - root, one + root].map(|value| (0.5 * value / two).sqrt());
    assert!((low - 130.01310).abs() < 1e-5 && (high - 172.94692).abs() < 1e-5, "{low} {high}");
    case.check("lower [rad/s]", low, nearest(&found, low), TOLERANCE);
    case.check("upper [rad/s]", high, nearest(&found, high), TOLERANCE);
}

#[test]
fn stretched_granules_have_the_tangent_of_their_stretch() {
    let case = Case {
        row: None,
        name: "bands of such granules at a stretch of 1.3, q = π/3",
        source: "κ = V(c₁(2 + 4λ⁻³) + 6c₂λ⁻⁴), j = J_x + (J_y + J_z)λ⁻³/4",
    };
    let (length, width, [first, second], stretch) = (0.1_f64, 0.06_f64, [2000.0_f64, 1000.0_f64], 1.3_f64);
    let volume = length * width * width;
    let mass = 1000.0 * volume;
    let (stiffness, natural) = (400.0, 0.05);
    let slope = 2.0 * first * (stretch - stretch.powi(-2)) + 2.0 * second * (1.0 - stretch.powi(-3));
    let tension = volume * slope / length;
    let spacing = stretch * length + natural + tension / stiffness;
    let link = Link {
        points: [[0.5 * length, 0.0, 0.0], [-0.5 * length, 0.0, 0.0]],
        law: [stiffness, natural, 0.0],
        ..Link::default()
    };
    let chain = LatticeScene::relaxed(&[[spacing, 0.0, 0.0]]);
    let chain = chain.body("a", [0.0; 3], &rubber([first, second], [length, width, width]));
    let waves = chain.spring(link).waves();
    let rest = waves.rest();
    case.by("V W′ = l T").check("stretch at rest", stretch, rest.bodies[0].stretches[0], TOLERANCE);
    case.by("V W′ = l T").check("tension [N]", tension, rest.force[0].x, TOLERANCE);
    let internal = volume * (first * (2.0 + 4.0 * stretch.powi(-3)) + 6.0 * second * stretch.powi(-4));
    let moments = [length, width, width].map(|side| mass * side * side / 12.0);
    let moment = moments[0] + 0.25 * (moments[1] + moments[2]) * stretch.powi(-3);
    let [low, high] = branches([stiffness, internal, length], [mass, moment], PI / 3.0);
    let found = frequencies(&waves, [1.0 / 6.0, 0.0, 0.0]);
    case.check("acoustic [rad/s]", low, nearest(&found, low), TOLERANCE);
    case.check("optic [rad/s]", high, nearest(&found, high), TOLERANCE);
}

/// The left side of the characteristic equation of active granules and its derivative: κ → κ(λa + b)/(λa + κ), times
/// what divides.
fn characteristic([drag, gain]: [f64; 2], q: f64, root: Complex<f64>) -> Complex<f64> {
    let (s, c) = (0.5 * q).sin_cos();
    let (mass, moment, internal) = (GRANULE.mass, GRANULE.moment, GRANULE.stiffness);
    let (a, b) = (VOLUME * drag, VOLUME * gain);
    let ends = (root * a + internal) * (BETWEEN * (LENGTH * c).powi(2) + root * root * moment);
    let own = (root * a + b) * internal + ends;
    let along = root * root * mass + 4.0 * BETWEEN * s * s;
    along * own - (root * a + internal) * 4.0 * (BETWEEN * LENGTH * s * c).powi(2)
}

#[test]
fn granules_that_feel_their_stretch_damp_or_drive_waves() {
    let case = Case {
        row: None,
        name: "bands of granules that feel their stretch",
        source: "as above with κ(λa + b)/(λa + κ), a = Vμ_γ, b = Vg",
    };
    let listed = [
        (300.0, 150.0, PI / 2.0, Complex::new(-0.203543, -2.186075), "g 300, acoustic"),
        (300.0, 150.0, PI / 2.0, Complex::new(-5.001752, -10.548097), "g 300, optic"),
        (300.0, 150.0, PI / 2.0, Complex::new(-2.922743, 0.0), "g 300, contraction"),
        (0.0, 150.0, PI / 2.0, Complex::new(-0.416579, -2.420408), "g 0, acoustic"),
        (0.0, 150.0, PI / 2.0, Complex::new(-6.250088, -10.958552), "g 0, optic"),
        (-200.0, 150.0, PI / 2.0, Complex::new(1.085246, 0.0), "g −200, grows"),
        (3000.0, 20.0, PI / 3.0, Complex::new(0.386953, -15.889196), "g 3000, flutter"),
        (3000.0, 20.0, PI / 3.0, Complex::new(0.000273, -1.681746), "g 3000, acoustic"),
        (3000.0, 20.0, PI / 3.0, Complex::new(-100.774452, 0.0), "g 3000, contraction"),
    ];
    for (gain, drag, q, near, quantity) in listed {
        let waves = granules_that_feel(gain, drag).waves();
        // Newton's method from the six digits of the list, with a derivative by differences.
        let (mut root, at) = (near, |root| characteristic([drag, gain], q, root));
        for _ in 0..20 {
            let step = Complex::new(1e-6, 0.0);
            root -= at(root) * 2e-6 / (at(root + step) - at(root - step));
        }
        assert!((root - near).norm() < 2e-6, "{root} {near}");
        let found = nearest_root(&row(&waves, [q / TAU, 0.0, 0.0]), root);
        case.check(quantity, 0.0, (found - root).norm() / root.norm(), TOLERANCE);
    }
}
