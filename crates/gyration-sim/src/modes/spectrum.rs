//! The eigenvalues and vectors of ξ̈ + C ξ̇ + K ξ = B γ, γ̇ = D ξ + E ξ̇ + H γ.
//!
//! In the basis of sym K, with x_i = ω_i ξ_i, ω_i = √|k_i|, and y = ξ̇:
//!
//!   ẋ_i = ω_i y_i,   ẏ_i = −Σ (K_ij/ω_j) x_j − Σ C_ij y_j + Σ B_ij γ_j,
//!   γ̇_i = Σ (D_ij/ω_j) x_j + Σ E_ij y_j + Σ H_ij γ_j
//!
//! γ are the contraction's, none of other bodies. Where nothing depends on a coordinate there is no x_i, and its
//! eigenvalue 0 is taken out exactly (left in, it would be a double one, known to the square root of rounding alone).
//! What does not act on each other falls into parts; a part of one coordinate is λ² + cλ + k = 0.

use super::canonical::Basis;
use super::parts::joined_parts;
use super::{ModeBehaviour, NoSpectrum};
use crate::eigenvalues::eigenvalues;
use nalgebra::{Complex, ComplexField, DMatrix, DVector};

type C64 = Complex<f64>;

/// Entries below this part of the rates that they couple change the eigenvalues by rounding.
const UNCOUPLED: f64 = 1e-12;
/// Entries below this part of the largest are the rounding of a few hundred operations on it.
const NOISE: f64 = 3e-14;
/// Real or imaginary parts below this part of the fastest eigenvalue of a part are rounding.
const ROUNDING: f64 = 1e-10;
/// Eigenvalues nearer than this part of the fastest are one, with as many vectors.
const SAME: f64 = 1e-8;

/// B, D, E and H.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FirstOrder {
    /// B.
    pub forces: DMatrix<f64>,
    /// D.
    pub by_place: DMatrix<f64>,
    /// E.
    pub by_rate: DMatrix<f64>,
    /// H.
    pub own: DMatrix<f64>,
    /// Which of them only turn the relaxed shape.
    pub turns: Vec<bool>,
}

impl FirstOrder {
    /// Of bodies without any.
    pub fn none(size: usize) -> Self {
        Self::zeros(size, 0)
    }

    /// Of so many z and γ, which do nothing to each other.
    pub fn zeros(size: usize, own: usize) -> Self {
        let (wide, high) = (DMatrix::zeros(size, own), DMatrix::zeros(own, size));
        let turns = vec![false; own];
        Self { forces: wide, by_place: high.clone(), by_rate: high, own: DMatrix::zeros(own, own), turns }
    }
}

/// The eigenvalues of a motion and how the body moves, in the coordinates z and γ.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EigenMotion {
    /// Two, or one of a motion that the contraction adds.
    pub eigenvalues: Vec<C64>,
    pub motion: ModeBehaviour,
    /// Along z.
    pub shape: DVector<C64>,
    /// Along γ.
    pub contraction: DVector<C64>,
    /// The same in the scale and phase of the shape, where that is not zero.
    pub following: DVector<C64>,
}

/// All of them, one a coordinate.
pub(super) fn solve(
    (k, c): (&DMatrix<f64>, &DMatrix<f64>),
    first: &FirstOrder,
    basis: &Basis,
) -> Result<Vec<EigenMotion>, NoSpectrum> {
    let vectors = &basis.vectors;
    let into = |matrix: &DMatrix<f64>| vectors.transpose() * matrix * vectors;
    let (count, own) = (vectors.ncols(), first.own.nrows());
    let system = System::new((into(k), basis.zero), into(c), (vectors, first));
    let mut motions = Vec::new();
    for part in system.parts() {
        let found = match part[..] {
            [alone] if alone < count => vec![system.single(alone)],
            _ => system.coupled(&part)?,
        };
        motions.extend(found.into_iter().map(|motion| {
            let placed = |contraction: &DVector<C64>| {
                let mut whole = DVector::zeros(count + own);
                let numbers = motion.shape.iter().chain(contraction.iter());
                part.iter().zip(numbers).for_each(|(at, value)| whole[*at] = *value);
                whole
            };
            let vectors = vectors.map(|entry| C64::new(entry, 0.0));
            let whole = placed(&motion.contraction);
            let contraction = whole.rows(count, own).into_owned();
            let following = placed(&motion.following).rows(count, own).into_owned();
            EigenMotion { shape: vectors * whole.rows(0, count), contraction, following, ..motion }
        }));
    }
    Ok(motions)
}

/// The system in the basis of the stiffness: coordinates first, then γ in units of a velocity.
struct System {
    stiffness: DMatrix<f64>,
    resistance: DMatrix<f64>,
    first: FirstOrder,
}

impl System {
    fn new(
        (mut stiffness, zero): (DMatrix<f64>, f64),
        resistance: DMatrix<f64>,
        (vectors, first): (&DMatrix<f64>, &FirstOrder),
    ) -> Self {
        let mut first = FirstOrder {
            forces: vectors.transpose() * &first.forces,
            by_place: &first.by_place * vectors,
            by_rate: &first.by_rate * vectors,
            own: first.own.clone(),
            turns: first.turns.clone(),
        };
        for mut column in stiffness.column_iter_mut() {
            if column.norm() <= zero {
                column.fill(0.0);
            }
        }
        let least = NOISE * first.by_place.amax();
        for mut column in first.by_place.column_iter_mut() {
            if column.norm() <= least {
                column.fill(0.0);
            }
        }
        let mut system = Self { stiffness, resistance, first: FirstOrder::none(vectors.ncols()) };
        // A unit of γ in which what it does to the body weighs as much as what the body does to it.
        let answers = (0..vectors.ncols()).filter(|i| system.stiffness.column(*i).norm() > 0.0);
        let answers = answers.map(|i| first.by_place.column(i).norm() / system.scale(i)).fold(0.0, f64::max);
        let (pushed, answers) = (first.forces.norm(), answers.max(first.by_rate.norm()));
        if pushed > 0.0 && answers > 0.0 {
            let unit = (pushed / answers).sqrt();
            first.forces /= unit;
            first.by_place *= unit;
            first.by_rate *= unit;
        }
        system.first = first;
        system
    }

    fn count(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Whether any force depends on the coordinate.
    fn bound(&self, i: usize) -> bool {
        self.scale(i) > 0.0
    }

    /// ω_i; without potential also where k_i = 0.
    fn scale(&self, i: usize) -> f64 {
        let scale = self.stiffness.column(i).norm().sqrt();
        if scale > 0.0 { scale } else { self.first.by_place.column(i).norm() }
    }

    /// Coordinates and contractions in groups that do not act on each other.
    fn parts(&self) -> Vec<Vec<usize>> {
        let count = self.count();
        let first = &self.first;
        let largest = [&self.stiffness, &self.resistance, &first.forces, &first.by_place, &first.by_rate, &first.own]
            .map(|matrix| NOISE * matrix.amax());
        let rate = |i: usize| match i.checked_sub(count) {
            None => self.scale(i).max(self.resistance[(i, i)].abs()),
            Some(k) => first.own[(k, k)].abs(),
        };
        let acts = |i: usize, j: usize| {
            let product = rate(i) * rate(j);
            let more = |value: f64, power: f64, noise: f64| value.abs() > (UNCOUPLED * power).max(noise);
            let [stiffness, resistance, forces, by_place, by_rate, own] = largest;
            match (i.checked_sub(count), j.checked_sub(count)) {
                (None, None) => {
                    more(self.resistance[(i, j)], product.sqrt(), resistance)
                        || more(self.stiffness[(i, j)], product, stiffness)
                }
                (None, Some(k)) => more(first.forces[(i, k)], product.sqrt(), forces),
                (Some(k), None) => {
                    more(first.by_rate[(k, j)], product.sqrt(), by_rate)
                        || more(first.by_place[(k, j)], product, by_place)
                }
                (Some(k), Some(l)) => more(first.own[(k, l)], product.sqrt(), own),
            }
        };
        // What only turns the relaxed shape, and is not felt, is no motion.
        let felt = |k: usize| (0..count + first.own.nrows()).any(|i| acts(i, count + k));
        let moving =
            (0..count).chain((0..first.own.nrows()).filter(|k| !first.turns[*k] || felt(*k)).map(|k| count + k));
        joined_parts(moving.collect(), acts)
    }

    /// λ² + cλ + k = 0.
    fn single(&self, i: usize) -> EigenMotion {
        let (k, c) = (self.stiffness[(i, i)], self.resistance[(i, i)]);
        let square = 0.25 * c * c - k;
        let eigenvalues = if square < 0.0 {
            [1.0, -1.0].map(|sign| C64::new(0.0 - 0.5 * c, sign * (-square).sqrt()))
        } else {
            // The larger one first, so that nothing cancels: λ₁ λ₂ = k.
            let fast = -0.5 * c - square.sqrt().copysign(c);
            let slow = if fast == 0.0 { 0.0 } else { k / fast };
            // Zero has no sign.
            [slow, fast].map(|value| C64::new(value + 0.0, 0.0))
        };
        // What resists a free turn is rounding of what resists strains.
        let rounding = if self.bound(i) { 0.0 } else { NOISE * self.resistance.amax() };
        let motion = judge(&eigenvalues, rounding, !self.bound(i));
        let shape = DVector::from_element(1, C64::new(1.0, 0.0));
        EigenMotion {
            eigenvalues: eigenvalues.to_vec(),
            motion,
            shape,
            contraction: DVector::zeros(0),
            following: DVector::zeros(0),
        }
    }

    /// The system of first order of a part: x of the bound coordinates, then y of all, then γ.
    fn first_order(&self, part: &Part) -> DMatrix<f64> {
        let Part { bound, coordinates, contractions } = part;
        let (speeds, own) = (bound.len(), bound.len() + coordinates.len());
        let mut matrix = DMatrix::zeros(own + contractions.len(), own + contractions.len());
        for (row, i) in coordinates.iter().enumerate() {
            for (column, j) in bound.iter().enumerate() {
                matrix[(speeds + row, column)] = -self.stiffness[(*i, *j)] / self.scale(*j);
            }
            for (column, j) in coordinates.iter().enumerate() {
                matrix[(speeds + row, speeds + column)] = -self.resistance[(*i, *j)];
            }
            for (column, k) in contractions.iter().enumerate() {
                matrix[(speeds + row, own + column)] = self.first.forces[(*i, *k)];
            }
        }
        for (row, k) in contractions.iter().enumerate() {
            for (column, j) in bound.iter().enumerate() {
                matrix[(own + row, column)] = self.first.by_place[(*k, *j)] / self.scale(*j);
            }
            for (column, j) in coordinates.iter().enumerate() {
                matrix[(own + row, speeds + column)] = self.first.by_rate[(*k, *j)];
            }
            for (column, l) in contractions.iter().enumerate() {
                matrix[(own + row, own + column)] = self.first.own[(*k, *l)];
            }
        }
        for (row, i) in bound.iter().enumerate() {
            let column = coordinates.iter().position(|j| j == i).unwrap_or(0);
            matrix[(row, speeds + column)] = self.scale(*i);
        }
        matrix
    }

    fn coupled(&self, part: &[usize]) -> Result<Vec<EigenMotion>, NoSpectrum> {
        let (coordinates, others): (Vec<usize>, Vec<usize>) = part.iter().partition(|i| **i < self.count());
        let part = &Part {
            bound: coordinates.iter().copied().filter(|i| self.bound(*i)).collect(),
            coordinates,
            contractions: others.into_iter().map(|i| i - self.count()).collect(),
        };
        let matrix = self.first_order(part);
        let values = eigenvalues(&matrix).ok_or(NoSpectrum)?;
        let fastest = values.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let neutral = part.coordinates.len() - part.bound.len();
        let rounding = ROUNDING * fastest;
        // What a contraction follows, nothing brings back: another zero.
        let has_zeros = neutral > 0 || !part.contractions.is_empty();
        let snap = |value: f64| if value.abs() <= rounding && has_zeros { 0.0 } else { value };
        let mut motions = Vec::new();
        let mut reals = Vec::new();
        for (value, vector) in eigenvectors(&matrix, &values, SAME * fastest) {
            if value.im > rounding {
                let eigenvalues = [C64::new(snap(value.re), value.im), C64::new(snap(value.re), -value.im)];
                let motion = judge(&eigenvalues, rounding, false);
                let Moved { shape, contraction, following } = self.moved(part, value, &vector);
                motions.push(EigenMotion { eigenvalues: eigenvalues.to_vec(), motion, shape, contraction, following });
            } else if value.im >= -rounding {
                reals.push((snap(value.re), self.moved(part, value, &vector)));
            }
        }
        let circling = self.circling(part, (rounding, motions.len()))?;
        let pairs = (part.bound.len() + circling.len()).saturating_sub(motions.len());
        let straight = neutral.saturating_sub(2 * circling.len());
        motions.extend(self.joined(part, reals, (straight, pairs), rounding));
        motions.extend(circling.into_iter().map(|shape| {
            let (eigenvalues, still) = (vec![C64::new(0.0, 0.0); 2], DVector::zeros(part.contractions.len()));
            EigenMotion {
                eigenvalues,
                motion: ModeBehaviour::Free,
                shape,
                contraction: still.clone(),
                following: still,
            }
        }));
        Ok(motions)
    }

    /// Displacements of free coordinates whose velocities turn into one another, a gyroscopic load: two of these make
    /// one pair ±iω, and leave the zeros of both, which are a motion. A direction in the plane of each such pair.
    ///
    /// Rates below the rounding of the part are none. Where it has more oscillations than bound coordinates, though
    /// none of free ones by themselves, coupling has made them.
    fn circling(&self, part: &Part, (rounding, oscillations): (f64, usize)) -> Result<Vec<DVector<C64>>, NoSpectrum> {
        let free: Vec<usize> = (0..part.coordinates.len()).filter(|at| !self.bound(part.coordinates[*at])).collect();
        let resistance = DMatrix::from_fn(free.len(), free.len(), |i, j| {
            -self.resistance[(part.coordinates[free[i]], part.coordinates[free[j]])]
        });
        let turning = (&resistance - resistance.transpose()).amax();
        if turning <= rounding.max(NOISE * self.resistance.amax()) {
            return Ok(Vec::new());
        }
        let values = eigenvalues(&resistance).ok_or(NoSpectrum)?;
        let fastest = values.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        let found = eigenvectors(&resistance, &values, SAME * fastest);
        let shape = |(_, vector): (C64, DVector<C64>)| {
            // The phase in which its largest part is displaced.
            let most = vector.iter().copied().max_by(|a, b| a.modulus().total_cmp(&b.modulus())).unwrap_or_default();
            let mut shape = DVector::zeros(part.coordinates.len());
            let displaced = vector.iter().map(|value| C64::new((value * most.conj()).re, 0.0));
            free.iter().zip(displaced).for_each(|(at, value)| shape[*at] = value);
            let size = shape.norm();
            shape / C64::new(size, 0.0)
        };
        let mut shapes: Vec<_> = found.into_iter().filter(|(value, _)| value.im > rounding).map(shape).collect();
        let made = if part.contractions.is_empty() { oscillations.saturating_sub(part.bound.len()) } else { 0 };
        for k in shapes.len()..made.min(free.len() / 2) {
            let mut shape = DVector::zeros(part.coordinates.len());
            shape[free[2 * k]] = C64::new(1.0, 0.0);
            shapes.push(shape);
        }
        Ok(shapes)
    }

    /// What an eigenvector moves.
    fn moved(&self, part: &Part, value: C64, vector: &DVector<C64>) -> Moved {
        let Part { bound, coordinates, contractions } = part;
        let along = |times: C64| {
            let mut along = coordinates.iter().enumerate().map(|(at, i)| match bound.iter().position(|j| j == i) {
                // ξ̇ = λ ξ, and ξ is what is known best of a slow motion.
                Some(x) => vector[x] / self.scale(*i) * times,
                None => vector[bound.len() + at],
            });
            DVector::from_fn(coordinates.len(), |_, _| along.next().unwrap_or_default())
        };
        let speeds = along(value);
        // Where rates are some 30 orders apart the speeds of the slow motions vanish; their displacements do not.
        let (along, times) = match speeds.norm().is_normal() {
            true => (speeds, value),
            false => (along(C64::new(1.0, 0.0)), C64::new(1.0, 0.0)),
        };
        let contraction = vector.rows(bound.len() + coordinates.len(), contractions.len()).into_owned();
        let size = along.norm();
        match size > 0.0 {
            true => Moved { shape: along / C64::new(size, 0.0), following: &contraction * (times / size), contraction },
            false => Moved { shape: along, following: contraction.clone(), contraction },
        }
    }

    /// Joins real eigenvalues to pairs: those that move along free coordinates most with the zeros of those that do not
    /// circle, the others by likeness; those that contract most stay alone.
    fn joined(
        &self,
        part: &Part,
        mut reals: Vec<(f64, Moved)>,
        (straight, pairs): (usize, usize),
        rounding: f64,
    ) -> Vec<EigenMotion> {
        let freedom = |(_, moved): &(f64, Moved)| -> f64 {
            let along = part.coordinates.iter().zip(moved.shape.iter());
            along.filter(|(i, _)| !self.bound(**i)).map(|(_, value)| value.norm_sqr()).sum()
        };
        reals.sort_by(|a, b| freedom(b).total_cmp(&freedom(a)));
        let mut motions = Vec::new();
        let motion = |values: &[f64], Moved { shape, contraction, following }: Moved, free: bool| {
            let eigenvalues: Vec<C64> = values.iter().map(|value| C64::new(*value, 0.0)).collect();
            EigenMotion { motion: judge(&eigenvalues, rounding, free), eigenvalues, shape, contraction, following }
        };
        for (value, moved) in reals.drain(..straight.min(reals.len())) {
            motions.push(motion(&[0.0, value], moved, true));
        }
        reals.sort_by(|a, b| b.1.contraction.norm().total_cmp(&a.1.contraction.norm()));
        for (value, moved) in reals.drain(..reals.len().saturating_sub(2 * pairs)) {
            motions.push(motion(&[value], moved, value.abs() <= rounding));
        }
        reals.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        while !reals.is_empty() {
            let (slow, moved) = reals.remove(0);
            let likeness = |other: &(f64, Moved)| moved.shape.dotc(&other.1.shape).modulus();
            let best = (0..reals.len()).max_by(|a, b| likeness(&reals[*a]).total_cmp(&likeness(&reals[*b])));
            let fast = best.map_or(slow, |best| reals.remove(best).0);
            motions.push(motion(&[slow, fast], moved, slow == 0.0 && !part.contractions.is_empty()));
        }
        motions
    }
}

/// Coordinates and contractions that act on each other.
#[derive(Debug)]
struct Part {
    /// The coordinates that a force depends on.
    bound: Vec<usize>,
    coordinates: Vec<usize>,
    contractions: Vec<usize>,
}

/// What moves along an eigenvector.
#[derive(Debug, Clone)]
struct Moved {
    /// Of length one, or nothing.
    shape: DVector<C64>,
    contraction: DVector<C64>,
    /// The contraction in the scale of the shape.
    following: DVector<C64>,
}

/// What a motion does; `free` if one of its zeros is that of a free coordinate.
fn judge(eigenvalues: &[C64], rounding: f64, free: bool) -> ModeBehaviour {
    if eigenvalues.iter().any(|value| value.re > rounding) {
        ModeBehaviour::Grows
    } else if free {
        ModeBehaviour::Free
    } else if eigenvalues[0].im != 0.0 {
        ModeBehaviour::Oscillates
    } else {
        ModeBehaviour::Creeps
    }
}

/// Vectors of the eigenvalues in order, by inverse iteration with as many columns as there are eigenvalues that are
/// one.
fn eigenvectors(matrix: &DMatrix<f64>, values: &[C64], same: f64) -> Vec<(C64, DVector<C64>)> {
    let size = matrix.nrows();
    let mut left: Vec<C64> = values.to_vec();
    let mut found = Vec::new();
    while let Some(first) = left.first().copied() {
        let (group, others): (Vec<C64>, Vec<C64>) = left.iter().partition(|value| (*value - first).modulus() <= same);
        left = others;
        // A shift beside the eigenvalue by more than its rounding keeps the matrix regular.
        let shift = first + C64::new(0.3, 0.4) * (1e-3 * same).max(f64::MIN_POSITIVE);
        let shifted = matrix.map(|entry| C64::new(entry, 0.0)) - DMatrix::from_diagonal_element(size, size, shift);
        let solver = shifted.lu();
        // Any start without zeros and without symmetry.
        let mut columns = DMatrix::from_fn(size, group.len(), |i, j| {
            C64::new(libm::sin(1.0 + 1.7 * i as f64 + 2.3 * (j * i) as f64), 0.1)
        });
        for _ in 0..3 {
            if let Some(next) = solver.solve(&columns) {
                columns = next.qr().q();
            }
        }
        found.extend(group.into_iter().zip(columns.column_iter().map(|column| column.into_owned())));
    }
    found
}

#[cfg(test)]
mod tests;
