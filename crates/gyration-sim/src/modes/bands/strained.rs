//! A cell that is deformed step by step, its bodies following: a_a(s) = F̄(s) a_a, each rest sought from the last.

use super::stability::{Stability, Unstable, ZoneMesh};
use super::{LatticeWaves, NoBands, Rest, are_driven, held_forces};
use gyration::lattice::Lattice;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};

/// Halvings of the step in which a lattice becomes unstable: all digits that s has.
const HALVINGS: usize = 46;

/// F̄(s) = 1 + E₀ + s (E₁ − E₀), both symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainPath {
    /// E₀ and E₁.
    pub ends: [Mat3; 2],
}

/// What is wrong with a path of strains.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StrainError {
    /// A component does not parse.
    #[error(
        "\"{word}\" is no component of a strain: write xx=0..-0.1, or xx=-0.1 for one value; xx, yy, zz, xy, xz, yz"
    )]
    Component {
        /// As it is written.
        word: String,
    },
    /// A component stands twice.
    #[error("\"{word}\" gives a component that another word gives as well: leave one out")]
    Twice {
        /// As it is written.
        word: String,
    },
    /// A range stands where one value is wanted.
    #[error("--strain takes one value of each component, as xx=-0.05; ranges are for --along")]
    Range,
    /// The cell would be turned inside out.
    #[error("a strain must leave det F̄ > 0: at s = {s} it is {determinant}")]
    Inverted {
        /// Where on the path.
        s: String,
        /// det F̄.
        determinant: String,
    },
}

impl StrainPath {
    /// Reads `xx=0..-0.1,yy=0.05`; a value alone stays what it is.
    ///
    /// # Errors
    /// [`StrainError`].
    pub fn parse(text: &str) -> Result<Self, StrainError> {
        let mut ends = [Mat3::zeros(); 2];
        let mut given = [[false; 3]; 3];
        for word in text.split(',').map(str::trim) {
            let wrong = || StrainError::Component { word: word.to_owned() };
            let (name, values) = word.split_once('=').ok_or_else(wrong)?;
            let [i, j] = component(name.trim()).ok_or_else(wrong)?;
            let (from, to) = values.split_once("..").unwrap_or((values, values));
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
            let values = [number(from).ok_or_else(wrong)?, number(to).ok_or_else(wrong)?];
            if given[i][j] {
                return Err(StrainError::Twice { word: word.to_owned() });
            }
            (given[i][j], given[j][i]) = (true, true);
            for (end, value) in ends.iter_mut().zip(values) {
                (end[(i, j)], end[(j, i)]) = (value, value);
            }
        }
        let path = Self { ends };
        let inverted = (0..=100).map(|k| f64::from(k) / 100.0).find(|s| path.at(*s).determinant() <= 0.0);
        match inverted {
            Some(s) => {
                Err(StrainError::Inverted { s: s.to_string(), determinant: path.at(s).determinant().to_string() })
            }
            None => Ok(path),
        }
    }

    /// One value, as `xx=-0.05,xy=0.01`.
    ///
    /// # Errors
    /// [`StrainError`].
    pub fn parse_value(text: &str) -> Result<Self, StrainError> {
        let path = Self::parse(text)?;
        if path.ends[0] == path.ends[1] { Ok(path) } else { Err(StrainError::Range) }
    }

    /// F̄.
    pub fn at(&self, s: f64) -> Mat3 {
        let [from, to] = self.ends;
        Mat3::identity() + from + s * (to - from)
    }
}

/// Which entry a name means.
fn component(name: &str) -> Option<[usize; 2]> {
    let axis = |letter: char| "xyz".find(letter);
    let mut letters = name.chars();
    let both = [axis(letters.next()?)?, axis(letters.next()?)?];
    letters.next().is_none().then_some(both)
}

/// A cell at a deformation of its vectors.
#[derive(Debug, Clone)]
pub struct StrainedCell {
    model: Model,
    state: State,
    /// The vectors as they are written.
    written: Lattice,
    gradient: Mat3,
    /// By how much F̄ may be off where the vectors have sought their rest; 0 where they are as written.
    unsettled: f64,
    /// F̄ at which they have come to rest; the identity where they are as written.
    rest: Mat3,
}

/// A value of a path.
#[derive(Debug)]
pub struct StrainedRow {
    /// s.
    pub s: f64,
    /// F̄.
    pub gradient: Mat3,
    /// The waves there.
    pub waves: LatticeWaves,
    /// How stable it is.
    pub stability: Stability,
}

/// Where a lattice first becomes unstable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instability {
    /// s.
    pub s: f64,
    /// F̄.
    pub gradient: Mat3,
    /// The wave that grows beyond.
    pub wave: Unstable,
}

impl StrainedCell {
    /// A cell as it is written.
    pub fn new(model: &Model, state: &State) -> Self {
        let (model, state) = (model.clone(), State { low: Vec::new(), ..state.clone() });
        let one = Mat3::identity();
        Self { written: Lattice::clone(&model.lattice), model, state, gradient: one, unsettled: 0.0, rest: one }
    }

    /// The cell at another deformation: its bodies move along, then seek their rest.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn at(&self, gradient: &Mat3) -> Result<(Self, LatticeWaves), NoBands> {
        let carried = self.carried_to(gradient)?;
        let waves = LatticeWaves::new(&carried.model, &carried.state, true)?;
        Ok((carried.resting(&waves.rest().bodies), waves))
    }

    /// The same while contractions are held, and the forces that the vectors carry there.
    pub(super) fn held_at(&self, gradient: &Mat3) -> Result<(Self, Vec<Vec3>), NoBands> {
        let carried = self.carried_to(gradient)?;
        let (rests, forces) = held_forces(&carried.model, &carried.state)?;
        Ok((carried.resting(&rests), forces))
    }

    /// The cell at another deformation, whose bodies have moved along.
    fn carried_to(&self, gradient: &Mat3) -> Result<Self, NoBands> {
        let step = self.gradient.try_inverse().map_or(*gradient, |inverse| gradient * inverse);
        if let Some(body) = self.model.leaves_guide(&step) {
            return Err(NoBands::Guide(self.model.name(body).to_owned()));
        }
        let (model, state) = self.state.carried(&self.model, &step, self.written.deformed(gradient));
        Ok(Self { model, state, gradient: *gradient, written: self.written.clone(), ..*self })
    }

    /// The same cell with its bodies where they rest.
    fn resting(mut self, rests: &[Rest]) -> Self {
        for (body, rest) in rests.iter().enumerate() {
            let start = self.model.slots(body).block().start;
            self.state.bodies[start..start + rest.block().len()].copy_from_slice(rest.block());
        }
        self
    }

    /// F̄ now.
    pub(super) fn gradient(&self) -> &Mat3 {
        &self.gradient
    }

    /// Whether a contraction moves by its law.
    pub(super) fn contracts(&self) -> bool {
        are_driven(&self.model, 0..self.model.bodies.len())
    }

    /// By how much relaxed shapes differ from those of another state of the cell.
    pub(super) fn relaxed_apart(&self, other: &Self) -> f64 {
        let contraction = |cell: &Self, body: usize| cell.state.contraction(&cell.model, body);
        let apart = |body: usize| Some((contraction(self, body)? - contraction(other, body)?).norm());
        (0..self.model.bodies.len()).filter_map(apart).fold(0.0, f64::max)
    }

    /// The cells of a run, of which this is one, where the vectors of this one have come to rest: their bodies move
    /// along.
    pub fn carry(&self, model: &Model, state: &State) -> (Model, State) {
        state.carried(model, &self.rest, model.lattice.deformed(&self.rest))
    }

    /// F̄ at which the vectors have come to rest; the identity where they are as written.
    pub fn rest(&self) -> &Mat3 {
        &self.rest
    }

    /// The vectors as they are written.
    pub(super) fn written(&self) -> &Lattice {
        &self.written
    }

    /// The cell at a deformation, from there on as if it were written so, but for what F̄ may be off.
    pub(super) fn as_written(&self, gradient: &Mat3, unsettled: f64) -> Result<Self, NoBands> {
        let there = self.at(gradient)?.0;
        let rest = gradient * self.rest;
        Ok(Self { written: Lattice::clone(&there.model.lattice), gradient: Mat3::identity(), unsettled, rest, ..there })
    }

    /// By how much F̄ may be off.
    pub(super) fn unsettled(&self) -> f64 {
        self.unsettled
    }

    /// What becomes of it along a path, and where it first becomes unstable.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn along(
        self,
        path: &StrainPath,
        steps: usize,
        zone: ZoneMesh<'_>,
    ) -> Result<(Vec<StrainedRow>, Option<Instability>), NoBands> {
        let mut rows: Vec<StrainedRow> = Vec::new();
        let mut instability = None;
        let mut last = self;
        let steps = steps.max(2);
        for k in 0..steps {
            let s = k as f64 / (steps - 1) as f64;
            let gradient = path.at(s);
            let (cell, waves) = last.at(&gradient)?;
            let stability = waves.stability(zone)?;
            if let (Some(wave), None) = (stability.unstable, &instability) {
                let before = rows.last().map(|row| row.s);
                instability = Some(match before {
                    None => Instability { s, gradient, wave },
                    Some(before) => last.first_unstable(path, [before, s], wave, zone)?,
                });
            }
            rows.push(StrainedRow { s, gradient, waves, stability });
            last = cell;
        }
        Ok((rows, instability))
    }

    /// Halves the step in which the lattice becomes unstable, of which this is the cell before.
    fn first_unstable(
        &self,
        path: &StrainPath,
        [mut stable, mut unstable]: [f64; 2],
        mut wave: Unstable,
        zone: ZoneMesh<'_>,
    ) -> Result<Instability, NoBands> {
        let mut cell = self.clone();
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stable + unstable);
            if middle <= stable || middle >= unstable {
                break;
            }
            let (there, waves) = cell.at(&path.at(middle))?;
            match waves.stability(zone)?.unstable {
                Some(found) => (unstable, wave) = (middle, found),
                None => (stable, cell) = (middle, there),
            }
        }
        Ok(Instability { s: unstable, gradient: path.at(unstable), wave })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_of_a_strain_are_read() {
        let path = StrainPath::parse("xx=0..-0.2, yx=0.05").unwrap_or_else(|error| panic!("{error}"));
        let half = path.at(0.5);
        assert_eq!((half[(0, 0)], half[(0, 1)], half[(1, 0)], half[(2, 2)]), (0.9, 0.05, 0.05, 1.0));
        for wrong in ["", "xx", "xw=1", "xx=a", "xx=0..", "xy=0.1,yx=0.1", "xx=0..-1.5", "xxx=1"] {
            assert!(StrainPath::parse(wrong).is_err(), "{wrong}");
        }
    }
}
