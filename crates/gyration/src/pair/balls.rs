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

use super::equilibrium::Switch;
use super::exchange::{PairGap, PairLoads};
use super::fault::PairFault;
use super::laws::{PairLaws, shares};
use super::plane::Plane;
use super::side::Side;
use crate::contact::LawKind;
use crate::kinematics::Velocity;
use crate::load::Loads;
use crate::tensor::Vec3;
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
    balls: [Ball; 2],
}

/// Two balls and their plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlacedBalls<'a> {
    balls: &'a Balls,
    /// n, from B to A.
    normal: Vec3,
    /// The distance of their centres [m].
    distance: f64,
    /// The gap of each to the plane [m].
    gaps: [f64; 2],
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
        let turns = |side: &&Side| side.inverse == side.placement.gradient.transpose();
        let rigid = sides.iter().all(|side| side.deformation.is_none() && turns(side));
        rigid.then(|| self.place_rigid(sides))
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

    /// U [J] and the force [N] where they are a slab [m] apart.
    ///
    /// # Errors
    /// [`PairFault`] if they are no numbers.
    pub fn at(&self, gap: f64) -> Result<(f64, f64), PairFault> {
        self.repulsion(self.balance(gap)?).map(|Repelled { energy, force, .. }| (energy, force))
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
        let energy = self.scale * value * libm::pow(part * part / self.shares[0], self.exponent - 1.0);
        if !energy.is_finite() {
            return Err(PairFault::NotFound { decrement: f64::NAN });
        }
        Ok(Repelled { energy, force: energy * part * self.fall(&above), balls: [above, below] })
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
        self.scaled(ball) * libm::pow(ball.gap / self.reference_gap, 2.0 - self.exponent)
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
        PairGap { gap, rate, normal: self.normal, turning, share: self.gaps[0] / gap }
    }

    /// What the repulsion does to both, beginning at an energy [J].
    ///
    /// # Errors
    /// [`PairFault`] if that is no number.
    pub fn loads(&self, sides: [&Side; 2], threshold: f64) -> Result<PairLoads, PairFault> {
        let Self { balls, normal, gaps, .. } = self;
        let Repelled { energy, force, balls: [above, below] } = balls.repulsion(*gaps)?;
        let switch = Switch::at(threshold, energy);
        let force = switch.slope * force;
        let on = |i: usize, sign: f64, lever: f64| Loads {
            force: sign * force * normal,
            moment: -force * lever * normal * sides[i].placement.gradient.tr_mul(normal).transpose(),
        };
        let on = [on(0, 1.0, above.lever()), on(1, -1.0, below.lever())];
        let power = |i: usize| {
            let Velocity { velocity, gradient_rate } = sides[i].velocity;
            on[i].force.dot(velocity) + on[i].moment.dot(gradient_rate)
        };
        let mut powers = [0.0; LawKind::COUNT];
        powers[LawKind::Repulsion as usize] = power(0) + power(1);
        Ok(PairLoads {
            on,
            energy: switch.value * energy,
            powers,
            gap: gaps[0] + gaps[1],
            normal: *normal,
            point: sides[0].placement.position + self.plane().offset * normal,
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::contact::{AreaMeasure, ContactLaw, Repulsion};
    use crate::kinematics::{Placement, Quaternion, Velocity};
    use crate::pair::{PairForm, PairLaws, PairLoads, PairScratch, PairSlopes, Side};
    use crate::surface::Surface;
    use crate::tensor::{Vec3, cross_matrix};
    use std::sync::Arc;

    /// A pair of balls by the formula and by the general method, with what holds their sides.
    struct Meeting {
        surfaces: [Surface; 2],
        placements: [Placement; 2],
        velocities: [Velocity; 2],
        pairs: [PairForm; 2],
    }

    impl Meeting {
        fn new(radii: [f64; 2], exponent: f64, gap: f64, reach: Option<f64>) -> Self {
            let repulsion = Repulsion { alpha: 3.0, exponent, reference_gap: 0.01 };
            let laws = vec![ContactLaw::Repulsion(repulsion)];
            let laws = Arc::new(PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap());
            let surfaces = radii.map(Surface::sphere);
            let closed = PairForm::new(laws, reach, surfaces.each_ref());
            let general = PairForm { balls: None, ..closed.clone() };
            let normal = Vec3::new(1.0, -2.0, 0.5).normalize();
            let gradient = Quaternion::from_axis_angle(&Vec3::new(1.0, 2.0, 3.0), 0.7).rotation();
            let place = |distance: f64| Placement { position: distance * normal, gradient };
            let velocity = |speed: Vec3| Velocity {
                velocity: speed,
                gradient_rate: cross_matrix(&Vec3::new(0.3, 1.0, -2.0)) * gradient,
            };
            Self {
                placements: [place(radii[0] + radii[1] + gap), place(0.0)],
                velocities: [velocity(Vec3::new(0.1, 0.7, 0.2)), velocity(Vec3::new(-1.0, 0.0, 0.4))],
                pairs: [closed, general],
                surfaces,
            }
        }

        fn sides(&self) -> [Side<'_>; 2] {
            [0, 1].map(|i| Side {
                surface: &self.surfaces[i],
                placement: &self.placements[i],
                from_first: self.placements[i].position - self.placements[0].position,
                velocity: &self.velocities[i],
                inverse: self.placements[i].gradient.transpose(),
                deformation: None,
                least_gap: 0.0,
            })
        }

        fn loads(&self) -> [PairLoads; 2] {
            let sides = self.sides();
            [0, 1].map(|i| {
                PairLoads::integrate(&self.pairs[i], sides.each_ref(), None, &mut PairScratch::default()).unwrap()
            })
        }
    }

    #[test]
    fn balls_do_what_the_general_method_says() {
        let (mut energy, mut force, mut rest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for radii in [[1.0, 1.0], [1.0, 0.3], [0.02, 1.5]] {
            for exponent in [2.0, 2.5, 3.0, 6.0, 12.0] {
                for gap in [1e-4, 0.01, 0.3, 5.0] {
                    let meeting = Meeting::new(radii, exponent, gap, None);
                    let [closed, general] = meeting.loads();
                    let push = general.on[0].force.norm();
                    energy = energy.max((closed.energy / general.energy - 1.0).abs());
                    for ((closed, general), radius) in closed.on.iter().zip(&general.on).zip(radii) {
                        force = force.max((closed.force - general.force).norm() / push);
                        rest = rest.max((closed.moment - general.moment).norm() / (push * radius));
                    }
                    rest = rest.max((closed.normal - general.normal).norm() + (closed.gap / general.gap - 1.0).abs());
                    rest = rest.max((closed.powers[0] - general.powers[0]).abs() / (push * 2.0));
                    let sides = meeting.sides();
                    let gaps = meeting
                        .pairs
                        .each_ref()
                        .map(|pair| pair.gap(sides.each_ref(), None, &mut PairScratch::default()).unwrap());
                    rest = rest.max((gaps[0].share - gaps[1].share).abs() + (gaps[0].rate - gaps[1].rate).abs());
                    rest = rest.max((gaps[0].turning - gaps[1].turning).norm());
                }
            }
        }
        println!("balls: energy {energy:.1e}, forces {force:.1e}, planes and the rest {rest:.1e}");
        // A gap of 1e-4 radii is rounded to 2e-12 of it, which the eleventh power makes 2e-11; the general method finds
        // its plane to half of the digits where U is flat.
        assert!(energy < 5e-11 && force < 5e-11 && rest < 1e-8);
    }

    /// −∂U/∂D by differences of sixth order, with a reach and without.
    #[test]
    fn force_is_the_slope_of_the_energy() {
        for (exponent, reach) in [(2.0, None), (2.5, Some(0.4)), (6.0, None), (6.0, Some(0.5)), (12.0, None)] {
            let (radii, gap) = ([0.7, 0.2], 0.02);
            let energy = |gap: f64| Meeting::new(radii, exponent, gap, reach).loads()[0].energy;
            let step = 1e-3 * gap;
            let difference = |k: f64| (energy(gap + k * step) - energy(gap - k * step)) / (2.0 * k * step);
            let slope = 1.5 * difference(1.0) - 0.6 * difference(2.0) + 0.1 * difference(3.0);
            let found = Meeting::new(radii, exponent, gap, reach).loads()[0];
            let force = found.on[0].force.dot(&found.normal);
            println!(
                "nu {exponent}, reach {reach:?}: force {force:e}, slope of the energy off by {:.1e}",
                slope / -force - 1.0
            );
            assert!((slope / -force - 1.0).abs() < 1e-11);
        }
    }

    /// Derjaguin's limit: that of balls of one radius R_A R_B/(R_A + R_B) at the whole gap of one of them from a plane,
    /// a sphere beside which is a half-space.
    #[test]
    fn a_ball_feels_one_that_is_a_million_times_larger_as_a_plane() {
        for (radii, small) in [([1.0, 1e-6], 1), ([1e-6, 1.0], 0)] {
            let gap = 1e-8;
            let meeting = Meeting::new(radii, 6.0, gap, None);
            // By hand: far smaller than the places are large, the gap has no digits in them.
            let balls = meeting.pairs[0].balls.as_ref().unwrap();
            let gaps = balls.balance(gap).unwrap();
            let own = balls.ball(small, gap);
            let plane = balls.scale * balls.value(&own);
            let placed = super::PlacedBalls { balls, normal: Vec3::z(), distance: 1.0, gaps };
            let energy = placed.loads(meeting.sides().each_ref(), 0.0).unwrap().energy;
            let balance = |i: usize| {
                let ball = balls.ball(i, gaps[i]);
                balls.shares[i].sqrt() * libm::pow(balls.value(&ball), -0.1) * balls.fall(&ball)
            };
            println!("{radii:?}: energy over that at a plane {:.9}", energy / plane);
            assert!((energy / plane - 1.0).abs() < 1e-5);
            assert!((balance(0) / balance(1) - 1.0).abs() < 1e-12);
        }
    }

    /// With derivatives the plane is the same, and so are they.
    #[test]
    fn slopes_are_those_of_the_general_method() {
        let meeting = Meeting::new([0.7, 0.2], 6.0, 0.02, None);
        let sides = meeting.sides();
        let [closed, general] = meeting
            .pairs
            .each_ref()
            .map(|pair| PairSlopes::integrate(pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap());
        for i in 0..2 {
            for j in 0..2 {
                let size = general.by_place[i][j].amax();
                assert!((closed.by_place[i][j] - general.by_place[i][j]).amax() < 1e-9 * size);
            }
        }
    }
}
