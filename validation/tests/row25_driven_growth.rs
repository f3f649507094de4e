//! Row 25: a body on which no stress acts contracts as G = exp(Qt/μ_γ).
//!
//! Without a material there is none at all; rubber has none in the limit ρ → 0, in which it follows G at once: the
//! deviation is of the first order in ρ.

use crate::soft::{CUBE, entry, size};
use gyration::tensor::Mat3;
use gyration_sim::{Outcome, Reason};
use gyration_validation::{Case, Experiment};

const DRAG: f64 = 50.0;
const END: f64 = 0.4;

/// Q [Pa], without any symmetry.
fn drive() -> Mat3 {
    Mat3::new(60.0, 40.0, -20.0, -10.0, -50.0, 30.0, 15.0, -25.0, 20.0)
}

/// exp(A) by its series, halved ten times.
fn exponential(a: &Mat3) -> Mat3 {
    let small = a / 1024.0;
    let mut sum = Mat3::identity();
    let mut term = Mat3::identity();
    for k in 1..16 {
        term = term * small / f64::from(k);
        sum += term;
    }
    (0..10).fold(sum, |power, _| power * power)
}

/// A cube that is driven, alone.
fn cube(material: &str, density: f64) -> Experiment {
    let q = entry("value", &drive());
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = {END}, sample = 0.1 }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        [[body]]
        name = "body"
        {CUBE}
        density = {density:e}
        contractile = {{ {material}contraction_viscosity = {DRAG}, drive = {{ constant = {{ {} }} }} }}
        "#,
        q.trim_end()
    ))
}

#[test]
fn contraction_without_stress_is_the_exponential_of_the_drive() {
    let case = Case { row: Some(25), name: "driven cube without a material", source: "G = exp(Qt/μ_γ)" };
    let run = cube("", 1000.0).run();
    let mut worst: f64 = 0.0;
    for (time, g) in run.times.iter().zip(run.matrices("contraction")) {
        let known = exponential(&(drive() * (*time / DRAG)));
        worst = worst.max(size(&(g - known)) / size(&known));
    }
    case.check("largest error of G over 0.4 s, relative", 0.0, worst, 1e-9);
}

#[test]
fn light_rubber_follows_its_contraction() {
    let case =
        Case { row: Some(25), name: "driven rubber cube, ρ → 0", source: "G = exp(Qt/μ_γ), first order in ρ" };
    let known = exponential(&(drive() * (END / DRAG)));
    let error = |density: f64| {
        let run = cube("material = { neo_hookean = { shear = 2000, bulk = 6000 } }, viscosity = 20, ", density).run();
        let g = run.matrices("contraction");
        size(&(g[g.len() - 1] - known)) / size(&known)
    };
    let (coarse, fine) = (error(0.2), error(0.1));
    case.check("deviation of G at ρ = 0.1 kg/m³, relative", 0.0, fine, 1e-4);
    case.check("ratio of the deviations at 0.2 and 0.1 kg/m³", 2.0, coarse / fine, 0.01);
}

#[test]
fn body_that_pulls_together_without_end_collapses_with_an_outcome_that_says_so() {
    // G = e^(−5t): det G leaves the range of numbers at t = 47 s.
    let collapsing = Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 100, sample = 1 }}
        [[body]]
        name = "body"
        {CUBE}
        density = 1000
        contractile = {{ contraction_viscosity = 10, drive = {{ constant = {{ value = [[-50, 0, 0], [0, -50, 0], [0, 0, -50]] }} }} }}
        "#
    ));
    let Outcome::Stopped(stop) = collapsing.attempt().outcome else { panic!("the body has vanished") };
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::Collapsed, Some("body")));
    assert!((40.0..48.0).contains(&stop.time), "{}", stop.time);
    assert!(stop.what.contains("contracted to nothing") && stop.advice.contains("isochoric"), "{stop:?}");
}
