//! Where the force of a contact is below some other: a bound that costs a product, in the place of integrals.
//!
//! Of a rigid body with the surface S and the radius r about its centre of mass, all of which is farther than D from a
//! plane at rest, and none of which is faster than u,
//!
//!   |f| ≤ S Σ c_k D^−ν_k   (c_k u of a viscous term)

use super::{Action, LawSet};
use crate::kinematics::BodyMotion;
use crate::support::Support;
use crate::surface::Surface;

/// From where on the force of a contact of a rigid body is negligible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Negligible {
    /// D + r [m].
    height: f64,
    /// r [m].
    radius: f64,
    /// u [m/s]; infinite where nothing is viscous.
    speed: f64,
}

impl Negligible {
    /// Nowhere.
    pub const NOWHERE: Self = Self { height: f64::INFINITY, radius: 0.0, speed: f64::INFINITY };

    /// Where it is below a force [N] as long as no point of the body is faster than a speed [m/s].
    pub fn of(laws: &LawSet, surface: &Surface, force: f64, speed: f64) -> Self {
        let terms = || laws.terms().iter().map(|planned| planned.term);
        let is_central = |action: Action| action == Action::Central;
        let share = force / (surface.area() * terms().count() as f64);
        let distances = terms().map(|term| {
            let factor = if is_central(term.action) { 1.0 } else { speed };
            libm::pow(term.coefficient.abs() * factor / share, 1.0 / term.exponent)
        });
        let radius = surface.radius();
        let height = radius + distances.fold(0.0, f64::max);
        let speed = if terms().all(|term| is_central(term.action)) { f64::INFINITY } else { speed };
        Self { height, radius, speed }
    }

    /// Whether it is so of a body that moves like this and turns at |Ω| [rad/s].
    #[inline]
    pub fn holds(&self, motion: &BodyMotion, spin: f64, support: &Support) -> bool {
        let height = (motion.placement.position - support.origin).dot(&support.normal);
        let fastest = || motion.velocity.velocity.norm() + spin * self.radius;
        height > self.height && support.motion.is_fixed() && fastest() <= self.speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{AreaMeasure, ContactLaw, ContactLoads, Friction, Meeting, RelativeMotion, Repulsion};
    use crate::kinematics::{Placement, Velocity};
    use crate::shape::{Cuboid, Shape};
    use crate::support::SupportMotion;
    use crate::tensor::{Mat3, Vec3};

    #[test]
    fn beyond_its_distance_a_force_is_below_the_one_asked_for() {
        let shape = Shape::Box(Cuboid { size: Vec3::new(2.0, 1.0, 0.5) });
        let surface = shape.surface().unwrap();
        let laws = LawSet::new(
            AreaMeasure::ReferenceArea,
            vec![
                ContactLaw::Repulsion(Repulsion { alpha: 1e3, exponent: 6.0, reference_gap: 0.01 }),
                ContactLaw::Friction(Friction { beta: 20.0, exponent: 4.0, reference_gap: 0.02, mu: None }),
            ],
        );
        let support = Support {
            name: String::new(),
            origin: Vec3::new(3.0, 1.0, -2.0),
            normal: Vec3::new(0.6, 0.0, 0.8),
            motion: SupportMotion::default(),
        };
        let velocity = Velocity { velocity: Vec3::new(-2.0, 0.5, 1.0), gradient_rate: Mat3::zeros() };
        let fastest = velocity.velocity.norm();
        for force in [1e-2, 1e-9, 1e-16] {
            let negligible = Negligible::of(&laws, &surface, force, fastest);
            for (off, holds) in [(1.0 + 1e-9, true), (1.0 - 1e-9, false)] {
                let position = support.origin + off * negligible.height * support.normal + Vec3::new(-0.8, 3.0, 0.6);
                let placement = Placement { position, gradient: Mat3::identity() };
                let motion = BodyMotion { placement, velocity };
                assert_eq!(negligible.holds(&motion, 0.0, &support), holds);
                assert!(!negligible.holds(&motion, 0.01 * fastest, &support), "too fast for its bound");
                let meeting = Meeting {
                    surface: &surface,
                    field: support.gap_field(&motion.placement, 0.0),
                    motion: RelativeMotion::to(&support, &motion, 0.0),
                    deformation: None,
                };
                let loads = ContactLoads::integrate(&laws, &meeting, &mut Default::default()).unwrap();
                let exerted = loads.total().force.norm();
                println!("{exerted:e} N of {force:e} N at {:.3} m", negligible.height);
                // From as far as its size on it is near.
                assert!(exerted < force && (force > 1e-3 || exerted > 1e-2 * force));
            }
        }
    }
}
