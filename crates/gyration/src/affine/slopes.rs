//! The derivative of the balance of an affine body, in closed form.
//!
//! With F = P⁻¹ and B = M − V(S_e + τ P⁻ᵀ) the change of P̈ = B J⁻¹ + πV Y is that of B J⁻¹ at a fixed reaction πV P⁻ᵀ,
//! which turns with P (`elastic`, `reaction`), and a multiple s of Y. The constraint tr(P̈ F) = tr(L²) is
//! differentiated as it stands, and gives s from
//!
//!   tr(δP̈ F) = Σ 2(FL)_Bj δṖ_jB + Σ (F P̈ F − 2FLL)_Bj δP_jB
//!
//! All terms are products of δP with fixed matrices (`terms`), the last of which is divided by J once.

use super::anisotropic::FrictionSlopes;
use super::elastic::Elastic;
use super::kinetic::KineticBalance;
use super::mobility::Mobility;
use super::reaction::Reaction;
use super::solution::Solution;
use super::terms::Entry;
use super::{AffineBody, Gyration};
use crate::load::unit;
use crate::material::{ByInvariants, ByPrincipal};
use crate::simd::{F64x4, SimdMat3};
use crate::tensor::Mat3;

/// The derivative of the balance at P, Ṗ, M: what its columns are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineSlopes<'a> {
    body: &'a AffineBody,
    mobility: Mobility,
    reaction: Reaction,
    elastic: Elastic,
    principal: Option<ByPrincipal>,
    anisotropic: Option<FrictionSlopes<'a>>,
    /// 1/a, of an incompressible body.
    compliance: Option<f64>,
    /// (F P̈ F − 2FLL)ᵀ.
    asked_by_gradient: SimdMat3,
    /// 2(FL)ᵀ.
    asked_by_rate: SimdMat3,
    /// Where B is no longer P̈ J.
    kinetic: Option<KineticBalance<'a>>,
}

impl AffineBody {
    /// The derivative of the balance; `moment` is M [N m].
    pub fn slopes<'a>(&'a self, at: &'a Gyration, moment: &Mat3) -> AffineSlopes<'a> {
        self.slopes_in([0.0; 4], at, moment)
    }

    /// The same, computed in registers of this kind.
    #[inline(always)]
    pub(crate) fn slopes_in<'a, F: F64x4>(&'a self, zeros: F, at: &'a Gyration, moment: &Mat3) -> AffineSlopes<'a> {
        // The matrices are written where they stay, one after the other: built of parts, they would be moved about.
        let mut slopes = AffineSlopes {
            body: self,
            mobility: Mobility::of(&self.inverse),
            reaction: Reaction::default(),
            elastic: Elastic::default(),
            principal: None,
            anisotropic: self.anisotropic.as_ref().map(|friction| FrictionSlopes::new(friction, at)),
            compliance: None,
            asked_by_gradient: SimdMat3::default(),
            asked_by_rate: SimdMat3::default(),
            kinetic: None,
        };
        let solution = Solution::new(self, at, self.elastic_stress(at, zeros), &SimdMat3::of(moment).with(zeros));
        let Solution { across, l, acceleration, .. } = &solution;
        let lt = l.transpose();
        let carried = lt.times(across);
        // Transposed: P⁻ᵀ P̈ᵀ P⁻ᵀ − 2 Lᵀ(FL)ᵀ.
        let straight = across.times_transposed(acceleration).times(across);
        slopes.asked_by_gradient = (straight - lt.times(&carried) * 2.0).kept();
        slopes.asked_by_rate = (carried * 2.0).kept();
        slopes.kinetic = self.kinetic.map(|kinetic| {
            let free = moment - solution.stress.matrix() * self.volume;
            KineticBalance::of(kinetic, at, self.inertia(), free)
        });
        slopes.compliance = solution.constraint.as_ref().map(|constraint| constraint.compliance);
        let pressed = slopes.fill_elastic(at, zeros);
        slopes.reaction.fill(self, at, (&slopes.mobility, &solution), solution.push - pressed, &carried);
        slopes
    }
}

impl AffineSlopes<'_> {
    /// Fills the elastic part, and gives what of V S_e Pᵀ acts as a pressure.
    #[inline(always)]
    fn fill_elastic<F: F64x4>(&mut self, at: &Gyration, zeros: F) -> f64 {
        let Some(material) = &self.body.material else { return 0.0 };
        let p = SimdMat3::of(&at.gradient);
        self.principal = material.by_principal(&p);
        if self.principal.is_some() {
            return 0.0;
        }
        let kept = ByInvariants::new(&p.with(zeros), material);
        let volume = self.body.volume;
        self.elastic.fill(volume, (&self.mobility, &SimdMat3::of(&self.body.inverse)), &kept);
        volume * at.volume_ratio * kept.derivatives.first[2]
    }

    /// ∂B/∂P_jB, M and the pressure kept, with the change of the reaction πV P⁻ᵀ.
    pub(crate) fn by_gradient(&self, j: usize, b: usize) -> SimdMat3 {
        self.along_places(Entry { j, b }, [0.0; 4]).times(&SimdMat3::of(&self.body.euler_tensor))
    }

    /// ∂B/∂Ṗ_jB.
    pub(crate) fn by_rate(&self, j: usize, b: usize) -> SimdMat3 {
        self.along_rates(Entry { j, b }, [0.0; 4]).times(&SimdMat3::of(&self.body.euler_tensor))
    }

    /// ∂B/∂P_jB J⁻¹.
    #[inline(always)]
    fn along_places<F: F64x4>(&self, entry: Entry, registers: F) -> SimdMat3<F> {
        let Entry { j, b } = entry;
        let mut image = self.reaction.by_gradient(entry, registers) + self.elastic.image(entry, registers);
        if let Some(principal) = &self.principal {
            image = image - self.stressed(&principal.slope(j, b)).with(registers);
        }
        if let Some(friction) = &self.anisotropic {
            image = image - self.stressed(&SimdMat3::of(&friction.by_gradient(j, b))).with(registers);
        }
        image
    }

    /// ∂B/∂Ṗ_jB J⁻¹.
    #[inline(always)]
    fn along_rates<F: F64x4>(&self, entry: Entry, registers: F) -> SimdMat3<F> {
        let image = self.reaction.by_rate(entry, registers);
        let Some(friction) = &self.anisotropic else { return image };
        image - self.stressed(&SimdMat3::of(&friction.by_rate(entry.j, entry.b))).with(registers)
    }

    /// V S J⁻¹.
    #[inline(always)]
    fn stressed(&self, stress: &SimdMat3) -> SimdMat3 {
        self.mobility.of_moment(&(*stress * self.body.volume))
    }

    /// δP̈ along δP_jB, by which M changes by δM, if it does.
    #[inline(always)]
    pub(crate) fn along_gradient<F: F64x4>(
        &self,
        entry: Entry,
        moment: Option<&SimdMat3>,
        registers: F,
    ) -> SimdMat3<F> {
        if let Some(kinetic) = &self.kinetic {
            let change = with(self.by_gradient(entry.j, entry.b), moment);
            let along = kinetic.along(&unit(3 * entry.b + entry.j), &Mat3::zeros(), &change);
            return SimdMat3::of(&along).with(registers);
        }
        let free = self.moved(self.along_places(entry, registers), moment);
        self.constrained(free, self.asked_by_gradient.at(entry.j, entry.b)).0
    }

    /// δP̈ along δṖ_jB, by which M changes by δM, if it does.
    #[inline(always)]
    pub(crate) fn along_rate<F: F64x4>(&self, entry: Entry, moment: Option<&SimdMat3>, registers: F) -> SimdMat3<F> {
        if let Some(kinetic) = &self.kinetic {
            let change = with(self.by_rate(entry.j, entry.b), moment);
            let along = kinetic.along(&Mat3::zeros(), &unit(3 * entry.b + entry.j), &change);
            return SimdMat3::of(&along).with(registers);
        }
        let free = self.moved(self.along_rates(entry, registers), moment);
        self.constrained(free, self.asked_by_rate.at(entry.j, entry.b)).0
    }

    /// δP̈ where M alone changes.
    #[inline(always)]
    pub(crate) fn along_moment<F: F64x4>(&self, moment: &SimdMat3, registers: F) -> SimdMat3<F> {
        if let Some(kinetic) = &self.kinetic {
            return SimdMat3::of(&kinetic.along(&Mat3::zeros(), &Mat3::zeros(), &moment.matrix())).with(registers);
        }
        self.constrained(self.mobility.of_moment(&moment.with(registers)), 0.0).0
    }

    /// With δM J⁻¹.
    #[inline(always)]
    fn moved<F: F64x4>(&self, change: SimdMat3<F>, moment: Option<&SimdMat3>) -> SimdMat3<F> {
        match moment {
            Some(moment) => change + self.mobility.of_moment(&moment.with(change.0[0].0)),
            None => change,
        }
    }

    /// The changes of P̈ and of the pressure (0 without one) with those of P, Ṗ and M.
    pub fn apply(&self, dp: &Mat3, drate: &Mat3, dmoment: &Mat3) -> (Mat3, f64) {
        let zeros = [0.0; 4];
        if let Some(kinetic) = &self.kinetic {
            let mut moved = *dmoment;
            for (j, b) in (0..9).map(|place| (place % 3, place / 3)) {
                moved += self.by_gradient(j, b).matrix() * dp[(j, b)] + self.by_rate(j, b).matrix() * drate[(j, b)];
            }
            return (kinetic.along(dp, drate, &moved), 0.0);
        }
        let (mut change, mut asked) = (self.mobility.of_moment(&SimdMat3::of(dmoment)), 0.0);
        for (j, b) in (0..9).map(|place| (place % 3, place / 3)) {
            let (entry, dp, drate) = (Entry { j, b }, dp[(j, b)], drate[(j, b)]);
            change += self.along_places(entry, zeros) * dp + self.along_rates(entry, zeros) * drate;
            asked += self.asked_by_gradient.at(j, b) * dp + self.asked_by_rate.at(j, b) * drate;
        }
        let (acceleration, push) = self.constrained(change, asked);
        (acceleration.matrix(), push / self.body.volume)
    }

    /// δP̈ of δB J⁻¹, where tr(δP̈ F) has to be as asked, and δ(πV).
    #[inline(always)]
    fn constrained<F: F64x4>(&self, free: SimdMat3<F>, asked: f64) -> (SimdMat3<F>, f64) {
        let Some(compliance) = self.compliance else { return (free, 0.0) };
        let registers = free.0[0].0;
        let push = (asked - free.dot(&self.reaction.across.with(registers))) * compliance;
        (free + self.reaction.way.with(registers) * push, push)
    }
}

/// ∂B with δM.
fn with(change: SimdMat3, moment: Option<&SimdMat3>) -> Mat3 {
    moment.map_or(change, |moment| change + *moment).matrix()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::MassProperties;
    use crate::material::{Fung, Hencky, Material, MooneyRivlin, NeoHookeanLog};
    use crate::simd::{WithF64x4, dispatch_f64x4, in_memory};
    use crate::tensor::Vec3;

    /// P̈ and its derivatives by all entries of P, Ṗ and M, bit by bit.
    struct Bits<'a>(&'a AffineBody, &'a Gyration, &'a Mat3);

    impl WithF64x4 for Bits<'_> {
        type Output = Vec<[u64; 9]>;

        // Loops: what iterators call is not compiled for the instruction set.
        #[inline(always)]
        fn run<F: F64x4>(self, zeros: F) -> Self::Output {
            let Self(body, at, moment) = self;
            let elastic = body.elastic_stress(at, zeros);
            let solution = Solution::new(body, at, elastic, &SimdMat3::of(moment).with(zeros));
            let (slopes, moment) = (body.slopes_in(zeros, at, moment), SimdMat3::of(moment));
            let mut columns = vec![solution.acceleration, solution.stress, slopes.along_moment(&moment, zeros)];
            for place in 0..9 {
                let entry = Entry { j: place % 3, b: place / 3 };
                columns.push(slopes.along_gradient(entry, None, zeros));
                columns.push(slopes.along_rate(entry, Some(&moment), zeros));
            }
            let (mut numbers, mut bits) = ([0.0; 9], Vec::new());
            for column in columns {
                column.write(&mut numbers);
                bits.push(numbers.map(f64::to_bits));
            }
            bits
        }
    }

    #[test]
    fn every_width_of_registers_gives_the_same_bytes() {
        let euler_tensor = Mat3::new(0.5, 0.1, 0.0, 0.1, 0.3, 0.05, 0.0, 0.05, 0.9);
        let rubber = |bulk| Material::MooneyRivlin(MooneyRivlin { c1: 3.0, c2: 1.0, bulk });
        let p = Mat3::new(1.3, 0.4, -0.2, -0.1, 0.7, 0.3, 0.5, -0.6, 1.9);
        let rate = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
        let moment = Mat3::new(0.3, 0.1, -0.6, 0.2, -0.9, 0.4, 0.7, -0.5, 0.8);
        let materials = [
            rubber(None),
            rubber(Some(20.0)),
            Material::Fung(Fung { shear: 2.0, exponent: 0.5, bulk: None }),
            Material::NeoHookeanLog(NeoHookeanLog { mu: 2.0, lambda: 5.0 }),
            Material::Hencky(Hencky { shear: 2.0, bulk: 5.0 }),
        ];
        let viscosity = crate::affine::Viscosity { kirchhoff: 0.4, shear: 0.3, bulk: 0.2 };
        for material in materials {
            for euler_tensor in [euler_tensor, Mat3::from_diagonal(&Vec3::new(0.5, 0.3, 0.9))] {
                let mass = MassProperties { mass: 2.0, center: Vec3::zeros(), euler_tensor, volume: 0.7 };
                let body = AffineBody::new(&mass, None, Some(material.clone()), viscosity).unwrap();
                let at = Gyration::of(&p, &rate).unwrap();
                let plain = in_memory(Bits(&body, &at, &moment));
                assert_eq!(dispatch_f64x4(Bits(&body, &at, &moment)), plain, "{material:?}");
            }
        }
    }
}
