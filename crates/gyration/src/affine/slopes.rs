//! The derivative of the balance of an affine body, in closed form.
//!
//! With F = P⁻¹, G = F Fᵀ, rows of F as F_A, places (i, A) of a matrix and increments δP = e_j ⊗ e_B:
//!
//!   ∂(V S_v)/∂Ṗ = V [½a (δ_ij G_AB + F_Bi F_Aj) + c F_Ai F_Bj]
//!   ∂(V S_v)/∂P = −V [½a (L_ij G_AB + F_Bi (FL)_Aj) + c F_Ai (FL)_Bj + (τ F_B)_i F_Aj − (τ_N P⁻ᵀ)_iA F_Bj]
//!
//! a, c and the Newtonian part τ_N as in `viscosity`; the elastic part is the tangent of the material. The constraint
//! tr(P̈ F) = tr(L²) is differentiated as it stands: δP̈ = u + s Y, u = (δB + πV δ(P⁻ᵀ)) J⁻¹, and s from
//!
//!   tr(δP̈ F) = Σ 2(FL)_Bj δṖ_jB + Σ (F P̈ F − 2FLL)_Bj δP_jB

use super::anisotropic::FrictionSlopes;
use super::solution::Solution;
use super::{AffineBody, Gyration};
use crate::columns::{Columns, UNIT};
use crate::material::Kept;
use crate::tensor::Mat3;

/// The derivative of the balance at P, Ṗ, M: what its columns are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineSlopes<'a> {
    body: &'a AffineBody,
    solution: Solution,
    material: Option<Kept>,
    friction: Friction<'a>,
    /// (F P̈ F − 2FLL)ᵀ.
    asked_by_gradient: Columns,
}

/// What the friction adds.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Friction<'a> {
    /// ½V a and V c.
    half: f64,
    cross: f64,
    /// G.
    metric: Columns,
    /// (FL)ᵀ.
    carried: Columns,
    /// V τ P⁻ᵀ, the anisotropic part excepted.
    turned: Columns,
    /// V τ_N P⁻ᵀ.
    grown: Option<Columns>,
    anisotropic: Option<FrictionSlopes<'a>>,
}

impl AffineBody {
    /// The derivative of the balance; `moment` is M [N m].
    #[inline]
    pub fn slopes<'a>(&'a self, at: &'a Gyration, moment: &Mat3) -> AffineSlopes<'a> {
        let material = self.material.as_ref().map(|material| material.at(&Columns::of(&at.gradient)));
        let solution = Solution::new(self, at, material.as_ref().map(Kept::stress), &Columns::of(moment));
        let friction = Friction::new(self, at, &solution);
        let Solution { across, l, acceleration, .. } = &solution;
        // Transposed: P⁻ᵀ P̈ᵀ P⁻ᵀ − 2 Lᵀ(FL)ᵀ.
        let straight = across.times_transposed(acceleration).times(across);
        let asked_by_gradient = straight - l.transpose().times(&friction.carried) * 2.0;
        AffineSlopes { body: self, solution, material, friction, asked_by_gradient }
    }
}

impl<'a> Friction<'a> {
    #[inline(always)]
    fn new(body: &'a AffineBody, at: &'a Gyration, solution: &Solution) -> Self {
        let Solution { across, l, .. } = solution;
        let (a, c) = body.viscosity.coefficients(at.volume_ratio);
        let stress = body.viscosity.stress_at(at.volume_ratio, l);
        let newtonian = body.viscosity.newtonian();
        Self {
            half: 0.5 * body.volume * a,
            cross: body.volume * c,
            metric: across.transpose().times(across),
            carried: l.transpose().times(across),
            turned: stress.times(across) * body.volume,
            grown: newtonian.map(|part| part.stress_at(at.volume_ratio, l).times(across) * body.volume),
            anisotropic: body.anisotropic.as_ref().map(|friction| FrictionSlopes::new(friction, at)),
        }
    }
}

impl AffineSlopes<'_> {
    /// ∂B/∂P_jB, M and the pressure kept, with the change of the reaction πV P⁻ᵀ.
    #[inline(always)]
    pub(crate) fn by_gradient(&self, j: usize, b: usize) -> Columns {
        let Solution { across, l, push, .. } = &self.solution;
        let Friction { half, cross, metric, carried, turned, grown, anisotropic } = &self.friction;
        // The reaction turns with P: πV δ(P⁻ᵀ) = −πV (F δP F)ᵀ.
        let mut change = Columns::default();
        for a in 0..3 {
            let along = half * carried.at(j, a) - push * across.at(j, a);
            change.0[a] = (across.0[b] * along + turned.0[b] * across.at(j, a)) + l.0[j] * (half * metric.at(a, b));
        }
        if let Some(grown) = grown {
            change += *across * (cross * carried.at(j, b)) - *grown * across.at(j, b);
        }
        if let Some(material) = &self.material {
            change = change - material.slope(j, b) * self.body.volume;
        }
        if let Some(friction) = anisotropic {
            change = change - Columns::of(&friction.by_gradient(j, b)) * self.body.volume;
        }
        change
    }

    /// ∂B/∂Ṗ_jB.
    #[inline(always)]
    pub(crate) fn by_rate(&self, j: usize, b: usize) -> Columns {
        let Solution { across, .. } = &self.solution;
        let Friction { half, cross, metric, grown, anisotropic, .. } = &self.friction;
        let mut change = Columns::default();
        for a in 0..3 {
            change.0[a] = across.0[b] * (-half * across.at(j, a)) - UNIT[j] * (half * metric.at(a, b));
        }
        if grown.is_some() {
            change = change - *across * (cross * across.at(j, b));
        }
        if let Some(friction) = anisotropic {
            change = change - Columns::of(&friction.by_rate(j, b)) * self.body.volume;
        }
        change
    }

    /// δP̈ along δP_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_gradient(&self, j: usize, b: usize, moment: &Columns) -> Columns {
        self.accelerate(&(*moment + self.by_gradient(j, b)), self.asked_by_gradient.at(j, b)).0
    }

    /// δP̈ along δṖ_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_rate(&self, j: usize, b: usize, moment: &Columns) -> Columns {
        self.accelerate(&(*moment + self.by_rate(j, b)), 2.0 * self.friction.carried.at(j, b)).0
    }

    /// δP̈ where M alone changes.
    #[inline(always)]
    pub(crate) fn along_moment(&self, moment: &Columns) -> Columns {
        self.accelerate(moment, 0.0).0
    }

    /// The changes of P̈ and of the pressure (0 without one) with those of P, Ṗ and M.
    pub fn apply(&self, dp: &Mat3, drate: &Mat3, dmoment: &Mat3) -> (Mat3, f64) {
        let (mut change, mut asked) = (Columns::of(dmoment), 0.0);
        for (j, b) in (0..9).map(|place| (place % 3, place / 3)) {
            let (dp, drate) = (dp[(j, b)], drate[(j, b)]);
            change += self.by_gradient(j, b) * dp + self.by_rate(j, b) * drate;
            asked += self.asked_by_gradient.at(j, b) * dp + 2.0 * self.friction.carried.at(j, b) * drate;
        }
        let (acceleration, push) = self.accelerate(&change, asked);
        (acceleration.matrix(), push / self.body.volume)
    }

    /// δP̈ of δB, where tr(δP̈ F) has to be as asked, and δ(πV).
    #[inline(always)]
    fn accelerate(&self, change: &Columns, asked: f64) -> (Columns, f64) {
        let acceleration = self.body.per_inertia(change);
        match &self.solution.constraint {
            Some(constraint) => {
                let push = constraint.push(change, asked);
                (acceleration + constraint.way * push, push)
            }
            None => (acceleration, 0.0),
        }
    }
}
