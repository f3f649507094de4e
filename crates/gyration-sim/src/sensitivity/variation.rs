//! How the start, the rates and the rows change with a number of the scene, at a fixed state.
//!
//!   ∂f/∂p ≈ (8 (f₁ − f₋₁) − (f₂ − f₋₂))/(12 h),   f_k = f(t, y; p + k h)
//!
//! The rates are an explicit smooth formula, so that differences of fourth order between models of neighbouring scenes
//! give ten digits and more. h begins at 1e-4 of the number; where that bends the rates too much, seen from the
//! difference of h and 2h, it is reduced for good. Where one side is refused, as for a β of zero, all points stand on the other.

use super::number::Number;
use gyration::Inadmissible;
use gyration::model::Model;
use gyration::rates::{Workspace, rates};
use gyration::state::State;
use gyration_scene::Scene;

/// The first step, as a part of the number.
const FIRST: f64 = 1e-4;
/// By how much it is reduced at a time.
const REDUCTION: f64 = 0.1;
/// How often: from 1e-4 to 1e-9, where rounding leaves seven digits.
const LEVELS: usize = 6;
/// Two derivatives of second order, of h and 2h, may differ by this part: the one of fourth order is then good to its square.
const BEND: f64 = 1e-5;
/// What changes its scale by less than this in a second, for a change by the whole number, counts as no effect.
const NOTHING: f64 = 1e-6;
/// Differences that are smaller than so many roundings of what is differentiated are rounding.
const ROUNDINGS: f64 = 1e3;

/// The points of a difference, in steps, with their weights.
type Stencil = &'static [(f64, f64)];

/// (8 (f₁ − f₋₁) − (f₂ − f₋₂))/12.
const CENTRAL: Stencil = &[(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];
/// (−25 f₀ + 48 f₁ − 36 f₂ + 16 f₃ − 3 f₄)/12.
const FORWARD: Stencil =
    &[(0.0, -25.0 / 12.0), (1.0, 48.0 / 12.0), (2.0, -36.0 / 12.0), (3.0, 16.0 / 12.0), (4.0, -3.0 / 12.0)];

/// What the number's change does.
#[derive(Debug)]
pub(super) struct Variation {
    /// The number.
    pub number: Number,
    base: Scene,
    levels: Vec<Level>,
    starts_only: bool,
    workspace: Workspace,
    /// The step in use.
    at: usize,
    /// The largest derivative so far, in the scales.
    largest: f64,
    /// The part of it in which two estimates may differ.
    doubt: f64,
    /// What rounding may add to the last derivative, in the scales.
    noise: f64,
    /// What is evaluated at each point, one after the other.
    values: Vec<Vec<f64>>,
}

/// The neighbouring scenes at one step.
#[derive(Debug)]
struct Level {
    step: f64,
    stencil: Stencil,
    scenes: Vec<Scene>,
}

/// A derivative that could not be had.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// In words.
    Reason(String),
    /// A neighbouring model does not know the state.
    Inadmissible(Inadmissible),
}

impl From<Inadmissible> for Fault {
    fn from(left: Inadmissible) -> Self {
        Self::Inadmissible(left)
    }
}

impl Variation {
    /// Prepares the neighbouring scenes.
    ///
    /// # Errors
    /// Why the derivative by this number has no meaning, in words.
    pub fn new(scene: &Scene, number: Number) -> Result<Self, String> {
        if let Some(reason) = number.is_no_quantity() {
            return Err(reason);
        }
        let starts_only = number.starts_only(scene);
        let mut this = Self {
            number,
            base: scene.clone(),
            levels: Vec::new(),
            starts_only,
            workspace: Workspace::default(),
            at: 0,
            largest: 0.0,
            doubt: 0.0,
            noise: 0.0,
            values: Vec::new(),
        };
        this.first_level()?;
        Ok(this)
    }

    /// The change of the number that counts as one: itself, or a size of the scene where it is zero.
    pub fn scale(&self) -> f64 {
        if self.number.value != 0.0 {
            return self.number.value.abs();
        }
        let sizes = self.base.built().model.bodies.iter().map(|body| body.size);
        let least = sizes.fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 1.0 }
    }

    /// Whether the rates do not know the number.
    pub fn starts_only(&self) -> bool {
        self.starts_only
    }

    /// ∂y₀/∂p.
    pub fn start(&mut self, scales: &[f64]) -> Result<Vec<f64>, Fault> {
        self.differentiate(scales, |scene, _, out| {
            out.extend_from_slice(&scene.built().state.bodies);
            Ok(())
        })
    }

    /// ∂f/∂p, and ∂g/∂p of the works behind it.
    pub fn rates(&mut self, time: f64, bodies: &[f64], scales: &[f64]) -> Result<Vec<f64>, Fault> {
        let works = scales.len() - bodies.len();
        if self.starts_only {
            return Ok(vec![0.0; bodies.len() + works]);
        }
        self.differentiate(scales, |scene, workspace, out| {
            out.resize(bodies.len() + works, 0.0);
            let (slopes, powers) = out.split_at_mut(bodies.len());
            rates(&scene.built().model, workspace, time, bodies, slopes, powers)
        })
    }

    /// ∂r/∂p of what a model says of a state; `row` fills it.
    pub fn row(
        &mut self,
        state: &State,
        mut row: impl FnMut(&Model, &mut Workspace, &State, &mut Vec<f64>) -> Result<(), Inadmissible>,
    ) -> Result<Vec<f64>, Fault> {
        self.differentiate(&[], |scene, workspace, out| row(&scene.built().model, workspace, state, out))
    }

    /// The derivative of a list of numbers, with a step at which it is smooth.
    ///
    /// Where a smaller step agrees no better with itself, it is rounding that speaks: the larger one is kept, and what
    /// is left of doubt is noted.
    fn differentiate(
        &mut self,
        scales: &[f64],
        mut evaluate: impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), Inadmissible>,
    ) -> Result<Vec<f64>, Fault> {
        let mut coarse: Option<Difference> = None;
        loop {
            let found = self.evaluate(scales, &mut evaluate);
            let fault = match found {
                Ok(found) => {
                    self.largest = self.largest.max(found.largest);
                    if let Some(coarse) = coarse.take_if(|coarse| found.bend > 0.5 * coarse.bend) {
                        self.at -= 1;
                        self.doubt = self.doubt.max(coarse.bend / self.largest.max(NOTHING / self.scale()));
                        return Ok(coarse.derivative);
                    }
                    if found.bend <= BEND * self.largest.max(NOTHING / self.scale()) {
                        return Ok(found.derivative);
                    }
                    coarse = Some(found);
                    None
                }
                Err(left) => Some(left),
            };
            if let Err(reason) = self.finer() {
                return match (coarse, fault) {
                    (Some(coarse), _) => {
                        self.doubt = self.doubt.max(coarse.bend / self.largest);
                        Ok(coarse.derivative)
                    }
                    (None, Some(left)) => Err(Fault::Inadmissible(left)),
                    (None, None) => Err(Fault::Reason(reason)),
                };
            }
        }
    }

    /// The derivative at the present step.
    fn evaluate(
        &mut self,
        scales: &[f64],
        evaluate: &mut impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), Inadmissible>,
    ) -> Result<Difference, Inadmissible> {
        let level = &self.levels[self.at];
        self.values.resize_with(level.scenes.len(), Vec::new);
        for (scene, values) in level.scenes.iter().zip(&mut self.values) {
            values.clear();
            evaluate(scene, &mut self.workspace, values)?;
        }
        let found = Difference::of(level, &self.values, scales);
        self.noise = found.noise;
        Ok(found)
    }

    /// What rounding may add to the last derivative, in the scales.
    pub fn noise(&self) -> f64 {
        if self.starts_only { 0.0 } else { self.noise }
    }

    /// The first step at which all neighbours are scenes.
    fn first_level(&mut self) -> Result<(), String> {
        let mut refused = String::new();
        for level in 0..LEVELS {
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
        let (last, stencil) = (self.levels[self.at].step, self.levels[self.at].stencil);
        let part = last / self.scale() * REDUCTION;
        if part < 0.5 * FIRST * REDUCTION.powi(LEVELS as i32 - 1) {
            return Err("the equations are not smooth in it".into());
        }
        let next = self.level(part, stencil)?;
        self.levels.push(next);
        self.at += 1;
        Ok(())
    }

    /// h.
    pub fn step(&self) -> f64 {
        self.levels[self.at].step
    }

    /// The part of its largest derivative in which two estimates differed, where that was not rounding.
    pub fn doubt(&self) -> f64 {
        self.doubt
    }

    /// The neighbours at a step, a part of the scale.
    fn level(&self, part: f64, stencil: Stencil) -> Result<Level, String> {
        let step = part * self.scale();
        let scene = |(offset, _): &(f64, f64)| self.number.scene_at(&self.base, self.number.value + offset * step);
        let scenes = stencil.iter().map(scene).collect::<Result<Vec<_>, _>>()?;
        let same = |scene: &Scene| {
            let (other, base) = (&scene.built().model, &self.base.built().model);
            other.blocks() == base.blocks() && other.works() == base.works() && other.energies() == base.energies()
        };
        if !scenes.iter().all(same) {
            return Err("it changes which equations there are".into());
        }
        Ok(Level { step, stencil, scenes })
    }

    /// A list of times [s] that each neighbour has, differentiated: the kinks of its signals.
    pub fn times(&mut self, mut times: impl FnMut(&Model) -> Vec<f64>) -> Result<Vec<f64>, Fault> {
        self.differentiate(&[], |scene, _, out| {
            out.extend(times(&scene.built().model));
            Ok(())
        })
    }
}

/// A derivative, and how well two estimates of it agree.
struct Difference {
    derivative: Vec<f64>,
    /// The largest entry, in the scales.
    largest: f64,
    /// The largest difference of two estimates of lower order, in the scales; none where it is rounding.
    bend: f64,
    /// What rounding may make, in the scales.
    noise: f64,
}

impl Difference {
    fn of(level: &Level, values: &[Vec<f64>], scales: &[f64]) -> Self {
        let length = values.iter().map(Vec::len).min().unwrap_or(0);
        let at = |i: usize| {
            let terms = level.stencil.iter().zip(values).map(|((_, weight), values)| weight * values[i]);
            terms.sum::<f64>() / level.step
        };
        let mut this = Self { derivative: (0..length).map(at).collect(), largest: 0.0, bend: 0.0, noise: 0.0 };
        let magnitude = scales.iter().enumerate().take(length).map(|(i, scale)| values[0][i].abs() / scale);
        let rounding = ROUNDINGS * f64::EPSILON * magnitude.fold(0.0, f64::max);
        this.noise = 0.1 * rounding / level.step;
        for (i, scale) in scales.iter().enumerate().take(length) {
            // Of the middle and of the whole, or of the first half and the second.
            let [narrow, wide] = match level.stencil.len() {
                4 => [(values[2][i] - values[1][i]) / 2.0, (values[3][i] - values[0][i]) / 4.0],
                _ => [(values[2][i] - values[0][i]) / 2.0, (values[4][i] - values[2][i]) / 2.0],
            };
            this.largest = this.largest.max(this.derivative[i].abs() / scale);
            let apart = (narrow - wide).abs() / scale;
            if apart > rounding {
                this.bend = this.bend.max(apart / level.step);
            }
        }
        this
    }
}
