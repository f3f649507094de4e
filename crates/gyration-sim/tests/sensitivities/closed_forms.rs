//! Closed forms: free fall, a rest gap, the precession of a free top, an oscillation.

use crate::sensitivities::support::{at_end, close, scene};
use std::f64::consts::PI;

#[test]
fn free_fall_is_differentiated_exactly() {
    let text = r#"
        time = { end = 0.7, sample = 0.1 }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.1 } }
        density = 1000
        position = [0, 0, 3]
        velocity = [0.2, 0, 1]
    "#;
    let keys = [
        "world.gravity.2",
        "body.ball.position.2",
        "body.ball.velocity.2",
        "body.ball.density",
        "body.ball.velocity.0",
    ];
    let found = at_end(&scene(text, &[]), &keys, &["ball.z", "ball.vz", "energy.kinetic"]);
    let (t, g, m) = (0.7, -9.81, 1000.0 * 4e-3 * std::f64::consts::PI / 3.0);
    let vz = 1.0 + g * t;
    let kinetic = 0.5 * (0.04 + vz * vz) * m / 1000.0;
    let expected =
        [[0.5 * t * t, t, m * vz * t], [1.0, 0.0, 0.0], [t, 1.0, m * vz], [0.0, 0.0, kinetic], [0.0, 0.0, m * 0.2]];
    for (derivatives, expected) in found.derivatives.iter().zip(expected) {
        for (value, expected) in derivatives.at_end().unwrap().iter().zip(expected) {
            println!("{value:e} {expected:e}");
            // Rounding of the differences, 1e-16 of the energies over a five thousandth of what they depend on.
            assert!((value - expected).abs() < 1e-9 * expected.abs().max(1.0), "{value} {expected}");
        }
    }
}

/// mg = 2πR α d₀^ν (d^(1−ν) − (d + 2R)^(1−ν))/(ν − 1): the gap d of a sphere at rest, differentiated as it stands.
#[test]
fn the_rest_gap_of_a_sphere_changes_as_its_balance_says() {
    let text = r#"
        time = { end = 1.5, sample = 0.5 }
        [[support]]
        name = "table"
        plane = {}
        [[contact]]
        support = "table"
        repulsion = { alpha = 1e4, nu = 6, d0 = "3 mm" }
        damping = { beta = 2e5, nu = 6, d0 = "3 mm" }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.05 } }
        density = 1000
        position = [0, 0, 0.056]
    "#;
    let keys = [
        "contact.0.repulsion.alpha",
        "contact.0.repulsion.nu",
        "contact.0.repulsion.d0",
        "body.ball.density",
        "world.gravity.2",
        "body.ball.shape.sphere.radius",
        "contact.0.damping.beta",
        "body.ball.position.2",
    ];
    let found = at_end(&scene(text, &[]), &keys, &["ball.z", "ball.vz"]);
    let (alpha, nu, d0, radius): (f64, f64, f64, f64) = (1e4, 6.0, 3e-3, 0.05);
    let d = found.values[0][0] - radius;
    let far = d + 2.0 * radius;
    let sum = d.powf(1.0 - nu) - far.powf(1.0 - nu);
    let weight = 1000.0 * 4.0 / 3.0 * PI * radius.powi(3) * 9.81;
    // rtol = 1e-8, of a force that goes with the sixth power of the gap.
    close("force", 2.0 * PI * radius * alpha * d0.powf(nu) * sum / (nu - 1.0), weight, 1e-6);
    // Of ln force − ln weight.
    let by_gap = (1.0 - nu) * (d.powf(-nu) - far.powf(-nu)) / sum;
    let by_nu = d0.ln() - 1.0 / (nu - 1.0) + (far.ln() * far.powf(1.0 - nu) - d.ln() * d.powf(1.0 - nu)) / sum;
    let by_radius = -2.0 / radius - 2.0 * (1.0 - nu) * far.powf(-nu) / sum;
    let by = [1.0 / alpha, by_nu, nu / d0, -1.0 / 1000.0, 1.0 / 9.81, by_radius];
    for ((key, derivatives), by) in keys.iter().zip(&found.derivatives).zip(by) {
        let centre = if key.ends_with("radius") { 1.0 } else { 0.0 };
        close(key, derivatives.at_end().unwrap()[0], -by / by_gap + centre, 1e-6);
    }
    // Neither damping nor the start has any part in it.
    for (key, scale, derivatives) in [(6, 2e5, &found.derivatives[6]), (7, 0.056, &found.derivatives[7])] {
        let slope = derivatives.at_end().unwrap()[0];
        println!("{}: {slope:e}", keys[key]);
        assert!((slope * scale).abs() < 1e-6 * d, "{slope:e}");
    }
}

/// The axis of a free symmetric top goes round L with |L|/I₁: e₃ = e₃⁰ cos θ + (l × e₃⁰) sin θ + l (l·e₃⁰)(1 − cos θ).
#[test]
fn the_precession_of_a_free_top_changes_with_its_spin_and_form() {
    let text = r#"
        time = { end = 3, sample = 1 }
        world = { gravity = [0, 0, 0] }
        [[body]]
        name = "top"
        shape = { ellipsoid = { semi_axes = [0.1, 0.1, 0.05] } }
        density = 1000
        angular_velocity = [2, 0, 5]
    "#;
    let keys = [
        "body.top.angular_velocity.0",
        "body.top.angular_velocity.2",
        "body.top.shape.ellipsoid.semi_axes.2",
        "body.top.density",
    ];
    let found = at_end(&scene(text, &[]), &keys, &["top.P_xz", "top.P_yz", "top.P_zz"]);
    let (a, c, t): (f64, f64, f64) = (0.1, 0.05, 3.0);
    // Of a unit of mass, times five.
    let (across, along) = (a * a + c * c, 2.0 * a * a);
    let momentum = [2.0 * across, 5.0 * along];
    let size = momentum[0].hypot(momentum[1]);
    let [lx, lz] = momentum.map(|part| part / size);
    let (sine, cosine) = (size * t / across).sin_cos();
    let expected = [lx * lz * (1.0 - cosine), -lx * sine, cosine + lz * lz * (1.0 - cosine)];
    for (value, expected) in found.values[0].iter().zip(expected) {
        close("axis", *value, expected, 1e-7);
    }
    // Changes of L and of I₁ with each number.
    let changes = [([across, 0.0], 0.0), ([0.0, along], 0.0), ([2.0 * 2.0 * c, 0.0], 2.0 * c)];
    for ((key, (by, by_across)), derivatives) in keys.iter().zip(changes).zip(&found.derivatives) {
        let by_size = lx * by[0] + lz * by[1];
        let turned = t * (by_size / across - size * by_across / (across * across));
        let [by_x, by_z] = [(by[0] - lx * by_size) / size, (by[1] - lz * by_size) / size];
        let expected = [
            (by_x * lz + lx * by_z) * (1.0 - cosine) + lx * lz * sine * turned,
            -by_x * sine - lx * cosine * turned,
            -sine * turned * (1.0 - lz * lz) + 2.0 * lz * by_z * (1.0 - cosine),
        ];
        for (value, expected) in derivatives.at_end().unwrap().iter().zip(expected) {
            // rtol = 1e-8 over three turns.
            close(key, *value, expected, 1e-6);
        }
    }
    assert!(found.derivatives[3].at_end().unwrap().iter().all(|slope| slope.abs() < 1e-12));
}

/// P_xy = ε/2 (1 + e^(−δt) (cos ωt + δ/ω sin ωt)), ω² + δ² = 20 (c₁ + c₂)/(ρR²), δ = μV/(2j), of a sphere that was
/// sheared by ε.
#[test]
fn a_small_oscillation_changes_its_phase_with_stiffness_and_its_height_with_viscosity() {
    let text = r#"
        time = { end = 0.1, sample = 0.1 }
        world = { gravity = [0, 0, 0] }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.1 } }
        density = 1000
        affine = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20 }
        gradient = [[1, 1e-6, 0], [0, 1, 0], [0, 0, 1]]
    "#;
    let keys = [
        "body.ball.affine.material.mooney_rivlin.c1",
        "body.ball.affine.material.mooney_rivlin.c2",
        "body.ball.affine.viscosity",
        "body.ball.gradient.0.1",
    ];
    let found = at_end(&scene(text, &[]), &keys, &["ball.P_xy"]);
    let (amplitude, t, stiffness): (f64, f64, f64) = (1e-6, 0.1, 8000.0);
    let (delta, by_stiffness) = (5.0f64, 1.0 / 4000.0);
    let omega = (stiffness - delta * delta).sqrt();
    let ((sine, cosine), decay) = ((omega * t).sin_cos(), (-delta * t).exp());
    let height = decay * (cosine + delta / omega * sine);
    close("P_xy", found.values[0][0], 0.5 * amplitude * (1.0 + height), 1e-6);
    let by_omega = decay * (-t * sine - delta / (omega * omega) * sine + delta / omega * t * cosine);
    let by_delta = -t * height + decay * sine / omega - by_omega * delta / omega;
    let by_c = 0.5 * amplitude * by_omega * stiffness * by_stiffness / (2.0 * omega);
    let expected = [by_c, by_c, 0.5 * amplitude * by_delta * delta / 20.0, 0.5 * (1.0 + height)];
    for ((key, derivatives), expected) in keys.iter().zip(&found.derivatives).zip(expected) {
        // The start is known to rtol of the size, 1e-8 of it, and the oscillation is a hundred times as large.
        close(key, derivatives.at_end().unwrap()[0], expected, 1e-4);
    }
}

/// v = −e v₀ behind a flat impact, without gravity; `restitution` and `at_speed` are no numbers of the resolved scene.
#[test]
fn the_speed_after_an_impact_changes_with_what_is_said_of_the_contact() {
    let text = r#"
        time = { end = 0.5, sample = 0.1 }
        world = { gravity = [0, 0, 0] }
        [[support]]
        name = "table"
        plane = {}
        [[contact]]
        support = "table"
        repulsion = { alpha = 800, nu = 6, d0 = "1 mm" }
        from = { restitution = 0.7, at_speed = "2 m/s" }
        [[body]]
        name = "box"
        shape = { box = { size = [0.1, 0.1, 0.1] } }
        density = 1000
        position = [0, 0, 0.4]
        velocity = [0, 0, -2]
    "#;
    let keys = ["contact.0.from.restitution", "contact.0.from.at_speed"];
    let found = at_end(&scene(text, &[]), &keys, &["box.vz"]);
    // Damping is c = x/v₀, where x − ln(1 + x) = −y − ln(1 − y) with y = e x: at the same speed of approach it changes
    // by c/v₀, and x dx/(1 + x) = y dy/(1 − y).
    let (v, e) = (2.0, 0.7);
    close("speed", found.values[0][0], e * v, 1e-7);
    close("by restitution", found.derivatives[0].at_end().unwrap()[0], v, 1e-6);
    let x = impact_number(e);
    let y = e * x;
    // v₁ = y/c as c changes by −c/v₀ per unit of `at_speed`.
    let by_c = (x / (1.0 + x)) * ((1.0 - y) / y) * x - y;
    close("by its speed", found.derivatives[1].at_end().unwrap()[0], -by_c / x, 1e-6);
}

/// x of a restitution, by halving.
fn impact_number(e: f64) -> f64 {
    let (mut low, mut high): (f64, f64) = (1e-9, 1.0 / e);
    for _ in 0..200 {
        let x = 0.5 * (low + high);
        if x - x.ln_1p() + e * x + (-e * x).ln_1p() > 0.0 { low = x } else { high = x }
    }
    low
}
