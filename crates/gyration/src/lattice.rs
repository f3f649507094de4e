//! The cells of a lattice: what a model holds is one cell, or several, and what is between bodies of different cells
//! says in which cell the second is, seen from that of the first.
//!
//!   R = Σ n_a a_a,   n whole numbers, a_a the primitive vectors
//!
//! The place of a body is that in its own cell, so that no digits are lost to the distance of a cell.

use crate::tensor::{Mat3, Vec3};

/// n, the cell of one body as seen from that of another; beyond the number of vectors zero.
pub type Cell = [i32; 3];

/// The same cell.
pub const HERE: Cell = [0; 3];

/// The cell of the one as seen from the other, the other way round.
pub fn opposite(cell: Cell) -> Cell {
    cell.map(|n| -n)
}

/// The primitive vectors a_a [m], one to three; none of a model without a lattice.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lattice {
    vectors: Vec<Vec3>,
}

/// Vectors that span no cell.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DependentVectors {
    /// One has no length.
    #[error("cell vector {} is zero", .number + 1)]
    Zero {
        /// Its number, from zero.
        number: usize,
    },
    /// They lie in a plane, or along a line.
    #[error("the cell vectors depend on one another: they span {volume:e} of the product of their lengths")]
    Flat {
        /// What they span, as a part of the product of their lengths.
        volume: f64,
    },
}

/// Vectors that span less than this part of the product of their lengths are taken to depend on one another.
const LEAST_SPAN: f64 = 1e-9;

impl Lattice {
    /// Of one to three vectors [m].
    ///
    /// # Errors
    /// [`DependentVectors`].
    ///
    /// # Panics
    /// If there are more than three.
    pub fn new(vectors: Vec<Vec3>) -> Result<Self, DependentVectors> {
        assert!(vectors.len() <= 3, "space has three dimensions");
        let lattice = Self { vectors };
        if let Some(number) = lattice.vectors.iter().position(|vector| *vector == Vec3::zeros()) {
            return Err(DependentVectors::Zero { number });
        }
        // Of unit vectors, so that no product leaves the range of numbers.
        let units = Self { vectors: lattice.vectors.iter().map(|vector| vector / vector.norm()).collect() };
        let volume = units.volume();
        if volume > LEAST_SPAN { Ok(lattice) } else { Err(DependentVectors::Flat { volume }) }
    }

    /// a_a [m].
    pub fn vectors(&self) -> &[Vec3] {
        &self.vectors
    }

    /// R of a cell [m].
    #[inline]
    pub fn place(&self, cell: Cell) -> Vec3 {
        if cell == HERE {
            return Vec3::zeros();
        }
        self.vectors.iter().zip(cell).map(|(vector, n)| f64::from(n) * vector).sum()
    }

    /// Volume, area or length Ω of the cell [m³, m² or m].
    pub fn volume(&self) -> f64 {
        match self.vectors[..] {
            [a] => a.norm(),
            [a, b] => a.cross(&b).norm(),
            [a, b, c] => a.cross(&b).dot(&c).abs(),
            _ => 1.0,
        }
    }

    /// The reciprocal vectors b_a [1/m], a_a·b_c = 2π δ_ac, in the space that the vectors span.
    pub fn reciprocal(&self) -> Vec<Vec3> {
        let columns = self.completed();
        // Rows of the inverse are dual to the columns.
        let dual = columns.try_inverse().unwrap_or_else(Mat3::zeros) * std::f64::consts::TAU;
        (0..self.vectors.len()).map(|a| dual.row(a).transpose()).collect()
    }

    /// The vectors as columns, and unit vectors across them in the place of those that there are not.
    pub fn completed(&self) -> Mat3 {
        let across = |a: &Vec3| {
            let axis = a.iamin();
            a.cross(&Vec3::ith(axis, 1.0)).normalize()
        };
        match self.vectors[..] {
            [a] => {
                let b = across(&a);
                Mat3::from_columns(&[a, b, a.cross(&b).normalize()])
            }
            [a, b] => Mat3::from_columns(&[a, b, a.cross(&b).normalize()]),
            [a, b, c] => Mat3::from_columns(&[a, b, c]),
            _ => Mat3::identity(),
        }
    }

    /// The orthogonal projector onto the space that the vectors span.
    pub fn projector(&self) -> Mat3 {
        let dual = self.reciprocal().into_iter().zip(&self.vectors);
        dual.map(|(reciprocal, vector)| vector * reciprocal.transpose() / std::f64::consts::TAU).sum()
    }

    /// The lattice under a homogeneous deformation F̄ of its vectors.
    #[must_use]
    pub fn deformed(&self, gradient: &Mat3) -> Self {
        Self { vectors: self.vectors.iter().map(|vector| gradient * vector).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocal_vectors_are_dual_and_lie_in_the_span() {
        let (a, b, c) = (Vec3::new(0.1, 0.02, 0.0), Vec3::new(-0.03, 0.2, 0.05), Vec3::new(0.0, 0.04, 0.3));
        for vectors in [vec![a], vec![a, b], vec![a, b, c]] {
            let lattice = Lattice::new(vectors.clone()).unwrap_or_else(|error| panic!("{error}"));
            let dual = lattice.reciprocal();
            for (i, vector) in vectors.iter().enumerate() {
                for (j, reciprocal) in dual.iter().enumerate() {
                    let expected = if i == j { std::f64::consts::TAU } else { 0.0 };
                    assert!((vector.dot(reciprocal) - expected).abs() < 1e-14, "{i} {j}");
                }
            }
            if let [one] = vectors[..] {
                assert!(dual[0].cross(&one).norm() < 1e-14);
            }
        }
    }

    #[test]
    fn vectors_in_a_plane_are_refused() {
        let (a, b) = (Vec3::x(), Vec3::y());
        assert!(Lattice::new(vec![a, b, a + b]).is_err() && Lattice::new(vec![a, 2.0 * a]).is_err());
        assert!(Lattice::new(vec![Vec3::zeros()]).is_err() && Lattice::new(vec![a, b]).is_ok());
    }
}
