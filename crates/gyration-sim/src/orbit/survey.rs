//! A periodic orbit of a scene, in a form to print.

use super::{CellShift, Choice, NoOrbit, Orbit, OrbitSearch, energy};
use crate::outcome::Stop;
use crate::plan::RunPlan;
use crate::sensitivity::Quantities;
use gyration::Inadmissible;
use gyration::kinematics::Placement;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Mat3;
use gyration_scene::Scene;
use serde::Serialize;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// What chooses the orbit of a scene, besides its start.
#[derive(Debug, Clone, PartialEq)]
pub enum OrbitChoice {
    /// The period \[s\].
    Period(f64),
    /// The energy \[J\], with a period to begin with.
    Energy(f64, Option<f64>),
    /// A number of the start, as `body.a.x`, and its value, with a period to begin with.
    Amplitude(String, f64, Option<f64>),
    /// The start alone: the orbit of its energy, and where energy is not kept the one nearest to it.
    Nearest,
}

/// A periodic orbit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitSurvey {
    /// T \[s\].
    pub period: f64,
    /// E \[J\].
    pub energy: f64,
    /// Where each body is at t = 0, and how it moves.
    pub start: BTreeMap<String, OrbitStart>,
    /// μ, the largest first: real and imaginary part.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether none but those of phase and symmetries is larger than one.
    pub stable: bool,
    /// What is left after a period, as a part of how far the motion goes.
    pub misfit: f64,
    /// By how many cells along each direction it has moved on after a period, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift: Option<[i32; 3]>,
}

/// Where a body is and how it moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitStart {
    /// p₀ \[m\].
    pub position: [f64; 3],
    /// P.
    pub gradient: [[f64; 3]; 3],
    /// ṗ₀ \[m/s\].
    pub velocity: [f64; 3],
    /// Ṗ \[1/s\].
    pub gradient_rate: [[f64; 3]; 3],
    /// G of a body that contracts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contraction: Option<[[f64; 3]; 3]>,
}

impl OrbitSurvey {
    /// Of a scene; `shift` tells by how many cells along each direction of its ring it has moved on after a period.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of(scene: &Scene, choice: &OrbitChoice, shift: Option<[i32; 3]>) -> Result<Self, String> {
        let built = scene.built();
        let (model, plan) = (&built.model, RunPlan::from(built));
        let moved = shift.map(|by| CellShift::of(built, by)).transpose().map_err(|error| error.to_string())?;
        let search = OrbitSearch { model, plan: &plan, shift: moved };
        let told = |error: NoOrbit| in_words(model, &error);
        let outside = |error: Inadmissible| told(error.into());
        let guess = |period: Option<f64>| match period {
            Some(period) => Ok((built.state.clone(), vec![period], false)),
            None => Orbit::returning(&search, &built.state).map_err(told),
        };
        let near = |start: &State, periods: &[f64], choice: &Choice<'_>| {
            Orbit::near_one(&search, start, periods, choice).map_err(told)
        };
        let found = match choice {
            OrbitChoice::Period(period) => near(&built.state, &[*period], &Choice::Period)?,
            OrbitChoice::Energy(energy, period) => {
                let (start, periods, _) = guess(*period)?;
                near(&start, &periods, &Choice::Energy(*energy))?
            }
            OrbitChoice::Nearest => match guess(None)? {
                (start, periods, true) => {
                    let energy = energy(model, &start).map_err(outside)?;
                    near(&start, &periods, &Choice::Energy(energy))?
                }
                (start, periods, false) => near(&start, &periods, &Choice::Alone)?,
            },
            OrbitChoice::Amplitude(key, value, period) => {
                let column = key.strip_prefix("body.").unwrap_or(key).to_owned();
                let quantity = Quantities::find(model, &[column]).map_err(|error| error.to_string())?;
                let quantity = RefCell::new(quantity);
                let of_state = |state: &State| Ok(quantity.borrow_mut().at(model, state)?[0]);
                let (start, periods, _) = guess(*period)?;
                near(&start, &periods, &Choice::Quantity(&of_state, *value))?
            }
        };
        let start = |index: usize| {
            let motion = found.start.motion_in_space(model, index);
            let Placement { position, gradient } = motion.placement;
            let start = OrbitStart {
                position: position.into(),
                gradient: rows(&gradient),
                velocity: motion.velocity.velocity.into(),
                gradient_rate: rows(&motion.velocity.gradient_rate),
                contraction: found.start.contraction(model, index).as_ref().map(rows),
            };
            (model.name(index).to_owned(), start)
        };
        Ok(Self {
            period: found.period,
            energy: energy(model, &found.start).map_err(outside)?,
            start: (0..model.bodies.len()).map(start).collect(),
            multipliers: found.multipliers.iter().map(|mu| [mu.re, mu.im]).collect(),
            stable: found.stable,
            misfit: found.misfit,
            shift,
        })
    }
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    matrix.transpose().into()
}

fn in_words(model: &Model, error: &NoOrbit) -> String {
    match error {
        NoOrbit::Outside(left) => {
            let what = Stop::by_inadmissible(model, 0.0, left).what;
            format!("a start that was tried is outside the model: {what}")
        }
        other => other.to_string(),
    }
}
