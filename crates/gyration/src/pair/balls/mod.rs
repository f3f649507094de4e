//! Two rigid balls: their plane lies across the line of centres, and where on it is one equation.
//!
//! With a ball of radius R at the gap a from the plane, t = log(1 + 2R/a) and E_m = (1 − e^(−mt))/m,
//!
//!   ∫d^−p dA = 2πR a^(1−p) E_{p−1},   v = U_i/αd₀ = 2πR d₀/(ν−1) (a/d₀)^(2−ν) E_{ν−2}
//!   −v′/v = (ν−1) E_{ν−1}/(a E_{ν−2}),   v″/v = ν(ν−1) E_ν/(a² E_{ν−2})
//!
//! Φ is largest where both sides of the plane gain alike, s_A (log v_A)′ = s_B (log v_B)′ with s = √w v^−q; that is
//! nearly a straight line in the logarithm of a_A : a_B. Then U = U_A w_A^(1−ν) (s_A/Σ)^(1/q) and the force is −U
//! (s_A/Σ) (log v_A)′.

mod along;
mod bound;
mod moving;
mod placed;
mod pulled;
#[cfg(test)]
mod tests;
mod viscous;

pub(super) use placed::PlacedBalls;

use super::fault::PairFault;
use super::laws::{PairLaws, raised, shares};
use super::placed::Switch;
use super::side::Side;
use std::f64::consts::PI;

/// Two balls about their centres of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Balls {
    /// R [m].
    radii: [f64; 2],
    /// w.
    shares: [f64; 2],
    /// ν.
    exponent: f64,
    /// α d₀ [N/m].
    scale: f64,
    /// d₀ [m].
    reference_gap: f64,
    /// log a_A/a_B of balls that nearly touch.
    ratio: f64,
}

/// A ball beside a plane.
#[derive(Debug, Clone, Copy)]
struct Ball {
    /// R and a [m].
    radius: f64,
    gap: f64,
    /// t.
    logarithm: f64,
    /// E_{ν−2} and E_{ν−1}.
    decays: [f64; 2],
}

/// What the repulsion does to both balls.
struct Repelled {
    /// U [J].
    energy: f64,
    /// −dU/dg [N].
    force: f64,
    /// s_A/Σ.
    part: f64,
    balls: [Ball; 2],
}

/// How that changes with the slab, without a threshold.
struct Stiffness {
    /// dF/dg [N/m].
    stiffness: f64,
    /// How the lever of each changes.
    levers_by_gap: [f64; 2],
    /// da/dg of each.
    shares: [f64; 2],
}

/// The repulsion of two balls, as it presses and as that changes with the slab.
struct Pressed<'a> {
    repelled: &'a Repelled,
    switch: &'a Switch,
    /// N [N] and dN/dg [N/m].
    push: [f64; 2],
    stiffness: &'a Stiffness,
}

/// A step of log a_A/a_B behind which the next is rounding, Newton's method being of second order.
const LAST_STEP: f64 = 1e-8;

/// More steps than Newton's method takes.
const MOST_STEPS: usize = 50;

impl Balls {
    /// Of these radii [m].
    pub fn new(laws: &PairLaws, radii: [f64; 2]) -> Self {
        let law = &laws.repulsion;
        let shares = shares(radii.map(|radius| 4.0 * PI * radius * radius));
        let (exponent, scale) = (law.exponent, law.alpha * law.reference_gap);
        // s ∝ √w R^−q a^β with β = (ν−2)q where balls nearly touch.
        let power = 0.5 / (exponent - 1.0);
        let strength = |i: usize| 0.5 * libm::log(shares[i]) - power * libm::log(radii[i]);
        let ratio = (strength(0) - strength(1)) / (1.0 - (exponent - 2.0) * power);
        Self { radii, shares, exponent, scale, reference_gap: law.reference_gap, ratio }
    }

    /// Whether their plane is half-way between them.
    fn are_alike(&self) -> bool {
        self.radii[0] == self.radii[1]
    }

    /// The plane between both; none of bodies that deform, or of a placement that is no rotation.
    ///
    /// # Errors
    /// [`PairFault`] if they touch, or a number of theirs is none.
    pub fn place<'a>(&'a self, sides: [&Side; 2]) -> Option<Result<PlacedBalls<'a>, PairFault>> {
        sides.iter().all(|side| side.is_rigid()).then(|| self.place_rigid(sides))
    }

    fn place_rigid(&self, [above, below]: [&Side; 2]) -> Result<PlacedBalls<'_>, PairFault> {
        let apart = above.from_first - below.from_first;
        let distance = apart.norm();
        let gap = distance - self.radii[0] - self.radii[1];
        let is_open = gap > above.least_gap + below.least_gap;
        if !is_open {
            return Err(PairFault::of_gap(gap));
        }
        let gaps = self.balance(gap)?;
        Ok(PlacedBalls { balls: self, normal: apart / distance, distance, gaps })
    }

    /// The gaps to the plane of least potential, by Newton's method for u = log a_A/a_B.
    ///
    ///   G(u) = log(s_A fall_A) − log(s_B fall_B) = 0,   (log(s fall))′ = (1+q) fall − bend/fall
    fn balance(&self, gap: f64) -> Result<[f64; 2], PairFault> {
        let at = |ratio: f64| [gap / (1.0 + libm::exp(-ratio)), gap / (1.0 + libm::exp(ratio))];
        if self.are_alike() {
            return Ok([0.5 * gap; 2]);
        }
        let power = 0.5 / (self.exponent - 1.0);
        let mut ratio = self.ratio;
        for _ in 0..MOST_STEPS {
            let gaps = at(ratio);
            let balls = [0, 1].map(|i| self.ball(i, gaps[i]));
            let gain = |i: usize| {
                let ball = &balls[i];
                0.5 * libm::log(self.shares[i]) - power * self.log_value(ball) + libm::log(self.fall(ball))
            };
            let steep = |ball: &Ball| (1.0 + power) * self.fall(ball) - self.bend(ball) / self.fall(ball);
            let slope = (steep(&balls[0]) + steep(&balls[1])) * gaps[0] * gaps[1] / gap;
            let step = (gain(0) - gain(1)) / slope;
            ratio -= step;
            if step.is_nan() {
                break;
            }
            if step.abs() < LAST_STEP {
                return Ok(at(ratio));
            }
        }
        Err(PairFault::NotFound { decrement: f64::NAN })
    }

    /// A slab [m] as wide as that or wider has no more than this energy [J]: U of balls of infinite radius is less.
    ///
    ///   v_i ≤ (2πR_i d₀/((ν−1)(ν−2))) (a_i/d₀)^(2−ν),   U ≤ C g^(2−ν),   C = c (Σ (√w_i R_i^−q)^(2(ν−1)/ν))^−ν
    ///   c = 2πα d₀^ν/((ν−1)(ν−2))
    ///
    /// by the plane with the least of such bounds; infinite at ν = 2.
    pub fn range(&self, energy: f64) -> f64 {
        let Self { radii, shares, exponent, scale, reference_gap, .. } = self;
        let part = |i: usize| libm::pow(shares[i], (exponent - 1.0) / exponent) * libm::pow(radii[i], -1.0 / exponent);
        let weighed = 2.0 * PI * scale * libm::pow(part(0) + part(1), -exponent);
        let steepness = (exponent - 1.0) * (exponent - 2.0);
        reference_gap * libm::pow(weighed * reference_gap / (steepness * energy), 1.0 / (exponent - 2.0))
    }

    /// U [J] and the force [N] where they are a slab [m] apart.
    ///
    /// # Errors
    /// [`PairFault`] if they are no numbers.
    pub fn at(&self, gap: f64) -> Result<(f64, f64), PairFault> {
        self.repulsion(self.balance(gap)?).map(|Repelled { energy, force, .. }| (energy, force))
    }

    /// −d log U/dg [1/m], also where U is too small for a number.
    fn growth(&self, repelled: &Repelled) -> f64 {
        repelled.part * self.fall(&repelled.balls[0])
    }

    /// How all this changes with the slab.
    ///
    ///   U = c Σ^(−1/q),   Σ = max s_A(a) + s_B(g − a),   dΣ/dg = s′,   d²Σ/dg² = s_A″ s_B″/(s_A″ + s_B″)
    ///   s′ = q s φ,   s″ = q s ((1+q) φ² − v″/v),   φ = −v′/v,   da/dg = s_B″/(s_A″ + s_B″)
    fn stiffness(&self, repelled: &Repelled) -> Stiffness {
        let power = 0.5 / (self.exponent - 1.0);
        let [above, below] = &repelled.balls;
        let part = repelled.part;
        // s and its second derivative over Σ.
        let parts = [part, 1.0 - part];
        let bent =
            |i: usize, ball: &Ball| power * parts[i] * ((1.0 + power) * self.fall(ball).powi(2) - self.bend(ball));
        let bends = [bent(0, above), bent(1, below)];
        let (slope, bend) = (power * part * self.fall(above), bends[0] * bends[1] / (bends[0] + bends[1]));
        let stiffness = repelled.energy / power * (bend - (1.0 / power + 1.0) * slope * slope);
        let shares = [bends[1], bends[0]].map(|other| other / (bends[0] + bends[1]));
        let lever = |i: usize, ball: &Ball| {
            shares[i] * (self.exponent - (self.exponent - 1.0) * self.bend(ball) / self.fall(ball).powi(2))
        };
        Stiffness { stiffness, levers_by_gap: [lever(0, above), lever(1, below)], shares }
    }

    /// What the repulsion does at the gaps of both to their plane, without a threshold.
    fn repulsion(&self, gaps: [f64; 2]) -> Result<Repelled, PairFault> {
        let above = self.ball(0, gaps[0]);
        let below = if self.are_alike() { above } else { self.ball(1, gaps[1]) };
        let value = self.value(&above);
        let part = match self.are_alike() {
            true => 0.5,
            false => {
                let others = libm::pow(value / self.value(&below), 0.5 / (self.exponent - 1.0));
                1.0 / (1.0 + (self.shares[1] / self.shares[0]).sqrt() * others)
            }
        };
        let energy = self.scale * value * raised(part * part / self.shares[0], self.exponent - 1.0);
        if !energy.is_finite() {
            return Err(PairFault::NotFound { decrement: f64::NAN });
        }
        Ok(Repelled { energy, force: energy * part * self.fall(&above), part, balls: [above, below] })
    }

    /// A ball at a gap from a plane.
    fn ball(&self, i: usize, gap: f64) -> Ball {
        let radius = self.radii[i];
        let logarithm = libm::log1p(2.0 * radius / gap);
        let decays = [2.0, 1.0].map(|less| decay(self.exponent - less, logarithm));
        Ball { radius, gap, logarithm, decays }
    }

    /// v over (a/d₀)^(2−ν).
    fn scaled(&self, ball: &Ball) -> f64 {
        2.0 * PI * ball.radius * self.reference_gap / (self.exponent - 1.0) * ball.decays[0]
    }

    /// v.
    fn value(&self, ball: &Ball) -> f64 {
        self.scaled(ball) * raised(ball.gap / self.reference_gap, 2.0 - self.exponent)
    }

    /// log v, which may be where v is no number.
    fn log_value(&self, ball: &Ball) -> f64 {
        libm::log(self.scaled(ball)) + (2.0 - self.exponent) * libm::log(ball.gap / self.reference_gap)
    }

    /// −v′/v [1/m].
    fn fall(&self, ball: &Ball) -> f64 {
        (self.exponent - 1.0) * ball.decays[1] / (ball.gap * ball.decays[0])
    }

    /// v″/v [1/m²].
    fn bend(&self, ball: &Ball) -> f64 {
        let last = decay(self.exponent, ball.logarithm);
        self.exponent * (self.exponent - 1.0) * last / (ball.gap * ball.gap * ball.decays[0])
    }
}

impl Ball {
    /// How far its tractions act from its centre in the mean, towards the plane [m].
    fn lever(&self) -> f64 {
        self.gap + self.radius - self.gap * self.decays[0] / self.decays[1]
    }
}

/// E_m.
fn decay(m: f64, logarithm: f64) -> f64 {
    if m == 0.0 { logarithm } else { -libm::expm1(-m * logarithm) / m }
}
