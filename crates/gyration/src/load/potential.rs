//! A potential of one body, V(p₀, P, t) [J].
//!
//!   f = −∂V/∂p₀,   M = −∂V/∂P,   ∂Q/∂q = −∂²V/∂q²
//!
//! Of a rigid body M acts by its turning part, axial(RᵀM); of an incompressible one the pressure takes what M does
//! along cof P. A potential that does not mention t is an energy, else its power f·ṗ₀ + M·Ṗ is booked as a work.

use super::formula::Formula;
use super::{LoadSlopes, Loads, loads};
use crate::kinematics::Placement;
use gyration_expression::{ParseError, Scratch, Undefined};

/// A potential of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct Potential(Formula);

impl Potential {
    /// Reads V of x y z, P_xx … P_zz and t.
    ///
    /// # Errors
    /// [`ParseError`] with the column.
    pub fn parse(text: &str, constants: &[(String, f64)]) -> Result<Self, ParseError> {
        Formula::parse(text, constants).map(Self)
    }

    /// True if it is an energy: V does not mention t.
    pub fn is_energy(&self) -> bool {
        !self.0.uses_time()
    }

    /// True if it acts: V mentions the place.
    pub fn acts(&self) -> bool {
        self.0.uses_place()
    }

    /// V [J].
    ///
    /// # Errors
    /// [`Undefined`] where it has none.
    pub fn energy(&self, placement: &Placement, time: f64, scratch: &mut Scratch) -> Result<f64, Undefined> {
        self.0.value(placement, time, scratch)
    }

    /// f and M.
    ///
    /// # Errors
    /// [`Undefined`] where V has no first derivative.
    pub fn loads(&self, placement: &Placement, time: f64, scratch: &mut Scratch) -> Result<Loads, Undefined> {
        let (_, gradient) = self.0.gradient(placement, time, scratch)?;
        Ok(loads(&-gradient))
    }
}

impl LoadSlopes {
    /// Adds a potential.
    ///
    /// # Errors
    /// [`Undefined`] where V has no second derivative.
    pub fn add_potential(
        &mut self,
        potential: &Potential,
        placement: &Placement,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<(), Undefined> {
        let slopes = potential.0.slopes(placement, time, scratch)?;
        self.loads += loads(&-slopes.gradient);
        self.by_place -= slopes.hessian;
        Ok(())
    }
}
