//! Lattices in time: bodies that meet across cells, drift together and stray.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::dynamics::{Workspace, rates};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Scene;
use gyration_sim::modes::bands::StrainedCell;
use gyration_sim::survey::modes;
use gyration_sim::{FirstSteps, Job, MemorySink, Outcome, Reason, Remarks, RunPlan, Simulation, Unwatched};

/// Balls in a row that press on one another.
fn balls(lattice: &str, body: &str, contact: &str) -> Scene {
    let text = format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 40, sample = 1 }}
        [lattice]
        cell = [[0.0403, 0, 0]]
        {lattice}
        [[body]]
        name = "a"
        density = 1000
        shape = {{ sphere = {{ radius = 0.02 }} }}
        {body}
        [[contact]]
        between = ["a", "a"]
        repulsion = {{ alpha = 100, nu = 6, d0 = 1e-4 }}
        {contact}
        "#
    );
    parsed(&text, &[])
}

fn run(scene: &Scene) -> (Outcome, Vec<Vec3>, f64) {
    let job = Job::of(scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    let motion = |body: usize| simulation.state().motion_in_space(job.model, body);
    let places = (0..job.model.bodies.len()).map(|body| motion(body).placement.position).collect();
    (outcome, places, simulation.run_state().largest_residual)
}

#[test]
fn a_ring_of_balls_drifts_far_and_resumes_to_the_same_bytes() {
    // A thousand cells away, which is more than a ball may stray alone.
    let scene = balls("repeat = [5, 1, 1]", "velocity = [1, 0, 0]", "reach = 0.002");
    let steps = FirstSteps::of(&Job::of(&scene, &provenance()), 8).unwrap();
    // Round a ring the angular momentum is none.
    let kept = steps.momenta.unwrap();
    assert!(kept.momentum < 1e-14 && kept.angular_momentum.is_none(), "{steps:?}");
    assert!(steps.windows > 0 && steps.difference.is_none(), "{steps:?}");
    let (outcome, places, residual) = run(&scene);
    assert_eq!(outcome, Outcome::Completed);
    for (cell, place) in places.iter().enumerate() {
        let expected = Vec3::new(40.0 + 0.0403 * cell as f64, 0.0, 0.0);
        // Steps may err by 1e-9 of the way.
        assert!((place - expected).norm() < 1e-7, "{cell}: {place}");
    }
    assert!(residual < 1e-12, "{residual:e}");
}

#[test]
fn a_ball_that_leaves_its_neighbours_strays() {
    // Two balls a cell, one of which flies off across the row.
    let scene = balls("repeat = [2, 1, 1]", "", "");
    let text = scene.text().replace("cell = [[0.0403, 0, 0]]", "cell = [[0.0806, 0, 0]]");
    let text = text.replace(
        "[[contact]]",
        "[[body]]\nname = \"b\"\ndensity = 1000\nshape = { sphere = { radius = 0.02 } }\nposition = [0.0403, 0, 0]\n\
         velocity = [0, 1, 0]\n[[contact]]",
    );
    let scene = parsed(&text.replace("between = [\"a\", \"a\"]", "between = [\"a\", \"b\"]"), &[]);
    let (outcome, ..) = run(&scene);
    let Outcome::Stopped(stop) = outcome else { panic!("{outcome:?}") };
    assert!(stop.reason == Reason::Strayed && stop.what.contains("\"b-0\""), "{stop:?}");
    // Half a cell at 1 m/s, less what the neighbours give.
    assert!((stop.time - 0.0403).abs() < 1e-3, "{}", stop.time);
}

#[test]
fn a_cell_of_one_body_is_a_system_with_its_images() {
    let found = modes(&balls("", "", ""));
    let [system] = &found.systems[..] else { panic!("{:?}", found.systems) };
    let rest = system.rest_state.as_ref().unwrap();
    assert_eq!((rest.modes.len(), found.bodies[0].system), (6, Some(0)));
    let [(_, place)] = &rest.bodies.0[..] else { panic!("{:?}", rest.bodies) };
    assert!((place.gap.unwrap() - 3e-4).abs() < 1e-12);
}

/// The forces on the first bodies of a row of six, and the energy of the contacts.
fn pushed(text: &str) -> Vec<f64> {
    let scene = parsed(text, &[]);
    let built = scene.built();
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; built.state.bodies.len()], vec![0.0; built.model.works().len()]);
    rates(&built.model, &mut workspace, 0.0, built.state.numbers(), &mut slopes, &mut powers).unwrap();
    (0..6).map(|body| slopes[built.model.slots(body).velocity().start]).collect()
}

#[test]
fn no_pair_of_a_row_with_free_ends_is_left_out_without_a_reach() {
    let start = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n[[contact]]\nbetween = [\"g\", \
        \"g\"]\nrepulsion = { alpha = 100, nu = 2.5, d0 = 0.02 }\n";
    let ball = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\ngroup = \"g\"\ndensity = 1000\nposition = [{x}, 0, 0]\n\
             shape = {{ sphere = {{ radius = 0.01 }} }}\n"
        )
    };
    let written: String = (0..6).map(|k| ball(&format!("a{k}"), 0.1 * f64::from(k))).collect();
    let lattice = format!("[lattice]\ncell = [[0.1, 0, 0]]\nrepeat = [6, 1, 1]\nperiodic = false\n{}", ball("a", 0.0));
    let (expected, found) = (pushed(&format!("{start}{written}")), pushed(&format!("{start}{lattice}")));
    let off = expected.iter().zip(&found).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
    println!("off by {off:e} of {:e}", expected[0]);
    // Places are sums in another order.
    assert!(off < 1e-12 * expected[0].abs(), "{expected:?}, {found:?}");
}

#[test]
fn a_body_that_outgrows_its_cell_strays() {
    let growing = "affine = {}\ngradient_rate = [[0, 0, 0], [0, 10, 0], [0, 0, 0]]";
    let (outcome, ..) = run(&balls("repeat = [3, 1, 1]", growing, "measure = \"reference_area\"\nreach = 0.002"));
    let Outcome::Stopped(stop) = outcome else { panic!("{outcome:?}") };
    assert!(stop.reason == Reason::Strayed && stop.what.contains("\"a-"), "{stop:?}");
    // Half a cell, 0.02015 m, beyond a radius of 0.02 m that grows at 0.2 m/s.
    assert!((stop.time - 0.10075).abs() < 1e-3, "{}", stop.time);
}

#[test]
fn images_that_matter_and_are_left_out_are_told() {
    let told = |lattice: &str, nu: f64, contact: &str| {
        let text = format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n[lattice]\ncell = [[0.1, 0, 0]]\n\
             {lattice}\n[[body]]\nname = \"a\"\ndensity = 1000\nshape = {{ sphere = {{ radius = 0.01 }} \
             }}\n[[contact]]\nbetween = [\"a\", \"a\"]\nrepulsion = {{ alpha = 100, nu = {nu}, d0 = 0.02 }}\n{contact}\n"
        );
        let scene = parsed(&text, &[]);
        let built = scene.built();
        let told = Remarks::at_start(&built.model, &built.state, &RunPlan::from(built)).warnings;
        told.iter().any(|warning| warning.contains("images of the lattice farther than 0.2 m are left out"))
    };
    for lattice in ["repeat = [6, 1, 1]", "", "repeat = [2, 1, 1]"] {
        assert!(told(lattice, 2.5, "") && told(lattice, 6.0, ""), "{lattice}");
        assert!(!told(lattice, 2.5, "reach = 0.45") && !told(lattice, 40.0, ""), "{lattice}");
    }
    assert!(!told("repeat = [6, 1, 1]\nperiodic = false", 2.5, ""));
}

/// Two shells of Lennard-Jones in a chain that is written too short: six cells of a ring have the waves of κ = n/6 of
/// the cell whose vectors rest, a = 1.1196.
#[test]
fn the_modes_of_a_ring_are_its_bands_where_its_cells_rest_too() {
    let bond = |cells: u32| {
        format!("[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [{cells}, 0, 0]\nlaw = \"4*(l^-12 - l^-6)\"\n")
    };
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n[lattice]\ncell = [[1.1, 0, 0]]\n\
         repeat = [6, 1, 1]\nrelax = [\"granules\", \"cell\"]\n[[body]]\nname = \"a\"\n\
         shape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\nkeep = {{ line = [1, 0, 0] }}\n{}{}",
        bond(1),
        bond(2)
    );
    let found = modes(&parsed(&text, &[]));
    let rest = found.systems[0].rest_state.as_ref().unwrap_or_else(|| panic!("{:?}", found.systems));
    let place = |body: usize| rest.bodies.0[body].1.position[0];
    assert!((place(1) - place(0) - 1.119_610_866_3).abs() < 1e-9);
    let frequencies: Vec<f64> = rest.modes.iter().map(|mode| mode.frequency).collect();
    // κ = 0, 1/6 and 5/6, 1/3 and 2/3, 1/2, from the second derivatives of the law at a and 2a.
    let stiffness = |l: f64| 4.0 * (156.0 * l.powi(-14) - 42.0 * l.powi(-8));
    let [near, far] = [1.0, 2.0].map(|cells| stiffness(cells * (place(1) - place(0))));
    let omega = |kappa: f64| {
        let shells =
            [(near, 0.5), (far, 1.0)].map(|(k, half)| 4.0 * k * (std::f64::consts::TAU * kappa * half).sin().powi(2));
        (shells[0] + shells[1]).sqrt()
    };
    let expected = [0.0, omega(1.0 / 6.0), omega(1.0 / 6.0), omega(1.0 / 3.0), omega(1.0 / 3.0), omega(0.5)];
    assert_eq!(frequencies.len(), 6);
    for (found, expected) in frequencies.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    assert!((frequencies[5] - 15.526_001).abs() < 1e-5);
    // What has no cell at rest says so in the place of modes.
    let loose = text.replace("4*(l^-12 - l^-6)", "l^-12");
    let found = modes(&parsed(&loose, &[]));
    let said = found.systems[0].no_rest_state_because.as_ref().unwrap();
    assert!(said.contains("cell"), "{said}");
}

/// Two blocks whose relaxed shapes flow, in a chain of natural length 0.385. Symptom: no force is left at any length,
/// so that the cell walked at random: stretches of 0.17 and 0.12, or a refusal, by the order of the bodies.
#[test]
fn a_cell_whose_bodies_flow_rests_at_its_natural_length() {
    let block = |name: &str, place: f64, drag: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\ndensity = 1000\n\
             position = [{place:?}, 0, 0]\ncontractile = {{ contraction_viscosity = {drag:?}, \
             material = {{ st_venant_kirchhoff = {{ lambda = 0, mu = 500 }} }} }}\n"
        )
    };
    let spring = |ends: [&str; 2], cell: u32, law: [f64; 2]| {
        let [stiffness, rest_length] = law;
        format!(
            "[[spring]]\nbetween = {ends:?}\ncell = [{cell}, 0, 0]\npoints = [[0.05, 0, 0], [-0.05, 0, 0]]\n\
             stiffness = {stiffness:?}\nrest_length = {rest_length:?}\n"
        )
    };
    let (a, b) = (block("a", 0.0, 25.0), block("b", 0.2, 60.0));
    for bodies in [format!("{a}{b}"), format!("{b}{a}")] {
        let text = format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n[lattice]\ncell = [[0.4, 0, 0]]\n\
             relax = [\"granules\", \"cell\"]\n{bodies}{}{}",
            spring(["a", "b"], 0, [50.0, 0.09]),
            spring(["b", "a"], 1, [40.0, 0.095])
        );
        let scene = parsed(&text, &[]);
        let cell = scene.built().cell.as_ref().unwrap();
        let rest = StrainedCell::new(&cell.model, &cell.state).at_rest(cell.load.unwrap());
        let rest = rest.unwrap_or_else(|error| panic!("{error}"));
        let (_, waves) = rest.at(&Mat3::identity()).unwrap_or_else(|error| panic!("{error}"));
        assert!((rest.rest().m11 - 0.385 / 0.4).abs() < 1e-9, "{}", rest.rest());
        for body in &waves.rest().bodies {
            assert!((body.stretches - Vec3::repeat(1.0)).norm() < 1e-9, "{}", body.stretches);
        }
    }
}
