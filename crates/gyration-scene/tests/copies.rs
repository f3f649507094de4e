//! Many bodies written as copies of one: on a grid, from a table, at random; and what is wrong with them.

use crate::common::{TABLE, TIME, assert_error, assert_resolves_to_itself, errors};
use gyration::state::BodyMotion;
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use gyration_scene::Scene;
use std::path::Path;
use std::sync::Arc;

const REPULSION: &str = "repulsion = { alpha = 1, nu = 6, d0 = 0.001 }";

/// A ball of 1 cm with these lines.
fn grain(lines: &str) -> String {
    format!(
        "[[body]]\nname = \"grain\"\ngroup = \"steel\"\nshape = {{ sphere = {{ radius = 0.01 }} }}\nmass = 1\n{lines}\n"
    )
}

fn contact(lines: &str) -> String {
    format!("[[contact]]\n{lines}\n{REPULSION}\n")
}

fn open(text: &str, base: &Path, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|one| (*one).to_owned()).collect();
    Scene::parse("scene.toml", text, base, &overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

fn motions(scene: &Scene) -> Vec<BodyMotion> {
    let built = scene.built();
    (0..built.model.bodies.len()).map(|body| built.state.motion(&built.model, body)).collect()
}

fn places(scene: &Scene) -> Vec<Vec3> {
    motions(scene).iter().map(|motion| motion.placement.position).collect()
}

#[test]
fn a_grid_runs_along_x_first_and_its_bodies_are_one_in_memory() {
    let grid = "position = [1, 2, 3]\ncopies = { grid = { count = [3, 2, 2], spacing = [\"3 cm\", 0.05, -0.1] } }";
    let pairs =
        contact("between = [\"grain\", \"grain-11\"]\nreach = 0.01") + &contact("between = [\"steel\", \"lid\"]");
    let lid = "[[body]]\nname = \"lid\"\nshape = { sphere = { radius = 0.01 } }\nmass = 2\n";
    let scene = open(&[TIME, lid, &grain(grid), &pairs].concat(), Path::new(""), &[]);
    assert_resolves_to_itself(&scene);
    let model = &scene.built().model;
    let names: Vec<&str> = model.names().collect();
    assert_eq!((names.len(), &names[..3], names[12]), (13, &["lid", "grain-0", "grain-1"][..], "grain-11"));
    assert_eq!(scene.built().written, [&[0][..], &[1; 12]].concat());
    let places = places(&scene);
    for (index, place) in places[1..].iter().enumerate() {
        let at = [index % 3, index / 3 % 2, index / 6].map(|n| n as f64);
        assert!((place - Vec3::new(1.0 + 0.03 * at[0], 2.0 + 0.05 * at[1], 3.0 - 0.1 * at[2])).norm() < 1e-15);
    }
    assert!(model.bodies[1..].windows(2).all(|two| Arc::ptr_eq(&two[0], &two[1])));
    // A name of a copy is a group of one; that of the body is all of them.
    let mut joined: Vec<[usize; 2]> = model.pairs().map(|pair| pair.bodies().unwrap()).collect();
    joined.iter_mut().for_each(|pair| pair.sort_unstable());
    joined.sort_unstable();
    let wanted = (1..13).map(|grain| [0, grain]).chain((1..12).map(|grain| [grain, 12]));
    assert_eq!(joined, wanted.collect::<Vec<_>>());
}

#[test]
fn an_override_reaches_all_copies_and_how_they_stand() {
    let text = [TIME, &grain("copies = { grid = { count = [2, 1, 1], spacing = [1, 0, 0] } }")].concat();
    let set =
        ["body.grain.mass=3", "body.grain.copies.grid.count=[4, 2, 1]", "body.grain.copies.grid.spacing.1=\"5 cm\""];
    let scene = open(&text, Path::new(""), &set);
    assert_eq!(scene.built().model.bodies.len(), 8);
    assert!(scene.built().model.bodies.iter().all(|body| body.solid.mass.mass == 3.0));
    assert_eq!(places(&scene)[4], Vec3::new(0.0, 0.05, 0.0));
    let found = errors("scene.toml", &text, &["body.grain-1.mass=3".to_owned()]);
    assert_eq!(found.count(), 1);
    let error = &found.as_slice()[0];
    assert!(error.help.contains("`body.grain`"), "{error}");
}

/// Columns in another order, a remark, blanks and a body that is turned, moves and spins already.
#[test]
fn a_table_adds_to_what_the_body_says() {
    let folder = tempfile::tempdir().unwrap();
    let table =
        "# two\nz, x,y,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n3,1,2,1,0,0,1,0.1,0,0,0,0,5\n\n0,-1,0,1,0,0,0,0,0,0,0,0,0\n";
    std::fs::write(folder.path().join("places.csv"), table).unwrap();
    let body = "position = [10, 0, 0]\norientation = { axis_angle = { axis = [1, 0, 0], angle = \"90 deg\" } }\n\
                velocity = [0, 1, 0]\nangular_velocity = [0, 2, 0]\ncopies = { places = \"places.csv\" }";
    let scene = open(&[TIME, &grain(body)].concat(), folder.path(), &[]);
    let [first, second] = motions(&scene)[..] else { panic!("two copies") };
    let quarter = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    let about_z = Mat3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    assert_eq!(first.placement.position, Vec3::new(11.0, 2.0, 3.0));
    // A few roundings of numbers near one.
    assert!((first.placement.gradient - about_z * quarter).norm() < 1e-15);
    assert_eq!(first.velocity.velocity, Vec3::new(0.1, 1.0, 0.0));
    let spin = cross_matrix(&Vec3::new(0.0, 2.0, 5.0)) * first.placement.gradient;
    assert!((first.velocity.gradient_rate - spin).norm() < 1e-14);
    assert_eq!(second.placement.position, Vec3::new(9.0, 0.0, 0.0));
    assert!((second.placement.gradient - quarter).norm() < 1e-15);
    // The resolved form has the table by its path.
    let again = Scene::parse("again.json", &scene.resolved().to_string(), folder.path(), &[]).unwrap();
    assert_eq!((again.resolved(), &again.built().state), (scene.resolved(), &scene.built().state));
}

/// A copy that deforms is turned with its gradient, and each pendulum has the anchor of its own place.
#[test]
fn gradients_are_turned_and_pins_are_at_their_places() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.csv"), "x,y,z,qw,qx,qy,qz\n0,0,0,1,0,0,0\n1,0,0,1,0,0,1\n").unwrap();
    let body = "affine = { material = { neo_hookean_log = { mu = 1, lambda = 1 } } }\n\
                gradient = [[2, 0, 0], [0, 1, 0], [0, 0, 0.5]]\ngradient_rate = [[1, 0, 0], [0, 0, 0], [0, 0, 0]]\n\
                copies = { places = \"p.csv\" }";
    let [straight, turned] = motions(&open(&[TIME, &grain(body)].concat(), folder.path(), &[]))[..] else {
        panic!("two copies")
    };
    let about_z = Mat3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    assert!((turned.placement.gradient - about_z * straight.placement.gradient).norm() < 1e-15);
    assert!((turned.velocity.gradient_rate - about_z * straight.velocity.gradient_rate).norm() < 1e-15);
    // A spin is one of space, of the copy that is turned as well, and stays so in the resolved form.
    let spinning = body.replace("gradient_rate = [[1, 0, 0], [0, 0, 0], [0, 0, 0]]", "angular_velocity = [5, 0, 0]");
    let scene = open(&[TIME, &grain(&spinning)].concat(), folder.path(), &[]);
    let again = Scene::parse("again.json", &scene.resolved().to_string(), folder.path(), &[]).unwrap();
    assert_eq!((again.resolved(), &again.built().state), (scene.resolved(), &scene.built().state));
    for motion in motions(&scene) {
        let spin = cross_matrix(&Vec3::new(5.0, 0.0, 0.0)) * motion.placement.gradient;
        assert!((motion.velocity.gradient_rate - spin).norm() < 1e-14);
    }
    let body = "pin = [0.1, 0, 0]\nangular_velocity = [0, 0, 2]\ncopies = { places = \"p.csv\" }";
    let scene = open(&[TIME, &grain(body)].concat(), folder.path(), &[]);
    let again = Scene::parse("again.json", &scene.resolved().to_string(), folder.path(), &[]).unwrap();
    assert_eq!(again.built().state, scene.built().state);
    let anchors: Vec<Vec3> = scene.built().model.bodies.iter().map(|body| body.pin.unwrap().anchor).collect();
    assert!((anchors[0] - Vec3::new(0.1, 0.0, 0.0)).norm() < 1e-15);
    assert!((anchors[1] - Vec3::new(1.0, 0.1, 0.0)).norm() < 1e-15);
    let velocities: Vec<Vec3> = motions(&scene).iter().map(|motion| motion.velocity.velocity).collect();
    assert!((velocities[0] - Vec3::new(0.0, -0.2, 0.0)).norm() < 1e-15);
    assert!((velocities[1] - Vec3::new(0.2, 0.0, 0.0)).norm() < 1e-15);
}

const RANDOM: &str = "copies = { random = { count = 300, box = [[0, 0, 0], [0.4, 0.3, 0.2]], gap = \"1 mm\", \
                      turn = true, seed = 7 } }";

#[test]
fn random_copies_keep_apart_within_their_box_and_follow_their_seed() {
    let cube = |lines: &str| grain(lines).replace("sphere = { radius = 0.01 }", "box = { size = [0.01, 0.01, 0.01] }");
    let text = [TIME, &cube(RANDOM)].concat();
    let scene = open(&text, Path::new(""), &[]);
    assert_resolves_to_itself(&scene);
    let motions = motions(&scene);
    let radius = 0.005 * 3f64.sqrt();
    let mut least = f64::INFINITY;
    for (index, one) in motions.iter().enumerate() {
        let place = one.placement.position;
        assert!((0..3).all(|k| (0.0..=[0.4, 0.3, 0.2][k]).contains(&place[k])));
        for other in &motions[..index] {
            least = least.min((other.placement.position - place).norm());
        }
    }
    println!("nearest two {least:.6} m apart");
    assert!(least > 2.0 * radius + 1e-3);
    // Uniform in the box: a mean of 300 with the deviation L/√(12·300), five of them.
    let mean = motions.iter().map(|motion| motion.placement.position).sum::<Vec3>() / 300.0;
    for (k, side) in [0.4, 0.3, 0.2].into_iter().enumerate() {
        assert!((mean[k] - 0.5 * side).abs() < 5.0 * side / 3600f64.sqrt(), "{mean}");
    }
    let turned = motions.iter().filter(|motion| motion.placement.gradient.trace() < 2.9).count();
    // An angle below 18° has probability 2e-3.
    assert!(turned > 290, "{turned}");
    assert_eq!(open(&text, Path::new(""), &[]).built().state, scene.built().state);
    let other = open(&text, Path::new(""), &["body.grain.copies.random.seed=8"]);
    assert_ne!(places(&other), places(&scene));
    let still = open(&text, Path::new(""), &["body.grain.copies.random.turn=false"]);
    assert!(self::motions(&still).iter().all(|motion| motion.placement.gradient == Mat3::identity()));
}

/// A plane and a hollow support that grains have contacts with, a ball beside them, other grains; a plane without a
/// contact, below which they may be.
#[test]
fn random_copies_keep_clear_of_what_they_meet() {
    let wall = |x: f64| format!("{{ shape = {{ box = {{ size = [0.02, 0.3, 0.3] }} }}, offset = [{x:?}, 0, 0] }}");
    let texts = [
        TIME.to_owned(),
        TABLE.to_owned(),
        "[[support]]\nname = \"roof\"\nplane = { origin = [0, 0, 5] }\n".to_owned(),
        format!(
            "[[support]]\nname = \"channel\"\nshape = {{ union = {{ parts = [{}, {}] }} }}\n",
            wall(-0.1),
            wall(0.1)
        ),
        grain(
            "copies = { random = { count = 60, box = [[-0.2, -0.2, -0.2], [0.2, 0.2, 0.2]], gap = 0.001, seed = 1 } }",
        ),
        grain(
            "copies = { random = { count = 60, box = [[-0.2, -0.2, -0.2], [0.2, 0.2, 0.2]], gap = 0.001, seed = 1 } }",
        )
        .replace("\"grain\"", "\"dust\""),
        "[[body]]\nname = \"ball\"\nshape = { sphere = { radius = 0.05 } }\nmass = 1\nposition = [0, 0, 0.1]\n"
            .to_owned(),
        contact("between = [\"steel\", \"steel\"]\nreach = 0.01"),
        contact("between = [\"steel\", \"ball\"]\nreach = 0.01"),
        contact("between = [\"steel\", \"table\"]"),
        contact("between = [\"steel\", \"channel\"]"),
    ];
    let places = places(&open(&texts.concat(), Path::new(""), &[]));
    let inside = places[..120].iter().filter(|place| place.x.abs() < 0.09).count();
    println!("{inside} of 120 in the channel");
    // The hollow of a union counts: a third of the volume is in it.
    assert!((15..80).contains(&inside), "{inside}");
    for place in &places[..120] {
        assert!(place.z > 0.011 && (place - places[120]).norm() > 0.061, "{place}");
        let from_wall = (place.x.abs() - 0.1).abs() - 0.01;
        let beside = place.y.abs() < 0.15 && place.z < 0.15;
        assert!(!beside || from_wall > 0.011 * (1.0 - 1e-9), "{place}");
    }
}

#[test]
fn what_is_wrong_with_copies_is_told_where_it_stands() {
    let case = |copies: &str| [TIME, &grain(&format!("copies = {copies}"))].concat();
    let cases = [
        (
            "{ grid = { count = [2, §2.5, 1], spacing = [1, 1, 1] } }",
            "grid.count.1",
            "must be whole",
            "whole number from 1",
        ),
        ("{ grid = { count = [2, §0, 1], spacing = [1, 1, 1] } }", "grid.count.1", "at least 1", "whole number from 1"),
        ("{ grid = §{ count = [2, 2, 1] } }", "grid.spacing", "\"spacing\" is missing", "add `spacing`"),
        ("{ grid = { count = [2, 2, 1], spacing = [1, §0, 0] } }", "grid.spacing.1", "2 copies would be", "count of 1"),
        ("{ grid = { count = §[2000, 2000, 1], spacing = [1, 1, 0] } }", "grid.count", "more than 1000000", "smaller"),
        ("{ places = §\"nowhere.csv\" }", "places", "cannot read the table", "relative to the folder"),
        (
            "{ random = { count = 3, box = §[[0, 0, 1], [1, 1, 0]], seed = 1 } }",
            "random.box",
            "along z",
            "least corner",
        ),
        (
            "{ random = { count = 3, box = [[0, 0, 0], [1, 1, 1]], gap = §-1, seed = 1 } }",
            "random.gap",
            "at least 0 m",
            "at least 0",
        ),
        (
            "{ random = §{ count = 3, box = [[0, 0, 0], [1, 1, 1]] } }",
            "random.seed",
            "\"seed\" is missing",
            "add `seed`",
        ),
        ("{ §gird = { count = [2, 2, 1], spacing = [1, 1, 1] } }", "gird", "unknown key", "did you mean `grid`?"),
        (
            "{ random = §{ count = 90, box = [[0, 0, 0], [0.08, 0.08, 0.08]], seed = 1 } }",
            "random",
            "of 90 copies of \"grain\" ",
            "write fewer",
        ),
        (
            "{ random = { count = 1, box = §[[-1e308, 0, 0], [1e308, 1, 1]], seed = 1 } }",
            "random.box",
            "beyond all numbers",
            "smaller box",
        ),
    ];
    for (copies, key, message, help) in cases {
        assert_error(&case(copies), &format!("body.grain.copies.{key}"), message, help);
    }
    // 90 balls of 1 cm in a cube of 10 cm.
    let crowded = case("{ random = { count = 90, box = [[0, 0, 0], [0.08, 0.08, 0.08]], seed = 1 } }");
    let told = errors("scene.toml", &crowded, &[]);
    assert!(told.as_slice()[0].message.contains("would fill 37.7 % of the volume"), "{told}");
}

#[test]
fn copies_are_refused_where_they_make_no_sense() {
    let grid = "copies = §{ grid = { count = [2, 1, 1], spacing = [1, 0, 0] } }";
    let lattice = "[lattice]\ncell = [[9, 0, 0]]\n[world]\ngravity = [0, 0, 0]\n";
    assert_error(&[TIME, lattice, &grain(grid)].concat(), "body.grain.copies", "a cell of a lattice", "one by one");
    let spring = format!("{grid}\nspring = [{{ anchor = [0, 0, 1], stiffness = 1 }}]");
    assert_error(&[TIME, &grain(&spring)].concat(), "body.grain.copies", "leads to a point of space", "`potential`");
    let grid = grid.replace('§', "");
    let of_all = "[[bond]]\nbetween = [\"grain-0\", §\"grain\"]\nlaw = \"l^2\"\n";
    let text = [TIME, &grain(&grid), of_all].concat();
    assert_error(&text, "bond.0.between.1", "\"grain-0\" to \"grain-1\"", "name one of them, \"grain-0\"");
    let beyond = "[[spring]]\nbetween = [\"grain-0\", §\"grain-2\"]\nstiffness = 1\n";
    assert_error(
        &[TIME, &grain(&grid), beyond].concat(),
        "spring.0.between.1",
        "there is no body or group \"grain-2\"",
        "grain",
    );
    let joint = "[[joint]]\nname = \"j\"\nbetween = [§\"grain\", \"space\"]\nkind = \"ball\"\n";
    assert_error(&[TIME, &grain(&grid), joint].concat(), "joint.j.between.0", "is the group of the copies", "grain-0");
    let many = "copies = { grid = { count = [1000, 1000, 1], spacing = [1, 1, 1] } }";
    let more = grain("copies = §{ grid = { count = [1, 1, 2], spacing = [1, 1, 1] } }").replace("grain", "more");
    let text = [TIME, &grain(many), &more].concat();
    assert_error(&text, "body.more.copies", "more than 1000000 bodies", "fewer");
    let namesake = "[[body]]\nname = §\"grain-1\"\nshape = { sphere = { radius = 0.01 } }\nmass = 1\n";
    assert_error(&[TIME, &grain(&grid), namesake].concat(), "body.grain-1.name", "a copy of another body", "own");
    // The table stands at the first's place, and of those below it the first is told.
    let low = "position = [0, 0, 0.1]\ncopies = { grid = { count = [1, 1, 30], spacing = [0, 0, -0.1] } }";
    let text = [TIME, TABLE, &grain(low), &contact("support = \"table\"")].concat();
    let told = errors("scene.toml", &text, &[]);
    assert!(told.count() == 1 && told.as_slice()[0].message.starts_with("\"grain-1\" reaches the support"), "{told}");
}

#[test]
fn a_table_of_places_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("", "line 1: the file is empty"),
        ("x,y,z\n", "line 1: there is no row"),
        ("1,2,3\n", "line 1: the first line holds \"1\" where it names the columns"),
        ("x,y\n1,2\n", "line 1: the column \"z\" is missing"),
        ("x,y,z,qw\n1,2,3,1\n", "line 1: the column \"qx\" is missing"),
        ("x,y,z,vz,vx\n1,2,3,1,1\n", "line 1: the column \"vy\" is missing"),
        ("x,y,z,w\n1,2,3,1\n", "line 1: unknown column \"w\""),
        ("x,y,z,x\n1,2,3,1\n", "line 1: the column \"x\" occurs twice"),
        ("x,y,z\n1,2,3\n1,2\n", "line 3: expected 3 columns, found 2"),
        ("x,y,z\n\n1,two,3\n", "line 3: column 2 holds \"two\", which is no number"),
        ("x,y,z\n1,inf,3\n", "line 2: column 2 holds inf, which is not finite"),
        ("x,y,z,qw,qx,qy,qz\n1,2,3,0,0,0,0\n", "line 2: its quaternion is zero"),
        ("x,y,z\n1,\u{fffd},3\n", "line 2: column 2"),
    ];
    let text = [TIME, &grain("copies = { places = \"p.csv\" }")].concat();
    for (table, message) in cases {
        std::fs::write(folder.path().join("p.csv"), table).unwrap();
        let found = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_err();
        assert_eq!((found.count(), found.as_slice()[0].key.as_str()), (1, "body.grain.copies.places"), "{found}");
        assert!(found.as_slice()[0].message.contains(message), "{found}\n  does not say: {message}");
        assert!(found.as_slice()[0].help.contains("x,y,z"), "{found}");
    }
    std::fs::write(folder.path().join("p.csv"), "x,y,z,vx,vy,vz\n0,0,0,1,0,0\n").unwrap();
    let pinned = [TIME, &grain("pin = [0.1, 0, 0]\ncopies = { places = \"p.csv\" }")].concat();
    let found = Scene::parse("scene.toml", &pinned, folder.path(), &[]).unwrap_err();
    assert!(found.count() == 1 && found.as_slice()[0].message.contains("the pin says how"), "{found}");
    let spins = "x,y,z,wx,wy,wz\n0,0,0,0,0,0\n1,0,0,0,1,0\n";
    std::fs::write(folder.path().join("p.csv"), spins).unwrap();
    let point = "[[body]]\nname = \"grain\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }] }\n\
                 copies = { places = \"p.csv\" }\n";
    let found = Scene::parse("scene.toml", &[TIME, point].concat(), folder.path(), &[]).unwrap_err();
    assert!(found.count() == 1 && found.as_slice()[0].message.contains("the spin of a point"), "{found}");
    let drifting = [
        "fluid = { viscosity = 1 }\n",
        TIME,
        &grain("inclusion = { inertia = false }\ncopies = { places = \"p.csv\" }"),
    ];
    let found = Scene::parse("scene.toml", &drifting.concat(), folder.path(), &[]).unwrap_err();
    assert!(found.count() == 1 && found.as_slice()[0].message.contains("without inertia"), "{found}");
    // What is wrong with one copy tells which.
    let kept = [TIME, &grain("keep = { plane = [1, 0, 0] }\ncopies = { places = \"p.csv\" }")].concat();
    let found = Scene::parse("scene.toml", &kept, folder.path(), &[]).unwrap_err();
    assert!(found.count() == 1 && found.as_slice()[0].message.starts_with("the copy \"grain-1\": "), "{found}");
    // To follow what it says without the table would add to it once more.
    assert!(found.to_string().contains("of the body and of its place in the table add up to"), "{found}");
    // Names are not guessed at where copies are not known.
    let spring = "[[spring]]\nbetween = [\"grain-0\", \"grain-5\"]\nstiffness = 1\n";
    let found = errors("scene.toml", &[TIME, &grain("copies = { places = \"no.csv\" }"), spring].concat(), &[]);
    assert_eq!(found.count(), 1, "{found}");
}

/// Springs between all of groups are those that are written one by one.
#[test]
fn springs_join_any_two_of_groups() {
    let balls = |count: usize| {
        let copies = format!("copies = {{ grid = {{ count = [{count}, 1, 1], spacing = [1, 0, 0] }} }}");
        let hub = "[[body]]\nname = \"hub\"\ngroup = [\"nodes\", \"iron\"]\nshape = { sphere = { radius = 0.01 } }\n\
                   mass = 1\nposition = [0, 9, 0]\n";
        [TIME, &grain(&copies), hub].concat()
    };
    let joined = |one: &str, other: &str| {
        let spring = format!("[[spring]]\nbetween = [\"{one}\", \"{other}\"]\nstiffness = 1\n");
        let scene = Scene::parse("scene.toml", &(balls(3) + &spring), Path::new(""), &[]);
        let scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
        scene.built().model.springs().iter().filter_map(gyration::load::Spring::bodies).collect::<Vec<_>>()
    };
    assert_eq!(joined("grain", "grain"), [[0, 1], [0, 2], [1, 2]]);
    assert_eq!(joined("hub", "grain"), [[3, 0], [3, 1], [3, 2]]);
    assert_eq!(joined("nodes", "grain-1"), [[3, 1]]);
    assert_eq!(joined("grain-1", "grain"), [[1, 0], [1, 2]]);
    let spring = |one: &str, other: &str| format!("[[spring]]\nbetween = {one}{other}\nstiffness = 1\n");
    let text = balls(3) + &spring("§[\"iron\", ", "\"iron\"]");
    assert_error(&text, "spring.0.between", "both name one body, and no pair", "besides");
    let text = balls(3) + &spring("§[\"hub\", ", "\"iron\"]");
    assert_error(&text, "spring.0.between", "both name one body, and no pair", "besides");
    let text = balls(3) + &spring("[\"hub\", ", "§\"stel\"]");
    assert_error(&text, "spring.0.between.1", "no body or group \"stel\"", "did you mean `steel`");
    let text = balls(3) + &spring("[\"grain-1\", ", "§\"grain-1\"]");
    assert_error(&text, "spring.0.between.1", "both ends are at the body", "two different");
    let text = balls(1500) + &spring("§[\"grain\", ", "\"grain\"]");
    assert_error(&text, "spring.0.between", "more than 1000000 springs", "name fewer");
}
