//! Mass, centre of mass and Euler tensor of a body in its reference shape.
//!
//!   m = ∫ρ dV,   X₀ = (1/m) ∫ρ X dV,   J = ∫ρ (X−X₀)⊗(X−X₀) dV,
//!
//! J symmetric, positive semi-definite \[kg m²\]. The inertia tensor of rigid mechanics is tr(J) I − J. About another
//! point J_p = J + m (X₀−X_p)⊗(X₀−X_p); under X → R X + a, J → R J Rᵀ. Source: `docs/theory-rigid.md`.
//!
//! Nothing here knows a shape: the integrals are the shapes' business.

use crate::tensor::{Mat3, Vec3};

/// Asymmetry of an Euler tensor that is rounding, relative to its largest entry.
const SYMMETRY_TOLERANCE: f64 = 1e-9;
/// Negative principal value of an Euler tensor that is rounding, relative to the largest one.
const DEFINITENESS_TOLERANCE: f64 = 1e-12;

/// Mass properties of a body in the frame of its shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// m \[kg\].
    pub mass: f64,
    /// X₀, the centre of mass in the shape's frame \[m\].
    pub center: Vec3,
    /// J = ∫ρ (X−X₀)⊗(X−X₀) dV about the centre of mass \[kg m²\].
    pub euler_tensor: Mat3,
    /// V, the volume of the shape \[m³\]; 0 for a set of points.
    pub volume: f64,
}

/// Principal values of an Euler tensor, ascending, and their axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalMoments {
    /// J₁ ≤ J₂ ≤ J₃ \[kg m²\].
    pub values: Vec3,
    /// The unit axes as columns, right-handed.
    pub axes: Mat3,
}

/// Mass properties that no body can have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MassError {
    /// m is zero, negative or not a number.
    #[error("mass is {value} kg: it must be finite and > 0")]
    MassNotPositive {
        /// The mass \[kg\].
        value: f64,
    },
    /// The volume is negative or not a number.
    #[error("volume is {value} m³: it must be finite and ≥ 0")]
    VolumeNegative {
        /// The volume \[m³\].
        value: f64,
    },
    /// A component is infinite or not a number.
    #[error("{quantity} has the component {value}: it must be finite")]
    NotFinite {
        /// Which quantity.
        quantity: &'static str,
        /// The component.
        value: f64,
    },
    /// J ≠ Jᵀ.
    #[error(
        "Euler tensor is not symmetric: entry ({row}, {column}) is {value} and ({column}, {row}) is {mirrored} \
            (counted from 0)"
    )]
    NotSymmetric {
        /// Row of the first entry, from 0.
        row: usize,
        /// Column of the first entry, from 0.
        column: usize,
        /// The entry.
        value: f64,
        /// Its mirror image.
        mirrored: f64,
    },
    /// J has a negative principal value.
    #[error(
        "Euler tensor has the negative principal value {value} kg m²: ∫ρ X⊗X dV has none; was an inertia tensor given? \
         Then J = ½ tr(I) 1 − I"
    )]
    NotPositive {
        /// The smallest principal value \[kg m²\].
        value: f64,
    },
}

impl MassProperties {
    /// The Euler tensor about a point of the shape's frame, J_p = J + m (X₀−X_p)⊗(X₀−X_p) \[kg m²\].
    pub fn about(&self, point: &Vec3) -> Mat3 {
        let arm = self.center - point;
        self.euler_tensor + self.mass * arm * arm.transpose()
    }

    /// The inertia tensor about the centre of mass, tr(J) I − J \[kg m²\].
    pub fn inertia(&self) -> Mat3 {
        Mat3::identity() * self.euler_tensor.trace() - self.euler_tensor
    }

    /// The two bodies as one.
    ///
    ///   m = m₁+m₂,  X₀ = (m₁X₁+m₂X₂)/m,  J = J₁ + J₂ + (m₁m₂/m) (X₁−X₂)⊗(X₁−X₂)
    ///
    /// The reduced mass keeps J free of cancellation however far the frame's origin is.
    pub fn combined(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        let arm = other.center - self.center;
        let reduced_mass = self.mass * other.mass / mass;
        Self {
            mass,
            center: self.center + arm * (other.mass / mass),
            euler_tensor: self.euler_tensor + other.euler_tensor + reduced_mass * arm * arm.transpose(),
            volume: self.volume + other.volume,
        }
    }

    /// All bodies as one; without any, a body of no mass, which [`MassProperties::validate`] refuses.
    pub fn sum(bodies: impl IntoIterator<Item = Self>) -> Self {
        let nothing = Self { mass: 0.0, center: Vec3::zeros(), euler_tensor: Mat3::zeros(), volume: 0.0 };
        bodies.into_iter().reduce(|sum, body| sum.combined(&body)).unwrap_or(nothing)
    }

    /// The same body turned by `rotation` R and then shifted by `offset` a: X → R X + a.
    pub fn transformed(&self, rotation: &Mat3, offset: &Vec3) -> Self {
        Self {
            center: rotation * self.center + offset,
            euler_tensor: symmetrized(&(rotation * self.euler_tensor * rotation.transpose())),
            ..*self
        }
    }

    /// The same distribution with every density multiplied by `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor, euler_tensor: self.euler_tensor * factor, ..*self }
    }

    /// The same distribution with the total mass `mass` \[kg\].
    pub fn with_mass(&self, mass: f64) -> Self {
        Self { mass, euler_tensor: self.euler_tensor * (mass / self.mass), ..*self }
    }

    /// Principal values and axes of the Euler tensor.
    pub fn principal(&self) -> PrincipalMoments {
        let eigen = symmetrized(&self.euler_tensor).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let column = |k: usize| eigen.eigenvectors.column(order[k]).into_owned();
        let (first, second) = (column(0), column(1));
        PrincipalMoments {
            values: Vec3::from_fn(|k, _| eigen.eigenvalues[order[k]]),
            axes: Mat3::from_columns(&[first, second, first.cross(&second)]),
        }
    }

    /// The number of directions in which the mass extends, 0 (a point) to 3.
    ///
    /// A rigid body can turn about every axis iff this is at least 2; a deformable one needs 3.
    pub fn rank(&self) -> usize {
        let values = self.principal().values;
        values.iter().filter(|&&value| value > DEFINITENESS_TOLERANCE * values[2].max(0.0)).count()
    }

    /// Checks that some body has these properties.
    ///
    /// # Errors
    /// [`MassError`] names the first value that is not admissible: m ≤ 0, V < 0, a component that is not finite, J ≠ Jᵀ
    /// beyond 1e-9 of its largest entry, a principal value below −1e-12 of the largest.
    pub fn validate(&self) -> Result<(), MassError> {
        if !(self.mass > 0.0 && self.mass.is_finite()) {
            return Err(MassError::MassNotPositive { value: self.mass });
        }
        if !(self.volume >= 0.0 && self.volume.is_finite()) {
            return Err(MassError::VolumeNegative { value: self.volume });
        }
        finite("center of mass", self.center.as_slice())?;
        finite("Euler tensor", self.euler_tensor.as_slice())?;
        let tensor = &self.euler_tensor;
        let tolerance = SYMMETRY_TOLERANCE * tensor.amax();
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let (value, mirrored) = (tensor[(row, column)], tensor[(column, row)]);
            if (value - mirrored).abs() > tolerance {
                return Err(MassError::NotSymmetric { row, column, value, mirrored });
            }
        }
        let values = self.principal().values;
        if values[0] < -DEFINITENESS_TOLERANCE * values[2].abs() {
            return Err(MassError::NotPositive { value: values[0] });
        }
        Ok(())
    }
}

fn finite(quantity: &'static str, components: &[f64]) -> Result<(), MassError> {
    match components.iter().find(|component| !component.is_finite()) {
        Some(&value) => Err(MassError::NotFinite { quantity, value }),
        None => Ok(()),
    }
}

fn symmetrized(a: &Mat3) -> Mat3 {
    (a + a.transpose()) * 0.5
}
