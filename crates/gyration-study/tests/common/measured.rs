//! A body above a table, and measurements of it.

use gyration_study::calibration::{Calibration, Fitted};

/// A ball above a table, in a file of its own.
pub const BALL: &str = r#"
    time = { end = 1.0, sample = 0.1 }
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = 40e3, nu = 6, d0 = 2e-3 }
    damping = { beta = 5e4, nu = 4, d0 = 2e-3 }
    friction = { beta = 4e4, nu = 6, d0 = 2e-3 }
    adhesion = { beta = 2e3, nu_attractive = 3, nu_repulsive = 9, d0 = 2e-3 }
    [[body]]
    name = "ball"
    shape = { box = { size = [0.05, 0.05, 0.05] } }
    density = 1000
    position = [0, 0, 0.1]
"#;

/// A folder with that file.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    folder
}

/// What is fitted to measurements of it.
pub fn fit(text: &str) -> Fitted {
    let folder = folder();
    Calibration::parse("data.toml", text, folder.path()).unwrap().fit().unwrap()
}

/// What the scene itself would have measured: residuals of data that are zero.
pub fn exact(sections: &str) -> Vec<f64> {
    let text = format!("scene = \"ball.toml\"\n[fit.a]\nkey = \"contact.0.repulsion.alpha\"\n{sections}");
    let folder = folder();
    let calibration = Calibration::parse("data.toml", &text, folder.path()).unwrap();
    calibration.predictions().unwrap()
}
