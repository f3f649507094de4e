//! Changes of what a scene tells with one of its numbers: start, rates and rows at a fixed state, or matrices at rest.
//!
//!   ∂f/∂p ≈ (8 (f₁ − f₋₁) − (f₂ − f₋₂))/(12 h),   f_k = f(t, y; p + k h)
//!
//! The rates are an explicit smooth formula, so that differences of fourth order between models of neighbouring scenes
//! give ten digits and more. h begins at 1e-4 of the number; where that bends the rates too much, seen from the
//! difference of h and 2h, it is reduced for good; where the rates jump by a little, it is enlarged. Where one side is
//! refused, as for a β of zero, all points stand on the other.

mod dependence;
mod difference;
mod levels;
mod number;

pub(crate) use dependence::BaseRates;
pub(crate) use difference::power_of_two;
pub(crate) use number::SceneNumber;
pub use number::UnknownNumber;

use dependence::KnownDependence;
use difference::{Difference, rounding};
use gyration::Inadmissible;
use gyration::dynamics::{Workspace, rates};
use gyration::extended::Numbers;
use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Scene;
use levels::VariationSteps;

/// Where smaller steps do not agree with themselves to this part, larger ones are tried.
const ROUGH: f64 = 1e-4;
/// Slopes on both sides that differ by this part are compared with those of a smaller step, and so often.
const LEAN: f64 = 1e-2;
const COMPARISONS: u32 = 16;
/// Two derivatives of second order, of h and 2h, may differ by this part: the one of fourth order is then good to its
/// square.
const BEND: f64 = 1e-6;
/// What changes its scale by less than this in a second, for a change by the whole number, counts as no effect.
const NOTHING: f64 = 1e-6;
/// Two estimates of a derivative may differ by this part of the largest.
pub(crate) const NOT_SMOOTH: f64 = 1e-3;

/// What the number's change does.
#[derive(Debug)]
pub(crate) struct SceneVariation {
    levels: VariationSteps,
    starts_only: bool,
    /// How the rates depend on it, where that is known.
    known: Option<KnownDependence>,
    workspace: Workspace,
    /// How often slopes on both sides are still compared.
    comparisons: u32,
    /// The largest derivative so far, in the scales.
    largest: f64,
    /// The part of it in which two estimates may differ.
    doubt: f64,
    /// What rounding may add to the last derivative, in the scales.
    noise: f64,
    /// By how much two estimates of second order of the last derivative differ, in the scales.
    bend: f64,
    /// What is evaluated at each point, one after the other.
    values: Vec<Vec<f64>>,
    /// How often the rates of a neighbour were asked for.
    evaluations: u64,
}

/// A derivative that could not be had.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum NoDerivative {
    /// In words.
    Reason(String),
    /// A neighbouring model does not know the state.
    Inadmissible(Inadmissible),
}

impl From<Inadmissible> for NoDerivative {
    fn from(left: Inadmissible) -> Self {
        Self::Inadmissible(left)
    }
}

impl SceneVariation {
    /// Prepares the neighbouring scenes.
    ///
    /// # Errors
    /// Why the derivative by this number has no meaning, in words.
    pub fn new(scene: &Scene, number: SceneNumber) -> Result<Self, String> {
        let mut this = Self::unprepared(scene, number)?;
        this.levels.prepare()?;
        Ok(this)
    }

    /// The same for the rates along a run: with one neighbour where it is known how they depend on the number, and the
    /// others only where something else asks for them.
    ///
    /// # Errors
    /// As of [`Self::new`].
    pub fn along_run(scene: &Scene, number: SceneNumber) -> Result<Self, String> {
        let mut this = Self::unprepared(scene, number)?;
        let levels = &this.levels;
        this.known = KnownDependence::of(scene, &levels.number, levels.scale()).filter(|_| !this.starts_only);
        if this.known.is_none() {
            this.levels.prepare()?;
        }
        Ok(this)
    }

    /// Without a neighbour.
    fn unprepared(scene: &Scene, number: SceneNumber) -> Result<Self, String> {
        if let Some(reason) = number.is_no_quantity() {
            return Err(reason);
        }
        Ok(Self {
            starts_only: number.starts_only(scene),
            levels: VariationSteps::new(scene, number),
            known: None,
            workspace: Workspace::default(),
            comparisons: COMPARISONS,
            largest: 0.0,
            doubt: 0.0,
            noise: 0.0,
            bend: 0.0,
            values: Vec::new(),
            evaluations: 0,
        })
    }

    /// The change of the number that counts as one.
    pub fn scale(&self) -> f64 {
        self.levels.scale()
    }

    /// Whether the rates do not know the number.
    pub fn starts_only(&self) -> bool {
        self.starts_only
    }

    /// ∂y₀/∂p.
    pub fn start(&mut self, scales: &[f64]) -> Result<Vec<f64>, NoDerivative> {
        let here = &self.levels.base().built().state.bodies;
        // What is the same far away does not know the number.
        if self.known.as_ref().is_some_and(|known| known.scene().built().state.bodies == *here) {
            return Ok(vec![0.0; here.len()]);
        }
        self.differentiate(scales, |scene, _, out| {
            out.extend_from_slice(&scene.built().state.bodies);
            Ok(())
        })
    }

    /// Whether ∂g/∂p will be looked at: it may be known less well than ∂f/∂p.
    ///
    /// # Errors
    /// As of [`Self::new`].
    pub fn follow_works(&mut self) -> Result<(), String> {
        self.known.take_if(|known| !known.holds_of_powers());
        if self.known.is_none() { self.levels.prepare() } else { Ok(()) }
    }

    /// ∂f/∂p, and ∂g/∂p of the works behind it, of the scene with this model.
    pub fn rates(
        &mut self,
        model: &Model,
        base: &mut BaseRates,
        (time, bodies, scales): (f64, Numbers, &[f64]),
    ) -> Result<Vec<f64>, NoDerivative> {
        let n = bodies.high.len();
        if self.starts_only {
            return Ok(vec![0.0; scales.len()]);
        }
        let found = self.known.as_mut().map(|known| known.derivative(model, base, (time, bodies, scales)));
        self.evaluations += u64::from(found.is_some());
        // Where its neighbour does not know the state, one that is nearer may.
        if let Some(Ok((derivative, magnitude))) = found {
            (self.noise, self.bend) = (rounding(magnitude), 0.0);
            return Ok(derivative);
        }
        let mut evaluations = 0;
        let found = self.differentiate(scales, |scene, workspace, out| {
            evaluations += 1;
            out.resize(scales.len(), 0.0);
            let (slopes, powers) = out.split_at_mut(n);
            Ok(rates(&scene.built().model, workspace, time, bodies, slopes, powers)?)
        });
        self.evaluations += evaluations;
        found
    }

    /// How often the rates of a neighbour were asked for.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The derivative of what is told of the neighbouring scenes, in numbers of these scales, with an estimate of its
    /// error in the same scales.
    ///
    /// A hundred roundings of the largest number count as those of what is told.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of_told(
        &mut self,
        scales: &[f64],
        mut tell: impl FnMut(&Scene) -> Result<Vec<f64>, String>,
    ) -> Result<(Vec<f64>, f64), String> {
        let found = self.differentiate(scales, |scene, _, out| {
            *out = tell(scene).map_err(NoDerivative::Reason)?;
            Ok(())
        });
        let derivative = match found {
            Ok(derivative) => derivative,
            Err(NoDerivative::Reason(reason)) => return Err(reason),
            Err(NoDerivative::Inadmissible(left)) => return Err(left.to_string()),
        };
        if self.doubt > NOT_SMOOTH {
            return Err("what it changes is not smooth in it".into());
        }
        let measure = self.measure();
        Ok((derivative, self.bend * self.bend / measure + self.noise + self.doubt * measure))
    }

    /// ∂r/∂p of what a model says of a state; `row` fills it.
    pub fn row(
        &mut self,
        state: &State,
        mut row: impl FnMut(&Model, &mut Workspace, &State, &mut Vec<f64>) -> Result<(), Inadmissible>,
    ) -> Result<Vec<f64>, NoDerivative> {
        if let Some(known) = &self.known {
            let (workspace, mut rows) = (&mut self.workspace, [Vec::new(), Vec::new()]);
            let mut scenes = [self.levels.base(), known.scene()].into_iter().zip(&mut rows);
            // A neighbour that does not know the state tells nothing; nearer ones may.
            let are_known = scenes.all(|(scene, out)| row(&scene.built().model, workspace, state, out).is_ok());
            if are_known && rows[0] == rows[1] {
                return Ok(vec![0.0; rows[0].len()]);
            }
        }
        self.differentiate(&[], |scene, workspace, out| Ok(row(&scene.built().model, workspace, state, out)?))
    }

    /// The derivative of a list of numbers, with a step at which it is smooth.
    ///
    /// Where a smaller step agrees no better with itself, it is rounding that speaks: the larger one is kept, and what
    /// is left of doubt is noted.
    fn differentiate(
        &mut self,
        scales: &[f64],
        mut evaluate: impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), NoDerivative>,
    ) -> Result<Vec<f64>, NoDerivative> {
        self.levels.prepare().map_err(NoDerivative::Reason)?;
        let mut coarse: Option<Difference> = None;
        loop {
            let found = self.evaluate(scales, &mut evaluate);
            let fault = match found {
                Ok(found) => {
                    self.largest = self.largest.max(found.largest);
                    if let Some(coarse) = coarse.take_if(|coarse| found.bend > 0.5 * coarse.bend) {
                        self.levels.coarser();
                        return Ok(self.settle_for(coarse, scales, &mut evaluate));
                    }
                    if found.bend <= BEND * self.measure() {
                        self.compare_sides(found.lean, scales, &mut evaluate);
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
                    (None, Some(left)) => Err(left),
                    (None, None) => Err(NoDerivative::Reason(reason)),
                };
            }
        }
    }

    /// Slopes that differ on both sides however small the step is have no derivative between them; central differences
    /// do not see that.
    fn compare_sides(
        &mut self,
        lean: f64,
        scales: &[f64],
        evaluate: &mut impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), NoDerivative>,
    ) {
        if self.comparisons == 0 || lean <= LEAN * self.measure() || self.finer().is_err() {
            return;
        }
        self.comparisons -= 1;
        if let Ok(finer) = self.evaluate(scales, evaluate)
            && finer.lean > 0.5 * lean
        {
            self.doubt = self.doubt.max(finer.lean / self.measure());
        }
        self.levels.coarser();
    }

    /// The largest derivative so far, or what counts as none.
    fn measure(&self) -> f64 {
        self.largest.max(NOTHING / self.scale())
    }

    /// Makes the best of a derivative that no smaller step improves.
    ///
    /// The equations may jump by themselves: boundary elements choose their quadrature by the form. Over longer steps
    /// that weighs less.
    fn settle_for(
        &mut self,
        mut found: Difference,
        scales: &[f64],
        evaluate: &mut impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), NoDerivative>,
    ) -> Vec<f64> {
        while found.bend > ROUGH * self.measure() && self.levels.coarser() {
            match self.evaluate(scales, evaluate) {
                Ok(coarser) if coarser.bend < 0.5 * found.bend => found = coarser,
                _ => {
                    // It has been there before.
                    self.levels.finer().ok();
                    break;
                }
            }
        }
        self.doubt = self.doubt.max(found.bend / self.measure());
        found.derivative
    }

    /// The derivative at the present step.
    fn evaluate(
        &mut self,
        scales: &[f64],
        evaluate: &mut impl FnMut(&Scene, &mut Workspace, &mut Vec<f64>) -> Result<(), NoDerivative>,
    ) -> Result<Difference, NoDerivative> {
        let level = self.levels.current();
        self.values.resize_with(level.scenes.len(), Vec::new);
        for (scene, values) in level.scenes.iter().zip(&mut self.values) {
            values.clear();
            evaluate(scene, &mut self.workspace, values)?;
        }
        let found = Difference::of(level.step, level.stencil, &self.values, scales);
        (self.noise, self.bend) = (found.noise, found.bend);
        Ok(found)
    }

    /// What rounding may add to the last derivative, in the scales.
    pub fn noise(&self) -> f64 {
        if self.starts_only { 0.0 } else { self.noise }
    }

    /// h.
    pub fn step(&self) -> f64 {
        self.levels.current().step
    }

    /// Takes a smaller step from now on.
    ///
    /// # Errors
    /// If there is none.
    pub fn finer(&mut self) -> Result<(), String> {
        self.levels.finer()
    }

    /// Never takes a larger step than it has now.
    pub fn keep_step(&mut self) {
        self.levels.keep_step();
    }

    /// The part of its largest derivative in which two estimates differed, where that was not rounding.
    pub fn doubt(&self) -> f64 {
        self.doubt
    }

    /// A list of times [s] that each neighbour has, differentiated: the kinks of its signals.
    pub fn times(&mut self, mut times: impl FnMut(&Model) -> Vec<f64>) -> Result<Vec<f64>, NoDerivative> {
        self.differentiate(&[], |scene, _, out| {
            out.extend(times(&scene.built().model));
            Ok(())
        })
    }

    /// ∂h/∂p of the switching functions of a model's formulas; none where they do not know the number.
    pub fn switching(&mut self, time: f64, state: Numbers) -> Result<Option<Vec<f64>>, NoDerivative> {
        if self.starts_only || self.known.is_some() {
            return Ok(None);
        }
        let found = self.differentiate(&[], |scene, workspace, out| {
            out.extend(workspace.switching(&scene.built().model, time, state)?);
            Ok(())
        })?;
        Ok(Some(found).filter(|found| found.iter().any(|slope| *slope != 0.0)))
    }
}
