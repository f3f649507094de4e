//! A ball that falls on a table, and studies of it.

#![allow(dead_code, clippy::unwrap_used)]

pub mod measured;

use gyration_sim::Unwatched;
use gyration_study::{Study, Table, execute};
use std::num::NonZeroUsize;
use std::path::Path;

/// A ball that bounces once or twice: short to simulate.
pub const BALL: &str = r#"
title = "A ball on a table"
time = { end = 0.3, sample = 0.01 }
solver = { rtol = 1e-4 }

[[support]]
name = "table"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }

[[contact]]
support = "table"
repulsion = { alpha = "40 kPa", nu = 6, d0 = "2 mm" }
damping = { beta = 4e3, nu = 6, d0 = "2 mm" }

[[body]]
name = "ball"
shape = { sphere = { radius = "5 cm" } }
density = 1000
position = [0, 0, 0.2]
"#;

/// A grid, a random number and a random vector; lists, counts and texts are kept. Some starts are below the table.
pub const STUDY: &str = r#"
title = "Where does it go?"
scene = "ball.toml"
seed = 7
repetitions = 10

[set]
"time.end" = 0.25

[parameter.density]
key = "body.ball.density"
grid = { from = 500, to = 2000, count = 3, spacing = "log" }

[parameter.height]
key = "body.ball.position.2"
uniform = { from = "4 cm", to = 0.2 }

[parameter.velocity]
key = "body.ball.velocity"
direction = { magnitude = { from = 0.1, to = 0.4 } }

[parameter.law]
key = "contact.0.measure"
values = ["deformed_area", "reference_area"]

[keep]
face = { face = "ball" }
end = { last = "ball.z" }
lowest = { minimum = "ball.gap" }
mean = { mean = "ball.vz" }
touches = { count = "closest_approach" }
lows = { at = "closest_approach", column = "ball.gap", last = 3 }
far = { distance = "ball" }
"#;

/// A folder with the scene, and the study of it.
pub fn sandbox() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    folder
}

pub fn study(folder: &Path) -> Study {
    Study::parse("where.toml", STUDY, folder, &[]).unwrap_or_else(|error| panic!("{error}"))
}

pub fn threads(count: usize) -> NonZeroUsize {
    NonZeroUsize::new(count).unwrap()
}

/// Makes the missing runs of a table, all of them.
pub fn complete(study: &Study, table: &mut Table, count: usize) {
    assert!(execute(study, table, threads(count), &mut Unwatched).unwrap());
}
