//! Row 16: ν_f = ν_r, a body that slides without turning.
//!
//! Then friction is (β/α) × pressure × velocity at every point: on a slope θ the speed tends to (α/β) tan θ with the
//! time constant α/(βg cos θ), whatever the mass and the shape; on the level it decays as exp(−βgt/α). The body is kept
//! from turning by moments of inertia that no such body has; it starts at the gap that carries it.

use gyration_validation::{Answer, Case as Known, Experiment};

const ROW: Option<u32> = Some(16);
const ALPHA: f64 = 1e-6;
const BETA: f64 = 4e-6;
const GRAVITY: f64 = 9.81;

struct Case {
    name: &'static str,
    shape: &'static str,
    half_height: f64,
    mass: f64,
    slope: f64,
}

const CASES: [Case; 3] = [
    Case {
        name: "box of 2 kg on a slope of 0.3",
        shape: "{ box = { size = [0.1, 0.08, 0.04] } }",
        half_height: 0.02,
        mass: 2.0,
        slope: 0.3,
    },
    Case {
        name: "box of 50 g on a slope of 0.3",
        shape: "{ box = { size = [0.1, 0.08, 0.04] } }",
        half_height: 0.02,
        mass: 0.05,
        slope: 0.3,
    },
    Case {
        name: "ball of 1 kg on a slope of 0.6",
        shape: "{ sphere = { radius = 0.05 } }",
        half_height: 0.05,
        mass: 1.0,
        slope: 0.6,
    },
];

/// A body at a gap on a slope about y, downhill towards +x, sliding at `speed`.
fn scene(case: &Case, gap: f64, speed: f64) -> Experiment {
    let (sin, cos) = case.slope.sin_cos();
    let height = case.half_height + gap;
    Experiment::of_scene(&format!(
        r#"
        [time]
        end = 1.0
        sample = 1.0
        [solver]
        rtol = 1e-10
        atol = 1e-12
        [[support]]
        name = "slope"
        plane = {{ origin = [0, 0, 0], normal = [{sin:.17e}, 0, {cos:.17e}] }}
        [[contact]]
        support = "slope"
        repulsion = {{ alpha = {ALPHA:e}, nu = 6 }}
        friction = {{ beta = {BETA:e}, nu = 6 }}
        [[body]]
        name = "body"
        shape = {}
        mass_properties = {{ mass = {}, euler_tensor = [[1e9, 0, 0], [0, 1e9, 0], [0, 0, 1e9]] }}
        position = [{:.17e}, 0, {:.17e}]
        orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = {:.17e} }} }}
        velocity = [{:.17e}, 0, {:.17e}]
        "#,
        case.shape,
        case.mass,
        height * sin,
        height * cos,
        case.slope,
        speed * cos,
        -speed * sin,
    ))
}

/// The gap at which repulsion carries the body across the slope, by secants in the logarithm.
fn carrying_gap(case: &Case) -> f64 {
    let weight = case.mass * GRAVITY * case.slope.cos();
    let excess = |log: f64| {
        let force = scene(case, log.exp(), 0.0).contact_force();
        (force.norm() / weight).ln()
    };
    let (mut before, mut now) = (0.02_f64.ln(), 0.025_f64.ln());
    for _ in 0..30 {
        let (a, b) = (excess(before), excess(now));
        if b.abs() < 1e-15 || a == b {
            break;
        }
        (before, now) = (now, now - b * (now - before) / (b - a));
    }
    now.exp()
}

fn downhill_speed(experiment: &Experiment, slope: f64, time: f64) -> f64 {
    let velocity = experiment.motion_at(time).velocity.velocity;
    velocity.x * slope.cos() - velocity.z * slope.sin()
}

#[test]
fn body_slides_down_a_slope_at_a_speed_without_mass_and_shape() {
    for case in CASES {
        let experiment = scene(&case, carrying_gap(&case), 0.0);
        let terminal = ALPHA / BETA * case.slope.tan();
        let constant = ALPHA / (BETA * GRAVITY * case.slope.cos());
        let source = "v = (α/β) tan θ (1 − exp(−βg cos θ t/α))";
        let known = Known { row: ROW, name: case.name, source };
        // rtol = 1e-10; the torque of friction turns the body by less than 1e-9 meanwhile.
        let tolerance = 1e-8;
        let late = downhill_speed(&experiment, case.slope, 30.0 * constant);
        known.check("terminal speed [m/s]", terminal, late, tolerance);
        let early = downhill_speed(&experiment, case.slope, constant);
        known.check("time constant [s]", constant, -constant / (1.0 - early / terminal).ln(), tolerance);
    }
}

#[test]
fn body_on_the_level_loses_its_speed_exponentially() {
    let case = Case { name: "box on the level", slope: 0.0, ..CASES[0] };
    let experiment = scene(&case, carrying_gap(&case), 0.7);
    let time = 0.1;
    Answer {
        row: ROW,
        case: case.name,
        quantity: "speed after 0.1 s from 0.7 m/s [m/s]",
        reference: 0.7 * (-BETA * GRAVITY * time / ALPHA).exp(),
        measured: downhill_speed(&experiment, 0.0, time),
        tolerance: 1e-8,
        source: "v = v₀ exp(−βgt/α)",
    }
    .check();
}
