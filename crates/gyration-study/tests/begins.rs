//! The bound on friction from the angle at which a body begins to slide, and its strength from how fast it creeps
//! below.

use gyration_study::calibration::{Calibration, Fitted};
use std::path::Path;

/// A block on a table, with a bound on friction and some adhesion.
fn scene(adhesion: f64) -> String {
    format!(
        r#"
        time = {{ end = 1.0, sample = 0.1 }}
        [[support]]
        name = "table"
        plane = {{}}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 40e3, nu = 6, d0 = 2e-3 }}
        friction = {{ beta = 4e4, nu = 6, d0 = 2e-3, mu = 0.4 }}
        adhesion = {{ beta = {adhesion:?}, nu_attractive = 3, nu_repulsive = 9, d0 = 2e-3 }}
        [[body]]
        name = "block"
        shape = {{ box = {{ size = [0.05, 0.05, 0.05] }} }}
        density = 1000
        position = [0, 0, 0.1]
        "#
    )
}

fn calibration(adhesion: f64, text: &str) -> Calibration {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("block.toml"), scene(adhesion)).unwrap();
    Calibration::parse("data.toml", &format!("scene = \"block.toml\"\n{text}"), folder.path()).unwrap()
}

fn fit(adhesion: f64, text: &str) -> Fitted {
    calibration(adhesion, text).fit().unwrap()
}

const MU: &str = "[fit.mu]\nkey = \"contact.0.friction.mu\"\n";

#[test]
fn angle_at_which_a_body_begins_to_slide_is_that_of_the_bound() {
    let text = format!("{MU}[[slope]]\nbegins = true\nangle = 0.3\ndeviation = 0.01\n");
    let [angle] = calibration(0.0, &text).predictions().unwrap()[..] else { panic!("one row") };
    assert!((angle.tan() - 0.4).abs() < 1e-9, "{angle}");
    // What adheres is pressed by more than its weight.
    let [held] = calibration(300.0, &text).predictions().unwrap()[..] else { panic!("one row") };
    assert!(held.tan() > 0.41, "{held}");
    let found =
        fit(0.0, &format!("{MU}[[slope]]\nbegins = true\nangle = [\"15 deg\", \"17 deg\"]\ndeviation = \"1 deg\"\n"));
    println!("mu {:?} ± {:?}", found.numbers[0].value, found.numbers[0].error);
    assert!((found.numbers[0].value.atan() - 16_f64.to_radians()).abs() < 1e-4);
    // ½ of the variance of one, 1 deg (1 + μ²).
    let expected = 1_f64.to_radians() * (1.0 + found.numbers[0].value.powi(2)) / 2_f64.sqrt();
    assert!((found.numbers[0].error.unwrap() / expected - 1.0).abs() < 1e-2);
}

/// A table far from the origin leaves the gap fewer digits: the slope is found as well as they tell it.
#[test]
fn angle_is_found_wherever_the_table_is() {
    for height in [0.5, 3.7, 100.0, 1000.0] {
        let text = scene(0.0).replace("plane = {}", &format!("plane = {{ origin = [0, 0, {height:?}] }}"));
        let text = text.replace("position = [0, 0, 0.1]", &format!("position = [0, 0, {:?}]", height + 0.1));
        let folder = tempfile::TempDir::new().unwrap();
        std::fs::write(folder.path().join("block.toml"), text).unwrap();
        for mu in [0.2_f64, 0.35, 0.9, 1.4] {
            let wanted = format!("[[slope]]\nbegins = true\nangle = {:?}\ndeviation = 0.01\n", mu.atan());
            let data = format!("scene = \"block.toml\"\n{MU}start = {:?}\n{wanted}", 1.1 * mu);
            let found = Calibration::parse("data.toml", &data, folder.path()).unwrap().fit();
            let found = found.unwrap_or_else(|error| panic!("{height} m, {mu}: {error}"));
            let off = (found.numbers[0].value / mu - 1.0).abs();
            println!("{height} m, mu {mu}: off by {off:.1e}");
            assert!(off < 1e-7, "{height} m, {mu}: {off:e}");
        }
    }
}

#[test]
fn speeds_below_the_bound_tell_the_strength_of_friction() {
    let text = "[fit.beta]\nkey = \"contact.0.friction.beta\"\nstart = 3e4\n[[slope]]\nangle = [0.1, 0.3]\n";
    let speed = |slope: f64| {
        let tan = slope.tan();
        tan / (1.0 - (tan / 0.4).powi(2)).sqrt()
    };
    let found = fit(0.0, &format!("{text}speed = [{:?}, {:?}]\ndeviation = 1e-3\n", speed(0.1), speed(0.3)));
    assert!((found.numbers[0].value / 4e4 - 1.0).abs() < 1e-6, "{:?}", found.numbers);
}

#[test]
fn what_cannot_be_is_told() {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("block.toml"), scene(0.0)).unwrap();
    let parse = |text: &str| {
        let text = format!("scene = \"block.toml\"\n{MU}[[slope]]\n{text}\n");
        Calibration::parse("data.toml", &text, folder.path()).map(|_| ()).unwrap_err().to_string()
    };
    for (text, expected) in [
        ("begins = true\nangle = 0.3\nspeed = 1\ndeviation = 0.1", "has no speed yet"),
        ("begins = true\nangle = \"95 deg\"\ndeviation = 0.1", "cannot be"),
        ("begins = 1\nangle = 0.3\ndeviation = 0.1", "begins"),
        ("begins = true\nangle = \"3 m\"\ndeviation = 0.1", "rad"),
    ] {
        let message = parse(text);
        assert!(message.contains(expected) && message.contains("fix:"), "{message}");
    }
    // Above the bound it has no steady speed.
    let text = format!("{MU}[[slope]]\nangle = 0.5\nspeed = 1\ndeviation = 0.1\n");
    let message = calibration(0.0, &text).fit().unwrap_err().to_string();
    assert!(message.contains("faster for ever"), "{message}");
    let viscous =
        "[fit.beta]\nkey = \"contact.0.friction.beta\"\n[[slope]]\nbegins = true\nangle = 0.3\ndeviation = 0.1\n";
    let text = scene(0.0).replace(", mu = 0.4", "");
    std::fs::write(folder.path().join("block.toml"), text).unwrap();
    let data = Calibration::parse("data.toml", &format!("scene = \"block.toml\"\n{viscous}"), Path::new(folder.path()));
    let message = data.unwrap().fit().unwrap_err().to_string();
    assert!(message.contains("give it a `mu`"), "{message}");
}
