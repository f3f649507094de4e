//! The fluid: its viscosity and density, and the flow that it has far from the bodies.
//!
//!   u∞(x, t) = U∞(t) + L∞(t) x,   tr L∞ = 0
//!
//! x from the origin of space. A flow with tr L∞ ≠ 0 would need sources all over the fluid.

use crate::signal::{Jet, Signal};
use crate::tensor::{Mat3, Vec3};

/// A viscous fluid that fills space.
#[derive(Debug, Clone, PartialEq)]
pub struct Fluid {
    /// η, > 0 \[Pa s\].
    pub viscosity: f64,
    /// ρ_f \[kg/m³\]; 0: no buoyancy, no inertia of the fluid.
    pub density: f64,
    /// U∞ in time, the first column \[m/s\].
    pub velocity: Signal,
    /// L∞ in time \[1/s\].
    pub gradient: Signal,
}

/// The ambient flow at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow {
    /// U∞ \[m/s\].
    pub velocity: Vec3,
    /// L∞ \[1/s\].
    pub gradient: Mat3,
}

impl Flow {
    /// u∞ at a place \[m/s\].
    pub fn at(&self, place: &Vec3) -> Vec3 {
        self.velocity + self.gradient * place
    }
}

impl Fluid {
    /// The ambient flow at a time \[s\].
    pub fn flow(&self, time: f64) -> Flow {
        Flow { velocity: self.velocity.at(time).column(0).into(), gradient: self.gradient.at(time) }
    }

    /// ∂u∞/∂t at a place and a time \[m/s²\], and the part of it that changes with the place \[1/s²\].
    pub fn rate(&self, time: f64, place: &Vec3) -> (Vec3, Mat3) {
        let (Jet { rate: velocity, .. }, Jet { rate: gradient, .. }) =
            (self.velocity.jet(time), self.gradient.jet(time));
        (velocity.column(0) + gradient * place, gradient)
    }

    /// The signals of the flow.
    pub fn signals(&self) -> [&Signal; 2] {
        [&self.velocity, &self.gradient]
    }
}
