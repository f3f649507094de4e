//! What a contractile body in a scene becomes: signals, feedback, contraction, start, resolved form.

use crate::common::{BLOCK, assert_resolves_to_itself, block, start};
use gyration::body::{BodyKind, Contractile};
use gyration::contractile::{ContractionSource, Feedback, FeedbackMeasure, Spin};
use gyration::signal::{Interpolation, Signal, TensorTable, Wave};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use gyration_scene::{Scene, schema};
use std::fs;
use std::path::Path;

const RUBBER: &str = "material = { mooney_rivlin = { c1 = 3000.0, c2 = 1000.0 } }, viscosity = 20.0";
const STRETCH: &str = "[[0, 0, 0], [0, 0, 0], [0, 0, 100.0]]";
const ONE: &str = "{ constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } }";

fn contractile(scene: &Scene) -> &Contractile {
    let BodyKind::Contractile(contractile) = &scene.built().model.bodies[0].kind else { panic!("the body contracts") };
    contractile
}

/// A driven block with these keys.
fn driven(keys: &str) -> Scene {
    block(&format!("contractile = {{ contraction_viscosity = 50, {keys} }}"))
}

fn drive(scene: &Scene) -> (&Signal, &[Feedback]) {
    let ContractionSource::Driven { drive, feedback } = &contractile(scene).contraction.source else {
        panic!("it is driven")
    };
    (drive, feedback)
}

fn prescribed(scene: &Scene) -> &Signal {
    let ContractionSource::Prescribed(signal) = &contractile(scene).contraction.source else {
        panic!("G is prescribed")
    };
    signal
}

fn along_z(value: f64) -> Mat3 {
    Mat3::from_diagonal(&Vec3::new(0.0, 0.0, value))
}

#[test]
fn the_contractile_example_of_the_contract_builds_as_it_says() {
    let text = "[time]\nend = 2.0\nsample = 0.01\n[[body]]\nname = \"hopper\"\n\
                shape = { box = { size = [0.1, 0.1, 0.1] } }\ndensity = 1000.0\n\
                contractile = { material = { mooney_rivlin = { c1 = 3000.0, c2 = 1000.0 } }, viscosity = 20.0, \
                contraction_viscosity = 50.0,\n                drive = { sine = { amplitude = [[0, 0, 0], [0, 0, 0], \
                [0, 0, 100.0]], frequency = 5.0, phase = 0.0 } } }\nposition = [2, 0, 0.1]\n";
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let made = contractile(&scene);
    assert!(made.affine.interior.is_incompressible());
    assert_eq!(made.affine.interior.viscosity.kirchhoff, 20.0);
    assert_eq!((made.contraction.viscosity, made.contraction.kept_volume), (50.0, None));
    assert_eq!(made.contraction.spin, Spin::Full);
    let sine = Signal::Sine(Wave { amplitude: along_z(100.0), frequency: 5.0, phase: 0.0 });
    assert_eq!(drive(&scene), (&sine, &[][..]));
    assert_eq!(start(&scene).placement.gradient, Mat3::identity());
    assert_resolves_to_itself(&scene);
}

#[test]
fn drives_are_those_that_the_file_gives() {
    let wave = Wave { amplitude: along_z(100.0), frequency: 2.0, phase: 0.0 };
    let turned = Wave { phase: std::f64::consts::FRAC_PI_2, ..wave };
    let ramp = |from: f64| Signal::Ramp { from: along_z(from), to: along_z(100.0), duration: 0.5 };
    let constant = Signal::Constant(along_z(30e3));
    let rows: &[(String, Signal)] = &[
        ("constant = { value = [[0, 0, 0], [0, 0, 0], [0, 0, \"30 kPa\"]] }".into(), constant.clone()),
        (format!("sine = {{ amplitude = {STRETCH}, frequency = 2 }}"), Signal::Sine(wave)),
        (format!("sine = {{ amplitude = {STRETCH}, frequency = 2, phase = \"90 deg\" }}"), Signal::Sine(turned)),
        (format!("square = {{ amplitude = {STRETCH}, frequency = \"2 Hz\" }}"), Signal::Square(wave)),
        (format!("ramp = {{ to = {STRETCH}, duration = \"500 ms\" }}"), ramp(0.0)),
        (format!("ramp = {{ from = [[0, 0, 0], [0, 0, 0], [0, 0, -7]], to = {STRETCH}, duration = 0.5 }}"), ramp(-7.0)),
        (
            format!(
                "sum = [{{ constant = {{ value = [[0, 0, 0], [0, 0, 0], [0, 0, 30000]] }} }}, \
                 {{ sum = [{{ ramp = {{ to = {STRETCH}, duration = 0.5 }} }}] }}]"
            ),
            Signal::Sum(vec![constant, Signal::Sum(vec![ramp(0.0)])]),
        ),
    ];
    for (written, expected) in rows {
        let scene = driven(&format!("drive = {{ {written} }}"));
        assert_eq!(drive(&scene).0, expected, "{written}");
        assert_resolves_to_itself(&scene);
    }
    let zero = Signal::Constant(Mat3::zeros());
    assert_eq!(drive(&driven("")), (&zero, &[][..]), "without a drive there is none");
}

#[test]
fn tables_are_read_relative_to_the_scene_and_interpolated_as_they_say() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("drives")).unwrap();
    let rows = "t,Q_xx,Q_xy,Q_xz,Q_yx,Q_yy,Q_yz,Q_zx,Q_zy,Q_zz\n0,1,2,3,4,5,6,7,8,9\n# a remark\n\n\
                0.5,1,0,3,4,5,6,7,8,9\n1,2,2,3,4,5,6,7,8,9\n";
    fs::write(folder.path().join("drives/q.csv"), rows).unwrap();
    let matrix = |xx: f64, xy: f64| Mat3::new(xx, xy, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    let values = vec![(0.0, matrix(1.0, 2.0)), (0.5, matrix(1.0, 0.0)), (1.0, matrix(2.0, 2.0))];
    for (words, interpolation) in [
        ("", Interpolation::Linear),
        (", interpolation = \"linear\"", Interpolation::Linear),
        (", interpolation = \"cubic\"", Interpolation::Cubic),
    ] {
        let text = format!(
            "{BLOCK}contractile = {{ contraction_viscosity = 1, drive = {{ table = {{ file = \"drives/q.csv\"{words} \
                }} }} }}\n"
        );
        let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let table = Signal::Table(TensorTable::new(values.clone(), interpolation).unwrap());
        assert_eq!(drive(&scene).0, &table);
        let resolved = scene.resolved();
        let name = resolved.pointer("/body/0/contractile/drive/table/interpolation").unwrap();
        assert_eq!(name, if words.contains("cubic") { "cubic" } else { "linear" });
    }
}

#[test]
fn feedback_is_one_table_or_several() {
    let gain = format!("gain = {STRETCH}");
    let gap =
        Feedback { measure: FeedbackMeasure::SupportGap, gain: along_z(100.0), bias: Mat3::zeros(), limits: None };
    let stretch = Feedback { measure: FeedbackMeasure::Stretch(Vec3::z()), bias: along_z(-3000.0), ..gap };
    let rate = Feedback { measure: FeedbackMeasure::Rate(Vec3::x()), limits: Some([-1.0, 2.0]), ..gap };
    let floor = "\n[[support]]\nname = \"floor\"\nplane = { origin = [0, 0, -5] }";
    let stretch_words =
        format!("{{ measure = {{ stretch = [0, 0, 2] }}, {gain}, bias = [[0, 0, 0], [0, 0, 0], [0, 0, \"-3 kPa\"]] }}");
    let rows: &[(String, &str, Vec<Feedback>)] = &[
        (format!("{{ measure = \"support_gap\", {gain} }}"), floor, vec![gap]),
        (format!("{{ measure = \"gap\", {gain} }}"), floor, vec![gap]),
        (stretch_words.clone(), "", vec![stretch]),
        (
            format!("[{{ measure = {{ rate = [3, 0, 0] }}, {gain}, limits = [-1, 2] }}, {stretch_words}]"),
            "",
            vec![rate, stretch],
        ),
        ("[]".into(), "", Vec::new()),
    ];
    for (written, after, expected) in rows {
        let scene = block(&format!("contractile = {{ contraction_viscosity = 1, feedback = {written} }}{after}"));
        assert_eq!(drive(&scene), (&Signal::Constant(Mat3::zeros()), expected.as_slice()), "{written}");
        assert_resolves_to_itself(&scene);
    }
    let both = driven(&format!("drive = {ONE}, feedback = {stretch_words}"));
    assert_eq!(drive(&both), (&Signal::Constant(Mat3::identity()), &[stretch][..]), "they add up");
}

#[test]
fn a_contractile_body_has_all_that_an_affine_one_has() {
    let lines = format!("{RUBBER}, internal_friction = {{ shear = 2 }}, couple = {{ value = {STRETCH} }}");
    let contracts = block(&format!("contractile = {{ contraction_viscosity = 1, {lines} }}"));
    let affine = block(&format!("affine = {{ {lines} }}"));
    let BodyKind::Affine(expected) = &affine.built().model.bodies[0].kind else { panic!("the body is affine") };
    assert_eq!(&contractile(&contracts).affine, expected.as_ref());
    let resolved = contracts.resolved();
    assert_eq!(resolved.pointer("/body/0/contractile/internal_friction/bulk").unwrap(), 0.0);
    assert!(resolved.pointer("/body/0/rigid").is_none() && resolved.pointer("/body/0/affine").is_none());
    assert_resolves_to_itself(&contracts);
}

#[test]
fn the_schema_has_the_keys_of_an_affine_body_beside_those_of_a_contraction() {
    let schema = schema();
    let keys = |name: &str| {
        let properties = schema.pointer(&format!("/$defs/{name}/properties")).unwrap().as_object().unwrap();
        properties.keys().cloned().collect::<std::collections::BTreeSet<String>>()
    };
    let (affine, contractile) = (keys("Affine"), keys("Contractile"));
    let own: Vec<&str> = contractile.difference(&affine).map(String::as_str).collect();
    let expected = ["contraction", "contraction_viscosity", "drive", "feedback", "isochoric", "prescribed", "spin"];
    assert_eq!(own, expected);
    assert!(affine.is_subset(&contractile));
    let definition = schema.pointer("/$defs/Contractile").unwrap();
    let closed = ["additionalProperties", "unevaluatedProperties"].map(|word| definition.get(word));
    assert!(closed.into_iter().flatten().any(|value| *value == false), "other keys are refused: {definition}");
}

#[test]
fn isochoric_and_spin_restrict_the_contraction() {
    let swollen = "contraction = [[1, 0.5, 0], [0, 2, 0], [0, 0, 3]]";
    let rows = [
        ("", None, Spin::Full),
        ("isochoric = true, spin = \"symmetric\"", Some(6.0), Spin::Symmetric),
        ("isochoric = false, spin = \"full\"", None, Spin::Full),
    ];
    for (keys, kept_volume, spin) in rows {
        let scene = driven(&format!("{swollen}, {keys}"));
        let contraction = &contractile(&scene).contraction;
        assert_eq!((contraction.kept_volume, contraction.spin), (kept_volume, spin), "{keys}");
        let resolved = scene.resolved();
        assert_eq!(resolved.pointer("/body/0/contractile/isochoric").unwrap(), kept_volume.is_some());
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn a_contractile_body_starts_relaxed() {
    let contraction = Mat3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0);
    let swollen = "contraction = [[1, 0.5, 0], [0, 2, 0], [0, 0, 3]]";
    let turn = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    let spin = cross_matrix(&Vec3::new(0.0, 0.0, 2.0));
    for (lines, p, pdot) in [
        ("", contraction, Mat3::zeros()),
        ("orientation = { euler_xyz = [\"90 deg\", 0, 0] }", turn * contraction, Mat3::zeros()),
        ("angular_velocity = [0, 0, 2]", contraction, spin * contraction),
        ("gradient = [[6, 0, 0], [0, 1, 0], [0, 0, 1]]", Mat3::from_diagonal(&Vec3::new(6.0, 1.0, 1.0)), Mat3::zeros()),
        // tr L is free while a body is driven: its contraction may change the volume.
        (
            "gradient_rate = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]",
            contraction,
            Mat3::from_diagonal(&Vec3::new(1.0, 2.0, 3.0)),
        ),
    ] {
        let scene = block(&format!("contractile = {{ {RUBBER}, contraction_viscosity = 1, {swollen} }}\n{lines}"));
        let motion = start(&scene);
        // A quarter turn is one to a few roundings.
        assert!((motion.placement.gradient - p).amax() < 1e-15, "{lines}");
        assert!((motion.velocity.gradient_rate - pdot).amax() < 1e-15, "{lines}");
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn a_prescribed_body_starts_with_its_contraction_and_follows_it() {
    // G = I + A sin(2πt + φ), A along x and sheared.
    let wave = "{ sine = { amplitude = [[0.2, 0.1, 0], [0, 0, 0], [0, 0, 0]], frequency = 1, phase = 0.5 } }";
    let lines = format!("contractile = {{ {RUBBER}, prescribed = {{ sum = [{ONE}, {wave}] }} }}");
    let still = block(&lines);
    assert_eq!((contractile(&still).contraction.viscosity, contractile(&still).contraction.kept_volume), (0.0, None));
    let jet = prescribed(&still).jet(0.0);
    let amplitude = Mat3::new(0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert!((jet.value - Mat3::identity() - amplitude * 0.5_f64.sin()).amax() < 1e-15);
    assert_eq!(start(&still).placement.gradient, jet.value);
    assert_eq!(start(&still).velocity.gradient_rate, jet.rate);
    assert_resolves_to_itself(&still);
    let turn = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    let turned =
        block(&format!("{lines}\norientation = {{ euler_xyz = [\"90 deg\", 0, 0] }}\nangular_velocity = [0, 0, 2]"));
    let (placement, velocity) = (start(&turned).placement, start(&turned).velocity);
    assert!((placement.gradient - turn * jet.value).amax() < 1e-15);
    let expected = cross_matrix(&Vec3::new(0.0, 0.0, 2.0)) * turn * jet.value + turn * jet.rate;
    // A few roundings of numbers up to 2.4.
    assert!((velocity.gradient_rate - expected).amax() < 3e-15);
    assert_resolves_to_itself(&turned);
    // Strained at the start, it keeps its strain while it follows.
    let strained = block(&format!("{lines}\ngradient = {}", rows(&(strain() * jet.value))));
    let motion = start(&strained);
    assert!((motion.velocity.gradient_rate - strain() * jet.rate).amax() < 1e-14);
    assert_resolves_to_itself(&strained);
}

/// F with det F = 1.
fn strain() -> Mat3 {
    Mat3::new(1.25, 0.3, 0.0, 0.0, 0.8, 0.1, 0.0, 0.0, 1.0)
}

fn rows(matrix: &Mat3) -> String {
    let row = |row: usize| format!("{:?}", [0, 1, 2].map(|column| matrix[(row, column)]));
    format!("[{}, {}, {}]", row(0), row(1), row(2))
}

#[test]
fn an_incompressible_contractile_body_starts_on_its_constraint() {
    let contraction = "contraction = [[1, 0.5, 0], [0, 2, 0], [0, 0.1, 3]]";
    let swollen = Mat3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.0, 0.0, 0.1, 3.0);
    for (excess, growth) in [(0.0, 0.0), (3e-10, -4e-10), (-9e-10, 9e-10)] {
        let p = strain() * swollen * (1.0 + excess / 3.0);
        let rate = Mat3::new(1.0, 2.0, 0.0, 0.0, -3.0, 5.0, 0.0, 7.0, 2.0 + growth) * p;
        let scene = block(&format!(
            "contractile = {{ {RUBBER}, contraction_viscosity = 1, isochoric = true, {contraction} }}\n\
             gradient = {}\ngradient_rate = {}",
            rows(&p),
            rows(&rate)
        ));
        let motion = start(&scene);
        let (held, rate) = (motion.placement.gradient, motion.velocity.gradient_rate);
        let (ratio, l) = (held.determinant() / swollen.determinant(), rate * held.try_inverse().unwrap());
        println!("excess {excess:e}: det P/det G − 1 = {:e}, tr L = {:e}", ratio - 1.0, l.trace());
        // A few roundings of terms up to 8 and 30.
        assert!((ratio - 1.0).abs() < 1e-14 && l.trace().abs() < 1e-13);
        assert!((held - p).amax() < 4e-9, "it moved by no more than it had to");
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn the_offered_start_of_a_contractile_body_is_accepted() {
    let wave = "{ sine = { amplitude = [[0.2, 0.1, 0], [0, 0, 0], [0, 0, 0]], frequency = 1 } }";
    for kind in [
        format!(
            "{RUBBER}, contraction_viscosity = 1, isochoric = true, contraction = [[1, 0.5, 0], [0, 2, 0], [0, 0, 3]]"
        ),
        format!("{RUBBER}, prescribed = {{ sum = [{ONE}, {wave}] }}"),
    ] {
        let lines = |start: &str| format!("contractile = {{ {kind} }}\n{start}");
        let far = "gradient = [[1.5, 0.3, 0], [0.1, 3, -0.2], [0, 0.4, 0.9]]\n\
                   gradient_rate = [[1.5, 2, 0], [0, 4, 5], [7, 0, 1]]";
        let text = format!("{BLOCK}{}\n", lines(far));
        let found = Scene::parse("scene.toml", &text, Path::new(""), &[]).err().unwrap();
        let offer = |help: &str| help.trim_start_matches("write ").split(", or give").next().map(str::to_owned);
        let offered: Vec<String> = found.into_iter().filter_map(|error| offer(&error.help)).collect();
        assert_eq!(offered.len(), 2, "{found}");
        assert!(found.as_slice()[0].message.contains("det P/det G is "), "{found}");
        let scene = block(&lines(&offered.join("\n")));
        let det = |matrix: &Mat3| matrix.determinant();
        let volume = match &contractile(&scene).contraction.source {
            ContractionSource::Prescribed(signal) => det(&signal.at(0.0)),
            ContractionSource::Driven { .. } => 6.0,
        };
        assert!((det(&start(&scene).placement.gradient) / volume - 1.0).abs() < 1e-14);
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn keys_of_a_drive_can_be_overridden() {
    let text = format!(
        "{BLOCK}contractile = {{ contraction_viscosity = 1, drive = {{ sine = {{ amplitude = {STRETCH}, frequency = 1 \
            }} }} }}\n"
    );
    let set = "body.b.contractile.drive.sine.frequency=\"3 Hz\"".to_owned();
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[set]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(drive(&scene).0.highest_frequency(), 3.0);
}
