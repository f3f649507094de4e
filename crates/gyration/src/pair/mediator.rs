//! Damping and friction against the velocities of the plane, a mediator without mass.
//!
//! Each side resists by −κ Π(v − u), u = Σ η_k b_k the velocity of the mediator, and η is such that the power lost is
//! least, so that the mediator is in balance:
//!
//!   damping    Π = n⊗n,       b_k = n (1, t₁·x, t₂·x),    velocities where the points are
//!   friction   Π = 1 − n⊗n,   b_k = t₁, t₂, n×x,          velocities and tractions at the plane
//!   κ_i = β (d₀ μ_i)^ν′ d_i^−ν′/ŵ_i,   μ_i = λ_i^(1/ν),   ŵ_i = μ_i/(μ_A + μ_B)
//!
//! At ν′ = ν a translation w is resisted by (β/α) N w, whatever the shapes. ŵ_i in the place of μ_i too would be the
//! same where μ_A + μ_B = 1, as of balls and equal faces, and would miss that else. On the numbers X̃ of a side b_k is
//! a 3×4 matrix B_k, the motion V = (ṗ₀ | Ṗ), and M = ∫κ X̃⊗X̃ dA, of friction ∫κ X̃_Π⊗X̃_Π dA, X̃_Π = G X̃ the
//! material point that stands at the foot of X̃ on the plane. With ⟨A, B⟩ = tr(A M Bᵀ), summed over both sides,
//!
//!   Σ_l ⟨B_k, B_l⟩ η_l = ⟨B_k, ΠV⟩,   (f | M) = −W M,   W = ΠV − Σ η_k B_k,   power = −⟨W, W⟩
//!
//! Of all these matrices the rows alone are computed along the directions of Π: n, or t₁ and t₂ ([`Rows`]).
//!
//! Coulomb's bound scales all of a friction by σ, with 2R = ⟨W, W⟩ and B = B_A B_B/(B_A + B_B), B_i = ∫κ_i dA: both
//! sides alike, so that the mediator stays as it is (`contact/bound`).

use super::directions::{Directions, NOTHING, Rows, UNIFORM};
use super::fault::PairFault;
use super::laws::{PairLaws, ViscousLaw, raised};
use super::opening::Opening;
use super::placed::Placed;
use super::side::{Half, joined};
use super::{Mat4, Mat34, Vec4};
use crate::contact::{Bound, LawKind, OneSided, Sliding};
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3};
use nalgebra::{Cholesky, Const};

/// How the powers d^−ν′ of two sides are weighed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shares {
    /// μ.
    own: [f64; 2],
    /// ŵ.
    parts: [f64; 2],
    /// 1/ν.
    power: f64,
}

/// A viscous law between two bodies: the mediator moves so as to be in balance.
#[derive(Debug, Clone)]
pub(super) struct Mediator {
    pub kind: LawKind,
    pub directions: Directions,
    /// M.
    pub moments: [Mat4; 2],
    /// B.
    pub fields: [[Rows; 3]; 2],
    /// B M.
    pub pressed: [[Rows; 3]; 2],
    /// W.
    pub slips: [Rows; 2],
    /// W M.
    pub resisted: [Rows; 2],
    /// η.
    pub motion: Vec3,
    pub system: Cholesky<f64, Const<3>>,
    /// G, of friction.
    pub feet: Option<[Foot; 2]>,
    /// Of a friction that has one.
    pub bound: Option<Bound>,
    /// Of a damping that is one-sided.
    pub opening: Option<Opening>,
}

/// G = 1 − a⊗e of a side: e the height of X̃ over the plane, and a how X̃ changes with it along the normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// e = σ z.
    pub heights: Vec4,
    /// a = (0; P⁻¹n).
    pub across: Vec4,
}

impl Shares {
    /// Of λ.
    pub fn of_weights(laws: &PairLaws, weights: [f64; 2]) -> Self {
        let power = 1.0 / laws.repulsion.exponent;
        let own = weights.map(|weight| libm::pow(weight, power));
        let sum = own[0] + own[1];
        Self { own, parts: own.map(|own| own / sum), power }
    }

    /// κ d^ν′ of a side.
    pub fn coefficient(&self, law: &ViscousLaw, side: usize) -> f64 {
        law.coefficient * raised(self.own[side], law.exponent) / self.parts[side]
    }

    /// δ log κ of a side by δ log λ of both.
    pub fn growth(&self, law: &ViscousLaw, side: usize) -> [f64; 2] {
        let mut growth = self.parts.map(|part| self.power * part);
        growth[side] += self.power * (law.exponent - 1.0);
        growth
    }
}

impl Foot {
    fn new(half: &Half, placed: &Placed) -> Self {
        let heights = half.sign * half.heights(&placed.plane);
        Self { heights, across: upright(&(half.side.inverse * placed.plane.normal)) }
    }

    /// G v.
    pub fn image(&self, v: &Vec4) -> Vec4 {
        v - self.heights.dot(v) * self.across
    }

    /// G M Gᵀ = M − a⊗b − b⊗a, b = Me − ½ (e·Me) a.
    pub fn carried(&self, moments: &Mat4) -> Mat4 {
        let pressed = moments * self.heights;
        let cross = self.across * (pressed - 0.5 * self.heights.dot(&pressed) * self.across).transpose();
        moments - cross - cross.transpose()
    }
}

/// (0; v).
pub(super) fn upright(v: &Vec3) -> Vec4 {
    Vec4::new(0.0, v.x, v.y, v.z)
}

/// B of a side.
fn fields(kind: LawKind, placed: &Placed, from_foot: &Mat34) -> [Rows; 3] {
    let (n, [one, other]) = (&placed.plane.normal, &placed.tangents);
    if kind == LawKind::Damping {
        [[UNIFORM, NOTHING], [from_foot.tr_mul(one), NOTHING], [from_foot.tr_mul(other), NOTHING]]
    } else {
        // t·(n × x) = (t × n)·x.
        let spin = [one, other].map(|tangent| from_foot.tr_mul(&tangent.cross(n)));
        [[UNIFORM, NOTHING], [NOTHING, UNIFORM], spin]
    }
}

/// Σ η_k B_k.
fn combined(motion: &Vec3, fields: &[Rows; 3]) -> Rows {
    [0, 1].map(|k| motion.x * fields[0][k] + motion.y * fields[1][k] + motion.z * fields[2][k])
}

/// η and W of a motion ΠV.
fn slipped(
    directions: &Directions,
    system: &Cholesky<f64, Const<3>>,
    (pressed, fields): (&[[Rows; 3]; 2], &[[Rows; 3]; 2]),
    mut moved: [Rows; 2],
) -> (Vec3, [Rows; 2]) {
    let mut right = Vec3::zeros();
    for (pressed, moved) in pressed.iter().zip(&moved) {
        right += Vec3::from_fn(|k, _| directions.product(&pressed[k], moved));
    }
    let motion = system.solve(&right);
    for (slip, fields) in moved.iter_mut().zip(fields) {
        let carried = combined(&motion, fields);
        slip.iter_mut().zip(&carried).for_each(|(slip, carried)| *slip -= carried);
    }
    (motion, moved)
}

/// M of a side, given κ d^ν′.
fn weighed(coefficient: f64, feet: Option<&[Foot; 2]>, side: usize, moments: &Moments) -> Mat4 {
    let Moments { zeroth, first, second, .. } = moments;
    let whole = coefficient * joined(*zeroth, first, second);
    feet.map_or(whole, |feet| feet[side].carried(&whole))
}

/// B_A B_B/(B_A + B_B).
fn in_series([above, below]: [f64; 2]) -> f64 {
    above * (below / (above + below))
}

/// (p₀ − foot | P) of a side, both places from A's centre.
pub(super) fn from_foot(half: &Half, foot: &Vec3) -> Mat34 {
    let mut columns = half.columns;
    let shifted = columns.column(0) - foot;
    columns.set_column(0, &shifted);
    columns
}

impl Mediator {
    /// The moments of d^−ν′ of both sides, by side, and where the one of this law stands among them.
    pub fn new(
        law: &ViscousLaw,
        halves: [&Half; 2],
        (placed, shares): (&Placed, &Shares),
        foot: &Vec3,
        moments: [&Moments; 2],
    ) -> Result<Self, PairFault> {
        let kind = law.kind;
        let directions = Directions::of(kind, placed);
        let feet = (kind == LawKind::Friction).then(|| halves.map(|half| Foot::new(half, placed)));
        let moments = [0, 1].map(|side| weighed(shares.coefficient(law, side), feet.as_ref(), side, moments[side]));
        let fields = halves.map(|half| fields(kind, placed, &from_foot(half, foot)));
        let moved = halves.map(|half| directions.rows(&half.rates()));
        let pressed = [0, 1].map(|side| fields[side].map(|field| directions.times(&field, &moments[side])));
        let mut matrix = Mat3::zeros();
        for (pressed, fields) in pressed.iter().zip(&fields) {
            // What a Cholesky factorization reads.
            for k in 0..3 {
                for l in 0..=k {
                    matrix[(k, l)] += directions.product(&pressed[k], &fields[l]);
                }
            }
        }
        let system = matrix.cholesky().ok_or(PairFault::Singular(law.kind))?;
        let (motion, slips) = slipped(&directions, &system, (&pressed, &fields), moved);
        let resisted = [0, 1].map(|side| directions.times(&slips[side], &moments[side]));
        let (bound, opening) = (None, None);
        let mut found =
            Self { kind, directions, moments, fields, pressed, slips, resisted, motion, system, feet, bound, opening };
        if let Some(release) = law.release {
            found.open(OneSided(release));
        }
        found.bound = law.mu.map(|mu| {
            let resistance = in_series(found.resistances());
            Bound::new(mu, Sliding { lost: -found.viscous_power(), resistance, push: placed.push() })
        });
        Ok(found)
    }

    /// Makes it that of a one-sided damping.
    fn open(&mut self, one_sided: OneSided) {
        let Self { directions, moments, .. } = self;
        let moved = [[UNIFORM, NOTHING], [NOTHING; 2]];
        let (motion, slips) = slipped(directions, &self.system, (&self.pressed, &self.fields), moved);
        let resisted = [0, 1].map(|side| directions.times(&slips[side], &moments[side]));
        let product =
            |other: &[Rows; 2]| -> f64 { (0..2).map(|side| directions.product(&resisted[side], &other[side])).sum() };
        let resistance = product(&slips);
        if resistance <= 0.0 {
            return;
        }
        let speed = product(&self.slips) / resistance;
        let shift = one_sided.shift(speed);
        for side in 0..2 {
            self.slips[side][0] += shift.by * slips[side][0];
            self.resisted[side][0] += shift.by * resisted[side][0];
        }
        self.motion += shift.by * motion;
        self.opening = Some(Opening { shift, speed, resistance, slips, resisted, motion });
    }

    /// (f | M) on a side.
    pub fn loads(&self, side: usize) -> Mat34 {
        let viscous = self.viscous(side);
        self.bound.as_ref().map_or(viscous, |bound| bound.factor() * viscous)
    }

    /// (f | M) on a part of a side, given κ d^ν′ and the moments of d^−ν′ over it.
    pub fn on_part(&self, side: usize, coefficient: f64, moments: &Moments) -> Mat34 {
        let moments = weighed(coefficient, self.feet.as_ref(), side, moments);
        let viscous = -self.directions.matrix(&self.directions.times(&self.slips[side], &moments));
        self.bound.as_ref().map_or(viscous, |bound| bound.factor() * viscous)
    }

    /// The same of the whole side, without a bound.
    pub(super) fn viscous(&self, side: usize) -> Mat34 {
        -self.directions.matrix(&self.resisted[side])
    }

    /// What it takes from both [W], negative.
    pub fn power(&self) -> f64 {
        let viscous = self.viscous_power();
        self.bound.as_ref().map_or(viscous, |bound| bound.factor() * viscous)
    }

    /// The same without a bound.
    fn viscous_power(&self) -> f64 {
        let taken: f64 = (0..2).map(|side| self.directions.product(&self.resisted[side], &self.slips[side])).sum();
        self.opening.as_ref().map_or(-taken, |opening| opening.power(taken))
    }

    /// B of both sides.
    pub(super) fn resistances(&self) -> [f64; 2] {
        self.moments.each_ref().map(|moments| moments[(0, 0)])
    }
}
