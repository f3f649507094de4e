//! Bodies without inertia that act on one another: their velocities follow from one balance.
//!
//! Balls of resistance ζ = 6πηR on a spring with a dashpot have l − l₀ ∝ exp(−k μ t/(1 + c μ)), μ = 1/ζ_a + 1/ζ_b. One
//! that presses on another as they sink has the velocity (W_a + W_b)/(ζ_a + ζ_b) with it, and the force between them is
//! (W_a ζ_b − W_b ζ_a)/(ζ_a + ζ_b). Equal balls that drive each other apart with F = K g^(1−ν), K = πRαd₀^ν/(ν − 1),
//! and a damping of the same exponent, c = β/α, have
//!
//!   c (g − g₀) + ζ (g^ν − g₀^ν)/(2νK) = t

use gyration_validation::{Case, Experiment};
use std::f64::consts::PI;

const VISCOSITY: f64 = 0.8;

fn resistance(radius: f64) -> f64 {
    6.0 * PI * VISCOSITY * radius
}

/// A scene in a fluid that weighs nothing.
fn in_fluid(gravity: f64, end: f64, rest: &str) -> Experiment {
    Experiment::of_scene(&format!(
        "world = {{ gravity = [0, 0, {:?}] }}\ntime = {{ end = {end:?}, sample = {end:?} }}\n\
         solver = {{ rtol = 1e-10, atol = 1e-12 }}\nfluid = {{ viscosity = {VISCOSITY} }}\n{rest}",
        -gravity
    ))
}

fn ball(name: &str, radius: f64, mass: f64, height: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = {radius:?} }} }}\nmass = {mass:?}\n\
         position = [0, 0, {height:?}]\ninclusion = {{ inertia = false }}\n"
    )
}

#[test]
fn balls_on_a_dashpot_come_to_rest_as_their_balance_says() {
    let (radii, stiffness, damping, length, end) = ([0.1, 0.25], 3.0, 5.0, 1.0, 2.0);
    let spring = format!(
        "[[spring]]\nbetween = [\"a\", \"b\"]\nstiffness = {stiffness:?}\ndamping = {damping:?}\nrest_length = \
            {length:?}\n"
    );
    let bodies = ball("a", radii[0], 1.0, 1.5) + &ball("b", radii[1], 2.0, 0.0);
    let scene = bodies + &spring;
    let run = in_fluid(0.0, end, &scene).run();
    let mobility: f64 = radii.iter().map(|radius| 1.0 / resistance(*radius)).sum();
    let left = 0.5 * (-stiffness * mobility * end / (1.0 + damping * mobility)).exp();
    let (one, other) = (run.column("a.z")[1], run.column("b.z")[1]);
    let case = Case { row: None, name: "balls without inertia on a dashpot", source: "exp(−kμt/(1 + cμ))" };
    case.check("stretch after 2 s [m]", left, one - other - length, 1e-9);
    // After a hundred decay times velocities are rounding, and no fault.
    let rest = in_fluid(0.0, 200.0, &scene).run();
    let stretch = rest.column("a.z")[1] - rest.column("b.z")[1] - length;
    assert!(stretch.abs() < 1e-9, "{stretch}");
    // Nothing pulls at both: ζ_a z_a + ζ_b z_b stays.
    let center = |one: f64, other: f64| radii[0] * one + radii[1] * other;
    case.by("ζ_a z_a + ζ_b z_b").check("centre of resistance [m²]", center(1.5, 0.0), center(one, other), 1e-13);
}

#[test]
fn a_heavy_ball_presses_on_a_light_one_as_they_sink() {
    let (radii, masses, gravity) = ([0.1, 0.1], [3.0, 1.0], 9.81);
    let laws = "[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = { alpha = 1e4, nu = 6, d0 = 0.01 }\n\
                damping = { beta = 1e4, nu = 6, d0 = 0.01 }\nfriction = { beta = 1e4, nu = 4, d0 = 0.01 }\n";
    let bodies = ball("a", radii[0], masses[0], 0.3) + &ball("b", radii[1], masses[1], 0.0);
    let run = in_fluid(gravity, 5.0, &(bodies + laws)).run();
    let [a, b] = radii.map(resistance);
    let [heavy, light] = masses.map(|mass| mass * gravity);
    let case = Case { row: None, name: "a ball that presses on another as both sink", source: "balance of both" };
    let fall = -(heavy + light) / (a + b);
    case.check("velocity of the upper [m/s]", fall, run.column("a.vz")[1], 1e-9);
    case.check("velocity of the lower [m/s]", fall, run.column("b.vz")[1], 1e-9);
    let force = (heavy * b - light * a) / (a + b);
    case.by("(W_a ζ_b − W_b ζ_a)/(ζ_a + ζ_b)").check("force between them [N]", force, run.column("a.fz")[1], 1e-9);
    let gap = run.column("a.gap")[1];
    let powers = gap.powf(-5.0) - (gap + 4.0 * radii[0]).powf(-5.0);
    let closed = PI * radii[0] * 1e4 * 0.01_f64.powi(6) * powers / 5.0;
    case.by("πRαd₀^ν [g^(1−ν) − (g+4R)^(1−ν)]/(ν−1)").check("force of their gap [N]", closed, force, 1e-8);
}

/// A damping 1e10 times as stiff as the fluid takes its digits from a factorization, not from the velocities.
#[test]
fn what_sticks_together_sinks_as_one() {
    let (radius, masses, gravity) = (0.1, [3.0, 1.0], 9.81);
    let laws = "[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = { alpha = 1e4, nu = 6, d0 = 0.01 }\n\
                damping = { beta = 1e14, nu = 6, d0 = 0.01 }\n";
    let bodies = ball("a", radius, masses[0], 0.215) + &ball("b", radius, masses[1], 0.0);
    let run = in_fluid(gravity, 0.5, &(bodies + laws)).run();
    let both = run.column("a.vz")[1] + run.column("b.vz")[1];
    let case = Case { row: None, name: "balls that stick together, β = 1e14 Pa s/m", source: "(W_a + W_b)/ζ" };
    case.check("sum of the velocities [m/s]", -(masses[0] + masses[1]) * gravity / resistance(radius), both, 1e-12);
}

#[test]
fn equal_balls_drive_each_other_apart_against_damping_and_fluid() {
    let (radius, alpha, nu, d0, first) = (1.0, 2e3, 6.0, 0.01, 2e-3);
    for (name, ratio) in [("balls that part in a fluid", 0.0), ("balls that part, with c = β/α", 4.0)] {
        let damping = if ratio > 0.0 {
            format!("damping = {{ beta = {:?}, nu = {nu:?}, d0 = {d0:?} }}\n", ratio * alpha)
        } else {
            String::new()
        };
        let laws = format!(
            "[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = {{ alpha = {alpha:?}, nu = {nu:?}, d0 = {d0:?} \
                }}\n{damping}"
        );
        let end = 0.5;
        let bodies = ball("a", radius, 1.0, 2.0 * radius + first) + &ball("b", radius, 1.0, 0.0);
        let run = in_fluid(0.0, end, &(bodies + &laws)).run();
        let gap = run.column("a.z")[1] - run.column("b.z")[1] - 2.0 * radius;
        let strength = PI * radius * alpha * f64::powf(d0, nu) / (nu - 1.0);
        let spent = resistance(radius) * (gap.powf(nu) - f64::powf(first, nu)) / (2.0 * nu * strength);
        let case = Case { row: None, name, source: "c (g − g₀) + ζ (g^ν − g₀^ν)/(2νK) = t" };
        case.check("time to the gap at the end [s]", end, ratio * (gap - first) + spent, 1e-7);
        // Part of the time goes to each of the two.
        assert!(ratio == 0.0 || ratio * (gap - first) > 0.02 * end, "{gap}");
        println!("{name}: {first} → {gap}, {} steps", run.steps);
    }
}
