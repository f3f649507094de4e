//! The ellipsoid with the second moments of a body, as the measure of its resistance.
//!
//!   H = A C Aᵀ,   A Aᵀ = H_e,   A lower triangular      (Cholesky)
//!
//! H_e is the resistance of that ellipsoid, image of the reference one under E, in closed form. C is I of an ellipsoid,
//! and of any other body it changes much less with the form than H does. With K = A⁻¹ δH_e A⁻ᵀ,
//!
//!   δA = A Φ(K),   Φ the part below the diagonal and half of that on it
//!
//! so that positive definite C make positive definite H, and derivatives of H are exact where those of C are.

use super::ellipsoid::{FluidEllipsoid, FormSlope};
use super::fixed::{FixedForm, packed, parted};
use super::stretch::PrincipalStretch;
use crate::load::Mat12;
use crate::tensor::Mat3;
use nalgebra::SVector;
use std::f64::consts::PI;

/// An ellipsoid in the place of a body, for viscosity 1.
#[derive(Debug, Clone, Copy)]
pub struct ReferenceEllipsoid {
    /// The ellipsoid.
    pub ellipsoid: FluidEllipsoid,
    /// E B Bᵀ with the squares B Bᵀ of the reference ellipsoid.
    swept: Mat3,
    /// A.
    pub lower: Mat12,
}

impl ReferenceEllipsoid {
    /// The image under E of the ellipsoid of the squares B Bᵀ \[m²\]; none where rounding leaves no positive
    /// resistance.
    pub fn of(root: &Mat3, stretch: &PrincipalStretch) -> Option<Self> {
        let carried = stretch.matrix() * root;
        let ellipsoid = FluidEllipsoid::of(&carried, 1.0);
        let lower = FixedForm::of(&ellipsoid).cholesky()?.l();
        Some(Self { ellipsoid, swept: carried * root.transpose(), lower })
    }

    /// C of H; none where H is not finite.
    pub fn ratio(&self, matrix: &Mat12) -> Option<Mat12> {
        let half = self.lower.solve_lower_triangular(matrix)?;
        let ratio = self.lower.solve_lower_triangular(&half.transpose())?;
        ratio.iter().all(|entry| entry.is_finite()).then(|| 0.5 * (ratio + ratio.transpose()))
    }

    /// H of C.
    pub fn resistance(&self, ratio: &Mat12) -> Mat12 {
        self.lower * ratio * self.lower.transpose()
    }

    /// ∂A/∂s_m.
    pub fn slopes(&self, stretch: &PrincipalStretch) -> [Mat12; 5] {
        let forms = std::array::from_fn(|m| {
            // Q = E B Bᵀ E.
            let half = self.swept * stretch.along(m);
            self.ellipsoid.along_form(&self.ellipsoid.seen(&(half + half.transpose())))
        });
        self.resistance_along(&forms).map(|change| {
            let mut part = self.ratio(&change).unwrap_or_else(|| Mat12::from_element(f64::NAN));
            part.fill_upper_triangle(0.0, 1);
            for k in 0..12 {
                part[(k, k)] *= 0.5;
            }
            self.lower * part
        })
    }

    /// δH_e along changes of form that keep the volume.
    fn resistance_along(&self, forms: &[FormSlope; 5]) -> [Mat12; 5] {
        let Self { ellipsoid, .. } = self;
        let [a, b, c] = ellipsoid.squares;
        let volume = 4.0 / 3.0 * PI * (a * b * c).sqrt();
        let mut changes = [Mat12::zeros(); 5];
        for place in 0..12 {
            let (velocity, gradient) = parted(&SVector::ith(place, 1.0));
            let (velocity, gradient) = (ellipsoid.axes.tr_mul(&velocity), ellipsoid.seen(&gradient));
            let stress = ellipsoid.stress(&gradient, &Mat3::zeros());
            for (change, form) in changes.iter_mut().zip(forms) {
                let force = ellipsoid.axes * ellipsoid.force_along(form, &velocity);
                let couple = volume * ellipsoid.shown(&ellipsoid.stress_along(form, &stress, &gradient));
                change.set_column(place, &-packed(&force, &couple));
            }
        }
        changes.map(|change| 0.5 * (change + change.transpose()))
    }
}

#[cfg(test)]
mod tests {
    use super::super::stretch::Strain;
    use super::*;

    #[test]
    fn slopes_are_those_of_the_factor() {
        let root = Mat3::new(0.5, 0.0, 0.0, 0.1, 0.3, 0.0, -0.05, 0.08, 0.4);
        let step = 1e-5;
        for s in [Strain::zeros(), Strain::from([0.3, -0.2, 0.5, 0.1, -0.4])] {
            let at = |s: &Strain| {
                let stretch = PrincipalStretch::at(s);
                (ReferenceEllipsoid::of(&root, &stretch).unwrap_or_else(|| panic!("{s}")), stretch)
            };
            let (here, stretch) = at(&s);
            for (m, slope) in here.slopes(&stretch).iter().enumerate() {
                let lower = |sign: f64| at(&(s + Strain::ith(m, sign * step))).0.lower;
                let difference = (lower(1.0) - lower(-1.0)) / (2.0 * step);
                // Third derivatives are of the order of A, which is about 5: step².
                assert!((difference - slope).norm() < 1e-8, "{m}: {}", (difference - slope).norm());
            }
            let own = here.resistance(&Mat12::identity());
            let ratio = here.ratio(&own).unwrap_or_else(Mat12::zeros);
            assert!((ratio - Mat12::identity()).norm() < 1e-12);
        }
    }
}
