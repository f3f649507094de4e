//! Row 13: a bounce without loss, of one face without gravity and of a ball under it.
//!
//!   ν = 3: d = √(d_min² + v²t²), d_min = √(αA/(m v²));   any ν: d_min = (2αA/((ν−1)m v²))^(1/(ν−1))
//!
//! v is the speed far away, ½m v² = ½m v₀² + αA d₀^(1−ν)/(ν−1). Over 100 bounces under gravity the apex must stay.

use gyration::contact::{ContactLaw, Repulsion};
use gyration_sim::Tolerance;
use gyration_validation::{Answer, Case, Experiment, FacetBody, largest};

const ROW: Option<u32> = Some(13);
const AREA: f64 = 0.01;
const MASS: f64 = 0.5;
const FAR_SPEED: f64 = 0.8;
const FIRST_GAP: f64 = 0.1;

/// A face that comes from far away at `FAR_SPEED`, caught at `FIRST_GAP`.
fn facet(alpha: f64, nu: f64) -> Experiment {
    let potential = alpha * AREA * FIRST_GAP.powf(1.0 - nu) / (nu - 1.0);
    let law = ContactLaw::Repulsion(Repulsion { alpha, exponent: nu, reference_gap: 1.0 });
    let body = FacetBody {
        mass: MASS,
        area: AREA,
        laws: vec![law],
        gravity: 0.0,
        gap: FIRST_GAP,
        tilt: 0.0,
        velocity: -(FAR_SPEED.powi(2) - 2.0 * potential / MASS).sqrt(),
    };
    body.experiment(Tolerance { rtol: 1e-11, atol: 1e-13 })
}

fn closest(alpha: f64, nu: f64) -> f64 {
    (2.0 * alpha * AREA / ((nu - 1.0) * MASS * FAR_SPEED.powi(2))).powf(1.0 / (nu - 1.0))
}

#[test]
fn face_follows_the_hyperbola_of_the_cube_law() {
    let least = closest(1e-4, 3.0);
    // d = √(d_min² + v²(t−T)²) with the closest approach at T.
    let turn = (FIRST_GAP.powi(2) - least.powi(2)).sqrt() / FAR_SPEED;
    let mut experiment = facet(1e-4, 3.0);
    experiment.plan.end = 2.5 * turn;
    experiment.plan.sample = turn / 16.0;
    let run = experiment.run();
    let gaps = run.column("facet.gap");
    let exact = |time: f64| least.hypot(FAR_SPEED * (time - turn));
    let error = largest(run.times.iter().zip(&gaps).map(|(time, gap)| gap / exact(*time) - 1.0));
    Answer {
        row: ROW,
        case: "bounce of one face, ν = 3",
        quantity: "largest relative error of the gap, samples in and between steps",
        reference: 0.0,
        measured: error,
        // rtol is 1e-11 of the gap at each of some 50 steps; the bounce magnifies errors of time by v/d.
        tolerance: 1e-8,
        source: "d = √(d_min² + v²t²)",
    }
    .check();
}

#[test]
fn face_turns_at_the_gap_where_the_potential_has_all_energy() {
    let cases = [
        ("bounce of one face, ν = 3", 1e-4, 3.0),
        ("bounce of one face, ν = 4.5", 1e-6, 4.5),
        ("bounce of one face, ν = 9", 1e-14, 9.0),
    ];
    for (case, alpha, nu) in cases {
        let mut experiment = facet(alpha, nu);
        experiment.plan.end = 2.0 * FIRST_GAP / FAR_SPEED;
        let turn = experiment.run().times_of("closest_approach")[0];
        Answer {
            row: ROW,
            case,
            quantity: "smallest gap [m]",
            reference: closest(alpha, nu),
            measured: experiment.motion_at(turn).placement.position.z,
            tolerance: 1e-9,
            source: "(2αA/((ν−1)m v²))^(1/(ν−1))",
        }
        .check();
    }
}

/// A ball dropped from 0.5 m on a table that takes nothing, long enough for 100 bounces.
fn ball(solver: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        {solver}
        [time]
        end = 70.0
        sample = 1.0
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = "40 kPa", nu = 6, d0 = "2 mm" }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = "5 cm" }} }}
        density = 1000
        position = [0, 0, 0.55]
        "#
    ))
}

#[test]
fn ball_keeps_its_apex_over_a_hundred_bounces() {
    const BOUNCES: usize = 100;
    // The apex is to stay to 1e-6 at the default rtol = 1e-8; a bounce errs by about rtol, and always in one sense.
    let cases = [
        ("ball dropped from 0.5 m, 100 bounces, default tolerances", "", 1e-6),
        ("ball dropped from 0.5 m, 100 bounces, rtol = 1e-10", "solver = { rtol = 1e-10, atol = 1e-12 }", 2e-8),
    ];
    for (case, solver, tolerance) in cases {
        let experiment = ball(solver);
        let run = experiment.run();
        let apexes = run.times_of("apex");
        assert!(apexes.len() >= BOUNCES, "{} apexes", apexes.len());
        let case = Case { row: ROW, name: case, source: "conservation of energy" };
        let apex = experiment.motion_at(apexes[BOUNCES - 1]).placement.position.z;
        case.check("height of the centre at the apex after 100 bounces [m]", 0.55, apex, tolerance);
        case.check("largest residual of the ledger over the energy in play", 0.0, run.relative_residual(), tolerance);
    }
}
