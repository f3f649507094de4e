//! Row 9: a true elastic sphere rings lower than the affine one: what twelve degrees of freedom cost.
//!
//! The lowest mode of the incompressible sphere of radius 1, μ = ρ = 1, is u = A∇(r²Y) + B curl curl(r j₂(kr)Y) with
//! the pressure k²A r²Y, Y a surface harmonic of degree 2 (Lamb 1882). Without traction at r = 1,
//!
//!   (4 − k²)A + 12(kj₂′ − j₂)B = 0,   2A + ((10 − k²)j₂ − 2kj₂′)B = 0
//!
//! so that k = 2.66562; the affine sphere has ω²R²ρ/μ = 10.

use crate::soft::{self, alone, body};
use gyration::tensor::Mat3;
use gyration_validation::Case;

/// The determinant of the two conditions, j₂ and kj₂′ in closed form.
fn determinant(k: f64) -> f64 {
    let (sin, cos) = k.sin_cos();
    let bessel = (3.0 / k.powi(3) - 1.0 / k) * sin - 3.0 * cos / k.powi(2);
    // kj₂′ = kj₁ − 3j₂.
    let slope = sin / k - cos - 3.0 * bessel;
    (4.0 - k * k) * ((10.0 - k * k) * bessel - 2.0 * slope) - 24.0 * (slope - bessel)
}

/// The lowest root, by bisection.
fn true_frequency() -> f64 {
    let (mut low, mut high) = (2.5_f64, 2.8_f64);
    let sign = determinant(low).signum();
    assert!(determinant(high).signum() != sign);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if determinant(middle).signum() == sign { low = middle } else { high = middle }
    }
    low
}

#[test]
fn affine_sphere_rings_higher_than_a_true_one_by_a_fifth() {
    let case = Case { row: Some(9), name: "lowest mode of an incompressible sphere", source: "Lamb 1882" };
    let root = true_frequency();
    // The list has six digits.
    assert!((root - 2.66562).abs() < 5e-6, "{root}");
    // √(μ/ρ)/R = √8/0.1 /s; its affine vibration, by the phase after about a period.
    let unit = 8.0_f64.sqrt() / 0.1;
    let stretch = Mat3::from_diagonal(&[1.0, -1.0, 0.0].into());
    let start = Mat3::identity() + 1e-5 * stretch;
    let motion = alone(&body(soft::BALL, soft::RUBBER, &start, &Mat3::zeros()), (1e-13, 1e-14)).motion_at(0.07);
    let (place, rate) = (stretch.dot(&motion.placement.gradient), stretch.dot(&motion.velocity.gradient_rate));
    let near = 10.0_f64.sqrt() * unit;
    let measured = (std::f64::consts::TAU + (-rate / near).atan2(place)) / 0.07;
    case.check("affine frequency over the true one", 10.0_f64.sqrt() / root, measured / (root * unit), 1e-6);
    case.by("the list: 18.6 %").check("excess of the affine frequency", 0.186, measured / (root * unit) - 1.0, 3e-3);
}
