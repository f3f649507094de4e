//! Joints that signals drive, against the integrals of these.

use gyration_validation::{Case, Experiment};
use std::f64::consts::TAU;

/// About the axis of the hinge \[kg m²\].
const INERTIA: f64 = 0.02;

/// A wheel on a hinge to space, and a block of the mass of that inertia on a slider, driven alike; for some time \[s\].
fn driven(signal: &str, end: f64) -> Experiment {
    let joint = |name: &str, kind: &str, what: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass_properties = {{ mass = {INERTIA}, \
             euler_tensor = [[{0:?}, 0, 0], [0, {0:?}, 0], [0, 0, {0:?}]] }}\n[[joint]]\nname = \"{name}-j\"\nbetween = [\"space\", \"{name}\"]\nkind = \"{kind}\"\n\
             axis = [0, 1, 0]\ndrive = {{ {what} = {signal} }}\n",
            0.5 * INERTIA
        )
    };
    Experiment::of_scene(&format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {end:?}, sample = {end:?} }}\n{}{}",
        joint("wheel", "hinge", "torque"),
        joint("block", "slider", "force")
    ))
}

/// Compares the coordinates and the work with the first and second integral of the signal over inertia.
fn check(name: &'static str, source: &'static str, signal: &str, end: f64, [rate, way]: [f64; 2], tolerance: f64) {
    let run = driven(signal, end).run();
    let case = Case { row: None, name, source };
    let last = |column: &str| *run.column(column).last().unwrap_or(&f64::NAN);
    let [rate, way] = [rate / INERTIA, way / INERTIA];
    case.check("angle of the wheel [rad]", way, last("joint.wheel-j.angle"), tolerance);
    case.check("way of the block [m]", way, last("joint.block-j.distance"), tolerance);
    case.check("velocity of the block [m/s]", rate, last("block.vy"), tolerance);
    case.by("the kinetic energy").check("work of both [J]", INERTIA * rate * rate, last("work.load"), tolerance);
}

#[test]
fn sine_drives_a_wheel_and_a_block() {
    let (amplitude, omega, phase, end) = (0.03_f64, TAU * 1.7, 0.4_f64, 0.9);
    let signal = format!("{{ sine = {{ amplitude = {amplitude:?}, frequency = 1.7, phase = {phase:?} }} }}");
    let turned = omega * end + phase;
    let rate = amplitude / omega * (phase.cos() - turned.cos());
    let way = amplitude / omega * (phase.cos() * end - (turned.sin() - phase.sin()) / omega);
    check("wheel and block driven by a sine", "∫∫ A sin(ωt + φ) dt²", &signal, end, [rate, way], 1e-11);
}

/// Edges take 1e-5 of a period: that moves no impulse, and 1e-11 of the way of a period.
#[test]
fn square_wave_drives_a_wheel_and_a_block() {
    let (amplitude, period) = (0.02_f64, 0.5_f64);
    let signal =
        format!("{{ square = {{ amplitude = {amplitude:?}, frequency = {:?}, phase = \"90 deg\" }} }}", 1.0 / period);
    // Forwards for a quarter of a period, back for a half, of which five eighths of a period see three quarters.
    let (quarter, end) = (0.25 * period, 0.625 * period);
    let back = end - 2.0 * quarter;
    let way = amplitude * (quarter * quarter - 0.5 * back * back);
    check(
        "wheel and block driven by a square wave",
        "A T²/16 − A (T/8)²/2",
        &signal,
        end,
        [-amplitude * back, way],
        1e-9,
    );
}

#[test]
fn ramp_on_a_constant_drives_a_wheel_and_a_block() {
    let (constant, rise, duration, end) = (0.01_f64, 0.03_f64, 0.4_f64, 0.7_f64);
    let ramp = format!("{{ ramp = {{ to = {rise:?}, duration = {duration:?} }} }}");
    let signal = format!("{{ sum = [{{ constant = {{ value = {constant:?} }} }}, {ramp}] }}");
    let left = end - duration;
    let rate = constant * end + rise * (0.5 * duration + left);
    let way =
        0.5 * constant * end * end + rise * (duration * duration / 6.0 + 0.5 * duration * left + 0.5 * left * left);
    check("wheel and block driven by a constant and a ramp", "B D²/6, then B t", &signal, end, [rate, way], 1e-11);
}
