//! Friction in proportion to the mass, by which free ends of a lattice absorb waves.
//!
//!   q(X) = −γ ρ ṗ(X):   f = −γ m ṗ₀,   M = −γ Ṗ J,   power −2γ T
//!
//! γ [1/s], J = ∫ρ X ⊗ X dV about the centre of mass, T the kinetic energy. A wave of a uniform lattice decays with
//! γ/2. Source: Rayleigh, The Theory of Sound (1877) §82.

use super::{LoadSlopes, Loads};
use crate::kinematics::Velocity;
use crate::mass::MassProperties;
use crate::tensor::{Mat3, Vec3};

/// A friction in proportion to the mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassFriction {
    /// γ [1/s].
    pub rate: f64,
}

impl MassFriction {
    /// f and M on a body of this mass.
    pub fn loads(&self, mass: &MassProperties, velocity: &Velocity) -> Loads {
        let momenta =
            Loads { force: mass.mass * velocity.velocity, moment: velocity.gradient_rate * mass.euler_tensor };
        momenta.scaled(-self.rate)
    }
}

impl LoadSlopes {
    /// Adds a friction in proportion to the mass.
    pub fn add_mass_friction(&mut self, friction: &MassFriction, mass: &MassProperties, velocity: &Velocity) {
        self.loads += friction.loads(mass, velocity);
        let (zeroth, second) = (friction.rate * mass.mass, friction.rate * mass.euler_tensor);
        self.resist(&Mat3::identity(), zeroth, &Vec3::zeros(), &second);
    }
}
