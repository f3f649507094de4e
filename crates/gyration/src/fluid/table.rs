//! The resistance of a surface as it deforms: matrices at the nodes of a lattice, and what is between them.
//!
//!   H(E) = A(E) C(E) A(E)ᵀ,   C(E) = Σ w_k C_k,   C_k = A_k⁻¹ H_k A_k⁻ᵀ      (`lattice`, `reference`)
//!
//! A matrix is computed when a simplex is entered that has its node for a corner, and kept. Which ones depends on
//! nothing but E, so that a run that is resumed, or made on other threads, sees the same numbers. **When**: in each
//! simplex that is entered, one more matrix at its centre of gravity is compared with the interpolant there. If the
//! power of any motion differs by more than the tolerance, there is no resistance: nothing goes on with less than was
//! asked for.
//!
//! Unless it is given, the spacing is 2⁻ⁿ, the first of ½, ¼, … at which the error beside the undeformed form is a
//! quarter of the tolerance: the error falls with the square of the spacing, and it may be four times as large
//! elsewhere.

use super::lattice::{CORNERS, LatticePlace, Node, Simplex, strain};
use super::reference::ReferenceEllipsoid;
use super::stretch::{PrincipalStretch, Strain};
use crate::inadmissible::Quantity;
use crate::load::Mat12;
use crate::tensor::Mat3;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt::Debug;
use std::sync::{Arc, Mutex, PoisonError};

/// A surface whose resistance can be computed, at a price.
pub trait ResistanceSource: Debug + Send + Sync {
    /// H(E) for viscosity 1, symmetric and positive definite, of the image of the surface under a symmetric E of
    /// determinant 1, about the centre of its volume.
    ///
    /// # Errors
    /// [`NoMatrix`].
    fn matrix(&self, stretch: &Mat3) -> Result<Mat12, NoMatrix>;
}

/// Why there is no matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoMatrix {
    /// Its estimated relative error is too large; NaN where there is none.
    Inexact(f64),
    /// Whoever wants it waits no longer. It may be asked for again.
    Interrupted,
}

/// How a table is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// The largest relative error of the power of any motion by interpolation.
    pub tolerance: f64,
    /// h, if it is given.
    pub spacing: Option<f64>,
}

/// What stands in the way of a resistance, and by how much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnresolvedForm {
    /// `Elements`, `Interpolation` or `Interruption`.
    pub quantity: Quantity,
    /// The relative error.
    pub value: f64,
}

/// The matrices C at the corners of a simplex.
pub type Corners = [Arc<Mat12>; CORNERS];

/// The resistance of a surface under any E.
#[derive(Debug)]
pub struct ResistanceTable {
    source: Box<dyn ResistanceSource>,
    /// B, whose B Bᵀ are the squares of the ellipsoid of the same second moments \[m\].
    root: Mat3,
    resolution: Resolution,
    known: Mutex<Known>,
}

/// What has been computed.
#[derive(Debug, Default)]
struct Known {
    spacing: Option<f64>,
    nodes: BTreeMap<Node, Arc<Mat12>>,
    simplices: BTreeMap<Simplex, Result<Arc<Corners>, UnresolvedForm>>,
}

/// C around a place.
#[derive(Debug, Clone)]
pub struct FormInterpolant {
    place: LatticePlace,
    spacing: f64,
    corners: Arc<Corners>,
}

/// The spacing that is tried first, and the finest.
const COARSEST: f64 = 0.5;
const FINEST: f64 = 1.0 / 64.0;
/// By how much the error may be larger elsewhere than beside the undeformed form.
const MARGIN: f64 = 4.0;

impl ResistanceTable {
    /// The table of a surface, of which nothing is computed yet. `second` = ∫ x ⊗ x dV/V about the centre of its volume
    /// \[m²\], without turn and deformation; none where that is not positive definite.
    pub fn new(source: Box<dyn ResistanceSource>, second: &Mat3, resolution: Resolution) -> Option<Self> {
        // Of an ellipsoid, a_i² = 5 ∫ x_i² dV/V.
        let root = (5.0 * second).cholesky()?.l();
        Some(Self { source, root, resolution, known: Mutex::default() })
    }

    /// H(E) for viscosity 1, of a symmetric E of determinant 1.
    ///
    /// # Errors
    /// [`UnresolvedForm`] where it is not known as well as was asked for, or not at all.
    pub fn matrix(&self, stretch: &Mat3) -> Result<Mat12, UnresolvedForm> {
        let stretch = PrincipalStretch::of(stretch);
        let ratio = self.around(&stretch)?.ratio();
        Ok(self.reference(&stretch)?.resistance(&ratio))
    }

    /// The ellipsoid that stands for the surface under E.
    ///
    /// # Errors
    /// [`UnresolvedForm`] where the form is so extreme that rounding leaves no positive resistance.
    pub(super) fn reference(&self, stretch: &PrincipalStretch) -> Result<ReferenceEllipsoid, UnresolvedForm> {
        ReferenceEllipsoid::of(&self.root, stretch)
            .ok_or(UnresolvedForm { quantity: Quantity::Elements, value: f64::NAN })
    }

    /// C around E.
    ///
    /// # Errors
    /// [`UnresolvedForm`] where the interpolant is not as near to the matrices as was asked for, or where there is no
    /// matrix.
    pub(super) fn around(&self, stretch: &PrincipalStretch) -> Result<FormInterpolant, UnresolvedForm> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let spacing = self.spacing(&mut known)?;
        let place = LatticePlace::of(&stretch.strain(), spacing)
            .ok_or(UnresolvedForm { quantity: Quantity::Elements, value: f64::NAN })?;
        let corners = match known.simplices.get(&place.simplex) {
            Some(found) => found.clone()?,
            None => {
                let found = self.resolved(&place.simplex, spacing, &mut known.nodes);
                // What was given up is no answer.
                if !matches!(found, Err(UnresolvedForm { quantity: Quantity::Interruption, .. })) {
                    known.simplices.insert(place.simplex, found.clone());
                }
                found?
            }
        };
        Ok(FormInterpolant { place, spacing, corners })
    }

    /// How many matrices have been computed for nodes, and how many simplices have been entered, each of which took one
    /// more.
    pub fn size(&self) -> (usize, usize) {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        (known.nodes.len(), known.simplices.len())
    }

    fn spacing(&self, known: &mut Known) -> Result<f64, UnresolvedForm> {
        if let Some(spacing) = self.resolution.spacing.or(known.spacing) {
            return Ok(spacing);
        }
        let mut spacing = COARSEST;
        loop {
            let mut nodes = BTreeMap::new();
            let place = LatticePlace::of(&Strain::zeros(), spacing);
            let simplex = place.ok_or(UnresolvedForm { quantity: Quantity::Elements, value: f64::NAN })?.simplex;
            let corners = self.corners(&simplex, spacing, &mut nodes)?;
            let error = self.error(&simplex, spacing, &corners)?;
            if error <= self.resolution.tolerance / MARGIN || spacing <= FINEST {
                known.nodes = nodes;
                known.spacing = Some(spacing);
                return Ok(spacing);
            }
            spacing *= 0.5;
        }
    }

    fn resolved(
        &self,
        simplex: &Simplex,
        spacing: f64,
        nodes: &mut BTreeMap<Node, Arc<Mat12>>,
    ) -> Result<Arc<Corners>, UnresolvedForm> {
        let corners = self.corners(simplex, spacing, nodes)?;
        let error = self.error(simplex, spacing, &corners)?;
        if error.is_nan() || error > self.resolution.tolerance {
            return Err(UnresolvedForm { quantity: Quantity::Interpolation, value: error });
        }
        Ok(Arc::new(corners))
    }

    fn corners(
        &self,
        simplex: &Simplex,
        spacing: f64,
        nodes: &mut BTreeMap<Node, Arc<Mat12>>,
    ) -> Result<Corners, UnresolvedForm> {
        let mut found = Vec::with_capacity(CORNERS);
        for node in simplex.corners() {
            let corner = match nodes.entry(node) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(free) => free.insert(Arc::new(self.ratio(&strain(&node, spacing))?)),
            };
            found.push(Arc::clone(corner));
        }
        found.try_into().map_err(|_| UnresolvedForm { quantity: Quantity::Elements, value: f64::NAN })
    }

    /// C of the matrix at s itself.
    fn ratio(&self, strain: &Strain) -> Result<Mat12, UnresolvedForm> {
        let fault = |value| UnresolvedForm { quantity: Quantity::Elements, value };
        let stretch = PrincipalStretch::at(strain);
        let reference = self.reference(&stretch)?;
        let matrix = self.source.matrix(&stretch.matrix()).map_err(|none| match none {
            NoMatrix::Inexact(error) => fault(error),
            NoMatrix::Interrupted => UnresolvedForm { quantity: Quantity::Interruption, value: f64::NAN },
        })?;
        reference.ratio(&matrix).ok_or_else(|| fault(f64::NAN))
    }

    /// The relative error of the interpolant at the centre of a simplex.
    fn error(&self, simplex: &Simplex, spacing: f64, corners: &Corners) -> Result<f64, UnresolvedForm> {
        let exact = self.ratio(&simplex.center(spacing))?;
        let mean = corners.iter().map(|corner| **corner).sum::<Mat12>() / CORNERS as f64;
        Ok(largest_error(&mean, &exact))
    }
}

/// The relative error of the power x·H x for the motion where it is largest: the largest |λ| of (H̃ − H) x = λ H x; NaN
/// unless H is positive definite. It is the same of H = A C Aᵀ and of C.
pub fn largest_error(approximate: &Mat12, exact: &Mat12) -> f64 {
    let relative = exact.cholesky().and_then(|factor| {
        let lower = factor.l();
        let half = lower.solve_lower_triangular(&(approximate - exact))?;
        lower.solve_lower_triangular(&half.transpose())
    });
    relative.map_or(f64::NAN, |relative| {
        let symmetric = 0.5 * (relative + relative.transpose());
        let eigenvalues = nalgebra::DMatrix::from_column_slice(12, 12, symmetric.as_slice()).symmetric_eigenvalues();
        eigenvalues.amax()
    })
}

impl FormInterpolant {
    /// C.
    pub fn ratio(&self) -> Mat12 {
        self.corners.iter().zip(self.place.weights).map(|(corner, weight)| **corner * weight).sum()
    }

    /// ∂C/∂s_m times a vector, for all m.
    pub fn slopes_on(&self, vector: &nalgebra::SVector<f64, 12>) -> [nalgebra::SVector<f64, 12>; 5] {
        let images: [_; CORNERS] = std::array::from_fn(|k| *self.corners[k] * vector);
        let mut slopes = [nalgebra::SVector::zeros(); 5];
        for k in 1..CORNERS {
            slopes[self.place.simplex.axis(k)] = (images[k] - images[k - 1]) / self.spacing;
        }
        slopes
    }
}

#[cfg(test)]
mod tests;
