//! Row 11: the force on a sphere, f = 2πRα[d^(1−ν) − (d+2R)^(1−ν)]/(ν−1) (hat-box theorem).

use gyration_validation::{Answer, Experiment};
use std::f64::consts::PI;

struct Sphere {
    case: &'static str,
    radius: f64,
    gap: f64,
    nu: f64,
}

#[test]
fn sphere_is_pushed_as_the_hat_box_theorem_says() {
    let cases = [
        Sphere { case: "sphere R = 0.1 m, d = 0.02 m, ν = 6", radius: 0.1, gap: 0.02, nu: 6.0 },
        Sphere { case: "sphere R = 0.1 m, d = 1e-6 R, ν = 6", radius: 0.1, gap: 1e-7, nu: 6.0 },
        Sphere { case: "sphere R = 1 mm, d = 0.3 R, ν = 2.5", radius: 1e-3, gap: 3e-4, nu: 2.5 },
        Sphere { case: "sphere R = 0.1 m, d = 100 R, ν = 4", radius: 0.1, gap: 10.0, nu: 4.0 },
        Sphere { case: "sphere R = 0.1 m, d = 0.05 R, ν = 1", radius: 0.1, gap: 5e-3, nu: 1.0 },
    ];
    for sphere in cases {
        let Sphere { case, radius, gap, nu } = sphere;
        let alpha = 1e-6;
        let scene = format!(
            r#"
            [time]
            end = 1.0
            sample = 1.0
            [[support]]
            name = "table"
            plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
            [[contact]]
            support = "table"
            repulsion = {{ alpha = {alpha:e}, nu = {nu} }}
            [[body]]
            name = "ball"
            shape = {{ sphere = {{ radius = {radius:e} }} }}
            mass = 1.0
            position = [0.3, -0.2, {:.17e}]
            "#,
            radius + gap
        );
        let force = Experiment::of_scene(&scene).contact_force();
        assert_eq!((force.x, force.y), (0.0, 0.0), "a central law on a level plane pushes along the normal");
        // The gap as the program has it: the difference of position and radius, rounded.
        let gap = (radius + gap) - radius;
        let logarithm = (2.0 * radius / gap).ln_1p();
        let reference = match nu == 1.0 {
            true => 2.0 * PI * radius * alpha * logarithm,
            // d^(1−ν)[1 − (1 + 2R/d)^(1−ν)], without cancellation where d ≫ R.
            false => 2.0 * PI * radius * alpha * gap.powf(1.0 - nu) * -((1.0 - nu) * logarithm).exp_m1() / (nu - 1.0),
        };
        Answer {
            row: Some(11),
            case,
            quantity: "contact force [N]",
            reference,
            measured: force.z,
            // Closed form against closed form: rounding of powers with exponents up to 6.
            tolerance: 1e-13,
            source: "2πRα[d^(1−ν) − (d+2R)^(1−ν)]/(ν−1)",
        }
        .check();
    }
}
