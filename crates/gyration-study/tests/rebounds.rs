//! Rebounds: the gap at the apex, whatever the body does there, and what it tells of the laws.

use crate::common::measured::{exact, fit, folder};
use gyration_study::calibration::Calibration;
use gyration_study::{Study, Value};
use std::path::Path;

#[test]
fn a_rebound_tells_the_damping() {
    let text = |rebound: &str| {
        format!(
            "scene = \"ball.toml\"\n[fit.damping]\nkey = \"contact.0.damping.beta\"\nstart = 2e4\n\
             [[drop]]\nheight = [0.1, \"30 cm\"]\nrebound = {rebound}\ndeviation = \"1 mm\"\n"
        )
    };
    let sections = "[[drop]]\nheight = [0.1, \"30 cm\"]\nrebound = [0.05, 0.1]\ndeviation = \"1 mm\"\n";
    let found = fit(&text(&format!("{:?}", exact(sections))));
    println!("damping {} ± {:?}", found.numbers[0].value, found.numbers[0].error);
    // The runs are known to 1e-8.
    assert!((found.numbers[0].value - 5e4).abs() < 1e-6 * 5e4, "{}", found.numbers[0].value);
}

#[test]
fn rebounds_from_short_impacts_tell_the_damping() {
    let steel = "time = { end = 1, sample = 0.01 }\n[[support]]\nname = \"t\"\nplane = {}\n[[contact]]\nsupport = \"t\"\n\
                 repulsion = { alpha = 1e4, nu = 6, d0 = 1e-4 }\ndamping = { beta = 2e4, nu = 4, d0 = 1e-4 }\n[[body]]\nname = \"b\"\n\
                 shape = { sphere = { radius = 0.05 } }\ndensity = 2500\nposition = [0, 0, 0.5]\n";
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("steel.toml"), steel).unwrap();
    let text = |start: f64, rebounds: &[f64]| {
        format!(
            "scene = \"steel.toml\"\n[fit.damping]\nkey = \"contact.0.damping.beta\"\nstart = {start:?}\n\
             [[drop]]\nheight = [0.2, 0.35, 0.5]\nrebound = {rebounds:?}\ndeviation = 0.002\n"
        )
    };
    let calibration =
        |start: f64, rebounds: &[f64]| Calibration::parse("data.toml", &text(start, rebounds), folder.path()).unwrap();
    let rebounds = calibration(6e4, &[0.1; 3]).predictions().unwrap();
    let found = calibration(2e4, &rebounds).fit().unwrap();
    println!("{rebounds:?}: {:?}", found.numbers);
    assert!((found.numbers[0].value / 6e4 - 1.0).abs() < 1e-6, "{:?}", found.numbers);
    // By what moves each rebound by a tenth of its deviation.
    let moved = (0..3).map(|row| {
        let rebounds: Vec<f64> = (0..3).map(|k| rebounds[k] + if k == row { 2e-4 } else { 0.0 }).collect();
        10.0 * (calibration(6e4, &rebounds).fit().unwrap().numbers[0].value - 6e4)
    });
    let (error, expected) = (found.numbers[0].error.unwrap(), moved.map(|moved| moved * moved).sum::<f64>().sqrt());
    println!("± {error}, by moving the measurements {expected}");
    assert!((error / expected - 1.0).abs() < 0.02, "{error} {expected}");
}

#[test]
fn a_body_that_spins_at_its_start_is_not_dropped() {
    let text = "scene = \"ball.toml\"\nset = { \"body.ball.angular_velocity\" = [0, 1, 0] }\n[fit.damping]\nkey = \"contact.0.damping.beta\"\n\
                [[drop]]\nheight = 0.1\nrebound = 0.05\ndeviation = 1e-3\n";
    let folder = folder();
    let message = Calibration::parse("data.toml", text, folder.path()).unwrap().fit().unwrap_err().to_string();
    assert!(
        message.contains("drop.0, row 1") && message.contains("released at rest") && message.contains("fix:"),
        "{message}"
    );
}

#[test]
fn a_rebound_has_derivatives_by_contacts_and_by_other_numbers_and_on_a_slope() {
    for slope in [0.0, 0.1f64] {
        let normal = format!("\"support.table.plane.normal\" = [{:?}, 0, {:?}]", slope.sin(), slope.cos());
        let round = "\"body.ball.shape\" = { sphere = { radius = 0.025 } }";
        let sections = "[[drop]]\nheight = [0.1, 0.2, 0.3]\nrebound = [0.01, 0.01, 0.01]\ndeviation = \"1 mm\"\n";
        let text = |rebounds: &[f64], starts: [f64; 2]| {
            format!(
                "scene = \"ball.toml\"\nset = {{ {normal}, {round} }}\n[fit.damping]\nkey = \"contact.0.damping.beta\"\nstart = {:?}\n\
                 [fit.density]\nkey = \"body.ball.density\"\nstart = {:?}\n{}",
                starts[0],
                starts[1],
                sections.replace("[0.01, 0.01, 0.01]", &format!("{rebounds:?}"))
            )
        };
        let folder = folder();
        let exact = Calibration::parse("data.toml", &text(&[0.01; 3], [5e4, 1000.0]), folder.path()).unwrap();
        let found = fit(&text(&exact.predictions().unwrap(), [4e4, 900.0]));
        println!("slope {slope}: {:?} after {} evaluations", found.numbers, found.evaluations);
        // Runs and differences of them are known to some 1e-6; the two are correlated.
        for (number, truth) in found.numbers.iter().zip([5e4, 1000.0]) {
            assert!((number.value / truth - 1.0).abs() < 1e-4, "{number:?}");
        }
    }
}

#[test]
fn a_body_that_cannot_fall_is_told_why() {
    let cases = [
        ("\"world.gravity\" = [0, 0, 0]", "the `world.gravity` of the scene is zero"),
        ("\"world.gravity\" = [0, 0, 9.81]", "does not take it to its support `table`"),
        ("\"body.b.pin\" = [0, 0, 0]", "\"b\" has a `pin`"),
        ("\"body.b.keep\" = { line = [1, 0, 0] }", "it stays at its support, or its `keep` holds it"),
    ];
    for (set, expected) in cases {
        let folder = tempfile::TempDir::new().unwrap();
        std::fs::write(folder.path().join("body.toml"), scene("shape = { sphere = { radius = 0.05 } }")).unwrap();
        let text = format!(
            "scene = \"body.toml\"\nset = {{ {set} }}\n[fit.damping]\nkey = \"contact.0.damping.beta\"\n\
             [[drop]]\nheight = 0.1\nrebound = 0.05\ndeviation = 1e-3\n"
        );
        let calibration = Calibration::parse("data.toml", &text, folder.path()).unwrap();
        let message = calibration.predictions().unwrap_err().to_string();
        println!("{message}");
        assert!(message.contains("drop.0, row 1") && message.contains(expected), "{set}: {message}");
    }
}

/// A body above a table.
fn scene(body: &str) -> String {
    format!(
        r#"
        time = {{ end = 1.0, sample = 0.5 }}
        solver = {{ rtol = 1e-9 }}
        [[support]]
        name = "table"
        plane = {{}}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 40e3, nu = 6, d0 = 2e-3 }}
        damping = {{ beta = 5e4, nu = 4, d0 = 2e-3 }}
        friction = {{ beta = 4e4, nu = 6, d0 = 2e-3 }}
        [[body]]
        name = "b"
        density = 1000
        position = [0, 0, 0.5]
        {body}
        "#
    )
}

/// Turns after it has met the table with an edge.
const TILTED: &str = r#"
    shape = { box = { size = [0.1, 0.12, 0.08] } }
    orientation = { axis_angle = { axis = [1, 0.3, 0], angle = "10 deg" } }
"#;
/// Swings after it has met the table.
const SOFT: &str = r#"
    shape = { sphere = { radius = 0.05 } }
    affine = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 2 }
"#;
/// Gets longer and shorter by itself.
const ACTIVE: &str = r#"
    shape = { sphere = { radius = 0.05 } }
    [body.contractile]
    material = { mooney_rivlin = { c1 = 30000, c2 = 10000 } }
    viscosity = 20
    contraction_viscosity = 500
    drive = { square = { amplitude = [[0, 0, 0], [0, 0, 0], [0, 0, 1000]], frequency = 3 } }
"#;

/// Measurements of the damping with the body.
fn dropped(folder: &Path, start: f64, heights: &[f64], rebounds: &[f64]) -> Calibration {
    let text = format!(
        "scene = \"body.toml\"\n[fit.damping]\nkey = \"contact.0.damping.beta\"\nstart = {start:?}\n\
         [[drop]]\nheight = {heights:?}\nrebound = {rebounds:?}\ndeviation = 1e-3\n"
    );
    Calibration::parse("data.toml", &text, folder).unwrap()
}

/// The height of the centre of mass rises by more than the lowest point of a body that turns, and by another length
/// than that of one that deforms.
#[test]
fn rebound_is_the_gap_at_the_apex() {
    for body in [TILTED, SOFT, ACTIVE] {
        let folder = tempfile::TempDir::new().unwrap();
        std::fs::write(folder.path().join("body.toml"), scene(body)).unwrap();
        let keep = "gaps = { samples = \"b.gap\", last = 3 }\n\
                    apex = { at = \"apex\", body = \"b\", column = \"b.gap\", first = 1 }";
        let text = format!("scene = \"body.toml\"\n[keep]\n{keep}\n");
        let study = Study::parse("s.toml", &text, folder.path(), &[]).unwrap_or_else(|error| panic!("{error}"));
        let row = study.row(0);
        let kept = |name: &str| {
            let column = study.columns().iter().position(|column| column.name == name).unwrap();
            match &row.values[column] {
                Value::List(values) => values[0],
                other => panic!("{other:?}"),
            }
        };
        let (height, expected) = (kept("gaps"), kept("apex"));
        let rebound = dropped(folder.path(), 5e4, &[height], &[0.1]).predictions().unwrap()[0];
        println!("from {height} m to {rebound} m, the run {expected} m");
        // Two runs at rtol = 1e-9 with ends of their own.
        assert!(rebound > 0.0 && (rebound - expected).abs() < 1e-7, "{rebound} {expected}");
    }
}

#[test]
fn rebound_of_a_soft_ball_has_its_whole_derivative() {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("body.toml"), scene(SOFT)).unwrap();
    let heights = [0.1, 0.2];
    let measured = |damping: f64, rebounds: &[f64]| dropped(folder.path(), damping, &heights, rebounds);
    let rebounds = |damping: f64| measured(damping, &[0.05; 2]).predictions().unwrap();
    let found = measured(4.5e4, &rebounds(5e4)).fit().unwrap();
    println!("{:?} after {} evaluations", found.numbers, found.evaluations);
    // Differences of runs.
    assert!((found.numbers[0].value / 5e4 - 1.0).abs() < 1e-4, "{:?}", found.numbers);
    // σ over the norm of the derivatives by ln β, which are differences over 2 % here.
    let (lower, higher) = (rebounds(5e4 * (-0.01f64).exp()), rebounds(5e4 * 0.01f64.exp()));
    let slopes = lower.iter().zip(&higher).map(|(lower, higher)| (higher - lower) / 0.02);
    let expected = 5e4 * 1e-3 / slopes.map(|slope| slope * slope).sum::<f64>().sqrt();
    println!("± {:?}, by differences {expected}", found.numbers[0].error);
    assert!((found.numbers[0].error.unwrap() / expected - 1.0).abs() < 0.02, "{expected}");
}
