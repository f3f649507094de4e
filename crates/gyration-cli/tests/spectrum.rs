//! `gyration spectrum`: what it prints and draws, and what it refuses.

use crate::common::Sandbox;
use serde_json::Value;

const RING: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 2, sample = 0.05 }
lattice = { cell = [[0.1, 0, 0]], repeat = [4, 1, 1], wave = { kappa = [0.25, 0, 0], branch = 2, amplitude = 1e-6 } }
[[body]]
name = "a"
shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
[[spring]]
between = ["a", "a"]
cell = [1, 0, 0]
stiffness = 40
rest_length = 0.1
damping = 0.1
"#;

#[test]
fn a_spectrum_is_told_in_words_in_json_and_in_a_picture() {
    let sandbox = Sandbox::new();
    sandbox.write("ring.toml", RING);
    sandbox.done(&["run", "ring.toml"]);
    let said = sandbox.done(&["spectrum", "ring.gyr"]).stdout;
    for told in ["4 wave vectors with 3 branches each, 41 samples to t = 2 s", "ω measured", "lost most"] {
        assert!(said.contains(told), "{told}: {said}");
    }
    let json = sandbox.done(&["spectrum", "ring.gyr", "--json"]).stdout;
    let found: Value = serde_json::from_str(&json).unwrap();
    let shape = |value: &Value| value.as_array().map_or(0, Vec::len);
    let of = ["kappa", "omega", "energy", "branches", "t", "total", "run"].map(|key| shape(&found[key]));
    assert_eq!((of, shape(&found["kappa"][0]), shape(&found["energy"][0])), ([4, 4, 4, 12, 41, 41, 41], 3, 3));
    assert_eq!(found["kappa"][2], serde_json::json!([0.25, 0.0, 0.0]));
    let branch = &found["branches"][8];
    // δ = 2(c/m) sin²(π/4).
    assert!((branch["width"].as_f64().unwrap() - 0.2).abs() < 1e-5, "{branch}");
    assert!((branch["omega"].as_f64().unwrap() - (160.0_f64 - 0.04).sqrt()).abs() < 1e-4, "{branch}");
    assert!(found["branches"][0]["width"].is_null() && found.get("energies").is_none());
    let all = sandbox.done(&["spectrum", "ring.gyr", "--json", "--energies"]).stdout;
    let all: Value = serde_json::from_str(&all).unwrap();
    assert_eq!([shape(&all["energies"]), shape(&all["energies"][0]), shape(&all["energies"][0][0])], [41, 4, 3]);
    sandbox.done(&["spectrum", "ring.gyr", "--plot", "ring.svg"]);
    let picture = std::fs::read_to_string(sandbox.path("ring.svg")).unwrap();
    assert!(picture.contains("all branches") && picture.contains("cell vector 1"), "{}", &picture[..400]);
}

#[test]
fn what_has_no_spectrum_is_refused() {
    let sandbox = Sandbox::new();
    let free = RING.replace("wave = { kappa = [0.25, 0, 0], branch = 2, amplitude = 1e-6 }", "periodic = false");
    sandbox.write("free.toml", &free);
    sandbox.done(&["run", "free.toml"]);
    let said = sandbox.refused(2, &["spectrum", "free.gyr"]).stderr;
    assert!(said.contains("free ends") && said.contains("periodic = true"), "{said}");
    let said = sandbox.refused(2, &["spectrum", "free.gyr", "--energies"]).stderr;
    assert!(said.contains("--json"), "{said}");
}
