//! Spheres whose motion the fluid remembers, stretched beyond the theory of that memory.
//!
//! Added mass and memory are those of the reference sphere; of an ellipsoid with the principal stretches λ_i they
//! differ by about the part max |ln λ_i| of themselves.

use super::rows::each_row;
use crate::format::significant;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Mat3;
use gyration_record::{RecordError, Recording};

/// max |ln λ_i| from which on it is told.
const LARGE: f64 = 0.1;

/// The sphere that was stretched most.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Stretched {
    most: Option<MostStretched>,
    /// How many others were stretched too far at a time.
    others: usize,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct MostStretched {
    time: f64,
    body: usize,
    /// The λ_i whose logarithm is largest.
    stretch: f64,
}

/// Whether the fluid remembers how a body deforms.
fn is_remembered(model: &Model, body: usize) -> bool {
    model.bodies[body].history().is_some() && model.bodies[body].affine().is_some()
}

impl Stretched {
    /// Of a model in a state.
    pub(crate) fn at(model: &Model, state: &State) -> Self {
        let mut stretched = Self::default();
        let gradient = |body: usize| state.motion_in_space(model, body).placement.gradient;
        stretched.note(model, state.time, gradient);
        stretched
    }

    /// Whether a model has such spheres.
    pub(crate) fn may_be(model: &Model) -> bool {
        (0..model.bodies.len()).any(|body| is_remembered(model, body))
    }

    /// Of the rows of a recording of the model; of very many, of some of them.
    ///
    /// # Errors
    /// Those of reading.
    pub(crate) fn in_rows(model: &Model, recording: &Recording) -> Result<Self, RecordError> {
        let mut stretched = Self::default();
        each_row(recording, ("placement_gradient", 9 * model.bodies.len()), |time, gradients| {
            // Row by row in a recording: the stretches of Pᵀ are those of P.
            stretched.note(model, time, |body| Mat3::from_column_slice(&gradients[9 * body..9 * body + 9]));
        })?;
        Ok(stretched)
    }

    fn note(&mut self, model: &Model, time: f64, gradient: impl Fn(usize) -> Mat3) {
        let mut count = 0;
        for body in (0..model.bodies.len()).filter(|body| is_remembered(model, *body)) {
            let stretch = farthest(&gradient(body));
            let size = |stretch: f64| libm::log(stretch).abs();
            if size(stretch) <= LARGE {
                continue;
            }
            count += 1;
            if self.most.is_none_or(|most| size(stretch) > size(most.stretch)) {
                self.most = Some(MostStretched { time, body, stretch });
            }
        }
        self.others = self.others.max(count.max(1) - 1);
    }

    /// What must be told of it.
    pub(crate) fn warning(&self, model: &Model) -> Option<String> {
        let MostStretched { time, body, stretch } = self.most?;
        let when = match time > 0.0 {
            true => format!("at t = {} s", significant(time, 5)),
            false => "at the start".to_owned(),
        };
        let more = match self.others {
            0 => String::new(),
            1 => " (and another one less)".to_owned(),
            others => format!(" (and {others} others less)"),
        };
        Some(format!(
            "the fluid remembers \"{}\" as a sphere, and it is stretched by {} {when}{more}: added mass and history \
             force are off by about {} % of themselves, what the fluid does without its inertia is not",
            model.name(body),
            significant(stretch, 3),
            significant(100.0 * libm::log(stretch).abs(), 2),
        ))
    }
}

/// The principal stretch of P farthest from one.
fn farthest(gradient: &Mat3) -> f64 {
    let squares = (gradient * gradient.transpose()).symmetric_eigenvalues();
    let logarithms = squares.map(|square| 0.5 * libm::log(square));
    let farthest = logarithms.iter().fold(0.0_f64, |most, next| if next.abs() > most.abs() { *next } else { most });
    libm::exp(farthest)
}
