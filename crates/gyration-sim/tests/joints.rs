//! Joined bodies in runs: what resumes, what depends on numbers, what both methods agree in.

use crate::islands::parsed;
use crate::resumption::resumes_after_every_window;
use crate::sensitivities::support::{TIGHT, disagreement, strings};
use gyration::dynamics::Workspace;
use gyration_sim::{FirstSteps, Job, MemorySink, MomentumChange, Outcome, Provenance, Reason, Simulation, Unwatched};
use nalgebra::UnitQuaternion;

/// Two links, a rubber block on the lower and a ball on a spring, over a table.
pub const ARM: &str = r#"
    [time]
    end = 0.5
    sample = 0.05
    [[support]]
    name = "table"
    plane = { origin = [0, 0, -0.52] }
    [[contact]]
    support = "table"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "2 mm" }
    damping = { beta = 1e3, nu = 3, d0 = "2 mm" }
    friction = { beta = 1e3, nu = 3, d0 = "2 mm" }
    [[body]]
    name = "upper"
    shape = { box = { size = [0.2, 0.04, 0.06] } }
    density = 1000
    position = [0.1, 0, 0]
    [[body]]
    name = "lower"
    shape = { box = { size = [0.2, 0.06, 0.04] } }
    density = 1000
    position = [0.3, 0, 0]
    [[body]]
    name = "block"
    shape = { box = { size = [0.1, 0.1, 0.08] } }
    density = 1000
    affine = { material = { neo_hookean_log = { lambda = "60 kPa", mu = "30 kPa" } }, viscosity = 20 }
    position = [0.45, 0, 0]
    [[body]]
    name = "ball"
    shape = { sphere = { radius = 0.04 } }
    density = 1000
    position = [0.1, 0.3, 0]
    [[spring]]
    between = ["upper", "ball"]
    points = [[0.1, 0, 0], [0, 0, 0]]
    stiffness = 30
    [[joint]]
    name = "shoulder"
    between = ["space", "upper"]
    kind = "hinge"
    points = [[0, 0, 0], [-0.1, 0, 0]]
    axis = [0, 1, 0.2]
    [[joint]]
    name = "elbow"
    between = ["upper", "lower"]
    kind = "ball"
    points = [[0.1, 0, 0], [-0.1, 0, 0]]
    [[joint]]
    name = "wrist"
    between = ["lower", "block"]
    kind = "ball"
    points = [[0.1, 0, 0], [-0.05, 0, 0]]
"#;

#[test]
fn an_arm_resumes_after_every_window() {
    resumes_after_every_window(&parsed(ARM, &[]), 200);
    resumes_after_every_window(&parsed(ARM, &["solver.method=\"implicit\""]), 60);
}

#[test]
fn both_methods_agree_on_an_arm_and_close_its_ledger() {
    let end = |method: &str| {
        let scene = parsed(ARM, &[&format!("solver.method=\"{method}\""), "solver.rtol=1e-9", "solver.atol=1e-12"]);
        let job = Job::of(&scene, &Provenance { version: "test".into(), commit: None });
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap();
        let relative = simulation.run_state().largest_residual / simulation.energy_in_play();
        let misfits = Workspace::default().joint_misfits(job.model, &simulation.state()).unwrap();
        println!("{method}: residual {relative:.1e}, {:?}, {misfits:?}", simulation.statistics());
        assert!(relative < 1e-7, "{method}: {relative:e}");
        assert!(misfits.iter().all(|misfit| misfit.place.max(misfit.turn) < 2e-16), "{misfits:?}");
        assert!(misfits.iter().all(|misfit| misfit.velocity.max(misfit.spin) < 1e-14), "{misfits:?}");
        sink.rows.pop().unwrap().1
    };
    let [explicit, implicit] = ["explicit", "implicit"].map(end);
    let apart = explicit.iter().zip(&implicit).take(12).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-6, "places are apart by {apart:e} m");
}

#[test]
fn an_isolated_linkage_keeps_its_momenta() {
    let start = ARM.find("    [[support]]").unwrap();
    let bodies = ARM.find("    [[body]]").unwrap();
    let shoulder = ARM.find("    [[joint]]").unwrap();
    let elbow = ARM[shoulder + 8..].find("    [[joint]]").unwrap() + shoulder + 8;
    let text =
        format!("world = {{ gravity = [0, 0, 0] }}\n{}{}{}", &ARM[..start], &ARM[bodies..shoulder], &ARM[elbow..]);
    let scene = parsed(&text, &[]);
    let FirstSteps { momenta, .. } =
        FirstSteps::of(&Job::of(&scene, &Provenance { version: "test".into(), commit: None }), 100).unwrap();
    let MomentumChange { momentum: linear, angular_momentum } = momenta.unwrap();
    let angular = angular_momentum.unwrap();
    println!("momentum {linear:.1e}, angular {angular:.1e}");
    assert!(linear < 1e-14 && angular < 1e-8);
}

#[test]
fn derivatives_of_an_arm_agree_with_differences_of_runs() {
    let keys = ["body.lower.density", "spring.0.stiffness", "contact.0.repulsion.alpha"];
    let quantities = ["lower.x", "lower.z", "block.P_xz", "ball.vz", "energy.kinetic", "joint.elbow.fz"];
    // The block has met the table by then.
    let overrides = [&strings(&TIGHT)[..], &["time.end=0.25".to_owned()]].concat();
    let worst = disagreement(ARM, &overrides, &keys, &quantities, 1e-4);
    assert!(worst < 1e-5, "{worst:e}");
}

/// An arm that a servo turns at 3 rad/s, from half a turn on out of reach of its angle.
#[test]
fn a_drive_that_jumps_at_half_a_turn_ends_the_run() {
    let arm = |torque: &str| {
        let text = format!(
            r#"
            [world]
            gravity = [0, 0, 0]
            [time]
            end = 4
            sample = 0.05
            [[body]]
            name = "arm"
            shape = {{ box = {{ size = [0.2, 0.04, 0.06] }} }}
            density = 1000
            position = [0.1, 0, 0]
            velocity = [0, 0, -0.3]
            angular_velocity = [0, 3, 0]
            [[joint]]
            name = "shoulder"
            between = ["space", "arm"]
            kind = "hinge"
            points = [[0, 0, 0], [-0.1, 0, 0]]
            axis = [0, 1, 0]
            drive = {{ torque = "{torque}" }}
            "#
        );
        let scene = parsed(&text, &[]);
        let built = scene.built();
        let mut simulation = Simulation::new(&built.model, &built.state, built.into()).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap()
    };
    let Outcome::Stopped(stop) = arm("10*(3*t - angle) - 2*(rate - 3)") else { panic!("it went on") };
    println!("{}: {}", stop.time, stop.what);
    assert!(stop.reason == Reason::Undefined && stop.what.contains("by 62.8 N m"), "{stop:?}");
    // The angle is 3 t up to there.
    assert!((stop.time - std::f64::consts::FRAC_PI_3).abs() < 1e-3, "{stop:?}");
    assert_eq!(arm("10*sin(3*t - angle) - 2*(rate - 3)"), Outcome::Completed);
    assert_eq!(arm("-2*(rate - 3)"), Outcome::Completed);
}

/// A parallelogram that a motor turns through its flat position at 0.2454 s, where an antiparallelogram goes on as
/// well.
const PARALLELOGRAM: &str = r#"
    [time]
    end = 0.4
    sample = 0.1
    [[body]]
    name = "crank"
    shape = { box = { size = ["10 cm", "1 cm", "1.5 cm"] } }
    density = "2.7 g/cm^3"
    position = [0, 0, 0.05]
    orientation = { axis_angle = { axis = [0, -1, 0], angle = 1.570796326794897 } }
    [[body]]
    name = "coupler"
    shape = { box = { size = ["30 cm", "1 cm", "1.5 cm"] } }
    density = "2.7 g/cm^3"
    position = [0.15, 0, 0.1]
    [[body]]
    name = "rocker"
    shape = { box = { size = ["10 cm", "1 cm", "1.5 cm"] } }
    density = "2.7 g/cm^3"
    position = [0.3, 0, 0.05]
    orientation = { axis_angle = { axis = [0, -1, 0], angle = 1.570796326794897 } }
    [[joint]]
    name = "motor"
    between = ["space", "crank"]
    kind = "hinge"
    points = [[0, 0, 0], [-0.05, 0, 0]]
    axis = [0, -1, 0]
    drive = { torque = "0.5*(2*pi*f - rate)", constants = { f = "1 Hz" } }
    [[joint]]
    name = "crank-end"
    between = ["crank", "coupler"]
    kind = "hinge"
    points = [[0.05, 0, 0], [-0.15, 0, 0]]
    axis = [0, -1, 0]
    [[joint]]
    name = "rocker-end"
    between = ["coupler", "rocker"]
    kind = "ball"
    points = [[0.15, 0, 0], [0.05, 0, 0]]
    [[joint]]
    name = "pivot"
    between = ["space", "rocker"]
    kind = "ball"
    points = [[0.3, 0, 0], [-0.05, 0, 0]]
"#;

#[test]
fn a_linkage_that_is_flat_is_passed_or_told_at_once() {
    let run = |settings: &[&str]| {
        let scene = parsed(PARALLELOGRAM, settings);
        let built = scene.built();
        let mut simulation = Simulation::new(&built.model, &built.state, built.into()).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
        (outcome, simulation.statistics().rate_evaluations, simulation.state())
    };
    let (outcome, _, state) = run(&["solver.rtol=1e-6"]);
    assert_eq!(outcome, Outcome::Completed);
    // All three are turned by as much, or not at all: it has stayed a parallelogram.
    let turn = |body: usize| 2.0 * state.bodies[13 * body + 5].atan2(state.bodies[13 * body + 3]);
    println!("turned by {} {} {}", turn(0), turn(1), turn(2));
    assert!((turn(0) - turn(2)).abs() < 1e-6 && turn(1).abs() < 1e-6);
    // Steps that get shorter without end would take half a million.
    let (outcome, evaluations, _) = run(&["solver.rtol=1e-10"]);
    let Outcome::Stopped(stop) = outcome else { panic!("{outcome:?}") };
    println!("{evaluations} evaluations, {}: {}", stop.time, stop.what);
    assert!(stop.reason == Reason::Locked && evaluations < 3_000 && (stop.time - 0.24537).abs() < 1e-4, "{stop:?}");
}

/// Symptom: which lines across the axis told the angle of a soft hinge was a matter of the axes of space, so that a
/// drive did another work in a scene that was turned.
#[test]
fn a_driven_hinge_of_soft_bodies_moves_alike_however_the_scene_lies() {
    let at_end = |turn: &UnitQuaternion<f64>, first: &str, axis: &str| {
        let [x, y, z, w] = [turn.i, turn.j, turn.k, turn.w];
        let place = turn * nalgebra::Vector3::new(0.12, 0.01, 0.0);
        let soft = "affine = { material = { neo_hookean = { shear = 1000, bulk = 2000 } } }";
        let body = |name: &str, [px, py, pz]: [f64; 3], lines: &str| {
            format!(
                "[[body]]\nname = \"{name}\"\nshape = {{ box = {{ size = [0.1, 0.08, 0.1] }} }}\ndensity = 1000\n\
                 position = [{px:?}, {py:?}, {pz:?}]\n\
                 orientation = {{ quaternion = [{w:?}, {x:?}, {y:?}, {z:?}] }}\n{lines}\n"
            )
        };
        let text = format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 0.5, sample = 0.5 }}\n\
             solver = {{ rtol = 1e-10, atol = 1e-12 }}\n{}{}[[joint]]\nname = \"h\"\nbetween = [\"a\", \"b\"]\n\
             kind = \"hinge\"\npoints = [[0.06, 0.01, 0], [-0.06, 0, 0]]\naxis = {axis}\n\
             limits = [\"-60 deg\", \"60 deg\"]\n\
             stop = {{ repulsion = {{ alpha = 1e-3, nu = 2, d0 = 0.1 }} }}\n\
             drive = {{ torque = \"0.05*sin(20*t) - 0.1*angle\" }}\n",
            body("a", [0.0; 3], first),
            body("b", place.into(), soft)
        );
        let scene = parsed(&text, &[]);
        let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        simulation.begin(&mut sink).unwrap();
        assert_eq!(simulation.run(&mut sink, &mut Unwatched).unwrap(), Outcome::Completed);
        let names: Vec<String> = job.layout().arrays.iter().map(|array| array.name.clone()).collect();
        let widths: Vec<usize> = job.layout().arrays.iter().map(|array| array.row_len()).collect();
        let row = &sink.rows.last().unwrap().1;
        ["joint_angle", "energy_kinetic"].map(|name| {
            let number = names.iter().position(|known| known == name).unwrap_or_else(|| panic!("{names:?}"));
            row[widths[..number].iter().sum::<usize>()]
        })
    };
    let soft = "affine = { material = { neo_hookean = { shear = 1000, bulk = 2000 } } }";
    // Along an axis of the body two others are as little along it.
    for (first, axis) in [("", "[0.1, 0.3, 1]"), (soft, "[0, 0, 1]"), (soft, "[1, 0, 0]"), (soft, "[1, 1, 1]")] {
        let written = at_end(&UnitQuaternion::identity(), first, axis);
        println!("soft first: {}, about {axis}: angle and energy {written:?}", !first.is_empty());
        for turned in [[0.0, 0.0, 1.0], [1.0, 0.3, -0.4], [0.2, 1.0, 0.5], [-0.7, 0.1, 0.6]] {
            let turn = UnitQuaternion::new(nalgebra::Vector3::from(turned) * 1.3);
            let found = at_end(&turn, first, axis);
            let off = (0..2).map(|k| (found[k] / written[k] - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6, "{axis}, {turned:?}: {found:?} {written:?}");
        }
    }
}

/// Symptom: what friction would take between cubes that turn together is rounding, and below zero Coulomb's bound was
/// no number.
#[test]
fn cubes_that_turn_together_far_apart_have_no_friction() {
    for (nu, friction) in [(6.0, 2.0), (12.0, 3.0), (12.0, 6.0), (8.0, 4.0), (6.0, 6.0)] {
        for (k, apart) in [0.25, 0.4, 0.7, 1.3, 2.0].into_iter().enumerate() {
            let turn = UnitQuaternion::new(nalgebra::Vector3::new(0.3, -0.8, 0.5) * (k + 1) as f64);
            let spin = nalgebra::Vector3::new(0.4, 0.7, 2.0);
            let place = turn * nalgebra::Vector3::new(apart, 0.1, 0.05);
            let velocity = spin.cross(&place);
            let cube = |name: &str, place: nalgebra::Vector3<f64>, velocity: nalgebra::Vector3<f64>| {
                let list = |v: nalgebra::Vector3<f64>| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
                format!(
                    "[[body]]\nname = \"{name}\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\n\
                     density = 1000\nposition = {}\nvelocity = {}\nangular_velocity = {}\n",
                    list(place),
                    list(velocity),
                    list(spin)
                )
            };
            let text = format!(
                "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 0.05, sample = 0.05 }}\n[[contact]]\n\
                 between = [\"a\", \"b\"]\nrepulsion = {{ alpha = 100, nu = {nu}, d0 = 1e-3 }}\n\
                 friction = {{ beta = 100, nu = {friction}, d0 = 1e-3, mu = 0.3 }}\n{}{}",
                cube("a", nalgebra::Vector3::zeros(), nalgebra::Vector3::zeros()),
                cube("b", place, velocity)
            );
            let scene = parsed(&text, &[]);
            let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
            let mut sink = MemorySink::default();
            let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
            simulation.begin(&mut sink).unwrap();
            assert_eq!(
                simulation.run(&mut sink, &mut Unwatched).unwrap(),
                Outcome::Completed,
                "{nu} {friction} {apart}"
            );
        }
    }
}
