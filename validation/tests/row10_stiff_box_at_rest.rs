//! Row 10 with bodies that deform: a box at rest on the field.
//!
//! A box of rubber sags, and its base spreads: its gap at rest is off that of the rigid one by something that goes as
//! 1/stiffness, so that twice the result at twice the stiffness, less the result, is the rigid one.

use gyration_validation::{Case, Experiment};

const REST_GAP: f64 = 0.0292715643344;

/// Gap at rest of a box of c₁ + c₂ = `stiffness` [Pa].
fn rest_gap(measure: &str, stiffness: f64) -> f64 {
    // The viscosity keeps the damping ratio of the vibrations at about one half.
    let viscosity = 2e3 * (stiffness / 1e6).sqrt();
    let (c1, c2, height) = (0.75 * stiffness, 0.25 * stiffness, REST_GAP + 0.1);
    let experiment = Experiment::of_scene(&format!(
        r#"
        time = {{ end = 0.5, sample = 0.5 }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        measure = "{measure}"
        repulsion = {{ alpha = 1e-6, nu = 6 }}
        damping = {{ beta = 1e-5, nu = 6 }}
        [[body]]
        name = "box"
        shape = {{ box = {{ size = [0.1, 0.1, 0.2] }} }}
        mass = 2.0
        affine = {{ material = {{ mooney_rivlin = {{ c1 = {c1:e}, c2 = {c2:e} }} }}, viscosity = {viscosity:e} }}
        position = [0, 0, {height:e}]
        "#
    ));
    experiment.run().column("box.gap")[1]
}

#[test]
fn stiff_box_tends_to_the_rest_gap_of_the_rigid_one() {
    let cases = [
        ("stiff box at rest, deformed_area", "deformed_area"),
        ("stiff box at rest, reference_area", "reference_area"),
        ("stiff box at rest, deformed_area_potential", "deformed_area_potential"),
    ];
    for (name, measure) in cases {
        let case = Case { row: Some(10), name, source: "row 10, and 1/stiffness" };
        let [soft, stiff] = [1e6, 2e6].map(|stiffness| rest_gap(measure, stiffness));
        let [off, less] = [soft, stiff].map(|gap| gap / REST_GAP - 1.0);
        println!("{name}: relative deviation at 1 and 2 MPa {off:.3e}, {less:.3e}");
        case.check("gap at rest of c₁ + c₂ = 2 MPa [m]", REST_GAP, stiff, 1e-3);
        case.check("deviation, stiffness over twice it", 2.0, off / less, 1e-2);
        // What is left is of second order in the deviation.
        case.check("gap at rest in the limit, from two stiffnesses [m]", REST_GAP, 2.0 * stiff - soft, 1e-6);
    }
}
