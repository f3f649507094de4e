//! `gyration fields`: what it prints and writes, and what it refuses.

use crate::common::Sandbox;
use serde_json::Value;

/// Two balls on a spring, and a third that may be met.
const BALLS: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 0.2, sample = 0.1 }
[[body]]
name = "a"
shape = { sphere = { radius = 0.05 } }
density = 1000
position = [0, 0, 0]
velocity = [0, 1, 0]
[[body]]
name = "b"
shape = { sphere = { radius = 0.05 } }
density = 1000
position = [0.3, 0, 0]
[[spring]]
between = ["a", "b"]
stiffness = 100
rest_length = 0.2
"#;

#[test]
fn fields_are_told_in_words_in_json_and_in_files() {
    let sandbox = Sandbox::new();
    sandbox.write("balls.toml", BALLS);
    sandbox.done(&["run", "balls.toml"]);
    let at = ["fields", "balls.gyr", "--width", "0.1", "--at", "0.15,0,0 -0.1,0,0"];
    let said = sandbox.done(&at).stdout;
    for told in ["left of the balances", "at (0.15, 0, 0) m, t = 0.2 s", "stress σ", "hyperstress"] {
        assert!(said.contains(told), "{told}: {said}");
    }
    let json = sandbox.done(&[&at[..], &["--json"]].concat()).stdout;
    let found: Value = serde_json::from_str(&json).unwrap();
    let shape = |value: &Value| value.as_array().map_or(0, Vec::len);
    let one = |name: &str| &found[name][2][1];
    assert_eq!(
        [shape(&found["t"]), shape(&found["x"]), shape(&found["density"]), shape(&found["density"][0])],
        [3, 2, 3, 2]
    );
    assert_eq!([shape(one("momentum")), shape(one("stress")), shape(&one("stress")[0])], [3, 3, 3]);
    assert_eq!([shape(one("flux")), shape(&one("hyperstress")[0]), shape(&one("hyperstress")[0][0])], [3, 3, 3]);
    // The spring is longer than it would be: what pulls is positive.
    assert!(found["stress"][0][0][0][0].as_f64().unwrap() > 0.0);
    let thinned: Value =
        serde_json::from_str(&sandbox.done(&[&at[..], &["--every", "2", "--json"]].concat()).stdout).unwrap();
    assert_eq!(thinned["t"], serde_json::json!([0.0, 0.2]));
    sandbox.done(&["fields", "balls.gyr", "--width", "0.1", "--grid", "4,3,1", "-o", "seen.vti"]);
    let bytes = std::fs::read(sandbox.path("seen.vti")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("WholeExtent=\"0 3 0 2 0 0\"") && text.contains("Name=\"hyperstress\""), "{}", &text[..400]);
    let list = std::fs::read_to_string(sandbox.path("seen.pvd")).unwrap();
    assert_eq!(list.matches("seen-vti/fields-").count(), 3);
    assert!(sandbox.path("seen-vti/fields-000002.vti").exists());
    for (grid, panels) in [("9,5,1", 3), ("9,1,1", 3)] {
        sandbox.done(&["fields", "balls.gyr", "--width", "0.1", "--grid", grid, "--plot", "seen.svg"]);
        let picture = std::fs::read_to_string(sandbox.path("seen.svg")).unwrap();
        let told = ["density", "speed", "pressure", "shear stress"].iter().filter(|name| picture.contains(**name));
        assert!(told.count() > panels, "{grid}");
    }
    sandbox.refused(2, &["fields", "balls.gyr", "--width", "0.1", "--at", "0,0,0", "--plot", "seen.svg"]);
    let said = sandbox.refused(2, &["fields", "balls.gyr", "--width", "1e308"]);
    assert!(said.stderr.contains("out of proportion"), "{}", said.stderr);
}

#[test]
fn what_cannot_be_averaged_is_refused() {
    let sandbox = Sandbox::new();
    let meeting = format!("{BALLS}[[contact]]\nbetween = [\"a\", \"b\"]\nrepulsion = {{ alpha = 1e-9, nu = 6 }}\n");
    sandbox.write("balls.toml", &meeting);
    sandbox.done(&["run", "balls.toml"]);
    for (arguments, told) in [
        (&["--width", "0.1"][..], "record = { pairs = true }"),
        (&["--width", "-1"], "above zero"),
        (&["--width", "inf"], "no finite number"),
        (&[], "--width"),
        (&["--width", "0.1", "--at", "0,0"], "no point"),
        (&["--width", "0.1", "--grid", "4,4"], "three counts"),
        (&["--width", "0.1", "--at", "0,0,0", "--grid", "4,4,4"], "cannot be used with"),
    ] {
        let said = sandbox.refused(2, &[&["fields", "balls.gyr"][..], arguments].concat());
        assert!(said.stderr.contains(told), "{arguments:?}: {}", said.stderr);
    }
}
