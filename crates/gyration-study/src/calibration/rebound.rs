//! A body that is dropped, and how high it comes again.

use super::scene::{body, normal};
use super::{Calibration, Experiment, FreeNumber};
use gyration::body::BodyKind;
use gyration::dynamics::gap_to_supports;
use gyration::model::Model;
use gyration::tensor::Vec3;
use gyration_scene::{Override, Scene};
use gyration_sim::events::{APEX, Event};
use gyration_sim::sensitivity::Sensitivities;
use gyration_sim::{Monitor, Outcome, Progress, Reason};

/// A support is level where its normal and the vertical differ by less than the root of twice this: what a speed along
/// it would change is then of the order of rounding.
const LEVEL: f64 = 1e-14;
/// A rebound is looked for over so many times the time of the fall, and this long [s].
const FALLS: f64 = 4.0;
const LONGER: f64 = 1.0;
/// Steps to the apex at most; a drop takes some hundreds. A search may come to numbers with which it takes millions.
const MOST_STEPS: u64 = 20_000;

/// The error of a step in the derivatives of a run, a part of the largest: a search that goes by them ends some 1e-6 of
/// what it leaves off, and standard errors are not known to more than three digits.
const SLOPE_ERROR: f64 = 1e-6;

/// The columns of the lowest point and of Ṗ.
const GAP: &str = "gap";
const GRADIENT_RATE: [&str; 9] =
    ["Pdot_xx", "Pdot_xy", "Pdot_xz", "Pdot_yx", "Pdot_yy", "Pdot_yz", "Pdot_zx", "Pdot_zy", "Pdot_zz"];

/// A body about to be dropped.
pub(super) struct Drop {
    scene: Scene,
    index: usize,
    normal: Vec3,
}

/// A run to this time \[s\], sampled there only.
fn until(time: f64) -> Override {
    Override::new("time", format!("{{ end = {time:?}, sample = {time:?} }}").as_str())
}

impl Drop {
    pub fn of(calibration: &Calibration, experiment: &Experiment, height: f64, values: &[f64]) -> Result<Self, String> {
        let still = Override::new(format!("body.{}.velocity", experiment.body), [0.0; 3]);
        let first = calibration.scene(experiment, height, values, std::slice::from_ref(&still))?;
        let (model, state) = (&first.built().model, &first.built().state);
        let index = body(model, experiment)?;
        let normal = normal(model, index)?;
        check_fall(model, index, &normal)?;
        let motion = state.motion(model, index);
        if motion.velocity.gradient_rate.norm() > 0.0 {
            let key = format!("body.{}.angular_velocity", experiment.body);
            return Err(format!(
                "it turns or deforms at its start, and is to be released at rest: set = {{ \"{key}\" = [0, 0, 0] }}"
            ));
        }
        let gap = gap_to_supports(model, 0.0, index, &motion);
        let start = motion.placement.position + normal * (height - gap);
        let fall = (2.0 * height / model.gravity.norm()).sqrt();
        let end = FALLS * fall + LONGER;
        let more =
            [still, Override::new(format!("body.{}.position", experiment.body), <[f64; 3]>::from(start)), until(end)];
        let scene = calibration.scene(experiment, height, values, &more)?;
        Ok(Self { scene, index, normal })
    }

    pub fn rebound(&self) -> Result<f64, String> {
        Ok(self.at_apex(&[])?.0)
    }

    /// The gap at the apex with its derivatives by keys: those at a fixed time, which are those of the rebound where
    /// the gap does not change at the apex; none of a body that turns or deforms there.
    fn at_apex(&self, keys: &[String]) -> Result<(f64, Vec<Option<f64>>), String> {
        let model = &self.scene.built().model;
        let name = model.name(self.index);
        let columns: Vec<String> =
            [GAP].iter().chain(&GRADIENT_RATE).map(|column| format!("{name}.{column}")).collect();
        let (mut touched, mut limit) = (false, StepLimit::default());
        // Behind the first touch, which is a closest approach.
        let is_apex = |event: &Event| {
            let is_own = event.body == self.index;
            touched |= is_own && event.kind != APEX;
            is_own && event.kind == APEX && touched
        };
        let found = Sensitivities::at_event(&self.scene, keys, &columns, SLOPE_ERROR, is_apex, &mut limit);
        let found = found.map_err(|error| error.to_string())?;
        let Some([gap, rates @ ..]) = found.values.last().map(Vec::as_slice) else {
            return Err(match limit.is_reached {
                true => format!("its run takes more than {MOST_STEPS} steps"),
                false => self.why_none(&found.outcome),
            });
        };
        // A lift-off faster by dv has its apex higher by v dv/g and later by dv/g: a derivative at a fixed time is off
        // by the rate of the gap over v, as a part of it.
        let turning = rates.iter().map(|rate| rate * rate).sum::<f64>().sqrt() * model.bodies[self.index].size;
        let is_stationary = turning <= SLOPE_ERROR * (2.0 * model.gravity.norm() * gap).sqrt();
        let slope = |row: &[f64]| row.first().copied().filter(|_| is_stationary);
        let slopes = found.derivatives.iter().map(|by_key| by_key.at_end().ok().and_then(slope)).collect();
        Ok((*gap, slopes))
    }

    /// Why a run had no apex.
    fn why_none(&self, outcome: &Outcome) -> String {
        let built = self.scene.built();
        let held = match built.model.bodies[self.index].guide {
            Some(_) => ", or its `keep` holds it",
            None => "",
        };
        match outcome {
            Outcome::Completed => {
                format!("it does not rebound in {:.3} s: it stays at its support{held}", built.plan.end)
            }
            Outcome::AtRest { .. } | Outcome::Stopped(_) => format!("it does not rebound: {}", outcome.in_words()),
        }
    }

    /// Whether it is a rigid body that rises straight up from planes at rest: its gap changes at the apex only if it
    /// turns there.
    fn is_straight(&self) -> bool {
        let model = &self.scene.built().model;
        let is_level = -model.gravity.dot(&self.normal) > (1.0 - LEVEL) * model.gravity.norm();
        let mut contacts = model.contacts_of(self.index);
        is_level
            && matches!(model.bodies[self.index].kind, BodyKind::Rigid(_))
            && contacts.all(|contact| model.supports[contact.support].motion.is_fixed())
    }

    /// The rebound, and its derivatives by those numbers that have one along the run: none if a number belongs to more
    /// than the contacts, to where the body starts perhaps, or if the gap still changes at the apex: above a slope,
    /// above a plane that moves, and of a body that turns or deforms.
    pub fn predicted(&self, calibration: &Calibration) -> Result<(f64, Vec<Option<f64>>), String> {
        let is_straight = self.is_straight();
        let of_contact = |number: &FreeNumber| is_straight && number.keys.iter().all(|key| key.starts_with("contact."));
        let keys: Vec<String> = calibration
            .numbers
            .iter()
            .filter(|number| of_contact(number))
            .flat_map(|number| number.keys.clone())
            .collect();
        if keys.is_empty() {
            return Ok((self.rebound()?, vec![None; calibration.numbers.len()]));
        }
        let (value, by_key) = self.at_apex(&keys)?;
        let mut by_key = by_key.into_iter();
        let slope = |number: &FreeNumber| match of_contact(number) {
            true => {
                let own: Vec<Option<f64>> = by_key.by_ref().take(number.keys.len()).collect();
                own.into_iter().sum()
            }
            false => None,
        };
        Ok((value, calibration.numbers.iter().map(slope).collect()))
    }
}

/// Whether gravity takes a body to its support.
///
/// # Errors
/// Why it does not, in words.
fn check_fall(model: &Model, index: usize, normal: &Vec3) -> Result<(), String> {
    let body = &model.bodies[index];
    if body.pin.is_some() {
        return Err(format!("{:?} has a `pin`: a body that is dropped falls freely", model.name(index)));
    }
    if !body.has_inertia() {
        return Err(format!("{:?} has no inertia: it does not rebound", model.name(index)));
    }
    if model.gravity.norm() == 0.0 {
        return Err("the `world.gravity` of the scene is zero: nothing falls".to_owned());
    }
    let support = model.contacts_of(index).map(|contact| &model.supports[contact.support].name).next();
    match support.filter(|_| model.gravity.dot(normal) >= 0.0) {
        Some(support) => Err(format!("the `world.gravity` of the scene does not take it to its support `{support}`")),
        None => Ok(()),
    }
}

/// Ends a run that takes too many steps.
#[derive(Default)]
struct StepLimit {
    is_reached: bool,
}

impl Monitor for StepLimit {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        self.is_reached = progress.statistics.accepted() >= MOST_STEPS;
        self.is_reached.then_some(Reason::Interrupted)
    }
}
