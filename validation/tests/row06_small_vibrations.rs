//! Row 6: small vibrations of elastic bodies, amplitude 1e-5.
//!
//!   sphere ω² = 20(c₁+c₂)/(ρR²), five-fold;   cube ω² = 48(c₁+c₂)/(ρa²)
//!   any body, shear in the plane of two principal axes of J: ω² = 2(c₁+c₂)V(1/J_i + 1/J_j)
//!   breathing of a compressible sphere or cube, J = jI: ω² = 3κV/j with the bulk modulus κ at rest
//!
//! A body starts at rest with P = I + a M. After ten periods T of the reference the phase of x = M·P tells the
//! frequency: x = A cos ωt at t = 10T, φ = atan2(−ẋ/ω, x), ω = (20π + φ)/t. The period of a large vibration differs by
//! a² only.

use crate::soft::{self, alone, body};
use gyration::tensor::Mat3;
use gyration_validation::{Case, Experiment};
use std::f64::consts::TAU;

const AMPLITUDE: f64 = 1e-5;
const PERIODS: f64 = 10.0;
/// The tolerance of the list.
const TOLERANCE: f64 = 1e-6;
/// A step may err by a tenth of the sum, 1e-9 of the amplitude.
const PRECISE: (f64, f64) = (1e-13, 1e-14);
const BRICK: &str = "shape = { box = { size = [0.1, 0.2, 0.15] } }";

fn vibrating(shape: &str, affine: &str, mode: &Mat3) -> Experiment {
    alone(&body(shape, affine, &(Mat3::identity() + AMPLITUDE * mode), &Mat3::zeros()), PRECISE)
}

/// The frequency of the coordinate M·P [rad/s], by its phase after ten periods of a frequency near it.
fn frequency(experiment: &Experiment, mode: &Mat3, near: f64) -> f64 {
    let time = PERIODS * TAU / near;
    let motion = experiment.motion_at(time);
    let place = mode.dot(&(motion.placement.gradient - Mat3::identity()));
    let rate = mode.dot(&motion.velocity.gradient_rate);
    (PERIODS * TAU + (-rate / near).atan2(place)) / time
}

/// e_i ⊗ e_j + e_j ⊗ e_i.
fn shear(i: usize, j: usize) -> Mat3 {
    let mut mode = Mat3::zeros();
    (mode[(i, j)], mode[(j, i)]) = (1.0, 1.0);
    mode
}

/// The five modes without change of volume.
fn modes() -> [(&'static str, Mat3); 5] {
    let diagonal = |x, y, z| Mat3::from_diagonal(&[x, y, z].into());
    [
        ("frequency, stretch along x and y [rad/s]", diagonal(1.0, -1.0, 0.0)),
        ("frequency, stretch along z [rad/s]", diagonal(-0.5, -0.5, 1.0)),
        ("frequency, shear in the plane yz [rad/s]", shear(1, 2)),
        ("frequency, shear in the plane xz [rad/s]", shear(0, 2)),
        ("frequency, shear in the plane xy [rad/s]", shear(0, 1)),
    ]
}

#[test]
fn sphere_and_cube_ring_at_one_frequency_in_five_modes() {
    let sphere = Case { row: Some(6), name: "rubber sphere, R = 0.1 m", source: "ω² = 20(c₁+c₂)/(ρR²)" };
    let cube = Case { row: Some(6), name: "rubber cube, a = 0.1 m", source: "ω² = 48(c₁+c₂)/(ρa²)" };
    // The list has ten digits.
    for (case, shape, omega, listed) in
        [(sphere, soft::BALL, 8000.0_f64.sqrt(), 89.442719100), (cube, soft::CUBE, 19200.0_f64.sqrt(), 138.5640646)]
    {
        assert!((omega / listed - 1.0_f64).abs() < 1e-9, "{omega}");
        for (quantity, mode) in modes() {
            let measured = frequency(&vibrating(shape, soft::RUBBER, &mode), &mode, omega);
            case.check(quantity, omega, measured, TOLERANCE);
        }
    }
}

#[test]
fn brick_shears_in_each_plane_at_the_frequency_of_its_two_sides() {
    let case =
        Case { row: Some(6), name: "rubber box 0.1×0.2×0.15 m", source: "ω² = 2(c₁+c₂)V(1/J_i + 1/J_j)" };
    let sides: [f64; 3] = [0.1, 0.2, 0.15];
    for ((quantity, mode), (i, j)) in modes().into_iter().skip(2).zip([(1, 2), (0, 2), (0, 1)]) {
        // V/J_i = 12/(ρ a_i²).
        let omega = (2.0 * 4000.0 * 12.0 / 1000.0 * (sides[i].powi(-2) + sides[j].powi(-2))).sqrt();
        let measured = frequency(&vibrating(BRICK, soft::RUBBER, &mode), &mode, omega);
        case.check(quantity, omega, measured, TOLERANCE);
    }
}

#[test]
fn compressible_sphere_breathes_at_the_frequency_of_its_bulk_modulus() {
    let case = Case { row: Some(6), name: "breathing sphere, R = 0.1 m, κ = 20 kPa", source: "ω² = 3κV/j" };
    // κ of the six energies: K; λ + ⅔μ; 8κ/3 of the orthogonality energy.
    let materials = [
        ("Mooney–Rivlin [rad/s]", "mooney_rivlin = { c1 = 3000, c2 = 1000, bulk = 20000 }"),
        ("Fung [rad/s]", "fung = { shear = 5000, exponent = 2, bulk = 20000 }"),
        ("Ogden [rad/s]", "ogden = { mu = [3000, -1000], alpha = [1.5, -2], bulk = 20000 }"),
        ("neo-Hookean with logarithm [rad/s]", "neo_hookean_log = { mu = 6000, lambda = 16000 }"),
        ("St Venant–Kirchhoff [rad/s]", "st_venant_kirchhoff = { mu = 6000, lambda = 16000 }"),
        ("Hencky [rad/s]", "hencky = { shear = 6000, bulk = 20000 }"),
        ("orthogonality [rad/s]", "orthogonality = { kappa = 7500 }"),
    ];
    // V/j = 5/(ρR²).
    let omega = (3.0 * 20000.0 * 5.0 / (1000.0 * 0.01_f64)).sqrt();
    for (quantity, material) in materials {
        let mode = Mat3::identity();
        let experiment = vibrating(soft::BALL, &format!("material = {{ {material} }}"), &mode);
        case.check(quantity, omega, frequency(&experiment, &mode, omega), TOLERANCE);
    }
}
