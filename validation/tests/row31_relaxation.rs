//! Row 31: a nearly spherical elastic particle in a fluid at rest goes back to its form as exp(−t/τ), τ = 3η/(2μ_s).
//!
//! On a sphere that deforms at a rate L the fluid has the stress −3ηL, and the stress of small strains is 2μ_s ε. With
//! larger ones the rate of ln λ differs by terms in ε and ε²; those are taken out by two amplitudes of either sign.

use gyration_validation::{Case, Experiment};

const VISCOSITY: f64 = 2.0;

/// The rate at which ln λ falls from this value on, over one τ.
fn rate(material: &str, strain: f64, tau: f64) -> f64 {
    let (long, short) = (strain.exp(), (-strain).exp());
    let experiment = Experiment::of_scene(&format!(
        r#"
        time = {{ end = {tau}, sample = {tau} }}
        solver = {{ rtol = 1e-12, atol = 1e-14 }}
        fluid = {{ viscosity = {VISCOSITY}, density = 1000 }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = 0.001 }} }}
        density = 1000
        affine = {{ material = {material} }}
        gradient = [[{long:e}, 0, 0], [0, {short:e}, 0], [0, 0, 1]]
        inclusion = {{ inertia = false }}
        "#
    ));
    let stretch = experiment.run().column("ball.P_xx")[1];
    -(stretch.ln() / strain).ln() / tau
}

#[test]
fn small_strains_relax_in_three_halves_of_viscosity_over_modulus() {
    let materials = [
        ("neo-Hookean sphere in a fluid at rest", "{ neo_hookean = { shear = 50 } }", 50.0),
        ("Mooney–Rivlin sphere in a fluid at rest", "{ mooney_rivlin = { c1 = 20, c2 = 15 } }", 70.0),
        ("compressible sphere in a fluid at rest", "{ neo_hookean_log = { mu = 40, lambda = 90 } }", 40.0),
    ];
    for (name, material, shear) in materials {
        let tau = 1.5 * VISCOSITY / shear;
        let even = |strain: f64| 0.5 * (rate(material, strain, tau) + rate(material, -strain, tau));
        let (coarse, fine) = (even(2e-3), even(1e-3));
        let case = Case { row: Some(31), name, source: "τ = 3η/(2μ_s)" };
        // ε⁴ is nothing; a strain of 1e-3 keeps nine digits at the tolerance of this run.
        case.check("rate of relaxation [1/s]", 1.0 / tau, (4.0 * fine - coarse) / 3.0, 1e-7);
    }
}

#[test]
fn a_ball_that_is_blown_up_comes_back_at_its_bulk_rate() {
    // σ = −4η ė I against 3κ e I, κ = λ + 2μ/3.
    let (mu, lambda) = (40.0, 90.0);
    let tau = 4.0 * VISCOSITY / (3.0 * lambda + 2.0 * mu);
    let rate = |strain: f64| {
        let stretch = strain.exp();
        let experiment = Experiment::of_scene(&format!(
            r#"
            time = {{ end = {tau}, sample = {tau} }}
            solver = {{ rtol = 1e-12, atol = 1e-14 }}
            fluid = {{ viscosity = {VISCOSITY}, density = 0 }}
            world = {{ gravity = [0, 0, 0] }}
            [[body]]
            name = "ball"
            shape = {{ sphere = {{ radius = 0.001 }} }}
            density = 1000
            affine = {{ material = {{ neo_hookean_log = {{ mu = {mu}, lambda = {lambda} }} }} }}
            gradient = [[{stretch:e}, 0, 0], [0, {stretch:e}, 0], [0, 0, {stretch:e}]]
            inclusion = {{ inertia = false }}
            "#
        ));
        let stretch = experiment.run().column("ball.P_xx")[1];
        -(stretch.ln() / strain).ln() / tau
    };
    let even = |strain: f64| 0.5 * (rate(strain) + rate(-strain));
    let case =
        Case {
            row: Some(31), name: "compressible sphere blown up, in a fluid at rest", source: "τ = 4η/(3λ + 2μ)"
        };
    case.check("rate of return [1/s]", 1.0 / tau, (4.0 * even(1e-3) - even(2e-3)) / 3.0, 1e-7);
}
