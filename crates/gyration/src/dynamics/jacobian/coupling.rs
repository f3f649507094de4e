//! Block (i, j) of the Jacobian: how the rates of body i change with the numbers of body j, through the loads on i.
//!
//!   block (i, j) = B_i ∂Q_i/∂(q_j, q̇_j) A_j
//!
//! [`Lift`] is A: it lifts a change of the numbers of a body to its coordinates q = (p₀ | P) and their rates,
//!
//!   rigid      δP = R [δθ]×,   δṖ = R [δθ]× [Ω]× + R [δΩ]×,   δθ = 2 vec(q⁻¹ ∘ δq)
//!   deforming  as they stand
//!   pinned     δp₀ = −δP r,    δṗ₀ = −δṖ r
//!
//! [`Lower`] is B: it lowers a change of the loads Q = (f | M) to the rates, δp̈₀ = δf/m, and of M about the centre or
//! the pin to the acceleration of P or Ω that the balance of the kind gives. With i = j it serves every load on a rigid
//! body that has no other way. Bodies without inertia take their velocities from it (`inertialess`), not their rates.

use super::super::affine_history::AffineHistory;
use super::super::contractile::ContractileMotion;
use super::super::guided::Guided;
use super::super::history::RigidHistory;
use crate::affine::Gyration;
use crate::body::{Affine, RigidInertia, Slots};
use crate::instant::{KindAt, MotionAt};
use crate::load::{LoadSlopes, Loads, Mat12, loads, numbers};
use crate::simd::{F64x4, SimdMat3, WithF64x4, dispatch_f64x4};
use crate::state::Turn;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{DMatrix, DVectorViewMut, SVector};

type Vec12 = SVector<f64, 12>;

/// The derivatives of the loads on one body by the coordinates of another, or by its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coupling {
    /// ∂Q_i/∂q_j.
    pub by_place: Mat12,
    /// ∂Q_i/∂q̇_j; none where no load feels velocities.
    pub by_rate: Option<Mat12>,
}

/// A of one body: its columns are the numbers of a slot, position and velocity from 0, attitude and rate behind them.
#[derive(Debug, Clone, Copy)]
pub struct Lift {
    /// ∂q/∂(position, attitude).
    place: Mat12,
    /// ∂q̇/∂(position, attitude).
    sway: Mat12,
    /// ∂q̇/∂(velocity, rate).
    rate: Mat12,
    slots: Slots,
}

/// B of one body: from Q to the rates of (velocity, rate).
#[derive(Debug, Clone, Copy)]
pub struct Lower {
    map: Mat12,
    slots: Slots,
}

impl From<&LoadSlopes> for Coupling {
    fn from(slopes: &LoadSlopes) -> Self {
        Self { by_place: slopes.by_place, by_rate: Some(slopes.by_rate) }
    }
}

impl Coupling {
    /// Adds the block that these derivatives give to a matrix with the rows of one body and the columns of another.
    pub fn add_to(&self, matrix: &mut DMatrix<f64>, lower: &Lower, lift: &Lift) {
        let mut add = |column: usize, change: &Vec12| lower.add_to(&mut matrix.column_mut(column), change);
        for (place, column) in lift.slots.places().enumerate() {
            add(column, &self.by_place(lower, lift, place));
        }
        if self.by_rate.is_some() {
            for (place, column) in lift.slots.velocities().enumerate() {
                add(column, &self.by_velocity(lower, lift, place));
            }
        }
    }

    /// The derivative of the rates of (velocity, rate) of one body by a number of the other; none by one that is
    /// neither place nor velocity.
    pub(in super::super) fn along(&self, lower: &Lower, lift: &Lift, number: usize) -> Option<Vec12> {
        let velocities = lift.slots.velocities();
        match number {
            place if lift.slots.places().contains(&place) => Some(self.by_place(lower, lift, place)),
            velocity if velocities.contains(&velocity) => {
                Some(self.by_velocity(lower, lift, velocity - velocities.start))
            }
            _ => None,
        }
    }

    /// The same by one of the numbers (velocity, rate).
    pub(in super::super) fn by_velocity(&self, lower: &Lower, lift: &Lift, place: usize) -> Vec12 {
        let by_rate = self.by_rate.as_ref();
        by_rate.map_or_else(Vec12::zeros, |by_rate| image(&lower.map, &image(by_rate, &lift.rate.column(place).into())))
    }

    /// The change of these rates with a change of all numbers (velocity, rate).
    pub(in super::super) fn along_velocities(&self, lower: &Lower, lift: &Lift, change: &[f64]) -> Vec12 {
        let mut along = Vec12::zeros();
        change.iter().enumerate().for_each(|(place, change)| along += *change * lift.rate.column(place));
        self.by_rate.as_ref().map_or_else(Vec12::zeros, |by_rate| image(&lower.map, &image(by_rate, &along)))
    }

    /// The derivative of the rates of (velocity, rate) of one body by one of the numbers (position, attitude) of the
    /// other.
    pub(in super::super) fn by_place(&self, lower: &Lower, lift: &Lift, place: usize) -> Vec12 {
        let mut change = image(&self.by_place, &lift.place.column(place).into());
        if let Some(by_rate) = &self.by_rate {
            change += image(by_rate, &lift.sway.column(place).into());
        }
        image(&lower.map, &change)
    }
}

/// The image of a vector, most of whose entries are zero.
fn image(matrix: &Mat12, vector: &Vec12) -> Vec12 {
    let mut image = Vec12::zeros();
    for (column, entry) in matrix.column_iter().zip(vector.iter()).filter(|(_, entry)| **entry != 0.0) {
        image.iter_mut().zip(column.iter()).for_each(|(sum, part)| *sum += part * entry);
    }
    image
}

/// (a | A) as a vector of twelve.
fn packed(force: &Vec3, moment: &Mat3) -> Vec12 {
    numbers(&Loads { force: *force, moment: *moment })
}

impl Lift {
    /// Of a body at an instant whose block has what its state has: no velocities without inertia.
    pub(super) fn of_state(at: &MotionAt) -> Self {
        Self { slots: Slots::of(at.body, 0), ..Self::of(at) }
    }

    /// A of a change of the rates of (velocity, rate): that of q̈.
    pub(in super::super) fn raised(&self, change: &Vec12) -> Vec12 {
        image(&self.rate, change)
    }

    /// Aᵀ of (f | M): what it does along each of (velocity, rate).
    pub(in super::super) fn lowered(&self, loads: &Vec12) -> Vec12 {
        self.rate.tr_mul(loads)
    }

    /// The change of q and q̇ with a number of the block; none with one that is neither place nor velocity.
    pub(in super::super) fn along(&self, number: usize) -> Option<[Vec12; 2]> {
        let velocities = self.slots.velocities();
        match number {
            place if self.slots.places().contains(&place) => {
                Some([self.place.column(place).into(), self.sway.column(place).into()])
            }
            velocity if velocities.contains(&velocity) => {
                Some([Vec12::zeros(), self.rate.column(velocity - velocities.start).into()])
            }
            _ => None,
        }
    }

    /// Of a body at an instant, with velocities; its block begins at 0.
    pub fn of(at: &MotionAt) -> Self {
        let slots = Slots::with_inertia(at.body, 0);
        let (mut place, mut sway, mut rate) = (Mat12::zeros(), Mat12::zeros(), Mat12::zeros());
        let free = slots.position().len();
        for axis in 0..free {
            place[(axis, axis)] = 1.0;
            rate[(axis, axis)] = 1.0;
        }
        // A pinned centre follows P.
        let arm = at.body.pin.as_ref().map_or_else(Vec3::zeros, |pin| pin.point);
        let whole = |gradient: &Mat3| packed(&-(gradient * arm), gradient);
        match at.kind() {
            KindAt::Rigid(_, turn) => {
                let (rotation, spin) = (&at.motion.placement.gradient, cross_matrix(&turn.spin));
                let turned = |axis: &Vec3| rotation * cross_matrix(axis);
                for (k, by_component) in turn.quaternion.turn_by_component().column_iter().enumerate() {
                    let turned = turned(&by_component.into_owned());
                    place.set_column(free + k, &whole(&turned));
                    sway.set_column(free + k, &whole(&(turned * spin)));
                }
                for k in 0..3 {
                    rate.set_column(free + k, &whole(&turned(&Vec3::ith(k, 1.0))));
                }
            }
            KindAt::Affine(..) | KindAt::Contractile(..) => {
                for k in 0..9 {
                    let column = whole(&crate::load::unit(k));
                    place.set_column(free + k, &column);
                    rate.set_column(free + k, &column);
                }
            }
        }
        Self { place, sway, rate, slots }
    }
}

impl Lower {
    /// Adds a change of the rates of (velocity, rate) to a column of the block of the body.
    pub(in super::super) fn add_to(&self, column: &mut DVectorViewMut<f64>, change: &Vec12) {
        let rows = self.slots.velocities();
        column.rows_mut(rows.start, rows.len()).iter_mut().zip(change.iter()).for_each(|(sum, part)| *sum += part);
    }

    /// B of (f | M): the change of the rates of (velocity, rate).
    pub(in super::super) fn rates(&self, loads: &Vec12) -> Vec12 {
        image(&self.map, loads)
    }

    /// Of a body at an instant; its block begins at 0.
    pub fn of(at: &MotionAt) -> Self {
        let mut lower = Self::free(at);
        if let Some(guided) = Guided::at(at) {
            let count = lower.slots.velocities().len();
            lower.map.column_iter_mut().for_each(|mut column| guided.hold(&mut column.as_mut_slice()[..count]));
        }
        lower
    }

    /// The same without the guide of the body.
    pub(super) fn free(at: &MotionAt) -> Self {
        let slots = Slots::with_inertia(at.body, 0);
        let columns: [Vec12; 12] = match at.kind() {
            KindAt::Rigid(inertia, turn) => {
                std::array::from_fn(|k| turned(at, inertia, turn, &loads(&Vec12::ith(k, 1.0))))
            }
            KindAt::Affine(affine, gyration) => match AffineHistory::of(at, affine, gyration) {
                Some(sphere) => std::array::from_fn(|k| remembered(&sphere, &loads(&Vec12::ith(k, 1.0)))),
                None => dispatch_f64x4(Deforming { at, affine, gyration }),
            },
            KindAt::Contractile(contractile, gyration, decomposition) => {
                dispatch_f64x4(ContractileMotion { at, contractile, gyration, decomposition })
            }
        };
        Self { map: Mat12::from_columns(&columns), slots }
    }
}

/// M about the pin, if there is one.
fn about_pin(at: &MotionAt, loads: &Loads) -> Mat3 {
    match &at.body.pin {
        None => loads.moment,
        Some(pin) => loads.moment - loads.force * pin.point.transpose(),
    }
}

/// (δp̈₀, δΩ̇) of a rigid body.
fn turned(at: &MotionAt, inertia: &RigidInertia, turn: &Turn, change: &Loads) -> Vec12 {
    let (mass, inverse) = match RigidHistory::of(at, turn) {
        Some(sphere) => (sphere.mass(), sphere.inverse(inertia)),
        None => (at.body.solid.mass.mass, inertia.inverse),
    };
    let about = Loads { force: change.force, moment: about_pin(at, change) };
    let angular = inverse * about.body_torque(&at.motion.placement.gradient);
    stacked(at, &(change.force / mass), angular.as_slice())
}

/// (δp̈₀, δP̈) of an affine sphere that the fluid remembers.
fn remembered(sphere: &AffineHistory, change: &Loads) -> Vec12 {
    packed(&(change.force / sphere.mass()), &sphere.inertia.along_moment(&change.moment))
}

/// The accelerations of a slot after those of the centre, which a pinned body does not have.
fn stacked(at: &MotionAt, linear: &Vec3, own: &[f64]) -> Vec12 {
    let linear = linear.as_slice().iter().filter(|_| at.body.pin.is_none());
    let mut stacked = Vec12::zeros();
    stacked.iter_mut().zip(linear.chain(own)).for_each(|(out, number)| *out = *number);
    stacked
}

/// An affine body at an instant.
struct Deforming<'a> {
    at: &'a MotionAt<'a>,
    affine: &'a Affine,
    gyration: &'a Gyration,
}

/// (δp̈₀, δP̈) by each number of Q, given δP̈ of δM.
#[inline(always)]
fn deformed<F: F64x4>(at: &MotionAt, acceleration: impl Fn(&SimdMat3) -> SimdMat3<F>) -> [Vec12; 12] {
    std::array::from_fn(|k| {
        let change = loads(&Vec12::ith(k, 1.0));
        let mut own = [0.0; 9];
        acceleration(&SimdMat3::of(&about_pin(at, &change))).write(&mut own);
        stacked(at, &(change.force / at.body.solid.mass.mass), &own)
    })
}

impl WithF64x4 for Deforming<'_> {
    type Output = [Vec12; 12];

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) -> Self::Output {
        let balance = self.affine.interior.slopes_in(zeros, self.gyration, &Mat3::zeros());
        deformed(self.at, |moment| balance.along_moment(moment, zeros))
    }
}

impl WithF64x4 for ContractileMotion<'_> {
    type Output = [Vec12; 12];

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) -> Self::Output {
        let balance = self.slopes_in(zeros, &self.command(), &Mat3::zeros());
        deformed(self.at, |moment| balance.held(&SimdMat3::default(), moment, 0.0))
    }
}
