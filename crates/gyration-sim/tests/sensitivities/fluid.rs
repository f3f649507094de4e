//! Bodies in a fluid: without inertia, with memory, with a resistance by boundary elements.

use crate::sensitivities::support::{TIGHT, at_end, close, disagreement, scene, strings};

/// The first quantity by each of the numbers.
fn first(found: &gyration_sim::sensitivity::Sensitivities) -> Vec<f64> {
    found.derivatives.iter().map(|derivatives| derivatives.at_end().unwrap()[0]).collect()
}

/// v = 2 (ρ − ρ_f) g R²/(9 η).
#[test]
fn a_sinking_sphere_changes_its_speed_as_stokes_says() {
    let text = r#"
        time = { end = 2, sample = 1 }
        fluid = { viscosity = 1.4, density = 1260 }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = "2 mm" } }
        density = 2500
        inclusion = { inertia = false }
    "#;
    let keys =
        ["fluid.viscosity", "body.ball.density", "fluid.density", "world.gravity.2", "body.ball.shape.sphere.radius"];
    let found = at_end(&scene(text, &[]), &keys, &["ball.z"]);
    let way = -2.0 * 2.0 * (2500.0 - 1260.0) * 9.81 * 4e-6 / (9.0 * 1.4);
    let expected = [-way / 1.4, way / 1240.0, -way / 1240.0, way / -9.81, 2.0 * way / 2e-3];
    for ((key, derivative), expected) in keys.iter().zip(first(&found)).zip(expected) {
        // Differences in steps of 1e-4: their rounding.
        close(key, derivative, expected, 1e-10);
    }
}

/// tan φ = −tan s/r, s = γ t r/(r² + 1), of an axis that starts along the flow.
#[test]
fn the_phase_of_a_jeffery_orbit_changes_with_shear_and_axis_ratio() {
    let text = r#"
        time = { end = 13, sample = 1 }
        fluid = { viscosity = 1.4, density = 1260, velocity_gradient = [[0, 0, 1], [0, 0, 0], [0, 0, 0]] }
        [[body]]
        name = "grain"
        shape = { ellipsoid = { semi_axes = ["6 mm", "2 mm", "2 mm"] } }
        density = 1260
        inclusion = { inertia = false }
    "#;
    let keys = ["fluid.velocity_gradient.0.2", "body.grain.shape.ellipsoid.semi_axes.0", "fluid.viscosity"];
    let found = at_end(&scene(text, &[]), &keys, &["grain.P_xx", "grain.P_zx"]);
    let (r, t): (f64, f64) = (3.0, 13.0);
    let s = t * r / (r * r + 1.0);
    let phase = -s.sin().atan2(r * s.cos());
    close("cos φ", found.values[0][0], phase.cos(), 1e-7);
    close("sin φ", found.values[0][1], phase.sin(), 1e-7);
    let by_shear = -t * ((r * phase.sin()).powi(2) + phase.cos().powi(2)) / (r * r + 1.0);
    let s_by_ratio = t * (1.0 - r * r) / (r * r + 1.0).powi(2);
    let by_ratio = phase.cos().powi(2) * (s.tan() / (r * r) - s_by_ratio / (r * s.cos().powi(2)));
    for (by_number, derivatives) in [by_shear, by_ratio / 2e-3].into_iter().zip(&found.derivatives) {
        let slopes = derivatives.at_end().unwrap();
        // rtol = 1e-8 in a hundred steps.
        close("cos φ", slopes[0], -phase.sin() * by_number, 1e-6);
        close("sin φ", slopes[1], phase.cos() * by_number, 1e-6);
    }
    // The viscosity does not matter.
    assert!(found.derivatives[2].at_end().unwrap().iter().all(|slope| slope.abs() < 1e-9));
}

#[test]
fn a_soft_ball_in_a_shear_flow_agrees_with_differences_of_runs() {
    let text = r#"
        time = { end = 0.5, sample = 0.1 }
        fluid = { viscosity = 10, density = 1000, velocity_gradient = [[0, 0, 5], [0, 0, 0], [0, 0, 0]] }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = "5 mm" } }
        density = 1100
        affine = { material = { neo_hookean = { shear = 166.7 } }, viscosity = 3 }
        inclusion = { inertia = false }
    "#;
    let keys = [
        "fluid.viscosity",
        "fluid.velocity_gradient.0.2",
        "body.ball.affine.material.neo_hookean.shear",
        "body.ball.affine.viscosity",
        "body.ball.shape.sphere.radius",
    ];
    let quantities = ["ball.z", "ball.P_xx", "ball.P_xz", "energy.elastic", "work.fluid", "work.viscosity"];
    let worst = disagreement(text, &strings(&TIGHT), &keys, &quantities, 1e-3);
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn a_muscle_without_inertia_agrees_with_differences_of_runs() {
    let text = r#"
        time = { end = 0.2, sample = 0.1 }
        world = { gravity = [0, 0, 0] }
        fluid = { viscosity = 0.5 }
        [[body]]
        name = "three"
        shape = { ellipsoid = { semi_axes = ["6 mm", "4 mm", "4 mm"] } }
        density = 1000
        inclusion = { inertia = false }
        [body.contractile]
        material = { neo_hookean = { shear = 100 } }
        contraction_viscosity = 1
        prescribed = { sum = [
            { constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } },
            { sine = { amplitude = [[0.1, 0, 0.17], [0, 0, 0], [0.17, 0, 0.3]], frequency = 3, phase = 1 } } ] }
    "#;
    let keys = [
        "fluid.viscosity",
        "body.three.contractile.material.neo_hookean.shear",
        "body.three.contractile.prescribed.sum.1.sine.frequency",
    ];
    let worst = disagreement(text, &strings(&TIGHT), &keys, &["three.P_xx", "three.P_xz"], 2e-4);
    assert!(worst < 1e-7, "{worst:e}");
}

/// The way of a body of any shape goes with 1/η, and with the weight that the fluid leaves it.
#[test]
fn a_sinking_box_changes_its_speed_as_dimensions_say() {
    let text = r#"
        time = { end = 2, sample = 1 }
        fluid = { viscosity = 1.4, density = 1260 }
        [[body]]
        name = "box"
        shape = { box = { size = ["6 mm", "4 mm", "4 mm"] } }
        density = 2500
        inclusion = { inertia = false, triangles = 100 }
    "#;
    let sizes = [0, 1, 2].map(|axis| format!("body.box.shape.box.size.{axis}"));
    let keys = ["fluid.viscosity", "body.box.density", &sizes[0], &sizes[1], &sizes[2]];
    let found = at_end(&scene(text, &[]), &keys, &["box.z"]);
    let (way, slopes) = (found.values[0][0], first(&found));
    // The elements are not quite symmetric: the box turns by 1e-6 on its way.
    close("viscosity", slopes[0], -way / 1.4, 1e-7);
    close("density", slopes[1], way / 1240.0, 1e-7);
    // The speed is homogeneous of degree two in the lengths.
    let by_size = slopes[2] * 6e-3 + slopes[3] * 4e-3 + slopes[4] * 4e-3;
    // The quadrature of the elements is chosen by the form: the matrix jumps by 1e-6 here and there, and steps of a
    // hundredth leave four digits.
    close("sizes", by_size, 2.0 * way, 1e-4);
}

#[test]
fn a_soft_sphere_that_the_fluid_remembers_agrees_with_differences_of_runs() {
    let text = r#"
        time = { end = 5e-3, sample = 5e-3 }
        world = { gravity = [0, 0, -9.81] }
        fluid = { viscosity = 1, density = 1260, velocity_gradient = [[0, 3, 0], [1, 0, 0], [0, 0, 0]] }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = "2 mm" } }
        density = 2800
        affine = { material = { neo_hookean = { shear = 800, bulk = 900 } } }
        velocity = [0.1, 0, 0]
        angular_velocity = [0, 0, 3]
        inclusion = { history = true, history_error = 1e-2 }
    "#;
    let keys = ["body.ball.density", "body.ball.velocity.0", "fluid.velocity_gradient.0.1"];
    let quantities = ["ball.x", "ball.z", "ball.vx", "ball.P_xx", "ball.P_xy"];
    let worst = disagreement(text, &strings(&["solver.rtol=1e-9", "solver.atol=1e-11"]), &keys, &quantities, 1e-3);
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn a_sphere_that_the_fluid_remembers_agrees_with_differences_of_runs() {
    let text = r#"
        time = { end = 5e-3, sample = 5e-3 }
        world = { gravity = [0, 0, -9.81] }
        fluid.viscosity = 1
        fluid.density = 1260
        fluid.velocity = [0.02, 0, 0]
        # It turns; a neighbour strains as well.
        fluid.velocity_gradient = [[0, -3, 0], [3, 0, 0], [0, 0, 0]]
        [[body]]
        name = "ball"
        shape = { sphere = { radius = "2 mm" } }
        density = 7800
        velocity = [0.1, 0, 0]
        angular_velocity = [0, 0, 30]
        inclusion = { history = true, history_error = 1e-3 }
    "#;
    let flow = ["fluid.velocity.0", "fluid.velocity_gradient.0.1"];
    let keys = ["body.ball.density", "body.ball.velocity.0", "world.gravity.2"].into_iter().chain(flow);
    let keys: Vec<&str> = keys.collect();
    let quantities = ["ball.x", "ball.z", "ball.vx", "ball.vz", "ball.P_xy"];
    let worst = disagreement(text, &strings(&["solver.rtol=1e-9", "solver.atol=1e-11"]), &keys, &quantities, 1e-3);
    assert!(worst < 1e-6, "{worst:e}");
}
