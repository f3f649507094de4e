//! What a scene becomes: gallery, defaults, units, JSON, resolved form, overrides, model and first state.

use gyration::body::BodyKind;
use gyration::support::MotionPart;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::{LoadError, Method, ReadError, Scene, SceneErrors, StopAtRest, gallery, schema};
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// The rigid parts of the contract's example.
const EXAMPLE: &str = r#"
title = "A die thrown on a table"
[world]
gravity = [0.0, 0.0, -9.81]
[time]
end = 2.0
sample = 0.01
stop_at_rest = { speed = 1e-4, hold = 0.05 }
[solver]
rtol = 1e-8
atol = 1e-10
method = "auto"
max_step = 0.1
max_wall_time = "10 min"
[[support]]
name = "table"
plane = { origin = [0, 0, 0], normal = [0, 0, 2] }
motion = { oscillate = { direction = [0, 0, 3], amplitude = "1 mm", frequency = 5.0, phase = "90 deg" } }
[[contact]]
support = "table"
measure = "deformed_area"
repulsion = { alpha = 1e-6, nu = 6 }
damping   = { beta = 1e-4, nu = 6 }
friction  = { beta = 1e-3, nu = 6 }
adhesion  = { beta = 1e-3, nu_attractive = 3, nu_repulsive = 9, d0 = 0.01 }
[[body]]
name = "die"
shape = { box = { size = [0.02, "2 cm", "20 mm"] } }
density = "1.2 g/cm3"
rigid = {}
position = [0, 0, 0.2]
orientation = { axis_angle = { axis = [1, 1, 0], angle = "30 deg" } }
velocity = [0.5, 0, 0]
angular_velocity = [0, 20, 3]
spring = [{ point = [0, 0, 0.01], anchor = [0, 0, 1], stiffness = 10.0, rest_length = 0.5, damping = 0.1 }]
"#;

fn parse(text: &str) -> Result<Scene, SceneErrors> {
    Scene::parse("scene.toml", text, Path::new(""), &[])
}

fn scene(text: &str) -> Scene {
    parse(text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// A scene of one body with these lines.
fn body(lines: &str) -> Scene {
    scene(&format!("[time]\nend = 1\nsample = 0.1\n[[body]]\nname = \"b\"\n{lines}\n"))
}

fn close(a: f64, b: f64) -> bool {
    // A few roundings of unit conversions and volumes.
    (a - b).abs() <= 1e-14 * b.abs().max(1e-300)
}

#[test]
fn the_example_of_the_contract_builds_as_it_says() {
    let scene = scene(EXAMPLE);
    let built = scene.built();
    let plan = built.plan;
    assert_eq!((plan.end, plan.sample, plan.rtol, plan.atol), (2.0, 0.01, 1e-8, 1e-10));
    assert_eq!((plan.method, plan.max_step, plan.max_wall_time), (Method::Auto, Some(0.1), Some(600.0)));
    assert_eq!(plan.stop_at_rest, Some(StopAtRest { speed: 1e-4, hold: 0.05 }));
    let support = &built.model.supports[0];
    assert_eq!(support.normal, Vec3::z());
    let [MotionPart::Oscillation { direction, amplitude, frequency, phase }] = *support.motion.parts() else {
        panic!()
    };
    assert_eq!((direction, amplitude, frequency), (Vec3::z(), 1e-3, 5.0));
    assert!(close(phase, std::f64::consts::FRAC_PI_2));
    let die = &built.model.bodies[0];
    assert!(close(die.solid.mass.mass, 1200.0 * 8e-6) && close(die.size, 0.02), "{die:?}");
    let model = &built.model;
    assert_eq!((model.contacts().len(), model.contacts()[0].law_set.laws().len(), model.springs().len()), (1, 4, 1));
    let motion = built.state.motion(&built.model, 0);
    assert_eq!(motion.placement.position, Vec3::new(0.0, 0.0, 0.2));
    assert_eq!(motion.velocity.velocity, Vec3::new(0.5, 0.0, 0.0));
    assert!((motion.angular_velocity() - Vec3::new(0.0, 20.0, 3.0)).norm() < 1e-14);
    let axis = Vec3::new(1.0, 1.0, 0.0).normalize();
    assert!((motion.placement.gradient * axis - axis).norm() < 1e-15);
    assert!(close(motion.placement.gradient.trace(), 1.0 + 2.0 * (std::f64::consts::PI / 6.0).cos()));
}

#[test]
fn every_scene_of_the_gallery_builds() {
    for (name, text) in gallery() {
        let scene = Scene::open(name, &[]).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((scene.name(), scene.text()), (*name, *text));
        assert!(scene.file().title.is_some(), "{name} has no title");
    }
}

#[test]
fn resolved_scene_resolves_to_itself() {
    let pinned = "[time]\nend = 1\nsample = 0.1\n[[body]]\nname = \"b\"\nshape = { sphere = { radius = 1 } }\nmass = 1\n\
                  pin = [0, 0, 1]\nangular_velocity = [\"3 rpm\", 0, 0]\n";
    for text in gallery().iter().map(|(_, text)| *text).chain([EXAMPLE, pinned]) {
        let resolved = scene(text).resolved();
        let again = scene(&resolved.to_string());
        assert_eq!(again.resolved(), resolved);
        assert_eq!(again.built().state, scene(text).built().state);
    }
}

#[test]
fn resolved_scene_shows_every_default() {
    let resolved = body("shape = { sphere = { radius = 1 } }\nmass = 1").resolved();
    let at = |pointer: &str| resolved.pointer(pointer).unwrap_or_else(|| panic!("{pointer} in {resolved:#}"));
    assert_eq!(at("/world/gravity").to_string(), "[0.0,0.0,-9.81]");
    assert_eq!(at("/solver").to_string(), r#"{"atol":1e-10,"method":"auto","rtol":1e-8}"#);
    assert_eq!(at("/body/0/orientation/quaternion").to_string(), "[1.0,0.0,0.0,0.0]");
    for pointer in
        ["/body/0/rigid", "/body/0/position", "/body/0/velocity", "/body/0/angular_velocity", "/body/0/spring"]
    {
        at(pointer);
    }
    let resolved = scene(EXAMPLE).resolved();
    assert_eq!(resolved.pointer("/contact/0/repulsion/d0").unwrap(), 1.0);
    assert_eq!(resolved.pointer("/support/0/motion/oscillate/amplitude").unwrap(), 1e-3);
}

#[test]
fn json_with_the_same_keys_is_the_same_scene() {
    let json = r#"{
        "title": "tab\t \u00e9 \\ \"",
        "time": {"end": 2, "sample": "10 ms"},
        "support": [{"name": "table", "plane": {"origin": [0, 0, -1e-1]}}],
        "contact": [{"support": "table", "repulsion": {"alpha": 1E2, "nu": 6, "d0": "1 mm"}}],
        "body": [{"name": "b", "shape": {"sphere": {"radius": 0.05}}, "mass": "10 g", "position": [0, 0, 1]}]
    }"#;
    let toml = "title = \"tab\\t é \\\\ \\\"\"\ntime = { end = 2, sample = 0.01 }\n\
        [[support]]\nname = \"table\"\nplane.origin = [0, 0, -0.1]\n\
        [[contact]]\nsupport = \"table\"\nrepulsion = { alpha = 100, nu = 6, d0 = 0.001 }\n\
        [[body]]\nname = \"b\"\nshape.sphere.radius = 0.05\nmass = 0.01\nposition = [0, 0, 1]\n";
    let from_json = scene(json);
    assert_eq!(from_json.file(), scene(toml).file());
    assert_eq!(from_json.built().state, scene(toml).built().state);
}

#[test]
fn toml_numbers_are_read_in_every_notation() {
    let text = "[time]\nend = 1_000\nsample = 0x10\n";
    let scene = scene(&format!(
        "{text}[[body]]\nname = \"b\"\nshape = {{ sphere = {{ radius = 1_0.2_5 }} }}\nmass = 0b101\n\
         velocity = [-1_0e-1_0, +2.5E+1, 0o17]\n"
    ));
    assert_eq!((scene.built().plan.end, scene.built().plan.sample), (1000.0, 16.0));
    assert_eq!(scene.built().model.bodies[0].size, 20.5);
    assert_eq!(scene.built().state.motion(&scene.built().model, 0).velocity.velocity, Vec3::new(-10e-10, 25.0, 15.0));
}

#[test]
fn overrides_change_items_by_name_and_by_index() {
    let set = |settings: &[&str]| {
        let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
        Scene::parse("scene.toml", EXAMPLE, Path::new(""), &settings)
    };
    let changed = set(&[
        "body.die.velocity=[1, 0, \"2 cm/s\"]",
        "contact.0.friction.beta = 2e-3",
        "body.0.orientation={ euler_xyz = [0, 0, \"90 deg\"] }",
        "solver.method=explicit",
        "time.end=30 s",
        "support.table.plane.origin.2=-0.5",
        "\"world\".gravity=[0, 0, 0]",
    ]);
    let changed = changed.unwrap_or_else(|errors| panic!("{errors}"));
    let built = changed.built();
    let motion = built.state.motion(&built.model, 0);
    assert_eq!(motion.velocity.velocity, Vec3::new(1.0, 0.0, 0.02));
    assert!((motion.placement.gradient * Vec3::x() - Vec3::y()).norm() < 1e-15);
    assert_eq!((built.plan.method, built.plan.end), (Method::Explicit, 30.0));
    assert_eq!(built.model.supports[0].origin.z, -0.5);
    assert_eq!(changed.file().contact[0].friction.unwrap().beta.value(), 2e-3);
    assert_eq!((changed.text(), changed.overrides().len()), (EXAMPLE, 7));
    // Gravity has a default where it is not written.
    let weightless = EXAMPLE.replace("gravity", "# gravity");
    let settings = ["world.gravity.2=-1.6".to_owned(), "world.gravity.0=0.1".to_owned()];
    let changed = Scene::parse("scene.toml", &weightless, Path::new(""), &settings);
    let changed = changed.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(changed.built().model.gravity, Vec3::new(0.1, 0.0, -1.6));
}

#[test]
fn errors_of_overrides_point_into_their_text() {
    let rows: &[(&str, usize, &str, &str)] = &[
        ("body.die.velocity", 1, "without a value", "KEY=VALUE"),
        ("body.dye.velocity=[0, 0, 1]", 6, "no item \"dye\"", "did you mean `die`?"),
        ("contact.1.friction.beta=1", 9, "no item \"1\"", "indices run from 0 to 0"),
        ("body..velocity=1", 6, "not a dotted key", ""),
        ("body.die.gradient_rate.0=1", 10, "no `gradient_rate` is written", "as a whole"),
        ("title.x=1", 7, "leads into a string", "as a whole"),
        ("body.die.velocity=[0, 0", 24, "not valid TOML", ""),
        ("body.die.velocity=[0, 0, \"1 kg\"]", 26, "is in kg", "m/s"),
        ("body.die.velcoity=[0, 0, 1]", 10, "unknown key", "`velocity`"),
        ("body.die.mass=1", 15, "more than one of", "exactly one"),
        ("contact.0.support=floor", 19, "no support \"floor\"", "table"),
        ("solver.rtol=", 13, "not valid TOML", ""),
    ];
    for (setting, column, message, help) in rows {
        let found = Scene::parse("scene.toml", EXAMPLE, Path::new(""), &[(*setting).to_owned()]);
        let found = found.err().unwrap_or_else(|| panic!("{setting}"));
        let error = &found.as_slice()[0];
        assert_eq!((found.count(), error.file.as_str(), error.line, error.column), (1, "--set", 1, *column), "{found}");
        assert!(error.message.contains(message) && error.help.contains(help), "{found}");
    }
}

#[test]
fn equal_bodies_share_a_solid() {
    let ball = |(name, line): (&str, &str)| {
        format!("[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 1 }} }}\ndensity = 3\n{line}\n")
    };
    let balls = [("a", ""), ("b", "velocity = [1, 0, 0]"), ("c", "pin = [0, 0, 1]"), ("d", "affine = {}")].map(ball);
    let text = format!("[time]\nend = 1\nsample = 0.1\n{}", balls.concat());
    let solids = |overrides: &[String]| {
        let scene = Scene::parse("scene.toml", &text, Path::new(""), overrides).unwrap();
        scene.built().model.bodies.iter().map(|body| Arc::clone(&body.solid)).collect::<Vec<_>>()
    };
    assert!(solids(&[]).windows(2).all(|pair| Arc::ptr_eq(&pair[0], &pair[1])));
    for unlike in ["body.b.density=4", "body.b.shape.sphere.radius=2"] {
        let solids = solids(&[unlike.to_owned()]);
        assert!(!Arc::ptr_eq(&solids[0], &solids[1]) && Arc::ptr_eq(&solids[0], &solids[2]), "{unlike}");
    }
}

/// However they start; a pinned one has a place of its own, and another kind is another body.
#[test]
fn equal_bodies_are_one_under_names_of_their_own() {
    let ball = |(name, line): (&str, &str)| {
        format!("[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 1 }} }}\ndensity = 3\n{line}\n")
    };
    let lines = ["", "velocity = [1, 0, 0]", "position = [9, 0, 0]", "pin = [0, 0, 1]", "affine = {}", "affine = {}"];
    let names = ["a", "b", "c", "d", "e", "f"];
    let balls: String = names.into_iter().zip(lines).map(ball).collect();
    let text = format!("[time]\nend = 1\nsample = 0.1\n{balls}");
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let model = &scene.built().model;
    assert!(model.names().eq(names));
    let is_next = |pair: &[Arc<gyration::body::Body>]| Arc::ptr_eq(&pair[0], &pair[1]);
    assert!(model.bodies.windows(2).map(is_next).eq([true, true, false, false, true]));
    assert_eq!(model.part(&[1, 4]).names().collect::<Vec<_>>(), ["b", "e"]);
}

#[test]
fn bodies_get_their_mass_as_they_say() {
    let mass = |lines: &str| body(lines).built().model.bodies[0].solid.mass;
    let sphere = "shape = { sphere = { radius = 1 } }";
    assert!(close(mass(&format!("{sphere}\ndensity = 3")).mass, 4.0 * std::f64::consts::PI));
    let given = mass(&format!("{sphere}\nmass = \"5 kg\""));
    assert!(close(given.mass, 5.0) && close(given.euler_tensor[(0, 0)], 1.0), "{given:?}");
    let outright =
        "mass_properties = { mass = 2, center = [0, 0, 0.1], euler_tensor = [[1, 0, 0], [0, 2, 0], [0, 0, 3]] }";
    for shape in [sphere, ""] {
        let given = mass(&format!("{shape}\n{outright}"));
        assert_eq!((given.mass, given.center), (2.0, Vec3::new(0.0, 0.0, 0.1)));
        assert_eq!(given.euler_tensor, Mat3::from_diagonal(&Vec3::new(1.0, 2.0, 3.0)));
    }
    let points = mass(
        "shape = { points = [{ mass = 1, at = [0, 0, 0] }, { mass = 1, at = [2, 0, 0] }, { mass = 2, at = [1, 1, 0] }] }",
    );
    assert_eq!((points.mass, points.center), (4.0, Vec3::new(1.0, 0.5, 0.0)));
}

#[test]
fn parts_of_a_union_get_their_density_from_themselves_or_from_the_body() {
    let cubes = |first: &str, second: &str, lines: &str| {
        let part = |offset: f64, density: &str| {
            format!("{{ shape = {{ box = {{ size = [1, 1, 1] }} }}, offset = [{offset}, 0, 0]{density} }}")
        };
        let parts = format!("{}, {}", part(-1.0, first), part(1.0, second));
        let mass =
            body(&format!("shape = {{ union = {{ parts = [{parts}] }} }}\n{lines}")).built().model.bodies[0].solid.mass;
        (mass.mass, mass.center.x)
    };
    let near = |(mass, x): (f64, f64), expected: (f64, f64)| close(mass, expected.0) && (x - expected.1).abs() < 1e-14;
    assert!(near(cubes(", density = 1", ", density = 3", ""), (4.0, 0.5)));
    assert!(near(cubes("", ", density = 3", "density = 1"), (4.0, 0.5)));
    assert!(near(cubes("", "", "density = 2"), (4.0, 0.0)));
    assert!(near(cubes("", "", "mass = 5"), (5.0, 0.0)));
    assert!(near(cubes(", density = 1", ", density = 3", "mass = 8"), (8.0, 0.5)));
}

#[test]
fn surfaces_lie_about_the_centre_of_mass() {
    // A cone's centre of mass is a quarter of its height above its base.
    let text = "[time]\nend = 1\nsample = 0.1\n[[support]]\nname = \"t\"\nplane = {}\n[[contact]]\nsupport = \"t\"\n\
                [[body]]\nname = \"b\"\nshape = { cone = { radius = 1, height = 4 } }\nmass = 1\nposition = [0, 0, ";
    assert!(parse(&format!("{text}1.000001]\n")).is_ok());
    let errors = parse(&format!("{text}0.999]\n")).err().unwrap();
    assert!(errors.to_string().contains("smallest gap is -1.0000"), "{errors}");
}

#[test]
fn a_support_that_starts_displaced_counts_where_it_starts() {
    let text = |phase: &str| {
        format!(
            "[time]\nend = 1\nsample = 0.1\n[[support]]\nname = \"t\"\nplane = {{}}\n\
             motion = {{ oscillate = {{ direction = [0, 0, 1], amplitude = 0.5, frequency = 1, phase = \"{phase}\" }} }}\n\
             [[contact]]\nsupport = \"t\"\n[[body]]\nname = \"b\"\nshape = {{ sphere = {{ radius = 1 }} }}\nmass = 1\n\
             position = [0, 0, 1.2]\n"
        )
    };
    assert!(parse(&text("0 deg")).is_ok());
    assert!(parse(&text("90 deg")).is_err());
}

#[test]
fn contacts_without_a_body_go_to_all_bodies_with_a_surface() {
    let scene = scene(
        "[time]\nend = 1\nsample = 0.1\n[[support]]\nname = \"t\"\nplane = {}\n[[contact]]\nsupport = \"t\"\n\
         repulsion = { alpha = 1, nu = 6 }\n[[contact]]\nsupport = \"t\"\nbody = \"b\"\nfriction = { beta = 1, nu = 3 }\n\
         [[body]]\nname = \"a\"\nshape = { sphere = { radius = 1 } }\nmass = 1\nposition = [0, 0, 2]\n\
         [[body]]\nname = \"b\"\nshape = { sphere = { radius = 1 } }\nmass = 1\nposition = [0, 0, 2]\n\
         [[body]]\nname = \"c\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }, { mass = 1, at = [2, 0, 0] }, { mass = 2, at = [1, 1, 0] }] }\n",
    );
    let model = &scene.built().model;
    let counts: Vec<usize> = (0..model.bodies.len()).map(|body| model.contacts_of(body).count()).collect();
    assert_eq!(counts, [1, 2, 0]);
}

#[test]
fn a_pinned_body_starts_with_the_velocity_that_its_spin_gives() {
    let scene = body(
        "shape = { sphere = { radius = 1 } }\nmass = 1\nposition = [1, 2, 3]\npin = [0, 0, 1]\n\
         orientation = { euler_xyz = [\"90 deg\", 0, 0] }\nangular_velocity = [0, 0, 2]",
    );
    let built = scene.built();
    let BodyKind::Rigid(inertia) = &built.model.bodies[0].kind else { panic!("the body is rigid") };
    // J = m R²/5 = 0.2 about the centre: I = 0.4, and m |X_p|² more across the pin.
    assert!((inertia.tensor - Mat3::from_diagonal(&Vec3::new(1.4, 1.4, 0.4))).amax() < 1e-15);
    let motion = built.state.motion(&built.model, 0);
    // The pin lies at (1, 1, 3): z turned about x by a quarter is −y. v = ω × (p₀ − a) = 2 z × y = −2 x.
    assert!((motion.placement.position - Vec3::new(1.0, 2.0, 3.0)).norm() < 1e-15);
    assert!((motion.velocity.velocity - Vec3::new(-2.0, 0.0, 0.0)).norm() < 1e-15);
    assert!((Vec3::from(scene.file().body[0].velocity.map(|v| v.0)) - Vec3::new(-2.0, 0.0, 0.0)).norm() < 1e-15);
}

#[test]
fn meshes_are_read_relative_to_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("meshes")).unwrap();
    let obj = "v 0 0 0\nv 30 0 0\nv 0 30 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    fs::write(folder.path().join("meshes/tetrahedron.obj"), obj).unwrap();
    let path = folder.path().join("scene.toml");
    let text = "[time]\nend = 1\nsample = 0.1\n[[body]]\nname = \"b\"\ndensity = 6\n\
                shape = { mesh = { file = \"meshes/tetrahedron.obj\", scale = 0.1 } }\n";
    fs::write(&path, text).unwrap();
    let scene = Scene::load(&path, &[]).unwrap();
    assert!(close(scene.built().model.bodies[0].solid.mass.mass, 27.0));
    assert_eq!(scene.name(), "scene");
}

#[test]
fn files_that_cannot_be_read_are_told_from_bad_content() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let missing = Scene::open("dicee", &[]).err().unwrap();
    assert!(missing.to_string().contains("did you mean `dice`?"), "{missing}");
    assert!(matches!(missing, LoadError::Read(ReadError::NotFound { .. })));
    assert!(matches!(Scene::open(&path(""), &[]), Err(LoadError::Read(ReadError::Io { .. }))));
    fs::File::create(path("large.toml")).unwrap().set_len(1 << 30).unwrap();
    assert!(matches!(Scene::open(&path("large.toml"), &[]), Err(LoadError::Read(ReadError::TooLarge { .. }))));
    fs::write(path("latin.toml"), b"title = \"x\"\n# caf\xe9\n").unwrap();
    let Err(LoadError::Content(errors)) = Scene::open(&path("latin.toml"), &[]) else { panic!() };
    let error = &errors.as_slice()[0];
    assert_eq!((error.line, error.column), (2, 6), "{errors}");
}

#[test]
fn schema_names_units_and_forbids_unknown_keys() {
    let schema = schema();
    assert_eq!(schema.pointer("/$defs/SurfaceDamping/unit").unwrap(), "Pa s/m");
    assert_eq!(schema.pointer("/additionalProperties").unwrap(), false);
    assert_eq!(schema.pointer("/$defs/Repulsion/properties/nu/exclusiveMinimum").unwrap(), 0);
    assert!(!schema.to_string().contains("\"null\""), "an optional key is left out, not null");
}
