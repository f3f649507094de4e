//! Soft bodies that meet in the measure with a tension: without loss their energy stays, and a body and its mirror
//! image move as one of them on a plane, with half its d₀.

use gyration_validation::{Case, Experiment, Run, largest};

const HEAD: &str = "world = { gravity = [0, 0, 0] }\n";
const LAW: &str = "measure = \"deformed_area_potential\"";
const PRECISE: &str = "solver = { rtol = 1e-10, atol = 1e-12 }\n";

fn soft(name: &str, shape: &str, axis: [f64; 3], place: [f64; 3], velocity: [f64; 3]) -> String {
    format!(
        r#"
        [[body]]
        name = "{name}"
        shape = {shape}
        density = 1000
        affine = {{ material = {{ neo_hookean_log = {{ mu = 6000, lambda = 9000 }} }} }}
        position = {place:?}
        velocity = {velocity:?}
        orientation = {{ axis_angle = {{ axis = {axis:?}, angle = 0.5 }} }}
        "#
    )
}

/// Σ m ṗ₀ along an axis [kg m/s] at a sample.
fn momentum(run: &Run, masses: [f64; 2], axis: &str, sample: usize) -> f64 {
    let of = |name: &str| run.column(&format!("{name}.v{axis}"))[sample];
    masses[0] * of("a") + masses[1] * of("b")
}

#[test]
fn soft_bodies_that_collide_without_loss_keep_their_energy() {
    let shapes = [
        (
            "soft boxes collide askew, no loss, with a tension",
            "{ box = { size = [0.1, 0.08, 0.06] } }",
            "{ box = { size = [0.07, 0.1, 0.09] } }",
            [0.48, 0.63],
        ),
        (
            "a soft ellipsoid strikes a soft box, no loss, with a tension",
            "{ ellipsoid = { semi_axes = [0.06, 0.05, 0.04] } }",
            "{ box = { size = [0.1, 0.08, 0.06] } }",
            [std::f64::consts::PI * 4.0 / 3.0 * 0.12, 0.48],
        ),
    ];
    for (name, one, other, masses) in shapes {
        let bodies = soft("a", one, [1.0, 2.0, 0.0], [0.01, 0.02, 0.1], [0.1, 0.0, -0.8])
            + &soft("b", other, [2.0, 0.0, 1.0], [0.0, 0.0, -0.1], [0.0, 0.1, 0.8]);
        let contact = format!(
            "[[contact]]\nbetween = [\"a\", \"b\"]\n{LAW}\nrepulsion = {{ alpha = \"4 kPa\", nu = 6, d0 = \"5 mm\" }}\n"
        );
        let scene = |solver: &str| format!("{solver}{HEAD}time = {{ end = 0.3, sample = 0.01 }}\n{contact}{bodies}");
        let case = Case { row: None, name, source: "conservation of energy" };
        for (quantity, solver) in
            [("largest change of energy over that in play", PRECISE), ("the same at the default tolerances", "")]
        {
            let run = Experiment::of_scene(&scene(solver)).run();
            let parts = ["kinetic", "elastic", "contact"].map(|part| run.column(&format!("energy.{part}")));
            assert!(!run.has("work.repulsion"), "an energy, and no work");
            let sums: Vec<f64> = (0..run.times.len()).map(|k| parts.iter().map(|part| part[k]).sum()).collect();
            let last = sums.len() - 1;
            assert!(largest(parts[1].clone()) > 0.02 * run.energy_in_play, "they are to ring");
            assert!(run.column("a.vz")[last] > 0.1 && run.column("b.vz")[last] < -0.1, "they have met");
            case.check(quantity, 0.0, largest(sums.iter().map(|sum| sum - sums[0])) / run.energy_in_play, 1e-7);
            if solver == PRECISE {
                let case = case.by("action and reaction");
                for (quantity, axis) in [
                    ("change of momentum along x [kg m/s]", "x"),
                    ("change of momentum along y [kg m/s]", "y"),
                    ("change of momentum along z [kg m/s]", "z"),
                ] {
                    let change = momentum(&run, masses, axis, last) - momentum(&run, masses, axis, 0);
                    // Rounding of some thousand steps with momenta of half a unit.
                    case.check(quantity, 0.0, change, 1e-12);
                }
            }
        }
    }
}

#[test]
fn a_soft_body_and_its_mirror_image_move_as_one_of_them_on_a_plane() {
    let shape = "{ ellipsoid = { semi_axes = [0.06, 0.05, 0.04] } }";
    let law = |d0: f64| format!("{LAW}\nrepulsion = {{ alpha = \"4 kPa\", nu = 6, d0 = {d0:?} }}\n");
    let above = soft("a", shape, [1.0, 2.0, 0.5], [0.1, 0.2, 0.1], [0.2, 0.1, -0.8]);
    let below = soft("b", shape, [-1.0, -2.0, 0.5], [0.1, 0.2, -0.1], [0.2, 0.1, 0.8]);
    let head = format!("solver = {{ rtol = 1e-11, atol = 1e-13 }}\n{HEAD}time = {{ end = 0.2, sample = 0.2 }}\n");
    let pair = format!("{head}[[contact]]\nbetween = [\"a\", \"b\"]\n{}{above}{below}", law(0.01));
    let support = "[[support]]\nname = \"plane\"\nplane = {}\n";
    let plane = format!("{head}{support}[[contact]]\nsupport = \"plane\"\n{}{above}", law(0.005));
    let [pair, plane] = [pair, plane].map(|scene| Experiment::of_scene(&scene));
    let (pair_run, plane_run) = (pair.run(), plane.run());
    let (one, other) = (pair_run.end.motion(&pair.model, 0), plane_run.end.motion(&plane.model, 0));
    assert!(other.velocity.velocity.z > 0.1, "it has come back");
    let case = Case {
        row: None,
        name: "a soft ellipsoid and its mirror image, with a tension",
        source: "one of them on a plane, d₀/2",
    };
    let (found, wanted) = (one.placement, other.placement);
    case.check("z at the end [m]", wanted.position.z, found.position.z, 1e-9);
    case.check("P_xy at the end", wanted.gradient[(0, 1)], found.gradient[(0, 1)], 1e-8);
    case.check("P_zz at the end", wanted.gradient[(2, 2)], found.gradient[(2, 2)], 1e-8);
}
