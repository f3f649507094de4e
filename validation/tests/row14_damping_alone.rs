//! Row 14: one face under damping alone.
//!
//!   m v̇ = −mg − βA d^−ν v   has the first integral   v = v₀ − gt + (βA/m)(d^(1−ν) − d₀^(1−ν))/(ν−1)
//!
//! Without gravity the face stops at a gap; under it, it creeps: d^(1−ν) = d₀^(1−ν) + (ν−1)(mg/(βA))t when v ≪ gt.

use gyration::contact::{ContactLaw, Damping};
use gyration_sim::Tolerance;
use gyration_validation::{Answer, Experiment, FacetBody};

const ROW: Option<u32> = Some(14);
const AREA: f64 = 0.01;
const MASS: f64 = 1.0;
const NU: f64 = 3.0;

fn facet(beta: f64, gravity: f64, gap: f64, velocity: f64) -> Experiment {
    let law = ContactLaw::Damping(Damping { beta, exponent: NU, reference_gap: 1.0, release: None });
    let body = FacetBody { mass: MASS, area: AREA, laws: vec![law], gravity, gap, tilt: 0.0, velocity };
    body.experiment(Tolerance { rtol: 1e-11, atol: 1e-14 })
}

#[test]
fn face_stops_at_the_gap_where_its_momentum_is_spent() {
    let (beta, first, speed) = (1e-7, 0.05_f64, 1.0);
    let spent = (NU - 1.0) * MASS * speed / (beta * AREA);
    let reference = (first.powf(1.0 - NU) + spent).powf(1.0 / (1.0 - NU));
    // The list gives nine digits.
    assert!((reference / 2.23606775e-5 - 1.0).abs() < 3e-9, "{reference:e}");
    // It slows at 9e4 1/s where it stops: 0.01 s after it has passed 0.05 m nothing moves.
    let motion = facet(beta, 0.0, first, -speed).motion_at(0.06);
    Answer {
        row: ROW,
        case: "damping alone, β = 1e-7, A = 0.01, ν = 3, m = 1, d₀ = 0.05, v₀ = −1",
        quantity: "gap at the stop [m]",
        reference,
        measured: motion.placement.position.z,
        // Over three decades of the gap, at rtol = 1e-11 of it a step.
        tolerance: 1e-8,
        source: "v = v₀ + (βA/m)(d^(1−ν) − d₀^(1−ν))/(ν−1)",
    }
    .check();
}

#[test]
fn face_creeps_under_gravity() {
    let (beta, gravity, first) = (10.0, 9.81, 0.01);
    let rate = beta * AREA / MASS;
    let experiment = facet(beta, gravity, first, 0.0);
    let cases = [
        ("creep under gravity, β = 10, A = 0.01, ν = 3, m = 1, d₀ = 0.01, t = 1 s", 1.0),
        ("creep under gravity, β = 10, A = 0.01, ν = 3, m = 1, d₀ = 0.01, t = 1000 s", 1000.0),
    ];
    for (case, time) in cases {
        let motion = experiment.motion_at(time);
        let (gap, velocity) = (motion.placement.position.z, motion.velocity.velocity.z);
        let spent = (NU - 1.0) * (velocity + gravity * time) / rate;
        Answer {
            row: ROW,
            case,
            quantity: "gap, by the first integral with the velocity measured [m]",
            reference: (first.powf(1.0 - NU) + spent).powf(1.0 / (1.0 - NU)),
            measured: gap,
            // Some hundred steps at rtol = 1e-11 of the gap.
            tolerance: 1e-9,
            source: "v = v₀ − gt + (βA/m)(d^(1−ν) − d₀^(1−ν))/(ν−1)",
        }
        .check();
        let crept = (NU - 1.0) * gravity * time / rate;
        Answer {
            row: ROW,
            case,
            quantity: "gap, by the law of creep [m]",
            reference: (first.powf(1.0 - NU) + crept).powf(1.0 / (1.0 - NU)),
            measured: gap,
            // The law neglects v/(gt) = d³/(βA t) < 1e-5 t⁻¹ s of the impulse.
            tolerance: 1e-5 / time,
            source: "d^(1−ν) = d₀^(1−ν) + (ν−1)(mg/(βA))t",
        }
        .check();
    }
}
