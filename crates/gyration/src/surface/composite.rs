//! The surface of a body: flat facets and smooth patches, of which any number make one surface.

use super::curved::{ConeWall, CylinderWall, Disk, Ellipsoid, Hemisphere, Patch, Primitive, Sphere, Torus};
use super::facets::{BATCH, Facets, FacetsError};
use super::gap::{GapClosed, GapField};
use super::moments::{AxialMoments, Kernel, MomentRequest, Moments};
use super::oriented::OrientedMoments;
use super::plan::MomentPlan;
use crate::extended::Extended;
use crate::tensor::{Mat3, Vec3};

/// The surface of a body: flat facets and smooth patches, with X relative to any origin.
///
/// Constructors put the origin at the centre of symmetry and the axis along z; cylinder, cone and capsule are centred
/// at mid-height, the base of a cone at −h/2 and its apex at +h/2.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Triangles.
    pub facets: Facets,
    /// Smooth pieces.
    pub patches: Vec<Patch>,
}

impl Surface {
    /// A sphere of radius R [m].
    pub fn sphere(radius: f64) -> Self {
        Self::from_patches(vec![Patch::new(Primitive::Sphere(Sphere { radius }))])
    }

    /// An ellipsoid with semi-axes [m] along x, y, z.
    pub fn ellipsoid(semi_axes: &Vec3) -> Self {
        Self::from_patches(vec![Patch::new(Primitive::Ellipsoid(Ellipsoid { semi_axes: *semi_axes }))])
    }

    /// A closed cylinder of radius R and height h [m].
    pub fn cylinder(radius: f64, height: f64) -> Self {
        let wall = Patch::new(Primitive::CylinderWall(CylinderWall { radius, height }));
        let end = Patch::new(Primitive::Disk(Disk { radius }));
        Self::from_patches(vec![wall, end.lifted(0.5 * height), end.lifted(-0.5 * height)])
    }

    /// A closed cone of base radius R and height h [m], apex up.
    pub fn cone(radius: f64, height: f64) -> Self {
        let wall = Patch::new(Primitive::ConeWall(ConeWall { radius, height }));
        let base = Patch::new(Primitive::Disk(Disk { radius }));
        Self::from_patches(vec![wall, base.lifted(-0.5 * height)])
    }

    /// A cylinder of radius R and height h [m] between two hemispheres.
    pub fn capsule(radius: f64, height: f64) -> Self {
        let wall = Patch::new(Primitive::CylinderWall(CylinderWall { radius, height }));
        let top = Patch::new(Primitive::Hemisphere(Hemisphere { radius })).lifted(0.5 * height);
        let half_turn = Mat3::from_diagonal(&Vec3::new(1.0, -1.0, -1.0));
        Self::from_patches(vec![wall, top, top.transformed(&half_turn, &Vec3::zeros())])
    }

    /// A torus: a tube of radius r around a circle of radius R ≥ r [m].
    pub fn torus(major_radius: f64, minor_radius: f64) -> Self {
        Self::from_patches(vec![Patch::new(Primitive::Torus(Torus { major_radius, minor_radius }))])
    }

    /// A box with the given edge lengths [m].
    pub fn cuboid(size: &Vec3) -> Self {
        Self::from_facets(Facets::cuboid(size))
    }

    /// Triangles given by vertices [m] and corner indices, counter-clockwise seen from outside.
    ///
    /// # Errors
    /// Those of [`Facets::new`].
    pub fn from_triangles(vertices: &[Vec3], triangles: &[[usize; 3]]) -> Result<Self, FacetsError> {
        Facets::new(vertices, triangles).map(Self::from_facets)
    }

    /// A surface of facets only.
    pub fn from_facets(facets: Facets) -> Self {
        Self { facets, patches: Vec::new() }
    }

    /// A surface of smooth patches only.
    pub fn from_patches(patches: Vec<Patch>) -> Self {
        Self { facets: Facets::default(), patches }
    }

    /// The surface after X ↦ X + by.
    pub fn translated(&self, by: &Vec3) -> Self {
        self.transformed(&Mat3::identity(), by)
    }

    /// The surface after X ↦ rotation · X + offset.
    pub fn transformed(&self, rotation: &Mat3, offset: &Vec3) -> Self {
        Self {
            facets: self.facets.transformed(rotation, offset),
            patches: self.patches.iter().map(|patch| patch.transformed(rotation, offset)).collect(),
        }
    }

    /// Both surfaces as one; every part of each makes contact.
    pub fn merged(&self, other: &Self) -> Self {
        Self { facets: self.facets.merged(&other.facets), patches: [self.patches.as_slice(), &other.patches].concat() }
    }

    /// The radius [m] of one sphere about the origin of X; none of any other surface.
    pub fn ball(&self) -> Option<f64> {
        match self.patches.as_slice() {
            [patch] if self.facets.is_empty() => patch.ball(),
            _ => None,
        }
    }

    /// The distance of its farthest point from the origin of X [m].
    pub fn radius(&self) -> f64 {
        // |X| is the speed of X under the unit gradient rate.
        self.fastest_point(&Vec3::zeros(), &Mat3::identity())
    }

    /// Area [m²].
    pub fn area(&self) -> f64 {
        self.facets.area() + self.patches.iter().map(Patch::area).sum::<f64>()
    }

    /// The moments of `requests`, set in the entries of `out`, about the origin of X.
    ///
    /// Orders above a request's are zero. `out` must be as long as `requests`.
    ///
    /// # Errors
    /// `GapClosed` if the smallest gap is not a positive finite number, or over a smooth patch is positive by no more
    /// than rounding; `out` is then unspecified.
    pub fn moments(&self, field: &GapField, requests: &[MomentRequest], out: &mut [Moments]) -> Result<(), GapClosed> {
        self.planned_moments(field, &MomentPlan::new(requests.to_vec()), out)
    }

    /// [`Surface::moments`] of requests that were planned before.
    ///
    /// # Errors
    /// As there.
    pub fn planned_moments(&self, field: &GapField, plan: &MomentPlan, out: &mut [Moments]) -> Result<(), GapClosed> {
        assert_eq!(plan.requests().len(), out.len(), "one place for each request");
        out.fill(Moments::default());
        for (plan, out) in plan.facets.iter().zip(out.chunks_mut(BATCH)) {
            self.facets.add_planned(field, plan, out)?;
        }
        for patch in &self.patches {
            patch.check_gap(field)?;
            patch.add_moments(field, plan, out);
        }
        Ok(())
    }

    /// The middle of its area, ∫ X dA/∫ dA [m]; none without one.
    pub fn area_center(&self) -> Option<Vec3> {
        let mut found = [Moments::default()];
        let request = MomentRequest { kernel: Kernel::Power(0.0), order: 1 };
        // Of a gap of one everywhere.
        self.moments(&GapField::new(1.0, Vec3::zeros()), &[request], &mut found).ok()?;
        (found[0].zeroth > 0.0).then(|| found[0].first / found[0].zeroth)
    }

    /// The moments of a ball about the origin of X, set in the entries of `out`: arguments as for
    /// [`Surface::planned_moments`]. None of any other surface.
    ///
    /// # Errors
    /// As there.
    pub fn axial_moments(
        &self,
        field: &GapField,
        plan: &MomentPlan,
        out: &mut [AxialMoments],
    ) -> Option<Result<(), GapClosed>> {
        let [patch] = self.patches.as_slice() else { return None };
        let ball = patch.ball().filter(|_| self.facets.is_empty())?;
        Some(patch.check_gap(field).map(|()| Sphere { radius: ball }.axial_moments(field, plan, out)))
    }

    /// The moments per deformed area, ∫ κ k X^⊗n dA, of planned requests, about the origin of X; set in the entries of
    /// `out`.
    ///
    /// `cofactor` is cof(P) = det P P⁻ᵀ (3×3), from which k = |cof(P) N|; `field` has the direction Pᵀn. Orders above a
    /// request's are zero. For a rotation these are [`Surface::planned_moments`].
    ///
    /// # Errors
    /// As there.
    pub fn deformed_moments(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &MomentPlan,
        out: &mut [Moments],
    ) -> Result<(), GapClosed> {
        assert_eq!(plan.requests().len(), out.len(), "one place for each request");
        out.fill(Moments::default());
        for (plan, out) in plan.facets.iter().zip(out.chunks_mut(BATCH)) {
            self.facets.add_deformed(field, cofactor, plan, out)?;
        }
        for patch in &self.patches {
            patch.check_gap(field)?;
            patch.add_deformed(field, cofactor, plan.requests(), out);
        }
        Ok(())
    }

    /// The moments per deformed area weighted with m_a m_b and, for requests of order 0, with m_a m_b m_c m_d; m is the
    /// current unit normal.
    ///
    /// Orders up to 2 are meant; a request of order 0 costs its fifteen components of the fourth power. Arguments as
    /// for [`Surface::deformed_moments`].
    ///
    /// # Errors
    /// As there.
    pub fn oriented_moments(
        &self,
        field: &GapField,
        cofactor: &Mat3,
        plan: &MomentPlan,
        out: &mut [OrientedMoments],
    ) -> Result<(), GapClosed> {
        assert_eq!(plan.requests().len(), out.len(), "one place for each request");
        out.fill(OrientedMoments::default());
        for (plan, out) in plan.facets.iter().zip(out.chunks_mut(BATCH)) {
            self.facets.add_oriented(field, cofactor, plan, out)?;
        }
        for patch in &self.patches {
            patch.check_gap(field)?;
            patch.add_oriented(field, cofactor, plan.requests(), out);
        }
        Ok(())
    }

    /// The smallest gap [m] and the material point where it is; infinite for an empty surface.
    ///
    /// The first gap that is not finite is returned at once.
    pub fn smallest_gap(&self, field: &GapField) -> (f64, Vec3) {
        let mut smallest = self.facets.smallest_gap(field);
        for patch in &self.patches {
            let point = patch.support(&-field.direction);
            let gap = patch.smallest_gap(field);
            if !gap.is_finite() {
                return (gap, point);
            }
            if gap < smallest.0 {
                smallest = (gap, point);
            }
        }
        smallest
    }

    /// The gap field of a direction m in which the smallest gap is the one given [m], to twice the digits where the
    /// surface keeps them.
    pub fn field_at(&self, gap: f64, direction: Vec3) -> GapField {
        let flat = GapField::extended(0.0.into(), &direction.map(Extended::from).into());
        let (lowest, point) = self.smallest_gap(&flat);
        let fall = if self.keeps_digits() { flat.extended_gap(&point) } else { lowest.into() };
        let field = GapField::extended(Extended::from(gap) - fall, &flat.parts().1);
        // What the place of the point on a curved surface is rounded to.
        let left = Extended::from(gap) - self.smallest_gap(&field).0.into();
        if left.value().abs() < 0.5 * gap {
            GapField::extended(field.parts().0 + left, &field.parts().1)
        } else {
            field
        }
    }

    /// Whether the moments of a body that moves rigidly keep the digits of a gap far below its size.
    pub fn keeps_digits(&self) -> bool {
        self.patches.iter().all(Patch::keeps_digits)
    }

    /// Whether all gaps are finite and above a floor [m].
    #[inline]
    pub(crate) fn is_above(&self, field: &GapField, floor: f64) -> bool {
        let fits = |gap: f64| gap > floor && gap < f64::INFINITY;
        let patches = || self.patches.iter().all(|patch| fits(patch.smallest_gap(field)));
        self.facets.are_above(field, floor) && patches()
    }

    /// The largest speed |v + A X| [m/s] on the surface.
    ///
    /// v velocity at the origin of X (3) [m/s], A = Ṗ (3×3) [1/s].
    pub fn fastest_point(&self, v: &Vec3, a: &Mat3) -> f64 {
        let patches = self.patches.iter().map(|patch| patch.fastest_point(v, a));
        patches.fold(self.facets.fastest_point(v, a), f64::max)
    }
}
