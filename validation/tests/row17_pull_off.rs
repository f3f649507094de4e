//! Row 17: the pull-off of adhesion, (d/d₀)^−ν_a − (d/d₀)^−ν_r on a face and its integral on a sphere.
//!
//!   face:    largest at s = d/d₀ = (ν_r/ν_a)^(1/(ν_r − ν_a)), where it is βA (s^−ν_a − s^−ν_r)
//!   sphere:  largest at d = d₀ if R ≫ d₀, where it is 2πR d₀ β (1/(ν_a − 1) − 1/(ν_r − 1))
//!
//! The far side of a sphere adds (d₀/2R)^(ν_a − 1) of that. A load below the pull-off is borne, one above is not.

use gyration::contact::{Adhesion, ContactLaw, Damping};
use gyration::dynamics::Workspace;
use gyration::dynamics::jacobian;
use gyration_sim::Tolerance;
use gyration_validation::{Answer, Case as Known, Experiment, FacetBody};
use nalgebra::DMatrix;
use std::f64::consts::PI;

const ROW: Option<u32> = Some(17);
const BETA: f64 = 2000.0;
const AREA: f64 = 0.01;
const REFERENCE_GAP: f64 = 1e-3;
const MASS: f64 = 0.1;

struct Case {
    name: &'static str,
    exponents: (f64, f64),
    /// d/d₀ and force over βA at the pull-off, where the list has them.
    listed: Option<(f64, f64)>,
}

const FACES: [Case; 4] = [
    Case { name: "adhesion (4, 8), one face", exponents: (4.0, 8.0), listed: Some((1.1892071150, 0.25)) },
    Case { name: "adhesion (2, 3), one face", exponents: (2.0, 3.0), listed: Some((1.5, 0.1481481481)) },
    Case { name: "adhesion (2.5, 12), one face", exponents: (2.5, 12.0), listed: None },
    Case { name: "adhesion (1, 1.5), one face", exponents: (1.0, 1.5), listed: None },
];

/// d/d₀ and force over βA of a face at its pull-off.
fn pull_off((attractive, repulsive): (f64, f64)) -> (f64, f64) {
    let gap = (repulsive / attractive).powf(1.0 / (repulsive - attractive));
    (gap, gap.powf(-attractive) - gap.powf(-repulsive))
}

/// A face at a gap, without weight, or hanging from the plane by a load [N].
fn face((attractive, repulsive): (f64, f64), gap: f64, load: f64, damping: f64) -> Experiment {
    let adhesion = Adhesion {
        beta: BETA,
        attractive_exponent: attractive,
        repulsive_exponent: repulsive,
        reference_gap: REFERENCE_GAP,
    };
    let damping = Damping { beta: damping, exponent: attractive, reference_gap: REFERENCE_GAP, release: None };
    let body = FacetBody {
        mass: MASS,
        area: AREA,
        laws: vec![ContactLaw::Adhesion(adhesion), ContactLaw::Damping(damping)],
        gravity: -load / MASS,
        gap,
        tilt: 0.0,
        velocity: 0.0,
    };
    body.experiment(Tolerance { rtol: 1e-8, atol: 1e-10 })
}

/// A sphere at a gap.
fn sphere((attractive, repulsive): (f64, f64), radius: f64, gap: f64) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1.0, sample = 1.0 }}
        [[support]]
        name = "table"
        plane = {{ normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        adhesion = {{ beta = {BETA}, nu_attractive = {attractive}, nu_repulsive = {repulsive}, d0 = {REFERENCE_GAP} }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = {radius} }} }}
        mass = {MASS}
        position = [0, 0, {:.17e}]
        "#,
        radius + gap
    ))
}

/// Slope of the force of the plane in the gap [N/m], from the exact Jacobian: row ṗ₀z, column p₀z.
fn slope(experiment: &Experiment) -> f64 {
    let mut blocks = [DMatrix::zeros(13, 13)];
    let bodies = &experiment.start.bodies;
    jacobian(&experiment.model, &mut Workspace::default(), 0.0, bodies.into(), &mut blocks[..])
        .unwrap_or_else(|error| panic!("{error:?}"));
    MASS * blocks[0][(9, 2)]
}

/// Gap [m] at which the force has no slope, by bisection, and the attraction there [N].
fn strongest(at: impl Fn(f64) -> Experiment, (mut left, mut right): (f64, f64)) -> (f64, f64) {
    // Below the pull-off the attraction grows with the gap: the force falls.
    assert!(slope(&at(left)) < 0.0 && slope(&at(right)) > 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (left + right);
        if slope(&at(middle)) < 0.0 { left = middle } else { right = middle }
    }
    (left, -at(left).contact_force().z)
}

#[test]
fn face_is_held_most_strongly_at_the_gap_of_the_closed_form() {
    for case in FACES {
        let (gap, force) = pull_off(case.exponents);
        if let Some((listed_gap, listed_force)) = case.listed {
            // Ten digits are listed.
            assert!((gap - listed_gap).abs() < 1e-10 && (force - listed_force).abs() < 1e-10, "{gap} {force}");
        }
        let at = |gap| face(case.exponents, gap, 0.0, 0.0);
        let (found, held) = strongest(at, (REFERENCE_GAP, 3.0 * REFERENCE_GAP));
        // The largest is flat: rounding in the two powers, times their number.
        let source = "s = (ν_r/ν_a)^(1/(ν_r−ν_a)), βA (s^−ν_a − s^−ν_r)";
        let known = Known { row: ROW, name: case.name, source };
        known.check("pull-off over βA", force, held / (BETA * AREA), 1e-13);
        known.check("gap of the pull-off over d₀", gap, found / REFERENCE_GAP, 1e-13);
    }
}

#[test]
fn sphere_is_held_most_strongly_at_the_reference_gap() {
    let cases = [
        ("adhesion (4, 8), sphere of R = 100 d₀", (4.0, 8.0), 100.0),
        ("adhesion (2.5, 12), sphere of R = 10000 d₀", (2.5, 12.0), 1e4),
        ("adhesion (2, 3), sphere of R = 10000 d₀", (2.0, 3.0), 1e4),
    ];
    for (case, exponents, ratio) in cases {
        let radius = ratio * REFERENCE_GAP;
        let reference =
            2.0 * PI * radius * REFERENCE_GAP * BETA * (1.0 / (exponents.0 - 1.0) - 1.0 / (exponents.1 - 1.0));
        let (gap, held) = strongest(|gap| sphere(exponents, radius, gap), (0.9 * REFERENCE_GAP, 1.1 * REFERENCE_GAP));
        // What the far side adds to the attraction, to the force and to its slope: some times (d₀/2R)^(ν_a−1).
        let far = (0.5 / ratio).powf(exponents.0 - 1.0);
        let known =
            Known { row: ROW, name: case, source: "2πR d₀ β (1/(ν_a−1) − 1/(ν_r−1)) for R ≫ d₀" };
        known.check("pull-off [N]", reference, held, 4.0 * far + 1e-12);
        known.check("gap of the pull-off over d₀", 1.0, gap / REFERENCE_GAP, 4.0 * far + 1e-12);
    }
}

#[test]
fn face_under_a_load_leaves_at_its_pull_off() {
    // Twice the critical damping at d₀, where the stiffness is βA (ν_r − ν_a)/d₀: the load is put on without a swing.
    let exponents = (4.0, 8.0);
    let stiffness = BETA * AREA * (exponents.1 - exponents.0) / REFERENCE_GAP;
    let damping = 4.0 * (stiffness * MASS).sqrt() / AREA;
    let (gap, force) = pull_off(exponents);
    let leaves = |share: f64| {
        let load = share * force * BETA * AREA;
        let run = face(exponents, REFERENCE_GAP, load, damping).until(20.0);
        run.motion_at(20.0).placement.position.z > 2.0 * gap * REFERENCE_GAP
    };
    let (mut held, mut left) = (0.9, 1.1);
    while left - held > 2e-4 {
        let share = 0.5 * (held + left);
        if leaves(share) { left = share } else { held = share }
    }
    Answer {
        row: ROW,
        case: "adhesion (4, 8), one face hanging by a load for 20 s",
        quantity: "load at which it leaves, over the pull-off",
        reference: 1.0,
        measured: 0.5 * (held + left),
        // Bisected to 2e-4; near the pull-off leaving takes as long as the excess is small, 20 s for some 1e-5.
        tolerance: 3e-4,
        source: "0.25 βA",
    }
    .check();
}
