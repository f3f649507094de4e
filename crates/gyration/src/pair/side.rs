//! One of the bodies of a pair: its gaps to a plane, and what its surface brings.

use super::laws::PairLaws;
use super::plane::Plane;
use super::{Mat4, Mat34, Vec4};
use crate::contact::Deformation;
use crate::kinematics::{Placement, Velocity};
use crate::surface::{GapClosed, GapField, MomentPlan, Moments, OrientedMoments, Surface};
use crate::tensor::{Mat3, Vec3};

/// σ: A is above the plane, B below.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

/// One of the two bodies, or a convex part of it.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// Its surface, relative to the centre of mass.
    pub surface: &'a Surface,
    /// p₀ and P.
    pub placement: &'a Placement,
    /// The place of its centre of mass from that of A [m]: a difference of places to twice their digits.
    pub from_first: Vec3,
    /// ṗ₀ and Ṗ.
    pub velocity: &'a Velocity,
    /// P⁻¹.
    pub inverse: Mat3,
    /// None of a rigid body, on which all measures of area are the same.
    pub deformation: Option<Deformation>,
    /// A gap that cannot be told from zero [m].
    pub least_gap: f64,
}

/// A side with places taken from the centre of mass of A, from which no large numbers cancel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Half<'a> {
    pub side: &'a Side<'a>,
    /// σ.
    pub sign: f64,
    /// (p₀ − o | P).
    pub columns: Mat34,
    /// √w.
    pub root_share: f64,
    /// cof P, if its areas are those of the deformed body.
    pub cofactor: Option<&'a Mat3>,
}

/// U, and its derivatives by z: U′ = −a, U″ = h.
#[derive(Debug, Clone, Copy)]
pub(super) struct Potential {
    /// U [J].
    pub value: f64,
    /// a = ∫α(d/d₀)^−ν X̃ dA.
    pub first: Vec4,
    /// h = ν ∫(α/d₀)(d/d₀)^−(ν+1) X̃⊗X̃ dA.
    pub second: Mat4,
}

impl Potential {
    /// Of nothing.
    pub const ZERO: Self = Self { value: 0.0, first: Vec4::new(0.0, 0.0, 0.0, 0.0), second: NOTHING };

    /// Adds a multiple of another.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        self.value += factor * other.value;
        self.first += factor * other.first;
        self.second += factor * other.second;
    }

    /// Of c d^−ν, from the moments of d^(1−ν), d^−ν and d^−(ν+1).
    pub fn new(coefficient: f64, exponent: f64, [energy, force, stiffness]: [&Moments; 3]) -> Self {
        Self {
            value: coefficient / (exponent - 1.0) * energy.zeroth,
            first: coefficient * force.joined_first(),
            second: exponent * coefficient * joined(stiffness.zeroth, &stiffness.first, &stiffness.second),
        }
    }
}

#[rustfmt::skip]
const NOTHING: Mat4 = Mat4::new(
    0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0,
    0.0, 0.0, 0.0, 0.0,
);

/// ∫κ X̃⊗X̃ dA from its parts.
pub(super) fn joined(zeroth: f64, first: &Vec3, second: &Mat3) -> Mat4 {
    let mut joined = Mat4::zeros();
    joined[(0, 0)] = zeroth;
    joined.fixed_view_mut::<3, 1>(1, 0).copy_from(first);
    joined.fixed_view_mut::<1, 3>(0, 1).copy_from(&first.transpose());
    joined.fixed_view_mut::<3, 3>(1, 1).copy_from(second);
    joined
}

/// ∫κ (X̃·z) X̃⊗X̃ dA, from moments up to the third.
pub(super) fn contracted(moments: &Moments, z: &Vec4) -> Mat4 {
    let Moments { zeroth, first, second, third } = moments;
    let (height, direction) = (z[0], Vec3::new(z[1], z[2], z[3]));
    joined(
        height * zeroth + direction.dot(first),
        &(height * first + second * direction),
        &(height * second + third.contract(&direction)),
    )
}

impl Side<'_> {
    /// Whether it can only turn: P is a rotation, and stays one.
    pub(super) fn is_rigid(&self) -> bool {
        self.deformation.is_none() && self.inverse == self.placement.gradient.transpose()
    }
}

impl Half<'_> {
    /// z of a plane.
    pub fn heights(&self, plane: &Plane) -> Vec4 {
        let mut heights = self.columns.tr_mul(&plane.normal);
        heights[0] -= plane.offset;
        self.sign * heights
    }

    /// The change of z with that of a plane.
    pub fn heights_by(&self, normal: &Vec3, offset: f64) -> Vec4 {
        let mut heights = self.columns.tr_mul(normal);
        heights[0] -= offset;
        self.sign * heights
    }

    /// Zᵀv: what v·δz is by the turns of n along two tangents and by c.
    pub fn by_plane(&self, tangents: &[Vec3; 2], v: &Vec4) -> Vec3 {
        let carried = self.sign * (self.columns * v);
        Vec3::new(tangents[0].dot(&carried), tangents[1].dot(&carried), -self.sign * v[0])
    }

    /// ZᵀhZ, h symmetric.
    pub fn bent_by_plane(&self, tangents: &[Vec3; 2], h: &Mat4) -> Mat3 {
        let turned = tangents.each_ref().map(|tangent| h * self.heights_by(tangent, 0.0));
        let [one, other] = turned.each_ref().map(|turned| self.by_plane(tangents, turned));
        Mat3::new(one.x, one.y, one.z, one.y, other.y, other.z, one.z, other.z, h[(0, 0)])
    }

    /// The smallest gap to a plane [m] and the material point where it is.
    pub fn smallest_gap(&self, plane: &Plane) -> (f64, Vec3) {
        self.side.surface.smallest_gap(&self.field(plane))
    }

    /// The moments of a plan, in the measure of the pair.
    pub fn moments(&self, plane: &Plane, plan: &MomentPlan, out: &mut [Moments]) -> Result<(), GapClosed> {
        let field = self.field(plane);
        match self.cofactor {
            Some(cofactor) => self.side.surface.deformed_moments(&field, cofactor, plan, out),
            None => self.side.surface.planned_moments(&field, plan, out),
        }
    }

    /// The moments of a plan with the products of the components of the current normal, where areas change.
    pub fn oriented_moments(
        &self,
        plane: &Plane,
        plan: &MomentPlan,
        out: &mut [OrientedMoments],
    ) -> Result<(), GapClosed> {
        let Some(cofactor) = self.cofactor else { return Ok(()) };
        self.side.surface.oriented_moments(&self.field(plane), cofactor, plan, out)
    }

    /// The potential of a plane.
    pub fn potential(&self, laws: &PairLaws, plane: &Plane, room: &mut [Moments]) -> Result<Potential, GapClosed> {
        self.moments(plane, &laws.placing, room)?;
        let [energy, force, stiffness] = room else { unreachable!("the plan of a repulsion has three powers") };
        Ok(Potential::new(laws.coefficient, laws.repulsion.exponent, [energy, force, stiffness]))
    }

    /// The gaps to a plane.
    pub fn field(&self, plane: &Plane) -> GapField {
        let heights = self.heights(plane);
        GapField::new(heights[0], heights.fixed_rows::<3>(1).into())
    }

    /// (ṗ₀ | Ṗ).
    pub fn rates(&self) -> Mat34 {
        columns(&self.side.velocity.velocity, &self.side.velocity.gradient_rate)
    }
}

/// (a | A).
pub(super) fn columns(first: &Vec3, rest: &Mat3) -> Mat34 {
    let mut columns = Mat34::zeros();
    columns.set_column(0, first);
    columns.fixed_view_mut::<3, 3>(0, 1).copy_from(rest);
    columns
}

impl Moments {
    /// ∫κ X̃ dA.
    pub(super) fn joined_first(&self) -> Vec4 {
        let first = &self.first;
        Vec4::new(self.zeroth, first.x, first.y, first.z)
    }
}
