//! Row 11 with bodies that deform: the force on a sphere, f(R) = 2πRα[d^(1−ν) − (d+2R)^(1−ν)]/(ν−1).
//!
//! Undeformed it is the same in all three measures; on a sphere that is blown up to λR, `deformed_area` gives f(λR),
//! and `reference_area` f(λR)/λ².

use crate::soft;
use gyration::tensor::Mat3;
use gyration_validation::{Case, Experiment};
use std::f64::consts::PI;

/// The force on a sphere of R = 0.1 m, all of it stretched by λ, at a gap of 2 cm.
fn force(measure: &str, stretch: f64) -> f64 {
    let height = 0.1 * stretch + 0.02;
    let gradient = soft::entry("gradient", &(stretch * Mat3::identity()));
    let experiment = Experiment::of_scene(&format!(
        r#"
        time = {{ end = 1, sample = 1 }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        measure = "{measure}"
        repulsion = {{ alpha = 1e-6, nu = 6 }}
        [[body]]
        name = "ball"
        {}
        mass = 1
        affine = {{}}
        position = [0.3, -0.2, {height:e}]
        {gradient}
        "#,
        soft::BALL
    ));
    experiment.contact_force().z
}

#[test]
fn blown_up_sphere_is_pushed_as_one_of_its_own_radius() {
    let case = Case {
        row: Some(11),
        name: "affine sphere R = 0.1 m, d = 0.02 m, ν = 6",
        source: "2πλRα[d^(1−ν) − (d+2λR)^(1−ν)]/(ν−1)",
    };
    let closed = |radius: f64| 2.0 * PI * radius * 1e-6 * (0.02_f64.powi(-5) - (0.02 + 2.0 * radius).powi(-5)) / 5.0;
    // The difference of position and radius is rounded: 1e-16 of 0.1 m, times ν of 0.02 m.
    let tolerance = 1e-12;
    case.check("force at P = I, deformed_area [N]", closed(0.1), force("deformed_area", 1.0), tolerance);
    case.check("force at P = I, reference_area [N]", closed(0.1), force("reference_area", 1.0), tolerance);
    let potential = force("deformed_area_potential", 1.0);
    case.check("force at P = I, deformed_area_potential [N]", closed(0.1), potential, tolerance);
    case.check("force at P = 1.5 I, deformed_area [N]", closed(0.15), force("deformed_area", 1.5), tolerance);
    let reference = force("reference_area", 1.5) * 2.25;
    case.check("force at P = 1.5 I, reference_area, times λ² [N]", closed(0.15), reference, tolerance);
}
