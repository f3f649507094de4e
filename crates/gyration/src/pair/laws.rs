//! What acts between two bodies, and the moments of their surfaces that it needs.

use super::pull::Pull;
use crate::contact::{Adhesion, AreaMeasure, ContactLaw, Damping, Friction, LawKind, Repulsion};
use crate::surface::{Kernel, MomentPlan, MomentRequest, request};

/// The laws between two bodies: what places the plane, what pulls beside it, and what resists their motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PairLaws {
    /// In which measure of area the tractions are given.
    pub measure: AreaMeasure,
    /// What places the plane: the repulsion, without one what an adhesion repels by.
    pub repulsion: Repulsion,
    /// Whose force that is.
    pub(super) placed_by: LawKind,
    /// What else acts along the normal: adhesion, but for what of it places the plane.
    pub(super) pull: Option<Pull>,
    /// α d₀^ν.
    pub(super) coefficient: f64,
    laws: Vec<ContactLaw>,
    /// Of d^(1−ν), d^−ν and d^−(ν+1).
    pub(super) placing: MomentPlan,
    /// Of d^(1−ν) alone, where the measure has a tension.
    pub(super) tightening: Option<MomentPlan>,
    /// Of d^−(ν+2), to third order.
    pub(super) bent: MomentPlan,
    pub(super) viscous: Vec<ViscousLaw>,
    /// d^−ν′ of each viscous law.
    pub(super) resisting: MomentPlan,
    /// d^−ν′ and d^−(ν′+1) of each.
    pub(super) resisting_slopes: MomentPlan,
}

/// Damping or friction: β (d/d₀)^−ν′.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ViscousLaw {
    pub kind: LawKind,
    /// β d₀^ν′.
    pub coefficient: f64,
    /// ν′.
    pub exponent: f64,
    /// μ of a friction that has a bound.
    pub mu: Option<f64>,
    /// w₀ of a damping that is one-sided [m/s].
    pub release: Option<f64>,
    /// Where its moments stand in the plan `resisting`.
    pub value: usize,
    /// Where those of ν′ and of ν′ + 1 stand in the plan `resisting_slopes`.
    pub slopes: [usize; 2],
}

/// Why laws cannot act between two bodies.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PairLawsError {
    /// Nothing places the plane.
    #[error("no repulsion")]
    NoRepulsion,
    /// A potential does not grow enough towards the plane for it to stay off both bodies.
    #[error("{} has the exponent {exponent}", .kind.name())]
    TooWeak {
        /// Whose potential: of adhesion its attraction.
        kind: LawKind,
        /// ν < 2.
        exponent: f64,
    },
    /// Adhesion per deformed area with a potential.
    #[error("no adhesion per deformed area with a potential between bodies")]
    TautAdhesion,
}

/// The largest power that is taken by products, of as many halves of a rounding.
const MOST_PRODUCTS: f64 = 16.0;

/// The least exponent with which a plane stays off both bodies.
const LEAST_EXPONENT: f64 = 2.0;

impl PairLaws {
    /// Whether damping or friction are among them.
    pub fn feel_velocities(&self) -> bool {
        !self.viscous.is_empty()
    }

    /// Whether the loads are linear in the velocities.
    pub fn is_linear(&self) -> bool {
        self.mu().is_none() && self.release().is_none()
    }

    /// μ, where the friction has a bound.
    pub fn mu(&self) -> Option<f64> {
        self.laws.iter().find_map(ContactLaw::mu)
    }

    /// w₀ [m/s], where the damping is one-sided.
    pub(super) fn release(&self) -> Option<f64> {
        self.laws.iter().find_map(ContactLaw::release)
    }

    /// Joins the laws between two bodies.
    ///
    /// # Errors
    /// [`PairLawsError`]: without repulsion and adhesion, with one of ν < 2, or with an adhesion per deformed area that
    /// has a potential.
    pub fn new(measure: AreaMeasure, laws: Vec<ContactLaw>) -> Result<Self, PairLawsError> {
        let (mut repelling, mut adhesion) = (None, None);
        let mut viscous = Vec::new();
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for law in &laws {
            match law {
                ContactLaw::Repulsion(repulsion) => repelling = Some(*repulsion),
                ContactLaw::Adhesion(law) => adhesion = Some(*law),
                ContactLaw::Damping(Damping { exponent, .. }) | ContactLaw::Friction(Friction { exponent, .. }) => {
                    let coefficient: f64 = law.terms().iter().flatten().map(|term| term.coefficient).sum();
                    if coefficient == 0.0 {
                        continue;
                    }
                    let value = request(&mut values, *exponent, 2);
                    let slopes = [request(&mut slopes, *exponent, 2), request(&mut slopes, exponent + 1.0, 3)];
                    let (kind, mu, release) = (law.kind(), law.mu(), law.release());
                    viscous.push(ViscousLaw { kind, coefficient, exponent: *exponent, mu, release, value, slopes });
                }
            }
        }
        let repelling = repelling.filter(|law| law.alpha > 0.0);
        let adhesion = adhesion.filter(|law: &Adhesion| law.beta > 0.0);
        if let Some(exponent) =
            adhesion.map(|law| law.attractive_exponent).filter(|exponent| *exponent < LEAST_EXPONENT)
        {
            return Err(PairLawsError::TooWeak { kind: LawKind::Adhesion, exponent });
        }
        let placed_by = if repelling.is_some() { LawKind::Repulsion } else { LawKind::Adhesion };
        let repulsion = repelling.or_else(|| adhesion.as_ref().map(repelling_part));
        let repulsion = repulsion.ok_or(PairLawsError::NoRepulsion)?;
        let exponent = repulsion.exponent;
        if exponent < LEAST_EXPONENT {
            return Err(PairLawsError::TooWeak { kind: LawKind::Repulsion, exponent });
        }
        let has_tension = measure == AreaMeasure::DeformedAreaPotential;
        if has_tension && adhesion.is_some() {
            return Err(PairLawsError::TautAdhesion);
        }
        let energy = MomentRequest { kernel: Kernel::Power(exponent - 1.0), order: 0 };
        let mut placing = Vec::new();
        for (order, exponent) in [exponent - 1.0, exponent, exponent + 1.0].into_iter().enumerate() {
            request(&mut placing, exponent, order);
        }
        Ok(Self {
            measure,
            repulsion,
            placed_by,
            pull: adhesion.map(|law| Pull::new(&law, placed_by)),
            coefficient: repulsion.term().coefficient,
            laws,
            placing: MomentPlan::new(placing),
            tightening: has_tension.then(|| MomentPlan::new(vec![energy])),
            bent: MomentPlan::new(vec![MomentRequest { kernel: Kernel::Power(exponent + 2.0), order: 3 }]),
            viscous,
            resisting: MomentPlan::new(values),
            resisting_slopes: MomentPlan::new(slopes),
        })
    }

    /// The laws.
    pub fn laws(&self) -> &[ContactLaw] {
        &self.laws
    }

    /// U_m [J]: no pair of surfaces [m²] has more at a distance D [m].
    ///
    ///   U_m = φ(D) (w_A S_A^−p + w_B S_B^−p)^(−1/p),   φ(D) = α d₀ (D/d₀)^(1−ν)/(ν−1),   p = 1/(ν−1)
    ///
    /// Whatever their shapes, a plane across the shortest way between them has U_i ≤ φ(g_i) S_i with g_A + g_B = D, and
    /// the best g_A : g_B is that of w_i S_i^−p.
    pub(super) fn most(&self, distance: f64, areas: [f64; 2]) -> f64 {
        let Repulsion { alpha, exponent, reference_gap } = self.repulsion;
        let density = alpha * reference_gap * libm::pow(distance / reference_gap, 1.0 - exponent) / (exponent - 1.0);
        let shares = shares(areas);
        let mean: f64 = (0..2).map(|i| shares[i] * libm::pow(areas[i], -1.0 / (exponent - 1.0))).sum();
        density * libm::pow(mean, 1.0 - exponent)
    }
}

/// β (d/d₀)^−ν_r of an adhesion.
fn repelling_part(law: &Adhesion) -> Repulsion {
    Repulsion { alpha: law.beta, exponent: law.repulsive_exponent, reference_gap: law.reference_gap }
}

/// xᵖ; by products where p is a small integer.
pub(super) fn raised(base: f64, exponent: f64) -> f64 {
    let is_integer = exponent.fract() == 0.0 && exponent.abs() <= MOST_PRODUCTS;
    if is_integer { base.powi(exponent as i32) } else { libm::pow(base, exponent) }
}

/// w of surfaces of these areas.
pub(super) fn shares(areas: [f64; 2]) -> [f64; 2] {
    let [above, below] = areas.map(f64::sqrt);
    [below / (above + below), above / (above + below)]
}
