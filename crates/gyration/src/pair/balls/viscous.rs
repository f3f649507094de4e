//! Damping and friction between two rigid balls: what `mediator` says, whose six numbers part by symmetry.
//!
//! About the line of centres a side has M₀ = ∫κ dA and M_⊥ = ½ ∫κ |x_⊥|² dA, and each number of the mediator is weighed
//! by one of them. Two sides that resist by x_A and x_B against what gives way resist one another by x_A x_B/(x_A +
//! x_B): D₀ and D_⊥ of damping, F₀ and F_⊥ of friction, k = 2F_⊥. With v = v_A − v_B, ω = ω_A − ω_B, Π = 1 − n⊗n and h
//! the distance of a centre from the plane,
//!
//!   u = Πv − (h_A ω_A + h_B ω_B)×n
//!   f_A = −D₀ (n·v) n − F₀u = −f_B,   τ_i = h_i F₀ n×u − σ_i (D_⊥ Πω + k (n·ω) n)
//!   power of damping −D₀ (n·v)² − D_⊥ |Πω|²,   of friction −F₀u² − k (n·ω)²
//!
//! Torques are about the centres, M = ½ [τ]× P. Coulomb's bound scales F₀ and k (`bound`); one-sided damping has s(n·v)
//! in the place of n·v in f.

use super::bound::BoundedSlip;
use super::moving::{Moving, Resistance, Shifted, column, spin_by_rate};
use super::{Balls, PlacedBalls, Pressed, Repelled, Stiffness};
use crate::contact::LawKind;
use crate::pair::exchange::{PairLoads, PairSlopes};
use crate::pair::laws::{PairLaws, ViscousLaw};
use crate::pair::mediator::Shares;
use crate::pair::placed::Switch;
use crate::pair::side::{SIGNS, Side};
use crate::surface::curved::Sphere;
use crate::surface::{AxialMoments, MomentPlan};
use crate::tensor::{Mat3, cross_matrix};
use nalgebra::SMatrix;

type Mat12x3 = SMatrix<f64, 12, 3>;

/// How much a side resists, and how that changes with the slab.
#[derive(Clone, Copy)]
struct Own {
    value: f64,
    slope: f64,
}

/// x_A x_B/(x_A + x_B), and its change.
fn in_series([above, below]: [Own; 2]) -> Own {
    let sum = above.value + below.value;
    let (part_above, part_below) = (below.value / sum, above.value / sum);
    Own {
        value: above.value * part_above,
        slope: above.slope * part_above * part_above + below.slope * part_below * part_below,
    }
}

/// (f | M) as it is linear in something, given f and τ as they are.
fn columns(force: &Mat3, torque: &Mat3, gradient: &Mat3) -> Mat12x3 {
    let mut columns = Mat12x3::zeros();
    columns.fixed_view_mut::<3, 3>(0, 0).copy_from(force);
    for k in 0..3 {
        let moment = 0.5 * cross_matrix(&torque.column(k).into()) * gradient;
        columns.fixed_view_mut::<9, 1>(3, k).copy_from_slice(moment.as_slice());
    }
    columns
}

impl Balls {
    /// λ of both, where their repulsion is switched on so far.
    fn weights(&self, repelled: &Repelled, switch: &Switch) -> [f64; 2] {
        let parts = [repelled.part, 1.0 - repelled.part];
        [0, 1].map(|i| switch.slope * parts[i] * (repelled.energy / (self.scale * self.value(&repelled.balls[i]))))
    }

    /// The moments of a plan over both.
    fn axial_moments(&self, repelled: &Repelled, plan: &MomentPlan, room: [&mut [AxialMoments]; 2]) {
        for (ball, room) in repelled.balls.iter().zip(room) {
            let (radius, gap) = (ball.radius, ball.gap);
            Sphere { radius }.moments_between((gap, gap + 2.0 * radius), plan, room);
        }
    }
}

impl PlacedBalls<'_> {
    /// Adds what damping and friction do to both.
    pub(super) fn resist(
        &self,
        laws: &PairLaws,
        sides: [&Side; 2],
        (repelled, switch): (&Repelled, &Switch),
        room: &mut [Vec<AxialMoments>; 2],
        loads: &mut PairLoads,
    ) {
        if laws.viscous.is_empty() || switch.slope == 0.0 {
            return;
        }
        let plan = &laws.resisting;
        let [above, below] = rooms(plan, room);
        self.balls.axial_moments(repelled, plan, [above, below]);
        let shares = Shares::of_weights(laws, self.balls.weights(repelled, switch));
        let mut by = Resistance::default();
        for law in &laws.viscous {
            let moments = [&above[law.value], &below[law.value]];
            let own = |pick: fn(&AxialMoments) -> f64| {
                in_series([0, 1].map(|i| Own { value: shares.coefficient(law, i) * pick(moments[i]), slope: 0.0 }))
                    .value
            };
            by.add(law.kind, own(|moments| moments.zeroth), own(|moments| moments.across));
        }
        let moving = Moving::new(self, sides, laws.release());
        if let Some(mu) = laws.mu() {
            let bound = moving.bound(mu, &by, switch.slope * repelled.force);
            by.bind(bound.factor());
        }
        self.add_resistance(sides, &moving, &by, loads);
    }

    fn add_resistance(&self, sides: [&Side; 2], moving: &Moving, by: &Resistance, loads: &mut PairLoads) {
        let force = moving.force(by);
        for side in 0..2 {
            let own = column(&(-SIGNS[side] * force), &moving.torque(side, by), &sides[side].placement.gradient);
            loads.on[side] += own;
        }
        let [damping, friction] = moving.powers(by);
        loads.powers[LawKind::Damping as usize] += damping;
        loads.powers[LawKind::Friction as usize] += friction;
    }

    /// The same with its derivatives: δa_i = share_i δg, δ log λ_i as that of `expansion`.
    pub(super) fn resist_with_slopes(
        &self,
        laws: &PairLaws,
        sides: [&Side; 2],
        pressed: &Pressed,
        room: &mut [Vec<AxialMoments>; 2],
        slopes: &mut PairSlopes,
    ) {
        let Pressed { repelled, switch, push, stiffness: &Stiffness { shares: shares_of_gap, .. } } = *pressed;
        if laws.viscous.is_empty() || switch.slope == 0.0 {
            return;
        }
        let plan = &laws.resisting_slopes;
        let [above, below] = rooms(plan, room);
        self.balls.axial_moments(repelled, plan, [above, below]);
        let shares = Shares::of_weights(laws, self.balls.weights(repelled, switch));
        let weights = self.growth_of_weights(repelled, switch, shares_of_gap);
        let (mut by, mut by_gap) = (Resistance::default(), Resistance::default());
        for law in &laws.viscous {
            let ViscousLaw { kind, exponent, slopes: [value, raised], .. } = *law;
            let own = |pick: fn(&AxialMoments) -> f64| {
                in_series([0, 1].map(|i| {
                    let (moments, coefficient) = ([&*above, &*below][i], shares.coefficient(law, i));
                    let growth = shares.growth(law, i);
                    let growth = growth[0] * weights[0] + growth[1] * weights[1];
                    let value = coefficient * pick(&moments[value]);
                    let fall = exponent * coefficient * pick(&moments[raised]);
                    Own { value, slope: growth * value - shares_of_gap[i] * fall }
                }))
            };
            let (whole, across) = (own(|moments| moments.zeroth), own(|moments| moments.across));
            by.add(kind, whole.value, across.value);
            by_gap.add(kind, whole.slope, across.slope);
        }
        let moving = Moving::new(self, sides, laws.release());
        let bounded = laws.mu().map(|mu| BoundedSlip::new(&moving, mu, [&mut by, &mut by_gap], push));
        self.add_resistance(sides, &moving, &by, &mut slopes.loads);
        self.differentiate(sides, &moving, [&by, &by_gap], shares_of_gap, slopes);
        if let Some(bounded) = &bounded {
            bounded.add_slopes(self, sides, &moving, shares_of_gap, slopes);
        }
    }

    /// δ log λ of both by δg.
    fn growth_of_weights(&self, repelled: &Repelled, switch: &Switch, shares_of_gap: [f64; 2]) -> [f64; 2] {
        let power = 0.5 / (self.balls.exponent - 1.0);
        let falls = [0, 1].map(|i| -self.balls.fall(&repelled.balls[i]) * shares_of_gap[i]);
        let mean = repelled.part * falls[0] + (1.0 - repelled.part) * falls[1];
        falls.map(|fall| (1.0 + power) * (mean - fall) + switch.bend * mean)
    }

    /// Adds the derivatives of f and τ by places and motions.
    fn differentiate(
        &self,
        sides: [&Side; 2],
        moving: &Moving,
        [by, by_gap]: [&Resistance; 2],
        shares_of_gap: [f64; 2],
        slopes: &mut PairSlopes,
    ) {
        let Moving { normal: n, heights, .. } = moving;
        let (along, turn) = (n * n.transpose(), cross_matrix(n));
        let level = Mat3::identity() - along;
        let twisted = by.tilt * level + by.drill * along;
        let gradients = sides.map(|side| &side.placement.gradient);
        let by_rate = slopes.by_rate.get_or_insert(PairSlopes::ZEROS);
        // By v, of A.
        let pushed = -(by.approach * moving.damped_slope * along + by.slip * level);
        let placed = self.along_places(moving, [by, by_gap], shares_of_gap);
        for side in 0..2 {
            let (height, sign, gradient) = (heights[side], SIGNS[side], gradients[side]);
            let torque = height * by.slip * turn;
            let by_velocity = columns(&(sign * pushed), &torque, gradient);
            let by_place = columns(&(sign * placed.0), &placed.1[side], gradient);
            for body in 0..2 {
                let force = -sign * by.slip * heights[body] * turn;
                let torque = -height * by.slip * heights[body] * level - sign * SIGNS[body] * twisted;
                let by_spin = columns(&force, &torque, gradient);
                let rate = &mut by_rate[side][body];
                let mut columns = rate.fixed_columns_mut::<3>(0);
                columns += SIGNS[body] * by_velocity;
                let mut columns = rate.fixed_columns_mut::<9>(3);
                columns += by_spin * spin_by_rate(gradients[body]);
                let place = &mut slopes.by_place[side][body];
                let mut columns = place.fixed_columns_mut::<3>(0);
                columns += SIGNS[body] * by_place;
                // ω = ½ Σ P e_k × Ṗ e_k, seen the other way.
                let mut columns = place.fixed_columns_mut::<9>(3);
                columns -= by_spin * spin_by_rate(&sides[body].velocity.gradient_rate);
            }
            let torque = 0.5 * cross_matrix(&moving.torque(side, by));
            for k in 0..3 {
                let mut own = slopes.by_place[side][side].fixed_view_mut::<3, 3>(3 + 3 * k, 3 + 3 * k);
                own += torque;
            }
        }
    }

    /// The derivatives of f_A and of τ of both by p_A − p_B: δn = Πδ/D, δg = n·δ.
    fn along_places(
        &self,
        moving: &Moving,
        [by, by_gap]: [&Resistance; 2],
        shares_of_gap: [f64; 2],
    ) -> (Mat3, [Mat3; 2]) {
        let Moving { normal: n, heights, damped, damped_slope, slip, spin, .. } = moving;
        let (mut force, mut torques) = (Mat3::zeros(), [Mat3::zeros(); 2]);
        let drilling = n.dot(spin);
        for axis in 0..3 {
            let Shifted { wider, turned, approached, slipped } = moving.shifted(self, axis, shares_of_gap);
            let damped = damped_slope * approached * n + *damped * turned;
            let pushed = wider * moving.force(by_gap) + by.approach * damped + by.slip * slipped;
            force.set_column(axis, &-pushed);
            let twisted =
                wider * moving.twist(by_gap) + (by.drill - by.tilt) * (turned.dot(spin) * n + drilling * turned);
            let lever = by.slip * (turned.cross(slip) + n.cross(&slipped));
            for side in 0..2 {
                let height = heights[side] * by_gap.slip + shares_of_gap[side] * by.slip;
                let torque = wider * height * n.cross(slip) + heights[side] * lever - SIGNS[side] * twisted;
                torques[side].set_column(axis, &torque);
            }
        }
        (force, torques)
    }
}

/// Room for the moments of a plan over both sides, growing if this is the first use.
fn rooms<'a>(plan: &MomentPlan, room: &'a mut [Vec<AxialMoments>; 2]) -> [&'a mut [AxialMoments]; 2] {
    let count = plan.requests().len();
    room.each_mut().map(|room| {
        if room.len() < count {
            room.resize(count, AxialMoments::default());
        }
        &mut room[..count]
    })
}
