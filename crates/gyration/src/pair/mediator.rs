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

use super::equilibrium::Placed;
use super::expansion::Change;
use super::fault::PairFault;
use super::laws::{PairLaws, ViscousLaw, raised};
use super::side::{Half, joined};
use super::{Mat4, Mat34, Vec4};
use crate::contact::LawKind;
use crate::load::Mat12;
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{Cholesky, Const, SMatrix, SVector};

type Vec12 = SVector<f64, 12>;
type Mat12x3 = SMatrix<f64, 12, 3>;

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
    /// M.
    pub moments: [Mat4; 2],
    /// B.
    fields: [[Mat34; 3]; 2],
    /// ΠV − Σ η_k B_k.
    slips: [Mat34; 2],
    /// η.
    motion: Vec3,
    system: Cholesky<f64, Const<3>>,
    /// G, of friction.
    feet: Option<[Mat4; 2]>,
}

/// The change of M on its way from d^−ν′: what the moments change by with z, before they are weighed.
pub(super) struct Slope {
    /// κ · moments of d^−ν′.
    value: Mat4,
    /// −ν′ κ × the moments of d^−(ν′+1), with one X̃ more.
    raised: Moments,
}

impl Shares {
    pub fn new(laws: &PairLaws, placed: &Placed) -> Self {
        let power = 1.0 / laws.repulsion.exponent;
        let own = placed.weights.map(|weight| libm::pow(weight, power));
        let sum = own[0] + own[1];
        Self { own, parts: own.map(|own| own / sum), power }
    }

    /// κ d^ν′ of a side.
    fn coefficient(&self, law: &ViscousLaw, side: usize) -> f64 {
        law.coefficient * raised(self.own[side], law.exponent) / self.parts[side]
    }

    /// δ log κ, given δ log λ.
    fn growth(&self, law: &ViscousLaw, weights: &[f64; 2], side: usize) -> f64 {
        let mean = self.parts[0] * weights[0] + self.parts[1] * weights[1];
        self.power * ((law.exponent - 1.0) * weights[side] + mean)
    }
}

/// G of a side: X̃ of the material point that stands at the foot of another on the plane.
fn feet(half: &Half, placed: &Placed) -> Mat4 {
    let across = half.side.inverse * placed.plane.normal;
    let heights = half.sign * half.heights(&placed.plane);
    Mat4::identity() - upright(&across) * heights.transpose()
}

/// (0; v).
fn upright(v: &Vec3) -> Vec4 {
    Vec4::new(0.0, v.x, v.y, v.z)
}

/// n⊗n or 1 − n⊗n.
fn projector(kind: LawKind, n: &Vec3) -> Mat3 {
    let along = n * n.transpose();
    if kind == LawKind::Damping { along } else { Mat3::identity() - along }
}

/// B of a side.
fn fields(kind: LawKind, placed: &Placed, from_foot: &Mat34) -> [Mat34; 3] {
    let (n, [one, other]) = (&placed.plane.normal, &placed.tangents);
    if kind == LawKind::Damping {
        let tilt = |tangent: &Vec3| n * from_foot.tr_mul(tangent).transpose();
        [uniform(n), tilt(one), tilt(other)]
    } else {
        [uniform(one), uniform(other), cross_matrix(n) * from_foot]
    }
}

/// The field that is v everywhere.
fn uniform(v: &Vec3) -> Mat34 {
    let mut uniform = Mat34::zeros();
    uniform.set_column(0, v);
    uniform
}

/// Σ η_k B_k.
fn combined(motion: &Vec3, fields: &[Mat34; 3]) -> Mat34 {
    motion.x * fields[0] + motion.y * fields[1] + motion.z * fields[2]
}

/// B_k · A of each k.
fn along(fields: &[Mat34; 3], weighed: &Mat34) -> Vec3 {
    Vec3::from_fn(|k, _| fields[k].dot(weighed))
}

/// (p₀ − foot | P) of a side, both places from A's centre.
fn from_foot(half: &Half, foot: &Vec3) -> Mat34 {
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
        let feet = (kind == LawKind::Friction).then(|| halves.map(|half| feet(half, placed)));
        let moments = [0, 1].map(|side| {
            let Moments { zeroth, first, second, .. } = moments[side];
            let whole = shares.coefficient(law, side) * joined(*zeroth, first, second);
            feet.map_or(whole, |feet| feet[side] * whole * feet[side].transpose())
        });
        let fields = halves.map(|half| fields(kind, placed, &from_foot(half, foot)));
        let projector = projector(kind, &placed.plane.normal);
        let mut slips = halves.map(|half| projector * half.rates());
        let (mut matrix, mut right) = (Mat3::zeros(), Vec3::zeros());
        for side in 0..2 {
            for k in 0..3 {
                let weighed = fields[side][k] * moments[side];
                right[k] += weighed.dot(&slips[side]);
                for l in 0..3 {
                    matrix[(k, l)] += weighed.dot(&fields[side][l]);
                }
            }
        }
        let system = matrix.cholesky().ok_or(PairFault::Singular(law.kind))?;
        let motion = system.solve(&right);
        for (slip, fields) in slips.iter_mut().zip(&fields) {
            *slip -= combined(&motion, fields);
        }
        Ok(Self { kind, moments, fields, slips, motion, system, feet })
    }

    /// (f | M) on a side.
    pub fn loads(&self, side: usize) -> Mat34 {
        -(self.slips[side] * self.moments[side])
    }

    /// What it takes from both [W], negative.
    pub fn power(&self) -> f64 {
        -(0..2).map(|side| (self.slips[side] * self.moments[side]).dot(&self.slips[side])).sum::<f64>()
    }

    /// Adds the derivatives of (f | M) on each side by the motion of each, places kept.
    ///
    ///   ∂(f | M)_i/∂V_j = G_i S⁻¹ G_jᵀ − δ_ij M_i⊗Π,   G_i = (B_1M_i, B_2M_i, B_3M_i),   S_kl = Σ ⟨B_k, B_l⟩
    ///
    /// G is 12×3; the B_k lie in the image of Π.
    pub fn add_by_rates(&self, normal: &Vec3, slopes: &mut [[Mat12; 2]; 2]) {
        let projector = projector(self.kind, normal);
        let pressed = [0, 1].map(|side| {
            let columns =
                self.fields[side].map(|field| Vec12::from_column_slice((field * self.moments[side]).as_slice()));
            Mat12x3::from_columns(&columns)
        });
        for (body, pressed_by) in pressed.iter().enumerate() {
            let motion = self.system.solve(&pressed_by.transpose());
            for (side, pressed) in pressed.iter().enumerate() {
                slopes[side][body] += pressed * motion;
            }
            slopes[body][body] -= self.moments[body].kronecker(&projector);
        }
    }

    /// The change of (f | M) on both sides with the places of both, (δq_A, δq_B), motions kept.
    pub fn along_places(
        &self,
        law: &ViscousLaw,
        halves: [&Half; 2],
        (placed, shares): (&Placed, &Shares),
        (foot, slopes): (&Vec3, &[Slope; 2]),
        (places, change): ([&Mat34; 2], &Change),
    ) -> [Mat34; 2] {
        let n = &placed.plane.normal;
        let turned = placed.tangents.map(|tangent| -n * tangent.dot(&change.normal));
        let (mut moments, mut slips, mut right) = ([Mat4::zeros(); 2], [Mat34::zeros(); 2], Vec3::zeros());
        let mut fields = [[Mat34::zeros(); 3]; 2];
        for side in 0..2 {
            let (half, place) = (halves[side], places[side]);
            moments[side] = self.moments_along(law, (half, side), placed, &slopes[side], (place, change), shares);
            let from_foot = from_foot(half, foot);
            fields[side] = if self.kind == LawKind::Damping {
                let tilt = |k: usize| {
                    let row = (from_foot.tr_mul(&turned[k]) + place.tr_mul(&placed.tangents[k])).transpose();
                    change.normal * from_foot.tr_mul(&placed.tangents[k]).transpose() + n * row
                };
                [uniform(&change.normal), tilt(0), tilt(1)]
            } else {
                let spin = cross_matrix(&change.normal) * from_foot + cross_matrix(n) * place;
                [uniform(&turned[0]), uniform(&turned[1]), spin]
            };
            let rates = half.rates();
            let sign = if self.kind == LawKind::Damping { 1.0 } else { -1.0 };
            slips[side] =
                sign * (change.normal * rates.tr_mul(n).transpose() + n * rates.tr_mul(&change.normal).transpose());
            slips[side] -= combined(&self.motion, &fields[side]);
            let pressed = self.slips[side] * self.moments[side];
            let changed = self.slips[side] * moments[side] + slips[side] * self.moments[side];
            right += along(&fields[side], &pressed) + along(&self.fields[side], &changed);
        }
        let motion = self.system.solve(&right);
        [0, 1].map(|side| {
            let carried = combined(&motion, &self.fields[side]);
            -((slips[side] - carried) * self.moments[side] + self.slips[side] * moments[side])
        })
    }

    /// δM of a side.
    fn moments_along(
        &self,
        law: &ViscousLaw,
        (half, side): (&Half, usize),
        placed: &Placed,
        slope: &Slope,
        (place, change): (&Mat34, &Change),
        shares: &Shares,
    ) -> Mat4 {
        let heights = &change.heights[side];
        let changed = shares.growth(law, &change.weights, side) * slope.value + slope.along(heights);
        let Some(feet) = &self.feet else { return changed };
        let (n, inverse, feet) = (&placed.plane.normal, &half.side.inverse, &feet[side]);
        let across = inverse * n;
        let gradient = place.fixed_columns::<3>(1);
        let turned = inverse * (change.normal - gradient * across);
        let moved = -half.sign
            * (upright(&turned) * half.heights(&placed.plane).transpose() + upright(&across) * heights.transpose());
        let cross = moved * slope.value * feet.transpose();
        feet * changed * feet.transpose() + cross + cross.transpose()
    }
}

impl Slope {
    /// From the moments of ν′ and of ν′ + 1 of a side.
    pub fn new(law: &ViscousLaw, shares: &Shares, side: usize, moments: &[Moments]) -> Self {
        let coefficient = shares.coefficient(law, side);
        let [value, mut raised] = law.slopes.map(|place| moments[place]);
        raised.scale(-law.exponent * coefficient);
        Self { value: coefficient * joined(value.zeroth, &value.first, &value.second), raised }
    }

    /// The change with z.
    fn along(&self, heights: &Vec4) -> Mat4 {
        let Moments { zeroth, first, second, third } = &self.raised;
        let (height, direction) = (heights[0], Vec3::new(heights[1], heights[2], heights[3]));
        joined(
            height * zeroth + direction.dot(first),
            &(height * first + second * direction),
            &(height * second + third.contract(&direction)),
        )
    }
}
