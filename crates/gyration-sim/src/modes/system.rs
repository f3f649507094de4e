//! Coordinates of the small motions of a system: those of its bodies, one after the other, then those of contractions.
//!
//! Where joints are, the coordinates are those y that they leave of all z (`tangent`).

use super::contraction::ContractionCoordinates;
use super::coordinates::Coordinates;
use super::frozen::FrozenSystem;
use super::shape::ModeShape;
use super::slopes::SystemSlopes;
use super::spectrum::FirstOrder;
use super::tangent::JointTangent;
use super::weightless::Inertial;
use crate::singular_values::SingularValues;
use gyration::Inadmissible;
use gyration::body::{Body, Slots};
use gyration::lattice::HERE;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;
use std::sync::Arc;

/// A part in quadrature below this is rounding.
const IN_STEP: f64 = 1e-6;

/// The maps between (z, γ) and the numbers of a system.
#[derive(Debug, Clone)]
pub(super) struct SystemCoordinates {
    bodies: Vec<BodyCoordinates>,
    /// What joints leave of z; none without any.
    tangent: Option<JointTangent>,
}

/// Those of one body, and where they stand.
#[derive(Debug, Clone)]
struct BodyCoordinates {
    places: Coordinates,
    contraction: Option<ContractionCoordinates>,
    slots: Slots,
    z: Range<usize>,
    gamma: Range<usize>,
}

impl BodyCoordinates {
    /// Where positions and attitudes end and velocities begin in its block, and where G begins.
    fn bounds(&self) -> [usize; 2] {
        let start = self.slots.block().start;
        [self.slots.velocities().start - start, self.slots.extra().start - start]
    }
}

impl SystemCoordinates {
    /// At a configuration.
    ///
    /// # Errors
    /// [`Inadmissible`] where it is outside the model.
    pub fn at(frozen: &mut FrozenSystem, numbers: &[f64]) -> Result<Self, Inadmissible> {
        let equations = frozen.joint_equations(numbers)?;
        let (mut z, mut gamma) = (0, 0);
        let next = |start: &mut usize, count: usize| {
            let range = *start..*start + count;
            *start = range.end;
            range
        };
        let bodies = frozen.bodies().iter().enumerate().map(|(index, body)| {
            let slots = *frozen.slots(index);
            let block = &numbers[slots.block()];
            let places = Coordinates::at(body, block);
            let contraction = ContractionCoordinates::at(body, block);
            let (moving, contracting) = (places.count(), contraction.as_ref().map_or(0, ContractionCoordinates::count));
            let (z, gamma) = (next(&mut z, moving), next(&mut gamma, contracting));
            BodyCoordinates { places, contraction, slots, z, gamma }
        });
        let bodies: Vec<BodyCoordinates> = bodies.collect();
        let places: Vec<_> = bodies.iter().map(|body| (&body.places, body.z.clone())).collect();
        let tangent = JointTangent::of(&equations, &places);
        Ok(Self { bodies, tangent })
    }

    /// How many free coordinates and γ there are.
    pub fn counts(&self) -> [usize; 2] {
        let contracting = self.bodies.last().map_or(0, |last| last.gamma.end);
        [self.tangent.as_ref().map_or(self.count(), JointTangent::count), contracting]
    }

    /// How many z there are.
    fn count(&self) -> usize {
        self.bodies.last().map_or(0, |last| last.z.end)
    }

    /// y of what a motion has within the joints.
    pub fn within(&self, z: DVector<f64>) -> DVector<f64> {
        match &self.tangent {
            None => z,
            Some(tangent) => tangent.along(&z),
        }
    }

    /// z of y.
    fn whole(&self, y: &DVector<f64>) -> DVector<f64> {
        self.tangent.as_ref().map_or_else(|| y.clone(), |tangent| tangent.basis() * y)
    }

    /// The rows of a matrix along y.
    fn rows_within(&self, matrix: DMatrix<f64>) -> DMatrix<f64> {
        match &self.tangent {
            None => matrix,
            Some(tangent) => tangent.basis().tr_mul(&matrix),
        }
    }

    /// The columns of a matrix along y.
    fn columns_within(&self, matrix: DMatrix<f64>) -> DMatrix<f64> {
        match &self.tangent {
            None => matrix,
            Some(tangent) => matrix * tangent.basis(),
        }
    }

    /// Those of a body.
    pub fn of(&self, body: usize) -> &Coordinates {
        &self.bodies[body].places
    }

    /// Where z of a body stand.
    pub fn range(&self, body: usize) -> Range<usize> {
        self.bodies[body].z.clone()
    }

    /// Which coordinates have inertia: no joint touches a body without.
    pub fn inertial(&self, frozen: &FrozenSystem) -> Inertial {
        let bodies = (0..self.bodies.len()).filter(|body| frozen.is_weightless(*body));
        let z = bodies.flat_map(|body| self.range(body));
        let weightless: Vec<usize> =
            z.filter_map(|z| self.tangent.as_ref().map_or(Some(z), |tangent| tangent.place(z))).collect();
        let moving = (0..self.counts()[0]).filter(|place| weightless.binary_search(place).is_err()).collect();
        Inertial { moving, weightless }
    }

    /// Whether the contraction of a body moves.
    pub fn contracts(&self) -> bool {
        self.counts()[1] > 0
    }

    /// The turn that takes coordinates of one cell nearest to those of a neighbouring one: U of X = U |X|, X = N₀ᵀ V₀†
    /// V N.
    ///
    /// None if they are not alike.
    pub fn turn(from: &Self, to: &Self) -> Option<DMatrix<f64>> {
        let mut seen = DMatrix::zeros(to.count(), from.count());
        for (own, other) in from.bodies.iter().zip(&to.bodies) {
            let (rates, weights) = (own.places.rates(), other.places.weights());
            if rates.nrows() != weights.ncols() {
                return None;
            }
            let shape = (other.z.len(), own.z.len());
            seen.view_mut((other.z.start, own.z.start), shape).copy_from(&(weights * rates));
        }
        let seen = to.rows_within(from.columns_within(seen));
        if from.bodies.len() != to.bodies.len() || !seen.is_square() {
            return None;
        }
        if seen.is_empty() {
            return Some(seen);
        }
        let found = SingularValues::of(&seen)?;
        let parts = found.above(0.0).map(|k| found.left(k) * found.right(k).transpose());
        Some(parts.fold(DMatrix::zeros(to.count(), from.count()), |sum, part| sum + part))
    }

    /// The sizes of the numbers of places along y, centres with a length beyond their cells.
    pub fn sizes(&self, frozen: &FrozenSystem, numbers: &[f64], beyond: f64) -> DVector<f64> {
        let mut sizes = DVector::zeros(self.count());
        for (body, at) in frozen.bodies().iter().zip(&self.bodies) {
            let own = at.places.sizes(body, &numbers[at.slots.block()], beyond);
            sizes.rows_mut(at.z.start, at.z.len()).copy_from(&own);
        }
        self.tangent.as_ref().map_or(sizes.clone(), |tangent| tangent.basis().abs().tr_mul(&sizes))
    }

    /// By how much the mass along z is not one, at most.
    pub fn mass_error(&self, frozen: &FrozenSystem) -> f64 {
        let bodies = frozen.bodies().iter().zip(&self.bodies);
        bodies.map(|(body, at)| at.places.mass_error(body)).fold(0.0, f64::max)
    }

    /// z̈ from the rates of all numbers.
    pub fn force(&self, rates: &[f64]) -> DVector<f64> {
        let mut force = DVector::zeros(self.count());
        for body in &self.bodies {
            force.rows_mut(body.z.start, body.z.len()).copy_from(&body.places.force(&rates[body.slots.velocities()]));
        }
        match &self.tangent {
            None => force,
            Some(tangent) => tangent.basis().tr_mul(&force),
        }
    }

    /// V_G of each body whose contraction moves [1/s].
    pub fn contraction_velocities(&self, frozen: &FrozenSystem, numbers: &[f64], rates: &[f64]) -> Vec<Option<Mat3>> {
        let moving = self.bodies.iter().enumerate();
        let speed = |body| frozen.contraction_velocity(numbers, rates, body);
        moving.map(|(index, body)| body.contraction.as_ref().map(|_| speed(index))).collect()
    }

    /// γ̇ of these.
    pub fn along(&self, velocities: &[Option<Mat3>]) -> DVector<f64> {
        let moving = self.bodies.iter().zip(velocities);
        let along = moving.filter_map(|(body, velocity)| Some(body.contraction.as_ref()?.along(velocity.as_ref()?)));
        DVector::from_vec(along.flat_map(|along| along.as_slice().to_vec()).collect())
    }

    /// The strain rate of the relaxed shape of a body along γ.
    pub fn strain(&self, body: usize, gamma: &DVector<f64>) -> Option<Mat3> {
        let BodyCoordinates { contraction, gamma: range, .. } = &self.bodies[body];
        Some(contraction.as_ref()?.strain(&gamma.rows(range.start, range.len()).into_owned()))
    }

    /// The sum over all blocks of what two bodies make of one.
    fn assembled(
        &self,
        slopes: &SystemSlopes,
        part: impl Fn(&BodyCoordinates, &BodyCoordinates, &DMatrix<f64>) -> DMatrix<f64>,
    ) -> DMatrix<f64> {
        let mut whole = DMatrix::zeros(self.count(), self.count());
        for ([row, column], _, block) in slopes.iter() {
            let (row, column) = (&self.bodies[row], &self.bodies[column]);
            let mut place = whole.view_mut((row.z.start, column.z.start), (row.z.len(), column.z.len()));
            place += part(row, column, block);
        }
        whole
    }

    /// K [1/s²] where no contraction moves.
    pub fn stiffness(&self, slopes: &SystemSlopes) -> DMatrix<f64> {
        self.rows_within(self.columns_within(self.whole_stiffness(slopes)))
    }

    /// K along z.
    fn whole_stiffness(&self, slopes: &SystemSlopes) -> DMatrix<f64> {
        self.assembled(slopes, |row, column, block| row.places.stiffness(&column.places, block))
    }

    /// C [1/s].
    pub fn resistance(&self, slopes: &SystemSlopes) -> DMatrix<f64> {
        let whole = self.assembled(slopes, |row, column, block| row.places.resistance(&column.places, block));
        self.rows_within(self.columns_within(whole))
    }

    /// K, and the matrices of the contractions, given V_G of each.
    pub fn first_order(&self, velocities: &[Option<Mat3>], slopes: &SystemSlopes) -> (DMatrix<f64>, FirstOrder) {
        let mut stiffness = self.whole_stiffness(slopes);
        let mut first = FirstOrder::zeros(self.count(), self.counts()[1]);
        first.turns =
            self.bodies.iter().flat_map(|body| body.contraction.iter().flat_map(|it| it.turns())).copied().collect();
        for ([i, j], cell, block) in slopes.iter() {
            let (row, column) = (&self.bodies[i], &self.bodies[j]);
            let ([above, below], [left, right]) = (row.bounds(), column.bounds());
            let speeds = row.places.rates().nrows();
            if let Some(contraction) = &column.contraction {
                let pushed = row.places.weights() * block.view((above, right), (speeds, 9));
                let mut by_place = stiffness.view_mut((row.z.start, column.z.start), (row.z.len(), column.z.len()));
                by_place -= &pushed * contraction.follows(&column.places);
                let mut forces =
                    first.forces.view_mut((row.z.start, column.gamma.start), (row.z.len(), column.gamma.len()));
                forces += pushed * contraction.columns();
            }
            let Some(contraction) = &row.contraction else { continue };
            let rows = contraction.rows();
            let mut by_place = &rows * (block.view((below, 0), (9, left)) * column.places.places());
            if let Some(other) = &column.contraction {
                let mut own = block.view((below, right), (9, 9)).into_owned();
                if let Some(velocity) = velocities[i].as_ref().filter(|_| i == j && cell == HERE) {
                    own -= ContractionCoordinates::carried(velocity);
                }
                by_place += &rows * (&own * other.follows(&column.places));
                let (high, wide) = (row.gamma.len(), column.gamma.len());
                let mut place = first.own.view_mut((row.gamma.start, column.gamma.start), (high, wide));
                place += &rows * own * other.columns();
            }
            let shape = (row.gamma.len(), column.z.len());
            let mut place = first.by_place.view_mut((row.gamma.start, column.z.start), shape);
            place += by_place;
            let by_rate = rows * block.view((below, left), (9, right - left)) * column.places.rates();
            let mut place = first.by_rate.view_mut((row.gamma.start, column.z.start), shape);
            place += by_rate;
        }
        let FirstOrder { forces, by_place, by_rate, .. } = &mut first;
        *forces = self.rows_within(std::mem::take(forces));
        [by_place, by_rate].into_iter().for_each(|matrix| *matrix = self.columns_within(std::mem::take(matrix)));
        (self.rows_within(self.columns_within(stiffness)), first)
    }

    /// Moves numbers along its coordinates and γ.
    pub fn advance(&self, numbers: &mut [f64], along: &DVector<f64>, gamma: &DVector<f64>) {
        let z = self.whole(along);
        for body in &self.bodies {
            let block = &mut numbers[body.slots.block()];
            let z = z.rows(body.z.start, body.z.len()).into_owned();
            if let Some(contraction) = &body.contraction {
                let gamma = gamma.rows(body.gamma.start, body.gamma.len()).into_owned();
                contraction.advance(block, (&body.places, &z), &gamma);
            }
            body.places.advance(block, &z);
        }
    }

    /// Moves the places alone.
    pub fn advance_places(&self, numbers: &mut [f64], along: &DVector<f64>) {
        let z = self.whole(along);
        for body in &self.bodies {
            body.places.advance(&mut numbers[body.slots.block()], &z.rows(body.z.start, body.z.len()).into_owned());
        }
    }

    /// δp₀ and δP of each body along the coordinates.
    pub fn shapes(&self, frozen: &FrozenSystem, along: &DVector<f64>) -> Vec<ModeShape> {
        let z = self.whole(along);
        let own = |body: &BodyCoordinates| z.rows(body.z.start, body.z.len()).into_owned();
        let shape = |(body, at): (&Arc<Body>, &BodyCoordinates)| at.places.shape(body, &own(at));
        frozen.bodies().iter().zip(&self.bodies).map(shape).collect()
    }

    /// The shapes along the coordinates, scaled by the fastest point of all bodies, with the leading entry of the body
    /// that it is of positive, and the part in quadrature if there is one.
    pub fn scaled_shapes(
        &self,
        frozen: &FrozenSystem,
        real: &DVector<f64>,
        imaginary: &DVector<f64>,
    ) -> (Vec<ModeShape>, Option<Vec<ModeShape>>) {
        let shapes = self.shapes(frozen, real);
        let sized = shapes.iter().zip(frozen.bodies()).map(|(shape, body)| {
            let radius = 0.5 * body.size;
            (shape.largest_displacement(radius), shape.leading(radius))
        });
        // The first of several that are as fast: rounding does not choose.
        let (most, leading) =
            sized.fold((0.0, 0.0), |most, next| if next.0 > most.0 * (1.0 + 1e-9) { next } else { most });
        // A contraction that moves no point has no shape.
        let factor = if most > 0.0 { f64::signum(leading) / most } else { 0.0 };
        let scaled = |shapes: Vec<ModeShape>| shapes.iter().map(|shape| shape.times(factor)).collect();
        let out_of_step = imaginary.norm() > IN_STEP * real.norm();
        let quadrature = out_of_step.then(|| scaled(self.shapes(frozen, imaginary)));
        (scaled(shapes), quadrature)
    }

    /// Motions that have a name, as unit vectors of z within the joints: of all bodies together, as those of one body,
    /// then of each.
    pub fn patterns(&self, frozen: &FrozenSystem, numbers: &[f64]) -> Vec<DVector<f64>> {
        let count = self.count();
        let mut own = Vec::new();
        for (index, at) in self.bodies.iter().enumerate() {
            let gradient = frozen.motion(numbers, index).placement.gradient;
            own.push(at.places.patterns(&frozen.bodies()[index], &gradient));
        }
        let placed = |body: usize, pattern: &DVector<f64>| {
            let mut whole = DVector::zeros(count);
            whole.rows_mut(self.bodies[body].z.start, pattern.len()).copy_from(pattern);
            self.within(whole)
        };
        let each = own.iter().enumerate().flat_map(|(body, own)| own.iter().map(move |pattern| placed(body, pattern)));
        let mut patterns = if self.bodies.len() > 1 { self.translations(frozen) } else { Vec::new() };
        patterns.extend(each);
        patterns
    }

    /// z of a motion of each body, δp₀ and δP.
    pub fn moved(&self, frozen: &FrozenSystem, motion: impl Fn(usize) -> (Vec3, Mat3)) -> DVector<f64> {
        let mut whole = DVector::zeros(self.count());
        for (index, (body, at)) in frozen.bodies().iter().zip(&self.bodies).enumerate() {
            let (translation, change) = motion(index);
            let own = at.places.moved(body, &translation, &change);
            whole.rows_mut(at.z.start, at.z.len()).copy_from(&own);
        }
        whole
    }

    /// Translations of all bodies along the axes, as unit vectors of z within the joints.
    pub fn translations(&self, frozen: &FrozenSystem) -> Vec<DVector<f64>> {
        let along = |axis: usize| {
            let mut whole = DVector::zeros(self.count());
            for (body, at) in frozen.bodies().iter().zip(&self.bodies) {
                let own = at.places.translation(body, axis);
                whole.rows_mut(at.z.start, at.z.len()).copy_from(&own);
            }
            let norm = whole.norm();
            self.within(if norm > 0.0 { whole / norm } else { whole })
        };
        (0..3).map(along).collect()
    }
}
