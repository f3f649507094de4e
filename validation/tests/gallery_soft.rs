//! The gallery's `spin-flatten`, `drop-skew`, `pinned-strain`, `stiff-limit` and `kick`: bodies that deform.
//!
//!   spinning    P = R(ωt) diag(a, a, a⁻²):  V S_aa = ω² j a, S_zz = 0;  angular momentum: ω a² = ω₀
//!   hanging     P = diag(l^−½, l^−½, l):  V W′(l) = ½ m g h,  W = c₁(l² + 2/l − 3) + c₂(2l + l⁻² − 3)
//!   stiff       the way from the rigid motion goes as 1/stiffness, by viscosity as μ/stiffness²
//!
//! Source: `docs/theory-affine.md`.

use gyration_sim::modes::rest;
use gyration_validation::{Answer, Experiment};

const C1: f64 = 3000.0;
const C2: f64 = 1000.0;
const DENSITY: f64 = 1000.0;

/// The root of a rising function between two places, by halving.
fn root(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn spinning_ball_finds_the_oblate_shape_of_the_closed_form() {
    let (radius, spin) = (0.1, 30.0);
    // j/V = ρR²/5; a is the equatorial stretch.
    let j = DENSITY * radius * radius / 5.0;
    let lacking = |a: f64| {
        let l = a.powi(-2);
        let first = 2.0 * a * a + l * l;
        let stress = |p: f64| 2.0 * C1 * p + 2.0 * C2 * (first * p - p.powi(3));
        let pressure = stress(l) * l;
        let omega = spin / (a * a);
        -(omega * omega * j * a - (stress(a) - pressure / a))
    };
    let a = root(lacking, 1.0, 1.5);
    let experiment = Experiment::of_gallery("spin-flatten", &["time.end=5", "time.sample=5"]);
    let motion = experiment.motion_at(5.0);
    let answer = |quantity, reference, measured, tolerance| {
        let (case, source) = ("gallery: spin-flatten", "V S = ω² P J across the axis, ωa² = ω₀");
        Answer { row: None, case, quantity, reference, measured, tolerance, source }.check();
    };
    // The swing has decayed by e^−25.
    answer("stretch along the axis", a.powi(-2), motion.placement.gradient.m33, 1e-8);
    answer("angular velocity [rad/s]", spin / (a * a), motion.angular_velocity().z, 1e-8);
}

#[test]
fn hanging_rod_settles_at_the_stretch_that_carries_its_weight() {
    let (height, gravity) = (0.4, 9.81);
    let pull = |l: f64| 2.0 * C1 * (l - l.powi(-2)) + 2.0 * C2 * (1.0 - l.powi(-3)) - 0.5 * DENSITY * gravity * height;
    let stretch = root(pull, 1.0, 2.0);
    let motion = Experiment::of_gallery("pinned-strain", &["time.end=9"]).motion_at(9.0);
    let answer = |quantity, reference, measured, tolerance| {
        let (case, source) = ("gallery: pinned-strain", "V W′(l) = ½ m g h");
        Answer { row: None, case, quantity, reference, measured, tolerance, source }.check();
    };
    answer("stretch of the rod at rest", stretch, motion.placement.gradient.m33, 1e-8);
    answer("height of its centre below the pin [m]", 0.5 * height * stretch, 0.2 - motion.placement.position.z, 1e-8);
}

#[test]
fn box_dropped_on_its_corner_comes_to_the_rest_state_of_its_face() {
    let experiment = Experiment::of_gallery("drop-skew", &[]);
    let run = experiment.run();
    assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
    // Downhill from where it lies there is a rest state near by.
    let state = rest(&experiment.model, &run.end, 0).unwrap_or_else(|error| panic!("{error}"));
    let motion = run.end.motion(&experiment.model, 0);
    let answer = |quantity, reference, measured, tolerance| {
        let (case, source) = ("gallery: drop-skew", "equilibrium of the exact rates");
        Answer { row: None, case, quantity, reference, measured, tolerance, source }.check();
    };
    answer("gap at rest [m]", state.gap, run.column("box.gap")[run.times.len() - 1], 1e-2);
    answer("height of the centre at rest [m]", state.placement.position.z, motion.placement.position.z, 1e-3);
    let stretches = motion.placement.gradient.singular_values();
    answer("largest principal stretch at rest", state.stretches.max(), stretches.max(), 1e-3);
    answer("smallest principal stretch at rest", state.stretches.min(), stretches.min(), 1e-3);
    assert!(stretches.min() < 0.999, "its weight flattens it");
}

#[test]
fn stiffer_and_stiffer_bodies_tend_to_the_rigid_one() {
    let distances = |overrides: &[&str]| {
        let run = Experiment::of_gallery("stiff-limit", &[&["time.end=0.35"], overrides].concat()).run();
        assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
        let at = |body: &str, axis: &str| run.column(&format!("{body}.{axis}"))[run.times.len() - 1];
        ["soft", "firm", "stiff"].map(|body| (at(body, "x") - at("rigid", "x")).hypot(at(body, "z") - at("rigid", "z")))
    };
    let [soft, firm, stiff] = distances(&[]);
    println!("way from the rigid egg after the first bounce: {soft:.5}, {firm:.5}, {stiff:.5} m");
    assert!(soft > firm && firm > stiff);
    let harder = "body.stiff.affine={ material = { mooney_rivlin = { c1 = 3e6, c2 = 1e6 } }, viscosity = 632 }";
    let [_, _, hard] = distances(&[harder]);
    let ratio = stiff / hard;
    println!("a hundred times the stiffness over a thousand times: {ratio:.2}");
    // The elastic part goes as 1/stiffness, that of viscosity, which grows as its root here, as its power −3/2: 10
    // to 32.
    assert!((9.0..32.0).contains(&ratio), "{ratio}");
}

#[test]
fn kicked_ball_repeats_itself_after_four_periods_of_the_table() {
    let run = Experiment::of_gallery("kick", &["time.end=12"]).run();
    assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
    let apexes: Vec<f64> = run.times_of("apex").into_iter().filter(|time| *time > 9.0).collect();
    let height = run.column("ball.z");
    let at = |time: f64| height[run.times.partition_point(|sample| *sample < time)];
    let high: Vec<f64> = apexes.iter().copied().filter(|time| at(*time) > 0.25).collect();
    let low: Vec<f64> = apexes.iter().copied().filter(|time| at(*time) < 0.25).collect();
    println!("high at {high:.4?} s, low at {low:.4?} s");
    assert!(high.len() > 2 && low.len() > 2);
    let worst = high.windows(2).map(|pair| (pair[1] - pair[0] - 0.8).abs()).fold(0.0, f64::max);
    let answer = |quantity, reference, measured, tolerance| {
        let (case, source) = ("gallery: kick", "a hop in two periods, high and low by turns");
        Answer { row: None, case, quantity, reference, measured, tolerance, source }.check();
    };
    answer("largest difference of two high hops from four periods [s]", 0.0, worst, 1e-3);
}
