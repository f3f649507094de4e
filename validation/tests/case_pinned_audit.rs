//! Sławianowski's balance about a pin, with every load that a body can have beside contact, by differences in time.
//!
//!   K_p = P J_p Ṗᵀ,   dK_p/dt = Ṗ J_p Ṗᵀ + N − V (S Pᵀ)ᵀ,   J_p = J + m r⊗r
//!
//! Pulled at by a spring with a dashpot, a couple, gravity, a linear friction and a gyroscopic load. The last does no
//! work: the ledger closes without it.

use crate::soft::{self, derivatives, size};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Recorded;
use gyration_validation::{Case, Experiment, largest};

const SPACING: f64 = 5e-4;
const SIZE: [f64; 3] = [0.10, 0.08, 0.06];

fn square(entry: impl Fn(usize, usize) -> f64) -> [[f64; 12]; 12] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The box; the gyroscopic load of this strength.
fn pinned(strength: f64) -> Experiment {
    // A semi-definite matrix of rank two, and a skew one, of every pair of velocities.
    let wave = |k: usize, phase: f64| (1.7 * k as f64 + phase).sin();
    let friction = square(|i, j| 2e-3 * (wave(i, 0.0) * wave(j, 0.0) + wave(i, 1.0) * wave(j, 1.0)));
    let skew = square(|i, j| strength * (wave(i, 0.3) * wave(j, 1.1) - wave(i, 1.1) * wave(j, 0.3)));
    let start = Mat3::new(1.05, 0.1, 0.0, -0.1, 0.95, 0.05, 0.02, 0.0, 1.1);
    let rate = Mat3::new(0.5, -4.0, 1.0, 5.0, 0.2, -2.0, 0.0, 3.0, -0.5);
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = 0.5, sample = {SPACING:e} }}
        solver = {{ rtol = 1e-10, atol = 1e-12 }}
        [[body]]
        name = "body"
        shape = {{ box = {{ size = {SIZE:?} }} }}
        density = 1000
        pin = [0.03, 0.02, 0.01]
        position = [0, 0, 1]
        spring = [{{ point = [-0.05, 0.04, 0.03], anchor = [0.1, 0.2, 0.9], stiffness = 50, rest_length = 0.1, damping = 0.5 }}]
        {}
        {}
        [body.affine]
        material = {{ neo_hookean_log = {{ mu = 4000, lambda = 6000 }} }}
        viscosity = 5
        couple = {{ value = [[0.1, 0.02, 0], [0, -0.05, 0.03], [0.04, 0, 0.02]] }}
        linear_friction = {{ matrix = {friction:?}, frame = "body" }}
        gyroscopic = {{ matrix = {skew:?} }}
        "#,
        soft::entry("gradient", &start),
        soft::entry("gradient_rate", &rate),
    ))
}

#[test]
fn affine_momentum_about_a_pin_balances_under_every_load() {
    let case = Case {
        row: None, name: "pinned soft box under every load", source: "dK/dt = Ṗ J Ṗᵀ + N − V(SPᵀ)ᵀ"
    };
    let run = pinned(5e-3).recording([Recorded::Stress, Recorded::AffineMoment]).run();
    let volume: f64 = SIZE.iter().product();
    let mass = 1000.0 * volume;
    let pin = Vec3::new(0.03, 0.02, 0.01);
    let squares = Vec3::from(SIZE.map(|side| side * side));
    let euler = Mat3::from_diagonal(&(squares * (mass / 12.0))) + mass * pin * pin.transpose();
    let arrays = ["placement_gradient", "gradient_rate", "affine_moment", "stress"].map(|name| run.matrices(name));
    let [p, rate, moment, stress] = &arrays;
    let momentum: Vec<Mat3> = p.iter().zip(rate).map(|(p, rate)| p * euler * rate.transpose()).collect();
    let supplied = |k: usize| {
        rate[k] * euler * rate[k].transpose() + moment[k] - volume * (stress[k] * p[k].transpose()).transpose()
    };
    let found = derivatives(&momentum, SPACING);
    // A derivative stands for the sample in the middle of nine.
    let error = largest(found.iter().enumerate().map(|(k, found)| size(&(found - supplied(k + 4)))));
    let scale = largest(found.iter().map(size));
    println!("largest entry of N {:.2e}, of dK/dt {scale:.2e} N m", largest(moment.iter().map(size)));
    case.check("largest error of the balance of K over the largest dK/dt", 0.0, error / scale, 1e-7);
    let ledger = case.by("the ledger");
    ledger.check("residual over the energy in play", 0.0, run.relative_residual(), 1e-8);
    let (with, without) = (&run.end, pinned(0.0).run().end);
    let apart = with.bodies.iter().zip(&without.bodies).map(|(a, b)| a - b);
    assert!(largest(apart) > 1e-3, "the gyroscopic load is to matter");
}
