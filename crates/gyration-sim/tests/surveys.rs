//! What `check` tells of a scene: springs, meetings, crowds.

use gyration_scene::Scene;
use gyration_sim::survey::Survey;
use std::path::Path;

#[test]
fn springs_are_told_with_the_period_of_two_free_bodies() {
    let ball = |name: &str, mass: f64, place: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = {mass}\n\
             position = [{place}, 0, 0]\n"
        )
    };
    let spring = "[[spring]]\nbetween = [\"a\", \"b\"]\npoints = [[0.1, 0, 0], [0, 0, 0]]\n\
                  stiffness = 6\nrest_length = 1.5\ndamping = 1.2\n";
    let text = ["time = { end = 1, sample = 1 }\n", &ball("a", 1.0, 0.0), &ball("b", 2.0, 2.0), spring].concat();
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let survey = Survey::of(&scene).unwrap();
    let [told] = &survey.springs[..] else { panic!("{:?}", survey.springs) };
    // μ = 2/3 kg, ω = 3 rad/s, ζ = 1.2/(2·2).
    assert!((told.period.unwrap() - std::f64::consts::TAU / 3.0).abs() < 1e-15);
    assert!((told.damping_ratio.unwrap() - 0.3).abs() < 1e-15 && (told.initial_length - 1.9).abs() < 1e-15);
    let line =
        "spring     a to b: 6 N/m, 1.5 m without force, 1.9 m at the start; period 2.0944 s, damping ratio 0.3\n";
    let words = survey.text(&scene).unwrap();
    assert!(words.contains(line), "{words}");
}

/// A row of balls, their centres 0.1 m apart, that feel each other from a gap of 0.045 m on.
fn row(repeat: usize) -> Survey {
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n\
         lattice = {{ cell = [[0.1, 0, 0]], repeat = [{repeat}, 1, 1] }}\n\
         body = [{{ name = \"a\", density = 1000, shape = {{ sphere = {{ radius = 0.03 }} }} }}]\n\
         contact = [{{ between = [\"a\", \"a\"], repulsion = {{ alpha = 20, nu = 2.01, d0 = 0.01 }}, \
         reach = 0.045 }}]\n"
    );
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let survey = Survey::of(&scene).unwrap();
    let words = survey.text(&scene).unwrap();
    let image = if repeat == 1 { "a with its image" } else { "a-0 with a-1" };
    let told = format!("meeting    {image} in the cell [1, 0, 0]: gap 0.04 m at the start, felt within 0.045 m");
    assert!(words.contains(&told), "{words}");
    survey
}

/// Images within reach were said to be out of it, and those of a cell alone were not told at all.
#[test]
fn meetings_of_a_lattice_are_those_of_one_cell_with_its_images() {
    for repeat in [1, 4] {
        let survey = row(repeat);
        let [near, far @ ..] = &survey.meetings[..] else { panic!("{:?}", survey.meetings) };
        assert!(near.cell == Some([1, 0, 0]) && (near.initial_gap.unwrap() - 0.04).abs() < 1e-12, "{near:?}");
        // What may come within reach, where nobody has strayed, follows: the next but one, with no gap.
        assert!(far.iter().all(|meeting| meeting.initial_gap.is_none() && meeting.cell > near.cell), "{far:?}");
        assert_eq!(survey.pairs, [survey.meetings.len(), 0]);
    }
}

#[test]
fn meetings_are_told_with_the_sharper_feature() {
    let text = r#"
        time = { end = 1, sample = 1 }
        contact = [{ between = ["a", "b"], repulsion = { alpha = 1, nu = 2.5, d0 = 0.01 }, reach = 2 }]
        body = [
            { name = "a", shape = { box = { size = [0.2, 0.2, 0.2] } }, mass = 1 },
            { name = "b", shape = { sphere = { radius = 0.1 } }, mass = 1, position = [0, 0, 0.5] },
        ]
    "#;
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    let survey = Survey::of(&scene).unwrap();
    let [told] = &survey.meetings[..] else { panic!("{:?}", survey.meetings) };
    assert!((told.initial_gap.unwrap() - 0.3).abs() < 1e-12 && told.reach == Some(2.0));
    assert!(!told.forbids_touching && told.laws[0].feature == Some("vertex"));
    let words = survey.text(&scene).unwrap();
    assert!(words.contains("meeting    a with b: gap 0.3 m at the start, felt within 2 m, which"), "{words}");
}

/// The critical exponents of a corner, a rim and a smooth point are 3, 2.5 and 2.
#[test]
fn at_the_critical_exponent_a_law_only_just_forbids_touching() {
    let shapes = [
        ("box = { size = [0.2, 0.2, 0.2] }", 3.0, "vertex"),
        ("cylinder = { radius = 0.1, height = 0.1 }", 2.5, "rim"),
        ("ellipsoid = { semi_axes = [0.1, 0.1, 0.2] }", 2.0, "smooth point"),
    ];
    for (shape, critical, feature) in shapes {
        let told = |nu: f64| {
            let text = format!(
                "time = {{ end = 1, sample = 1 }}\nsupport = [{{ name = \"table\", plane = {{}} }}]\ncontact = [\
                 {{ between = [\"a\", \"b\"], repulsion = {{ alpha = 1, nu = {nu}, d0 = 0.01 }} }},\
                 {{ support = \"table\", body = \"a\", repulsion = {{ alpha = 1, nu = {nu}, d0 = 0.01 }} }}]\n\
                 body = [{{ name = \"a\", shape = {{ {shape} }}, mass = 1, position = [0, 0, 1] }},\
                 {{ name = \"b\", shape = {{ sphere = {{ radius = 0.1 }} }}, mass = 1, position = [0, 0, 2] }}]\n"
            );
            let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
            let survey = Survey::of(&scene).unwrap();
            assert!(survey.meetings[0].forbids_touching && survey.bodies[0].supports[0].forbids_touching);
            survey.text(&scene).unwrap()
        };
        // For the two bodies and for the plane alike.
        let words = told(critical);
        let line = format!("ν = {critical} = {critical} ({feature}): forbids touching only just");
        assert_eq!(words.matches(&line).count(), 2, "{words}");
        let words = told(critical + 0.25);
        assert!(!words.contains("only just") && words.contains(": forbids touching\n"), "{words}");
    }
}

/// Dice in two orientations, and among them one ball.
#[test]
fn a_crowd_is_told_in_as_many_words_as_it_has_sorts() {
    let told = |count: usize| {
        let mut text = String::from(
            r#"
            time = { end = 1, sample = 1 }
            support = [{ name = "table", plane = {} }]
            contact = [{ support = "table", repulsion = { alpha = 245, nu = 6, d0 = 6e-4 } }]
            "#,
        );
        for k in 0..count {
            let shape = if k == 3 { "sphere = { radius = 0.01 }" } else { "box = { size = [0.02, 0.02, 0.02] }" };
            let height = 0.05 + 0.01 * (k % 2) as f64;
            text += &format!(
                "[[body]]\nname = \"b{k}\"\nshape = {{ {shape} }}\ndensity = 1250\n\
                 position = [{k}, 0, {height}]\norientation = {{ euler_xyz = [{}, 0, 0] }}\n",
                0.7 * (k % 2) as f64
            );
        }
        let scene = Scene::parse("crowd.toml", &text, Path::new(""), &[]).unwrap();
        Survey::of(&scene).unwrap().text(&scene).unwrap()
    };
    let text = told(120);
    assert_eq!(text.lines().count(), told(300).lines().count());
    assert!(text.contains("\n119 bodies alike, b0 to b119\n") && text.contains("\nbody b3\n"), "{text}");
    let line = text.lines().find(|line| line.starts_with("  on table: gap 0.04")).unwrap();
    assert!(line.contains(" to 0.04") && line.ends_with(" m at the start"), "{line}");
    assert_eq!(text.matches("[[body]]").count(), 2, "{text}");
    assert_eq!(text.matches("forbids touching").count(), 2, "{text}");
}

/// Symptom: the gap at which a body would rest was given for one that a force lifts, a potential presses or a fluid
/// carries.
#[test]
fn a_body_on_which_more_acts_than_its_weight_is_given_no_gap_of_rest() {
    let told = |keys: &str, head: &str| {
        let text = format!(
            "{head}time = {{ end = 1, sample = 1 }}\n[[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\n\
             support = \"floor\"\nrepulsion = {{ alpha = 2000, nu = 6, d0 = 1e-3 }}\n\
             damping = {{ beta = 20000, nu = 6, d0 = 1e-3 }}\n[[body]]\nname = \"b\"\n\
             shape = {{ box = {{ size = [0.2, 0.2, 0.2] }} }}\ndensity = 1000\nposition = [0, 0, 0.101]\n{keys}\n"
        );
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]);
        let scene = scene.unwrap_or_else(|errors| panic!("{errors}"));
        Survey::of(&scene).unwrap().text(&scene).unwrap()
    };
    let alone = told("", "");
    assert!(alone.contains("rests at a gap of") && alone.contains("damping ratio"), "{alone}");
    for keys in [
        "force = [{ point = [0, 0, 0], value = [\"0\", \"0\", \"100\"] }]",
        "body_force = [\"0\", \"0\", \"9000\"]",
        "potential = \"-60*z\"",
    ] {
        let told = told(keys, "");
        assert!(!told.contains("rests at a gap of") && told.contains("forces of its own act"), "{told}");
    }
    let carried = told("inclusion = {}", "fluid = { viscosity = 1e-3, density = 500 }\n");
    assert!(!carried.contains("rests at a gap of") && carried.contains("the fluid acts"), "{carried}");
}
