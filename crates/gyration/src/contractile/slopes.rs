//! The derivative of the balance of a contractile body and of its law of contraction, in closed form.
//!
//! In the axes N of C = FᵀF (F and G are turned: F N, NᵀG), with increments ξ = F⁻¹ δF, γ = δG G⁻¹, Λ = F⁻¹ L F, E = V_G − Λ,
//! 𝓜(A) = (μ/2)(C A C⁻¹ + Aᵀ), K = (μ/2) C E C⁻¹, X = δC C⁻¹ = C ξ C⁻¹ + ξᵀ and Z = Fᵀ(τ − πI)F⁻ᵀ,
//!
//!   δZ = δ(gΣ) − X K + K X − 𝓜(δV_G − δΛ) − δπ I,         δ(gΣ) = tr γ gΣ + ξᵀ gΣ + Fᵀ g 𝔸[Fξ]
//!   A δV_G = δ(gΣ) − X K + K X + 𝓜(δΛ) − (δ(gφ) + δπ) I + δQ,   δ(gφ) = tr γ gφ + gΣ·ξ
//!   δS = F⁻ᵀ(δZ − ξᵀ Z − Z γᵀ)G⁻ᵀ,    δĠ = δV_G G + V_G δG,     δP̈ = (δM − V δS) J⁻¹
//!
//! 𝔸 is the tangent of the material. All increments are of rank one: with w_B the row B of G⁻¹,
//!
//!   δP = e_j ⊗ e_B:  ξ = F⁻¹e_j ⊗ w_B,  δΛ = −ξ Λ;      δṖ:  δΛ = F⁻¹e_j ⊗ w_B;      δG:  γ = e_j ⊗ w_B = −ξ,  δΛ = γ Λ − Λ γ
//!
//! so that what stands beside 𝔸 is four dyads, of vectors that depend on j or on B alone (`vectors`).

use super::mobility::{Axes, Mobility};
use super::solution::Solution;
use super::vectors::{Row, Side, Vectors, dyad};
use super::{Command, Decomposition, Pull};
use crate::affine::AffineBody;
use crate::columns::{Column, Columns, Four, UNIT};
use crate::tensor::Mat3;

/// The derivative at P, Ṗ, G, M and Q: what its columns are made of.
#[derive(Debug, Clone, Copy)]
pub struct ContractileSlopes<'a> {
    body: &'a AffineBody,
    /// How V_G answers; none if it is prescribed.
    law: Option<Law>,
    /// μ/2 c_i/c_j and μ/2; none without viscosity.
    viscous: Option<(Columns, f64)>,
    /// N, F⁻ᵀ N, NᵀG, NᵀG⁻ᵀ and −V NᵀG⁻ᵀ J⁻¹.
    axes: Columns,
    back: Columns,
    contraction: Columns,
    inverse: Columns,
    outward: Columns,
    /// gΣ and Z in the axes, gφ.
    mandel: Columns,
    total: Columns,
    energy: f64,
    /// V_G, outside the axes.
    velocity: Columns,
    /// Of e_j as seen through F⁻¹, for δP and δṖ, and as it is, for δG.
    spatial: [Side; 3],
    relaxed: [Side; 3],
    rows: [Row; 3],
    /// Nᵀ Fᵀ g 𝔸[e_j ⊗ w_B] N, and of −F e_j ⊗ w_B, at 3B + j.
    tangent: [Columns; 9],
    tangent_back: [Columns; 9],
    reaction: Option<Reaction>,
}

/// What a pressure adds that is that of the second derivative of det P.
#[derive(Debug, Clone, Copy)]
struct Reaction {
    /// P⁻ᵀ, P⁻ᵀ J⁻¹ and 1/tr(P⁻ᵀ J⁻¹ P⁻¹).
    across: Columns,
    way: Columns,
    compliance: f64,
    /// (F P̈ F − 2FLL)ᵀ and (FL)ᵀ with F = P⁻¹.
    by_gradient: Columns,
    by_rate: Columns,
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

impl<'a> Pull<'a> {
    /// The derivative of the balance and of the law of contraction; `moment` is M [N m].
    #[inline(always)]
    pub(crate) fn slopes_in<F: Four>(&self, registers: F, command: &Command, moment: &Mat3) -> ContractileSlopes<'a> {
        let Pull { body, decomposition, .. } = *self;
        let solution = Solution::new(self, command, &Columns::of(moment).with(registers));
        let viscosity = body.viscosity.kirchhoff;
        let (n, values) = match &solution.axes {
            Some(axes) => (axes.axes, axes.values),
            None => (Columns(UNIT), [1.0; 3]),
        };
        let n_in = n.with(registers);
        let turned = n_in.transpose();
        let own = Columns::load(&decomposition.contraction, registers);
        let back = own.times_transposed(&solution.across).transpose().times(&n_in);
        let forth = solution.elastic.times(&n_in).transpose();
        let inverse = turned.times_transposed(&Columns::load(&decomposition.inverse, registers));
        // Λ = F⁻¹ L F; Fᵀ X F⁻ᵀ of symmetric stresses.
        let pulled = back.transpose().times(&solution.l).times_transposed(&forth);
        let mandel = forth.times(&solution.elastic_stress).times(&back).symmetric();
        let total = forth.times(&solution.kirchhoff).times(&back);
        let velocity = turned.times(&solution.velocity).times(&n_in);
        let half = 0.5 * viscosity;
        let ratios = solution.axes.as_ref().map(|axes| ratios(axes, half));
        let kept = match &ratios {
            Some(ratios) => (velocity - pulled).entrywise(&ratios.with(registers)).kept(),
            None => Columns::default(),
        };
        let (mandel, total, pulled) = (mandel.kept(), total.kept(), pulled.kept());
        let vectors = Vectors { values, half, kept, pulled, mandel, total };

        let mut slopes = ContractileSlopes {
            body,
            law: law(self, solution.axes.as_ref()),
            viscous: ratios.map(|ratios| (ratios, half)),
            axes: n,
            back: back.kept(),
            contraction: turned.times(&own).kept(),
            inverse: inverse.kept(),
            outward: (body.per_inertia(&inverse) * -body.volume).kept(),
            mandel,
            total,
            energy: solution.energy,
            velocity: solution.velocity.kept(),
            spatial: [Side::default(); 3],
            relaxed: [Side::default(); 3],
            rows: [Row::default(); 3],
            tangent: [Columns::default(); 9],
            tangent_back: [Columns::default(); 9],
            reaction: reaction(&solution),
        };
        for j in 0..3 {
            let row_of = |matrix: &Columns| Column([matrix.at(j, 0), matrix.at(j, 1), matrix.at(j, 2), 0.0]);
            slopes.spatial[j] = vectors.spatial(row_of(&slopes.back));
            slopes.relaxed[j] = vectors.relaxed(row_of(&n));
            slopes.rows[j] = vectors.row(slopes.inverse.0[j]);
        }
        slopes.fill_tangents(self, (&forth, &n_in));
        slopes
    }
}

/// μ/2 c_i/c_j.
#[inline(always)]
fn ratios(axes: &Axes, half: f64) -> Columns {
    let column = |j: usize| Column([0, 1, 2, 2].map(|i| half * axes.ratio(i, j)));
    Columns([column(0), column(1), column(2)])
}

#[inline(always)]
fn law(pull: &Pull<'_>, axes: Option<&Axes>) -> Option<Law> {
    let Pull { body, contraction, .. } = *pull;
    let viscosity = body.viscosity.kirchhoff;
    contraction.is_driven().then(|| Law {
        mobility: Mobility::new([contraction.viscosity, viscosity], contraction.spin, axes),
        stretching: contraction.viscosity + viscosity,
        volume: match (contraction.kept_volume, body.is_incompressible()) {
            (Some(_), _) => Volume::Kept,
            (None, true) => Volume::Follows,
            (None, false) => Volume::Free,
        },
    })
}

#[inline(always)]
fn reaction<F: Four>(solution: &Solution<F>) -> Option<Reaction> {
    let constraint = solution.constraint.as_ref()?;
    let Solution { l, across, acceleration, .. } = solution;
    let carried = l.transpose().times(across);
    let straight = across.times_transposed(acceleration).times(across);
    Some(Reaction {
        across: across.kept(),
        way: constraint.way.kept(),
        compliance: constraint.compliance,
        by_gradient: (straight - l.transpose().times(&carried) * 2.0).kept(),
        by_rate: carried.kept(),
    })
}

/// What changes along a direction: V_G, and the bracket of δS, both in the axes.
struct Change<F> {
    velocity: Columns<F>,
    total: Columns<F>,
}

impl ContractileSlopes<'_> {
    #[inline(always)]
    fn fill_tangents<F: Four>(&mut self, pull: &Pull<'_>, (forth, n): (&Columns<F>, &Columns<F>)) {
        let Some(material) = &pull.body.material else { return };
        let Decomposition { elastic, inverse, volume_ratio, .. } = pull.decomposition;
        let (slopes, registers) = (material.slopes_at(&Columns::of(elastic)), n.0[0].0);
        let mut turned = [Columns::default().with(registers); 9];
        for (turned, slope) in turned.iter_mut().zip(&slopes) {
            *turned = forth.times(&slope.with(registers)).times(n) * *volume_ratio;
        }
        for b in 0..3 {
            for j in 0..3 {
                let (x, y, z) = (turned[j], turned[3 + j], turned[6 + j]);
                let sum = (x * inverse[(b, 0)] + y * inverse[(b, 1)]) + z * inverse[(b, 2)];
                self.tangent[3 * b + j] = sum.kept();
            }
            // −F e_j = −Σ_i F_ij e_i.
            let tangents = &self.tangent[3 * b..3 * b + 3];
            let (x, y, z) = (tangents[0].with(registers), tangents[1].with(registers), tangents[2].with(registers));
            for j in 0..3 {
                let sum = (x * -elastic[(0, j)] - y * elastic[(1, j)]) - z * elastic[(2, j)];
                self.tangent_back[3 * b + j] = sum.kept();
            }
        }
    }

    /// δ(gΣ) − X K + K X + 𝓜(δΛ) beside what `tangent` holds of it.
    #[inline(always)]
    fn stretched<F: Four>(&self, side: &Side, row: &Row, tangent: &Columns, registers: F) -> Columns<F> {
        let [a, b, c, d] = &side.dyads;
        if self.viscous.is_none() {
            return tangent.with(registers) + dyad(&row.w, a, registers);
        }
        let pairs = (dyad(&row.w, a, registers) + dyad(b, &row.back, registers))
            + (dyad(c, &row.first, registers) + dyad(&row.second, d, registers));
        tangent.with(registers) + pairs
    }

    /// δV_G and δZ for δ(gΣ) − X K + K X + 𝓜(δΛ), δ(gφ) and δ(tr Λ); δQ is added to what moves V_G.
    #[inline(always)]
    fn answer<F: Four>(
        &self,
        stress: &Columns<F>,
        (energy, growth): (f64, f64),
        drive: Option<&Columns<F>>,
    ) -> Change<F> {
        let Some(law) = &self.law else {
            return Change { velocity: Columns::default().with(stress.0[0].0), total: *stress };
        };
        let loaded = if let Some(drive) = drive { *stress + *drive } else { *stress };
        let excess = match law.volume {
            Volume::Free => energy,
            Volume::Kept => loaded.trace() / 3.0,
            Volume::Follows => (loaded.trace() - law.stretching * growth) / 3.0,
        };
        let velocity = law.mobility.velocity(&loaded.plus_unit(-excess));
        let mut total = *stress;
        if law.volume == Volume::Follows {
            total = total.plus_unit(energy - excess);
        }
        if let Some((ratios, half)) = &self.viscous {
            total = total - (velocity.entrywise(&ratios.with(stress.0[0].0)) + velocity.transpose() * *half);
        }
        Change { velocity, total }
    }

    /// δĠ, but for V_G δG, and δP̈ of a change; `moment` is δM.
    #[inline(always)]
    fn along<F: Four>(&self, change: &Change<F>, moment: Option<&Columns>, asked: f64) -> (Columns<F>, Columns<F>) {
        let registers = change.total.0[0].0;
        let mut acceleration = self.back.with(registers).times(&change.total).times(&self.outward.with(registers));
        if let Some(moment) = moment {
            acceleration += self.body.per_inertia(&moment.with(registers));
        }
        let rate = self.axes.with(registers).times(&change.velocity).times(&self.contraction.with(registers));
        (rate, self.held(&acceleration, asked))
    }

    /// δP̈ where tr(δP̈ P⁻¹) has to be as asked.
    #[inline(always)]
    fn held<F: Four>(&self, acceleration: &Columns<F>, asked: f64) -> Columns<F> {
        let Some(reaction) = &self.reaction else { return *acceleration };
        let registers = acceleration.0[0].0;
        let missing = asked - acceleration.dot(&reaction.across.with(registers));
        *acceleration + reaction.way.with(registers) * (missing * reaction.compliance)
    }

    /// What tr(δP̈ P⁻¹) has to be; nothing where no pressure sees to it.
    #[inline(always)]
    fn asked(&self, of: impl Fn(&Reaction) -> f64) -> f64 {
        if let Some(reaction) = &self.reaction { of(reaction) } else { 0.0 }
    }

    /// δĠ and δP̈ along δP_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_gradient<F: Four>(
        &self,
        (j, b): (usize, usize),
        moment: Option<&Columns>,
        registers: F,
    ) -> (Columns<F>, Columns<F>) {
        let (side, row) = (&self.spatial[j], &self.rows[b]);
        let stress = self.stretched(side, row, &self.tangent[3 * b + j], registers);
        // tr Λ = tr L changes by −u·Λᵀw.
        let mut change = self.answer(&stress, (side.heavy.dot(&row.w), -side.u.dot(&row.pulled)), None);
        change.total = change.total - dyad(&row.w, &side.total, registers);
        self.along(&change, moment, self.asked(|reaction| reaction.by_gradient.at(j, b)))
    }

    /// δĠ and δP̈ along δṖ_jB, by which M changes by δM.
    #[inline(always)]
    pub(crate) fn along_rate<F: Four>(
        &self,
        (j, b): (usize, usize),
        moment: Option<&Columns>,
        registers: F,
    ) -> (Columns<F>, Columns<F>) {
        let (side, row) = (&self.spatial[j], &self.rows[b]);
        let half = self.viscous.as_ref().map_or(0.0, |(_, half)| *half);
        let stress = (dyad(&side.carried, &row.back, registers) + dyad(&row.w, &side.u, registers)) * half;
        let change = self.answer(&stress, (0.0, side.u.dot(&row.w)), None);
        self.along(&change, moment, self.asked(|reaction| 2.0 * reaction.by_rate.at(j, b)))
    }

    /// δĠ and δP̈ along δG_jB.
    #[inline(always)]
    pub(crate) fn along_contraction<F: Four>(&self, (j, b): (usize, usize), registers: F) -> (Columns<F>, Columns<F>) {
        let (side, row) = (&self.relaxed[j], &self.rows[b]);
        let growth = side.u.dot(&row.w);
        let mut stress = self.stretched(side, row, &self.tangent_back[3 * b + j], registers);
        stress += self.mandel.with(registers) * growth;
        // tr Λ = tr L does not depend on G.
        let mut change = self.answer(&stress, (self.energy * growth - side.heavy.dot(&row.w), 0.0), None);
        change.total += dyad(&row.w, &side.total, registers);
        change.total = change.total - dyad(&self.total.image(&row.w), &side.u, registers);
        let (mut rate, acceleration) = self.along(&change, None, 0.0);
        rate.0[b] += Column(registers.like(self.velocity.0[j].0));
        (rate, acceleration)
    }

    /// δĠ and δP̈ along a change of the drive.
    pub(crate) fn along_drive(&self, drive: &Mat3) -> (Columns, Columns) {
        let turned = self.axes.transpose().times(&Columns::of(drive)).times(&self.axes);
        self.along(&self.answer(&Columns::default(), (0.0, 0.0), Some(&turned)), None, 0.0)
    }

    /// δP̈ where M alone changes.
    #[inline(always)]
    pub(crate) fn along_moment<F: Four>(&self, moment: &Columns, registers: F) -> Columns<F> {
        self.held(&self.body.per_inertia(&moment.with(registers)), 0.0)
    }
}
