//! Two balls whose plane is found: the slab between them, what they do to each other, and its derivatives.

use super::{Balls, Pressed, Repelled, Stiffness};
use crate::contact::LawKind;
use crate::kinematics::Velocity;
use crate::load::{Loads, numbers};
use crate::pair::exchange::{PairGap, PairLoads, PairSlopes};
use crate::pair::fault::PairFault;
use crate::pair::laws::PairLaws;
use crate::pair::placed::Switch;
use crate::pair::plane::Plane;
use crate::pair::side::{SIGNS, Side};
use crate::surface::AxialMoments;
use crate::tensor::{Mat3, Vec3};

/// Two balls and their plane.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct PlacedBalls<'a> {
    pub(super) balls: &'a Balls,
    /// n, from B to A.
    pub(super) normal: Vec3,
    /// The distance of their centres [m].
    pub(super) distance: f64,
    /// The gap of each to the plane [m].
    pub(super) gaps: [f64; 2],
}

impl PlacedBalls<'_> {
    /// The plane, from the centre of A.
    pub fn plane(&self) -> Plane {
        Plane { normal: self.normal, offset: -(self.balls.radii[0] + self.gaps[0]) }
    }

    /// The slab between them.
    pub fn gap(&self, sides: [&Side; 2]) -> PairGap {
        let gap = self.gaps[0] + self.gaps[1];
        let apart = sides[0].velocity.velocity - sides[1].velocity.velocity;
        let along = apart.dot(&self.normal);
        let turning = (apart - along * self.normal) / self.distance;
        // The nearest points are at ∓R n; rigid balls do not move them along n.
        let swelling = |i: usize| {
            let Side { velocity, placement, .. } = sides[i];
            let point = placement.gradient.tr_mul(&self.normal);
            self.balls.radii[i] * self.normal.dot(&(velocity.gradient_rate * point))
        };
        let rate = along - swelling(0) - swelling(1);
        PairGap { gap, rate, normal: self.normal, turning, share: self.gaps[0] / gap, sharing: 0.0 }
    }

    /// What the laws do to both, beginning at an energy [J].
    ///
    /// # Errors
    /// [`PairFault`] if that is no number.
    pub fn loads(
        &self,
        laws: &PairLaws,
        sides: [&Side; 2],
        threshold: f64,
        room: &mut [Vec<AxialMoments>; 2],
    ) -> Result<PairLoads, PairFault> {
        let repelled = self.balls.repulsion(self.gaps)?;
        let switch = Switch::at(threshold, repelled.energy);
        let mut loads = self.pushed(sides, &repelled, &switch);
        self.resist(laws, sides, (&repelled, &switch), room, &mut loads);
        Ok(loads)
    }

    /// What the repulsion does, given that at the gaps and how it begins.
    fn pushed(&self, sides: [&Side; 2], repelled: &Repelled, switch: &Switch) -> PairLoads {
        let Self { normal, gaps, .. } = self;
        let Repelled { energy, force, balls, .. } = repelled;
        let force = switch.slope * force;
        let on = [0, 1].map(|i| Loads {
            force: SIGNS[i] * force * normal,
            moment: -force * balls[i].lever() * normal * sides[i].placement.gradient.tr_mul(normal).transpose(),
        });
        let power = |i: usize| {
            let Velocity { velocity, gradient_rate } = sides[i].velocity;
            on[i].force.dot(velocity) + on[i].moment.dot(gradient_rate)
        };
        let mut powers = [0.0; LawKind::COUNT];
        powers[LawKind::Repulsion as usize] = power(0) + power(1);
        PairLoads {
            on,
            energy: switch.value * energy,
            powers,
            gap: gaps[0] + gaps[1],
            normal: *normal,
            point: sides[0].placement.position + self.plane().offset * normal,
        }
    }

    /// The same with its derivatives, along motions of rigid bodies, in the place of derivatives that are zeros.
    ///
    ///   f_A = F n,   M_i = −F l_i n⊗m_i,   m_i = P_iᵀn
    ///   δn = (1 − n⊗n)(δp_A − δp_B)/D,   δg = n·(δp_A − δp_B),   δm_i = P_iᵀδn + δP_iᵀn
    ///
    /// # Errors
    /// [`PairFault`] if they are no numbers.
    pub fn slopes(
        &self,
        laws: &PairLaws,
        sides: [&Side; 2],
        threshold: f64,
        room: &mut [Vec<AxialMoments>; 2],
        slopes: &mut PairSlopes,
    ) -> Result<(), PairFault> {
        let Self { balls, normal, distance, gaps } = self;
        let repelled = balls.repulsion(*gaps)?;
        let switch = Switch::at(threshold, repelled.energy);
        let unswitched = balls.stiffness(&repelled);
        let Stiffness { stiffness, levers_by_gap, .. } = unswitched;
        // χ″ = bend χ′/U, and dU/dg = −F.
        let bend = -switch.bend * repelled.force * balls.growth(&repelled);
        let (force, stiffness) = (switch.slope * repelled.force, switch.slope * (stiffness + bend));
        let by_place = &mut slopes.by_place;
        for side in 0..2 {
            let gradient = &sides[side].placement.gradient;
            let (point, lever) = (gradient.tr_mul(normal), repelled.balls[side].lever());
            let moment = force * lever;
            let by_gap = stiffness * lever + force * levers_by_gap[side];
            for (axis, across) in Mat3::identity().column_iter().enumerate() {
                let along = normal[axis];
                let turned = (across - along * normal) / *distance;
                let pushed = stiffness * along * normal + force * turned;
                let moved = -by_gap * along * normal * point.transpose()
                    - moment * (turned * point.transpose() + normal * gradient.tr_mul(&turned).transpose());
                for body in 0..2 {
                    let force = SIGNS[side] * SIGNS[body] * pushed;
                    by_place[side][body].set_column(axis, &numbers(&Loads { force, moment: SIGNS[body] * moved }));
                }
                // δP = e_axis ⊗ e_k.
                for k in 0..3 {
                    let moment = -moment * along * normal * Vec3::ith(k, 1.0).transpose();
                    let change = Loads { force: Vec3::zeros(), moment };
                    by_place[side][side].set_column(3 + 3 * k + axis, &numbers(&change));
                }
            }
        }
        slopes.loads = self.pushed(sides, &repelled, &switch);
        let push = [force, stiffness];
        let pressed = Pressed { repelled: &repelled, switch: &switch, push, stiffness: &unswitched };
        self.resist_with_slopes(laws, sides, &pressed, room, slopes);
        Ok(())
    }
}
