//! The gallery's `shaker`: a ball on a table z = A sin(ωt + φ), with Γ = Aω²/g.
//!
//!   Γ < 1:  a ball that lies on the table stays (as far as the field is hard: ω below its own frequency)
//!   one bounce a period T:  up with gT/2, so that the impact, of restitution e, is where the table has the velocity
//!       Aω cos θ = (gT/2)(1 − e)/(1 + e);   stable for  Γ² < (π(1 − e)/(1 + e))² + (2(1 + e²)/(1 + e)²)²
//!
//! beyond which the period doubles. Source: Holmes, *J. Sound Vib.* 84 (1982) 173; the bound with the table's
//! displacement: Tufillaro, Abbott, Reilly, *An Experimental Approach to Nonlinear Dynamics* (1992), ch. 1.

use gyration_validation::{Answer, Experiment};
use std::f64::consts::{PI, TAU};

const CASE: &str = "gallery: shaker";
const GRAVITY: f64 = 9.81;
const PERIOD: f64 = 0.1;
const OMEGA: f64 = TAU / PERIOD;
const PHASE: f64 = -145.0 / 180.0 * PI;

fn amplitude(gamma: f64) -> f64 {
    gamma * GRAVITY / (OMEGA * OMEGA)
}

/// The scene with another Γ.
fn shaken(gamma: f64, others: &[&str]) -> Experiment {
    let amplitude = format!("support.table.motion.oscillate.amplitude={:e}", amplitude(gamma));
    Experiment::of_gallery("shaker", &[&[amplitude.as_str()], others].concat())
}

/// Restitution at the relative speed of one bounce a period.
fn restitution() -> f64 {
    let weightless = ["world.gravity=[0, 0, 0]", "body.ball.velocity=[0, 0, -0.66]"];
    shaken(0.0, &weightless).motion_at(0.1).velocity.velocity.z / 0.66
}

fn answer(quantity: &'static str, reference: f64, measured: f64, tolerance: f64, source: &'static str) {
    Answer { row: None, case: CASE, quantity, reference, measured, tolerance, source }.check();
}

/// The smallest of what carries a ball that lies on the table, over its weight, once it has settled.
fn least_load(gamma: f64) -> f64 {
    // The table starts at its top, at rest, under the ball at its rest gap.
    let top = amplitude(gamma) + 0.0101;
    let [position, phase] = [format!("body.ball.position=[0, 0, {top:e}]"), "phase=1.5707963267948966".to_owned()];
    let phase = format!("support.table.motion.oscillate.{phase}");
    let run = shaken(gamma, &[&position, &phase, "time.end=1", "time.sample=2e-4"]).run();
    let weight = 1000.0 * 4.0 / 3.0 * PI * 1e-6 * GRAVITY;
    let late = run.column("ball.fz").into_iter().zip(&run.times).filter(|(_, time)| **time > 0.6);
    late.map(|(force, _)| force / weight).fold(f64::INFINITY, f64::min)
}

#[test]
fn ball_that_lies_on_the_table_leaves_it_at_one_g() {
    // 0.5 % of the weight is left to the field at 2.4 times its rest gap: nothing to the eye.
    let (mut stays, mut leaves) = (0.7, 1.4);
    assert!(least_load(stays) > 5e-3 && least_load(leaves) < 5e-3);
    while leaves - stays > 2e-3 {
        let gamma = 0.5 * (stays + leaves);
        if least_load(gamma) > 5e-3 { stays = gamma } else { leaves = gamma }
    }
    // The table shakes at a tenth of the frequency of the ball on its field, which magnifies the load by some 1e-2.
    answer("Γ at which a ball at rest leaves the table", 1.0, 0.5 * (stays + leaves), 3e-2, "Aω² = g");
    answer("least load at Γ = 0.5, over the weight", 0.5, least_load(0.5), 3e-2, "1 − Γ");
}

/// Times of the last impacts and heights of the last hops.
fn last_bounces(gamma: f64, count: usize) -> Vec<f64> {
    let run = shaken(gamma, &["time.end=8", "time.sample=8"]).run();
    let impacts = run.times_of("closest_approach");
    impacts[impacts.len() - count..].to_vec()
}

#[test]
fn bounces_fall_into_step_where_the_table_gives_back_what_the_impact_takes() {
    let impacts = last_bounces(1.3, 6);
    let worst = impacts.windows(2).map(|pair| ((pair[1] - pair[0]) / PERIOD - 1.0).abs()).fold(0.0, f64::max);
    answer("largest difference of an interval from the period, relative", 0.0, worst, 1e-6, "one bounce a period");
    let e = restitution();
    let table = amplitude(1.3) * OMEGA * (OMEGA * impacts[5] + PHASE).cos();
    let reference = 0.5 * GRAVITY * PERIOD * (1.0 - e) / (1.0 + e);
    // An impact lasts for a part of a millisecond and 0.1 mm, a few thousandths of the period and of the hop.
    answer("velocity of the table at the closest approach [m/s]", reference, table, 3e-2, "(gT/2)(1 − e)/(1 + e)");
}

#[test]
fn period_doubles_at_the_bound_of_the_closed_form() {
    // Alternate hops differ once the period has doubled; near the bound they take long to tell.
    let doubled = |gamma| {
        let impacts = last_bounces(gamma, 3);
        let [one, two] = [impacts[1] - impacts[0], impacts[2] - impacts[1]];
        (one - two).abs() > 1e-3 * PERIOD
    };
    let (mut single, mut double) = (1.4, 1.75);
    assert!(!doubled(single) && doubled(double));
    while double - single > 5e-3 {
        let gamma = 0.5 * (single + double);
        if doubled(gamma) { double = gamma } else { single = gamma }
    }
    let e = restitution();
    let reference = (PI * (1.0 - e) / (1.0 + e)).hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
    answer(
        "Γ at which the period doubles",
        reference,
        0.5 * (single + double),
        3e-2,
        "Γ² = (π(1−e)/(1+e))² + (2(1+e²)/(1+e)²)²",
    );
}
