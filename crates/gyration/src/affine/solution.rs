//! The balance of an affine body solved at P, Ṗ, M, with what its derivative needs again.
//!
//!   B = M − V(S_e + τ P⁻ᵀ),   P̈ = B J⁻¹ + π V Y
//!
//! Y and π V of an incompressible body as in `constraint`.

use super::constraint::Constraint;
use super::{AffineBalance, AffineBody, Gyration};
use crate::columns::Columns;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solution {
    /// P⁻ᵀ.
    pub across: Columns,
    /// L.
    pub l: Columns,
    /// τ.
    pub kirchhoff: Columns,
    /// S without the pressure.
    pub stress: Columns,
    /// P̈.
    pub acceleration: Columns,
    pub constraint: Option<Constraint>,
    /// π V, zero without a constraint.
    pub push: f64,
}

impl Solution {
    /// Of a body whose elastic stress is S_e.
    #[inline(always)]
    pub fn new(body: &AffineBody, at: &Gyration, elastic: Option<Columns>, moment: &Columns) -> Self {
        let across = Columns::of(&at.inverse).transpose();
        let l = Columns::of(&at.velocity_gradient);
        let mut kirchhoff = body.viscosity.stress_at(at.volume_ratio, &l);
        if let Some(friction) = &body.anisotropic {
            kirchhoff += Columns::of(&friction.kirchhoff_stress(at));
        }
        let mut stress = kirchhoff.times(&across);
        if let Some(elastic) = elastic {
            stress += elastic;
        }
        let free = *moment - stress * body.volume;
        let mut acceleration = body.per_inertia(&free);
        let mut push = 0.0;
        let constraint = body.is_incompressible().then(|| Constraint::new(body, &across));
        if let Some(constraint) = &constraint {
            push = constraint.push(&free, l.dot(&l.transpose()));
            acceleration += constraint.way * push;
        }
        Self { across, l, kirchhoff, stress, acceleration, constraint, push }
    }

    /// What is told of it.
    #[inline(always)]
    pub fn balance(&self, body: &AffineBody) -> AffineBalance {
        AffineBalance {
            acceleration: self.acceleration.matrix(),
            stress: self.stress.matrix(),
            pressure: self.constraint.is_some().then_some(self.push / body.volume),
            dissipation: body.volume * self.kirchhoff.dot(&self.l),
        }
    }
}
