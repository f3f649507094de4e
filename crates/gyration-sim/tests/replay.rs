//! A recording brought back to life agrees with the run that left it.

use gyration::balance::observe;
use gyration::contact::{Action, AreaMeasure, Contact, RelativeMotion, Term};
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::shape::Triangulation;
use gyration::state::BodyMotion;
use gyration::tensor::{Mat3, Vec3, cofactor};
use gyration_record::{Recording, RowHash};
use gyration_scene::Scene;
use gyration_sim::replay::{Replay, ReplayError, SurfaceCells};
use gyration_sim::{Job, Provenance, Reason, RecordingEnd, RunSummary, Unwatched};
use std::path::{Path, PathBuf};

fn record(scene: &Scene, folder: &Path) -> Recording {
    let provenance = Provenance { version: "test".into(), commit: None };
    let path = folder.join(format!("{}.gyr", scene.name()));
    Job::of(scene, &provenance).record(&path, &mut Unwatched).unwrap();
    Recording::open(&path).unwrap()
}

fn gallery(name: &str, overrides: &[&str], folder: &Path) -> Recording {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    record(&Scene::open(name, &overrides).unwrap(), folder)
}

/// The vector of a body in a row of an array.
fn vector(recording: &Recording, array: &str, row: usize, body: usize) -> Vec3 {
    let numbers = recording.read_rows(array, row..row + 1).unwrap().data;
    Vec3::from_column_slice(&numbers[3 * body..][..3])
}

/// Bodies of all kinds, pinned ones, a support that moves; long enough to meet it.
const SCENES: [(&str, &[&str]); 7] = [
    ("dice", &["time.end=0.5"]),
    ("top", &["time.end=0.2"]),
    ("shaker", &["time.end=0.2"]),
    ("elastic-bounce-tilted", &["time.end=0.5"]),
    ("pinned-strain", &["time.end=0.2"]),
    ("hop", &["time.end=0.2"]),
    ("contract-1", &["time.end=0.2"]),
];

#[test]
fn a_replayed_state_is_the_one_recorded() {
    let folder = tempfile::tempdir().unwrap();
    for (name, overrides) in SCENES {
        let recording = gallery(name, overrides, folder.path());
        let mut replay = Replay::open(&recording).unwrap();
        let model = replay.model().clone();
        let mut worst = 0.0_f64;
        for row in (0..recording.rows()).step_by(7) {
            let state = replay.state(row).unwrap();
            for (body, of) in model.bodies.iter().enumerate() {
                let seen = observe(&model, &mut Workspace::default(), &state, body).unwrap();
                let position = vector(&recording, "position", row, body);
                assert!(
                    (seen.motion.placement.position - position).norm() < 1e-15 * (of.size + position.norm()),
                    "{name}"
                );
                let force = vector(&recording, "contact_force", row, body);
                let scale = force.norm().max(of.solid.mass.mass * model.gravity.norm());
                worst = worst.max((seen.contact_force - force).norm() / scale);
            }
        }
        println!("{name}: contact force within {worst:.1e}");
        // A rotation read from its matrix rounds to 1e-16; the lever of the size over the gap, times the exponent of
        // the law, multiplies it by 10⁴ at most here.
        assert!(worst < 1e-11, "{name}: {worst:e}");
    }
}

#[test]
fn replayed_stress_is_that_which_the_run_recorded() {
    let folder = tempfile::tempdir().unwrap();
    for (name, end) in
        [("contract-1", "time.end=0.2"), ("elastic-bounce-tilted", "time.end=0.5"), ("hop", "time.end=0.2")]
    {
        let recording = gallery(name, &[end, "record.quantities=[\"cauchy_stress\"]"], folder.path());
        let mut replay = Replay::open(&recording).unwrap();
        let mut worst = 0.0_f64;
        for row in 0..recording.rows() {
            let stress = replay.cauchy_stress(row).unwrap();
            let recorded = recording.read_rows("cauchy_stress", row..row + 1).unwrap().data;
            for (body, stress) in stress.iter().enumerate() {
                let recorded = Mat3::from_row_slice(&recorded[9 * body..][..9]);
                // Of the largest elastic modulus in these scenes, 8 kPa: a stress of zero is a difference of such.
                worst = worst.max((stress.unwrap() - recorded).norm() / recorded.norm().max(8e3));
            }
        }
        println!("{name}: stress within {worst:.1e}");
        assert!(worst < 1e-13, "{name}: {worst:e}");
    }
}

#[test]
fn the_force_between_bodies_without_friction_is_normal_and_is_had_again() {
    let folder = tempfile::tempdir().unwrap();
    let asked = "record.quantities=[\"normal_force\", \"tangential_force\", \"pair_force\"]";
    let recording = gallery("collide", &["time.end=0.8", asked], folder.path());
    let mut replay = Replay::open(&recording).unwrap();
    let read = |name: &str| recording.read(name).unwrap().data;
    let [normal, tangential, pair, contact] =
        ["normal_force", "tangential_force", "pair_force", "contact_force"].map(read);
    assert_eq!(pair, contact);
    let most = normal.iter().copied().fold(0.0, f64::max);
    // Far apart they feel but 1e-10 N.
    assert!(most > 1e-4, "the two have met: {most}");
    for row in 0..recording.rows() {
        for (body, parts) in replay.contact_parts(row).unwrap().iter().enumerate() {
            let at = 2 * row + body;
            let force = Vec3::from_column_slice(&contact[3 * at..][..3]);
            // Along the normal to rounding, and of one sign.
            assert!((normal[at] - force.norm()).abs() <= 1e-14 * most && tangential[at] <= 1e-14 * most);
            // A recording has the state to a digit less than the run had it, and forces are steep.
            assert!((parts.normal - normal[at]).abs() <= 1e-9 * most, "{row}: {parts:?}, {}", normal[at]);
        }
    }
}

/// Symptom: a support with a shape counted as another body.
#[test]
fn the_force_of_a_support_with_a_shape_is_that_of_a_support() {
    let text = "time = { end = 0.1, sample = 0.05 }\nrecord = { quantities = [\"pair_force\", \"force_by_kind\"] }\n\
        [[support]]\nname = \"peg\"\nshape = { sphere = { radius = 0.05 } }\n[[contact]]\nbetween = [\"a\", \"peg\"]\n\
        repulsion = { alpha = 100, nu = 4, d0 = 0.01 }\n[[body]]\nname = \"a\"\n\
        shape = { sphere = { radius = 0.05 } }\ndensity = 500\nposition = [0, 0, 0.11]\n";
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::parse("peg.toml", text, Path::new(""), &[]).unwrap();
    let recording = record(&scene, folder.path());
    let read = |name: &str| recording.read(name).unwrap().data;
    let [contact, pair, of_contacts, of_pairs] =
        ["contact_force", "pair_force", "force_contact", "force_pair"].map(read);
    assert!(contact.iter().any(|force| *force > 1.0), "{contact:?}");
    assert_eq!((contact, pair.iter().all(|f| *f == 0.0)), (of_contacts, true));
    assert!(of_pairs.iter().all(|force| *force == 0.0), "{of_pairs:?}");
}

#[test]
fn a_rigid_body_has_no_stress() {
    let folder = tempfile::tempdir().unwrap();
    let recording = gallery("dice", &["time.end=0.02"], folder.path());
    assert_eq!(Replay::open(&recording).unwrap().cauchy_stress(0).unwrap(), [None]);
}

/// A body hangs over a table that moves, near enough to feel all laws, and moves in every way that it can.
fn hovering(shape: &str, kind: &str, measure: &str) -> Scene {
    hovering_by(shape, kind, measure, ["", ""])
}

/// The same with more keys of damping and friction.
fn hovering_by(shape: &str, kind: &str, measure: &str, [damping, friction]: [&str; 2]) -> Scene {
    let text = format!(
        r#"
[time]
end = 0.01
sample = 0.01
[[support]]
name = "table"
plane = {{ origin = [0, 0, 0], normal = [0.1, 0, 1] }}
motion = {{ oscillate = {{ direction = [0, 0, 1], amplitude = "1 mm", frequency = "10 Hz", phase = 0.3 }} }}
[[contact]]
support = "table"
measure = "{measure}"
repulsion = {{ alpha = 200, nu = 4, d0 = "5 cm" }}
damping = {{ beta = 30, nu = 3, d0 = "5 cm"{damping} }}
friction = {{ beta = 50, nu = 2, d0 = "5 cm"{friction} }}
adhesion = {{ beta = 40, nu_attractive = 2, nu_repulsive = 5, d0 = "4 cm" }}
[[body]]
name = "it"
shape = {{ {shape} }}
density = 1000
{kind}
position = [0, 0, 0.13]
velocity = [0.3, 0.1, -0.2]
"#
    );
    Scene::parse("hovering.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

const RIGID: &str = "angular_velocity = [3, -2, 5]\norientation = { axis_angle = { axis = [1, 2, 0], angle = 0.3 } }";
const AFFINE: &str = "affine = { material = { neo_hookean_log = { mu = 1000, lambda = 2000 } } }\n\
                      gradient = [[1.2, 0.3, 0], [0, 0.9, 0.1], [0.1, 0, 0.8]]\ngradient_rate = [[1, 2, 0], [0, -1, 1], [3, 0, 0.5]]";
const MEASURES: [&str; 3] = ["deformed_area", "reference_area", "deformed_area_potential"];

/// The traction of laws without bounds with planes at a point of a surface with this normal, per current area \[Pa\].
fn traction(model: &Model, time: f64, motion: &BodyMotion, point: &Vec3, normal: &Vec3) -> Vec3 {
    let of_contact = |contact: &Contact| {
        let support = &model.supports[contact.support];
        let gap = support.gap_field(&motion.placement, time).gap(point);
        let relative = RelativeMotion::to(support, motion, time);
        let w = relative.velocity + relative.gradient_rate * point;
        let along = relative.normal * relative.normal.dot(&w);
        let of_term = |term: Term| {
            let direction = match term.action {
                Action::Central => relative.normal,
                Action::Normal => -along,
                Action::Tangential => along - w,
            };
            term.coefficient * gap.powf(-term.exponent) * direction
        };
        let area_factor = match contact.law_set.measure {
            AreaMeasure::ReferenceArea => (cofactor(&motion.placement.gradient) * normal).norm(),
            AreaMeasure::DeformedArea | AreaMeasure::DeformedAreaPotential => 1.0,
        };
        contact.law_set.laws().iter().flat_map(|law| law.terms()).flatten().map(of_term).sum::<Vec3>() / area_factor
    };
    model.contacts_of(0).map(of_contact).sum()
}

/// ∫ t dA over the current surface, by the midpoints of the sides of each triangle: exact for quadratic integrands.
fn integrated(replay: &mut Replay, row: usize, surface: &Triangulation) -> Vec3 {
    let (model, time) = (replay.model().clone(), replay.state(row).unwrap().time);
    let motion = *replay.snapshot(row).unwrap().body(0).motion();
    let gradient = motion.placement.gradient;
    let mut force = Vec3::zeros();
    for triangle in &surface.triangles {
        let [a, b, c] = surface.corners(triangle);
        let normal = (b - a).cross(&(c - a)).normalize();
        let area = 0.5 * (gradient * (b - a)).cross(&(gradient * (c - a))).norm();
        for middle in [a + b, b + c, c + a] {
            force += area / 3.0 * traction(&model, time, &motion, &(0.5 * middle), &normal);
        }
    }
    force
}

#[test]
fn tractions_integrate_to_the_contact_force_whatever_the_measure_of_area() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [("box = { size = [0.1, 0.12, 0.08] }", RIGID), ("box = { size = [0.1, 0.12, 0.08] }", AFFINE)];
    for (k, ((shape, kind), measure)) in cases.iter().flat_map(|case| MEASURES.map(|m| (*case, m))).enumerate() {
        let at = folder.path().join(k.to_string());
        std::fs::create_dir(&at).unwrap();
        let recording = record(&hovering(shape, kind, measure), &at);
        let mut replay = Replay::open(&recording).unwrap();
        let surface = SurfaceCells::of(&replay.model().bodies[0].solid, 12).surface().clone();
        for row in 0..recording.rows() {
            let force = vector(&recording, "contact_force", row, 0);
            let mut error = |n: usize| {
                let difference = integrated(&mut replay, row, &surface.subdivided(n)) - force;
                difference.norm() / force.norm()
            };
            let (coarse, fine) = (error(8), error(32));
            println!("{measure}, row {row}, {kind:.6}: {coarse:.1e}, {fine:.1e}");
            // Sides of 0.1 m/32 against gaps of 0.05 m; the rule is of order four: a quarter of the step, a 256th of
            // the error.
            assert!(fine < 1e-6 && fine < coarse / 150.0, "{measure}: {coarse:e} {fine:e}");
        }
    }
}

#[test]
fn tractions_of_a_curved_body_integrate_to_the_contact_force_as_its_triangles_grow_finer() {
    let folder = tempfile::tempdir().unwrap();
    let recording =
        record(&hovering("ellipsoid = { semi_axes = [0.06, 0.05, 0.04] }", AFFINE, "reference_area"), folder.path());
    let mut replay = Replay::open(&recording).unwrap();
    let force = vector(&recording, "contact_force", 1, 0);
    let shape = replay.model().bodies[0].solid.shape.clone();
    let mut error = |count: usize| {
        let difference = integrated(&mut replay, 1, &shape.triangulation(count)) - force;
        difference.norm() / force.norm()
    };
    let (coarse, fine) = (error(2000), error(32000));
    println!("{coarse:.1e}, {fine:.1e}");
    // Chords cut 1/8 of the square of the step off: 16 times the triangles, a 16th of the error.
    assert!(fine < 2e-3 && (fine * 16.0 / coarse - 1.0).abs() < 0.1, "{coarse:e} {fine:e}");
}

/// Σ t A over the cells of each body.
fn summed_of_all(replay: &mut Replay, row: usize, cells: &[SurfaceCells]) -> Vec<Vec3> {
    let snapshot = replay.snapshot(row).unwrap();
    let tractions = snapshot.mean_tractions(&cells.iter().map(Some).collect::<Vec<_>>()).unwrap();
    let of_body = |(index, (cells, tractions)): (usize, (&SurfaceCells, &Vec<Vec3>))| {
        let gradient = snapshot.body(index).motion().placement.gradient;
        let force = |(triangle, traction): (&[usize; 3], &Vec3)| {
            let [a, b, c] = cells.surface().corners(triangle);
            0.5 * (gradient * (b - a)).cross(&(gradient * (c - a))).norm() * traction
        };
        cells.surface().triangles.iter().zip(tractions).map(force).sum()
    };
    cells.iter().zip(&tractions).enumerate().map(of_body).collect()
}

/// Σ t A over the cells of the first body.
fn summed(replay: &mut Replay, row: usize, cells: &SurfaceCells) -> Vec3 {
    summed_of_all(replay, row, std::slice::from_ref(cells))[0]
}

#[test]
fn mean_tractions_of_flat_faces_add_up_to_the_contact_force_exactly() {
    let folder = tempfile::tempdir().unwrap();
    // The last are no sums over parts: a bound on friction, and damping of what approaches on the whole.
    let sorts = [["", ""], [", one_sided = true", ", mu = 0.3"]];
    let cases = [RIGID, AFFINE].into_iter().flat_map(|kind| MEASURES.map(|m| (kind, m)));
    for (k, ((kind, measure), more)) in cases.flat_map(|case| sorts.map(|more| (case, more))).enumerate() {
        let at = folder.path().join(k.to_string());
        std::fs::create_dir(&at).unwrap();
        let recording = record(&hovering_by("box = { size = [0.1, 0.12, 0.08] }", kind, measure, more), &at);
        let mut replay = Replay::open(&recording).unwrap();
        let cells = SurfaceCells::of(&replay.model().bodies[0].solid, 192);
        assert_eq!(cells.len(), 192);
        for row in 0..recording.rows() {
            let (force, recorded) = (summed(&mut replay, row, &cells), vector(&recording, "contact_force", row, 0));
            // 192 terms.
            assert!((force - recorded).norm() < 1e-13 * recorded.norm(), "{measure}: {force} {recorded}");
        }
    }
}

/// A bar of two parts and a box that deforms at each other and at a support with a shape, with laws of all kinds.
const MEETING: &str = r#"
[time]
end = 0.02
sample = 0.01
[[support]]
name = "anvil"
shape = { box = { size = [0.3, 0.3, 0.05] } }
position = [0, 0, -0.05]
motion = [{ rotate = { rate = 2, axis = [0, 0, 1] } }]
[[contact]]
between = ["bar", "gum"]
measure = "MEASURE"
repulsion = { alpha = 200, nu = 4, d0 = "5 cm" }
damping = { beta = 30, nu = 3, d0 = "5 cm" }
friction = { beta = 50, nu = 2, d0 = "5 cm", mu = 0.3 }
adhesion = { beta = 40, nu_attractive = 2.5, nu_repulsive = 5, d0 = "4 cm" }
[[contact]]
body = "gum"
support = "anvil"
measure = "MEASURE"
repulsion = { alpha = 300, nu = 6, d0 = "3 cm" }
reach = "15 cm"
damping = { beta = 3, nu = 6, d0 = "3 cm", one_sided = true }
friction = { beta = 5, nu = 6, d0 = "3 cm" }
[[body]]
name = "bar"
shape = { union = { parts = [{ shape = { box = { size = [0.1, 0.12, 0.08] } } }, { shape = { box = { size = [0.1, 0.05, 0.05] } }, offset = [0.1, 0, 0] }] } }
density = 1000
position = [0.02, 0, 0.23]
velocity = [0.3, 0.1, -0.2]
angular_velocity = [3, -2, 5]
orientation = { axis_angle = { axis = [1, 2, 0], angle = 0.3 } }
[[body]]
name = "gum"
shape = { box = { size = [0.1, 0.12, 0.08] } }
density = 1000
affine = { material = { neo_hookean_log = { mu = 1000, lambda = 2000 } } }
gradient = [[1.2, 0.3, 0], [0, 0.9, 0.1], [0.1, 0, 0.8]]
gradient_rate = [[1, 2, 0], [0, -1, 1], [3, 0, 0.5]]
position = [0, 0, 0.06]
"#;

#[test]
fn mean_tractions_of_bodies_that_meet_add_up_to_their_contact_forces() {
    let folder = tempfile::tempdir().unwrap();
    for measure in ["deformed_area", "reference_area"] {
        let at = folder.path().join(measure);
        std::fs::create_dir(&at).unwrap();
        let text = MEETING.replace("MEASURE", measure);
        let scene = Scene::parse("meeting.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let recording = record(&scene, &at);
        let mut replay = Replay::open(&recording).unwrap();
        let bodies = replay.model().bodies.clone();
        let cells: Vec<SurfaceCells> = bodies.iter().map(|body| SurfaceCells::of(&body.solid, 192)).collect();
        for row in 0..recording.rows() {
            let forces = summed_of_all(&mut replay, row, &cells);
            for (body, force) in forces.iter().enumerate() {
                let recorded = vector(&recording, "contact_force", row, body);
                println!("{measure}, row {row}, body {body}: {:.1e}", (force - recorded).norm() / recorded.norm());
                // 192 terms, and a plane that is found from another start.
                assert!((force - recorded).norm() < 1e-13 * recorded.norm(), "{measure}: {force} {recorded}");
            }
        }
    }
}

#[test]
fn mean_tractions_of_a_ball_with_a_bound_add_up_to_the_contact_force() {
    let folder = tempfile::tempdir().unwrap();
    let more = [", one_sided = true", ", mu = 0.3"];
    let scene = hovering_by("sphere = { radius = 0.1 }", RIGID, "reference_area", more);
    let recording = record(&scene, folder.path());
    let mut replay = Replay::open(&recording).unwrap();
    let cells = SurfaceCells::of(&replay.model().bodies[0].solid, 1600);
    for row in 0..recording.rows() {
        let (force, recorded) = (summed(&mut replay, row, &cells), vector(&recording, "contact_force", row, 0));
        let missed = (force - recorded).norm() / recorded.norm();
        println!("{missed:.1e}");
        // A triangle may miss two thousandths of its own traction.
        assert!(missed < 2e-3, "{force} {recorded}");
    }
}

#[test]
fn mean_tractions_of_curved_bodies_add_up_to_the_contact_force_however_near_they_are() {
    let folder = tempfile::tempdir().unwrap();
    // A ball, an egg that deforms, a disc that rolls on its rim, a capsule and a cone of one piece.
    let scenes = [
        ("shaker", "0.2"),
        ("elastic-bounce-tilted", "0.5"),
        ("euler-disk", "0.3"),
        ("tippe-top", "0.05"),
        ("ball-on-ball", "0.2"),
    ];
    for (name, end) in scenes {
        let recording = gallery(name, &[&format!("time.end={end}")], folder.path());
        let mut replay = Replay::open(&recording).unwrap();
        let cells = SurfaceCells::of(&replay.model().bodies[0].solid, 1600);
        let weight = replay.model().bodies[0].solid.mass.mass * replay.model().gravity.norm();
        let mut worst = 0.0_f64;
        for row in (0..recording.rows()).step_by(5) {
            let (force, recorded) = (summed(&mut replay, row, &cells), vector(&recording, "contact_force", row, 0));
            worst = worst.max((force - recorded).norm() / recorded.norm().max(weight));
        }
        println!("{name}: within {worst:.1e}");
        // A triangle may miss two thousandths of its own traction.
        assert!(worst < 3e-3, "{name}: {worst:e}");
    }
}

#[test]
fn the_smallest_gap_of_the_corners_is_the_recorded_one() {
    let folder = tempfile::tempdir().unwrap();
    let recording = record(&hovering("box = { size = [0.1, 0.12, 0.08] }", AFFINE, "reference_area"), folder.path());
    let mut replay = Replay::open(&recording).unwrap();
    let surface = SurfaceCells::of(&replay.model().bodies[0].solid, 12).surface().clone();
    let body = replay.snapshot(1).unwrap().body(0);
    let smallest = surface.points.iter().map(|point| body.gap(point)).fold(f64::INFINITY, f64::min);
    let recorded = recording.read_rows("gap", 1..2).unwrap().data[0];
    assert!((smallest - recorded).abs() < 1e-16, "{smallest} {recorded}");
}

/// A tetrahedron as an OBJ file, with a leg of this length along z.
fn tetrahedron(folder: &Path, leg: f64) -> PathBuf {
    let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {leg}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    let path = folder.join("body.obj");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_mesh_that_moved_or_changed_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = tetrahedron(folder.path(), 1.0);
    let text = "[time]\nend = 0.01\nsample = 0.01\n[[body]]\nname = \"rock\"\nshape = { mesh = { file = \"body.obj\" } }\ndensity = 1.0\n";
    let scene = Scene::parse("rock.toml", text, folder.path(), &[]).unwrap();
    let recording = record(&scene, folder.path());
    // Beside the recording.
    assert!(Replay::open(&recording).is_ok());
    tetrahedron(folder.path(), 1.1);
    let changed = Replay::open(&recording).unwrap_err();
    assert!(matches!(changed, ReplayError::OtherFiles { .. }) && changed.to_string().contains("body.obj"), "{changed}");
    // A recording that says nothing of files tells it by the bodies.
    let metadata = recording.path().join("zarr.json");
    let mut group: serde_json::Value = serde_json::from_slice(&std::fs::read(&metadata).unwrap()).unwrap();
    let attributes = group["attributes"].as_object_mut().unwrap();
    for key in ["record_checksum", "files"] {
        attributes.remove(key).unwrap();
    }
    std::fs::write(&metadata, group.to_string()).unwrap();
    let earlier = Recording::open(recording.path()).unwrap();
    let changed = Replay::open(&earlier).unwrap_err();
    assert!(matches!(changed, ReplayError::OtherBody { quantity: "the mass", .. }), "{changed}");
    std::fs::remove_file(mesh).unwrap();
    let moved = Replay::open(&recording).unwrap_err();
    assert!(matches!(moved, ReplayError::Scene { .. }) && moved.to_string().contains("body.obj"), "{moved}");
}

#[test]
fn rows_that_are_not_there_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let recording = gallery("dice", &["time.end=0.02"], folder.path());
    let mut replay = Replay::open(&recording).unwrap();
    assert!(matches!(replay.state(recording.rows()), Err(ReplayError::Record(_))));
}

#[test]
fn a_summary_read_back_is_that_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    for (name, overrides) in SCENES {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let scene = Scene::open(name, &overrides).unwrap();
        let path = folder.path().join(format!("{name}.gyr"));
        let provenance = Provenance { version: "test".into(), commit: None };
        let RecordingEnd::Ran(told) = Job::of(&scene, &provenance).record(&path, &mut Unwatched).unwrap() else {
            panic!("{name} had ended before")
        };
        let recording = Recording::open(&path).unwrap();
        let hash = RowHash::of_recording(&recording, recording.rows()).unwrap();
        assert_eq!(told.row_hash, Some(hash.to_string()), "{name}");
        let (again, read) = RunSummary::of_recording(&recording).unwrap();
        let text = |summary: &RunSummary| {
            let mut value = serde_json::to_value(summary).unwrap();
            value["wall_time"] = serde_json::Value::Null;
            value.to_string()
        };
        assert_eq!(text(&told), text(&read), "{name}");
        assert_eq!((again.name(), &again.file().title), (scene.name(), &scene.file().title));
    }
}

#[test]
fn a_recording_that_has_not_ended_is_told_as_far_as_it_has_come() {
    struct Enough;
    impl gyration_sim::Monitor for Enough {
        fn after_step(&mut self, progress: &gyration_sim::Progress) -> Option<Reason> {
            (progress.time > 0.1).then_some(Reason::Interrupted)
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::open("bounce", &[]).unwrap();
    let path = folder.path().join("bounce.gyr");
    let provenance = Provenance { version: "test".into(), commit: None };
    Job::of(&scene, &provenance).record(&path, &mut Enough).unwrap();
    let (_, read) = RunSummary::of_recording(&Recording::open(&path).unwrap()).unwrap();
    assert!(read.time > 0.1 && read.time < scene.built().plan.end);
    assert!(read.in_words.starts_with("not ended at t = 0.1") && !read.outcome.is_final(), "{}", read.in_words);
}
