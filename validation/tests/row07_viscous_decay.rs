//! Row 7: with viscosity μ a small vibration decays at δ = μV/(2j), and rings at √(ω² − δ²).
//!
//! Four samples of x = A e^−δt cos(ω_d t + φ), spaced by h, give both: x_{k+1} = 2e^−δh cos(ω_d h) x_k − e^−2δh
//! x_{k−1}. Newton's viscosity η is μ = 2η; ζ slows the breathing alone, δ = 3ζV/(2j).

use crate::soft::{self, alone, body};
use gyration::tensor::Mat3;
use gyration_validation::Case;

/// Decay rate and frequency of M·P, from samples spaced by about a fifth of a period.
fn decay(shape: &str, affine: &str, mode: &Mat3, spacing: f64) -> (f64, f64) {
    // Small enough for the terms of second order, of 1e-7, which a breathing mode has.
    let start = Mat3::identity() + 1e-7 * mode;
    let experiment = alone(&body(shape, affine, &start, &Mat3::zeros()), (1e-13, 1e-15));
    let run = experiment.until(3.0 * spacing).sampled(spacing).run();
    let x: Vec<f64> = run.matrices("placement_gradient").iter().map(|p| mode.dot(&(p - Mat3::identity()))).collect();
    // x₂ = p x₁ − q x₀ and x₃ = p x₂ − q x₁.
    let determinant = x[1] * x[1] - x[0] * x[2];
    let p = (x[1] * x[2] - x[0] * x[3]) / determinant;
    let q = (x[2] * x[2] - x[1] * x[3]) / determinant;
    (-0.5 * q.ln() / spacing, (0.5 * p / q.sqrt()).acos() / spacing)
}

#[test]
fn vibrations_decay_at_the_rate_of_the_viscosity() {
    let stretch = Mat3::from_diagonal(&[1.0, -1.0, 0.0].into());
    let soft_cube = "material = { mooney_rivlin = { c1 = 3000, c2 = 1000, bulk = 20000 } }";
    let rubber = soft::RUBBER;
    // δ = μV/(2j): 5/(2ρR²) μ of a sphere, 12/(2ρa²) μ of a cube.
    let cases = [
        ("rubber sphere, μ = 20 Pa s", soft::BALL, format!("{rubber}, viscosity = 20"), stretch, 8000.0_f64, 5.0),
        ("rubber cube, μ = 20 Pa s", soft::CUBE, format!("{rubber}, viscosity = 20"), stretch, 19200.0, 12.0),
        (
            "rubber sphere, η = 10 Pa s",
            soft::BALL,
            format!("{rubber}, internal_friction = {{ shear = 10 }}"),
            stretch,
            8000.0,
            5.0,
        ),
        (
            "breathing cube, κ = 20 kPa, ζ = 4 Pa s",
            soft::CUBE,
            format!("{soft_cube}, internal_friction = {{ bulk = 4 }}"),
            Mat3::identity(),
            72000.0,
            7.2,
        ),
    ];
    for (name, shape, affine, mode, square, rate) in cases {
        let case = Case { row: Some(7), name, source: "δ = μV/(2j)" };
        let damped = (square - rate * rate).sqrt();
        let (decay, frequency) = decay(shape, &affine, &mode, 1.2 / damped);
        // Samples err by 1e-9 of the amplitude, and δh is a twentieth; terms of second order are 1e-7.
        case.check("decay rate [1/s]", rate, decay, 1e-5);
        case.by("√(ω² − δ²)").check("frequency [rad/s]", damped, frequency, 1e-6);
    }
}
