//! Kinetic energies that do not change under P → A P: free motions in closed form, and swings of any amplitude.
//!
//!   ½ tr(W J Wᵀ), W = P⁻¹Ṗ, J = j 1      P(t) = P₀ exp(t Aᵀ) exp(t (A − Aᵀ)),   A = W(0)
//!   ½ (A tr W² + B (tr W)²)              P(t) = P₀ exp(t W)
//!   V = ½ k ln² P_xx, P diagonal         ω² = k/j, and k (A + 2B)/(A (A + 3B)): harmonic, however far P goes

use crate::soft::{self, alone, body, size};
use gyration::tensor::Mat3;
use gyration_scene::Recorded;
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::PI;

const PRECISE: (f64, f64) = (1e-12, 1e-14);
/// j of the ball of 0.1 m and 1000 kg/m³ [kg m²].
const INERTIA: f64 = 4.0 / 3.0 * PI * 0.01 / 5.0;
/// A and B [kg m²].
const INVARIANT: [f64; 2] = [0.02, -0.005];

fn start() -> [Mat3; 2] {
    let place = Mat3::new(1.2, 0.3, -0.1, 0.1, 0.8, 0.2, -0.2, 0.1, 1.1);
    [place, Mat3::new(0.2, -0.9, 0.4, 0.7, -0.1, 0.3, -0.2, 0.5, 0.1)]
}

/// The ball that starts with W, free.
fn free(kinetic: &str) -> Experiment {
    let [place, w] = start();
    alone(&body(soft::BALL, &format!("kinetic = {kinetic}"), &place, &(place * w)), PRECISE).until(2.0).sampled(0.1)
}

/// Largest entry of a difference at the samples, of those of a first one.
fn drift(found: &[Mat3]) -> f64 {
    largest(found.iter().map(|matrix| size(&(matrix - found[0])))) / size(&found[0])
}

#[test]
fn a_free_body_moves_on_geodesics_of_its_own_metric() {
    let case =
        Case { row: None, name: "free ball, T = ½ tr(W J Wᵀ)", source: "P = P₀ exp(t Aᵀ) exp(t (A − Aᵀ))" };
    let quantities = [Recorded::ComovingMomentum, Recorded::MomentumResidual, Recorded::CanonicalMomentum];
    let run = free("\"comoving\"").recording(quantities).run();
    let [place, a] = start();
    let expected = |t: &f64| place * (a.transpose() * *t).exp() * ((a - a.transpose()) * *t).exp();
    let found = run.matrices("placement_gradient");
    let error = largest(run.times.iter().zip(&found).map(|(t, p)| size(&(p - expected(t)))));
    case.check("largest error of P over 2 s", 0.0, error, 1e-9);
    let energy = 0.5 * INERTIA * a.norm_squared();
    let energies = run.column("energy.kinetic");
    case.check("kinetic energy at the end [J]", energy, *energies.last().unwrap(), 1e-10);
    let case = case.by("T does not change under P → A P");
    case.check("drift of the affine momentum", 0.0, drift(&run.matrices("affine_momentum")), 1e-10);
    let left = largest(run.matrices("momentum_residual").iter().map(size)) / energy;
    case.check("residual of dK/dt = N over the energy", 0.0, left, 1e-12);
    let momenta = run.matrices("canonical_momentum");
    let parts = momenta.iter().zip(&found).zip(run.matrices("affine_momentum"));
    let error = largest(parts.map(|((momentum, p), k)| size(&(p * momentum.transpose() - k))));
    case.check("P (∂T/∂Ṗ)ᵀ less K [kg m²/s]", 0.0, error, 1e-15);
}

#[test]
fn a_free_body_of_the_invariant_energy_moves_on_one_parameter_subgroups() {
    let case = Case {
        row: None,
        name: "free ball, T = ½ (A tr W² + B (tr W)²), A = 0.02, B = −0.005",
        source: "P = P₀ exp(t W)",
    };
    let run = free("{ invariant = { A = 0.02, B = -0.005 } }").run();
    let [place, w] = start();
    let found = run.matrices("placement_gradient");
    let error = largest(run.times.iter().zip(&found).map(|(t, p)| size(&(p - place * (w * *t).exp()))));
    case.check("largest error of P over 2 s", 0.0, error, 1e-9);
    let [a, b] = INVARIANT;
    let energy = 0.5 * (a * (w * w).trace() + b * w.trace().powi(2));
    assert!(energy < 0.0, "{energy}");
    case.check("kinetic energy at the end [J]", energy, *run.column("energy.kinetic").last().unwrap(), 1e-10);
    case.check("drift of the affine momentum", 0.0, drift(&run.matrices("affine_momentum")), 1e-10);
}

#[test]
fn logarithms_of_stretches_swing_harmonically() {
    let case = Case {
        row: None,
        name: "ball in V = ½ k ln² P_xx, from P_xx = e",
        source: "ω² = ∂²V/∂x² over the inertia of x = ln P_xx",
    };
    let [a, b] = INVARIANT;
    let k = 0.7;
    let place = Mat3::from_diagonal(&[std::f64::consts::E, 1.0, 1.0].into());
    let kinds = [
        ("\"comoving\"", k / INERTIA, "ln P_xx after 1.1 periods, comoving"),
        (
            "{ invariant = { A = 0.02, B = -0.005 } }",
            k * (a + 2.0 * b) / (a * (a + 3.0 * b)),
            "ln P_xx after 1.1 periods, invariant",
        ),
    ];
    for (kinetic, square, quantity) in kinds {
        let own = "potential = \"0.5*k*ln(P_xx)^2\"\nconstants = { k = 0.7 }";
        let written = body(soft::BALL, &format!("kinetic = {kinetic}"), &place, &Mat3::zeros());
        let time = 2.2 * PI / square.sqrt();
        let swinging = alone(&format!("{written}{own}"), PRECISE).until(time);
        let run = swinging.run();
        let found = run.end.motion(&swinging.model, 0).placement.gradient.m11.ln();
        case.check(quantity, (2.2 * PI).cos(), found, 1e-9);
        assert!(run.relative_residual() < 1e-9, "{:e}", run.relative_residual());
        // The implicit steps go by the exact derivatives of both.
        let implicit = Experiment::of_scene(&format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {time:?}, sample = {time:?} }}\n\
             solver = {{ rtol = 1e-11, atol = 1e-13, method = \"implicit\" }}\n\
             [[body]]\nname = \"body\"\ndensity = 1000\n{written}{own}"
        ));
        let run = implicit.run();
        let found = run.end.motion(&implicit.model, 0).placement.gradient.m11.ln();
        assert!((found - (2.2 * PI).cos()).abs() < 1e-7 && run.steps < 2000, "{found} in {} steps", run.steps);
    }
}
