//! Adhesion between two rigid balls: what `pulled` says, along the line of centres.
//!
//! With a_i the gaps to the plane and F_i^m what a power pulls a ball by at a fixed plane,
//!
//!   F = −dW/dg = Σ h_i F_i,   F_i = Σ ± W_m s_i^m φ_i^m,   h_i = da_i/dg
//!   h_A = k_B/(k_A + k_B),   k_i = s_i [v_i″/v_i − (1+q) φ_i²],   φ = −v′/v
//!
//! The levers are those of the forces F_i and of what the shift of the plane brings, which has moments of ν + 1.

use super::along::Along;
use super::{Ball, Balls, PlacedBalls, Repelled, decay};
use crate::pair::fault::PairFault;
use crate::pair::placed::Switch;
use crate::pair::pull::{Pull, PullTerm};
use crate::pair::side::SIGNS;

/// What adhesion does to both, without a threshold.
pub(super) struct BallsPulled {
    /// W [J].
    pub energy: f64,
    /// Σ |W| of its powers [J].
    pub stored: f64,
    pub along: Along,
}

/// A number of a ball, and how it changes with the slab.
#[derive(Debug, Clone, Copy, Default)]
struct Changing {
    value: f64,
    slope: f64,
}

impl Changing {
    fn new(value: f64, slope: f64) -> Self {
        Self { value, slope }
    }

    fn times(self, other: Self) -> Self {
        Self::new(self.value * other.value, self.value * other.slope + self.slope * other.value)
    }

    fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(value, (self.slope - value * other.slope) / other.value)
    }

    fn plus(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.slope + other.slope)
    }

    fn scaled(self, by: f64) -> Self {
        Self::new(by * self.value, by * self.slope)
    }
}

/// A power of the gap at both balls, whose gaps change by h_i with the slab.
struct Power {
    /// s.
    parts: [Changing; 2],
    /// φ.
    falls: [Changing; 2],
    /// v″/v.
    bends: [Changing; 2],
    /// U.
    energy: Changing,
    /// a + R − ∫κ(a + R − lever) of d^−m and of d^−(m+1).
    levers: [[Changing; 2]; 2],
}

impl Power {
    fn new(balls: &Balls, repelled: &Repelled, opening: [f64; 2]) -> Self {
        let exponent = balls.exponent;
        let power = 0.5 / (exponent - 1.0);
        let fall = [0, 1].map(|i| balls.fall(&repelled.balls[i]));
        let bend = [0, 1].map(|i| balls.bend(&repelled.balls[i]));
        let third = [0, 1].map(|i| balls.third(&repelled.balls[i]));
        let part = [repelled.part, 1.0 - repelled.part];
        let growth = [0, 1].map(|i| -fall[i] * opening[i]);
        let mean = part[0] * growth[0] + part[1] * growth[1];
        let levers = [0, 1].map(|i| {
            let Ball { gap, radius, .. } = repelled.balls[i];
            let own = exponent - (exponent - 1.0) * bend[i] / (fall[i] * fall[i]);
            let next = 1.0 + exponent - exponent * fall[i] * third[i] / (bend[i] * bend[i]);
            [
                Changing::new(repelled.balls[i].lever(), own * opening[i]),
                Changing::new(gap + radius - exponent * fall[i] / bend[i], next * opening[i]),
            ]
        });
        Self {
            parts: [0, 1].map(|i| Changing::new(part[i], -power * (growth[i] - mean) * part[i])),
            falls: [0, 1].map(|i| Changing::new(fall[i], (fall[i] * fall[i] - bend[i]) * opening[i])),
            bends: [0, 1].map(|i| Changing::new(bend[i], (fall[i] * bend[i] - third[i]) * opening[i])),
            energy: Changing::new(repelled.energy, repelled.energy * mean),
            levers,
        }
    }
}

impl Balls {
    /// The same balls, of a power that pulls.
    fn of_term(&self, law: &PullTerm) -> Self {
        let scale = law.strength * law.reference_gap;
        Self { exponent: law.exponent, scale, reference_gap: law.reference_gap, ..*self }
    }

    /// −v‴/v [1/m³].
    fn third(&self, ball: &Ball) -> f64 {
        let exponent = self.exponent;
        let last = decay(exponent + 1.0, ball.logarithm);
        (exponent - 1.0) * exponent * (exponent + 1.0) * last / (libm::pow(ball.gap, 3.0) * ball.decays[0])
    }
}

impl PlacedBalls<'_> {
    /// What adhesion does to both, given what places the plane.
    ///
    /// # Errors
    /// [`PairFault`] if it is no number.
    pub(super) fn pulled(&self, pull: &Pull, repelled: &Repelled) -> Result<BallsPulled, PairFault> {
        let opening = self.balls.stiffness(repelled).shares;
        let own = Power::new(self.balls, repelled, opening);
        let tough = 1.0 + 0.5 / (self.balls.exponent - 1.0);
        let square = |i: usize| own.falls[i].times(own.falls[i]).scaled(-tough);
        let stiff = [0, 1].map(|i| own.parts[i].times(own.bends[i].plus(square(i))));
        let whole = stiff[0].plus(stiff[1]);
        let opening_of = [1, 0].map(|other: usize| stiff[other].over(whole));
        let (mut energy, mut stored) = (0.0, 0.0);
        let (mut forces, mut moments) = ([Changing::default(); 2], [Changing::default(); 2]);
        for law in pull.terms.iter().flatten() {
            let balls = self.balls.of_term(law);
            let term = Power::new(&balls, &balls.repulsion(self.gaps)?, opening);
            energy += law.sign * term.energy.value;
            stored += term.energy.value;
            for i in 0..2 {
                let force = term.energy.times(term.parts[i]).times(term.falls[i]).scaled(law.sign);
                forces[i] = forces[i].plus(force);
                moments[i] = moments[i].plus(force.times(term.levers[i][0]));
            }
        }
        let force = opening_of[0].times(forces[0]).plus(opening_of[1].times(forces[1]));
        let shift = forces[0].plus(forces[1].scaled(-1.0)).over(whole);
        let moments = [0, 1].map(|i| {
            let [lever, next] = own.levers[i];
            let shifted = own.bends[i].times(next).plus(square(i).times(lever));
            moments[i].plus(own.parts[i].times(shifted).times(shift).scaled(-SIGNS[i]))
        });
        let along = Along {
            force: force.value,
            force_by_gap: force.slope,
            moments: moments.map(|moment| moment.value),
            moments_by_gap: moments.map(|moment| moment.slope),
        };
        let known = energy.is_finite() && along.force.is_finite();
        if known { Ok(BallsPulled { energy, stored, along }) } else { Err(PairFault::NotFound { decrement: f64::NAN }) }
    }
}

impl BallsPulled {
    /// What is within reach of it, given the repulsion there, −δ log U/δg, and how the pair begins.
    pub fn within(&self, repulsion: &Along, growth: f64, switch: &Switch) -> Along {
        let Self { energy, along, .. } = self;
        let faded = |own: f64, pushed: f64| switch.value * own + switch.lift * energy * pushed;
        let fading = |own: f64, by_gap: f64, pushed: f64, pushed_by_gap: f64| {
            let risen = -along.force - switch.lifting * growth * energy;
            switch.value * by_gap - switch.rise * growth * own + switch.lift * (risen * pushed + energy * pushed_by_gap)
        };
        let of_side =
            |i: usize| (along.moments[i], along.moments_by_gap[i], repulsion.moments[i], repulsion.moments_by_gap[i]);
        Along {
            force: faded(along.force, repulsion.force),
            force_by_gap: fading(along.force, along.force_by_gap, repulsion.force, repulsion.force_by_gap),
            moments: [0, 1].map(|i| faded(along.moments[i], repulsion.moments[i])),
            moments_by_gap: [0, 1]
                .map(of_side)
                .map(|(own, by_gap, pushed, pushed_by_gap)| fading(own, by_gap, pushed, pushed_by_gap)),
        }
    }
}
