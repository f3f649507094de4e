//! Numbers of a lattice from frequencies of its waves: from a table beside the file; bad ones are refused.

use gyration_study::calibration::{Calibration, CalibrationError, Fitted};
use std::f64::consts::PI;
use std::fmt::Write as _;

/// Masses of ½ kg on springs of 40 N/m; ω = 2 √(k/m) |sin πκ| along, branch 2, nothing across.
const CHAIN: &str = r#"
    world = { gravity = [0, 0, 0] }
    time = { end = 1, sample = 1 }
    lattice = { cell = [[1, 0, 0]] }
    [[body]]
    name = "a"
    shape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }
    [[spring]]
    between = ["a", "a"]
    cell = [1, 0, 0]
    stiffness = 40
    rest_length = 1
"#;

const FIT: &str = "scene = \"chain.toml\"\n[fit.k]\nkey = \"spring.0.stiffness\"\nstart = 25\n";

fn folder(waves: &str) -> tempfile::TempDir {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("chain.toml"), CHAIN).unwrap();
    std::fs::write(folder.path().join("waves.csv"), waves).unwrap();
    folder
}

/// A table of waves of springs of 40 N/m.
fn waves() -> String {
    let mut text = "kappa_1,kappa_2,kappa_3,branch,omega,error,who\n".to_owned();
    for kappa in [0.1, 0.2, 0.3, 0.45] {
        let omega = 2.0 * 80_f64.sqrt() * (PI * kappa).sin();
        writeln!(text, "{kappa},0,0,2,{omega:?},0.05,me").unwrap();
    }
    text
}

fn fit(waves: &str, section: &str) -> Result<Fitted, CalibrationError> {
    let folder = folder(waves);
    Calibration::parse("data.toml", &format!("{FIT}{section}"), folder.path())?.fit()
}

#[test]
fn a_table_of_waves_tells_a_stiffness() {
    let section = "[[dispersion]]\ntable = \"waves.csv\"\n";
    let found = fit(&waves(), section).unwrap_or_else(|error| panic!("{error}"));
    let k = &found.numbers[0];
    // The end of the search: 1e-10 of a χ² that is its own scale, and rounding.
    assert!((k.value - 40.0).abs() < 1e-8, "{}", k.value);
    // ω ∝ √k: σ_k = 2k σ/√(Σω²).
    let squares: f64 = [0.1, 0.2, 0.3, 0.45].iter().map(|kappa| 320.0 * (PI * kappa).sin().powi(2)).sum();
    let error = k.error.unwrap();
    assert!((error - 80.0 * 0.05 / squares.sqrt()).abs() < 1e-6 * error, "{error}");
    assert_eq!(found.residuals.len(), 4);
    assert!((found.residuals[3].condition - 0.45).abs() < 1e-15);
    let folder = folder(&waves());
    let calibration = Calibration::parse("data.toml", &format!("{FIT}{section}"), folder.path()).unwrap();
    let text = found.text(&calibration);
    assert!(text.contains("dispersion.0") && text.contains("0.4500 0.0000 0.0000, 2"), "{text}");
    let curves = calibration.curves(&found);
    assert_eq!((curves.len(), curves[0].branch, curves[0].points.len()), (1, Some(2), 4));
}

#[test]
fn a_wave_in_wrong_units_is_named() {
    let mut lines: Vec<String> = waves().lines().map(str::to_owned).collect();
    // In Hz.
    lines[2] = format!("0.2,0,0,2,{:?},0.05,me", 80_f64.sqrt() * (0.2 * PI).sin() / PI);
    let found = fit(&(lines.join("\n") + "\n"), "[[dispersion]]\ntable = \"waves.csv\"\n");
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    let suspect = found.suspect.unwrap();
    assert_eq!((suspect.table.as_str(), suspect.row), ("dispersion.0", Some(1)));
}

#[test]
fn what_no_wave_can_be_is_refused() {
    let refused = |section: &str, words: &[&str]| {
        let Err(error) = fit(&waves(), &format!("[[dispersion]]\n{section}\n")) else {
            panic!("{section} is taken");
        };
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{section}: {message}");
    };
    let rest = "kappa_1 = [0.1, 0.2]\nomega = [5, 10]\nerror = 0.1";
    refused(&format!("branch = [2, 2.5]\n{rest}"), &["row 2", "2.5", "count branches"]);
    refused(&format!("branch = -1\n{rest}"), &["row 1", "-1"]);
    refused(rest, &["`branch` is missing"]);
    refused("branch = 2\nkappa_1 = [0.1, 0.2]\nomega = [5, 0]\nerror = 0.1", &["row 2", "above zero"]);
    refused("branch = 2\nkappa_1 = [0.1, 0.2]\nomega = [5, 8]\nerror = 0", &["error", "above zero"]);
    refused("branch = 2\nkappa_1 = [0.1, 0.2]\nomega = [5, 8, 9]\nerror = 1", &["3 values of `omega`", "kappa_1"]);
    refused("table = \"nothing.csv\"", &["nothing.csv"]);
    refused(&format!("branch = 2\ndeviation = 1\n{rest}"), &["deviation"]);
    // What only the lattice tells.
    refused(&format!("branch = 7\n{rest}"), &["dispersion.0, row 1", "no branch 7", "has 3"]);
    let folder = folder(&waves());
    let alone =
        "time = { end = 1, sample = 1 }\n[[body]]\nname = \"a\"\nshape = { sphere = { radius = 1 } }\ndensity = 40\n";
    std::fs::write(folder.path().join("chain.toml"), alone).unwrap();
    let text = "scene = \"chain.toml\"\n[fit.k]\nkey = \"body.a.density\"\n[[dispersion]]\ntable = \"waves.csv\"\n";
    let error = Calibration::parse("data.toml", text, folder.path()).unwrap_err().to_string();
    assert!(error.contains("no `[lattice]`"), "{error}");
}
