//! Coulomb's bound on the friction of two balls (`contact/bound`), of which 2R = F₀u² + k (n·ω)² and B = F₀.

use super::PlacedBalls;
use super::moving::{Moving, Resistance, Shifted, column, spin_by_rate};
use crate::contact::{Bound, Sliding};
use crate::load::numbers;
use crate::pair::exchange::PairSlopes;
use crate::pair::side::{SIGNS, Side};
use crate::tensor::Vec3;

/// A friction that has a bound.
pub(super) struct BoundedSlip {
    bound: Bound,
    /// F₀ and k without it.
    viscous: Resistance,
}

impl Resistance {
    /// Scales friction by σ.
    pub fn bind(&mut self, factor: f64) {
        self.slip *= factor;
        self.drill *= factor;
    }
}

impl Moving {
    /// The bound with a coefficient μ, given viscous friction and N [N].
    pub fn bound(&self, mu: f64, by: &Resistance, push: f64) -> Bound {
        let [_, power] = self.powers(by);
        Bound::new(mu, Sliding { lost: -power, resistance: by.slip, push })
    }
}

impl BoundedSlip {
    /// Puts a bound on friction and on its change with the slab, the motion being kept; given N and dN/dg.
    pub fn new(moving: &Moving, mu: f64, [by, by_gap]: [&mut Resistance; 2], [push, by_slab]: [f64; 2]) -> Self {
        let (bound, viscous) = (moving.bound(mu, by, push), by.of_friction());
        let [_, power] = moving.powers(by_gap);
        let change = bound.change(&Sliding { lost: -power, resistance: by_gap.slip, push: by_slab });
        by_gap.bind(bound.factor());
        by_gap.slip += change * viscous.slip;
        by_gap.drill += change * viscous.drill;
        by.bind(bound.factor());
        Self { bound, viscous }
    }

    /// Adds what its factor changes by with the motion, and with places as these change what the motion is.
    pub fn add_slopes(
        &self,
        placed: &PlacedBalls,
        sides: [&Side; 2],
        moving: &Moving,
        shares_of_gap: [f64; 2],
        slopes: &mut PairSlopes,
    ) {
        let Self { bound, viscous } = self;
        let Moving { normal, slip, spin, .. } = moving;
        let torques = [0, 1].map(|side| moving.torque(side, viscous));
        let on = [0, 1].map(|side| {
            let force = -SIGNS[side] * moving.force(viscous);
            numbers(&column(&force, &torques[side], &sides[side].placement.gradient))
        });
        let by_shift = Vec3::from_fn(|axis, _| {
            let Shifted { turned, slipped, .. } = moving.shifted(placed, axis, shares_of_gap);
            let drilled = viscous.drill * normal.dot(spin) * turned.dot(spin);
            let lost = 2.0 * (viscous.slip * slip.dot(&slipped) + drilled);
            bound.change(&Sliding { lost, resistance: 0.0, push: 0.0 })
        });
        let by_rate = slopes.by_rate.get_or_insert(PairSlopes::ZEROS);
        for (side, acting) in on.iter().enumerate() {
            for body in 0..2 {
                by_rate[side][body].ger(bound.by_motion(), acting, &on[body], 1.0);
                let place = &mut slopes.by_place[side][body];
                place.fixed_columns_mut::<3>(0).ger(SIGNS[body], acting, &by_shift, 1.0);
                // ω = ½ Σ P e_k × Ṗ e_k, seen the other way.
                let spun = spin_by_rate(&sides[body].velocity.gradient_rate).tr_mul(&torques[body]);
                place.fixed_columns_mut::<9>(3).ger(-bound.by_motion(), acting, &spun, 1.0);
            }
        }
    }
}
