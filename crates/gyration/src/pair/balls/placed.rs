//! Two balls whose plane is found: the slab between them, what they do to each other, and its derivatives.

use super::along::Along;
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

/// f·v + M·Ṗ [W].
fn power(on: &Loads, Velocity { velocity, gradient_rate }: &Velocity) -> f64 {
    on.force.dot(velocity) + on.moment.dot(gradient_rate)
}

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
        let pushed = Along::of_repulsion(&repelled, &switch);
        let (mut loads, _) = self.pushed(laws, sides, (&repelled, &switch), &pushed)?;
        self.resist(laws, sides, (&repelled, &switch), room, &mut loads);
        Ok(loads)
    }

    /// What repulsion and adhesion do, given the former and how it begins, and both along the line of centres.
    fn pushed(
        &self,
        laws: &PairLaws,
        sides: [&Side; 2],
        (repelled, switch): (&Repelled, &Switch),
        repulsion: &Along,
    ) -> Result<(PairLoads, Along), PairFault> {
        let energy = switch.value * repelled.energy;
        let mut loads = PairLoads {
            on: self.on(sides, repulsion),
            energy,
            stored: energy,
            powers: [0.0; LawKind::COUNT],
            gap: self.gaps[0] + self.gaps[1],
            normal: self.normal,
            point: sides[0].placement.position + self.plane().offset * self.normal,
        };
        let power = |on: &[Loads; 2]| power(&on[0], sides[0].velocity) + power(&on[1], sides[1].velocity);
        loads.powers[laws.placed_by as usize] = power(&loads.on);
        let Some(pull) = laws.pull.as_ref().filter(|_| switch.slope > 0.0) else { return Ok((loads, *repulsion)) };
        let pulled = self.pulled(pull, repelled)?;
        let adhesion = pulled.within(repulsion, self.balls.growth(repelled), switch);
        let on = self.on(sides, &adhesion);
        loads.powers[LawKind::Adhesion as usize] += power(&on);
        loads.on.iter_mut().zip(on).for_each(|(sum, on)| *sum += on);
        loads.energy += switch.value * pulled.energy;
        loads.stored += switch.value * pulled.stored;
        Ok((loads, repulsion.plus(&adhesion)))
    }

    /// (f | M) of what acts along the line of centres.
    fn on(&self, sides: [&Side; 2], along: &Along) -> [Loads; 2] {
        let normal = &self.normal;
        [0, 1].map(|i| Loads {
            force: SIGNS[i] * along.force * normal,
            moment: -along.moments[i] * normal * sides[i].placement.gradient.tr_mul(normal).transpose(),
        })
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
        let force_by_gap = switch.slope * (stiffness + bend);
        let mut repulsion = Along { force_by_gap, ..Along::of_repulsion(&repelled, &switch) };
        repulsion.moments_by_gap = [0, 1].map(|i| {
            let lever = repelled.balls[i].lever();
            force_by_gap * lever + repulsion.force * levers_by_gap[i]
        });
        let (loads, along) = self.pushed(laws, sides, (&repelled, &switch), &repulsion)?;
        let Along { force, force_by_gap: stiffness, .. } = along;
        let by_place = &mut slopes.by_place;
        for side in 0..2 {
            let gradient = &sides[side].placement.gradient;
            let point = gradient.tr_mul(normal);
            let (moment, by_gap) = (along.moments[side], along.moments_by_gap[side]);
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
        slopes.loads = loads;
        let push = [repulsion.force, repulsion.force_by_gap];
        let pressed = Pressed { repelled: &repelled, switch: &switch, push, stiffness: &unswitched };
        self.resist_with_slopes(laws, sides, &pressed, room, slopes);
        Ok(())
    }
}
