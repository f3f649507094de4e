//! Row 8: large uniaxial oscillation of a rubber sphere, P = diag(l^−½, l^−½, l), J = jI.
//!
//!   T = 2∫ √( j(1 + 1/(2l³)) / (2V(W(l_max) − W(l))) ) dl,   W = c₁(l² + 2/l − 3) + c₂(2l + l⁻² − 3)
//!
//! With l = mean + half·sin θ the singular ends go, and the midpoint rule in θ converges as for a periodic function.
//! W(m) − W(l) = (m − l)[c₁(m + l − 2/(ml)) + c₂(2 − (m + l)/(m²l²))], without cancellation at m.

use crate::soft::{self, alone, body};
use gyration::tensor::Mat3;
use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::PI;

const C1: f64 = 3000.0;
const C2: f64 = 1000.0;
/// j/V = ρR²/5 [kg/m].
const INERTIA: f64 = 2.0;
const SOURCE: &str = "T = 2∫√(j(1 + 1/(2l³))/(2V(W(l_max) − W(l)))) dl";

/// (W(m) − W(l))/(m − l).
fn slope(m: f64, l: f64) -> f64 {
    C1 * (m + l - 2.0 / (m * l)) + C2 * (2.0 - (m + l) / (m * l).powi(2))
}

/// 1 + 1/(2l³).
fn spread(l: f64) -> f64 {
    1.0 + 0.5 * l.powi(-3)
}

/// The least stretch of an oscillation, where W is that of the largest, by bisection.
fn least(largest: f64) -> f64 {
    let (mut low, mut high) = (1e-3, 1.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if slope(largest, middle) < 0.0 { low = middle } else { high = middle }
    }
    high
}

/// The period [s], by the midpoint rule in θ.
fn period(largest: f64) -> f64 {
    const POINTS: u32 = 400;
    let least = least(largest);
    let (mean, half) = (0.5 * (largest + least), 0.5 * (largest - least));
    let term = |k: u32| {
        let (sin, cos) = ((f64::from(k) + 0.5) * PI / f64::from(POINTS) - 0.5 * PI).sin_cos();
        let l = mean + half * sin;
        (INERTIA * spread(l) / (2.0 * slope(largest, l) * (largest - l))).sqrt() * half * cos
    };
    2.0 * PI / f64::from(POINTS) * (0..POINTS).map(term).sum::<f64>()
}

/// The sphere at a stretch l along z with the rate l̇ [1/s].
fn sphere(l: f64, rate: f64, tolerances: (f64, f64)) -> Experiment {
    let narrow = l.powf(-0.5);
    let place = Mat3::from_diagonal(&[narrow, narrow, l].into());
    let thinning = -0.5 * rate * narrow / l;
    let rates = Mat3::from_diagonal(&[thinning, thinning, rate].into());
    alone(&body(soft::BALL, soft::RUBBER, &place, &rates), tolerances)
}

#[test]
fn large_oscillations_take_the_period_of_the_quadrature() {
    let cases = [
        ("rubber sphere, l_max = 1.2", 1.2),
        ("rubber sphere, l_max = 1.5", 1.5),
        ("rubber sphere, l_max = 2", 2.0),
        ("rubber sphere, l_max = 3", 3.0),
        ("rubber sphere, l_max = 4", 4.0),
    ];
    for (name, largest) in cases {
        let reference = period(largest);
        let motion = sphere(largest, 0.0, (1e-11, 1e-13)).motion_at(reference);
        // There l̇ ≈ l̈ (t − T), with l̈ = −V W′/(j(1 + 1/(2l³))).
        let acceleration = -slope(largest, largest) / (INERTIA * spread(largest));
        let measured = reference - motion.velocity.gradient_rate.m33 / acceleration;
        // The tolerance of the list.
        Case { row: Some(8), name, source: SOURCE }.check("period [s]", reference, measured, 1e-7);
    }
}

fn worst_volume(run: &Run) -> f64 {
    largest(run.matrices("placement_gradient").into_iter().map(|p| p.determinant() - 1.0))
}

#[test]
fn sphere_stretched_to_three_returns_after_five_periods() {
    let case = Case { row: Some(8), name: "rubber sphere, l = 1 → 3, five periods, rtol = 1e-10", source: SOURCE };
    // The speed at l = 1 that carries it to 3: ½ j(1 + ½) l̇² = V (W(3) − W(1)).
    let speed = (2.0 * slope(3.0, 1.0) * 2.0 / (INERTIA * spread(1.0))).sqrt();
    let reference = period(3.0);
    let run = sphere(1.0, speed, (1e-10, 1e-12)).until(5.0 * reference).sampled(reference / 64.0).run();
    let stretches = run.column("body.P_zz");
    let reached = stretches.iter().copied().fold(0.0, f64::max);
    // A sample is at most half a spacing from the extreme: (π/64)²/2 of the swing.
    case.check("largest stretch at the samples", 3.0, reached, 2e-3);
    case.check("stretch after five periods", 1.0, stretches[stretches.len() - 1], 1e-6);
    case.by("det P = 1").check("largest error of det P at the samples", 0.0, worst_volume(&run), 1e-10);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-7);
}
