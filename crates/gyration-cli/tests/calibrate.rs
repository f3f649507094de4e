//! `gyration calibrate`: numbers, drawing and exit codes.

use crate::common::Sandbox;
use serde_json::Value;

const BLOCK: &str = r#"
    time = { end = 1.0, sample = 0.1 }
    support = [{ name = "table", plane = {} }]
    contact = [{ support = "table", repulsion = { alpha = 40e3, nu = 6, d0 = 2e-3 } }]
    [[body]]
    name = "block"
    shape = { box = { size = [0.05, 0.05, 0.05] } }
    density = 1000
    position = [0, 0, 0.1]
"#;

/// Gaps that no scene gives exactly.
const DATA: &str = r#"
    scene = "block.toml"
    fit.alpha = { key = "contact.0.repulsion.alpha", start = "20 kPa" }
    fit.nu = { key = "contact.0.repulsion.nu", start = 5 }
    [[gap]]
    key = "body.block.density"
    at = [500, 1000, 2000, 4000]
    gap = ["5.53 mm", "4.92 mm", "4.38 mm", "3.90 mm"]
    deviation = "0.02 mm"
"#;

#[test]
fn measurements_are_fitted_printed_and_drawn() {
    let sandbox = Sandbox::new();
    sandbox.write("block.toml", BLOCK);
    sandbox.write("gaps.toml", DATA);
    let said = sandbox.done(&["calibrate", "gaps.toml"]);
    assert!(said.stdout.contains("alpha") && said.stdout.contains("--set contact.0.repulsion.nu="), "{}", said.stdout);
    assert!(sandbox.names().contains(&"gaps-fit.svg".to_owned()));
    let json: Value =
        serde_json::from_str(&sandbox.done(&["calibrate", "gaps.toml", "--json", "-o", "fit.png"]).stdout).unwrap();
    let nu = json["numbers"][1]["value"].as_f64().unwrap();
    // d ~ (weight)^(−1/ν): a factor of 8 in weight, 0.705 in the gap.
    assert!((nu - 8f64.ln() / (5.53f64 / 3.90).ln()).abs() < 0.3, "{nu}");
    assert!(sandbox.names().contains(&"fit.png".to_owned()));
}

#[test]
fn bad_measurements_are_refused() {
    let sandbox = Sandbox::new();
    sandbox.write("block.toml", BLOCK);
    sandbox.write("gaps.toml", &DATA.replace("deviation", "deviatoin"));
    let said = sandbox.refused(2, &["calibrate", "gaps.toml"]);
    assert!(said.stderr.contains("gaps.toml:9:5") && said.stderr.contains("deviation"), "{}", said.stderr);
    sandbox.refused(3, &["calibrate", "nothing.toml"]);
    sandbox.refused(2, &["calibrate", "gaps.toml", "-o", "fit.jpg"]);
}

#[test]
fn the_example_of_the_book_finds_the_laws_that_made_it() {
    let sandbox = Sandbox::new();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/examples/calibrate/measurements.toml");
    let said = sandbox.done(&["calibrate", data, "--json", "-o", "fit.svg"]);
    let json: Value = serde_json::from_str(&said.stdout).unwrap();
    let truth = [("adhesion", 5e3), ("damping", 2e4), ("exponent", 6.0), ("friction", 5e4), ("repulsion", 40e3)];
    let numbers = json["numbers"].as_array().unwrap();
    assert_eq!(numbers.len(), truth.len());
    for (name, expected) in truth {
        let number = numbers.iter().find(|number| number["name"] == name).unwrap();
        let number = |key: &str| number[key].as_f64().unwrap();
        let off = (number("value") / expected).ln() * number("value") / number("error");
        println!("{name} = {:.5e}, {off:.2} standard errors off", number("value"));
        // The errors of the data are normal ones.
        assert!(off.abs() < 3.0, "{name}: {off}");
    }
    // 9 degrees of freedom: 99.9 % lie below 28.
    assert!(json["chi_squared"].as_f64().unwrap() < 28.0, "{}", json["chi_squared"]);
}

#[test]
fn waves_of_a_lattice_are_fitted() {
    let sandbox = Sandbox::new();
    sandbox.write("chain.toml", crate::bands::DIATOMIC);
    // ω at the edge of the zone, √(2k/m): 3 N/m of masses of 2 kg and 1 kg.
    sandbox.write(
        "waves.csv",
        "kappa_1,kappa_2,kappa_3,branch,omega,error\n0.5,0,0,4,1.7320508,0.01\n0.5,0,0,5,2.4494897,0.01\n",
    );
    sandbox.write(
        "data.toml",
        "scene = \"chain.toml\"\n[fit.k]\nkeys = [\"spring.0.stiffness\", \"spring.1.stiffness\"]\nstart = 2\n\
         [[dispersion]]\ntable = \"waves.csv\"\n",
    );
    let json: Value = serde_json::from_str(&sandbox.done(&["calibrate", "data.toml", "--json"]).stdout).unwrap();
    let k = json["numbers"][0]["value"].as_f64().unwrap();
    assert!((k - 3.0).abs() < 1e-6, "{k}");
    assert!(sandbox.names().contains(&"data-fit.svg".to_owned()));
}
