//! Row 15: restitution with ν_d = ν_r, without gravity, in translation, for any symmetric shape.
//!
//! With u = βv/α the balance m v̇ = F(d)(1 − u) separates: v dv/(1 − u) = F dd/m, and the right side returns to its
//! value when the gap does. So with x = βv_in/α and y = βv_out/α at the same gap: x − ln(1+x) = −y − ln(1−y).

use gyration_validation::{Answer, Experiment};

struct Case {
    name: &'static str,
    shape: &'static str,
    /// Height of the centre over the lowest point [m].
    half_height: f64,
    x: f64,
    restitution: f64,
}

const CASES: [Case; 6] = [
    Case {
        name: "sphere, x = 0.1",
        shape: "{ sphere = { radius = 0.05 } }",
        half_height: 0.05,
        x: 0.1,
        restitution: 0.93747557995,
    },
    Case {
        name: "sphere, x = 10",
        shape: "{ sphere = { radius = 0.05 } }",
        half_height: 0.05,
        x: 10.0,
        restitution: 0.09998162475,
    },
    Case {
        name: "box on its face, x = 0.1",
        shape: "{ box = { size = [0.1, 0.06, 0.04] } }",
        half_height: 0.02,
        x: 0.1,
        restitution: 0.93747557995,
    },
    Case {
        name: "box on its face, x = 10",
        shape: "{ box = { size = [0.1, 0.06, 0.04] } }",
        half_height: 0.02,
        x: 10.0,
        restitution: 0.09998162475,
    },
    Case {
        name: "cylinder on its base, x = 0.1",
        shape: "{ cylinder = { radius = 0.04, height = 0.06 } }",
        half_height: 0.03,
        x: 0.1,
        restitution: 0.93747557995,
    },
    Case {
        name: "ellipsoid on its long axis, x = 10",
        shape: "{ ellipsoid = { semi_axes = [0.03, 0.04, 0.08] } }",
        half_height: 0.08,
        x: 10.0,
        restitution: 0.09998162475,
    },
];

#[test]
fn speed_ratio_of_a_bounce_depends_on_the_number_x_alone() {
    for case in CASES {
        let (alpha, speed, gap) = (1e-6, 1.0, 0.1);
        let height = case.half_height + gap;
        let scene = format!(
            r#"
            [world]
            gravity = [0, 0, 0]
            [time]
            end = 1.0
            sample = 1.0
            [solver]
            rtol = 1e-10
            atol = 1e-12
            [[support]]
            name = "table"
            plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
            [[contact]]
            support = "table"
            repulsion = {{ alpha = {alpha:e}, nu = 6 }}
            damping = {{ beta = {:e}, nu = 6 }}
            [[body]]
            name = "body"
            shape = {}
            mass = 0.5
            position = [0, 0, {height:e}]
            velocity = [0, 0, {:e}]
            "#,
            case.x * alpha / speed,
            case.shape,
            -speed
        );
        let experiment = Experiment::of_scene(&scene);
        // In and out at about uniform speed.
        let guess = gap / speed * (1.0 + 1.0 / case.restitution);
        let back = experiment.time_when(guess, |motion| motion.placement.position.z - height);
        Answer {
            row: Some(15),
            case: case.name,
            quantity: "speed after over speed before, at the same gap",
            reference: case.restitution,
            measured: experiment.motion_at(back).velocity.velocity.z / speed,
            // The list asks for 1e-6.
            tolerance: 1e-8,
            source: "x − ln(1+x) = −y − ln(1−y)",
        }
        .check();
    }
}
