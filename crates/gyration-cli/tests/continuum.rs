//! `gyration continuum`: what it prints, and what it refuses.

use crate::bands::DIATOMIC;
use crate::common::Sandbox;
use serde_json::Value;

#[test]
fn a_continuum_is_told_in_words_in_json_and_in_a_picture() {
    let sandbox = Sandbox::new();
    sandbox.write("chain.toml", DIATOMIC);
    let arguments = ["continuum", "chain.toml", "--path", "0,0,0 0.25,0,0", "--points", "3"];
    let said = sandbox.done(&[&arguments[..], &["--plot", "continuum.svg"]].concat());
    for told in [
        "6 coordinates a cell: u_x u_y u_z b.u_x b.u_y b.u_z",
        "density 3 kg/m",
        "  xxxx           1.5",
        "wavelengths below",
    ] {
        assert!(said.stdout.contains(told), "{told}: {}", said.stdout);
    }
    assert!(said.stderr.contains("nothing holds 2 motions"), "{}", said.stderr);
    let picture = std::fs::read_to_string(sandbox.path("continuum.svg")).unwrap();
    assert!(picture.contains("lattice") && picture.contains("mindlin"));
    let json = sandbox.done(&[&arguments[..], &["--model", "cauchy", "--json"]].concat()).stdout;
    let found: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(found["model"], "cauchy");
    assert_eq!(found["volume"], 1.0);
    let shape = |value: &Value| value.as_array().map_or(0, Vec::len);
    assert_eq!([shape(&found["D0"]), shape(&found["D1"]), shape(&found["D2"]), shape(&found["D2"][0])], [6, 3, 3, 3]);
    let map = &found["map"];
    // Motions across the chain that nothing holds stay beside u.
    assert_eq!([shape(&map["kappa"]), shape(&map["omega"][1]), shape(&map["continuum"][1])], [3, 6, 5]);
    assert!(map["error"][0].as_array().unwrap().iter().all(Value::is_null), "nothing moves at κ = 0");
    assert!(found["reach"][0]["wavelength"].as_f64().unwrap() > 1.0);
}

#[test]
fn what_is_no_continuum_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.write("chain.toml", DIATOMIC);
    sandbox.write("damped.toml", &DIATOMIC.replace("stiffness = 3\n", "stiffness = 3\ndamping = 0.1\n"));
    sandbox.write(
        "alone.toml",
        &DIATOMIC.replace("[lattice]\ncell = [[1, 0, 0]]\n", "").replace("cell = [1, 0, 0]\n", ""),
    );
    for (arguments, told) in [
        (&["damped.toml"][..], "leave out damping"),
        (&["alone.toml"], "no `[lattice]`"),
        (&["chain.toml", "--path", "0,0"], "no vertex"),
        (&["chain.toml", "--model", "hooke"], "possible values"),
        (&["chain.toml", "--plot", "continuum.bmp"], ""),
    ] {
        let said = sandbox.refused(2, &[&["continuum"][..], arguments].concat());
        assert!(said.stderr.contains(told), "{arguments:?}: {}", said.stderr);
    }
}
