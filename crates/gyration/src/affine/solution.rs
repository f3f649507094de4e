//! The balance of an affine body solved at P, Ṗ, M, with what its derivative needs again.
//!
//!   B = M − V(S_e + τ P⁻ᵀ),   P̈ = B J⁻¹ + π V Y
//!
//! Y and π V of an incompressible body as in `constraint`. S_e Pᵀ is symmetric, and made so to the last bit, and an
//! incompressible body's is taken without its middle entry of the diagonal, which the pressure takes over: rounding of
//! a large stress must not turn or swell a stiff body, since nothing would bring it back, and the steps would have to
//! follow that noise. The middle one and not their mean: across a thread, the mean would be that of the pull along it.

use super::constraint::Constraint;
use super::mobility::Mobility;
use super::{AffineBalance, AffineBody, Gyration};
use crate::simd::{F64x4, SimdMat3};

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solution<F> {
    pub mobility: Mobility,
    /// P⁻ᵀ.
    pub across: SimdMat3<F>,
    /// L.
    pub l: SimdMat3<F>,
    /// τ.
    pub kirchhoff: SimdMat3<F>,
    /// S.
    pub stress: SimdMat3<F>,
    /// P̈.
    pub acceleration: SimdMat3<F>,
    pub constraint: Option<Constraint<F>>,
    /// π V, zero without a constraint.
    pub push: f64,
}

impl<F: F64x4> Solution<F> {
    /// Of a body whose elastic Kirchhoff stress is S_e Pᵀ.
    #[inline(always)]
    pub fn new(body: &AffineBody, at: &Gyration, elastic: Option<SimdMat3<F>>, moment: &SimdMat3<F>) -> Self {
        let registers = moment.0[0].0;
        let across = SimdMat3::of(&at.inverse).transpose().with(registers);
        let l = SimdMat3::of(&at.velocity_gradient).with(registers);
        let mut kirchhoff = body.viscosity.stress_at(at.volume_ratio, &l);
        if let Some(friction) = &body.anisotropic {
            kirchhoff += SimdMat3::of(&friction.kirchhoff_stress(at)).with(registers);
        }
        let mobility = Mobility::of(&body.inverse);
        let constraint = body.is_incompressible().then(|| Constraint::new(body, &across));
        let mut straight = kirchhoff;
        let mut taken = 0.0;
        if let Some(elastic) = elastic {
            straight += elastic;
        }
        if constraint.is_some() {
            let [x, y, z] = [straight.at(0, 0), straight.at(1, 1), straight.at(2, 2)];
            taken = x.min(y).max(x.max(y).min(z));
            straight = straight.plus_unit(-taken);
        }
        let mut stress = straight.times(&across);
        let free = *moment - stress * body.volume;
        let mut acceleration = mobility.of_moment(&free);
        let mut push = 0.0;
        if let Some(constraint) = &constraint {
            let rest = constraint.push(&free, l.dot(&l.transpose()));
            acceleration += constraint.way * rest;
            stress += across * (-rest / body.volume);
            push = rest + taken * body.volume;
        }
        Self { mobility, across, l, kirchhoff, stress, acceleration, constraint, push }
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
