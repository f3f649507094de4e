//! A plane between two bodies, and where it may be.

use crate::tensor::Vec3;

/// A plane: n, and c from the centre of mass of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    /// n, from B to A.
    pub normal: Vec3,
    /// c = n·x [m].
    pub offset: f64,
}

/// Where a plane is looked for first: along a normal, at a part of the slab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guess {
    /// n, from B to A.
    pub normal: Vec3,
    /// The part of the slab that is above it.
    pub share: f64,
}

impl Plane {
    /// The plane that three numbers turn and shift it to.
    pub(super) fn moved(&self, tangents: &[Vec3; 2], by: &Vec3) -> Self {
        let normal = self.normal + tangents[0] * by.x + tangents[1] * by.y;
        let length = normal.norm();
        Self { normal: normal / length, offset: (self.offset + by.z) / length }
    }
}
