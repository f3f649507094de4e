//! A body with joints at an instant: from its rates to q̈ and back, and how both change with its numbers.
//!
//!   q̈ = A v̇ + Ȧ v,   v̇ = a + B Q
//!
//! v are its numbers (velocity, rate), A and B those of `jacobian/coupling`. Of a rigid body P̈ = R([Ω̇]× + [Ω]×²), of
//! one that deforms P̈ as it stands; a pinned centre follows, p̈₀ = −P̈ r.

use super::super::jacobian::{Lift, Lower};
use super::Vec12;
use crate::body::{BodyKind, Slots};
use crate::instant::{KindAt, MotionAt, jet};
use crate::joint::Jet;
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::Matrix3x4;

/// A body with joints at an instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Member {
    pub index: usize,
    pub slots: Slots,
    /// A and B; none of a free rigid body, unless derivatives are wanted.
    maps: Option<(Lift, Lower)>,
    /// m⁻¹ and I⁻¹, of a rigid body without guide and history.
    mobility: Option<(f64, Mat3)>,
    /// q, q̇ and q̈; p₀ is zero.
    pub jet: Jet,
    /// Of a rigid body R and [Ω]×.
    turn: Option<[Mat3; 2]>,
    /// r, of a pinned body.
    arm: Option<Vec3>,
}

/// (a | A) in three rows.
fn columns(vector: &Vec3, matrix: &Mat3) -> Matrix3x4<f64> {
    let mut columns = Matrix3x4::zeros();
    columns.set_column(0, vector);
    columns.fixed_view_mut::<3, 3>(0, 1).copy_from(matrix);
    columns
}

impl Member {
    /// A body whose velocities do not change.
    pub fn of(at: &MotionAt, wants_slopes: bool) -> Self {
        let turn = match at.kind() {
            KindAt::Rigid(_, turn) => Some([at.motion.placement.gradient, cross_matrix(&turn.spin)]),
            KindAt::Affine(..) | KindAt::Contractile(..) => None,
        };
        let jet = jet(at);
        let slots = Slots::with_inertia(at.body, 0);
        let arm = at.body.pin.as_ref().map(|pin| pin.point);
        let mobility = match &at.body.kind {
            BodyKind::Rigid(inertia) if at.body.guide.is_none() && at.body.history().is_none() => {
                Some((1.0 / at.body.solid.mass.mass, inertia.inverse))
            }
            BodyKind::Rigid(_) | BodyKind::Affine(_) | BodyKind::Contractile(_) => None,
        };
        let maps = (wants_slopes || mobility.is_none()).then(|| (Lift::of(at), Lower::of(at)));
        Self { index: at.index, slots, maps, mobility, jet, turn, arm }
    }

    /// Aᵀ and B of (f | M): what it does along each of (velocity, rate), and their rates.
    pub fn pull_and_response(&self, columns: &Matrix3x4<f64>) -> [Vec12; 2] {
        let loads = || Vec12::from_column_slice(columns.as_slice());
        match (&self.mobility, &self.turn, &self.maps) {
            (Some((mobility, inverse)), Some([rotation, _]), _) => {
                let (force, mut moment) =
                    (columns.column(0).into_owned(), columns.fixed_view::<3, 3>(0, 1).into_owned());
                if let Some(arm) = &self.arm {
                    moment -= force * arm.transpose();
                }
                // M·R[δθ]× = axial(RᵀM)·δθ.
                let torque = axial(&rotation.tr_mul(&moment));
                [self.stacked(&force, &torque), self.stacked(&(force * *mobility), &(inverse * torque))]
            }
            (_, _, Some((lift, lower))) => [lift.lowered(&loads()), lower.rates(&loads())],
            _ => unreachable!("a body that is no free rigid one has its maps"),
        }
    }

    /// (velocity, rate) of a rigid body, which has no velocity where it is pinned.
    fn stacked(&self, linear: &Vec3, angular: &Vec3) -> Vec12 {
        let mut stacked = Vec12::zeros();
        let free = self.slots.velocity().len();
        stacked.as_mut_slice()[..free].copy_from_slice(&linear.as_slice()[..free]);
        stacked.as_mut_slice()[free..free + 3].copy_from_slice(angular.as_slice());
        stacked
    }

    /// Accelerates it by the rates of (velocity, rate).
    pub fn accelerate(&mut self, rates: &[f64]) {
        let own = &rates[self.slots.velocity().len()..];
        let gradient = match &self.turn {
            Some([rotation, spin]) => rotation * (cross_matrix(&Vec3::from_column_slice(own)) + spin * spin),
            None => Mat3::from_column_slice(own),
        };
        let center = match &self.arm {
            Some(arm) => -(gradient * arm),
            None => Vec3::from_column_slice(&rates[..3]),
        };
        self.jet.acceleration = columns(&center, &gradient);
    }

    /// Changes its acceleration with that of the rates of (velocity, rate).
    pub fn accelerate_by(&mut self, change: &Vec12) {
        if let (Some(_), Some([rotation, _])) = (&self.mobility, &self.turn) {
            let free = self.slots.velocity().len();
            let gradient = rotation * cross_matrix(&Vec3::from_column_slice(&change.as_slice()[free..free + 3]));
            let center = match &self.arm {
                Some(arm) => -(gradient * arm),
                None => Vec3::from_column_slice(&change.as_slice()[..3]),
            };
            self.jet.acceleration += columns(&center, &gradient);
        } else if let Some((lift, _)) = &self.maps {
            self.jet.acceleration += Matrix3x4::from_column_slice(lift.raised(change).as_slice());
        }
    }

    /// The change of q, q̇ and q̈ with one of its numbers, the rates of (velocity, rate) as they are.
    pub fn change(&self, number: usize) -> Option<Jet> {
        let [place, rate] = self.maps.as_ref()?.0.along(number)?;
        let [place, rate] = [place, rate].map(|change| Matrix3x4::from_column_slice(change.as_slice()));
        let mut change = Jet { place, rate, acceleration: Matrix3x4::zeros() };
        if let Some([rotation, spin]) = &self.turn {
            let in_body = |change: &Matrix3x4<f64>| rotation.tr_mul(&change.fixed_view::<3, 3>(0, 1).into_owned());
            let gradient = if self.slots.places().contains(&number) {
                // δR = R [δθ]×: R [δθ]× RᵀP̈.
                let own = rotation.tr_mul(&self.jet.acceleration.fixed_view::<3, 3>(0, 1).into_owned());
                rotation * in_body(&change.place) * own
            } else {
                // δṖ = R [δΩ]×.
                let turned = in_body(&change.rate);
                rotation * (turned * spin + spin * turned)
            };
            let center = self.arm.map_or_else(Vec3::zeros, |arm| -(gradient * arm));
            change.acceleration = columns(&center, &gradient);
        }
        Some(change)
    }
}
