//! What a random scene is drawn from: the stream, the scales of its bodies, and the files beside it.
//!
//! Lengths are drawn in sizes, times in √(size/pull), speeds in √(pull·size), where the pull is gravity or what stands
//! for it. So a scene makes sense at any size and mass.

use super::stream::Stream;
use std::f64::consts::PI;

/// A scene while it is drawn.
#[derive(Debug)]
pub struct Draft {
    /// Random numbers.
    pub stream: Stream,
    /// Radius of the bodies [m].
    pub size: f64,
    /// Mass of a body [kg].
    pub mass: f64,
    /// Acceleration that the rest is measured by [m/s²].
    pub pull: f64,
    /// Files beside the scene: name and text.
    pub files: Vec<(String, String)>,
    /// Whether bodies meet one another.
    pub meets: bool,
    /// Whether nothing from outside acts on them.
    pub isolated: bool,
}

impl Draft {
    /// The scales of a case: a millimetre to a kilometre, from foam to gold, now and then much lighter or heavier.
    pub fn of(seed: u64, case: u64) -> Self {
        let mut stream = Stream::of(seed, case);
        let size = stream.decade(-3.0, 3.0);
        let pull = if stream.chance(0.85) { 9.81 } else { size * stream.decade(-1.0, 1.0) };
        let mass =
            stream.decade(1.5, 4.3) * size.powi(3) * if stream.chance(0.2) { stream.decade(-3.0, 3.0) } else { 1.0 };
        let meets = stream.chance(0.6);
        let isolated = meets && stream.chance(0.4);
        Self { stream, size, mass, pull, files: Vec::new(), meets, isolated }
    }

    /// The unit of time [s].
    pub fn time(&self) -> f64 {
        (self.size / self.pull).sqrt()
    }

    /// The unit of speed [m/s].
    pub fn speed(&self) -> f64 {
        (self.size * self.pull).sqrt()
    }

    /// Mass per volume, about [kg/m³].
    pub fn density(&self) -> f64 {
        self.mass / (4.0 / 3.0 * PI * self.size.powi(3))
    }

    /// The pressure under a body of this weight [Pa].
    pub fn pressure(&self) -> f64 {
        self.mass * self.pull / (self.size * self.size)
    }

    /// Puts a text beside the scene; the name of its file.
    pub fn file(&mut self, stem: &str, ending: &str, text: String) -> String {
        let name = format!("{stem}-{}.{ending}", self.files.len());
        self.files.push((name.clone(), text));
        name
    }
}
