//! What the readers of tables in time and of tables of places owe whatever bytes it gets: a scene that starts with
//! finite numbers, or errors with a place.

use gyration_scene::Scene;
use std::path::Path;

/// A couple, linear; a drive, cubic; the velocity of a fluid, three columns; the places of copies.
const SCENES: [&str; 4] = [
    r#"
    [time]
    end = 1
    sample = 0.1
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.1 } }
    density = 1000
    affine = { couple = { table = "table.csv" } }
    "#,
    r#"
    [time]
    end = 1
    sample = 0.1
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.1 } }
    density = 1000
    [body.contractile]
    material = { neo_hookean = { shear = 1000 } }
    contraction_viscosity = 10
    drive = { table = { file = "table.csv", interpolation = "cubic" } }
    "#,
    r#"
    [time]
    end = 1
    sample = 0.1
    [fluid]
    viscosity = 1
    velocity = { table = { file = "table.csv" } }
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.1 } }
    density = 1000
    inclusion = {}
    "#,
    r#"
    [time]
    end = 1
    sample = 0.1
    [[body]]
    name = "b"
    shape = { box = { size = [0.1, 0.2, 0.3] } }
    density = 1000
    copies = { places = "table.csv" }
    "#,
];

/// Reads the bytes as a table of each kind; it is put into `folder`.
pub fn check(folder: &Path, bytes: &[u8]) {
    let table = folder.join("table.csv");
    std::fs::write(&table, bytes).unwrap_or_else(|error| panic!("{}: {error}", table.display()));
    for text in SCENES {
        match Scene::parse("scene.toml", text, folder, &[]) {
            Ok(scene) => assert!(scene.built().state.bodies.iter().all(|number| number.is_finite())),
            Err(errors) => {
                assert!(errors.count() > 0);
                assert!(errors.into_iter().all(|error| error.line > 0 && !error.message.is_empty()));
            }
        }
    }
}
