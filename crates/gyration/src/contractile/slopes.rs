//! The derivative of the balance of a contractile body and of its law of contraction, in closed form.
//!
//! In the axes N of C = FᵀF (F and G are turned: F N, NᵀG), with increments ξ = F⁻¹ δF, γ = δG G⁻¹, E = V_G − Λ,
//! 𝓜(A) = (μ/2)(C A C⁻¹ + Aᵀ), K = (μ/2) C E C⁻¹, X = δC C⁻¹ = C ξ C⁻¹ + ξᵀ and Z = Fᵀ(τ − πI)F⁻ᵀ,
//!
//!   δZ = δ(gΣ) − X K + K X − 𝓜(δV_G − δΛ) − δπ I,         δ(gΣ) = tr γ gΣ + ξᵀ gΣ + Fᵀ g 𝔸[Fξ]
//!   A δV_G = δ(gΣ) − X K + K X + 𝓜(δΛ) − (δ(gφ) + δπ) I + δQ,   δ(gφ) = tr γ gφ + gΣ·ξ
//!   δS = F⁻ᵀ(δZ − ξᵀ Z − Z γᵀ)G⁻ᵀ,    δĠ = δV_G G + V_G δG,     δP̈ = (δM − V δS) J⁻¹
//!
//! 𝔸 is the tangent of the material. All increments are of rank one: with w_B the row B of G⁻¹,
//!
//!   δP = e_j ⊗ e_B:  ξ = F⁻¹e_j ⊗ w_B,  δΛ = −ξ Λ;      δṖ:  δΛ = F⁻¹e_j ⊗ w_B;      δG:  γ = e_j ⊗ w_B = −ξ,  δΛ = γ Λ − Λ γ

use super::mobility::{Axes, Mobility};
use super::solution::Solution;
use super::{Command, Pull};
use crate::affine::AffineBody;
use crate::columns::{Column, Columns, UNIT};
use crate::tensor::Mat3;

/// The derivative at P, Ṗ, G, M and Q: what its columns are made of.
#[derive(Debug, Clone, Copy)]
pub struct ContractileSlopes<'a> {
    body: &'a AffineBody,
    solution: Solution,
    /// N, or the unit matrix.
    axes: Columns,
    /// c, or ones where there is no viscosity.
    values: [f64; 3],
    /// How V_G answers; none if it is prescribed.
    law: Option<Law>,
    half_viscosity: f64,
    /// Of F N and NᵀG: F⁻ᵀ, G⁻ᵀ, G.
    back: Columns,
    inverse: Columns,
    contraction: Columns,
    /// gΣ, K, Λ, V_G and Z in the axes.
    mandel: Columns,
    kept: Columns,
    pulled: Columns,
    total: Columns,
    /// Nᵀ Fᵀ g 𝔸[e_j ⊗ w_B] N at 3B + j.
    tangent: [Columns; 9],
    /// (F P̈ F − 2FLL)ᵀ and (FL)ᵀ with F = P⁻¹, where the pressure is that of the second derivative of det P.
    asked: Option<[Columns; 2]>,
}

/// How the contraction velocity answers to stress.
#[derive(Debug, Clone, Copy)]
struct Law {
    mobility: Mobility,
    /// μ_γ + μ.
    stretching: f64,
    volume: Volume,
}

/// What decides tr V_G.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Volume {
    /// The stress.
    Free,
    /// tr L, by the pressure.
    Follows,
    /// It is zero.
    Kept,
}

/// A direction: vectors u (F⁻¹e_j or e_j) and w with what is made of them.
#[derive(Debug, Clone, Copy)]
struct Left {
    u: Column,
    /// C u, Kᵀ u, K C u.
    carried: Column,
    turned: Column,
    both: Column,
}

#[derive(Debug, Clone, Copy)]
struct Right {
    w: Column,
    /// C⁻¹ w, Kᵀ C⁻¹ w, K w, Λᵀ w.
    back: Column,
    turned: Column,
    kept: Column,
    pulled: Column,
}

/// What changes along a direction: V_G, and F⁻ᵀ(…)G⁻ᵀ of the stress, all in the axes.
#[derive(Debug, Clone, Copy)]
struct Change {
    velocity: Columns,
    total: Columns,
}

#[inline(always)]
fn outer(left: &Column, right: &Column) -> Columns {
    Columns([*left * right.0[0], *left * right.0[1], *left * right.0[2]])
}

impl<'a> Pull<'a> {
    /// The derivative of the balance and of the law of contraction; `moment` is M [N m].
    pub fn slopes(&self, command: &Command, moment: &Mat3) -> ContractileSlopes<'a> {
        let Pull { body, contraction, decomposition, .. } = *self;
        let solution = Solution::new(self, command, &Columns::of(moment));
        let viscosity = body.viscosity.kirchhoff;
        let axes = solution.axes.or_else(|| Axes::of(&solution.split.elastic, viscosity));
        let (n, values) = axes.map_or((Columns(UNIT), [1.0; 3]), |axes| (axes.axes, axes.values));
        let across = n.transpose();
        let turn = |matrix: &Columns| across.times(matrix).times(&n);
        let law = contraction.is_driven().then(|| Law {
            mobility: Mobility::new([contraction.viscosity, viscosity], contraction.spin, axes.as_ref()),
            stretching: contraction.viscosity + viscosity,
            volume: match (contraction.kept_volume, body.is_incompressible()) {
                (Some(_), _) => Volume::Kept,
                (None, true) => Volume::Follows,
                (None, false) => Volume::Free,
            },
        });
        let split = &solution.split;
        let elastic = split.elastic.times(&n);
        let inverse = across.times_transposed(&Columns::of(&decomposition.inverse));
        let (pulled, velocity) = (turn(&split.pulled), turn(&solution.velocity));
        let mut tangent = [Columns::default(); 9];
        if let Some(material) = &body.material {
            let kept = material.at(&split.elastic);
            let right = Columns::of(&decomposition.inverse);
            for (place, tangent) in tangent.iter_mut().enumerate() {
                let (j, b) = (place % 3, place / 3);
                let change = (kept.slope(j, 0) * right.at(b, 0) + kept.slope(j, 1) * right.at(b, 1))
                    + kept.slope(j, 2) * right.at(b, 2);
                *tangent = elastic.transpose().times(&change).times(&n) * decomposition.volume_ratio;
            }
        }
        let mandel = elastic.transpose().times(&solution.elastic_stress).times(&n).symmetric();
        let back = split.back.transpose().times(&n);
        let total = elastic.transpose().times(&solution.kirchhoff).times(&back);
        let mut kept = velocity - pulled;
        for (b, column) in kept.0.iter_mut().enumerate() {
            let Column([x, y, z, _]) = *column * (0.5 * viscosity / values[b]);
            *column = Column([x * values[0], y * values[1], z * values[2], 0.0]);
        }
        let asked = solution.constraint.is_some().then(|| {
            let carried = split.l.transpose().times(&split.across);
            let straight = split.across.times_transposed(&solution.acceleration).times(&split.across);
            [straight - split.l.transpose().times(&carried) * 2.0, carried]
        });
        ContractileSlopes {
            body,
            axes: n,
            values,
            law,
            half_viscosity: 0.5 * viscosity,
            back,
            inverse,
            contraction: across.times(&Columns::of(&decomposition.contraction)),
            mandel,
            kept,
            pulled,
            total,
            tangent,
            asked,
            solution,
        }
    }
}

impl ContractileSlopes<'_> {
    #[inline(always)]
    fn left(&self, u: Column) -> Left {
        let Column([x, y, z, _]) = u;
        let carried = Column([x * self.values[0], y * self.values[1], z * self.values[2], 0.0]);
        Left { u, carried, turned: self.kept.transpose().image(&u), both: self.kept.image(&carried) }
    }

    #[inline(always)]
    fn right(&self, b: usize) -> Right {
        let w = self.inverse.0[b];
        let Column([x, y, z, _]) = w;
        let back = Column([x / self.values[0], y / self.values[1], z / self.values[2], 0.0]);
        Right {
            w,
            back,
            turned: self.kept.transpose().image(&back),
            kept: self.kept.image(&w),
            pulled: self.pulled.transpose().image(&w),
        }
    }

    /// F⁻¹ e_j in the axes: a row of F⁻ᵀ.
    #[inline(always)]
    fn spatial_left(&self, j: usize) -> Left {
        let [x, y, z] = &self.back.0;
        self.left(Column([x.0[j], y.0[j], z.0[j], 0.0]))
    }

    /// e_j in the axes: a row of N.
    #[inline(always)]
    fn relaxed_left(&self, j: usize) -> Left {
        let [x, y, z] = &self.axes.0;
        self.left(Column([x.0[j], y.0[j], z.0[j], 0.0]))
    }

    /// 𝓜(a ⊗ b), C a and C⁻¹ b being given.
    #[inline(always)]
    fn viscous(&self, (a, carried): (&Column, &Column), (b, back): (&Column, &Column)) -> Columns {
        (outer(carried, back) + outer(b, a)) * self.half_viscosity
    }

    /// C⁻¹ b and C a of vectors that have no name.
    #[inline(always)]
    fn by_values(&self, v: &Column) -> [Column; 2] {
        let Column([x, y, z, _]) = *v;
        let c = &self.values;
        [Column([x * c[0], y * c[1], z * c[2], 0.0]), Column([x / c[0], y / c[1], z / c[2], 0.0])]
    }

    /// δ(gΣ) − X K + K X + 𝓜(δΛ) and δ(gφ) along ξ = u ⊗ w, δΛ = −ξ Λ; Fᵀ g 𝔸[Fξ] is given.
    #[inline(always)]
    fn stretched(&self, left: &Left, right: &Right, tangent: &Columns) -> (Columns, f64) {
        let heavy = self.mandel.image(&left.u);
        let mut change = *tangent + outer(&right.w, &heavy);
        if self.half_viscosity > 0.0 {
            change += outer(&left.both, &right.back) - outer(&left.carried, &right.turned);
            change += outer(&right.kept, &left.u) - outer(&right.w, &left.turned);
            let [_, back] = self.by_values(&right.pulled);
            change = change - self.viscous((&left.u, &left.carried), (&right.pulled, &back));
        }
        (change, heavy.dot(&right.w))
    }

    /// δV_G and δZ for δ(gΣ) − X K + K X + 𝓜(δΛ), δ(gφ), δQ and δ(tr Λ).
    #[inline(always)]
    fn answer(&self, stress: &Columns, (energy, drive): (f64, Option<&Columns>), growth: f64) -> Change {
        let Some(law) = &self.law else { return Change { velocity: Columns::default(), total: *stress } };
        let mut loaded = *stress;
        if let Some(drive) = drive {
            loaded += *drive;
        }
        let excess = match law.volume {
            Volume::Free => energy,
            Volume::Kept => loaded.trace() / 3.0,
            Volume::Follows => (loaded.trace() - law.stretching * growth) / 3.0,
        };
        let velocity = law.mobility.velocity(&(loaded + Columns(UNIT) * -excess));
        let mut total = *stress;
        if law.volume == Volume::Follows {
            total += Columns(UNIT) * (energy - excess);
        }
        if self.half_viscosity > 0.0 {
            let c = &self.values;
            for (b, column) in total.0.iter_mut().enumerate() {
                let Column([x, y, z, _]) = velocity.0[b];
                let row = Column([velocity.at(b, 0), velocity.at(b, 1), velocity.at(b, 2), 0.0]);
                let carried = Column([x * c[0], y * c[1], z * c[2], 0.0]) * (1.0 / c[b]);
                *column = *column - (carried + row) * self.half_viscosity;
            }
        }
        Change { velocity, total }
    }

    /// δĠ and δP̈ of a change, `own` being V_G δG.
    #[inline(always)]
    fn along(&self, change: &Change, moment: Option<&Columns>, asked: f64) -> (Columns, Columns) {
        let stress = self.back.times(&change.total).times(&self.inverse);
        let mut free = stress * -self.body.volume;
        if let Some(moment) = moment {
            free += *moment;
        }
        (self.axes.times(&change.velocity).times(&self.contraction), self.accelerate(&free, asked))
    }

    /// δP̈ of δB, where tr(δP̈ P⁻¹) has to be as asked.
    #[inline(always)]
    fn accelerate(&self, free: &Columns, asked: f64) -> Columns {
        let acceleration = self.body.per_inertia(free);
        match &self.solution.constraint {
            Some(constraint) => acceleration + constraint.way * constraint.push(free, asked),
            None => acceleration,
        }
    }

    /// δĠ and δP̈ along δP_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_gradient(&self, j: usize, b: usize, moment: &Columns) -> (Columns, Columns) {
        let (left, right) = (self.spatial_left(j), self.right(b));
        let (stress, energy) = self.stretched(&left, &right, &self.tangent[3 * b + j]);
        // tr Λ = tr L changes by −u·Λᵀw.
        let mut change = self.answer(&stress, (energy, None), -left.u.dot(&right.pulled));
        change.total = change.total - outer(&right.w, &self.total.transpose().image(&left.u));
        let asked = self.asked.as_ref().map_or(0.0, |[gradient, _]| gradient.at(j, b));
        self.along(&change, Some(moment), asked)
    }

    /// δĠ and δP̈ along δṖ_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_rate(&self, j: usize, b: usize, moment: &Columns) -> (Columns, Columns) {
        let (left, right) = (self.spatial_left(j), self.right(b));
        let stress = self.viscous((&left.u, &left.carried), (&right.w, &right.back));
        let change = self.answer(&stress, (0.0, None), left.u.dot(&right.w));
        let asked = self.asked.as_ref().map_or(0.0, |[_, carried]| 2.0 * carried.at(j, b));
        self.along(&change, Some(moment), asked)
    }

    /// δĠ and δP̈ along δG_jB.
    #[inline(always)]
    pub(crate) fn along_contraction(&self, j: usize, b: usize) -> (Columns, Columns) {
        let (left, right) = (self.relaxed_left(j), self.right(b));
        // Fᵀ g 𝔸[Fξ] with ξ = −e_j ⊗ w_B, F e_j = Σ_i F_ij e_i.
        let f = &self.solution.split.elastic;
        let [x, y, z] = [0, 1, 2].map(|i| self.tangent[3 * b + i] * f.at(i, j));
        let (stress, energy) = self.stretched(&left, &right, &((x + y) + z));
        let mut stress = stress * -1.0;
        // What G does beside stretching F back: it makes the relaxed body larger, and Λ is seen from it.
        let growth = left.u.dot(&right.w);
        stress += self.mandel * growth;
        if self.half_viscosity > 0.0 {
            let seen = self.pulled.image(&left.u);
            let [carried, _] = self.by_values(&seen);
            stress = stress - self.viscous((&seen, &carried), (&right.w, &right.back));
        }
        // tr Λ = tr L does not depend on G.
        let mut change = self.answer(&stress, (self.solution.energy * growth - energy, None), 0.0);
        change.total += outer(&right.w, &self.total.transpose().image(&left.u));
        change.total = change.total - outer(&self.total.image(&right.w), &left.u);
        let (mut rate, acceleration) = self.along(&change, None, 0.0);
        // V_G δG, with V_G as it stands.
        rate.0[b] += self.solution.velocity.0[j];
        (rate, acceleration)
    }

    /// δĠ and δP̈ along a change of the drive.
    pub(crate) fn along_drive(&self, drive: &Mat3) -> (Columns, Columns) {
        let turned = self.axes.transpose().times(&Columns::of(drive)).times(&self.axes);
        let change = self.answer(&Columns::default(), (0.0, Some(&turned)), 0.0);
        self.along(&change, None, 0.0)
    }

    /// δP̈ where M alone changes.
    #[inline(always)]
    pub(crate) fn along_moment(&self, moment: &Columns) -> Columns {
        self.accelerate(moment, 0.0)
    }
}
