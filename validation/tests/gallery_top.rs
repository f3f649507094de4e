//! The scenes `top`, `top-slow` and `top-falling`: a cone on its apex, held up by the field alone.
//!
//! A top pinned at its tip precesses at Ω = [I₃ω₃ − √(I₃²ω₃² − 4 I₁ m g l cos θ)]/(2 I₁ cos θ), I₁ about the tip. Where
//! the tip is free to slide, the centre stays on its vertical and I₁ is about the centre; friction decides between the
//! two, and while the top is fast both are m g l/(I₃ω₃) to leading order.

use crate::spinning::{Spinning, mean};
use gyration_validation::{Answer, Experiment, largest};
use std::f64::consts::PI;

const GRAVITY: f64 = 9.81;
const MASS: f64 = 0.1;
const RADIUS: f64 = 0.04;
const HEIGHT: f64 = 0.03;
/// l, from the apex to the centre of mass [m].
const ARM: f64 = 0.75 * HEIGHT;
/// I₃ and I₁ about the apex [kg m²].
const AXIAL: f64 = 0.3 * MASS * RADIUS * RADIUS;
const TRANSVERSE: f64 = MASS * (0.15 * RADIUS * RADIUS + 0.6 * HEIGHT * HEIGHT);

/// What is measured of a top: inclinations of the axis that points up [rad], rate of precession and of spin [rad/s].
struct Top {
    inclinations: Vec<f64>,
    precession: f64,
    spins: Vec<f64>,
    residual: f64,
    orbit: f64,
}

fn top(name: &str, overrides: &[&str]) -> Top {
    let run = Experiment::of_gallery(name, overrides).run();
    let motion = Spinning::of(&run, "top");
    // The shape's axis points down to the apex.
    let inclinations = motion.inclinations().iter().map(|angle| PI - angle).collect();
    let spins = motion.axial_spins().iter().map(|spin| -spin).collect();
    let (azimuths, last) = (motion.azimuths(), run.times.len() - 1);
    let precession = (azimuths[last] - azimuths[0]) / run.times[last];
    let (x, y) = (run.column("top.x"), run.column("top.y"));
    let width = |values: &[f64]| {
        let [low, high] = [f64::min, f64::max].map(|pick| values.iter().copied().reduce(pick).unwrap_or(f64::NAN));
        high - low
    };
    let orbit = 0.25 * (width(&x) + width(&y));
    Top { inclinations, precession, spins, residual: run.relative_residual(), orbit }
}

/// The slow precession of a top pinned at its apex [rad/s].
fn pinned(spin: f64, inclination: f64) -> f64 {
    let (momentum, moment) = (AXIAL * spin, MASS * GRAVITY * ARM);
    2.0 * moment / (momentum + (momentum * momentum - 4.0 * TRANSVERSE * moment * inclination.cos()).sqrt())
}

#[test]
fn fast_top_precesses_on_the_field_as_if_it_were_pinned() {
    let top = top("top", &[]);
    let (spin, inclination) = (mean(&top.spins), mean(&top.inclinations));
    println!("{spin:.2} rad/s, {:.2}°, the centre circles at {:.2e} m", inclination.to_degrees(), top.orbit);
    Answer {
        row: Some(4),
        case: "scene top, on its apex at 300 rad/s, not pinned",
        quantity: "rate of precession over 5 s [rad/s]",
        reference: pinned(spin, inclination),
        measured: top.precession,
        // The field carries the cone on its lower side, some 0.15 mm from the apex towards the vertical through the
        // centre, which is 7.7 mm away; and the tip is free to slide.
        tolerance: 0.03,
        source: "[I₃ω₃ − √(I₃²ω₃² − 4I₁mgl cosθ)]/(2I₁cosθ) of the pinned top",
    }
    .check();
    let change = largest(top.inclinations.iter().map(|angle| angle - 20_f64.to_radians()));
    assert!(change < 0.5_f64.to_radians(), "leaves its inclination by {change} rad");
    assert!(top.spins.last().is_some_and(|spin| *spin > 298.0), "{:?}", top.spins.last());
    // The tip stays while the centre circles at l sin θ.
    assert!((top.orbit / (ARM * inclination.sin()) - 1.0).abs() < 0.3, "{}", top.orbit);
    assert!(top.residual < 1e-6, "{:e}", top.residual);
}

#[test]
fn field_borne_top_tends_to_the_pinned_one_as_the_gap_shrinks() {
    let table = |law: &str, key: &str, value: f64| format!("contact.0.{law}.{key}={value:e}");
    // A tenth of the gap: α d₀^ν goes as d^(ν−2).
    let overrides = [
        table("repulsion", "alpha", 6e9),
        table("damping", "beta", 6e9),
        table("friction", "beta", 6e9),
        table("repulsion", "d0", 1e-5),
        table("damping", "d0", 1e-5),
        table("friction", "d0", 1e-5),
        format!("body.top.position=[0, 0, {}]", ARM * 20_f64.to_radians().cos() + 9.2e-6),
        "time.end=2".into(),
    ];
    let top = top("top", &overrides.each_ref().map(String::as_str));
    Answer {
        row: Some(4),
        case: "scene top with a tenth of the gap, not pinned",
        quantity: "rate of precession over 2 s [rad/s]",
        reference: pinned(mean(&top.spins), mean(&top.inclinations)),
        measured: top.precession,
        // The lever of the field is now 0.2 % short; with a tip that slides at will the rate would be 0.5 % less.
        tolerance: 0.01,
        source: "[I₃ω₃ − √(I₃²ω₃² − 4I₁mgl cosθ)]/(2I₁cosθ) of the pinned top",
    }
    .check();
}

#[test]
fn top_without_friction_keeps_its_spin_its_vertical_angular_momentum_and_its_place() {
    let overrides = ["contact.0.friction.beta=0", "contact.0.damping.beta=0", "time.end=1"];
    let run = Experiment::of_gallery("top", &overrides).run();
    let motion = Spinning::of(&run, "top");
    let across = TRANSVERSE - MASS * ARM * ARM;
    let vertical: Vec<f64> = (motion.axes().iter().zip(&motion.angular_velocities))
        .map(|(axis, omega)| across * omega.z + (AXIAL - across) * axis.dot(omega) * axis.z)
        .collect();
    let drift = |values: &[f64]| largest(values.iter().map(|value| value / values[0] - 1.0));
    let answer = |quantity, measured, source| Answer {
        row: None,
        case: "scene top without friction and damping, 1 s",
        quantity,
        reference: 0.0,
        measured,
        // rtol is 1e-8 of the speed of the rim over a run of 600 steps.
        tolerance: 1e-8,
        source,
    };
    answer("drift of the spin about the axis, relative", drift(&motion.axial_spins()), "body of revolution").check();
    answer("drift of the vertical angular momentum, relative", drift(&vertical), "vertical forces only").check();
    let place = largest(run.column("top.x").into_iter().chain(run.column("top.y")));
    answer("displacement of the centre in the plane [m]", place, "vertical forces only").check();
}

#[test]
fn slow_top_nods_precesses_faster_and_sinks() {
    let top = top("top-slow", &[]);
    let (spin, inclination) = (mean(&top.spins), mean(&top.inclinations));
    let reference = pinned(spin, inclination);
    println!("{spin:.2} rad/s: {:.4} rad/s, pinned {reference:.4} rad/s", top.precession);
    // Nearer to its threshold of 55 rad/s the two answers to the tip part: I₁ of the tip is three times that of the
    // centre.
    assert!((top.precession / reference - 1.0).abs() < 0.05);
    // It starts with its axis at rest, falls, and rises again: within 0.1 s a maximum between lower values.
    let nods = top.inclinations[..20].windows(3).any(|angles| angles[1] > angles[0] && angles[1] > angles[2]);
    assert!(nods, "{:?}", &top.inclinations[..20]);
    let (first, last) = (top.inclinations[0], top.inclinations[top.inclinations.len() - 1]);
    println!("from {:.2}° to {:.2}°", first.to_degrees(), last.to_degrees());
    assert!(last > first + 2_f64.to_radians() && last < 30_f64.to_radians(), "{last} rad");
}

#[test]
fn top_below_its_threshold_falls_on_its_side() {
    let threshold = 2.0 * (TRANSVERSE * MASS * GRAVITY * ARM).sqrt() / AXIAL;
    let top = top("top-falling", &[]);
    assert!(top.spins[0] < 0.85 * threshold, "threshold {threshold} rad/s");
    // On its wall the axis is inclined by atan(h/r).
    let side = (HEIGHT / RADIUS).atan();
    let fallen = top.inclinations.iter().position(|angle| *angle > side - 0.03);
    println!("down at sample {fallen:?}, {:.2}° at the end", top.inclinations[top.inclinations.len() - 1].to_degrees());
    assert!(fallen.is_some_and(|sample| sample <= 40), "{fallen:?}");
    assert!(top.inclinations.last().is_some_and(|angle| (angle - side).abs() < 0.02), "{:?}", top.inclinations.last());
}
