//! `gyration bands`: what it prints, and what it refuses.

use crate::common::Sandbox;
use serde_json::Value;

/// Masses of ½ kg on springs of 40 N/m that are a fifth longer than they were.
const STRING: &str = "\
title = \"a string\"
[world]
gravity = [0, 0, 0]
[time]
end = 1
sample = 1
[lattice]
cell = [[1, 0, 0]]
[[body]]
name = \"a\"
shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
[[spring]]
between = [\"a\", \"a\"]
cell = [1, 0, 0]
stiffness = 40
rest_length = 0.8
";

/// Two masses in turn, along a line that nothing stretches.
pub(crate) const DIATOMIC: &str = "\
[world]
gravity = [0, 0, 0]
[time]
end = 1
sample = 1
[lattice]
cell = [[1, 0, 0]]
[[body]]
name = \"a\"
shape = { points = [{ mass = 2, at = [0, 0, 0] }] }
[[body]]
name = \"b\"
shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
position = [0.5, 0, 0]
[[spring]]
between = [\"a\", \"b\"]
stiffness = 3
rest_length = 0.5
[[spring]]
between = [\"b\", \"a\"]
cell = [1, 0, 0]
stiffness = 3
rest_length = 0.5
";

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("string.toml", STRING);
    sandbox.write("diatomic.toml", DIATOMIC);
    sandbox
}

fn json(sandbox: &Sandbox, arguments: &[&str]) -> Value {
    let arguments = [&["bands"][..], arguments, &["--json"]].concat();
    serde_json::from_str(&sandbox.done(&arguments).stdout).unwrap()
}

#[track_caller]
fn assert_near(found: &Value, expected: f64) {
    let found = found.as_f64().unwrap();
    // Rounding of some ten operations, in the square of a frequency.
    assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{found} {expected}");
}

#[test]
fn bands_of_a_string_are_those_of_its_tension() {
    let sandbox = sandbox();
    let found = json(&sandbox, &["string.toml", "--path", "0,0,0 X=1/2,0,0", "--points", "3", "--shapes"]);
    let (across, along) = (2.0 * 16_f64.sqrt(), 2.0 * 80_f64.sqrt());
    assert_eq!(found["kappa"], serde_json::json!([[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.5, 0.0, 0.0]]));
    assert_near(&found["omega"][2][0], across);
    assert_near(&found["omega"][1][2], along * 0.5_f64.sqrt());
    assert_near(&found["velocity"][1][2][0], 80_f64.sqrt() * 0.5_f64.sqrt());
    assert_near(&found["sound"][0]["speed"][0], 4.0);
    assert_near(&found["sound"][0]["speed"][2], 80_f64.sqrt());
    assert_near(&found["rest"]["force"][0][0], 8.0);
    assert_eq!(found["labels"], serde_json::json!([[2, "X"]]));
    assert_eq!(found["shapes"][1][0]["a"]["translation"].as_array().unwrap().len(), 3);
    let words = sandbox.done(&["bands", "string.toml", "--points", "3"]).stdout;
    assert!(words.contains("cell vector 1") && words.contains("17.8885"), "{words}");
}

#[test]
fn complex_bands_decay_in_a_gap() {
    let sandbox = sandbox();
    let arguments = ["diatomic.toml", "--complex", "--omega", "1..2.1", "--points", "12"];
    let found = json(&sandbox, &arguments);
    // cos q = 1 − ω²(m₁ + m₂)/k + ω⁴m₁m₂/(2k²).
    for (omega, kappa) in found["omega"].as_array().unwrap().iter().zip(found["kappa"].as_array().unwrap()) {
        let square = omega.as_f64().unwrap().powi(2);
        let cosine = 1.0 - square + square * square / 9.0;
        assert_eq!(kappa.as_array().unwrap().len(), 2, "{omega}");
        for wave in kappa.as_array().unwrap() {
            let [re, im] = [0, 1].map(|k| std::f64::consts::TAU * wave[k].as_f64().unwrap());
            // Rounding grows where two κ are near one another.
            assert!((re.cos() * im.cosh() - cosine).abs() < 1e-9, "{omega} {wave} {cosine}");
            assert!(re.sin().abs() < 1e-9 || im == 0.0, "{omega} {wave}");
        }
    }
    let words = sandbox.done(&[&["bands"][..], &arguments].concat()).stdout;
    assert!(words.contains("0.50000"), "{words}");
}

#[test]
fn a_string_buckles_where_it_is_slack() {
    let sandbox = sandbox();
    let found = json(&sandbox, &["string.toml", "--along", "xx=0..-0.4", "--steps", "5"]);
    assert_eq!(found["path"].as_array().unwrap().len(), 5);
    assert_near(&found["path"][1]["force"][0][0], 4.0);
    let first = &found["instability"];
    // ω² below zero by 1e-10 of the stiffest is rounding.
    assert!((first["s"].as_f64().unwrap() - 0.5).abs() < 1e-9, "{first}");
    assert_eq!(first["macroscopic"], true);
    assert!(found["path"][4]["least_omega2"].as_f64().unwrap() < -10.0);
    let words = sandbox.done(&["bands", "string.toml", "--along", "xx=0..-0.4", "--steps", "3"]).stdout;
    assert!(words.contains("unstable from s = 0.5"), "{words}");
    let stretched = json(&sandbox, &["string.toml", "--strain", "xx=0.1", "--points", "2"]);
    assert_near(&stretched["rest"]["force"][0][0], 12.0);
}

#[test]
fn pictures_and_files_for_other_programs_are_written() {
    let sandbox = sandbox();
    let path = ["--path", "G=0,0,0 X=0.5,0,0 | 0.25,0,0 G=0,0,0", "--points", "5", "--mesh", "8", "--shapes"];
    let files = ["--plot", "bands.svg", "--yaml", "band.yaml"];
    let said = sandbox.done(&[&["bands", "diatomic.toml"][..], &path, &files].concat());
    assert!(said.stderr.contains("wrote bands.svg") && said.stdout.contains("gap 1.73205"), "{}", said.stdout);
    let picture = std::fs::read_to_string(sandbox.path("bands.svg")).unwrap();
    assert!(picture.starts_with("<svg") || picture.starts_with("<?xml"));
    let text = std::fs::read_to_string(sandbox.path("band.yaml")).unwrap();
    assert!(text.contains("nqpoint: 10\nnpath: 2\nsegment_nqpoint:\n- 5\n- 5\n"), "{text}");
    assert!(text.contains("- [ 'G', 'X' ]") && text.contains("natom: 2"), "{text}");
    assert_eq!((text.matches("q-position").count(), text.matches("frequency:").count()), (10, 60));
    assert_eq!(text.matches("eigenvector:").count(), 60);
}

#[test]
fn what_bands_cannot_do_is_refused() {
    let sandbox = sandbox();
    sandbox.write("alone.toml", &STRING.replace("[lattice]\ncell = [[1, 0, 0]]\n", "").replace("cell = [1, 0, 0]", ""));
    sandbox.write("free.toml", &STRING.replace("cell = [[1, 0, 0]]", "cell = [[1, 0, 0]]\nperiodic = false"));
    for (arguments, word) in [
        (&["string.toml", "--path", "0,0,0 X"][..], "no vertex"),
        (&["string.toml", "--path", "0,0.5,0"], "leaves what is periodic"),
        (&["free.toml"], "gyration modes"),
        (&["string.toml", "--complex", "--direction", "2"], "not periodic"),
        (&["string.toml", "--complex", "--omega", "3"], "0..20"),
        (&["string.toml", "--along", "xx"], "no component"),
        (&["string.toml", "--strain", "xx=-1"], "det"),
        (&["string.toml", "--strain", "xx=0..0.1"], "one value of each component"),
        (&["string.toml", "--along", "xx=0..0.1", "--steps", "1"], "--steps 2"),
        (&["string.toml", "--omega", "0..3"], "--complex"),
        (&["string.toml", "--set", "solver.max_wall_time=1e-9"], "longer than solver.max_wall_time"),
        (&["string.toml", "--plot", "bands.bmp"], ""),
    ] {
        let said = sandbox.refused(2, &[&["bands"][..], arguments].concat());
        assert!(said.stderr.contains(word), "{arguments:?}: {}", said.stderr);
    }
    let said = sandbox.run(&["bands", "alone.toml"]);
    assert!(said.code != Some(0) && !said.stderr.contains("panicked"), "{}", said.stderr);
}

#[test]
fn a_cell_rests_under_its_stress_or_is_told_to_be_floppy() {
    let sandbox = sandbox();
    let stress = ["--set", "lattice.stress=[[4, 0, 0], [0, 0, 0], [0, 0, 0]]"];
    let relax = ["string.toml", "--points", "2", "--set", "lattice.relax=[\"granules\", \"cell\"]"];
    let found = json(&sandbox, &[&relax[..], &stress].concat());
    assert_near(&found["rest"]["cell"][0][0], 0.9);
    assert_near(&found["rest"]["force"][0][0], 4.0);
    let pressed = json(&sandbox, &[&relax[..], &["--set", "lattice.pressure=-6"]].concat());
    assert_near(&pressed["rest"]["cell"][0][0], 0.95);
    // A step of the search lets the soft discs of this sheet overlap, and is halved.
    let scene = r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 1, sample = 1 }
        [lattice]
        cell = [[0.1, 0, 0], [0.05, 0.0866, 0]]
        relax = ["granules", "cell"]
        pressure = 10
        [[contact]]
        between = ["a", "a"]
        repulsion = { alpha = 300, nu = 4, d0 = 0.002 }
        reach = 0.02
        [[body]]
        name = "a"
        shape = { sphere = { radius = 0.048 } }
        density = 700
        affine = { material = { st_venant_kirchhoff = { lambda = 4000, mu = 3000 } } }
        potential = "20*z^2"
    "#;
    sandbox.write("sheet.toml", scene);
    let sheet = json(&sandbox, &["sheet.toml", "--points", "2"]);
    // The search for the cell ends where steps are 1e-13 of it, and stiffness is 1e4 times the pressure.
    let stress = &sheet["rest"]["stress"];
    assert!([0, 1].iter().all(|i| (stress[*i][*i].as_f64().unwrap() + 10.0).abs() < 1e-8), "{stress}");
    // A sheet of nothing but squares can be sheared.
    let square = STRING.replace("[[1, 0, 0]]", "[[1, 0, 0], [0, 1, 0]]\nrelax = [\"cell\"]");
    let across = "[[spring]]\nbetween = [\"a\", \"a\"]\ncell = [0, 1, 0]\nstiffness = 40\nrest_length = 0.8\n";
    sandbox.write("square.toml", &format!("{square}{across}"));
    let said = sandbox.refused(2, &["bands", "square.toml"]);
    assert!(said.stderr.contains("F̄_xy"), "{}", said.stderr);
}

#[test]
fn derivatives_and_bounds_are_added() {
    let sandbox = sandbox();
    let keys = "spring.0.stiffness body.a.shape.points.0.mass";
    let path = ["string.toml", "--path", "0,0,0 X=1/2,0,0", "--points", "3"];
    let found = json(&sandbox, &[&path[..], &["--derivatives", keys, "--bound"]].concat());
    let along = 2.0 * 80_f64.sqrt();
    let near = |found: &Value, expected: f64| {
        let found = found.as_f64().unwrap();
        // Differences of fourth order of neighbouring scenes.
        assert!((found - expected).abs() < 1e-9 * expected.abs(), "{found} {expected}");
    };
    near(&found["derivatives"]["spring.0.stiffness"][2][2], along / 80.0);
    near(&found["derivatives"]["body.a.shape.points.0.mass"][2][2], -along);
    // Nothing opposes a translation: ω is 0, and has no derivative.
    assert_eq!(found["derivatives"]["spring.0.stiffness"][0], serde_json::json!([null, null, null]));
    let bound = found["bound"][2][2].as_f64().unwrap();
    assert!(bound > 0.0 && bound < 1e-12 * along, "{bound}");
    let plain = json(&sandbox, &path);
    assert!(plain.get("derivatives").is_none() && plain.get("bound").is_none());
    let said = sandbox.done(&[&["bands"], &path[..], &["--derivatives", keys, "--bound"]].concat());
    assert!(said.stdout.contains("∂ln ω/∂ln p by branch at X κ = (0.5000, 0.0000, 0.0000)"), "{}", said.stdout);
    assert!(said.stdout.contains("may be off by at most"), "{}", said.stdout);
}

#[test]
fn what_is_no_number_has_no_derivative() {
    let sandbox = sandbox();
    let refused = |keys: &str, words: &[&str]| {
        let said = sandbox.refused(2, &["bands", "string.toml", "--derivatives", keys]);
        assert!(words.iter().all(|word| said.stderr.contains(word)), "{keys}: {}", said.stderr);
    };
    refused("constants.k", &["constants.k", "the scene has no `"]);
    refused("spring.3.stiffness", &["spring.3.stiffness", "0 to 0"]);
    refused("body.a", &["body.a", "several numbers"]);
    refused("body.a.name", &["no number"]);
    refused("solver.rtol", &["solver.rtol", "not how it is"]);
    refused("spring.0.stiffness spring.0.stiffness", &["stands twice"]);
    sandbox.refused(2, &["bands", "string.toml", "--complex", "--derivatives", "spring.0.stiffness"]);
}

#[test]
fn phases_are_told_and_those_of_losses_are_not() {
    let sandbox = sandbox();
    sandbox.write("turned.toml", &DIATOMIC.replacen("stiffness = 3", "stiffness = 2", 1));
    let found = json(&sandbox, &["turned.toml", "--topology"]);
    assert_eq!(found["directions"], serde_json::json!([1]));
    assert_eq!(found["zak"][0].as_array().unwrap().len(), 6);
    assert_eq!(found["chern"], serde_json::json!([]));
    let said = sandbox.done(&["bands", "turned.toml", "--topology", "--mesh", "12"]);
    assert!(said.stdout.contains("Zak phases by branch [π]\n  along κ1"), "{}", said.stdout);
    sandbox.write("lossy.toml", &STRING.replace("rest_length = 0.8", "rest_length = 0.8\ndamping = 0.1"));
    let said = sandbox.refused(2, &["bands", "lossy.toml", "--topology"]);
    assert!(said.stderr.contains("neither decay nor grow"), "{}", said.stderr);
    sandbox.write("squeezed.toml", &STRING.replace("rest_length = 0.8", "rest_length = 1.2"));
    let said = sandbox.refused(2, &["bands", "squeezed.toml", "--topology"]);
    assert!(said.stderr.contains("one grows"), "{}", said.stderr);
    sandbox.refused(2, &["bands", "turned.toml", "--topology", "--shapes"]);
}
