//! What the fluid between inclusions, and between one and a support, would do: nothing of it is computed.
//!
//! Each inclusion moves as if it were alone in the fluid, unless it says that it feels its neighbours. For two equal
//! rigid spheres and for one above a plane it is known how much that leaves out (`neighbor`), and so about for one that
//! deforms; of other bodies, R being half the largest diameter, the first term tells its size: 1 + 3R/2r of the speed
//! at a distance r of the centres, 1/(1 − 9R/8h) of the drag at a height h above a plane, nearer than 1.2 R no less
//! than there. Of two of different sizes the larger takes the smaller along with 3R/2r of its own speed.

use super::neighbor::{pair_speed_ratio, plane_drag_ratio};
use super::rows::each_row;
use crate::format::significant;
use gyration::body::BodyKind;
use gyration::model::Model;
use gyration::neighbours::{Sphere, each_overlap};
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_record::{RecordError, Recording};
use std::ops::ControlFlow;

/// Within so many radii a neighbour is told: beyond, it changes less than a seventh.
const NEAR: f64 = 10.0;
/// The height, in radii, below which the first term of a plane tells nothing.
const LEAST_HEIGHT: f64 = 1.2;

/// Pairs of neighbours at a time that are looked at.
const MOST_COMPARED: usize = 1_000_000;

/// A neighbour in the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Near {
    time: f64,
    body: usize,
    /// A body or a support.
    other: usize,
    /// Between the centres, or from the centre to the plane [m].
    distance: f64,
    /// How many times the speed, or the drag, of one alone.
    ratio: f64,
    /// How well that is known.
    known: Known,
}

/// How well a ratio is known.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Known {
    Well,
    /// By the first term, or by the sphere that it nearly is.
    About,
    /// It is greater: the first term means nothing there.
    AtLeast,
}

impl Known {
    /// The words before the ratio.
    fn words(self) -> &'static str {
        match self {
            Self::Well => "",
            Self::About => "about ",
            Self::AtLeast => "more than ",
        }
    }
}

/// What is left out of the fluid: of all neighbours the ones that matter most.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct LeftOut {
    pair: Option<Near>,
    plane: Option<Near>,
    /// How many pairs of inclusions were near each other at a time.
    pairs: usize,
    /// How many inclusions were near a support at a time.
    planes: usize,
}

impl LeftOut {
    /// What is left out in a state.
    pub(crate) fn at(model: &Model, state: &State) -> Self {
        let position = |body: usize| state.motion_in_space(model, body).placement.position;
        let positions: Vec<Vec3> = (0..model.bodies.len()).map(position).collect();
        let mut left_out = Self::default();
        left_out.note(model, state.time, &positions);
        left_out
    }

    /// What is left out at the rows of a recording of the model; of very many, at some of them.
    ///
    /// # Errors
    /// Those of reading.
    pub(crate) fn in_rows(model: &Model, recording: &Recording) -> Result<Self, RecordError> {
        let mut left_out = Self::default();
        each_row(recording, ("position", 3 * model.bodies.len()), |time, places| {
            let positions: Vec<Vec3> = places.chunks_exact(3).map(Vec3::from_column_slice).collect();
            left_out.note(model, time, &positions);
        })?;
        Ok(left_out)
    }

    /// Whether a model may leave anything out.
    pub(crate) fn may_be(model: &Model) -> bool {
        let immersed = || (0..model.bodies.len()).filter(|body| model.bodies[*body].inclusion.is_some());
        let has_support = |body: usize| model.contacts_of(body).next().is_some();
        model.fluid.is_some() && (immersed().nth(1).is_some() || immersed().any(has_support))
    }

    /// Notes the bodies at a time, each with its centre.
    pub(crate) fn note(&mut self, model: &Model, time: f64, positions: &[Vec3]) {
        if model.fluid.is_none() {
            return;
        }
        let inclusions = model.bodies.iter().zip(positions).enumerate();
        let inclusions =
            inclusions.filter(|(_, (body, place))| body.inclusion.is_some() && place.iter().all(|c| c.is_finite()));
        let radius = |body: usize| 0.5 * model.bodies[body].size;
        let inclusions: Vec<(usize, &Vec3)> = inclusions.map(|(body, (_, center))| (body, center)).collect();
        let (mut pairs, mut planes) = (0, 0);
        for (body, center) in &inclusions {
            let mut supports: Vec<usize> = model.contacts_of(*body).map(|it| it.support).collect();
            if model.bodies[*body].inclusion.as_ref().is_some_and(|it| it.walls.is_some()) {
                supports.clear();
            }
            supports.sort_unstable();
            supports.dedup();
            for support in supports {
                let height = model.supports[support].gap(center, time);
                if height < NEAR * radius(*body) {
                    planes += 1;
                    largest(&mut self.plane, above(model, *body, (support, height), time));
                }
            }
        }
        let sphere = |(body, center): &(usize, &Vec3)| Sphere::new(**center, 0.5 * NEAR * radius(*body));
        let spheres: Vec<Sphere> = inclusions.iter().map(sphere).collect();
        let _ = each_overlap(&spheres, |places| {
            let [(one, here), (other, there)] = places.map(|place| inclusions[place]);
            // Of these the run has what the fluid between them does.
            if [one, other].iter().all(|body| is_felt(model, *body)) {
                return ControlFlow::Continue(());
            }
            pairs += 1;
            largest(&mut self.pair, beside(model, [one, other], (here - there).norm(), time));
            if pairs < MOST_COMPARED { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        self.pairs = self.pairs.max(pairs);
        self.planes = self.planes.max(planes);
    }

    /// What must be told of it.
    pub(crate) fn warnings(&self, model: &Model) -> Vec<String> {
        let mut told = Vec::new();
        let when = |near: &Near| match near.time > 0.0 {
            true => format!(" at t = {} s", significant(near.time, 5)),
            false => " at the start".to_owned(),
        };
        let name = |body: usize| model.name(body);
        if let Some(near) = &self.pair {
            let (distance, ratio) = (significant(near.distance, 4), significant(near.ratio, 3));
            let more = match self.pairs {
                0 | 1 => String::new(),
                pairs => format!("; so of {pairs} pairs of inclusions within {NEAR} radii"),
            };
            let [size, other] = [near.body, near.other].map(|body| model.bodies[body].size);
            let what = match near.known {
                Known::About if are_unequal([size, other]) => format!(
                    "where \"{}\" moves along their line, it would take \"{}\" along with about {} times its own speed",
                    name(if size > other { near.body } else { near.other }),
                    name(if size > other { near.other } else { near.body }),
                    significant(near.ratio - 1.0, 2)
                ),
                known => format!("they would move along their line {}{ratio} times as fast", known.words()),
            };
            told.push(format!(
                "the fluid between \"{}\" and \"{}\" is left out: {distance} m apart{}, {what}{more}",
                name(near.body),
                name(near.other),
                when(near),
            ));
        }
        if let Some(near) = &self.plane {
            let (height, ratio) = (significant(near.distance, 4), significant(near.ratio, 3));
            let more = match self.planes {
                0 | 1 => String::new(),
                planes => format!("; so of {planes} inclusions within {NEAR} radii of a support"),
            };
            told.push(format!(
                "the fluid between \"{}\" and the support \"{}\" is left out: with the centre {height} m above it{}, \
                 the drag towards it would be {}{ratio} times as large{more}",
                name(near.body),
                model.supports[near.other].name,
                when(near),
                near.known.words()
            ));
        }
        told
    }
}

/// Whether a body feels its neighbours.
fn is_felt(model: &Model, body: usize) -> bool {
    model.spheres().is_some_and(|spheres| spheres.place(body).is_some())
}

/// Whether two sizes differ by more than rounding.
fn are_unequal([one, other]: [f64; 2]) -> bool {
    (one - other).abs() > 1e-9 * one.max(other)
}

/// Keeps the neighbour that matters more, of those that matter alike the nearest, and of those the first.
fn largest(kept: &mut Option<Near>, near: Near) {
    if kept.is_none_or(|kept| (near.ratio, -near.distance) > (kept.ratio, -kept.distance)) {
        *kept = Some(near);
    }
}

/// Whether a body has the shape of a sphere in its reference placement.
fn is_ball(model: &Model, body: usize) -> bool {
    model.bodies[body].solid.surface.as_ref().is_some_and(|surface| surface.ball().is_some())
}

/// Whether a body keeps its shape.
fn is_rigid(model: &Model, body: usize) -> bool {
    matches!(model.bodies[body].kind, BodyKind::Rigid(_))
}

/// Two inclusions beside each other.
fn beside(model: &Model, bodies: [usize; 2], distance: f64, time: f64) -> Near {
    let radii = bodies.map(|body| 0.5 * model.bodies[body].size);
    let radius = radii[0].max(radii[1]);
    let are_equal = !are_unequal(radii) && bodies.iter().all(|body| is_ball(model, *body));
    // Nearer than in touch the first term means nothing more.
    let (ratio, known) = match are_equal && distance > 2.0 * radius {
        false => (1.0 + 1.5 * radius / distance.max(radii[0] + radii[1]), Known::About),
        true if bodies.iter().all(|body| is_rigid(model, *body)) => (pair_speed_ratio(distance / radius), Known::Well),
        true => (pair_speed_ratio(distance / radius), Known::About),
    };
    Near { time, body: bodies[0], other: bodies[1], distance, ratio, known }
}

/// An inclusion above a support.
fn above(model: &Model, body: usize, (support, height): (usize, f64), time: f64) -> Near {
    let radius = 0.5 * model.bodies[body].size;
    let first_term = |height: f64| 1.0 / (1.0 - 9.0 / (8.0 * height / radius));
    let (ratio, known) = match is_ball(model, body) && height > radius {
        true if is_rigid(model, body) => (plane_drag_ratio(height / radius), Known::Well),
        true => (plane_drag_ratio(height / radius), Known::About),
        false if height > LEAST_HEIGHT * radius => (first_term(height), Known::About),
        false => (first_term(LEAST_HEIGHT * radius), Known::AtLeast),
    };
    Near { time, body, other: support, distance: height, ratio, known }
}
