//! The balance of an affine body solved at P, Ṗ, M, with what its derivative needs again.
//!
//!   B = M − V(S_e + τ P⁻ᵀ),   P̈ = B J⁻¹ + π V Y
//!
//! Y and π V of an incompressible body as in `constraint`. S_e Pᵀ is symmetric, and made so to the last bit, and an
//! incompressible body's is taken without its mean, which the pressure takes over: rounding of a large stress must not turn
//! or swell a stiff body, since nothing would bring it back, and the steps would have to follow that noise.

use super::constraint::Constraint;
use super::{AffineBalance, AffineBody, Gyration};
use crate::columns::{Columns, UNIT as AXES};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solution {
    /// P⁻ᵀ.
    pub across: Columns,
    /// L.
    pub l: Columns,
    /// τ.
    pub kirchhoff: Columns,
    /// S.
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
        let constraint = body.is_incompressible().then(|| Constraint::new(body, &across));
        let mut straight = kirchhoff;
        let mut mean = 0.0;
        if let Some(elastic) = elastic {
            straight += elastic.times_transposed(&Columns::of(&at.gradient)).symmetric();
        }
        if constraint.is_some() {
            mean = straight.trace() / 3.0;
            straight += Columns(AXES) * -mean;
        }
        let mut stress = straight.times(&across);
        let free = *moment - stress * body.volume;
        let mut acceleration = body.per_inertia(&free);
        let mut push = 0.0;
        if let Some(constraint) = &constraint {
            let rest = constraint.push(&free, l.dot(&l.transpose()));
            acceleration += constraint.way * rest;
            stress += across * (-rest / body.volume);
            push = rest + mean * body.volume;
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
