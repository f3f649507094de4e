//! The steps of differences by a number, and the neighbouring scenes of each.

use super::difference::{CENTRAL, FORWARD, Stencil, power_of_two};
use super::number::SceneNumber;
use gyration_scene::Scene;

/// The first step, as a part of the number.
const FIRST: f64 = 1e-4;
/// By how much it is reduced at a time.
const REDUCTION: f64 = 0.125;
/// How often: from 1e-4 to 5e-11, a thousandth of a gap that is 5e-8 of the number.
const LEVELS: usize = 8;
/// How often at most before there are neighbours, to 3e-9: nearer ones pass for the scene itself, as det P = 1 is asked
/// for to a tolerance.
const FIRST_LEVELS: usize = 6;
/// The largest step, as a part of the number, where smaller ones do not agree with themselves.
const LARGEST: f64 = 1e-2;

/// The neighbouring scenes at one step.
#[derive(Debug)]
pub(super) struct Neighbours {
    pub step: f64,
    pub stencil: Stencil,
    pub scenes: Vec<Scene>,
}

/// The steps that a number has been varied by, the larger ones first.
#[derive(Debug)]
pub(super) struct VariationSteps {
    /// The number.
    pub number: SceneNumber,
    base: Scene,
    levels: Vec<Neighbours>,
    /// The one in use.
    at: usize,
    /// Whether no larger one may be taken.
    keeps_step: bool,
}

impl VariationSteps {
    /// Without a step.
    pub fn new(scene: &Scene, number: SceneNumber) -> Self {
        Self { number, base: scene.clone(), levels: Vec::new(), at: 0, keeps_step: false }
    }

    /// Takes the first step at which there are neighbours, unless it has been taken.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn prepare(&mut self) -> Result<(), String> {
        if self.levels.is_empty() { self.first_level() } else { Ok(()) }
    }

    /// The scene whose neighbours they are.
    pub fn base(&self) -> &Scene {
        &self.base
    }

    /// The neighbours in use.
    pub fn current(&self) -> &Neighbours {
        &self.levels[self.at]
    }

    /// The change of the number that counts as one: itself, or a size of the scene where it is zero.
    pub fn scale(&self) -> f64 {
        if self.number.value != 0.0 {
            return self.number.value.abs();
        }
        let sizes = self.base.built().model.bodies.iter().map(|body| body.size);
        let least = sizes.fold(f64::INFINITY, f64::min);
        if least.is_finite() && least > 0.0 { least } else { 1.0 }
    }

    /// The first step at which all neighbours are scenes.
    fn first_level(&mut self) -> Result<(), String> {
        let mut refused = String::new();
        for level in 0..FIRST_LEVELS {
            for stencil in [CENTRAL, FORWARD] {
                match self.level(FIRST * REDUCTION.powi(level as i32), stencil) {
                    Ok(found) => {
                        self.levels.push(found);
                        return Ok(());
                    }
                    Err(reason) => refused = reason,
                }
            }
        }
        Err(format!("the scene admits no other value of it: {refused}"))
    }

    /// Takes a smaller step from now on.
    ///
    /// # Errors
    /// If there is none.
    pub fn finer(&mut self) -> Result<(), String> {
        if self.at + 1 < self.levels.len() {
            self.at += 1;
            return Ok(());
        }
        let (last, stencil) = (self.current().step, self.current().stencil);
        let part = last / self.scale() * REDUCTION;
        if part < 0.5 * FIRST * REDUCTION.powi(LEVELS as i32 - 1) {
            return Err("the equations are not smooth in it".into());
        }
        let next = self.level(part, stencil)?;
        self.levels.push(next);
        self.at += 1;
        Ok(())
    }

    /// Takes a larger step from now on, if there is one.
    pub fn coarser(&mut self) -> bool {
        if self.at > 0 {
            self.at -= 1;
            return true;
        }
        let part = self.current().step / self.scale() / REDUCTION;
        if self.keeps_step || part > 1.5 * LARGEST {
            return false;
        }
        let found = self.level(part, self.levels[0].stencil);
        found.map(|level| self.levels.insert(0, level)).is_ok()
    }

    /// Never takes a larger step than it has now.
    pub fn keep_step(&mut self) {
        self.levels.drain(..self.at);
        (self.at, self.keeps_step) = (0, true);
    }

    /// The neighbours at a step, a power of two near a part of the scale: rounding would else be a ten-millionth of the
    /// shortest steps.
    fn level(&self, part: f64, stencil: Stencil) -> Result<Neighbours, String> {
        let step = power_of_two(part * self.scale());
        let scene = |(offset, _): &(f64, f64)| self.number.scene_at(&self.base, self.number.value + offset * step);
        let scenes = stencil.iter().map(scene).collect::<Result<Vec<_>, _>>()?;
        if !scenes.iter().all(|scene| have_same_equations(&self.base, scene)) {
            return Err("it changes which equations there are".into());
        }
        Ok(Neighbours { step, stencil, scenes })
    }
}

/// Whether state and ledger of two scenes have the same entries.
pub(super) fn have_same_equations(one: &Scene, other: &Scene) -> bool {
    let (one, other) = (&one.built().model, &other.built().model);
    one.blocks() == other.blocks() && one.works() == other.works() && one.energies() == other.energies()
}
