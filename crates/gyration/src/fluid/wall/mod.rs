//! A rigid sphere that feels plane walls through a fluid at rest.
//!
//!   (f | τ) = −η Σ_walls (R_w − R_0) (ṗ₀ | ω)
//!
//! beside the drag −η R_0 that the sphere has alone. Of one wall that is exact (`factors`); of several, and of walls
//! beside other spheres, what each changes is added. A wall can only add to dissipation: R_w − R_0 is positive
//! semi-definite, and so is the sum. Source: `docs/theory-fluid.md`.
//!
//! ```text
//! factors     the resistance in parts of that of a sphere alone, by the height of the centre
//! harmonics   the flow about a sphere that moves along the wall
//! dual        numbers with their derivative
//! ```

mod dual;
mod factors;
mod harmonics;

use super::spheres::{Felt, Line, Mat6, Mat6x3, Scalars, Vec6, of_wrench, parts, spin};
use crate::kinematics::Velocity;
use crate::load::{Loads, Mat12};
use crate::tensor::{Mat3, Vec3};
use dual::Dual;
use factors::WallFactors;
use std::f64::consts::PI;

/// What walls change for a sphere at an instant.
#[derive(Debug, Clone, Copy)]
pub struct WallLoads {
    /// −η Σ (R_w − R_0), and its slopes.
    felt: Felt,
    /// (ṗ₀ | ω).
    motion: Vec6,
    wrench: Vec6,
}

impl WallLoads {
    /// On a sphere of radius R \[m\] and P⁻¹ in a fluid of a viscosity \[Pa s\], beside walls of these normals into the
    /// fluid, each at a height of the centre \[m\] that is above R.
    pub fn of(
        radius: f64,
        viscosity: f64,
        (velocity, inverse): (&Velocity, &Mat3),
        walls: impl Iterator<Item = (f64, Vec3)>,
    ) -> Self {
        let spin = spin(&(velocity.gradient_rate * inverse));
        let motion = Vec6::from_iterator(velocity.velocity.iter().chain(spin.iter()).copied());
        let (mut by_slip, mut by_place) = (Mat6::zeros(), Mat6x3::zeros());
        for (height, normal) in walls {
            let [value, slope] = excess(radius, height);
            let line = Line::from_plane(&normal, height);
            by_slip -= viscosity * value.block(&line);
            let change = -viscosity * (slope.block(&line) * motion);
            for axis in 0..3 {
                let mut column = by_place.column_mut(axis);
                column += normal[axis] * change;
            }
        }
        Self { felt: Felt { by_slip, by_place }, motion, wrench: by_slip * motion }
    }

    /// Force \[N\] and torque \[N m\] in the axes of space.
    pub fn wrench(&self) -> (Vec3, Vec3) {
        parts(&self.wrench)
    }

    /// f and M on the sphere of the gradient P.
    pub fn loads(&self, gradient: &Mat3) -> Loads {
        of_wrench(&self.wrench, gradient)
    }

    /// The power that walls add to dissipation \[W\].
    pub fn dissipation(&self) -> f64 {
        -self.wrench.dot(&self.motion)
    }

    /// ∂Q/∂q and ∂Q/∂q̇ of a sphere of P, P⁻¹ and Ṗ.
    pub fn slopes(&self, gradient: &Mat3, (inverse, rate): (&Mat3, &Mat3)) -> [Mat12; 2] {
        self.felt.coupling(Some(&self.wrench().1), gradient, (inverse, rate))
    }
}

/// R_w − R_0 for viscosity 1 as the numbers of a block, and their derivatives by the height.
fn excess(radius: f64, height: f64) -> [Scalars; 2] {
    let factors = WallFactors::at(height / radius);
    let (force, cube) = (6.0 * PI * radius, 8.0 * PI * radius * radius * radius);
    let square = cube / radius;
    let one = Dual::constant(1.0);
    let parts = [
        force * (factors.normal - one),
        force * (factors.along - one),
        square * factors.coupling,
        cube * (factors.spin - one),
        cube * (factors.roll - one),
    ];
    let scalars = |of: &dyn Fn(&Dual) -> f64| {
        let [xa, ya, yb, xc, yc] = parts.each_ref().map(of);
        Scalars { xa, ya, yb, yb_back: yb, xc, yc }
    };
    [scalars(&|part| part.value), scalars(&|part| part.slope / radius)]
}
