//! Row 22: a rattleback, an ellipsoid whose axes of inertia are turned a little against its axes of curvature.
//!
//! One sense of spin feeds its pitching and reverses; the other does not; I_xy → −I_xy is a mirror and exchanges them.
//! Without spin, and rolling without slip, it pitches and rolls about the lowest point of its axes with
//!
//!   ω² = m g (ϱ − h)/(I + m h²),   ϱ = a²/c, I = I_yy for pitching;   ϱ = b²/c, I = I_xx for rolling,
//!
//! h = 0.01 m the height of its centre of mass. Source of the phenomenon: G. T. Walker, Quart. J. Pure Appl. Math. 28
//! (1896) 175.

use crate::spinning::{Spinning, falls_to};
use gyration_validation::{Answer, Experiment, largest};

const ROW: Option<u32> = Some(22);
/// J_xy = −I_xy [kg m²].
const PRODUCT: f64 = 2e-5;
/// Spin at the start [rad/s].
const SPIN: f64 = 5.0;

/// The stone with a product J_xy [kg m²], an orientation and an angular velocity [rad/s].
///
/// Friction is strong, so that it rolls; the gap is small, since the rubbing of a patch of the width √(ϱ d) eats the
/// spin at the rate (β/α) m g (ϱ d/(ν−2))/I_zz.
fn stone(product: f64, orientation: &str, angular_velocity: [f64; 3], end: f64) -> Experiment {
    let [x, y, z] = angular_velocity;
    Experiment::of_scene(&format!(
        r#"
        [time]
        end = {end}
        sample = 0.002
        [solver]
        rtol = 1e-6
        method = "implicit"
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 1e6, nu = 12, d0 = 1e-6 }}
        damping = {{ beta = 2e8, nu = 12, d0 = 1e-6 }}
        friction = {{ beta = 3e8, nu = 12, d0 = 1e-6 }}
        [[body]]
        name = "stone"
        shape = {{ ellipsoid = {{ semi_axes = [0.20, 0.03, 0.02] }} }}
        position = [0, 0, 0.0100007]
        orientation = {{ axis_angle = {orientation} }}
        angular_velocity = [{x:e}, {y:e}, {z:e}]
        [body.mass_properties]
        mass = 1.0
        center = [0, 0, -0.01]
        euler_tensor = [[1.55e-3, {product:e}, 0], [{product:e}, 1.5e-4, 0], [0, 0, 5e-5]]
        "#
    ))
}

#[test]
fn stone_without_spin_pitches_and_rolls_at_the_frequencies_of_rolling() {
    // m g (ϱ − h)/(I + m h²), about the lowest point.
    let frequency = |radius: f64, inertia: f64| (9.81 * (radius - 0.01) / (inertia + 1e-4)).sqrt();
    let cases = [
        (
            "rattleback without spin, J_xy = 0",
            "pitching frequency [rad/s]",
            "[0, 1, 0]",
            (2, 0),
            1e-4,
            frequency(2.0, 1.6e-3),
        ),
        (
            "rattleback without spin, J_xy = 0",
            "rolling frequency [rad/s]",
            "[1, 0, 0]",
            (2, 1),
            1e-3,
            frequency(0.045, 2e-4),
        ),
    ];
    for (case, quantity, axis, entry, angle, reference) in cases {
        let orientation = format!("{{ axis = {axis}, angle = {angle:e} }}");
        let experiment = stone(0.0, &orientation, [0.0; 3], 1.0);
        // Level after a quarter and three quarters of a period: half a period between them.
        let quarter = 0.5 * std::f64::consts::PI / reference;
        let [first, second] =
            [1.0, 3.0].map(|count| experiment.time_when(count * quarter, |motion| motion.placement.gradient[entry]));
        let measured = std::f64::consts::PI / (second - first);
        let source = "m g (ϱ−h)/(I + m h²), ϱ = a²/c or b²/c";
        Answer { row: ROW, case, quantity, reference, measured, tolerance: 1e-3, source }.check();
    }
}

/// The spin about the vertical and the largest pitch.
struct Spun {
    times: Vec<f64>,
    spins: Vec<f64>,
    pitches: Vec<f64>,
    residual: f64,
}

/// Spins the stone, pitching a little, and follows it.
fn spun(product: f64, spin: f64, end: f64) -> Spun {
    let run = stone(product, "{ axis = [0, 0, 1], angle = 0 }", [0.0, 0.5, spin], end).run();
    let spins = Spinning::of(&run, "stone").vertical_spins();
    let residual = run.relative_residual();
    Spun { spins, pitches: run.column("stone.P_zx"), residual, times: run.times }
}

#[test]
fn stone_reverses_from_one_sense_of_spin_and_a_flipped_product_exchanges_them() {
    let end = 2.7;
    let clockwise = spun(PRODUCT, -SPIN, end);
    let mirrored = spun(-PRODUCT, SPIN, end);
    let speeds: Vec<f64> = clockwise.spins.iter().map(|spin| -spin).collect();
    let reversal = falls_to(&clockwise.times, &speeds, 0.0);
    let reversal = reversal.unwrap_or_else(|| panic!("still spinning at {:?} rad/s", clockwise.spins.last()));
    println!("spin −5 rad/s stops at {reversal:.4} s, {:?} rad/s at {end} s", clockwise.spins.last());
    let pitch = |spun: &Spun| largest(spun.pitches.iter().copied());
    println!("largest pitch {:.4} rad, residual {:.1e}", pitch(&clockwise), clockwise.residual);
    // The spin has gone into pitching, and comes back the other way.
    assert!(clockwise.spins.last().is_some_and(|spin| *spin > 0.2), "{:?}", clockwise.spins.last());
    let stop = falls_to(&mirrored.times, &mirrored.spins, 0.0);
    Answer {
        row: ROW,
        case: "rattleback, spin +5 and J_xy = −2e-5 against spin −5 and J_xy = +2e-5",
        quantity: "time of the reversal [s]",
        reference: reversal,
        measured: stop.unwrap_or(f64::NAN),
        // A mirror image to rounding, which the motion magnifies, and to the errors of the steps.
        tolerance: 1e-5,
        source: "mirror image in the plane of x and z",
    }
    .check();
    assert!(clockwise.residual < 1e-4 && mirrored.residual < 1e-4);
}

#[test]
fn stone_goes_on_in_the_other_sense_of_spin() {
    for (product, spin) in [(PRODUCT, SPIN), (-PRODUCT, -SPIN)] {
        let spun = spun(product, spin, 2.0);
        let turning: Vec<f64> = spun.spins.iter().map(|value| value * spin.signum()).collect();
        let slowest = turning.iter().copied().fold(f64::INFINITY, f64::min);
        let pitch = |from: f64, to: f64| {
            let within = spun.times.iter().zip(&spun.pitches).filter(|(time, _)| **time >= from && **time < to);
            largest(within.map(|(_, pitch)| *pitch))
        };
        let (first, last) = (pitch(0.0, 0.3), pitch(1.7, 2.0));
        println!("J_xy = {product:e}, spin {spin}: never below {slowest:.3} rad/s; pitch {first:.1e} → {last:.1e} rad");
        // Only the rubbing of the patch slows it; its pitching dies out.
        assert!(slowest > 0.4 * SPIN, "slowed down to {slowest} rad/s");
        assert!(last < 0.1 * first, "pitching from {first} to {last} rad");
    }
}
