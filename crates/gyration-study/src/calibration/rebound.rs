//! A body that is dropped, and how high it comes again.

use super::scene::{body, normal};
use super::{Calibration, Experiment, FreeNumber};
use gyration::dynamics::gap_to_supports;
use gyration::tensor::Vec3;
use gyration_scene::{Override, Scene};
use gyration_sim::events::{APEX, Event};
use gyration_sim::sensitivity::Sensitivities;
use gyration_sim::{Monitor, Progress, Reason};

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

/// A body about to be dropped.
pub(super) struct Drop {
    scene: Scene,
    index: usize,
    normal: Vec3,
    height: f64,
    start: Vec3,
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
        Ok(Self { scene, index, normal, height, start })
    }

    pub fn rebound(&self) -> Result<f64, String> {
        Ok(self.at_apex(&[])?.0)
    }

    /// The rebound with its derivatives by keys; those at a fixed time, since the speed vanishes at the apex.
    fn at_apex(&self, keys: &[String]) -> Result<(f64, Vec<Option<f64>>), String> {
        let name = self.scene.built().model.name(self.index);
        let columns = ["x", "y", "z"].map(|axis| format!("{name}.{axis}"));
        let (mut touched, mut limit) = (false, StepLimit::default());
        // Behind the first touch, which is a closest approach.
        let is_apex = |event: &Event| {
            let is_own = event.body == self.index;
            touched |= is_own && event.kind != APEX;
            is_own && event.kind == APEX && touched
        };
        let found = Sensitivities::at_event(&self.scene, keys, &columns, SLOPE_ERROR, is_apex, &mut limit);
        let found = found.map_err(|error| error.to_string())?;
        let Some(center) = found.values.last() else {
            return Err(match limit.is_reached {
                true => format!("its run takes more than {MOST_STEPS} steps"),
                false => format!("it does not rebound: {}", found.outcome.in_words()),
            });
        };
        // The gap with which the body started, and the rise of its centre of mass since.
        let rise = (Vec3::from_column_slice(center) - self.start).dot(&self.normal);
        let slope = |row: &[f64]| Vec3::from_column_slice(row).dot(&self.normal);
        let slopes = found.derivatives.iter().map(|by_key| by_key.at_end().ok().map(slope)).collect();
        Ok((self.height + rise, slopes))
    }

    /// The rebound, and its derivatives by those numbers that have one along the run: none if a number belongs to more
    /// than the contacts, to where the body starts perhaps, or if the body does not rebound straight up, so that its
    /// speed along the normal does not vanish at the apex.
    pub fn predicted(&self, calibration: &Calibration) -> Result<(f64, Vec<Option<f64>>), String> {
        let gravity = self.scene.built().model.gravity;
        let is_level = -gravity.dot(&self.normal) > (1.0 - LEVEL) * gravity.norm();
        let of_contact = |number: &FreeNumber| is_level && number.keys.iter().all(|key| key.starts_with("contact."));
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
