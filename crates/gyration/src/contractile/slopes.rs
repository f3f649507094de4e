//! The derivative of the balance of a contractile body and of its law of contraction, in closed form.
//!
//! In the axes N of C = FᵀF (F and G are turned: F N, NᵀG), with increments ξ = F⁻¹ δF, γ = δG G⁻¹, Λ = F⁻¹ L F, E =
//! V_G − Λ, 𝓜(A) = (μ/2)(C A C⁻¹ + Aᵀ), K = (μ/2) C E C⁻¹, X = δC C⁻¹ = C ξ C⁻¹ + ξᵀ and Z = Fᵀ(τ − πI)F⁻ᵀ,
//!
//!   δZ = δ(gΣ) − X K + K X − 𝓜(δV_G − δΛ) − δπ I,         δ(gΣ) = tr γ gΣ + ξᵀ gΣ + Fᵀ g 𝔸[Fξ]
//!   A δV_G = δ(gΣ) − X K + K X + 𝓜(δΛ) − (δ(gφ) + δπ) I + δQ,   δ(gφ) = tr γ gφ + gΣ·ξ
//!   δS = F⁻ᵀ(δZ − ξᵀ Z − Z γᵀ)G⁻ᵀ,    δĠ = δV_G G + V_G δG,     δP̈ = (δM − V δS) J⁻¹
//!
//! 𝔸 is the tangent of the material. All increments are of rank one: with w_B the row B of G⁻¹,
//!
//!   δP = e_j ⊗ e_B:  ξ = F⁻¹e_j ⊗ w_B,  δΛ = −ξ Λ;      δṖ:  δΛ = F⁻¹e_j ⊗ w_B;      δG:  γ = e_j ⊗ w_B = −ξ,  δΛ = γ Λ − Λ γ
//!
//! so that what stands beside 𝔸 is four dyads, of vectors that depend on j or on B alone (`vectors`). The three j of
//! one B are done at once (`batch`).

use super::batch::{Broadcast, MatrixBatch, along, broadcast};
use super::mobility::{ContractionMobility, ElasticAxes};
use super::turned::{Turned, TurnedElastic, TurnedReaction, Volume, diagonal};
use super::vectors::{ColumnVectors, DyadVectors, RowVectors, strained};
use super::{ContractionCommand, Pull, Spin};
use crate::affine::AffineBody;
use crate::simd::{F64x4, SimdMat3, SimdVec3, UNIT};
use crate::tensor::Mat3;

/// The derivative at P, Ṗ, G, M and Q: what its columns are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContractileSlopes<'a, F> {
    body: &'a AffineBody,
    law: Law<F>,
    /// N and NᵀG; F⁻ᵀ N and −V NᵀG⁻ᵀ J⁻¹.
    axes: Broadcast<F>,
    contraction: Broadcast<F>,
    back: Broadcast<F>,
    outward: Broadcast<F>,
    /// N again.
    turn: SimdMat3<F>,
    /// gφ, and the diagonal gΣ in the axes.
    energy: f64,
    mandel: SimdVec3,
    /// V_Gᵀ, outside the axes.
    velocity: SimdMat3<F>,
    /// Of F⁻¹e_j, for δP; of −e_j, for δG; for δṖ.
    spatial: RowVectors<F>,
    relaxed: RowVectors<F>,
    strained: [SimdMat3<F>; 2],
    columns: [ColumnVectors; 3],
    reaction: Option<TurnedReaction>,
}

/// How the contraction velocity answers to stress, and what is left of the stress.
#[derive(Debug, Clone, Copy)]
struct Law<F> {
    velocity: [Broadcast<F>; 2],
    /// None if it is μ_γ δV_G.
    rest: Option<[Broadcast<F>; 2]>,
    /// μ_γ and μ_γ + μ.
    viscosity: f64,
    stretching: f64,
    volume: Volume,
}

impl<'a> Pull<'a> {
    /// The derivative of the balance and of the law of contraction; `moment` is M [N m].
    #[inline(always)]
    pub(crate) fn slopes_in<F: F64x4>(
        &self,
        registers: F,
        command: &ContractionCommand,
        moment: &Mat3,
    ) -> ContractileSlopes<'a, F> {
        let Pull { body, decomposition, .. } = *self;
        let axes = ElasticAxes::at(&SimdMat3::of(&decomposition.elastic));
        let elastic = self.elastic(&axes, registers);
        let mobility = self.mobility(&axes);
        let turned = self.turned((&axes, &mobility), &elastic, command, moment);
        let back = turned.axes.transpose();
        let inverse = back.times_transposed(&SimdMat3::load(&decomposition.inverse, registers));
        let contraction = back.times(&SimdMat3::load(&decomposition.contraction, registers));
        let vectors = self.vectors(&axes, &elastic, &turned);
        ContractileSlopes {
            body,
            law: self.law(&mobility, &axes, registers),
            axes: Broadcast::of(&axes.axes, registers),
            contraction: fixed(&contraction),
            back: fixed(&turned.back),
            outward: fixed(&(body.per_inertia(&inverse) * -body.volume)),
            turn: turned.axes,
            energy: elastic.energy,
            mandel: SimdVec3(vectors.mandel.0.numbers()),
            velocity: turned.velocity,
            spatial: vectors.spatial(&turned.back),
            relaxed: vectors.relaxed(&(turned.axes * -1.0)),
            strained: vectors.strained(&turned.back),
            columns: vectors.columns(&inverse),
            reaction: turned.reaction,
        }
    }

    /// What the vectors are made of.
    #[inline(always)]
    fn vectors<F: F64x4>(&self, axes: &ElasticAxes, elastic: &TurnedElastic<F>, turned: &Turned<F>) -> DyadVectors<F> {
        let (registers, full) = (turned.axes.0[0].0, elastic.along);
        let straight = diagonal([full.at(0, 0), full.at(1, 1), full.at(2, 2)]).with(registers);
        let weights = diagonal(elastic.mandel).with(registers);
        DyadVectors {
            values: three(axes.values, registers),
            inverses: three(axes.inverses, registers),
            mandel: three(elastic.mandel, registers),
            half: 0.5 * self.body.viscosity.kirchhoff,
            kept: turned.kept,
            pulled: turned.pulled,
            total: turned.total,
            own: elastic.own + straight + weights,
            other: elastic.other.plus_beside(&elastic.mandel),
            along: full - straight,
        }
    }

    /// How V_G answers to stress.
    #[inline(always)]
    fn mobility(&self, axes: &ElasticAxes) -> ContractionMobility {
        let Pull { body, contraction, .. } = *self;
        if contraction.is_driven() {
            ContractionMobility::new([contraction.viscosity, body.viscosity.kirchhoff], contraction.spin, Some(axes))
        } else {
            ContractionMobility::none()
        }
    }

    #[inline(always)]
    fn law<F: F64x4>(&self, mobility: &ContractionMobility, axes: &ElasticAxes, registers: F) -> Law<F> {
        let Pull { body, contraction, .. } = *self;
        let coefficients = [contraction.viscosity, body.viscosity.kirchhoff];
        let volume = self.volume();
        let rest = match (volume, contraction.spin) {
            (Volume::Prescribed, _) => Some(pair(&ContractionMobility::all(), registers)),
            (_, Spin::Full) => None,
            (_, Spin::Symmetric) => Some(pair(&mobility.rest(coefficients, axes), registers)),
        };
        Law {
            velocity: pair(mobility, registers),
            rest,
            viscosity: contraction.viscosity,
            stretching: coefficients[0] + coefficients[1],
            volume,
        }
    }
}

#[inline(always)]
fn pair<F: F64x4>(ContractionMobility { own, other }: &ContractionMobility, registers: F) -> [Broadcast<F>; 2] {
    [Broadcast::of(own, registers), Broadcast::of(other, registers)]
}

#[inline(always)]
fn three<F: F64x4>([x, y, z]: [f64; 3], registers: F) -> SimdVec3<F> {
    SimdVec3(registers.like([x, y, z, 0.0]))
}

#[inline(always)]
fn fixed<F: F64x4>(matrix: &SimdMat3<F>) -> Broadcast<F> {
    Broadcast::of(&matrix.kept(), matrix.0[0].0)
}

/// δĠ and δP̈ along the three rows of a column, M kept and without what a `TurnedReaction` does to δP̈.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Along<F> {
    pub rate: MatrixBatch<F>,
    pub acceleration: MatrixBatch<F>,
}

impl<F: F64x4> ContractileSlopes<'_, F> {
    /// δV_G and δZ for δ(gΣ) − X K + K X + 𝓜(δΛ) + δQ, δ(gφ) and δ(tr Λ), the second but for −δQ.
    #[inline(always)]
    fn answer(&self, stress: &MatrixBatch<F>, energy: &SimdVec3<F>, growth: &SimdVec3<F>) -> [MatrixBatch<F>; 2] {
        const THIRD: f64 = 1.0 / 3.0;
        let Law { velocity, rest, viscosity, stretching, volume } = &self.law;
        let none = *energy * 0.0;
        let (excess, level) = match volume {
            Volume::Free => (*energy, *energy),
            Volume::Follows => ((stress.trace() - *growth * *stretching) * THIRD, *energy),
            Volume::Kept => (stress.trace() * THIRD, stress.trace() * THIRD),
            Volume::Prescribed => (none, none),
        };
        let velocity = stress.mixed(&velocity[0], &velocity[1], (&excess, &none));
        let total = if let Some([own, other]) = rest {
            stress.mixed(own, other, (&excess, &level))
        } else {
            velocity.times_plus_unit(*viscosity, &level)
        };
        [velocity, total]
    }

    /// δĠ, but for V_G δG, and δP̈ of a change of V_G and of the bracket of δS, both in the axes.
    #[inline(always)]
    fn along(&self, velocity: &MatrixBatch<F>, total: &MatrixBatch<F>) -> Along<F> {
        let acceleration = total.between(&self.back, &self.outward);
        Along { rate: velocity.between(&self.axes, &self.contraction), acceleration }
    }

    #[inline(always)]
    fn none(&self) -> SimdVec3<F> {
        broadcast(0.0, self.turn.0[0].0)
    }

    /// Along δP_jB for all j.
    #[inline(always)]
    pub fn along_gradient(&self, b: usize) -> Along<F> {
        let (row, column) = (&self.spatial, &self.columns[b]);
        let stress = row.stretched(column);
        // tr Λ = tr L changes by −u·Λᵀw.
        let (energy, growth) = (along(&row.u.0, &column.heavy), along(&row.u.0, &column.pulled));
        let [velocity, total] = self.answer(&stress, &energy, &growth);
        self.along(&velocity, &total.plus_dyad(&column.w, &row.total))
    }

    /// Along δṖ_jB for all j.
    #[inline(always)]
    pub fn along_rate(&self, b: usize) -> Along<F> {
        let column = &self.columns[b];
        let growth = along(&self.spatial.u.0, &column.w);
        let [velocity, total] = self.answer(&strained(&self.strained, column), &self.none(), &growth);
        self.along(&velocity, &total)
    }

    /// Along δG_jB for all j.
    #[inline(always)]
    pub fn along_contraction(&self, b: usize) -> Along<F> {
        let (row, column) = (&self.relaxed, &self.columns[b]);
        // −tr γ.
        let growth = along(&row.u.0, &column.w);
        let stress = row.stretched(column).plus_diagonal(&self.mandel, &(growth * -1.0));
        let energy = along(&row.u.0, &column.heavy) - growth * self.energy;
        // tr Λ = tr L does not depend on G.
        let [velocity, total] = self.answer(&stress, &energy, &self.none());
        let total = total.plus_dyad(&column.w, &row.total).plus_dyad(&column.total, &row.u);
        let Along { rate, acceleration } = self.along(&velocity, &total);
        Along { rate: rate.plus_dyad_transposed(&self.velocity, &UNIT[b]), acceleration }
    }

    /// Along a change of the drive, the same for all three.
    #[inline(always)]
    pub fn along_drive(&self, drive: &Mat3) -> Along<F> {
        let registers = self.turn.0[0].0;
        let turned = self.turn.transpose().times(&SimdMat3::load(drive, registers)).times(&self.turn);
        let drive = fixed(&turned);
        let [velocity, total] = self.answer(&MatrixBatch(drive.0), &self.none(), &self.none());
        self.along(&velocity, &total.less(&drive))
    }

    /// Whether δP̈ is not that of `Along` even if M stays as it is.
    #[inline(always)]
    pub fn is_held(&self) -> bool {
        self.reaction.is_some()
    }

    /// What tr(δP̈ P⁻¹) has to be along δP_jB or δṖ_jB, where it is held.
    #[inline(always)]
    pub fn asked(&self, by_rate: bool, (j, b): (usize, usize)) -> f64 {
        let Some(TurnedReaction { by_gradient, by_rate: rate, .. }) = &self.reaction else { return 0.0 };
        if by_rate { 2.0 * rate.at(j, b) } else { by_gradient.at(j, b) }
    }

    /// δP̈ with what δM adds to that of `Along`, and tr(δP̈ P⁻¹) as asked, where it is held.
    #[inline(always)]
    pub fn held(&self, along: &SimdMat3, moment: &SimdMat3, asked: f64) -> SimdMat3<F> {
        let registers = self.turn.0[0].0;
        let acceleration = along.with(registers) + self.body.per_inertia(&moment.with(registers));
        let Some(reaction) = &self.reaction else { return acceleration };
        let missing = asked - acceleration.dot(&reaction.across.with(registers));
        acceleration + reaction.way.with(registers) * (missing * reaction.compliance)
    }
}

impl<F: F64x4> Along<F> {
    /// Writes δP̈ and, if G is part of the state, δĠ behind it into three columns that lie `apart` from each other.
    #[inline(always)]
    pub fn write(&self, columns: &mut [f64], apart: usize, driven: bool) {
        let [x, y, z] = &self.acceleration.0;
        let [u, v, w] = &self.rate.0;
        let one = F::transposed([x[0].0, x[1].0, x[2].0, y[0].0]);
        let two = F::transposed([y[1].0, y[2].0, z[0].0, z[1].0]);
        let three = F::transposed([z[2].0, u[0].0, u[1].0, u[2].0]);
        let four = F::transposed([v[0].0, v[1].0, v[2].0, w[0].0]);
        let five = F::transposed([w[1].0, w[2].0, w[1].0, w[2].0]);
        for j in 0..3 {
            if driven {
                let out = &mut columns[apart * j..][..18];
                out[..4].copy_from_slice(&one[j].numbers());
                out[4..8].copy_from_slice(&two[j].numbers());
                out[8..12].copy_from_slice(&three[j].numbers());
                out[12..16].copy_from_slice(&four[j].numbers());
                out[16..].copy_from_slice(&five[j].numbers()[..2]);
            } else {
                let out = &mut columns[apart * j..][..9];
                out[..4].copy_from_slice(&one[j].numbers());
                out[4..8].copy_from_slice(&two[j].numbers());
                out[8] = three[j].at(0);
            }
        }
    }
}
