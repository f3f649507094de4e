//! Row 3: a free rigid body with I = (1, 2, 3) kg m² and ω₀ = (0.3, 0.2, 1) rad/s.
//!
//! Its angular velocity in body axes is periodic with 4K(k)/p, k² = 0.04276315789; momentum and energy stay.

use gyration::state::BodyMotion;
use gyration::tensor::Vec3;
use gyration_validation::{Answer, Experiment, largest};

// J = ½ tr(I) 1 − I.
const SCENE: &str = r#"
    [world]
    gravity = [0, 0, 0]
    [time]
    end = 60.0
    sample = 0.5
    [solver]
    rtol = 1e-12
    atol = 1e-13
    [[body]]
    name = "body"
    mass_properties = { mass = 1.0, euler_tensor = [[2, 0, 0], [0, 1, 0], [0, 0, 0]] }
    angular_velocity = [0.3, 0.2, 1.0]
"#;

const SOURCE: &str = "Euler's equations, 4K(k)/p with k² = 0.04276315789";
const ROW: Option<u32> = Some(3);
const CASE: &str = "free rigid body, I = (1, 2, 3), ω₀ = (0.3, 0.2, 1)";

/// Ω in body axes [rad/s].
fn spin(motion: &BodyMotion) -> Vec3 {
    motion.placement.gradient.tr_mul(&motion.angular_velocity())
}

#[test]
fn free_body_repeats_its_spin_after_a_period() {
    const PERIOD: f64 = 6.310094905947;
    const PERIODS: f64 = 5.0;
    let experiment = Experiment::of_scene(SCENE);
    // Ω₂ crosses its first value upward once a period.
    let time = experiment.time_when(PERIODS * 6.3, |motion| spin(motion).y - 0.2);
    Answer {
        row: ROW,
        case: CASE,
        quantity: "period of the angular velocity in body axes [s]",
        reference: PERIOD,
        measured: time / PERIODS,
        // The tolerance of the list; the reference has 13 digits.
        tolerance: 1e-9,
        source: SOURCE,
    }
    .check();
    let spin = spin(&experiment.motion_at(PERIODS * PERIOD));
    Answer {
        row: ROW,
        case: CASE,
        quantity: "distance of Ω from its start after 5 periods [rad/s]",
        reference: 0.0,
        measured: (spin - Vec3::new(0.3, 0.2, 1.0)).norm(),
        tolerance: 1e-9,
        source: SOURCE,
    }
    .check();
}

#[test]
fn free_body_keeps_momentum_and_energy() {
    let run = Experiment::of_scene(SCENE).run();
    let energy = run.column("energy.kinetic");
    let drift = largest(energy.iter().map(|value| value / energy[0] - 1.0));
    Answer {
        row: ROW,
        case: CASE,
        quantity: "drift of kinetic energy over 60 s, relative",
        reference: 0.0,
        measured: drift,
        // Some 100 steps that err by 1e-12 each.
        tolerance: 1e-10,
        source: "conservation of energy",
    }
    .check();
    let components = ["body.P_xx", "body.P_xy", "body.P_xz", "body.P_yx", "body.P_yy", "body.P_yz"];
    let rows = components.map(|name| run.column(name));
    let orthogonality = largest((0..run.times.len()).map(|k| {
        let row = |i: usize| [rows[i][k], rows[i + 1][k], rows[i + 2][k]];
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        dot(row(0), row(3)).abs() + (dot(row(0), row(0)) - 1.0).abs()
    }));
    Answer {
        row: ROW,
        case: CASE,
        quantity: "departure of P from a rotation over 60 s",
        reference: 0.0,
        measured: orthogonality,
        // P is made from the direction of a quaternion: rounding only.
        tolerance: 1e-14,
        source: "P is a rotation",
    }
    .check();
}
