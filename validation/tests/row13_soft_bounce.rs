//! Row 13 with bodies that deform: a bounce without loss.
//!
//! A face that stays level is pushed without being stretched in the measures `deformed_area` and `reference_area`: it
//! turns at the gap of the rigid one. In `deformed_area_potential` a tension ∫U dA acts in its plane; a stiff face
//! tends to the rigid one as 1/stiffness. A soft body takes energy into its vibrations, and the sum stays: exactly
//! where repulsion has a potential; by the ledger of works in `deformed_area`.

use gyration::contact::{AreaMeasure, ContactLaw, Repulsion};
use gyration::material::{Material, MooneyRivlin};
use gyration_sim::Tolerance;
use gyration_validation::{Case, Experiment, FacetBody, largest};

const ROW: Option<u32> = Some(13);
const MASS: f64 = 0.5;
const AREA: f64 = 0.01;
const ALPHA: f64 = 1e-4;
const FIRST_GAP: f64 = 0.1;
const FAR_SPEED: f64 = 0.8;

/// The gap at which a face with ν = 3 turns [m], of c₁ + c₂ = `stiffness` [Pa].
fn turning_gap(measure: AreaMeasure, stiffness: f64) -> f64 {
    let potential = ALPHA * AREA * FIRST_GAP.powi(-2) / 2.0;
    let body = FacetBody {
        mass: MASS,
        area: AREA,
        laws: vec![ContactLaw::Repulsion(Repulsion { alpha: ALPHA, exponent: 3.0, reference_gap: 1.0 })],
        gravity: 0.0,
        gap: FIRST_GAP,
        tilt: 0.0,
        velocity: -(FAR_SPEED.powi(2) - 2.0 * potential / MASS).sqrt(),
    };
    let material = Material::MooneyRivlin(MooneyRivlin { c1: 0.75 * stiffness, c2: 0.25 * stiffness, bulk: None });
    let mut experiment = body.deformable(material, measure, Tolerance { rtol: 1e-11, atol: 1e-13 });
    experiment.plan.end = 2.0 * FIRST_GAP / FAR_SPEED;
    let turn = experiment.run().times_of("closest_approach")[0];
    experiment.motion_at(turn).placement.position.z
}

#[test]
fn deformable_face_turns_where_the_rigid_one_does() {
    let case = Case { row: ROW, name: "bounce of one deformable face, ν = 3", source: "d_min = √(αA/(m v²))" };
    let rigid = (ALPHA * AREA / (MASS * FAR_SPEED * FAR_SPEED)).sqrt();
    for (measure, quantity) in [
        (AreaMeasure::DeformedArea, "smallest gap in deformed_area [m]"),
        (AreaMeasure::ReferenceArea, "smallest gap in reference_area [m]"),
    ] {
        case.check(quantity, rigid, turning_gap(measure, 1e3), 1e-9);
    }
    let deviation = |stiffness| turning_gap(AreaMeasure::DeformedAreaPotential, stiffness) / rigid - 1.0;
    let [soft, stiff] = [2e6, 4e6].map(deviation);
    println!("relative deviation of the gap at 2 and 4 MPa: {soft:.3e}, {stiff:.3e}");
    let case = case.by("1/stiffness");
    case.check("deviation of the gap in deformed_area_potential, stiffness over twice it", 2.0, soft / stiff, 2e-2);
    case.check("smallest gap in the limit, from two stiffnesses [m]", rigid, rigid * (1.0 + 2.0 * stiff - soft), 1e-5);
}

/// A soft body dropped on a table that takes nothing, in a measure.
fn dropped(measure: &str, (shape, end): (&str, f64), solver: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        {solver}
        time = {{ end = {end}, sample = 0.01 }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        measure = "{measure}"
        repulsion = {{ alpha = "4 kPa", nu = 6, d0 = "5 mm" }}
        [[body]]
        name = "body"
        shape = {shape}
        density = 1000
        affine = {{ material = {{ mooney_rivlin = {{ c1 = 9000, c2 = 3000 }} }} }}
        position = [0, 0, 0.3]
        orientation = {{ axis_angle = {{ axis = [1, 2, 0], angle = 0.5 }} }}
        "#
    ))
}

#[test]
fn lossless_soft_bounce_keeps_its_energy() {
    const PRECISE: &str = "solver = { rtol = 1e-10, atol = 1e-12 }";
    let shapes = [
        ("soft ellipsoid dropped from 0.3 m, no loss", "{ ellipsoid = { semi_axes = [0.06, 0.05, 0.04] } }", 0.32),
        ("soft box dropped askew from 0.3 m, no loss", "{ box = { size = [0.1, 0.08, 0.06] } }", 0.6),
    ];
    for (name, shape, end) in shapes {
        let case = Case { row: ROW, name, source: "conservation of energy" };
        for (measure, quantity, loose) in [
            (
                "reference_area",
                "largest change of energy over that in play, reference_area",
                "the same at the default tolerances, reference_area",
            ),
            (
                "deformed_area_potential",
                "largest change of energy over that in play, deformed_area_potential",
                "the same at the default tolerances, deformed_area_potential",
            ),
        ] {
            let change = |solver| {
                let run = dropped(measure, (shape, end), solver).run();
                let parts =
                    ["kinetic", "gravity", "elastic", "contact"].map(|part| run.column(&format!("energy.{part}")));
                let sums: Vec<f64> = (0..run.times.len()).map(|k| parts.iter().map(|part| part[k]).sum()).collect();
                assert!(largest(parts[2].clone()) > 0.02 * run.energy_in_play, "it is to ring");
                largest(sums.iter().map(|sum| sum - sums[0])) / run.energy_in_play
            };
            case.check(quantity, 0.0, change(PRECISE), 1e-7);
            case.check(loose, 0.0, change(""), 1e-7);
        }
        let run = dropped("deformed_area", (shape, end), PRECISE).run();
        let exchanged = run.column("work.repulsion");
        println!("{name}: work of repulsion from 0 to {:.2e} J", exchanged[exchanged.len() - 1]);
        let case = case.by("the ledger of works");
        case.check("residual over the energy in play, deformed_area", 0.0, run.relative_residual(), 1e-7);
    }
}
