//! Waves through lattices of springs: `bands` against closed forms, q = k·a, s = sin(q/2), c = cos(q/2).

use crate::lattices::{
    GRANULE, LatticeScene, Link, between_faces, frequencies, nearest, nearest_root, row, row_towards,
};
use gyration_sim::modes::{system_modes, system_rest};
use gyration_validation::Case;
use nalgebra::Complex;
use std::f64::consts::{PI, SQRT_2, TAU};

/// Closed forms hold to rounding: that of the largest frequency, seen from the one that is compared.
const TOLERANCE: f64 = 1e-10;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

fn along(q: f64) -> [f64; 3] {
    [q / TAU, 0.0, 0.0]
}

#[test]
fn masses_on_springs_have_the_frequencies_of_a_chain() {
    let case = Case { row: None, name: "bands of a chain, k = 40, m = ½", source: "ω = 2√(k/m) sin(q/2)" };
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], 0.5);
    let waves = chain.spring(Link { law: [40.0, 1.0, 0.0], ..Link::default() }).waves();
    let most = 2.0 * 80_f64.sqrt();
    let found = row(&waves, along(0.5 * PI));
    case.check("q = π/2 [rad/s]", most * (0.25 * PI).sin(), found.branches[2].omega, TOLERANCE);
    case.check("q = π [rad/s]", most, frequencies(&waves, along(PI))[2], TOLERANCE);
    let velocity = found.branches[2].velocity.unwrap().x;
    case.by("∂ω/∂k = √(k/m) cos(q/2)").check("group velocity, q = π/2 [m/s]", 40_f64.sqrt(), velocity, TOLERANCE);
    let dos = waves.zone(2000, &[true]).unwrap().dos;
    let width = dos.omega[1] - dos.omega[0];
    let near = |omega: &&f64| (**omega - 0.5 * most).abs();
    let middle = dos.omega.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
    let bin = dos.omega.iter().position(|omega| omega == middle).unwrap();
    let states = |omega: f64| 2.0 / PI * (omega / most).asin();
    let expected = (states(middle + 0.5 * width) - states(middle - 0.5 * width)) / width;
    // A wave vector of the mesh stands for those about it with the slope at its middle.
    case.by("D = 2/(π√(ω_m² − ω²))").check(
        "density of states at half of the top [s]",
        expected,
        dos.density[bin],
        1e-4,
    );
}

#[test]
fn two_masses_or_two_springs_that_alternate_leave_a_gap() {
    let case = Case { row: None, name: "bands of a chain of masses 2 : 1", source: "closed form" };
    let (heavy, light, stiffness) = (2.0, 1.0, 3.0);
    let law = [stiffness, 0.5, 0.0];
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], heavy).point("b", [0.5, 0.0, 0.0], light);
    let inner = Link { between: ["a", "b"], cell: [0; 3], law, ..Link::default() };
    let outer = Link { between: ["b", "a"], law, ..Link::default() };
    let waves = chain.spring(inner).spring(outer).waves();
    let q = 0.3 * PI;
    let sum: f64 = stiffness * (1.0 / heavy + 1.0 / light);
    let root = (sum * sum - 4.0 * (stiffness * (0.5 * q).sin()).powi(2) / (heavy * light)).sqrt();
    let found = frequencies(&waves, along(q));
    case.check("q = 0.3π, acoustic [rad/s]", (sum - root).sqrt(), found[4], TOLERANCE);
    case.check("q = 0.3π, optic [rad/s]", (sum + root).sqrt(), found[5], TOLERANCE);
    let gap = waves.zone(64, &[true]).unwrap().gaps.into_iter().find(|gap| gap.below == 4).unwrap();
    let [from, to] = [(2.0 * stiffness / heavy).sqrt(), (2.0 * stiffness / light).sqrt()];
    case.check("gap over its middle", 2.0 * (to - from) / (to + from), gap.width_over_middle, TOLERANCE);

    let case = Case { row: None, name: "bands of a chain of springs 5 : 3", source: "closed form" };
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], heavy).point("b", [0.5, 0.0, 0.0], heavy);
    let inner = Link { law: [5.0, 0.5, 0.0], ..inner };
    let waves = chain.spring(inner).spring(outer).waves();
    let (edge, middle) = (frequencies(&waves, along(PI)), frequencies(&waves, along(0.0)));
    case.check("lower edge of the gap [rad/s]", (2.0 * 3.0 / heavy).sqrt(), edge[4], TOLERANCE);
    case.check("upper edge of the gap [rad/s]", (2.0 * 5.0 / heavy).sqrt(), edge[5], TOLERANCE);
    case.check("top [rad/s]", (2.0 * 8.0 / heavy).sqrt(), middle[5], TOLERANCE);
}

#[test]
fn a_taut_string_moves_across_and_a_pressed_one_buckles() {
    let case = Case { row: None, name: "bands of a taut chain, l₀ = 0.8 a", source: "2√(T/(ma)) sin(q/2)" };
    let (mass, stiffness, q) = (0.5, 40.0, 0.6 * PI);
    let chain = |spacing: f64, rest_length: f64| {
        let chain = LatticeScene::new(&[[spacing, 0.0, 0.0]]).point("a", [0.0; 3], mass);
        chain.spring(Link { law: [stiffness, rest_length, 0.0], ..Link::default() }).waves()
    };
    let s = (0.5 * q).sin();
    let waves = chain(1.0, 0.8);
    let found = frequencies(&waves, along(q));
    let tension = stiffness * 0.2;
    case.check("across [rad/s]", 2.0 * (tension / mass).sqrt() * s, found[0], TOLERANCE);
    case.check("along [rad/s]", 2.0 * (stiffness / mass).sqrt() * s, found[2], TOLERANCE);
    case.check("force of the cell vector [N]", tension, waves.rest().force[0].x, TOLERANCE);
    let pressed = row(&chain(0.9, 1.0), along(q));
    let growth = 2.0 * (stiffness * 0.1 / (mass * 0.9)).sqrt() * s;
    case.check("growth across at a = 0.9 l₀ [1/s]", growth, -pressed.branches[0].decay, TOLERANCE);
    assert_eq!(pressed.branches[0].omega, 0.0);
}

#[test]
fn bars_with_crossed_springs_bend_and_turn() {
    let case = Case {
        row: None,
        name: "bands of bars, L .2, b = d = .1, k 50, k_d 20, m 1, I .02, q = π/2",
        source: "(4k_s s² − mω²)(4k_r s² + k_s a²c² − Iω²) = 4k_s²a²s²c²",
    };
    let (length, half, apart, spring, crossed, mass, inertia) = (0.2_f64, 0.1_f64, 0.1_f64, 50.0, 20.0, 1.0, 0.02);
    let spacing = length + apart;
    let bar = |spring: f64, crossed: f64| {
        // Six points at equal distances: I = 4 (m/6) r².
        let arm = (1.5_f64 * inertia / mass).sqrt();
        let at = [0, 1, 2].map(|axis| {
            let place = |sign: f64| std::array::from_fn::<f64, 3, _>(|a| if a == axis { sign * arm } else { 0.0 });
            let point = |sign: f64| format!("{{ mass = {:?}, at = {:?} }}", mass / 6.0, place(sign));
            format!("{}, {}", point(1.0), point(-1.0))
        });
        let mut chain = LatticeScene::new(&[[spacing, 0.0, 0.0]]);
        chain = chain.body("a", [0.0; 3], &format!("shape = {{ points = [{}] }}", at.join(", ")));
        for side in [half, -half] {
            let link = |to: f64, stiffness: f64, length: f64| Link {
                points: [[0.1, side, 0.0], [-0.1, to, 0.0]],
                law: [stiffness, length, 0.0],
                ..Link::default()
            };
            chain = chain.spring(link(side, spring, apart));
            if crossed > 0.0 {
                chain = chain.spring(link(-side, crossed, apart.hypot(2.0 * half)));
            }
        }
        chain.waves()
    };
    let sine = 2.0 * half / apart.hypot(2.0 * half);
    let (across, turn) = (2.0 * crossed * sine * sine, 2.0 * spring * half * half);
    let q = 0.5 * PI;
    let (s, c) = (0.5 * q).sin_cos();
    let (a, b) = (4.0 * across * s * s, 4.0 * turn * s * s + across * (spacing * c).powi(2));
    let coupling = 4.0 * (across * spacing * s * c).powi(2);
    let (sum, product) = (a / mass + b / inertia, (a * b - coupling) / (mass * inertia));
    let root = (0.25 * sum * sum - product).sqrt();
    let found = frequencies(&bar(spring, crossed), along(q));
    let low = (product / (0.5 * sum + root)).sqrt();
    case.check("lower [rad/s]", low, nearest(&found, low), TOLERANCE);
    let high = (0.5 * sum + root).sqrt();
    case.check("upper [rad/s]", high, nearest(&found, high), TOLERANCE);
    let straight = (4.0 * (2.0 * spring + 2.0 * crossed * (1.0 - sine * sine)) * s * s / mass).sqrt();
    case.check("along [rad/s]", straight, nearest(&found, straight), TOLERANCE);
    let cutoff = spacing * (across / inertia).sqrt();
    let middle = frequencies(&bar(spring, crossed), along(0.0));
    case.check("cut-off at q = 0 [rad/s]", cutoff, nearest(&middle, cutoff), TOLERANCE);
    let alone = 2.0 * half * (2.0 * spring / inertia).sqrt() * s;
    let uncrossed = frequencies(&bar(spring, 0.0), along(q));
    case.check("turning without crossed springs [rad/s]", alone, nearest(&uncrossed, alone), TOLERANCE);
}

#[test]
fn a_square_lattice_with_diagonals_has_its_speeds_and_corners() {
    let case = Case { row: None, name: "bands of a square lattice, k₁ 30, k₂ 20, m 2", source: "closed form" };
    let (side, diagonal, mass) = (30.0, 20.0, 2.0);
    let mut square = LatticeScene::new(&[X, Y]).point("a", [0.0; 3], mass);
    for (cell, law) in [
        ([1, 0, 0], [side, 1.0, 0.0]),
        ([0, 1, 0], [side, 1.0, 0.0]),
        ([1, 1, 0], [diagonal, SQRT_2, 0.0]),
        ([1, -1, 0], [diagonal, SQRT_2, 0.0]),
    ] {
        square = square.spring(Link { cell, law, ..Link::default() });
    }
    let waves = square.waves();
    let corner = frequencies(&waves, [0.5, 0.0, 0.0]);
    case.check("X, upper [rad/s]", (4.0 * (side + diagonal) / mass).sqrt(), corner[2], TOLERANCE);
    case.check("X, lower [rad/s]", (4.0 * diagonal / mass).sqrt(), corner[1], TOLERANCE);
    let corner = frequencies(&waves, [0.5, 0.5, 0.0]);
    case.check("M, one of two [rad/s]", (4.0 * side / mass).sqrt(), corner[1], TOLERANCE);
    case.check("M, the other [rad/s]", (4.0 * side / mass).sqrt(), corner[2], TOLERANCE);
    // At κ = 1e-4 the slope of ω is a part of 5e-8 less.
    let speed = |direction: [f64; 3]| {
        let branches = row_towards(&waves, direction.map(|part| 1e-4 * part), direction).branches;
        [1, 2].map(|branch| branches[branch].velocity.unwrap().norm())
    };
    let near = 1e-6;
    let [across, along] = speed(X);
    case.check("speed along [10], along [m/s]", ((side + diagonal) / mass).sqrt(), along, near);
    case.check("speed along [10], across [m/s]", (diagonal / mass).sqrt(), across, near);
    let [across, along] = speed([1.0, 1.0, 0.0]);
    case.check("speed along [11], along [m/s]", ((0.5 * side + 2.0 * diagonal) / mass).sqrt(), along, near);
    case.check("speed along [11], across [m/s]", (0.5 * side / mass).sqrt(), across, near);
}

#[test]
fn a_honeycomb_has_a_flat_branch_and_two_that_meet() {
    let case = Case { row: None, name: "bands of a honeycomb, κ = (.13, .31)", source: "ω²m/k = 1.5 (1 ∓ g), 3" };
    let half = 0.5 * 3_f64.sqrt();
    let mut lattice = LatticeScene::new(&[[1.5, half, 0.0], [1.5, -half, 0.0]]);
    lattice = lattice.point("a", [0.0; 3], 1.0).point("b", [1.0, 0.0, 0.0], 1.0);
    lattice = lattice.spring(Link { between: ["a", "b"], cell: [0; 3], ..Link::default() });
    for cell in [[1, 0, 0], [0, 1, 0]] {
        lattice = lattice.spring(Link { between: ["b", "a"], cell, ..Link::default() });
    }
    let found = frequencies(&lattice.waves(), [0.13, 0.31, 0.0]);
    let phase = |kappa: f64| Complex::from_polar(1.0, TAU * kappa);
    let g = (phase(0.13) + phase(0.31) + 1.0).norm() / 3.0;
    case.check("acoustic [rad/s]", (1.5 * (1.0 - g)).sqrt(), found[3], TOLERANCE);
    case.check("optic [rad/s]", (1.5 * (1.0 + g)).sqrt(), found[4], TOLERANCE);
    case.check("flat [rad/s]", 3_f64.sqrt(), found[5], TOLERANCE);
    case.check("in the plane, without stiffness [rad/s]", 0.0, found[2], TOLERANCE);
}

#[test]
fn granules_that_stretch_have_an_optic_branch() {
    let case = Case {
        row: None,
        name: "bands of granules that stretch, m 2, j .05, κ 8, k 6, l .4",
        source: "(4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²",
    };
    let chain = LatticeScene::new(&[X]).body("a", [0.0; 3], &GRANULE.affine());
    let waves = chain.spring(between_faces(["a", "a"], [1, 0, 0])).waves();
    for (q, names) in [
        (PI / 3.0, ["q = π/3, acoustic [rad/s]", "q = π/3, optic [rad/s]"]),
        (PI / 2.0, ["q = π/2, acoustic [rad/s]", "q = π/2, optic [rad/s]"]),
        (PI, ["q = π, acoustic [rad/s]", "q = π, optic [rad/s]"]),
    ] {
        let found = frequencies(&waves, along(q));
        for (name, square) in names.into_iter().zip(GRANULE.squares(q)) {
            case.check(name, square.sqrt(), nearest(&found, square.sqrt()), TOLERANCE);
        }
    }
}

#[test]
fn a_free_chain_of_granules_sounds_as_the_bands_tell() {
    let case = Case { row: None, name: "modes of a free chain of four such granules", source: "bands at q = πn/4" };
    let names = ["a", "b", "c", "d"];
    let mut chain = LatticeScene::alone();
    for (n, name) in names.into_iter().enumerate() {
        chain = chain.body(name, [n as f64, 0.0, 0.0], &GRANULE.affine());
    }
    for pair in names.windows(2) {
        chain = chain.spring(between_faces([pair[0], pair[1]], [0; 3]));
    }
    let scene = chain.scene();
    let (model, start) = (&scene.built().model, &scene.built().state);
    let members = [0, 1, 2, 3];
    let rests = system_rest(model, start, &members).unwrap();
    let found: Vec<f64> =
        system_modes(model, start, &members, &rests).unwrap().iter().map(|mode| mode.frequency()).collect();
    for (n, names) in [
        (1, ["n = 1, acoustic [rad/s]", "n = 1, optic [rad/s]"]),
        (2, ["n = 2, acoustic [rad/s]", "n = 2, optic [rad/s]"]),
        (3, ["n = 3, acoustic [rad/s]", "n = 3, optic [rad/s]"]),
    ] {
        for (name, square) in names.into_iter().zip(GRANULE.squares(PI * f64::from(n) / 4.0)) {
            case.check(name, square.sqrt(), nearest(&found, square.sqrt()), TOLERANCE);
        }
    }
    let own = (GRANULE.stiffness / GRANULE.moment).sqrt();
    case.by("√(κ/j)").check("free ends [rad/s]", own, nearest(&found, own), TOLERANCE);
}

#[test]
fn a_taut_face_centred_lattice_has_its_corners() {
    let case = Case { row: None, name: "bands of a face-centred lattice, k 7, T = .4 r", source: "closed form" };
    let (stiffness, taut, mass) = (7.0, 0.4, 1.3);
    let half = 0.5 * SQRT_2;
    let vectors = [[0.0, half, half], [half, 0.0, half], [half, half, 0.0]];
    let mut lattice = LatticeScene::new(&vectors).point("a", [0.0; 3], mass);
    for cell in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, -1, 0], [0, 1, -1], [1, 0, -1]] {
        lattice = lattice.spring(Link { cell, law: [stiffness, 1.0 - taut / stiffness, 0.0], ..Link::default() });
    }
    let waves = lattice.waves();
    let corner = frequencies(&waves, [0.5, 0.5, 0.0]);
    case.check("X, twice [rad/s]", ((4.0 * stiffness + 12.0 * taut) / mass).sqrt(), corner[0], TOLERANCE);
    case.check("X, once [rad/s]", ((8.0 * stiffness + 8.0 * taut) / mass).sqrt(), corner[2], TOLERANCE);
    let corner = frequencies(&waves, [0.5, 0.5, 0.5]);
    case.check("L, twice [rad/s]", ((2.0 * stiffness + 10.0 * taut) / mass).sqrt(), corner[1], TOLERANCE);
    case.check("L, once [rad/s]", ((8.0 * stiffness + 4.0 * taut) / mass).sqrt(), corner[2], TOLERANCE);
}

#[test]
fn dashpots_damp_short_waves() {
    let case =
        Case { row: None, name: "bands of a chain with dashpots, q = π, m ½, k 40, c 1.5", source: "δ = 2cs²/m" };
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], 0.5);
    let waves = chain.clone().spring(Link { law: [40.0, 1.0, 1.5], ..Link::default() }).waves();
    let found = row(&waves, along(PI));
    case.check("decay rate [1/s]", 6.0, found.branches[2].decay, TOLERANCE);
    case.by("√(4ks²/m − δ²)").check("frequency [rad/s]", 284_f64.sqrt(), found.branches[2].omega, TOLERANCE);
    let creeping = chain.spring(Link { law: [40.0, 1.0, 6.0], ..Link::default() }).waves();
    let found = row(&creeping, along(PI));
    assert!(found.branches.iter().all(|branch| branch.omega == 0.0));
    // λ² + 48 λ + 320 = 0.
    let root = nearest_root(&found, Complex::new(-8.0, 0.0));
    case.by("c²s² > km").check("creep with c = 6 [1/s]", 24.0 - 256_f64.sqrt(), -root.re, TOLERANCE);
}
