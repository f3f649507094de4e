//! `gyration orbit`: what it prints, and what it refuses.

use crate::common::Sandbox;
use serde_json::Value;

const WELL: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 8, sample = 1 }
[[body]]
name = "a"
shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
position = [0.9, 0, 0]
potential = "0.5*x^2 + 0.25*x^4"
"#;

#[test]
fn an_orbit_is_told_in_words_and_in_json() {
    let sandbox = Sandbox::new();
    sandbox.write("well.toml", WELL);
    let arguments = ["orbit", "well.toml", "--amplitude", "body.a.x=1"];
    let said = sandbox.done(&arguments).stdout;
    assert!(said.contains("period      4.76802202") && said.contains("stable: no neighbour leaves it"), "{said}");
    let json = sandbox.done(&[&arguments[..], &["--json"]].concat()).stdout;
    let found: Value = serde_json::from_str(&json).unwrap();
    assert!((found["period"].as_f64().unwrap() - 4.768022029).abs() < 2e-9, "{json}");
    assert!(found["misfit"].as_f64().unwrap() < 1e-9 && found["stable"] == true, "{json}");
    let shape = |value: &Value| value.as_array().map_or(0, Vec::len);
    assert_eq!([shape(&found["multipliers"]), shape(&found["multipliers"][0])], [6, 2]);
    assert_eq!([shape(&found["start"]["a"]["position"]), shape(&found["start"]["a"]["gradient_rate"])], [3, 3]);
}

#[test]
fn what_is_no_orbit_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.write("well.toml", WELL);
    for (arguments, told) in [
        (&["--period", "-1"][..], "no time above zero"),
        (&["--period", "nan"], "no time above zero"),
        (&["--energy", "nan"], "no finite number"),
        (&["--amplitude", "body.a.x"], "is not as"),
        (&["--amplitude", "body.a.x=inf"], "is not as"),
        (&["--amplitude", "body.b.x=1"], "did you mean `a.x`?"),
        (&["--shift", "1"], "no `[lattice]`"),
        (&["--shift", "1,2"], "neither a number of cells nor three"),
        (&["--energy", "1", "--amplitude", "body.a.x=1"], "cannot be used with"),
        (&["--period", "4.8", "--set", "solver.max_wall_time=1e-9"], "took longer than solver.max_wall_time"),
    ] {
        let said = sandbox.refused(2, &[&["orbit", "well.toml"][..], arguments].concat());
        assert!(said.stderr.contains(told), "{arguments:?}: {}", said.stderr);
    }
}
