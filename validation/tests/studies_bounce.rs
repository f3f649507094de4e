//! The ready studies `restitution` and `bounce-bifurcation`, some of their runs.
//!
//!   an edge that strikes a distance s beside the centre, without friction:  v_out/v_in = (1 + e)/(1 + s²/k²) − 1
//!   one bounce a period forks into two at  Γ² = (π(1 − e)/(1 + e))² + (2(1 + e²)/(1 + e)²)²,  Γ = Aω²/g
//!
//! The second is where an eigenvalue of the exact map of impacts (time, speed) passes −1, with constant e (Tufillaro,
//! Abbott, Reilly, *An experimental approach to nonlinear dynamics and chaos*, 1992, ch. 1).

use gyration_study::Study;
use gyration_validation::{Answer, Studied};
use std::f64::consts::{PI, TAU};
use std::path::Path;

#[test]
fn block_rebounds_as_an_edge_does() {
    let study = Studied::ready("restitution");
    let angles = study.axes()[1];
    let (long, high) = (0.12_f64, 0.04_f64);
    let radius_squared = (long * long + high * high) / 12.0;
    // Where the edge is below the centre nothing turns the block: there the rebound is e itself.
    let below = (4.0 * (long / high).atan().to_degrees()).round() as u64;
    for (damping, case) in [
        (0, "study restitution, without damping, 60 to 85 degrees"),
        (1, "study restitution, with damping, 60 to 85 degrees"),
    ] {
        let runs: Vec<u64> = [below].into_iter().chain((240..=340).step_by(20)).map(|k| damping * angles + k).collect();
        let studied = Studied::new(&study, &runs);
        let (angle, rebound) = (studied.numbers("angle"), studied.numbers("rebound"));
        let e = rebound[0];
        let mut worst = 0.0_f64;
        for (angle, rebound) in angle.iter().zip(&rebound) {
            let beside = 0.5 * (long * angle.cos() - high * angle.sin());
            let expected = (1.0 + e) / (1.0 + beside * beside / radius_squared) - 1.0;
            println!("{:5.1}°: {rebound:.4}, one impact of an edge {expected:.4}", angle.to_degrees());
            worst = worst.max((rebound - expected).abs());
        }
        Answer {
            row: None,
            case,
            quantity: "largest error of the rebound",
            reference: 0.0,
            measured: worst,
            // The field reaches a few millimetres, and the block turns meanwhile.
            tolerance: 0.01,
            source: "one impact of an edge without friction",
        }
        .check();
    }
}

/// The ball of the study on a table at rest, without gravity.
const ON_A_TABLE_AT_REST: &str = r#"
scene = "shaker"
[set]
"support.table.motion.oscillate.amplitude" = 0
"world.gravity" = [0, 0, 0]
"time.end" = 0.1
"body.ball.position" = [0, 0, 0.02]
"body.ball.velocity" = [0, 0, -0.6]
[keep]
speed = { last = "ball.vz" }
"#;

/// The coefficient of restitution of the ball.
fn restitution() -> f64 {
    let study = Study::parse("rest.toml", ON_A_TABLE_AT_REST, Path::new(""), &[]);
    Studied::new(&study.unwrap_or_else(|errors| panic!("{errors}")), &[0]).numbers("speed")[0] / 0.6
}

#[test]
fn bounces_fork_where_the_map_of_impacts_says() {
    let study = Studied::ready("bounce-bifurcation");
    let strength = |amplitude: f64| amplitude * (TAU * 10.0).powi(2) / 9.81;
    let studied = Studied::new(&study, &[80, 100, 110, 120]);
    let spread = |apexes: &Vec<f64>| {
        let (low, high) = apexes.iter().fold((f64::MAX, f64::MIN), |(a, b), z| (a.min(*z), b.max(*z)));
        assert_eq!(apexes.len(), 32);
        high - low
    };
    let forks: Vec<(f64, f64)> = studied
        .numbers("amplitude")
        .iter()
        .zip(&studied.lists("apex"))
        .map(|(amplitude, apexes)| (strength(*amplitude), spread(apexes)))
        .collect();
    println!("Γ, spread of the apexes [m]: {forks:?}");
    assert!(forks[0].1 < 1e-5 && forks[1].1 > 1e-3);
    // The fork opens as a square root: its square goes linearly to zero, here by a parabola through three.
    let squares: Vec<(f64, f64)> = forks[1..].iter().map(|(strength, spread)| (spread * spread, *strength)).collect();
    let weight =
        |k: usize| (0..3).filter(|j| *j != k).map(|j| squares[j].0 / (squares[j].0 - squares[k].0)).product::<f64>();
    let onset: f64 = (0..3).map(|k| weight(k) * squares[k].1).sum();
    let e = restitution();
    let expected = (PI * (1.0 - e) / (1.0 + e)).hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2));
    println!("e = {e:.5}");
    Answer {
        row: None,
        case: "study bounce-bifurcation",
        quantity: "acceleration of the table at which one bounce becomes two, over g",
        reference: expected,
        measured: onset,
        // An impact takes a few ms of a period of 100 ms, and the parabola leaves something.
        tolerance: 1e-2,
        source: "eigenvalue −1 of the map of impacts",
    }
    .check();
}
