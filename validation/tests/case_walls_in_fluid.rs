//! A rigid sphere that feels a plane through the fluid.
//!
//!   towards it  f_⊥ = (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [(2 sinh mα + m sinh 2α)/(4 s² − m² sinh²α) − 1]
//!   along it    f_∥ = 1.5675, 2.6475, 3.7863 at h/R = 1.5431, 1.0453, 1.0050, without spin
//!   far         1/f_∥ = 1 − 9x/16 + x³/8 − 45x⁴/256 − x⁵/16,   x = R/h
//!
//! cosh α = h/R, m = 2n + 1, s = sinh(mα/2). Sources: Brenner 1961; Goldman, Cox and Brenner 1967, table 2; Faxén, in
//! Happel and Brenner §7-4.

use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::PI;

const VISCOSITY: f64 = 2.0;
const RADIUS: f64 = 0.01;
const WEIGHT: f64 = 1500.0 * 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS * 9.81;

/// A sphere at a height of so many radii above a plane, pulled as by its weight in a direction.
fn sphere(end: f64, inertia: bool, height: f64, pull: [f64; 3]) -> Experiment {
    kept(end, inertia, height, pull, "")
}

/// The same of one that is kept to a motion.
fn kept(end: f64, inertia: bool, height: f64, pull: [f64; 3], keep: &str) -> Experiment {
    let gravity = pull.map(|share| 9.81 * share);
    Experiment::of_scene(&format!(
        "world = {{ gravity = {gravity:?} }}\ntime = {{ end = {end:?}, sample = {:?} }}\nsolver = {{ rtol = 1e-9 }}\n\
         fluid = {{ viscosity = {VISCOSITY}, density = 1000 }}\n[[support]]\nname = \"floor\"\nplane = {{}}\n\
         [[body]]\nname = \"s\"\nshape = {{ sphere = {{ radius = {RADIUS} }} }}\ndensity = 2500\n\
         position = [0, 0, {:?}]\ninclusion = {{ inertia = {inertia}, walls = true }}\n{keep}\n",
        0.1 * end,
        height * RADIUS
    ))
}

/// The speed of a sphere without a wall.
fn alone() -> f64 {
    WEIGHT / (6.0 * PI * VISCOSITY * RADIUS)
}

fn at_start(height: f64, pull: [f64; 3]) -> Run {
    sphere(1e-6, false, height, pull).run()
}

/// f_⊥, by terms that fall as e^(−2nα).
fn brenner(height: f64) -> f64 {
    let alpha = height.acosh();
    let sinh = alpha.sinh();
    let term = |k: usize| {
        let n = k as f64;
        let m = 2.0 * n + 1.0;
        let small = (-m * alpha).exp();
        let denominator = 1.0 + small * small - (2.0 + m * m * sinh * sinh) * small;
        let numerator = 1.0 - small * small + m * (2.0 * alpha).sinh() * small;
        n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (numerator / denominator - 1.0)
    };
    4.0 / 3.0 * sinh * (1..3000).map(term).sum::<f64>()
}

#[test]
fn sphere_sinks_towards_a_wall_as_brenner_says() {
    let case = Case { row: None, name: "sphere above a plane wall, without inertia", source: "Brenner 1961" };
    let down = [0.0, 0.0, -1.0];
    let names = [
        (1.001, "speed towards it, at a gap of 0.001 R, over that without it", 1e-9),
        (1.1, "speed towards it, at a gap of 0.1 R, over that without it", 1e-12),
        (3.0, "speed towards it, at a gap of 2 R, over that without it", 1e-12),
    ];
    for (height, name, tolerance) in names {
        let speed = -at_start(height, down).column("s.vz")[0] / alone();
        case.check(name, 1.0 / brenner(height), speed, tolerance);
    }
    // dh/dt = −U/f_⊥ from 2 R down to 1.05 R: t = ∫ f_⊥ dh/U, Simpson's rule over the logarithm of the gap.
    let (from, to, parts) = (2.0, 1.05, 4000);
    let step = ((to - 1.0_f64) / (from - 1.0)).ln() / f64::from(parts);
    let integrand = |k: i32| {
        let gap = (from - 1.0) * (step * f64::from(k)).exp();
        brenner(1.0 + gap) * gap
    };
    let sum: f64 = (0..=parts)
        .map(|k| {
            integrand(k)
                * if k == 0 || k == parts {
                    1.0
                } else if k % 2 == 1 {
                    4.0
                } else {
                    2.0
                }
        })
        .sum();
    let time = -sum * step / 3.0 * RADIUS / alone();
    let experiment = sphere(time, false, from, down);
    let end = experiment.run().end.motion(&experiment.model, 0).placement.position.z / RADIUS;
    case.by("t = ∫ f_⊥ dh/U").check("gap after sinking from R to 0.05 R, over R", to - 1.0, end - 1.0, 1e-7);
}

#[test]
fn sphere_moves_along_a_wall_as_goldman_cox_and_brenner_say() {
    let case =
        Case { row: None, name: "sphere pulled along a plane wall", source: "Goldman, Cox and Brenner 1967, table 2" };
    let along = [1.0, 0.0, 0.0];
    // As printed, to five digits; the sphere is kept from turning.
    let names = [
        (1.543_080_6, 1.5675, "drag at h = 1.5431 R without spin, over that without the wall"),
        (1.045_338_5, 2.6475, "drag at h = 1.0453 R without spin, over that without the wall"),
        (1.005_004_2, 3.7863, "drag at h = 1.0050 R without spin, over that without the wall"),
    ];
    for (height, drag, name) in names {
        let run = kept(1e-6, false, height, along, "keep = { stretch_only = true }").run();
        case.check(name, drag, alone() / run.column("s.vx")[0], 3e-5);
    }
    let x = 0.05_f64;
    let faxen = 1.0 - 9.0 / 16.0 * x + x.powi(3) / 8.0 - 45.0 / 256.0 * x.powi(4) - x.powi(5) / 16.0;
    // Faxén leaves out x⁶.
    let run = at_start(1.0 / x, along);
    case.by("Faxén").check(
        "speed at h = 20 R, over that without it",
        faxen,
        run.column("s.vx")[0] / alone(),
        x.powi(6),
    );
    // Without a torque ω = U c/(g R): it rolls along the wall. Beyond the first terms are x² of it.
    let spin = run.column("s.Pdot_xz")[0] * RADIUS / run.column("s.vx")[0];
    let known = 3.0 / 32.0 * x.powi(4) * (1.0 - 0.375 * x) / (1.0 + 0.3125 * x.powi(3));
    case.by("c = 3x⁴/32 (1 − 3x/8), g = 1 + 5x³/16").check("R ω/U at h = 20 R", known, spin, 10.0 * x * x);
}

#[test]
fn sphere_with_inertia_closes_the_ledger_beside_a_wall() {
    let case = Case { row: None, name: "sphere thrown along a wall and towards it", source: "the ledger" };
    let run = sphere(2.0, true, 1.6, [0.5, 0.2, -0.7]).run();
    case.check("residual over the energy in play", 0.0, run.relative_residual(), 1e-7);
    let work = run.column("work.fluid");
    let gained = largest(work.windows(2).map(|pair| (pair[1] - pair[0]).max(0.0)));
    case.by("dissipation").check("energy that the fluid gives [J]", 0.0, gained, 1e-15);
}
