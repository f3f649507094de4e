//! Lattices as continua, q = k·a.
//!
//!   affine granules, a = 1   uu k, uα kl, αα κ + kl², double stress −kl²/4; C_e = k, C_micro = κ/l², C = k_e
//!   rigid grains, S          (k_s q² − mω²)(k_s a² + (k_b − ¼k_s a²) q² − Iω²) = k_s² a² q²
//!   fcc, nearest             C₁₁ = 2k/a, C₁₂ = C₄₄ = k/a of the cube a
//!   two springs in turn      C = a k₁k₂/(k₁ + k₂), k₁ in the cell: C_e = a k₂, C_micro = a k₁

use crate::lattices::{BETWEEN, GRANULE, LENGTH, LatticeScene, Link, between_faces};
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::modes::bands::ContinuumModel;
use gyration_sim::survey::ContinuumSurvey;
use gyration_validation::Case;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const TOLERANCE: f64 = 1e-10;

fn survey(scene: &Scene, model: ContinuumModel, q: &[f64]) -> ContinuumSurvey {
    let path: Vec<String> = q.iter().map(|q| format!("{:?},0,0", q / TAU)).collect();
    let path = path.join(" | ");
    ContinuumSurvey::of(scene, model, Some(&path), 2).unwrap_or_else(|error| panic!("{error}"))
}

fn nearest(values: &[f64], to: f64) -> f64 {
    values.iter().copied().min_by(|a, b| (a - to).abs().total_cmp(&(b - to).abs())).unwrap()
}

/// The lower root and the upper one of (a − mω²)(b − jω²) = c²: ω².
fn roots([a, b, c]: [f64; 3], [mass, moment]: [f64; 2]) -> [f64; 2] {
    let (sum, product) = (a / mass + b / moment, (a * b - c * c) / (mass * moment));
    let root = (0.25 * sum * sum - product).sqrt();
    [product / (0.5 * sum + root), 0.5 * sum + root]
}

fn granules() -> Scene {
    let chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &GRANULE.affine());
    chain.spring(between_faces(["a", "a"], [1, 0, 0])).scene()
}

#[test]
fn affine_granules_are_a_medium_with_their_moduli() {
    let case = Case { row: None, name: "continuum of affine granules", source: "closed form" };
    let found = survey(&granules(), ContinuumModel::First, &[0.5]);
    let at = |name: &str| found.coordinates.iter().position(|other| other == name).unwrap();
    let (u, stretch) = (at("u_x"), at("a.A_xx"));
    let [k, l, own] = [BETWEEN, LENGTH, GRANULE.stiffness];
    case.check("uu, k² [N]", k, -0.5 * found.second[0][0][u][u], TOLERANCE);
    case.check("uα, k [N]", k * l, found.first[0][u][stretch].abs(), TOLERANCE);
    case.check("αα [N]", own + k * l * l, found.zeroth[stretch][stretch], TOLERANCE);
    case.check("double stress [N m²]", -0.25 * k * l * l, -0.5 * found.second[0][0][stretch][stretch], TOLERANCE);
    let together = 1.0 / (1.0 / k + l * l / own);
    case.check("C [N]", together, found.macroscopic[0][0][0][0], TOLERANCE);
    case.check("C_e [N]", k, found.held[0][0][0][0], TOLERANCE);
    case.check("C_micro [N]", own / (l * l), found.micro.unwrap()[0][0][0][0], TOLERANCE);
}

#[test]
fn a_medium_of_affine_granules_ends_where_it_must() {
    let case = Case { row: None, name: "waves of the continuum of affine granules", source: "closed form" };
    let [k, l, own] = [BETWEEN, LENGTH, GRANULE.stiffness];
    let wave_numbers = [3.0 * PI / 16.0, 0.25 * PI, 0.5 * PI, PI];
    let first = [
        ("first, q = 3π/16 [rad/s]", "first, off at 3π/16 [%]", 0.998),
        ("first, q = π/4 [rad/s]", "first, off at π/4 [%]", 1.800),
        ("first, q = π/2 [rad/s]", "first, off at π/2 [%]", 7.920),
        ("first, q = π [rad/s]", "first, off at π [%]", 46.914),
    ];
    let mindlin = [
        ("mindlin, q = 3π/16 [rad/s]", "mindlin, off at 3π/16 [%]", 0.941),
        ("mindlin, q = π/4 [rad/s]", "mindlin, off at π/4 [%]", 1.695),
        ("mindlin, q = π/2 [rad/s]", "mindlin, off at π/2 [%]", 7.424),
        ("mindlin, q = π [rad/s]", "mindlin, off at π [%]", 42.363),
    ];
    let models = [
        (ContinuumModel::First, first, ("first, optic off at π/2 [%]", 2.921)),
        (ContinuumModel::Mindlin, mindlin, ("mindlin, optic off at π/2 [%]", -0.505)),
    ];
    for (model, names, (name_of_optic, optic_off)) in models {
        let found = survey(&granules(), model, &wave_numbers);
        for (row, (q, (name, off, percent))) in wave_numbers.into_iter().zip(names).enumerate() {
            let softens = if model == ContinuumModel::Mindlin { 0.25 * k * l * l * q * q } else { 0.0 };
            let squares = roots([k * q * q, own + k * l * l - softens, k * l * q], [GRANULE.mass, GRANULE.moment]);
            let acoustic = squares[0].sqrt();
            case.check(name, acoustic, nearest(&found.map.continuum[row], acoustic), TOLERANCE);
            let exact = nearest(&found.map.omega[row], GRANULE.squares(q)[0].sqrt());
            case.check(off, percent, 100.0 * (acoustic / exact - 1.0), 1e-3);
        }
        let optic = GRANULE.squares(0.5 * PI)[1].sqrt();
        let own = nearest(&found.map.continuum[2], optic);
        case.check(name_of_optic, optic_off, 100.0 * (own / optic - 1.0), 1e-3);
    }
    // −kl²q²/4 takes away what holds the stretch: ω² < 0 where κ < kl²q²/4.
    let soft = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body(
        "a",
        [0.0; 3],
        &GRANULE.table("affine = { material = { st_venant_kirchhoff = { lambda = 0, mu = 100 } } }"),
    );
    let soft = soft.spring(between_faces(["a", "a"], [1, 0, 0])).scene();
    let found = survey(&soft, ContinuumModel::Mindlin, &[1.0, 3.0]);
    let told = found.warnings.iter().filter(|warning| warning.contains("below zero")).count();
    let sinks = f64::from(u8::from(2.0 * 100.0 * 0.004 < 0.25 * k * l * l * 9.0));
    case.by("κ < kl²q²/4").check("told that ω² < 0 at q = 3", sinks, told as f64, 0.0);
}

#[test]
fn rigid_grains_are_a_beam_that_shears() {
    let case = Case { row: None, name: "continuum of rigid grains with S = diag(k)", source: "closed form" };
    let (spacing, inertia, shear, bend) = (0.3_f64, 0.02_f64, 20.0_f64, 0.8_f64);
    let arm = (inertia * 6.0 / 4.0_f64).sqrt();
    let points =
        [[arm, 0.0, 0.0], [-arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, -arm, 0.0], [0.0, 0.0, arm], [0.0, 0.0, -arm]];
    let points: Vec<String> = points.iter().map(|at| format!("{{ mass = {:?}, at = {at:?} }}", 1.0 / 6.0)).collect();
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\nlattice = {{ cell = [[{spacing}, 0, 0]] \
         }}\n[[body]]\nname = \"a\"\nshape = {{ points = [{}] }}\n[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, \
         0]\npoints = [[0.15, 0, 0], [-0.15, 0, 0]]\nstiffness = [70, {shear}, {shear}, 0.3, {bend}, {bend}]\n",
        points.join(", ")
    );
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"));
    let names = [
        (ContinuumModel::Mindlin, ["mindlin, lower, q = 0.4 [rad/s]", "mindlin, upper, q = 0.4 [rad/s]"]),
        (ContinuumModel::Cosserat, ["cosserat, lower, q = 0.4 [rad/s]", "cosserat, upper, q = 0.4 [rad/s]"]),
    ];
    for (model, names) in names {
        let q = 0.4;
        let found = survey(&scene, model, &[q]);
        let arm = shear * spacing * spacing;
        let turning = arm + (bend - 0.25 * arm) * q * q;
        let squares = roots([shear * q * q, turning, shear * spacing * q], [1.0, inertia]);
        for (name, square) in names.into_iter().zip(squares) {
            let omega = square.sqrt();
            case.check(name, omega, nearest(&found.map.continuum[0], omega), TOLERANCE);
        }
    }
    // Without torsion or bending of its own the beam gives way: what follows at k = 0 carries no shear.
    let found = survey(&scene, ContinuumModel::Cauchy, &[0.4]);
    case.check("C_yxyx [N]", 0.0, found.macroscopic[1][0][1][0], 1e-12);
    case.check("C_xxxx [N]", 70.0 * spacing, found.macroscopic[0][0][0][0], TOLERANCE);
}

#[test]
fn face_centred_springs_are_a_cubic_solid() {
    let case = Case {
        row: None, name: "continuum of a face-centred lattice", source: "C₁₁ = 2k/a, C₁₂ = C₄₄ = k/a"
    };
    let (side, k) = (0.4_f64, 35.0_f64);
    let half = 0.5 * side;
    let mut lattice =
        LatticeScene::new(&[[0.0, half, half], [half, 0.0, half], [half, half, 0.0]]).point("a", [0.0; 3], 0.2);
    let length = half * 2.0_f64.sqrt();
    for cell in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, -1, 0], [0, 1, -1], [1, 0, -1]] {
        lattice = lattice.spring(Link { cell, law: [k, length, 0.0], ..Link::default() });
    }
    let found = survey(&lattice.scene(), ContinuumModel::Cauchy, &[0.1]);
    let c = &found.macroscopic;
    case.check("C_xxxx [Pa]", 2.0 * k / side, c[0][0][0][0], TOLERANCE);
    case.check("C_xxyy [Pa]", k / side, c[0][0][1][1], TOLERANCE);
    case.check("C_xyxy [Pa]", k / side, c[0][1][0][1], TOLERANCE);
    case.check("C_xyyx [Pa]", k / side, c[0][1][1][0], TOLERANCE);
    case.check("density [kg/m³]", 4.0 * 0.2 / side.powi(3), found.mass[0][0], TOLERANCE);
    // 4 (k/m) sin²: 1 − ω_c/ω = −(q/2)²/6 of waves along [100], which pass all springs at the angle of 45°.
    let along = found.reach.iter().find(|reach| Vec3::from(reach.direction).map(f64::abs).max() > 0.999).unwrap();
    let exact = {
        // x/sin x = 1.01.
        let mut x: f64 = 0.2;
        for _ in 0..60 {
            x -= (x / x.sin() - 1.01) / ((x.sin() - x * x.cos()) / x.sin().powi(2));
        }
        PI * half / x
    };
    case.by("x/sin x = 1.01").check("wavelength of 1 % along [100] [m]", exact, along.wavelength.unwrap(), 1e-9);
}

#[test]
fn a_net_under_tension_holds_its_stress_in_its_waves() {
    let case = Case {
        row: None,
        name: "continuum of a triangular net under tension T = ta",
        source: "B = 2/√3 [⅜(k − t)(δ_ij δ_ab + δ_ia δ_jb + δ_ib δ_ja) + (3/2)t δ_ij δ_ab]",
    };
    let (spacing, k, tension) = (1e-3_f64, 3.0_f64, 0.6_f64);
    let mut lattice = LatticeScene::new(&[[spacing, 0.0, 0.0], [0.5 * spacing, 0.75_f64.sqrt() * spacing, 0.0]]);
    lattice = lattice.point("a", [0.0; 3], 1e-6);
    for cell in [[1, 0, 0], [0, 1, 0], [1, -1, 0]] {
        lattice = lattice.spring(Link { cell, law: [k, spacing * (1.0 - tension / k), 0.0], ..Link::default() });
    }
    let found = survey(&lattice.scene(), ContinuumModel::Cauchy, &[0.0, 1e-3]);
    let (central, taut) = (0.375 * (k - tension), 1.5 * tension);
    let factor = 2.0 / 3.0_f64.sqrt();
    let c = &found.macroscopic;
    case.check("C_xxxx [N/m]", factor * (3.0 * central + taut), c[0][0][0][0], TOLERANCE);
    case.check("C_xyxy [N/m]", factor * (central + taut), c[0][1][0][1], TOLERANCE);
    case.check("C_xxyy [N/m]", factor * (central - taut), c[0][0][1][1] + 0.0, 1e-9);
    case.check("C_zxzx [N/m]", factor * taut, c[2][0][2][0], TOLERANCE);
    case.check("stress [N/m]", factor * taut, found.rest.stress[0][0], TOLERANCE);
    assert!(found.warnings.iter().any(|warning| warning.contains("under stress")), "{:?}", found.warnings);
    assert_eq!(found.map.continuum[0], [0.0; 3], "nothing opposes a translation");
    assert!(found.reach.iter().all(|reach| reach.wavelength.is_some_and(|length| length > 5.0 * spacing)));
}

#[test]
fn masses_within_a_cell_follow_a_strain() {
    let case = Case { row: None, name: "continuum of two springs in turn", source: "closed form" };
    let (spacing, inner, outer) = (0.8_f64, 50.0_f64, 30.0_f64);
    let half = 0.5 * spacing;
    let lattice = LatticeScene::new(&[[spacing, 0.0, 0.0]]).point("a", [0.0; 3], 0.5).point("b", [half, 0.0, 0.0], 0.3);
    let lattice =
        lattice.spring(Link { between: ["a", "b"], cell: [0; 3], law: [inner, half, 0.0], ..Link::default() });
    let lattice =
        lattice.spring(Link { between: ["b", "a"], cell: [1, 0, 0], law: [outer, half, 0.0], ..Link::default() });
    let found = survey(&lattice.scene(), ContinuumModel::Gradient, &[0.2]);
    case.check("C [N]", spacing * inner * outer / (inner + outer), found.macroscopic[0][0][0][0], TOLERANCE);
    case.check("C_e [N]", spacing * outer, found.held[0][0][0][0], TOLERANCE);
    case.check("C_micro [N]", spacing * inner, found.micro.unwrap()[0][0][0][0], TOLERANCE);
    let error = found.map.error[0].last().copied().flatten().unwrap();
    // ω to q⁴: off by less than a hundredth of q⁴.
    case.by("of order q⁴").check("off at q = 0.2", 0.0, error, 0.01 * 0.2_f64.powi(4));
}
