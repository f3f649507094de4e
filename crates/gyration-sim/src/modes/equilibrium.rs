//! The way downhill to rest: Newton's method with |K| in place of K, in steps that stay inside the model.
//!
//!   (|sym K| + skw K) z = r,   r the forces along z
//!
//! With |sym K| every step does positive work, so that the body ends in a valley, not on a hill; near the end it is
//! Newton's step. Where K is smaller than r over the longest step allowed, the largest such quotient stands in its
//! place: a body far above its support comes down in growing steps, and directions without force that are free
//! (sliding, turning about the vertical) or unstable are left alone. A step is halved until gaps and det P keep a part
//! of their values, and the work over it by the trapezoidal rule is not negative.

use super::canonical::{self, Basis};
use super::coordinates::Coordinates;
use super::frozen::FrozenBody;
use super::shape::ModeShape;
use super::{NoRest, Rest};
use gyration::body::BodyKind;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
use nalgebra::{DMatrix, DVector};

/// Steps at most. A fall over a thousand sizes takes some forty, a box on its corner that finds a face a hundred.
const MOST: usize = 1000;
/// Evaluations of the forces and their derivatives at most: those of a body that deforms take up to 10 ms.
const MOST_EVALUATIONS: usize = 2000;
/// Halvings of a step at most.
const HALVINGS: usize = 60;
/// The most that a step may strain or turn the body.
const LARGEST_STRAIN: f64 = 0.3;
/// The part of a gap, and of det P, that a step must leave.
const LEAST_KEPT: f64 = 0.1;
/// Steps smaller than this part of gap and size are the last; then they are repeated for as long as they get smaller.
const SMALL: f64 = 1e-8;
/// Forces below this part of the largest stiffness over the gap are none: what is left in free directions.
const NO_FORCE: f64 = 1e-9;
/// The part of gravity along the supports that is rounding.
const LEVEL: f64 = 1e-12;
/// Sizes from the start, and stretch, beyond which a body has gone.
const AWAY: f64 = 1e6;
const FLAT: f64 = 1e4;

/// Finds the rest state.
pub(super) fn find(frozen: &mut FrozenBody) -> Result<Rest, NoRest> {
    frozen.accelerations(&frozen.start.clone())?;
    is_supported(frozen)?;
    let mut search = Search { block: frozen.start.clone(), reach: 0.5 * frozen.body().size, last: f64::INFINITY };
    for steps in 0..MOST {
        if frozen.evaluations() > MOST_EVALUATIONS || Interruption::due().is_some() {
            return Err(not_found(frozen, &search.block, steps)?);
        }
        let ended = search.step(frozen)?;
        gone(frozen, &search.block)?;
        if ended {
            return Ok(rest_at(frozen, search.block));
        }
    }
    Err(not_found(frozen, &search.block, MOST)?)
}

/// A search that has not ended, and the acceleration where it stands.
fn not_found(frozen: &mut FrozenBody, block: &[f64], steps: usize) -> Result<NoRest, NoRest> {
    let left = frozen.accelerations(block)?;
    let acceleration = left.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    Ok(NoRest::NotFound { steps, acceleration })
}

/// Refuses what gravity moves on for ever: the laws push along the normals of supports alone.
fn is_supported(frozen: &FrozenBody) -> Result<(), NoRest> {
    let body = frozen.body();
    if body.pin.is_some() || frozen.is_sprung() {
        return Ok(());
    }
    let normals = frozen.normals();
    let mut left = frozen.gravity();
    let mut spanned: Vec<Vec3> = Vec::new();
    for normal in &normals {
        let new = spanned.iter().fold(*normal, |new, unit| new - unit * unit.dot(&new));
        if let Some(unit) = new.try_normalize(1e-6) {
            left -= unit * unit.dot(&left);
            spanned.push(unit);
        }
    }
    match left.norm() {
        rounding if rounding <= LEVEL * frozen.gravity().norm() => Ok(()),
        _ if normals.is_empty() => Err(NoRest::Falls),
        acceleration => Err(NoRest::Slides { along: left / acceleration, acceleration }),
    }
}

/// Refuses a body that has gone to infinity.
fn gone(frozen: &FrozenBody, block: &[f64]) -> Result<(), NoRest> {
    let (now, start) = (frozen.motion(block).placement, frozen.motion(&frozen.start).placement);
    let distance = (now.position - start.position).norm();
    if distance > AWAY * frozen.body().size {
        return Err(NoRest::DrivenAway { distance });
    }
    let stretches = now.gradient.singular_values();
    let (least, most) = (stretches.min(), stretches.max());
    if most > FLAT || least * FLAT < 1.0 {
        return Err(NoRest::Deforms { stretch: if most * least > 1.0 { most } else { least } });
    }
    Ok(())
}

pub(super) fn rest_at(frozen: &mut FrozenBody, block: Vec<f64>) -> Rest {
    let placement = frozen.motion(&block).placement;
    let stretches = match frozen.body().kind {
        BodyKind::Rigid(_) => Vec3::repeat(1.0),
        BodyKind::Affine(_) | BodyKind::Contractile(_) => {
            let mut values: [f64; 3] = placement.gradient.singular_values().into();
            values.sort_by(|a, b| b.total_cmp(a));
            values.into()
        }
    };
    let gap = frozen.gaps(&block).into_iter().fold(f64::INFINITY, f64::min);
    Rest { placement, stretches, pressure: frozen.pressure(&block), gap, contraction: None, block }
}

/// The balance at a configuration.
struct Balance {
    coordinates: Coordinates,
    /// Forces along z.
    force: DVector<f64>,
    /// K.
    stiffness: DMatrix<f64>,
    gaps: Vec<f64>,
}

struct Search {
    block: Vec<f64>,
    /// The longest way of the centre in a step [m].
    reach: f64,
    /// The size of the step before.
    last: f64,
}

impl Search {
    /// Goes one step; true at the end.
    fn step(&mut self, frozen: &mut FrozenBody) -> Result<bool, NoRest> {
        let coordinates = Coordinates::at(frozen.body(), &self.block);
        let balance = Balance {
            force: coordinates.force(&frozen.accelerations(&self.block)?),
            stiffness: coordinates.stiffness(&frozen.slopes(&self.block)?),
            gaps: frozen.gaps(&self.block),
            coordinates,
        };
        let length = balance.gaps.iter().fold(frozen.body().size, |least, gap| least.min(*gap));
        let way = self.direction(frozen, &balance, length);
        let shape = balance.coordinates.shape(frozen.body(), &way);
        let inverse = self.inverse(frozen);
        let size = (shape.translation.norm() / length).max((shape.gradient * inverse).norm());
        // Newton squares a small step: where it does not even halve, rounding is reached.
        if size == 0.0 || (size < SMALL && size > 0.5 * self.last) {
            return Ok(true);
        }
        self.last = size;
        match self.take(frozen, &balance, &way) {
            Some(part) => self.reach *= if part == 1.0 { 2.0 } else { 0.5 },
            // No part of it is admissible or of use: at rounding.
            None if size < SMALL => return Ok(true),
            None => self.reach *= 0.25,
        }
        Ok(false)
    }

    fn inverse(&self, frozen: &FrozenBody) -> Mat3 {
        frozen.motion(&self.block).placement.gradient.try_inverse().unwrap_or_else(Mat3::identity)
    }

    /// The step before it is cut.
    fn direction(&self, frozen: &FrozenBody, balance: &Balance, length: f64) -> DVector<f64> {
        let Balance { coordinates, force, stiffness, .. } = balance;
        let Basis { vectors, values, zero } = canonical::eigen(stiffness);
        let along = vectors.transpose() * force;
        let inverse = self.inverse(frozen);
        let shapes: Vec<ModeShape> =
            vectors.column_iter().map(|vector| coordinates.shape(frozen.body(), &vector.into_owned())).collect();
        let strain = |shape: &ModeShape| (shape.gradient * inverse).norm();
        // The force that the stiffness gives over a length, or a strain, of one.
        let scale = shapes.iter().zip(&values).map(|(shape, value)| {
            value.abs() / (shape.translation.norm() / length).max(strain(shape)).max(f64::MIN_POSITIVE)
        });
        let scale = scale.fold(frozen.gravity().norm() * frozen.body().solid.mass.mass.sqrt(), f64::max);
        // Nor does rounding choose the side to which a body would fall.
        let free = |k: usize| values[k] <= zero && along[k].abs() <= NO_FORCE * scale;
        let per_step = |shape: &ModeShape| (shape.translation.norm() / self.reach).max(strain(shape) / LARGEST_STRAIN);
        // What has to be cut is cut alike, so that it goes the way of its force.
        let needed = shapes.iter().enumerate().map(|(k, shape)| along[k].abs() * per_step(shape));
        let cut = needed.enumerate().filter(|(k, least)| values[*k].abs() < *least && !free(*k));
        let least = cut.map(|(_, least)| least).fold(0.0, f64::max);
        let mut matrix = vectors.transpose() * (0.5 * (stiffness - stiffness.transpose())) * &vectors;
        let mut right = along.clone();
        for k in 0..shapes.len() {
            matrix[(k, k)] = values[k].abs().max(least);
            if free(k) {
                matrix.row_mut(k).fill(0.0);
                matrix.column_mut(k).fill(0.0);
                (matrix[(k, k)], right[k]) = (1.0, 0.0);
            }
        }
        let solved = matrix.lu().solve(&right).unwrap_or_else(|| DVector::zeros(right.len()));
        vectors * solved
    }

    /// Takes the largest part 1, ½, ¼ … of a step that is admissible and goes downhill; none if there is none.
    fn take(&mut self, frozen: &mut FrozenBody, balance: &Balance, way: &DVector<f64>) -> Option<f64> {
        let Balance { coordinates, force, gaps, .. } = balance;
        let volume = frozen.motion(&self.block).placement.gradient.determinant();
        let mut part = 1.0;
        for _ in (0..HALVINGS).take_while(|_| Interruption::due().is_none()) {
            let mut block = self.block.clone();
            coordinates.advance(&mut block, &(part * way));
            frozen.project(&mut block);
            let kept = frozen.motion(&block).placement.gradient.determinant() > LEAST_KEPT * volume
                && frozen.gaps(&block).iter().zip(gaps).all(|(new, old)| *new > LEAST_KEPT * old);
            if kept && let Ok(ahead) = frozen.accelerations(&block) {
                let (before, after) = (force.dot(way), coordinates.force(&ahead).dot(way));
                // Forces at rest are rounding; their work tells nothing.
                if before + after >= 0.0 || self.last < SMALL {
                    self.block = block;
                    return Some(part);
                }
            }
            part *= 0.5;
        }
        None
    }
}
