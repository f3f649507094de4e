//! The way downhill to rest: Newton's method with |K| in place of K, in steps that stay inside the model.
//!
//!   (|sym K| + skw K) z = r,   r the forces along z
//!
//! With |sym K| every step does positive work, so that the body ends in a valley, not on a hill; near the end it is
//! Newton's step. Where K is smaller than r over the longest step allowed, the largest such quotient stands in its
//! place: a body far above its support comes down in growing steps, and directions without force that are free
//! (sliding, turning about the vertical) or unstable are left alone. A step is halved until gaps and det P keep a part
//! of their values, no body has passed through another (`barriers`), the work over it by the trapezoidal rule is not
//! negative, and the force along it is at its end what K tells of it, but for a part: a step over a hill would find
//! another. Steps that come to nothing although forces are left have met an edge of the model, not a rest.

use super::barriers::{Barriers, LEAST_KEPT};
use super::canonical::{self, Basis};
use super::frozen::{BodyGaps, FrozenSystem};
use super::shape::ModeShape;
use super::system::SystemCoordinates;
use super::{NoRest, Rest};
use gyration::body::BodyKind;
use gyration::load::BondLaw;
use gyration::model::Model;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
use nalgebra::{DMatrix, DVector};

/// Steps at most. A fall over a thousand sizes takes some forty, a box on its corner that finds a face a hundred.
const MOST: usize = 1000;
/// Evaluations of the forces and their derivatives at most: those of a body that deforms take up to 10 ms.
const MOST_EVALUATIONS: usize = 4000;
/// Halvings of a step at most.
const HALVINGS: usize = 60;
/// The most that a step may strain or turn a body.
const LARGEST_STRAIN: f64 = 0.3;
/// Steps smaller than this part of gap and size are the last; then they are repeated for as long as they get smaller.
const SMALL: f64 = 1e-8;
/// Forces below this part of the largest stiffness over the gap are none: what is left in free directions.
const NO_FORCE: f64 = 1e-9;
/// The part of gravity along the supports that is rounding.
const LEVEL: f64 = 1e-12;
/// Sizes from the start, and stretch, beyond which a body has gone.
const AWAY: f64 = 1e6;
const FLAT: f64 = 1e4;

/// Finds the rest state: the numbers there.
pub(super) fn find(frozen: &mut FrozenSystem) -> Result<Vec<f64>, NoRest> {
    frozen.rates(&frozen.start.clone())?;
    is_supported(frozen)?;
    let reach = frozen.bodies().iter().map(|body| 0.5 * body.size).collect();
    let mut search = Search { numbers: frozen.start.clone(), reach, last: f64::INFINITY };
    for steps in 0..MOST {
        if frozen.evaluations() > MOST_EVALUATIONS || Interruption::due().is_some() {
            return Err(not_found(frozen, &search.numbers, steps)?);
        }
        let progress = search.step(frozen)?;
        gone(frozen, &search.numbers)?;
        match progress {
            Progress::GoesOn => {}
            Progress::Rests => return Ok(search.numbers),
            Progress::IsBlocked => {
                let acceleration = left(frozen, &search.numbers)?;
                return Err(NoRest::Blocked { steps, acceleration });
            }
        }
    }
    Err(not_found(frozen, &search.numbers, MOST)?)
}

/// A search that has not ended.
fn not_found(frozen: &mut FrozenSystem, numbers: &[f64], steps: usize) -> Result<NoRest, NoRest> {
    Ok(NoRest::NotFound { steps, acceleration: left(frozen, numbers)? })
}

/// The largest acceleration where the search stands.
fn left(frozen: &mut FrozenSystem, numbers: &[f64]) -> Result<f64, NoRest> {
    let rates = frozen.rates(numbers)?;
    let left = (0..frozen.count()).flat_map(|body| &rates[frozen.slots(body).velocities()]);
    Ok(left.fold(0.0, |most: f64, a| most.max(a.abs())))
}

/// Refuses what gravity moves on for ever: the laws push along the normals of supports alone.
fn is_supported(frozen: &FrozenSystem) -> Result<(), NoRest> {
    if frozen.is_anchored() {
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

/// Refuses bodies that have gone to infinity.
fn gone(frozen: &FrozenSystem, numbers: &[f64]) -> Result<(), NoRest> {
    for (index, body) in frozen.bodies().iter().enumerate() {
        let (now, start) = (frozen.motion(numbers, index).placement, frozen.motion(&frozen.start, index).placement);
        let distance = (now.position - start.position).norm();
        if distance > AWAY * body.size {
            return Err(NoRest::DrivenAway { distance });
        }
        let stretches = now.gradient.singular_values();
        let (least, most) = (stretches.min(), stretches.max());
        if most > FLAT || least * FLAT < 1.0 {
            return Err(NoRest::Deforms { stretch: if most * least > 1.0 { most } else { least } });
        }
    }
    Ok(())
}

/// What a rest state is of each body.
pub(super) fn rest_at(frozen: &mut FrozenSystem, numbers: &[f64]) -> Vec<Rest> {
    let gaps = frozen.gaps(numbers);
    let rest = |(body, gaps): (usize, BodyGaps)| {
        let placement = frozen.motion(numbers, body).placement;
        let stretches = match frozen.bodies()[body].kind {
            BodyKind::Rigid(_) => Vec3::repeat(1.0),
            BodyKind::Affine(_) | BodyKind::Contractile(_) => {
                let mut values: [f64; 3] = placement.gradient.singular_values().into();
                values.sort_by(|a, b| b.total_cmp(a));
                values.into()
            }
        };
        let gap = gaps.least();
        let pressure = frozen.pressure(numbers, body);
        let block = frozen.block(numbers, body);
        Rest { placement, stretches, pressure, gap, contraction: None, block }
    };
    gaps.into_iter().enumerate().map(rest).collect()
}

/// The balance at a configuration.
struct Balance {
    coordinates: SystemCoordinates,
    /// Forces along z.
    force: DVector<f64>,
    /// K.
    stiffness: DMatrix<f64>,
    /// The gaps of each body [m].
    gaps: Vec<BodyGaps>,
    /// What keeps them apart.
    barriers: Barriers,
    /// The lengths by which the ways of their centres are judged [m].
    lengths: Vec<f64>,
    /// P⁻¹ of each.
    inverses: Vec<Mat3>,
}

impl Balance {
    fn at(frozen: &mut FrozenSystem, numbers: &[f64]) -> Result<Self, NoRest> {
        let coordinates = SystemCoordinates::at(frozen, numbers)?;
        let gaps = frozen.gaps(numbers);
        let barriers = Barriers::at(frozen, numbers);
        let size = |body: usize| frozen.bodies()[body].size;
        let shortest = |(body, gaps): (usize, &BodyGaps)| gaps.least().min(size(body));
        let lengths: Vec<f64> = gaps.iter().enumerate().map(shortest).collect();
        Ok(Self {
            force: coordinates.force(&frozen.rates(numbers)?),
            stiffness: coordinates.stiffness(&frozen.slopes(numbers)?),
            barriers,
            lengths,
            inverses: (0..frozen.count()).map(|body| frozen.inverse(numbers, body)).collect(),
            gaps,
            coordinates,
        })
    }

    /// The largest way or strain of a body, in units of lengths and of a strain.
    fn size(&self, shapes: &[ModeShape], lengths: &[f64], strain: f64) -> f64 {
        let bodies = shapes.iter().zip(lengths).zip(&self.inverses);
        let sizes = bodies.map(|((shape, length), inverse)| {
            (shape.translation.norm() / length).max((shape.gradient * inverse).norm() / strain)
        });
        sizes.fold(0.0, f64::max)
    }
}

/// A direction to go, before it is cut by what is in the way.
struct Way {
    along: DVector<f64>,
    /// Whether it is shorter than Newton's step.
    is_cut: bool,
}

/// What a step has come to.
enum Progress {
    GoesOn,
    Rests,
    /// Forces are left, and no part of a step along them is in the model.
    IsBlocked,
}

/// By what part of the force along a step that at its end may differ from what the stiffness tells: one that has led
/// over a hill does by more.
const TRUSTED: f64 = 0.5;
/// A step below this part of the one before closes in: Newton's method does near a rest.
const CLOSING: f64 = 0.5;
/// In how many parts a step is looked at besides, for far away a force may be what it should be by chance: where the
/// stiffness does not stop it, and among formulas, which may have hills and valleys anywhere, for each size or unit of
/// strain that it goes, at least and at most.
const FEW_PARTS: usize = 4;
const PARTS: f64 = 16.0;
const PARTS_BOUNDS: (f64, f64) = (8.0, 64.0);

/// How a step stands to the one before.
struct Pace {
    /// In lengths and strains.
    size: f64,
    is_closing: bool,
    /// In how many parts it is looked at among formulas; none where there are none.
    parts: Option<usize>,
}

impl Pace {
    /// The parts at which a step is looked at, given whether the stiffness stops its force.
    fn parts(&self, is_stopped: bool) -> usize {
        match self.parts {
            _ if is_stopped && self.is_closing => 1,
            None if is_stopped => 1,
            None => FEW_PARTS,
            Some(parts) => parts,
        }
    }
}

/// Whether formulas act, between whose hills and valleys a step may lead.
fn has_formulas(model: &Model) -> bool {
    // A stiffness has one valley.
    let is_formula = |law: &BondLaw| !matches!(law, BondLaw::Stiffness(_));
    model.bodies.iter().any(|body| body.own.hold())
        || model.bonds().iter().any(|bond| bond.law.as_ref().is_some_and(is_formula))
        || model.joints().iter().any(|joint| joint.motor.drive.is_some())
}

struct Search {
    numbers: Vec<f64>,
    /// The longest way of each centre in a step [m].
    reach: Vec<f64>,
    /// The size of the step before.
    last: f64,
}

impl Search {
    /// Goes one step.
    fn step(&mut self, frozen: &mut FrozenSystem) -> Result<Progress, NoRest> {
        let balance = Balance::at(frozen, &self.numbers)?;
        if balance.force.is_empty() {
            return Ok(Progress::Rests);
        }
        let way = self.direction(frozen, &balance);
        let shapes = balance.coordinates.shapes(frozen, &way.along);
        let size = balance.size(&shapes, &balance.lengths, 1.0);
        // Newton squares a small step: where it does not even halve, rounding is reached. One that is as small because
        // nothing longer was in the model has not come to rest.
        if size == 0.0 || (size < SMALL && size > 0.5 * self.last) {
            return Ok(if size > 0.0 && way.is_cut { Progress::IsBlocked } else { Progress::Rests });
        }
        let parts = has_formulas(frozen.model()).then(|| {
            let sizes: Vec<f64> = frozen.bodies().iter().map(|body| body.size).collect();
            let (least, most) = PARTS_BOUNDS;
            // Between two whole numbers.
            (PARTS * balance.size(&shapes, &sizes, 1.0)).ceil().clamp(least, most) as usize
        });
        let pace = Pace { size, is_closing: size < CLOSING * self.last, parts };
        self.last = size;
        let mut grow = |factor: f64| self.reach.iter_mut().for_each(|reach| *reach *= factor);
        match Self::take(frozen, &mut self.numbers, &pace, &balance, &way.along) {
            Some(1.0) if way.is_cut => grow(2.0),
            Some(1.0) => {}
            Some(_) => grow(0.5),
            None if size < SMALL && way.is_cut => return Ok(Progress::IsBlocked),
            // No part of it is admissible or of use: at rounding.
            None if size < SMALL => return Ok(Progress::Rests),
            None => grow(0.25),
        }
        Ok(Progress::GoesOn)
    }

    /// The step, no longer than the reach.
    fn direction(&self, frozen: &FrozenSystem, balance: &Balance) -> Way {
        let Balance { coordinates, force, stiffness, .. } = balance;
        let Basis { vectors, values, zero } = canonical::eigen(stiffness);
        let along = vectors.transpose() * force;
        let shapes: Vec<Vec<ModeShape>> =
            vectors.column_iter().map(|vector| coordinates.shapes(frozen, &vector.into_owned())).collect();
        // The force that the stiffness gives over a length, or a strain, of one.
        let scale = shapes
            .iter()
            .zip(&values)
            .map(|(shapes, value)| value.abs() / balance.size(shapes, &balance.lengths, 1.0).max(f64::MIN_POSITIVE));
        let heaviest = frozen.bodies().iter().map(|body| body.solid.mass.mass).fold(0.0, f64::max);
        let scale = scale.fold(frozen.gravity().norm() * heaviest.sqrt(), f64::max);
        // Nor does rounding choose the side to which a body would fall.
        let free = |k: usize| values[k] <= zero && along[k].abs() <= NO_FORCE * scale;
        // What has to be cut is cut alike, so that it goes the way of its force.
        let per_step = |shapes: &[ModeShape]| balance.size(shapes, &self.reach, LARGEST_STRAIN);
        let needed = shapes.iter().enumerate().map(|(k, shapes)| along[k].abs() * per_step(shapes));
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
        Way { along: vectors * solved, is_cut: least > 0.0 }
    }

    /// Takes the largest part 1, ½, ¼ … of a step that is admissible and goes downhill; none if there is none.
    fn take(
        frozen: &mut FrozenSystem,
        numbers: &mut Vec<f64>,
        pace: &Pace,
        balance: &Balance,
        way: &DVector<f64>,
    ) -> Option<f64> {
        let Balance { coordinates, force, stiffness, gaps, barriers, .. } = balance;
        let bend = way.dot(&(stiffness * way));
        let volumes = |frozen: &FrozenSystem, numbers: &[f64]| -> Vec<f64> {
            (0..frozen.count()).map(|body| frozen.motion(numbers, body).placement.gradient.determinant()).collect()
        };
        let before = volumes(frozen, numbers);
        let mut part = 1.0;
        for _ in (0..HALVINGS).take_while(|_| Interruption::due().is_none()) {
            let mut ahead = numbers.clone();
            coordinates.advance_places(&mut ahead, &(part * way));
            let is_held = frozen.project(&mut ahead);
            let keeps_volume = volumes(frozen, &ahead).iter().zip(&before).all(|(new, old)| *new > LEAST_KEPT * old);
            let new_gaps = frozen.gaps(&ahead);
            let keeps = |(new, old): (&BodyGaps, &BodyGaps)| {
                new.to_supports.iter().zip(&old.to_supports).all(|(new, old)| *new > LEAST_KEPT * old)
            };
            let keeps_gaps = new_gaps.iter().zip(gaps).all(keeps);
            let is_kept = is_held && keeps_volume && keeps_gaps && barriers.hold(frozen, &ahead);
            if is_kept && let Ok(rates) = frozen.rates(&ahead) {
                let (before, after) = (force.dot(way), coordinates.force(&rates).dot(way));
                let is_as_told = |along: f64, part: f64| (along - (before - part * bend)).abs() <= TRUSTED * before;
                let mut is_as_told_inside = |part: f64| {
                    let mut there = numbers.clone();
                    coordinates.advance_places(&mut there, &(part * way));
                    let is_held = frozen.project(&mut there);
                    let found = frozen.rates(&there).ok().filter(|_| is_held);
                    found.is_some_and(|rates| is_as_told(coordinates.force(&rates).dot(way), part))
                };
                let goes_on = before + after >= 0.0 && is_as_told(after, part) && {
                    let parts = pace.parts(part * bend >= TRUSTED * before);
                    (1..parts).all(|k| is_as_told_inside(k as f64 / parts as f64 * part))
                };
                // Forces at rest are rounding; their work tells nothing.
                if pace.size < SMALL || goes_on {
                    *numbers = ahead;
                    return Some(part);
                }
            }
            part *= 0.5;
        }
        None
    }
}
