//! Rest states and the small motions about them, in a form to print.

use crate::format::significant;
use crate::modes::{
    Mode, ModeBehaviour, ModeShape, PARTS, Rest, RestContraction, modes, rest, system_modes, system_rest,
};
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::ComplexField;
use serde::{Serialize, Serializer};
use std::f64::consts::TAU;

/// Where a body rests, and how it moves about that state.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestState {
    /// Where it rests.
    #[serde(flatten)]
    pub place: RestPlace,
    /// The small motions: unstable, free, creeping, oscillating ones, each by frequency.
    pub modes: Vec<ModeSurvey>,
}

/// Where bodies rest together, and how they move about that state.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SystemRestState {
    /// Where each of them rests.
    pub bodies: Named<RestPlace>,
    /// The small motions: free ones first, then by frequency.
    pub modes: Vec<ModeSurvey<Named<ShapeSurvey>>>,
}

/// Where a body rests.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestPlace {
    /// p₀ of the centre of mass [m].
    pub position: [f64; 3],
    /// P, row by row.
    pub gradient: [[f64; 3]; 3],
    /// Principal stretches, the largest first.
    pub stretches: [f64; 3],
    /// π [Pa] of an incompressible body.
    pub pressure: Option<f64>,
    /// Smallest distance to what acts on it by a contact [m].
    pub gap: Option<f64>,
    /// G, row by row, where the contraction stands still.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contraction: Option<[[f64; 3]; 3]>,
    /// What the small motions leave out, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
}

/// Something of each body, under its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T>(pub Vec<(String, T)>);

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// A small motion about rest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeSurvey<S = ShapeSurvey> {
    /// "oscillates", "creeps", "free" or "unstable".
    pub motion: &'static str,
    /// What moves how, in words.
    pub in_words: String,
    /// ω/2π [Hz]; 0 where it does not oscillate.
    pub frequency_hz: f64,
    /// ω [rad/s].
    pub frequency: f64,
    /// δ of the two eigenvalues −δ ± iω [1/s], the slower one first, or of the only one of a motion that the
    /// contraction adds; negative where the motion grows.
    pub decay_rates: Vec<f64>,
    /// ζ; none of free and unstable motions.
    pub damping_ratio: Option<f64>,
    /// How the body moves, or each body.
    pub shape: S,
    /// The part of the motion a quarter of a period ahead, if its points do not move in step.
    pub quadrature: Option<S>,
    /// Shares of the kinetic energy: translation, rotation, shear, stretch, breathing.
    pub participation: [f64; PARTS],
}

/// A shape: of the points at half the body's size from its centre the fastest moves by one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ShapeSurvey {
    /// δp₀.
    pub translation: [f64; 3],
    /// δP [1/m], row by row.
    pub gradient: [[f64; 3]; 3],
}

/// G of a rest state in which the contraction stands still.
fn stands(rest: &Rest) -> Option<[[f64; 3]; 3]> {
    match rest.contraction? {
        RestContraction::Stands(contraction) => Some(rows(&contraction)),
        RestContraction::GoesOn(_) => None,
    }
}

/// What the small motions of a body leave out: of one whose contraction does not come to rest, the law of that.
pub(super) fn left_out(rest: &Rest) -> Option<String> {
    match rest.contraction? {
        RestContraction::Stands(_) => None,
        RestContraction::GoesOn(speed) => Some(format!(
            "contraction held as it is at the start: let go, it moves, with {} 1/s here, and comes to no state near by \
             in which it would stand still; what its law does to decay and stability is not known",
            significant(speed, 3)
        )),
    }
}

/// Parts of an eigenvalue below this part of it are rounding.
const ROUNDING: f64 = 1e-10;

impl RestState {
    /// Of the body of this index.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of(model: &Model, start: &State, body: usize) -> Result<Self, String> {
        let rest = rest(model, start, body).map_err(|reason| reason.to_string())?;
        let found = modes(model, start, body, &rest).map_err(|reason| reason.to_string())?;
        let fastest = fastest(&found);
        let modes = found.iter().map(|mode| ModeSurvey::of(mode, fastest, |shapes| ShapeSurvey::of(&shapes[0])));
        Ok(Self { place: RestPlace::of(&rest, model.in_space(body, &rest.placement.position)), modes: modes.collect() })
    }
}

impl SystemRestState {
    /// Of bodies whose indices ascend.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn of(model: &Model, start: &State, members: &[usize]) -> Result<Self, String> {
        let rests = system_rest(model, start, members).map_err(|reason| reason.to_string())?;
        let found = system_modes(model, start, members, &rests).map_err(|reason| reason.to_string())?;
        let name = |index: usize| model.name(members[index]).to_owned();
        let shapes = |shapes: &[ModeShape]| {
            Named(shapes.iter().enumerate().map(|(body, shape)| (name(body), ShapeSurvey::of(shape))).collect())
        };
        let fastest = fastest(&found);
        let place = |body: usize, rest: &Rest| model.in_space(members[body], &rest.placement.position);
        let places = rests.iter().enumerate().map(|(body, rest)| (name(body), RestPlace::of(rest, place(body, rest))));
        let modes = found.iter().map(|mode| ModeSurvey::of(mode, fastest, shapes));
        Ok(Self { bodies: Named(places.collect()), modes: modes.collect() })
    }
}

impl RestPlace {
    /// At this place in space [m].
    pub(super) fn of(rest: &Rest, place: Vec3) -> Self {
        Self {
            position: place.into(),
            gradient: rows(&rest.placement.gradient),
            stretches: rest.stretches.into(),
            pressure: rest.pressure,
            contraction: stands(rest),
            left_out: left_out(rest),
            gap: rest.gap.is_finite().then_some(rest.gap),
        }
    }
}

impl<S> ModeSurvey<S> {
    /// `fastest` is the largest eigenvalue of all motions, from whose matrix all of them are computed.
    fn of(mode: &Mode, fastest: f64, shape: impl Fn(&[ModeShape]) -> S) -> Self {
        let rounding = match mode.motion {
            ModeBehaviour::Oscillates => {
                ROUNDING * mode.eigenvalues.iter().map(|value| value.modulus()).fold(0.0, f64::max)
            }
            _ => f64::EPSILON * fastest,
        };
        let clean = |rate: f64| if rate.abs() <= rounding { 0.0 } else { rate };
        let decay_rates = mode.decay_rates().into_iter().map(clean).collect();
        Self {
            motion: match mode.motion {
                ModeBehaviour::Oscillates => "oscillates",
                ModeBehaviour::Creeps => "creeps",
                ModeBehaviour::Free => "free",
                ModeBehaviour::Grows => "unstable",
            },
            in_words: mode.in_words.clone(),
            frequency_hz: mode.frequency() / TAU,
            frequency: mode.frequency(),
            decay_rates,
            damping_ratio: mode.damping_ratio().map(|ratio| if ratio <= ROUNDING { 0.0 } else { ratio }),
            shape: shape(&mode.shapes),
            quadrature: mode.quadratures.as_deref().map(shape),
            participation: mode.participation.total(),
        }
    }
}

impl ShapeSurvey {
    fn of(shape: &ModeShape) -> Self {
        Self { translation: shape.translation.into(), gradient: rows(&shape.gradient) }
    }
}

/// The largest eigenvalue of all motions.
fn fastest(modes: &[Mode]) -> f64 {
    modes.iter().flat_map(|mode| &mode.eigenvalues).map(|value| value.modulus()).fold(0.0, f64::max)
}

fn rows(matrix: &Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::Participation;
    use nalgebra::Complex;

    #[test]
    fn a_rate_below_the_rounding_of_the_fastest_one_is_no_rate() {
        let of = |motion, rates: [f64; 2]| Mode {
            eigenvalues: rates.map(|rate| Complex::new(-rate, 0.0)).to_vec(),
            motion,
            shapes: vec![ModeShape { translation: Vec3::x(), gradient: Mat3::zeros() }],
            quadratures: None,
            in_words: String::new(),
            participation: Participation { bodies: vec![[1.0, 0.0, 0.0, 0.0, 0.0]] },
        };
        let modes = [of(ModeBehaviour::Free, [5.7e-31, 0.0]), of(ModeBehaviour::Creeps, [1e-9, 40.0])];
        let told = modes
            .each_ref()
            .map(|mode| ModeSurvey::of(mode, fastest(&modes), |shapes| ShapeSurvey::of(&shapes[0])).decay_rates);
        assert_eq!(told, [vec![0.0, 0.0], vec![1e-9, 40.0]]);
    }
}
