//! Vectors and matrices of space.

use nalgebra::{Matrix3, Vector3};

pub(crate) type Vec3 = Vector3<f64>;
pub(crate) type Mat3 = Matrix3<f64>;
