//! Where the force of a pair begins: at a distance, or at so many gaps at which the two come to rest or turn back.
//!
//!   reach = 25 g₀,   g₀ = max(g_w, g_v),   F(g_w) = W,   U(g_v) = ½ μ v²
//!
//! W the weight of the lighter one, μ the reduced mass, v the largest relative speed of the bodies at the start. F and
//! U are those of two balls, and for other shapes those of the bound U_m (`laws`), above which no pair of surfaces is:
//! the gap of faces with the whole surfaces, and more than the gap of corners. Of bodies that adhere g₀ is no less than
//! the gap at which faces hold each other. Source: `docs/theory-meetings.md`.

use super::balls::Balls;
use super::laws::PairLaws;
use crate::surface::Surface;

/// How many gaps a reach has.
const GAPS: f64 = 25.0;
/// More steps than the secant method takes for a gap of balls, and when it ends.
const MOST_STEPS: usize = 60;
const PRECISION: f64 = 1e-13;

/// Where the force of a pair begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reach {
    /// At a distance [m].
    Length(f64),
    /// At so many gaps at which the two come to rest or turn back.
    Gaps {
        /// What brings them together.
        falling: Falling,
        /// The longest of all bodies for which it is meant, or more [m].
        longest: f64,
        /// Whether that is the reach of any two of them.
        is_common: bool,
    },
}

/// What brings two bodies together.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Falling {
    /// |g| [m/s²].
    pub gravity: f64,
    /// v [m/s].
    pub speed: f64,
}

/// One of two bodies.
#[derive(Debug, Clone, Copy)]
pub struct Mass<'a> {
    /// The surface of the part that meets.
    pub surface: &'a Surface,
    /// The mass of the whole [kg].
    pub mass: f64,
}

/// Where the force of two bodies begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Threshold {
    /// The distance that is said [m].
    pub reach: f64,
    /// From this distance on there is none [m]: the reach, or less.
    pub range: f64,
    /// U_c [J].
    pub energy: f64,
}

impl Threshold {
    /// At a distance [m].
    pub fn at(laws: &PairLaws, reach: f64, surfaces: [&Surface; 2]) -> Self {
        Self { reach, range: reach, energy: laws.most(reach, surfaces.map(Surface::area)) }
    }
}

impl Reach {
    /// The longest distance [m], or more.
    pub fn longest(&self) -> f64 {
        match self {
            Self::Length(reach) => *reach,
            Self::Gaps { longest, .. } => *longest,
        }
    }

    /// The distance for two bodies [m].
    fn of(&self, laws: &PairLaws, bodies: [Mass; 2]) -> f64 {
        match self {
            Self::Length(reach) => *reach,
            Self::Gaps { longest, is_common: true, .. } => *longest,
            Self::Gaps { falling, .. } => Self::of_gaps(falling, laws, bodies),
        }
    }

    /// So many gaps of two bodies [m].
    pub fn of_gaps(falling: &Falling, laws: &PairLaws, bodies: [Mass; 2]) -> f64 {
        GAPS * falling.contact_gap(laws, bodies).max(laws.held_gap().unwrap_or(0.0))
    }

    /// Where the force of two bodies begins. U_c at so many gaps is that of two balls, if they are; else that of U_m,
    /// which balls have at a smaller distance only.
    pub fn threshold(&self, laws: &PairLaws, bodies: [Mass; 2]) -> Threshold {
        let surfaces = bodies.map(|body| body.surface);
        let threshold = Threshold::at(laws, self.of(laws, bodies), surfaces);
        let Some(balls) = balls(laws, surfaces) else { return threshold };
        match self {
            Self::Gaps { .. } => {
                let energy = balls.at(threshold.reach).map_or(threshold.energy, |(energy, _)| energy);
                Threshold { energy, ..threshold }
            }
            Self::Length(reach) => Threshold { range: reach.min(balls.range(threshold.energy)), ..threshold },
        }
    }

    /// The distance from which on two bodies do nothing to each other [m].
    pub fn range(&self, laws: &PairLaws, bodies: [Mass; 2]) -> f64 {
        match self {
            Self::Gaps { .. } => self.of(laws, bodies),
            Self::Length(_) => self.threshold(laws, bodies).range,
        }
    }
}

impl Falling {
    /// Whether it brings anything together.
    pub fn acts(&self) -> bool {
        self.gravity > 0.0 || self.speed > 0.0
    }

    /// g₀, the gap at which two bodies come to rest or turn back, the larger one [m].
    pub fn contact_gap(&self, laws: &PairLaws, bodies: [Mass; 2]) -> f64 {
        let [one, other] = bodies.map(|body| body.mass);
        let weight = self.gravity * one.min(other);
        // A support has an infinite mass.
        let reduced = if other.is_infinite() { 0.5 * one } else { 0.5 * one * other / (one + other) };
        let kinetic = reduced * self.speed * self.speed;
        let law = &laws.repulsion;
        let (exponent, unit) = (law.exponent, law.reference_gap);
        let surfaces = bodies.map(|body| body.surface);
        let of_most = {
            let energy = laws.most(unit, surfaces.map(Surface::area));
            let weighed = unit * libm::pow((exponent - 1.0) * energy / (unit * weight), 1.0 / exponent);
            let turning = unit * libm::pow(energy / kinetic, 1.0 / (exponent - 1.0));
            [(weight, weighed), (kinetic, turning)].map(|(load, gap)| if load > 0.0 { gap } else { 0.0 })
        };
        let Some(balls) = balls(laws, surfaces) else { return of_most[0].max(of_most[1]) };
        let root = |load: f64, start: f64, value: &dyn Fn(f64) -> f64, slope: f64| {
            if load > 0.0 { falling_root(|gap| value(gap) / load, start, slope) } else { 0.0 }
        };
        let energy = |gap: f64| balls.at(gap).map_or(f64::NAN, |(energy, _)| energy);
        let force = |gap: f64| balls.at(gap).map_or(f64::NAN, |(_, force)| force);
        root(weight, of_most[0], &force, 1.0 - exponent).max(root(kinetic, of_most[1], &energy, 2.0 - exponent))
    }
}

/// Two balls about their centres of mass; none of other shapes.
fn balls(laws: &PairLaws, surfaces: [&Surface; 2]) -> Option<Balls> {
    let [Some(one), Some(other)] = surfaces.map(Surface::ball) else { return None };
    Some(Balls::new(laws, [one, other]))
}

/// Where a falling function, nearly a power of this exponent, is one, by the secant method in logarithms; zero where no
/// gap that is a number has so much.
fn falling_root(function: impl Fn(f64) -> f64, start: f64, exponent: f64) -> f64 {
    let height = |place: f64| libm::log(function(libm::exp(place)));
    let mut slope = if exponent < 0.0 { exponent } else { -1.0 };
    let (mut place, mut above) = (libm::log(start), height(libm::log(start)));
    for _ in 0..MOST_STEPS {
        let next = place - above / slope;
        let height = height(next);
        if !height.is_finite() {
            break;
        }
        let is_last = (next - place).abs() < PRECISION;
        if next != place && height != above {
            slope = (height - above) / (next - place);
        }
        (place, above) = (next, height);
        if is_last {
            break;
        }
    }
    if above.abs() < 1e-6 { libm::exp(place) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{AreaMeasure, ContactLaw, Repulsion};
    use crate::tensor::Vec3;
    use std::f64::consts::PI;

    fn laws(alpha: f64, exponent: f64, reference_gap: f64) -> PairLaws {
        let repulsion = ContactLaw::Repulsion(Repulsion { alpha, exponent, reference_gap });
        PairLaws::new(AreaMeasure::ReferenceArea, vec![repulsion]).unwrap()
    }

    /// F = πRα d₀^ν [g^(1−ν) − (g+4R)^(1−ν)]/(ν−1) of equal balls, and its integral.
    #[test]
    fn balls_rest_at_their_weight_and_turn_at_their_energy() {
        let mut worst: f64 = 0.0;
        for exponent in [2.0, 2.5, 6.0, 12.0] {
            for (radius, unit) in [(1.0, 0.01), (1e-3, 1e-5), (500.0, 2000.0)] {
                let (alpha, mass) = (100.0, 3.0);
                let laws = laws(alpha, exponent, unit);
                let surface = Surface::sphere(radius);
                let bodies = [mass, 2.0 * mass].map(|mass| Mass { surface: &surface, mass });
                let power = |gap: f64, n: f64| (gap / unit).powf(n);
                let force = |gap: f64| {
                    let two = power(gap, 1.0 - exponent) - power(gap + 4.0 * radius, 1.0 - exponent);
                    PI * radius * alpha * unit * two / (exponent - 1.0)
                };
                let energy = |gap: f64| {
                    let primitive = |gap: f64| match exponent {
                        2.0 => -unit * (gap / unit).ln(),
                        _ => unit * power(gap, 2.0 - exponent) / (exponent - 2.0),
                    };
                    let all = primitive(gap) - primitive(gap + 4.0 * radius);
                    PI * radius * alpha * unit * all / (exponent - 1.0)
                };
                let gap = 0.003 * unit;
                let weighed = Falling { gravity: force(gap) / mass, speed: 0.0 }.contact_gap(&laws, bodies);
                let speed = (energy(gap) / (0.5 * mass * 2.0 / 3.0)).sqrt();
                let turning = Falling { gravity: 0.0, speed }.contact_gap(&laws, bodies);
                worst = worst.max((weighed / gap - 1.0).abs()).max((turning / gap - 1.0).abs());
                let both = Falling { gravity: 2.0 * force(gap) / mass, speed };
                assert!((both.contact_gap(&laws, bodies) / gap - 1.0).abs() < 1e-9);
                let reach = Reach::Gaps { falling: both, longest: 0.0, is_common: false };
                let begins = reach.threshold(&laws, bodies);
                assert!((begins.reach / (25.0 * gap) - 1.0).abs() < 1e-9);
                assert!((begins.energy / energy(25.0 * gap) - 1.0).abs() < 1e-9, "{exponent} {radius}");
            }
        }
        println!("gaps of balls off by {worst:.1e}");
        assert!(worst < 1e-9);
    }

    /// By the closed form of two balls, which is not used where their gap is large against their radii.
    #[test]
    fn balls_do_nothing_from_their_range_on_and_something_just_within() {
        let mut widest: f64 = 1.0;
        for exponent in [2.0, 2.1, 2.5, 3.0, 6.0, 12.0] {
            for radii in [[1.0, 1.0], [1.0, 0.1], [1e-3, 5.0]] {
                for reach in [1e-3, 0.05, 0.3] {
                    let laws = laws(100.0, exponent, 0.01);
                    let surfaces = radii.map(Surface::sphere);
                    let bodies = [0, 1].map(|i| Mass { surface: &surfaces[i], mass: 1.0 });
                    let begins = Reach::Length(reach).threshold(&laws, bodies);
                    let at_least = laws.most(reach, surfaces.each_ref().map(Surface::area));
                    assert_eq!((begins.reach, begins.energy), (reach, at_least), "the law of a length stays");
                    let balls = balls(&laws, surfaces.each_ref()).unwrap();
                    let energy = |gap: f64| balls.at(gap).unwrap().0;
                    let case = format!("{exponent} {radii:?} {reach}");
                    assert!(begins.range <= reach && energy(begins.range) <= begins.energy * (1.0 + 1e-12), "{case}");
                    if exponent >= 6.0 && reach < 0.1 * radii[0].min(radii[1]) {
                        assert!(energy(0.999 * begins.range) > begins.energy, "{case}");
                        widest = widest.min(begins.range / reach);
                    }
                }
            }
        }
        println!("balls begin at {widest:.2} of a reach and more");
        assert!(widest < 0.5);
    }

    /// Faces with the whole surfaces: F = α S (g/d₀)^−ν, U = F g/(ν−1) of equal bodies.
    #[test]
    fn other_shapes_go_by_the_bound_of_all_surfaces() {
        let laws = laws(245.0, 6.0, 6e-4);
        let surface = Surface::cuboid(&Vec3::new(0.1, 0.05, 0.03));
        let bodies = [2.0, 1.0].map(|mass| Mass { surface: &surface, mass });
        let area = 2.0 * (0.1 * 0.05 + 0.1 * 0.03 + 0.05 * 0.03);
        let gap = 6e-4 * (245.0 * area / 9.81_f64).powf(1.0 / 6.0);
        let weighed = Falling { gravity: 9.81, speed: 0.0 }.contact_gap(&laws, bodies);
        assert!((weighed / gap - 1.0).abs() < 1e-12, "{weighed} {gap}");
        let speed = 0.7;
        let gap = 6e-4 * (245.0 * area * 6e-4 / 5.0 / (0.5 * 2.0 / 3.0 * speed * speed)).powf(0.2);
        let turning = Falling { gravity: 0.0, speed }.contact_gap(&laws, bodies);
        assert!((turning / gap - 1.0).abs() < 1e-12, "{turning} {gap}");
    }
}
