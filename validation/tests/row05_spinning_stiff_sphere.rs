//! Row 5: a stiff affine body tends to the rigid one. A sphere that spins at ω is stretched to 1 + ε, ε =
//! ρR²ω²/(60(c₁+c₂)).
//!
//! The steady motion P = R(t) diag(λ, λ, λ⁻²) obeys, exactly,
//!
//!   c₁(4 − 4λ⁻⁶) + c₂(4λ² − 4λ⁻⁴) = 2ρR²ω²/5,   so that   λ = 1 + ε + ε²(84c₁ + 36c₂)/(24(c₁ + c₂)) + …
//!
//! It is reached from the round sphere by viscosity, which a rigid rotation does not feel; ω is that at the end.

use crate::soft::{self, alone, body};
use gyration::tensor::Mat3;
use gyration_validation::Case;

const SPIN: f64 = 30.0;

/// Stretch λ and ω² [1/s²] of a sphere of stiffness c₁ = 3c₂ = 3s·1000 Pa that has come to spin steadily.
fn steady(stiffness: f64) -> (f64, f64) {
    let root = stiffness.sqrt();
    // Frequencies go as √s, and so does the viscosity: damping ratio 0.5 whatever the stiffness, e^−45 after 1 s/√s.
    let (c1, c2, viscosity) = (3000.0 * stiffness, 1000.0 * stiffness, 180.0 * root);
    let affine = format!("material = {{ mooney_rivlin = {{ c1 = {c1:e}, c2 = {c2:e} }} }}, viscosity = {viscosity:e}");
    let rate = Mat3::new(0.0, -SPIN, 0.0, SPIN, 0.0, 0.0, 0.0, 0.0, 0.0);
    let text = body(soft::BALL, &affine, &Mat3::identity(), &rate);
    let motion = alone(&text, (1e-12, 1e-14)).motion_at(1.0 / root);
    let (p, rate) = (motion.placement.gradient, motion.velocity.gradient_rate);
    let stretch = p.column(0).norm();
    assert!((p.column(1).norm() - stretch).abs() < 1e-10 && (p[(2, 2)] * stretch * stretch - 1.0).abs() < 1e-12);
    (stretch, rate.column(0).norm_squared() / (stretch * stretch))
}

fn expected(square: f64, stiffness: f64) -> f64 {
    1000.0 * 0.01 * square / (60.0 * 4000.0 * stiffness)
}

#[test]
fn spinning_sphere_finds_the_stretch_of_the_closed_form() {
    let case = Case {
        row: Some(5),
        name: "sphere spun at 30 rad/s, c₁ = 3000, c₂ = 1000",
        source: "c₁(4 − 4λ⁻⁶) + c₂(4λ² − 4λ⁻⁴) = 2ρR²ω²/5",
    };
    let (stretch, square) = steady(1.0);
    let elastic = 3000.0 * (4.0 - 4.0 * stretch.powi(-6)) + 1000.0 * (4.0 * stretch.powi(2) - 4.0 * stretch.powi(-4));
    // Some hundred steps at rtol = 1e-12; differences of λ from 1 magnify by twenty.
    case.check("elastic stress at the stretch reached [Pa]", 2.0 * 10.0 * square / 5.0, elastic, 1e-9);
}

#[test]
fn stiff_affine_body_tends_to_the_rigid_one() {
    let case = Case { row: Some(5), name: "stiff spinning sphere", source: "1 + ρR²ω²/(60(c₁+c₂))" };
    // (λ − 1)/ε at a stiffness: 1 + 3ε + O(ε²).
    let ratio = |stiffness: f64| {
        let (stretch, square) = steady(stiffness);
        (stretch - 1.0) / expected(square, stiffness)
    };
    let [soft, middle, stiff] = [100.0, 200.0, 400.0].map(ratio);
    // ε = 9.4e-5 there, and the next term is 3ε of it.
    case.check("(λ − 1)/ε at c₁ + c₂ = 1.6 MPa", 1.0, stiff, 4e-4);
    case.check("(λ − 1)/ε in the limit, from two stiffnesses", 1.0, 2.0 * stiff - middle, 1e-6);
    let order = ((soft - 1.0) / (middle - 1.0)).log2() + 1.0;
    // (1 + O(ε)) of the ratio of two deviations.
    case.check("order of the deviation in 1/stiffness", 2.0, order, 2e-3);
    let second = (soft - 1.0) / expected(SPIN * SPIN, 100.0);
    case.check("second coefficient, deviation over ε²", 3.0, second, 1e-2);
}
