//! Bonds and contacts across the cells of a lattice: bands, and modes of bodies that press on one another, q = k·a, s =
//! sin(q/2), c = cos(q/2).
//!
//!   V(l) at the spacing a           along 2√(V″/m) s, across 2√(V′/(ma)) s
//!   rigid, S = diag(k_n, k_s, k_s, k_t, k_b, k_b), half way
//!                                   (4k_s s² − mω²)(k_s a²c² + 4k_b s² − Iω²) = 4k_s²a²s²c²
//!   balls pressed with F, k = −F′   along 2√(k/m) s, across growth 2√(F/(m(2R + g))) s
//!   cubes, side L, h = g/2          k = 2^−(ν+1) αd₀^ν [νL²(h^−(ν+1) + (h+L)^−(ν+1)) + 4L(h^−ν − (h+L)^−ν)]
//!   balls with damping, ν′ = ν      δ = 2(β/α)F s²/m along
//!   balls with friction, ν′ = ν     R = ½b|u_{n+1} − u_n − ½r(θ_n + θ_{n+1})|², b = (β/α)F, r = 2R + g

use gyration_scene::Scene;
use gyration_sim::survey::{BandOptions, BandSurvey, SystemRestState};
use gyration_validation::Case;
use std::f64::consts::{PI, TAU};
use std::path::Path;

const HEAD: &str = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n";

fn scene(text: &str) -> Scene {
    Scene::parse("scene.toml", &format!("{HEAD}{text}"), Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The bands at q along the first direction.
fn bands(text: &str, q: f64) -> BandSurvey {
    let path = format!("{:?},0,0", q / TAU);
    let options = BandOptions { points: 2, ..BandOptions::default() };
    BandSurvey::of(&scene(text), Some(&path), options).unwrap_or_else(|error| panic!("{error}"))
}

/// The value nearest to one that is expected.
fn nearest(values: &[f64], expected: f64) -> f64 {
    let near = |value: &f64| (value - expected).abs();
    values.iter().copied().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap()
}

fn chain(mass: f64, spacing: f64, bonds: &str) -> String {
    format!(
        "lattice = {{ cell = [[{spacing:?}, 0, 0]] }}\n[[body]]\nname = \"a\"\n\
         shape = {{ points = [{{ mass = {mass:?}, at = [0, 0, 0] }}] }}\n{bonds}"
    )
}

fn bond(cell: i32, law: &str) -> String {
    format!("[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [{cell}, 0, 0]\n{law}\n")
}

#[test]
fn bonds_of_a_law_have_its_second_derivative_along_and_its_first_across() {
    let case =
        Case { row: None, name: "bands of a chain of Toda's bonds", source: "2√(V″/m) s, 2√(V′/(ma)) s" };
    let law = "law = \"b/alpha*(exp(-alpha*(l - l0)) + alpha*(l - l0) - 1)\"\n\
               constants = { b = \"0.4 N\", alpha = \"9 1/m\", l0 = \"0.1 m\" }";
    let found = bands(&chain(0.5, 0.12, &bond(1, law)), 0.5 * PI);
    let (stretch, s) = (0.02, (0.25 * PI).sin());
    let (first, second) = (0.4 * (1.0 - f64::exp(-9.0 * stretch)), 0.4 * 9.0 * f64::exp(-9.0 * stretch));
    let along = 2.0 * (second / 0.5).sqrt() * s;
    let across = 2.0 * (first / (0.5 * 0.12)).sqrt() * s;
    case.check("along, q = π/2 [rad/s]", along, nearest(&found.omega[0], along), 1e-12);
    case.check("across, q = π/2 [rad/s]", across, nearest(&found.omega[0], across), 1e-12);
    case.by("V′").check("force of the chain [N]", first, found.rest.force[0][0], 1e-12);
}

#[test]
fn lennard_jones_with_two_shells_is_free_along_and_buckles_across() {
    let case = Case {
        row: None,
        name: "bands of a chain of Lennard-Jones bonds, two shells",
        source: "(a/σ)⁶ = 2(1 + 2⁻¹²)/(1 + 2⁻⁶), closed form",
    };
    let spacing = (2.0 * (1.0 + 2_f64.powi(-12)) / (1.0 + 2_f64.powi(-6))).powf(1.0 / 6.0);
    let law = "law = \"4*(1/l^12 - 1/l^6)\"";
    let found = bands(&chain(1.0, spacing, &(bond(1, law) + &bond(2, law))), PI);
    let second = |l: f64| 4.0 * (156.0 * l.powi(-14) - 42.0 * l.powi(-8));
    let tension = |l: f64| 4.0 * (-12.0 * l.powi(-13) + 6.0 * l.powi(-7));
    // At q = π the second shell moves in step.
    let along = 2.0 * second(spacing).sqrt();
    case.check("along, q = π [rad/s]", along, nearest(&found.omega[0], along), 1e-12);
    let growth = 2.0 * (-tension(spacing) / spacing).sqrt();
    case.check("growth across, q = π [1/s]", growth, -nearest(&found.decay[0], -growth), 1e-12);
    case.by("no force at rest").check("force of the chain [N]", 0.0, found.rest.force[0][0], 1e-14);
}

#[test]
fn stiffness_half_way_between_rigid_grains_bends_and_shears() {
    let case = Case { row: None, name: "bands of rigid grains with S = diag(k)", source: "closed form" };
    let (spacing, inertia, shear, bend, axial) = (0.3_f64, 0.02_f64, 20.0_f64, 0.15_f64, 70.0_f64);
    let arm = (inertia * 6.0 / 4.0_f64).sqrt();
    let points =
        [[arm, 0.0, 0.0], [-arm, 0.0, 0.0], [0.0, arm, 0.0], [0.0, -arm, 0.0], [0.0, 0.0, arm], [0.0, 0.0, -arm]];
    let points: Vec<String> = points.iter().map(|at| format!("{{ mass = {:?}, at = {at:?} }}", 1.0 / 6.0)).collect();
    let text = format!(
        "lattice = {{ cell = [[{spacing}, 0, 0]] }}\n[[body]]\nname = \"a\"\nshape = {{ points = [{}] }}\n{}",
        points.join(", "),
        bond(
            1,
            &format!(
                "points = [[0.15, 0, 0], [-0.15, 0, 0]]\nstiffness = [{axial}, {shear}, {shear}, 0.3, {bend}, {bend}]"
            )
        )
    );
    let names = [
        (PI / 3.0, ["lower, q = π/3 [rad/s]", "upper, q = π/3 [rad/s]", "along, q = π/3 [rad/s]"]),
        (0.5 * PI, ["lower, q = π/2 [rad/s]", "upper, q = π/2 [rad/s]", "along, q = π/2 [rad/s]"]),
        (PI, ["lower, q = π [rad/s]", "upper, q = π [rad/s]", "along, q = π [rad/s]"]),
    ];
    for (q, [low, high, straight]) in names {
        let found = bands(&text, q);
        let (s2, c2) = ((0.5 * q).sin().powi(2), (0.5 * q).cos().powi(2));
        let (one, other) = (4.0 * shear * s2, (shear * spacing * spacing * c2 + 4.0 * bend * s2) / inertia);
        let product = one * other - 4.0 * shear * shear * spacing * spacing * s2 * c2 / inertia;
        let sum = one + other;
        let upper = (0.5 * (sum + (sum * sum - 4.0 * product).sqrt())).sqrt();
        let lower = product.sqrt() / upper;
        case.check(low, lower, nearest(&found.omega[0], lower), 1e-12);
        case.check(high, upper, nearest(&found.omega[0], upper), 1e-12);
        let along = 2.0 * (axial * s2).sqrt();
        case.check(straight, along, nearest(&found.omega[0], along), 1e-12);
    }
}

const RADIUS: f64 = 0.02;
const GAP: f64 = 3e-4;
const REPULSION: &str = "repulsion = { alpha = 100, nu = 6, d0 = 1e-4 }";

fn mass() -> f64 {
    1000.0 * 4.0 / 3.0 * PI * RADIUS.powi(3)
}

fn balls(contact: &str) -> String {
    format!(
        "lattice = {{ cell = [[{:?}, 0, 0]] }}\n[[body]]\nname = \"a\"\n\
         shape = {{ sphere = {{ radius = {RADIUS} }} }}\n\
         density = 1000\n[[contact]]\nbetween = [\"a\", \"a\"]\n{REPULSION}\n{contact}",
        2.0 * RADIUS + GAP
    )
}

#[test]
fn balls_pressed_between_planes_swing_with_their_contacts() {
    let case =
        Case { row: None, name: "modes of two balls pressed between planes", source: "√(k_w/m), √((k_w + 2k)/m)" };
    let apart = 0.080989219013;
    let places = [-1.0, 1.0].map(|side| 0.5 * apart + side * (RADIUS + 0.5 * GAP));
    let support = |name: &str, origin: f64, normal: i32| {
        format!(
            "[[support]]\nname = \"{name}\"\nplane = {{ origin = [{origin:?}, 0, 0], normal = [{normal}, 0, 0] }}\n"
        )
    };
    let ball = |name: &str, place: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = {RADIUS} }} }}\ndensity = 1000\n\
             position = [{place:?}, 0, 0]\n"
        )
    };
    let contact = |with: &str| format!("[[contact]]\n{with}\n{REPULSION}\n");
    let text = support("left", 0.0, 1)
        + &support("right", apart, -1)
        + &ball("a", places[0])
        + &ball("b", places[1])
        + &contact("support = \"left\"")
        + &contact("support = \"right\"")
        + &contact("between = [\"a\", \"b\"]");
    let scene = scene(&text);
    let rest = SystemRestState::of(&scene.built().model, &scene.built().state, &[0, 1]);
    let rest = rest.unwrap_or_else(|error| panic!("{error}"));
    let found: Vec<f64> = rest.modes.iter().map(|mode| mode.frequency).collect();
    // The distance of the planes is given to twelve digits.
    case.check("in step [rad/s]", 0.473188163, nearest(&found, 0.473188163), 2e-9);
    case.check("against each other [rad/s]", 0.859249865, nearest(&found, 0.859249865), 2e-9);
}

#[test]
fn balls_in_a_row_that_press_on_one_another_pass_waves_on() {
    let case =
        Case { row: None, name: "bands of a chain of balls in contact", source: "2√(k/m) s; 2√(F/(m(2R + g))) s" };
    // F and k of the pair follow from the modes between planes, which have nine digits.
    let (force, stiffness) = (5.1713459e-7, 0.5 * mass() * (0.859249865_f64.powi(2) - 0.473188163_f64.powi(2)));
    let (q, spacing) = (0.4 * PI, 2.0 * RADIUS + GAP);
    let s = (0.5 * q).sin();
    let found = bands(&balls(""), q);
    let along = 2.0 * (stiffness / mass()).sqrt() * s;
    case.check("along [rad/s]", along, nearest(&found.omega[0], along), 5e-9);
    let growth = 2.0 * (force / (mass() * spacing)).sqrt() * s;
    case.check("growth across [1/s]", growth, -nearest(&found.decay[0], -growth), 1e-8);
    case.by("F of the pair").check("force of the chain [N]", -force, found.rest.force[0][0], 1e-8);
    let damped = bands(&balls("damping = { beta = 200, nu = 6, d0 = 1e-4 }"), q);
    let decay = 2.0 * 2.0 * force * s * s / mass();
    case.by("δ = 2(β/α)F s²/m").check("decay along [1/s]", decay, nearest(&damped.decay[0], decay), 1e-8);
}

#[test]
fn balls_in_a_row_that_rub_roll_on_one_another_as_they_buckle() {
    let case = Case {
        row: None,
        name: "bands of a chain of balls with friction, q = 0.4π",
        source: "Im λ³ + b(4s²I + r²c²m) λ² − Ig λ − br²c²g = 0, g = 4Fs²/r",
    };
    let (force, resistance, spacing) = (5.1713459e-7, 3.0 * 5.1713459e-7, 2.0 * RADIUS + GAP);
    let (s, c) = (0.2 * PI).sin_cos();
    let (mass, inertia) = (mass(), 0.4 * mass() * RADIUS * RADIUS);
    let (slide, turn) = (4.0 * s * s, (spacing * c).powi(2));
    let push = slide * force / spacing;
    let cubic = |root: f64| {
        let quadratic = resistance * (slide * inertia + turn * mass);
        ((inertia * mass * root + quadratic) * root - inertia * push) * root - resistance * turn * push
    };
    // The rate with which the chain would buckle without friction, and the decay of a slip, bound them.
    let (fast, slip) = ((push / mass).sqrt(), resistance * (slide / mass + turn / inertia));
    let root = |mut low: f64, mut high: f64| {
        assert!(cubic(low) * cubic(high) < 0.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            *(if cubic(low) * cubic(middle) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        low
    };
    let found = bands(&balls("friction = { beta = 300, nu = 6, d0 = 1e-4 }"), 0.4 * PI);
    let real: Vec<f64> = found.lambda[0].iter().filter(|root| root[1] == 0.0).map(|root| root[0]).collect();
    for (name, expected) in [
        ("growth across, rolling [1/s]", root(0.0, fast)),
        ("decay across, rolling [1/s]", root(-fast, 0.0)),
        ("decay of a slip [1/s]", root(-slip - fast, -fast)),
    ] {
        // F has nine digits.
        case.check(name, expected, nearest(&real, expected), 1e-8);
    }
}

#[test]
fn cubes_in_a_row_push_with_faces_and_sides() {
    let (side, nu, gap) = (0.02_f64, 6.0_f64, GAP);
    let case =
        Case { row: None, name: "bands of a chain of cubes in contact", source: "k per area with sides, closed form" };
    let h = 0.5 * gap;
    let powers = |exponent: f64| (h.powf(-exponent), (h + side).powf(-exponent));
    let ((near, far), (nearer, farther)) = (powers(nu), powers(nu + 1.0));
    let stiffness = 2_f64.powf(-(nu + 1.0))
        * 100.0
        * 1e-4_f64.powf(nu)
        * (nu * side * side * (nearer + farther) + 4.0 * side * (near - far));
    let text = format!(
        "lattice = {{ cell = [[{:?}, 0, 0]] }}\n[[body]]\nname = \"a\"\n\
         shape = {{ box = {{ size = [{side}, {side}, {side}] }} }}\n\
         density = 1000\n[[contact]]\nbetween = [\"a\", \"a\"]\n{REPULSION}\n",
        side + gap
    );
    let found = bands(&text, PI);
    let along = 2.0 * (stiffness / (1000.0 * side.powi(3))).sqrt();
    // Balls of the second shell push with some 1e-11 of a neighbour.
    case.check("along, q = π [rad/s]", along, nearest(&found.omega[0], along), 1e-9);
}
