//! The gallery's `jacobi-ellipsoid`, `roche-limit` and `geodesic`: figures of fluid, and a ball that rings by inertia.
//!
//!   Jacobi and Dedekind   P = R(Ωt) D and D R(Ωt)ᵀ: one has the spin Ω, the other the vorticity, and D stays
//!   Roche                 T + V − ½ w² tr((3 n ⊗ n − 1) P J Pᵀ) − w L_z stays, n towards the planet
//!   geodesic              P = P₀ exp(t Aᵀ) exp(t (A − Aᵀ))
//!
//! Sources: Chandrasekhar, *Ellipsoidal Figures of Equilibrium*; `validation/oracles/{self_gravity,roche_moons}.py`.

use crate::soft::size;
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::PI;

/// πGρ of water [1/s²].
const GRAVITY: f64 = PI * 6.674e-11 * 1000.0;

/// By how much stretches leave those of the start, of a body of the run.
fn change(run: &Run, body: usize) -> f64 {
    let stretches = run.vectors_of(body, "principal_stretches");
    largest(stretches.iter().map(|found| (found - stretches[0]).norm()))
}

#[test]
fn jacobi_and_dedekind_exchange_spin_and_vorticity() {
    let case = Case { row: None, name: "gallery: jacobi-ellipsoid", source: "Jacobi, b/a = 0.6; Dedekind's theorem" };
    let run = Experiment::of_gallery("jacobi-ellipsoid", &[]).run();
    let omega = (0.3373299033756934 * GRAVITY).sqrt();
    let off = |body: usize, name: &str, expected: f64| {
        largest(run.vectors_of(body, name).iter().map(|found| (found - expected * Vec3::z()).norm())) / omega
    };
    // Twelve digits in the file, and the tolerance of the run over three turns.
    case.check("largest error of Jacobi's spin over Ω", 0.0, off(0, "spin", omega), 1e-7);
    case.check("Jacobi's vorticity over Ω", 0.0, off(0, "vorticity", 0.0), 1e-7);
    case.check("Dedekind's spin over Ω", 0.0, off(1, "spin", 0.0), 1e-7);
    case.check("largest error of Dedekind's vorticity over Ω", 0.0, off(1, "vorticity", omega), 1e-7);
    case.check("change of Jacobi's stretches", 0.0, change(&run, 0), 1e-7);
    case.check("change of Dedekind's stretches", 0.0, change(&run, 1), 1e-7);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-8);
}

#[test]
fn moons_keep_or_lose_their_figure_on_the_two_sides_of_roches_limit() {
    let case = Case { row: None, name: "gallery: roche-limit", source: "the same equations by a fourth-order method" };
    let moons = Experiment::of_gallery("roche-limit", &[]);
    let run = moons.run();
    let longest = |body: usize| -> Vec<f64> {
        run.vectors_of(body, "principal_stretches").iter().map(|stretches| stretches.x).collect()
    };
    let [outer, inner] = [longest(0), longest(1)];
    case.check("long axis of the outer moon at the end", 1.447791704443, *outer.last().unwrap(), 1e-7);
    case.check("long axis of the inner moon at the end", 4.508640948415, *inner.last().unwrap(), 1e-7);
    assert!(outer.iter().all(|axis| *axis <= outer[0]), "{outer:?}");
    assert!(inner.windows(2).all(|pair| pair[0] < pair[1]), "{inner:?}");
    let rates = [0.000135404000035, 0.000139527805288];
    for (body, (w, quantity)) in
        rates.into_iter().zip(["drift of Jacobi's integral, outer", "drift of Jacobi's integral, inner"]).enumerate()
    {
        let own = &moons.model.bodies[body];
        let (gravity, euler_tensor) = (own.own.self_gravity.unwrap(), own.solid.mass.euler_tensor);
        let [places, speeds] = ["placement_gradient", "gradient_rate"].map(|name| run.matrices_of(body, name));
        let integral = |((time, p), rate): ((&f64, &Mat3), &Mat3)| {
            let planet = Vec3::new((w * time).cos(), (w * time).sin(), 0.0);
            let form = p * euler_tensor * p.transpose();
            let tide = 0.5 * w * w * (3.0 * planet.dot(&(form * planet)) - form.trace());
            let momentum = p * euler_tensor * rate.transpose();
            let kinetic = 0.5 * (rate * euler_tensor).dot(rate);
            kinetic + gravity.energy(p) - tide - w * (momentum.m12 - momentum.m21)
        };
        let found: Vec<f64> = run.times.iter().zip(&places).zip(&speeds).map(integral).collect();
        let drift = largest(found.iter().map(|value| value - found[0])) / gravity.energy(&places[0]).abs();
        case.by("Jacobi's integral").check(quantity, 0.0, drift, 1e-8);
    }
}

#[test]
fn a_ball_without_elasticity_rings() {
    let case = Case { row: None, name: "gallery: geodesic", source: "P = P₀ exp(t Aᵀ) exp(t (A − Aᵀ))" };
    let run = Experiment::of_gallery("geodesic", &[]).run();
    let a = Mat3::new(0.0, -2.0, 0.0, 1.0, 0.0, 0.5, 0.0, -0.3, 0.0);
    let expected = |t: &f64| (a.transpose() * *t).exp() * ((a - a.transpose()) * *t).exp();
    let found = run.matrices("placement_gradient");
    let error = largest(run.times.iter().zip(&found).map(|(t, p)| size(&(p - expected(t)))));
    case.check("largest error of P", 0.0, error, 1e-7);
    let stretches: Vec<f64> = run.vectors_of(0, "principal_stretches").iter().map(|stretches| stretches.x).collect();
    let turns = stretches.windows(3).filter(|row| row[1] > row[0] && row[1] > row[2]).count();
    assert!(turns >= 3 && stretches.iter().all(|stretch| *stretch < 1.6), "{stretches:?}");
}
