//! The loads on a body that moves homogeneously and their derivatives, in the coordinates q = (p₀ | P).
//!
//! q and the loads Q = (f | M) are 3×4 matrices, columns first p₀ and f, then those of P and M; read column by column
//! they are vectors of twelve, with power Q·q̇. A point X is X̃ = (1; X) on their columns: x = q X̃, and a force F
//! there is Q = F ⊗ X̃. A pinned body has the coordinates P alone: q = P T, T = (−r | I), r = X_p, and Q_p = Q Tᵀ.

use super::{Applied, LinearResistance, Loads, SpringEnd, SpringLoads};
use crate::kinematics::{Placement, Velocity};
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{SMatrix, SVector};

type Mat12 = SMatrix<f64, 12, 12>;

/// Loads and their derivatives by q and by q̇.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadSlopes {
    /// f and M.
    pub loads: Loads,
    /// ∂Q/∂q.
    pub by_place: Mat12,
    /// ∂Q/∂q̇.
    pub by_rate: Mat12,
}

impl Default for LoadSlopes {
    fn default() -> Self {
        Self { loads: Loads::default(), by_place: Mat12::zeros(), by_rate: Mat12::zeros() }
    }
}

/// (a | A) as a vector of twelve.
fn coordinates(vector: &Vec3, matrix: &Mat3) -> SVector<f64, 12> {
    SVector::from_iterator(vector.iter().chain(matrix.iter()).copied())
}

/// How many coordinates a body has.
pub(crate) const COORDINATES: usize = 12;

/// The loads as a vector of twelve.
pub(crate) fn numbers(loads: &Loads) -> SVector<f64, 12> {
    let Loads { force: f, moment: m } = loads;
    SVector::from([f[0], f[1], f[2], m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]])
}

/// The loads of a vector of twelve.
pub(crate) fn loads(numbers: &SVector<f64, 12>) -> Loads {
    let moment = Mat3::from_iterator(numbers.fixed_rows::<9>(3).iter().copied());
    Loads { force: numbers.fixed_rows::<3>(0).into(), moment }
}

impl LoadSlopes {
    /// The change of the loads with δp₀ and δP, velocities kept.
    pub fn along_place(&self, position: &Vec3, gradient: &Mat3) -> Loads {
        loads(&(self.by_place * coordinates(position, gradient)))
    }

    /// The change of the loads with δṗ₀ and δṖ, places kept.
    pub fn along_rate(&self, velocity: &Vec3, gradient_rate: &Mat3) -> Loads {
        loads(&(self.by_rate * coordinates(velocity, gradient_rate)))
    }

    /// Adds those by the motion relative to what turns at ω [rad/s]: δw = δq̇ − [ω]× δq.
    pub fn add_turned(&mut self, relative: &Self, spin: &Vec3) {
        let turning = cross_matrix(spin);
        self.loads += relative.loads;
        self.by_place += relative.by_place;
        self.by_rate += relative.by_rate;
        for column in (0..COORDINATES).step_by(3) {
            let carried = relative.by_rate.fixed_columns::<3>(column) * turning;
            let mut own = self.by_place.fixed_columns_mut::<3>(column);
            own -= carried;
        }
    }

    /// Adds the derivative by one of the twelve coordinates.
    pub fn add_by_place(&mut self, coordinate: usize, slope: &Loads) {
        let mut column = self.by_place.column_mut(coordinate);
        column += numbers(slope);
    }

    /// Adds the derivative by the rate of one of them.
    pub fn add_by_rate(&mut self, coordinate: usize, slope: &Loads) {
        let mut column = self.by_rate.column_mut(coordinate);
        column += numbers(slope);
    }

    /// Adds a resistance that takes the velocities at X to the forces −across · Σ κ X̃⊗X̃, given the moments of κ.
    pub fn resist(&mut self, across: &Mat3, zeroth: f64, first: &Vec3, second: &Mat3) {
        if zeroth == 0.0 {
            return;
        }
        let moment = |a: usize, b: usize| match (a, b) {
            (0, 0) => zeroth,
            (0, k) | (k, 0) => first[k - 1],
            (a, b) => second[(a - 1, b - 1)],
        };
        add_blocks(&mut self.by_rate, across, |a, b| -moment(a, b));
    }

    /// Adds a spring on one of its bodies, while the other end stays.
    pub fn add_spring(&mut self, end: &SpringEnd, spring: &SpringLoads) {
        let at = end.point();
        let point = |a: usize| if a == 0 { 1.0 } else { at[a - 1] };
        self.loads += end.loads(spring);
        add_blocks(&mut self.by_place, &spring.by_place, |a, b| point(a) * point(b));
        add_blocks(&mut self.by_rate, &spring.by_velocity, |a, b| point(a) * point(b));
    }

    /// Adds an affine moment M = Nᵀ P⁻ᵀ: δM = −M (δP P⁻¹)ᵀ… with P⁻¹ given.
    pub fn add_couple(&mut self, moment: &Mat3, inverse: &Mat3) {
        self.loads.moment += moment;
        for coordinate in 0..9 {
            let dp = unit(coordinate);
            // δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
            let slope = Loads { force: Vec3::zeros(), moment: -(moment * dp.transpose() * inverse.transpose()) };
            self.add_by_place(3 + coordinate, &slope);
        }
    }

    /// Adds what a controller applies; P⁻¹ is given. Of it, only the couple changes with P.
    pub fn add_applied(&mut self, applied: &Applied, inverse: &Mat3) {
        self.loads += Loads { force: applied.force, moment: applied.moment };
        self.add_couple(&applied.couple(inverse), inverse);
    }

    /// Adds a load that is linear in the velocities.
    pub fn add_resistance(&mut self, load: &LinearResistance, at: (&Placement, &Mat3, &Velocity)) {
        let (placement, inverse, velocity) = at;
        let gradient = &placement.gradient;
        self.loads += load.loads(gradient, inverse, velocity);
        let along = |dp: &Mat3, velocity_change: &Velocity| {
            numbers(&load.along((gradient, inverse, velocity), dp, velocity_change))
        };
        let still = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        for axis in 0..3 {
            let change = along(&Mat3::zeros(), &Velocity { velocity: Vec3::ith(axis, 1.0), ..still });
            let mut column = self.by_rate.column_mut(axis);
            column += change;
        }
        for coordinate in 0..9 {
            let (by_place, by_rate) = (along(&unit(coordinate), &still), {
                along(&Mat3::zeros(), &Velocity { gradient_rate: unit(coordinate), ..still })
            });
            let mut column = self.by_place.column_mut(3 + coordinate);
            column += by_place;
            let mut column = self.by_rate.column_mut(3 + coordinate);
            column += by_rate;
        }
    }
}

/// The matrix with a one at a place, counted column by column.
pub(crate) fn unit(place: usize) -> Mat3 {
    let mut unit = Mat3::zeros();
    unit[(place % 3, place / 3)] = 1.0;
    unit
}

/// Adds weight(a, b) · block at the 3×3 block (a, b).
pub(crate) fn add_blocks(matrix: &mut Mat12, block: &Mat3, weight: impl Fn(usize, usize) -> f64) {
    for (coordinate, column) in matrix.as_mut_slice().chunks_exact_mut(COORDINATES).enumerate() {
        for (a, part) in column.chunks_exact_mut(3).enumerate() {
            let weight = weight(a, coordinate / 3);
            for (entry, number) in part.iter_mut().zip(&block.as_slice()[3 * (coordinate % 3)..]) {
                *entry += weight * number;
            }
        }
    }
}
