//! Dice of 2 cm above one table, far enough apart on a grid that each has a place of its own.
//!
//! Thrown alike, all have the attitude, spin and height of the first; thrown differently, each has its own. Die k has
//! random numbers of its own, so that it is the same in a crowd of any size.

use crate::random::Random;
use gyration_scene::Scene;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// The lowest and the highest start [m].
const HEIGHTS: (f64, f64) = (0.06, 0.12);
/// The standard deviation of each component of the spins [rad/s].
const SPIN: f64 = 15.0;
/// From one place of the grid to the next [m]: three sides.
const SPACING: f64 = 0.06;
/// The key of the crowd, before which dice of other benchmarks have theirs.
const SEED: u64 = 1 << 32;

/// How the dice of a crowd are thrown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Throws {
    /// All in the same way.
    Alike,
    /// Each in its own way.
    Different,
}

/// The scene of so many dice, up to a time [s].
pub fn text(count: usize, throws: Throws, end: f64) -> String {
    text_of(0..count, throws, end)
}

/// The dice of these numbers alone.
fn text_of(dice: Range<usize>, throws: Throws, end: f64) -> String {
    let count = dice.len();
    let mut text = format!(
        r#"
title = "{count} dice"
time = {{ end = {end:?}, sample = 0.02 }}
[[support]]
name = "table"
plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
[[contact]]
support = "table"
repulsion = {{ alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }}
damping = {{ beta = 1e4, nu = 3, d0 = "0.6 mm" }}
friction = {{ beta = 1e4, nu = 3, d0 = "0.6 mm" }}
"#
    );
    let side = count.isqrt().max(1);
    for k in dice {
        let key = if throws == Throws::Alike { 0 } else { k as u64 };
        let place = [k % side, k / side].map(|row| SPACING * row as f64);
        // Writing to a string does not fail.
        let _ = write!(text, "{}", die(k, place, &mut Random::new(SEED + key)));
    }
    text
}

/// A die above its place [m].
fn die(number: usize, [x, y]: [f64; 2], random: &mut Random) -> String {
    let height = HEIGHTS.0 + (HEIGHTS.1 - HEIGHTS.0) * random.uniform();
    let attitude: [f64; 4] = std::array::from_fn(|_| random.normal());
    let spin: [f64; 3] = std::array::from_fn(|_| SPIN * random.normal());
    format!(
        r#"
[[body]]
name = "die-{number}"
shape = {{ box = {{ size = ["2 cm", "2 cm", "2 cm"] }} }}
density = "1.25 g/cm^3"
position = [{x:?}, {y:?}, {height:?}]
orientation = {{ quaternion = {attitude:?} }}
angular_velocity = {spin:?}
"#
    )
}

/// The scene of so many dice, up to a time [s].
///
/// # Panics
/// If the scene is not valid: a mistake in this file.
pub fn scene(count: usize, throws: Throws, end: f64) -> Scene {
    part(0..count, throws, end)
}

/// The dice of these numbers out of a larger crowd, thrown as there.
///
/// # Panics
/// As [`scene`].
pub fn part(dice: Range<usize>, throws: Throws, end: f64) -> Scene {
    let read = Scene::parse("crowd.toml", &text_of(dice, throws, end), Path::new(""), &[]);
    read.unwrap_or_else(|errors| panic!("{errors}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{gas, heap};

    #[test]
    fn crowds_begin_apart() {
        for scene in [scene(9, Throws::Different, 0.1), gas::scene(30, 0.1), heap::scene(9, 0.1)] {
            let built = scene.built();
            assert!(gyration_sim::Simulation::new(&built.model, &built.state, built.into()).is_ok());
        }
        let count = |scene: Scene| scene.built().model.bodies.len();
        assert_eq!([count(gas::scene(30, 0.1)), count(heap::scene(9, 0.1))], [30, 9]);
    }
}
