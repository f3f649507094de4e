//! Where what a contact may still do to a body is below some energy: a bound that costs a product, in the place of
//! integrals.
//!
//! Of a rigid body with the surface S and the radius r about its centre of mass, all of which is farther than D from a
//! plane at rest, and none of which is faster than u, the force and its work from there to infinity are
//!
//!   |f| ≤ S Σ c_k D^−ν_k,   W ≤ S Σ c_k D^(1−ν_k)/(ν_k − 1)   (2 c_k u of a viscous term)
//!
//! since one-sided damping shifts an approach by as much as that once more.

use super::LawSet;
use crate::kinematics::BodyMotion;
use crate::support::Support;
use crate::surface::Surface;

/// From where on a contact of a rigid body is negligible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Negligible {
    /// D + r [m].
    height: f64,
    /// r [m].
    radius: f64,
    /// The speeds of its fastest point between which it is [m/s].
    speeds: [f64; 2],
}

impl Negligible {
    /// Nowhere.
    pub const NOWHERE: Self = Self { height: f64::INFINITY, radius: 0.0, speeds: [0.0; 2] };

    /// Where W is below an energy [J] as long as the fastest point of the body has a speed between these [m/s].
    pub fn of(laws: &LawSet, surface: &Surface, energy: f64, speeds: [f64; 2]) -> Self {
        let is_known = |number: f64| number > 0.0 && number.is_finite();
        if !is_known(energy) || !speeds.into_iter().all(is_known) {
            return Self::NOWHERE;
        }
        let terms = || laws.terms().iter().map(|planned| planned.term);
        let share = energy / (surface.area() * terms().count() as f64);
        let distances = terms().map(|term| match term.falling_work(speeds[1]) {
            Some((factor, falls)) => libm::pow(factor / (falls * share), 1.0 / falls),
            // That work has no bound.
            None => f64::INFINITY,
        });
        let radius = surface.radius();
        Self { height: radius + distances.fold(0.0, f64::max), radius, speeds }
    }

    /// Whether it is so of a body that moves like this and turns at |Ω| [rad/s].
    #[inline]
    pub fn holds(&self, motion: &BodyMotion, spin: f64, support: &Support) -> bool {
        let height = (motion.placement.position - support.origin).dot(&support.normal);
        let [slow, fast] = self.speeds;
        let fastest = || motion.velocity.velocity.norm() + spin * self.radius;
        height > self.height && support.motion.is_fixed() && (slow..=fast).contains(&fastest())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{
        AreaMeasure, ContactLaw, ContactLoads, Friction, Meeting, RelativeMotion, Repulsion, contact_potential,
    };
    use crate::kinematics::{Placement, Velocity};
    use crate::shape::{Cuboid, Shape};
    use crate::support::SupportMotion;
    use crate::tensor::{Mat3, Vec3};

    fn surface() -> Surface {
        Shape::Box(Cuboid { size: Vec3::new(2.0, 1.0, 0.5) }).surface().unwrap()
    }

    fn repulsion(exponent: f64) -> ContactLaw {
        ContactLaw::Repulsion(Repulsion { alpha: 1e3, exponent, reference_gap: 0.01 })
    }

    fn law_set(laws: Vec<ContactLaw>) -> LawSet {
        LawSet::new(AreaMeasure::ReferenceArea, laws)
    }

    #[test]
    fn nothing_is_negligible_by_what_is_no_number_or_has_no_bound() {
        let height =
            |laws: Vec<ContactLaw>, energy, speeds| Negligible::of(&law_set(laws), &surface(), energy, speeds).height;
        for energy in [0.0, f64::NAN, -1.0, f64::INFINITY] {
            assert_eq!(height(vec![repulsion(6.0)], energy, [0.1, 1.0]), f64::INFINITY, "{energy}");
        }
        assert_eq!(height(vec![repulsion(6.0)], 1.0, [0.1, f64::INFINITY]), f64::INFINITY);
        assert_eq!(height(vec![repulsion(1.0)], 1.0, [0.1, 1.0]), f64::INFINITY);
        // Without laws there is no force.
        assert_eq!(height(Vec::new(), 1.0, [0.1, 1.0]), surface().radius());
    }

    #[test]
    fn beyond_its_distance_what_a_contact_may_do_is_below_the_energy_asked_for() {
        let surface = surface();
        let friction = ContactLaw::Friction(Friction { beta: 20.0, exponent: 4.0, reference_gap: 0.02, mu: None });
        let support = Support {
            name: String::new(),
            origin: Vec3::new(3.0, 1.0, -2.0),
            normal: Vec3::new(0.6, 0.0, 0.8),
            motion: SupportMotion::default(),
        };
        let velocity = Velocity { velocity: Vec3::new(-2.0, 0.5, 1.0), gradient_rate: Mat3::zeros() };
        let speed = velocity.velocity.norm();
        for (laws, energy) in [repulsion(6.0), friction].into_iter().flat_map(|law| [(law, 1e-9), (law, 1e-16)]) {
            let laws = law_set(vec![laws]);
            let negligible = Negligible::of(&laws, &surface, energy, [0.5 * speed, 1.005 * speed]);
            for (off, holds) in [(1.0 + 1e-9, true), (1.0 - 1e-9, false)] {
                let position = support.origin + off * negligible.height * support.normal + Vec3::new(-0.8, 3.0, 0.6);
                let motion = BodyMotion { placement: Placement { position, gradient: Mat3::identity() }, velocity };
                assert_eq!(negligible.holds(&motion, 0.0, &support), holds);
                assert!(!negligible.holds(&motion, 0.01 * speed, &support), "too fast for its bound");
                let slow = Velocity { velocity: 0.4 * velocity.velocity, ..velocity };
                assert!(!negligible.holds(&BodyMotion { velocity: slow, ..motion }, 0.0, &support), "too slow");
                let meeting = Meeting {
                    surface: &surface,
                    field: support.gap_field(&motion.placement, 0.0),
                    motion: RelativeMotion::to(&support, &motion, 0.0),
                    deformation: None,
                };
                let loads = ContactLoads::integrate(&laws, &meeting, &mut Default::default()).unwrap();
                let stored = contact_potential(&laws, &meeting, &mut Default::default()).unwrap();
                let done = if stored > 0.0 { stored } else { loads.total().force.norm() * negligible.height / 3.0 };
                println!("{done:e} J of {energy:e} J at {:.3} m", negligible.height);
                assert!(done < energy && done > 1e-2 * energy, "a bound that is near");
            }
        }
    }
}
