//! Whatever a file holds, reading it ends with a scene or with errors that have a place; it never panics.

use gyration::body::BodyKind;
use gyration::tensor::Mat3;
use gyration_scene::{Scene, SceneErrors, gallery};
use proptest::prelude::*;
use std::path::Path;

fn read(name: &str, text: &str, overrides: &[String]) -> Result<Scene, SceneErrors> {
    let result = Scene::parse(name, text, Path::new("/nowhere"), overrides);
    if let Err(errors) = &result {
        assert!(errors.count() > 0 && !errors.to_string().is_empty());
        assert!(errors.into_iter().all(|error| error.line > 0 && error.column > 0 && !error.message.is_empty()));
    }
    result
}

fn gallery_text() -> impl Strategy<Value = String> {
    (0..gallery().len()).prop_map(|index| gallery()[index].1.to_owned())
}

/// Pieces that scenes are made of, and pieces that are wrong everywhere.
fn piece() -> impl Strategy<Value = String> {
    let pieces = [
        "[",
        "]",
        "{",
        "}",
        "[[body]]",
        "[[contact]]\n",
        "\"",
        "'",
        "=",
        ".",
        ",",
        "\n",
        "#",
        "-",
        "1e400",
        "nan",
        "inf",
        "0x",
        "1979-05-27",
        "\"2 cm\"",
        "\"1 (((m\"",
        "shape",
        "union = { parts = [",
        "points = []",
        "null",
        "true",
        "é",
        "\u{0}",
        "\u{feff}",
        "\\u",
        "99999999999999999999999",
        "1e308",
        "-0.0",
        "1e-320",
    ];
    prop::sample::select(pieces.to_vec()).prop_map(str::to_owned)
}

/// Mostly positive numbers from the whole range, and now and then any.
fn number() -> impl Strategy<Value = String> {
    let positive = (-320.0..308.0_f64).prop_map(|exponent| 10_f64.powf(exponent));
    let usual = (-3.0..3.0_f64).prop_map(|exponent| 10_f64.powf(exponent));
    let number = prop_oneof![4 => usual, 4 => positive, 1 => any::<f64>()];
    number.prop_map(|number| format!("{number:?}").replace("NaN", "nan"))
}

proptest! {
    // Each case takes below a millisecond.
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_texts_never_panic(text in "\\PC{0,200}", json in any::<bool>()) {
        let _ = read(if json { "scene.json" } else { "scene.toml" }, &text, &[]);
    }

    #[test]
    fn mutilated_scenes_never_panic(
        text in gallery_text(),
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, piece()), 1..6),
    ) {
        let mut text = text;
        for (at, length, piece) in cuts {
            let start = text.floor_char_boundary(at.index(text.len() + 1));
            let end = text.floor_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end.max(start), &piece);
        }
        let _ = read("scene.toml", &text, &[]);
    }

    #[test]
    fn mutilated_json_never_panics(
        text in gallery_text(),
        cuts in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..12, piece()), 1..6),
    ) {
        let Ok(scene) = read("scene.toml", &text, &[]) else { panic!("the gallery is sound") };
        let mut text = scene.resolved().to_string();
        for (at, length, piece) in cuts {
            let start = text.floor_char_boundary(at.index(text.len() + 1));
            let end = text.floor_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end.max(start), &piece);
        }
        let _ = read("scene.json", &text, &[]);
    }

    #[test]
    fn random_overrides_never_panic(text in gallery_text(), key in "[a-z0-9. ]{0,20}", value in "\\PC{0,20}") {
        let _ = read("scene.toml", &text, &[format!("{key}={value}"), format!("body.0.{key}={value}"), value]);
    }

    #[test]
    fn numbers_of_any_size_never_panic(numbers in prop::array::uniform6(number())) {
        let [a, b, c, d, e, f] = numbers;
        let text = format!(
            "[time]\nend = {a}\nsample = {b}\n[[support]]\nname = \"t\"\nplane = {{ normal = [{a}, {b}, {c}], origin = [{d}, 0, 0] }}\n\
             [[contact]]\nsupport = \"t\"\nrepulsion = {{ alpha = {a}, nu = {d}, d0 = {e} }}\n\
             [[body]]\nname = \"b\"\nshape = {{ box = {{ size = [{c}, {d}, {e}] }} }}\ndensity = {f}\nposition = [{a}, {b}, {f}]\n\
             orientation = {{ quaternion = [{a}, {c}, {d}, {f}] }}\nangular_velocity = [{a}, {e}, {f}]\npin = [{a}, {c}, {e}]\n\
             spring = [{{ anchor = [{a}, {b}, {c}], stiffness = {d} }}]\n"
        );
        if let Ok(scene) = read("scene.toml", &text, &[]) {
            let (model, state) = (&scene.built().model, &scene.built().state);
            prop_assert!(state.bodies.iter().all(|number| number.is_finite()), "{state:?}");
            let BodyKind::Rigid(inertia) = &model.bodies[0].kind else { panic!("the body is rigid") };
            prop_assert!(inertia.tensor.iter().chain(&inertia.inverse).all(|number| number.is_finite()), "{inertia:?}");
        }
    }
}

/// A gradient of determinant 1 + excess from any nine numbers, and a rate of tr L = growth.
fn isochoric(p: Mat3, rate: Mat3, excess: f64, growth: f64) -> (Mat3, Mat3) {
    let p = p * ((1.0 + excess) / p.determinant()).cbrt();
    let l = rate - Mat3::from_diagonal_element((rate.trace() - growth) / 3.0);
    (p, l * p)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// The projection of a start must not move it again: a resolved scene resolves to itself, however strained.
    #[test]
    fn incompressible_starts_within_the_tolerance_are_taken_and_stay(
        p in prop::array::uniform9(-3.0..3.0_f64),
        rate in prop::array::uniform9(-30.0..30.0_f64),
        excess in prop_oneof![Just(0.0), -9e-10..9e-10_f64],
        growth in prop_oneof![Just(0.0), -9e-10..9e-10_f64],
        size in prop::array::uniform3(0.01..10.0_f64),
    ) {
        let p = Mat3::from_row_slice(&p);
        prop_assume!(p.determinant().abs() > 1e-3);
        let (p, rate) = isochoric(p * p.determinant().signum(), Mat3::from_row_slice(&rate), excess, growth);
        let rows = |a: &Mat3| format!("{:?}", [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[(i, j)])));
        let text = format!(
            "[time]\nend = 1\nsample = 1\n[[body]]\nname = \"b\"\nshape = {{ box = {{ size = {size:?} }} }}\ndensity = 1\n\
             affine = {{ material = {{ neo_hookean = {{ shear = 1 }} }} }}\ngradient = {}\ngradient_rate = {}\n",
            rows(&p),
            rows(&rate),
        );
        let scene = read("scene.toml", &text, &[]).map_err(|errors| TestCaseError::fail(errors.to_string()))?;
        let motion = scene.built().state.motion(&scene.built().model, 0);
        let (held, held_rate) = (motion.placement.gradient, motion.velocity.gradient_rate);
        let inverse = held.try_inverse().ok_or_else(|| TestCaseError::fail("P cannot be inverted"))?;
        // Sixteen roundings of the terms of the determinant, and nine times as many of tr L, at most.
        let cube = held.amax().powi(3);
        prop_assert!((held.determinant() - 1.0).abs() <= 6.0 * 16.0 * f64::EPSILON * cube);
        let growth = (held_rate * inverse).trace();
        prop_assert!(growth.abs() <= 9.0 * 16.0 * f64::EPSILON * held_rate.amax() * inverse.amax());
        let again = read("again.json", &scene.resolved().to_string(), &[]);
        let again = again.map_err(|errors| TestCaseError::fail(errors.to_string()))?;
        prop_assert_eq!(again.resolved(), scene.resolved());
        prop_assert_eq!(&again.built().state, &scene.built().state);
    }

    #[test]
    fn strains_and_moduli_of_any_size_never_panic(numbers in prop::array::uniform9(number()), incompressible in any::<bool>()) {
        let [a, b, c, d, e, f, g, h, i] = numbers;
        let bulk = if incompressible { String::new() } else { format!(", bulk = {i}") };
        let text = format!(
            "[time]\nend = 1\nsample = 1\n[[body]]\nname = \"b\"\nshape = {{ box = {{ size = [{a}, {b}, {c}] }} }}\ndensity = {d}\n\
             affine = {{ material = {{ ogden = {{ mu = [{e}], alpha = [{f}]{bulk} }} }}, viscosity = {g}, internal_friction = {{ bulk = {h} }} }}\n\
             gradient = [[{a}, {h}, 0], [0, {b}, {i}], [0, 0, {g}]]\ngradient_rate = [[{g}, {c}, 0], [{a}, {f}, 0], [{d}, 0, {e}]]\n\
             pin = [{e}, {f}, {g}]\n"
        );
        if let Ok(scene) = read("scene.toml", &text, &[]) {
            let (model, state) = (&scene.built().model, &scene.built().state);
            prop_assert!(state.bodies.iter().all(|number| number.is_finite()), "{state:?}");
            let BodyKind::Affine(affine) = &model.bodies[0].kind else { panic!("the body is affine") };
            let tensors = [&affine.interior.euler_tensor, &affine.interior.inverse];
            prop_assert!(tensors.into_iter().flatten().all(|number| number.is_finite()), "{tensors:?}");
            let again = read("again.json", &scene.resolved().to_string(), &[]);
            prop_assert_eq!(again.map(|again| again.resolved()).ok(), Some(scene.resolved()));
        }
    }
}

/// A thin rod of 1e-308 kg m²: the inverse of its inertia was infinite, and the scene was taken.
#[test]
fn inertia_whose_inverse_overflows_is_refused() {
    let text = "[time]\nend = 1\nsample = 1\n[[body]]\nname = \"b\"\nshape = { box = { size = [1, 0.016, 2e-307] } }\n\
                density = 1\norientation = { quaternion = [1, 1, 0.016, 1] }\npin = [1, 1, 2e-307]\n";
    let Err(errors) = read("scene.toml", text, &[]) else { panic!("taken") };
    assert!(errors.to_string().contains("leaves the range of numbers"), "{errors}");
}

#[test]
fn nesting_bombs_are_refused() {
    let depth = 100_000;
    let bombs = [
        ("a.toml", format!("a = {}", "[".repeat(depth))),
        ("a.toml", format!("a = {}1{}", "[".repeat(depth), "]".repeat(depth))),
        ("a.toml", format!("a = {}", "{a=".repeat(depth))),
        ("a.toml", format!("{}a = 1", "a.".repeat(depth))),
        ("a.toml", format!("[{}a]", "a.".repeat(depth))),
        ("a.json", "[".repeat(depth)),
        ("a.json", "{\"a\":".repeat(depth)),
        ("a.json", format!("{}1{}", "{\"a\":".repeat(depth), "}".repeat(depth))),
    ];
    for (name, text) in &bombs {
        assert!(read(name, text, &[]).is_err());
    }
    let (_, dice) = gallery()[0];
    for setting in [format!("{}a=1", "a.".repeat(depth)), format!("title={}", "[".repeat(depth))] {
        assert!(read("a.toml", dice, &[setting]).is_err());
    }
}

#[test]
fn files_with_very_many_errors_end_soon() {
    let wrong: String = (0..100_000).map(|index| format!("k{index} = 1\n")).collect();
    let Err(errors) = read("a.toml", &wrong, &[]) else { panic!("no errors") };
    assert!((200..100_000).contains(&errors.count()), "{}", errors.count());
    assert!(errors.as_slice().len() < 1000);
    assert!(errors.to_string().ends_with("or more errors, of which 50 are shown"));
    let line = format!("{{\"body\": [{}1]}}", "1,".repeat(1_000_000));
    assert!(read("a.json", &line, &[]).is_err());
    assert!(read("a.toml", &"=\n".repeat(100_000), &[]).is_err());
}

/// Took hours and gigabytes: every name was compared with every other, every contact stored for every body.
#[test]
fn files_with_very_many_names_end_soon() {
    let count = 5000;
    let list = |item: &dyn Fn(usize) -> String| (0..count).map(item).collect::<String>();
    let supports = list(&|k| format!("[[support]]\nname = \"s{k}\"\nplane = {}\n", "{}"));
    let strangers = list(&|k| format!("[[contact]]\nsupport = \"t{k}\"\n"));
    let Err(errors) = read("a.toml", &format!("{supports}{strangers}"), &[]) else { panic!("taken") };
    assert!(errors.to_string().contains("there is no support \"t0\""), "{errors}");
    let bodies = list(&|k| format!("[[body]]\nname = \"b{k}\"\nshape = {{ sphere = {{ radius = 1 }} }}\nmass = 1\n"));
    let contacts = list(&|k| format!("[[contact]]\nsupport = \"s{k}\"\n"));
    let text = format!("[time]\nend = 1\nsample = 1\n{supports}{contacts}{bodies}");
    let Err(errors) = read("a.toml", &text, &[]) else { panic!("taken") };
    assert!(errors.to_string().contains("more than 1000000"), "{errors}");
}

/// The exponents of a unit overflowed.
#[test]
fn units_of_absurd_powers_are_refused() {
    let tower = format!("1 {}m{}", "(".repeat(8), "^12)".repeat(8));
    for text in [format!("{tower}^12"), format!("{tower}{tower}{tower}{tower}{tower}").replace("1 ", " ")] {
        let text = format!("[time]\nend = \"{text}\"\nsample = 1\n");
        let Err(errors) = read("a.toml", &text, &[]) else { panic!("taken") };
        assert!(errors.count() == 2, "{errors}");
    }
}
