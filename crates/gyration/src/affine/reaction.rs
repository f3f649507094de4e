//! Friction and reaction in the derivative of the balance: −V δ(τ P⁻ᵀ) J⁻¹ and (πV) δ(P⁻ᵀ) J⁻¹.
//!
//! With F = P⁻¹, G = F Fᵀ, τ = a sym L + c tr(L) I of which τ_N grows with det P (`viscosity`), Y = P⁻ᵀJ⁻¹:
//!
//!   by Ṗ:  −½Va (P⁻ᵀ δṖᵀ Y + δṖ G J⁻¹) − Vc Y (P⁻ᵀ·δṖ)
//!   by P:  P⁻ᵀ δPᵀ (½Va (FL)ᵀ J⁻¹ − πV Y) + V τ P⁻ᵀ δPᵀ Y + ½Va L δP G J⁻¹
//!          + Vc Y ((FL)ᵀ·δP) − V τ_N Y (P⁻ᵀ·δP)

use super::mobility::Mobility;
use super::solution::Solution;
use super::terms::Entry;
use super::{AffineBody, Gyration};
use crate::simd::{F64x4, SimdMat3, UNIT};

/// The matrices of these terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Reaction {
    /// P⁻ᵀ.
    pub across: SimdMat3,
    /// Y.
    pub way: SimdMat3,
    /// ½Va (FL)ᵀ J⁻¹ − (πV) Y, with what of the elastic stress acts as a pressure.
    pressed: SimdMat3,
    /// V τ P⁻ᵀ, the anisotropic part excepted.
    turned: SimdMat3,
    /// L.
    l: SimdMat3,
    /// ½Va G J⁻¹.
    metric: SimdMat3,
    /// −½Va Y.
    resisting: SimdMat3,
    newtonian: Option<Newtonian>,
}

/// What friction adds that grows with det P, or goes with tr L.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Newtonian {
    /// −V τ_N P⁻ᵀ J⁻¹.
    grown: SimdMat3,
    /// V c Y.
    spread: SimdMat3,
    /// (FL)ᵀ.
    carried: SimdMat3,
}

impl Reaction {
    /// Of a body at its solution, `push` being πV, and (FL)ᵀ.
    #[inline(always)]
    pub fn fill<F: F64x4>(
        &mut self,
        body: &AffineBody,
        at: &Gyration,
        (mobility, solution): (&Mobility, &Solution<F>),
        push: f64,
        carried: &SimdMat3<F>,
    ) {
        let Solution { across, l, constraint, .. } = solution;
        let way = constraint.as_ref().map_or_else(|| mobility.of_moment(across), |constraint| constraint.way);
        let (a, c) = body.viscosity.coefficients(at.volume_ratio);
        let half = 0.5 * body.volume * a;
        self.across = across.kept();
        self.way = way.kept();
        self.pressed = (mobility.of_moment(carried) * half - way * push).kept();
        self.resisting = (way * -half).kept();
        self.l = l.kept();
        // G J⁻¹ = F Y.
        self.metric = (SimdMat3::of(&at.inverse).with(across.0[0].0).times(&way) * half).kept();
        self.turned = (body.viscosity.stress_at(at.volume_ratio, l).times(across) * body.volume).kept();
        self.newtonian = body.viscosity.newtonian().map(|part| {
            let grown = part.stress_at(at.volume_ratio, l).times(across) * -body.volume;
            let spread = way * (body.volume * c);
            Newtonian { grown: mobility.of_moment(&grown).kept(), spread: spread.kept(), carried: carried.kept() }
        });
    }

    /// Of one entry of δP.
    #[inline(always)]
    pub fn by_gradient<F: F64x4>(&self, entry: Entry, registers: F) -> SimdMat3<F> {
        let Self { across, way, pressed, turned, l, metric, newtonian, .. } = self;
        let mut image = entry.crossed(across, pressed, registers) + entry.crossed(turned, way, registers);
        image += entry.straight(l, metric, registers);
        if let Some(Newtonian { grown, spread, carried }) = newtonian {
            image += entry.whole(grown, across, registers) + entry.whole(spread, carried, registers);
        }
        image
    }

    /// Of one entry of δṖ.
    #[inline(always)]
    pub fn by_rate<F: F64x4>(&self, entry: Entry, registers: F) -> SimdMat3<F> {
        let Self { across, resisting, metric, newtonian, .. } = self;
        let mut image = entry.crossed(across, resisting, registers);
        image = image - entry.straight(&SimdMat3(UNIT), metric, registers);
        if let Some(Newtonian { spread, .. }) = newtonian {
            image = image - entry.whole(spread, across, registers);
        }
        image
    }
}
